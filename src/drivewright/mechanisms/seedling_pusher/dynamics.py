"""The lever between its cams with clearance: contact forces and rod error, their dependence on clearance and speed, Poincare section."""

import numpy as np

from drivewright import curves
from drivewright._typing import Floats
from drivewright.cams.clearance import (
    LeverBetweenCams,
    LeverRun,
    mass_deviation,
    mass_deviation_rate,
    sample_tables,
    simulate_last_turn,
    simulate_turns,
)
from drivewright.cams.conjugate_tables import contact_table
from drivewright.contact import KelvinVoigt
from drivewright.errors import SolverError
from drivewright.mechanisms.seedling_pusher.build import TURN, PusherModel
from drivewright.multibody.analyses.poincare import Section, section_answer
from drivewright.numerics.ensemble import mean_of_members
from drivewright.numerics.jets import cos
from drivewright.result import Answer, Answers, Check, Column, Table, Value

GRID = 4096
ENSEMBLE = 8  # runs behind a number with clearance
FREE = "fraction of the turn in which neither roller is in contact"
PEAK = "maximum normal force in the last simulated turn"
ERROR = "maximum deviation of the rod from its programme"
WIDEST = 0.1e-3  # m: the largest clearance that its study looks at
TURNS, DISCARD = 48, 16  # of the carrier in the Poincare section, and those of them that are left out
STILL = 1e-3  # of the rod's range: the damper's force jumps at a touch, which costs digits


def lever_system(model: PusherModel, clearance: float | None = None, speed: float | None = None) -> LeverBetweenCams:
    """The lever of a model between its cams, for another clearance or speed where given; driving angle 0 is the start of the push."""
    spec = model.spec
    t = model.pair.start + np.linspace(0, TURN, GRID + 1)
    leverages = [cam.arm * cos(model.pair.pressure_angle(cam, t)) for cam in model.pair.cams]
    gaps = [curves.profile_gap(model.pair.trimmed[cam.name], t) for cam in model.pair.cams]
    return LeverBetweenCams(
        KelvinVoigt(spec.contact.stiffness, spec.contact.damping),
        sample_tables(model.pair.swing(t), leverages, gaps),
        float(speed or spec.drive.speed),
        spec.lever.output_arm,
        spec.load.mass,
        spec.load.push_force,
        spec.push.rise,
        float(spec.contact.clearance if clearance is None else clearance),
    )


def simulate(model: PusherModel, clearance: float | None = None, speed: float | None = None) -> LeverRun:
    """The last carrier turn of the contact run; angles count from the start of the push."""
    system = lever_system(model, clearance, speed)
    return simulate_last_turn(system, model.spec.contact.turns, lambda angle: model.pair.swing(model.pair.start + angle).d0)


def contact(model: PusherModel, done: Answers) -> Answer:
    """Contact forces, separation and rod error in the last simulated turn."""
    run = simulate(model)
    worst = run.max_deviation
    values = {
        "contact.peak_force": Value(run.peak_force, "N", PEAK, label="Peak contact force"),
        "contact.main.peak_force": Value(float(run.main.max()), "N", f"{PEAK} (main cam)", label="Peak contact force, main cam"),
        "contact.return.peak_force": Value(float(run.back.max()), "N", f"{PEAK} (return cam)", label="Peak contact force, return cam"),
        "contact.separation": Value(run.separation, "-", FREE, label="Fraction of the turn without contact"),
        "contact.rod_error.max": Value(worst, "m", ERROR, label="Maximum rod error"),
    }
    message = "maximum deviation of the rod from its programme; reduce the clearance or the speed, or stiffen the contacts"
    checks = (Check("rod_error", worst, model.spec.limits.rod_error, "<=", "m", message, ("rod",), label="Maximum rod error"),)
    return Answer(values, (contact_table(run, model.pair.start),), checks)


