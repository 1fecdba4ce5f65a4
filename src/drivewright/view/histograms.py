"""How often a sample takes which values, with its mean, its tails and its limits."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from drivewright._typing import Floats
from drivewright.view.palette import colour
from drivewright.view.panels import Panel
from drivewright.view.style import BADGE, legend_above, new_figure, styled, whole_ticks
from drivewright.view.text import axis_label, literal, number, with_unit

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MOST_BINS = 100
TAILS = (5.0, 95.0)  # percentiles that are marked
ENOUGH = 20  # values from which on percentiles mean something
CONSTANT = 1e-9  # a spread so small beside the values is rounding
APART = 1.5  # a limit farther off than so many times the range of the samples is written, not drawn


def draw_histogram(shown: Sequence[Panel]) -> "Figure":
    """Figure of a panel of style "histogram": counts, mean, 5 % and 95 %, limits as dashed lines."""
    panel = shown[0]
    samples = panel.series[0].data
    finite = samples[np.isfinite(samples)]
    with styled():
        figure = new_figure(3.3, panel.title)
        axis = figure.subplots()
        handles = _bars(axis, finite, len(samples) - len(finite)) + _marks(axis, finite, panel.x.unit)
        near, far = _reachable(panel.limits, finite)
        legend_above(axis, handles + far)
        axis.set(xlabel=literal(axis_label(panel.x.label, panel.x.unit)), ylabel="Cases")
        whole_ticks(axis.yaxis)
        if samples.dtype.kind in "iu":
            whole_ticks(axis.xaxis)
        for value, text in near:
            _limit(axis, value, literal(text))
    return figure


def bin_edges(samples: NDArray[Any]) -> Floats:
    """Edges of about sqrt(n) bins, fewer where the rule of Freedman and Diaconis, a width of 2 IQR / n^(1/3), asks for fewer.

    Whole numbers lie in the middle of their bins; samples that are all the same have one bin.
    """
    low, high = float(samples.min()), float(samples.max())
    if samples.dtype.kind in "iu":
        step = -(-int(high - low + 1) // MOST_BINS)
        return np.arange(low, high + step + 0.5, step) - 0.5
    if high - low <= CONSTANT * max(abs(low), abs(high)):
        half = 0.01 * max(abs(low), abs(high)) or 0.5
        return np.array([low - half, high + half])
    root, quartiles = np.sqrt(len(samples)), np.percentile(samples, [25, 75])
    width = 2 * (quartiles[1] - quartiles[0]) / np.cbrt(len(samples))
    bins = min(root, (high - low) / width if width > 0 else root, MOST_BINS)
    return np.linspace(low, high, int(np.ceil(bins)) + 1)


def _bars(axis: "Axes", finite: Floats, absent: int) -> "list[Artist]":
    """The bars; their entry in the legend tells how many samples there are."""
    from matplotlib.patches import Patch

    label = f"{len(finite)} {'case' if len(finite) == 1 else 'cases'}" + (f", {absent} without a value" if absent else "")
    look = {"facecolor": (colour("blue"), 0.35), "edgecolor": colour("blue"), "lw": 0.7}
    if len(finite):
        borders = bin_edges(finite)
        counts = np.histogram(finite, borders)[0]
        axis.bar(borders[:-1], counts, np.diff(borders), align="edge", **look)
        axis.set_ylim(0, 1.06 * counts.max())
        axis.grid(False, axis="x")
    return [Patch(label=label, **look)]


def _marks(axis: "Axes", finite: Floats, unit: str) -> "list[Artist]":
    """Lines at the mean and at the tails, told in the legend."""
    if not len(finite):
        return []
    mean, spread = finite.mean(), finite.std(ddof=1) if len(finite) > 1 else 0.0
    digits = figures(finite, spread)
    text = f"Mean {with_unit(number(mean, digits), unit)}"
    text += f", standard deviation {with_unit(number(spread, 3), unit)}" if spread else ""
    handles: list[Artist] = [axis.axvline(mean, color=colour("ink"), lw=1.3, label=text)]
    if len(finite) >= ENOUGH and spread:
        ends = np.percentile(finite, TAILS)
        bounds = " … ".join(number(end, digits) for end in ends)
        text = f"5 % … 95 %: {with_unit(bounds, unit)}"
        handles += [axis.axvline(end, color=colour("ink"), lw=1.1, ls=(0, (1, 1.5)), label=text) for end in ends]
    return handles[:2]


def figures(samples: Floats, spread: float) -> int:
    """Figures that a number of the sample needs to tell a hundredth of its spread; 4 to 12."""
    size = float(np.abs(samples).max())
    return int(np.clip(np.ceil(np.log10(size / spread)) + 3, 4, 12)) if spread and size else 4


def _reachable(limits: Sequence[tuple[float, str]], finite: Floats) -> "tuple[Sequence[tuple[float, str]], list[Artist]]":
    """(limits near enough to be drawn, legend entries of the others)."""
    from matplotlib.lines import Line2D

    if not len(finite):
        return limits, []
    low, high = float(finite.min()), float(finite.max())
    reach = APART * (high - low) or max(abs(low), 1.0)
    near = [limit for limit in limits if low - reach <= limit[0] <= high + reach]
    return near, [
        Line2D([], [], ls="none", label=f"{literal(text)}: far {'below' if value < low else 'above'}")
        for value, text in limits
        if (value, text) not in near
    ]


def _limit(axis: "Axes", value: float, text: str) -> None:
    """A dashed upright line with its name and value along it, inside the picture."""
    axis.axvline(value, color=colour("bad"), lw=1.0, ls=(0, (5, 3)))
    left = value > sum(axis.get_xlim()) / 2
    axis.annotate(
        text,
        (value, 1.0),
        xycoords=("data", "axes fraction"),
        xytext=(-2 if left else 2, -2),
        textcoords="offset points",
        rotation=90,
        ha="right" if left else "left",
        va="top",
        fontsize=8,
        color=colour("bad"),
        bbox=BADGE,
    )
