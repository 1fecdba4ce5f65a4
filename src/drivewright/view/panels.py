"""A plot as plain data: which columns share a panel, in which unit, over which range.

Figures and the player's plots both draw these panels, so both show the same thing.
"""

import itertools
import math
from collections.abc import Iterable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from drivewright import registry
from drivewright._typing import ArrayLike, Floats, Ints
from drivewright.errors import UnknownName
from drivewright.labels import label_of, usual_unit
from drivewright.result import Column, Plot, Result, Table
from drivewright.units import SHORT, System
from drivewright.view.axis_names import axis_name
from drivewright.view.lines import Line, lines_of
from drivewright.view.palette import MARKERS, SERIES
from drivewright.view.text import axis_label, number, quantity, sentence, shown_scale, with_unit

REACH = 8.0  # a panel with a limit shows at most so many times the limit: beyond it (a pole of a radius) the line leaves the panel
DECADES = 6  # powers of ten that a logarithmic axis shows at most
MOST_GROUPS = 20  # kinds of points that are distinguished
SMALL_LENGTHS = {"mm": (1e6, "µm"), "inch": (1e3 / 0.0254, "mil")}  # {system: (factor, unit)}
STANDING = ("map", "histogram", "ranked")  # styles whose x is no quantity that a cursor could run along


class Series(NamedTuple):
    """One column in the unit people read; `unit` as printed, `role` its colour, `dashed` where it is a reference, `marker` of points,
    or of a line that has one of its own.

    `ends` are the (low, high) of its 95 % intervals, nan where a value has none; () where no value has one.
    `x` are its own places on the x axis [unit of the panel's x], None where they are the panel's.
    `covered`: how many later lines of the panel lie upon this one at each row (rows,), None where none does.
    """

    name: str
    label: str
    unit: str
    data: NDArray[Any]  # (rows,) numbers or texts
    role: str = "ink"
    dashed: bool = False
    marker: str = ""
    ends: tuple[Floats, ...] = ()
    x: Floats | None = None
    covered: Ints | None = None


class Panel(NamedTuple):
    """Series of one unit over x, with limit lines (value, text) and the range [low, high] to show.

    style: line, points, stems, bars (stacked), grouped (bars side by side), polar (over the angle x), mesh (series: up, depth, colour,
    then right and up of the shape before), map (series: second axis, colour; the range is the colour's), histogram (of its series) or
    ranked (x: labels); `log`: y axis or colour in powers of ten; `shade`: stretches (from, to) of x; `rings`: circles (radius, text);
    `places`: (x, name) of what stands along the x axis.
    """

    title: str
    label: str
    x: Series
    series: tuple[Series, ...]
    limits: tuple[tuple[float, str], ...]
    low: float
    high: float
    equal: bool
    style: str = "line"
    log: bool = False
    shade: tuple[tuple[float, float], ...] = ()
    rings: tuple[tuple[float, str], ...] = ()
    places: tuple[tuple[float, str], ...] = ()


def known_plots(result: Result[Any]) -> dict[str, Plot]:
    """Name -> Plot of the result's mechanism; none where the kind is not installed here."""
    if not registry.is_known(result.mechanism):
        return {}
    plots = registry.mechanism(result.mechanism).plots
    return {plot.name: plot for plot in (plots(result) if callable(plots) else plots)}


def find_plot(result: Result[Any], name: str) -> Plot:
    """The mechanism's plot of that name, else a whole table over its first column; UnknownName otherwise."""
    plots = known_plots(result)
    plot = plots.get(name) or (whole_table(result.tables[name]) if name in result.tables else None)
    if plot is None:
        raise UnknownName("table or plot", name, [*result.tables, *plots])
    if plot.table not in result.tables:
        raise UnknownName(f"table for the plot {name!r} (its analysis was left out)", plot.table, result.tables)
    return plot


def whole_table(table: Table) -> Plot:
    """The plot of every column of numbers over the first column."""
    first, *rest = table.columns
    numbers = (c.name for c in rest if np.asarray(c.data).dtype.kind in "fiub")
    return Plot(table.name, table.title, table.name, first.name, tuple(name for name in numbers if not table.bounded(name)))


def drawable(result: Result[Any], plots: Sequence[Plot]) -> tuple[Plot, ...]:
    """Those plots whose table is in the result; an analysis that was left out takes its plots with it."""
    return tuple(plot for plot in plots if plot.table in result.tables)


