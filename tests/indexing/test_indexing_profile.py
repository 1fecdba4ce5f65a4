"""The pin wheel's cam: the sheet's table of contacts, its counts, the cycloid limit in closed form, symmetry, and shapely beside it."""

from functools import cache

import numpy as np
import pytest
import shapely

from drivewright.curves.touching import touches
from drivewright.indexing.motion import TURN, index_motion
from drivewright.indexing.pin_wheel import PinWheel
from drivewright.indexing.plane import centre_curvature, contacts_at, envelope_points, find_contacts, index_angles, pitch_point

pytestmark = pytest.mark.analytical

R, E = 0.12, 0.01


@cache
def wheel(pin_radius=8e-3, law="modified-sine", eccentricity=E, side="inside"):
    return PinWheel(12, R, pin_radius, eccentricity, index_motion(law, 12), side)


def touching_pins(drive, theta):
    found = find_contacts(drive, theta, reach=1e-5)
    return set(found.pin[found.intended])


def around(drive, count=400):
    """Points around the profile."""
    return np.concatenate([span.piece.at(np.linspace(span.start, span.stop, count)).d0 for span in drive.profile.spans])


# angle, pin, centre, point of contact [mm] seen from the cam, arm [mm], pressure angle [deg]; reference computation for rz = 8 mm
TABLE = [
    (90, 0, (115.9111, 21.0583), (107.9138, 21.2681), -34.087, 73.50),
    (90, 3, (-31.0583, 105.9111), (-28.2190, 98.4319), 12.102, 84.21),
    (90, 5, (-115.9111, 21.0583), (-107.9138, 21.2681), 34.087, 73.50),
    (90, 8, (-31.0583, -125.9111), (-29.4363, -118.0772), 6.913, 86.70),
    (45, 0, (112.7031, 0.2869), (120.1702, -2.5843), 49.853, 65.45),
    (45, 4, (-73.3303, 92.9775), (-66.4291, 88.9310), 52.792, 63.90),
    (45, 1, (92.9775, 59.1882), (85.6830, 55.9034), -19.336, 80.73),
]


@pytest.mark.parametrize(("angle", "pin", "centre", "point", "arm", "alpha"), TABLE)
def test_contacts_of_the_sheet(angle, pin, centre, point, arm, alpha):
    drive, theta = wheel(), np.deg2rad(angle)
    found = find_contacts(drive, theta)
    number = int(np.flatnonzero((found.pin == pin) & found.intended)[0])
    seen = found.centre[number] - drive.crank_vector(theta).d0
    touched = seen - drive.pin_radius * found.normal[number]
    np.testing.assert_allclose([1e3 * seen.real, 1e3 * seen.imag], centre, atol=5.1e-5)
    np.testing.assert_allclose([1e3 * touched.real, 1e3 * touched.imag], point, atol=5.1e-5)
    assert 1e3 * found.arm[number] == pytest.approx(arm, abs=5.1e-4)
    assert np.rad2deg(np.arccos(abs(found.arm[number]) / R)) == pytest.approx(alpha, abs=5.1e-3)


def test_half_of_the_pins_touch_nothing_at_45_deg():
    assert touching_pins(wheel(), np.deg2rad(45)) == set(range(7))


def test_measures_of_the_cam():
    """The dwell's arcs reach R - e - rz and R + e - rz exactly; area and perimeter within the error of the reference's polygon."""
    profile, reach = wheel().profile, np.abs(around(wheel()))
    assert np.min(reach) == pytest.approx(R - E - 8e-3, abs=1e-9)
    assert np.max(reach) == pytest.approx(R + E - 8e-3, abs=1e-6)
    assert 1e6 * profile.area == pytest.approx(38122.1, rel=1e-4)
    assert 1e3 * profile.perimeter == pytest.approx(1018.66, rel=5e-4)


@pytest.mark.parametrize(
    ("pin_radius", "at_45", "at_90", "least"),
    [(18.635, 3, 8, 0), (10, 6, 12, 3), (8.5, 7, 12, 7), (8, 7, 12, 7), (7.5, 7, 12, 7), (6, 9, 12, 8)],
)
def test_pins_that_touch(pin_radius, at_45, at_90, least):
    drive = wheel(1e-3 * pin_radius)
    counts = [len(touching_pins(drive, theta)) for theta in index_angles(drive)]
    assert (counts[10], counts[20], min(counts), len(counts)) == (at_45, at_90, least, 41)


