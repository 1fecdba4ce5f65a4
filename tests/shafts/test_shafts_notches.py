"""Notch factors of shafts: limits, published numbers, scaling, and what is refused."""

import math

import pytest
from shaft_steel import STEEL

from drivewright.errors import InputError, UnknownName
from drivewright.shafts.notches import (
    CrossHole,
    Keyway,
    PressFit,
    RectangularGroove,
    RoundGroove,
    ShoulderFillet,
    SmoothPlace,
    Spline,
    kind_of,
    measured_factors,
    net_diameter,
    root_radius,
    stress_concentration,
)

pytestmark = pytest.mark.analytical

MM = 1e-3


def shoulder(larger, smaller, radius):
    return ShoulderFillet("step", 0.1, larger * MM, smaller * MM, radius * MM)


def kt(notch, outer=0.05, bore=0.0):
    return stress_concentration(notch, outer, bore)[:3]


# -- shoulders -----------------------------------------------------------------------------------------------------------------


@pytest.mark.property
@pytest.mark.parametrize("radius", [0.5, 2.0, 8.0])
def test_a_vanishing_step_raises_nothing(radius):
    small_steps = [kt(shoulder(40 * (1 + step), 40, radius)) for step in (1e-2, 1e-4, 1e-6, 1e-12)]
    for earlier, later in zip(small_steps, small_steps[1:], strict=False):
        assert all(a >= b >= 1 for a, b in zip(earlier, later, strict=True))
    assert small_steps[-1] == pytest.approx((1, 1, 1), abs=1e-4)
    assert small_steps[0] == pytest.approx(kt(shoulder(40 * 1.01 - 1e-9, 40, radius)), rel=1e-6)  # both formulas meet


@pytest.mark.property
def test_a_larger_fillet_is_milder_and_a_higher_step_worse():
    by_radius = [kt(shoulder(60, 40, radius)) for radius in (0.1, 0.4, 1, 4, 10)]
    by_height = [kt(shoulder(40 * ratio, 40, 1)) for ratio in (1.01, 1.03, 1.1, 1.3, 2.0)]
    for better, worse in [*zip(by_radius[1:], by_radius, strict=False), *zip(by_height, by_height[1:], strict=False)]:
        assert all(a < b for a, b in zip(better, worse, strict=True))
    assert kt(shoulder(60, 40, 12.0)) == kt(shoulder(60, 40, 30.0))  # the fit ends at 0.3 d
    tension, bending, torsion = by_radius[2]
    assert tension > bending > torsion > 1


ROARK_BENDING = (  # table 17.1, square shoulder with fillet in bending, h/r from 2 to 20, as at eng-calculations.com
    (1.225, 0.831, -0.010),
    (-3.790, 0.958, -0.257),
    (7.374, -4.834, 0.862),
    (-3.809, 3.046, -0.595),
)


@pytest.mark.parametrize("larger, radius", [(1.2, 0.05), (1.5, 0.1), (2.0, 0.2)])
def test_photoelastic_fits_lie_a_little_below(larger, radius):
    ratio, share = (larger - 1) / 2 / radius, (larger - 1) / larger
    roark = sum((a + b * ratio**0.5 + c * ratio) * share**n for n, (a, b, c) in enumerate(ROARK_BENDING))
    assert 0.92 < roark / kt(shoulder(40 * larger, 40, 40 * radius))[1] < 1.0


# -- grooves and holes ---------------------------------------------------------------------------------------------------------


@pytest.mark.property
def test_a_groove_ends_at_a_smooth_bar_and_at_the_deep_groove_in_a_half_space():
    assert kt(RoundGroove("g", 0.1, 1e-12, 2 * MM)) == pytest.approx((1, 1, 1), abs=1e-4)
    sharp = kt(RoundGroove("g", 0.1, 1e-3 * MM, 1e-3 * MM), outer=1.0)  # a half circle in the surface of a half space
    assert sharp == pytest.approx((1 + 1 / 0.22**0.5, 1 + 1 / 0.2**0.5, 1 + 1 / 0.7**0.5), rel=1e-3)
    assert sharp == pytest.approx((3.065, 3.065, 2.0), rel=0.1)  # Peterson: 3.065; in torsion a half circle has 2 exactly


def test_a_round_groove_by_hand():
    # r/t = 0.5 and r/d = 0.05: 2 r/d (1 + 2 r/d)^2 = 0.121
    expected = 1 + 0.27577**-0.5, 1 + 0.43275**-0.5, 1 + 1.5963**-0.5
    assert kt(RoundGroove("g", 0.1, 4 * MM, 2 * MM), outer=0.048) == pytest.approx(expected, rel=1e-9)


