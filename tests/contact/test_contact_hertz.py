"""Hertz contacts, checked by integrating what the pressure does: a route without elliptic integrals."""

import numpy as np
import pytest
from scipy.special import ellipe, ellipk

from drivewright import contact
from drivewright.contact.hertz import axis_ratio
from drivewright.numerics.quadrature import integrate_periodic, integrate_pieces

pytestmark = pytest.mark.analytical

STEEL = contact.effective_modulus(210e9, 0.3, 210e9, 0.3)
FORCE, LENGTH, RADIUS = 1300.0, 0.017, 0.0083


def test_effective_modulus_of_unequal_bodies():
    assert contact.effective_modulus(210e9, 0.3, 210e9, 0.3) == pytest.approx(210e9 / (2 * 0.91), rel=1e-15)
    assert contact.effective_modulus(210e9, 0.3, 1e30, 0.1) == pytest.approx(210e9 / 0.91, rel=1e-12)
    assert contact.effective_modulus(210e9, 0.25, 3e9, 0.4) == pytest.approx(1 / (0.9375 / 210e9 + 0.84 / 3e9), rel=1e-15)


def test_effective_radius_of_plane_and_hollow():
    assert contact.effective_radius(0.01, np.inf) == pytest.approx(0.01, rel=1e-15)
    assert contact.effective_radius(0.01, -0.0102) == pytest.approx(0.51, rel=1e-12)
    assert contact.effective_radius(7.0, np.inf) == 7.0


# ---------------------------------------------------------------------------------------------------------------- line


def test_line_pressure_carries_the_force():
    b, p0 = contact.line_contact(FORCE, LENGTH, RADIUS, STEEL)
    assert integrate_pieces(lambda u: p0 * np.cos(u) ** 2 * b, [-np.pi / 2, np.pi / 2]) * LENGTH == pytest.approx(FORCE, rel=1e-13)


def test_line_pressure_bends_the_surface_to_the_profile():
    # The slope of a half-plane under p(s) is -2/(pi E*) PV of the integral p(s)/(x - s) ds; under Hertz it must be -x/R.
    b, p0 = contact.line_contact(FORCE, LENGTH, RADIUS, STEEL)
    x = 0.37 * b
    p = lambda s: p0 * np.sqrt(np.maximum(1 - (s / b) ** 2, 0))  # noqa: E731
    # Symmetric about x up to the nearer edge, the principal value is a plain integral of (p(x - r) - p(x + r))/r.
    # With r = (b - x)(1 - q^2) the root of p at the edge does no harm.
    both = lambda r: p(x - (b - x) * r) - p(x + (b - x) * r)  # noqa: E731
    near = integrate_pieces(lambda q: both(1 - q**2) / (1 - q**2) * 2 * q, [0, 0.5, 0.9, 1], 60)
    far = integrate_pieces(lambda u: p0 * np.cos(u) ** 2 * b / (x - b * np.sin(u)), [-np.pi / 2, np.arcsin((2 * x - b) / b)], 60)
    assert 2 / (np.pi * STEEL) * (near + far) == pytest.approx(x / RADIUS, rel=1e-6)


def test_line_scaling():
    b, p0 = contact.line_contact(FORCE, LENGTH, RADIUS, STEEL)
    assert contact.line_contact(4 * FORCE, LENGTH, RADIUS, STEEL) == pytest.approx((2 * b, 2 * p0), rel=1e-14)
    in_mm = contact.line_contact(FORCE, LENGTH * 1e3, RADIUS * 1e3, STEEL * 1e-6)
    assert in_mm == pytest.approx((b * 1e3, p0 * 1e-6), rel=1e-14)


def half_plane_stress(z, p0=1.0, b=1.0):
    """Stresses across and along the depth z below the middle, by summing Flamant's line loads over the pressure."""

    def stress(u):
        s, load = b * np.sin(u), p0 * np.cos(u) ** 2 * b
        return -2 * z / np.pi * load / (s**2 + z**2) ** 2 * np.array([s**2, 0 * s + z**2])

    return integrate_pieces(stress, np.linspace(-np.pi / 2, np.pi / 2, 9), 40)


def test_subsurface_shear_is_half_the_stress_difference():
    for z in (0.2, 0.786, 1.7):
        across, down = half_plane_stress(z)
        assert contact.line_shear(z) == pytest.approx(abs(across - down) / 2, rel=1e-9)
        assert min(across, down) <= 0.3 * (across + down) <= max(across, down) or z < 0.5


def test_greatest_shear_is_the_known_one():
    depth, shear = contact.line_greatest_shear()
    assert (round(depth, 3), round(shear, 3)) == (0.786, 0.300)
    assert 1 - depth * (2 + depth**2) / (1 + depth**2) ** 1.5 == pytest.approx(0, abs=1e-7)  # its derivative


def test_cylinder_compression_is_the_integral_of_the_strain():
    # Stresses down the axis of a disc pressed between p over 2b and the opposite point load: two half-planes and the
    # uniform tension F/(pi R L) that frees the rim.
    nu, modulus = 0.28, 205e9
    b = contact.line_contact(FORCE, LENGTH, RADIUS, STEEL).half_width
    p0, load = 2 * FORCE / (np.pi * b * LENGTH), FORCE / LENGTH

    def strain(depths):
        across, down = np.array([half_plane_stress(z, p0, b) for z in depths]).T
        across, down = across + load / (np.pi * RADIUS), down + load / (np.pi * RADIUS) - 2 * load / (np.pi * (2 * RADIUS - depths))
        return (1 - nu**2) / modulus * (down - nu / (1 - nu) * across)

    breaks = np.concatenate([[0.0], b * np.geomspace(0.05, RADIUS / b, 12)])
    integral = -integrate_pieces(strain, breaks, 8)
    assert contact.cylinder_compression(FORCE, LENGTH, b, RADIUS, modulus, nu) == pytest.approx(integral, rel=2e-4)


