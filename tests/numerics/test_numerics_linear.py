"""Null spaces and pivots beside SciPy's."""

import numpy as np
import pytest
import scipy.linalg

from drivewright.numerics.linear import null_space, pivot_order

pytestmark = pytest.mark.analytical


@pytest.mark.parametrize("shape", [(1, 1), (3, 3), (2, 5), (5, 2), (4, 9), (9, 4)])
def test_pivots_are_those_of_qr_with_column_pivoting(shape):
    rng = np.random.default_rng(sum(shape))
    for _ in range(50):
        matrix = rng.normal(size=shape) * 10.0 ** rng.integers(-6, 7, shape[1])
        given = matrix.copy()
        np.testing.assert_array_equal(pivot_order(matrix), scipy.linalg.qr(matrix, mode="r", pivoting=True)[-1])
        np.testing.assert_array_equal(matrix, given)


def test_the_first_columns_of_a_deficient_matrix_span_it():
    rng = np.random.default_rng(0)
    matrix = rng.normal(size=(5, 3)) @ rng.normal(size=(3, 8))
    order = pivot_order(matrix)
    assert sorted(order) == list(range(8)) and np.linalg.matrix_rank(matrix[:, order[:3]]) == 3
    np.testing.assert_array_equal(pivot_order(np.zeros((2, 3))), [0, 1, 2])
    np.testing.assert_array_equal(pivot_order(np.array([[1, 1, 3, 3]])), [2, 1, 0, 3])


@pytest.mark.parametrize(("rows", "rank", "columns"), [(4, 2, 6), (6, 2, 4), (3, 3, 3), (3, 0, 4), (0, 0, 3)])
def test_a_null_space_is_orthonormal_unseen_and_whole(rows, rank, columns):
    rng = np.random.default_rng(rows)
    matrix = rng.normal(size=(rows, rank)) @ rng.normal(size=(rank, columns))
    free = null_space(matrix)
    assert free.shape == (columns, columns - rank)
    np.testing.assert_allclose(free.T @ free, np.eye(columns - rank), atol=1e-14)
    np.testing.assert_allclose(matrix @ free, 0, atol=1e-13)


def test_what_counts_as_zero_is_a_part_of_the_largest():
    matrix = 1e6 * np.diag([1.0, 1e-3, 1e-9])
    assert [null_space(matrix, rcond).shape[1] for rcond in (None, 1e-12, 1e-6, 1e-2)] == [0, 0, 1, 2]
    for rcond in (None, 1e-6):
        assert null_space(matrix, rcond).shape == scipy.linalg.null_space(matrix, rcond=rcond).shape
