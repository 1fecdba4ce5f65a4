"""Stiff initial value problems: Radau IIA of order 5 (three stages, L-stable), for the systems of `numerics.ode`.

The stages solve Z = h A f(y + Z) by simplified Newton steps.  In the eigenvectors of 1/A these fall apart into one real and one
complex linear system of the size of y, whose factors serve as long as convergence is good.  The polynomial through the stages is
the dense output.

Hairer & Wanner, Solving Ordinary Differential Equations II (code RADAU5); recalled.  The tableau and all that follows from it are
computed from their conditions below.
"""

from typing import Any, NamedTuple

import numpy as np

from drivewright._jit import generic, implements, inner, outer, plain
from drivewright.numerics import ode
from drivewright.numerics.dopri5 import (
    EVENT,
    FINISHED,
    GOES_ON,
    MIN_STEP,
    NOT_FINITE,
    Batch,
    Settings,
    Unwatched,
    _copy,
    _go_back,
    _happen,
    _point,
    _watch,
    begin,
    events_at,
    rate,
    rate_at,
    refresh,
)

_EPS = np.finfo(float).eps
_C = np.array([0.4 - np.sqrt(0.06), 0.4 + np.sqrt(0.06), 1.0])
_POWERS = _C[:, None] ** np.arange(3)
_A = (_POWERS * _C[:, None] / [1, 2, 3]) @ np.linalg.inv(_POWERS)  # collocation: exact for powers of t up to 2
_INVERSE = np.linalg.inv(_A)


def _eigen():
    """Real and complex eigenvalue of 1/A, and real T with T^-1 (1/A) T block diagonal; its last row is 1 1 0."""
    values, vectors = np.linalg.eig(_INVERSE)
    vectors = vectors / vectors[2]
    real, pair = np.argmin(np.abs(values.imag)), np.argmax(values.imag)
    t = np.stack([vectors[:, real].real, vectors[:, pair].real, -vectors[:, pair].imag], axis=1)
    return float(values[real].real), complex(values[pair]), t


_REAL, _COMPLEX, _T = _eigen()
_T_INVERSE = np.linalg.inv(_T)
# Stages and f(y) at the start in one quadrature of order 3, minus the result; times the real eigenvalue.
_ERROR = -np.linalg.solve(_POWERS.T, [1, 0, 0])[None] @ _INVERSE
_BEND = np.linalg.inv(_POWERS * _C[:, None])[1:]  # coefficients of the powers 2 and 3 of the polynomial through 0 and the stages

_MOST_ITERATIONS = 7
_LEAST_GROWTH, _MOST_GROWTH = 0.2, 8.0
_GOOD = 1e-3  # contraction of Newton's method below which the Jacobian serves again

# The clock: as in `dopri5` the time, the next step and the last error, then what decides about the Jacobian and the next step.
T, STEP, ERROR, FACTORED_STEP, JACOBIAN, CONTRACTION, REMAINDER, OLD_STEP, OLD_ERROR = range(9)
MISSING, FRESH, OLD = range(3)  # the Jacobian


@generic
def jacobian(system, t, y, J):
    """Write the derivative of rate i by y[j] at (t, y) into J[i, j], which arrives as zeros.

    A system need not state it: `integrate_stiff` then lets `Differenced` stand for the system.
    """


class Differenced(NamedTuple):
    """A system whose Jacobian is taken by differences of its rate: over the part `share` of (|y| + least)."""

    system: Any
    share: float
    least: np.ndarray
    scratch: np.ndarray  # (3, n)


@implements(rate, Differenced)
def _(system, t, y, dy):
    rate(system.system, t, y, dy)