@pytest.mark.property
@pytest.mark.parametrize("bore", [0.0, 0.5])
def test_a_small_cross_hole_is_one_in_a_plate(bore):
    tension, bending, torsion = kt(CrossHole("h", 0.1, 1e-9), bore=bore * 0.05)
    assert (tension, bending, torsion) == pytest.approx((3, 3, 4 / math.sqrt(3)), rel=1e-6)


def test_cross_hole_of_a_published_calculation():
    # amesweb, Transverse circular hole in a round bar: D = 100 mm, d = 80 mm, r = 5 mm; 3.16, 4.92/1.73, 3.76 on the shear stress
    tension, bending, torsion = kt(CrossHole("h", 0.1, 10 * MM), outer=0.1, bore=0.08)
    assert (tension, bending, torsion * math.sqrt(3)) == pytest.approx((3.16, 4.92 / 1.73, 3.76), abs=0.005)


def test_cross_hole_of_a_solid_shaft():
    x = 0.25
    expected = (3 + 0.427 * x + 11.357 * x**2, 3 - 6.690 * x + 44.739 * x**2 - 53.307 * x**3)
    assert kt(CrossHole("h", 0.1, 10 * MM), outer=0.04)[:2] == pytest.approx(expected)


POLYNOMIALS = (  # rows: powers of hole/D; columns: powers of bore/D; as printed at eng-calculations.com, bending recalled
    ((3,), (0.427, -6.770, 22.698, -16.670), (11.357, 15.665, -60.929, 41.501)),
    ((3,), (-6.690, -1.620, 4.432), (44.739, 10.724, -19.927), (-53.307, -25.998, 43.258)),
    ((4,), (-6.793, 1.133, -0.126), (38.382, -7.242, 6.495), (-44.576, -7.428, 58.656)),
)


def test_cross_holes_of_tubes():
    x, m = 0.4, 0.9
    printed = [sum(c * x**i * m**j for i, row in enumerate(rows) for j, c in enumerate(row)) for rows in POLYNOMIALS]
    tension, bending, torsion = kt(CrossHole("h", 0.1, 20 * MM), outer=0.05, bore=0.045)
    assert (tension, bending, torsion * math.sqrt(3)) == pytest.approx(printed, rel=1e-12)


# -- measured factors ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "notch, outer, expected",
    [
        (Keyway("k", 0.1), 0.04, (3.0, 3.0, 1.78)),
        (Keyway("k", 0.1, keys=2), 0.04, (3.45, 3.45, 1.15 * 1.78)),
        (PressFit("p", 0.1), 0.04, (2.7, 2.7, 1.855)),
        (Spline("s", 0.1, form="straight"), 0.029, (1 + 0.45 * 0.52196, 1 + 0.45 * 0.52196, 1.52196)),
        (Spline("s", 0.1, form="serrated"), 0.029, (1 + 0.65 * 0.52196, 1 + 0.65 * 0.52196, 1.52196)),
        (Spline("s", 0.1), 0.029, (1 + 0.49 * 0.52196, 1 + 0.49 * 0.52196, 1 + 0.75 * 0.52196)),
    ],
)
def test_measured_factors_at_the_diameter_they_were_measured_at(notch, outer, expected):
    assert measured_factors(notch, outer, STEEL)[:3] == pytest.approx(expected, rel=1e-5)


def test_measured_factors_follow_the_tensile_strength():
    weak = STEEL._replace(tensile=500e6)
    assert measured_factors(Keyway("k", 0.1), 0.04, weak).bending == pytest.approx(3 * 0.5**0.38)
    assert measured_factors(PressFit("p", 0.1), 0.04, weak).bending == pytest.approx(2.7 * 0.5**0.43)
    assert measured_factors(Spline("s", 0.1, form="straight"), 0.029, weak).torsion == pytest.approx(math.exp(0.105))


def test_measured_factors_on_other_diameters():
    small, usual, large, huge = (measured_factors(Keyway("k", 0.1), d, STEEL).bending for d in (0.0075, 0.04, 0.15, 0.3))
    effect = 0.2 * math.log10(3.0)
    assert small == pytest.approx(3 * (1 - effect * math.log10(40 / 7.5) / math.log10(20)))
    assert large == pytest.approx(small / (1 - effect)) and huge == large and small < usual < large


