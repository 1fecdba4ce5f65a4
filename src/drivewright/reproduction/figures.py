"""Figures of papers: curves with axes named by what they show, told apart without colour, printed and stated values marked."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from drivewright._typing import ArrayLike
from drivewright.reproduction.placing import Place, Room
from drivewright.view.palette import MARKERS, SERIES, colour
from drivewright.view.style import BADGE, angle_ticks, legend_above, log_ticks, name_places, new_figure, styled
from drivewright.view.text import literal, wrapped_label

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

DASHES = ("-", (0, (6, 2)), (0, (2, 1.5)), (0, (8, 2, 1.5, 2)), (0, (4, 1, 1, 1, 1, 1)))
SPARSE = 9  # markers along a line
MANY = 1500  # points from which on a line is thin


class Curve(NamedTuple):
    """A curve in the units of its axes.

    look: "line", "points" (joined by nothing), "both" (points joined by a line), "printed" (numbers of the paper) or "reference" (thin,
    dashed).  `low` and `high` are the ends of the 95 % intervals.  `number` is its place among the curves' looks, by default that in the
    chart.
    """

    label: str
    x: ArrayLike
    y: ArrayLike
    look: str = "line"
    low: ArrayLike | None = None
    high: ArrayLike | None = None
    number: int | None = None


class Stated(NamedTuple):
    """What the text states: a horizontal line at `y`, a vertical one at `x`, or a cross where both are given; the words beside it."""

    text: str
    x: float | None = None
    y: float | None = None


class Chart(NamedTuple):
    """One pair of axes."""

    y_label: str
    curves: Sequence[Curve]
    stated: Sequence[Stated] = ()
    title: str = ""
    log: bool = False
    places: Sequence[tuple[float, str]] = ()  # (x, name) of bearings, stations, loads along the x axis
    from_zero: bool = False
    equal: bool = False  # one scale for both axes, for geometry


def chart_figure(title: str, x_label: str, charts: Sequence[Chart], columns: int = 1, height: float = 2.6) -> "Figure":
    """Figure of charts over a common kind of x, one under the other, or in so many columns."""
    rows = -(-len(charts) // columns)
    with styled():
        figure = new_figure(0.5 + height * rows, title)
        axes = figure.subplots(rows, columns, squeeze=False)
        for axis in axes.flat[len(charts) :]:
            axis.set_axis_off()
        for axis, chart in zip(axes.flat, charts, strict=False):
            draw_chart(axis, chart, columns)
            axis.set_xlabel(literal(x_label))
        figure.align_ylabels(list(axes[:, 0]))
    return figure


def draw_chart(axis: "Axes", chart: Chart, columns: int = 1) -> None:
    """Curves, stated values and places in one pair of axes, one of so many `columns` side by side."""
    if chart.log:
        axis.set_yscale("log")
    for number, curve in enumerate(chart.curves):
        _draw_curve(axis, curve, number if curve.number is None else curve.number)
    axis.set_ylabel(wrapped_label(literal(chart.y_label), 30))
    if chart.equal:
        axis.set_aspect("equal", adjustable="datalim")
    axis.margins(y=0.1)
    axis.update_datalim([(0.0, stated.y) for stated in chart.stated if stated.y is not None], updatex=False)
    axis.autoscale_view()
    if chart.from_zero:
        axis.set_ylim(bottom=0.0)
    if chart.log:
        log_ticks(axis.yaxis)
    _angles(axis, chart)
    room = Room(axis, [line for curve in chart.curves for line in _numbers(curve)])
    for stated in sorted(chart.stated, key=lambda stated: stated.y is None):
        _draw_stated(axis, room, stated)
    name_places(axis, chart.places)
    if len(chart.curves) > 1:
        legend_above(axis, room=84 // max(columns, 1))
        legend = axis.get_legend()
        if legend is not None and chart.title:
            legend.set_title(literal(chart.title))
            legend.set_alignment("left")
    elif chart.title:
        axis.set_title(literal(chart.title), fontweight="normal", fontsize=9)


def _numbers(curve):
    """[(x, y)] of a curve over numbers, nothing of one over names."""
    return [(np.ravel(np.asarray(curve.x, float)), np.ravel(np.asarray(curve.y, float)))] if np.asarray(curve.x).dtype.kind in "fiu" else []


def _angles(axis, chart):
    data = np.concatenate([np.empty(0), *(x for curve in chart.curves for x, _ in _numbers(curve))])
    if len(data) and np.nanmax(data) - np.nanmin(data) in (90.0, 180.0, 360.0):
        angle_ticks(axis.xaxis, float(np.nanmin(data)), float(np.nanmax(data)))


def _draw_curve(axis, curve, number):
    x, y = np.asarray(curve.x), np.asarray(curve.y, float)
    hue, label = colour(SERIES[number % len(SERIES)]), literal(curve.label)
    if curve.look == "printed":
        axis.plot(x, y, ls="none", marker="x", ms=7, mew=1.6, color=colour("bad"), label=label, zorder=4)
    elif curve.look == "reference":
        axis.plot(x, y, ls=(0, (4, 3)), lw=1.0, color=colour("ink"), label=label)
    elif curve.look in ("points", "both"):
        line = DASHES[number % len(DASHES)] if curve.look == "both" else "none"
        axis.plot(x, y, ls=line, lw=1.3, marker=MARKERS[number % len(MARKERS)], ms=5, color=hue, label=label)
    else:
        axis.plot(
            x,
            y,
            ls=DASHES[number % len(DASHES)],
            lw=1.5 if len(x) <= MANY else 0.7,
            marker=MARKERS[number % len(MARKERS)],
            ms=4.5,
            markevery=_marked(x, y, number),
            color=hue,
            label=label,
        )
    if curve.low is not None and curve.high is not None:
        _draw_interval(axis, curve, x, hue)


def _marked(x, y, number):
    """Points of a line that have a marker, evenly over x where that grows, and not where other lines have theirs."""
    finite = np.flatnonzero(np.isfinite(y))
    if len(finite) < 2 or x.dtype.kind not in "fiu" or np.any(np.diff(x) < 0):
        step = max(len(finite) // SPARSE, 1)
        return [*finite[((number * step) // 4) % max(len(finite), 1) :: step]]
    at = np.linspace(x[finite[0]], x[finite[-1]], SPARSE + 1) + (number % 4) / 4 * (x[finite[-1]] - x[finite[0]]) / SPARSE
    return [*finite[np.unique(np.searchsorted(x[finite], at[at <= x[finite[-1]]]).clip(max=len(finite) - 1))]]


def _draw_interval(axis, curve, x, hue):
    low, high = np.asarray(curve.low, float), np.asarray(curve.high, float)
    if curve.look in ("points", "both"):
        axis.vlines(x, low, high, color=hue, lw=1.2, alpha=0.8)
    else:
        axis.fill_between(x, low, high, color=hue, alpha=0.18, lw=0)


def _draw_stated(axis, room, stated):
    """In the colour of what is printed: a line across or upright, or a cross where both are given; the words where there is room."""
    look: dict[str, Any] = {"color": colour("bad"), "lw": 1.0, "ls": (0, (5, 3))}
    words: dict[str, Any] = {"fontsize": 8, "color": colour("bad"), "bbox": BADGE, "textcoords": "offset points"}
    if stated.y is None:
        axis.axvline(stated.x, **look)
        left, _ = room.fraction(stated.x, 1.0)
        place = (stated.x, room.gap(stated.text, left))
        axis.annotate(stated.text, place, xycoords=("data", "axes fraction"), xytext=(3, 0), rotation=90, va="center", ha="left", **words)
        return
    if stated.x is None:
        axis.axhline(stated.y, **look)
        _, y = room.fraction(axis.get_xlim()[0], stated.y)
        room.take(np.stack([np.linspace(0.0, 1.0, 200), np.full(200, y)], axis=1))
        ends = [Place(1.0, y, -1, -1), Place(1.0, y, -1, 1), Place(0.0, y, 1, -1), Place(0.0, y, 1, 1)]
    else:
        axis.plot([stated.x], [stated.y], ls="none", marker="x", ms=8, mew=1.8, color=colour("bad"), zorder=5)
        x, y = room.fraction(stated.x, stated.y)
        ends = [Place(x, y, right, up) for right, up in ((1, 1), (-1, 1), (1, -1), (-1, -1))]
    place = room.best(stated.text, ends)
    words |= {"ha": "left" if place.right > 0 else "right", "va": "bottom" if place.up > 0 else "top"}
    away = (6 * place.right, 5 * place.up) if stated.x is not None else (3 * place.right, 2 * place.up)
    point, kind = ((place.x, stated.y), ("axes fraction", "data")) if stated.x is None else ((stated.x, stated.y), "data")
    axis.annotate(stated.text, point, xycoords=kind, xytext=away, **words)
