"""The parallel-shaft indexer: each cam against the closed form of a plate cam with an oscillating roller, its dwell, and how both lock."""

from functools import cache

import numpy as np
import pytest

from drivewright.cams import oscillating
from drivewright.indexing.motion import TURN, index_motion
from drivewright.indexing.parallel import ParallelIndexer
from drivewright.indexing.plane import centre_curvature, contact_pressure_angle, envelope_points, find_contacts, pitch_point
from drivewright.indexing.play import BACKWARD, FORWARD, find_play
from drivewright.numerics.jets import Jet, constant, variable

pytestmark = pytest.mark.analytical

N, R, RZ, C = 8, 0.06, 0.009, 0.085
THETA = np.array([0.2, 0.7, 1.3, 1.6, 2.2, 2.9])


@cache
def drive(centre_distance=C, law="modified-sine", ratio=1.0, scale=1.0):
    return ParallelIndexer(N, R * scale, RZ * scale, centre_distance * scale, index_motion(law, N, ratio))


def touching(level, theta):
    found = find_contacts(level, theta, reach=1e-5)
    keep = found.intended
    return type(found)(*(column[keep] for column in found))


@pytest.mark.parametrize("number", [0, 1])
def test_rollers_run_along_the_pitch_curve_of_an_oscillating_follower(number):
    """The arm R swings about a pivot at the distance C; with the wheel's axis as pivot the line to the cam is at psi = 0."""
    level = drive().levels[number]
    motion = level.motion(THETA)
    path = level.pin_paths(THETA)
    for roller in range(N):
        psi = motion + (level.phase + TURN / N * roller)
        closed = -oscillating.pitch_curve(variable(THETA), psi, C, R, side=-1)
        for order in ("d0", "d1", "d2"):
            np.testing.assert_allclose(getattr(path, order)[:, roller], getattr(closed, order), atol=1e-12)


@pytest.mark.parametrize("number", [0, 1])
@pytest.mark.parametrize("theta", THETA)
def test_contacts_lie_on_the_line_to_the_pole(number, theta):
    """The pole divides the centre distance as 1 : phi'; the contact is a roller's radius from its centre towards the pole or away."""
    level = drive().levels[number]
    rate = float(level.motion(theta).d1)
    pole = C / (1 + rate)
    assert pitch_point(level, theta) == pytest.approx(pole, rel=1e-12)
    found = touching(level, theta)
    assert len(found.pin)
    to_pole = (pole - found.centre) / np.abs(pole - found.centre)
    np.testing.assert_allclose(np.abs(np.real(np.conj(to_pole) * found.normal)), 1, atol=1e-12)
    psi = np.angle(found.centre)
    np.testing.assert_allclose(np.abs(found.arm), np.abs(R * pole * np.sin(psi)) / np.abs(pole - found.centre), rtol=1e-10)
    contact = (found.centre - RZ * found.normal - C) * np.exp(1j * theta)  # seen from the cam
    away = np.min(np.abs(contact[:, None] - envelope_points(level, theta)[found.pin]), axis=1)
    np.testing.assert_allclose(away, 0, atol=1e-14)
    np.testing.assert_allclose(found.curvature, _curvature(level, theta, found), rtol=1e-9)


def _curvature(level, theta, found):
    """1/(rho - rz) of the cam where rho, that of the roller's path, is counted positive around the cam's side."""
    path = level.pin_paths(theta)
    left = np.real(np.conj(1j * path.d1[found.pin]) * -found.normal * np.exp(1j * theta)) > 0
    bend = np.where(left, 1, -1) * centre_curvature(level, theta)[found.pin]
    return bend / (1 - RZ * bend)


@pytest.mark.parametrize("direction", [FORWARD, BACKWARD])
def test_pressure_angle_of_the_driving_roller(direction):
    """tan(alpha) = (R (1 + phi') - C cos psi)/(C sin psi), the oscillating follower's; the best roller that pushes that way."""
    for theta, alpha in zip(THETA, contact_pressure_angle(drive(), THETA, direction), strict=True):
        angles = []
        for level in drive().levels:
            found = touching(level, theta)
            found = type(found)(*(column[direction * found.arm > 0] for column in found))
            rate = float(level.motion(theta).d1)
            psi = np.angle(found.centre)
            angles += list(np.arctan(np.abs((R * (1 + rate) - C * np.cos(psi)) / (C * np.sin(psi)))))
            told = oscillating.pressure_angle(variable(0 * psi), Jet(psi, rate + 0 * psi, 0 * psi, 0 * psi), C, R, side=-1).d0
            np.testing.assert_allclose(np.abs(told), angles[len(angles) - len(psi) :], rtol=1e-9)
        assert alpha == pytest.approx(min(angles), rel=1e-9)


