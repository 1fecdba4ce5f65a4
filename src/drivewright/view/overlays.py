"""A plot of several designs in one picture: a panel for each quantity, in it a curve for each design."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.errors import InputError, UnknownName
from drivewright.result import Column, Plot, Result
from drivewright.units import System
from drivewright.view.axis_names import common_phrase
from drivewright.view.coincident import show_coincident
from drivewright.view.lines import Line, lines_of
from drivewright.view.markers import line_marker
from drivewright.view.palette import SERIES
from drivewright.view.panels import (
    Panel,
    Series,
    drawable,
    find_plot,
    in_usual_unit,
    known_plots,
    limits_of,
    panel_of,
    panels,
    places_along,
    series_of,
)
from drivewright.view.text import shown_scale

MOST_PANELS = 12  # quantities of one plot that are drawn
APART = ("map", "mesh", "histogram")  # styles whose pictures cannot lie upon each other
FEW_BARS = 25  # places along x up to which bars of several designs can stand side by side
CURVES = ("points", "stems", "polar", "ranked", "line")  # styles that stay as they are; the others are bars


class Overlay(NamedTuple):
    """Panels of a plot of several designs; `left_out` counts the quantities of one design only, and those beyond `MOST_PANELS`."""

    panels: tuple[Panel, ...]
    left_out: int = 0


class Curve(NamedTuple):
    """A column of one design over its own x, shown in a system of units, which all curves share."""

    design: int
    plot: Plot
    x: Column
    line: Line
    system: System = "mm"


def common_plots(results: Sequence[Result[Any]]) -> dict[str, list[int]]:
    """{name of a plot: numbers of the results that have it}, of those that at least two have."""
    found: dict[str, list[int]] = {}
    for number, result in enumerate(results):
        for plot in drawable(result, tuple(known_plots(result).values())):
            found.setdefault(plot.name, []).append(number)
    return {name: numbers for name, numbers in found.items() if len(numbers) > 1}


def overlay(results: Sequence[Result[Any]], labels: Sequence[str], name: str) -> Overlay:
    """The plot of that name, or a whole table over its first column, of all results that have it.

    In the units of the first spec.
    UnknownName where none has it; InputError for a style whose pictures cannot lie upon each other (`apart`).
    """
    chosen = _plots(results, name)
    style = next(iter(chosen.values())).style
    if style in APART:
        raise InputError(f"plot {name!r}: pictures of style {style!r} cannot lie upon each other; draw each with result.plot({name!r}).")
    quantities = _quantities(results, chosen)
    shared = [curves for curves in quantities.values() if len(curves) > 1] or list(quantities.values())
    shown = shared[:MOST_PANELS]
    if style == "ranked":
        return Overlay(_ranked(shown, labels), len(quantities) - len(shown))
    common = _common_places([curve.x for curves in shown for curve in curves])
    return Overlay(tuple(_panel(results, labels, curves, common) for curves in shown), len(quantities) - len(shown))


def is_apart(results: Sequence[Result[Any]], name: str) -> bool:
    """Whether a plot has a picture for each design."""
    return any(plot.style in APART for plot in _plots(results, name).values())


def apart(results: Sequence[Result[Any]], labels: Sequence[str], name: str) -> list[tuple[Panel, ...]]:
    """The panels of a plot for each result that has it, titled with the design; maps have one range of colours."""
    chosen = _plots(results, name)
    drawn = [(labels[number], panels(results[number], plot, results[0].units)) for number, plot in chosen.items()]
    ends = [end for _, shown in drawn for panel in shown for end in (panel.low, panel.high) if np.isfinite(end)]
    same = {"low": min(ends), "high": max(ends)} if ends and all(plot.style == "map" for plot in chosen.values()) else {}
    return [tuple(panel._replace(title=f"{panel.title} – {label}", **same) for panel in shown) for label, shown in drawn]


def _plots(results, name):
    """{number of a result: its plot of that name}; the reason of the first one where none has it."""
    found, reasons = {}, []
    for number, result in enumerate(results):
        try:
            found[number] = find_plot(result, name)
        except UnknownName as error:
            reasons.append(error)
    if not found:
        raise reasons[0]
    return found


def _quantities(results, chosen):
    """{(column, unit): curves}, each quantity with a curve for each design that has it over an x of the first design's unit."""
    found: dict[tuple[str, str], list[Curve]] = {}
    unit = None
    for number, plot in chosen.items():
        plot = plot._replace(by="") if plot.style == "points" else plot
        x, lines = lines_of(results[number].tables[plot.table], plot, results[0].units)
        unit = x.unit if unit is None else unit
        for line in lines if x.unit == unit else ():
            curves = found.setdefault((line.column.name, line.column.unit), [])
            if curves:
                shown = plot._replace(unit=curves[0].plot.unit)  # all designs in the unit of the first
            else:
                shown = in_usual_unit(plot, results[number].tables[plot.table], line.column.unit, limits_of(results[number], plot))
            curves.append(Curve(number, shown, x, line, results[0].units))
    return found


def _common_places(columns):
    """(names, {name: place}) of columns of texts, in the order in which they come; None for columns of numbers."""
    if all(np.asarray(column.data).dtype.kind in "fiub" for column in columns):
        return None
    names = list(dict.fromkeys(str(each) for column in columns for each in column.data))
    return names, {name: place for place, name in enumerate(names)}


