"""Rolling pins pressed on each other along a line: the stresses below the surface, first yield and shakedown.

Hypotheses: long smooth cylinders, elastic, free rolling without traction, plane strain.  z points into the material, x along the
surface, both over the half width b; stresses over the peak pressure p0.
"""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Complexes, Numbers
from drivewright.contact import hertz
from drivewright.errors import InputError, UnknownName
from drivewright.numerics.roots import extremes

YIELD = {"tresca": 0.5, "mises": 1 / np.sqrt(3)}  # yield stress in shear k over that in tension

REVERSAL = 0.25  # greatest |sxz|/p0, at x = sqrt(3)/2, z = 1/2: the shear that changes sign as the contact rolls by


class RollingContact(NamedTuple):
    """pressure p0 [Pa], half_width b [m], shear [Pa]: the greatest below the surface, and the depth [m] where it is."""

    pressure: Numbers
    half_width: Numbers
    shear: Numbers
    depth: Numbers


class PressureLimits(NamedTuple):
    """Peak pressures [Pa] of a rolling line contact.

    first_yield: below it nothing ever yields.  shakedown: below it what yields at first leaves stresses under which nothing yields
    again; above it every pass adds plastic shear.
    """

    first_yield: float
    shakedown: float


def rolling_contact(force: Numbers, width: Numbers, radii: tuple[Numbers, Numbers], modulus: float, poisson: float) -> RollingContact:
    """Hertz line contact of two like pins: force [N] over the width [m], radii (R1, R2) [m], both with the same modulus [Pa].

    1/R = 1/R1 + 1/R2,  E* = E/(2(1 - nu^2)),  p0 = sqrt(F E*/(pi L R)),  greatest shear 0.300 p0 at the depth 0.786 b.
    """
    radius = hertz.effective_radius(*radii)
    found = hertz.line_contact(force, width, radius, hertz.effective_modulus(modulus, poisson, modulus, poisson))
    depth, shear = hertz.line_greatest_shear()
    return RollingContact(found.pressure, found.half_width, shear * found.pressure, depth * found.half_width)


def line_stresses(x: Numbers, z: Numbers) -> tuple[Numbers, ...]:
    """(sx, sz, sxz)/p0 at x, z >= 0 over b, below a Hertz pressure p0 sqrt(1 - x^2).

    With m, n >= 0 the parts of sqrt((z + i x)^2 + 1) = m + i n (n with the sign of x):
    sx = 2z - m (1 + (z^2 + n^2)/(m^2 + n^2)),  sz = -m (1 - (z^2 + n^2)/(m^2 + n^2)),  sxz = -n (m^2 - z^2)/(m^2 + n^2).
    Source: McEwen's solution in Johnson, Contact Mechanics (1985), chapter 4, recalled; the tests sum Flamant's line loads.
    """
    x, z = np.broadcast_arrays(np.asarray(x, float), np.asarray(z, float))
    root: Complexes = np.sqrt((z + 1j * x) ** 2 + 1)
    m, n = np.real(root), np.copysign(np.imag(root), x)
    size = np.maximum(m**2 + n**2, np.finfo(float).tiny)
    share = (z**2 + n**2) / size
    return 2 * z - m * (1 + share), -m * (1 - share), -n * (m**2 - z**2) / size


def pressure_limits(yield_stress: float, poisson: float, criterion: str = "mises") -> PressureLimits:
    """`PressureLimits` for a yield stress [Pa] in tension.

    First yield, on the axis below the contact: 1.67 Y by Tresca, 1.79 Y by von Mises with nu = 0.3 (the stress along the pin is
    nu (sx + sz)).  Shakedown: stresses left behind can be any sx(z), sy(z) but no sxz, for the rolling treats all x alike; so the limit
    is k over the greatest |sxz|/p0 = 1/4 (Melan's theorem), 4 k: 2 Y by Tresca, 2.31 Y by von Mises.
    """
    if criterion not in YIELD:
        raise UnknownName("yield criterion", criterion, YIELD)
    if not (np.isfinite(yield_stress) and yield_stress > 0):
        raise InputError(f"pins: a yield stress of {yield_stress:g} Pa; it must be above 0")
    return PressureLimits(yield_stress / _greatest_equivalent(poisson, criterion), YIELD[criterion] * yield_stress / REVERSAL)


def equivalent(stresses: tuple[Numbers, ...], poisson: float, criterion: str) -> Numbers:
    """Stress over p0 to be compared with the yield stress in tension, of (sx, sz, sxz) in plane strain."""
    x, z, xz = stresses
    middle, radius = (x + z) / 2, np.hypot((x - z) / 2, xz)
    if criterion == "tresca":
        y = 2 * poisson * middle
        return np.maximum(2 * radius, np.maximum(abs(middle + radius - y), abs(middle - radius - y)))
    return np.sqrt(3 * radius**2 + (1 - 2 * poisson) ** 2 * middle**2)


def _greatest_equivalent(poisson, criterion):
    """Largest equivalent stress over p0; it lies on the axis x = 0, for a small Poisson's ratio at the surface itself."""
    return extremes(lambda z: equivalent(line_stresses(0.0, z), poisson, criterion), 0.0, 2.0)[3]
