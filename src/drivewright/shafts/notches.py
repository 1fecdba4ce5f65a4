"""Notches of a shaft: shoulders, grooves, holes, keyways, fits and splines, and by how much they raise the stress.

Two kinds of factors.  `stress_concentration` is elastic (Kt): local von Mises stress over that of the nominal stress.  Where no root radius
stands for the notch (keyways, fits, splines, retaining rings) the fatigue notch factor (Kf) was measured, and there is no Kt.
The nominal stress is that of the net section of `net_diameter`.
"""

import math
from functools import singledispatch
from typing import NamedTuple, TypeAlias

from drivewright.errors import InputError, UnknownName
from drivewright.materials import Strength

MM, MPA = 1e-3, 1e6
SHALLOWEST, BLUNTEST = 0.01, 0.3  # of a fillet's fit: step and radius over the smaller diameter
WIDEST_HOLE = 0.4  # of the shaft's diameter: beyond it there are no published factors

TIPTON = (
    "recalled: Tipton, Sorem and Rolovic, Updated stress concentration factors for filleted shafts in bending and tension, J. Mech. Des. "
    "118 (1996); within 2 % of finite elements in the tests"
)
DIN_743 = "DIN 743-2 as in the public program sydgtfzguhgfhtr/ME_Wellennachweis"
HOLES = "Peterson (tension) and Roark, table 17.1 (torsion) as at eng-calculations.com; bending recalled of Roark, table 17.1"


class SmoothPlace(NamedTuple):
    """A place [m] without a notch."""

    name: str
    position: float


class ShoulderFillet(NamedTuple):
    """A step from the `larger` to the `smaller` diameter [m] with a fillet of `radius` [m]; `assumed`: nobody gave the radius."""

    name: str
    position: float
    larger: float
    smaller: float
    radius: float
    assumed: bool = False


class RoundGroove(NamedTuple):
    """A groove all round with a round bottom: depth and radius [m].  An undercut beside a shoulder is one too."""

    name: str
    position: float
    depth: float
    radius: float


class RectangularGroove(NamedTuple):
    """A groove all round with a flat bottom, as of a retaining ring: depth, width and the radius of its corners [m]."""

    name: str
    position: float
    depth: float
    width: float
    radius: float


class CrossHole(NamedTuple):
    """A round hole through the axis and square to it: diameter [m]."""

    name: str
    position: float
    diameter: float


class Keyway(NamedTuple):
    """`keys` keyways from `position` on over `length` [m], cut by an end mill, with key and hub in place."""

    name: str
    position: float
    length: float = 0.0
    keys: int = 1


class PressFit(NamedTuple):
    """A hub pressed or shrunk on, from `position` on over `length` [m]."""

    name: str
    position: float
    length: float = 0.0


class Spline(NamedTuple):
    """A splined piece from `position` on over `length` [m]; form: "straight" flanks, "serrated" or "involute"."""

    name: str
    position: float
    length: float = 0.0
    form: str = "involute"


Notch: TypeAlias = SmoothPlace | ShoulderFillet | RoundGroove | RectangularGroove | CrossHole | Keyway | PressFit | Spline

KINDS = {
    SmoothPlace: "smooth",
    ShoulderFillet: "shoulder",
    RoundGroove: "round groove",
    RectangularGroove: "rectangular groove",
    CrossHole: "cross hole",
    Keyway: "keyway",
    PressFit: "press fit",
    Spline: "spline",
}


class NotchFactors(NamedTuple):
    """Factors [-] on the nominal stress in tension, bending and torsion, with the source of their formula."""

    tension: float
    bending: float
    torsion: float
    source: str


def kind_of(notch: Notch) -> str:
    """The kind of a notch in words."""
    return KINDS[type(notch)]


def net_diameter(notch: Notch, outer: float) -> float:
    """Outer diameter [m] of the section on which the nominal stress is reckoned; `outer` is that of the shaft beside the notch."""
    if isinstance(notch, ShoulderFillet):
        return notch.smaller
    return outer - 2 * notch.depth if isinstance(notch, RoundGroove | RectangularGroove) else outer


@singledispatch
def stress_concentration(notch: Notch, outer: float, bore: float) -> NotchFactors:
    """Kt [-] of a notch in a shaft of an outer diameter and a bore [m]; a smooth place has 1."""
    raise InputError(f"a {kind_of(notch)} has no elastic stress concentration factor here, but a measured fatigue notch factor")


@stress_concentration.register
def _(notch: SmoothPlace, outer: float, bore: float) -> NotchFactors:
    return NotchFactors(1.0, 1.0, 1.0, "nominal stress")


