"""Radau IIA: its tableau by the simplifying conditions, its stability function, its orders by formula and measured."""

from typing import NamedTuple

import numpy as np
import pytest

from drivewright._jit import implements, plain
from drivewright.numerics.ode import Functions, integrate, jacobian, rate
from drivewright.numerics.ode.dense_output import polynomial
from drivewright.numerics.ode.method import StepControl
from drivewright.numerics.ode.methods import radau

pytestmark = pytest.mark.order

A, C = radau.METHOD.tableau.a, radau.METHOD.tableau.c
B = radau.METHOD.tableau.b


class Linear(NamedTuple):
    """y' = matrix y, with its Jacobian."""

    matrix: np.ndarray


@implements(rate, Linear)
def _(system, t, y, dy):
    dy[:] = system.matrix @ y


@implements(jacobian, Linear)
def _(system, t, y, J):
    J[:] = system.matrix


class Coupled(NamedTuple):
    """Nonlinear, coupled, with time on the right; solved by (exp(sin t), cos t)."""

    nothing: int


@implements(rate, Coupled)
def _(system, t, y, dy):
    dy[0] = y[0] * y[1]
    dy[1] = -np.sin(t) + (y[1] - np.cos(t)) * y[0]


@implements(jacobian, Coupled)
def _(system, t, y, J):
    J[0, 0], J[0, 1] = y[1], y[0]
    J[1, 0], J[1, 1] = y[1] - np.cos(t), y[0]


def exact(t):
    return np.array([np.exp(np.sin(t)), np.cos(t)])


def one_step(system, t, h, y):
    """End and interpolant of a step whose stages are solved down to rounding, in plain Python."""
    control, work, trial = StepControl(np.inf, 1e-3, np.ones(y.size), np.inf, 0.0), radau.METHOD.workspace(y.size), np.empty(y.size)
    plain(radau._prepare)(work, system, control, t, h, y)
    for _ in range(30):
        plain(radau._improve)(work, system, t, h, y, trial)
    dense = np.empty((5, y.size))
    plain(radau._interpolant)(y, work, dense)
    return y + work.z[2], dense


def slope(sizes, errors):
    return np.polyfit(np.log(sizes), np.log(errors), 1)[0]


# ------------------------------------------------------------------------------------------------------------- exactly


def test_the_nodes_are_those_of_radau():
    np.testing.assert_allclose(C, np.append(np.sort(np.roots([10, -8, 1])), 1.0), atol=1e-15)  # the factor of P3 - P2 on [0, 1]


@pytest.mark.parametrize("power", range(1, 7))
def test_the_quadrature_has_order_5_and_no_more(power):
    assert (abs(B @ C ** (power - 1) - 1 / power) < 1e-14) == (power <= 5)


@pytest.mark.parametrize("power", range(1, 5))
def test_the_stages_have_order_3_and_no_more(power):
    assert (np.abs(A @ C ** (power - 1) - C**power / power).max() < 1e-14) == (power <= 3)


@pytest.mark.parametrize("power", range(1, 4))
def test_the_adjoint_condition_that_lifts_the_order_to_5(power):
    assert (np.abs((B * C ** (power - 1)) @ A - B * (1 - C**power) / power).max() < 1e-14) == (power <= 2)


def test_the_transformation_splits_the_stages():
    blocks = radau._T_INVERSE @ np.linalg.inv(A) @ radau._T
    p, q = radau._COMPLEX.real, radau._COMPLEX.imag
    np.testing.assert_allclose(blocks, [[radau._REAL, 0, 0], [0, p, -q], [0, q, p]], atol=2e-13)
    assert pytest.approx(3 - 3 ** (1 / 3) + 9 ** (1 / 3), rel=1e-14) == radau._REAL


@pytest.mark.parametrize("power", range(5))
def test_the_error_estimate_has_order_3(power):
    # For y' = t^power / power! : stages minus y are c^(power + 1) / (power + 1), and f at the start is 1 or 0.
    defect = (power == 0) + radau._ERROR[0] @ C ** (power + 1) / (power + 1)
    assert (abs(defect) < 1e-13) == (power <= 2)