@pytest.mark.parametrize(("side", "sign"), [("inside", 1), ("outside", -1)])
def test_the_uniform_law_gives_the_offset_of_an_epitrochoid(side, sign):
    """z = R e^{iu} - e e^{i s N u}, |z'| = |R - s N e e^{i(sN-1)u}|: its parallel curve has A - s rz L + pi rz^2 and L - 2 pi s rz."""
    e, radius, lobes = 4e-3, 8e-3, 12 - sign
    drive = wheel(radius, "uniform", e, side)
    u = np.linspace(0, TURN, 4096, endpoint=False)
    slope = R * np.exp(1j * u) - sign * 12 * e * np.exp(sign * 12j * u)
    length = TURN * np.mean(np.abs(slope))
    area = np.pi * (R**2 + sign * 12 * e**2)
    assert drive.lobes == lobes and not drive.profile.corners
    assert drive.profile.perimeter == pytest.approx(length - sign * TURN * radius, rel=1e-9)
    assert drive.profile.area == pytest.approx(area - sign * radius * length + np.pi * radius**2, rel=1e-9)
    closed = R * np.exp(1j * u) - e * np.exp(sign * 12j * u) - sign * radius * slope / np.abs(slope)  # z' = i slope
    own = envelope_points(drive, 12 * u[:40])[:, 0, 0 if sign > 0 else 1]  # pin 0 in its first step
    np.testing.assert_allclose(own, closed[:40], atol=1e-14)
    np.testing.assert_allclose(np.sort(np.abs(around(drive)))[[0, -1]], np.sort(np.abs(closed))[[0, -1]], rtol=1e-6)


@pytest.mark.parametrize("angle", [7.0, 31.5, 52.0, 83.0])
def test_the_cam_is_its_own_mirror_image(angle):
    """theta -> pi - theta, pin k -> 5 - k, x -> -x: the same pins touch, their arms change sign."""
    drive, theta = wheel(), np.deg2rad(angle)
    one, other = find_contacts(drive, theta, reach=1e-5), find_contacts(drive, np.pi - theta, reach=1e-5)
    one_way = sorted(zip(one.pin[one.intended], one.centre[one.intended], one.arm[one.intended], strict=True))
    there = other.intended
    back = sorted(zip((5 - other.pin[there]) % 12, -np.conj(other.centre[there]), -other.arm[there], strict=True))
    assert len(one_way) >= 7
    np.testing.assert_allclose(np.array(one_way), np.array(back), atol=1e-12)


@pytest.mark.parametrize("side", ["inside", "outside"])
def test_shapely_leaves_the_same_profile(side):
    drive = wheel(8e-3, side=side)
    theta = np.linspace(0, TURN, 1441)
    path = np.concatenate([drive.pin_paths(theta).d0[:-1, pin] for pin in range(12)])
    swept = shapely.union_all(
        [
            shapely.LineString(np.stack([z.real, z.imag], axis=1)).buffer(8e-3, quad_segs=64)
            for z in np.split(np.append(path, path[0]), np.arange(1440, 12 * 1440, 1440))
        ]
    )
    joints = shapely.union_all(shapely.points(np.stack([path[::1440].real, path[::1440].imag], axis=1)).tolist()).buffer(8e-3, quad_segs=64)
    swept = shapely.union(swept, joints)
    hole = next(shapely.Polygon(ring) for ring in swept.interiors if shapely.Polygon(ring).contains(shapely.Point(0, 0)))
    polygon = shapely.Polygon(swept.exterior) if side == "outside" else hole
    assert drive.profile.area == pytest.approx(polygon.area, rel=5e-5)
    points = shapely.points(np.stack([around(drive, 40).real, around(drive, 40).imag], axis=1))
    assert np.max(shapely.distance(polygon.exterior, points)) < 5e-6


def test_normals_pass_through_the_pitch_point():
    drive, theta = wheel(), 0.83
    found = find_contacts(drive, theta, reach=1e-5)
    to_pole = pitch_point(drive, theta) - found.centre
    off = np.imag(np.conj(found.normal) * to_pole)
    assert np.sum(found.intended) == 7
    np.testing.assert_allclose(off[found.intended], 0, atol=1e-12)
    assert abs(pitch_point(drive, np.deg2rad(22.5))) == pytest.approx(136.3944e-3, abs=5e-8)
    assert np.isinf(pitch_point(drive, 4.0))


