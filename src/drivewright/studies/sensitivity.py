"""Which of the varying keys causes how much of a number's spread.

Three ways, by what has been run: linear theory from a step of each key, regression and ranks from any random sample, and the indices
of Sobol from a sample made for them.  The keys vary independently of each other.  Functions of plain arrays; nan is a case without
the number.
"""

from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats, Ints, Numbers
from drivewright.studies.statistics import LEVEL, NORMAL, Sampled, varies

ROUNDS = 500  # of the bootstrap
GROUPS = 4096  # rows, or groups of rows, that are drawn in each
LEAST_RANKED = 20  # cases below which ranks say nothing


class Linear(NamedTuple):
    """Linear theory about the nominal point; arrays (d,) over the keys.

    slope dy/dx, contribution (dy/dx sigma_x)^2 to the variance and its share of their sum, curvature y+ + y- - 2 y0 (what the straight
    line leaves out, 0 for a straight one), sigma by root sum of squares, and the ends that the sum of all |dy/dx| reaches.
    """

    slope: Floats
    contribution: Floats
    share: Floats
    curvature: Floats
    sigma: float
    least: float
    greatest: float


def linear(nominal: float, steps: Floats, sigmas: Floats, deviations: Floats, noise: Numbers = 0.0) -> Linear:
    """`Linear` of a number: at the means, and with each key one sigma (d,) down and up, steps (2 d,) as the plan has them.

    `deviations` (d, 2): lower and upper end of each key less its mean.  dy/dx = (y+ - y-) / (2 sigma); exact for a parabola.
    `noise` (2 d,): variance of the number within each of those cases.  It adds (noise+ + noise-)/4 to a contribution on average, which
    is taken off, down to 0.
    """
    down, up = np.reshape(steps, (-1, 2)).T
    slope = (up - down) / (2 * sigmas)
    contribution = np.maximum((slope * sigmas) ** 2 - np.reshape(np.broadcast_to(noise, np.shape(steps)), (-1, 2)).sum(axis=1) / 4, 0.0)
    total = contribution.sum()
    reach = np.sort(slope[:, None] * deviations, axis=1)
    share = contribution / total if total > 0 else np.full_like(contribution, np.nan)
    return Linear(
        slope, contribution, share, up + down - 2 * nominal, float(np.sqrt(total)), *(float(nominal + side.sum()) for side in reach.T)
    )


# -- any random sample ---------------------------------------------------------------------------------------------------------


class Regression(NamedTuple):
    """Standardised regression coefficients b sigma_x / sigma_y (d,), and the share R2 of the variance that the fit explains; `error` is
    the standard error of a coefficient, that of independent keys, `cases` how many there are."""

    coefficients: Floats
    determination: float
    error: float = np.nan
    cases: int = 0

    @property
    def shares(self) -> Floats:
        """Shares of the variance by squares of the coefficients, and the ends of their intervals (3, d): (|b| -+ 1.96 s)^2."""
        size, reach = np.abs(self.coefficients), NORMAL * self.error
        return np.stack([size**2, np.maximum(size - reach, 0.0) ** 2, (size + reach) ** 2])

    @property
    def determined(self) -> Sampled:
        """R2 with its interval, -+ 1.96 s within 0 and 1, s^2 = 4 R2 (1 - R2)^2 (n - d - 1)^2 / ((n^2 - 1) (n + 3)) (Olkin & Finn 1995,
        recalled)."""
        fit, n = self.determination, self.cases
        free = n - len(self.coefficients) - 1
        reach = NORMAL * 2 * np.sqrt(max(fit, 0.0)) * (1 - fit) * free / np.sqrt((n**2 - 1) * (n + 3)) if n else np.nan
        return Sampled(fit, float(max(fit - reach, 0.0)), float(min(fit + reach, 1.0)))


def regression(x: Floats, y: Floats) -> Regression:
    """`Regression` of y (n,) on x (n, d) by least squares; nan where y does not vary or the cases are too few.

    For independent keys the square of a coefficient is the key's share of the variance, as far as the number is linear in the keys.
    """
    present = np.isfinite(y)
    x, y = x[present], y[present]
    if len(y) < x.shape[1] + 2 or not varies(y):
        return Regression(np.full(x.shape[1], np.nan), np.nan)
    design, target = np.stack([_standardised(column) for column in x.T], axis=1), _standardised(y)
    coefficients = np.asarray(np.linalg.lstsq(design, target, rcond=None)[0], float)
    fit = float(1 - np.sum((target - design @ coefficients) ** 2) / np.sum(target**2))
    return Regression(coefficients, fit, float(np.sqrt(max(1 - fit, 0.0) / (len(y) - x.shape[1] - 1))), len(y))


def share_by_keys(y: Floats, noise: Floats) -> float:
    """Share of the variance of y (n,) that is not within its cases, `noise` (n,) being the variance within each; nan where none is left.

    Scatter within the cases is independent from case to case: it adds its mean to the variance and nothing to what keys and y have in
    common, so shares of the whole variance, divided by this, are those of what the keys cause.
    """
    present = np.isfinite(y)
    whole = np.var(y[present]) if varies(y) else 0.0
    left = whole - np.mean(noise[present]) if whole > 0 else 0.0
    return float(left / whole) if left > 0 else np.nan


def _standardised(column):
    """(column - mean) / standard deviation; zeros where it does not vary."""
    if not varies(column):
        return np.zeros(len(column))
    part = (column - column.min()) / np.ptp(column)
    part = part - part.mean()
    return part / np.sqrt(np.mean(part**2))


