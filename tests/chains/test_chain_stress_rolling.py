"""Rolling pins: Hertz numbers, stresses below the surface, first yield and shakedown, each from its definition."""

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from drivewright.chains.stress.rolling import equivalent, line_stresses, pressure_limits, rolling_contact
from drivewright.errors import InputError, UnknownName

pytestmark = pytest.mark.analytical

X, Z = np.meshgrid(np.linspace(-2, 2, 401), np.linspace(0.0, 2.0, 201))


@pytest.mark.parametrize(
    ("radius", "pressure", "half_width", "shear"), [(1.2e-3, 1414.77e6, 0.0150e-3, 424.8e6), (7.4e-3, 569.72e6, 0.03725e-3, 171.1e6)]
)
def test_pins_of_a_chain(radius, pressure, half_width, shear):
    """200 N over 6 mm of steel."""
    found = rolling_contact(200.0, 6e-3, (radius, radius), 206e9, 0.3)
    assert found.pressure == pytest.approx(pressure, rel=1e-5)
    assert found.half_width == pytest.approx(half_width, rel=2e-3)
    assert found.shear == pytest.approx(shear, rel=2e-3)
    assert found.depth == pytest.approx(0.786 * found.half_width, rel=1e-3)


def test_the_pressure_carries_the_force():
    found = rolling_contact(350.0, 7e-3, (1.1e-3, 2.3e-3), 206e9, 0.28)
    assert np.pi / 2 * found.pressure * found.half_width * 7e-3 == pytest.approx(350.0)


@pytest.mark.parametrize(("x", "z"), [(0.3, 0.5), (-0.8, 0.4), (1.5, 0.2), (0.0, 0.786), (-1.2, 1.7)])
def test_stresses_are_flamant_s_summed_over_the_pressure(x, z):
    at, step = np.linspace(-np.pi / 2, np.pi / 2, 4000, endpoint=False, retstep=True)  # over whole periods: no quadrature is better
    load = step * np.cos(at) ** 2
    away = x - np.sin(at)
    common = -2 / np.pi * load * z / (away**2 + z**2) ** 2
    summed = [(common * away**2).sum(), (common * z**2).sum(), (common * z * away).sum()]
    assert np.allclose(line_stresses(x, z), summed, rtol=0, atol=1e-9)


def test_the_surface_carries_the_pressure_and_nothing_else():
    x = np.linspace(-2.3, 2.3, 47)
    along, normal, shear = line_stresses(x, 0.0)
    assert np.allclose(normal, -np.sqrt(np.maximum(1 - x**2, 0)), atol=1e-7)
    assert np.allclose(along, normal, atol=1e-7)
    assert np.allclose(shear, 0, atol=1e-12)


@pytest.mark.parametrize(("criterion", "ratio"), [("tresca", 1.67), ("mises", 1.79)])
def test_first_yield(criterion, ratio):
    """Published ratios, and no place of the whole field yields below the limit while one does at it."""
    limit = pressure_limits(835e6, 0.3, criterion).first_yield
    assert limit / 835e6 == pytest.approx(ratio, abs=0.006)
    assert (limit * equivalent(line_stresses(X, Z), 0.3, criterion)).max() == pytest.approx(835e6, rel=1e-4)


@pytest.mark.parametrize("poisson", [0.05, 0.1, 0.15, 0.25, 0.4])
@pytest.mark.parametrize("criterion", ["tresca", "mises"])
def test_first_yield_for_any_poisson_s_ratio(criterion, poisson):
    worst = equivalent(line_stresses(X, Z), poisson, criterion).max()
    assert pressure_limits(1.0, poisson, criterion).first_yield == pytest.approx(1 / worst, rel=2e-3)


def test_equivalent_stress_is_that_of_the_full_tensor():
    rng = np.random.default_rng(5)
    for x, z, xz in rng.normal(size=(20, 3)):
        tensor = np.array([[x, 0, xz], [0, 0.3 * (x + z), 0], [xz, 0, z]])
        principal = np.linalg.eigvalsh(tensor)
        deviator = tensor - np.trace(tensor) / 3 * np.eye(3)
        assert equivalent((x, z, xz), 0.3, "tresca") == pytest.approx(np.ptp(principal))
        assert equivalent((x, z, xz), 0.3, "mises") == pytest.approx(np.sqrt(1.5 * np.sum(deviator**2)))


def tamed(pressure, z):
    """Least over the residual stress sx(z) of the greatest shear radius over x at that depth, over p0 = 1."""
    along, normal, shear = line_stresses(np.linspace(-3, 3, 1501), z)

    def worst(residual):
        return np.hypot((pressure * (along - normal) + residual) / 2, pressure * shear).max()

    return minimize_scalar(worst, bounds=(-3 * pressure, 3 * pressure), method="bounded", options={"xatol": 1e-7}).fun


def test_shakedown_is_where_residual_stresses_just_hold_every_depth():
    """Melan: at p0 = 4 k some sx(z) keeps every depth within the shear k, a little above none does at z = 1/2."""
    k = 1.0
    depths = np.linspace(0.05, 2.0, 40)
    assert max(tamed(4 * k, z) for z in depths) <= k * (1 + 1e-5)
    assert tamed(4 * k, 0.5) == pytest.approx(k, rel=1e-5)
    assert tamed(4.04 * k, 0.5) > 1.009 * k
    assert pressure_limits(2.0, 0.3, "tresca").shakedown == pytest.approx(4 * k)
    assert pressure_limits(np.sqrt(3), 0.3).shakedown == pytest.approx(4 * k)


def test_messages():
    with pytest.raises(UnknownName, match="did you mean 'tresca'"):
        pressure_limits(1e9, 0.3, "treska")
    with pytest.raises(InputError, match="yield stress of -5 Pa; it must be above 0"):
        pressure_limits(-5.0, 0.3)
