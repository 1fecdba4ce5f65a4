"""Quantities given as piecewise polynomials: the motion of a drive, a load, the lift of a cam."""

from dataclasses import dataclass

import numpy as np

from drivewright._jit import inner, per_lane
from drivewright._typing import Floats, Numbers
from drivewright.multibody.records import Records
from drivewright.numerics.lanes import all_lanes


@dataclass(frozen=True, eq=False)
class Curve:
    """A quantity as piecewise polynomials: f(x) = sum c_k (x - x_i)^k in [x_i, x_(i+1)], repeated every `period` where it is not 0.

    breaks (n + 1,), coefficients (n, 6) in ascending powers; outside its breaks an aperiodic curve goes on with its end pieces.
    """

    breaks: Floats
    coefficients: Floats
    period: float = 0.0


def line(start: float, slope: float) -> Curve:
    """The Curve start + slope x."""
    return Curve(np.array([0.0, 1.0]), np.array([[start, slope, 0.0, 0.0, 0.0, 0.0]]))


def curve_values(curve: Curve, x: Numbers) -> Floats:
    """f of a `Curve` at x, any shape."""
    coefficients, u = _piece_of(curve, x)
    return np.sum(coefficients * u[..., None] ** np.arange(coefficients.shape[-1]), axis=-1)


def curve_slope(curve: Curve, x: Numbers) -> Floats:
    """df/dx of a `Curve` at x, any shape."""
    coefficients, u = _piece_of(curve, x)
    powers = np.arange(1, coefficients.shape[-1])
    return np.sum(powers * coefficients[..., 1:] * u[..., None] ** (powers - 1), axis=-1)


def _piece_of(curve, x):
    """(coefficients (..., 6) of the piece in which every x lies, x from its start on)."""
    breaks, coefficients = np.asarray(curve.breaks), np.asarray(curve.coefficients)
    x = breaks[0] + (x - breaks[0]) % curve.period if curve.period else np.asarray(x)
    piece = np.clip(np.searchsorted(breaks[: len(coefficients)], x, side="right") - 1, 0, None)
    return coefficients[piece], x - breaks[piece]


@inner
def curve_at(curves: Records, pieces: Records, index: int, x: float) -> tuple[float, float, float]:
    """(f, f', f'') of the curve number `index` at x.  curves (n,) of CURVE, pieces (k,) of PIECE."""
    curve = curves[index]
    if curve.count == 1 and all_lanes(curve.period == 0.0):
        return _piece_at(pieces[curve.first], x)
    return _pieces_at(curves, pieces, index, x)


@per_lane
def _pieces_at(curves, pieces, index, x):
    """`curve_at` of several pieces, or of one that is repeated. curves (n,) of CURVE, pieces (k,) of PIECE."""
    curve = curves[index]
    low, high = curve.first, curve.first + curve.count - 1
    start = pieces[low].start
    if curve.period > 0.0:
        x = start + (x - start) % curve.period
    while low < high:
        middle = (low + high + 1) // 2
        if pieces[middle].start <= x:
            low = middle
        else:
            high = middle - 1
    return _piece_at(pieces[low], x)


@inner
def _piece_at(p, x):
    """`curve_at` of one piece."""
    u = x - p.start
    value = p.c0 + u * (p.c1 + u * (p.c2 + u * (p.c3 + u * (p.c4 + u * p.c5))))
    slope = p.c1 + u * (2 * p.c2 + u * (3 * p.c3 + u * (4 * p.c4 + u * 5 * p.c5)))
    return value, slope, 2 * p.c2 + u * (6 * p.c3 + u * (12 * p.c4 + u * 20 * p.c5))