@stress_concentration.register
def _(notch: ShoulderFillet, outer: float, bore: float) -> NotchFactors:
    """`_fillet_factors`; of a step below 1 % of the diameter 1 + (those of 1 % - 1) sqrt(step/1 %).

    A bore makes a shoulder milder: the factors, of the solid shaft, are on the safe side.
    """
    _check_positive(notch, "radius", notch.radius)
    step, slenderness = notch.larger / notch.smaller - 1, min(notch.radius / notch.smaller, BLUNTEST)
    low = math.sqrt(min(step / SHALLOWEST, 1.0))
    tension, bending, torsion = (1 + low * (each - 1) for each in _fillet_factors(1 + max(step, SHALLOWEST), slenderness))
    return NotchFactors(tension, bending, torsion, TIPTON)


def _fillet_factors(ratio: float, slenderness: float) -> tuple[float, float, float]:
    """(tension, bending, torsion) with q = (D/d)^2 and s = r/d:

    0.493 + 0.48 q^-1.215 + s^-0.48 sqrt((3.43 - 3.41 q - 0.0232 q^2)/(1 - 8.85 q - 0.078 q^2)),
    0.632 + 0.377 q^-2.2 + s^-0.5 sqrt((-0.14 - 0.363 q + 0.503 q^2)/(1 - 2.39 q + 3.368 q^2)),
    0.78 + 0.2 q^-5 + s^-0.46 sqrt((0.002 - 0.125 q + 0.123 q^2)/(1 - 2.75 q + 2.55 q^2)).
    """
    q, s = ratio**2, slenderness
    tension = math.sqrt((3.43 - 3.41 * q - 0.0232 * q**2) / (1 - 8.85 * q - 0.078 * q**2))
    bending = math.sqrt((-0.14 - 0.363 * q + 0.503 * q**2) / (1 - 2.39 * q + 3.368 * q**2))
    torsion = math.sqrt((0.002 - 0.125 * q + 0.123 * q**2) / (1 - 2.75 * q + 2.55 * q**2))
    return (
        0.493 + 0.48 * q**-1.215 + s**-0.48 * tension,
        0.632 + 0.377 * q**-2.2 + s**-0.5 * bending,
        0.78 + 0.2 * q**-5 + s**-0.46 * torsion,
    )


@stress_concentration.register
def _(notch: RoundGroove, outer: float, bore: float) -> NotchFactors:
    """1 + 1/sqrt(A r/t + 2 B r/d (1 + 2 r/d)^2) with the depth t and the diameter d at the bottom."""
    _check_groove(notch, outer, bore)
    net = net_diameter(notch, outer)
    by_depth, by_net = notch.radius / notch.depth, notch.radius / net
    curved = 2 * by_net * (1 + 2 * by_net) ** 2
    tension, bending, torsion = (1 + 1 / math.sqrt(a * by_depth + b * curved) for a, b in ((0.22, 1.37), (0.2, 2.75), (0.7, 10.3)))
    return NotchFactors(tension, bending, torsion, DIN_743)


@stress_concentration.register
def _(notch: CrossHole, outer: float, bore: float) -> NotchFactors:
    """Polynomials in x = hole/D and m = bore/D on the gross section; in torsion the edge carries Kt tau in one direction: Kt/sqrt(3)."""
    x, m = notch.diameter / outer, bore / outer
    if not 0 < x <= WIDEST_HOLE:
        raise InputError(
            f"{notch.name}: a cross hole of {notch.diameter / MM:.4g} mm is {x:.2g} of the shaft's {outer / MM:.4g} mm; factors are "
            f"published above 0 and up to {WIDEST_HOLE:g}. Give the diameter of the hole, or make it smaller."
        )
    tension = _cubic(x, 3, 0.427 - 6.770 * m + 22.698 * m**2 - 16.670 * m**3, 11.357 + 15.665 * m - 60.929 * m**2 + 41.501 * m**3, 0)
    bending = _cubic(x, 3, -6.690 - 1.620 * m + 4.432 * m**2, 44.739 + 10.724 * m - 19.927 * m**2, -53.307 - 25.998 * m + 43.258 * m**2)
    torsion = _cubic(x, 4, -6.793 + 1.133 * m - 0.126 * m**2, 38.382 - 7.242 * m + 6.495 * m**2, -44.576 - 7.428 * m + 58.656 * m**2)
    return NotchFactors(tension, bending, torsion / math.sqrt(3), HOLES)


@singledispatch
def measured_factors(notch: Notch, outer: float, strength: Strength) -> NotchFactors | None:
    """Measured fatigue notch factors Kf [-] of a notch in a shaft of an outer diameter [m]; None of a notch that has Kt.

    Those in tension were not measured, and are taken as those in bending.
    """
    return None


