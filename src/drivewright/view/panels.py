"""A plot as plain data: which columns share a panel, in which unit, over which range.

Figures and the player's plots both draw these panels, so both show the same thing.
"""

import itertools
from typing import NamedTuple

import numpy as np

from drivewright import registry
from drivewright.errors import UnknownName
from drivewright.result import Plot
from drivewright.view.palette import SERIES
from drivewright.view.text import axis_label, dimension, number, sentence, shown, with_unit

REACH = 8.0  # a panel with a limit shows at most so many times the limit: beyond it (a pole of a radius) the line leaves the panel


class Series(NamedTuple):
    """One column in the unit people read; `unit` as printed, `role` its colour."""

    name: str
    label: str
    unit: str
    data: np.ndarray
    role: str = "ink"


class Panel(NamedTuple):
    """Series of one unit over x, with limit lines (value, text) and the range [low, high] to show."""

    title: str
    label: str
    x: Series
    series: tuple
    limits: tuple
    low: float
    high: float
    equal: bool


def known_plots(result):
    """Name -> Plot of the result's mechanism; none where the kind is not installed here."""
    kinds = registry.kinds()
    return {plot.name: plot for plot in registry.mechanism(result.mechanism).plots} if result.mechanism in kinds else {}


def find_plot(result, name):
    """The mechanism's plot of that name, else a whole table over its first column; UnknownName otherwise."""
    plots = known_plots(result)
    plot = plots.get(name) or (whole_table(result.tables[name]) if name in result.tables else None)
    if plot is None:
        raise UnknownName("table or plot", name, [*result.tables, *plots])
    if plot.table not in result.tables:
        raise UnknownName(f"table for the plot {name!r} (its analysis was left out)", plot.table, result.tables)
    return plot


def whole_table(table):
    """The plot of every column of numbers over the first column."""
    first, *rest = table.columns
    return Plot(table.name, table.title, table.name, first.name, tuple(c.name for c in rest if np.asarray(c.data).dtype.kind in "fiub"))


def drawable(result, plots):
    """Those plots whose table is in the result; an analysis that was left out takes its plots with it."""
    return tuple(plot for plot in plots if plot.table in result.tables)


def panels(result, plot):
    """The panels of a plot, one for each unit among its y columns (at most as many lines in one as there are colours)."""
    table = result.tables[plot.table]
    groups = {}
    for name in plot.y:
        groups.setdefault(table[name].unit, []).append(table[name])
    chunks = [group[i:i + len(SERIES)] for group in groups.values() for i in range(0, len(group), len(SERIES))]
    roles = itertools.cycle(SERIES)  # running on from panel to panel, so that one colour means one line as long as there are enough
    return tuple(_panel(plot, _series(table[plot.x]), _told_apart([_series(c, next(roles)) for c in chunk]), chunk[0].unit,
                        () if n else _limits(result, plot)) for n, chunk in enumerate(chunks))


def _limits(result, plot):
    """(value, label) of every limit line; those of a check that this run did not make are left out."""
    known = {check.name: check.limit for check in result.checks}
    for value, label in plot.limits:
        if not isinstance(value, str):
            yield value, label
        elif (name := value.removeprefix("-")) in known:
            yield (-known[name] if value.startswith("-") else known[name]), label


def _panel(plot, x, series, unit, limits):
    factor, text = shown(unit)
    limits = tuple((value * factor, limit_text(value * factor, label, text)) for value, label in limits)
    label = series[0].label if len(series) == 1 else sentence(dimension(unit))
    low, high = span([s.data for s in series], [value for value, _ in limits])
    return Panel(plot.title, axis_label(label, text), x, tuple(series), limits, low, high, plot.equal)


def _series(column, role="ink"):
    factor, text = shown(column.unit)
    data = np.asarray(column.data)
    return Series(column.name, sentence(column.meaning or column.name), text, data * factor if data.dtype.kind in "fiub" else data, role)


def limit_text(value, label, unit):
    """The words on a limit line: its name and its value, unless the name says the number already."""
    text = number(value, 4)
    return label if text.lstrip("−") in label else f"{label} {with_unit(text, unit)}".strip()


def _told_apart(series):
    """Lines of one panel with the same meaning get the part of their names in which they differ: 'normal force · main'."""
    labels = [s.label for s in series]
    if len(set(labels)) == len(labels):
        return series
    names = [s.name.split(".") for s in series]
    while len(names[0]) > 1 and len({name[-1] for name in names}) == 1 and all(len(name) > 1 for name in names):
        names = [name[:-1] for name in names]
    return [s._replace(label=f"{s.label} · {'.'.join(name)}") for s, name in zip(series, names, strict=True)]


def span(lines, limits=()):
    """(low, high) that shows the finite part of all lines and the limits, with a little air; poles are cut at `REACH` times the limit."""
    data = np.concatenate([np.ravel(line) for line in lines]).astype(float)
    data = data[np.isfinite(data)]
    if limits:
        reach = REACH * max(abs(value) for value in limits)
        data = np.concatenate([np.clip(data, -reach, reach) if reach > 0 else data, limits])
    if not len(data):
        return -1.0, 1.0
    low, high = float(data.min()), float(data.max())
    air = 0.06 * (high - low) or 0.1 * abs(high) or 1.0
    return low - air, high + air


def decimals(low, high, digits=4):
    """Decimals that show a range with so many digits: fixed, so that a running number does not jump."""
    largest = max(abs(low), abs(high), 1e-300)
    return int(np.clip(digits - 1 - np.floor(np.log10(largest)), 0, 9))
