"""Forces and contact pressure of the kinds without a model of stiffness: by statics of rigid parts."""

from collections.abc import Iterator

import numpy as np

from drivewright.indexing.motion import TURN
from drivewright.indexing.pin_pressure import best_resisting_contact
from drivewright.mechanisms.indexer import roller
from drivewright.mechanisms.indexer.build import IndexerModel
from drivewright.mechanisms.indexer.pins import largest_pin_values, pressure_check, pressure_on_pin
from drivewright.mechanisms.indexer.refusals import TRANSLATING
from drivewright.mechanisms.indexer.spec import IndexerSpec
from drivewright.result import Answer, Answers, Check, Column, Table


def no_stress(spec: IndexerSpec) -> str | None:
    """Why there is none."""
    return None if spec.load.torque or spec.kind in TRANSLATING else "load.torque is not given"


def stress(model: IndexerModel, done: Answers) -> Answer:
    """Forces on the rollers and Hertz pressure under the torque; those on the pins of translating cams come with the stiffness."""
    if model.translating:
        return Answer()
    table, findings = (_plate if model.spec.kind == "parallel" else roller.stress)(model, done)
    values = largest_pin_values(table)
    return Answer(values, (table,), (*pressure_check(model, values), *_held(model, table)), findings)


def _held(model: IndexerModel, table: Table) -> Iterator[Check]:
    """Part of the input angles at which no roller takes the torque."""
    if model.spec.load.angle is None:
        angles = model.angles if model.spec.kind == "parallel" else np.linspace(0, TURN, roller.STEPS)
        lost = 1 - len(np.unique(table["angle"].data)) / len(angles)
        yield Check("held", lost, 0.0, "<=", "-", "part of the input angles at which no roller takes the torque", ("cam1", "wheel"))


def _plate(model: IndexerModel, done: Answers) -> tuple[Table, tuple[str, ...]]:
    """Of two plate cams: the roller with the longest lever alone."""
    torque, rows = model.torque, []
    for angle in model.angles:
        best = [best_resisting_contact(level, angle, torque) for level in model.plane.levels]
        number, (pin, arm, curvature) = max(enumerate(best), key=lambda each: abs(each[1][1]))
        if arm:
            force = abs(torque / arm)
            rows.append((angle, pin + model.plane.pins * number, force, arm, pressure_on_pin(model, force, curvature)))
    data = np.array(rows, dtype=float).reshape(-1, 5).T
    lost = len(model.angles) - len(rows)
    findings = (f"nothing carries the torque at {lost} of {len(model.angles)} input angles",) if lost else ()
    return Table(
        "pin_forces",
        "Force on the roller with the longest lever",
        (
            Column("angle", "rad", "input angle", data[0]),
            Column("pin", "-", "roller", data[1]),
            Column("force", "N", "force on the roller", data[2]),
            Column("arm", "m", "lever about the wheel's axis", data[3]),
            Column("pressure", "Pa", "Hertz pressure", data[4]),
        ),
    ), findings
