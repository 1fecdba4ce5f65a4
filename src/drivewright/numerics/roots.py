"""Roots and extremes of smooth functions.

A scalar function here is vectorised: an array of abscissas in, an array of values out.
"""

from collections.abc import Callable

import numpy as np

from drivewright._typing import ArrayLike, Floats
from drivewright.errors import InputError, SolverError


def bracketed_roots(f: Callable[[Floats], ArrayLike], grid: ArrayLike) -> Floats:
    """All x where the continuous f changes sign between neighbours of `grid`, or is exactly 0 on it, ascending.

    Each bracket is refined to a few units in the last place.  A pole also changes sign; it is recognised because |f| grows
    there, and left out.  A root that f only touches is not seen: look for it with `extremes`.
    """
    grid = np.asarray(grid, dtype=float)
    if grid.ndim != 1 or np.any(np.diff(grid) <= 0):
        raise InputError("bracketed_roots: the grid must be one row of strictly increasing numbers; sort it and drop repeats.")
    values = _values(f, grid)
    if not np.all(np.isfinite(values)):
        bad = grid[~np.isfinite(values)]
        raise InputError(f"bracketed_roots: f is not finite at {bad.size} grid points, first at {bad[0]:.6g}. Move the grid off it.")
    left = np.flatnonzero(np.sign(values[:-1]) * np.sign(values[1:]) < 0)
    inside, residual = _refine(f, grid[left], grid[left + 1], values[left], values[left + 1])
    is_root = np.abs(residual) <= np.maximum(np.abs(values[left]), np.abs(values[left + 1]))
    return np.sort(np.concatenate([grid[values == 0], inside[is_root]]))


def roots_in_brackets(f: Callable[[Floats], ArrayLike], a: Floats, b: Floats, fa: Floats, fb: Floats) -> Floats:
    """The root of f in each bracket [a, b], where f has the values fa and fb; nan where these do not differ in sign, and at a pole.

    All of one shape; f is elementwise: every bracket may have a function of its own.  Each root is refined to a few units in the last
    place.
    """
    bracketed = np.sign(fa) * np.sign(fb) < 0
    b, fb = np.where(bracketed, b, a), np.where(bracketed, fb, fa)  # an empty bracket is done at once
    root, residual = _refine(f, a, b, fa, fb)
    return np.where(bracketed & (np.abs(residual) <= np.maximum(np.abs(fa), np.abs(fb))), root, np.nan)


def _refine(f, a, b, fa, fb, steps=200):
    """Root and residual in each bracket [a, b], all at once.

    Inverse quadratic interpolation where Chandrupatla's test finds the three points fit for it, bisection elsewhere
    (Chandrupatla, Adv. Eng. Software 28, 1997; recalled).  a is the latest point, b closes the bracket, c is the one before.
    """
    tolerance = 2 * np.finfo(float).eps * np.maximum(np.abs(a), np.abs(b)) + np.finfo(float).tiny
    c, fc, t = b, fb, np.full_like(a, 0.5)
    for _ in range(steps):
        done = (fa == 0) | (fb == 0) | (np.abs(b - a) <= tolerance)
        if np.all(done):
            break
        x = np.where(done, a, a + t * (b - a))
        fx = np.where(done, fa, _values(f, x))
        same = done | (np.sign(fx) == np.sign(fa))
        c, fc = np.where(same, a, b), np.where(same, fa, fb)
        b, fb = np.where(same, b, a), np.where(same, fb, fa)
        a, fa = x, fx
        t = _next_fraction(a, b, c, fa, fb, fc, tolerance)
    nearer_b = np.less(np.abs(fb), np.abs(fa))
    return np.where(nearer_b, b, a), np.where(nearer_b, fb, fa)


def _next_fraction(a, b, c, fa, fb, fc, tolerance):
    """Where in [a, b], as a fraction, to look next."""
    with np.errstate(all="ignore"):  # finished brackets divide by zero; their fraction is not used
        xi, phi = (a - b) / (c - b), (fa - fb) / (fc - fb)
        fit = (phi**2 < xi) & ((1 - phi) ** 2 < 1 - xi)
        t = fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
        least = np.minimum(0.5 * tolerance / np.abs(b - a), 0.5)
    return np.clip(np.where(fit & np.isfinite(t), t, 0.5), least, 1 - least)


