"""Estimates from a random sample: a value with its confidence interval, of cases drawn independently of each other.

The intervals hold the true number with probability `LEVEL`; those of mean and standard deviation take the number to be normally
distributed.  Formulas: Hahn & Meeker, Statistical Intervals (recalled), held by simulation in the tests of `studies.statistics`.
"""

from typing import NamedTuple

import numpy as np

from drivewright.numerics.student import student_quantile
from drivewright.result import Value

LEVEL = 0.95
NORMAL = 1.959963984540054  # quantile of the normal distribution that leaves (1 - LEVEL)/2 above it


class Sampled(NamedTuple):
    """A number estimated from a sample and its confidence interval; nan where the sample is too small for one."""

    value: float
    low: float = np.nan
    high: float = np.nan

    def named(self, unit: str, meaning: str, label: str = "") -> Value:
        """As a `Value` of a result."""
        return Value(self.value, unit, meaning, self.low, self.high, "sample", label=label).plain()


def mean_of(mean: float, sigma: float, n: int) -> Sampled:
    """`Sampled` mean of n cases: mean -+ t s / sqrt(n), t being Student's quantile of n - 1 degrees of freedom."""
    if n < 2:
        return Sampled(mean)
    reach = float(student_quantile(n - 1, (1 + LEVEL) / 2) * sigma / np.sqrt(n))
    return Sampled(mean, mean - reach, mean + reach)


def sigma_of(sigma: float, n: int) -> Sampled:
    """`Sampled` standard deviation of n cases: s sqrt((n - 1) / chi2), chi2 being both quantiles of n - 1 degrees of freedom."""
    from scipy.special import chdtri

    if n < 2:
        return Sampled(sigma)
    low, high = (sigma * np.sqrt((n - 1) / chdtri(n - 1, tail)) for tail in ((1 - LEVEL) / 2, (1 + LEVEL) / 2))
    return Sampled(sigma, float(low), float(high))


def share_of(passes: int, count: int) -> Sampled:
    """`Sampled` of a probability from `passes` of `count` cases, with the interval of Clopper and Pearson; nan of no cases."""
    from scipy.special import betaincinv

    if not count:
        return Sampled(np.nan)
    tail = (1 - LEVEL) / 2
    low = float(betaincinv(passes, count - passes + 1, tail)) if passes else 0.0
    high = float(betaincinv(passes + 1, count - passes, 1 - tail)) if passes < count else 1.0
    return Sampled(passes / count, low, high)
