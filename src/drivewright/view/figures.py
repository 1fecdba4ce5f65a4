"""Tables and plots as printable figures: labelled axes in the units people read, limits as labelled dashed lines."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from drivewright.errors import InputError
from drivewright.result import Result
from drivewright.view.coincident import is_covered
from drivewright.view.histograms import draw_histogram
from drivewright.view.maps import draw_map, map_into
from drivewright.view.markers import line_marker, marked_rows
from drivewright.view.meshes import draw_mesh
from drivewright.view.palette import SERIES, colour
from drivewright.view.panels import Panel, find_plot, panels
from drivewright.view.ranked import draw_ranked, hatch
from drivewright.view.rounds import draw_round, round_into
from drivewright.view.style import (
    BADGE,
    MUTED,
    angle_ticks,
    are_turned,
    legend_above,
    log_ticks,
    name_places,
    new_figure,
    places,
    show_places,
    styled,
    whole_ticks,
)
from drivewright.view.text import axis_label, literal, parts_of_label

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

FEW = 25  # up to so many points each one is marked
DASH = 4.0  # line widths that a dash of a covered line is long
BESIDE = 0.02  # of the width of a cloud: room at both ends
MANY = 1500  # from so many points on lines are thinner and points smaller


def plot_table(result: Result[Any], name: str, marks: Sequence[tuple[float, str]] = (), ax: "Axes | None" = None) -> "Figure":
    """Figure of a plot of the result's mechanism, or of a whole table over its first column, by name.

    `marks` are (x in SI, label): a phase begins at each; phases are shaded in turn.  With `ax` it is drawn into these axes, whose figure
    is returned.
    """
    shown = panels(result, find_plot(result, name))
    return draw_panels(shown, marks) if ax is None else draw_into(ax, shown, name, marks)


def draw_into(ax: "Axes", shown: Sequence[Panel], name: str, marks: Sequence[tuple[float, str]] = ()) -> "Figure":
    """Draw the one panel of a plot into axes of the caller; InputError where it has several, or its style needs axes of its own."""
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    style = shown[0].style
    if not isinstance(ax, Axes):
        raise InputError(f"plot {name!r}: ax is a {type(ax).__name__}; give one matplotlib Axes, e.g. plt.subplots()[1], or leave ax out.")
    if len(shown) > 1:
        raise InputError(f"plot {name!r}: it has {len(shown)} panels, one under the other, and ax is one; leave ax out.")
    if style in APART and style not in INTO:
        raise InputError(f"plot {name!r}: its style {style!r} needs a figure of its own; leave ax out.")
    if (style == "polar") != (ax.name == "polar"):
        wanted = 'polar axes, e.g. figure.add_subplot(projection="polar")' if style == "polar" else "plain axes"
        raise InputError(f"plot {name!r}: it needs {wanted}; these are {'polar' if ax.name == 'polar' else ax.name}.")
    with styled():
        if style in INTO:
            INTO[style](ax, shown[0])
        else:
            _draw_panel(ax, shown[0], marks)
            ax.set_xlabel(literal(axis_label(shown[0].x.label, shown[0].x.unit)))
    return ax.figure if isinstance(ax.figure, Figure) else ax.figure.figure


def draw_panels(shown: Sequence[Panel], marks: Sequence[tuple[float, str]] = ()) -> "Figure":
    """Figure of panels, one under the other over a common x; `marks` as in `plot_table` but in the unit of the x axis."""
    if shown[0].style in APART:
        return APART[shown[0].style](shown)
    with styled():
        equal = shown[0].equal
        figure = new_figure(4.6 if equal else _height(shown), shown[0].title)
        axes = figure.subplots(len(shown), 1, squeeze=False, sharex=not equal)[:, 0]
        for axis, panel in zip(axes, shown, strict=True):
            first = axis is axes[0]
            _draw_panel(axis, panel, marks, first, first or _legend_entries(panel) != _legend_entries(shown[0]))
        axes[-1].set_xlabel(literal(axis_label(shown[0].x.label, shown[0].x.unit)))
        figure.align_ylabels(list(axes))
    return figure


APART = {"mesh": draw_mesh, "polar": draw_round, "map": draw_map, "histogram": draw_histogram, "ranked": draw_ranked}


INTO = {"polar": round_into, "map": map_into}


def _legend_entries(panel):
    return [(series.label, series.role) for series in panel.series]


def _draw_panel(axis, panel, marks, named=True, told=True):
    """One panel of lines, points, stems or bars, with its phases, `named` or not; `told` with its legend."""
    _draw(axis, panel, told)
    _shade(axis, panel, marks, named)


def _height(shown):
    """Inches; a legend of many rows and names that are turned get room of their own."""
    names = places(shown[0].x.data)[1] if shown[0].style == "points" else None
    more = 0.16 * sum(len(panel.series) // 6 for panel in shown) + (0.8 if names and are_turned(names) else 0.0)
    return (3.1 if len(shown) == 1 else 0.9 + 1.7 * len(shown)) + more


def _draw(axis, panel, told):
    # Points may share a name; in any other style each row has its own place.
    x, names = places(panel.x.data) if panel.style == "points" else _positions(panel.x.data)
    if panel.style in BARS:
        BARS[panel.style](axis, panel.series, x)
    for series in panel.series if panel.style not in BARS else ():
        _draw_series(axis, panel, series, x if series.x is None else series.x, names)
    if names is None and any(series.covered is not None for series in panel.series):
        _show_covered(axis, panel, x)
    for start, end in panel.shade:
        axis.axvspan(start, end, color=colour("line"), zorder=0, lw=0)
    for radius, text in panel.rings:
        _ring(axis, radius, text)
    name_places(axis, panel.places)
    show_places(axis.xaxis, x, names)
    axis.set_ylabel(literal(axis_label(*parts_of_label(panel.label), width=26 if not panel.equal else 60)))
    if panel.equal:
        axis.set_aspect("equal", adjustable="datalim")
    else:
        _scale(axis, panel, x)
    for value, text in panel.limits:
        _limit(axis, value, text)
    if len(panel.series) > 1 and told:
        legend_above(axis)


def _draw_series(axis, panel, series, x, names):
    """One line, cloud of points or row of stems, with the intervals of its values."""
    if series.ends:
        _draw_intervals(axis, series, x, isolated=bool(names) or panel.style in ("points", "stems"))
    data = np.where(np.isfinite(series.data), series.data, np.nan)
    hue, finite, label = colour(series.role), np.isfinite(data), literal(series.label)
    if series.marker and panel.style == "points":
        size = 6 if len(x) <= FEW else 5 if len(x) <= MANY else 3
        # The first group lies on top: it is the one that matters.
        axis.plot(
            x[finite],
            data[finite],
            ls="none",
            marker=series.marker,
            ms=size,
            mew=0.4,
            mec="white",
            color=hue,
            label=label,
            zorder=3 - 0.01 * panel.series.index(series),
            rasterized=len(x) > MANY,
        )
    elif panel.style == "points":
        size = 7 if len(x) <= FEW else 5 if len(x) <= MANY else 1.5
        # A cloud is drawn as an image: as outlines ten thousand points are megabytes.
        axis.plot(x, data, ls="none", marker=".", ms=size, mew=0, color=hue, label=label, rasterized=len(x) > MANY)
    elif panel.style == "stems" and not series.dashed:
        axis.vlines(x[finite], panel.low if panel.log else 0.0, data[finite], color=hue, lw=1.0)
        axis.plot(x, data, ls="none", ms=3, color=hue, label=label, marker=_own_marker(panel, series, "o"))
    elif names:
        axis.plot(x, data, ls="none", ms=5, color=hue, label=label, marker=_own_marker(panel, series, "D"))
    elif series.dashed:
        axis.plot(x, data, lw=1.0, ls=(0, (4, 3)), color=hue, label=label, zorder=2.5)
    else:
        axis.plot(x, data, lw=1.5 if len(x) <= MANY else 0.9, color=hue, label=label, **_line_markers(panel, series, x, data))


def _own_marker(panel, series, usual):
    """The marker of one of several series, the usual one of a single one."""
    solid = [each for each in panel.series if not each.dashed]
    return (series.marker or line_marker(_number(solid, series))) if len(solid) > 1 and not series.dashed else usual


def _line_markers(panel, series, x, data):
    """Every point of a short line is marked; several long lines carry a few markers each, so that they differ without colour."""
    solid, few = [each for each in panel.series if not each.dashed], len(x) <= FEW
    if len(solid) == 1:
        return {"marker": "o", "ms": 3.5} if few else {}
    rows = None if few else marked_rows(x, data, _number(solid, series), len(solid), upright=not panel.equal)
    return {"marker": _own_marker(panel, series, ""), "ms": 5.5, "mew": 0.4, "mec": "white", "markevery": rows}


def _show_covered(axis, panel, x):
    """Dashes of each covered line upon the lines that cover it, and the markers of all lines upon the dashes."""
    for series in reversed(panel.series):
        if series.covered is None:
            continue
        place, on = x if series.x is None else series.x, is_covered(series.covered)
        for count in np.unique(series.covered[on]):
            data = np.where(on & (series.covered == count), series.data, np.nan)
            axis.plot(place, data, lw=2.0, ls=(0, (DASH, DASH * count)), color=colour(series.role), zorder=2.1, dash_capstyle="butt")
    for line in axis.get_lines():
        if line.get_marker() not in ("", "None", None):
            line.set_zorder(2.0)
            axis.plot(line.get_xdata(), line.get_ydata(), ls="none", color=line.get_color(), zorder=2.2, **_look_of_markers(line))


def _look_of_markers(line):
    return {
        "marker": line.get_marker(),
        "ms": line.get_markersize(),
        "mew": line.get_markeredgewidth(),
        "mec": line.get_markeredgecolor(),
        "markevery": line.get_markevery(),
    }


def _number(lines, line):
    return [each.name for each in lines].index(line.name)


def _is_cloud(panel):
    """Whether points lie in groups, each with a marker of its own."""
    return panel.style == "points" and bool(panel.series[0].marker)


def _draw_intervals(axis, series, x, isolated):
    """A band behind a line; error bars of isolated values, unless they are too many to be told apart."""
    hue, (low, high) = colour(series.role), series.ends
    known = np.isfinite(low) & np.isfinite(high)
    if not isolated:
        axis.fill_between(x, low, high, where=known, color=hue, alpha=0.18, lw=0, zorder=1.5)
    if isolated or len(x) <= FEW:
        axis.vlines(x[known], low[known], high[known], color=hue, lw=1.0 if len(x) <= FEW else 0.5, alpha=0.75, zorder=2.2)
    if len(x) <= FEW:
        for end in (low, high):
            axis.plot(x[known], end[known], ls="none", marker="_", ms=5, mew=1.0, color=hue, alpha=0.75, zorder=2.2)


def _draw_bars(axis, lines, x):
    """Stacked bars, what is negative below zero; a diamond marks the sum of several, error bars the intervals of a single one."""
    above, below = np.zeros(len(x)), np.zeros(len(x))
    apart = np.min(np.diff(x)) if len(x) > 1 else 1.0
    width = (0.6 if len(x) <= FEW else 0.85) * apart
    for number, series in enumerate(lines):
        up, down = np.maximum(series.data, 0.0), np.minimum(series.data, 0.0)
        look = {"width": width, "color": colour(series.role), "edgecolor": "white", "lw": 0.4, "hatch": "//" * (number // len(SERIES))}
        axis.bar(x, up, bottom=above, label=literal(series.label), **look)
        axis.bar(x, down, bottom=below, **look)
        above, below = above + up, below + down
    if len(lines) > 1:
        axis.plot(x, above + below, ls="none", marker="D", ms=6 if len(x) <= FEW else 2.5, mfc="white", mec=colour("ink"), label="Sum")
    elif lines[0].ends:
        _draw_intervals(axis, lines[0]._replace(role="ink"), x, isolated=True)
    axis.axhline(0.0, color=colour("muted"), lw=0.8)


def _draw_grouped(axis, lines, x):
    """Bars of several series side by side, each with a hatch of its own."""
    steps = np.diff(np.sort(np.asarray(x, float)))
    wide = 0.8 * float(steps.min() if len(steps) else 1.0) / len(lines)
    for number, series in enumerate(lines):
        place = (x if series.x is None else series.x) + (number - (len(lines) - 1) / 2) * wide
        look = {"color": colour(series.role), "edgecolor": "white", "lw": 0.4, "hatch": hatch(number)}
        axis.bar(place, np.where(np.isfinite(series.data), series.data, 0.0), 0.94 * wide, label=literal(series.label), **look)
    axis.axhline(0.0, color=colour("muted"), lw=0.8)


BARS = {"bars": _draw_bars, "grouped": _draw_grouped}


def _ring(axis, radius, text):
    """A circle about the origin with its name at its top."""
    turn = np.linspace(0, 2 * np.pi, 181)
    axis.plot(radius * np.cos(turn), radius * np.sin(turn), color=colour("bad"), lw=1.0, ls=(0, (5, 3)))
    axis.annotate(
        text, (0, radius), xytext=(0, 3), textcoords="offset points", ha="center", va="bottom", fontsize=8, color=colour("bad"), bbox=BADGE
    )


def _positions(data):
    """x as numbers, with tick texts where the column holds names."""
    return (data, None) if data.dtype.kind in "fiub" else (np.arange(len(data)), [str(text) for text in data])


def _scale(axis, panel, x):
    """The range of both axes, and ticks at round angles."""
    axis.set_ylim(panel.low, panel.high)
    x = np.concatenate([np.asarray(x if series.x is None else series.x, float) for series in panel.series])
    if panel.log:
        axis.set_yscale("log")
        log_ticks(axis.yaxis)
    if len(x) > FEW and np.ptp(x) > 0 and panel.style not in BARS and not _is_cloud(panel):
        room = BESIDE * np.ptp(x) if panel.style == "points" and len(x) <= MANY else 0.0  # whole dots at the ends
        axis.set_xlim(np.min(x) - room, np.max(x) + room)
    if panel.x.unit == "°":
        angle_ticks(axis.xaxis, np.min(x), np.max(x))
    if panel.series[0].unit == "°" and panel.high - panel.low > 100:
        angle_ticks(axis.yaxis, panel.low, panel.high, most=6)
    elif not panel.log and not panel.series[0].unit.strip("-") and all(_counts(series.data) for series in panel.series):
        whole_ticks(axis.yaxis)


def _counts(data):
    """Whether numbers count something, as far as there are any."""
    known = data[np.isfinite(data)] if data.dtype.kind in "fiu" else data[:0]
    return len(known) > 0 and bool(np.all(known % 1 == 0))


def _limit(axis, value, text):
    """A dashed line across the panel with its name and value on it."""
    axis.axhline(value, color=colour("bad"), lw=1.0, ls=(0, (5, 3)))
    above = value < sum(axis.get_ylim()) / 2
    axis.annotate(
        text,
        (1.0, value),
        xycoords=("axes fraction", "data"),
        xytext=(-2, 2 if above else -2),
        textcoords="offset points",
        ha="right",
        va="bottom" if above else "top",
        fontsize=8,
        color=colour("bad"),
        bbox=BADGE,
    )


def _shade(axis, panel, marks, named):
    """Every other phase lightly grey where there are several; the first panel names them in a strip kept free for it."""
    low, high = axis.get_xlim()
    inside = sorted((float(x), label) for x, label in marks if low <= x <= high)
    ends = [x for x, _ in inside[1:]] + [high]
    for (start, _), end in list(zip(inside, ends, strict=False))[::2] if len(inside) > 1 else ():
        axis.axvspan(start, end, color=colour("raised"), zorder=0, lw=0)
    if named and inside:
        rows = _rows(inside, (high - low) / 84)
        axis.set_ylim(panel.low, panel.high + (0.02 + 0.07 * max(rows)) * (panel.high - panel.low))
        for (start, label), row in zip(inside, rows, strict=True):
            axis.annotate(
                label,
                (start, 1.0),
                xycoords=("data", "axes fraction"),
                xytext=(2, 8 - 10 * row),
                textcoords="offset points",
                va="top",
                fontsize=7.5,
                color=MUTED,
                bbox={"boxstyle": "square,pad=0.05", "fc": (1, 1, 1, 0.6), "ec": "none"},
            )


def _rows(inside, letter):
    """The row, from 1, of each phase's name: the first row where it does not touch the name before; `letter` is a letter's width."""
    ends, rows = {}, []
    for start, label in inside:
        row = next(r for r in range(1, len(inside) + 1) if ends.get(r, -np.inf) <= start)
        ends[row] = start + letter * (len(label) + 1)
        rows.append(row)
    return rows
