"""Splines through points, as piecewise polynomials (scipy's PPoly: coefficients .c, breaks .x, .derivative())."""

from math import factorial

import numpy as np
from scipy.interpolate import PPoly, make_interp_spline

from drivewright._typing import ArrayLike
from drivewright.errors import InputError

# Derivatives that vanish at an end, by kind of end and degree; a spline of degree k needs (k - 1)/2 of them.
_VANISHING = {("clamped", 3): (1,), ("clamped", 5): (1, 2), ("natural", 3): (2,), ("natural", 5): (3, 4)}


def interpolating_spline(x: ArrayLike, y: ArrayLike, degree: int = 3, ends: str = "natural") -> PPoly:
    """The spline of degree 3 or 5 with y(x) = y and all derivatives below the degree continuous; breaks at x.

    x (m,) ascending, y (m, ...).  ends: "periodic" (y[0] = y[-1]); "clamped": at rest, first derivative 0 and for degree 5
    the second too; "natural": free, second derivative 0, for degree 5 third and fourth.
    """
    x, y = _points(x, y, degree)
    if ends == "periodic":
        _check_period(y)
        y = np.concatenate([y[:-1], y[:1]])
        return _pieces(make_interp_spline(x, y, degree, bc_type="periodic"), x, "periodic")
    if (ends, degree) not in _VANISHING:
        raise InputError(f"spline: ends must be 'periodic', 'clamped' or 'natural', got {ends!r}.")
    conditions = [(order, np.zeros(y.shape[1:])) for order in _VANISHING[ends, degree]]
    return _pieces(make_interp_spline(x, y, degree, bc_type=(conditions, conditions)), x, True)


def _points(x, y, degree):
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    if degree not in (3, 5):
        raise InputError(f"spline: the degree must be 3 or 5, got {degree}.")
    if x.ndim != 1 or y.shape[:1] != x.shape or not (np.all(np.isfinite(x)) and np.all(np.isfinite(y))):
        raise InputError(f"spline: x (m,) and y (m, ...) must be finite and of one length, got shapes {x.shape} and {y.shape}.")
    if x.size <= degree:
        raise InputError(f"spline: degree {degree} needs at least {degree + 1} points, got {x.size}.")
    if np.any(np.diff(x) <= 0):
        first = int(np.argmax(np.diff(x) <= 0))
        raise InputError(f"spline: x must increase, but x[{first + 1}] = {x[first + 1]:g} follows {x[first]:g}; sort and drop repeats.")
    return x, y


def _check_period(y):
    gap = np.max(np.abs(y[-1] - y[0]))
    if gap > 1e-9 * np.ptp(y):
        raise InputError(
            f"spline: a periodic one must end where it starts, but the last value differs from the first by {gap:.3g}. "
            "Repeat the first value at the end of the period, or choose other ends."
        )


def _pieces(spline, breaks, extrapolate):
    """The polynomial of each interval between breaks, by Taylor's formula at its left end.

    PPoly.from_spline would list empty and outlying intervals too, and takes scalar splines only.
    """
    taylor = [spline(breaks[:-1], nu=order) / factorial(order) for order in range(spline.k, -1, -1)]
    return PPoly(np.stack(taylor), breaks, extrapolate=extrapolate)