@measured_factors.register
def _(notch: Keyway, outer: float, strength: Strength) -> NotchFactors:
    """3 (Rm/1000 MPa)^0.38 in bending and 0.56 times that + 0.1 in torsion, of 40 mm; 1.15 times that of two keyways."""
    bending = 3.0 * (strength.tensile / (1000 * MPA)) ** 0.38
    more = 1.15 if notch.keys > 1 else 1.0
    return _of_size(outer, 40 * MM, more * bending, more * bending, more * (0.56 * bending + 0.1))


@measured_factors.register
def _(notch: PressFit, outer: float, strength: Strength) -> NotchFactors:
    """2.7 (Rm/1000 MPa)^0.43 in bending and 0.65 times that + 0.1 in torsion, of 40 mm."""
    bending = 2.7 * (strength.tensile / (1000 * MPA)) ** 0.43
    return _of_size(outer, 40 * MM, bending, bending, 0.65 * bending + 0.1)


SPLINES = {"straight": (0.45, 1.0), "serrated": (0.65, 1.0), "involute": (0.49, 0.75)}  # shares in bending and torsion


@measured_factors.register
def _(notch: Spline, outer: float, strength: Strength) -> NotchFactors:
    """1 + share (exp(4.2e-7 (Rm/MPa)^2) - 1), of 29 mm."""
    if notch.form not in SPLINES:
        raise UnknownName("form of a spline", notch.form, SPLINES)
    excess = math.exp(4.2e-7 * (strength.tensile / MPA) ** 2) - 1
    bending, torsion = (1 + share * excess for share in SPLINES[notch.form])
    return _of_size(outer, 29 * MM, bending, bending, torsion)


@measured_factors.register
def _(notch: RectangularGroove, outer: float, strength: Strength) -> NotchFactors:
    """0.9 (1.27 + 1.17 g), 0.9 (1.14 + 1.08 g), 1.48 + 0.45 h of 30 mm; 1.08 (width/t)^-0.2 times that below a width of 1.4 t.

    g = sqrt(t/(r + 2.9 rho)) and h = sqrt(t/(r + rho)) with depth t, corner radius r and rho = 10^-(0.514 + 0.00152 Re/MPa) mm.
    """
    _check_groove(notch, outer, 0.0)
    _check_positive(notch, "width", notch.width)
    rho = MM * 10 ** -(0.514 + 0.00152 * strength.yield_strength / MPA)
    g, h = (math.sqrt(notch.depth / (notch.radius + share * rho)) for share in (2.9, 1.0))
    narrow = 1.08 * (notch.width / notch.depth) ** -0.2 if notch.width < 1.4 * notch.depth else 1.0
    tension, bending, torsion = 0.9 * (1.27 + 1.17 * g), 0.9 * (1.14 + 1.08 * g), 1.48 + 0.45 * h
    return _of_size(net_diameter(notch, outer), 30 * MM, narrow * tension, narrow * bending, narrow * torsion)


def root_radius(notch: Notch) -> float | None:
    """Radius [m] of the root of a notch that has Kt; None of a smooth place."""
    return notch.diameter / 2 if isinstance(notch, CrossHole) else getattr(notch, "radius", None)


def _of_size(diameter: float, measured: float, tension: float, bending: float, torsion: float) -> NotchFactors:
    """Factors measured on one diameter [m] carried over to another one: K3(measured)/K3(diameter) times as large."""

    def converted(factor: float) -> float:
        return max(factor * _size_effect(measured, factor) / _size_effect(diameter, factor), 1.0)

    return NotchFactors(converted(tension), converted(bending), converted(torsion), DIN_743)


def _size_effect(diameter: float, factor: float) -> float:
    """K3 = 1 - 0.2 lg(factor) lg(d/7.5 mm)/lg 20, from 7.5 mm to 150 mm."""
    size = min(max(diameter / (7.5 * MM), 1.0), 20.0)
    return 1 - 0.2 * math.log10(factor) * math.log10(size) / math.log10(20)


def _cubic(x: float, *coefficients: float) -> float:
    return sum(c * x**power for power, c in enumerate(coefficients))


def _check_positive(notch: Notch, key: str, value: float) -> None:
    if not value > 0:
        raise InputError(f"{notch.name}: the {key} of a {kind_of(notch)} must be above 0, got {value / MM:.4g} mm.")


def _check_groove(notch: RoundGroove | RectangularGroove, outer: float, bore: float) -> None:
    _check_positive(notch, "radius", notch.radius)
    _check_positive(notch, "depth", notch.depth)
    if not net_diameter(notch, outer) > bore:
        raise InputError(
            f"{notch.name}: a groove {notch.depth / MM:.4g} mm deep leaves nothing of a shaft of {outer / MM:.4g} mm with a bore of "
            f"{bore / MM:.4g} mm; make it shallower than {(outer - bore) / 2 / MM:.4g} mm."
        )
