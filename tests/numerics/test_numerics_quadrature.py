import numpy as np
import pytest
import scipy

from drivewright.errors import InputError
from drivewright.numerics.quadrature import cumulative_integral, cumulative_simpson, integrate_periodic, integrate_pieces, trapezoid

pytestmark = pytest.mark.analytical


def test_gauss_is_exact_to_degree_2n_minus_1_and_not_beyond():
    breaks = [-0.4, 0.1, 1.3]
    exact = lambda n: (1.3**n - (-0.4) ** n) / n  # noqa: E731
    assert integrate_pieces(lambda x: x**7, breaks, points=4) == pytest.approx(exact(8), rel=1e-14)
    assert integrate_pieces(lambda x: x**8, breaks, points=4) != pytest.approx(exact(9), rel=1e-9)


def test_corners_at_breaks_cost_nothing():
    assert integrate_pieces(lambda x: np.abs(x - 0.3), [0, 0.3, 1], points=2) == pytest.approx((0.3**2 + 0.7**2) / 2, rel=1e-15)


def test_cumulative_integral_of_a_row_of_functions():
    breaks = np.array([0.2, 0.5, 1.1, 1.1, 2.0])
    got = cumulative_integral(lambda x: np.array([np.cos(x), np.exp(x)]), breaks)
    np.testing.assert_allclose(got, [np.sin(breaks) - np.sin(0.2), np.exp(breaks) - np.exp(0.2)], rtol=1e-14, atol=1e-15)
    np.testing.assert_allclose(got[:, -1], integrate_pieces(lambda x: np.array([np.cos(x), np.exp(x)]), breaks), rtol=1e-15)


def test_periodic_integral_is_spectral_wherever_it_starts():
    # integral of exp(k cos(x)) over a period is 2 pi I0(k)
    exact = 2 * np.pi * np.i0(2.0)
    errors = [abs(integrate_periodic(lambda x: np.exp(2 * np.cos(x)), 2 * np.pi, n, start=0.7) - exact) for n in (4, 8, 16, 32)]
    assert errors[1] < 1e-2 * errors[0] and errors[2] < 1e-6 * errors[1] and errors[3] < 1e-13


def test_one_piece_is_enough():
    assert integrate_pieces(np.exp, [0.3, 0.9]) == pytest.approx(np.exp(0.9) - np.exp(0.3), rel=1e-15)


def test_constants_are_functions():
    assert integrate_periodic(lambda x: 3.0, 2.0) == 6.0
    np.testing.assert_allclose(cumulative_integral(lambda x: 3.0, [0, 1, 4]), [0, 3, 12], rtol=1e-15)


def test_descending_breaks_are_refused():
    with pytest.raises(InputError, match="ascending"):
        integrate_pieces(np.cos, [1, 0])


@pytest.mark.parametrize("count", [2, 3, 4, 7, 10, 41])
def test_simpson_over_samples_is_scipys(count):
    rng = np.random.default_rng(count)
    x, y = np.cumsum(rng.uniform(0.1, 2, count)), rng.normal(size=(count, 3))
    got = cumulative_simpson(y, x)
    if count > 2:
        # SciPy lays its parabolas the same way but for the last interval of an even count, for which it takes the last three as well.
        np.testing.assert_allclose(got, scipy.integrate.cumulative_simpson(y, x=x, axis=0, initial=0.0), rtol=1e-12, atol=1e-13)
    np.testing.assert_allclose(trapezoid(y, x), scipy.integrate.trapezoid(y, x, axis=0), rtol=1e-13)
    assert got.shape == y.shape and np.all(got[0] == 0)


def test_simpson_over_samples_is_exact_for_parabolas_and_on_even_steps_for_cubics():
    x = np.array([0.0, 0.3, 1.0, 1.1, 2.5, 4.0])
    np.testing.assert_allclose(cumulative_simpson(3 * x**2 - 2 * x + 1, x), x**3 - x**2 + x, rtol=1e-13, atol=1e-14)
    even = np.linspace(0, 4, 9)
    np.testing.assert_allclose(cumulative_simpson(4 * even**3, even)[::2], even[::2] ** 4, rtol=1e-13, atol=1e-13)
    np.testing.assert_allclose(cumulative_simpson(np.array([1.0, 3.0]), np.array([0.0, 2.0])), [0.0, 4.0])
