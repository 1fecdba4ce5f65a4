"""Pins in their holes with clearance: Hertz for much of it, the wrapped pin for none."""

from functools import cache

import numpy as np
import pytest

from drivewright.chains.link import design_link
from drivewright.chains.plate import design_plate
from drivewright.chains.stress import bearing
from drivewright.chains.stress.plate import Loads, plate_basis, plate_body, stress_history
from drivewright.chains.stress.seating import seated
from drivewright.errors import InputError, SolverError
from drivewright.solids.plane import PlaneBody, plane_von_mises
from drivewright.solids.plane_meshing import plane_mesh

pytestmark = [pytest.mark.analytical, pytest.mark.needs_fe]
R, T, E = 1.2e-3, 2e-3, 206e9
PINS = np.array([[-200.0, 0.0], [200.0, 0.0]])


@cache
def plate():
    return design_plate(design_link(9.525e-3, R, np.radians(30), 2.6e-3))


@cache
def body():
    return plate_body(plate(), E, 0.3)


@cache
def found(clearance):
    return seated(plate(), body(), PINS, clearance)


def test_much_clearance_is_hertz_contact():
    """Rigid cylinder in a hollow, plane stress E* = E, 1/R* = 1/(R - c) - 1/R: peak pressure and half width."""
    fine = {f"hole{k}:{list(plate().hole(side)).index('seat')}": 0.036e-3 for k, side in enumerate(("left", "right"))}
    body = PlaneBody(plane_mesh(plate().outline, plate().holes, size=1.5e-3, fine=fine), thickness=T, modulus=E, poisson=0.3, order=2)
    clearance, force = 40e-6, 100.0
    one = seated(plate(), body, PINS * force / 200, clearance)
    radius, line = R * (R - clearance) / clearance, force / T
    for turns, pressure in zip(one.turns, one.pressures, strict=True):
        assert pressure.max() == pytest.approx(np.sqrt(line * E / (np.pi * radius)), rel=0.1)
        spread = np.sqrt(np.sum(turns**2 * pressure) / np.sum(pressure))  # of an ellipse of pressure: half its half width
        assert 2 * R * spread == pytest.approx(np.sqrt(4 * line * radius / (np.pi * E)), rel=0.06)


@pytest.mark.parametrize("clearance", [0.0, 1e-6, 5e-6])
def test_the_pressures_carry_the_forces(clearance):
    """Hats integrate to r t times their spacing; the stress along the rim is that of the pressures."""
    one = found(clearance)
    for turns, pressure in zip(one.turns, one.pressures, strict=True):
        step = turns[1] - turns[0]
        assert R * T * step * np.sum(pressure * np.cos(turns)) == pytest.approx(200.0, rel=0.01)
        assert abs(R * T * step * np.sum(pressure * np.sin(turns))) < 2.0
        assert pressure.min() >= 0


def test_clearance_narrows_the_contact_and_raises_everything():
    runs = [found(clearance) for clearance in (0.0, 0.1e-6, 1e-6, 5e-6)]
    widths = [np.count_nonzero(one.pressures[1]) for one in runs]
    assert np.all(np.diff(widths) < 0)
    assert np.all(np.diff([one.pressures[1].max() for one in runs]) > 0)
    hole = body().on("hole*")
    assert np.all(np.diff([plane_von_mises(one.stress[hole]).max() for one in runs]) > 0)
    assert np.all(np.diff([one.shift[1, 0] for one in runs]) > 0)


def test_the_gap_left_is_what_the_clearance_says():
    """Behind the contact the hole's wall is the clearance, less the pin's shift along it, plus its own movement, away from the pin."""
    one, clearance = found(5e-6), 5e-6
    seat = bearing.seat_of(body(), plate(), "right")
    assert one.shift[1, 0] > clearance
    assert one.shift[0, 0] == pytest.approx(-one.shift[1, 0], rel=2e-3)
    traction = np.zeros((1, len(body().rim.name), 2))
    for k, side in enumerate(("left", "right")):
        own = bearing.seat_of(body(), plate(), side)
        turn = np.angle(np.exp(1j * (own.turn - 0.0)))
        traction[0, own.rows] = np.interp(turn, one.turns[k], one.pressures[k])[:, None] * own.outward
    wall = body().displacement(body().solve(traction))[0, seat.rows]
    gap = clearance + np.sum((wall - one.shift[1]) * seat.outward, axis=1)
    assert gap.min() > -0.03 * clearance
    assert np.abs(gap[np.abs(seat.turn) < 0.3]).max() < 0.03 * clearance
    assert gap[np.abs(seat.turn) > 0.7].min() > 0.05 * clearance


def test_a_pin_without_clearance_bears_almost_as_the_cosine():
    """Peak pressures 54.8 and 53.1 MPa; the hole's edge 131.5 against 135.8 MPa."""
    basis = plate_basis(plate(), body())
    cosine = stress_history(basis, Loads(PINS[None], np.zeros((1, 2)), np.zeros((1, 2))))[0]
    hole = body().on("hole*")
    assert found(0.0).pressures[1].max() == pytest.approx(4 * 200 / (np.pi * 2 * R * T), rel=0.06)
    assert plane_von_mises(found(0.0).stress[hole]).max() == pytest.approx(plane_von_mises(cosine[hole]).max(), rel=0.06)


def test_scaling_forces_and_clearance_together_scales_the_answer():
    double = seated(plate(), body(), 2 * PINS, 10e-6)
    assert np.allclose(double.pressures[0], 2 * found(5e-6).pressures[0], rtol=1e-6, atol=1.0)
    assert np.allclose(double.shift, 2 * found(5e-6).shift, rtol=1e-6)


def test_messages():
    with pytest.raises(InputError, match="clearance of 0 or more, got -1 µm"):
        seated(plate(), body(), PINS, -1e-6)
    with pytest.raises(SolverError, match="clearance of 50 µm a pin is in contact at . nodes only.*fineness"):
        seated(plate(), body(), PINS, 50e-6)
