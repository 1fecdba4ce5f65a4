"""What a random sample says about a number: location, spread, percentiles and yield, each with its confidence interval.

Everything is a function of plain arrays; nan stands for a case that has no such number, is left out, and counted.  The intervals hold the
true number with probability `LEVEL`, for cases drawn independently of each other; those of mean and standard deviation also take the
number to be normally distributed.  Formulas: Hahn & Meeker, Statistical Intervals (recalled), held by simulation in the tests.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from drivewright._typing import ArrayLike, Floats
from drivewright.numerics.student import student_quantile
from drivewright.result import Value

LEVEL = 0.95
NORMAL = 1.959963984540054  # quantile of the normal distribution that leaves (1 - LEVEL)/2 above it
PERCENTS = (0.135, 1.0, 5.0, 25.0, 50.0, 75.0, 95.0, 99.0, 99.865)  # the outer ones are 3 sigma of a normal distribution
NOISE = 1e-12  # a column whose range is a smaller part of its size is rounding about one number


class Sampled(NamedTuple):
    """A number estimated from a sample and its confidence interval; nan where the sample is too small for one."""

    value: float
    low: float = np.nan
    high: float = np.nan

    def named(self, unit: str, meaning: str) -> Value:
        """As a `Value` of a result."""
        return Value(self.value, unit, meaning, self.low, self.high, "sample").plain()


class Summary(NamedTuple):
    """What `summary` says: `cases` with the number, `absent` without; `percentiles` in the order of PERCENTS."""

    cases: int
    absent: int
    mean: Sampled
    sigma: Sampled
    skewness: float
    least: float
    greatest: float
    percentiles: tuple[Sampled, ...]


def summary(sample: Floats) -> Summary:
    """`Summary` of a sample (n,); the order of the cases changes nothing, not even the last bit."""
    ordered = finite(sample)
    absent = np.size(sample) - len(ordered)
    if not len(ordered):
        none = Sampled(np.nan)
        return Summary(0, absent, none, none, np.nan, np.nan, np.nan, (none,) * len(PERCENTS))
    mean, sigma, skewness = moments(ordered)
    return Summary(
        len(ordered),
        absent,
        _mean(mean, sigma, len(ordered)),
        _sigma(sigma, len(ordered)),
        skewness,
        float(ordered[0]),
        float(ordered[-1]),
        percentiles(ordered),
    )


def finite(sample: ArrayLike) -> Floats:
    """The numbers of a sample that exist, ascending."""
    sample = np.ravel(np.asarray(sample, dtype=float))
    return np.sort(sample[np.isfinite(sample)])


def varies(sample: ArrayLike, rounding: float = 0.0) -> bool:
    """Whether a sample holds two numbers that differ by more than rounding: their own, and that of what they come from."""
    ordered = finite(sample)
    return bool(len(ordered) > 1 and ordered[-1] - ordered[0] > max(rounding, NOISE * max(abs(ordered[0]), abs(ordered[-1]))))


def moments(ordered: Floats) -> tuple[float, float, float]:
    """(mean, standard deviation with n - 1, skewness m3 / m2^(3/2)) of an ascending sample.

    Taken on a scale from 0 to 1 over the sample's range: equal numbers have exactly no spread, and nothing overflows.  The skewness of a
    sample without spread, and the spread of one number, do not exist (nan).
    """
    width, n = ordered[-1] - ordered[0], len(ordered)
    if width == 0:
        return float(ordered[0]), (0.0 if n > 1 else np.nan), np.nan
    part = (ordered - ordered[0]) / width
    middle = np.mean(part)
    second, third = (np.mean((part - middle) ** k) for k in (2, 3))
    return float(ordered[0] + width * middle), float(width * np.sqrt(second * n / (n - 1))), float(third / second**1.5)


def _mean(mean, sigma, n):
    """mean -+ t s / sqrt(n), t being Student's quantile of n - 1 degrees of freedom."""
    if n < 2:
        return Sampled(mean)
    reach = float(student_quantile(n - 1, (1 + LEVEL) / 2) * sigma / np.sqrt(n))
    return Sampled(mean, mean - reach, mean + reach)


def _sigma(sigma, n):
    """s sqrt((n - 1) / chi2), chi2 being both quantiles of n - 1 degrees of freedom."""
    from scipy.special import chdtri

    if n < 2:
        return Sampled(sigma)
    low, high = (sigma * np.sqrt((n - 1) / chdtri(n - 1, tail)) for tail in ((1 - LEVEL) / 2, (1 + LEVEL) / 2))
    return Sampled(sigma, float(low), float(high))


def percentiles(ordered: Floats) -> tuple[Sampled, ...]:
    """`Sampled` of each of PERCENTS of an ascending sample, between neighbours in a straight line; intervals end at cases of the sample.

    The number of cases below the true percentile is binomial, whatever the distribution; so the r-th and s-th smallest case hold it.
    Where the sample is too small to reach beyond it on a side, there is no bound on that side (nan).
    """
    n, between = len(ordered), np.percentile(ordered, PERCENTS)
    return tuple(
        Sampled(float(value), float(ordered[low - 1]) if low else np.nan, float(ordered[high - 1]) if high <= n else np.nan)
        for value, (low, high) in zip(between, _ranks(n), strict=True)
    )


@lru_cache(maxsize=256)
def _ranks(n):
    """(r, s) from 1 for each of PERCENTS: the largest r with P(B < r), the smallest s with P(B >= s) at most (1 - LEVEL)/2.

    B, the number of cases below the percentile, is binomial.
    """
    from scipy.stats import binom

    low, high = (binom.ppf(tail, n, np.array(PERCENTS) / 100).astype(int) for tail in ((1 - LEVEL) / 2, (1 + LEVEL) / 2))
    return tuple(zip(low.tolist(), (high + 1).tolist(), strict=True))


def share(passes: int, count: int) -> Sampled:
    """`Sampled` of a probability from `passes` of `count` cases, with the interval of Clopper and Pearson; nan of no cases."""
    from scipy.special import betaincinv

    if not count:
        return Sampled(np.nan)
    tail = (1 - LEVEL) / 2
    low = float(betaincinv(passes, count - passes + 1, tail)) if passes else 0.0
    high = float(betaincinv(passes + 1, count - passes, 1 - tail)) if passes < count else 1.0
    return Sampled(passes / count, low, high)


def share_between(surely: int, passes: int, possibly: int, count: int) -> Sampled:
    """The same where some cases are undecided: from the lower end for those that surely pass to the upper one for those that may."""
    return Sampled(share(passes, count).value, share(surely, count).low, share(possibly, count).high)


def capability(margins: Floats) -> float:
    """Capability index of a one-sided limit from the margins to it: Cpk = mean / (3 sigma); nan without spread."""
    ordered = finite(margins)
    mean, sigma, _ = moments(ordered) if varies(ordered) else (np.nan, np.nan, np.nan)
    return mean / (3 * sigma)
