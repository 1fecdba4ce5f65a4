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
def cholesky_solve(a: Floats, b: Floats) -> None:
    """Overwrite b (n,) with x of a x = b, a (n, n) symmetric and positive definite (its lower half is used up); nan in b where it is
    not."""
    cholesky_factor(a)
    cholesky_substitute(a, b)


@inner
def cholesky_factor(a: Floats) -> None:
    """Overwrite the lower half of a (n, n), symmetric and positive definite, with its factor L, a = L L^T; nan where it is not."""
    n = a.shape[0]
    for j in range(n):
        for k in range(j):
            a[j, j] -= a[j, k] * a[j, k]
        a[j, j] = np.sqrt(a[j, j])
        for i in range(j + 1, n):
            for k in range(j):
                a[i, j] -= a[i, k] * a[j, k]
            a[i, j] /= a[j, j]


@inner
def cholesky_substitute(a: Floats, b: Floats) -> None:
    """Overwrite b (n,) with x of L L^T x = b, L in the lower half of a (n, n)."""
    n = a.shape[0]
    for i in range(n):
        for k in range(i):
            b[i] -= a[i, k] * b[k]
        b[i] /= a[i, i]
    for i in range(n - 1, -1, -1):
        for k in range(i + 1, n):
            b[i] -= a[k, i] * b[k]
        b[i] /= a[i, i]
