"""Torsional stiffness over the index period: the parts that carry, the rotation of the wheel, and positions without a holding contact."""

from collections.abc import Iterator

from drivewright.indexing.pin_pressure import largest_pin_values
from drivewright.indexing.stiffness.loading import dwell_angles, solve_after_play, solve_at_contacts, solve_loaded
from drivewright.indexing.stiffness.tables import pin_force_table, stiffness_table
from drivewright.indexing.stiffness.values import dwell_values, stiffness_findings, stiffness_values
from drivewright.mechanisms.indexer.build import STEP, IndexerModel, once
from drivewright.mechanisms.indexer.geometry import holding_hint
from drivewright.mechanisms.indexer.refusals import TRANSLATING
from drivewright.mechanisms.indexer.spec import IndexerSpec
from drivewright.mechanisms.indexer.stress import judge_pressure
from drivewright.result import Answer, Answers, Check, Value


def no_stiffness(spec: IndexerSpec) -> str | None:
    """Why there is none."""
    if spec.kind not in TRANSLATING:
        return f"kind {spec.kind!r} has no cams on cranks"
    return None if spec.load.torque else "load.torque is not given"


def torsional(model: IndexerModel, done: Answers) -> Answer:
    """Secant and tangent stiffness, compliance budget, forces of pins and bearings at every position."""
    angles, (result, contacts) = model.angles, _at_contacts(model)
    loaded, _, free = _after_play(model)
    reverse = solve_at_contacts(model.loaded_wheel, angles, contacts, -model.torque)
    tables = (stiffness_table(angles, result, loaded, free, reverse), _pin_forces(model))
    answers = (secant_stiffness(model), dwell_stiffness(model), pin_loads(model), pin_pressure(model))
    values = {name: value for answer in answers for name, value in answer.values.items()}
    checks = tuple(check for answer in answers for check in answer.checks)
    findings = (*stiffness_findings(angles, result, loaded), *(finding for answer in answers for finding in answer.findings))
    return Answer(values, tables, checks, findings, data=(result, contacts))


def secant_stiffness(model: IndexerModel) -> Answer:
    """Mean, extremes and range of the secant stiffness over the index period, and the positions without a holding contact."""
    values, limit = stiffness_values(model.angles, _at_contacts(model)[0]), model.spec.limits.stiffness
    checks = []
    if limit and "stiffness.minimum" in values:
        checks.append(stiffness_check(values["stiffness.minimum"], limit))
    return Answer(values, checks=(*checks, *holding_checks(model, "held", values.get("stiffness.undefined_fraction"), "index period")))


@once
def dwell_stiffness(model: IndexerModel) -> Answer:
    """Holding, least stiffness and largest pin force in the dwell; nothing where one input angle is given."""
    angles = dwell_angles(model.wheel.motion, STEP)
    if model.spec.load.angle is not None or not len(angles):
        return Answer()
    result, contacts = solve_loaded(model.loaded_wheel, angles, model.torque)
    values = dwell_values(angles, result, pin_force_table(angles, contacts, result.pin_forces, *model.pin_measures))
    return Answer(values, checks=tuple(holding_checks(model, "held.dwell", values.get("dwell.undefined_fraction"), "dwell")))


def pin_loads(model: IndexerModel) -> Answer:
    """Largest force and Hertz pressure of a pin over the index period, after the play where no contact holds the torque at first."""
    return Answer(largest_pin_values(_pin_forces(model)))


def pin_pressure(model: IndexerModel) -> Answer:
    """Check of the largest Hertz pressure, over the index period and in the dwell."""
    return judge_pressure(model, {**dwell_stiffness(model).values, **largest_pin_values(_pin_forces(model))})


@once
def _at_contacts(model):
    """(result, contacts) over the index period, the wheel in its ideal place."""
    return solve_loaded(model.loaded_wheel, model.angles, model.torque)


@once
def _after_play(model):
    """(result, contacts, play) once the wheel has turned freely."""
    return solve_after_play(model.loaded_wheel, model.angles, model.torque, *_at_contacts(model))


@once
def _pin_forces(model):
    """Table of the forces on the pins after the play."""
    loaded, touching, _ = _after_play(model)
    return pin_force_table(model.angles, touching, loaded.pin_forces, *model.pin_measures)


def stiffness_check(least: Value, limit: float) -> Check:
    """The least secant stiffness against its limit [N m/rad]."""
    message = "minimum secant stiffness over the index period; stiffen the parts that contribute most to the compliance"
    return Check.of(least, "stiffness", limit, ">=", message, ("wheel",), "Minimum torsional stiffness")


def holding_checks(model: IndexerModel, name: str, lost: Value | None, stretch: str) -> Iterator[Check]:
    """Share of the input angles at which the torque is not held at once; stretch: "index period" or "dwell"."""
    if lost is not None and model.spec.load.angle is None:
        why = "the wheel first turns freely, or the moment arm is near zero"
        message = f"share of the {stretch} at which no contact holds the torque at once: {why}; {holding_hint(model)}"
        label = f"{stretch.capitalize()} without holding contact"
        yield Check(name, lost.value, 0.0, "<=", "-", message, ("cam1", "wheel"), label=label)
