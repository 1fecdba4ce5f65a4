"""A chain at speed, by second routes: joints followed, masses on a circle, links struck, a moving string by collocation."""

import numpy as np
import pytest
from scipy.linalg import eig
from scipy.optimize import minimize_scalar

from drivewright.chains import standards as s

pytestmark = pytest.mark.analytical

P, W, Q = 12.7e-3, 61.0, 0.7  # pitch, angular speed, mass per length
STEP = 1e-7


def test_speed_along_the_strand_is_that_of_the_last_seated_joint():
    teeth = 13
    radius, t = 0.5 * P / np.sin(np.pi / teeth), np.pi / teeth
    angle = np.linspace(-t, t, 20001)  # from the top of the circle, one joint's stay as the last one seated
    speed = np.gradient(radius * np.sin(angle), angle[1] - angle[0], edge_order=2) * W
    assert s.speed_range(P, teeth, W) == pytest.approx((speed.min(), speed.max()), rel=1e-7)
    assert s.chain_speed(P, teeth, W) == pytest.approx(np.trapezoid(speed, angle) / (2 * t), rel=1e-7)
    assert s.speed_fluctuation(teeth) == pytest.approx((speed.max() - speed.min()) / s.chain_speed(P, teeth, W), rel=1e-5)
    assert s.mesh_frequency(teeth, W) * P == pytest.approx(s.chain_speed(P, teeth, W), rel=1e-14)
    assert s.speed_fluctuation(1000) == pytest.approx(np.pi**2 / 2e6, rel=1e-5)


def test_centrifugal_tension_holds_the_joints_on_their_circle():
    teeth = 11
    radius = 0.5 * s.pitch_diameter(P, teeth)
    outward = Q * P * W**2 * radius  # of a joint with the mass of a link
    assert 2 * s.centrifugal_tension(Q, W * radius) * np.sin(np.pi / teeth) == pytest.approx(outward, rel=1e-13)


def test_tension_carries_the_power():
    speed, slack = 9.0, 120.0
    tension = s.strand_tension(4500.0, speed, Q, slack)
    assert (tension - s.strand_tension(0.0, speed, Q, slack)) * speed == pytest.approx(4500.0, rel=1e-12)
    assert s.strand_tension(0.0, speed, Q, slack) == pytest.approx(slack + Q * speed**2, rel=1e-14)
    assert s.tensile_safety(22200.0, tension) * tension == pytest.approx(22200.0, rel=1e-14)


def test_greatest_power():
    allowed, slack = 2000.0, 150.0
    found = minimize_scalar(lambda v: -v * (allowed - slack - Q * v**2), bounds=(1.0, 50.0), method="bounded", options={"xatol": 1e-9})
    speed, power = s.max_power(allowed, Q, slack)
    assert speed == pytest.approx(found.x, rel=1e-6)
    assert power == pytest.approx(-found.fun, rel=1e-12)
    assert s.strand_tension(power, speed, Q, slack) == pytest.approx(allowed, rel=1e-13)


def test_joint_pressure_adds_up_to_the_force():
    pressure = s.articulation_pressure(900.0, 3.6e-3, 11e-3, strands=2)
    angle, weight = np.polynomial.legendre.leggauss(20)
    across = np.sum(weight * 0.5 * np.pi * pressure * np.cos(0.5 * np.pi * angle)) * 1.8e-3 * 11e-3
    assert 2 * across == pytest.approx(900.0, rel=1e-12)


@pytest.mark.parametrize("normal_angle", [0.5 * np.pi, 1.1])
def test_meeting_velocity_of_a_strand_drawn_from_afar(normal_angle):
    teeth, far = 9, 1e5 * P
    t, radius = np.pi / teeth, 0.5 * P / np.sin(np.pi / teeth)

    def joint(time):
        """The next joint, a pitch behind the seated one on the line to a far point, seen from the turning sprocket."""
        seated = radius * np.array([np.sin(t + W * time), np.cos(t + W * time)])  # clockwise, t past the top
        along = np.array([-far, radius * np.cos(t)]) - seated
        place = seated + P * along / np.hypot(*along)
        turn = np.exp(1j * W * time) * (place[0] + 1j * place[1])
        return np.array([turn.real, turn.imag])

    assert joint(0.0) == pytest.approx(radius * np.array([-np.sin(t), np.cos(t)]), abs=1e-12 * P)  # it is at its seat
    velocity = (joint(STEP) - joint(-STEP)) / (2 * STEP)
    normal = np.array([np.cos(normal_angle), np.sin(normal_angle)])
    assert s.meeting_velocity(P, -W, normal_angle) == pytest.approx(abs(velocity @ normal), rel=1e-4)


