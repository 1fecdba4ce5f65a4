"""Ranked contributions: horizontal bars, the longest on top."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from drivewright._typing import Floats, Ints
from drivewright.view.palette import colour
from drivewright.view.panels import Panel, Series
from drivewright.view.style import legend_above, new_figure, styled
from drivewright.view.text import axis_label, literal, number, numbers, parts_of_label, wrapped

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST_ROWS = 30  # the rest is counted, not drawn
HATCHES = ("", "///", "...", "xxx", "\\\\\\")  # so that bars side by side differ on a grey printer
ROOM = 80  # letters of the figure's width, for the labels and a row of the legend
THICK = 0.8  # of the room of a row
LETTER = 0.018  # room of a letter beside the longest bar, over the width of all bars


def hatch(number: int) -> str:
    """The hatch of the bars of that number among several side by side."""
    return HATCHES[number % len(HATCHES)]


def draw_ranked(shown: Sequence[Panel]) -> "Figure":
    """Figure of panels of style "ranked", one under the other: a row for each label, in it a bar for each column."""
    labels = [literal(wrapped(str(label), 40)) for label in shown[0].x.data[:MOST_ROWS]]
    with styled():
        rows = [max(0.17 * (label.count("\n") + 1), 0.12 * len(panel.series) + 0.04, 0.22) for label in labels for panel in shown]
        figure = new_figure(0.75 + 0.55 * len(shown) + sum(rows), shown[0].title)
        axes = figure.subplots(len(shown), 1, squeeze=False)[:, 0]
        for axis, panel in zip(axes, shown, strict=True):
            _draw(axis, panel, labels)
    return figure


def _draw(axis: "Axes", panel: Panel, labels: Sequence[str]) -> None:
    bars = panel.series
    place, thick = np.arange(len(labels)), THICK / max(len(bars), 1)
    for n, series in enumerate(bars):
        middle = place + (n - (len(bars) - 1) / 2) * thick
        data = series.data[: len(labels)]
        axis.barh(
            middle,
            np.where(np.isfinite(data), data, 0.0),
            0.92 * thick,
            color=colour(series.role),
            edgecolor="white",
            lw=0.3,
            hatch=hatch(n),
            label=literal(series.label),
        )
        if series.ends:
            _errors(axis, np.asarray(middle, float), data, *(end[: len(labels)] for end in series.ends))
    axis.axvline(0.0, color=colour("muted"), lw=0.8)
    axis.set_yticks(place, labels)
    axis.tick_params(axis="y", length=0)
    axis.set_ylim(max(len(labels), 1) - 0.5, -0.5)
    axis.grid(False, axis="y")
    more = len(panel.x.data) - len(labels)
    named = literal(axis_label(*parts_of_label(panel.label))) if len(bars) == 1 else ""
    axis.set_xlabel("; ".join(part for part in (named, f"{more} smaller ones are not shown" if more else "") if part))
    axis.set_ylabel(literal(panel.x.label))
    _write(axis, bars, place)
    if len(bars) > 1:
        legend_above(axis, room=ROOM - max((len(line) for label in labels for line in label.splitlines()), default=0))


def _value_text(value: float, ends: Sequence[float]) -> str:
    """A number with the digits that its interval supports, three at most; as any number without zeros at its end."""
    text = numbers(value, ends[0], ends[1], 3)[0] if ends else number(value, 3)
    return text.rstrip("0").rstrip(".") if "." in text and "×" not in text else text


def _errors(axis: "Axes", middle: Floats, data: Floats, low: Floats, high: Floats) -> None:
    """Bars from the lower to the upper end; they need not hold the value."""
    known = np.isfinite(data) & np.isfinite(low) & np.isfinite(high)
    axis.hlines(middle[known], low[known], high[known], color=colour("ink"), lw=1.2)
    for end in (low, high):
        axis.plot(end[known], middle[known], ls="none", marker="|", ms=6, mew=1.2, color=colour("ink"))


def _write(axis: "Axes", bars: Sequence[Series], place: Ints) -> None:
    """The number of each single bar beyond its end, with room for it, and a word where there is none."""
    data, *ends = (each[: len(place)] for each in (bars[0].data, *bars[0].ends))
    low, high = (np.fmin.reduce([data, *ends]), np.fmax.reduce([data, *ends]))
    some = np.any([np.isfinite(series.data[: len(place)]) for series in bars], axis=0)
    for row, value in zip(place, data, strict=True):
        side = -1 if value < 0 else 1
        look = {
            "xytext": (4 * side, 0),
            "textcoords": "offset points",
            "va": "center",
            "fontsize": 8,
            "color": colour("muted"),
            "ha": "right" if value < 0 else "left",
        }
        if not some[row]:
            axis.annotate("no value", (0.0, row), **look)
        elif len(bars) == 1:
            tip = min(low[row], 0.0) if value < 0 else max(high[row], 0.0)
            axis.annotate(_value_text(value, [float(end[row]) for end in ends]), (tip, row), **look)
    if len(bars) == 1:
        left, right = axis.get_xlim()
        wide = LETTER * max((len(text.get_text()) for text in axis.texts), default=0) * (right - left)
        axis.set_xlim(left - wide * bool(np.any(np.nan_to_num(data) < 0)), right + wide * bool(np.any(np.nan_to_num(data) >= 0)))
