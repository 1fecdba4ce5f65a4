"""Approaches of strips and of Hertz contacts, checked by integrating the strains under a line load down to a point in the depth."""

from functools import cache

import numpy as np
import pytest

from drivewright import contact
from drivewright.numerics.quadrature import integrate_pieces

pytestmark = pytest.mark.analytical

E, NU, DEPTH = 206e9, 0.27, 0.6
SIGMA, HALF_WIDTH = 8e-4, 5e-4  # a thousandth of the depth, beside which they must be small


@cache
def flamant(poisson):
    """(ln |x|, E times the shortening from the surface at x to the point at DEPTH under it, under 1 N/m at 0, in plane strain).

    sz = -2 z^3/(pi r^4), sx = -2 x^2 z/(pi r^4), E ez = (1 - nu^2) sz - nu (1 + nu) sx, summed up over z = |x| sinh t.
    """
    logarithms = np.linspace(np.log(1e-9), np.log(1e-2), 600)
    t = np.linspace(0.0, 1.0, 4001) * np.arcsinh(DEPTH / np.exp(logarithms))[:, None]
    x = np.exp(logarithms)[:, None]
    z, step = x * np.sinh(t), x * np.cosh(t)
    across, down = (-2 * size / (np.pi * (x**2 + z**2) ** 2) for size in (x**2 * z, z**3))
    strain = (1 - poisson**2) * down - poisson * (1 + poisson) * across
    return logarithms, -np.trapezoid(strain * step, t, axis=1)


def approach(x, poisson=NU):
    return np.interp(np.log(np.abs(x)), *flamant(poisson)) / E


def gaussian(x):
    return np.exp(-0.5 * (x / SIGMA) ** 2) / (SIGMA * np.sqrt(2 * np.pi))


def mean_over_strip(poisson=NU):
    """The mean of what the strip's load does, over the same strip: a double integral, its logarithm flattened by x = +-u^3."""
    ends = 7 * SIGMA
    node, weight = np.polynomial.legendre.leggauss(80)

    def surface(y):
        reach = np.cbrt(2 * ends)
        pull = lambda u: (gaussian(y + u**3) + gaussian(y - u**3)) * approach(u**3, poisson) * 3 * u**2  # noqa: E731
        return integrate_pieces(pull, np.linspace(1e-9, reach, 30), 20)

    return sum(ends * w * gaussian(ends * n) * surface(ends * n) for n, w in zip(node, weight, strict=True))


@pytest.mark.parametrize("poisson", [NU, 0.45])
def test_a_gaussian_strip_approaches_the_depth_by_the_mean_of_its_own_displacements(poisson):
    found = contact.gaussian_strip_approach(SIGMA, DEPTH, E, poisson)
    assert found == pytest.approx(mean_over_strip(poisson), rel=2e-5)


def test_a_hertz_contact_goes_on_from_the_strip():
    """The middle of a contact whose pressure is 2/(pi b) sqrt(1 - x^2/b^2), x = b sin^3 u, against the mean over the strip."""
    pressed = lambda s: 2 / (np.pi * HALF_WIDTH) * np.sqrt(1 - s**2)  # noqa: E731
    way = lambda u: 2 * pressed(u**3) * approach(HALF_WIDTH * u**3) * HALF_WIDTH * 3 * u**2  # noqa: E731
    middle = integrate_pieces(way, np.concatenate([np.linspace(1e-9, 0.9, 20), 1 - np.geomspace(0.1, 1e-9, 30)[1:]]), 20)
    found = contact.hertz_beyond_strip(SIGMA, HALF_WIDTH, E, NU)
    assert found == pytest.approx(middle - mean_over_strip(), rel=1e-4)


def test_a_narrow_strip_goes_deeper_than_a_wide_hertz_contact():
    assert contact.hertz_beyond_strip(SIGMA, 20 * SIGMA, E, NU) < 0 < contact.hertz_beyond_strip(SIGMA, SIGMA, E, NU)


def test_approaches_of_arrays_in_other_units():
    sigma = np.array([1.0, 2.5]) * SIGMA
    once = contact.gaussian_strip_approach(sigma, DEPTH, E, NU)
    assert contact.gaussian_strip_approach(1e3 * sigma, 1e3 * DEPTH, 1e-6 * E, NU) == pytest.approx(1e6 * once, rel=1e-14)
    assert contact.hertz_beyond_strip(1e3 * sigma, 0.4, 1e-6 * E, NU) == pytest.approx(
        1e6 * contact.hertz_beyond_strip(sigma, 4e-4, E, NU), rel=1e-13
    )
