"""Film of a line contact: Reynolds' equation in the inlet, exponents as scalings, the book's groups by hand."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

from drivewright.contact import film_ratio, line_contact, line_film

CASE = {"speed": 6.0, "load": 1e5, "radius": 0.015, "modulus": 115e9, "viscosity": 0.01, "pressure_viscosity": 18e-9}


def inlet_film(speed, load, radius, modulus, viscosity, pressure_viscosity):
    """Central film by Ertel and Grubin: the Hertz shape of the gap before the contact, 12 eta u int (h - h0)/h^3 dx = 1/alpha."""
    half = float(line_contact(load, 1.0, radius, modulus).half_width)

    def opening(t):
        """Gap of the dry Hertz contact at x = half cosh(t)."""
        return half**2 / (2 * radius) * (np.cosh(t) * np.sinh(t) - t)

    def excess(log_film):
        film = np.exp(log_film)
        pressure, _ = quad(lambda t: opening(t) / (opening(t) + film) ** 3 * half * np.sinh(t), 0, 12, limit=400)
        return np.log(12 * viscosity * speed * pressure * pressure_viscosity)

    return float(np.exp(brentq(excess, np.log(1e-9), np.log(1e-4))))


@pytest.mark.analytical
@pytest.mark.parametrize(
    "change", [{}, {"speed": 1.5}, {"speed": 20.0}, {"load": 3e5}, {"radius": 0.04}, {"pressure_viscosity": 25e-9}, {"viscosity": 0.05}]
)
def test_reynolds_equation_in_the_inlet(change):
    """Grubin's film, which leaves the elasticity in the inlet out, lies within 15 % of the fitted formula."""
    case = CASE | change
    assert float(line_film(**case).central) == pytest.approx(inlet_film(**case), rel=0.15)


@pytest.mark.analytical
def test_groups_by_hand():
    film = line_film(**CASE)
    stiff = 2 * 115e9
    u, g, w = 0.01 * 6 / (stiff * 0.015), 18e-9 * stiff, 1e5 / (stiff * 0.015)
    assert film.minimum == pytest.approx(0.015 * 2.65 * u**0.7 * g**0.54 / w**0.13, rel=1e-12)
    assert film.central == pytest.approx(0.015 * 3.06 * u**0.69 * g**0.56 / w**0.10, rel=1e-12)
    assert 1.1 < float(film.central / film.minimum) < 1.5  # the film narrows by a quarter or so at its outlet


@pytest.mark.property
@pytest.mark.parametrize(
    ("name", "power"),
    [
        ("speed", 0.70),
        ("load", -0.13),
        ("radius", 1 - 0.70 + 0.13),
        ("modulus", -0.70 + 0.54 + 0.13),
        ("viscosity", 0.70),
        ("pressure_viscosity", 0.54),
    ],
)
def test_exponents(name, power):
    doubled = line_film(**(CASE | {name: 2 * CASE[name]}))
    assert float(doubled.minimum / line_film(**CASE).minimum) == pytest.approx(2**power, rel=1e-12)


@pytest.mark.property
def test_signs_and_ends():
    still, back = line_film(**(CASE | {"speed": 0.0})), line_film(**(CASE | {"speed": -6.0}))
    assert (still.minimum, still.central) == (0, 0) and back == line_film(**CASE)
    assert np.isinf(line_film(**(CASE | {"load": 0.0})).minimum)
    assert film_ratio(0.6e-6, 0.3e-6) == pytest.approx(2)