def _panel(results, labels, curves, common):
    """The panel of one quantity."""
    first = curves[0]
    names = np.array(common[0]) if common else None
    series = [each for curve in curves for each in _curves_of(curve, labels[curve.design], common, curve is first)]
    style = _style(first.plot, max(len(common[0]) if common else len(np.asarray(curve.x.data)) for curve in curves))
    plot = first.plot._replace(style=style, rings=tuple(_told(_all_rings(curves, labels))))
    x = series_of(first.x, system=first.system)
    x = x if names is None else x._replace(data=names)
    label = _meaning(results, curves), first.line.column.unit
    drawn = panel_of(plot, x, series, label, _limits(results, labels, curves), system=first.system)
    return show_coincident(drawn._replace(places=_shared_places(curves)))


def _shared_places(curves):
    """What stands at the same place along x in all designs, by the same name."""
    each = [places_along(curve.plot, curve.x.unit, curve.system) for curve in curves]
    return tuple(place for place in each[0] if all(place in other for other in each[1:]))


def _style(plot, places):
    """Bars of several designs stand side by side, and where those are too many they are lines."""
    return plot.style if plot.style in CURVES else "grouped" if places <= FEW_BARS else "line"


def _curves_of(curve, label, common, first):
    """Series of a design: its curve, then what that is compared with, which the legend names once."""
    place, about = _place(curve, common), {"unit": curve.plot.unit, "system": curve.system}
    own = series_of(curve.line.column, _role(curve), ends=curve.line.ends, **about)
    own = own._replace(name=label, label=label, x=place, marker=line_marker(curve.design))
    compared = [series_of(column, _role(curve), dashed=True, **about) for column in curve.line.references]
    return [own, *(each._replace(label=each.label if first else "", x=place) for each in compared)]


def _role(curve):
    return SERIES[curve.design % len(SERIES)]


def _place(curve: Curve, common: tuple[list[str], dict[str, int]] | None) -> Floats:
    """Places along x in the unit people read, of texts those of all designs."""
    if common:
        return np.array([common[1][str(each)] for each in curve.x.data], float)
    return shown_scale(curve.x.unit, system=curve.system).of(np.asarray(curve.x.data, float))


def _meaning(results, curves):
    """What the quantity is, in the words that all designs have for it, with the level of the column that splits it."""
    first = curves[0]
    words = common_phrase([curve.line.column.meaning for curve in curves]) or first.line.column.meaning or first.line.column.name
    if not first.plot.by:
        return words
    column = results[first.design].tables[first.plot.table][first.plot.y[0]]
    return f"{column.meaning or column.name}, {words}"


def _limits(results, labels, curves):
    """(value, name) of the limits of all designs, in the panels of the unit that they belong to."""
    named = []
    for curve in curves:
        result, plot = results[curve.design], curve.plot
        if curve.line.column.unit == result.tables[plot.table][plot.y[0]].unit:
            named += [(value, text, labels[curve.design]) for value, text in limits_of(result, plot)]
    return _told(named)


def _all_rings(curves, labels):
    return [(radius, text, labels[curve.design]) for curve in curves for radius, text in curve.plot.rings]


def _told(named: Sequence[tuple[float, str, str]]) -> list[tuple[float, str]]:
    """(value, name) of lines (value, name, design): what is the same for all designs once, else with the design."""
    values: dict[str, dict[str, set[float]]] = {}
    for value, text, label in named:
        values.setdefault(text, {}).setdefault(label, set()).add(value)
    same = {text for text, of_design in values.items() if len(set(map(frozenset, of_design.values()))) == 1}
    return list(dict.fromkeys((value, text if text in same else f"{text} ({label})") for value, text, label in named))


def _ranked(quantities: Sequence[Sequence[Curve]], labels: Sequence[str]) -> tuple[Panel, ...]:
    """Panels of lying bars: a row for each label of any design, the largest of the first quantity on top."""
    names = list(dict.fromkeys(str(each) for curves in quantities for curve in curves for each in curve.x.data))
    data = {id(curve): _by_name(curve, names) for curves in quantities for curve in curves}
    sizes = np.array([np.abs(data[id(curve)]) for curve in quantities[0]])
    order = np.argsort(-np.where(np.isfinite(sizes), sizes, -1.0).max(axis=0), kind="stable")
    return tuple(
        _ranked_panel(curves, labels, np.array(names)[order], [data[id(curve)][order] for curve in curves]) for curves in quantities
    )


def _ranked_panel(curves, labels, names, data) -> Panel:
    column, system = curves[0].line.column, curves[0].system
    series = [
        Series(labels[curve.design], labels[curve.design], shown_scale(column.unit, curve.plot.unit, system).unit, each, _role(curve))
        for curve, each in zip(curves, data, strict=True)
    ]
    x, label = series_of(curves[0].x)._replace(data=names), (column.meaning or column.name, column.unit)
    return panel_of(curves[0].plot, x, series, label, (), system=system)


def _by_name(curve: Curve, names: Sequence[str]) -> Floats:
    """The curve's numbers at the names, nan where it has none."""
    shown = series_of(curve.line.column, unit=curve.plot.unit, system=curve.system)
    known = dict(zip(map(str, curve.x.data), np.asarray(shown.data, float), strict=True))
    return np.array([known.get(name, np.nan) for name in names])
