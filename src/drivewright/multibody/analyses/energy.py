"""Energy audit and drive torque."""

from drivewright.labels import in_words
from drivewright.multibody.analyses.energy_audit import audit_table, error_check, error_values
from drivewright.multibody.analyses.ensemble import statistics
from drivewright.multibody.analyses.simulation_model import ROWS, SimulationModel, cycle_columns, last_turn, over_last_turn, run_of
from drivewright.multibody.analyses.turns import audit_of_run, driven_columns, energy_numbers
from drivewright.multibody.observe import POWER_FIELDS
from drivewright.multibody.system import joints_with_friction
from drivewright.result import Answer, Check, Column, Table, Value

UNITS = {"torque": "N m", "force": "N"}  # of drives that turn, and of those that push
MEANING = {
    "springs": "springs, dampers and bushings",
    "applied": "applied torques and forces",
    "pins": "pins with clearance",
    "friction": "friction in ideal joints",
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
    kinds = [name for name in POWER_FIELDS if name != "friction" or len(joints_with_friction(model.assembly.system))]
    values = {
        f"energy.{name}": Value.of(numbers.of_run(name), "J", f"work of {MEANING[name]} over the run", f"work of {MEANING[name]}")
        for name in kinds
    }
    values |= error_values(numbers.worst("gap"), numbers.worst("error"))
    limit, checks = model.limits.energy_error, []
    remedy = "; lower simulate.relative_tolerance"
    checks.append(error_check(values["energy.error"].value, limit, remedy))
    if model.assembly.model.drives:
        words = "maximum difference between the work of the drives and the change of energy plus losses, relative to the work of the drives"
        label = "drive work balance error, relative"
        checks.append(Check("power_audit", numbers.worst("power_error"), limit, "<=", "-", words + remedy, label=label))
    return Answer(values, (), tuple(checks))


def drive_torque(model: SimulationModel) -> Answer:
    """Largest torque (force) of the drives in the window; nothing without a drive."""
    if not model.assembly.model.drives:
        return Answer()
    values = {
        f"drive.max_{kind}": Value.of(
            statistics(model).of_run(f"drive.{kind}"), UNITS[kind], f"peak magnitude of the drive {kind}", f"peak drive {kind}"
        )
        for kind in driven_columns(model)
    }
    torque, limit = values.get("drive.max_torque"), model.limits.drive_torque
    checks = (Check.of(torque, "drive_torque", limit, "<=", "peak drive torque"),) if limit and torque else ()
    return Answer(values, (), checks)


def _torque_tables(model):
    """Torque (force) of the drives over the last turn."""
    names = [drive.joint for drive in model.assembly.model.drives]
    if not names:
        return ()
    turn = last_turn(model)
    columns = [
        Column(f"{kind}_{names[k]}", UNITS[kind], f"drive {kind} at joint {in_words(names[k])}", turn.drives[:, k])
        for kind, chosen in driven_columns(model).items()
        for k in chosen
    ]
    kinds = " and ".join(driven_columns(model))
    return (Table("drive", f"Drive {kinds}{over_last_turn(model)}", (*cycle_columns(model, turn.t), *columns)),)