def panels(result: Result[Any], plot: Plot, system: System | None = None) -> tuple[Panel, ...]:
    """The panels of a plot, one for each unit among its y columns (at most as many lines in one as there are colours).

    In the units of the result's spec, or of another `system`.
    """
    table, system = result.tables[plot.table], system or result.units
    if plot.style == "mesh":
        return (_mesh_panel(plot, table, system),)
    if plot.style == "map":
        return (_map_panel(result, plot, table, system),)
    if plot.style == "points" and plot.by:
        return tuple(_cloud_panel(result, plot, table, name, system) for name in plot.y)
    x, lines = lines_of(table, plot, system)
    groups = {}
    for line in lines:
        groups.setdefault(line.column.unit, []).append(line)
    most = len(lines) if plot.style in ("bars", "ranked") else len(SERIES)
    chunks = [group[i : i + most] for group in groups.values() for i in range(0, len(group), most)]
    roles = itertools.cycle(SERIES)  # running on from panel to panel, so that one colour means one line as long as there are enough
    shade = _shaded(x, table[plot.shade], system) if plot.shade else ()
    limits = tuple(limits_of(result, plot))
    shown = [in_usual_unit(plot, table, chunk[0].column.unit, () if n else limits) for n, chunk in enumerate(chunks)]
    return tuple(
        panel_of(
            each,
            series_of(x, unit=each.unit if plot.style == "histogram" else "", system=system),
            _coloured(chunk, roles, each.unit, system),
            _label(table, plot, chunk, len(groups) == 1),
            () if n else limits,
            shade,
            system,
        )._replace(places=places_along(plot, x.unit, system))
        for n, (each, chunk) in enumerate(zip(shown, chunks, strict=True))
    )


def in_usual_unit(plot: Plot, table: Table, si_unit: str, limits: Iterable[tuple[float, str]] = ()) -> Plot:
    """The plot with the unit of its y axis in which people read those of its columns that have an SI unit.

    "%" where all are shares, micrometres where all numbers and limits are short lengths; the plot itself where it names a unit, is a
    drawing to scale, or where its columns are read in different units.
    """
    columns = [column for column in map(table.__getitem__, plot.y) if column.unit == si_unit]
    usual = {usual_unit(label_of(column.meaning, column.label), si_unit) for column in columns}
    if plot.unit or plot.equal or len(usual) != 1:
        return plot
    if si_unit == "m" and max((_size(column.data) for column in columns), default=0.0) < SHORT:
        usual = {"um" if all(abs(value) < SHORT for value, _ in limits) else ""}
    return plot._replace(unit=usual.pop())


def _size(data: ArrayLike) -> float:
    """The largest finite magnitude of a column; infinite where all of it is 0, so that nothing is said of its size."""
    finite = np.abs(np.asarray(data, float))
    return float(np.max(finite, initial=0.0, where=np.isfinite(finite))) or math.inf


def _label(table: Table, plot: Plot, chunk: Sequence[Line], alone: bool) -> tuple[str, str]:
    """(name, SI unit) of the y axis: that of the only column, also of one that another one splits into lines, else `axis_name`."""
    unit = chunk[0].column.unit
    columns = [table[name] for name in plot.y if table[name].unit == unit] if plot.by else [line.column for line in chunk]
    meanings = [column.meaning or column.name for column in columns]
    return (meanings[0] if len(columns) == 1 else axis_name(meanings, unit, plot.title, alone)), unit


def _cloud_panel(result: Result[Any], plot: Plot, table: Table, name: str, system: System) -> Panel:
    """Points of a column told apart by colour and shape; the rows of the other groups are nan."""
    limits = tuple(limits_of(result, plot)) if name == plot.y[0] else ()
    plot = in_usual_unit(plot, table, table[name].unit, limits)
    column = series_of(table[name], ends=table.bounds_of(name) or (), unit=plot.unit, system=system)
    names, group = _groups(table[plot.by], system)

    def member(n, name):
        data, *ends = (np.where(group == n, each, np.nan) for each in (column.data, *column.ends))
        return column._replace(
            name=f"{column.name}.{name}",
            label=name,
            data=data,
            ends=tuple(ends),
            role=SERIES[n % len(SERIES)],
            marker=MARKERS[n % len(MARKERS)],
        )

    series = [member(n, name) for n, name in enumerate(names)]
    x = series_of(table[plot.x], system=system)
    return panel_of(plot, x, series or [column], (column.label, table[name].unit), limits, (), system)


