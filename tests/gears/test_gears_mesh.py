"""Generated gears meshed through a turn as polygons: they touch, never overlap, and have the backlash asked for."""

from functools import cache

import numpy as np
import pytest
import shapely

from drivewright import gears
from drivewright.numerics import jets
from drivewright.scene import place

pytestmark = pytest.mark.property

ECCENTRICITY = np.sqrt(1 - 0.985**2)


def pusher():
    return gears.EllipticGearPair(ECCENTRICITY, 0.016272)


def lobed():
    """Two lobes driving three; the driven gear's pitch curve is nearly triangular."""
    return gears.NonCircularPair(lambda x: (2 / 3) * (1 + 0.12 * jets.cos(2 * x) + 0.03 * jets.sin(2 * x)), 0.1)


def far():
    return gears.EllipticGearPair(0.3, 0.02, "far")


# pair, teeth, phase, pressure angle and rounding of the rack
PAIRS = {"pusher": (pusher, 21, 21, 0.0, 20, 0.38), "far": (far, 24, 24, 0.3, 20, 0.38), "lobed": (lobed, 16, 24, 0.0, 25, 0.2)}


@cache
def meshed(name, backlash=0.0):
    make, first, second, phase, alpha, rounding = PAIRS[name]
    pair = make()
    rack = gears.Rack(np.deg2rad(alpha), rounding=rounding, backlash=backlash)
    return pair, gears.cut_gear(pair, 1, first, rack, phase), gears.cut_gear(pair, 2, second, rack, phase)


_POINTS = {}


def boundary(gear):
    """Points of the outline, made once per gear."""
    if id(gear) not in _POINTS:
        _POINTS[id(gear)] = gear, gear.outline(2e-8).points(2e-8)
    return _POINTS[id(gear)][1]


def overlap(pair, first, second, angle, play=0.0):
    """Area in module^2 common to both gears at a driver angle, the driven gear turned on by `play` [rad]."""
    driver = shapely.Polygon(place(boundary(first), (0, 0, angle)))
    driven = shapely.Polygon(place(boundary(second), (pair.centre_distance, 0, -float(pair.driven(angle)) - play)))
    return driver.intersection(driven).area / first.module**2


@pytest.mark.parametrize("name", PAIRS)
def test_gears_touch_and_do_not_overlap_through_a_turn(name):
    pair, first, second = meshed(name)
    assert first.module == pytest.approx(second.module, rel=1e-12)
    assert not first.undercut and not second.undercut and not first.pointed
    for angle in np.linspace(0.05, 2 * np.pi + 0.05, 9, endpoint=False):
        assert overlap(pair, first, second, angle) < 1e-7
        slight = 3e-3 * first.module / (0.5 * pair.centre_distance)  # moves a flank by 3e-3 modules
        for play in (slight, -slight):
            assert overlap(pair, first, second, angle, play) > 1e-4


def test_backlash_is_the_play_asked_for():
    """0.1 module of arc: the driven gear may turn by half of it either way, and not by more."""
    pair, first, second = meshed("pusher", 0.1)
    for angle in (0.4, 2.9):
        radius = float(pair.radii(angle)[1].d0) / np.cos(float(pair.tilt(angle)))
        half = 0.05 * first.module / radius
        for way in (1, -1):
            assert overlap(pair, first, second, angle, 0.85 * way * half) < 1e-7
            assert overlap(pair, first, second, angle, 1.3 * way * half) > 1e-4


def test_pitch_data_of_the_pusher():
    """semi_major 16.272 mm, minor/major 0.985: 21 teeth need module 1.538 mm."""
    from scipy.special import ellipe

    assert pusher().module(21) == pytest.approx(4 * 0.016272 * ellipe(ECCENTRICITY**2) / (21 * np.pi), rel=1e-12)
    assert pusher().module(21) == pytest.approx(1.5381e-3, abs=5e-8)


def test_congruent_gears_with_odd_teeth_are_one_and_the_same():
    """Both have a space at the short radius when the count is odd; with an even one the second has a tooth there."""
    _, first, second = meshed("pusher")
    one, other = shapely.Polygon(boundary(first)), shapely.Polygon(boundary(second))
    assert one.symmetric_difference(other).area < 1e-6 * one.area
    pair = gears.EllipticGearPair(0.1, 0.02)
    even = [shapely.Polygon(boundary(gears.cut_gear(pair, gear, 20))) for gear in (1, 2)]
    assert even[0].symmetric_difference(even[1]).area > 0.05 * even[0].area


def test_gears_scale_with_their_size():
    small = meshed("pusher")[1]
    large = gears.cut_gear(gears.EllipticGearPair(ECCENTRICITY, 16.272), 1, 21, small.family.rack)
    assert large.profile.area == pytest.approx(1e6 * small.profile.area, rel=1e-9)
    assert large.profile.perimeter == pytest.approx(1e3 * small.profile.perimeter, rel=1e-9)


def test_teeth_sit_on_the_pitch_curve():
    """Every flank crosses the pitch curve half a pitch of arc from the next, all around the eccentric gear."""
    pair, first, _ = meshed("pusher")
    family = first.family
    crossings = []
    for span in first.profile.spans:
        if span.piece.label.startswith("flank"):
            side = 1 if span.piece.label.endswith("+") else -1
            space = int(span.piece.label[6:-1])
            x = pair.arc_length.inverse(family.spaces[space] + side * np.pi / 4 * first.module)
            assert abs(span.piece.at(np.array([x])).d0[0] - pair.pitch_curve(1, np.array([x])).d0[0]) < 1e-13
            crossings.append(pair.arc_length(x))
    np.testing.assert_allclose(np.diff(np.sort(crossings)), np.pi / 2 * first.module, rtol=1e-10)
