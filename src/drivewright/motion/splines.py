"""Motion through given points: interpolating splines of degree 3 or 5."""

import math
from collections.abc import Callable, Sequence

import numpy as np

from drivewright._typing import Floats
from drivewright.errors import InputError
from drivewright.motion.laws import register
from drivewright.motion.piecewise import CLOSURE, Piecewise

LEAST_POINTS = 3


def through_points(x: Floats, y: Floats, degree: int, ends: str, what: str) -> Piecewise:
    """`Piecewise` interpolating spline, its pieces between neighbouring points.

    ends "periodic": all degree - 1 continuous derivatives agree at both ends; "clamped": v = 0 there, for degree 5 a = 0 too.
    Error O(h^(degree+1)) in s for a smooth motion that meets the end conditions.
    """
    if degree not in (3, 5):
        raise InputError(f"{what}: degree {degree} is not offered; give 3 (a continuous) or 5 (j and its derivative continuous too).")
    if ends not in ("periodic", "clamped"):
        raise InputError(f"{what}: ends {ends!r} are unknown; give 'periodic' or 'clamped'.")
    return of_spline(_interpolated(x, y, degree, ends), x, degree, ends == "periodic")


def of_spline(spline: Callable[..., Floats], x: Floats, degree: int, closed: bool) -> Piecewise:
    """The `Piecewise` of a spline (x, nu) of a degree with its breaks at x."""
    middle = 0.5 * (x[:-1] + x[1:])
    poly = np.stack([spline(middle, nu=order) / math.factorial(order) for order in range(degree + 1)], axis=1)
    empty = np.zeros((len(middle), 0))
    return Piecewise(x, poly, empty.astype(complex), empty, closed=closed)


def _interpolated(x, y, degree, ends):
    from scipy.interpolate import make_interp_spline

    rest = [(order, 0.0) for order in range(1, (degree + 1) // 2)]
    return make_interp_spline(x, y, k=degree, bc_type="periodic" if ends == "periodic" else (rest, rest))


@register("spline")
def _spline(points, degree=5, ends="clamped"):
    """Through points (u, s) from (0, 0) to (1, 1); with periodic ends from (0, s0) back to (1, s0)."""
    points = np.asarray(points, dtype=float)
    what = "motion law 'spline'"
    if points.ndim != 2 or points.shape[1] != 2 or len(points) < LEAST_POINTS:
        raise InputError(f"{what}: needs at least {LEAST_POINTS} points (u, s), got an array of shape {points.shape}.")
    u, s = points.T
    refuse_disorder(u, s, what, [f"point {k + 1}" for k in range(len(u))], "u")
    if not np.allclose(u[[0, -1]], (0, 1), rtol=0, atol=CLOSURE):
        raise InputError(f"{what}: the points run from u = {u[0]:.9g} to {u[-1]:.9g}; they must run from 0 to 1.")
    first, last = (s[0], s[0]) if ends == "periodic" else (0, 1)
    if not np.allclose(s[[0, -1]], (first, last), rtol=0, atol=CLOSURE):
        raise InputError(
            f"{what}: s runs from {s[0]:.9g} to {s[-1]:.9g}; with {ends} ends it must run from {first:.9g} to {last:.9g}"
            f"{'' if ends == 'periodic' else ' (the rise is that of the segment)'}."
        )
    return through_points(np.array([0.0, *u[1:-1], 1.0]), np.array([first, *s[1:-1], last]), degree, ends, what)


def refuse_disorder(x: Floats, y: Floats, what: str, places: Sequence[str], x_name: str) -> None:
    """InputError naming the first place with a non-finite entry or where x does not increase."""
    for name, column in ((x_name, x), ("the lift", y)):
        if not np.all(np.isfinite(column)):
            k = np.flatnonzero(~np.isfinite(column))[0]
            raise InputError(f"{what}, {places[k]}: {name} is {column[k]}, not a finite number.")
    if np.any(np.diff(x) <= 0):
        k = np.flatnonzero(np.diff(x) <= 0)[0] + 1
        raise InputError(
            f"{what}, {places[k]}: {x_name} is {x[k]:.9g} after {x[k - 1]:.9g}, but must increase from row to row. "
            "Sort the rows and drop repeats."
        )
