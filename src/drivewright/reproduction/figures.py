"""Figures of papers: curves with axes named by what they show, told apart without colour, printed and stated values marked."""

import textwrap
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from drivewright._typing import ArrayLike
from drivewright.view.palette import MARKERS, SERIES, colour
from drivewright.view.style import BADGE, angle_ticks, legend_above, log_ticks, name_places, new_figure, styled
from drivewright.view.text import literal

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
    axis.set_ylabel(textwrap.fill(literal(chart.y_label), 30))
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
    across = 0
    for stated in chart.stated:
        _draw_stated(axis, stated, left=across % 2 == 1)
        across += stated.x is None
    name_places(axis, chart.places)
    if len(chart.curves) > 1:
        legend_above(axis, room=84 // max(columns, 1))
        legend = axis.get_legend()
        if legend is not None and chart.title:
            legend.set_title(literal(chart.title))
            legend.set_alignment("left")
    elif chart.title:
        axis.set_title(literal(chart.title), fontweight="normal", fontsize=9)


def _angles(axis, chart):
    numbers = [np.ravel(np.asarray(curve.x, float)) for curve in chart.curves if np.asarray(curve.x).dtype.kind in "fiu"]
    data = np.concatenate([np.empty(0), *numbers])
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
        finite = np.flatnonzero(np.isfinite(y))
        step = max(len(finite) // SPARSE, 1)
        axis.plot(
            x,
            y,
            ls=DASHES[number % len(DASHES)],
            lw=1.5 if len(x) <= MANY else 0.7,
            marker=MARKERS[number % len(MARKERS)],
            ms=4.5,
            markevery=(((number * step) // 4) % max(len(x), 1), step) if len(x) > 1 else None,
            color=hue,
            label=label,
        )
    if curve.low is not None and curve.high is not None:
        _draw_interval(axis, curve, x, hue)


def _draw_interval(axis, curve, x, hue):
    low, high = np.asarray(curve.low, float), np.asarray(curve.high, float)
    if curve.look in ("points", "both"):
        axis.vlines(x, low, high, color=hue, lw=1.2, alpha=0.8)
    else:
        axis.fill_between(x, low, high, color=hue, alpha=0.18, lw=0)


def _draw_stated(axis, stated, left):
    """In the colour of what is printed: a line across with its words at the right or `left` end, a line upright, or a cross at a point."""
    look: dict[str, Any] = {"color": colour("bad"), "lw": 1.0, "ls": (0, (5, 3))}
    words: dict[str, Any] = {"fontsize": 8, "color": colour("bad"), "bbox": BADGE, "textcoords": "offset points"}
    if stated.x is not None and stated.y is not None:
        axis.plot([stated.x], [stated.y], ls="none", marker="x", ms=8, mew=1.8, color=colour("bad"), zorder=5)
        before = stated.x > sum(axis.get_xlim()) / 2
        axis.annotate(stated.text, (stated.x, stated.y), xytext=(-6 if before else 6, 5), ha="right" if before else "left", **words)
    elif stated.y is not None:
        axis.axhline(stated.y, **look)
        high = stated.y > sum(axis.get_ylim()) / 2
        place = (0.0 if left else 1.0, stated.y)
        axis.annotate(
            stated.text,
            place,
            xycoords=("axes fraction", "data"),
            xytext=(3 if left else -3, -2 if high else 2),
            ha="left" if left else "right",
            va="top" if high else "bottom",
            **words,
        )
    elif stated.x is not None:
        axis.axvline(stated.x, **look)
        axis.annotate(
            stated.text, (stated.x, 0.0), xycoords=("data", "axes fraction"), xytext=(3, 4), rotation=90, va="bottom", ha="left", **words
        )