def orders(x: Floats) -> Ints:
    """The cases in ascending order of each key (n, d), for `by_ranks`; once for all numbers of a study."""
    return np.argsort(x, axis=0, kind="stable")


def by_ranks(order: Ints, y: Floats) -> Floats:
    """First-order Sobol indices (d,) of y (n,) from any random sample: how alike the numbers of cases with neighbouring keys are.

    S = (sum y_j y_N(j) / n - mean^2) / variance, N(j) being the case whose key is next above, of the last the first one
    (Gamboa, Gremaud, Klein & Lagnoux, Bernoulli 2022; recalled, held by functions with known indices).  Scatters by about 1/sqrt(n), so
    that a small index may come out below 0.  Not for the points of a Sobol sequence, whose neighbours are anything but random.
    nan where y does not vary or the cases are fewer than `LEAST_RANKED`.
    """
    present = np.isfinite(y)
    if present.sum() < LEAST_RANKED or not varies(y):
        return np.full(order.shape[1], np.nan)
    z = np.zeros(len(y))
    z[present] = _standardised(y[present])
    return np.array([_neighbours(z[column[present[column]]]) for column in order.T])


def ranked_shares(order: Ints, y: Floats) -> Floats:
    """The same with the ends of their intervals (3, d): -+ 1.96 / sqrt(n), as far as indices of keys without a share scatter."""
    found = by_ranks(order, y)
    reach = NORMAL / np.sqrt(max(np.isfinite(y).sum(), 1))
    return np.stack([found, found - reach, found + reach])


def _neighbours(z):
    """Mean product of neighbours of a standardised ring."""
    return np.mean(z * np.roll(z, -1))


# -- a sample made for it ------------------------------------------------------------------------------------------------------


class Indices(NamedTuple):
    """Sobol indices of each key (d,): first order, its own share of the variance; total, with all that it shares with other keys.

    The intervals (d, 2) are those of a bootstrap.  `rows` base cases are complete, `dropped` are not and left out.
    """

    first: Floats
    first_interval: Floats
    total: Floats
    total_interval: Floats
    rows: int
    dropped: int


def indices(a: Floats, b: Floats, mixed: Floats, noise: Sequence[Numbers] = (0.0, 0.0, 0.0)) -> Indices:
    """`Indices` of a number at the points A (n,), B (n,), and A with column k from B (d, n).

    S = mean(y_B (y_ABk - y_A)) / variance (Saltelli et al. 2010), T = mean((y_A - y_ABk)^2) / (2 variance) (Jansen 1999); both recalled,
    held by functions with known indices.  A base case that lacks one of its numbers is left out in whole.
    `noise`: variance of the number within each of the cases A, B and mixed.  No key causes it, and as it is independent from case to case
    it adds to the variance and to the squared differences only, where it is taken off case by case: the indices are those of the rest.
    """
    present = np.isfinite(a) & np.isfinite(b) & np.all(np.isfinite(mixed), axis=0)
    noise = [np.broadcast_to(part, np.shape(each))[..., present] for part, each in zip(noise, (a, b, mixed), strict=True)]
    a, b, mixed = a[present], b[present], mixed[:, present]
    d, rows, dropped = len(mixed), int(present.sum()), int(np.sum(~present))
    if rows < 2 or not varies(np.concatenate([a, b])):
        one, ends = np.full(d, np.nan), np.full((d, 2), np.nan)
        return Indices(one, ends, one, ends, rows, dropped)
    terms = _terms(a, b, mixed, *noise)
    first, total = _ratios(terms.sum(axis=0), d)
    drawn = _bootstrap_counts(min(rows, GROUPS)) @ _grouped(terms)
    intervals = np.quantile(_ratios(drawn, d), [(1 - LEVEL) / 2, (1 + LEVEL) / 2], axis=1)
    return Indices(first, intervals[:, 0].T, total, intervals[:, 1].T, rows, dropped)


def _terms(a, b, mixed, a_noise, b_noise, mixed_noise):
    """Rows (n, 2 d + 1) whose sums make the indices: products, squared differences, and squares about the mean, without the noise."""
    low, width = min(a.min(), b.min()), np.ptp(np.concatenate([a, b]))
    a, b, mixed = ((y - low) / width for y in (a, b, mixed))
    a_noise, b_noise, mixed_noise = (each / width**2 for each in (a_noise, b_noise, mixed_noise))
    middle = (a.mean() + b.mean()) / 2
    a, b, mixed = a - middle, b - middle, mixed - middle
    squares = ((mixed - a) ** 2 - mixed_noise - a_noise) / 2
    return np.stack([*(b * (mixed - a)), *squares, (a**2 - a_noise + b**2 - b_noise) / 2], axis=1)


def _ratios(sums, d):
    """(first, total) (..., d) of summed terms; nan where a draw has no variance."""
    variance = np.where(sums[..., -1:] > 0, sums[..., -1:], np.nan)
    return sums[..., :d] / variance, sums[..., d : 2 * d] / variance


def _grouped(terms):
    """The rows, or where they are many their sums in groups put together at random, which scatter alike and are drawn faster."""
    if len(terms) <= GROUPS:
        return terms
    shuffled = terms[np.random.default_rng(len(terms)).permutation(len(terms))]
    return np.add.reduceat(shuffled, np.linspace(0, len(terms), GROUPS, endpoint=False).astype(int), axis=0)


@lru_cache(maxsize=4)
def _bootstrap_counts(n):
    """How often each of n rows is drawn in each round (ROUNDS, n); always the same."""
    rng = np.random.default_rng(n)
    return np.stack([np.bincount(rng.integers(n, size=n), minlength=n) for _ in range(ROUNDS)]).astype(float)
