"""Sprockets of silent chains: involute, hob's root, thickness and measuring pins by two routes each."""

import numpy as np
import pytest
import shapely

from drivewright import gears
from drivewright.chains.interference import profile_gap
from drivewright.chains.link import design_link, seat_support
from drivewright.chains.sprocket import Sprocket, design_sprocket
from drivewright.chains.tooth import Cutter, cut_tooth, matching_cutter, modification_for
from drivewright.curves import outline_area
from drivewright.scene import Arc, Line, Spline, place

pytestmark = pytest.mark.analytical

P, A = 9.525e-3, np.radians(30)
CHAIN = design_link(P, 1.2e-3, A, 2.6e-3)
CUTTERS = [20.0, 25.0, 27.0, 30.0, 31.5]


def cutter(degrees):
    return matching_cutter(P, A, np.radians(degrees))


def gear(teeth, shift, rounding=0.25, tip=1.0, chamfer=0.0, dedendum=1.25, module=2e-3, pressure=20.0):
    """A gear of the common rack, by its shift and tip height in modules."""
    hob, a = Cutter(np.pi * module, np.radians(pressure)), np.radians(pressure)
    r = 0.5 * module * teeth
    return Sprocket(
        cut_tooth(teeth, hob, shift, a),
        a,
        hob,
        r + (tip + shift) * module,
        r + (shift - dedendum) * module,
        rounding * module,
        chamfer * module,
    )


@pytest.mark.parametrize("degrees", CUTTERS)
@pytest.mark.parametrize("teeth", [35, 37])
def test_cutters_with_one_base_pitch_leave_one_tooth_and_their_own_roots(degrees, teeth):
    one, other = design_sprocket(CHAIN, teeth), design_sprocket(CHAIN, teeth, cutter(degrees))
    radius = np.linspace(one.form_radius, one.tip_radius, 9)
    np.testing.assert_allclose(other.flank_polar(radius), one.flank_polar(radius), atol=1e-15)
    assert other.over_pins(one.best_pin) == pytest.approx(one.over_pins(one.best_pin), rel=1e-13)
    assert (other.form_radius == pytest.approx(one.form_radius, rel=1e-12)) == (degrees == 30.0)


def test_contact_of_the_paper_s_third_group():
    sprocket = design_sprocket(CHAIN, 35)
    assert sprocket.tooth.contact_radius == pytest.approx(49.59688789127e-3, rel=1e-12)
    assert sprocket.tooth.support == pytest.approx(-18.667231944520e-3, rel=1e-12)
    low, high = sprocket.contact_margins
    assert low == pytest.approx(sprocket.tooth.contact_radius - sprocket.form_radius)
    assert high == pytest.approx(sprocket.tip_radius - sprocket.tip_chamfer - sprocket.tooth.contact_radius)
    assert min(low, high) > 1e-3


@pytest.mark.parametrize("degrees", CUTTERS)
def test_thickness_on_the_rolling_circle_is_the_hob_s_space(degrees):
    """p2/2 + 2 x m2 tan a2: the hob's space where it has moved x m2 away."""
    hob = cutter(degrees)
    sprocket = design_sprocket(CHAIN, 35, hob)
    x = modification_for(35, hob, seat_support(CHAIN, 35), A)
    thickness = 0.5 * hob.pitch + 2 * x * hob.module * np.tan(hob.half_angle)
    assert sprocket.thickness(0.5 * 35 * hob.module) == pytest.approx(thickness, rel=1e-12)
    assert gear(20, 0.3).thickness(20e-3) == pytest.approx((np.pi / 2 + 2 * 0.3 * np.tan(np.radians(20))) * 2e-3, rel=1e-13)


def test_flank_points_have_the_normal_of_the_involute():
    """Every normal of the flank is tangent to the base circle."""
    sprocket = design_sprocket(CHAIN, 35)
    z = sprocket.flank_points(4001) @ (1, 1j)
    along = (z[2:] - z[:-2]) / np.abs(z[2:] - z[:-2])
    np.testing.assert_allclose(np.real(np.conj(along) * z[1:-1]), sprocket.tooth.base_radius, rtol=3e-9)
    assert np.abs(z[[0, -1]]) == pytest.approx([sprocket.form_radius, sprocket.tip_radius - sprocket.tip_chamfer], rel=1e-13)
    assert np.all(np.diff(np.angle(z)) > 0)