def test_a_retaining_ring_groove_by_hand():
    # 30 mm at the bottom, 1.3 mm deep, 0.2 mm radius, Re = 500 MPa: rho = 10^-(0.514 + 0.76) = 0.053211 mm
    groove = RectangularGroove("g", 0.1, 1.3 * MM, 2.0 * MM, 0.2 * MM)
    g, h = math.sqrt(1.3 / (0.2 + 2.9 * 0.053211)), math.sqrt(1.3 / 0.253211)
    expected = (0.9 * (1.27 + 1.17 * g), 0.9 * (1.14 + 1.08 * g), 1.48 + 0.45 * h)
    strength = STEEL._replace(yield_strength=500e6)
    assert measured_factors(groove, 0.0326, strength)[:3] == pytest.approx(expected, rel=1e-5)
    narrow = measured_factors(groove._replace(width=1.04 * MM), 0.0326, strength)[:3]
    assert narrow == pytest.approx([1.08 * 0.8**-0.2 * each for each in expected], rel=1e-5)
    assert measured_factors(groove._replace(width=1.85 * MM), 0.0326, strength)[:3] == pytest.approx(expected, rel=1e-5)
    assert measured_factors(groove._replace(width=1.79 * MM), 0.0326, strength)[:3] != pytest.approx(expected, rel=1e-5)


# -- all of them ---------------------------------------------------------------------------------------------------------------

ELASTIC = [shoulder(50, 40, 1), RoundGroove("g", 0.1, 2 * MM, 1 * MM), CrossHole("h", 0.1, 8 * MM), SmoothPlace("s", 0.1)]
MEASURED = [Keyway("k", 0.1), PressFit("p", 0.1), Spline("t", 0.1), RectangularGroove("r", 0.1, 1 * MM, 2 * MM, 0.2 * MM)]


def scaled(notch, factor):
    lengths = {key: value * factor for key, value in notch._asdict().items() if isinstance(value, float)}
    return notch._replace(**lengths)


@pytest.mark.property
@pytest.mark.parametrize("notch", ELASTIC, ids=kind_of)
def test_elastic_factors_know_no_metre(notch):
    assert kt(scaled(notch, 7.0), 7 * 0.05, 7 * 0.01) == pytest.approx(kt(notch, 0.05, 0.01), rel=1e-12)


def test_a_smooth_place_has_no_factor():
    assert kt(SmoothPlace("s", 0.1)) == (1, 1, 1) and measured_factors(SmoothPlace("s", 0.1), 0.05, STEEL) is None


def test_the_net_section_and_the_root():
    assert [net_diameter(notch, 0.05) for notch in ELASTIC] == pytest.approx([0.04, 0.046, 0.05, 0.05])
    assert [net_diameter(notch, 0.05) for notch in MEASURED] == pytest.approx([0.05, 0.05, 0.05, 0.048])
    assert [root_radius(notch) for notch in ELASTIC] == pytest.approx([1 * MM, 1 * MM, 4 * MM, None])


@pytest.mark.parametrize("notch", [*ELASTIC, *MEASURED], ids=kind_of)
def test_a_notch_has_factors_of_one_of_the_two_kinds(notch):
    measured = measured_factors(notch, 0.05, STEEL)
    assert (measured is not None) == (notch in MEASURED)
    if measured:
        with pytest.raises(InputError, match=f"a {kind_of(notch)} has no elastic stress concentration factor"):
            stress_concentration(notch, 0.05, 0.0)
    assert len((measured or stress_concentration(notch, 0.05, 0.0)).source) > 10


# -- what is refused -----------------------------------------------------------------------------------------------------------


@pytest.mark.error
@pytest.mark.parametrize(
    "notch, message",
    [
        (shoulder(50, 40, 0), r"^step: the radius of a shoulder must be above 0, got 0 mm\.$"),
        (RoundGroove("g", 0.1, 1 * MM, 0.0), r"^g: the radius of a round groove must be above 0"),
        (RoundGroove("g", 0.1, 0.0, 1 * MM), r"^g: the depth of a round groove must be above 0"),
        (RoundGroove("g", 0.1, 21 * MM, 1 * MM), r"a groove 21 mm deep leaves nothing of a shaft of 50 mm with a bore of 10 mm.* 20 mm"),
        (CrossHole("pin", 0.1, 21 * MM), r"^pin: a cross hole of 21 mm is 0\.42 of the shaft's 50 mm; .* up to 0\.4\."),
        (CrossHole("pin", 0.1, 0.0), r"^pin: a cross hole of 0 mm"),
    ],
)
def test_impossible_notches_are_refused(notch, message):
    with pytest.raises(InputError, match=message):
        stress_concentration(notch, 0.05, 0.01)


@pytest.mark.error
def test_impossible_measured_notches_are_refused():
    with pytest.raises(UnknownName, match=r"no form of a spline is called 'involut' \(did you mean 'involute'\?\)"):
        measured_factors(Spline("s", 0.1, form="involut"), 0.05, STEEL)
    for key in ("depth", "width", "radius"):
        with pytest.raises(InputError, match=f"the {key} of a rectangular groove must be above 0"):
            measured_factors(MEASURED[3]._replace(**{key: 0.0}), 0.05, STEEL)
