"""The pieces of an outline (`scene.Line`, `Arc`, `Spline`): ends, headings, thrifty sampling and sparse fits.

Everything in metres and radians; a spline is the C2 cubic through its knots over the chord length, with its end tangents.
"""

import numpy as np
import scipy

from drivewright._typing import Floats
from drivewright.curves import outlines
from drivewright.errors import counted
from drivewright.scene import Arc, Line, Piece, Spline

MOST_POINTS = 1_000_000  # of the polyline of a curve


def start(piece: Piece) -> Floats:
    """First point (2,) [m] of a piece."""
    return _end(piece, 0)


def end(piece: Piece) -> Floats:
    """Last point (2,) [m] of a piece."""
    return _end(piece, 1)


def headings(piece: Piece) -> tuple[Floats, Floats]:
    """Unit tangents (2,), (2,) at the start and at the end, in the direction of travel."""
    if isinstance(piece, Line):
        direction = end(piece) - start(piece)
        return (direction / np.hypot(*direction),) * 2
    if isinstance(piece, Arc):
        turn = np.sign(piece.sweep)
        return tuple(turn * np.array([-np.sin(a), np.cos(a)]) for a in (piece.start, piece.start + piece.sweep))
    return tuple(np.asarray(t, float) / np.hypot(*t) for t in (piece.start_tangent, piece.end_tangent))


def reverse(piece: Piece) -> Piece:
    """The same piece travelled backwards."""
    if isinstance(piece, Line):
        return Line(piece.end, piece.start)
    if isinstance(piece, Arc):
        return Arc(piece.center, piece.radius, piece.start + piece.sweep, -piece.sweep)
    back = [tuple(-np.asarray(t, float)) for t in (piece.end_tangent, piece.start_tangent)]
    return Spline(np.asarray(piece.knots, float)[::-1], *back)


def length(piece: Piece) -> float:
    """Arc length [m]; of a spline the length of its chords."""
    if isinstance(piece, Arc):
        return piece.radius * abs(piece.sweep)
    return float(np.hypot(*np.diff(piece.points(0.0), axis=0).T).sum())


def interpolant(spline: Spline) -> "scipy.interpolate.PPoly":
    """The curve of a `Spline`: clamped C2 cubic over the chord length s [m], as a vectorised function s -> (n, 2) [m]."""
    curve, distance = outlines.interpolant(spline)
    return scipy.interpolate.PPoly(np.stack([curve.c.real, curve.c.imag], axis=-1), distance)


def fit(spline: Spline, tolerance: float) -> "scipy.interpolate.BSpline":
    """Clamped cubic BSpline with few spans that stays within `tolerance` [m] of the curve through all the knots.

    It interpolates the curve at its breaks, has the same end tangents, and is C2; spans that miss a knot are halved until none is left.
    """
    curve = interpolant(spline)
    probe = between(curve.x)
    target, clamp = curve(probe), [[(1, t)] for t in headings(spline)]
    breaks = np.array([curve.x[0], curve.x[-1]])
    while True:
        sparse = scipy.interpolate.make_interp_spline(breaks, curve(breaks), k=3, bc_type=tuple(clamp))
        missed = probe[np.hypot(*(sparse(probe) - target).T) > tolerance]
        if not len(missed):
            return sparse
        spans = np.unique(np.clip(np.searchsorted(breaks, missed) - 1, 0, len(breaks) - 2))
        breaks = np.union1d(breaks, (breaks[spans] + breaks[spans + 1]) / 2)


def between(breaks: Floats, parts: int = 4) -> Floats:
    """The breaks (n,) of a curve with every span divided into `parts`: where two curves are compared."""
    return np.interp(np.arange(parts * (len(breaks) - 1) + 1) / parts, np.arange(len(breaks)), breaks)


def polyline(piece: Piece, tolerance: float) -> Floats:
    """Points (n, 2) [m] on the piece, as few as keep its chords within `tolerance` [m] of it."""
    if not isinstance(piece, Spline):
        return piece.points(tolerance)
    from shapely import LineString

    curve = interpolant(piece)
    second = np.hypot(*np.moveaxis(curve(curve.x, 2), 1, 0))  # |r''| is piecewise linear at most, so the ends of a span bound it
    step = np.diff(curve.x)
    parts = np.maximum(1, np.ceil(step * np.sqrt(np.maximum(second[1:], second[:-1]) / (8 * tolerance / 10))))
    counted(np.sum(parts), MOST_POINTS, "points of a curve", "allow a larger tolerance")
    parts = parts.astype(int)
    fine = np.concatenate([curve.x[i] + step[i] * np.arange(n) / n for i, n in enumerate(parts)] + [curve.x[-1:]])
    return np.array(LineString(curve(fine)).simplify(0.9 * tolerance).coords)


def halves(piece: Arc | Spline) -> tuple[Piece, Piece]:
    """The piece as two, cut in the middle."""
    if isinstance(piece, Arc):
        half = piece.sweep / 2
        return Arc(piece.center, piece.radius, piece.start, half), Arc(piece.center, piece.radius, piece.start + half, half)
    knots, middle = np.asarray(piece.knots, float), len(piece.knots) // 2
    curve = interpolant(piece)
    tangent = curve(curve.x[middle], 1)
    tangent = tuple(tangent / np.hypot(*tangent))
    return Spline(knots[: middle + 1], piece.start_tangent, tangent), Spline(knots[middle:], tangent, piece.end_tangent)


def _end(piece: Piece, which: int) -> Floats:
    if isinstance(piece, Arc):
        angle = piece.start + which * piece.sweep
        return np.asarray(piece.center) + piece.radius * np.array([np.cos(angle), np.sin(angle)])
    return np.asarray((piece.knots if isinstance(piece, Spline) else piece)[-which], float)
