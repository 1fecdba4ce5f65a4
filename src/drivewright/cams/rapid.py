"""Curvature and extremes of an oscillating follower for many designs: what the jets give, on plain complex numbers."""

import numpy as np

from drivewright._jit import kernel


@kernel
def rest(prime, pivot, arm):
    """cos of the arm's angle with the rod in."""
    return (pivot**2 + arm**2 - prime**2) / (2 * pivot * arm)


@kernel
def convexity(pivot, arm, q1, q2, w1, w2, u):
    """Im(conj(B') B'')/|B'|^3 of B = -i a' e^{iq} + i l e^{iw}, u = e^{i(w - q)}, seen in the frame that turns with q."""
    first = pivot * q1 - arm * w1 * u
    second = pivot * complex(q2, q1 * q1) - arm * complex(w2, w1 * w1) * u
    size = first.real**2 + first.imag**2
    return (np.conj(first) * second).imag / (size * np.sqrt(size))


@kernel
def peak(values):
    """Greatest value of a sampled function, by the parabola through its top three samples."""
    top = np.argmax(values)
    if top == 0 or top == values.shape[0] - 1:
        return values[top]
    before, here, after = values[top - 1], values[top], values[top + 1]
    bend = before - 2 * here + after
    return here - (after - before) ** 2 / (8 * bend) if bend < 0 else here
