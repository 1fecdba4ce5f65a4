"""Torsional stiffness over the index period: who carries, how far the wheel yields, and where nothing holds it."""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from drivewright._typing import Bools, Floats
from drivewright.indexing.contacts import CamContacts
from drivewright.indexing.motion import TURN
from drivewright.indexing.stiffness.loading import solve_after_play, solve_at_contacts, solve_loaded
from drivewright.indexing.stiffness.result import CARRIED, TorsionalStiffness
from drivewright.indexing.stiffness.tables import pin_force_table, stiffness_table
from drivewright.mechanisms.indexer.build import STEP, IndexerModel
from drivewright.mechanisms.indexer.pins import largest_pin_values, pressure_check
from drivewright.mechanisms.indexer.refusals import TRANSLATING
from drivewright.mechanisms.indexer.spec import IndexerSpec
from drivewright.result import Answer, Answers, Check, Table, Value


def no_stiffness(spec: IndexerSpec) -> str | None:
    """Why there is none."""
    if spec.kind not in TRANSLATING:
        return f"kind {spec.kind!r} has no model of stiffness"
    return None if spec.load.torque else "load.torque is not given"


def torsional(model: IndexerModel, done: Answers) -> Answer:
    """Secant and tangent stiffness, compliance budget, forces of pins and bearings at every position."""
    torque, angles = model.torque, model.angles
    found, near = solve_loaded(model.loaded_wheel, angles, torque)
    loaded, touching, free = solve_after_play(model.loaded_wheel, angles, torque, found, near)
    reverse = solve_at_contacts(model.loaded_wheel, angles, near, -torque)
    carried = np.array([outcome == CARRIED for outcome in found.outcome])
    values = {
        "stiffness.undefined_fraction": Value(
            float(np.mean(~carried)), "-", "part of the positions where no contact without a gap carries the torque"
        )
    }
    values |= _summary(angles, found.secant, carried)
    values |= dwell(model, torque)
    forces = _pin_forces(model, angles, touching, loaded)
    values |= largest_pin_values(forces)
    tables = (stiffness_table(angles, found, loaded, free, reverse), forces)
    return Answer(values, tables, tuple(_checks(model, values)), tuple(_findings(angles, found, loaded, torque)), data=(found, near))


def dwell(model: IndexerModel, torque: float) -> dict[str, Value]:
    """Holding, least stiffness and largest pin force in the dwell, where work is done on the table."""
    start = model.wheel.motion.motion_angle
    count = int(np.ceil((TURN - start) / STEP))
    if model.spec.load.angle is not None or count < 2:
        return {}
    angles = np.linspace(start, TURN, count + 1)[1:-1]
    found, near = solve_loaded(model.loaded_wheel, angles, torque)
    carried = np.array([outcome == CARRIED for outcome in found.outcome])
    values = {
        "dwell.undefined_fraction": Value(float(np.mean(~carried)), "-", "part of the dwell where the torque is not held without play")
    }
    if carried.any():
        least = int(np.nanargmin(found.secant))
        values["dwell.stiffness.minimum"] = Value(float(found.secant[least]), "N m/rad", "least secant stiffness in the dwell")
        values["dwell.stiffness.minimum.at"] = Value(float(angles[least]), "rad", "input angle of the least stiffness in the dwell")
        forces = _pin_forces(model, angles, near, found)["force"].data
        values["dwell.pins.max_force"] = Value(float(np.max(forces)), "N", "largest force on a pin in the dwell")
    return values


def _summary(angles: Floats, secant: Floats, carried: Bools) -> dict[str, Value]:
    """Mean, minimum and range over the positions that carry the torque."""
    if not carried.any():
        return {}
    here, at = secant[carried], angles[carried]
    least = int(np.argmin(here))
    return {
        "stiffness.mean": Value(float(np.mean(here)), "N m/rad", "mean secant stiffness of the positions that carry the torque"),
        "stiffness.minimum": Value(float(here[least]), "N m/rad", "least secant stiffness"),
        "stiffness.minimum.at": Value(float(at[least]), "rad", "input angle of the least stiffness"),
        "stiffness.maximum": Value(float(np.max(here)), "N m/rad", "greatest secant stiffness"),
        "stiffness.range": Value(float(np.ptp(here)), "N m/rad", "greatest less least secant stiffness"),
    }


def _pin_forces(model: IndexerModel, angles: Floats, contacts: Sequence[CamContacts], found: TorsionalStiffness) -> Table:
    return pin_force_table(angles, contacts, found, model.spec.pin_radius, model.spec.cam_width, model.modulus)


def _checks(model: IndexerModel, values: Mapping[str, Value]) -> Iterator[Check]:
    limits = model.spec.limits
    if limits.stiffness and "stiffness.minimum" in values:
        yield Check(
            "stiffness", values["stiffness.minimum"].value, limits.stiffness, ">=", "N m/rad", "least torsional stiffness", ("wheel",)
        )
    for name, of, words in (("held", "stiffness", "index period"), ("held.dwell", "dwell", "dwell")):
        if f"{of}.undefined_fraction" in values and model.spec.load.angle is None:
            yield Check(
                name,
                values[f"{of}.undefined_fraction"].value,
                0.0,
                "<=",
                "-",
                f"part of the {words} in which the torque is not held at once: the wheel turns freely first, or has next to no lever",
                ("cam1", "wheel"),
            )
    yield from pressure_check(model, values)


def _findings(angles: Floats, found: TorsionalStiffness, loaded: TorsionalStiffness, torque: float) -> Iterator[str]:
    lost = [k for k, outcome in enumerate(found.outcome) if outcome != CARRIED]
    for reason in dict.fromkeys(found.reasons[k] for k in lost):
        at = [np.degrees(angles[k]) for k in lost if found.reasons[k] == reason]
        after = sum(loaded.outcome[k] == CARRIED for k in lost if found.reasons[k] == reason)
        more = f" At {after} of them a contact takes it after the play: table stiffness, secant_after_play." if after else ""
        yield (
            f"no stiffness at {len(at)} of {len(angles)} input angles ({', '.join(f'{angle:.4g}' for angle in at[:12])}"
            f"{' ...' if len(at) > 12 else ''} deg) against {torque:.6g} N m: {reason}.{more}"
        )
