"""Surge of a spring as an elastic rod: closed forms, d'Alembert's waves, the modes carried in time, and a chain of many masses in scipy."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicHermiteSpline

from drivewright import cams
from drivewright.cams.spring_surge import COARSE, harmonics_of
from drivewright.motion import Programme, Segment
from drivewright.numerics.jets import variable

K, M, ZETA, SPEED = 30e3, 0.06, 0.02, 300.0
SPRING = cams.SurgingSpring(K, M, ZETA)
TURN = 2 * np.pi


def programme(law):
    return Programme((Segment(1.1, law, 9e-3), Segment(1.2, law, -9e-3), Segment(TURN - 2.3, "dwell")))


def surge_of(motion, spring=SPRING, speed=SPEED, samples=8192):
    return cams.PeriodicSurge(spring, cams.lift_harmonics(motion, samples), speed)


@pytest.mark.analytical
def test_without_damping_the_dynamic_stiffness_is_that_of_a_rod():
    """F/y = k b cot b, b = w sqrt(m/k): zero at the odd quarter waves, infinite at the natural frequencies."""
    loose = cams.SurgingSpring(K, M, 1e-12)
    w = np.array([10.0, 700.0, 1500.0, 3000.0, 9000.0, 23456.0])
    b = w * np.sqrt(M / K)
    assert 1 + loose.surge_factor(w) == pytest.approx(b / np.tan(b), rel=1e-8)
    quarter = 0.5 * np.pi / np.sqrt(M / K)
    assert abs(1 + loose.surge_factor(quarter)[0]) < 1e-9
    assert loose.frequency == pytest.approx(2 * quarter)


@pytest.mark.analytical
def test_damped_sum_of_modes():
    """The closed form against many terms of the sum and the rest of it as mass."""
    x, n = np.array([0.3, 0.97, 1.0, 2.5, 7.2]), np.arange(1, 200001)
    terms = [np.sum(each**2 / (n**2 + 2j * ZETA * each * n - each**2)) + each**2 / n[-1] for each in x]
    assert SPRING.surge_factor(x * SPRING.frequency) == pytest.approx(-2 * np.array(terms), rel=1e-6)
    assert SPRING.surge_factor(0.0)[0] == 0


@pytest.mark.property
def test_slow_motion_feels_a_third_of_the_mass():
    """Surge force -> m/3 y'' in the fourth order of the frequency: a tenth of it leaves a hundredth of the departure."""

    def departure(w):
        return abs(K * SPRING.surge_factor(w)[0].real / (-(w**2) * M / 3) - 1)

    assert departure(20.0) / departure(2.0) == pytest.approx(100, rel=0.02) and departure(2.0) < 1e-6


@pytest.mark.analytical
def test_waves_of_dalembert():
    """u = g(t + x/c) - g(t - x/c) solves the rod: its end moves as g(t + tau) - g(t - tau) under sqrt(k m) (g'(t + tau) + g'(t - tau))."""
    tau, orders, sizes = np.sqrt(M / K), np.array([1, 3, 7, 12]), np.array([4e-3, -1e-3, 5e-4, 2e-4])

    def waves(time, derivative):
        phase = np.multiply.outer(time * SPEED, orders)
        return (sizes * np.sin(phase)).sum(-1) if not derivative else (sizes * orders * SPEED * np.cos(phase)).sum(-1)

    def end(angle):
        return waves(angle / SPEED + tau, 0) - waves(angle / SPEED - tau, 0)

    angle = np.linspace(0, TURN, 37)
    force = np.sqrt(K * M) * (waves(angle / SPEED + tau, 1) + waves(angle / SPEED - tau, 1))
    surge = surge_of(end, cams.SurgingSpring(K, M, 1e-10))
    assert K * end(angle) + surge.force(variable(angle)).d0 == pytest.approx(force, abs=1e-6 * np.max(np.abs(force)))


@pytest.mark.analytical
@pytest.mark.parametrize(("law", "tolerance"), [("cycloidal", 1e-4), ("polynomial-4567", 2e-5), ("parabolic", 0.02)])
def test_modes_carried_in_time_give_the_same(law, tolerance):
    """Each mode is one mass on a spring, carried exactly over the pieces of the motion; the modes left out act as mass."""
    cycle, modes = cams.Cycle(programme(law).function), 40
    angle = np.linspace(0.01, TURN - 0.01, 301)
    force = np.zeros_like(angle)
    for n in range(1, modes + 1):
        response = cams.periodic_response(cycle, 1.0, SPEED, n * SPRING.frequency, ZETA)
        places = np.flatnonzero(np.diff(response.angle, prepend=-1) > 0)
        error, rate = (part[places] for part in (response.error.d0, response.error.d1))
        force -= 2 * K * CubicHermiteSpline(response.angle[places], error, rate / SPEED)(angle)
    left = np.pi**2 / 6 - np.sum(1 / np.arange(1, modes + 1) ** 2)
    force += 2 * K * left * SPEED**2 / SPRING.frequency**2 * cycle.at_angle(angle)[1].d2
    surge = surge_of(lambda theta: cycle.at_angle(theta)[1].d0)
    ours = surge.force(variable(angle)).d0
    assert ours == pytest.approx(force, abs=tolerance * np.max(np.abs(force)))


@pytest.mark.analytical
def test_a_chain_of_many_masses():
    """The spring as 60 masses between 61 springs, integrated by scipy until it repeats itself; modes damped alike."""
    count, motion = 60, programme("cycloidal")
    stiff = K * (count + 1)
    beads = M / (count + 1)
    matrix = stiff / beads * (2 * np.eye(count) - np.eye(count, k=1) - np.eye(count, k=-1))
    squares, shapes = np.linalg.eigh(matrix)
    damping = shapes @ np.diag(2 * 0.05 * np.sqrt(squares)) @ shapes.T
    line = np.arange(1, count + 1) / (count + 1)

    def rates(time, state):
        s = motion(SPEED * time % TURN)
        place, velocity = state[:count], state[count:]
        push = -matrix @ place - damping @ (velocity - line * s.v * SPEED)
        push[-1] += stiff / beads * s.s
        return np.concatenate([velocity, push])

    turns, angle = 9, np.linspace(0, TURN, 200)
    times = (TURN * (turns - 1) + angle) / SPEED
    found = solve_ivp(rates, (0, times[-1]), np.zeros(2 * count), t_eval=times, rtol=1e-6, atol=1e-9, max_step=TURN / SPEED / 200)
    # The end bead's half of a step belongs to the driven end.
    s = motion(angle)
    force = stiff * (s.s - found.y[count - 1]) + 0.5 * beads * s.a * SPEED**2
    ours = surge_of(lambda theta: motion(theta).s, cams.SurgingSpring(K, M, 0.05)).force(variable(angle)).d0
    assert ours == pytest.approx(force - K * s.s, abs=0.01 * np.max(np.abs(ours)))


@pytest.mark.property
def test_force_of_surge_between_the_samples_and_its_slope():
    surge = surge_of(lambda theta: programme("polynomial-4567")(theta).s, samples=COARSE)
    angle, step = np.linspace(-1.0, 8.0, 57), 1e-5
    force = surge.force(variable(angle))
    assert force.d0 == pytest.approx(surge.harmonics.at(angle).d0, abs=1e-4 * np.max(np.abs(force.d0)))
    sides = [surge.harmonics.at(angle + k * step).d0 for k in (-1, 1)]
    assert force.d1 == pytest.approx((sides[1] - sides[0]) / (2 * step), abs=2e-3 * np.max(np.abs(force.d1)))


@pytest.mark.property
def test_harmonics_of_a_known_sum():
    angle = TURN * np.arange(256) / 256
    found = harmonics_of(3 + 2 * np.cos(angle) - 0.5 * np.sin(5 * angle), 32)
    expected = np.zeros(32, complex)
    expected[[0, 1, 5]] = 3, 2, 0.5j
    assert found.amplitude == pytest.approx(expected, abs=1e-13)
    assert found.at(np.array([0.4])).d1[0] == pytest.approx(-2 * np.sin(0.4) - 2.5 * np.cos(2.0))


@pytest.mark.property
def test_the_nearest_harmonic():
    surge = surge_of(lambda theta: programme("cycloidal")(theta).s, speed=SPRING.frequency / 7.2)
    harmonic, ratio = surge.nearest_harmonic()
    assert harmonic == 7 and ratio == pytest.approx(7 / 7.2)


@pytest.mark.property
def test_rescaled_in_mass_and_time():
    """k and m tenfold: ten times the force; k a hundredfold with the speed tenfold: a hundredfold."""
    motion, angle = (lambda theta: programme("cycloidal")(theta).s), variable(np.linspace(0, 6, 31))
    force = surge_of(motion).force(angle).d0
    assert surge_of(motion, cams.SurgingSpring(10 * K, 10 * M, ZETA)).force(angle).d0 == pytest.approx(10 * force, rel=1e-9)
    assert surge_of(motion, cams.SurgingSpring(100 * K, M, ZETA), 10 * SPEED).force(angle).d0 == pytest.approx(100 * force, rel=1e-9)


@pytest.mark.property
@pytest.mark.parametrize("damping", [0.1, 0.01, 0.002])
def test_a_narrow_resonance_that_opens_the_contact_is_found(damping):
    """The contact opens in a resonance as narrow as the damping makes it, and again far above: the first is the jump."""

    def least(speed):
        return cams.Extreme(1.0 if abs(speed / 200 - 1) > damping and speed < 380 else -1.0, 0.7, 0)

    found = cams.jump_with_surge(least, least, 40.0, 400.0, damping)
    assert found.speed == pytest.approx(200 * (1 - damping), rel=1e-6) and found.angle == 0.7
    assert cams.jump_with_surge(lambda _: cams.Extreme(1.0, 0.0, 0), least, 40.0, 400.0, damping).speed == np.inf