@pytest.mark.parametrize("normal_angle", [0.5 * np.pi, 0.8])
def test_meeting_energy_of_rigid_links_struck_at_the_joint(normal_angle):
    """Impulses of hinges and seat on n rigid links, each with its own x, y and turn; the first hinge stands on the sprocket."""
    links, mass = 24, Q * P
    inverse = np.diag(np.tile([1 / mass, 1 / mass, 12 / (mass * P**2)], links))

    def end(link, side):
        """Rows that give the velocity of a link's end from the velocities of all links."""
        rows = np.zeros((2, 3 * links))
        rows[:, 3 * link : 3 * link + 3] = [[1, 0, 0], [0, 1, side * 0.5 * P]]
        return rows

    hinges = [end(0, -1)] + [end(i, 1) - end(i + 1, -1) for i in range(links - 1)]
    normal = np.array([np.cos(normal_angle), np.sin(normal_angle)])
    rows = np.vstack([*hinges, normal @ end(0, 1)])
    # seen from the frame of the seated joint that turns with the sprocket: every link turns by W about the first hinge
    before = np.zeros(3 * links)
    before[1::3], before[2::3] = W * P * (np.arange(links) + 0.5), W
    # only changes count: the seat stops the joint, the hinges hold
    jump = np.zeros(len(rows))
    jump[-1] = -rows[-1] @ before
    impulses = np.linalg.solve(rows @ inverse @ rows.T, jump)
    change = inverse @ rows.T @ impulses
    lost = 0.5 * impulses[-1] * jump[-1]  # impulse times the mean of the relative velocity
    assert 0.5 * change @ np.linalg.solve(inverse, change) == pytest.approx(lost, rel=1e-9)
    assert s.meeting_energy(P, Q, W) == pytest.approx(lost, rel=1e-9)


def collocated_frequencies(tension, speed, length, points=28):
    """Frequencies [Hz] of w_tt + 2 v w_xt + (v^2 - c^2) w_xx = 0 with fixed ends, on Chebyshev points."""
    x = np.cos(np.pi * np.arange(points + 1) / points)
    weight = np.where(np.isin(np.arange(points + 1), (0, points)), 2.0, 1.0) * (-1.0) ** np.arange(points + 1)
    slope = np.outer(weight, 1 / weight) / (x[:, None] - x[None] + np.eye(points + 1))
    slope -= np.diag(slope.sum(axis=1))
    first, second = (matrix[1:-1, 1:-1] * (2 / length) ** power for power, matrix in ((1, slope), (2, slope @ slope)))
    unit, none = np.eye(points - 1), np.zeros((points - 1, points - 1))
    values = eig(np.block([[none, unit], [(tension / Q - speed**2) * second, -2 * speed * first]]), right=False)
    found = np.abs(values.imag[values.imag > 1e-6]) / (2 * np.pi)
    return np.sort(found)


def test_frequencies_of_a_running_strand():
    tension, speed, length = 800.0, 14.0, 0.43
    found = collocated_frequencies(tension, speed, length)
    ours = [s.strand_frequency(tension, Q, length, speed, mode) for mode in (1, 2, 3)]
    assert ours == pytest.approx(found[:3], rel=1e-6)
    assert s.strand_frequency(tension, Q, length) == pytest.approx(np.sqrt(tension / Q) / (2 * length), rel=1e-14)


@pytest.mark.parametrize(("mode", "harmonic"), [(1, 1), (3, 1), (2, 5)])
def test_resonance_is_where_meshing_and_strand_agree(mode, harmonic):
    pull, length = np.array([3.0, 700.0]), 0.43
    speed = s.resonance_speed(pull, Q, length, P, mode, harmonic)
    whole = pull + s.centrifugal_tension(Q, speed)
    assert harmonic * speed / P == pytest.approx(s.strand_frequency(whole, Q, length, speed, mode), rel=1e-12)


def test_the_pure_numbers_do_not_know_the_units():
    """Lengths 3 times, times 5 times, masses 7 times as large in numbers."""
    speed, force, per_length, energy = 3 / 5, 7 * 3 / 25, 7 / 3, 7 * 9 / 25
    assert s.resonance_speed(700 * force, Q * per_length, 0.43 * 3, P * 3) == pytest.approx(
        speed * s.resonance_speed(700.0, Q, 0.43, P), rel=1e-13
    )
    assert s.meeting_energy(3 * P, Q * per_length, W / 5) == pytest.approx(energy * s.meeting_energy(P, Q, W), rel=1e-13)


def test_forces_of_the_strands_of_a_running_drive():
    """The preload is the sum of both pulls along the line of centres, their difference carries the torque, and q v^2 is in both."""
    forces = s.strand_forces(0.0127, (19, 38), 100, 0.7, 150.0, 400.0, 12.0)
    distance = s.centre_distance(0.0127, 19, 38, 100)
    angle = np.arcsin(0.5 * (s.pitch_diameter(0.0127, 38) - s.pitch_diameter(0.0127, 19)) / distance)
    assert (forces.tight + forces.slack) * np.cos(angle) == pytest.approx(400.0, rel=1e-12)
    assert (forces.tight - forces.slack) * 38 * 0.0127 / (2 * np.pi) == pytest.approx(12.0, rel=1e-12)
    assert forces.speed == pytest.approx(150.0 * 19 * 0.0127 / (2 * np.pi), rel=1e-12)
    assert forces.tension - forces.tight == pytest.approx(0.7 * forces.speed**2, rel=1e-12)
    assert s.strand_angle_cosine(0.0127, 19, 38, 20) == 1.0  # too short to reach around both