def clearance_study(model: PusherModel, done: Answers) -> Answer:
    """Peak force and rod error over clearance at the given speed, and over speed without clearance."""
    plays, speeds = np.linspace(0, WIDEST, 5), model.spec.drive.speed * np.array([0.5, 1.0, 1.5])
    rows = [(play, model.spec.drive.speed) for play in plays] + [(0.0, speed) for speed in speeds]
    loose = runs_with_play(model, WIDEST)
    runs = [loose[0] if play == WIDEST else simulate(model, play, speed) for play, speed in rows]
    tight, many = runs[0].peak_force, f"with {1e3 * WIDEST:g} mm of clearance at each roller"
    ratio = "Peak force ratio due to clearance"
    forces, separations = (np.array([getattr(run, name) for run in loose]) for name in ("peak_force", "separation"))
    values = {
        "clearance.peak_force.tight": Value(tight, "N", "maximum normal force without clearance"),
        "clearance.peak_force": _mean(forces, "N", f"mean maximum normal force {many}", "Maximum normal force with clearance"),
        "clearance.force_ratio": _mean(forces / tight, "-", f"mean maximum normal force {many} over that without", ratio),
        "clearance.separation": _mean(separations, "-", f"mean {FREE}, {many}", "Fraction without contact, with clearance"),
    }
    message = f"mean maximum normal force {many} over that without; impacts shorten the life of rollers and cams: reduce the clearance"
    limit = model.spec.limits.play_force_ratio
    checks = (Check.of(values["clearance.force_ratio"], "play", limit, "<=", message, ("rollers",), label=ratio),)
    columns = (
        Column("clearance", "m", "normal clearance of each roller", np.array([play for play, _ in rows])),
        Column("speed", "rad/s", "carrier speed", np.array([speed for _, speed in rows])),
        Column("peak_force", "N", PEAK, np.array([run.peak_force for run in runs]), "Peak contact force"),
        Column("separation", "-", FREE, np.array([run.separation for run in runs]), "Fraction of the turn without contact"),
        Column("rod_error", "m", ERROR, np.array([run.max_deviation for run in runs]), "Maximum rod error"),
    )
    by_play = Table("play", "Contact by clearance", tuple(column._replace(data=column.data[: len(plays)]) for column in columns))
    return Answer(values, (Table("clearance", "Contact by clearance and speed", columns), by_play), checks)


def runs_with_play(model: PusherModel, play: float) -> list[LeverRun]:
    """Runs whose clearance [m] differs by a negligible amount: impacts are chaotic.  The first has the clearance itself."""
    return [simulate(model, play * (1 + 1e-6 * number)) for number in range(ENSEMBLE)]


def _mean(numbers: Floats, unit: str, meaning: str, label: str) -> Value:
    """Mean of runs that share nothing, with its 95 % interval."""
    mean, half = mean_of_members(numbers)
    return Value(float(mean), unit, meaning, float(mean - half), float(mean + half), "ensemble", label=label).plain()


def poincare(model: PusherModel, done: Answers) -> Answer:
    """Deviation of the rod from its programme, and its rate, once a turn of the carrier, at the start of the push."""
    system = lever_system(model)
    # Finer than the contact run: visits are compared with each other.
    run = simulate_turns(
        system, TURNS, system.period * np.arange(TURNS + 1, dtype=float), rtol=1e-10, atol=(1e-13, 1e-10), max_steps=5_000_000
    )
    if len(run.t) <= DISCARD:
        raise SolverError(f"the contact simulation ends before turn {DISCARD}, at t = {run.t_end:.6g} s: {run.advice}")
    start, turn = (model.pair.swing(model.pair.start + angle) for angle in (np.array([0.0]), np.linspace(0.0, TURN, 721)))
    ahead, ahead_rate = run.y.T
    error = mass_deviation(system.arm, start.d0, ahead)
    rate = mass_deviation_rate(system.arm, start.d0, start.d1 * system.speed, ahead, ahead_rate)
    spans = np.array([np.ptp(system.arm * np.tan(turn.d0)), np.ptp(system.arm * turn.d1 * system.speed / np.cos(turn.d0) ** 2)])
    return section_answer("rod", Section(run.t, error, rate), system.period, spans, DISCARD * system.period, "the start of the push", STILL)
