"""Energy audit and drive torque."""

from drivewright.multibody.analyses.energy_audit import audit_table
from drivewright.multibody.analyses.ensemble import statistics
from drivewright.multibody.analyses.simulation_model import ROWS, SimulationModel, cycle_columns, last_turn, run_of
from drivewright.multibody.analyses.turns import audit_of_run, energy_numbers
from drivewright.multibody.observe import POWER_FIELDS
from drivewright.result import Answer, Check, Column, Table, Value

MEANING = {
    "springs": "springs, dampers and bushings",
    "applied": "applied torques and forces",
    "pins": "pins with play",
    "drives": "drives",
}


def energy(model: SimulationModel) -> Answer:
    """Work of every kind of element against the change of energy; torque of the drive."""
    works, torque = work_audit(model), drive_torque(model)
    tables = (audit_table(audit_of_run(model, run_of(model)), MEANING, ROWS), *_torque_tables(model))
    return Answer({**works.values, **torque.values}, tables, (*works.checks, *torque.checks))


def work_audit(model: SimulationModel) -> Answer:
    """Work of every kind of element over the run, and what the audits leave over."""
    numbers = statistics(model, energy_numbers)
    values = {f"energy.{name}": Value.of(numbers.of_run(name), "J", f"work of {MEANING[name]} over the run") for name in POWER_FIELDS}
    values["energy.gap"] = Value(numbers.worst("gap"), "J", "largest gap of the energy audit")
    values["energy.error"] = Value(numbers.worst("error"), "-", "largest gap over the energy exchanged")
    limit, checks = model.limits.energy_error, []
    checks.append(Check("energy_audit", values["energy.error"].value, limit, "<=", "-", values["energy.error"].meaning))
    if model.assembly.model.drives:
        words = "largest gap between work of the drives and change of energy with losses, over the work of the drives"
        checks.append(Check("power_audit", numbers.worst("power_error"), limit, "<=", "-", words))
    return Answer(values, (), tuple(checks))


def drive_torque(model: SimulationModel) -> Answer:
    """Largest torque (force) of the drives in the window; nothing without a drive."""
    if not model.assembly.model.drives:
        return Answer()
    torque = Value.of(statistics(model).of_run("drive.torque"), "N m", "largest torque of the drive, either way")
    limit = model.limits.drive_torque
    checks = (Check.of(torque, "drive_torque", limit, "<=", "largest torque of the drive"),) if limit else ()
    return Answer({"drive.max_torque": torque}, (), checks)


def _torque_tables(model):
    """Torque (force) of the drives over the last turn."""
    names = [drive.joint for drive in model.assembly.model.drives]
    if not names:
        return ()
    turn = last_turn(model)
    columns = (
        *cycle_columns(model, turn.t),
        *(Column(f"torque_{name}", "N m", f"torque of the drive at joint {name!r}", turn.drives[:, k]) for k, name in enumerate(names)),
    )
    return (Table("drive", "Torque of the drive over the last turn", columns),)
