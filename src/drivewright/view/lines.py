"""Which columns of a table are lines of a plot, with what each is compared with and the intervals of its values."""

from typing import NamedTuple

import numpy as np

from drivewright.result import Column, Plot, Table
from drivewright.units import System
from drivewright.view.text import quantity


class Line(NamedTuple):
    """A column to draw, those that it is compared with, and the columns (low, high) of its intervals."""

    column: Column
    references: tuple[Column, ...] = ()
    ends: tuple[Column, ...] = ()


def lines_of(table: Table, plot: Plot, system: System = "mm") -> tuple[Column, list[Line]]:
    """(x column, lines) of a plot; levels of the column `by` are named in a system of units."""
    return LINES[plot.style](table, plot) if plot.style in LINES else _grouped(table, plot, system) if plot.by else _compared(table, plot)


def _compared(table: Table, plot: Plot) -> tuple[Column, list[Line]]:
    """(x column, lines): every line a column, with its reference behind it where there is one."""
    references = [(table[name],) for name in plot.reference]
    references += [()] * (len(plot.y) - len(references))
    return table[plot.x], [_line(table, name, reference) for name, reference in zip(plot.y, references, strict=True)]


def _line(table: Table, name: str, references: tuple[Column, ...] = ()) -> Line:
    return Line(table[name], references, table.bounds_of(name) or ())


def _grouped(table: Table, plot: Plot, system: System) -> tuple[Column, list[Line]]:
    """(x column, lines): for every y column a line for each value of the column `by`, over all values of x; gaps are nan."""
    by, x = table[plot.by], table[plot.x]
    values, group = np.unique(by.data, return_inverse=True)
    places, place = np.unique(x.data, return_inverse=True)
    levels = [str(v) if values.dtype.kind not in "fiub" else quantity(v, by.unit, 4, system) for v in values]

    def split(column):
        data = np.full((len(values), len(places)), np.nan)
        data[group, place] = column.data
        return [
            column._replace(name=f"{column.name}.{text}", meaning=f"{plot.by} {text}", data=row)
            for text, row in zip(levels, data, strict=True)
        ]

    lines = []
    for line in (_line(table, name) for name in plot.y):
        ends = [split(end) for end in line.ends]
        lines += [Line(column, (), tuple(end[n] for end in ends)) for n, column in enumerate(split(line.column))]
    return x._replace(data=places), lines


def _ranked(table: Table, plot: Plot) -> tuple[Column, list[Line]]:
    """(labels, lines): the rows in the order of the first y column's magnitude, what has none last; with it the ends of its error bars."""
    first = np.asarray(table[plot.y[0]].data, float)
    order = np.argsort(-np.where(np.isfinite(first), np.abs(first), -1.0), kind="stable")

    def ordered(column):
        return column._replace(data=np.asarray(column.data)[order])

    lines = [_line(table, name) for name in plot.y]
    lines[0] = lines[0]._replace(ends=tuple(table[name] for name in plot.reference) or lines[0].ends)
    return ordered(table[plot.x]), [Line(ordered(line.column), (), tuple(map(ordered, line.ends))) for line in lines]


def _samples(table: Table, plot: Plot) -> tuple[Column, list[Line]]:
    """(samples, lines) of a histogram."""
    return table[plot.y[0]], [Line(table[plot.y[0]])]


LINES = {"ranked": _ranked, "histogram": _samples}
