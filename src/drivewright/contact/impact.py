"""Impact at a journal bearing with play: how a contact force loses energy, and the elastic law of a cylinder in a hollow.

An impact law is the factor h of  F = F_el(d) (1 + h d'/d0')  as a function of the wanted coefficient of restitution e;
F_el is the elastic force over the depth d, d0' the speed of approach at first touch.  More laws come through the
entry-point group `drivewright.impact_laws`: an `ImpactLaw` each.

The speed v of a free impact obeys  m v dv/(1 + h v/d0') = -F_el dd,  so what a factor delivers depends on h alone, for every
F_el and every mass: `delivered_restitution`.  The laws' formulas are recalled; the tests integrate the impacts.
"""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from drivewright import plugins
from drivewright._jit import kernel
from drivewright._typing import Floats, Numbers
from drivewright.contact.normal import hunt_crossley_chi
from drivewright.errors import InputError, UnknownName
from drivewright.numerics.roots import bracketed_roots

PLUGINS = "drivewright.impact_laws"
_BUILT_IN = {}


class ImpactLaw(NamedTuple):
    """`factor(e)` -> h for 0 < e <= 1; from e = `reliable` upwards the impact gives the required restitution within 10 %."""

    name: str
    factor: Callable[[float], float]
    reliable: float
    source: str


def impact_law_names() -> list[str]:
    """Names of all impact laws, built in or plugged in, sorted."""
    return sorted({*_BUILT_IN, *plugins.installed(PLUGINS)})


def impact_law(name: str) -> ImpactLaw:
    """The impact law of a name; UnknownName with the nearest one otherwise."""
    if name not in impact_law_names():
        raise UnknownName("impact law", name, impact_law_names())
    law = _BUILT_IN.get(name) or plugins.load(PLUGINS, name, "impact law")
    if not isinstance(law, ImpactLaw):
        raise InputError(f"impact law {name!r}: its entry point gives a {type(law).__name__}; it must name an ImpactLaw.")
    return law


def _law(name, reliable, source):
    """Decorator: the formula e -> h of a built-in law, called with e in (0, 1] only."""

    def keep(formula):
        def factor(restitution):
            return formula(_bounce(restitution, name))

        _BUILT_IN[name] = ImpactLaw(name, factor, reliable, source)
        return formula

    return keep


def _bounce(restitution, name):
    e = float(restitution)
    if not 0 < e <= 1:
        raise InputError(f"contact: restitution must lie in (0, 1], got {e:g} for {name!r}; take e.g. 0.05 for a dead impact.")
    return e


@_law("flores-2011", 0.384, "Flores, Machado, Silva & Martins, Multibody System Dynamics 25 (2011), recalled")
def _flores(e):
    return 8 * (1 - e) / (5 * e)


@_law("lankarani-nikravesh", 0.742, "Lankarani & Nikravesh, J. Mechanical Design 112 (1990), recalled")
def _lankarani_nikravesh(e):
    return 3 * (1 - e**2) / 4


@_law("hunt-crossley", 0.697, "Hunt & Crossley, J. Applied Mechanics 42 (1975), recalled")
def _hunt_crossley(e):
    return 3 * (1 - e) / 2


@_law("gonthier", 0.0, "Gonthier, McPhee, Lange & Piedboeuf, Multibody System Dynamics 11 (2004), recalled")
def _gonthier(e):
    """Exact: the root h of  h (1 + e) = ln((1 + h)/(1 - h e)),  about (1 - e^2)/e."""
    return hunt_crossley_chi(e, 1.0)


@_law("herbert-mcwhannell", 0.581, "Herbert & McWhannell, J. Engineering for Industry 99 (1977), recalled")
def _herbert_mcwhannell(e):
    return 6 * (1 - e) / ((2 * e - 1) ** 2 + 3)


@_law("elastic", 0.91, "no loss, whatever restitution is required")
def _elastic(e):
    return 0.0


