"""The lever between its two cams, with play: contact, flight and impact in one degree of freedom.

Coordinate: delta, how far the lever's swing is ahead of its programme.  The gap of each roller is linear in delta,
leverage times delta plus play, which is exact to second order in delta (0.1 mm of play: 1 um).
"""

from typing import NamedTuple

import numpy as np

from drivewright import curves
from drivewright._jit import implements, kernel, warmer
from drivewright._typing import Floats
from drivewright.contact import KelvinVoigt, normal_force
from drivewright.errors import SolverError
from drivewright.mechanisms.seedling_pusher.build import TURN, PusherModel
from drivewright.numerics.jets import cos
from drivewright.numerics.ode import Trajectory, integrate, rate
from drivewright.result import Answer, Answers, Check, Column, Table, Value
from drivewright.stops import Stop, note_stop

GRID = 4096
SAMPLES = 7201


class LeverBetweenCams(NamedTuple):
    """Tables over the carrier angle from `start`, one turn in GRID steps: (quantity, point, value or slope).

    Quantities: swing, its first and second derivative, leverage of main and return roller [m], gap of both to the real profile [m].
    """

    law: KelvinVoigt
    tables: Floats  # (7, points, 2)
    start: float
    speed: float
    arm: float
    mass: float
    push_force: float
    rise: float
    clearance: float


@kernel
def look_up(tables: Floats, quantity: int, place: float) -> tuple[float, float]:
    """(value, slope) of one quantity of the tables (quantities, points, 2) by cubic Hermite interpolation at place = angle / step."""
    n = tables.shape[1] - 1
    k = min(int(place), n - 1)
    x = place - k
    left, right = tables[quantity, k], tables[quantity, k + 1]
    rise, a, b = right[0] - left[0], left[1], right[1]
    c, d = 3 * rise - 2 * a - b, a + b - 2 * rise
    return left[0] + x * (a + x * (c + x * d)), a + x * (2 * c + x * 3 * d)


@kernel
def forces(system: LeverBetweenCams, angle: float, delta: float, delta_rate: float) -> tuple[float, float]:
    """(main, return) normal forces [N] at a carrier angle [rad] since the start of the push; delta [rad]: lever off its programme."""
    n = system.tables.shape[1] - 1
    place = (angle % (2 * np.pi)) / (2 * np.pi) * n
    per_second = system.speed / (2 * np.pi) * n
    lever_1, slope_1 = look_up(system.tables, 3, place)
    lever_2, slope_2 = look_up(system.tables, 4, place)
    lost_1, lost_rate_1 = look_up(system.tables, 5, place)
    lost_2, lost_rate_2 = look_up(system.tables, 6, place)
    gap_1 = lever_1 * delta + system.clearance + lost_1
    gap_2 = -lever_2 * delta + system.clearance + lost_2
    rate_1 = lever_1 * delta_rate + (slope_1 * delta + lost_rate_1) * per_second
    rate_2 = -lever_2 * delta_rate + (-slope_2 * delta + lost_rate_2) * per_second
    return normal_force(system.law, gap_1, rate_1), normal_force(system.law, gap_2, rate_2)


@implements(rate, LeverBetweenCams)
def _(system, t, y, dy):
    """m g'^2 phi'' + m g' g'' phi'^2 = N1 lambda1 - N2 lambda2 - F g',  g = l tan(phi), phi = programme + delta."""
    angle = system.speed * t
    n = system.tables.shape[1] - 1
    place = (angle % (2 * np.pi)) / (2 * np.pi) * n
    swing, _ = look_up(system.tables, 0, place)
    swing_1, _ = look_up(system.tables, 1, place)
    swing_2, _ = look_up(system.tables, 2, place)
    phi, phi_rate = swing + y[0], swing_1 * system.speed + y[1]
    main, back = forces(system, angle, y[0], y[1])
    lever_1, _ = look_up(system.tables, 3, place)
    lever_2, _ = look_up(system.tables, 4, place)
    first = system.arm / np.cos(phi) ** 2
    second = 2 * first * np.tan(phi)
    resistance = system.push_force if angle % (2 * np.pi) < system.rise else 0.0
    moment = main * lever_1 - back * lever_2 - resistance * first
    acceleration = (moment / (system.mass * first) - second * phi_rate**2) / first
    dy[0] = y[1]
    dy[1] = acceleration - swing_2 * system.speed**2


@warmer
def warm_lever() -> None:
    """Compile for `doctor --warm`: a lever at rest between two cams of unit leverage."""
    tables = np.zeros((7, 3, 2))
    tables[3:5, :, 0] = 1.0
    system = LeverBetweenCams(KelvinVoigt(1.0, 1.0), tables, 0.0, 1.0, 1.0, 1.0, 0.0, 1.0, 0.0)
    integrate(system, 0.0, 1.0, [0.0, 0.0])
    forces(system, 0.0, 0.0, 0.0)


