"""Statistics of a random sample: location, spread, percentiles and yield, each with its confidence interval.

Everything is a function of plain arrays; nan stands for a case that has no such number, is left out, and counted.  The intervals hold the
true number with probability `LEVEL`, for cases drawn independently of each other; those of mean and standard deviation also take the
number to be normally distributed.  Formulas: Hahn & Meeker, Statistical Intervals (recalled), held by simulation in the tests.
"""

from collections.abc import Mapping
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from drivewright._typing import ArrayLike, Floats, Ints
from drivewright.numerics.samples import LEVEL, NORMAL, Sampled, mean_of, sigma_of
from drivewright.numerics.samples import share_of as share

PERCENTS = (0.135, 1.0, 5.0, 25.0, 50.0, 75.0, 95.0, 99.0, 99.865)  # the outer ones are 3 sigma of a normal distribution
NOISE = 1e-12  # a column whose range is a smaller part of its size is rounding about one number


class Summary(NamedTuple):
    """What `summary` says: `cases` with the number, `absent` without; `percentiles` in the order of PERCENTS."""

    cases: int
    absent: int
    mean: Sampled
    sigma: Sampled
    skewness: Sampled
    least: float
    greatest: float
    percentiles: tuple[Sampled, ...]


def summary(sample: Floats) -> Summary:
    """`Summary` of a sample (n,); the order of the cases changes nothing, not even the last bit."""
    ordered = finite(sample)
    absent = np.size(sample) - len(ordered)
    if not len(ordered):
        none = Sampled(np.nan)
        return Summary(0, absent, none, none, none, np.nan, np.nan, (none,) * len(PERCENTS))
    mean, sigma, skewness = moments(ordered)
    return Summary(
        len(ordered),
        absent,
        mean_of(mean, sigma, len(ordered)),
        sigma_of(sigma, len(ordered)),
        skewness_of(skewness, len(ordered)),
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


def skewness_of(skewness: float, n: int) -> Sampled:
    """`Sampled` skewness of n cases: g -+ 1.96 sqrt(6 n (n - 1) / ((n - 2) (n + 1) (n + 3))), of normally distributed ones (recalled)."""
    if n < 3 or not np.isfinite(skewness):
        return Sampled(skewness)
    reach = NORMAL * np.sqrt(6 * n * (n - 1) / ((n - 2) * (n + 1) * (n + 3)))
    return Sampled(skewness, float(skewness - reach), float(skewness + reach))


def percentiles(ordered: Floats) -> tuple[Sampled, ...]:
    """`Sampled` of each of PERCENTS of an ascending sample, between neighbours in a straight line; intervals end at cases of the sample.

    The number of cases below the true percentile is binomial, whatever the distribution; so the r-th and s-th smallest case hold it.
    Where the sample is too small to reach beyond it on a side, there is no bound on that side (nan).
    """
    n = len(ordered)
    return percentiles_at(n, {rank: float(ordered[rank]) for rank in np.unique(percentile_ranks(n)).tolist() if rank >= 0})


def percentiles_at(n: int, of_rank: Mapping[int, float]) -> tuple[Sampled, ...]:
    """The same of n cases of which those of some ranks are known, {rank from 0: number}; the ranks are those of `percentile_ranks`."""
    found = []
    for percent, (lower, upper, low, high) in zip(PERCENTS, percentile_ranks(n).tolist(), strict=True):
        share = percent / 100 * (n - 1) - lower
        value = of_rank[lower] + share * (of_rank[upper] - of_rank[lower])
        found.append(Sampled(float(value), of_rank.get(low, np.nan), of_rank.get(high, np.nan)))
    return tuple(found)


def percentile_ranks(n: int) -> Ints:
    """Ranks from 0 (percents, 4) that the percentiles of n cases need: neighbours, and ends of the interval (-1 where it has none)."""
    places = np.array(PERCENTS) / 100 * (n - 1)
    lower = np.floor(places).astype(int)
    ends = np.array(_ranks(n)) - 1
    return np.column_stack([lower, np.minimum(lower + 1, n - 1), ends[:, 0], np.where(ends[:, 1] < n, ends[:, 1], -1)])


@lru_cache(maxsize=256)
def _ranks(n):
    """(r, s) from 1 for each of PERCENTS: the largest r with P(B < r), the smallest s with P(B >= s) at most (1 - LEVEL)/2.

    B, the number of cases below the percentile, is binomial.
    """
    from scipy.stats import binom

    low, high = (binom.ppf(tail, n, np.array(PERCENTS) / 100).astype(int) for tail in ((1 - LEVEL) / 2, (1 + LEVEL) / 2))
    return tuple(zip(low.tolist(), (high + 1).tolist(), strict=True))


def share_between(surely: int, passes: int, possibly: int, count: int) -> Sampled:
    """The same where some cases are undecided: from the lower end for those that surely pass to the upper one for those that may."""
    return Sampled(share(passes, count).value, share(surely, count).low, share(possibly, count).high)


def capability(margins: Summary) -> Sampled:
    """Capability index of a one-sided limit from the margins to it: Cpk = mean / (3 sigma); nan without spread.

    Its interval is Cpk -+ 1.96 sqrt(1/(9 n) + Cpk^2 / (2 (n - 1))), of normally distributed margins (Bissell 1990, recalled).
    """
    n, spread = margins.cases, margins.greatest - margins.least > NOISE * max(abs(margins.least), abs(margins.greatest))
    if n < 2 or not spread:
        return Sampled(np.nan)
    index = margins.mean.value / (3 * margins.sigma.value)
    reach = NORMAL * np.sqrt(1 / (9 * n) + index**2 / (2 * (n - 1)))
    return Sampled(index, float(index - reach), float(index + reach))