@implements(jacobian, Differenced)
def _(system, t, y, J):
    nudged, base, changed = system.scratch[0], system.scratch[1], system.scratch[2]
    _copy(y, nudged)
    rate(system.system, t, y, base)
    for j in range(y.size):
        nudge = system.share * (abs(y[j]) + system.least[j])
        nudged[j] = y[j] + (nudge if base[j] >= 0.0 else -nudge)  # to the side where the next stages are
        rate(system.system, t, nudged, changed)
        for i in range(y.size):
            J[i, j] = (changed[i] - base[i]) / (nudged[j] - y[j])
        nudged[j] = y[j]


def _sloped(system, settings):
    """The system, or what can differentiate it.

    y is moved by its tolerance, and no more than a billionth: so little that nothing which the run resolves bends over it, be it a
    play of a micrometre after a hundred turns, and far above rounding.  Newton's method wants no more than three digits.
    """
    if type(system) in jacobian.formulas:
        return system
    return Differenced(system, min(max(settings.rtol, 1e-11), 1e-9), settings.atol / settings.rtol, np.empty((3, settings.atol.size)))


class Work(NamedTuple):
    """What is carried from step to step beside the clock, and room for a step; n is the size of y."""

    f: np.ndarray  # (1, n) rate at the start of the step
    J: np.ndarray  # (n, n)
    real: np.ndarray  # (n, n) factors of the two linear systems
    complex: np.ndarray
    real_pivots: np.ndarray
    complex_pivots: np.ndarray
    real_rest: np.ndarray  # (n,) right-hand side, then solution
    complex_rest: np.ndarray
    scale: np.ndarray  # (n,) tolerance of y
    z: np.ndarray  # (3, n) stages minus y
    w: np.ndarray  # (3, n) the same in eigenvectors
    rates: np.ndarray  # (3, n) at the stages
    dense: np.ndarray  # (5, n) polynomial of the last step
    trial: np.ndarray


def _work(n):
    def room(*shape, kind=float):
        return np.zeros((*shape, n), dtype=kind)

    return Work(
        f=room(1),
        J=room(n),
        real=room(n),
        complex=room(n, kind=complex),
        real_pivots=room(kind=int),
        complex_pivots=room(kind=int),
        real_rest=room(),
        complex_rest=room(kind=complex),
        scale=room(),
        z=room(3),
        w=room(3),
        rates=room(3),
        dense=room(5),
        trial=room(),
    )


def integrate_stiff(
    system,
    t0,
    t1,
    y0,
    rtol=1e-8,
    atol=1e-10,
    *,
    samples=None,
    watch=(),
    per_step=1,
    max_steps=100_000,
    max_step=np.inf,
    min_step=0.0,
    first_step=None,
):
    """`ode.integrate` for stiff systems: the same arguments and the same Trajectory, by an implicit method.

    The error that is kept below the tolerance is that of the dense output, of order 3; the ends of the steps, of order 5, are far
    better.  A system may state its `jacobian`; otherwise it is taken by differences of its rate.
    """
    y = np.array(y0, dtype=float)
    samples = None if samples is None else np.asarray(samples, dtype=float)
    ode._check(system, t0, t1, y, samples, watch, rtol, atol)
    start, go_on = (plain(begin), plain(advance)) if isinstance(system, ode.Functions) else (begin, advance)
    watched = system if watch else Unwatched(0)
    switched = system if any(event.switches for event in watch) else Unwatched(0)
    settings = Settings(
        float(t1),
        float(rtol),
        np.broadcast_to(np.asarray(atol, dtype=float), y.shape).copy(),
        float(max_step),
        max(min_step, 16 * _EPS * max(abs(t0), abs(t1))),
    )
    what = ode._watched(watch)
    clock, work, values = np.array([t0, 0.0, 1e-4, 0, MISSING, 0, 1.0, 0, 0]), _work(y.size), np.empty(len(watch))
    code = start(system, watched, settings, clock, y, work.f, values)
    clock[STEP] = first_step or clock[STEP]
    sloped, scratch = _sloped(system, settings), (np.empty(y.size), *np.empty((3, len(watch))))
    parts, crossings, steps, rejected = [], [], 0, 0
    while code == GOES_ON and steps < max_steps:
        size = min(ode._BATCH, max_steps - steps)
        batch = Batch(
            np.empty((size, 2)),
            np.empty((size, 5, y.size)),
            np.empty((2 * size * len(watch), 3)),
            np.empty((2 * size * len(watch), y.size)),
            *scratch,
        )
        code, done, refused, hits = go_on(sloped, watched, switched, settings, what, clock, y, work, values, batch)
        crossings.append(ode._crossings(batch, hits))
        picked = ode._pick(batch, done, clock[T], per_step) if samples is None else ode._sample(batch, done, samples, clock[T])
        parts.append(picked)
        steps, rejected = steps + done, rejected + refused
    return ode._trajectory(t0, np.array(y0, dtype=float), parts, samples, clock[T], y, crossings, code, settings, steps, rejected)


