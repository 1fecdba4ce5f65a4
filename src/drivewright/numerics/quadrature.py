"""Integrals of smooth functions: Gauss-Legendre on pieces, the trapezoidal rule over a period; of samples: Simpson's rule and the polygon.

A function takes an array of abscissas (m,) and returns values (..., m); integrals have the leading shape.
"""

import functools
from collections.abc import Callable

import numpy as np

from drivewright._typing import ArrayLike, Floats
from drivewright.errors import InputError


def integrate_pieces(f: Callable[[Floats], Floats], breaks: ArrayLike, points: int = 16) -> Floats:
    """Integral of f from breaks[0] to breaks[-1], where f is smooth between neighbouring breaks.

    `points` Gauss nodes per piece are exact for polynomials of degree 2 points - 1 there.
    """
    return _piece_integrals(f, breaks, points).sum(axis=-1)


def cumulative_integral(f: Callable[[Floats], Floats], breaks: ArrayLike, points: int = 16) -> Floats:
    """Integrals of f from breaks[0] to every break: (..., len(breaks)), the first one 0."""
    pieces = _piece_integrals(f, breaks, points)
    return np.concatenate([np.zeros_like(pieces[..., :1]), np.cumsum(pieces, axis=-1)], axis=-1)


def integrate_periodic(f: Callable[[Floats], Floats], period: float, samples: int = 256, start: float = 0.0) -> Floats:
    """Integral of f over one period by the trapezoidal rule, which for a smooth periodic f converges faster than any power."""
    x = start + period * np.arange(samples) / samples
    return period * np.mean(_values(f, x), axis=-1)


def cumulative_simpson(values: Floats, x: Floats) -> Floats:
    """Integrals from x[0] to every x of the parabolas through samples 0 1 2, 2 3 4 ...: values (m, ...), x (m,) ascending -> (m, ...).

    An interval left over at the end gets the last parabola, two samples a straight line.  Exact for quadratics; at every second of evenly
    spaced samples exact for cubics.  With f[a, b, c] the second divided difference, an interval h has h (f_a + f_b)/2 - f[a, b, c] h^3/6.
    (scipy.integrate has the like; it takes 0.2 s to import.)
    """
    h = np.diff(x).reshape(-1, *(1,) * (values.ndim - 1))
    pieces = h / 2 * (values[1:] + values[:-1])
    if len(x) > 2:
        bends = np.diff(np.diff(values, axis=0) / h, axis=0) / (h[1:] + h[:-1])
        parabola = np.minimum(np.arange(len(h)) // 2 * 2, len(bends) - 1)
        pieces -= bends[parabola] * h**3 / 6
    return np.concatenate([np.zeros_like(values[:1]), np.cumsum(pieces, axis=0)])


def trapezoid(values: Floats, x: Floats) -> Floats:
    """Integral of the polygon through samples: values (m, ...), x (m,) -> (...)."""
    h = np.diff(x).reshape(-1, *(1,) * (values.ndim - 1))
    return np.sum(h / 2 * (values[1:] + values[:-1]), axis=0)


def _piece_integrals(f, breaks, points):
    breaks = np.asarray(breaks, dtype=float)
    if breaks.ndim != 1 or breaks.size < 2 or np.any(np.diff(breaks) < 0):
        raise InputError(f"quadrature: breaks must be two or more ascending numbers, got {breaks}; sort them.")
    nodes, weights = _gauss(points)
    half = 0.5 * np.diff(breaks)[:, None]
    x = breaks[:-1, None] + half * (1 + nodes)
    values = _values(f, x.ravel())
    return (values.reshape(*values.shape[:-1], *x.shape) * half * weights).sum(axis=-1)


def _values(f, x):
    """f(x) with x's axis last, also when f forgot to depend on x."""
    values = np.asarray(f(x))
    return values if values.shape[-1:] == x.shape else np.broadcast_to(values, x.shape)


@functools.cache
def _gauss(points):
    return np.polynomial.legendre.leggauss(points)
