"""Curvature and extremes of an oscillating follower for many designs: what the jets give, on plain complex numbers."""

import numpy as np

from drivewright._jit import kernel
from drivewright._typing import Floats


@kernel
def rest_cosine(prime: float, pivot: float, arm: float) -> float:
    """Cosine of the arm's angle at zero lift, from prime radius, pivot distance and arm length [m]."""
    return (pivot**2 + arm**2 - prime**2) / (2 * pivot * arm)


@kernel
def pitch_curvature(pivot: float, arm: float, q1: float, q2: float, w1: float, w2: float, u: complex) -> float:
    """Im(conj(B') B'')/|B'|^3 of B = -i a' e^{iq} + i l e^{iw}, u = e^{i(w - q)}, seen in the frame that turns with q  [1/m].

    pivot, arm [m]; q1, q2, w1, w2: derivatives of q and w [rad] by the driving angle.
    """
    first = pivot * q1 - arm * w1 * u
    second = pivot * complex(q2, q1 * q1) - arm * complex(w2, w1 * w1) * u
    size = first.real**2 + first.imag**2
    return (np.conj(first) * second).imag / (size * np.sqrt(size))


@kernel
def sampled_peak(values: Floats) -> float:
    """Greatest value of a function from its samples (m,), by the parabola through its top three samples."""
    top = np.argmax(values)
    if top == 0 or top == values.shape[0] - 1:
        return values[top]
    before, here, after = values[top - 1], values[top], values[top + 1]
    curvature = before - 2 * here + after
    return here - (after - before) ** 2 / (8 * curvature) if curvature < 0 else here
