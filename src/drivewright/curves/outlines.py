"""Outlines from surviving spans of exact curves; area, perimeter and parallel outline (tool path) of an outline."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import scipy

from drivewright._typing import Floats
from drivewright.curves.pieces import gather
from drivewright.errors import InputError, counted
from drivewright.scene import Arc, Line, Outline, Spline, xy

_ARC = 1e-8  # a piece flagged as an arc may differ from one by this, relative to its radius
MOST_KNOTS = 1_000_000  # of a spline
_FEWEST = 8  # chords in a spline
_TURN = 0.1  # the coarse points of a spline are doubled until the curve turns less than this [rad] between them
_HALVINGS = 12
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(8)
_HIGHEST = np.stack([(k + 0.5) * _WEIGHTS * np.polynomial.legendre.Legendre.basis(k)(_NODES) for k in (6, 7)])


def span_measures(spans: Sequence[Any], panels: int = 12) -> tuple[float, float]:
    """Signed area (1/2) int Im(conj(z) dz) [m^2] and length int |dz| [m] of the closed chain of spans.

    Gauss's rule, all spans at once, their panels halved until both integrands are smooth on them: the two highest of the 8 Legendre
    coefficients are under 1e-6 of the span's mean; the rule's own error is about its square.
    """
    pieces, starts, stops = tuple(span.piece for span in spans), *np.array([(span.start, span.stop) for span in spans], dtype=float).T
    edges = np.linspace(starts, stops, panels + 1)
    own, low, high = np.tile(np.arange(len(spans)), panels), edges[:-1].ravel(), edges[1:].ravel()
    total, mean = np.zeros(2), None
    for halving in range(_HALVINGS):
        half = 0.5 * (high - low)
        jet = gather(pieces, np.repeat(own, len(_NODES)), (0.5 * (low + high)[:, None] + half[:, None] * _NODES).ravel())
        speed = np.abs(jet.d1) * np.repeat(np.sign(half), len(_NODES))
        values = np.stack([0.5 * np.imag(np.conj(jet.d0) * jet.d1), speed]).reshape(2, len(low), -1)
        mean = np.mean(np.abs(values).reshape(2, panels, len(spans), -1), axis=(1, 3)) if mean is None else mean
        rough = np.any(np.abs(values @ _HIGHEST.T).sum(axis=2) > 1e-6 * mean[:, own], axis=0) & (halving < _HALVINGS - 1)
        total += np.sum((half * (values @ _WEIGHTS))[:, ~rough], axis=1)
        if not rough.any():
            break
        middle = 0.5 * (low + high)[rough]
        own, low, high = np.tile(own[rough], 2), np.append(low[rough], middle), np.append(middle, high[rough])
    return float(total[0]), float(total[1])


def outline_of_spans(spans: Sequence[Any], tolerance: float, closed: bool = True) -> Outline:
    """Outline of the spans, turned counter-clockwise if closed: Arc and Line where flagged, else Spline.

    The knots of a spline lie on the exact curve, so close that no chord is further than `tolerance` [m] from it.
    """
    if closed and span_measures(spans)[0] < 0:
        spans = [span._replace(start=span.stop, stop=span.start) for span in reversed(spans)]
    makers = {"arc": _arc, "line": _line, "smooth": _spline}
    return Outline(tuple(makers[span.piece.shape](span, tolerance) for span in spans), closed)


def _arc(span, tolerance):
    points = span.piece.at(np.linspace(span.start, span.stop, 9)).d0
    center = _center(points[0], points[3], points[6])  # of a full circle the last point is the first
    arms = points - center
    radius = abs(arms[0])
    if not np.max(np.abs(np.abs(arms) - radius)) <= _ARC * radius:
        raise InputError(
            f"outline: piece '{span.piece.label}' is flagged as an arc but leaves the circle of radius {radius * 1e3:.4g} mm by "
            f"{np.max(np.abs(np.abs(arms) - radius)) * 1e3:.3g} mm. Flag only dwells about a fixed axis as arcs."
        )
    sweep = float(np.sum(np.angle(arms[1:] / arms[:-1])))
    return Arc(xy(center), float(radius), float(np.angle(arms[0])), sweep)


def _center(a, b, c):
    """Centre of the circle through three points; nan when they are in line."""
    b, c = b - a, c - a
    with np.errstate(divide="ignore", invalid="ignore"):
        return a + 1j * (b * abs(c) ** 2 - c * abs(b) ** 2) / (2 * np.imag(np.conj(b) * c))


def _line(span, tolerance):
    ends = span.piece.at(np.array([span.start, span.stop])).d0
    return Line(xy(ends[0]), xy(ends[1]))


def _spline(span, tolerance):
    """Knots spread so that the sagitta of every chord, its length times its turn / 8, is half the tolerance."""
    t, length, turn = _course(span)
    chords = np.maximum(np.sqrt(length * turn / (4 * tolerance)), _FEWEST / len(length))
    number = np.append(0.0, np.cumsum(chords))
    count = counted(np.ceil(number[-1]), MOST_KNOTS, "knots of a curve", "allow a larger tolerance")
    knots = np.interp(np.linspace(0, number[-1], count + 1), number, t)
    knots[0], knots[-1] = span.start, span.stop
    jet = span.piece.at(knots)
    heading = jet.d1 / np.abs(jet.d1) * np.sign(span.stop - span.start)
    return Spline(np.stack([jet.d0.real, jet.d0.imag], axis=1), xy(heading[0]), xy(heading[-1]))


def _course(span, count=129):
    """Parameters along a span, lengths and turns between them, fine enough for its sharpest place."""
    most = (count - 1) * 2 ** (_HALVINGS - 1) + 1
    while True:
        t = np.linspace(span.start, span.stop, count)
        speed = span.piece.at(t).d1
        turn = np.abs(np.angle(speed[1:] / speed[:-1]))
        if np.max(turn) < _TURN or count == most:
            return t, 0.5 * np.abs(speed[1:] + speed[:-1]) * np.abs(np.diff(t)), turn
        count = 2 * count - 1


def outline_area(outline: Outline) -> float:
    """Area [m^2] of a closed outline, positive when it runs counter-clockwise."""
    return float(sum(_sector(piece) for piece in outline.pieces))


def perimeter(outline: Outline) -> float:
    """Length [m] of an outline."""
    return float(sum(_length(piece) for piece in outline.pieces))


def _sector(piece):
    """(1/2) int x dy - y dx along the piece."""
    if isinstance(piece, Arc):
        start, end = (piece.radius * np.exp(1j * (piece.start + part)) for part in (0.0, piece.sweep))
        return 0.5 * (piece.radius**2 * piece.sweep + np.imag(np.conj(complex(*piece.center)) * (end - start)))
    if isinstance(piece, Line):
        return 0.5 * np.imag(np.conj(complex(*piece.start)) * complex(*piece.end))
    z, v, weight = _gauss(piece)
    return 0.5 * np.sum(weight * np.imag(np.conj(z) * v))


def _length(piece):
    if isinstance(piece, Arc):
        return piece.radius * abs(piece.sweep)
    if isinstance(piece, Line):
        return abs(complex(*piece.end) - complex(*piece.start))
    _, v, weight = _gauss(piece)
    return np.sum(weight * np.abs(v))


def _gauss(spline):
    """Points, derivatives and weights of Gauss's rule between the knots of a spline."""
    curve, u = interpolant(spline)
    x, w = np.polynomial.legendre.leggauss(4)
    half = 0.5 * np.diff(u)[:, None]
    at = 0.5 * (u[1:] + u[:-1])[:, None] + half * x
    return curve(at), curve(at, 1), half * w


def interpolant(spline: Spline) -> "tuple[scipy.interpolate.PPoly, Floats]":
    """Cubic through the knots with the given end tangents, over the running chord length; returns (curve, u at the knots)."""
    from scipy.interpolate import CubicSpline

    z = np.asarray(spline.knots) @ (1, 1j)
    u = np.append(0.0, np.cumsum(np.abs(np.diff(z))))
    ends = complex(*spline.start_tangent), complex(*spline.end_tangent)
    return CubicSpline(u, z, bc_type=((1, ends[0]), (1, ends[1]))), u  # pyright: ignore[reportArgumentType]  scipy's stub says str