def test_the_error_estimate_is_the_slope_that_the_polynomial_misses_at_the_start():
    stages = np.array([[0.3], [-0.7], [1.9]])
    work = radau.METHOD.workspace(1)
    work.z[:] = stages
    dense = np.empty((5, 1))
    plain(radau._interpolant)(np.array([0.4]), work, dense)
    slope_at_start = (polynomial(dense, 1e-6)[0] - polynomial(dense, -1e-6)[0]) / 2e-6
    assert radau._ERROR[0] @ stages[:, 0] == pytest.approx(-slope_at_start, rel=1e-9)


@pytest.mark.parametrize("z", [0.7, -0.3, -2.9, -40.0, -1e4, -1e8, -1e12])
def test_the_stability_function_is_the_pade_approximation_that_vanishes_at_infinity(z):
    ours = one_step(Linear(np.array([[z / 0.2]])), 0.0, 0.2, np.array([1.7]))[0][0] / 1.7
    pade = (1 + z * (2 / 5 + z / 20)) / (1 - z * (3 / 5 - z * (3 / 20 - z / 60)))
    assert ours == pytest.approx(pade, rel=1e-9, abs=2e-15) and abs(ours) < max(1.1 * np.exp(z), 4 / abs(z))


@pytest.mark.parametrize("phase", [0.5, 3.0, 30.0])
def test_an_undamped_oscillation_never_grows(phase):
    start = np.array([0.6, -0.8])
    end = one_step(Linear(np.array([[0.0, phase], [-phase, 0.0]])), 0.0, 1.0, start)[0]
    z = 1j * phase
    pade = (1 + z * (2 / 5 + z / 20)) / (1 - z * (3 / 5 - z * (3 / 20 - z / 60)))
    assert np.hypot(*end) == pytest.approx(abs(pade), rel=1e-12) and np.hypot(*end) < 1
    assert complex(end[1], end[0]) == pytest.approx(pade * complex(start[1], start[0]), rel=1e-12)


# ------------------------------------------------------------------------------------------------------------ measured


def test_measured_order_of_the_steps():
    counts, errors = np.array([6, 12, 24, 60]), []
    for n in counts:
        y, h = exact(0.3), 3.0 / n
        for k in range(n):
            y = one_step(Coupled(0), 0.3 + k * h, h, y)[0]
        errors.append(np.abs(y - exact(3.3)).max())
    assert slope(1 / counts, errors) == pytest.approx(5, abs=0.15)


def test_measured_order_of_whole_runs():
    # Linear, so that one iteration solves for the stages, however loose the tolerance that lets every step pass.
    counts = np.array([12, 24, 48, 120])
    spring = Functions(lambda t, y: np.array([y[1], -4 * y[0]]))
    ends = [
        integrate(spring, 0.3, 3.3, [np.cos(0.6), -2 * np.sin(0.6)], 1e9, 1e9, method="radau", max_step=3 / n, first_step=3 / n)
        for n in counts
    ]
    assert [end.steps for end in ends] == list(counts)
    errors = [np.abs(end.y_end - [np.cos(6.6), -2 * np.sin(6.6)]).max() for end in ends]
    assert slope(1 / counts, errors) == pytest.approx(5, abs=0.15)


@pytest.mark.parametrize("theta", [0.08, 0.2, 0.81])
def test_measured_order_of_the_dense_output(theta):
    # Between the nodes a polynomial of degree 3 is wrong by h^4, except at 0.4, where the area under the node polynomial is zero.
    sizes = np.geomspace(0.02, 0.2, 5)
    errors = []
    for h in sizes:
        dense = one_step(Coupled(0), 0.3, h, exact(0.3))[1]
        errors.append(np.abs(polynomial(dense, theta) - exact(0.3 + theta * h)).max())
    assert slope(sizes, errors) == pytest.approx(4, abs=0.15)


def test_the_interpolant_passes_through_both_ends_and_the_stages():
    y, h = exact(0.3), 0.2
    end, dense = one_step(Coupled(0), 0.3, h, y)
    np.testing.assert_allclose(polynomial(dense, 0.0), y, atol=0)
    np.testing.assert_allclose(polynomial(dense, 1.0), end, rtol=1e-15)
    for node in C:  # collocation: the polynomial obeys the equation there
        slope_there = (polynomial(dense, node + 1e-5) - polynomial(dense, node - 1e-5)) / 2e-5
        f = np.empty(2)
        rate(Coupled(0), 0.3 + node * h, polynomial(dense, node), f)
        np.testing.assert_allclose(slope_there, h * f, atol=1e-9)
