"""Torsional stiffness over the index period: who carries, how far the wheel yields, and where nothing holds it."""

from collections.abc import Iterator, Mapping

from drivewright.indexing.pin_pressure import largest_pin_values
from drivewright.indexing.stiffness.loading import dwell_angles, solve_after_play, solve_at_contacts, solve_loaded
from drivewright.indexing.stiffness.tables import pin_force_table, stiffness_table
from drivewright.indexing.stiffness.values import dwell_values, stiffness_findings, stiffness_values
from drivewright.mechanisms.indexer.build import STEP, IndexerModel
from drivewright.mechanisms.indexer.refusals import TRANSLATING
from drivewright.mechanisms.indexer.spec import IndexerSpec
from drivewright.mechanisms.indexer.stress import pressure_check
from drivewright.result import Answer, Answers, Check, Value


def no_stiffness(spec: IndexerSpec) -> str | None:
    """Why there is none."""
    if spec.kind not in TRANSLATING:
        return f"kind {spec.kind!r} has no model of stiffness"
    return None if spec.load.torque else "load.torque is not given"


def torsional(model: IndexerModel, done: Answers) -> Answer:
    """Secant and tangent stiffness, compliance budget, forces of pins and bearings at every position."""
    wheel, torque, angles = model.loaded_wheel, model.torque, model.angles
    result, contacts = solve_loaded(wheel, angles, torque)
    loaded, touching, free = solve_after_play(wheel, angles, torque, result, contacts)
    reverse = solve_at_contacts(wheel, angles, contacts, -torque)
    forces = pin_force_table(angles, touching, loaded, *model.pin_measures)
    values = stiffness_values(angles, result) | _dwell(model) | largest_pin_values(forces)
    tables = (stiffness_table(angles, result, loaded, free, reverse), forces)
    return Answer(values, tables, tuple(_checks(model, values)), tuple(stiffness_findings(angles, result, loaded)), data=(result, contacts))


def _dwell(model: IndexerModel) -> dict[str, Value]:
    """Holding, least stiffness and largest pin force in the dwell; nothing where one input angle is asked for."""
    angles = dwell_angles(model.wheel.motion, STEP)
    if model.spec.load.angle is not None or not len(angles):
        return {}
    result, contacts = solve_loaded(model.loaded_wheel, angles, model.torque)
    return dwell_values(angles, result, pin_force_table(angles, contacts, result, *model.pin_measures))


def _checks(model: IndexerModel, values: Mapping[str, Value]) -> Iterator[Check]:
    limits = model.spec.limits
    if limits.stiffness and "stiffness.minimum" in values:
        least = values["stiffness.minimum"].value
        yield Check("stiffness", least, limits.stiffness, ">=", "N m/rad", "least torsional stiffness", ("wheel",))
    for name, of, words in (("held", "stiffness", "index period"), ("held.dwell", "dwell", "dwell")):
        lost = values.get(f"{of}.undefined_fraction")
        if lost is not None and model.spec.load.angle is None:
            message = f"part of the {words} in which the torque is not held at once: the wheel turns freely first, or has next to no lever"
            yield Check(name, lost.value, 0.0, "<=", "-", message, ("cam1", "wheel"))
    yield from pressure_check(model, values)