def test_curvature_of_the_centre_curve():
    """1/e in the dwell; elsewhere the turn of the path over its length, by differences."""
    drive = wheel()
    np.testing.assert_allclose(np.abs(centre_curvature(drive, 5.0)), 1 / E, rtol=1e-9)
    theta, h = 1.1, 1e-4
    heading = np.angle(drive.pin_paths(theta + h).d1 / drive.pin_paths(theta - h).d1)
    speed = np.abs(drive.pin_paths(theta).d1)
    np.testing.assert_allclose(centre_curvature(drive, theta), heading / (2 * h * speed), rtol=1e-6)


def test_curvature_of_the_profile_in_the_dwell():
    """Lobe tops have the radius e - rz and are convex, valleys e + rz and are hollow."""
    found = find_contacts(wheel(), 4.5, reach=1e-5)
    convex = found.curvature > 0
    assert convex.any() and (~convex).any()
    np.testing.assert_allclose(found.curvature[convex], 1 / 2e-3, rtol=1e-9)
    np.testing.assert_allclose(found.curvature[~convex], -1 / 18e-3, rtol=1e-9)


@pytest.mark.parametrize("angle", [33.0, 61.0, 90.0])
def test_curvature_of_the_profile_is_that_of_the_places_found(angle):
    """The exact curvature of a contact beside that of the cubics through the profile's nodes, good to some percent."""
    drive = wheel()
    found = find_contacts(drive, np.deg2rad(angle), reach=1e-5)
    seen = touches(drive.nodes, found.centre - drive.crank_vector(np.deg2rad(angle)).d0, drive.pin_radius, 1e-6)
    assert np.sum(found.intended) >= 7
    for k in np.flatnonzero(found.intended):
        cubic = drive.orientation * seen.curvature[seen.centre == k]
        assert np.min(np.abs(cubic - found.curvature[k])) < 0.03 * abs(found.curvature[k]) + 0.2


def test_a_missed_crossing_is_not_answered_with_the_outer_edge():
    """With 16 pins and slow places of the path the first sampling misses a crossing; the area is shapely's of the same pins."""
    drive = PinWheel(16, R, 6.983337529689183e-3, 14.160737410022744e-3, index_motion("modified-sine", 16, 5.958))
    assert drive.profile.area == pytest.approx(4.0176247e-2, rel=1e-4)


def test_contacts_of_many_positions_are_those_of_each():
    """At once beside one by one, with the wheel in its place and turned at some of the positions."""
    drive, theta = wheel(), np.deg2rad([0.0, 13.5, 45.0, 90.0, 151.0, 230.0])
    turned = np.array([0.0, 0.002, 0.0, -0.001, 0.0, 3e-4])
    together = contacts_at(drive, theta, 2e-3, turned)
    assert len(together) == len(theta)
    for each, angle, off in zip(together, theta, turned, strict=True):
        alone = find_contacts(drive, angle, 2e-3, off)
        for own, wanted in zip(each, alone, strict=True):
            np.testing.assert_allclose(own, wanted, rtol=1e-12)
        assert len(each.pin) > 6 and each.intended.any() == (off == 0)


def test_a_wheel_of_many_pins_is_as_exact_as_one_of_few():
    """Forty pins on the pitch of twelve: area and lobes beside a union of the pins by shapely."""
    drive = PinWheel(40, 0.4, 8e-3, E, index_motion("modified-sine", 40))
    theta = np.linspace(0, TURN, 1440, endpoint=False)
    centres = drive.pin_paths(theta).d0
    path = np.append(centres.T.ravel(), centres[0, 0])
    swept = shapely.LineString(np.stack([path.real, path.imag], axis=1)).buffer(8e-3, quad_segs=64)
    hole = max((shapely.Polygon(ring) for ring in swept.interiors), key=lambda each: each.area)
    assert drive.profile.area == pytest.approx(hole.area, rel=2e-6)
    assert drive.profile.perimeter == pytest.approx(hole.length, rel=1e-3)


def test_a_corner_lies_between_the_spans_that_meet_there():
    """The span before it ends where the envelope leaves, that after it starts where it goes on, both at the corner's point."""
    spans, corners = wheel().profile.spans, wheel().profile.corners
    ahead = [(k, (k + 1) % len(spans)) for k in range(len(spans))]
    for leaves, resumes, point in corners:
        (k, after), *more = [(k, n) for k, n in ahead if abs(spans[k].stop - leaves) + abs(spans[n].start - resumes) < 1e-12]
        assert not more
        ends = [spans[k].piece.at(np.array([leaves])).d0[0], spans[after].piece.at(np.array([resumes])).d0[0]]
        np.testing.assert_allclose(ends, point, atol=1e-13)
    assert len(corners) == 14
