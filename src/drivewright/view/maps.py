"""A quantity over two others as coloured cells, each about its own point of the grid: levels may lie anywhere, a level may be a text."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from drivewright._typing import ArrayLike, Floats
from drivewright.view.palette import colour
from drivewright.view.panels import Panel, decimals
from drivewright.view.style import angle_ticks, legend_above, log_ticks, new_figure, places, show_places, styled, whole_ticks
from drivewright.view.text import axis_label, literal, number, parts_of_label

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure

Levels: TypeAlias = tuple[NDArray[Any], list[str] | None]  # places along an axis, and their names where it holds texts
Cells: TypeAlias = np.ma.MaskedArray[Any, Any]
LETTER, LINE = 0.075, 0.16  # inches that a written number needs across for each letter, and up
FEWEST = 5  # levels from which on contours are drawn
SMOOTH = 0.7  # mean second difference over mean first one: 1.7 in white noise, about 3 / n in a hump over n levels
FEW_LEVELS = 12  # whole levels that all get a tick
DECADE = 10.0  # ratio of the ends from which on a geometric series of levels stands on a logarithmic axis


def draw_map(shown: Sequence[Panel]) -> "Figure":
    """Figure of a panel of style "map": cells, a colour bar, contours where the field is smooth, hatching where there is no value."""
    panel = shown[0]
    levels = len(grid(panel)[1][0])
    with styled():
        figure = new_figure(float(np.clip(1.6 + 0.24 * levels, 3.4, 4.8)), panel.title)
        map_into(figure.subplots(), panel)
    return figure


def map_into(axis: "Axes", panel: Panel) -> None:
    """Draw a panel of style "map" into axes, with its colour bar beside them."""
    (x, across), (y, up), cells = grid(panel)
    # What is not painted shows the ground.
    axis.patch.set(facecolor=colour("raised"), edgecolor=colour("muted"), hatch="////", linewidth=0)
    axis.grid(False)
    _axis(axis.xaxis, x, across, panel.x.unit)
    _axis(axis.yaxis, y, up, panel.series[0].unit)
    axis.set_xlabel(literal(axis_label(panel.x.label, panel.x.unit)))
    axis.set_ylabel(literal(axis_label(*parts_of_label(panel.label), width=34)))
    painted = _paint(axis.figure, axis, panel, x, y, cells)
    lines = _contours(axis.figure, axis, panel, (x, across), (y, up), cells)
    if not lines and painted:
        _write(axis, painted, x, y, cells)
    legend_above(axis, [*_limits(axis, panel, x, y, cells), *_hatched(cells)])


def grid(panel: Panel) -> tuple[Levels, Levels, Cells]:
    """((x places, names or None), (y places, names or None), cells (y, x)) of a long table; a cell without a value is masked."""
    axes, where = [], []
    for data in (panel.x.data, panel.series[0].data):
        numbers, names = places(data)
        levels, place = np.unique(numbers, return_inverse=True)
        axes.append((levels, names))
        where.append(place)
    cells = np.full((len(axes[1][0]), len(axes[0][0])), np.nan)
    cells[where[1], where[0]] = panel.series[1].data
    bad = ~np.isfinite(cells)
    if panel.log:
        bad |= np.where(bad, -1.0, cells) <= 0
    return axes[0], axes[1], np.ma.masked_array(cells, bad)


def edges(levels: ArrayLike, logarithmic: bool = False) -> Floats:
    """Borders (n + 1) of cells about n rising levels: half way to the neighbours, in the logarithm on such an axis."""
    if logarithmic:
        return np.exp(edges(np.log(levels)))
    levels = np.asarray(levels, float)
    if len(levels) < 2:
        half = 0.5 * (0.1 * np.abs(levels) if np.any(levels % 1) else np.ones(len(levels)))
        return np.concatenate([levels - half, levels[-1:] + half[-1:]])
    middle = (levels[1:] + levels[:-1]) / 2
    return np.concatenate([[2 * levels[0] - middle[0]], middle, [2 * levels[-1] - middle[-1]]])


def is_geometric(levels: Floats) -> bool:
    """Whether positive levels are a geometric series over at least a decade."""
    if len(levels) < 3 or levels[0] <= 0 or levels[-1] < DECADE * levels[0]:
        return False
    steps = np.diff(np.log(levels))
    return bool(np.ptp(steps) < 1e-6 * steps.mean())


def is_smooth(cells: Cells) -> bool:
    """Whether contours of a grid mean something: its second differences are small beside its first ones, along both axes."""
    for along in (0, 1):
        first, second = (np.ma.abs(np.ma.masked_invalid(np.diff(cells.filled(np.nan), n, axis=along))).mean() for n in (1, 2))
        if np.ma.is_masked(first) or np.ma.is_masked(second) or second > SMOOTH * first:
            return False
    return True


def _axis(axis: "Axis", levels: NDArray[Any], names: list[str] | None, unit: str) -> None:
    """Scale, range and ticks of an axis of cells."""
    along, logarithmic = "x" if axis is axis.axes.xaxis else "y", names is None and is_geometric(levels)
    ends = edges(levels, logarithmic)[[0, -1]] if len(levels) else (0.0, 1.0)
    getattr(axis.axes, f"set_{along}scale")("log" if logarithmic else "linear")
    getattr(axis.axes, f"set_{along}lim")(*ends)
    if logarithmic:
        log_ticks(axis)
    if names is None and (len(levels) == 1 or _are_few_whole(levels)):
        axis.set_ticks(levels)
    elif not logarithmic:
        show_places(axis, levels, names)
    if unit == "°" and names is None:
        angle_ticks(axis, float(ends[0]), float(ends[1]))


def _are_few_whole(levels: NDArray[Any]) -> bool:
    """Whether every level gets its tick: some whole numbers at equal distances."""
    return levels.dtype.kind in "iu" and len(levels) <= FEW_LEVELS and len(set(np.diff(levels).tolist())) == 1


def _paint(figure, axis, panel, x, y, cells):
    """The cells with their colour bar; None where no cell has a value.  As an image: outlines would show seams."""
    from matplotlib import colormaps
    from matplotlib.colors import LogNorm, Normalize

    if not cells.count():
        return None
    air = 0.0 if panel.high > panel.low else 0.05 * abs(panel.high) or 1.0  # a constant still has a range
    scale = LogNorm if panel.log else Normalize
    low, high = (panel.low / (1 + air), panel.high * (1 + air)) if panel.log else (panel.low - air, panel.high + air)
    borders = [edges(levels, axis_.get_scale() == "log") for levels, axis_ in ((x, axis.xaxis), (y, axis.yaxis))]
    painted = axis.pcolormesh(*borders, cells, cmap=colormaps["viridis"], norm=scale(low, high), rasterized=True)
    tint = panel.series[1]
    bar = figure.colorbar(painted, ax=axis, aspect=28, pad=0.015, label=literal(axis_label(tint.label, tint.unit, width=34)))
    bar.outline.set_visible(False)
    if panel.log:
        log_ticks(bar.ax.yaxis)
    elif are_whole(cells):
        whole_ticks(bar.ax.yaxis)
    return painted


def _contours(figure, axis, panel, across, up, cells):
    """Whether contour lines with their values were drawn: over two axes of numbers, where the field is smooth."""
    from matplotlib.patheffects import withStroke
    from matplotlib.ticker import LogLocator, MaxNLocator

    if across[1] or up[1] or min(cells.shape) < FEWEST or not panel.high > panel.low or not is_smooth(cells):
        return False
    between = (1, 2, 5) if panel.log and panel.high < 1e3 * panel.low else (1,)
    levels = (LogLocator(subs=between) if panel.log else MaxNLocator(6)).tick_values(panel.low, panel.high)
    levels = [level for level in levels if panel.low < level < panel.high]
    if not levels:
        return False
    lines = axis.contour(across[0], up[0], cells, levels=levels, colors=colour("ink"), linewidths=0.7)
    lines.set_path_effects([withStroke(linewidth=1.8, foreground=(1, 1, 1, 0.45))])
    figure.draw_without_rendering()  # the layout, so that the labels know their place
    for text in axis.clabel(lines, fmt=lambda value: number(value, 4), fontsize=7.5, inline_spacing=3):
        text.set_path_effects([withStroke(linewidth=2.0, foreground=(1, 1, 1, 0.7))])
    return True


def _limits(axis, panel, x, y, cells):
    """Legend entries of the limits; a contour for each one that the cells reach on both sides."""
    from matplotlib.lines import Line2D

    handles = []
    for n, (value, text) in enumerate(panel.limits):
        look = {"color": colour("bad"), "lw": 2.0, "ls": ("--", ":", "-.")[n % 3]}
        if min(cells.shape) > 1 and panel.low < value < panel.high:
            axis.contour(x, y, cells, levels=[value], colors=look["color"], linewidths=look["lw"], linestyles=look["ls"])
            handles.append(Line2D([], [], label=literal(text), **look))
        elif cells.count():
            handles.append(Line2D([], [], ls="none", label=f"{literal(text)}: all {'above' if value <= panel.low else 'below'}"))
    return handles


def _hatched(cells):
    """The legend entry of cells without a value, where there are some."""
    from matplotlib.patches import Patch

    if cells.count() == cells.size and cells.size:
        return []
    return [Patch(facecolor=colour("raised"), edgecolor=colour("muted"), hatch="////", lw=0.4, label="No value")]


def _write(axis, painted, x, y, cells):
    """The number of each cell, dark on light and light on dark, where the smallest cell has room for it."""
    words = cell_texts(cells)
    wide, high = axis.figure.get_size_inches() * (0.78, 0.72)  # about what the cells take of the figure
    room = [narrowest_part(levels, edge.get_scale() == "log") for levels, edge in ((x, axis.xaxis), (y, axis.yaxis))]
    if room[0] * wide < LETTER * max(map(len, words.values())) or room[1] * high < LINE:
        return
    for (row, column), text in words.items():
        red, green, blue, _ = painted.cmap(painted.norm(cells[row, column]))
        ink = "white" if 0.3 * red + 0.59 * green + 0.11 * blue < 0.5 else colour("ink")
        axis.text(x[column], y[row], text, ha="center", va="center", fontsize=7.5, color=ink)


def cell_texts(cells: Cells) -> dict[tuple[int, int], str]:
    """{(row, column): text} of the cells that have a value, to the same decimals: three figures of the largest, none of whole numbers."""
    largest = float(np.abs(cells).max())
    places = 0 if are_whole(cells) else decimals(float(cells.min()), float(cells.max()), 3)
    plain = largest == 0 or 1e-3 <= largest < 1e6
    return {
        (row, column): f"{cells[row, column]:.{places}f}".replace("-", "−") if plain else number(float(cells[row, column]), 3)
        for row, column in zip(*np.nonzero(~np.ma.getmaskarray(cells)), strict=True)
    }


def are_whole(cells: Cells) -> bool:
    """Whether every cell that has a value counts something."""
    return bool(np.all(cells.compressed() % 1 == 0))


def narrowest_part(levels: ArrayLike, logarithmic: bool) -> float:
    """Width of the narrowest cell over that of them all."""
    borders = edges(levels, logarithmic)
    borders = np.log(borders) if logarithmic else borders
    return float(np.diff(borders).min() / (borders[-1] - borders[0]))
