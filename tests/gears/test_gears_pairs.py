"""Rolling pairs against the geometry of the ellipse, closed forms of arc length, and each other."""

import numpy as np
import pytest
from scipy.special import ellipe

from drivewright import gears
from drivewright.errors import InputError
from drivewright.numerics import jets

pytestmark = pytest.mark.analytical

PI = np.pi
X = np.linspace(-7.3, 20.1, 173)


def test_the_contract():
    pair = gears.EllipticGearPair(eccentricity=0.3)
    np.testing.assert_allclose(pair.driven(np.array([0.0, PI, -PI, 4 * PI])), [0, PI, -PI, 4 * PI], atol=1e-15)
    assert pair.driven(PI / 2) == pytest.approx(2 * np.arctan(0.7 / 1.3), rel=1e-15)
    assert pair.ratio(0.0) == pytest.approx(0.7 / 1.3) and pair.ratio(PI) == pytest.approx(1.3 / 0.7)


@pytest.mark.parametrize("start", ["near", "far"])
def test_the_focal_radii_in_contact_fill_the_centre_distance(start):
    """r = a (1 - e^2)/(1 + e cos x) from the short radius on; the driven ellipse begins with its other radius."""
    e, a = 0.3, 0.02
    pair = gears.EllipticGearPair(e, a, start)
    sign = 1 if start == "near" else -1
    driver = a * (1 - e**2) / (1 + sign * e * np.cos(X))
    driven = a * (1 - e**2) / (1 - sign * e * np.cos(pair.driven(X)))
    np.testing.assert_allclose(driver + driven, 2 * a, rtol=1e-14)
    np.testing.assert_allclose(pair.ratio(X), driver / driven, rtol=1e-13)
    np.testing.assert_allclose(pair.radii(X)[0].d0, driver, rtol=1e-13)
    np.testing.assert_allclose(pair.radii(X)[1].d0, driven, rtol=1e-13)


def test_derivatives_are_those_of_the_half_angle_formula():
    pair, x = gears.EllipticGearPair(0.3), jets.variable(X)
    r = 0.7 / 1.3
    formula = 2 * jets.atan2(r * jets.sin(0.5 * x), jets.cos(0.5 * x))
    for ours, theirs in zip(list(pair.jet(X))[1:], list(formula)[1:], strict=True):
        np.testing.assert_allclose(ours, theirs, rtol=1e-11, atol=1e-13)


def test_driven_angle_is_continuous_and_periodic_over_many_turns():
    pair = gears.EllipticGearPair(0.6)
    fine = np.linspace(-40, 40, 40001)
    assert np.max(np.diff(pair.driven(fine))) < 0.002 * pair.ratio(PI) * 1.001 and np.min(np.diff(pair.driven(fine))) > 0
    np.testing.assert_allclose(pair.driven(X + 6 * PI) - 6 * PI, pair.driven(X), atol=1e-13)


def test_far_undoes_near_and_jets_follow_the_chain_rule():
    near, far = gears.EllipticGearPair(0.4), gears.EllipticGearPair(0.4, start="far")
    back = far.jet(near.jet(jets.variable(X)))
    for ours, theirs in zip(back, (X, 1.0, 0.0, 0.0), strict=True):
        np.testing.assert_allclose(ours, theirs * np.ones_like(X), atol=2e-12)


def test_eccentricity_zero_is_a_pair_of_circles():
    pair = gears.EllipticGearPair(0.0, 0.03)
    np.testing.assert_allclose(pair.driven(X), X, rtol=1e-15, atol=1e-15)
    assert pair.perimeter() == pytest.approx(2 * PI * 0.03, rel=1e-14)


def test_lengths_and_curvature_of_the_ellipse():
    e, a = 0.55, 0.02
    pair = gears.EllipticGearPair(e, a)
    b = a * np.sqrt(1 - e**2)
    assert pair.centre_distance == 0.04
    for gear in (1, 2):
        assert pair.perimeter(gear) == pytest.approx(4 * a * ellipe(e**2), rel=1e-13)
        place, least = pair.min_curvature(gear)
        assert least == pytest.approx(b / a**2, rel=1e-4)
        assert pair.curvature(gear, np.array([0.0]))[0] == pytest.approx(a / b**2, rel=1e-12)
    assert np.cos(place) == pytest.approx(-e, abs=0.02) or np.cos(place) == pytest.approx(e, abs=0.6)
    assert pair.teeth(pair.module(21)) == pytest.approx(21, rel=1e-15)
    assert pair.module(21) == pytest.approx(4 * a * ellipe(e**2) / (21 * PI), rel=1e-13)


def ellipse_ratio(e):
    r = (1 - e) / (1 + e)
    return lambda x: r / (0.5 * (1 + r**2) + 0.5 * (1 - r**2) * jets.cos(x))


def test_twin_the_general_pair_with_the_ratio_of_the_ellipse():
    e, a = 0.3, 0.016272
    ellipse, twin = gears.EllipticGearPair(e, a), gears.NonCircularPair(ellipse_ratio(e), 2 * a)
    for ours, theirs in zip(twin.jet(X), ellipse.jet(X), strict=True):
        np.testing.assert_allclose(ours, theirs, rtol=1e-10, atol=1e-10)
    for gear in (1, 2):
        np.testing.assert_allclose(twin.pitch_curve(gear, X).d0, ellipse.pitch_curve(gear, X).d0, rtol=1e-10)
        assert twin.perimeter(gear) == pytest.approx(ellipse.perimeter(gear), rel=1e-10)


