"""The linear solver of a ring of plates against dense algebra."""

import numpy as np
import pytest

from drivewright.chains.implicit.ring import empty_ring, factor, solve

pytestmark = pytest.mark.analytical


def dense(ring):
    count, size = len(ring.diagonal), len(ring.corner)
    full = np.zeros((3 * count + size, 3 * count + size))
    for i in range(count):
        here, there = slice(3 * i, 3 * i + 3), slice(3 * ((i + 1) % count), 3 * ((i + 1) % count) + 3)
        full[here, here] += ring.diagonal[i]
        full[here, there] += ring.side[i]
        full[there, here] += ring.side[i].T
        full[here, 3 * count :] = ring.border[i]
        full[3 * count :, here] = ring.border[i].T
    full[3 * count :, 3 * count :] = ring.corner
    return full


def filled(count, size, seed):
    """A positive definite ring; its smallest eigenvalue is above 1."""
    rng, ring = np.random.default_rng(seed), empty_ring(count, size)
    for table in (ring.diagonal, ring.side, ring.border, ring.corner):
        table[:] = rng.normal(size=table.shape)
    ring.diagonal[:] = 0.5 * (ring.diagonal + ring.diagonal.transpose(0, 2, 1))
    ring.corner[:] = 0.5 * (ring.corner + ring.corner.T)
    shift = 1.0 - np.linalg.eigvalsh(dense(ring))[0]
    ring.diagonal[:] += shift * np.eye(3)
    ring.corner[:] += shift * np.eye(size)
    return ring


@pytest.mark.parametrize("count, size", [(6, 0), (7, 1), (24, 4)])
def test_solution_is_the_dense_one(count, size):
    ring = filled(count, size, seed=count)
    wanted = np.random.default_rng(3).normal(size=3 * count + size)
    right = dense(ring) @ wanted
    plates, others = right[: 3 * count].reshape(count, 3).copy(), right[3 * count :].copy()
    assert factor(ring)
    solve(ring, plates, others)
    assert np.append(plates, others) == pytest.approx(wanted, abs=1e-12)


@pytest.mark.parametrize("lift, definite", [(1e-6, True), (-1e-6, False)])
def test_factors_tell_definite_from_indefinite(lift, definite):
    """The smallest eigenvalue a millionth above or below 0."""
    ring = filled(9, 3, seed=5)
    low = np.linalg.eigvalsh(dense(ring))[0]
    ring.diagonal[:] -= (low - lift) * np.eye(3)
    ring.corner[:] -= (low - lift) * np.eye(3)
    assert factor(ring) == definite
