"""Null space of a matrix, its most independent columns, and its inverse in least squares: by NumPy alone.

scipy.linalg has the like; it takes as long to import as everything else in a small run of a mechanism.
"""

import numpy as np

from drivewright._typing import Bools, Floats, Ints

WELL = 1e8  # largest condition of a Gram matrix that is inverted: it leaves 1e-8 of a solution, and one correction leaves rounding


def null_space(matrix: Floats, rcond: float | None = None) -> Floats:
    """(n, free): orthonormal columns x with matrix x = 0, matrix (m, n).

    Singular values up to `rcond` times the largest count as zero; by default that is machine precision times the larger dimension.
    """
    _, sizes, directions = np.linalg.svd(matrix)
    least = np.max(sizes, initial=0.0) * (np.finfo(float).eps * max(matrix.shape) if rcond is None else rcond)
    return directions[np.sum(sizes > least) :].T


def pivot_order(matrix: Floats) -> Ints:
    """The columns (n,) of a matrix (m, n) in the order of QR with column pivoting: next is the one of which most is left when the
    directions of those before are taken out (Golub & Van Loan, section 5.4.2); the first of several alike."""
    rest, order = matrix.astype(float), np.arange(matrix.shape[1])
    for k in range(min(matrix.shape)):
        best = k + int(np.argmax(np.linalg.norm(rest[:, k:], axis=0)))
        order[[k, best]], rest[:, [k, best]] = order[[best, k]], rest[:, [best, k]]
        length = np.linalg.norm(rest[:, k])
        if length > 0:
            direction = rest[:, k] / length
            rest[:, k + 1 :] -= np.outer(direction, direction @ rest[:, k + 1 :])
    return order


def pseudo_inverse(matrices: Floats, rcond: float) -> Floats:
    """(..., n, m): the inverses in least squares of matrices (..., m, n); singular values up to `rcond` times the largest count as zero.

    Of independent columns (A' A)^-1 A', whose error grows with the square of the condition of A, up to 1e-8 of it: correct a solution x
    of A x = b once, x + A^+ (b - A x).  Where the condition is above 1e4, by singular values, which takes five times as long.
    """
    found = np.empty((*matrices.shape[:-2], matrices.shape[-1], matrices.shape[-2]))
    transposed = matrices.swapaxes(-1, -2)
    inverse, well = _inverse_where_well(transposed @ matrices)
    found[well] = inverse[well] @ transposed[well]
    found[~well] = np.linalg.pinv(matrices[~well], rcond=rcond)
    return found


def _inverse_where_well(matrices: Floats) -> tuple[Floats, Bools]:
    """(inverses, which of them are of a condition below `WELL`) of symmetric matrices (..., n, n); of none where one is singular."""
    try:
        inverse = np.asarray(np.linalg.inv(matrices), dtype=float)
    except np.linalg.LinAlgError:
        return matrices, np.zeros(matrices.shape[:-2], dtype=bool)
    return inverse, np.linalg.norm(matrices, axis=(-2, -1)) * np.linalg.norm(inverse, axis=(-2, -1)) < WELL