def delivered_restitution(factor: float) -> float:
    """The coefficient of restitution e that a free impact with the factor h >= 0 really gives.

    Root of  h (1 + e) = ln((1 + h)/(1 - h e)).  With y = h e in 0 .. 1 it reads  -ln(1 - y) - y = h - ln(1 + h);  w = -ln(1 - y)
    keeps its digits where y is near 1.  The force of these laws never pulls, as the rebound stays below d0'/h: y < 1.
    """
    h = float(factor)
    if not (h >= 0 and math.isfinite(h)):
        raise InputError(
            f"contact: the factor of an impact law must be finite and not below 0, got {h:g}; below 0 an impact would gain energy."
        )
    if h < 1e-3:  # rounding would spoil the equation; series of the root
        return 1 - h * (2 / 3 - h * (4 / 9 - h * 44 / 135))
    loss = h - math.log1p(h)
    w = bracketed_roots(lambda w: w + np.expm1(-w) - loss, np.array([0.0, loss + 1]))[-1]
    return float(-np.expm1(-w) / h)


# ---------------------------------------------------------------------------------------------------------- Kelvin-Voigt


def kelvin_voigt_restitution(damping: float, stiffness: float, mass: float) -> float:
    """What a free impact delivers under F = max(K d + c d', 0): exp(-2 z acos(z)/sqrt(1 - z^2)),  z = c/(2 sqrt(K m)).

    c [N s/m], K [N/m], m [kg] the effective mass m1 m2/(m1 + m2).  The body leaves where the force is gone, before the spring is
    relaxed.  Above z = 1 the same function continues as exp(-2 z acosh(z)/sqrt(z^2 - 1)).
    """
    return math.exp(-_kelvin_voigt_loss(damping / (2 * math.sqrt(stiffness * mass))))


def kelvin_voigt_damping(restitution: float, stiffness: float, mass: float) -> float:
    """The damping c [N s/m] with which F = max(K d + c d', 0) delivers the restitution e in a free impact of the mass m.

    The root of `kelvin_voigt_restitution`.  The textbooks' c = -2 ln e sqrt(K m/(pi^2 + ln^2 e)) belongs to a force that may pull until
    the spring is relaxed; without the pull that c gives more than required: 0.902 for 0.9, 0.550 for 0.5, 0.253 for 0.1.
    """
    loss = -math.log(_bounce(restitution, "kelvin-voigt"))
    if not (stiffness > 0 and mass > 0):
        raise InputError(f"contact: kelvin-voigt needs stiffness and mass above 0, got {stiffness:g} N/m and {mass:g} kg.")
    return 2 * _damping_ratio(loss) * math.sqrt(stiffness * mass)


def _damping_ratio(loss):
    """The z of a loss -ln e."""
    if loss == 0:
        return 0.0
    grid = np.array([loss / (2 * np.pi), (1 + loss) * math.exp(loss / 2)])  # the loss is below pi z, and beyond it at the far end
    return float(bracketed_roots(np.vectorize(lambda z: _kelvin_voigt_loss(z) - loss, otypes=[float]), grid)[0])


def _kelvin_voigt_loss(z):
    """-ln e of the damping ratio z."""
    if abs(z - 1) < 1e-6:  # acos(z)/sqrt(1 - z^2) -> 1 - (z - 1)/3
        return 2 * z * (1 - (z - 1) / 3)
    return 2 * z * (math.acos(z) / math.sqrt(1 - z * z) if z < 1 else math.acosh(z) / math.sqrt(z * z - 1))


# -------------------------------------------------------------------------------------------------------- lasting contact


def lasting_factor(factor: float) -> float:
    """h_w of  F = F_el (1 + h_w d'/w),  w = sqrt(2 E(d)/m),  by which a lasting contact loses what an impact with the factor h loses.

    E(d) [J] is the elastic energy at the depth d, m [kg] the mass that the contact moves; w [m/s] the speed of approach that would
    bring a free body so deep without loss.  In (w, d') a free impact of any elastic force and mass obeys  d' d(d')/dw = -(w + h_w d'):
    the equation of `kelvin_voigt_restitution` with z = h_w/2.  So h_w = 2 z, z that of the restitution which h delivers.
    Small oscillations about a static depth, where F_el grows as d^n, have the damping ratio  z sqrt((n + 1)/(2 n)).
    For F_el = K d^1.5 the damping grows as d^(1/4): Tsuji, Tanaka & Ishida, Powder Technology 71 (1992), recalled.
    """
    return 2 * _damping_ratio(-math.log(delivered_restitution(factor)))


