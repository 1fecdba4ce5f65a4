"""The orders that numerics.ode claims: exactly, by the order conditions of all rooted trees, and measured with fixed steps."""

import itertools

import numpy as np
import pytest
from rooted_trees import density, elementary_weights, trees

from drivewright._jit import plain
from drivewright.numerics.ode import Functions, integrate
from drivewright.numerics.ode.dense_output import polynomial
from drivewright.numerics.ode.methods import dopri5

pytestmark = pytest.mark.order

A = dopri5.METHOD.tableau.a


def defects(quadrature, order, theta=1.0):
    return np.array([quadrature @ elementary_weights(tree, A) - theta**order / density(tree) for tree in trees(order)])


def dense_quadrature(theta):
    """Weight of each stage in the interpolant at the fraction theta, by feeding it one stage at a time."""
    result = []
    for stage in range(7):
        k, dense = np.zeros((7, 1)), np.zeros((5, 1))
        k[stage] = 1.0
        plain(dopri5._interpolant)(1.0, np.zeros(1), A[6] @ k, k, dense)
        result.append(polynomial(dense, theta)[0])
    return np.array(result)


def test_there_are_as_many_trees_as_butcher_counts():
    assert [len(trees(order)) for order in range(1, 6)] == [1, 1, 2, 4, 9]


def test_times_of_the_stages():
    np.testing.assert_allclose(A.sum(axis=1), dopri5._C, atol=2e-15)


@pytest.mark.parametrize("order", range(1, 7))
def test_steps_have_order_5_and_no_more(order):
    assert (np.abs(defects(A[6], order)).max() < 1e-14) == (order <= 5)


@pytest.mark.parametrize("order", range(1, 6))
def test_the_error_estimate_compares_with_order_4(order):
    estimate = [dopri5._ERROR @ elementary_weights(tree, A) for tree in trees(order)]
    assert (np.abs(estimate).max() < 1e-15) == (order <= 4)


@pytest.mark.parametrize("order, theta", list(itertools.product(range(1, 6), (0.21, 0.37, 0.8))))
def test_dense_output_has_order_4_and_no_more(order, theta):
    assert (np.abs(defects(dense_quadrature(theta), order, theta)).max() < 1e-14) == (order <= 4)


def test_dense_output_meets_both_ends():
    np.testing.assert_allclose(dense_quadrature(0.0), 0, atol=0)
    np.testing.assert_allclose(dense_quadrature(1.0), A[6], atol=1e-15)


# ------------------------------------------------------------------------------------------------------------ measured


def coupled(t, y):
    """Nonlinear, coupled, with time on the right: (exp(sin t), cos t)."""
    return np.array([y[0] * y[1], -np.sin(t) + (y[1] - np.cos(t)) * y[0]])


def exact(t):
    return np.array([np.exp(np.sin(t)), np.cos(t)])


def fixed(f, y0, step, t1, **more):
    """Equal steps from t = 0.3: nothing exceeds such a tolerance."""
    return integrate(Functions(f), 0.3, t1, y0, rtol=1e9, atol=1e9, max_step=step, first_step=step, **more)


def slope(sizes, errors):
    return np.polyfit(np.log(sizes), np.log(errors), 1)[0]


def test_measured_order_of_the_steps():
    # On a linear oscillator the first neglected term rules over the whole decade; on others DOPRI5 hides it behind the next.
    counts = np.array([24, 48, 96, 240])
    ends = [fixed(lambda t, y: np.array([y[1], -4 * y[0]]), [np.cos(0.6), -2 * np.sin(0.6)], 3.0 / n, 3.3) for n in counts]
    assert [end.steps for end in ends] == list(counts)
    errors = [np.abs(end.y_end - [np.cos(6.6), -2 * np.sin(6.6)]).max() for end in ends]
    assert slope(1 / counts, errors) == pytest.approx(5, abs=0.1)


def test_measured_order_of_the_dense_output():
    # Away from the ends an interpolant of order 4 is wrong by h^5 in a step.
    sizes = np.geomspace(0.02, 0.2, 5)
    errors = []
    for h in sizes:
        inside = fixed(coupled, exact(0.3), h, 0.3 + h, samples=[0.3 + 0.37 * h])
        assert inside.steps == 1
        errors.append(np.abs(inside.y[0] - exact(inside.t[0])).max())
    assert slope(sizes, errors) - 1 == pytest.approx(4, abs=0.2)


def test_dense_output_is_smooth_across_steps():
    h, tiny = 0.21, 1e-7
    t = 0.3 + 2 * h + tiny * np.array([-2, -1, 1, 2])
    y = fixed(coupled, exact(0.3), h, 0.3 + 4 * h, samples=t).y[:, 0]
    left, right = (y[1] - y[0]) / tiny, (y[3] - y[2]) / tiny
    assert left == pytest.approx(right, rel=1e-6) and left == pytest.approx(coupled(t[1], exact(t[1]))[0], rel=1e-4)
