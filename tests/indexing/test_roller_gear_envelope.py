"""Flanks of roller-gear cams: normals, curvature and pressure angle against finite differences, closed forms of dwell and limits."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from drivewright.indexing.motion import TURN, index_motion
from drivewright.indexing.roller_gear import FLANKS, barrel, flank_contact, globoidal

pytestmark = pytest.mark.analytical

MOTION = index_motion("modified-sine", 12, 2.0)


def hourglass(motion=MOTION, hand="right", **changes):
    return globoidal(
        motion,
        **{
            "pin_circle_radius": 0.08,
            "roller_radius": 0.012,
            "roller_length": 0.016,
            "centre_distance": 0.125,
            "cam_length": 0.06,
            "hand": hand,
            **changes,
        },
    )


def drum(motion=MOTION, hand="right", **changes):
    return barrel(
        motion,
        **{
            "pin_circle_radius": 0.09,
            "roller_radius": 0.012,
            "roller_length": 0.016,
            "cam_radius": 0.05,
            "cam_length": 0.075,
            "centre_distance": 0.088,
            "hand": hand,
            **changes,
        },
    )


BOTH = pytest.mark.parametrize("make", [hourglass, drum])
PLACES = [(1.3, 0.003, 1), (1.3, 0.003, -1), (3.1, -0.006, 1), (-2.6, 0.005, -1)]  # away from the middle of motion and cam


def axis_of(cam, travel, u):
    """Point and direction of roller 0's axis in the cam's frame, by rotations of scipy."""
    psi = cam.motion(travel).d0 + cam.motion.pitch * cam.phase
    turret = Rotation.from_euler("z", psi)
    direction = np.array([1.0, 0, 0]) if cam.kind == "globoidal" else np.array([0, 0, 1.0])
    point = turret.apply([cam.pin_circle_radius, 0, 0] + u * direction)
    back = Rotation.from_euler("y", travel if cam.hand_sign < 0 else -travel)
    return back.apply(point - [cam.centre_distance, 0, cam.height]), back.apply(turret.apply(direction))


def derivative(f, x, step=1e-4):
    return (8 * (f(x + step) - f(x - step)) - f(x + 2 * step) + f(x - 2 * step)) / (12 * step)


@BOTH
@pytest.mark.parametrize("hand", ["right", "left"])
@pytest.mark.parametrize("travel, u, flank", PLACES)
def test_the_contact_lies_on_the_roller_and_is_normal_to_the_cam(make, hand, travel, u, flank):
    cam = make(hand=hand)
    found = flank_contact(cam, travel, u, flank)
    foot, along = axis_of(cam, travel, u)
    np.testing.assert_allclose(found.point - foot, cam.roller_radius * found.normal, atol=1e-15)
    assert found.normal @ along == pytest.approx(0, abs=1e-14)
    onward = derivative(lambda t: flank_contact(cam, t, u, flank).point, travel)
    for tangent in (onward, derivative(lambda s: flank_contact(cam, travel, s, flank).point, u)):
        assert found.normal @ tangent == pytest.approx(0, abs=1e-9 * np.linalg.norm(tangent))
    carried = derivative(lambda t: axis_of(cam, t, u)[0], travel)  # the roller's axis against the cam
    assert found.normal @ carried == pytest.approx(0, abs=1e-10)


@BOTH
@pytest.mark.parametrize("travel, u, flank", PLACES)
def test_curvature_is_that_of_the_surface(make, travel, u, flank):
    """Curvature across the contact line by finite differences of the normal; roller plus cam is the relative one."""
    cam = make()
    found = flank_contact(cam, travel, u, flank)
    along, onward = (
        derivative(f, x)
        for f, x in ((lambda s: flank_contact(cam, travel, s, flank).point, u), (lambda t: flank_contact(cam, t, u, flank).point, travel))
    )
    normal_along, normal_onward = (
        derivative(f, x)
        for f, x in ((lambda s: flank_contact(cam, travel, s, flank).normal, u), (lambda t: flank_contact(cam, t, u, flank).normal, travel))
    )
    line = along / np.linalg.norm(along)
    across = np.cross(found.normal, line)
    share = np.linalg.solve([[onward @ line, along @ line], [onward @ across, along @ across]], [0, 1])
    curvature = -(share[0] * normal_onward + share[1] * normal_along) @ across  # the normal points into the cam
    assert found.cam_curvature == pytest.approx(curvature, rel=1e-6, abs=1e-5)
    roller_axis = axis_of(cam, travel, u)[1]
    own = (1 - (across @ roller_axis) ** 2) / cam.roller_radius
    assert found.relative_curvature == pytest.approx(curvature + own, rel=1e-7)
    assert found.line_slope == pytest.approx(np.linalg.norm(along), rel=1e-8)


@BOTH
@pytest.mark.parametrize("travel, u, flank", PLACES)
def test_rolling_and_sliding_are_the_speed_of_the_roller_at_the_contact(make, travel, u, flank):
    cam = make(hand="left")
    found = flank_contact(cam, travel, u, flank)
    foot, along = axis_of(cam, travel, u)

    def carried(t):
        """The material point of the locked roller that is in contact at `travel`."""
        turn = Rotation.from_euler("z", cam.motion(t).d0 - cam.motion(travel).d0)
        fixed = Rotation.from_euler("y", travel).apply(found.point) + [cam.centre_distance, 0, cam.height]
        return Rotation.from_euler("y", -t).apply(turn.apply(fixed) - [cam.centre_distance, 0, cam.height])

    speed = derivative(carried, travel)
    assert found.sliding == pytest.approx(speed @ along, rel=1e-8, abs=1e-12)
    assert abs(found.rolling) == pytest.approx(np.linalg.norm(speed - along * (speed @ along)), rel=1e-8)


@BOTH
def test_power_in_is_power_out(make):
    """A unit force along the normal: turret arm times phi' plus the moment on the cam about its axis is nothing."""
    for hand, sign in (("right", -1.0), ("left", 1.0)):
        cam = make(hand=hand)
        for travel, u, flank in PLACES:
            found = flank_contact(cam, travel, u, flank)
            on_cam = sign * np.cross(found.point, found.normal)[1]
            assert found.arm * cam.motion(travel).d1 + on_cam == pytest.approx(0, abs=1e-15)
            assert np.sign(found.arm) == flank


