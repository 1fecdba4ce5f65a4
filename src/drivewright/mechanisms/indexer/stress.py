"""Forces and contact pressure of the kinds whose cams turn, by statics of rigid parts; the check of the pressure."""

from collections.abc import Iterator, Mapping

import numpy as np

from drivewright import materials
from drivewright.indexing.motion import TURN
from drivewright.indexing.pin_pressure import WIDEST, largest_pin_values, longest_lever_table, relative_width
from drivewright.mechanisms.indexer import roller
from drivewright.mechanisms.indexer.build import IndexerModel
from drivewright.mechanisms.indexer.refusals import TRANSLATING
from drivewright.mechanisms.indexer.spec import IndexerSpec
from drivewright.result import Answer, Answers, Check, Table, Value

PRESSURES = {  # values that the check of the pressure looks at, and its message where one is the largest
    "pins.max_pressure": "Hertz pressure on a pin",
    "shared.max_pressure": "Hertz pressure on a roller, the load shared by stiffness",
    "dwell.pins.max_pressure": "Hertz pressure in the dwell, on a pin or roller",
}
TOO_WIDE = (
    "{0} = {1:.4g} MPa: the half-width of this contact is {2:.2g} times its relative radius; Hertz's theory holds up to about {3:g}, so "
    "this force and pressure are no prediction. Lower the torque or the interference, or take larger pins"
)
UNSHARED = (
    "contact_pressure is not checked: the statics of rigid parts do not know contact.interference; let the analysis 'stiffness' run as "
    "well, whose forces do"
)


def no_stress(spec: IndexerSpec) -> str | None:
    """Why there is none."""
    return None if spec.load.torque or spec.kind in TRANSLATING else "load.torque is not given"


def stress(model: IndexerModel, done: Answers) -> Answer:
    """Forces on the rollers and Hertz pressure under the torque; those on the pins of translating cams come with the stiffness."""
    if model.translating:
        return Answer()
    table, findings = (_plate if model.flat else roller.stress)(model, done)
    values, shared = largest_pin_values(table), done["stiffness"].values if "stiffness" in done else {}
    unshared = model.spec.contact.interference and not shared
    judged = Answer(findings=(UNSHARED,)) if unshared else judge_pressure(model, {**shared, **values})
    return Answer(values, (table,), (*judged.checks, *_held(model, table)), (*findings, *judged.findings))


def judge_pressure(model: IndexerModel, values: Mapping[str, Value]) -> Answer:
    """Check of the largest Hertz pressure among the values against what is allowed, or what the material stands; a finding where the
    contact is too wide for Hertz's theory."""
    known = {name: values[name].value for name in PRESSURES if name in values}
    if not known:
        return Answer()
    name, largest = max(known.items(), key=lambda each: each[1])
    allowed = model.spec.limits.contact_pressure or materials.material(model.spec.contact.material).hertz_limit
    check = Check("contact_pressure", largest, allowed or np.nan, "<=", "Pa", PRESSURES[name], ("cam1", "wheel"))
    width = relative_width(largest, model.modulus)
    return Answer(
        checks=(check,) if allowed else (), findings=(TOO_WIDE.format(name, largest / 1e6, width, WIDEST),) if width > WIDEST else ()
    )


def _held(model: IndexerModel, table: Table) -> Iterator[Check]:
    """Part of the input angles at which no roller takes the torque."""
    if model.spec.load.angle is None:
        angles = model.angles if model.flat else np.linspace(0, TURN, roller.STEPS)
        lost = 1 - len(np.unique(table["angle"].data)) / len(angles)
        yield Check("held", lost, 0.0, "<=", "-", "part of the input angles at which no roller takes the torque", ("cam1", "wheel"))


def _plate(model: IndexerModel, done: Answers) -> tuple[Table, tuple[str, ...]]:
    """Of two plate cams: the roller with the longest lever alone."""
    table = longest_lever_table(model.plane, model.angles, model.torque, model.spec.cam_width, model.modulus)
    count = len(model.angles)
    lost = count - len(table["angle"].data)
    return table, (f"nothing carries the torque at {lost} of {count} input angles",) if lost else ()
