"""Jets against derivatives by Cauchy's integral on a circle in the complex plane: a route without a single derivative rule."""

import numpy as np
import pytest

from drivewright.errors import InputError
from drivewright.numerics import jets
from drivewright.numerics.jets import Jet, compose, constant, variable

pytestmark = pytest.mark.analytical

POINTS = np.array([0.31, 0.57, 0.83])


def cauchy(f, x, radius=0.2, samples=64):
    """f and its first three derivatives at x."""
    turn = np.exp(2j * np.pi * np.arange(samples) / samples)
    values = f(x[:, None] + radius * turn)
    return [factor * np.mean(values * turn**-n, axis=1) / radius**n for n, factor in enumerate((1, 1, 2, 6))]


def same(jet, expected, tolerance=1e-11):
    for ours, theirs in zip(jet, expected, strict=True):
        np.testing.assert_allclose(ours, theirs, rtol=tolerance, atol=tolerance)


FUNCTIONS = {
    "exp": (jets.exp, np.exp),
    "log": (jets.log, np.log),
    "sin": (jets.sin, np.sin),
    "cos": (jets.cos, np.cos),
    "tan": (jets.tan, np.tan),
    "atan": (jets.atan, np.arctan),
    "sqrt": (jets.sqrt, np.sqrt),
    "power": (lambda x: x**2.7, lambda x: x**2.7),
    "square": (lambda x: x**2, lambda x: x**2),
    "reciprocal": (lambda x: 3 / x, lambda x: 3 / x),
    "quotient": (lambda x: jets.sin(x) / (2 + x * x), lambda x: np.sin(x) / (2 + x * x)),
    "chain": (lambda x: jets.exp(jets.sin(3 * x) - x), lambda x: np.exp(np.sin(3 * x) - x)),
    "left and right": (lambda x: 2 - (3 - x) * 4 / x + 1, lambda x: 2 - (3 - x) * 4 / x + 1),
    "complex": (lambda x: (1 + 2j) * jets.exp(1j * x) / (x + 1j), lambda x: (1 + 2j) * np.exp(1j * x) / (x + 1j)),
}


@pytest.mark.parametrize("name", FUNCTIONS)
def test_derivatives(name):
    ours, theirs = FUNCTIONS[name]
    same(ours(variable(POINTS)), cauchy(theirs, POINTS))


def test_atan2_in_all_quadrants():
    t = variable(np.linspace(0.1, 6.2, 9))
    x, y = 0.7 * jets.cos(t) + 0.1, 1.3 * jets.sin(t) - 0.05
    angle = jets.atan2(y, x)
    np.testing.assert_allclose(angle.d0, np.arctan2(y.d0, x.d0), rtol=0, atol=0)
    slope = (x * Jet(y.d1, y.d2, y.d3, 0 * y.d3) - y * Jet(x.d1, x.d2, x.d3, 0 * x.d3)) / (x * x + y * y)
    same([angle.d1, angle.d2, angle.d3], list(slope)[:3])


def test_parts_of_a_complex_jet():
    t = variable(POINTS)
    z = jets.exp(0.3 * t + 2j * t)
    same(z.abs2(), jets.exp(0.6 * t))
    same(z.real, jets.exp(0.3 * t) * jets.cos(2 * t))
    same(z.imag, jets.exp(0.3 * t) * jets.sin(2 * t))
    same(z.conj(), jets.exp(0.3 * t - 2j * t))


def test_compose_is_evaluation_at_the_inner_value():
    inner = jets.sin(variable(POINTS)) + 0.5
    outer = jets.log(variable(inner.d0))
    same(compose(outer, inner), jets.log(inner))


def test_change_of_variable_undoes_compose():
    t = variable(POINTS)
    x = t + 0.3 * jets.sin(2 * t)
    same((jets.exp(x) * x).with_respect_to(x), jets.exp(variable(x.d0)) * variable(x.d0))


def test_inverse_of_the_exponential_is_the_logarithm():
    same(jets.exp(variable(POINTS)).inverse(POINTS), jets.log(variable(np.exp(POINTS))))


def test_powers_at_zero_are_polynomials():
    assert [float(part) for part in variable(0.0) ** 2] == [0, 0, 2, 0]
    assert [float(part) for part in variable(0.0) ** 3] == [0, 0, 0, 6]


def test_integer_input_is_a_number_too():
    assert [float(part) for part in variable(2) ** -1] == [0.5, -0.25, 0.25, -0.375]


def test_arrays_constants_and_indices():
    jet = np.array([1.0, 2.0, 3.0]) * variable(POINTS)
    assert isinstance(jet, Jet)
    assert [float(part) for part in jet[1]] == [2 * POINTS[1], 2.0, 0.0, 0.0]
    assert [float(part) for part in constant(4)] == [4.0, 0.0, 0.0, 0.0]


def test_standstill_is_refused_with_its_place():
    x = variable(np.array([-1.0, 0.0, 2.0])) ** 2
    with pytest.raises(InputError, match=r"x' = 0\) at 1 of 3 points, first at x = 0"):
        x.with_respect_to(x)