# --------------------------------------------------------------------------------------------------------------- point


def test_sphere_is_exact():
    point = contact.point_contact(FORCE, (RADIUS, RADIUS), STEEL)
    a = np.cbrt(3 * FORCE * RADIUS / (4 * STEEL))
    assert point == pytest.approx((a, a, 3 * FORCE / (2 * np.pi * a**2), a**2 / RADIUS), rel=1e-14)
    assert contact.point_constant((RADIUS, RADIUS), STEEL) == pytest.approx(4 / 3 * STEEL * np.sqrt(RADIUS), rel=1e-14)


@pytest.mark.parametrize("ratio", [1.0, 1.37, 4.0, 60.0])
def test_pressure_presses_the_surfaces_flat(ratio):
    """Displacements by Boussinesq, in polar coordinates about the point: at the middle and at both vertices."""
    radii = np.array([ratio, 1.0]) * RADIUS
    a, b, p0, approach = contact.point_contact(FORCE, radii, STEEL)
    assert 2 / 3 * np.pi * a * b * p0 == pytest.approx(FORCE, rel=1e-14)
    curvature = lambda angle: np.cos(angle) ** 2 / a**2 + np.sin(angle) ** 2 / b**2  # noqa: E731
    middle = p0 / (4 * STEEL) * integrate_periodic(lambda angle: curvature(angle) ** -0.5, 2 * np.pi, 4000)
    assert middle == pytest.approx(approach, rel=1e-12)
    # From a vertex the chord at `angle` to the inward normal is 2 cos/(axis c), the pressure along it a half-circle.
    at_major = p0 / (8 * STEEL) * integrate_periodic(lambda t: 2 * np.cos(t) ** 2 / a**2 * curvature(t) ** -1.5, 2 * np.pi, 4000)
    at_minor = p0 / (8 * STEEL) * integrate_periodic(lambda t: 2 * np.sin(t) ** 2 / b**2 * curvature(t) ** -1.5, 2 * np.pi, 4000)
    assert at_major == pytest.approx(approach - a**2 / (2 * radii[0]), rel=1e-9)
    assert at_minor == pytest.approx(approach - b**2 / (2 * radii[1]), rel=1e-9)


def test_axis_ratio_solves_the_equation_with_legendre_integrals():
    ratio = np.array([1.2, 3.0, 50.0])
    x = axis_ratio(ratio)
    k, e = ellipk(1 - x**2), ellipe(1 - x**2)
    np.testing.assert_allclose((e / x**2 - k) / (k - e), ratio, rtol=1e-12)


def test_a_long_ellipse_becomes_a_line():
    a, b, p0, _ = contact.point_contact(FORCE, (1e6 * RADIUS, RADIUS), STEEL)
    # In the middle section the load per length is pi/2 p0 b, as under a line of that load.
    line = contact.line_contact(np.pi / 2 * p0 * b, 1.0, RADIUS, STEEL)
    assert (b, p0) == pytest.approx(tuple(line), rel=1e-5)


def test_point_scaling():
    radii = np.array([3.0, 1.0]) * RADIUS
    one, two = contact.point_contact(FORCE, radii, STEEL), contact.point_contact(8 * FORCE, radii, STEEL)
    np.testing.assert_allclose(two, np.array(one) * [2, 2, 2, 4], rtol=1e-13)
    in_mm = contact.point_contact(FORCE, radii * 1e3, STEEL * 1e-6)
    np.testing.assert_allclose(in_mm, np.array(one) * [1e3, 1e3, 1e-6, 1e3], rtol=1e-13)
    assert contact.point_constant(radii, STEEL) * one.approach**1.5 == pytest.approx(FORCE, rel=1e-13)


def test_arrays_go_through():
    many = contact.point_contact(np.array([[1.0], [FORCE]]), (np.array([1.0, 2.0]) * RADIUS, RADIUS), STEEL)
    assert many.major.shape == (2, 2)
    assert many.major[1, 1] == pytest.approx(contact.point_contact(FORCE, (2 * RADIUS, RADIUS), STEEL).major, rel=1e-15)


def test_relative_radii_from_the_gap_itself():
    (r1, s1), (r2, s2), angle = (0.03, -0.2), (0.05, 0.02), 0.6
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    curvatures = np.linalg.eigvalsh(np.diag([1 / r1, 1 / s1]) + turn @ np.diag([1 / r2, 1 / s2]) @ turn.T)
    np.testing.assert_allclose(contact.relative_radii((r1, s1), (r2, s2), angle), 1 / curvatures, rtol=1e-12)


def test_crossed_equal_cylinders_are_a_sphere_on_a_plane():
    radii = contact.relative_radii((RADIUS, np.inf), (RADIUS, np.inf), np.pi / 2)
    np.testing.assert_allclose(radii, RADIUS, rtol=1e-12)


def test_rollers_with_parallel_axes_and_crowns():
    radii = contact.relative_radii((0.01, 3.0), (0.02, 4.0))
    assert radii == pytest.approx((1 / (1 / 3 + 1 / 4), 1 / 150), rel=1e-12)
    slender = contact.relative_radii((1e-5, 1e5), (np.inf, np.inf))  # nearly a line, but still a point
    assert slender == pytest.approx((1e5, 1e-5), rel=1e-5)


def test_a_ball_in_a_groove():
    larger, smaller = contact.relative_radii((0.004, 0.004), (-0.00416, 0.02))
    assert (larger, smaller) == pytest.approx((1 / (1 / 0.004 - 1 / 0.00416), 1 / (1 / 0.004 + 1 / 0.02)), rel=1e-12)
