"""The look of every figure: fonts, lines, spacing.  The only place that sets matplotlib's parameters."""

import io
import math
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from drivewright._typing import ArrayLike, Floats
from drivewright.view.palette import colour
from drivewright.view.text import literal, wrapped

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure

WIDTH = 7.2  # inches: the text width of an A4 page with normal margins
TITLE = {"ha": "left", "fontsize": 11, "fontweight": "bold"}
POINTS = 72  # in an inch: a unit of SVG
NEEDLESS = re.compile(r"(?<=\.\d\d)\d+|\s+(?=[MLCQz\s]|$)|(?<=[MLCQz])\s+|^\s+")  # in a path: more than two decimals, blanks about commands
RASTER = 220  # dots per inch of what is drawn as an image
TALLEST = 4.4  # inches: the tallest picture to scale
BADGE = {"boxstyle": "square,pad=0.1", "fc": (1, 1, 1, 0.75), "ec": "none"}  # behind words that stand on a line
TURNED = 78  # letters of the names under an axis, from which on they are turned
MOST_NAMES = 40  # along an axis; of more, only every second, third ... is written
INK, MUTED, LINE, GRID = colour("ink"), colour("muted"), colour("line"), colour("grid")
PARAMETERS = {
    "font.family": ["DejaVu Sans"],
    "font.size": 9,
    "axes.titlesize": 10,
    "axes.labelsize": 9,
    "legend.fontsize": 8.5,
    "xtick.labelsize": 8.5,
    "ytick.labelsize": 8.5,
    "text.color": INK,
    "axes.labelcolor": INK,
    "xtick.color": MUTED,
    "ytick.color": MUTED,
    "axes.edgecolor": MUTED,
    "axes.linewidth": 0.7,
    "axes.grid": True,
    "grid.color": GRID,
    "grid.linewidth": 0.7,
    "axes.axisbelow": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "xtick.major.size": 3,
    "ytick.major.size": 3,
    "xtick.major.width": 0.7,
    "ytick.major.width": 0.7,
    "axes.titlelocation": "left",
    "axes.titleweight": "bold",
    "figure.dpi": 100,
    "figure.facecolor": "white",
    "axes.facecolor": "white",
    "legend.frameon": False,
    "lines.solid_joinstyle": "round",
    "axes.formatter.useoffset": False,
    "svg.fonttype": "none",
    "path.simplify_threshold": 0.2,
    "svg.hashsalt": "drivewright",
}


@contextmanager
def styled() -> Iterator[None]:
    """Context in which figures are made and written: our parameters over matplotlib's own defaults, whatever the user set elsewhere."""
    import matplotlib.style

    with matplotlib.style.context(PARAMETERS, after_reset=True):
        yield


def new_figure(height: float, title: str = "") -> "Figure":
    """An empty figure of the common width, laid out by itself; it belongs to no window and no global list."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(WIDTH, height), layout="constrained")
    layout: Any = figure.get_layout_engine()
    layout.set(w_pad=0.06, h_pad=0.05, hspace=0.02)
    figure.suptitle(literal(title), x=0.012, **TITLE)
    return figure


def figure_to_scale(count: int, title: str = "") -> "tuple[Figure, list[Axes]]":
    """(figure, axes side by side) for pictures of one scale; `arrange` gives them their place when the extent is known."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(WIDTH, 4.0))
    figure.suptitle(title, **TITLE)
    return figure, [figure.add_axes((0, 0, 1, 1), label=str(n)) for n in range(count)]


def arrange(
    figure: "Figure",
    axes: "Sequence[Axes]",
    low: Sequence[float] | Floats,
    high: Sequence[float] | Floats,
    left: float = 0.8,
    right: float = 0.15,
    top: float = 0.6,
    bottom: float = 0.55,
    trim: bool = False,
) -> None:
    """Show the box low ... high (x, y) in all axes at one scale, in a figure as high as that needs; margins in inches.

    `trim` also makes it as narrow as that needs.  matplotlib's own layouts lose the room of a legend where the aspect is fixed.
    """
    wide, tall = np.subtract(high, low)
    gap, room = left - 0.1, WIDTH - left - right
    width = (room - gap * (len(axes) - 1)) / len(axes)
    scale = min(width / wide, TALLEST / tall)
    height, whole = top + scale * tall + bottom, left + scale * wide + right if trim else WIDTH
    figure.set_size_inches(whole, height)
    for n, axis in enumerate(axes):
        axis.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
        axis.set_position(((left + n * (width + gap)) / whole, bottom / height, scale * wide / whole, scale * tall / height))
    figure.suptitle(figure.get_suptitle(), x=0.012, y=1 - 0.06 / height, va="top", **TITLE)


def svg(figure: "Figure") -> str:
    """The figure as SVG text: the same input, the same bytes.

    Letters stay text (selectable, a third of the size) in DejaVu Sans, for which the figure is laid out; the fonts named after it
    are no wider, so nothing is cut off where it is missing.  Paths keep two decimals of a point, a hundredth of what a printer shows.
    """
    sink = io.StringIO()
    with styled():
        _lay_out(figure)
        figure.savefig(sink, format="svg", dpi=RASTER, metadata={"Date": None, "Creator": None, "Format": None, "Type": None})
    text = sink.getvalue().replace("'DejaVu Sans'", "'DejaVu Sans', Verdana, Arial, sans-serif")
    return re.sub(r' d="([^"]+)"', lambda path: f' d="{_short(path[1])}"', text)


