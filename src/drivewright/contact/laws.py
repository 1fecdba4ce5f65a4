"""Contact laws by name: those that other packages bring under the entry point group `drivewright.contact_laws`.

The entry point is a function of `ContactParameters` that returns a law: a NamedTuple of numbers whose class has a formula under
@implements(normal_force, ...).  Every kernel takes it: pins with play, flanks, rollers and guides of chains.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from drivewright import plugins
from drivewright._jit import formulas_of, implements
from drivewright.contact.normal import normal_force, stored_energy, tangent
from drivewright.contact.time_step import mean_force, sampled_mean_force
from drivewright.errors import InputError, UnknownName

PLUGINS = "drivewright.contact_laws"
# Gauss-Legendre on (0, 1), five points: exact for polynomials of the ninth degree.
_AT = tuple(0.5 + 0.5 * x for x in np.polynomial.legendre.leggauss(5)[0].tolist())
_WEIGHT = tuple(0.5 * w for w in np.polynomial.legendre.leggauss(5)[1].tolist())
_DIFFERENCE = 1e-5  # step of the differences, over the depth


class ContactParameters(NamedTuple):
    """What a mechanism states of a place of contact, for a law to be made from."""

    stiffness: float  # K of F = K d^n [N/m^n]
    exponent: float = 1.0  # n [-]
    damping: float = 0.0  # c of a force c d' [N s/m]; 0 where none is given
    restitution: float = 1.0  # wanted coefficient of restitution, in (0, 1]; 1 where none is given
    mass: float = np.inf  # effective mass of the two bodies, m1 m2/(m1 + m2) [kg]


def contact_law_names() -> list[str]:
    """Names of the contact laws that are plugged in, sorted."""
    return sorted(plugins.installed(PLUGINS))


def contact_law(wanted: str | Callable[[ContactParameters], Any], parameters: ContactParameters) -> Any:
    """The law for a place of contact, by its registered name or the function that makes it; UnknownName where there is no such name."""
    make, name = (_registered(wanted), wanted) if isinstance(wanted, str) else (wanted, getattr(wanted, "__name__", repr(wanted)))
    if not callable(make):
        raise InputError(f"contact law {name!r}: its entry point gives a {type(make).__name__}; it must name a function.")
    law = make(parameters)
    if not (isinstance(law, tuple) and hasattr(law, "_fields")) or type(law) not in formulas_of(normal_force):
        raise InputError(
            f"contact law {name!r}: its function returns a {type(law).__name__}; "
            "it must return a record whose class has a formula under @implements(normal_force, ...)."
        )
    law = _with_floats(law)
    if normal_force(law, 1.0, 0.0) != 0.0:
        raise InputError(f"contact law {name!r}: gives {normal_force(law, 1.0, 0.0):g} N across a gap of 1 m; its force there must be 0.")
    complete(type(law))
    return law


def _with_floats(law: Any) -> Any:
    """The law with its whole numbers as floats: kernels know one type of parameter."""
    return type(law)(*(float(value) if isinstance(value, int | float) else value for value in law))


def _registered(name: str) -> Any:
    """What the entry point of a law names."""
    if name not in contact_law_names():
        raise UnknownName("contact law", name, contact_law_names())
    return plugins.load(PLUGINS, name, "contact law")


def complete(kind: type) -> None:
    """Give a law's class the formulas that it does not state, derived from its force."""
    for dispatch, derived in ((stored_energy, _integrated_force), (tangent, _differences), (mean_force, sampled_mean_force)):
        if kind not in formulas_of(dispatch):
            implements(dispatch, kind)(derived)


def _integrated_force(law, gap):
    """The force at rest over the depth, by Gauss' quadrature."""
    depth = max(-gap, 0.0)
    total = 0.0
    for k in range(5):
        total += _WEIGHT[k] * normal_force(law, -_AT[k] * depth, 0.0)
    return total * depth


def _differences(law, gap, gap_rate):
    """Central differences of the force by the depth and by its rate."""
    step = _DIFFERENCE * abs(gap)
    speed = _DIFFERENCE * max(abs(gap_rate), 1e-3)
    stiffness = (normal_force(law, gap - step, gap_rate) - normal_force(law, gap + step, gap_rate)) / (2.0 * step)
    damping = (normal_force(law, gap, gap_rate - speed) - normal_force(law, gap, gap_rate + speed)) / (2.0 * speed)
    return stiffness, damping
