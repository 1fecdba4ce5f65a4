"""Teeth cut by the rack on a circular pitch curve against the involute, the trochoid and the limit of undercut."""

from functools import cache

import numpy as np
import pytest
import shapely

from drivewright import gears
from drivewright.errors import InputError
from drivewright.scene import Arc

pytestmark = pytest.mark.analytical

PI = np.pi
ALPHA = np.deg2rad(20)


@cache
def cut(teeth, gear=1, rack=None, eccentricity=0.0):
    return gears.cut_gear(gears.EllipticGearPair(eccentricity, 0.02), gear, teeth, rack or gears.Rack())


def polygon(gear, tolerance=2e-8):
    return shapely.Polygon(gear.outline(tolerance).points(tolerance))


def points(gear, label, count=41):
    """Points along the surviving spans of the pieces whose label starts so, one row each."""
    spans = [span for span in gear.profile.spans if span.piece.label.startswith(label)]
    return np.array([span.piece.at(np.linspace(span.start, span.stop, count)).d0 for span in spans])


def half_space(radius, teeth, pitch_radius, alpha=ALPHA):
    """Half angle of the tooth space at a radius: pi/(2 z) - inv(alpha) + inv(alpha_r), cos(alpha_r) = r cos(alpha)/radius."""
    involute = lambda angle: np.tan(angle) - angle  # noqa: E731
    return PI / (2 * teeth) - involute(alpha) + involute(np.arccos(pitch_radius * np.cos(alpha) / radius))


def test_flanks_are_involutes():
    gear, teeth, r = cut(24), 24, 0.02
    flanks = points(gear, "flank")
    assert len(flanks) == 2 * teeth and not gear.undercut and not gear.pointed
    radius, angle = np.abs(flanks), np.angle(flanks)
    space = np.round(angle * teeth / (2 * PI)) * 2 * PI / teeth  # a space stands at the contact of angle 0
    np.testing.assert_allclose(np.abs(angle - space), half_space(radius, teeth, r), atol=1e-13)
    assert np.max(radius) == pytest.approx(r + gear.module, rel=1e-13)
    assert gear.module == pytest.approx(2 * r / teeth, rel=1e-13)


def test_second_gear_has_a_tooth_where_the_first_has_a_space():
    flanks = points(cut(24, gear=2), "flank")
    angle, teeth = np.angle(-flanks), 24  # contact of angle 0 lies at -x in its frame
    space = (np.floor(angle * teeth / (2 * PI)) + 0.5) * 2 * PI / teeth
    np.testing.assert_allclose(np.abs(angle - space), half_space(np.abs(flanks), teeth, 0.02), atol=1e-13)


def test_root_and_tip_are_true_arcs_and_the_fillet_is_a_parallel_of_a_trochoid():
    gear, r = cut(24), 0.02
    m, rack = gear.module, gear.family.rack
    np.testing.assert_allclose(np.abs(points(gear, "root")), r - 1.25 * m, rtol=1e-13)
    np.testing.assert_allclose(np.abs(points(gear, "tip")), r + m, rtol=1e-13)
    arcs = [piece for piece in gear.outline().pieces if isinstance(piece, Arc)]
    assert len(arcs) == 48 and {round(arc.radius / m, 9) for arc in arcs} == {13.0, 10.75}
    # centre of the rounding in the gear: (r - e) - i (roll r -+ land) turned by the roll
    roll = np.linspace(-0.6, 0.6, 60001)
    centre = (r - rack.center_depth * m + 1j * (rack.land * m - roll * r)) * np.exp(1j * roll)
    fillet = next(span for span in gear.profile.spans if span.piece.label.startswith("fillet"))
    z = fillet.piece.at(np.linspace(fillet.start, fillet.stop, 30)).d0
    k = np.round(np.angle(z[0]) * 24 / (2 * PI))
    z = z * np.exp(-1j * k * 2 * PI / 24)
    z = z.real + 1j * np.abs(z.imag)
    gap = np.min(np.abs(z[:, None] - centre), axis=1)
    np.testing.assert_allclose(gap, rack.rounding * m, rtol=1e-6)


@pytest.mark.parametrize(("rack", "clean"), [(gears.Rack(), 18), (gears.Rack(np.deg2rad(25), rounding=0.2), 13)])
def test_undercut_begins_at_the_exact_limit(rack, clean):
    """Least tooth count 2 h/sin^2(alpha) with the straight depth h of the cutter: 17.097 for 20 deg and h = 1."""
    limit = 2 * rack.straight / np.sin(rack.pressure_angle) ** 2
    assert clean - 1 < limit < clean
    assert not cut(clean, rack=rack).undercut and cut(clean, rack=rack).describe_undercut() == ""
    under = cut(clean - 1, rack=rack)
    assert len(under.undercut) == 2 * (clean - 1) and len(under.profile.corners) == 2 * (clean - 1)


def at_the_limit(teeth, shortage):
    """A rack with the straight depth of one module whose pressure angle falls short of the limit by this part of sin^2."""
    alpha = np.arcsin(np.sqrt(2 / teeth * (1 - shortage)))
    return gears.Rack(alpha, rounding=0.25 / (1 - np.sin(alpha)))


@pytest.mark.parametrize("shortage", [3e-4, 1e-2])
def test_the_slightest_undercut_is_seen(shortage):
    """The tail between flank and fillet is far thinner than the chords between samples; the lost depth is 1.5 times the shortage."""
    under = cut(17, rack=at_the_limit(17, shortage)).undercut
    assert len(under) == 34
    np.testing.assert_allclose([flank.lost / flank.straight for flank in under], 1.5 * shortage, rtol=2e-3)


