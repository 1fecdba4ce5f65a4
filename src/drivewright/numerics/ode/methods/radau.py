"""Radau IIA of order 5 (three stages, L-stable): implicit, for stiff systems.

The stages solve Z = h A f(y + Z) by simplified Newton steps.  In the eigenvectors of 1/A these fall apart into one real and one
complex linear system of the size of y, whose factors serve as long as convergence is good.  The polynomial through the stages is
the dense output, and the error that is kept below the tolerance is its own, of order 3; the ends of the steps are far better.

Hairer & Wanner, Solving Ordinary Differential Equations II (code RADAU5); recalled.  The tableau and all that follows from it are
computed from their conditions below.
"""

from typing import NamedTuple

import numpy as np

from drivewright._jit import by_reference, implements, inner
from drivewright._typing import Complexes, Floats, Ints
from drivewright.numerics.ode.dense_output import component
from drivewright.numerics.ode.method import ERROR, STEP, TIME, Method, Tableau, begin, carry_over, first_step, interpolate, restart, step
from drivewright.numerics.ode.system import jacobian, rate_at

_EPS = np.finfo(float).eps
_C = np.array([0.4 - np.sqrt(0.06), 0.4 + np.sqrt(0.06), 1.0])
_POWERS = _C[:, None] ** np.arange(3)
_A = (_POWERS * _C[:, None] / [1, 2, 3]) @ np.linalg.inv(_POWERS)  # collocation: exact for powers of t up to 2
_INVERSE = np.linalg.inv(_A)


def _eigen():
    """Real and complex eigenvalue of 1/A, and real T with T^-1 (1/A) T block diagonal; its last row is 1 1 0."""
    values, vectors = np.linalg.eig(_INVERSE)
    vectors = vectors / vectors[2]
    real, pair = np.argmin(np.abs(np.imag(values))), np.argmax(np.imag(values))
    t = np.stack([np.real(vectors[:, real]), np.real(vectors[:, pair]), -np.imag(vectors[:, pair])], axis=1)
    return float(values[real].real), complex(values[pair]), t


_REAL, _COMPLEX, _T = _eigen()
_T_INVERSE = np.linalg.inv(_T)
# Stages and f(y) at the start in one quadrature of order 3, minus the result; times the real eigenvalue.
_ERROR = -np.linalg.solve(_POWERS.T, [1, 0, 0])[None] @ _INVERSE
_HIGHER = np.linalg.inv(_POWERS * _C[:, None])[1:]  # coefficients of the powers 2 and 3 of the polynomial through 0 and the stages

_MAX_ITERATIONS = 7
_MIN_GROWTH, _MAX_GROWTH = 0.2, 8.0
_GOOD = 1e-3  # contraction of Newton's method below which the Jacobian serves again

# What is known from the steps before: when the factors were made, whether the Jacobian serves, how Newton's method converges.
FACTORED_STEP, JACOBIAN, CONTRACTION, REMAINDER, OLD_STEP, OLD_ERROR = range(6)
MISSING, FRESH, OLD = range(3)  # the Jacobian


@by_reference
class RadauIIA(NamedTuple):
    """Workspace, n the size of y: what is carried from step to step, and scratch for one."""

    history: Floats  # (6,) see above
    f: Floats  # (n,) rate at the start of the step
    J: Floats  # (n, n)
    real: Floats  # (n, n) factors of the two linear systems
    complex: Complexes
    real_pivots: Ints  # (n,)
    complex_pivots: Ints
    real_rest: Floats  # (n,) right-hand side, then solution
    complex_rest: Complexes
    scale: Floats  # (n,) tolerance of y
    z: Floats  # (3, n) stages minus y
    w: Floats  # (3, n) the same in eigenvectors
    rates: Floats  # (3, n) at the stages
    dense: Floats  # (5, n) polynomial of the last step


def _workspace(n):
    return RadauIIA(
        history=np.array([0.0, MISSING, 0.0, 1.0, 0.0, 0.0]),
        f=np.zeros(n),
        J=np.zeros((n, n)),
        real=np.zeros((n, n)),
        complex=np.zeros((n, n), dtype=complex),
        real_pivots=np.zeros(n, dtype=int),
        complex_pivots=np.zeros(n, dtype=int),
        real_rest=np.zeros(n),
        complex_rest=np.zeros(n, dtype=complex),
        scale=np.zeros(n),
        z=np.zeros((3, n)),
        w=np.zeros((3, n)),
        rates=np.zeros((3, n)),
        dense=np.zeros((5, n)),
    )


