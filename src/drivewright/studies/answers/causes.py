"""Which keys cause the spread of which value: the tables and plots of `sensitivity`."""

from collections.abc import Iterator

import numpy as np

from drivewright._typing import Floats
from drivewright.result import Column, Plot, Table, Value
from drivewright.studies import sensitivity
from drivewright.studies.answers.maps import Response
from drivewright.studies.answers.parts import BOUNDS, Arranged, Part, about, table_of_rows, together
from drivewright.studies.answers.within import variances
from drivewright.studies.statistics import Sampled, varies

LINEAR, REGRESSION, RANKS = "linear", "regression", "ranks"
METHODS = {LINEAR: "linear theory from steps", REGRESSION: "squared regression coefficients", RANKS: "first-order Sobol indices by ranks"}
CONTRIBUTIONS = (
    ("value", "", "value of the result"),
    ("key", "", "key that varies"),
    ("method", "", "how it is found"),
    *(("share" + end, "-", "share of the variance that the key causes" + suffix) for end, suffix in BOUNDS),
)
THEORY = (
    ("value", "", "value of the result"),
    ("unit", "", "unit of the value"),
    ("key", "", "key that varies"),
    ("slope", "", "change of the value by change of the key, in units of both"),
    ("sigma", "", "standard deviation of the value that the key causes"),
    ("share", "-", "share of the variance"),
    ("curvature", "", "sum of the changes by a step up and a step down; 0 where the value is linear in the key"),
)
TOTALS = (
    ("value", "", "value of the result"),
    ("unit", "", "unit of the row's numbers"),
    ("nominal", "", "with all keys at their means"),
    ("sigma", "", "standard deviation by root sum of squares"),
    ("least", "", "worst case of linear theory, least"),
    ("greatest", "", "worst case of linear theory, greatest"),
)
INDICES = (
    ("value", "", "value of the result"),
    ("key", "", "key that varies"),
    *(
        (name + end, "-", meaning + suffix)
        for name, meaning in (
            ("first_order", "share of the variance by the key alone"),
            ("total", "share of the variance in which the key takes part"),
        )
        for end, suffix in BOUNDS
    ),
    ("rows", "-", "base cases"),
    ("dropped", "-", "base cases left out because one of their cases has no value"),
)


def causes(arranged: Arranged) -> Part:
    """`Part` of what the spread comes from, as far as the plan's blocks tell it."""
    return together([_linear(arranged), _contributions(arranged), _indices(arranged)])


def _each(arranged):
    """(value, it and its variance within a case, both (combinations, points)) of the values that vary."""
    for name in arranged.study.value_names:
        samples = arranged.of(name)
        if varies(samples):
            yield name, samples, _noise(arranged, name)


def _noise(arranged, name):
    """Variance of a value within each case (combinations, points); 0 where it has no interval."""
    noise = variances(arranged, name)
    return np.zeros((arranged.combinations, arranged.plan.inner)) if noise is None else noise


def _keys(arranged):
    return tuple(variable.key for variable in arranged.plan.random)


# -- linear theory -------------------------------------------------------------------------------------------------------------


def theories(arranged: Arranged, name: str) -> list[sensitivity.Linear]:
    """`sensitivity.Linear` of a value in each combination; none without steps."""
    return _theories(arranged, arranged.of(name), _noise(arranged, name))


def _theories(arranged, samples, noise):
    """The same of a value by combination and point, and its variance within each case."""
    nominal, steps = arranged.block("nominal"), arranged.block("steps")
    if steps is None:
        return []
    distributions = [variable.distribution for variable in arranged.plan.random]
    sigmas, means = (np.array([getattr(each, what)() for each in distributions]) for what in ("std", "mean"))
    deviations = np.array([variable.ends for variable in arranged.plan.random]) - means[:, None]
    return [
        sensitivity.linear(row[nominal][0], row[steps], sigmas, deviations, within[steps])
        for row, within in zip(samples, noise, strict=True)
    ]


