"""Spread within a case, told apart from the spread that the varied keys cause.

A chaotic value of a case is an estimate; it would come out a little different each time.  The variance of a sample of cases is then that
by the keys plus the mean variance within a case, as the cases scatter independently of each other.
"""

from typing import NamedTuple

import numpy as np

from drivewright.result import HIGH, LOW, Value
from drivewright.studies.answers.parts import Part, table_of_rows
from drivewright.studies.statistics import Sampled, finite, summary

WITHIN = (
    ("value", "", "value of the result"), ("unit", "", "unit of the row's numbers"),
    ("sigma", "", "standard deviation over the cases, all together"), ("sigma.within", "", "standard deviation within a case"),
    ("sigma.keys", "", "standard deviation by the keys that vary"), ("sigma.keys" + LOW, "", "the same, at least"),
    ("sigma.keys" + HIGH, "", "the same, at most"), ("share.within", "-", "share of the variance that is within a case"),
)


class Apart(NamedTuple):
    """Standard deviations: of all cases together, within a case, and by the keys, with its interval."""

    sigma: float
    within: float
    keys: Sampled

    @property
    def share(self):
        """Of the variance of all cases, that within a case."""
        return min((self.within / self.sigma) ** 2, 1.0) if self.sigma > 0 else np.nan


def variances(arranged, name):
    """Variance of each case's own estimate (combinations, points), 0 where it has no interval; None where no case has one.

    The square of its standard error, unbiased over the cases; where a value only has an interval, half its width over 1.96, whose square
    is too large rather than too small.
    """
    error = arranged.errors(name)
    return None if error is None else np.where(np.isfinite(error), error, 0.0) ** 2


def told_apart(sample, noise):
    """`Apart` of the values of a sample (n,) and the variance (n,) of each within its case.

    sigma_keys^2 = sigma^2 - mean(noise), and so for the ends of the interval of sigma, below by 0.
    """
    found, within = summary(sample), float(np.mean(noise[np.isfinite(sample)])) if len(finite(sample)) else np.nan
    keys = Sampled(*(float(np.sqrt(max(end**2 - within, 0.0))) if np.isfinite(end) else np.nan for end in found.sigma))
    return Apart(found.sigma.value, float(np.sqrt(within)), keys)


def within_cases(arranged):
    """`Part` of a sample: table `within_cases` of the values with intervals, with values and a finding."""
    noises = {name: noise for name in arranged.study.value_names if (noise := variances(arranged, name)) is not None}
    rows = [(number, name, arranged.study.unit(name), told_apart(*row)) for name, noise in noises.items()
            for number, row in enumerate(zip(arranged.of(name)[:, arranged.sample], noise[:, arranged.sample], strict=True))]
    rows = [row for row in rows if np.isfinite(row[3].sigma)]
    if not rows:
        return Part()
    table = table_of_rows("within_cases", "Spread within a case and by the keys", WITHIN,
                          [(n, name, unit, each.sigma, each.within, *each.keys, each.share) for n, name, unit, each in rows], arranged)
    alone = arranged.combinations == 1
    return Part(dict(_values(arranged, rows)) if alone else {}, (table,), findings=tuple(_findings(rows)) if alone else ())


def _values(arranged, rows):
    for _, name, unit, found in rows:
        what = arranged.study.meaning(name) or name
        yield f"sigma_within.{name}", Value(found.within, unit, f"{what}: standard deviation within a case")
        yield f"sigma_keys.{name}", found.keys.named(unit, f"{what}: standard deviation by the keys that vary")


def _findings(rows):
    for _, name, _, found in rows:
        if found.keys.value == 0:
            yield (f"{name}: the cases differ no more than one case by itself, so nothing can be said of what its keys cause; more windows "
                   "or members narrow the intervals of the cases")
        elif found.share > 0.01:
            yield (f"{name}: {found.share:.0%} of the variance over the cases is spread within a case; it is taken off the shares of the "
                   "keys")