METHOD = Method(
    name="radau",
    order=5,
    dense_order=3,
    tableau=Tableau(_A, _A[2], _C),
    citation="Hairer & Wanner, Solving Ordinary Differential Equations II",
    workspace=_workspace,
    needs_jacobian=True,
)


@implements(begin, RadauIIA)
def _(work, system, control, clock, y):
    rate_at(system, clock[TIME], y, work.f)
    first_step(work.f, control, clock, y)


@implements(restart, RadauIIA)
def _(work, system, control, clock, y):
    rate_at(system, clock[TIME], y, work.f)
    work.history[JACOBIAN], work.history[OLD_STEP] = MISSING, 0.0


@implements(step, RadauIIA)
def _(work, system, control, clock, t, h, again, y, trial):
    return _try_step(work, system, control, clock, t, h, again, y, trial)


@implements(interpolate, RadauIIA)
def _(work, h, y, trial, dense):
    _interpolant(y, work, dense)


@implements(carry_over, RadauIIA)
def _(work, system, t, y, is_good):
    rate_at(system, t, y, work.f)


@inner
def _try_step(work, system, control, clock, t, h, again, y, trial):
    """`step`: Newton's method, once more with a new Jacobian where it fails with an old one; then the error and the next step.

    y, trial (n,); clock as for `step`.
    """
    iterations = _newton(work, system, control, t, h, y, trial)
    if iterations == 0 and work.history[JACOBIAN] == OLD:
        work.history[JACOBIAN] = MISSING
        iterations = _newton(work, system, control, t, h, y, trial)
    error = np.nan
    if iterations > 0:
        error = _error(work, system, control, t, h, y, trial, again or work.history[OLD_STEP] == 0.0)
    clock[STEP] = h * _growth(error, iterations, h, again, clock, work.history)
    return error <= 1.0  # nan is no success


@inner
def _prepare(work, system, control, t, h, y):
    """The tolerance of y; the Jacobian where it is missing, and the factors where they belong to another one or another step. y (n,)."""
    n = y.size
    for i in range(n):
        work.scale[i] = control.atol[i] + control.rtol * abs(y[i])
    if work.history[JACOBIAN] == MISSING:
        for i in range(n):
            for j in range(n):
                work.J[i, j] = 0.0
        jacobian(system, t, y, work.J)
        work.history[JACOBIAN], work.history[FACTORED_STEP] = FRESH, 0.0
    if work.history[FACTORED_STEP] != h:
        for i in range(n):
            for j in range(n):
                work.real[i, j] = work.complex[i, j] = -work.J[i, j]
            work.real[i, i] += _REAL / h
            work.complex[i, i] += _COMPLEX / h
        _factor(work.real, work.real_pivots)
        _factor(work.complex, work.complex_pivots)
        work.history[FACTORED_STEP] = h


@inner
def _newton(work, system, control, t, h, y, trial):
    """Solve for the stages; the number of iterations, 0 where they do not converge, -1 where the rate is not finite. y, trial (n,)."""
    target = max(10 * _EPS / control.rtol, min(0.03, np.sqrt(control.rtol)))
    remainder = max(work.history[REMAINDER], _EPS) ** 0.8  # what is still to come over the last change: first by what it was before
    contraction, before = _GOOD, 0.0
    _prepare(work, system, control, t, h, y)
    _predict(work, h, y)
    for iteration in range(1, _MAX_ITERATIONS + 1):
        change = _improve(work, system, t, h, y, trial)
        if not np.isfinite(change):
            return -1
        if iteration > 1:
            contraction = change / before
            if contraction >= 0.99:
                return 0
            remainder = contraction / (1.0 - contraction)
            if remainder * change * contraction ** (_MAX_ITERATIONS - iteration) > target:
                return 0
        if remainder * change <= target:
            work.history[CONTRACTION], work.history[REMAINDER] = contraction, remainder
            return iteration
        before = max(change, 1e-300)
    return 0


@inner
def _predict(work, h, y):
    """First guess of the stages: the last step's polynomial, continued. y (n,)."""
    for i in range(y.size):
        for stage in range(3):
            work.z[stage, i] = 0.0
            if work.history[OLD_STEP] > 0.0:
                work.z[stage, i] = component(work.dense, i, 1.0 + _C[stage] * h / work.history[OLD_STEP]) - y[i]
        for row in range(3):
            work.w[row, i] = _sum(_T_INVERSE, row, work.z, i)


