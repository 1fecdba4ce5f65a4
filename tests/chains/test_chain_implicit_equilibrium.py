"""Equilibrium over a tooth: limits of stiffness, scaling, symmetry, balance of forces, tooth thickness, elongation."""

from dataclasses import replace

import numpy as np
import pytest
from chain_implicit_models import PITCH, drive, thickened

from drivewright.chains.implicit.equilibrium import compliance_of, equilibrium
from drivewright.chains.model import with_sprocket

pytestmark = pytest.mark.analytical

CLOSURE = {1.0e-3: 219.056810e-3, 1.3e-3: 219.057740e-3, 1.6e-3: 219.058711e-3, 0.0: 219.054018e-3}  # rigid plates, strands in equilibrium


@pytest.fixture(scope="module")
def rest():
    return equilibrium(drive(), 24)


@pytest.mark.parametrize("radius", CLOSURE)
def test_rigid_limit_is_the_closure(radius):
    found = compliance_of(drive(radius), 12)
    assert found.rigid_mean == pytest.approx(CLOSURE[radius], abs=2e-8)
    assert 2.4e-6 < found.added < 2.6e-6


def test_compliance_is_of_first_order():
    """Three stiffnesses, each four times the one before: differences fall by four."""
    a, b, c = (equilibrium(drive(stiffness=k), 8).mean for k in (16e9, 64e9, 256e9))
    assert (a - b) / (b - c) == pytest.approx(4.0, rel=0.02)


def test_force_over_stiffness_is_all_that_counts():
    one, other = equilibrium(drive(force=150.0), 6), equilibrium(drive(stiffness=2e9, force=300.0), 6)
    assert other.centre_distance == pytest.approx(one.centre_distance, abs=1e-12)
    assert other.joint_force == pytest.approx(2 * one.joint_force, abs=1e-3)


def test_motion_is_that_of_the_mirrored_drive(rest):
    """The assembly is symmetric about the line of centres at angle 0: backwards the same distances come in turn."""
    back = equilibrium(drive(speed=200.0), 24)
    assert back.centre_distance == pytest.approx(rest.centre_distance, abs=1e-11)
    assert np.ptp(rest.centre_distance) > 5e-7


def test_a_tooth_further_all_is_as_before():
    found = equilibrium(drive(1.6e-3), 6, teeth=2)
    assert found.centre_distance[6:] == pytest.approx(found.centre_distance[:6], abs=1e-11)
    assert found.bodies[6:, 1, 1] - found.bodies[:6, 1, 1] == pytest.approx(-2 * np.pi / 37 * np.ones(6), abs=1e-10)


def test_strands_carry_half_the_force_each(rest):
    """Cut between the sprockets: two joints, whose forces along the slide add up to its force."""
    upper, lower = (
        np.abs([force[_at(plates, side), 0] for plates, force in zip(rest.plates, rest.joint_force, strict=True)]) for side in (1, -1)
    )
    assert upper + lower == pytest.approx(150.0 * np.ones(24), rel=2e-6)
    assert upper == pytest.approx(75.0 * np.ones(24), rel=3e-3)
    assert rest.flank_force.min() == 0.0
    assert 45 < np.mean(rest.contacts) < 54


def _at(plates, side):
    """Number of the plate half-way between the sprockets, in the upper (1) or lower strand."""
    return np.argmin(np.abs(plates[:, 0] - 0.11) + (side * plates[:, 1] < 0))


def test_load_torque_is_the_difference_of_the_strands():
    torque = 0.6
    found = equilibrium(drive(torque=torque), 6)
    x, y = found.plates[..., 0], found.plates[..., 1]
    middle = (x > 0.09) & (x < 0.13)
    upper, lower = (np.mean(found.tension[middle & side]) for side in (y > 0, y < 0))
    height = 0.5 * PITCH / np.sin(np.pi / 37) * np.cos(np.pi / 37)
    assert abs(upper - lower) * height == pytest.approx(torque, rel=3e-3)


def test_thick_teeth_lift_the_chain():
    """20 um too thick on both sprockets: 0.6 mm less centre distance, far more than any rolling radius does."""
    base, thick = drive(stiffness=3e9), thickened(thickened(drive(stiffness=3e9), 0, 2e-5), 1, 2e-5)
    lift = equilibrium(thick, 8).mean - equilibrium(base, 8).mean
    assert lift == pytest.approx(-0.603e-3, abs=0.005e-3)


def test_longer_chain_moves_the_sprocket_out():
    """Pitches longer on thinner teeth by as much as the seat asks: each link adds half its growth per strand."""
    growth, base = 2e-4, drive(stiffness=1e10)
    longer = drive(stiffness=1e10, elongation=growth)
    single = drive(stiffness=1e10, deviations=(growth * PITCH,) * 82)
    long, one = equilibrium(longer, 4).mean, equilibrium(single, 4).mean
    assert long == pytest.approx(one, abs=1e-12)
    assert long - equilibrium(base, 4).mean > 0.5 * 23 * growth * PITCH


def test_slide_spring_gives_way():
    """A spring on the slide takes its part of the force."""
    base = drive()
    slide = replace(base.sprockets[1].slide, stiffness=1e4)
    found = equilibrium(with_sprocket(base, 1, slide=slide), 4)
    middle = (found.plates[..., 0] > 0.09) & (found.plates[..., 0] < 0.13)
    assert 2 * np.mean(found.tension[middle]) == pytest.approx(150.0 - 1e4 * np.mean(found.bodies[:, 1, 0]), rel=2e-3)