def two_to_three():
    """Driver with 2 lobes, driven gear with 3: mean ratio 2/3."""
    return gears.NonCircularPair(lambda x: (2 / 3) * (1 + 0.15 * jets.cos(2 * x) + 0.04 * jets.sin(4 * x)), 0.1)


def test_driven_angle_is_the_integral_of_the_ratio():
    expected = (2 / 3) * (X + 0.075 * np.sin(2 * X) + 0.01 * (1 - np.cos(4 * X)))
    np.testing.assert_allclose(two_to_three().driven(X), expected, rtol=1e-13, atol=1e-13)
    assert two_to_three().lobes == (2, 3)


def test_the_pitch_curves_roll_without_sliding_and_close():
    """Arc lengths from both curves, each by its own derivative; contact points meet; both curves close after their own turn."""
    pair = two_to_three()
    first, second = pair.pitch_curve(1, X), pair.pitch_curve(2, X)
    np.testing.assert_allclose(np.abs(first.d1), np.abs(second.d1), rtol=1e-13)
    np.testing.assert_allclose(first.d0 * np.exp(1j * X), 0.1 + second.d0 * np.exp(-1j * pair.driven(X)), rtol=1e-13)
    np.testing.assert_allclose(first.d1 * np.exp(1j * X), second.d1 * np.exp(-1j * pair.driven(X)), rtol=1e-12)
    np.testing.assert_allclose(pair.pitch_curve(1, X + 2 * PI).d0, first.d0, rtol=1e-12)
    np.testing.assert_allclose(pair.pitch_curve(2, X + 3 * PI).d0, second.d0, rtol=1e-12)
    assert pair.perimeter(2) == pytest.approx(1.5 * pair.perimeter(1), rel=1e-15)
    fine = np.linspace(0, 3 * PI, 60001)
    length = np.sum(np.abs(np.diff(pair.pitch_curve(2, fine).d0)))
    assert length == pytest.approx(pair.perimeter(2), rel=1e-7)
    np.testing.assert_allclose(pair.arc_length.inverse(pair.arc_length(X)), X, atol=1e-12)


def test_convexity_is_measured_on_each_curve():
    """A single gear r1 with swing: the 3-lobed driven gear goes hollow first; the sign is positive for a convex curve."""
    mild = two_to_three()
    assert mild.min_curvature(1)[1] > 0
    strong = gears.NonCircularPair(lambda x: 1 + 0.5 * jets.cos(3 * x), 0.1)
    place, least = strong.min_curvature(1)
    z = strong.pitch_curve(1, place + np.array([-1e-3, 0.0, 1e-3])).d0
    turn = -np.angle((z[2] - z[1]) / (z[1] - z[0])) / np.abs(z[1] - z[0])
    assert least < 0 and turn == pytest.approx(least, rel=1e-3)


def test_tilt_is_the_direction_of_the_common_tangent():
    pair = two_to_three()
    tangent = pair.pitch_curve(1, X).d1 * np.exp(1j * X)
    np.testing.assert_allclose(np.angle(-tangent / 1j), pair.tilt(X), atol=1e-13)
    assert np.max(pair.tilt(X)) > 0.1


def test_size_scales_and_angles_do_not():
    small, large = gears.EllipticGearPair(0.3, 0.02), gears.EllipticGearPair(0.3, 20.0)
    np.testing.assert_allclose(large.pitch_curve(1, X).d0, 1e3 * small.pitch_curve(1, X).d0, rtol=1e-14)
    np.testing.assert_array_equal(large.driven(X), small.driven(X))
    assert large.perimeter() == pytest.approx(1e3 * small.perimeter(), rel=1e-14)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: gears.EllipticGearPair(1.0), "eccentricity = 1; an ellipse needs 0 <= e < 1"),
        (lambda: gears.EllipticGearPair(-0.1), "eccentricity = -0.1"),
        (lambda: gears.EllipticGearPair(float("nan")), "eccentricity = nan"),
        (lambda: gears.EllipticGearPair(0.3, start="left"), "start = 'left'; it is 'near'"),
        (lambda: gears.EllipticGearPair(0.3, -1.0), "semi_major = -1 m; it must be positive"),
        (lambda: gears.EllipticGearPair(0.3).perimeter(), "give semi_major"),
        (
            lambda: gears.NonCircularPair(lambda x: 0.68 + 0.1 * jets.cos(x), 0.1),
            r"mean ratio is 0.68; the nearest fraction .* is 2/3, .* fails to close by 7.2°. Multiply the ratio by 0.980392157",
        ),
        (lambda: gears.NonCircularPair(lambda x: 2 / 3 + 0.1 * jets.cos(x), 0.1), r"does not repeat after 180° .* mean ratio of 2/3"),
        (lambda: gears.NonCircularPair(lambda x: 1 + 0.1 * jets.cos(0.5 * x), 0.1), "does not repeat after 360°"),
        (lambda: gears.NonCircularPair(lambda x: 1 + 1.1 * jets.cos(x), 0.1), "ratio = -0.1 at driver angle 180°"),
        (lambda: gears.NonCircularPair(lambda x: 1.0, 0.0), "centre_distance = 0 m"),
    ],
)
def test_messages(make, message):
    with pytest.raises(InputError, match=message):
        make()
