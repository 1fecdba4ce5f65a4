"""How far the values of a random sample spread, how many cases pass, and the worst values at the corners."""

from collections.abc import Iterator

import numpy as np

from drivewright.execution.outputs import CHECK
from drivewright.result import Column, Plot, Table, Value
from drivewright.studies.answers.maps import Response
from drivewright.studies.answers.parts import BOUNDS, Arranged, Part, about, estimate_values, table_of_rows, together
from drivewright.studies.answers.within import within_cases
from drivewright.studies.statistics import PERCENTS, Sampled, capability, finite

ALL = "all checks"
VALUE = (("value", "", "value of the result"), ("unit", "", "unit of the row's numbers"))
SHORT = (1.0, 50.0, 99.0)  # percentiles of the overview
TOLERANCE = (
    *VALUE,
    *(
        (name + end, "", meaning + suffix)
        for name, meaning in (("mean", "mean"), ("sigma", "standard deviation"))
        for end, suffix in BOUNDS
    ),
    *(
        (f"percentile.{percent:g}{end}", "", f"{percent:g} % of all cases are below" + suffix)
        for percent in SHORT
        for end, suffix in BOUNDS
    ),
    ("least", "", "least of the sample"),
    ("greatest", "", "greatest of the sample"),
    ("absent", "-", "cases that do not have the value"),
)
CONFIDENCE = (
    *VALUE,
    ("cases", "-", "cases that have the value"),
    *(
        (name + end, "", meaning + suffix)
        for name, meaning in (("mean", "mean"), ("sigma", "standard deviation"))
        for end, suffix in BOUNDS
    ),
    *(("skewness" + end, "-", "skewness" + suffix) for end, suffix in BOUNDS),
    *(
        (f"percentile.{percent:g}{end}", "", f"{percent:g} % of all cases are below" + suffix)
        for percent in PERCENTS
        for end, suffix in BOUNDS
    ),
)
YIELD = (
    ("check", "", "design check"),
    ("passes", "-", "cases that pass"),
    ("cases", "-", "cases that have the check, or failed"),
    *(("yield" + end, "-", "share of the cases that pass" + suffix) for end, suffix in BOUNDS),
    *(("capability" + end, "-", "capability index Cpk: mean margin over three standard deviations" + suffix) for end, suffix in BOUNDS),
    ("undecided", "-", "cases whose limit lies within the interval of their value"),
)
WORST = (
    ("value", "", "value of the result, or margin of a check to its limit"),
    ("unit", "", "unit of the row's numbers"),
    ("least", "", "least at the corners"),
    ("greatest", "", "greatest at the corners"),
    ("corners", "-", "corners that have it"),
)

ESTIMATES = {"mean": ("mean", "mean of the sample"), "sigma": ("sigma", "standard deviation of the sample")}


def spread(arranged: Arranged) -> Part:
    """`Part` of the sample: tables `tolerance`, `confidence` and `yield`, their values and histograms."""
    if not len(arranged.sample):
        return Part()
    names = arranged.study.value_names
    rows = [
        (number, name, arranged.study.unit(name), statistics)
        for name in names
        for number, statistics in enumerate(arranged.summaries(name))
    ]
    parts = [_yields(arranged), within_cases(arranged)]
    if rows:
        short = table_of_rows("tolerance", "Spread of the values", TOLERANCE, [_tolerance_row(*row) for row in rows], arranged)
        full = table_of_rows("confidence", "Spread of the values with confidence", CONFIDENCE, [_sure(*row) for row in rows], arranged)
        parts.append(Part(tables=(short, full)))
    if arranged.combinations == 1:
        parts += [Part(dict(estimate_values(arranged, rows, ESTIMATES))), _histograms(arranged)]
    return together(parts)


def _tolerance_row(number, name, unit, statistics):
    """Row of the table `tolerance`."""
    middle = (each for percent in SHORT for each in statistics.percentiles[PERCENTS.index(percent)])
    return (number, name, unit, *statistics.mean, *statistics.sigma, *middle, statistics.least, statistics.greatest, statistics.absent)


def _sure(number, name, unit, statistics):
    """Row of the table `confidence`."""
    spread_ = (each for percent in statistics.percentiles for each in percent)
    return (number, name, unit, statistics.cases, *statistics.mean, *statistics.sigma, *statistics.skewness, *spread_)


