"""Symmetric linear systems with the shape of a chain: blocks of 3 in a ring, each beside its two neighbours, and a dense border.

    | D0  U0          Un' E0 |
    | U0' D1  U1          E1 |
    |     U1' ...            |        n = N - 1;  Di (3, 3),  Ui (3, 3) couples plate i to plate i + 1,  Ei (3, b),  C (b, b)
    | Un            Dn    En |
    | E0' E1'  ...  En'   C  |

Cholesky factors by blocks from plate 0 on; plate n and the border are left as a Schur complement S of size 3 + b.  Cost O(N (3 + b)^2).
"""

from typing import NamedTuple

import numpy as np

from drivewright._jit import by_reference, inner
from drivewright._typing import Floats


@by_reference
class Ring(NamedTuple):
    """The matrix, overwritten by its factors; `tail` (N, 3, 3 + b), `last` (3 + b, 3 + b) and `rest` (3 + b,) are scratch."""

    diagonal: Floats  # (N, 3, 3)
    side: Floats  # (N, 3, 3)
    border: Floats  # (N, 3, b)
    corner: Floats  # (b, b)
    tail: Floats
    last: Floats
    rest: Floats


def empty_ring(count: int, border: int) -> Ring:
    """A `Ring` of zeros for N = `count` plates, at least 3, and b = `border` further unknowns."""
    size = 3 + border
    return Ring(
        np.zeros((count, 3, 3)),
        np.zeros((count, 3, 3)),
        np.zeros((count, 3, border)),
        np.zeros((border, border)),
        np.zeros((count, 3, size)),
        np.zeros((size, size)),
        np.zeros(size),
    )


@inner
def clear(ring: Ring) -> None:
    """All zeros."""
    ring.diagonal[:] = 0.0
    ring.side[:] = 0.0
    ring.border[:] = 0.0
    ring.corner[:] = 0.0


@inner
def factor(ring: Ring) -> bool:
    """Overwrite the matrix with its factors; False where it is not positive definite.

    Li Li' = Di, Wi = Li^-1 Ui (over Ui), Yi = Li^-1 Fi (the tail);  Di+1 -= Wi' Wi,  Fi+1 -= Wi' Yi,  S -= Yi' Yi.
    """
    n = len(ring.diagonal) - 1
    _open(ring, n)
    for i in range(n):
        if not _cholesky(ring.diagonal[i]):
            return False
        _lower(ring.diagonal[i], ring.tail[i])
        if i + 1 < n:
            _lower(ring.diagonal[i], ring.side[i])
            _take_product(ring.side[i], ring.side[i], ring.diagonal[i + 1])
            _take_product(ring.side[i], ring.tail[i], ring.tail[i + 1])
        _take_product(ring.tail[i], ring.tail[i], ring.last)
    return _cholesky(ring.last)


@inner
def solve(ring: Ring, plates: Floats, others: Floats) -> None:
    """Overwrite the right-hand side, plates (N, 3) [N, N, N m] and others (b,) [N or N m], with the solution [m, m, rad], [m or rad].

    The matrix is factored already.
    """
    n, size = len(ring.diagonal) - 1, len(ring.last)
    for i in range(n):
        if i > 0:
            _take(ring.side[i - 1], plates[i - 1], plates[i])
        _forward(ring.diagonal[i], plates[i])
    for a in range(size):
        ring.rest[a] = plates[n, a] if a < 3 else others[a - 3]
    for i in range(n):
        _take(ring.tail[i], plates[i], ring.rest)
    _forward(ring.last, ring.rest)
    _backward(ring.last, ring.rest)
    for a in range(size):
        if a < 3:
            plates[n, a] = ring.rest[a]
        else:
            others[a - 3] = ring.rest[a]
    for i in range(n - 1, -1, -1):
        _take_across(ring.tail[i], ring.rest, plates[i])
        if i + 1 < n:
            _take_across(ring.side[i], plates[i + 1], plates[i])
        _backward(ring.diagonal[i], plates[i])


@inner
def _open(ring, n):
    """The tails: what couples each plate to plate n and to the border; and S before anything is taken off it."""
    for i in range(n):
        for a in range(3):
            for b in range(ring.tail.shape[2]):
                ring.tail[i, a, b] = ring.border[i, a, b - 3] if b >= 3 else 0.0
    for a in range(3):
        for b in range(3):
            ring.tail[0, a, b] += ring.side[n, b, a]
            ring.tail[n - 1, a, b] += ring.side[n - 1, a, b]
            ring.last[a, b] = ring.diagonal[n, a, b]
        for b in range(len(ring.corner)):
            ring.last[a, 3 + b] = ring.last[3 + b, a] = ring.border[n, a, b]
    for a in range(len(ring.corner)):
        for b in range(len(ring.corner)):
            ring.last[3 + a, 3 + b] = ring.corner[a, b]


@inner
def _cholesky(a):
    """Cholesky factor L L' = a in the lower half of a (n, n), the diagonal inverted; False where a is not positive definite.

    Units of a are those of the system's matrix: row and column of a place [N/m] with itself, [N] with an angle, of two angles [N m].
    """
    n = len(a)
    for j in range(n):
        pivot = a[j, j]
        for k in range(j):
            pivot -= a[j, k] * a[j, k]
        if not pivot > 0.0:
            return False
        a[j, j] = 1.0 / np.sqrt(pivot)
        for i in range(j + 1, n):
            entry = a[i, j]
            for k in range(j):
                entry -= a[i, k] * a[j, k]
            a[i, j] = entry * a[j, j]
    return True


@inner
def _lower(factor, columns):
    """Overwrite the columns (3, c) with L^-1 columns, L the factor (3, 3) of `_cholesky`."""
    for b in range(columns.shape[1]):
        first = columns[0, b] * factor[0, 0]
        second = (columns[1, b] - factor[1, 0] * first) * factor[1, 1]
        columns[2, b] = (columns[2, b] - factor[2, 0] * first - factor[2, 1] * second) * factor[2, 2]
        columns[0, b], columns[1, b] = first, second


@inner
def _take_product(left, right, target):
    """target (a, b) -= left' right, for left (3, a) and right (3, b)."""
    for a in range(target.shape[0]):
        for b in range(target.shape[1]):
            target[a, b] -= left[0, a] * right[0, b] + left[1, a] * right[1, b] + left[2, a] * right[2, b]


@inner
def _take(matrix, vector, target):
    """target (a,) -= matrix' vector, for matrix (3, a) and vector (3,)."""
    for a in range(len(target)):
        target[a] -= matrix[0, a] * vector[0] + matrix[1, a] * vector[1] + matrix[2, a] * vector[2]


@inner
def _take_across(matrix, vector, target):
    """target (3,) -= matrix vector, for matrix (3, b) and vector (b,)."""
    for a in range(3):
        for b in range(len(vector)):
            target[a] -= matrix[a, b] * vector[b]


@inner
def _forward(factor, b):
    """Overwrite b (n,) with L^-1 b, L the factor (n, n) of `_cholesky`."""
    for i in range(len(b)):
        for k in range(i):
            b[i] -= factor[i, k] * b[k]
        b[i] *= factor[i, i]


@inner
def _backward(factor, b):
    """Overwrite b (n,) with L'^-1 b, L the factor (n, n) of `_cholesky`."""
    for i in range(len(b) - 1, -1, -1):
        for k in range(i + 1, len(b)):
            b[i] -= factor[k, i] * b[k]
        b[i] *= factor[i, i]
