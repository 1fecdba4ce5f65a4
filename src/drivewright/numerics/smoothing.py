"""The smoothest curve within a band about given points.

    minimise  int (s''')^2 dx    over all s with |s(x_i) - y_i| <= band at every point

The minimiser is a quintic spline with its knots at the points, for of all curves with the same values there the interpolating spline has
the least integral; so a quadratic programme in its coefficients finds it exactly.  Solved by a primal-dual interior point method from
the interpolating spline, which lies in the middle of the band, so that the band holds at every step (Nocedal & Wright, Numerical
Optimization, section 16.6; recalled).  All matrices are banded.
"""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import scipy

from drivewright._typing import Floats
from drivewright.errors import InputError, SolverError

if TYPE_CHECKING:
    from scipy.interpolate import BSpline

DEGREE = 5
STEPS = 200
TOLERANCE = 1e-9  # of the duality gap over the objective
KEEP = 0.995  # part of the way to the edge of the band that a step may go
GAUSS = np.polynomial.legendre.leggauss(3)  # exact for the square of a third derivative, which has degree 4


class _Problem(NamedTuple):
    """|rows p - target| <= 1 with the least 1/2 p' curve p + slope' p; `full` p + `fixed` are the coefficients of the spline."""

    curve: "scipy.sparse.csc_array"
    slope: Floats
    rows: "scipy.sparse.csr_array"
    target: Floats


def smoothest_within(x: Floats, y: Floats, band: float, periodic: bool) -> "BSpline":
    """The `BSpline` of degree 5 on x[0] .. x[-1].  x (m,) ascending, m >= 6, y (m,) with y[0] = y[-1] where periodic.

    Not periodic: it starts in y[0] and ends in y[-1], at rest, with first and second derivative 0.
    """
    if len(x) < DEGREE + 1:
        raise InputError(f"smoothing: {len(x)} points are too few; give at least {DEGREE + 1}.")
    if not band > 0:
        raise InputError(f"smoothing: the band is {band:.6g}; it must be above 0.")
    step = float(np.mean(np.diff(x)))
    knots = _knots(x / step, periodic)
    free, fixed = _coefficients(y, len(knots) - DEGREE - 1, periodic)
    bending = _third_derivative(knots, x / step) @ free
    offset = _third_derivative(knots, x / step) @ fixed
    values = _design(x / step, knots)
    rows = slice(None, -1) if periodic else slice(1, -1)
    problem = _Problem(
        (bending.T @ bending).tocsc(), bending.T @ offset / band, (values @ free).tocsr()[rows], (y - values @ fixed)[rows] / band
    )
    found = free @ (band * _solve(problem)) + fixed
    return scipy.interpolate.BSpline(knots * step, found, DEGREE)


def _knots(x, periodic):
    """Knots at the points, repeated at the ends, or carried on by a period."""
    if not periodic:
        return np.concatenate([np.full(DEGREE, x[0]), x, np.full(DEGREE, x[-1])])
    period = x[-1] - x[0]
    places = np.arange(-DEGREE, len(x) + DEGREE)
    count = len(x) - 1
    return x[places % count] + period * (places // count)


def _coefficients(y, count, periodic):
    """(free, fixed): the coefficients of the spline are free @ p + fixed."""
    if periodic:
        own = count - DEGREE
        return scipy.sparse.csr_array((np.ones(count), (np.arange(count), np.arange(count) % own)), shape=(count, own)), np.zeros(count)
    held = (DEGREE + 1) // 2
    fixed = np.zeros(count)
    fixed[:held], fixed[-held:] = y[0], y[-1]
    inner = np.arange(held, count - held)
    return scipy.sparse.csr_array((np.ones(len(inner)), (inner, np.arange(len(inner)))), shape=(count, len(inner))), fixed


def _design(x, knots, degree=DEGREE):
    return scipy.sparse.csr_array(scipy.interpolate.BSpline.design_matrix(np.clip(x, knots[degree], knots[-degree - 1]), knots, degree))


def _third_derivative(knots, x):
    """Matrix from the coefficients to s''' at Gauss's places of every interval, times the root of their weights."""
    node, weight = GAUSS
    width = np.diff(x)
    places = (x[:-1, None] + 0.5 * width[:, None] * (1 + node)).ravel()
    matrix, degree = scipy.sparse.eye_array(len(knots) - DEGREE - 1), DEGREE
    for _ in range(3):
        matrix, knots, degree = _difference(knots, degree) @ matrix, knots[1:-1], degree - 1
    return scipy.sparse.diags_array(np.sqrt(0.5 * np.outer(width, weight).ravel())) @ (_design(places, knots, degree) @ matrix)


def _difference(knots, degree):
    """Matrix from the coefficients of a spline to those of its derivative: k (c[i+1] - c[i])/(t[i+k+1] - t[i+1])."""
    count = len(knots) - degree - 1
    scale = degree / (knots[degree + 1 : degree + count] - knots[1:count])
    return scipy.sparse.diags_array([-scale, scale], offsets=[0, 1], shape=(count - 1, count))  # pyright: ignore[reportArgumentType]


def _solve(problem: _Problem) -> Floats:
    """p of a `_Problem`, from the p that meets all targets."""
    curve, slope, rows, target = problem
    start = scipy.sparse.linalg.spsolve((rows.T @ rows + 1e-13 * curve).tocsc(), rows.T @ target)
    p = start + scipy.sparse.linalg.spsolve((rows.T @ rows + 1e-13 * curve).tocsc(), rows.T @ (target - rows @ start))
    upper = lower = np.full(len(target), max(1.0, float(np.max(np.abs(curve @ p + slope)))))
    for _ in range(STEPS):
        residual = rows @ p - target
        above, below = 1 - residual, 1 + residual
        gap = float(upper @ above + lower @ below)
        objective = float(0.5 * p @ (curve @ p) + slope @ p)
        gradient = curve @ p + slope + rows.T @ (upper - lower)
        if gap <= TOLERANCE * (1 + abs(objective)) and np.max(np.abs(gradient)) <= 1e-6 * (1 + np.max(upper + lower)):
            return p
        aim = 0.1 * gap / (2 * len(target))
        weight = upper / above + lower / below
        matrix = curve + rows.T @ (scipy.sparse.diags_array(weight) @ rows)
        move = scipy.sparse.linalg.spsolve(matrix.tocsc(), -(curve @ p + slope) - rows.T @ (aim / above - aim / below))
        turn = rows @ move
        d_upper, d_lower = aim / above - upper + upper / above * turn, aim / below - lower - lower / below * turn
        far = min(
            1.0, *(KEEP * _room(value, change) for value, change in ((above, -turn), (below, turn), (upper, d_upper), (lower, d_lower)))
        )
        p, upper, lower = p + far * move, upper + far * d_upper, lower + far * d_lower
    raise SolverError("smoothing: the smoothest curve within the band did not settle; give a wider band or fewer points.", partial=p)


def _room(value, change):
    """How far positive values may change before one of them is 0."""
    shrinking = change < 0
    return float(np.min(-value[shrinking] / change[shrinking], initial=np.inf))
