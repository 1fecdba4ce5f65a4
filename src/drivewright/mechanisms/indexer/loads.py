"""Loads of the crank and support bearings over a turn of the crank, their lives, and the statics of equations (7) to (12)."""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from drivewright import bearings
from drivewright._typing import Complexes
from drivewright.indexing.contacts import CamContacts
from drivewright.indexing.motion import TURN
from drivewright.indexing.stiffness import statics
from drivewright.indexing.stiffness.loading import solve_after_play, solve_loaded
from drivewright.indexing.stiffness.result import CARRIED, TorsionalStiffness
from drivewright.indexing.stiffness.statics import equivalent_load
from drivewright.indexing.stiffness.tables import bearing_forces, bearing_load_table
from drivewright.mechanisms.indexer.build import STEP, IndexerModel
from drivewright.mechanisms.indexer.refusals import TRANSLATING
from drivewright.mechanisms.indexer.spec import IndexerSpec
from drivewright.result import Answer, Answers, Check, Value

RATED = {"crank": "crank_bearings", "support": "support_bearings"}


def no_loads(spec: IndexerSpec) -> str | None:
    """Why there are none."""
    if spec.kind not in TRANSLATING:
        return f"kind {spec.kind!r} has no cranks"
    if spec.load.torque is None:
        return "load.torque is not given"
    return None if spec.crank_bearings or spec.support_bearings else "no bearings are given; without them statics leaves their loads open"


def bearing_loads(model: IndexerModel, done: Answers) -> Answer:
    """Forces on every bearing over the turn, largest and mean loads, lives, and the corrected statics beside them."""
    torque = model.torque
    angles = model.angles if model.spec.load.angle is not None else np.linspace(0, TURN, int(round(TURN / STEP)) + 1)
    found, near = solve_loaded(model.loaded_wheel, angles, torque)
    loaded, _, _ = solve_after_play(model.loaded_wheel, angles, torque, found, near)
    forces = bearing_forces(loaded)
    values, checks, findings = {}, [], []
    for group in RATED:
        own = {name: force for name, force in forces.items() if name.startswith(group)}
        if any(np.isfinite(force).any() for force in own.values()):
            values |= _measures(model, group, own)
            checks += _checks(model, group, own, values)
    lost = np.sum([outcome != CARRIED for outcome in loaded.outcome])
    if lost:
        findings.append(
            f"bearing loads are absent at {lost} of {len(angles)} input angles, where nothing carries the torque; lives leave them out"
        )
    if model.spec.cams == 2 and model.wheel.side == "inside":
        values |= _statics(model, found, near)
    return Answer(values, (bearing_load_table(angles, forces),), tuple(checks), tuple(findings))


def _measures(model: IndexerModel, group: str, own: Mapping[str, Complexes]) -> dict[str, Value]:
    """Largest load of a group; equivalent load and life of its worst bearing."""
    largest = max(float(np.nanmax(np.abs(force))) for force in own.values())
    values = {f"{group}.max_load": Value(largest, "N", f"largest load of a {group} bearing")}
    rolling = model.rolling.get(RATED[group])
    if rolling is None or rolling.dynamic_rating is None or len(model.angles) == 1:
        return values
    mean = max(equivalent_load(np.abs(force), bearings.life_exponent(rolling)) for force in own.values())
    if mean > 0:
        life = float(bearings.basic_life(rolling, mean))
        values[f"{group}.equivalent_load"] = Value(mean, "N", f"load of constant size with the same life, worst {group} bearing")
        values[f"{group}.basic_life"] = Value(life, "-", f"basic life L10 (ISO 281) of the worst {group} bearing, turns of the input")
        if model.spec.load.speed:
            values[f"{group}.basic_life.time"] = Value(life * TURN / model.spec.load.speed, "s", "the same at the input's speed")
    return values


def static_rating(model: IndexerModel, table: str) -> float | None:
    """C0 [N] as given, else of the catalogue, else by the permissible pressure; None for a stiffness without one."""
    given, rolling = getattr(model.spec, table), model.rolling.get(table)
    if rolling is None:
        return given.static_rating if given else None
    return bearings.static_rating(rolling)


def _checks(model: IndexerModel, group: str, own: Mapping[str, Complexes], values: Mapping[str, Value]) -> Iterator[Check]:
    limits, largest = model.spec.limits, values[f"{group}.max_load"].value
    rating = static_rating(model, RATED[group])
    if rating and largest > 0:
        yield Check(
            f"static_rating.{group}",
            rating / largest,
            limits.static_safety,
            ">=",
            "-",
            f"static rating of {rating / 1e3:.4g} kN over the largest load of {largest / 1e3:.4g} kN",
            (group,),
        )
    life = values.get(f"{group}.basic_life.time")
    if limits.life and life:
        yield Check(
            f"life.{group}",
            life.value,
            limits.life,
            ">=",
            "s",
            f"basic life {life.value / 3600:.4g} h of {limits.life / 3600:.4g} h",
            (group,),
        )


def _statics(model: IndexerModel, found: TorsionalStiffness, near: Sequence[CamContacts]) -> dict[str, Value]:
    """Largest difference of the corrected equations (7)-(12) from the solver, over the largest load, and the same of the printed (8)."""
    if model.train is None or model.train.crank is None:
        return {}
    return {
        f"statics.{name}.deviation": Value(deviation, "-", f"equations (8) as {name} against the equilibrium, over the largest load")
        for name, deviation in statics.crank_load_deviations(found, near, model.wheel.eccentricity, model.train.spacing).items()
    }
