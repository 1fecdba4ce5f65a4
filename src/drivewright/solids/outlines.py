"""Outlines made ready for a file: pieces without zero-length parts, joined exactly, counter-clockwise, free of crossings."""

from typing import TYPE_CHECKING

import numpy as np

from drivewright._typing import Floats
from drivewright.curves import outline_area
from drivewright.errors import InputError
from drivewright.scene import Arc, Line, Outline, Prism, Spline
from drivewright.solids import pieces as of

if TYPE_CHECKING:
    import shapely

SNAP = 1e-9  # m: shorter pieces are dropped and smaller gaps are closed


def normalised(outline: Outline, name: str) -> Outline:
    """The outline with its pieces end to end, as an Outline whose arcs turn by half a turn at most.

    Pieces and steps between knots shorter than 1e-9 m are dropped, gaps below it closed, closed splines cut in two, and a closed
    outline is turned counter-clockwise.  A wider gap raises InputError naming `name`, the place and the gap.
    """
    for number, piece in enumerate(outline.pieces):
        if not np.isfinite(np.concatenate([np.ravel(np.asarray(value, float)) for value in piece])).all():
            raise InputError(f"{name}: piece {number} of the outline ({type(piece).__name__.lower()}) holds a number that is not finite")
    _refuse_gaps(outline, name)
    pieces = _snapped([part for piece in outline.pieces for part in _tidy(piece)], outline.closed)
    pieces = [piece for piece in pieces if of.length(piece) > SNAP / 10]  # snapping may have drawn the ends of one together
    if not pieces:
        raise InputError(f"{name}: the outline has no piece longer than {SNAP:g} m; give it lines, arcs or splines with some length")
    if outline.closed and outline_area(Outline(tuple(pieces))) < 0:
        pieces = [of.reverse(piece) for piece in pieces[::-1]]
    return Outline(tuple(pieces), outline.closed)


def piece_ends(outline: Outline) -> Floats:
    """Points (n + 1, 2) [m] at which the pieces of a `normalised` outline start, and the last end.

    Two arcs that meet within the snapping distance have one joint here, which their own centres and radii cannot say.
    """
    points = [of.start(piece) for piece in outline.pieces]
    return np.array([*points, points[0] if outline.closed else of.end(outline.pieces[-1])])


def polyline(outline: Outline, tolerance: float) -> Floats:
    """Points (n, 2) [m] along a `normalised` outline within `tolerance` [m] of it, without repeating the first of a closed one."""
    chains = [of.polyline(piece, tolerance)[:-1] for piece in outline.pieces]
    return np.concatenate(chains if outline.closed else [*chains, of.end(outline.pieces[-1])[None]])


def full_circle(outline: Outline) -> Arc | None:
    """The first arc of a `normalised` outline that is one full circle, else None."""
    arcs = [piece for piece in outline.pieces if isinstance(piece, Arc)]
    if not outline.closed or len(arcs) < len(outline.pieces):
        return None
    first = arcs[0]
    same = all(np.hypot(*np.subtract(arc.center, first.center)) + abs(arc.radius - first.radius) < SNAP for arc in arcs)
    return first if same else None


def outline_polygon(outline: Outline, name: str, tolerance: float = 1e-6) -> "shapely.Polygon":
    """shapely Polygon [m] of a closed `normalised` outline; InputError naming the place where it crosses itself."""
    import shapely

    if not outline.closed:
        raise InputError(f"{name}: the outline is open; a face needs a closed one")
    points = polyline(outline, tolerance)
    if len(points) < 3:
        raise InputError(f"{name}: the outline encloses nothing; it runs to and fro on one line")
    shape = shapely.Polygon(points)
    if not shape.is_valid:
        raise InputError(f"{name}: the outline crosses or touches itself at {_place(shape)}; trim it there, or cut less deep")
    return shape


def prism_region(prism: Prism, name: str, tolerance: float = 1e-6) -> "shapely.Polygon":
    """shapely Polygon [m] of a prism's outline minus its holes; InputError where a hole is outside or breaks it up."""
    import shapely

    rest = outline_polygon(normalised(prism.outline, name), name, tolerance)
    for number, hole in enumerate(prism.holes):
        cutter = outline_polygon(normalised(hole, f"hole {number} of {name}"), f"hole {number} of {name}", tolerance)
        if not cutter.intersects(rest) or cutter.covers(rest):
            raise InputError(f"{name}: hole {number} lies outside the outline or leaves nothing of it; move it or make it smaller")
        remaining = rest.difference(cutter)
        if not isinstance(remaining, shapely.Polygon):
            count = len(shapely.get_parts(remaining))
            raise InputError(f"{name}: hole {number} cuts the outline into {count} pieces; make it smaller")
        rest = remaining
    return rest


def _refuse_gaps(outline, name):
    count = len(outline.pieces)
    for i in range(count if outline.closed else count - 1):
        j = (i + 1) % count
        gap = np.hypot(*(of.start(outline.pieces[j]) - of.end(outline.pieces[i])))
        if gap >= SNAP:
            x, y = 1e3 * of.end(outline.pieces[i])
            raise InputError(
                f"{name}: a gap of {1e3 * gap:.6g} mm between pieces {i} and {j} of the outline at ({x:.6g}, {y:.6g}) mm; "
                f"pieces must meet within {1e3 * SNAP:g} mm"
            )


def _tidy(piece):
    """The piece as zero, one or two that every file format can hold."""
    if isinstance(piece, Spline):
        piece = _without_repeats(piece)
    if of.length(piece) < SNAP:
        return ()
    closed_spline = isinstance(piece, Spline) and len(piece.knots) > 2 and np.hypot(*(of.end(piece) - of.start(piece))) < SNAP
    wide_arc = isinstance(piece, Arc) and abs(piece.sweep) > np.pi * (1 + 1e-12)
    return of.halves(piece) if closed_spline or wide_arc else (piece,)


def _without_repeats(spline):
    knots = np.asarray(spline.knots, float)
    keep = np.concatenate([[True], np.hypot(*np.diff(knots, axis=0).T) >= SNAP])
    return spline._replace(knots=knots[keep])


def _snapped(pieces, closed):
    """Pieces whose ends agree: the end of an arc wins, since it alone cannot be moved."""
    pieces = list(pieces)
    for i in range(len(pieces) if closed else len(pieces) - 1):
        j = (i + 1) % len(pieces)
        if isinstance(pieces[j], Arc):
            pieces[i] = _moved(pieces[i], -1, of.start(pieces[j]))
        else:
            pieces[j] = _moved(pieces[j], 0, of.end(pieces[i]))
    return pieces


def _moved(piece, which, point):
    if isinstance(piece, Arc):
        return piece
    if isinstance(piece, Line):
        ends = list(piece)
        ends[which] = tuple(point)
        return Line(*ends)
    knots = np.array(piece.knots, float)
    knots[which] = point
    return piece._replace(knots=knots)


def _place(shape):
    from shapely import is_valid_reason

    words = is_valid_reason(shape)
    try:
        x, y = (1e3 * float(number) for number in words.split("[")[1].rstrip("]").split())
    except (IndexError, ValueError):
        return words
    return f"({x:.4g}, {y:.4g}) mm"
