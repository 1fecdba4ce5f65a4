"""Small dense systems of equations against NumPy's."""

import numpy as np
import pytest

from drivewright.numerics.small import ldl_energy, ldl_factor, ldl_solve, lu_factor, lu_solve

pytestmark = pytest.mark.analytical


def definite(n, seed=0):
    """A symmetric, positive definite matrix (n, n)."""
    half = np.random.default_rng(seed).normal(size=(n, n))
    return half @ half.T + 0.1 * np.eye(n)


@pytest.mark.parametrize("n", [1, 2, 3, 6])
def test_definite_systems_are_solved_from_their_lower_half(n):
    a, b = definite(n), np.arange(1.0, n + 1)
    lower, x = np.tril(a) + 7.0 * np.triu(np.ones((n, n)), 1), b.copy()
    ldl_solve(lower, x)
    np.testing.assert_allclose(x, np.linalg.solve(a, b), rtol=1e-11)


@pytest.mark.parametrize("n", [1, 2, 3, 6])
def test_factors_give_the_matrix_back(n):
    a = definite(n, 1)
    factors = a.copy()
    ldl_factor(factors)
    unit = np.tril(factors, -1) + np.eye(n)
    np.testing.assert_allclose(unit @ np.diag(1 / np.diag(factors)) @ unit.T, a, rtol=1e-12, atol=1e-12)


def test_energy_of_a_load_is_the_product_with_the_inverse():
    a, b = definite(4, 2), np.array([1.0, -2.0, 0.5, 3.0])
    factors = a.copy()
    ldl_factor(factors)
    assert ldl_energy(factors, b.copy()) == pytest.approx(b @ np.linalg.solve(a, b), rel=1e-12)


@pytest.mark.parametrize("a", [[[0.0]], [[-1.0]], [[1.0, 2.0], [2.0, 1.0]]])
def test_what_is_not_definite_gives_nan(a):
    a, x = np.array(a), np.ones(len(a))
    ldl_solve(a, x)
    assert np.all(np.isnan(x))


@pytest.mark.parametrize("n", [1, 3, 5])
def test_general_systems_are_solved_with_rows_exchanged(n):
    a = np.random.default_rng(n).normal(size=(n, n))
    a[0, 0] = 0.0 if n > 1 else a[0, 0]
    b, factors, pivots = np.arange(1.0, n + 1), a.copy(), np.zeros(n, np.int64)
    assert lu_factor(factors, pivots)
    lu_solve(factors, pivots, b)
    np.testing.assert_allclose(b, np.linalg.solve(a, np.arange(1.0, n + 1)), rtol=1e-10)


def test_a_singular_matrix_is_told():
    assert not lu_factor(np.array([[1.0, 2.0], [2.0, 4.0]]), np.zeros(2, np.int64))