def test_pressure_angle_of_the_globoidal_cam():
    """tan = rho phi'/(C - rho cos psi), rho the distance from the turret's axis."""
    cam, travel, u = hourglass(), np.linspace(0.2, 4, 9), 0.005
    psi, speed = cam.motion(travel).d0 + np.pi / 12, cam.motion(travel).d1
    found = flank_contact(cam, travel, u, 1)
    np.testing.assert_allclose(np.tan(found.pressure_angle), 0.085 * speed / (0.125 - 0.085 * np.cos(psi)), rtol=1e-13)
    np.testing.assert_allclose(found.arm, 0.085 * np.cos(found.pressure_angle), rtol=1e-13)


def test_pressure_angle_of_the_barrel():
    """Normal between the path of the roller and the rib: with C = R it vanishes where R phi' = s sin(psi) g, and is psi in the dwell."""
    cam = drum()
    still = flank_contact(cam, 5.0, 0.004, FLANKS)
    np.testing.assert_allclose(still.pressure_angle, np.pi / 12 + np.pi / 6, rtol=1e-13)
    travel = 1.9
    psi, speed = cam.motion(travel).d0 + np.pi / 12, cam.motion(travel).d1
    depth = 0.05 - 0.004
    wanted = (0.09 * speed + np.sin(psi) * depth) / (np.cos(psi) * depth)
    np.testing.assert_allclose(np.tan(flank_contact(cam, travel, 0.004, 1).pressure_angle), wanted, rtol=1e-13)


def test_dwell_of_the_barrel_is_a_plane_ring():
    """In the dwell the rib is cut square to the cam's axis; roller on plane: relative curvature 1/r."""
    cam = drum()
    travel, u = np.linspace(4.4, 6.1, 5)[:, None], np.linspace(-0.008, 0.008, 4)
    for flank in FLANKS:
        found = flank_contact(cam, travel, u, flank)
        np.testing.assert_allclose(found.point[..., 1], 0.09 * np.sin(np.pi / 4) - flank * 0.012, rtol=1e-13)
        np.testing.assert_allclose(found.normal[..., 1], -flank, rtol=1e-13)
        np.testing.assert_allclose(found.relative_curvature, 1 / 0.012, rtol=1e-12)
        np.testing.assert_allclose(found.cam_curvature, 0, atol=1e-10)


def test_dwell_of_the_globoidal_cam_is_a_cone():
    """A line parallel to the roller's axis, turned about the cam's axis: curvature across it sin(psi)/D at the distance D."""
    cam, psi = hourglass(), np.pi / 12 - np.pi / 6
    travel, u = np.linspace(4.4, 6.1, 5)[:, None] - TURN * 2, np.linspace(-0.008, 0.008, 4)
    for flank in FLANKS:
        found = flank_contact(cam, travel, u, flank)
        away = 0.125 - (0.08 + u) * np.cos(psi) - flank * 0.012 * np.sin(psi)
        np.testing.assert_allclose(np.hypot(found.point[..., 0], found.point[..., 2]), np.broadcast_to(away, (5, 4)), rtol=1e-13)
        np.testing.assert_allclose(found.cam_curvature, np.broadcast_to(flank * np.sin(psi) / away, (5, 4)), rtol=1e-10)
        np.testing.assert_allclose(found.relative_curvature, np.broadcast_to(1 / 0.012 + flank * np.sin(psi) / away, (5, 4)), rtol=1e-12)


