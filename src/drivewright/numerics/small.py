"""Kernels for small dense systems of equations, where a call of LAPACK would cost more than the work."""

import numpy as np

from drivewright._jit import inner
from drivewright._typing import Floats, Ints

SINGULAR = 1e-13  # a pivot below this part of the matrix' largest entry


@inner
def lu_factor(a: Floats, pivots: Ints) -> bool:
    """Overwrite the square matrix a (n, n) with L and U, rows exchanged as `pivots` (n,) says; False where it is singular."""
    n = a.shape[0]
    largest = 0.0
    for i in range(n):
        for j in range(n):
            largest = max(largest, abs(a[i, j]))
    for k in range(n):
        best = k
        for i in range(k + 1, n):
            if abs(a[i, k]) > abs(a[best, k]):
                best = i
        pivots[k] = best
        if not abs(a[best, k]) > SINGULAR * largest:
            return False
        if best != k:
            for j in range(n):
                a[k, j], a[best, j] = a[best, j], a[k, j]
        for i in range(k + 1, n):
            a[i, k] /= a[k, k]
            for j in range(k + 1, n):
                a[i, j] -= a[i, k] * a[k, j]
    return True


@inner
def lu_solve(lu: Floats, pivots: Ints, b: Floats) -> None:
    """Overwrite b (n,) with the solution x of a x = b, from the factors (n, n) and `pivots` (n,) of `lu_factor`."""
    n = lu.shape[0]
    for k in range(n):
        best = pivots[k]
        if best != k:
            b[k], b[best] = b[best], b[k]
    for i in range(n):
        for j in range(i):
            b[i] -= lu[i, j] * b[j]
    for i in range(n - 1, -1, -1):
        for j in range(i + 1, n):
            b[i] -= lu[i, j] * b[j]
        b[i] /= lu[i, i]


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
        reciprocal = 1.0 / a[j, j] if a[j, j] > 0.0 else np.nan
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
