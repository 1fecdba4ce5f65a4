import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline, CubicSpline

from drivewright.errors import InputError
from drivewright.numerics.splines import cubic_spline, hermite_cubics, interpolating_spline, solve_tridiagonal

pytestmark = pytest.mark.analytical

X = np.array([0.0, 0.3, 0.9, 1.2, 2.0, 2.3, 3.1, 3.3, 4.0])
Y = np.sin(1.3 * X) + 0.1 * X**2


@pytest.mark.parametrize("degree", [3, 5])
@pytest.mark.parametrize("ends", ["natural", "clamped", "periodic"])
def test_interpolates_and_is_smooth_and_breaks_at_the_points(degree, ends):
    y = np.where(X[-1] == X, Y[0], Y) if ends == "periodic" else Y
    spline = interpolating_spline(X, y, degree, ends)
    np.testing.assert_array_equal(spline.x, X)
    assert spline.c.shape == (degree + 1, X.size - 1)
    np.testing.assert_allclose(spline(X), y, atol=1e-13)
    wrap = (X[0], X[-1]) if ends == "periodic" else ()
    for order in range(degree):
        left = [np.polyval(np.polyder(np.poly1d(spline.c[:, i]), order), X[i + 1] - X[i]) for i in range(X.size - 1)]
        right = [np.polyval(np.polyder(np.poly1d(spline.c[:, i]), order), 0.0) for i in range(X.size - 1)]
        np.testing.assert_allclose(left[:-1], right[1:], atol=2e-9)
        if wrap:
            assert left[-1] == pytest.approx(right[0], abs=2e-9)


@pytest.mark.parametrize(
    "degree, ends, orders", [(3, "natural", (2,)), (5, "natural", (3, 4)), (3, "clamped", (1,)), (5, "clamped", (1, 2))]
)
def test_end_conditions(degree, ends, orders):
    spline = interpolating_spline(X, Y, degree, ends)
    for order in orders:
        np.testing.assert_allclose(spline.derivative(order)(X[[0, -1]]), 0, atol=1e-10)
    free = {1, 2, 3, 4} - set(orders)
    assert abs(spline.derivative(min(free))(X[0])) > 1e-3


@pytest.mark.parametrize("degree", [3, 5])
def test_order_of_interpolation(degree):
    errors = []
    for n in (10, 20, 40, 80):
        x = 2 * np.pi * np.arange(n + 1) / n
        spline = interpolating_spline(x, np.append(np.exp(np.sin(x[:-1])), 1.0), degree, "periodic")
        fine = np.linspace(0, 2 * np.pi, 1234)
        errors.append(np.abs(spline(fine) - np.exp(np.sin(fine))).max())
    slope = np.polyfit(np.log([20, 40, 80]), np.log(errors[1:]), 1)[0]
    assert -slope == pytest.approx(degree + 1, abs=0.5)


def test_a_periodic_spline_goes_on_for_ever():
    y = np.where(X[-1] == X, Y[0], Y)
    spline = interpolating_spline(X, y, 3, "periodic")
    np.testing.assert_allclose(spline(X[2] + 3 * X[-1]), y[2], rtol=1e-12)


@pytest.mark.parametrize("ends", ["natural", "clamped", "periodic"])
def test_a_point_in_the_plane_is_two_splines(ends):
    y = np.column_stack([np.cos(X), Y**2])
    y[-1] = y[0]
    both = interpolating_spline(X, y, 5, ends)
    for column in (0, 1):
        np.testing.assert_allclose(both(1.23)[column], interpolating_spline(X, y[:, column], 5, ends)(1.23), rtol=1e-13)


def test_rounding_does_not_open_a_period_but_a_micrometre_does():
    y = 1e-3 * np.cos(np.pi / 2 * X)
    interpolating_spline(X, np.append(y[:-1], y[0] + 1e-14), 3, "periodic")
    with pytest.raises(InputError, match="differs from the first by 1e-07"):
        interpolating_spline(X, np.append(y[:-1], y[0] + 1e-7), 3, "periodic")


@pytest.mark.parametrize(
    "call, word",
    [
        (lambda: interpolating_spline(X, Y, 4), "degree must be 3 or 5, got 4"),
        (lambda: interpolating_spline(X, Y, 3, "free"), "'natural', got 'free'"),
        (lambda: interpolating_spline(X, Y, 3, "periodic"), "Repeat the first value"),
        (lambda: interpolating_spline(np.where(X == 1.2, 0.5, X), Y), r"x\[3\] = 0.5 follows 0.9"),
        (lambda: interpolating_spline(X[:5], Y[:5], 5), "at least 6 points, got 5"),
        (lambda: interpolating_spline(X, Y[:-1]), r"shapes \(9,\) and \(8,\)"),
    ],
)
def test_messages(call, word):
    with pytest.raises(InputError, match=word):
        call()


@pytest.mark.parametrize("count", [2, 3, 4, 5, 6, 7, 8, 9, 64, 1001])
def test_the_cubic_spline_of_samples_is_scipys(count):
    rng = np.random.default_rng(count)
    x, y = np.cumsum(rng.uniform(0.1, 2, count)), rng.normal(size=count)
    ours, theirs = cubic_spline(x, y), CubicSpline(x, y)
    np.testing.assert_allclose(ours.coefficients, theirs.c, rtol=1e-11, atol=1e-11 * np.abs(theirs.c).max())
    at = np.concatenate([x, rng.uniform(x[0], x[-1], 100)])
    np.testing.assert_allclose(ours.integrals_to(at), theirs.antiderivative()(at), rtol=1e-12, atol=1e-12)


def test_the_cubic_spline_of_a_cubic_is_that_cubic():
    x = np.array([0.0, 0.1, 0.7, 1.0, 2.5])
    ours = cubic_spline(x, 4 * x**3 - 3 * x**2 + 2 * x - 1)
    np.testing.assert_allclose(ours.coefficients[0], 4, rtol=1e-11)
    at = np.linspace(0, 2.5, 11)
    np.testing.assert_allclose(ours.integrals_to(at), at**4 - at**3 + at**2 - at, rtol=1e-12, atol=1e-13)


@pytest.mark.parametrize("count", [1, 2, 3, 4, 5, 8, 17, 100])
def test_cyclic_reduction_solves_the_system(count):
    rng = np.random.default_rng(count)
    below, above, right = rng.uniform(-1, 1, (3, count))
    below[0] = above[-1] = 0
    diagonal = 2.5 + rng.uniform(0, 1, count)
    matrix = np.diag(diagonal) + np.diag(below[1:], -1) + np.diag(above[:-1], 1)
    np.testing.assert_allclose(solve_tridiagonal(below, diagonal, above, right), np.linalg.solve(matrix, right), rtol=1e-12, atol=1e-13)


def test_cubics_through_samples_and_their_slopes_are_scipys():
    rng = np.random.default_rng(4)
    x = np.cumsum(rng.uniform(0.1, 1.0, 12))
    y, slope = rng.normal(size=(2, 12))
    at = np.linspace(x[0], x[-1], 200)
    np.testing.assert_allclose(hermite_cubics(x, y, slope).at(at), CubicHermiteSpline(x, y, slope)(at), rtol=1e-11, atol=1e-12)
