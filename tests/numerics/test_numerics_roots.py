import numpy as np
import pytest

from drivewright.errors import InputError, SolverError
from drivewright.numerics.roots import bracketed_roots, extremes, newton, roots_in_brackets

pytestmark = pytest.mark.analytical


def test_all_roots_to_machine_precision():
    roots = bracketed_roots(np.cos, np.linspace(0.3, 20.1, 40))
    np.testing.assert_allclose(roots, np.pi * (np.arange(6) + 0.5), rtol=3e-16)


def test_flat_steep_and_hidden_roots():
    f = lambda x: (x - 0.3) ** 9 * np.expm1(200 * (x - 0.7))  # noqa: E731
    np.testing.assert_allclose(bracketed_roots(f, np.linspace(0, 1, 8)), [0.3, 0.7], rtol=1e-15)


def test_a_hit_on_the_grid_counts_once():
    np.testing.assert_array_equal(bracketed_roots(lambda x: x * (x - 0.4), [-1.0, 0.0, 0.2, 1.0]), [0.0, 0.4])


def test_poles_and_touching_roots_are_no_roots():
    np.testing.assert_allclose(bracketed_roots(np.tan, np.linspace(0.1, 10, 50)), np.pi * np.arange(1, 4), rtol=1e-15)
    assert bracketed_roots(lambda x: (x - 0.31) ** 2, np.linspace(0, 1, 20)).size == 0


@pytest.mark.parametrize(
    "f, grid, root, most",
    [
        (lambda x: np.exp(x) - 2, [-3.0, 4.0], np.log(2), 9),
        (lambda x: np.arctan(x - 0.1234), [-10.0, 30.0], 0.1234, 10),
        (lambda x: np.expm1(40 * (x - 0.7)), [0.0, 1.0], 0.7, 12),
        (lambda x: x**2 - 2, [1.0, 2.0], np.sqrt(2), 7),
        (lambda x: (x - 0.3) ** 9, [0.0, 1.0], 0.3, 52),
        (lambda x: np.cbrt(x - 0.3), [0.0, 1.0], 0.3, 52),
    ],
)
def test_few_calls_where_f_is_smooth_and_never_many_more_than_bisection(f, grid, root, most):
    calls = []
    assert bracketed_roots(lambda x: calls.append(1) or f(x), grid) == pytest.approx([root], rel=3e-16)
    assert len(calls) <= most


@pytest.mark.parametrize("grid, word", [([0.0, 2.0, 1.0], "increasing"), ([0.0, 0.0], "increasing"), ([0.0, np.nan, 2.0], "not finite")])
def test_bad_grids_are_named(grid, word):
    with pytest.raises(InputError, match=word):
        bracketed_roots(lambda x: x - 0.5, grid)


def circle_and_hyperbola(x):
    return np.array([x[0] ** 2 + x[1] ** 2 - 4, x[0] * x[1] - 1]), np.array([[2 * x[0], 2 * x[1]], [x[1], x[0]]])


def test_newton_finds_the_closed_form():
    np.testing.assert_allclose(newton(circle_and_hyperbola, [2.0, 0.3]), np.sqrt(2 + np.array([1, -1]) * np.sqrt(3)), rtol=1e-15)


def test_newton_converges_quadratically():
    calls = []
    newton(lambda x: calls.append(1) or circle_and_hyperbola(x), [2.0, 0.3])
    assert len(calls) <= 5


def test_newton_is_damped_where_full_steps_diverge():
    calls = []

    def arctangent(x):
        calls.append(x[0])
        return np.arctan(x), np.diag(1 / (1 + x**2))

    np.testing.assert_allclose(newton(arctangent, [20.0]), [0.0], atol=1e-15)
    assert max(np.abs(calls)) < 1000  # undamped, |x| squares itself


def test_newton_does_not_see_units():
    scale = np.array([1e3, 1e-6])

    def other_units(x):
        f, jacobian = circle_and_hyperbola(x / scale)
        return f * [1e5, 1e-7], jacobian / scale * np.array([[1e5], [1e-7]])

    ours = newton(other_units, np.array([2.0, 0.3]) * scale, scale=scale)
    np.testing.assert_allclose(ours / scale, newton(circle_and_hyperbola, [2.0, 0.3]), rtol=1e-14)


@pytest.mark.parametrize(
    "f, start, word",
    [
        (lambda x: (x**2 + 1, np.diag(2 * x)), [0.7], "There may be no solution near the start"),
        (lambda x: (x * 0 + 1, np.zeros((1, 1))), [0.7], "singular at step 1"),
        (lambda x: (np.exp(-x), np.diag(-np.exp(-x))), [0.0], "no solution after 50 steps"),
    ],
)
def test_newton_gives_up_with_advice_and_its_last_point(f, start, word):
    with pytest.raises(SolverError, match=word) as caught:
        newton(f, start)
    assert np.shape(caught.value.partial) == (1,)


def test_extremes_of_many_hills():
    f = lambda x: np.sin(x) + 0.3 * np.sin(7.3 * x)  # noqa: E731
    x = np.linspace(0, 9, 2_000_001)
    low, least, high, most = extremes(f, 0, 9)
    assert least == pytest.approx(f(x).min(), abs=1e-11) and most == pytest.approx(f(x).max(), abs=1e-11)
    assert low == pytest.approx(x[f(x).argmin()], abs=1e-5) and high == pytest.approx(x[f(x).argmax()], abs=1e-5)


def test_extremes_are_refined_between_samples():
    low, least, high, most = extremes(lambda x: 3 - (x - 0.123456) ** 2, -1, 1, samples=9)
    assert (low, least) == (-1.0, 3 - 1.123456**2)
    assert high == pytest.approx(0.123456, abs=2e-8) and most == pytest.approx(3, abs=1e-15)


def test_extremes_at_the_ends_and_of_a_constant():
    assert extremes(lambda x: 2 * x, -1, 3) == (-1.0, -2.0, 3.0, 6.0)
    assert extremes(lambda x: 7.0, -1, 3) == (-1.0, 7.0, -1.0, 7.0)


def test_the_first_of_equal_extremes():
    low, _, high, _ = extremes(lambda x: np.round(np.cos(x), 3), 0, 20)
    assert high == 0.0 and low == pytest.approx(np.pi, abs=0.04)


def test_extremes_refuse_infinity():
    with np.errstate(divide="ignore"), pytest.raises(InputError, match="not finite at 0"):
        extremes(lambda x: 1 / x, 0, 1)


def test_brackets_of_functions_of_their_own_are_closed_together():
    """Each column has its own cosine: roots where they are, nan at a pole and where the signs are equal."""
    shift = np.array([[0.3], [1.1]])
    a, b = np.array([[1.0, 2.5], [2.0, 3.0]]), np.array([[2.0, 3.0], [3.5, 3.2]])
    roots = roots_in_brackets(lambda x: np.cos(x - shift), a, b, np.cos(a - shift), np.cos(b - shift))
    np.testing.assert_allclose(roots, [[np.pi / 2 + 0.3, np.nan], [np.pi / 2 + 1.1, np.nan]], rtol=1e-15)
    ends = np.array([1.0]), np.array([2.0])
    assert np.isnan(roots_in_brackets(np.tan, *ends, *map(np.tan, ends)))
