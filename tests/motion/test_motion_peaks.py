"""Peaks and shapes of the classical motion laws against published numbers and closed forms."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from drivewright.motion import law

pytestmark = pytest.mark.analytical

PI = math.pi

# (law, Vm, Am, Jm, (AV)m) as handbooks and catalogues print them (recalled; every row is verified by a closed form below).
PUBLISHED = [
    ("modified-sine", "1.76", "5.53", "69.47", "5.46"),
    ("modified-trapezoid", "2.00", "4.89", "61.43", "8.09"),
    ("cycloidal", "2.00", "6.28", "39.5", "8.16"),
    ("mcv50", "1.28", "8.01", "201.4", "5.73"),
    ("simple-harmonic", "1.5708", "4.9348", "inf", "3.88"),
    ("parabolic", "2.00", "4.00", "inf", "8.00"),
    ("polynomial-345", "1.875", "5.7735", "60.0", "6.69"),
    ("polynomial-4567", "2.1875", "7.5132", "52.5", "10.75"),
    ("constant-velocity", "1.00", "inf", "inf", "inf"),
]

# The same to machine precision.  Stationary points: cycloid a v ~ sin x (1 - cos x) at 120 deg; polynomials in w = 1 - 2u.
CLOSED = {
    "cycloidal": (2, 2 * PI, 4 * PI**2, 2 * PI * 3 * math.sqrt(3) / 4),
    "simple-harmonic": (PI / 2, PI**2 / 2, math.inf, PI**3 / 8),
    "parabolic": (2, 4, math.inf, 8),
    "modified-sine": (4 * PI / (4 + PI), 4 * PI**2 / (4 + PI), 16 * PI**3 / (4 + PI), None),
    "modified-trapezoid": (2, 8 * PI / (2 + PI), 32 * PI**2 / (2 + PI), None),
    "polynomial-345": (15 / 8, 10 / math.sqrt(3), 60, None),
    "polynomial-4567": (35 / 16, 84 * math.sqrt(5) / 25, 52.5, None),
    "polynomial-56789": (315 / 128, 2520 / 64 * (6 / 7) ** 3 / math.sqrt(7), 78.75, None),
    "double-harmonic": (PI * 3 * math.sqrt(3) / 8, PI**2, math.inf, None),
}


@pytest.mark.parametrize(("name", *"vajp"), PUBLISHED)
def test_published_peaks(name, v, a, j, p):
    for printed, ours in zip((v, a, j, p), law(name).peaks(), strict=True):
        half_a_digit = 0.5 * 10.0 ** -len(printed.partition(".")[2])
        assert float(printed) == ours or abs(float(printed) - ours) <= half_a_digit


@pytest.mark.parametrize("name", CLOSED)
def test_peaks_in_closed_form(name):
    for exact, ours in zip(CLOSED[name], law(name).peaks(), strict=True):
        if exact is not None:
            assert_allclose(ours, exact, rtol=1e-13)


def test_crossover_jerk_of_the_modified_sine():
    assert_allclose(law("modified-sine").on_piece(1, 0.5).j, -16 * PI**3 / (4 + PI) / 3, rtol=1e-13)
    assert_allclose(law("modified-sine").on_piece(1, 0.5).j, -23.155452, atol=5e-7)


@pytest.mark.parametrize(("name", "power"), [("polynomial-345", 1), ("polynomial-4567", 2), ("polynomial-56789", 3)])
def test_torque_factor_of_a_polynomial_from_the_roots_of_its_slope(name, power):
    u = np.polynomial.Polynomial([0, 1])
    a = (u * (1 - u)) ** power * (1 - 2 * u)
    v = a.integ()
    size = v.integ()(1)
    product = a * v / size**2
    stationary = product.deriv().roots()
    stationary = stationary[abs(stationary.imag) < 1e-3].real
    assert_allclose(law(name).peaks().AVm, np.max(np.abs(product(stationary[(stationary > 0) & (stationary < 1)]))), rtol=1e-9)


@pytest.mark.parametrize(
    ("b", "c", "d"), [(0.25, 0, 0.75), (0.25, 0.5, 0.25), (0.1, 0.2, 0.7), (0.6, 0.3, 0.1), (0.5, 0, 0.5), (0.3, 0.7, 0)]
)
def test_scca_factors(b, c, d):
    """Ca, Cv, Cj of the sine-constant-cosine family (Norton; recalled)."""
    Ca = 4 * PI**2 / ((PI**2 - 8) * (b**2 - d**2) - 2 * PI * (PI - 2) * b + PI**2)
    Cv = Ca * ((b + d) / PI + c / 2)
    this = law("scca", b=b, c=c, d=d)
    if d > 0:
        assert_allclose(this.peaks()[:3], (Cv, Ca, max(Ca * PI / b, Ca * PI / d)), rtol=1e-12)
        assert_allclose(this(0.5).j, -Ca * PI / d, rtol=1e-12)
    else:
        assert_allclose(this.peaks()[:3], (Cv, Ca, math.inf), rtol=1e-12)
    assert_allclose(this(0.0).j, Ca * PI / b, rtol=1e-12)


@pytest.mark.parametrize(("name", "c"), [("mcv50", 1 / 2), ("mcv33", 1 / 3), ("mcv20", 1 / 5)])
def test_modified_constant_velocity_factors(name, c):
    """Sine over r, cosine over 3r: full speed is 8 r A/pi; both ends and c at full speed cover 1."""
    r = (1 - c) / 8
    way = 2 * r / PI * (r - 2 * r / PI) + 2 * r / PI * 3 * r + (6 * r / PI) ** 2  # of one end, for A = 1
    A = 1 / (2 * way + 8 * r / PI * c)
    peaks = law(name).peaks()
    assert_allclose(peaks[:3], (8 * r / PI * A, A, A * PI / (2 * r)), rtol=1e-12)
    assert_allclose(law(name)(4 * r).s, A * way, rtol=1e-12)
    assert_allclose(law(name)(0.5 + 0.4 * c)[1:], (peaks.Vm, 0, 0), atol=1e-11)


def modified_sine(t):
    """The three branches as textbooks print them, k = 1/(4 + pi)."""
    k = 1 / (4 + PI)
    if 1 / 8 <= t <= 7 / 8:
        x = 4 * PI * t / 3 + PI / 3
        return k * (2 + PI * t - 9 / 4 * math.sin(x)), k * PI * (1 - 3 * math.cos(x)), 4 * PI**2 * k * math.sin(x)
    x = 4 * PI * t
    return k * ((0 if t < 1 / 8 else 4) + PI * t - math.sin(x) / 4), k * PI * (1 - math.cos(x)), 4 * PI**2 * k * math.sin(x)


@pytest.mark.parametrize("t", [0, 0.05, 0.124, 0.126, 0.3, 0.5, 0.71, 0.874, 0.876, 0.97, 1])
def test_modified_sine_is_the_textbook_one(t):
    assert_allclose(law("modified-sine")(t)[:3], modified_sine(t), rtol=0, atol=1e-14 * 6)


def test_an_index_of_twelve_by_the_modified_sine():
    """One pitch of 30 deg in half a turn of the crank: wheel angle and its slope at four crank angles."""
    motion = law("modified-sine")(np.radians([22.5, 45, 67.5, 90]) / PI)
    assert_allclose(30 * motion.s, (0.599442, 3.515355, 8.624535, 15.0), atol=5e-7)
    assert_allclose(motion.v / 6, (0.07331681, 0.18329202, 0.26379946, 0.29326723), atol=5e-9)


TWINS = [
    ("scca", {"b": 0.25, "c": 0, "d": 0.75}, "modified-sine"),
    ("scca", {"b": 0.25, "c": 0.5, "d": 0.25}, "modified-trapezoid"),
    ("scca", {"b": 0.5, "c": 0, "d": 0.5}, "cycloidal"),
    ("scca", {"b": 0, "c": 1, "d": 0}, "parabolic"),
    ("scca", {"b": 0, "c": 0, "d": 1}, "simple-harmonic"),
    ("mcv", {"c": 0}, "modified-sine"),
    ("mcv", {"c": 1 / 3}, "mcv33"),
    ("polynomial", {}, "polynomial-345"),
    ("polynomial", {"start": (0,) * 3, "end": (0,) * 3}, "polynomial-4567"),
    ("polynomial", {"start": (0,) * 4, "end": (0,) * 4}, "polynomial-56789"),
    ("polynomial", {"start": (), "end": ()}, "uniform"),
    ("spline", {"points": [(0, 0), (0.3, law("polynomial-345")(0.3).s), (1, 1)]}, "polynomial-345"),
]


@pytest.mark.parametrize(("name", "parameters", "twin"), TWINS)
def test_twins(name, parameters, twin):
    u = np.random.default_rng(7).uniform(0, 1, 50)
    for ours, other in zip(law(name, **parameters)(u), law(twin)(u), strict=True):
        assert_allclose(ours, other, rtol=0, atol=1e-12 * max(1, np.max(np.abs(other))))


def test_constant_velocity_part_shrinking_to_nothing_leaves_the_modified_sine():
    u = np.linspace(0, 1, 41)
    gaps = [np.max(np.abs(law("mcv", c=c)(u).s - law("modified-sine")(u).s)) for c in (1e-2, 1e-3, 1e-4)]
    assert_allclose(np.diff(np.log10(gaps)), -1, atol=0.02)


def test_polynomial_345_has_its_textbook_coefficients():
    u = np.array([0.1, 0.37, 0.92])
    s, v, a, j = law("polynomial-345")(u)
    assert_allclose(s, 10 * u**3 - 15 * u**4 + 6 * u**5, rtol=0, atol=1e-15)
    assert_allclose(v, 30 * u**2 - 60 * u**3 + 30 * u**4, rtol=1e-13)
    assert_allclose(a, 60 * u - 180 * u**2 + 120 * u**3, rtol=1e-12, atol=1e-13)
    assert_allclose(j, 60 - 360 * u + 360 * u**2, rtol=1e-12, atol=1e-12)


def test_polynomial_meets_any_conditions():
    start, end, interior = (0.3, -1.2, 4.0), (1.7, 2.0), [(0.37, 0, 0.6), (0.61, 1, 1.1), (0.8, 2, -0.5), (0.2, 3, 7.0)]
    this = law("polynomial", start=start, end=end, interior=interior)
    assert_allclose(this(0.0), (0, *start), atol=1e-11)
    assert_allclose(this(1.0)[:3], (1, *end), atol=1e-11)
    assert_allclose([this(u)[order] for u, order, _ in interior], [value for *_, value in interior], atol=1e-11)
    assert this.function.poly.shape == (1, 11)


def test_double_harmonic_is_half_the_difference_of_its_two_waves():
    u = np.linspace(0, 1, 23)
    s, v, a, j = law("double-harmonic")(u)
    assert_allclose(s, 0.5 * (1 - np.cos(PI * u) - 0.25 * (1 - np.cos(2 * PI * u))), atol=1e-15)
    assert_allclose(v, PI / 2 * (np.sin(PI * u) - 0.5 * np.sin(2 * PI * u)), atol=1e-14)
    assert_allclose(a, PI**2 / 2 * (np.cos(PI * u) - np.cos(2 * PI * u)), atol=1e-13)
    assert_allclose(j, PI**3 / 2 * (2 * np.sin(2 * PI * u) - np.sin(PI * u)), atol=1e-13)


def test_peaks_print_readably():
    assert str(law("scca", b=0.25, c=0, d=0.75).peaks()).startswith("Peaks(Vm=1.75960338595")
