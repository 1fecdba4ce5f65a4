"""Hertz contact of elastic bodies, long lines and ellipses; any arrays that broadcast, SI units.

Smooth bodies, contact small against their radii, no friction.
Source of all formulas: Johnson, Contact Mechanics (1985), chapters 4 and 5, recalled.  The tests check them by integrating
the displacements and strains that the pressure causes.
"""

from typing import NamedTuple

import numpy as np
import scipy

from drivewright._typing import Floats, Numbers
from drivewright.errors import InputError
from drivewright.numerics.roots import extremes


class LineContact(NamedTuple):
    """half_width b [m], peak pressure p0 [Pa]."""

    half_width: Numbers
    pressure: Numbers


class PointContact(NamedTuple):
    """Semi-axes a >= b [m] of the contact ellipse, a along the larger relative radius; peak pressure p0 [Pa]; approach [m]."""

    major: Numbers
    minor: Numbers
    pressure: Numbers
    approach: Numbers


def effective_modulus(modulus1: Numbers, poisson1: Numbers, modulus2: Numbers, poisson2: Numbers) -> Numbers:
    """E*: 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2  [Pa]."""
    return 1.0 / ((1 - np.square(poisson1)) / modulus1 + (1 - np.square(poisson2)) / modulus2)


def effective_radius(radius1: Numbers, radius2: Numbers) -> Numbers:
    """R: 1/R = 1/R1 + 1/R2  [m].  A concave radius is negative, a plane is inf.

    Raises InputError where the hollow is not wider than the body in it: there is no small contact.
    """
    curvature = 1.0 / np.asarray(radius1, dtype=float) + 1.0 / np.asarray(radius2, dtype=float)
    if np.any(curvature <= 0):
        raise InputError(
            f"contact: radii {radius1} and {radius2} m give the relative curvature {np.min(curvature):.4g} 1/m, which must be above 0. "
            "Convex radii are positive, concave ones negative and larger in size than the body in the hollow."
        )
    return 1.0 / curvature


# ---------------------------------------------------------------------------------------------------------------- line


def line_contact(force: Numbers, length: Numbers, radius: Numbers, modulus: Numbers) -> LineContact:
    """Parallel cylinders: b = sqrt(4 F R/(pi L E*)),  p0 = sqrt(F E*/(pi L R)).

    force [N], length [m], effective radius R [m], effective modulus E* [Pa].
    """
    load = np.asarray(force) / length
    return LineContact(np.sqrt(4 * load * radius / (np.pi * modulus)), np.sqrt(load * modulus / (np.pi * radius)))


def line_shear(depth: Numbers) -> Floats:
    """Greatest shear stress over p0 below the middle of a line contact: |z - z^2/sqrt(1 + z^2)|, z = depth/b.

    Half the difference of the stresses across and normal to the surface; the third one lies between them near the peak.
    """
    depth = np.asarray(depth, dtype=float)
    return depth - depth**2 / np.sqrt(1 + depth**2)


def line_greatest_shear() -> tuple[float, float]:
    """(depth/b, shear/p0) of the peak of `line_shear`, where fatigue of a rolling line contact begins: 0.786, 0.300."""
    _, _, depth, shear = extremes(line_shear, 0.0, 4.0)
    return depth, shear


def cylinder_compression(
    force: Numbers, length: Numbers, half_width: Numbers, radius: Numbers, modulus: Numbers, poisson: Numbers
) -> Numbers:
    """How far a line contact comes nearer to the axis of ONE solid cylinder: F/L (1 - nu^2)/(pi E) (2 ln(4 R/b) - 1)  [m].

    The cylinder has its own radius R, E and nu, and is held by the opposite side.  The approach of two cylinders is the sum.
    Unlike that of a point contact it depends on the whole body: for another shape the logarithm is another.
    """
    return np.asarray(force) / length * (1 - np.square(poisson)) / (np.pi * modulus) * (2 * np.log(4 * radius / half_width) - 1)


# --------------------------------------------------------------------------------------------------------------- point


def relative_radii(radii1: tuple[Numbers, Numbers], radii2: tuple[Numbers, Numbers], angle: Numbers = 0.0) -> tuple[Floats, Floats]:
    """The principal relative radii (R', R''), R' >= R'', of two bodies that touch at a point  [m].

    radii1 = (R1', R1''), radii2 likewise: principal radii of each, concave negative, plane inf; `angle` [rad] between the
    directions of R1' and R2'.  The gap is x^2/(2R') + y^2/(2R'').  Raises InputError where it closes along a line or deeper.
    """
    (k1, l1), (k2, l2) = (tuple(1.0 / np.asarray(r, dtype=float) for r in radii) for radii in (radii1, radii2))
    total = k1 + l1 + k2 + l2
    d1, d2 = k1 - l1, k2 - l2
    difference = np.sqrt(np.maximum(d1**2 + d2**2 + 2 * d1 * d2 * np.cos(2 * angle), 0.0))
    low, high = 0.5 * (total - difference), 0.5 * (total + difference)
    if np.any(low <= 1e-12 * np.abs(high)):
        raise InputError(
            f"contact: radii {radii1} and {radii2} m give the smallest relative curvature {np.min(low):.4g} 1/m, which must be above 0. "
            "For 0 use line_contact; below 0 the bodies touch at more than one place."
        )
    return 1.0 / low, 1.0 / high


def point_contact(force: Numbers, radii: tuple[Numbers, Numbers], modulus: Numbers) -> PointContact:
    """Contact ellipse, pressure and approach of two bodies with the principal relative radii (R', R''), R' >= R''.

    With the ratio of axes x = b/a from  R'/R'' = R_D(0, 1, x^2)/R_D(0, x^2, 1):
    a^3 = F R' R_D(0, x^2, 1)/(pi E*),  p0 = 3F/(2 pi a b),  approach = 3F K/(2 pi a E*).
    The integrals are (K - E)/e^2 and (E - (1 - e^2)K)/e^2 in Carlson's form, which stays exact for a circle (e = 0).
    """
    larger, smaller = np.asarray(radii[0], dtype=float), np.asarray(radii[1], dtype=float)
    ratio = axis_ratio(larger / smaller)
    major = np.cbrt(force * larger * scipy.special.elliprd(0, ratio**2, 1) / (np.pi * modulus))
    pressure = 1.5 * force / (np.pi * major**2 * ratio)
    return PointContact(major, ratio * major, pressure, 1.5 * force * scipy.special.ellipkm1(ratio**2) / (np.pi * major * modulus))


def point_constant(radii: tuple[Numbers, Numbers], modulus: Numbers) -> Numbers:
    """k of force = k approach^(3/2)  [N/m^1.5]; 4/3 E* sqrt(R) for a sphere."""
    return point_contact(1.0, radii, modulus).approach ** -1.5


def axis_ratio(radius_ratio: Numbers) -> Floats:
    """b/a, in (0, 1], of the contact ellipse for R'/R'' >= 1, by bisection of its logarithm."""
    wanted = np.asarray(radius_ratio, dtype=float)
    if not np.all(wanted >= 1):
        raise InputError(f"contact: the ratio of relative radii R'/R'' is {np.min(wanted):.4g}, below 1; name the larger radius first.")
    low, high = -np.log(wanted), np.zeros_like(wanted)  # R''/R' <= b/a <= 1
    for _ in range(60):
        middle = 0.5 * (low + high)
        square = np.exp(2 * middle)
        too_round = scipy.special.elliprd(0, 1, square) < wanted * scipy.special.elliprd(0, square, 1)
        low, high = np.where(too_round, low, middle), np.where(too_round, middle, high)
    return np.exp(high)
