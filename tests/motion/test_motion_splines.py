"""Splines and tables reproduce a sampled smooth motion at the order of their degree; the ripple check knows rounded data."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from drivewright.motion import Programme, Segment, law

pytestmark = pytest.mark.order

FINE = np.linspace(0, 1, 3001)


def periodic_motion(u):
    return 0.01 * np.exp(0.5 * np.sin(2 * np.pi * u + 0.4))


def uneven(n):
    """Rows that crowd in places, so that no symmetry of the grid helps."""
    u = np.linspace(0, 1, n + 1)
    return u + 0.03 * np.sin(2 * np.pi * u)


def slope(counts, errors):
    return -np.polyfit(np.log(counts), np.log(errors), 1)[0]


@pytest.mark.parametrize("degree", [3, 5])
def test_periodic_table_converges_at_its_order(degree):
    counts, errors = np.array([60, 80, 110, 150, 200, 270]), []
    for n in counts:
        u = uneven(n)
        table = law("table", angle=2 * np.pi * u, lift=periodic_motion(u), degree=degree)
        errors.append(np.max(np.abs(table(FINE).s - periodic_motion(FINE))))
    assert abs(slope(counts, errors) - (degree + 1)) < 0.1


@pytest.mark.parametrize(("degree", "part", "order"), [(3, "s", 4), (3, "a", 2), (5, "s", 6), (5, "a", 4)])
def test_clamped_spline_converges_at_its_order(degree, part, order):
    smooth = law("cycloidal")
    counts, errors = np.array([30, 40, 60, 80, 120, 170]), []
    for n in counts:
        u = uneven(n)
        spline = law("spline", points=np.column_stack([u, smooth(u).s]), degree=degree)
        errors.append(np.max(np.abs(getattr(spline(FINE), part) - getattr(smooth(FINE), part))))
    assert abs(slope(counts, errors) - order) < 0.1


@pytest.mark.parametrize("degree", [3, 5])
@pytest.mark.parametrize("ends", ["periodic", "clamped"])
def test_a_spline_goes_through_its_points_and_is_smooth_at_them(degree, ends):
    u = uneven(9)
    s = periodic_motion(u) if ends == "periodic" else law("double-harmonic")(u).s
    s[-1] = s[0] if ends == "periodic" else 1.0
    spline = law("spline", points=np.column_stack([u, s]), degree=degree, ends=ends)
    assert_allclose(spline(u).s, s, atol=1e-14)
    assert_allclose(spline.breaks, u, atol=1e-15)
    expected = {("periodic", 3): 2, ("periodic", 5): 4, ("clamped", 3): 1, ("clamped", 5): 2}  # clamped: against the standstill before
    assert spline.continuity == expected[ends, degree]


def table(motion, rows, digits=None, span=2 * np.pi):
    u = np.linspace(0, 1, rows + 1)
    lift = 0.02 * (motion(u) if digits is None else np.round(motion(u), digits))
    return law("table", angle=span * u, lift=lift)


def rise_and_return(u):
    programme = Programme(
        [Segment(2.0, "cycloidal", 1.0), Segment(1.0, "dwell"), Segment(2.2, "polynomial-345", -1.0), Segment(2 * np.pi - 5.2, "dwell")]
    )
    return programme(2 * np.pi * u).s


@pytest.mark.parametrize("rows", [12, 24, 36, 72, 180, 360])
@pytest.mark.parametrize("motion", [lambda u: 0.5 - 0.5 * np.cos(2 * np.pi * u), rise_and_return])
def test_no_ripple_in_a_smooth_table(motion, rows):
    ripple = table(motion, rows).ripple
    assert not ripple.significant and ripple.message == ""


@pytest.mark.parametrize(("rows", "digits"), [(72, 2), (180, 3), (360, 3), (360, 4)])
def test_ripple_in_a_table_rounded_to_few_digits(rows, digits):
    """Rounding to r scatters the rows by r/sqrt(12); most of it must be seen, and the sentence must say so."""
    ripple = table(rise_and_return, rows, digits).ripple
    scatter = 0.02 * 10.0**-digits / np.sqrt(12)
    assert ripple.significant and 0.3 * scatter < ripple.scatter < 1.2 * scatter
    assert "more digits" in ripple.message and f"{ripple.acceleration:.0%}" in ripple.message


def test_ripple_of_a_table_over_part_of_a_turn():
    rise = law("polynomial-4567")
    assert not table(lambda u: rise(u).s, 60, span=2.0).ripple.significant
    assert table(lambda u: rise(u).s, 120, digits=2, span=2.0).ripple.significant


def test_a_table_that_never_moves_has_no_ripple():
    assert table(lambda u: 0 * u, 12).ripple.acceleration == 0