def test_a_straight_groove_at_constant_speed_is_a_screw():
    """Pin circle to infinity, uniform law: the surface maps onto itself under the screw of that pitch; tan(pressure angle) = R phi'/g."""
    count, pitch = 100_000_000, 0.04
    radius = pitch * count / TURN
    cam = drum(index_motion("uniform", count), pin_circle_radius=radius, centre_distance=radius, cam_length=0.08)
    first, later = flank_contact(cam, 0.3, 0.002, 1), flank_contact(cam, 1.7, 0.002, 1)
    moved = Rotation.from_euler("y", 1.4).apply(first.point) + [0, pitch * 1.4 / TURN, 0]  # right hand
    np.testing.assert_allclose(later.point, moved, atol=3e-9)
    assert later.relative_curvature == pytest.approx(first.relative_curvature, rel=1e-6)
    assert np.tan(first.pressure_angle) == pytest.approx(pitch / TURN / 0.048, rel=1e-6)


def test_a_large_barrel_is_a_planar_cam():
    """Drum and pin circle to infinity: a roller runs along y(x = h theta) in a plane; the flank below a path bent upwards is hollow.

    The path of the roller leans by psi, small as the slope itself.
    """
    count, pitch, height = 1_000_000, 0.05, 4000.0
    radius = pitch * count / TURN
    motion = index_motion("modified-sine", count, 1.0)
    cam = drum(motion, pin_circle_radius=radius, centre_distance=radius, cam_radius=height, cam_length=0.08)
    for angle in (1.0, 2.2):
        jet = cam.motion(angle)
        slope, bend = radius * jet.d1 / height, radius * jet.d2 / height**2
        for flank in FLANKS:
            found = flank_contact(cam, angle, 0.0, flank)
            assert found.cam_curvature == pytest.approx(-flank * bend / (1 + slope**2) ** 1.5, rel=1e-4)
            assert np.tan(found.pressure_angle) == pytest.approx(slope + np.tan(found.psi), rel=1e-9)


@BOTH
@pytest.mark.parametrize("travel, u, flank", PLACES)
def test_a_symmetric_law_makes_the_flanks_mirror_images(make, travel, u, flank):
    """y -> -y turns the motion back: flank f at t is flank -f at the mirrored travel."""
    cam = make()
    image = cam if cam.kind == "globoidal" else make(hand="left")  # a barrel has no second plane of symmetry that restores the hand
    other = MOTION.motion_angle - 2 * TURN - travel  # psi = phi + pitch/2, and phi(motion_angle - t) = pitch - phi(t)
    one, two = flank_contact(cam, travel, u, flank), flank_contact(image, other, u, -flank)
    assert one.psi + two.psi == pytest.approx(0, abs=1e-12)
    for name in ("pressure_angle", "opening", "relative_curvature", "cam_curvature", "line_slope"):
        assert getattr(one, name) == pytest.approx(getattr(two, name), rel=1e-8, abs=1e-9)
    assert one.arm == pytest.approx(-two.arm, rel=1e-12)
    assert one.point[1] == pytest.approx(-two.point[1], abs=1e-15)


def test_left_hand_is_the_mirror_image_of_right_hand():
    """Of the globoidal cam in the plane of the turret."""
    for travel, u, flank in PLACES:
        one, two = flank_contact(hourglass(), travel, u, flank), flank_contact(hourglass(hand="left"), travel, u, flank)
        np.testing.assert_allclose(one.point * [1, 1, -1], two.point, atol=1e-16)
        assert one.relative_curvature == pytest.approx(two.relative_curvature, rel=1e-13)


@BOTH
def test_lengths_scale(make):
    cam = make()
    lengths = ("pin_circle_radius", "roller_radius", "roller_length", "centre_distance", "cam_length")
    big = make(**{name: 1000 * getattr(cam, name) for name in lengths}, **({"cam_radius": 50.0} if cam.kind == "barrel" else {}))
    one, two = flank_contact(cam, 1.3, 0.003, 1), flank_contact(big, 1.3, 3.0, 1)
    np.testing.assert_allclose(1000 * one.point, two.point, rtol=1e-12)
    assert one.relative_curvature == pytest.approx(1000 * two.relative_curvature, rel=1e-12)
    assert one.pressure_angle == pytest.approx(two.pressure_angle, rel=1e-12)
    assert 1000 * one.opening == pytest.approx(two.opening, rel=1e-12)