@outer
def advance(system, watched, switched, settings, watch, clock, y, work, values, batch):
    """As `dopri5.advance`: step until the batch is full or the run ends; (code, accepted steps, rejected steps, event hits)."""
    accepted = rejected = hits = 0
    again = rejected > 0  # False, but not as a constant, for which numba would compile `_succeeds` once more
    while accepted < len(batch.steps):
        t, h = clock[T], min(clock[STEP], settings.max_step)
        last = t + 1.000001 * h >= settings.t1  # no tiny step is left over
        if last:
            h = settings.t1 - t
        elif h < settings.min_step:
            return (MIN_STEP if np.isfinite(clock[ERROR]) else NOT_FINITE), accepted, rejected, hits
        again = not _succeeds(system, t, h, again, y, work, settings, clock)
        if again:
            rejected += 1
            continue
        _interpolant(y, work, batch.dense[accepted])
        batch.steps[accepted, 0], batch.steps[accepted, 1] = t, h
        clock[T] = settings.t1 if last else t + h
        _copy(work.trial, y)
        rate_at(system, clock[T], y, work.f[0])
        events_at(watched, clock[T], y, batch.after)
        known = hits
        hits, ender = _watch(watched, watch, values, batch.after, batch.trial, accepted, batch, hits)
        _copy(batch.after, values)
        accepted += 1
        if ender >= 0:
            _go_back(clock, y, batch, ender)
            if _happen(switched, watch, clock[T], y, batch, known, hits, ender):
                return EVENT, accepted, rejected, hits
            refresh(system, watched, clock, y, work.f, values)
            clock[JACOBIAN], clock[OLD_STEP] = MISSING, 0.0
        if clock[T] >= settings.t1:
            return FINISHED, accepted, rejected, hits
    return GOES_ON, accepted, rejected, hits


@outer
def _succeeds(system, t, h, again, y, work, settings, clock):
    """Try the step: its result in `trial`, the size of the next one in the clock."""
    iterations = _newton(system, t, h, y, work, settings, clock)
    if iterations == 0 and clock[JACOBIAN] == OLD:
        clock[JACOBIAN] = MISSING
        iterations = _newton(system, t, h, y, work, settings, clock)
    error = np.nan
    if iterations > 0:
        error = _error(system, t, h, y, work, settings, again or clock[OLD_STEP] == 0.0)
    clock[STEP] = h * _growth(error, iterations, h, again, clock)
    return error <= 1.0  # nan is no success


@outer
def _prepare(system, t, h, y, work, settings, clock):
    """The tolerance of y; the Jacobian where it is missing, and the factors where they belong to another one or another step."""
    n = y.size
    for i in range(n):
        work.scale[i] = settings.atol[i] + settings.rtol * abs(y[i])
    if clock[JACOBIAN] == MISSING:
        for i in range(n):
            for j in range(n):
                work.J[i, j] = 0.0
        jacobian(system, t, y, work.J)
        clock[JACOBIAN], clock[FACTORED_STEP] = FRESH, 0.0
    if clock[FACTORED_STEP] != h:
        for i in range(n):
            for j in range(n):
                work.real[i, j] = work.complex[i, j] = -work.J[i, j]
            work.real[i, i] += _REAL / h
            work.complex[i, i] += _COMPLEX / h
        _factor(work.real, work.real_pivots)
        _factor(work.complex, work.complex_pivots)
        clock[FACTORED_STEP] = h


