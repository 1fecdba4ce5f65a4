"""Discs, strands and joints as far as nobody has measured them, the step that a run takes, and the load on a roller chain's pin."""

from types import SimpleNamespace

import numpy as np
import pytest

from drivewright.chains import masses
from drivewright.chains.explicit import stability
from drivewright.chains.implicit.tables import plate_force_table
from drivewright.chains.stress import pins

pytestmark = pytest.mark.analytical


def test_a_disc_is_a_cylinder_less_its_hole():
    """m = pi (R^2 - r^2) b rho;  I = m (R^2 + r^2)/2: that of the full disc less that of the hole."""
    full, hole = masses.disc_mass(0.05, 0.0, 0.01, 7850.0), masses.disc_mass(0.02, 0.0, 0.01, 7850.0)
    mass = masses.disc_mass(0.05, 0.02, 0.01, 7850.0)
    assert mass == pytest.approx(full - hole, rel=1e-12)
    assert masses.disc_inertia(mass, 0.05, 0.02) == pytest.approx(0.5 * full * 0.05**2 - 0.5 * hole * 0.02**2, rel=1e-12)
    assert masses.disc_mass(0.05, 0.06, 0.01, 7850.0) == full  # a hole that leaves no disc is none


def test_strands_are_springs_in_line_side_by_side():
    joint = masses.joint_stiffness(3e7)
    assert joint == pytest.approx(1 / (1 / 3e7 + 1 / 3e7 + 1 / 3e7))
    assert masses.strands_stiffness(joint, 4.0) == pytest.approx(2 / (5 / joint))


def test_articulation_damping_is_half_of_critical_at_a_ratio_of_one_for_two_joints():
    """I x'' + 2 c x' + T A x = 0 is critically damped where 2 c = 2 sqrt(T A I)."""
    tension, pitch, inertia = 75.0, 0.012, 5e-8
    assert masses.articulation_damping(1.0, tension, pitch, inertia) ** 2 == pytest.approx(tension * pitch * inertia)


def test_a_step_that_nobody_gives_is_a_microsecond_or_half_the_stable_one(monkeypatch):
    for largest, step in ((1.0, stability.STEP), (1.2e-6, 0.6e-6)):
        monkeypatch.setattr(stability, "largest_step", lambda model, largest=largest: largest)
        assert stability.safe_step(None) == pytest.approx(step)
        assert stability.safe_step(None, 0.9e-6) == 0.9e-6


def test_the_pin_of_a_roller_chain_is_in_balance_and_symmetric():
    sheet, bush, force = 1e-3, 6e-3, 900.0
    breaks, load = pins.roller_pin_load(sheet, bush, force)
    length = np.diff(breaks)
    assert breaks[-1] == pytest.approx(4 * sheet + bush) and np.array_equal(load, load[::-1])
    assert load[0] * length[0] == pytest.approx(force / 2)  # an outer plate pulls with half of it
    assert np.sum(load * length) == pytest.approx(0.0, abs=1e-9)
    middle = np.sum(load * length * 0.5 * (breaks[1:] + breaks[:-1]))
    assert middle == pytest.approx(0.0, abs=1e-9)


def test_forces_of_every_plate_stand_in_their_columns():
    flanks = np.arange(12.0).reshape(2, 3, 2)
    table = plate_force_table(SimpleNamespace(tension=np.arange(6.0).reshape(2, 3), flank_force=flanks))
    assert [column.data.tolist() for column in table.columns] == [[0, 1, 2], [0, 1, 2], [0, 2, 4], [1, 3, 5]]