def newton(
    f_and_jacobian: Callable[[Floats], tuple[Floats, Floats]],
    x0: ArrayLike,
    scale: ArrayLike = 1.0,
    tolerance: float = 1e-12,
    max_steps: int = 50,
) -> Floats:
    """Solve f(x) = 0 for a small system by damped Newton steps; returns x.

    f_and_jacobian(x) -> f (n,), J (n, n).  `scale` is the typical size of each unknown; the iteration ends when every step is
    below tolerance * max(|x|, scale).  A step is halved until the next simplified step J^-1 f(x + step) is shorter: a test
    that no unit of f can change (Deuflhard's natural monotonicity test, recalled).
    Raises SolverError with the last x as `partial`.
    """
    x = np.array(x0, dtype=float)
    f, jacobian = f_and_jacobian(x)
    size = np.inf
    for count in range(max_steps):
        step = _solve(jacobian, f, x, count)
        size = np.max(np.abs(step) / np.maximum(np.abs(x), scale))
        if size <= tolerance:
            return x + step
        x, f, jacobian = _damped(f_and_jacobian, x, step, jacobian, scale, count)
    raise SolverError(
        f"newton: no solution after {max_steps} steps; the last step was {size:.1e} of the unknowns' size, the largest residual "
        f"{np.max(np.abs(f)):.1e}. Start nearer to the solution or raise max_steps.",
        partial=x,
    )


def _damped(f_and_jacobian, x, step, jacobian, scale, count):
    """The first of x + step, x + step/2, ... whose simplified step is shorter, with f and J there."""
    weight = 1.0 / np.maximum(np.abs(x), scale)
    length = np.linalg.norm(step * weight)
    for damping in 0.5 ** np.arange(20):
        trial = x + damping * step
        f, next_jacobian = f_and_jacobian(trial)
        if np.all(np.isfinite(f)) and np.linalg.norm(_solve(jacobian, f, x, count) * weight) <= (1 - 0.25 * damping) * length:
            return trial, f, next_jacobian
    raise SolverError(
        f"newton: stuck at step {count + 1}: no part of a step of length {length:.1e} (in units of the unknowns' size) brings f "
        "nearer to zero. There may be no solution near the start; start elsewhere.",
        partial=x,
    )


def _solve(jacobian, f, x, count):
    try:
        return -np.linalg.solve(jacobian, f)
    except np.linalg.LinAlgError:
        raise SolverError(
            f"newton: the Jacobian is singular at step {count + 1}. Start elsewhere, or look for unknowns that f does not depend on.",
            partial=x,
        ) from None


def extremes(f: Callable[[Floats], ArrayLike], a: float, b: float, samples: int = 721) -> tuple[float, float, float, float]:
    """Global least and greatest value of a smooth f on [a, b]: (argmin, min, argmax, max), floats.

    `samples` equidistant values must show every hill; the best eight local candidates are then refined together.
    The value is exact to rounding, its place to about 1e-8 of (b - a), as the value itself is flat there.
    Extremes at an end are found exactly; of equal values the first is returned, so a constant gives a.
    """
    x = np.linspace(a, b, samples)
    lowest = _least(f, x)
    place, value = _least(lambda x: -_values(f, x), x)
    return *lowest, place, -value


def _least(f, x):
    values = _values(f, x)
    if not np.all(np.isfinite(values)):
        raise InputError(f"extremes: f is not finite at {x[~np.isfinite(values)][0]:.6g}. Shorten the interval to where f exists.")
    inner = np.flatnonzero((values[1:-1] <= values[:-2]) & (values[1:-1] <= values[2:])) + 1
    best = inner[np.argsort(values[inner], kind="stable")[:8]]
    refined = _zoom(f, x[best - 1], x[best + 1])
    x, values = np.append(x, refined), np.append(values, _values(f, refined))
    least = np.argmin(values)
    return float(x[least]), float(values[least])


def _zoom(f, a, b, points=33, passes=6):
    """The least point of each interval [a, b] in which f has one valley: sample, keep the neighbourhood of the best, repeat.

    Each pass narrows by half the number of points, so few calls of f, each on many places, reach the limit set by rounding.
    """
    share = np.linspace(0.0, 1.0, points)[:, None]
    for _ in range(passes):
        x = a + share * (b - a)
        best = np.argmin(_values(f, x.ravel()).reshape(x.shape), axis=0)
        rows = np.arange(x.shape[1])
        a, b = x[np.maximum(best - 1, 0), rows], x[np.minimum(best + 1, points - 1), rows]
    return 0.5 * (a + b)


def _values(f, x):
    """f(x) as floats of x's shape, also when f forgot to depend on x."""
    return np.broadcast_to(np.asarray(f(x), dtype=float), x.shape)
