"""What drives and motors must be able to give: torque, speed, power over the window, and the reflected inertia."""

import numpy as np

from drivewright._typing import Floats
from drivewright.labels import in_words
from drivewright.motion.motor_sizing import MotorSizing, size_motor
from drivewright.multibody.analyses.actuation import Actuation, actuations, observe_run
from drivewright.multibody.analyses.simulation_model import SimulationModel, run_of
from drivewright.multibody.analyses.turns import start_of_window
from drivewright.multibody.curves import curve_slope, curve_values
from drivewright.multibody.forces.joint_friction import JointFrictions
from drivewright.multibody.observe import Observed, observe
from drivewright.multibody.records import table_of
from drivewright.multibody.simulate import simulate, states_outside_folds
from drivewright.multibody.system import PIECE, System
from drivewright.numerics.signals import time_mean
from drivewright.result import Answer, Column, Table, Value

POSITIONS = 73  # at which the inertia is felt
QUANTITIES = (
    # key, of MotorSizing, unit where it turns, unit where it slides, words, convention
    ("rms", "rms_torque", "N m", "N", "RMS {effort}", ""),
    ("peak", "peak_torque", "N m", "N", "peak {effort}", "magnitude"),
    ("mean_power", "mean_power", "W", "W", "mean power", "positive from the drive into the mechanism"),
    ("peak_power", "peak_power", "W", "W", "peak power", "positive from the drive into the mechanism"),
    ("braking_power", "braking_power", "W", "W", "peak braking power", "positive from the mechanism back into the drive"),
    ("peak_speed", "peak_speed", "rad/s", "m/s", "peak {rate}", "magnitude"),
)


def observe_window(model: SimulationModel) -> Observed:
    """`Observed` over the window of the run; of whole turns where the drive makes some."""
    run = run_of(model)
    start, end = start_of_window(model, run.end[1]), run.end[1]
    observed = observe_run(model, run, start)
    if model.period and (turns := int((end - start) / model.period + 1e-9)):
        keep = observed.t <= (start + turns * model.period) * (1 + 1e-12)
        observed = Observed(*(field[keep] for field in observed))
    return observed


def motors(model: SimulationModel) -> Answer:
    """Sizing of every drive and motor: values and a table with a row each."""
    observed, values, rows = observe_window(model), {}, []
    for one in actuations(model, observed):
        own = {**_sizing_values(one, size_motor(observed.t, one.effort, one.rate)), **_inertia_values(model, one)}
        values |= {f"drives.{one.name}.{key}": value for key, value in own.items()}
        rows.append((one, own))
    return Answer(values, (_table(rows),) if rows else ())


def _sizing_values(one: Actuation, sizing: MotorSizing) -> dict[str, Value]:
    effort, rate = ("torque", "speed") if one.turns else ("force", "velocity")
    values = {}
    for key, field, turning, sliding, words, convention in QUANTITIES:
        name = f"{key}_{effort}" if key in ("rms", "peak") else key
        label = f"{words.format(effort=effort, rate=rate)} of drive {in_words(one.name)}"
        unit, meaning = turning if one.turns else sliding, f"{label} over the window"
        values[name] = Value(getattr(sizing, field), unit, meaning, label=label, convention=convention)
    return values


def _inertia_values(model: SimulationModel, one: Actuation) -> dict[str, Value]:
    times, inertia = felt_inertia(model, one)
    if not len(inertia):
        return {}
    unit, word = ("kg m^2", "inertia") if one.turns else ("kg", "mass")
    drive = f"drive {in_words(one.name)}"
    positions = "over the positions of a turn with ideal joints" if model.has_play else "over the positions in the window"
    of_all = {f"reflected_{word}": ("mean", time_mean(times, inertia)), f"max_reflected_{word}": ("maximum", np.max(inertia))}
    where = f"{positions}, other drives held"
    return {
        key: Value(float(value), unit, f"{kind} reflected {word} of {drive}, {where}", label=f"{kind} reflected {word}, {drive}")
        for key, (kind, value) in of_all.items()
    }


