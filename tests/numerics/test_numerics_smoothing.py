"""The smoothest curve within a band: the band itself, the conditions of an optimum, another optimiser, limits, scaling."""

import numpy as np
import pytest
from scipy.interpolate import make_interp_spline
from scipy.optimize import minimize

from drivewright.errors import InputError
from drivewright.numerics.smoothing import smoothest_within

TURN = 2 * np.pi
ENDS = {True: "periodic", False: ([(1, 0.0), (2, 0.0)],) * 2}


def law(x):
    """A lift that stands still at its ends, and its third derivative."""
    u = x / TURN
    return 1e-2 * (u - np.sin(TURN * u) / TURN), 1e-2 * np.cos(x) / TURN


def rounded(n, digit, rise=True):
    x = np.linspace(0, TURN, n)
    y = law(x)[0] if rise else 5e-3 * (1 - np.cos(x)) + 1e-3 * np.sin(3 * x)
    return x, np.round(y / digit) * digit


def bending(spline, x):
    """int (s''')^2 dx by Gauss's rule between the points."""
    node, weight = np.polynomial.legendre.leggauss(5)
    width = np.diff(x)[:, None]
    return float(np.sum(0.5 * width * weight * spline(x[:-1, None] + 0.5 * width * (1 + node), nu=3) ** 2))


@pytest.mark.property
@pytest.mark.parametrize("periodic", [True, False])
@pytest.mark.parametrize("n", [13, 91, 721])
def test_within_the_band_everywhere_and_smoother_than_the_interpolant(n, periodic):
    digit = 1e-5
    x, y = rounded(n, digit, rise=not periodic)
    smooth = smoothest_within(x, y, 0.5 * digit, periodic)
    through = make_interp_spline(x, y, 5, bc_type=ENDS[periodic])
    assert np.max(np.abs(smooth(x) - y)) <= 0.5 * digit
    assert bending(smooth, x) < bending(through, x)
    if periodic:
        start, end = ([float(smooth(place, nu=k)) for k in range(5)] for place in (0.0, TURN))
        assert start == pytest.approx(end, rel=1e-6, abs=1e-9)
    else:
        assert smooth(np.array([0.0, TURN])) == pytest.approx(y[[0, -1]], abs=1e-17)
        assert [float(smooth(end, nu=k)) for end in (0.0, TURN) for k in (1, 2)] == pytest.approx([0] * 4, abs=1e-11)


@pytest.mark.analytical
def test_the_jerk_comes_back():
    """Rows of a known law, printed to 10 um: the jerk of the spline through them is off by a multiple of itself, the smoothest is right."""
    x, y = rounded(721, 1e-5, rise=False)
    inside = np.linspace(0, TURN, 4001)
    true = -5e-3 * np.sin(inside) - 27e-3 * np.cos(3 * inside)
    smooth, through = smoothest_within(x, y, 0.5e-5, True), make_interp_spline(x, y, 5, bc_type="periodic")
    size = np.sqrt(np.mean(true**2))
    assert np.sqrt(np.mean((smooth(inside, nu=3) - true) ** 2)) < 0.02 * size
    assert np.sqrt(np.mean((through(inside, nu=3) - true) ** 2)) > 100 * size


@pytest.mark.analytical
@pytest.mark.parametrize("periodic", [True, False])
def test_conditions_of_an_optimum(periodic):
    """The fifth derivative jumps only where a row holds the curve, and there with the sign of a force that pulls it back."""
    digit = 2e-4
    x, y = rounded(25, digit, rise=not periodic)
    smooth = smoothest_within(x, y, 0.5 * digit, periodic)
    inner = np.arange(1, len(x) - 1)
    left, right = (smooth(0.5 * (x[inner] + x[inner + side]), nu=5) for side in (-1, 1))
    jump, off = right - left, (smooth(x[inner]) - y[inner]) / (0.5 * digit)
    size = np.max(np.abs(jump))
    free = np.abs(off) < 0.999
    assert np.any(free) and np.any(~free)
    assert np.abs(jump[free]) == pytest.approx(0, abs=1e-4 * size)
    # d/ds of int (s''')^2 is -2 s^(6): a positive jump of s^(5) asks for a smaller s, which the band allows on its upper edge alone.
    assert np.all(jump[~free] * off[~free] > 0)


@pytest.mark.analytical
def test_another_optimiser():
    """The values at few points varied by scipy, the integral of the interpolating spline through them as the objective."""
    digit = 1e-3
    x, y = rounded(9, digit)

    def spline(inner):
        return make_interp_spline(x, np.concatenate([y[:1], y[1:-1] + digit * inner, y[-1:]]), 5, bc_type=ENDS[False])

    scale = bending(spline(np.zeros(7)), x)
    found = minimize(lambda inner: bending(spline(inner), x) / scale, np.zeros(7), bounds=[(-0.5, 0.5)] * 7, method="L-BFGS-B", tol=1e-14)
    smooth = smoothest_within(x, y, 0.5 * digit, False)
    assert bending(smooth, x) / scale == pytest.approx(found.fun, rel=1e-5)
    assert (smooth(x) - y)[1:-1] / digit == pytest.approx(found.x, abs=5e-3)


@pytest.mark.property
def test_wide_and_narrow_bands():
    x, y = rounded(37, 1e-5, rise=False)
    wide = smoothest_within(x, y, 1.0, True)
    assert bending(wide, x) < 1e-9
    narrow, through = smoothest_within(x, y, 1e-10, True), make_interp_spline(x, y, 5, bc_type="periodic")
    assert narrow(x, nu=3) == pytest.approx(through(x, nu=3), abs=1e-4 * np.max(np.abs(through(x, nu=3))))


@pytest.mark.property
def test_rescaled_and_uneven():
    x, y = rounded(61, 1e-5, rise=False)
    uneven = np.delete(np.arange(61), [5, 6, 20, 33])
    x, y = x[uneven], y[uneven]
    first, other = smoothest_within(x, y, 0.5e-5, True), smoothest_within(40 * x, 1e3 * y, 0.5e-2, True)
    assert np.max(np.abs(first(x) - y)) <= 0.5e-5
    places = np.linspace(0, TURN, 50)
    assert 1e3 * first(places) == pytest.approx(other(40 * places), abs=1e-7)


@pytest.mark.error
def test_refusals():
    x, y = rounded(9, 1e-4)
    with pytest.raises(InputError, match="the band is 0; it must be above 0"):
        smoothest_within(x, y, 0.0, False)
    with pytest.raises(InputError, match="5 points are too few; give at least 6"):
        smoothest_within(x[:5], y[:5], 1e-5, False)
