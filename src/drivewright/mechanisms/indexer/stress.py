"""Forces and contact pressure of the kinds whose cams turn, by statics of rigid parts; the check of the pressure."""

from collections.abc import Iterator, Mapping

import numpy as np

from drivewright import materials
from drivewright.indexing.motion import TURN
from drivewright.indexing.pin_pressure import WIDEST, largest_pin_values, longest_lever_table, relative_width
from drivewright.mechanisms.indexer import roller
from drivewright.mechanisms.indexer.build import IndexerModel
from drivewright.mechanisms.indexer.geometry import holding_hint
from drivewright.mechanisms.indexer.refusals import TRANSLATING
from drivewright.mechanisms.indexer.spec import IndexerSpec
from drivewright.result import Answer, Answers, Check, Table, Value

PRESSURES = {  # values that the check of the pressure looks at, and its message where one is the largest
    "pins.max_pressure": "maximum Hertz pressure on a {}",
    "shared.max_pressure": "maximum Hertz pressure on a {}, the load shared by stiffness",
    "dwell.pins.max_pressure": "maximum Hertz pressure on a {} in the dwell",
}
LABELS = {  # of that check: those of the values
    "pins.max_pressure": "Maximum Hertz pressure on a {}",
    "shared.max_pressure": "Maximum Hertz pressure, shared load",
    "dwell.pins.max_pressure": "Maximum Hertz pressure in the dwell",
}
TOO_WIDE = (
    "{0} = {1:.4g} MPa: the half-width of this contact is {2:.2g} times its relative radius; Hertz's theory holds up to about {3:g}, so "
    "this force and pressure are no prediction. Lower the torque or the interference, or take larger pins"
)
UNSHARED = (
    "contact_pressure is not checked: the statics of rigid parts leave contact.interference out; run the analysis 'stiffness' as well, "
    "whose forces include it"
)


def no_stress(spec: IndexerSpec) -> str | None:
    """Why there is none."""
    return None if spec.load.torque or spec.kind in TRANSLATING else "load.torque is not given"


def stress(model: IndexerModel, done: Answers) -> Answer:
    """Forces on the rollers and Hertz pressure under the torque; those on the pins of translating cams come with the stiffness."""
    if model.translating:
        return Answer()
    table, findings = (_plate if model.flat else roller.stress)(model, done)
    values, shared = largest_pin_values(table, "roller"), done["stiffness"].values if "stiffness" in done else {}
    unshared = model.spec.contact.interference and not shared
    judged = Answer(findings=(UNSHARED,)) if unshared else judge_pressure(model, {**shared, **values}, "roller")
    return Answer(values, (table,), (*judged.checks, *_held(model, table)), (*findings, *judged.findings))


def judge_pressure(model: IndexerModel, values: Mapping[str, Value], part: str = "pin") -> Answer:
    """Check of the largest Hertz pressure among the values against what is allowed, or what the material stands; a finding where the
    contact is too wide for Hertz's theory."""
    known = {name: values[name].value for name in PRESSURES if name in values}
    if not known:
        return Answer()
    name, largest = max(known.items(), key=lambda each: each[1])
    allowed = model.spec.limits.contact_pressure or materials.material(model.spec.contact.material).hertz_limit
    message = f"{PRESSURES[name].format(part)}; increase the contact length or the {part} radius, or take a stronger material"
    label = LABELS[name].format(part)
    check = Check("contact_pressure", largest, allowed or np.nan, "<=", "Pa", message, ("cam1", "wheel"), label=label)
    width = relative_width(largest, model.modulus)
    return Answer(
        checks=(check,) if allowed else (), findings=(TOO_WIDE.format(name, largest / 1e6, width, WIDEST),) if width > WIDEST else ()
    )


def _held(model: IndexerModel, table: Table) -> Iterator[Check]:
    """Share of the input angles at which no roller carries the torque."""
    if model.spec.load.angle is None:
        angles = model.angles if model.flat else np.linspace(0, TURN, roller.STEPS)
        lost = 1 - len(np.unique(table["angle"].data)) / len(angles)
        message, label = (
            f"share of the input angles at which no roller carries the torque; {holding_hint(model)}",
            "Cycle without holding contact",
        )
        yield Check("held", lost, 0.0, "<=", "-", message, ("cam1", "wheel"), label=label)


def _plate(model: IndexerModel, done: Answers) -> tuple[Table, tuple[str, ...]]:
    """Of two plate cams: the roller with the longest moment arm alone."""
    table = longest_lever_table(model.plane, model.angles, model.torque, model.spec.cam_width, model.modulus)
    count = len(model.angles)
    lost = count - len(table["angle"].data)
    return table, (f"no roller carries the torque at {lost} of {count} input angles",) if lost else ()
