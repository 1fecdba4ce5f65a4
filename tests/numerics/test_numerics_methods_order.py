"""Every method of integration has the orders that it states: its tableau by Butcher's trees, its steps measured over a decade."""

import numpy as np
import pytest
from rooted_trees import density, elementary_weights, trees

from drivewright.errors import InputError
from drivewright.numerics.ode import METHODS, Functions, integrate
from drivewright.numerics.ode.loop import method_by_name

pytestmark = pytest.mark.order

METHOD = pytest.mark.parametrize("method", METHODS.values(), ids=METHODS)
SPRING = Functions(lambda t, y: np.array([y[1], -4 * y[0]]))


def spring(t):
    return np.array([np.cos(2 * t), -2 * np.sin(2 * t)])


def slope(sizes, errors):
    return np.polyfit(np.log(sizes), np.log(errors), 1)[0]


def equal_steps(method, count, length=3.0, **more):
    """`count` steps of one size from t = 0.3: nothing exceeds such a tolerance."""
    h = length / count
    run = integrate(SPRING, 0.3, 0.3 + length, spring(0.3), 1e9, 1e9, method=method, max_step=h, first_step=h, **more)
    assert run.steps == count
    return run


def test_the_methods_offered():
    assert {"dopri5", "radau", "rk4"} <= set(METHODS) and all(name == method.name for name, method in METHODS.items())
    assert method_by_name("rk4") is METHODS["rk4"] is method_by_name(METHODS["rk4"])
    with pytest.raises(InputError, match=r"method = 'euler' is not known; take one of dopri5, radau, rk4"):
        integrate(SPRING, 0.0, 1.0, [1.0, 0.0], method="euler")


@METHOD
def test_the_tableau_is_of_the_order_stated_and_no_more(method):
    a, b, c = method.tableau
    assert method.stages == len(a) and method.citation
    np.testing.assert_allclose(a.sum(axis=1), c, atol=2e-15)
    for order in range(1, method.order + 2):
        defects = [b @ elementary_weights(tree, a) - 1 / density(tree) for tree in trees(order)]
        assert (np.abs(defects).max() < 1e-14) == (order <= method.order)


@METHOD
def test_the_steps_have_the_order_stated(method):
    counts = np.array([24, 48, 96, 240])
    errors = [np.abs(equal_steps(method, n).y_end - spring(3.3)).max() for n in counts]
    assert slope(1 / counts, errors) == pytest.approx(method.order, abs=0.1)


@METHOD
def test_the_dense_output_has_the_order_stated(method):
    sizes = np.geomspace(0.005, 0.05, 5)  # within one step a polynomial of order p is wrong by h^(p+1)
    errors = []
    for h in sizes:
        inside = equal_steps(method, 1, h, samples=[0.3 + 0.23 * h])
        errors.append(np.abs(inside.y[0] - spring(inside.t[0])).max())
    assert slope(sizes, errors) - 1 == pytest.approx(method.dense_order, abs=0.1)
