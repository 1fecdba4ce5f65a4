"""Integrals that tests hold results against."""

import numpy as np

from drivewright.numerics.quadrature import cumulative_integral


def integrate_pieces(f, breaks, points=16):
    """Integral of f (values (..., m) of m abscissas) from breaks[0] to breaks[-1], smooth between neighbouring breaks."""
    return cumulative_integral(f, breaks, points)[..., -1]


def integrate_periodic(f, period, samples=256, start=0.0):
    """Integral of a smooth f over one period by the trapezoidal rule, which converges faster than any power."""
    x = start + period * np.arange(samples) / samples
    return period * np.mean(np.broadcast_to(f(x), x.shape), axis=-1)
