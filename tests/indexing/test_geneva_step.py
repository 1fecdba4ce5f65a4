"""Kinematics of the Geneva wheel: loop closure, derivatives, special cases, the crank's motion law."""

import numpy as np
import pytest

from drivewright import motion
from drivewright.indexing.geneva.crank import Crank
from drivewright.indexing.geneva.step import GenevaStep
from drivewright.validation.geneva_tables import source

pytestmark = pytest.mark.analytical

SLOTS = range(3, 19)


def fitting(slots, centre_distance=0.1):
    return GenevaStep(slots, centre_distance, centre_distance * float(np.sin(np.pi / slots)))


@pytest.mark.parametrize("slots", SLOTS)
def test_the_pin_is_on_the_slot_of_the_wheel(slots):
    """O2 + rho (the direction pi - psi) is the place of the pin on its circle."""
    step = fitting(slots)
    theta = np.linspace(-step.half_engagement, step.half_engagement, 51)
    pin = step.crank_radius * np.exp(1j * theta)
    found = step.centre_distance + step.pin_distance(theta) * np.exp(1j * (np.pi - step.pin_direction(theta).d0))
    assert np.max(np.abs(found - pin)) < 1e-15


@pytest.mark.parametrize("step", [fitting(5), GenevaStep(7, 0.12, 0.055), GenevaStep(3, 1.0, 0.8)])
def test_each_derivative_is_that_of_the_one_before(step):
    theta, h = np.linspace(-1.0, 1.2, 41), 1e-5
    here, before, after = (step.pin_direction(theta + k * h) for k in (0, -1, 1))
    for order in range(3):
        slope = (list(after)[order] - list(before)[order]) / (2 * h)
        assert slope == pytest.approx(list(here)[order + 1], rel=1e-6, abs=1e-7 * np.max(np.abs(list(here)[order + 1])))
    away = (step.pin_distance(theta + h) - step.pin_distance(theta - h)) / (2 * h)
    assert away == pytest.approx(step.pin_travel_rate(theta), rel=1e-6, abs=1e-9)


@pytest.mark.parametrize("slots", SLOTS)
def test_a_fitting_pin_enters_at_rest_and_leaves_after_one_step(slots):
    step = fitting(slots)
    ends = step.pin_direction(np.array([-step.half_engagement, step.half_engagement]))
    assert ends.d0 == pytest.approx([-np.pi / slots, np.pi / slots], rel=1e-12)
    assert ends.d1 == pytest.approx([0.0, 0.0], abs=1e-12)
    assert step.entry_bend == pytest.approx(np.tan(np.pi / slots), rel=1e-12)
    assert step.engagement == pytest.approx(np.pi * (1 - 2 / slots), rel=1e-12)


@pytest.mark.parametrize("step", [fitting(3), fitting(6), fitting(18), GenevaStep(4, 0.1, 0.072)])
def test_the_peaks_are_those_of_a_fine_search(step):
    theta = np.linspace(-step.half_engagement, step.half_engagement, 400_001)
    over = step.pin_direction(theta)
    assert step.largest_rate == pytest.approx(np.max(over.d1), rel=1e-9)
    assert step.largest_bend == pytest.approx(np.max(np.abs(over.d2)), rel=1e-9)
    assert step.largest_third == pytest.approx(np.max(np.abs(over.d3)), rel=1e-9)
    assert abs(theta[np.argmax(over.d2)]) == pytest.approx(step.largest_bend_angle, abs=2e-5)


def test_the_tables_of_the_literature():
    assert [row.name for row in source.rows() if row.verdict != row.pinned] == []


def test_a_longer_crank_meets_the_waiting_slot_and_a_shorter_one_comes_nearest():
    longer, shorter = GenevaStep(4, 0.1, 0.072), GenevaStep(4, 0.1, 0.069)
    assert longer.excess > 0 > shorter.excess
    assert longer.pin_direction(-longer.half_engagement).d0 == pytest.approx(-np.pi / 4, rel=1e-12)
    assert longer.pin_direction(-longer.half_engagement).d1 > 0.1
    at = -shorter.half_engagement + np.array([-1e-3, 0.0, 1e-3])
    aside = shorter.pin_direction(at).d0
    assert np.argmin(aside) == 1 and aside[1] > -np.pi / 4


def test_the_wheel_rests_outside_of_the_step():
    step = fitting(6)
    wheel = step.wheel(np.array([-2.0, 0.0, 2.0]), np.array([False, True, False]))
    assert wheel.d0 == pytest.approx([0.0, np.pi / 6, np.pi / 3]) and wheel.d1[[0, 2]].tolist() == [0.0, 0.0]


@pytest.mark.parametrize("law", ["cycloidal", "modified-sine", "polynomial-4567"])
def test_a_crank_with_a_law_makes_a_turn_from_rest_to_rest(law):
    crank = Crank(3.0, motion.law(law))
    samples = crank.samples(1.1)
    assert samples.angle[[0, -1]] == pytest.approx([-np.pi, np.pi]) and samples.speed[[0, -1]] == pytest.approx([0.0, 0.0], abs=1e-9)
    assert samples.time[-1] == pytest.approx(2 * np.pi / 3)
    inside = samples.angle[samples.engaged]
    assert (inside[0], inside[-1]) == pytest.approx((-1.1, 1.1), abs=1e-9)
    u, h = np.linspace(0.1, 0.9, 31), 1e-6
    before, here, after = (crank.at(u + k * h) for k in (-1, 0, 1))
    for order in range(3):
        slope = (after[order] - before[order]) / (2 * h * crank.period)
        assert slope == pytest.approx(here[order + 1], rel=1e-4, abs=1e-3 * np.max(np.abs(here[order + 1])))


def test_an_even_crank_turns_evenly():
    samples = Crank(5.0).samples(0.7)
    assert np.ptp(samples.speed) == 0.0 and np.max(np.abs(samples.acceleration)) == 0.0
    assert samples.angle == pytest.approx(5.0 * samples.time - np.pi, abs=1e-12)