def _groups(by: Column, system: System) -> tuple[list[str], NDArray[np.int64]]:
    """(names, number of the group of each row): texts as they come, numbers rising; the last of very many are one group."""
    is_text = np.asarray(by.data).dtype.kind not in "fiub"
    values, first, group = np.unique(np.asarray(by.data).astype(str) if is_text else by.data, return_index=True, return_inverse=True)
    order = np.argsort(first) if is_text else np.arange(len(values))
    names = [sentence(str(v)) if is_text else f"{sentence(by.name)} {quantity(v, by.unit, 4, system)}" for v in values[order]]
    place = np.argsort(order)[group]
    if len(names) > MOST_GROUPS:
        names = [*names[: MOST_GROUPS - 1], f"{len(names) - MOST_GROUPS + 1} more"]
    return names, np.minimum(place, len(names) - 1)


def _coloured(chunk: Sequence[Line], roles: Iterator[str], unit: str, system: System) -> list[Series]:
    """Series of some lines, each line in its colour."""
    series = []
    for line in chunk:
        references = (series_of(column, "ink", dashed=True, unit=unit, system=system) for column in line.references)
        series += [series_of(line.column, next(roles), ends=line.ends, unit=unit, system=system), *references]
    return _with_distinct_labels(series)


def _shaded(x: Column, column: Column, system: System) -> tuple[tuple[float, float], ...]:
    """Stretches (from, to) of x, as shown, in which a column is above 0; each sample stands for half the way to its neighbours."""
    place = shown_scale(x.unit, system=system).of(np.asarray(x.data))
    edges = np.concatenate([place[:1], (place[1:] + place[:-1]) / 2, place[-1:]])
    on = np.concatenate([[0], np.asarray(column.data) > 0, [0]])
    starts, ends = np.flatnonzero(np.diff(on) == 1), np.flatnonzero(np.diff(on) == -1)
    return tuple((float(edges[a]), float(edges[b])) for a, b in zip(starts, ends, strict=True))


def limits_of(result: Result[Any], plot: Plot) -> Iterator[tuple[float, str]]:
    """(value, label) of every limit line; those of a check that this run did not make are left out."""
    known = {check.name: check.limit for check in result.checks}
    for value, label in plot.limits:
        if not isinstance(value, str):
            yield value, label
        elif (name := value.removeprefix("-")) in known:
            yield (-known[name] if value.startswith("-") else known[name]), label


def places_along(plot: Plot, unit: str, system: System = "mm") -> tuple[tuple[float, str], ...]:
    """(x, name) of what stands along the x axis, x in the unit people read."""
    shown = shown_scale(unit, system=system)
    return tuple((shown.of(place), name) for place, name in plot.places)


def panel_of(
    plot: Plot,
    x: Series,
    series: Sequence[Series],
    label: tuple[str, str],
    limits: Iterable[tuple[float, str]],
    shade: tuple[tuple[float, float], ...] = (),
    system: System = "mm",
) -> Panel:
    """The panel of some series in the style of a plot; `label` (name, SI unit) of the y axis, `limits` (value [SI], name)."""
    shown = shown_scale(label[1], plot.unit, system)
    limits = tuple((shown.of(value), limit_text(shown.of(value), label, shown.unit)) for value, label in limits)
    rings = tuple((shown.of(radius), limit_text(shown.of(radius), label, shown.unit)) for radius, label in plot.rings)
    lines, values = [each for s in series for each in (s.data, *s.ends)], [value for value, _ in limits]
    if plot.style == "bars":
        data, ends = [s.data for s in series], series[0].ends if len(series) == 1 else ()
        lines = [np.maximum(data, 0.0).sum(axis=0), np.minimum(data, 0.0).sum(axis=0), *ends]
    if plot.log:
        low, high = log_span(lines, values)
    else:
        low, high = span(lines, values + [0.0] * (plot.style in ("stems", "grouped")), np.inf if plot.whole else REACH)
    return Panel(
        sentence(plot.title),
        axis_label(sentence(label[0]), shown.unit),
        x,
        tuple(series),
        limits,
        low,
        high,
        plot.equal,
        plot.style,
        plot.log,
        shade,
        rings,
    )


def _mesh_panel(plot: Plot, table: Table, system: System) -> Panel:
    """The panel of a surface: series up, depth and colour (small lengths, as deflections are), then the dashed right and up of the surface
    before."""
    up, depth, colour = (series_of(table[name], system=system) for name in plot.y)
    if table[plot.y[2]].unit == "m" and system in SMALL_LENGTHS:
        factor, unit = SMALL_LENGTHS[system]
        colour = colour._replace(unit=unit, data=np.asarray(table[plot.y[2]].data) * factor)
    before = tuple(series_of(table[name], dashed=True, system=system) for name in plot.reference)
    label, x = axis_label(up.label, up.unit), series_of(table[plot.x], system=system)
    return Panel(plot.title, label, x, (up, depth, colour, *before), (), *span([up.data]), True, "mesh", plot.log)