def _histograms(arranged):
    """The raw samples of the shown values; the margin of a check with its limit, 0."""
    study = arranged.study
    columns = [
        Column(name, study.unit(name), study.meaning(name) or name, arranged.of(name)[0, arranged.sample], study.label(name))
        for name in arranged.plotted
    ]
    columns = [column for column in columns if len(finite(column.data)) > 1]
    if not columns:
        return Part()
    cases = Column("case", "-", "number of the case", arranged.sample)
    plots = [
        Plot(
            f"histogram.{c.name}",
            f"{c.label}: distribution",
            "sample",
            c.name,
            (c.name,),
            ((0.0, "limit"),) if c.name.startswith(CHECK) else (),
            style="histogram",
        )
        for c in columns
    ]
    title = "The points of the file" if arranged.plan.listed else "The random sample"
    return Part(tables=(Table("sample", title, (cases, *columns)),), plots=tuple(plots))


# -- yield ---------------------------------------------------------------------------------------------------------------------


def _yields(arranged):
    """Table `yield`: each check, and all in one; a failed case passes none, and one that is not complete does not pass all.

    Whether a case passes is decided by its values; the interval of the yield reaches from that of the cases that surely pass, whatever
    their intervals hold, to that of those that may.
    """
    if not arranged.study.check_names:
        return Part()
    rows = [row for name in arranged.study.check_names for row in _of_check(arranged, name)]
    together_ = [(number, ALL, *_shares(each), *Sampled(np.nan), each.undecided) for number, each in enumerate(arranged.tallies())]
    table = table_of_rows("yield", "Share of the cases that pass", YIELD, rows + together_, arranged)
    return Part(dict(_yield_values(together_[0])) if arranged.combinations == 1 else {}, (table,))


def _of_check(arranged, name):
    """Row of each combination that has the check."""
    for number, (each, margins) in enumerate(zip(arranged.tallies(name), arranged.summaries(CHECK + name), strict=True)):
        if each.counted:
            yield number, name, *_shares(each), *capability(margins), each.undecided


def _shares(each):
    return each.passes, each.counted, *each.share


def _yield_values(row):
    what = "share of the cases that are complete and pass every design check"
    estimate = Sampled(*row[4:7])
    yield "yield", estimate.named("-", what)
    for value, (end, words) in list(zip(estimate, BOUNDS, strict=True))[1:]:
        yield f"yield{end}", Value(value, "-", what + words)


def responses(arranged: Arranged) -> Iterator[Response]:
    """`Response`s over the grid: mean and mean -+ sigma of each shown value, its sigma, and the yield, with their intervals."""
    for name in arranged.plotted:
        unit, what, label = arranged.study.unit(name), arranged.study.meaning(name) or name, arranged.study.label(name)
        summaries = arranged.summaries(name)
        (mean, *mean_ends), (sigma, *sigma_ends) = (np.array([getattr(each, part) for each in summaries]).T for part in ("mean", "sigma"))
        lines = (
            (f"mean.{name}", "mean", mean),
            (f"lower.{name}", "mean less one standard deviation", mean - sigma),
            (f"upper.{name}", "mean and one standard deviation", mean + sigma),
        )
        columns = tuple(Column(c, unit, f"{what}, {words}", y, f"{label}, {words}") for c, words, y in lines)
        yield Response(name, f"{label}: mean and standard deviation", columns, ends=columns[0].bounds(*mean_ends))
        alone = Column(f"sigma.{name}", unit, f"{what}, standard deviation", sigma, f"{label}, standard deviation")
        yield Response(alone.name, f"{label}: standard deviation", (alone,), ends=alone.bounds(*sigma_ends))
    if arranged.study.check_names:
        shares, *ends = np.array([each.share for each in arranged.tallies()]).T
        column = Column("yield", "-", "share of the cases that pass every check", shares)
        yield Response("yield", "Yield", (column,), ends=column.bounds(*ends))


# -- corners -------------------------------------------------------------------------------------------------------------------


def worst_case(arranged: Arranged) -> Part:
    """`Part` of the corners: table `worst_case` of all values and of the margins of all checks."""
    block = arranged.block("corners")
    if block is None:
        return Part()
    names = (*arranged.study.value_names, *(CHECK + name for name in arranged.study.check_names))
    rows = [
        (number, name, arranged.study.unit(name), *ends)
        for name in names
        for number, ends in enumerate(_ends(case) for case in arranged.of(name)[:, block])
        if ends[2]
    ]
    if not rows:
        return Part()
    table = table_of_rows("worst_case", "Worst case: every key at an end", WORST, rows, arranged)
    return Part(dict(_worst_values(arranged, rows)) if arranged.combinations == 1 else {}, (table,))


def _ends(case):
    ordered = finite(case)
    return (float(ordered[0]), float(ordered[-1]), len(ordered)) if len(ordered) else (np.nan, np.nan, 0)


def _worst_values(arranged, rows):
    for _, name, unit, least, greatest, _ in rows:
        for end, value in (("least", least), ("greatest", greatest)):
            yield f"worst_case.{end}.{name}", Value(value, unit, **about(arranged.study, name, f"{end} at the corners"))