def test_tip_with_and_without_chamfer():
    plain, cut = design_sprocket(CHAIN, 35, tip_chamfer=0.0), design_sprocket(CHAIN, 35, tip_chamfer=0.3e-3)
    assert plain.tip_thickness == pytest.approx(plain.thickness(plain.tip_radius), rel=1e-14)
    low = cut.tip_radius - 0.3e-3
    assert cut.tip_thickness == pytest.approx(cut.thickness(low) * cut.tip_radius / low - 2 * 0.3e-3, rel=1e-13)
    lines = [piece for piece in cut.outline().pieces if isinstance(piece, Line)]
    assert len(lines) == 70 and not [piece for piece in plain.outline().pieces if isinstance(piece, Line)]


def test_flanks_meet_at_the_pointed_radius():
    sprocket = gear(12, 0.4, tip=0.6)
    assert sprocket.thickness(sprocket.pointed_radius) == pytest.approx(0.0, abs=1e-15)
    assert sprocket.pointed_radius > sprocket.tip_radius


@pytest.mark.parametrize("teeth", [35, 36])
@pytest.mark.parametrize("factor", [0.93, 1.0, 1.05])
def test_measuring_pins_touch_both_flanks(teeth, factor):
    sprocket = design_sprocket(CHAIN, teeth)
    diameter = factor * sprocket.best_pin
    flank = sprocket.flank_points(20001)
    half = np.pi / teeth
    pin = sprocket.pin_center_radius(diameter) * np.array([np.sin(half), np.cos(half)])
    assert np.min(np.hypot(*(flank - pin).T)) == pytest.approx(0.5 * diameter, abs=1e-11)


def test_best_pin_touches_where_the_plate_does():
    sprocket = design_sprocket(CHAIN, 35)
    half = np.pi / 35
    pin = sprocket.pin_center_radius(sprocket.best_pin) * np.array([np.sin(half), np.cos(half)])
    flank = sprocket.flank_points(40001)
    nearest = flank[np.argmin(np.hypot(*(flank - pin).T))]
    assert np.hypot(*nearest) == pytest.approx(sprocket.tooth.contact_radius, abs=2e-7)


@pytest.mark.parametrize("teeth", [23, 24])
def test_over_pins_is_the_largest_distance_of_two_pins(teeth):
    sprocket = design_sprocket(CHAIN, teeth)
    center = sprocket.pin_center_radius(sprocket.best_pin)
    places = center * np.exp(2j * np.pi * np.arange(teeth) / teeth)
    widest = np.max(np.abs(places[:, None] - places)) + sprocket.best_pin
    assert sprocket.over_pins(sprocket.best_pin) == pytest.approx(widest, rel=1e-13)


@pytest.mark.parametrize("teeth, shift, rounding", [(24, 0.0, 0.3), (10, -0.1, 0.25), (14, -0.4, 0.2)])
def test_profile_is_what_a_rolling_rack_leaves(teeth, shift, rounding):
    """Second route: the envelope of the whole rack, trimmed; its spaces stand at angle 0, ours half a pitch beside the y axis."""
    sprocket = gear(teeth, shift, rounding, tip=0.8)
    module, r = 0.04 / teeth, 0.02
    rack = gears.Rack(np.radians(20), 0.8 + shift, 1.25 - shift, rounding, backlash=-4 * shift * np.tan(np.radians(20)))
    cut = gears.cut_gear(gears.EllipticGearPair(0.0, r), 1, teeth, rack)
    assert bool(cut.undercut) == sprocket.undercut == (teeth != 24)
    turn = 0.5 * np.pi - np.pi / teeth
    points = place(cut.outline(1e-7).points(1e-7)[::11], (0.0, 0.0, turn)) * 2e-3 / module
    np.testing.assert_allclose(profile_gap(sprocket, points, 1e-9), 0.0, atol=3e-9)


def test_undercut_begins_at_the_limit_of_the_book():
    """z = 2 h/sin^2 a with h the straight depth of the hob below the pitch line."""
    straight = 1.25 - 0.25 * (1 - np.sin(np.radians(20)))
    least = 2 * straight / np.sin(np.radians(20)) ** 2
    assert gear(int(np.floor(least)), 0.0).undercut and not gear(int(np.ceil(least)), 0.0).undercut
    shifted = int(np.ceil(2 * (straight - 0.5) / np.sin(np.radians(20)) ** 2))
    assert not gear(shifted, 0.5, tip=0.5).undercut and gear(shifted - 1, 0.5, tip=0.5).undercut