def _map_panel(result: Result[Any], plot: Plot, table: Table, system: System) -> Panel:
    """The panel of cells over two axes; its range and its limits are those of the colour."""
    contours = tuple(limits_of(result, plot))
    colour = in_usual_unit(plot._replace(y=plot.y[1:]), table, table[plot.y[1]].unit, contours).unit
    up, tint = series_of(table[plot.y[0]], system=system), series_of(table[plot.y[1]], unit=colour, system=system)
    shown = shown_scale(table[plot.y[1]].unit, colour, system)
    limits = tuple((shown.of(value), limit_text(shown.of(value), label, shown.unit)) for value, label in contours)
    finite = np.asarray(tint.data, float)
    finite = finite[np.isfinite(finite) & (finite > 0)] if plot.log else finite[np.isfinite(finite)]
    low, high = (float(finite.min()), float(finite.max())) if len(finite) else (np.nan, np.nan)
    label, x = axis_label(up.label, up.unit), series_of(table[plot.x], system=system)
    return Panel(sentence(plot.title), label, x, (up, tint), limits, low, high, False, "map", plot.log)


def series_of(
    column: Column, role: str = "ink", dashed: bool = False, ends: Sequence[Column] = (), unit: str = "", system: System = "mm"
) -> Series:
    """A column in the unit people read, or in another `unit`; `ends` are the columns of its intervals."""
    shown = shown_scale(column.unit, unit, system)
    data = np.asarray(column.data)
    # Whole numbers stay whole, so that their axis has whole ticks.
    if data.dtype.kind in "fb" or (data.dtype.kind in "iu" and (shown.factor, shown.zero) != (1, 0)):
        data = shown.of(data)
    return Series(
        column.name,
        sentence(column.meaning or column.name),
        shown.unit,
        data,
        role,
        dashed,
        ends=tuple(shown.of(np.asarray(end.data, float)) for end in ends),
    )


def limit_text(value: float, label: str, unit: str) -> str:
    """The words on a limit line: its name and its value, unless the name says the number already."""
    text = number(value, 4)
    return label if text.lstrip("−") in label else f"{label} {with_unit(text, unit)}".strip()


def _with_distinct_labels(series: list[Series]) -> list[Series]:
    """Lines of one panel with the same meaning get the part of their names in which they differ: 'normal force · main'."""
    labels = [s.label for s in series]
    if len(set(labels)) == len(labels):
        return series
    names = [s.name.split(".") for s in series]
    while len(names[0]) > 1 and len({name[-1] for name in names}) == 1 and all(len(name) > 1 for name in names):
        names = [name[:-1] for name in names]
    return [s._replace(label=f"{s.label} · {'.'.join(name)}") for s, name in zip(series, names, strict=True)]


def span(lines: Sequence[ArrayLike], limits: Sequence[float] = (), reach: float = REACH) -> tuple[float, float]:
    """(low, high) that shows the finite part of all lines and the limits, with a little air; poles are cut at `reach` times the limit."""
    data = np.concatenate([np.ravel(line) for line in lines]).astype(float)
    data = data[np.isfinite(data)]
    if limits:
        largest = max(abs(value) for value in limits)
        data = np.concatenate([np.clip(data, -reach * largest, reach * largest) if largest > 0 else data, limits])
    if not len(data):
        return -1.0, 1.0
    low, high = float(data.min()), float(data.max())
    air = 0.06 * (high - low) or 0.1 * abs(high) or 1.0
    return low - air, high + air


def log_span(lines: Sequence[ArrayLike], limits: Sequence[float] = ()) -> tuple[float, float]:
    """(low, high) of the positive part of all lines and the limits, with a little air, over `DECADES` powers of ten at most."""
    data = np.concatenate([*(np.ravel(line) for line in lines), limits]).astype(float)
    data = data[np.isfinite(data) & (data > 0)]
    if not len(data):
        return 0.1, 1.0
    high = float(data.max())
    low = max(float(data.min()), high / 10.0**DECADES)
    air = (high / low) ** 0.06 if high > low else 2.0
    return low / air, high * air


def decimals(low: float, high: float, digits: int = 4) -> int:
    """Decimals that show a range with so many digits: fixed, so that a running number does not jump."""
    largest = max(abs(low), abs(high), 1e-300)
    return int(np.clip(digits - 1 - np.floor(np.log10(largest)), 0, 9))
