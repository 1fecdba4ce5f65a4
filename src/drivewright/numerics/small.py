"""Kernels for small dense systems of equations, where a call of LAPACK would cost more than the work."""

import numpy as np

from drivewright._jit import inner
from drivewright._typing import Floats, Ints
from drivewright.numerics.lanes import any_lane, where

SINGULAR = 1e-13  # a pivot below this part of the matrix' largest entry


@inner
def lu_factor(a: Floats, pivots: Floats | Ints) -> bool:
    """Overwrite the square matrix a (n, n) with L and U, rows exchanged as `pivots` (n,) says; False where it is singular."""
    n, largest = a.shape[0], 0.0
    for i in range(n):
        for j in range(n):
            largest = max(largest, abs(a[i, j]))
    regular = largest >= 0.0
    for k in range(n):
        best, size = 1.0 * k, abs(a[k, k])
        for i in range(k + 1, n):
            best, size = where(abs(a[i, k]) > size, 1.0 * i, best), max(size, abs(a[i, k]))
        pivots[k] = best
        regular = regular & (size > SINGULAR * largest)
        if not any_lane(regular):
            return regular
        for i in range(k + 1, n):
            is_best = best == i
            if any_lane(is_best):
                for j in range(n):
                    upper, lower = a[k, j], a[i, j]
                    a[k, j], a[i, j] = where(is_best, lower, upper), where(is_best, upper, lower)
        for i in range(k + 1, n):
            a[i, k] /= a[k, k]
            for j in range(k + 1, n):
                a[i, j] -= a[i, k] * a[k, j]
    return regular


@inner
def lu_solve(lu: Floats, pivots: Floats | Ints, b: Floats) -> None:
    """Overwrite b (n,) with the solution x of a x = b, from the factors (n, n) and `pivots` (n,) of `lu_factor`."""
    n = lu.shape[0]
    for k in range(n):
        for i in range(k + 1, n):
            is_best = pivots[k] == i
            if any_lane(is_best):
                b[k], b[i] = where(is_best, b[i], b[k]), where(is_best, b[k], b[i])
    for i in range(n):
        for j in range(i):
            b[i] -= lu[i, j] * b[j]
    for i in range(n - 1, -1, -1):
        for j in range(i + 1, n):
            b[i] -= lu[i, j] * b[j]
        b[i] /= lu[i, i]


@inner
def lu_solve_transposed(lu: Floats, pivots: Floats | Ints, b: Floats) -> None:
    """Overwrite b (n,) with the solution x of a^T x = b, from the factors (n, n) and `pivots` (n,) of `lu_factor`."""
    n = lu.shape[0]
    for i in range(n):
        for j in range(i):
            b[i] -= lu[j, i] * b[j]
        b[i] /= lu[i, i]
    for i in range(n - 1, -1, -1):
        for j in range(i + 1, n):
            b[i] -= lu[j, i] * b[j]
    for k in range(n - 1, -1, -1):
        for i in range(k + 1, n):
            is_best = pivots[k] == i
            if any_lane(is_best):
                b[k], b[i] = where(is_best, b[i], b[k]), where(is_best, b[k], b[i])


@inner
def ldl_solve(a: Floats, b: Floats) -> None:
    """Overwrite b (n,) with x of a x = b, a (n, n) symmetric and positive definite (its lower half is used up); nan in b where it is
    not."""
    ldl_factor(a)
    ldl_substitute(a, b)


@inner
def ldl_factor(a: Floats) -> None:
    """Overwrite the lower half of a (n, n), symmetric and positive definite, with its factors, a = L D L^T; nan where it is not.

    L has ones on its diagonal; in their places stand the reciprocals of D.  One division a column, where Cholesky's factor needs a root
    and n divisions: in a mass matrix of two or three coordinates they are most of the time.
    """
    n = a.shape[0]
    for j in range(n):
        reciprocal = 1.0 / where(a[j, j] > 0.0, a[j, j], np.nan)
        for i in range(j + 1, n):
            factor = a[i, j] * reciprocal
            for k in range(j + 1, i + 1):
                a[i, k] -= factor * a[k, j]
        for i in range(j + 1, n):
            a[i, j] *= reciprocal
        a[j, j] = reciprocal


@inner
def ldl_substitute(a: Floats, b: Floats) -> None:
    """Overwrite b (n,) with x of L D L^T x = b, the factors in the lower half of a (n, n) as `ldl_factor` leaves them."""
    n = a.shape[0]
    for i in range(n):
        for k in range(i):
            b[i] -= a[i, k] * b[k]
    for i in range(n - 1, -1, -1):
        b[i] *= a[i, i]
        for k in range(i + 1, n):
            b[i] -= a[k, i] * b[k]


@inner
def ldl_energy(a: Floats, b: Floats) -> float:
    """b^T (L D L^T)^-1 b, the factors in the lower half of a (n, n) as `ldl_factor` leaves them; b (n,) is used up."""
    total = 0.0
    for i in range(b.size):
        for k in range(i):
            b[i] -= a[i, k] * b[k]
        total += a[i, i] * b[i] * b[i]
    return total