@pytest.mark.parametrize("sprocket", [design_sprocket(CHAIN, 35), design_sprocket(CHAIN, 37, cutter(20.0)), gear(24, 0.0)])
def test_trochoid_joins_root_circle_and_involute_smoothly(sprocket):
    rise, flank = (piece for piece in sprocket.outline().pieces[1:3])
    start, top = rise.knots[[0, -1]] @ (1, 1j)
    assert abs(start) == pytest.approx(sprocket.root_radius, rel=1e-14)
    assert complex(*rise.start_tangent) == pytest.approx(1j * start / abs(start), abs=1e-13)
    assert top == pytest.approx(complex(*flank.knots[0]), abs=1e-15)
    assert rise.end_tangent == pytest.approx(flank.start_tangent, abs=1e-12)
    assert abs(top) == pytest.approx(sprocket.form_radius, rel=1e-14)


@pytest.mark.parametrize("sprocket", [design_sprocket(CHAIN, 35), gear(10, 0.0)])
def test_end_tangents_of_the_splines_are_those_of_their_curves(sprocket):
    for piece in (p for p in sprocket.outline(1e-12).pieces[:8] if isinstance(p, Spline)):
        z = np.asarray(piece.knots) @ (1, 1j)
        for heading, chord in ((piece.start_tangent, z[1] - z[0]), (piece.end_tangent, z[-1] - z[-2])):
            assert abs(np.angle(complex(*heading) / chord)) < 4e-3


def test_outline_runs_once_around_without_a_gap():
    sprocket = design_sprocket(CHAIN, 35)
    pieces = sprocket.outline().pieces
    ends = [piece.points(1e-7)[[0, -1]] for piece in pieces]
    for (_, a), (b, _) in zip(ends, ends[1:] + ends[:1], strict=True):
        assert a == pytest.approx(b, abs=1e-15)
    assert len([p for p in pieces if isinstance(p, Arc)]) == 70
    points = sprocket.outline().points() @ (1, 1j)
    assert np.sum(np.angle(np.roll(points, -1) / points)) == pytest.approx(2 * np.pi)


@pytest.mark.parametrize("sprocket", [design_sprocket(CHAIN, 35), gear(11, 0.0, chamfer=0.1)])
def test_area_is_that_of_the_half_teeth(sprocket):
    """Splines of a coarse outline against sectors under the fine half profile."""
    x, y = sprocket.half_profile(1e-10).T
    half = 0.5 * np.sum(x[:-1] * y[1:] - x[1:] * y[:-1])
    assert outline_area(sprocket.outline(1e-6)) == pytest.approx(2 * sprocket.tooth.teeth * half, rel=1e-6)


def test_half_profile_keeps_its_tolerance():
    sprocket = design_sprocket(CHAIN, 35)
    fine, coarse = sprocket.half_profile(1e-11), shapely.LineString(sprocket.half_profile(1e-7))
    assert max(coarse.distance(shapely.Point(p)) for p in fine[::5]) < 1.01e-7


def test_teeth_are_mirror_images_and_alike():
    body = shapely.Polygon(design_sprocket(CHAIN, 23).outline(1e-7).points())
    points = shapely.get_coordinates(body)
    image = shapely.Polygon(points * (-1, 1))
    turned = shapely.Polygon(place(points, (0, 0, 2 * np.pi / 23)))
    assert body.symmetric_difference(image).area < 1e-12 and body.symmetric_difference(turned).area < 1e-12


def test_twice_the_chain_has_twice_the_sprocket():
    small, large = design_sprocket(CHAIN, 35), design_sprocket(design_link(2 * P, 2.4e-3, A, 5.2e-3), 35)
    for name in ("form_radius", "tip_thickness", "best_pin", "tip_rounding", "pointed_radius"):
        assert getattr(large, name) == pytest.approx(2 * getattr(small, name), rel=1e-12)
    assert large.over_pins(large.best_pin) == pytest.approx(2 * small.over_pins(small.best_pin), rel=1e-12)


def test_drawing_and_part_have_the_bore():
    sprocket = design_sprocket(CHAIN, 35)
    assert len(sprocket.drawing(0.02, 0.006).on("hole")) == 1 and not sprocket.drawing().on("hole")
    (prism,) = sprocket.part(0.02, 0.006).solids
    assert (prism.z, prism.thickness) == (-0.003, 0.006) and outline_area(prism.holes[0]) == pytest.approx(np.pi * 1e-4)