def _table(rows) -> Table:
    """A row a drive; torque and inertia of those that turn, force and mass of those that slide."""

    def column(name, unit, meaning, keys):
        numbers = [next((own[key].value for key in keys if key in own), np.nan) for _, own in rows]
        return Column(name, unit, meaning, np.array(numbers))

    turning, sliding = (any(one.turns is turns for one, _ in rows) for turns in (True, False))
    columns = [Column("joint", "-", "joint of the drive", np.array([one.name for one, _ in rows]))]
    for kind, unit, there in (("torque", "N m", turning), ("force", "N", sliding)):
        if there:
            columns += [
                column(f"rms_{kind}", unit, f"RMS {kind}", [f"rms_{kind}"]),
                column(f"peak_{kind}", unit, f"peak {kind}", [f"peak_{kind}"]),
            ]
    columns += [column(key, "W", words, [key]) for key, _, unit, _, words, _ in QUANTITIES if unit == "W"]
    for kind, unit, there in (("inertia", "kg m^2", turning), ("mass", "kg", sliding)):
        if there:
            columns.append(column(f"reflected_{kind}", unit, f"mean reflected {kind}", [f"reflected_{kind}"]))
            columns.append(column(f"max_reflected_{kind}", unit, f"maximum reflected {kind}", [f"max_reflected_{kind}"]))
    return Table("motors", "Motor sizing", tuple(columns))


# ---------------------------------------------------------------------------------------------------------- reflected inertia


def felt_inertia(model: SimulationModel, one: Actuation) -> tuple[Floats, Floats]:
    """(times [s], inertia [kg m^2] or mass [kg]) (m,) that a drive feels at positions over the window, nothing of a motor.

    It is how much more the drive gives for a unit more of acceleration, other drives as they are and without friction.  A pin with play
    passes on no acceleration at an instant, only what presses it: there the inertia is that without play.
    """
    times, felt = [], []
    number = next((k for k, drive in enumerate(model.assembly.model.drives) if drive.joint == one.name), None)
    if number is None:
        return np.zeros(0), np.zeros(0)
    for system, t, y in _positions(model):
        for k in range(len(t)):
            steady, faster = (_drive_effort(model, system, number, t[k], y[k], acceleration) for acceleration in (0.0, 1.0))
            times.append(t[k])
            felt.append(faster - steady)
    return np.array(times), np.array(felt)


def _positions(model):
    """(system, times, states) over the window; of the mechanism without play over a turn, or the whole run, where pins have play."""
    if not model.has_play:
        run = run_of(model)
        return states_outside_folds(run, start_of_window(model, run.end[1]), POSITIONS)
    length = model.period or model.run_length
    return states_outside_folds(simulate(model.ideal, length, model.settings, samples=np.linspace(0.0, length, POSITIONS)))


def _drive_effort(model, system, number, t, y, acceleration):
    """Torque of a drive at a state with this acceleration, friction left out."""
    changed = _accelerated(_frictionless(system), model.assembly.model.drives[number].motion, number, t, acceleration)
    return float(observe(changed, [t], y[None]).drives[0, number])


def _frictionless(system: System) -> System:
    if not isinstance(system.frictions, JointFrictions):
        return system
    table = system.frictions.table.copy()
    table.friction = table.static_friction = table.viscous = 0.0
    return system._replace(frictions=JointFrictions(table))


def _accelerated(system, motion, number, t, acceleration):
    """The system with the motion of a drive replaced by one through the same place at the same rate, with this acceleration."""
    piece = {"start": t, "c0": float(curve_values(motion, t)), "c1": float(curve_slope(motion, t)), "c2": 0.5 * acceleration}
    curves, place = system.curves.copy(), len(system.pieces)
    index = system.driven[number].curve
    curves.first[index], curves.count[index], curves.period[index] = place, 1, 0.0
    pieces = np.concatenate([system.pieces, table_of(PIECE, [piece])]).view(np.recarray)
    return system._replace(curves=curves.view(np.recarray), pieces=pieces)
