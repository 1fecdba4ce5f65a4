"""SVG drawings of flat parts in true millimetres, for laser cutters and plots: arcs are SVG arcs, splines cubic Beziers."""

from collections.abc import Sequence
from html import escape
from pathlib import Path

import numpy as np

from drivewright._typing import Floats
from drivewright.atomic import write_text
from drivewright.report.dxf import extent
from drivewright.scene import Arc, Drawing, Line, Outline, Piece
from drivewright.solids import outlines, pieces

MM = 1e3
STROKES = {
    "profile": "#000",
    "hole": "#000",
    "pitch": "#0891b2",
    "base": "#1d4ed8",
    "roller": "#15803d",
    "axis": "#b91c1c",
    "defect": "#c026d3",
}
DASHES = {"pitch": "4 1 1 1", "axis": "4 1 1 1", "base": "2 1"}


def write_svg(drawing: Drawing, path: str | Path, tolerance: float = 1e-6, margin: float = 2e-3, stroke: float = 1e-4) -> None:
    """SVG file of a drawing at scale 1:1, y up as in the drawing, one group per layer; lengths of the arguments in metres.

    Splines stay within `tolerance` of their knots; `margin` surrounds the shapes; `stroke` is the width of the lines.
    """
    low, high = extent(drawing)
    x, y, width, height = MM * np.array([low[0] - margin, -high[1] - margin, *(high - low + 2 * margin)])
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.4f}mm" height="{height:.4f}mm" '
        f'viewBox="{x:.4f} {y:.4f} {width:.4f} {height:.4f}">',
        f"<title>{escape(drawing.title)}</title>",
    ]
    for layer in dict.fromkeys(shape.layer for shape in drawing.shapes):
        dash = f' stroke-dasharray="{DASHES[layer]}"' if layer in DASHES else ""
        lines.append(f'<g id="{escape(layer)}" fill="none" stroke="{STROKES.get(layer, "#555")}" stroke-width="{MM * stroke:g}"{dash}>')
        lines += [f'<path d="{path_data(outline, drawing.name, tolerance)}"/>' for outline in drawing.on(layer)]
        lines.append("</g>")
    write_text(path, "\n".join([*lines, "</svg>", ""]))


def path_data(outline: Outline, name: str, tolerance: float = 1e-6) -> str:
    """The `d` of an SVG path [mm, y down] of an outline."""
    outline = outlines.normalised(outline, f"drawing {name!r}")
    steps = [f"M{_pair(pieces.start(outline.pieces[0]))}", *(_step(piece, tolerance) for piece in outline.pieces)]
    return " ".join(steps + ["Z"] * outline.closed)


def _step(piece: Piece, tolerance: float) -> str:
    if isinstance(piece, Line):
        return f"L{_pair(piece.end)}"
    if isinstance(piece, Arc):  # y points down in SVG, so counter-clockwise is its negative sense
        return f"A{_number(piece.radius)} {_number(piece.radius)} 0 0 {0 if piece.sweep > 0 else 1} {_pair(pieces.end(piece))}"
    curve = pieces.fit(piece, tolerance)
    breaks = np.unique(curve.t)
    third, at, slope = np.diff(breaks)[:, None] / 3, curve(breaks), curve(breaks, 1)
    return " ".join(
        f"C{_pair(a)} {_pair(b)} {_pair(c)}"
        for a, b, c in zip(at[:-1] + third * slope[:-1], at[1:] - third * slope[1:], at[1:], strict=True)
    )


def _pair(point: Sequence[float] | Floats) -> str:
    return f"{_number(point[0])} {_number(-point[1])}"


def _number(metres: float) -> str:
    return f"{round(MM * float(metres), 6) + 0.0:.6f}".rstrip("0").rstrip(".")
