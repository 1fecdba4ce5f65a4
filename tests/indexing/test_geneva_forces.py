"""Clearance and forces of a Geneva drive: entry, crossing, balance of moments and power."""

import numpy as np
import pytest

from drivewright.indexing.geneva.clearance import crossing, entry
from drivewright.indexing.geneva.forces import PinFriction, pin_forces
from drivewright.indexing.geneva.step import GenevaStep

pytestmark = pytest.mark.analytical

C = 0.1
STEP = GenevaStep(4, C, C * float(np.sin(np.pi / 4)))
SPEED = 12.0


def test_at_entry_the_pin_is_half_the_clearance_aside_of_the_slot():
    clearance = 5e-5
    found = entry(STEP, clearance, SPEED)
    pin = STEP.crank_radius * np.exp(1j * found.angle) - C
    along = np.exp(1j * (np.pi + STEP.half_pitch))  # the slot of a wheel at rest
    aside = (np.conj(along) * pin).imag
    assert abs(aside) == pytest.approx(clearance / 2, rel=1e-9)
    path = 1j * np.exp(1j * found.angle)
    assert abs(np.angle(path * np.conj(-along))) == pytest.approx(found.path_angle, rel=1e-9)
    assert found.normal_speed == pytest.approx(STEP.crank_radius * SPEED * np.sin(found.path_angle), rel=1e-12)
    assert found.speed_jump * STEP.pin_distance(found.angle) == pytest.approx(found.normal_speed, rel=1e-12)


def test_the_entry_angle_goes_with_the_root_of_the_clearance():
    angles = [entry(STEP, clearance, SPEED).path_angle for clearance in (1e-6, 1e-8)]
    assert angles[0] / angles[1] == pytest.approx(10.0, rel=1e-3)
    assert angles[0] == pytest.approx(np.sqrt(1e-6 / STEP.crank_radius), rel=1e-3)
    assert entry(STEP, 0.0, SPEED).path_angle == pytest.approx(0.0, abs=1e-7)


def test_a_pin_that_is_off_misses_the_slot_by_what_exceeds_the_clearance():
    off = GenevaStep(4, C, STEP.crank_radius + 1e-4)
    assert entry(off, 1e-4, SPEED).miss == pytest.approx(5e-5) and entry(off, 3e-4, SPEED).miss == 0.0
    grown = entry(off, 1e-4, SPEED).path_angle / entry(STEP, 1e-4, SPEED).path_angle
    assert grown == pytest.approx(np.sqrt(3.0), rel=2e-3)  # a (1 - cos) = excess + s/2, the excess being the clearance


def test_a_crossing_goes_with_the_two_thirds_power_of_the_clearance():
    """A pin that slows down at the rate psi''' falls behind by rho psi''' x^3/6, so s^(1/3) of way and s^(2/3) of speed."""
    near, far = (crossing(STEP, clearance, SPEED, 0.0) for clearance in (1e-9, 1e-6))
    assert far.speed / near.speed == pytest.approx(100.0, rel=1e-2) and far.angle / near.angle == pytest.approx(10.0, rel=1e-2)
    rho, third = STEP.pin_distance(0.0), STEP.largest_third
    assert near.angle == pytest.approx(np.cbrt(6e-9 / (rho * third)), rel=1e-3)
    assert near.speed == pytest.approx(SPEED * rho * third * near.angle**2 / 2, rel=2e-3)


def test_at_the_crossing_a_free_wheel_is_the_clearance_ahead_of_the_pin():
    """A wheel that slows down evenly from where psi'' is its own second derivative; the speed is that of the gap."""
    clearance, bend = 2e-4, -2.0
    found = crossing(STEP, clearance, SPEED, bend)
    fine = np.linspace(0.0, 0.3, 300_001)
    start = fine[int(np.argmin(np.abs(STEP.pin_direction(fine).d2 - bend)))]
    first = STEP.pin_direction(start)

    def gap(theta):
        free = first.d0 + first.d1 * (theta - start) + bend * (theta - start) ** 2 / 2
        return STEP.pin_distance(theta) * (free - STEP.pin_direction(theta).d0)

    assert gap(found.angle) == pytest.approx(clearance, rel=1e-5)
    h = 1e-6
    slope = (gap(found.angle + h) - gap(found.angle - h)) / (2 * h)
    assert found.speed == pytest.approx(SPEED * slope, rel=1e-5)


def test_friction_of_the_wheel_delays_the_crossing_and_softens_it():
    free, held = (crossing(STEP, 3e-5, SPEED, bend) for bend in (0.0, -2.0))
    assert held.angle > free.angle and held.speed < free.speed
    assert crossing(STEP, 0.0, SPEED, 0.0).speed == 0.0
    assert crossing(STEP, 3e-5, SPEED, -100.0).speed == 0.0, "a wheel that stops by itself never strikes"


def forces(friction, torque=20.0, resisting=0.0):
    theta = np.linspace(-0.75, 0.75, 61)
    over = STEP.pin_direction(theta)
    load = torque * over.d2 + resisting
    return theta, over.d1 * SPEED, load, pin_forces(STEP, 0.008, friction, theta, SPEED + 0 * theta, over.d1 * SPEED, load)


def test_without_friction_the_crank_gives_the_power_of_the_wheel():
    theta, wheel_speed, load, found = forces(PinFriction())
    assert found.normal * STEP.pin_distance(theta) == pytest.approx(load)
    assert found.crank_torque * SPEED == pytest.approx(load * wheel_speed, rel=1e-12, abs=1e-9)


@pytest.mark.parametrize("friction", [PinFriction(0.1), PinFriction(0.05, 0.5), PinFriction(0.2, 1.0, 1e-3)])
def test_with_friction_the_crank_pays_the_losses(friction):
    """Moments at the crank against power: wheel with its bearing, and the sliding of the pin."""
    _, wheel_speed, load, found = forces(friction, resisting=3.0)
    given = (load + found.bearing_torque) * wheel_speed + found.pin_loss
    assert found.crank_torque * SPEED == pytest.approx(given, rel=1e-12, abs=1e-9)
    assert np.all(found.pin_loss >= 0) and np.all(found.bearing_torque >= -1e-12)
    assert found.bearing_torque == pytest.approx(friction.bearing * found.resultant, abs=1e-12)


def test_the_pin_changes_sides_where_the_wheel_has_to_be_held_back():
    theta, _, load, found = forces(PinFriction(0.1))
    assert np.all(np.sign(found.normal) == np.sign(load)) and found.normal[0] > 0 > found.normal[-1]