def test_what_rounding_makes_of_the_limit_is_no_undercut():
    gear = cut(17, rack=at_the_limit(17, 1e-5))
    assert not gear.undercut and not gear.profile.crossings


def test_undercut_data_and_message():
    """Ten teeth: the flank starts above the base circle, where it leaves the trochoid; the lost depth follows from that radius."""
    gear, r = cut(10), 0.02
    first = np.min(np.abs(points(gear, "flank")), axis=1)
    base = r * np.cos(ALPHA)
    assert np.all(first > base * 1.0005) and np.ptp(first) < 1e-12
    # a point of radius rho is cut at height h = (sqrt(rho^2 - rb^2) - r sin a) sin a above the pitch line
    depth = (r * np.sin(ALPHA) - np.sqrt(first[0] ** 2 - base**2)) * np.sin(ALPHA)
    for under in gear.undercut:
        assert under.lost == pytest.approx(gear.module - depth, rel=1e-9)
        assert under.pitch_radius == pytest.approx(r, rel=1e-12)
    message = gear.describe_undercut()
    assert message.startswith("20 of 20 flanks are undercut") and "pitch curve radius 20 mm there, 34.19 mm needed" in message
    assert f"{gear.undercut[0].lost * 1e3:.3g} mm of 4 mm straight cutter depth lost" in message


def test_a_gear_is_what_polygon_racks_leave_of_the_blank():
    """Independent route for undercut teeth: blank minus 500 placed rack polygons, rounded by a buffer."""
    gear, r, teeth = cut(10), 0.02, 10
    m, rack = gear.module, gear.family.rack
    land, top = rack.land * m, 3 * m
    half = lambda height: rack.half_width * m + height * np.tan(ALPHA) - rack.rounding * m / np.cos(ALPHA)  # noqa: E731
    trapezoid = shapely.Polygon([(-half(top), top), (-land, -rack.center_depth * m), (land, -rack.center_depth * m), (half(top), top)])
    tooth = np.array(trapezoid.buffer(rack.rounding * m, quad_segs=32).exterior.coords)
    cuts = []
    for roll in np.linspace(-0.9, 0.9, 500):  # one space; the rack's tooth is under the contact at roll 0
        z = (r + tooth[:, 1] + 1j * (tooth[:, 0] - roll * r)) * np.exp(1j * roll)
        cuts.append(shapely.Polygon(np.stack([z.real, z.imag], axis=1)))
    space = shapely.union_all(cuts)
    sector = shapely.Polygon([(0, 0), (0.04, -0.04 * np.tan(PI / teeth)), (0.04, 0.04 * np.tan(PI / teeth))])
    blank = shapely.Point(0, 0).buffer(r + m, quad_segs=2000)
    left = blank.difference(space).difference(shapely.affinity.rotate(space, 36, origin=(0, 0)))
    left = left.difference(shapely.affinity.rotate(space, -36, origin=(0, 0))).intersection(sector)
    ours = polygon(gear).intersection(sector)
    assert ours.symmetric_difference(left).area < 4e-5 * left.area


def test_pointed_teeth_are_cut_off_where_the_flanks_meet():
    rack = gears.Rack(np.deg2rad(28), addendum=1.5, dedendum=1.0, rounding=0.1)
    gear = cut(9, rack=rack)
    assert gear.pointed == tuple(range(9))
    m, r = gear.module, 0.02
    tips = [abs(corner.point) for corner in gear.profile.corners if abs(corner.point) > r]
    radius = np.array(tips)
    np.testing.assert_allclose(half_space(radius, 9, r, rack.pressure_angle), PI / 9, rtol=1e-9)
    assert len(tips) == 9 and np.all(radius < r + 1.5 * m)
    assert polygon(gear).is_valid


def test_drawing_has_profile_pitch_curve_and_bore():
    gear = cut(18)
    drawing = gear.drawing("sun", bore=0.012, thickness=0.008)
    assert [shape.layer for shape in drawing.shapes] == ["profile", "pitch", "hole"] and drawing.thickness == 0.008
    assert drawing.title == "18 teeth, module 2.222 mm"
    (pitch,) = drawing.on("pitch")
    assert [type(piece) for piece in pitch.pieces] == [Arc] and pitch.pieces[0].radius == pytest.approx(0.02, rel=1e-12)
    with pytest.raises(InputError, match="bore of 40 mm breaks through the root by 2.778 mm; the axis is 17.22 mm from"):
        gear.drawing("sun", bore=0.04)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: gears.Rack(0.0), "pressure_angle = 0 rad; it lies between"),
        (lambda: gears.Rack(addendum=0.0), "addendum = 0 modules; it must be positive"),
        (lambda: gears.Rack(backlash=2.0), "backlash = 2 modules"),
        (lambda: gears.Rack(rounding=0.6), "rounding = 0.6 modules leaves a tip land of -0.1794 modules; .* at most 0.4719"),
        (lambda: gears.Rack(dedendum=0.1, rounding=0.3), "begins 0.09739 modules above the pitch line"),
        (lambda: gears.cut_gear(gears.EllipticGearPair(0.1, 0.02), 1, 20.5), "20.5 teeth on gear 1 give 20.5 on its mate"),
    ],
)
def test_messages(make, message):
    with pytest.raises(InputError, match=message):
        make()