@inner
def _improve(work, system, t, h, y, trial):
    """One iteration on the stages; returns the change over the tolerance, root mean square. y, trial (n,)."""
    for stage in range(3):
        for i in range(y.size):
            trial[i] = y[i] + work.z[stage, i]
        rate_at(system, t + _C[stage] * h, trial, work.rates[stage])
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
    """One row of the matrix times component i of the three stages. matrix (3, 3), stages (3, n)."""
    return matrix[row, 0] * stages[0, i] + matrix[row, 1] * stages[1, i] + matrix[row, 2] * stages[2, i]


@inner
def _error(work, system, control, t, h, y, trial, doubtful):
    """Root mean square of the estimated error over its tolerance; the result of the step in `trial`.

    h f - h P'(0), P being the polynomial, damped by (1 - h J / eigenvalue)^-1 as the method itself damps.  In a doubtful step, where
    the start may lie off the slow motion, this is done twice.
    """
    error = _filtered(work, control, h, y, work.f)
    if doubtful and error > 1.0:
        for i in range(y.size):
            trial[i] = y[i] + work.real_rest[i]
        rate_at(system, t, trial, work.rates[0])
        error = _filtered(work, control, h, y, work.rates[0])
    for i in range(y.size):
        trial[i] = y[i] + work.z[2, i]
    return error


@inner
def _filtered(work, control, h, y, f):
    """Root mean square of h f - h P'(0) (n,), damped, over its tolerance; what is damped stays in `real_rest`."""
    for i in range(y.size):
        work.real_rest[i] = f[i] + _sum(_ERROR, 0, work.z, i) / h
    _solve(work.real, work.real_pivots, work.real_rest)
    total = 0.0
    for i in range(y.size):
        tolerance = control.atol[i] + control.rtol * max(abs(y[i]), abs(y[i] + work.z[2, i]))
        total += (work.real_rest[i] / tolerance) ** 2
    return np.sqrt(total / y.size)


@inner
def _growth(error, iterations, h, again, clock, history):
    """Factor on the step, by the error and its trend (Gustafsson's prediction); decides what serves again."""
    if not np.isfinite(error):
        clock[ERROR] = np.nan if iterations != 0 else 1.0
        return 0.1 if iterations != 0 else 0.5
    clock[ERROR] = error
    safety = 0.9 * (2 * _MAX_ITERATIONS + 1) / (2 * _MAX_ITERATIONS + iterations)
    growth = safety * max(error, 1e-8) ** -0.25
    if error > 1.0:
        return max(_MIN_GROWTH, growth)
    if history[OLD_STEP] > 0.0:
        growth = min(growth, 0.9 * h / history[OLD_STEP] * (history[OLD_ERROR] / max(error, 1e-8) ** 2) ** 0.25)
    history[OLD_STEP], history[OLD_ERROR] = h, max(error, 0.01)
    history[JACOBIAN] = OLD if history[CONTRACTION] <= _GOOD else MISSING
    growth = min(max(growth, _MIN_GROWTH), 1.0 if again else _MAX_GROWTH)
    return 1.0 if history[JACOBIAN] == OLD and 1.0 <= growth <= 1.2 else growth  # for the factors to serve again


@inner
def _interpolant(y, work, dense):
    """Coefficients of the polynomial of degree 3 through y and the stages. y (n,), dense (5, n), written."""
    for i in range(y.size):
        square, cube = _sum(_HIGHER, 0, work.z, i), _sum(_HIGHER, 1, work.z, i)
        dense[0, i] = y[i]
        dense[1, i] = work.z[2, i]
        dense[2, i] = -square - cube
        dense[3, i] = -cube
        dense[4, i] = 0.0
        for k in range(5):
            work.dense[k, i] = dense[k, i]


@inner
def _factor(a, pivots):
    """LU factors of `a` in its place, rows exchanged, the diagonal of U inverted; for real and complex numbers.

    Rows are exchanged to the right of the column alone, as `_solve` meets the exchanges one by one.

    a (n, n), pivots (n,), written.
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


@inner
def _solve(a, pivots, b):
    """Solve in place of b with the factors. a (n, n), pivots (n,), b (n,)."""
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