@outer
def _newton(system, t, h, y, work, settings, clock):
    """Solve for the stages; the number of iterations, 0 where they do not converge, -1 where the rate is not finite."""
    target = max(10 * _EPS / settings.rtol, min(0.03, np.sqrt(settings.rtol)))
    remainder = max(clock[REMAINDER], _EPS) ** 0.8  # what is still to come over the last change: first by what it was before
    contraction, before = _GOOD, 0.0
    _prepare(system, t, h, y, work, settings, clock)
    _predict(h, y, work, clock)
    for iteration in range(1, _MOST_ITERATIONS + 1):
        change = _improve(system, t, h, y, work)
        if not np.isfinite(change):
            return -1
        if iteration > 1:
            contraction = change / before
            if contraction >= 0.99:
                return 0
            remainder = contraction / (1.0 - contraction)
            if remainder * change * contraction ** (_MOST_ITERATIONS - iteration) > target:
                return 0
        if remainder * change <= target:
            clock[CONTRACTION], clock[REMAINDER] = contraction, remainder
            return iteration
        before = max(change, 1e-300)
    return 0


@inner
def _predict(h, y, work, clock):
    """First guess of the stages: the last step's polynomial, continued."""
    for i in range(y.size):
        for stage in range(3):
            work.z[stage, i] = 0.0
            if clock[OLD_STEP] > 0.0:
                work.z[stage, i] = _point(work.dense, i, 1.0 + _C[stage] * h / clock[OLD_STEP]) - y[i]
        for row in range(3):
            work.w[row, i] = _sum(_T_INVERSE, row, work.z, i)


@inner
def _improve(system, t, h, y, work):
    """One iteration on the stages; returns the change over the tolerance, root mean square."""
    for stage in range(3):
        for i in range(y.size):
            work.trial[i] = y[i] + work.z[stage, i]
        rate_at(system, t + _C[stage] * h, work.trial, work.rates[stage])
    for i in range(y.size):
        along = complex(_sum(_T_INVERSE, 1, work.rates, i), _sum(_T_INVERSE, 2, work.rates, i))
        work.real_rest[i] = _sum(_T_INVERSE, 0, work.rates, i) - _REAL / h * work.w[0, i]
        work.complex_rest[i] = along - _COMPLEX / h * complex(work.w[1, i], work.w[2, i])
    _solve(work.real, work.real_pivots, work.real_rest)
    _solve(work.complex, work.complex_pivots, work.complex_rest)
    total = 0.0
    for i in range(y.size):
        change = work.real_rest[i], work.complex_rest[i].real, work.complex_rest[i].imag
        for row in range(3):
            work.w[row, i] += change[row]
            total += (change[row] / work.scale[i]) ** 2
        for stage in range(3):
            work.z[stage, i] = _sum(_T, stage, work.w, i)
    return np.sqrt(total / (3 * y.size))


@inner
def _sum(matrix, row, stages, i):
    """One row of the matrix times component i of the three stages."""
    return matrix[row, 0] * stages[0, i] + matrix[row, 1] * stages[1, i] + matrix[row, 2] * stages[2, i]


@inner
def _error(system, t, h, y, work, settings, doubtful):
    """Root mean square of the estimated error over its tolerance; the result of the step in `trial`.

    h f - h P'(0), P being the polynomial, damped by (1 - h J / eigenvalue)^-1 as the method itself damps.  In a doubtful step, where
    the start may lie off the slow motion, this is done twice.
    """
    error = _filtered(h, y, work, work.f[0], settings)
    if doubtful and error > 1.0:
        for i in range(y.size):
            work.trial[i] = y[i] + work.real_rest[i]
        rate_at(system, t, work.trial, work.rates[0])
        error = _filtered(h, y, work, work.rates[0], settings)
    for i in range(y.size):
        work.trial[i] = y[i] + work.z[2, i]
    return error


