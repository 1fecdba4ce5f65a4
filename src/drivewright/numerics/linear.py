"""Which directions a matrix does not see, and which of its columns are the most independent: by NumPy alone.

scipy.linalg has the like; it takes as long to import as everything else in a small run of a mechanism.
"""

import numpy as np

from drivewright._typing import Floats, Ints


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
