"""Integrals of smooth functions: Gauss-Legendre on pieces, the trapezoidal rule over a period.

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
