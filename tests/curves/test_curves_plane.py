"""Tangent, curvature, offset and envelopes against circles, ellipses and direct differentiation."""

import numpy as np
import pytest

from drivewright import curves
from drivewright.errors import InputError
from drivewright.numerics.jets import Jet, cos, exp, sin, variable

pytestmark = pytest.mark.analytical

T = np.linspace(0.3, 5.9, 41)


def ellipse(t, a=0.05, b=0.02):
    t = variable(t)
    return a * cos(t) + 1j * b * sin(t)


def test_curvature_of_an_ellipse_and_its_sign():
    expected = 0.05 * 0.02 / ((0.05 * np.sin(T)) ** 2 + (0.02 * np.cos(T)) ** 2) ** 1.5
    np.testing.assert_allclose(curves.curvature(ellipse(T)), expected, rtol=1e-13)
    np.testing.assert_allclose(curves.curvature(ellipse(T).conj()), -expected, rtol=1e-13)


def test_curvature_rate_is_the_derivative_along_the_arc():
    a, b = 0.05, 0.02
    speed = np.hypot(a * np.sin(T), b * np.cos(T))
    expected = -3 * a * b * (a**2 - b**2) * np.sin(T) * np.cos(T) / speed**6
    np.testing.assert_allclose(curves.curvature_rate(ellipse(T)), expected, rtol=1e-11, atol=1e-9)


def test_tangent_and_normal_of_a_circle():
    circle = 3.0 * exp(2j * variable(T))
    np.testing.assert_allclose(curves.tangent(circle).d0, 1j * np.exp(2j * T), rtol=1e-14)
    np.testing.assert_allclose(curves.normal(circle).d0, -np.exp(2j * T), rtol=1e-14)
    np.testing.assert_allclose(curves.normal(circle).d2, 4 * np.exp(2j * T), rtol=1e-13)
    assert np.isnan(curves.tangent(circle).d3).all()


@pytest.mark.parametrize("distance", [0.003, -0.004])
def test_offset_is_the_parallel_curve(distance):
    """kappa/(1 - d kappa) is the curvature of the parallel curve and |q - z| its distance."""
    base = ellipse(T)
    moved = curves.offset(base, distance)
    bend = curves.curvature(base)
    np.testing.assert_allclose(np.abs(moved.d0 - base.d0), abs(distance), rtol=1e-13)
    np.testing.assert_allclose(moved.d1, base.d1 * (1 - distance * bend), rtol=1e-12)
    np.testing.assert_allclose(curves.curvature(moved), bend / (1 - distance * bend), rtol=1e-10)


def test_offset_of_a_circle_to_the_left_is_smaller():
    circle = 3.0 * exp(1j * variable(T))
    np.testing.assert_allclose(np.abs(curves.envelope_of_circle(circle, 0.5, +1).d0), 2.5, rtol=1e-14)
    np.testing.assert_allclose(np.abs(curves.envelope_of_circle(circle, 0.5, -1).d0), 3.5, rtol=1e-14)


def test_envelope_of_line_gives_the_curve_of_its_tangents():
    """Support function of an ellipse: p = sqrt(a^2 cos^2 + b^2 sin^2); contact (a^2 cos, b^2 sin)/p, with beta(t) not t."""
    a, b = 0.05, 0.02
    t = variable(T)
    direction = t + 0.3 * sin(t)
    support = (a**2 * cos(direction) ** 2 + b**2 * sin(direction) ** 2) ** 0.5
    contact = curves.envelope_of_line(direction, support)
    expected = (a**2 * cos(direction) + 1j * b**2 * sin(direction)) / support
    for ours, theirs in zip(list(contact)[:3], expected, strict=False):
        np.testing.assert_allclose(ours, theirs, rtol=1e-11, atol=1e-14)


def test_a_line_that_only_translates_is_refused():
    still = Jet(np.ones(3), np.array([1.0, 0.0, 1.0]), np.zeros(3), np.zeros(3))
    with pytest.raises(InputError, match="does not turn at 1 of 3 points"):
        curves.envelope_of_line(still, variable(np.ones(3)))


def test_a_rest_has_no_tangent():
    with pytest.raises(InputError, match=r"tangent: the curve does not move .* at 1 of 3 points, first at \(0, 2\) m"):
        curves.tangent(variable(np.array([-1.0, 0.0, 1.0])) ** 2 + 2j)
