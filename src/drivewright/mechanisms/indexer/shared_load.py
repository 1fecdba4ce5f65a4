"""Torsional stiffness of parallel, barrel and globoidal drives, and how their rollers share the load."""

from collections.abc import Iterator

import numpy as np

from drivewright.indexing.stiffness.loading import dwell_angles
from drivewright.indexing.stiffness.roller_drive import RollerDrive
from drivewright.indexing.stiffness.roller_loading import (
    LoadedRollers,
    shared_force_table,
    solve_at_roller_contacts,
    solve_rollers,
    solve_rollers_after_play,
)
from drivewright.indexing.stiffness.tables import stiffness_table
from drivewright.indexing.stiffness.values import dwell_values, stiffness_findings, stiffness_values
from drivewright.mechanisms.indexer.build import STEP, IndexerModel
from drivewright.mechanisms.indexer.spec import IndexerHousing
from drivewright.mechanisms.indexer.stiffness import holding_checks, stiffness_check
from drivewright.result import Answer, Answers, Table, Value


def loaded_rollers(model: IndexerModel) -> LoadedRollers:
    """The drive with what yields: rollers on their lines and in their seats, housing, shafts of cam and wheel."""
    spec, drive = model.spec, model.roller_drive
    held = spec.housing or IndexerHousing()
    yields = RollerDrive(
        spec.pin_circle_radius,
        spec.contact.pin_stiffness,
        held.cam_stiffness,
        held.input_torsion,
        held.wheel_stiffness,
        held.wheel_torsion,
        spec.contact.interference,
    )
    return LoadedRollers(drive, yields, spec.contact.model, spec.cam_width)


def torsional(model: IndexerModel, done: Answers) -> Answer:
    """Secant and tangent stiffness, compliance by parts, forces on the rollers at every position of the index period."""
    loaded, angles, torque = loaded_rollers(model), model.angles, model.torque
    result, contacts = solve_rollers(loaded, angles, torque)
    after, touching, free = solve_rollers_after_play(loaded, angles, torque, result, contacts)
    reverse = solve_at_roller_contacts(loaded, angles, contacts, -torque)
    forces = shared_force_table(angles, touching, after.pin_forces, model.modulus)
    values = stiffness_values(angles, result) | dict(_force_values(forces))
    dwell = _dwell(model, loaded)
    checks, limit = dwell.checks, model.spec.limits.stiffness
    if limit and "stiffness.minimum" in values:
        least = values["stiffness.minimum"]
        checks = (*checks, stiffness_check(least, limit))
    tables = (stiffness_table(angles, result, after, free, reverse), forces)
    return Answer({**values, **dwell.values}, tables, checks, tuple(stiffness_findings(angles, result, after)), data=(result, contacts))


def _force_values(forces: Table) -> Iterator[tuple[str, Value]]:
    if len(forces["force"].data):
        meaning, label = "maximum force on a roller, the load shared by stiffness", "Maximum roller force, shared load"
        yield "shared.max_force", Value(float(np.max(forces["force"].data)), "N", meaning, label=label)
    if np.isfinite(forces["pressure"].data).any():
        largest = float(np.nanmax(forces["pressure"].data))
        meaning, label = "maximum Hertz pressure on a roller, the load shared by stiffness", "Maximum Hertz pressure, shared load"
        yield "shared.max_pressure", Value(largest, "Pa", meaning, label=label)


def _dwell(model: IndexerModel, loaded: LoadedRollers) -> Answer:
    """Holding, least stiffness and largest force in the dwell; nothing where one input angle is given."""
    angles = dwell_angles(model.drive.motion, STEP)
    if model.spec.load.angle is not None or not len(angles):
        return Answer()
    result, contacts = solve_rollers(loaded, angles, model.torque)
    values = dwell_values(angles, result, shared_force_table(angles, contacts, result.pin_forces, model.modulus), "roller")
    return Answer(values, checks=tuple(holding_checks(model, "held.dwell", values["dwell.undefined_fraction"], "dwell")))