def lever_system(model: PusherModel, clearance: float | None = None, speed: float | None = None) -> LeverBetweenCams:
    """The `LeverBetweenCams` of a model, for another play or speed where given."""
    spec = model.spec
    return LeverBetweenCams(
        KelvinVoigt(spec.contact.stiffness, spec.contact.damping),
        _tables(model),
        model.push_start,
        float(speed or spec.drive.speed),
        spec.lever.output_arm,
        spec.load.mass,
        spec.load.push_force,
        spec.push.rise,
        float(spec.contact.clearance if clearance is None else clearance),
    )


def _tables(model):
    """Values and slopes per grid step of all seven quantities."""
    t = model.push_start + np.linspace(0, TURN, GRID + 1)
    step = TURN / GRID
    swing = model.swing(t)
    rows = [(swing.d0, swing.d1), (swing.d1, swing.d2), (swing.d2, swing.d3)]
    for cam in model.cams:
        leverage = cam.arm * cos(model.pressure_angle(cam, t))
        rows.append((leverage.d0, leverage.d1))
    for cam in model.cams:
        gap = curves.profile_gap(model.trimmed[cam.name], t)
        rows.append((gap, np.gradient(gap, step)))  # the gap has a kink where the cam is undercut; no exact slope exists there
    return np.array([np.stack([value, slope * step], axis=1) for value, slope in rows])


def simulate(model: PusherModel, system: LeverBetweenCams) -> tuple[Floats, Floats, Floats, Floats, Trajectory]:
    """(carrier angle [rad], main force [N], return force [N], rod error [m], trajectory) of the last turn of a run."""
    period, turns = TURN / system.speed, model.spec.contact.turns
    times = (turns - 1) * period + np.linspace(0, period, SAMPLES)
    run = integrate(
        system,
        0.0,
        turns * period * (1 + 1e-12),
        [0.0, 0.0],
        rtol=1e-7,
        atol=[1e-10, 1e-7],
        samples=times,
        max_step=period / 2000,
        max_steps=2_000_000,
    )
    if run.advice:
        note_stop(Stop(f"the contact simulation ends at t = {run.t_end:.6g} s of {turns * period:.6g} s", run.advice))
    if len(run.t) < 2:
        raise SolverError(f"the contact simulation ends before its last turn, at t = {run.t_end:.6g} s: {run.advice}")
    delta, delta_rate = run.y.T
    angle = np.linspace(0, TURN, SAMPLES)[: len(delta)]
    normal = np.array([forces(system, a, d, v) for a, d, v in zip(angle, delta, delta_rate, strict=True)])
    swing = model.swing(model.push_start + angle).d0
    error = system.arm * (np.tan(swing + delta) - np.tan(swing))
    return angle, normal[:, 0], normal[:, 1], error, run


def contact(model: PusherModel, done: Answers) -> Answer:
    """Contact forces, separation and rod error in the last simulated turn."""
    system = lever_system(model)
    angle, main, back, error, _ = simulate(model, system)
    table = Table(
        "contact",
        "Contact over the last simulated turn",
        (
            Column("carrier_angle", "rad", "turn of the carrier", model.push_start + angle),
            Column("main.force", "N", "normal force on the main cam", main),
            Column("return.force", "N", "normal force on the return cam", back),
            Column("rod_error", "m", "rod ahead of its programme", error),
        ),
    )
    worst = float(np.max(np.abs(error)))
    values = {
        "contact.peak_force": Value(float(max(main.max(), back.max())), "N", "largest normal force in the last turn"),
        "contact.main.peak_force": Value(float(main.max()), "N", "largest normal force on the main cam"),
        "contact.return.peak_force": Value(float(back.max()), "N", "largest normal force on the return cam"),
        "contact.separation": Value(float(np.mean((main <= 0) & (back <= 0))), "-", "share of the turn in which neither roller touches"),
        "contact.rod_error.max": Value(worst, "m", "largest deviation of the rod from its programme"),
    }
    checks = (Check("rod_error", worst, model.spec.limits.rod_error, "<=", "m", "the rod follows its programme", ("rod",)),)
    return Answer(values, (table,), checks)


def clearance_study(model: PusherModel, done: Answers) -> Answer:
    """Peak force and rod error over play at the given speed, and over speed without play."""
    plays, speeds = np.linspace(0, 0.1e-3, 5), model.spec.drive.speed * np.array([0.5, 1.0, 1.5])
    rows = [(play, model.spec.drive.speed) for play in plays] + [(0.0, speed) for speed in speeds]
    found = [simulate(model, lever_system(model, play, speed)) for play, speed in rows]
    table = Table(
        "clearance",
        "Play and speed",
        (
            Column("clearance", "m", "normal play of each roller", np.array([r[0] for r in rows])),
            Column("speed", "rad/s", "carrier speed", np.array([r[1] for r in rows])),
            Column("peak_force", "N", "largest normal force in the last turn", np.array([max(f[1].max(), f[2].max()) for f in found])),
            Column(
                "separation",
                "-",
                "share of the turn in which neither roller touches",
                np.array([np.mean((f[1] <= 0) & (f[2] <= 0)) for f in found]),
            ),
            Column("rod_error", "m", "largest deviation of the rod", np.array([np.max(np.abs(f[3])) for f in found])),
        ),
    )
    return Answer(tables=(table,))
