"""Elastic bodies in contact beside closed forms: Hertz's line and point contact, Persson's pin in a hole, an even pressure, energy."""

from functools import cache

import numpy as np
import pytest

from drivewright.contact import hertz
from drivewright.contact.conforming import conforming_half_angle, conforming_pressure
from drivewright.solids.contact import ContactModel, Functional, Pair
from drivewright.solids.elastic import FreeBody, Plane
from drivewright.solids.stresses import skin_stress
from tests.support.pressed_bodies import NU, SHEET, E, block, half_disc, half_plate, quarter_ball, quarter_disc

pytestmark = [pytest.mark.analytical, pytest.mark.needs_fe]

MODULUS = hertz.effective_modulus(E, NU, E, NU)
DISC, FORCE = 1.2e-3, 33.3333  # m, N on a sheet of 1 mm


@cache
def two_discs(share):
    """(points [m], pressure [Pa], state) of two discs pressed together, elements of a part of the half width."""
    expected = hertz.line_contact(FORCE, SHEET, DISC / 2, MODULUS)
    size = 1e3 * expected.half_width * share
    upper = FreeBody(quarter_disc(1.2, 1, size, 0.04), E, NU, Plane(SHEET), dirichletx="sym")
    lower = FreeBody(quarter_disc(1.2, -1, 1.3 * size, 0.04), E, NU, Plane(SHEET), dirichletx="sym", dirichlety="flat")
    pair = Pair(("upper", "contact"), ("lower", "contact"), 1e-6)
    model = ContactModel({"upper": upper, "lower": lower}, [pair], [], {"push": Functional("upper", upper.mean("flat", (0, -1)))})
    state = model.solve({"push": FORCE / 2})
    return 1e-3 * model.pairings[0].places, state.pressure[0], state, expected


def parabola(distance, pressure):
    """(pressure at 0, where it ends) of the ellipse p^2 = p0^2 (1 - x^2/b^2) through the upper part of a pressure."""
    kept = pressure > 0.3 * pressure.max()
    slope, top = np.polyfit(distance[kept] ** 2, pressure[kept] ** 2, 1)
    return np.sqrt(top), np.sqrt(-top / slope)


def test_two_cylinders_press_as_hertz_says():
    points, pressure, state, expected = two_discs(0.05)
    top, end = parabola(points[:, 0], pressure)
    assert pressure.max() == pytest.approx(expected.pressure, rel=0.01)
    assert top == pytest.approx(expected.pressure, rel=0.01)
    assert end == pytest.approx(expected.half_width, rel=0.01)
    assert state.force(0)[1] == pytest.approx(FORCE / 2, rel=1e-9)


def test_a_fifth_of_the_half_width_is_enough_for_the_pressure():
    _, pressure, _, expected = two_discs(0.2)
    assert pressure.max() == pytest.approx(expected.pressure, rel=0.02)


def test_pressure_converges_with_the_elements():
    """In the mean square with the first power: the pressure ends inside an element, with a vertical tangent."""
    half_width = 1e3 * two_discs(0.2)[3].half_width
    counts, off = np.array([16, 32, 64, 128, 256]), []
    for count in counts:
        points, pressure, state, expected = two_discs(float(0.04 / count / half_width))
        exact = expected.pressure * np.sqrt(np.maximum(1 - (points[:, 0] / expected.half_width) ** 2, 0.0))
        weight = state.model.pairings[0].area
        off.append(np.sqrt((pressure - exact) ** 2 @ weight / (exact**2 @ weight)))
    assert np.polyfit(np.log(counts), np.log(off), 1)[0] == pytest.approx(-1.0, abs=0.15)
    assert off[-1] < 0.01


def two_balls(share):
    """(r / a, p / p0, areas / a^2) at the hats of two balls, elements of a part of the half width a."""
    radius, force = 10e-3, 500.0
    expected = hertz.point_contact(force, (radius / 2, radius / 2), MODULUS)
    size, patch = 1e3 * float(expected.major) * share, 1.4e3 * float(expected.major)
    upper = FreeBody(quarter_ball(10.0, 1, size, patch), E, NU, dirichletx="symx", dirichlety="symy")
    lower = FreeBody(quarter_ball(10.0, -1, size, patch), E, NU, dirichletx="symx", dirichlety="symy", dirichletz="flat")
    pair = Pair(("upper", "contact"), ("lower", "contact"), 2e-5)
    model = ContactModel({"upper": upper, "lower": lower}, [pair], [], {"push": Functional("upper", upper.mean("flat", (0, 0, -1)))})
    state, (pairing,) = model.solve({"push": force / 4}), model.pairings
    assert state.force(0)[2] == pytest.approx(force / 4, rel=1e-9)
    distance = 1e-3 * np.hypot(*pairing.places[:, :2].T) / float(expected.major)
    return distance, state.pressure[0] / float(expected.pressure), 1e-6 * pairing.area / float(expected.major) ** 2


def test_two_balls_press_as_hertz_says():
    """The half width by the second moment of the pressure, <r^2> = 2 a^2/5, and the pressure by the ellipse through it."""
    distance, pressure, area = two_balls(1 / 9)
    assert np.sqrt(2.5 * (pressure * area) @ distance**2 / (pressure @ area)) == pytest.approx(1.0, rel=0.01)
    assert parabola(distance, pressure)[0] == pytest.approx(1.0, rel=0.01)
    assert pressure.max() == pytest.approx(1.0, rel=0.025)