def _linear(arranged):
    """Tables `linear` (each key) and `linear_totals`."""
    rows, totals = [], []
    for name, samples, noise in _each(arranged):
        unit = arranged.study.unit(name)
        for number, theory in enumerate(_theories(arranged, samples, noise)):
            nominal = samples[number, arranged.block("nominal")][0]
            columns = (theory.slope, np.sqrt(theory.contribution), theory.share, theory.curvature)
            rows += [(number, name, unit, key, *row) for key, *row in zip(_keys(arranged), *columns, strict=True)]
            totals.append((number, name, unit, nominal, theory.sigma, theory.least, theory.greatest))
    if not rows:
        return Part()
    tables = (
        table_of_rows("linear", "Linear theory, key by key", THEORY, rows, arranged),
        table_of_rows("linear_totals", "Linear theory, all keys together", TOTALS, totals, arranged),
    )
    return Part(dict(_linear_values(arranged, totals)) if arranged.combinations == 1 else {}, tables)


def _linear_values(arranged, totals):
    for _, name, unit, _, sigma, least, greatest in totals:
        study = arranged.study
        yield f"linear.sigma.{name}", Value(sigma, unit, **about(study, name, "standard deviation by root sum of squares"))
        yield f"linear.least.{name}", Value(least, unit, **about(study, name, "worst case of linear theory, least"))
        yield f"linear.greatest.{name}", Value(greatest, unit, **about(study, name, "worst case of linear theory, greatest"))


# -- shares --------------------------------------------------------------------------------------------------------------------


class _Sample:
    """The points of a random sample or of a file, ready for every value; `order` is None where neighbours are not random."""

    def __init__(self, arranged):
        plan, self.rows = arranged.plan, arranged.sample
        made = plan.block("mixed") is not None or not len(self.rows)
        columns = {} if made else _numbers(plan.listed) if plan.listed else dict(zip(_keys(arranged), plan.points[:].T, strict=True))
        self.keys = tuple(columns)
        self.x = np.array([column[self.rows] for column in columns.values()]).T
        ranked = columns and not plan.listed and arranged.study.spec.study.method != "sobol"
        self.order = sensitivity.orders(self.x) if ranked else None

    def shares(self, y, noise):
        """({method: shares of the keys with the ends of their intervals (3, keys)}, `Sampled` determination of the regression) of a value
        at all points, whose variance within each case, `noise`, no key causes: the shares are those of what is left."""
        if not self.keys:
            return {}, Sampled(np.nan)
        y = y[self.rows]
        more = 1 / sensitivity.share_by_keys(y, noise[self.rows])
        regression = sensitivity.regression(self.x, y)
        by_method = {REGRESSION: more * regression.shares}
        if self.order is not None:
            by_method[RANKS] = more * sensitivity.ranked_shares(self.order, y)
        determined = Sampled(*(more * each for each in regression.determined))
        return {method: shares for method, shares in by_method.items() if np.any(np.isfinite(shares[0]))}, determined


def exactly(shares: Floats) -> Floats:
    """Shares without an interval (3, keys)."""
    return np.stack([shares, *np.full((2, len(shares)), np.nan)])


def _with_ends(column, low, high):
    """A column, with the ends of its intervals where it has some."""
    return (column, *column.bounds(low, high)) if np.any(np.isfinite(low)) else (column,)


def _numbers(listed):
    """{key: numbers} of the columns of a file of points that are numbers and vary."""
    return {variable.key: column.astype(float) for variable, column in listed.items() if column.dtype.kind in "iuf" and varies(column)}


def _contributions(arranged):
    """Table `contributions`: value, key, method, share; a wide table and a plot of each shown value."""
    sample, rows, wide, fits = _Sample(arranged), [], {}, {}
    for name, samples, noise in _each(arranged):
        theories = _theories(arranged, samples, noise)
        for number, y in enumerate(samples):
            shares, determination = sample.shares(y, noise[number])
            if theories and np.any(np.isfinite(theories[number].share)):
                shares = {LINEAR: exactly(theories[number].share)} | shares
            wide[name, number], fits[name] = shares, determination
            rows += [
                (number, name, key, method, *part)
                for method, parts in shares.items()
                for key, part in zip(sample.keys or _keys(arranged), parts.T, strict=True)
            ]
    if not rows:
        return Part()
    table = table_of_rows("contributions", "Contributions to the variance", CONTRIBUTIONS, rows, arranged)
    plots = _ranked(arranged, sample.keys or _keys(arranged), wide) if arranged.combinations == 1 else Part()
    values = {
        f"determination.{name}": fit.named("-", **about(arranged.study, name, "share of the variance that a linear fit explains, R²"))
        for name, fit in fits.items()
        if arranged.combinations == 1 and np.isfinite(fit.value)
    }
    return together([Part(values, (table,), findings=tuple(_remarks(rows, len(sample.rows)))), plots])