@inner
def _filtered(h, y, work, f, settings):
    for i in range(y.size):
        work.real_rest[i] = f[i] + _sum(_ERROR, 0, work.z, i) / h
    _solve(work.real, work.real_pivots, work.real_rest)
    total = 0.0
    for i in range(y.size):
        tolerance = settings.atol[i] + settings.rtol * max(abs(y[i]), abs(y[i] + work.z[2, i]))
        total += (work.real_rest[i] / tolerance) ** 2
    return np.sqrt(total / y.size)


@inner
def _growth(error, iterations, h, again, clock):
    """Factor on the step, by the error and its trend (Gustafsson's prediction); decides what serves again."""
    if not np.isfinite(error):
        clock[ERROR] = np.nan if iterations != 0 else 1.0
        return 0.1 if iterations != 0 else 0.5
    clock[ERROR] = error
    safety = 0.9 * (2 * _MOST_ITERATIONS + 1) / (2 * _MOST_ITERATIONS + iterations)
    growth = safety * max(error, 1e-8) ** -0.25
    if error > 1.0:
        return max(_LEAST_GROWTH, growth)
    if clock[OLD_STEP] > 0.0:
        growth = min(growth, 0.9 * h / clock[OLD_STEP] * (clock[OLD_ERROR] / max(error, 1e-8) ** 2) ** 0.25)
    clock[OLD_STEP], clock[OLD_ERROR] = h, max(error, 0.01)
    clock[JACOBIAN] = OLD if clock[CONTRACTION] <= _GOOD else MISSING
    growth = min(max(growth, _LEAST_GROWTH), 1.0 if again else _MOST_GROWTH)
    return 1.0 if clock[JACOBIAN] == OLD and 1.0 <= growth <= 1.2 else growth  # for the factors to serve again


@inner
def _interpolant(y, work, dense):
    """Coefficients, as `dopri5` has them, of the polynomial of degree 3 through y and the stages."""
    for i in range(y.size):
        square, cube = _sum(_BEND, 0, work.z, i), _sum(_BEND, 1, work.z, i)
        dense[0, i] = y[i]
        dense[1, i] = work.z[2, i]
        dense[2, i] = -square - cube
        dense[3, i] = -cube
        dense[4, i] = 0.0
        for k in range(5):
            work.dense[k, i] = dense[k, i]


@outer
def _factor(a, pivots):
    """LU factors of `a` in its place, rows exchanged, the diagonal of U inverted; for real and complex numbers.

    Rows are exchanged to the right of the column alone, as `_solve` meets the exchanges one by one.
    """
    n = len(a)
    for k in range(n):
        p = k
        for i in range(k + 1, n):
            if abs(a[i, k]) > abs(a[p, k]):
                p = i
        pivots[k] = p
        for j in range(k, n):
            a[k, j], a[p, j] = a[p, j], a[k, j]
        a[k, k] = 1.0 / a[k, k] if a[k, k] != 0.0 else np.nan  # a singular system: the step is refused
        for i in range(k + 1, n):
            a[i, k] *= a[k, k]
            for j in range(k + 1, n):
                a[i, j] -= a[i, k] * a[k, j]


@outer
def _solve(a, pivots, b):
    """Solve in place of b with the factors."""
    n = len(a)
    for k in range(n):
        p = pivots[k]
        b[k], b[p] = b[p], b[k]
        for i in range(k + 1, n):
            b[i] -= a[i, k] * b[k]
    for k in range(n - 1, -1, -1):
        for j in range(k + 1, n):
            b[k] -= a[k, j] * b[j]
        b[k] *= a[k, k]