# ---------------------------------------------------------------------------------------------------------- elastic force


def journal_stiffness(bearing_radius: Numbers, journal_radius: Numbers, modulus: Numbers) -> Numbers:
    """K of F = K d^1.5:  4/3 E* sqrt(Rb Rj/(Rb - Rj))  [N/m^1.5], as for a ball of the journal's radius in a hollow ball.

    radii [m], E* [Pa] as from `effective_modulus`.  Lankarani & Nikravesh (1990), recalled.
    """
    clearance = np.asarray(bearing_radius) - journal_radius
    if np.any(clearance <= 0):
        raise InputError(
            f"contact: the journal's radius {journal_radius} m must be below the bearing's {bearing_radius} m; the difference is the play."
        )
    return 4 / 3 * modulus * np.sqrt(bearing_radius * np.asarray(journal_radius) / clearance)


def cylinder_depth(
    force: Numbers, clearance: Numbers, bearing_radius: Numbers, journal_radius: Numbers, modulus: Numbers, length: Numbers
) -> Floats:
    """Depth d [m] of a cylinder pressed into a cylindrical hollow:  d = x (ln(4 c/x) - 1),  x = F/(pi E* L).

    force [N] >= 0, radial clearance c = Rb - Rj [m], E* [Pa], length L [m]; arrays that broadcast.  It is the sum of both bodies'
    compressions (`cylinder_compression`), with equal elastic constants or nearly so; Johnson, Contact Mechanics (1985), recalled.
    Hertz' theory ends where the contact is no longer small, and the formula then even turns back.  From the contact's half-width
    Rj/2 on, where x = c Rj/(16 Rb), the depth therefore grows linearly with the force, without a kink.
    """
    x = np.asarray(force, dtype=float) / (np.pi * modulus * length)
    last = clearance * journal_radius / (16 * bearing_radius)
    hertz = np.clip(x, np.finfo(float).tiny, last)
    curved = np.where(x > 0, hertz * (np.log(4 * clearance / hertz) - 1), 0.0)
    return curved + np.maximum(x - last, 0.0) * (np.log(4 * clearance / last) - 2)


@kernel
def cylinder_force(depth: float, clearance: float, bearing_radius: float, journal_radius: float, modulus: float, length: float) -> float:
    """The inverse of `cylinder_depth`, for kernels: force [N] of scalars, 0 where depth <= 0.

    Newton's method on  y (ln(4/y) - 1) = d/c,  y = x/c: the function is concave, so the first step lands below the root and the
    others climb to it.  The start, one step of iteration, is so near that three steps give 12 digits.
    """
    if depth <= 0.0:
        return 0.0
    scale = np.pi * modulus * length * clearance
    relative, last = depth / clearance, journal_radius / (16.0 * bearing_radius)
    slope = np.log(4.0 / last) - 2.0
    end = last * (slope + 1.0)
    if relative >= end:
        return scale * (last + (relative - end) / slope)
    y = relative / (np.log(4.0 / relative) - 1.0)
    y = relative / (np.log(4.0 / y) - 1.0)
    for _ in range(3):
        bend = np.log(4.0 / y)
        y -= (y * (bend - 1.0) - relative) / (bend - 2.0)
    return scale * y


@kernel
def cylinder_energy(
    depth: float, force: float, clearance: float, bearing_radius: float, journal_radius: float, modulus: float, length: float
) -> float:
    """Elastic energy [J] at a depth where `cylinder_force` is `force`:  S c y^2 (ln(4/y)/2 - 3/4),  S = pi E* L c,  y = F/S.

    Beyond the end of Hertz' theory the depth grows linearly with the force, and the energy as the work along that line.
    """
    if depth <= 0.0:
        return 0.0
    scale = np.pi * modulus * length * clearance
    last = journal_radius / (16.0 * bearing_radius)
    y = min(force / scale, last)
    energy = y * y * (0.5 * np.log(4.0 / y) - 0.75)
    beyond = (force / scale - y) * (np.log(4.0 / last) - 2.0)  # of the depth over the clearance
    return scale * clearance * (energy + beyond * 0.5 * (y + force / scale))
