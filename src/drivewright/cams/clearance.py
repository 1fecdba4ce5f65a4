"""A lever between two conjugate cams, with clearance: contact, flight and impact in one degree of freedom.

Coordinate: delta, how far the lever's swing phi is ahead of its programme.  The gap of each roller is linear in delta, leverage
times delta plus clearance, which is exact to second order in delta (0.1 mm of clearance: 1 um).
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from drivewright._jit import by_reference, implements, kernel, warmer
from drivewright._typing import Floats
from drivewright.contact import KelvinVoigt, normal_force
from drivewright.errors import SolverError
from drivewright.numerics.jets import Jet
from drivewright.numerics.ode import Trajectory, integrate, rate
from drivewright.stops import Stop, note_stop

STEPS_A_TURN = 200_000  # at most: fifteen times what two cams with play usually take


@by_reference
class LeverBetweenCams(NamedTuple):
    """A lever with two rollers between a main cam, which swings it out, and a return cam; it drives a mass on a straight path.

    tables (7, points, 2): value and slope per grid step over one turn of the driving angle [rad] of the swing [rad], its first and
    second derivative, the leverage of main and return roller [m], and their gaps to the real profiles [m].
    """

    law: KelvinVoigt  # of each roller on its cam
    tables: Floats
    speed: float  # rad/s, of the drive
    arm: float  # m, from the pivot to the line of the mass, whose travel is arm * tan(phi)
    mass: float  # kg
    resistance: float  # N, against the mass over `resisted_angle`
    resisted_angle: float  # rad, of the driving angle from 0
    clearance: float  # m, of each roller

    @property
    def period(self) -> float:
        """Duration of one turn [s]."""
        return 2 * np.pi / self.speed


class LeverRun(NamedTuple):
    """The last turn of a run: driving angle (m,) [rad], force of main and return roller (m,) [N], mass ahead of its programme (m,) [m]."""

    angle: Floats
    main: Floats
    back: Floats
    deviation: Floats
    trajectory: Trajectory

    @property
    def separation(self) -> float:
        """Share of the turn in which neither roller touches."""
        return float(np.mean((self.main <= 0) & (self.back <= 0)))

    @property
    def peak_force(self) -> float:
        """Largest normal force [N]."""
        return float(max(self.main.max(), self.back.max()))

    @property
    def max_deviation(self) -> float:
        """Largest deviation of the mass from its programme, magnitude [m]."""
        return float(np.max(np.abs(self.deviation)))


def sample_tables(swing: Jet, leverages: Sequence[Jet], gaps: Sequence[Floats]) -> Floats:
    """The `LeverBetweenCams.tables` of jets and gaps at equidistant driving angles over one turn, both ends included."""
    step = 2 * np.pi / (len(swing.d0) - 1)
    rows = [(swing.d0, swing.d1), (swing.d1, swing.d2), (swing.d2, swing.d3)]
    rows += [(leverage.d0, leverage.d1) for leverage in leverages]
    rows += [(gap, np.gradient(gap, step)) for gap in gaps]  # a gap has a kink where the cam is undercut; no exact slope exists there
    return np.array([np.stack([value, slope * step], axis=1) for value, slope in rows])


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
def roller_forces(system: LeverBetweenCams, angle: float, delta: float, delta_rate: float) -> tuple[float, float]:
    """(main, return) normal forces [N] at a driving angle [rad]; delta [rad], delta_rate [rad/s]: lever ahead of its programme."""
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
    """m g'^2 phi'' + m g' g'' phi'^2 = N1 lambda1 - N2 lambda2 - F g',  g = l tan(phi), phi = programme + delta.

    t [s]; y (2,) = (delta [rad], its rate [rad/s]); dy (2,) [rad/s, rad/s^2].
    """
    angle = system.speed * t
    n = system.tables.shape[1] - 1
    place = (angle % (2 * np.pi)) / (2 * np.pi) * n
    swing, _ = look_up(system.tables, 0, place)
    swing_1, _ = look_up(system.tables, 1, place)
    swing_2, _ = look_up(system.tables, 2, place)
    phi, phi_rate = swing + y[0], swing_1 * system.speed + y[1]
    main, back = roller_forces(system, angle, y[0], y[1])
    lever_1, _ = look_up(system.tables, 3, place)
    lever_2, _ = look_up(system.tables, 4, place)
    first = system.arm / np.cos(phi) ** 2
    second = 2 * first * np.tan(phi)
    resistance = system.resistance if angle % (2 * np.pi) < system.resisted_angle else 0.0
    moment = main * lever_1 - back * lever_2 - resistance * first
    acceleration = (moment / (system.mass * first) - second * phi_rate**2) / first
    dy[0] = y[1]
    dy[1] = acceleration - swing_2 * system.speed**2


@warmer
def warm_lever() -> None:
    """Compile for `doctor --warm`: a lever at rest between two cams of unit leverage."""
    tables = np.zeros((7, 3, 2))
    tables[3:5, :, 0] = 1.0
    system = LeverBetweenCams(KelvinVoigt(1.0, 1.0), tables, 1.0, 1.0, 1.0, 0.0, 1.0, 0.0)
    integrate(system, 0.0, 1.0, [0.0, 0.0])
    roller_forces(system, 0.0, 0.0, 0.0)


def simulate_turns(
    system: LeverBetweenCams, turns: int, samples: Floats, rtol: float, atol: tuple[float, float], max_steps: int
) -> Trajectory:
    """The motion (delta [rad], its rate [rad/s]) over some turns from rest on the programme, at the times `samples` [s].

    rtol and atol (of both) limit the error per step; a run that ends early for `max_steps` notes why.
    """
    duration = turns * system.period
    run = integrate(
        system,
        0.0,
        duration * (1 + 1e-12),
        [0.0, 0.0],
        rtol=rtol,
        atol=list(atol),
        samples=samples,
        max_step=system.period / 2000,
        max_steps=max_steps,
    )
    if run.advice:
        note_stop(Stop(f"the contact simulation ends at t = {run.t_end:.6g} s of {duration:.6g} s", run.advice))
    return run


def mass_deviation(arm: float, swing: Floats, ahead: Floats) -> Floats:
    """Deviation of the mass [m] from its programme g = l tan(phi) where the lever is `ahead` [rad] of its swing phi [rad]; arm l [m]."""
    return arm * (np.tan(swing + ahead) - np.tan(swing))


def mass_deviation_rate(arm: float, swing: Floats, swing_rate: Floats, ahead: Floats, ahead_rate: Floats) -> Floats:
    """Rate [m/s] of `mass_deviation`, from the rates of swing and lead [rad/s]: g' = l phi'/cos^2(phi)."""
    return arm * ((swing_rate + ahead_rate) / np.cos(swing + ahead) ** 2 - swing_rate / np.cos(swing) ** 2)


def simulate_last_turn(system: LeverBetweenCams, turns: int, swing: Callable[[Floats], Floats], samples: int = 7201) -> LeverRun:
    """The last of some turns from rest, at `samples` equidistant driving angles; `swing`: programme [rad] over the driving angle [rad].

    Raises SolverError where the run ends before its last turn.
    """
    times = (turns - 1) * system.period + np.linspace(0, system.period, samples)
    run = simulate_turns(system, turns, times, rtol=1e-7, atol=(1e-10, 1e-7), max_steps=STEPS_A_TURN * turns)
    if len(run.t) < 2:
        raise SolverError(f"the contact simulation ends before its last turn, at t = {run.t_end:.6g} s: {run.advice}")
    delta, delta_rate = run.y.T
    angle = np.linspace(0, 2 * np.pi, samples)[: len(delta)]
    normal = np.array([roller_forces(system, a, d, v) for a, d, v in zip(angle, delta, delta_rate, strict=True)])
    return LeverRun(angle, normal[:, 0], normal[:, 1], mass_deviation(system.arm, swing(angle), delta), run)
