"""Normal contact forces: a NamedTuple of parameters and its formulas, for plain Python and for kernels.

gap > 0 separated, depth of penetration = -gap; gap_rate > 0 separating.  The force presses the bodies apart: it is never negative.
A new law is a NamedTuple with its force under @implements(normal_force, ...), in this or any other package.  Its stored energy and its
tangent may be stated likewise; `contact.laws.complete` derives from the force what is not stated.
"""

from typing import Any, NamedTuple

import numpy as np

from drivewright._jit import generic, implements
from drivewright.errors import InputError
from drivewright.numerics.roots import bracketed_roots


@generic
def normal_force(law: Any, gap: float, gap_rate: float) -> float:
    """Force [N] that the law gives at the gap [m] and its rate [m/s], both scalars."""
    raise NotImplementedError


@generic
def stored_energy(law: Any, gap: float) -> float:
    """Elastic energy [J] at the gap [m]: the integral of the force at rest over the depth."""
    raise NotImplementedError


@generic
def tangent(law: Any, gap: float, gap_rate: float) -> tuple[float, float]:
    """(dF/d(depth) [N/m], dF/d(rate of the depth) [N s/m]) where the law presses, gap < 0."""
    raise NotImplementedError


class Spring(NamedTuple):
    """k [N/m]."""

    k: float


@implements(normal_force, Spring)
def _(law, gap, gap_rate):
    """F = k d,  d = max(-g, 0)."""
    return law.k * max(-gap, 0.0)


class KelvinVoigt(NamedTuple):
    """k [N/m], c [N s/m]."""

    k: float
    c: float


@implements(normal_force, KelvinVoigt)
def _(law, gap, gap_rate):
    """F = k d - c g' while d = -g > 0.  Jumps by c |g'| at first touch, which bodies do not do."""
    if gap >= 0.0:
        return 0.0
    return max(-law.k * gap - law.c * gap_rate, 0.0)


@implements(stored_energy, KelvinVoigt)
def _(law, gap):
    """V = k d^2/2."""
    return 0.5 * law.k * max(-gap, 0.0) ** 2


@implements(tangent, KelvinVoigt)
def _(law, gap, gap_rate):
    """(k, c)."""
    return law.k, law.c


class PowerLaw(NamedTuple):
    """k [N/m^n], n [-] (3/2 for a Hertz point)."""

    k: float
    n: float


@implements(normal_force, PowerLaw)
def _(law, gap, gap_rate):
    """F = k d^n."""
    depth = max(-gap, 0.0)
    if law.n == 1.5:
        return law.k * depth * np.sqrt(depth)
    return law.k * depth**law.n


class HuntCrossley(NamedTuple):
    """k [N/m^n], n [-] (3/2 for a Hertz point), chi [s/m]."""

    k: float
    n: float
    chi: float


@implements(normal_force, HuntCrossley)
def _(law, gap, gap_rate):
    """F = k d^n (1 - chi g'),  d = max(-g, 0).  Hunt & Crossley 1975, recalled."""
    depth = max(-gap, 0.0)
    return max(law.k * depth**law.n * (1.0 - law.chi * gap_rate), 0.0)


def hunt_crossley_chi(restitution: float, speed: float) -> float:
    """The damping chi [s/m] with which a free impact at `speed` [m/s] bounces with the coefficient of restitution e, 0 < e <= 1.

    Exact for every mass, k and n: with x = chi v,  x (1 + e) = ln((1 + x)/(1 - x e)), from the integral of m v dv = -F dd over
    the impact.  For hard bounces x is 3/2 (1 - e).
    """
    e = float(restitution)
    if not 0 < e <= 1 or not speed > 0:
        raise InputError(
            f"contact: restitution must lie in (0, 1] and speed be above 0, got {restitution:g} and {speed:g} m/s. "
            "A Hunt-Crossley impact always bounces a little; take e.g. 0.05 for a dead one."
        )
    if e > 0.9999:  # rounding would spoil the equation; the next term of the series is (1 - e)^3
        return 1.5 * (1 - e) * (2 - e) / speed

    def balance(w):  # w = -ln(1 - x e): x comes too near to 1/e to be distinguished from it when e is small
        x = -np.expm1(-w) / e
        return x * (1 + e) - np.log1p(x) - w

    w = bracketed_roots(balance, np.geomspace(0.5 * (1 - e), (1 + e) / e, 20))[-1]
    return float(-np.expm1(-w) / e / speed)
