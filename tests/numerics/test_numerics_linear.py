"""Null spaces and pivots beside SciPy's."""

import numpy as np
import pytest
import scipy.linalg

from drivewright.numerics.linear import null_space, pivot_order, pseudo_inverse

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


@pytest.mark.parametrize("condition", [1.0, 3e3, 1e5, 1e9])
def test_inverses_in_least_squares_are_those_by_singular_values(condition):
    rng = np.random.default_rng(7)
    left, _, right = np.linalg.svd(rng.normal(size=(50, 9, 6)))
    matrices = left[:, :, :6] * np.geomspace(1.0, 1 / condition, 6) @ right
    right_sides = rng.normal(size=(50, 9))
    found = pseudo_inverse(matrices, 1e-12)
    x = np.einsum("knm,km->kn", found, right_sides)
    x += np.einsum("knm,km->kn", found, right_sides - np.einsum("kmn,kn->km", matrices, x))
    theirs = np.array([np.linalg.lstsq(matrix, b, rcond=None)[0] for matrix, b in zip(matrices, right_sides, strict=True)])
    assert x == pytest.approx(theirs, rel=1e-13 * condition, abs=1e-13 * condition * np.abs(theirs).max())


def test_dependent_columns_share_what_they_carry():
    """The least of all solutions: twice the same column carries half each; a column of rounding carries nothing."""
    matrices = np.array(
        [[[1.0, 1.0], [0.0, 0.0], [0.0, 0.0]], [[1.0, 0.0], [0.0, 1e-13], [0.0, 0.0]], [[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]]]
    )
    found = pseudo_inverse(matrices, 1e-10)
    assert found @ [1.0, 0.0, 0.0] == pytest.approx(np.array([[0.5, 0.5], [1.0, 0.0], [1.0, 0.0]]))
    assert found @ [0.0, 1.0, 0.0] == pytest.approx(np.array([[0.0, 0.0], [0.0, 0.0], [0.0, 1.0]]))
    assert pseudo_inverse(np.ones((4, 1, 2)), 1e-10) == pytest.approx(np.full((4, 2, 1), 0.5))
    assert pseudo_inverse(np.zeros((2, 3, 0)), 1e-10).shape == (2, 0, 3)