@pytest.mark.parametrize("number", [0, 1])
def test_the_dwell_is_an_arc_about_the_shaft(number):
    level = drive().levels[number]
    radius = abs(R * np.exp(1j * TURN / (4 * N)) - C) - RZ
    arcs = [piece for piece in level.profile.outline().pieces if hasattr(piece, "sweep") and abs(piece.radius - radius) < 1e-9]
    assert arcs
    for arc in arcs:
        np.testing.assert_allclose(arc.center, 0, atol=1e-9)
    assert sum(abs(arc.sweep) for arc in arcs) == pytest.approx(TURN / 2, rel=1e-6)  # half a turn is dwell


def test_in_the_dwell_one_cam_presses_forward_and_the_other_backward():
    arms = []
    for level, sign in zip(drive().levels, (1, -1), strict=True):
        found = touching(level, 4.0)
        assert len(found.pin) == 1
        assert np.angle(found.centre[0]) == pytest.approx(sign * TURN / (4 * N), rel=1e-9)
        arms.append(found.arm[0])
    reach = abs(R * np.exp(1j * TURN / (4 * N)) - C)
    assert arms[0] == pytest.approx(C * R * np.sin(TURN / (4 * N)) / reach, rel=1e-9)
    assert arms[1] == pytest.approx(-arms[0], rel=1e-12)


def test_the_second_cam_is_the_mirror_image_of_the_first():
    """theta -> theta_h - theta and y -> -y change the levels over."""
    first, second = drive(ratio=2.0).levels
    assert first.profile.area == pytest.approx(second.profile.area, rel=1e-9)
    for theta in (0.4, 1.9, 3.3, 5.1):
        one, other = touching(first, theta), touching(second, first.motion.motion_angle - theta)
        np.testing.assert_allclose(sorted(one.centre), sorted(np.conj(other.centre)), atol=1e-12)
        np.testing.assert_allclose(sorted(one.arm), sorted(-other.arm), atol=1e-12)


def test_both_cams_hold_the_wheel_at_every_angle():
    theta = np.deg2rad(np.arange(0.0, 360.0, 2.0))
    for direction in (FORWARD, BACKWARD):
        np.testing.assert_allclose(find_play(drive(), theta, direction), 0, atol=1e-7)
        assert np.max(find_play(drive().levels[0], theta, direction)) > 0.05  # one alone does not


def test_shafts_too_close_leave_play_and_the_mirror_theorem_holds():
    near = drive(0.08)
    theta = np.deg2rad(np.arange(1.0, 180.0, 2.0))
    forward, backward = find_play(near, theta, FORWARD), find_play(near, np.pi - theta, BACKWARD)
    assert np.max(forward) > np.deg2rad(0.2)
    np.testing.assert_allclose(forward, backward, atol=1e-8)


def test_play_knows_no_unit_of_length():
    theta = np.deg2rad(np.arange(3.0, 180.0, 9.0))
    np.testing.assert_allclose(find_play(drive(0.08), theta, FORWARD), find_play(drive(0.08, scale=3.0), theta, FORWARD), atol=1e-7)


def test_a_point_is_seen_from_a_cam_that_turns():
    """A point of the wheel's plane, turned by +theta about the input shaft: its distance stays, its derivatives are differences."""
    level, h = drive().levels[0], 1e-5
    seen = level.seen_from_cam(constant(np.full(THETA.shape, 0.01 + 0.02j)), THETA)
    np.testing.assert_allclose(seen.d0, (0.01 + 0.02j - C) * np.exp(1j * THETA), rtol=1e-14)
    ahead, back = (level.seen_from_cam(constant(np.full(THETA.shape, 0.01 + 0.02j)), THETA + d).d0 for d in (h, -h))
    np.testing.assert_allclose(seen.d1, (ahead - back) / (2 * h), rtol=1e-8)