@pytest.mark.slow
def test_two_balls_press_as_hertz_says_on_finer_elements():
    """Elements of a/18: to 1 % by every measure, single hats too."""
    distance, pressure, area = two_balls(1 / 18)
    top, end = parabola(distance, pressure)
    assert [top, end, pressure.max()] == pytest.approx([1.0] * 3, rel=0.01)
    assert np.sqrt(2.5 * (pressure * area) @ distance**2 / (pressure @ area)) == pytest.approx(1.0, rel=0.005)
    assert np.sqrt(4 / np.pi * area[pressure > 0].sum()) == pytest.approx(1.0, rel=0.01)


@cache
def pin_in_plate(first="plate"):
    """A pin of 1.2 mm radius in a hole of an endless sheet; the hole's clearance is in the gap, not in the mesh."""
    import ngsolve as ng

    pin = FreeBody(half_disc(1.2, 0.04), E, NU, Plane(SHEET), dirichletx="sym")
    plate = FreeBody(half_plate(1.2, 72.0, 0.04), E, NU, Plane(SHEET), dirichletx="sym|far", dirichlety="far")
    weight = ng.exp(-(ng.x**2 + ng.y**2) / (2 * 0.15**2))
    region = ng.dx(bonus_intorder=6)
    push = ng.LinearForm(-weight / ng.Integrate(weight * region, pin.mesh) * pin.space.TestFunction()[1] * region).Assemble().vec
    second = "pin" if first == "plate" else "plate"
    pair = Pair((first, "contact"), (second, "contact"), 2e-4)
    return ContactModel({"pin": pin, "plate": plate}, [pair], [], {"push": Functional("pin", push)})


@pytest.mark.parametrize("first", ["plate", "pin"])
@pytest.mark.parametrize(("clearance", "load"), [(20e-6, 100e3), (5e-6, 100e3), (5e-6, 1e6), (0.0, 100e3)])
def test_a_pin_in_a_hole_presses_as_persson_says(first, clearance, load):
    model = pin_in_plate(first)
    (pairing,) = model.pairings
    gap = [pairing.gap + 1e3 * clearance * pairing.area]
    state = model.solve({"push": load * SHEET / 2}, gaps=gap)
    x, y = pairing.places.T
    turn = np.arctan2(x, -y)
    end = conforming_half_angle(load, clearance, E / (1 - NU**2))
    expected = load / DISC * conforming_pressure(turn, end)
    inside = turn < end - np.radians(6.0)  # elements of 2 deg
    assert state.pressure[0][inside] == pytest.approx(expected[inside], abs=0.012 * expected.max())
    assert np.all(state.pressure[0][turn > end + np.radians(2.0)] == 0)


def test_persson_pressure_has_the_load_as_its_resultant():
    for end in (0.1, 0.7, 1.4):
        turn = np.linspace(-end, end, 40001)
        assert np.trapezoid(conforming_pressure(turn, end) * np.cos(turn), turn) == pytest.approx(1.0, rel=1e-5)


def test_persson_without_clearance_and_as_hertz_for_a_small_load():
    assert np.degrees(conforming_half_angle(1.0, 0.0, 1e11)) == pytest.approx(84.828, abs=0.001)
    radius, clearance, load = 10e-3, 50e-6, 1e4
    end = conforming_half_angle(load, clearance, 2e11)
    line = hertz.line_contact(load, 1.0, radius * radius / clearance, 1e11)
    assert radius * end == pytest.approx(float(line.half_width), rel=2e-3)
    assert load / radius * conforming_pressure(0.0, end) == pytest.approx(float(line.pressure), rel=2e-3)


def test_an_even_pressure_passes_through_blocks_with_other_meshes():
    """Patch test: in plane stress between smooth walls the blocks shorten evenly, whatever their elements; off by the quadrature only."""
    sheet, push = Plane(SHEET, "stress"), 1000.0
    lower = FreeBody(block((0, 0), (10, 6), 1.1), E, NU, sheet, dirichlety="bottom", dirichletx="left")
    upper = FreeBody(block((0, 6), (10, 12), 1.7), E, NU, sheet, dirichletx="left")
    pair = Pair(("upper", "bottom"), ("lower", "top"), 1e-6)
    model = ContactModel({"upper": upper, "lower": lower}, [pair], [], {"push": Functional("upper", upper.mean("top", (0, -1)))})
    state = model.solve({"push": push})
    even = push / (10e-3 * SHEET)
    assert state.pressure[0] == pytest.approx(even, rel=2e-3)
    assert state.travel("push") == pytest.approx(even / E * 12e-3, rel=1e-5)
    skin = skin_stress(lower, [state.displacement("lower")])
    assert skin.stress[0][:, 1, 1] == pytest.approx(-even, rel=2e-2)


def test_work_of_the_load_is_the_energy_that_it_leaves():
    """Castigliano: the travel is the derivative of the complementary energy, so the work to F is the integral of the travel over F."""
    model = pin_in_plate()
    (pairing,) = model.pairings
    gap = [pairing.gap + 5e-3 * pairing.area]
    forces = 50.0 * (1 + np.polynomial.legendre.leggauss(8)[0]) / 2

    def energy(force):
        state = model.solve({"push": force}, gaps=gap, narrow=True)
        x, h = state.answer.x, np.array([force])
        whole = np.sum([each.flexibility for each in model.condensed.values()], axis=0)
        both = np.concatenate([x, h])
        return 0.5e-3 * both @ whole @ both + 1e-3 * x @ gap[0], state.travel("push")

    for force in forces[2:]:
        step = 1e-4 * force
        slope = (energy(force + step)[0] - energy(force - step)[0]) / (2 * step)
        assert slope == pytest.approx(energy(force)[1], rel=1e-5)
