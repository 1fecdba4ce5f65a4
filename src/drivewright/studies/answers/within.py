"""Spread within a case, told apart from the spread that the varied keys cause.

A chaotic value of a case is an estimate; it would come out a little different each time.  The variance of a sample of cases is then that
by the keys plus the mean variance within a case, as the cases scatter independently of each other.
"""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.studies.answers.parts import BOUNDS, Arranged, Part, estimate_values, table_of_rows
from drivewright.studies.statistics import Sampled, summary

WITHIN = (
    ("value", "", "value of the result"),
    ("unit", "", "unit of the row's numbers"),
    ("sigma", "", "standard deviation over the cases, all together"),
    *(
        (name + end, unit, meaning + suffix)
        for name, unit, meaning in (
            ("sigma.within", "", "standard deviation within a case"),
            ("sigma.keys", "", "standard deviation by the keys that vary"),
            ("share.within", "-", "share of the variance that is within a case"),
        )
        for end, suffix in BOUNDS
    ),
)


ESTIMATES = {
    "sigma_within": ("within", "standard deviation within a case"),
    "sigma_keys": ("keys", "standard deviation by the keys that vary"),
}


class Apart(NamedTuple):
    """Standard deviations: of all cases together, within a case, and by the keys, with its interval."""

    sigma: Sampled
    within: Sampled
    keys: Sampled

    @property
    def share(self) -> Sampled:
        """Of the variance of all cases, that within a case; its interval is from the ends of both, too wide rather than too narrow."""
        over = (self.sigma.value, self.sigma.high, self.sigma.low)
        return Sampled(*(min((within / sigma) ** 2, 1.0) if sigma > 0 else np.nan for within, sigma in zip(self.within, over, strict=True)))


def variances(arranged: Arranged, name: str) -> Floats | None:
    """Variance of each case's own estimate (combinations, points), 0 where it has no interval; None where no case has one.

    The square of its standard error, unbiased over the cases; where a value only has an interval, half its width over 1.96, whose square
    is too large rather than too small.
    """
    error = arranged.errors(name)
    return None if error is None else np.where(np.isfinite(error), error, 0.0) ** 2


def separate_variances(sample: Floats, noise: Floats) -> Apart:
    """`Apart` of the values of a sample (n,) and the variance (n,) of each within its case.

    sigma_keys^2 = sigma^2 - mean(noise), and so for the ends of the interval of sigma, which is much the wider one; not below 0.
    """
    statistics, within = summary(sample), summary(noise[np.isfinite(sample)]).mean
    keys = Sampled(*(_root(end**2 - within.value) for end in statistics.sigma))
    return Apart(statistics.sigma, Sampled(*map(_root, within)), keys)


def _root(square):
    return float(np.sqrt(max(square, 0.0))) if np.isfinite(square) else np.nan


def within_cases(arranged: Arranged) -> Part:
    """`Part` of a sample: table `within_cases` of the values with intervals, with values and a finding."""
    noises = {name: noise for name in arranged.study.value_names if (noise := variances(arranged, name)) is not None}
    rows = [
        (number, name, arranged.study.unit(name), separate_variances(*row))
        for name, noise in noises.items()
        for number, row in enumerate(zip(arranged.of(name)[:, arranged.sample], noise[:, arranged.sample], strict=True))
    ]
    rows = [row for row in rows if np.isfinite(row[3].sigma.value)]
    if not rows:
        return Part()
    cells = [(number, name, unit, each.sigma.value, *each.within, *each.keys, *each.share) for number, name, unit, each in rows]
    table = table_of_rows("within_cases", "Spread within a case and by the keys", WITHIN, cells, arranged)
    alone = arranged.combinations == 1
    return Part(
        dict(estimate_values(arranged, rows, ESTIMATES)) if alone else {}, (table,), findings=tuple(_findings(rows)) if alone else ()
    )


def _findings(rows):
    for _, name, _, variances in rows:
        if variances.keys.value == 0:
            yield (
                f"{name}: the cases differ no more than one case by itself, so the contributions of the keys cannot be determined; "
                "more windows or members narrow the intervals of the cases"
            )
        elif variances.share.value > 0.01:
            yield (
                f"{name}: {variances.share.value:.0%} of the variance over the cases is spread within a case; it is taken off the shares "
                "of the keys"
            )
