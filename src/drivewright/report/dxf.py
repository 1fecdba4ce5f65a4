"""DXF drawings of flat parts: true arcs and circles, lines, splines; millimetres; one layer per role of a shape."""

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from drivewright._typing import Floats
from drivewright.atomic import replacing
from drivewright.errors import InputError
from drivewright.scene import Arc, Drawing, Line, Piece, Shape
from drivewright.solids import outlines, pieces

if TYPE_CHECKING:
    from ezdxf.layouts.layout import Modelspace

MM = 1e3
LAYERS = {  # colour index, line type
    "profile": (7, "CONTINUOUS"),
    "hole": (7, "CONTINUOUS"),
    "body": (8, "CONTINUOUS"),
    "roller": (3, "CONTINUOUS"),
    "pitch": (4, "CENTER"),
    "base": (5, "DASHED"),
    "axis": (1, "CENTER"),
    "ground": (9, "CONTINUOUS"),
    "defect": (6, "CONTINUOUS"),
    "notes": (2, "CONTINUOUS"),
}
LONG_RUN = 8  # more lines than this in a row stand for a curve (a sampled pitch curve) and become one polyline


def write_dxf(drawings: Drawing | Iterable[Drawing], path: str | Path, tolerance: float = 1e-6, splines: bool = True) -> None:
    """DXF R2010 file of one drawing, or of several side by side; the origin of the first is the origin of the file.

    Splines are C2 cubic B-splines within `tolerance` [m] of their knots; with `splines=False` polylines with chords
    within it, for machines that read none.  Title, thickness and overall size stand on layer `notes`.
    """
    from ezdxf import units
    from ezdxf.filemanagement import new

    drawings = (drawings,) if isinstance(drawings, Drawing) else tuple(drawings)
    if not drawings:
        raise InputError("a DXF file needs at least one drawing")
    with replacing(path) as temporary, _reproducible():
        document = new("R2010", setup=True, units=units.MM)
        for name in dict.fromkeys([shape.layer for drawing in drawings for shape in drawing.shapes] + ["notes"]):
            colour, linetype = LAYERS.get(name, (7, "CONTINUOUS"))
            document.layers.add(name, color=colour, linetype=linetype)
        _lay_out(document.modelspace(), drawings, tolerance, splines)
        for name in sorted(document.entitydb.dxf_types_in_use()):  # the library takes them in the order of a set
            document.classes.add_class(name)
        document.saveas(temporary)


def extent(drawing: Drawing, layer: str | None = None) -> tuple[Floats, Floats]:
    """Lower left and upper right corner (2,), (2,) [m] of a layer of a drawing, or of all its shapes where that layer is empty."""
    outlines = (drawing.on(layer) if layer else ()) or tuple(shape.outline for shape in drawing.shapes)
    if not outlines:
        raise InputError(f"drawing {drawing.name!r} has no shapes; give it at least a profile")
    points = np.concatenate([outline.points(1e-6) for outline in outlines])
    return points.min(axis=0), points.max(axis=0)


def _lay_out(space: "Modelspace", drawings: Sequence[Drawing], tolerance: float, splines: bool) -> None:
    """The drawings from left to right with room between for their notes; the first keeps its origin."""
    shift = 0.0
    for number, drawing in enumerate(drawings):
        low, high = (MM * corner for corner in extent(drawing))
        size = max(high - low)
        shift += 0.4 * size - low[0] if number else 0.0
        for shape in drawing.shapes:
            _draw(space, shape, f"drawing {drawing.name!r}", shift, tolerance, splines)
        _notes(space, drawing, low, shift, size / 40)
        shift += high[0]


def _draw(space: "Modelspace", shape: Shape, name: str, shift: float, tolerance: float, splines: bool) -> None:
    outline, at = outlines.normalised(shape.outline, name), {"layer": shape.layer}
    if ring := outlines.full_circle(outline):
        space.add_circle(_mm(ring.center, shift), MM * ring.radius, dxfattribs=at)
        return
    for _, run in groupby(outline.pieces, type):
        run = list(run)
        lines = [piece for piece in run if isinstance(piece, Line)]
        if len(lines) > LONG_RUN:
            space.add_lwpolyline([_mm(p, shift) for p in (lines[0].start, *(line.end for line in lines))], dxfattribs=at)
            continue
        for piece in run:
            _entity(space, piece, at, shift, tolerance, splines)


def _entity(space: "Modelspace", piece: Piece, at: dict[str, str], shift: float, tolerance: float, splines: bool) -> None:
    if isinstance(piece, Line):
        space.add_line(_mm(piece.start, shift), _mm(piece.end, shift), dxfattribs=at)
    elif isinstance(piece, Arc):
        angles = sorted(np.degrees([piece.start, piece.start + piece.sweep]).tolist())  # DXF arcs run counter-clockwise
        space.add_arc(_mm(piece.center, shift), MM * piece.radius, *angles, dxfattribs=at)
    elif splines:
        curve = pieces.fit(piece, tolerance)
        space.add_open_spline([_mm(c, shift) for c in curve.c], degree=3, knots=(MM * curve.t).tolist(), dxfattribs=at)
    else:
        space.add_lwpolyline([_mm(p, shift) for p in pieces.polyline(piece, tolerance)], dxfattribs=at)


def _mm(point: Sequence[float] | Floats, shift: float) -> tuple[float, float]:
    return (MM * float(point[0]) + shift, MM * float(point[1]))


def _notes(space: "Modelspace", drawing: Drawing, corner: Floats, shift: float, text: float) -> None:
    """Title above, overall width of the profile below and its height on the left, clear of the `corner` of all shapes; lengths in mm."""
    low, high = (MM * point + (shift, 0) for point in extent(drawing, "profile"))
    at = {"layer": "notes"}
    style = {"dimtxt": text, "dimasz": text, "dimexe": text / 2, "dimexo": text / 2, "dimgap": text / 3, "dimdec": 3, "dimlfac": 1.0}
    thickness = f", thickness {MM * drawing.thickness:g} mm" if drawing.thickness else ""
    top = MM * extent(drawing)[1][1] + 2 * text
    space.add_text(f"{drawing.title}{thickness}", height=text, dxfattribs=at).set_placement((low[0], top))
    left, below = corner[0] + shift - 4 * text, corner[1] - 4 * text
    for base, end, angle in (((low[0], below), (high[0], low[1]), 0), ((left, low[1]), (low[0], high[1]), 90)):
        space.add_linear_dim(base=base, p1=tuple(low), p2=end, angle=angle, dimstyle="EZDXF", override=style, dxfattribs=at).render()


@contextmanager
def _reproducible() -> Iterator[None]:
    """Equal drawings give equal bytes: ezdxf leaves out its dates and random identifiers."""
    from ezdxf import options  # pyright: ignore[reportPrivateImportUsage]  # documented as ezdxf.options

    before = options.write_fixed_meta_data_for_testing
    options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        options.write_fixed_meta_data_for_testing = before