def _remarks(rows, cases):
    if any(row[3] == RANKS for row in rows):
        yield (
            f"contributions by ranks come from {cases} cases and scatter by about {1 / np.sqrt(cases):.2g}; "
            "a small one may come out below 0"
        )


def _ranked(arranged, keys, wide):
    """A table and a plot of ranked bars for each shown value."""
    tables, plots = [], []
    for name in arranged.plotted:
        if shares := wide.get((name, 0)):
            table = Table(
                f"contributions.{name}",
                f"{arranged.study.label(name)}: contributions to its variance",
                (
                    Column("key", "", "key that varies", np.array(keys)),
                    *(
                        column
                        for method, parts in shares.items()
                        for column in _with_ends(Column(method, "-", METHODS[method], parts[0]), *parts[1:])
                    ),
                ),
            )
            tables.append(table)
            plots.append(
                Plot(table.name, f"{arranged.study.label(name)}: shares in its variance", table.name, "key", tuple(shares), style="ranked")
            )
    return Part(tables=tuple(tables), plots=tuple(plots))


def responses(arranged: Arranged) -> Iterator[Response]:
    """`Response`s over the grid: the share of each key in the variance of the shown values, by the first method that there is."""
    sample = _Sample(arranged)
    for name in arranged.plotted:
        samples, noise = arranged.of(name), _noise(arranged, name)
        theories = _theories(arranged, samples, noise)
        keys = _keys(arranged) if theories else sample.keys
        shares = [theory.share for theory in theories] or [
            sample.shares(*row)[0].get(REGRESSION, np.full((3, len(keys)), np.nan))[0] for row in zip(samples, noise, strict=True)
        ]
        columns = tuple(
            Column(f"share.{name}.{key}", "-", f"share of {key}", part)
            for key, part in zip(keys, np.array(shares).T, strict=True)
            if np.any(np.isfinite(part))
        )
        if columns:
            yield Response(f"shares.{name}", f"{arranged.study.label(name)}: shares in its variance", columns)


# -- Sobol indices -------------------------------------------------------------------------------------------------------------


def _indices(arranged):
    """Table `indices` from a sample made for it, and for each shown value a table and a plot."""
    if arranged.block("mixed") is None:
        return Part()
    rows = [
        (number, name, key, *row)
        for name, samples, noise in _each(arranged)
        for number, y in enumerate(samples)
        for key, row in zip(_keys(arranged), _index_rows(arranged, y, noise[number]), strict=True)
    ]
    if not rows:
        return Part()
    table = table_of_rows("indices", "Sobol indices", INDICES, rows, arranged)
    shown = [_index_plot(arranged, name, rows) for name in arranged.plotted] if arranged.combinations == 1 else []
    dropped = max(row[-1] for row in rows)
    remark = (
        (
            f"up to {dropped} of {dropped + min(row[-2] for row in rows)} base cases are left out of the Sobol indices, because one of "
            "their cases has no value",
        )
        if dropped
        else ()
    )
    return together([Part(tables=(table,), findings=remark), *(part for part in shown if part)])


def _index_rows(arranged, y, noise):
    """Row of each key."""
    blocks = [arranged.block(name) for name in ("a", "b", "mixed")]
    (a, b, mixed), within = ([column[block] for block in blocks] for column in (y, noise))
    indices = sensitivity.indices(a, b, mixed.reshape(-1, len(a)), (within[0], within[1], within[2].reshape(-1, len(a))))
    return [
        (s, *s_ends, t, *t_ends, indices.rows, indices.dropped)
        for s, s_ends, t, t_ends in zip(indices.first, indices.first_interval, indices.total, indices.total_interval, strict=True)
    ]


def _index_plot(arranged, name, rows):
    rows = [row[2:-2] for row in rows if row[1] == name and np.isfinite(row[3])]
    if not rows:
        return None
    columns = [Column(*head, np.array(data)) for head, data in zip(INDICES[1:-2], zip(*rows, strict=True), strict=True)]
    table = Table(f"indices.{name}", f"Sobol indices of {name}", tuple(columns))
    plot = Plot(
        table.name,
        f"{arranged.study.label(name)}: shares in its variance",
        table.name,
        "key",
        ("first_order", "total"),
        style="ranked",
        reference=("first_order.low", "first_order.high"),
    )
    return Part(tables=(table,), plots=(plot,))