def _lay_out(figure: "Figure") -> None:
    """Give the axes their places once and for all: `savefig` would draw everything twice for it."""
    from matplotlib.backends.backend_svg import FigureCanvasSVG

    engine = figure.get_layout_engine()
    if engine is not None and figure.axes:
        FigureCanvasSVG(figure)  # whose letters count
        figure.set_dpi(POINTS)
        engine.execute(figure)
    figure.set_layout_engine(None)


def _short(path: str) -> str:
    """The commands of an SVG path with two decimals and no needless blanks."""
    return NEEDLESS.sub("", path)


def angle_ticks(axis: "Axis", low: float, high: float, most: int = 9) -> None:
    """Ticks of an angle in degrees at 5, 15, 30, 45, 90 ... where the range is a good part of a turn."""
    from matplotlib.ticker import MultipleLocator

    width = abs(high - low)
    if width >= 20:
        step = next((step for step in (5, 10, 15, 30, 45, 60, 90, 180) if width / step <= most), 360 * math.ceil(width / 360 / most))
        axis.set_major_locator(MultipleLocator(step))


def places(data: ArrayLike) -> tuple[NDArray[Any], list[str] | None]:
    """(numbers on an axis, names of the places 0, 1, 2 ... where the column holds texts, else None); texts come in their own order."""
    data = np.asarray(data)
    if data.dtype.kind in "fiub":
        return data, None
    names = list(dict.fromkeys(data.tolist()))
    place = {name: number for number, name in enumerate(names)}
    return np.array([place[name] for name in data.tolist()], int), [str(name) for name in names]


def show_places(axis: "Axis", numbers: ArrayLike, names: Sequence[str] | None) -> None:
    """Ticks of an axis (xaxis, yaxis): names at their places, or whole numbers for whole numbers."""
    if names is not None:
        turned = {"rotation": 40, "ha": "right", "rotation_mode": "anchor"} if axis is axis.axes.xaxis and are_turned(names) else {}
        each = -(-len(names) // MOST_NAMES)
        axis.set_ticks(range(0, len(names), each), [literal(wrapped(name, 28)) for name in names[::each]], **turned)
    elif np.asarray(numbers).dtype.kind in "iu":
        whole_ticks(axis)


def are_turned(names: Sequence[str]) -> bool:
    """Whether names under an axis are too long to stand beside each other."""
    return sum(len(name) + 2 for name in names) > TURNED


def whole_ticks(axis: "Axis") -> None:
    """Ticks at whole numbers only."""
    from matplotlib.ticker import MaxNLocator

    axis.set_major_locator(MaxNLocator("auto", steps=[1, 2, 5, 10], integer=True, min_n_ticks=1))


def log_ticks(axis: "Axis") -> None:
    """Names of ticks along a logarithmic axis: '10⁻³'."""
    from drivewright.view.powers import PowersOfTen

    axis.set_major_formatter(PowersOfTen())
    axis.set_minor_formatter(PowersOfTen())


def name_places(axis: "Axes", places: Sequence[tuple[float, str]]) -> None:
    """Names at places along the x axis, in the lower edge of the axes, each with a thin line up."""
    for x, name in places:
        axis.axvline(x, color=MUTED, lw=0.7, ls=(0, (1, 2)), zorder=0.5)
        axis.annotate(
            literal(name),
            (x, 0.0),
            xycoords=("data", "axes fraction"),
            xytext=(2, 3),
            textcoords="offset points",
            fontsize=8,
            color=MUTED,
            bbox=BADGE,
        )


def legend_above(axis: "Axes", handles: "Sequence[Artist] | None" = None, room: int = 84) -> None:
    """The legend in rows of `room` letters above an axis, from its left end on; none without anything to tell."""
    handles = axis.get_legend_handles_labels()[0] if handles is None else handles
    if handles:
        axis.legend(
            handles=handles,
            loc="lower left",
            bbox_to_anchor=(-0.01, 1.0),
            borderaxespad=0.1,
            handlelength=1.4,
            columnspacing=1.2,
            ncols=legend_columns([str(handle.get_label()) for handle in handles], room),
        )


def legend_columns(labels: Sequence[str], room: int = 92) -> int:
    """Columns of a legend so that its rows, even in length, stay within `room` letters: the figure's width at the legend's size."""
    rows = max(1, math.ceil(sum(len(label) + 6 for label in labels) / room))
    return max(1, math.ceil(len(labels) / rows))


def nice_length(largest: float) -> float:
    """The largest of 1, 2, 5 times a power of ten up to `largest`."""
    power = 10.0 ** math.floor(math.log10(largest))
    return next(step * power for step in (5, 2, 1) if step * power <= largest * (1 + 1e-12))
