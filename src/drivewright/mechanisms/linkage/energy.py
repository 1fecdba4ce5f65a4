"""Energy audit and drive torque of a linkage's run."""

import numpy as np

from drivewright.mechanisms.linkage.analyse import ROWS, cycle_columns, last_turn
from drivewright.mechanisms.linkage.build import run_of
from drivewright.mechanisms.linkage.ensemble import statistics
from drivewright.mechanisms.linkage.member import audited, energy_of
from drivewright.multibody.observe import POWER_FIELDS
from drivewright.result import Answer, Check, Column, Table, Value

MEANING = {
    "springs": "springs, dampers and bushings",
    "applied": "applied torques and forces",
    "pins": "pins with play",
    "drives": "drives",
}


def energy(model, done):
    """Work of every kind of element against the change of energy; torque of the drive."""
    found, numbers = audited(model, run_of(model)), statistics(model, energy_of)
    rows = slice(None, None, max(1, len(found.t) // ROWS))
    columns = (
        Column("time", "s", "time", found.t[rows]),
        Column("stored", "J", "kinetic energy and energy of gravity, from the start", (found.gap + np.sum(found.works, axis=1))[rows]),
    )
    columns += tuple(Column(f"work_{name}", "J", f"work of {MEANING[name]}", found.works[rows, k]) for k, name in enumerate(POWER_FIELDS))
    columns += (Column("gap", "J", "change of energy less all work: the audit's error", found.gap[rows]),)
    values = {f"energy.{name}": Value.of(numbers.of_run(name), "J", f"work of {MEANING[name]} over the run") for name in POWER_FIELDS}
    values["energy.gap"] = Value(numbers.worst("gap"), "J", "largest gap of the energy audit")
    values["energy.error"] = Value(numbers.worst("error"), "-", "largest gap over the energy exchanged")
    limit, checks = model.spec.limits.energy_error, []
    checks.append(Check("energy_audit", values["energy.error"].value, limit, "<=", "-", values["energy.error"].meaning))
    if model.assembly.model.drives:
        words = "largest gap between work of the drives and change of energy with losses, over the work of the drives"
        checks.append(Check("power_audit", numbers.worst("power_error"), limit, "<=", "-", words))
    torque = _torque(model)
    return Answer(values | torque.values, (Table("energy", "Energy audit", columns), *torque.tables), (*checks, *torque.checks))


def _torque(model):
    """Torque (force) of the drives over the last turn, and the largest in the window."""
    if not model.assembly.model.drives:
        return Answer()
    turn = last_turn(model)
    names = [drive.joint for drive in model.assembly.model.drives]
    torque = Value.of(statistics(model).of_run("drive.torque"), "N m", "largest torque of the drive, either way")
    values = {"drive.max_torque": torque}
    columns = (
        *cycle_columns(model, turn.t),
        *(Column(f"torque_{name}", "N m", f"torque of the drive at joint {name!r}", turn.drives[:, k]) for k, name in enumerate(names)),
    )
    limit = model.spec.limits.drive_torque
    checks = (Check.of(torque, "drive_torque", limit, "<=", "largest torque of the drive"),) if limit else ()
    return Answer(values, (Table("drive", "Torque of the drive over the last turn", columns),), checks)
