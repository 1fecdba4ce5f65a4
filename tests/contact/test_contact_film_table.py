"""The oil film from its table against Reynolds' equation solved for every state, and its drag against the shear of the film's walls."""

import numpy as np
import pytest

from drivewright.contact import film, reynolds
from drivewright.contact.film_table import film_table, tabulated_bearing

pytestmark = pytest.mark.analytical

VISCOSITY, LENGTH, RADIUS, CLEARANCE = 0.04, 0.012, 0.01, 5e-5
OIL = (VISCOSITY, LENGTH, RADIUS, CLEARANCE)
TABLE = film_table(LENGTH / (2 * RADIUS)).coefficients


def states(count, largest):
    """(eccentricity (2,) [m], velocity (2,) [m/s], spin [rad/s]) anywhere."""
    rng = np.random.default_rng(5)
    for _ in range(count):
        size, angle = CLEARANCE * rng.uniform(0.0, largest), rng.uniform(-np.pi, np.pi)
        speed, way = rng.uniform(0.0, 0.02), rng.uniform(-np.pi, np.pi)
        yield size * np.array([np.cos(angle), np.sin(angle)]), speed * np.array([np.cos(way), np.sin(way)]), rng.uniform(-300, 300)


def test_the_table_is_reynolds_equation_for_the_bearings_length():
    for e, v, spin in states(15, 0.95):
        wanted = reynolds.solve_film(e, v, spin, *OIL, shape=(720, 24)).force
        found = np.array(tabulated_bearing(*e, *v, spin, *OIL, TABLE))
        assert np.linalg.norm(found - wanted) < 0.012 * np.linalg.norm(wanted)


def test_beyond_the_table_the_force_grows_on():
    """From 0.985 of the clearance on: as (1 - eps^2)^-1.5 in a squeeze."""
    one, two = (-tabulated_bearing(eps * CLEARANCE, 0.0, 0.01, 0.0, 0.0, *OIL, TABLE)[0] for eps in (0.99, 0.999))
    assert two / one == pytest.approx(((1 - 0.99**2) / (1 - 0.999**2)) ** 1.5, rel=1e-9)


@pytest.mark.property
def test_what_is_mirrored_or_turned_gives_the_same_force():
    for e, v, spin in states(20, 0.99):
        fx, fy = tabulated_bearing(*e, *v, spin, *OIL, TABLE)
        assert tabulated_bearing(e[0], -e[1], v[0], -v[1], -spin, *OIL, TABLE) == pytest.approx((fx, -fy), rel=1e-9, abs=1e-12)
        assert tabulated_bearing(-e[1], e[0], -v[1], v[0], spin, *OIL, TABLE) == pytest.approx((-fy, fx), rel=1e-9, abs=1e-12)


@pytest.mark.property
def test_a_film_takes_energy_out():
    """Force times velocity against the half-speed whirl, in which nothing happens, is never above 0."""
    for e, v, spin in states(200, 0.999):
        moved = v - 0.5 * spin * np.array([-e[1], e[0]])
        assert np.dot(tabulated_bearing(*e, *v, spin, *OIL, TABLE), moved) <= 0.0


def test_the_drag_is_the_shear_at_the_journals_wall():
    """mu R w/h + (h/2) dp/(R dx), over the wall, of the pressure on a grid; the wedge's film of a journal that turns and is squeezed."""
    for e, v, slip in states(8, 0.8):
        solved = reynolds.solve_film(e, v, slip, *OIL, shape=(720, 24))
        size, line = np.hypot(*e), np.arctan2(e[1], e[0])
        thickness = CLEARANCE - size * np.cos(solved.angle - line)
        along = np.trapezoid(solved.pressure, solved.axial, axis=1) * 2  # both halves, over the length
        slope = (np.roll(along, -1) - np.roll(along, 1)) / (2 * RADIUS * (solved.angle[1] - solved.angle[0]))
        shear = VISCOSITY * RADIUS * slip / thickness * LENGTH + 0.5 * thickness * slope
        wanted = np.sum(shear) * (solved.angle[1] - solved.angle[0]) * RADIUS**2
        found = film.journal_friction(*e, *solved.force, slip, *OIL)
        assert found == pytest.approx(wanted, rel=2e-3, abs=2e-3 * VISCOSITY * LENGTH * RADIUS**3 / CLEARANCE * 300)


def test_a_journal_in_the_middle_is_braked_by_petroffs_torque():
    assert film.journal_friction(0.0, 0.0, 0.0, 0.0, 100.0, *OIL) == pytest.approx(
        2 * np.pi * VISCOSITY * LENGTH * RADIUS**3 * 100.0 / CLEARANCE, rel=1e-14
    )
