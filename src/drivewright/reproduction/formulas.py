"""Equations as pictures: mathtext drawn once, in the letters of the figures, for the page and for paper alike."""

import io
from collections.abc import Sequence
from functools import cache

from drivewright.view.palette import colour
from drivewright.view.style import styled

FONT = 13.0


def formula_picture(lines: Sequence[str]) -> str:
    """SVG text of an equation of one or several lines of mathtext (without dollar signs), as wide as it is."""
    return _picture(tuple(lines))


@cache
def _picture(lines: tuple[str, ...]) -> str:
    from matplotlib.figure import Figure
    from matplotlib.mathtext import MathTextParser

    lines = tuple(line.replace(r"\frac", r"\dfrac") for line in lines)
    sizes = [MathTextParser("path").parse(f"${line}$", dpi=72, prop=_letters()) for line in lines]
    heights = [max(float(size[1]) + 8.0, 20.0) / 72 for size in sizes]  # inches
    with styled():
        figure = Figure(figsize=(max(float(size[0]) for size in sizes) / 72 + 0.12, sum(heights)))
        figure.patch.set_alpha(0.0)
        top = sum(heights)
        for line, size, height in zip(lines, sizes, heights, strict=True):
            base = top - height / 2 + (float(size[2]) - float(size[1]) / 2) / 72  # of the letters: depth below it, height above
            figure.text(0.0, base / sum(heights), f"${line}$", fontproperties=_letters(), color=colour("ink"), va="baseline")
            top -= height
        return _outlined(figure)


def _letters():
    from matplotlib.font_manager import FontProperties

    return FontProperties(size=FONT, math_fontfamily="stix")


def _outlined(figure):
    """SVG text with letters as outlines: a reader's own mathematical letters have other widths."""
    import matplotlib

    sink = io.StringIO()
    with matplotlib.rc_context({"svg.fonttype": "path"}):
        figure.savefig(sink, format="svg", metadata={"Date": None, "Creator": None, "Format": None, "Type": None})
    return sink.getvalue()
