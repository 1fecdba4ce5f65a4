"""Figures for paper: plots narrow enough for two in a row where everything in them still fits, and all without the white around them."""

import math
import re
import warnings
from typing import TYPE_CHECKING, Any, NamedTuple

from drivewright.view.style import styled, svg

if TYPE_CHECKING:
    from matplotlib.figure import Figure

NARROW, LOWER, LOWER_SEVERAL = 0.6, 0.75, 0.85  # of the width, and of the height of a plot with one panel and with several
NAMES = 8.0  # points: letters of the names of narrow axes
POINTS = 72  # in an inch
FIRST_TAG = re.compile(r'width="[\d.]+pt" height="[\d.]+pt" viewBox="[^"]*"')
SIZE = re.compile(r'<svg[^>]*?\swidth="([\d.]+)(?:pt)?"[^>]*?\sheight="([\d.]+)(?:pt)?"|viewBox="[\d.-]+ [\d.-]+ ([\d.]+) ([\d.]+)"')
MARGIN = 3.0  # points of white that stay around


class Size(NamedTuple):
    """Of a picture [points]."""

    width: float
    height: float


def paper_svg(figure: "Figure") -> str:
    """The figure as SVG text, without its title, which the caption says."""
    figure.suptitle("")
    with styled():
        if figure.get_layout_engine() is not None and figure.axes:
            _make_narrow(figure)
    text = svg(figure)
    with styled():
        return _cropped(text, figure)


def size_of(text: str) -> Size:
    """The size of an SVG text; that of a square where it says none."""
    found = SIZE.search(text)
    width, height = ((found[1] or found[3]), (found[2] or found[4])) if found else ("400", "400")
    return Size(float(width), float(height))


def _make_narrow(figure: "Figure") -> None:
    """Makes a plot narrow and lower, and back again where its words do not fit into that."""
    width, height = figure.get_size_inches()
    names = [axis.label for axes in figure.axes for axis in (axes.xaxis, axes.yaxis)]
    sizes = [name.get_fontsize() for name in names]
    figure.set_size_inches(NARROW * width, (LOWER if len(figure.axes) == 1 else LOWER_SEVERAL) * height)
    for name in names:
        name.set_fontsize(NAMES)
    if _overflows(figure):
        figure.set_size_inches(width, height)
        for name, size in zip(names, sizes, strict=True):
            name.set_fontsize(size)


def _overflows(figure: "Figure") -> bool:
    """Whether words stand out of the figure, or the name of an axis is longer than it."""
    from matplotlib.backends.backend_svg import FigureCanvasSVG

    FigureCanvasSVG(figure)
    figure.set_dpi(POINTS)
    engine: Any = figure.get_layout_engine()
    with warnings.catch_warnings():
        warnings.filterwarnings("error", "constrained_layout not applied")
        try:
            engine.execute(figure)
        except UserWarning:  # no room for the axes
            return True
    box: Any = figure.get_tightbbox()
    width, height = figure.get_size_inches()
    outside = max(-box.x0, -box.y0, box.x1 - width, box.y1 - height)
    return bool(outside > 0.05 or any(_is_cut(axes) for axes in figure.axes))


def _is_cut(axes: Any) -> bool:
    """Whether the y axis has a name longer than itself, or the axes have become too small."""
    room, name = axes.get_window_extent(), axes.yaxis.label.get_window_extent()
    return bool(name.height > 1.25 * room.height or room.width < 80 or room.height < 40)


def _cropped(text: str, figure: "Figure") -> str:
    """SVG text whose view is what is drawn, and no more."""
    box: Any = figure.get_tightbbox()
    _, height = figure.get_size_inches()
    if not all(map(math.isfinite, (box.x0, box.y0, box.x1, box.y1))):
        return text
    x, y = POINTS * box.x0 - MARGIN, POINTS * (height - box.y1) - MARGIN
    wide, tall = POINTS * box.width + 2 * MARGIN, POINTS * box.height + 2 * MARGIN
    return FIRST_TAG.sub(f'width="{wide:.2f}pt" height="{tall:.2f}pt" viewBox="{x:.2f} {y:.2f} {wide:.2f} {tall:.2f}"', text, count=1)
