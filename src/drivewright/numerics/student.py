"""Student's distribution, for intervals of means.  (scipy.special has the like; it takes 0.2 s to import, as long as a small run.)"""

import functools
import math

import numpy as np

from drivewright.errors import InputError

POINTS = 64  # of Gauss and Legendre: rounding is all that is left for 1 to 1e6 degrees of freedom
SETTLED = 1e-15  # of the angle: a step of Newton's method that is rounding
STEPS = 100
LARGE = 100.0
TAIL = 5e-4  # share beyond which the integrand of few degrees of freedom, no whole number, is too steep for the quadrature


@functools.lru_cache(maxsize=1024)
def student_quantile(freedom: float, share: float) -> float:
    """t below which lies this share of Student's distribution with `freedom` degrees of freedom, a real number of 1 or more; to 1e-8.

    With t = sqrt(freedom) tan(a) the share between 0 and t is  c int_0^a cos(u)^(freedom - 1) du,  c = Gamma((freedom + 1)/2) /
    (sqrt(pi) Gamma(freedom/2)).  It rises ever more slowly with a, so that Newton's method comes up from 0 and never passes the solution.
    """
    if not (freedom >= 1.0 and TAIL <= share <= 1.0 - TAIL):
        raise InputError(
            f"Student's distribution: freedom = {freedom:g} must be 1 or more, share = {share:g} between {TAIL:g} and {1 - TAIL:g}."
        )
    if share == 0.5:
        return 0.0
    node, weight = _gauss(POINTS)
    scale = _gamma_ratio(0.5 * freedom) / math.sqrt(math.pi)
    wanted, angle = abs(share - 0.5), 0.0
    for _ in range(STEPS):
        reached = 0.5 * angle * scale * float(weight @ np.cos(0.5 * angle * (1.0 + node)) ** (freedom - 1.0))
        step = (wanted - reached) / (scale * math.cos(angle) ** (freedom - 1.0))
        angle += step
        if step <= SETTLED * angle:
            break
    return math.copysign(math.sqrt(freedom) * math.tan(angle), share - 0.5)


def _gamma_ratio(x):
    """Gamma(x + 1/2)/Gamma(x); of large x by its series, where the difference of two logarithms has no digits left."""
    if x < LARGE:
        return math.exp(math.lgamma(x + 0.5) - math.lgamma(x))
    return math.sqrt(x) * (1 - 1 / (8 * x) + 1 / (128 * x**2) + 5 / (1024 * x**3))


@functools.lru_cache(maxsize=1)
def _gauss(points):
    return np.polynomial.legendre.leggauss(points)
