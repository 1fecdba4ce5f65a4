"""Forces and contact pressure of the kinds whose cams turn, by statics of rigid parts; the check of the pressure."""

from collections.abc import Iterator, Mapping

import numpy as np

from drivewright import materials
from drivewright.indexing.motion import TURN
from drivewright.indexing.pin_pressure import largest_pin_values, longest_lever_table
from drivewright.mechanisms.indexer import roller
from drivewright.mechanisms.indexer.build import IndexerModel
from drivewright.mechanisms.indexer.geometry import holding_hint
from drivewright.mechanisms.indexer.refusals import TRANSLATING
from drivewright.mechanisms.indexer.spec import IndexerSpec
from drivewright.result import Answer, Answers, Check, Table, Value


def no_stress(spec: IndexerSpec) -> str | None:
    """Why there is none."""
    return None if spec.load.torque or spec.kind in TRANSLATING else "load.torque is not given"


def stress(model: IndexerModel, done: Answers) -> Answer:
    """Forces on the rollers and Hertz pressure under the torque; those on the pins of translating cams come with the stiffness."""
    if model.translating:
        return Answer()
    table, findings = (_plate if model.flat else roller.stress)(model, done)
    values = largest_pin_values(table, "roller")
    return Answer(values, (table,), (*pressure_check(model, values, "roller"), *_held(model, table)), findings)


def pressure_check(model: IndexerModel, values: Mapping[str, Value], part: str = "pin") -> Iterator[Check]:
    """The Hertz pressure on a pin or roller against what is allowed, or what the material stands."""
    allowed = model.spec.limits.contact_pressure or materials.material(model.spec.contact.material).hertz_limit
    if allowed and "pins.max_pressure" in values:
        message = f"maximum Hertz pressure on a {part}; increase the contact length or the {part} radius, or take a stronger material"
        label = f"Maximum Hertz pressure on a {part}"
        yield Check.of(values["pins.max_pressure"], "contact_pressure", allowed, "<=", message, ("cam1", "wheel"), label)


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
