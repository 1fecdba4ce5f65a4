"""Analyses of multibody systems asked by other drives: a Poincare section of the pusher, an energy audit of a cam with spring."""

import numpy as np
import pytest

import drivewright as dw
from drivewright.cams.clearance import mass_deviation, mass_deviation_rate
from drivewright.mechanisms.seedling_pusher.dynamics import DISCARD, TURNS
from drivewright.multibody.analyses.energy_audit import audit_of_powers
from drivewright.multibody.analyses.poincare import Section, section_answer
from drivewright.registry import mechanism

pytestmark = pytest.mark.property


def preset(kind, name="default"):
    return dw.load(mechanism(kind).presets()[name])


def test_the_rod_of_the_pusher_comes_back_every_turn():
    """Damped contact between two cams: after the transient every visit is the same point, micrometres off the programme."""
    spec = preset("seedling-pusher")
    result = dw.run(spec, only="poincare")
    table = result.tables["poincare"]
    assert len(table["position"].data) == TURNS + 1 - DISCARD
    assert result["poincare.period"] == 1
    assert np.ptp(table["position"].data) < 1e-9  # of a stroke of centimetres
    assert 0 < abs(result["poincare.position"]) < 1e-5


def test_the_rod_deviation_is_the_difference_of_two_tangents():
    ahead, step = 2e-3, 1e-6
    error, rate = mass_deviation(0.1, 0.3, ahead), mass_deviation_rate(0.1, 0.3, 5.0, ahead, 0.7)
    assert error == pytest.approx(0.1 * (np.tan(0.302) - np.tan(0.3)), rel=1e-12)
    after = mass_deviation(0.1, 0.3 + 5.0 * step, ahead + 0.7 * step)
    before = mass_deviation(0.1, 0.3 - 5.0 * step, ahead - 0.7 * step)
    assert rate == pytest.approx((after - before) / (2 * step), rel=1e-6)


def test_a_motion_of_three_turns_and_one_that_never_repeats():
    turns = np.arange(40.0)
    spans = np.ones(2)
    three = section_answer("x", Section(turns, np.cos(2 * np.pi * turns / 3), np.sin(2 * np.pi * turns / 3)), 1.0, spans)
    assert three.values["poincare.period"].value == 3
    assert three.values["poincare.position"].interval == ""
    quasi = section_answer("x", Section(turns, np.cos(turns), np.sin(turns)), 1.0, spans, start=10.0)
    assert quasi.values["poincare.period"].value == 0
    assert quasi.values["poincare.position"].interval == "visits"
    assert quasi.tables[0]["turn"].data[0] == 10


@pytest.mark.parametrize("name", sorted(mechanism("cam").presets()))
def test_the_energy_of_every_cam_adds_up(name):
    result = dw.run(preset("cam", name), only="energy")
    assert result.check("energy_audit").ok
    assert result["energy.error"] < 1e-7
    last = result.tables["energy"]["stored"].data[-1]
    assert abs(last) < 1e-7 * np.max(np.abs(result.tables["energy"]["work_drive"].data))  # a whole turn ends as it began


def test_damping_of_the_follower_is_paid_by_the_shaft():
    """Over a turn the spring gives back what it took: the work of the shaft is that of the damper, integral of c v dx."""
    spec = preset("cam")
    spec = spec.replace(load=spec.load.replace(damping="5 N s/m"))
    result = dw.run(spec, only="energy")
    assert result["energy.damping"] < 0
    assert result["energy.drive"] == pytest.approx(-result["energy.damping"], rel=1e-6)
    assert abs(result["energy.spring"]) < 1e-9 * result["energy.drive"]


def test_a_missing_power_leaves_a_gap():
    """A mass on a spring whose power is left out; the powers of a piece that jumps are counted on both sides."""
    t = np.concatenate([np.linspace(0, 1, 201), np.linspace(1, 3, 401)])
    velocity = np.where(np.arange(len(t)) < 201, 1.0 - t, 2 * (t - 1))
    force = np.where(np.arange(len(t)) < 201, -1.0, 2.0)
    kinetic = 0.5 * velocity**2
    whole = audit_of_powers(t, (force * velocity)[:, None], kinetic, kinetic, drives=0)
    assert whole.error < 1e-12
    assert whole.works[-1, 0] == pytest.approx(kinetic[-1] - kinetic[0], rel=1e-12)
    half = audit_of_powers(t, (0.5 * force * velocity)[:, None], kinetic, kinetic, drives=0)
    assert np.max(np.abs(half.gap)) == pytest.approx(0.5 * (kinetic[-1] - kinetic[0]), rel=1e-9)
