"""Mean of a contact force over a time step, for explicit integrators: the impulse is right wherever in it the contact closes or opens."""

from typing import Any

from drivewright._jit import generic, implements
from drivewright.contact.normal import KelvinVoigt, normal_force

_AT = 0.7745966692414834  # sqrt(3/5): points of Gauss' quadrature on (-1, 1), weights 5/9, 8/9, 5/9


@generic
def mean_force(law: Any, depth: float, rate: float, dt: float) -> tuple[float, float, bool]:
    """(elastic part of the mean force [N], mean force [N], whether there is contact in the step).

    The depth [m] passes at `rate` [m/s] from half a step `dt` [s] before to half a step after: the leapfrog's impulse dt F is then the
    integral of the force.  Taken at the whole step instead, each closing loses and each opening gains energy of the order
    k (rate dt)^2, by chance.
    """
    raise NotImplementedError


@implements(mean_force, KelvinVoigt)
def _(law, depth, rate, dt):
    """k times the mean of the depth where positive, and c times the rate in the share of the step with contact; exact."""
    half = 0.5 * dt * abs(rate) + 1e-300
    inside = min(max(depth + half, 0.0), 2.0 * half)
    share = inside / (2.0 * half)
    mean = 0.5 * share * inside + max(depth - half, 0.0)
    elastic = law.k * mean
    return elastic, max(elastic + law.c * rate * share, 0.0), share > 0.0


def sampled_mean_force(law: Any, depth: float, rate: float, dt: float) -> tuple[float, float, bool]:
    """For any law: Gauss' quadrature with three points over the part of the step with contact."""
    half = 0.5 * dt * abs(rate) + 1e-300
    inside = min(max(depth + half, 0.0), 2.0 * half)
    share = inside / (2.0 * half)
    middle, reach = depth + half - 0.5 * inside, 0.5 * inside * _AT
    low, high = max(middle - reach, 0.0), max(middle + reach, 0.0)
    middle = max(middle, 0.0)
    elastic = (5.0 * (normal_force(law, -low, 0.0) + normal_force(law, -high, 0.0)) + 8.0 * normal_force(law, -middle, 0.0)) / 18.0
    force = (5.0 * (normal_force(law, -low, -rate) + normal_force(law, -high, -rate)) + 8.0 * normal_force(law, -middle, -rate)) / 18.0
    return share * elastic, share * force, share > 0.0
