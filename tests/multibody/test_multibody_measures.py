"""Peaks and the impact load coefficient of signals whose peaks are known."""

import numpy as np
import pytest

from drivewright.multibody.measures import highest, impact_load, largest, peaks

pytestmark = pytest.mark.analytical

TURN = 2 * np.pi


def test_peaks_of_a_sine_are_found_between_the_samples():
    t = np.linspace(0, 3, 301) + 0.0007
    times, values = peaks(t, 2.0 * np.sin(TURN * t))
    np.testing.assert_allclose(times, [0.25, 1.25, 2.25], atol=1e-5)
    np.testing.assert_allclose(values, 2.0, rtol=1e-6)


def test_where_the_steps_differ_much_the_sample_counts():
    t = np.array([0.0, 1.0, 1.01, 2.0, 3.0])
    times, values = peaks(t, np.array([0.0, 0.9, 1.0, 0.2, 0.1]))
    assert (times, values) == (1.01, 1.0)


def test_the_largest_magnitude_counts_negative_peaks_and_the_ends():
    t = np.linspace(0, 1, 1001)
    assert largest(t, -3.0 * np.sin(TURN * t) + 0.5) == pytest.approx(3.5, rel=1e-6)
    assert largest(t, np.exp(t)) == pytest.approx(np.e)


def test_the_coefficient_is_the_mean_of_the_five_largest_peaks_over_the_ideal_one():
    t = np.linspace(0, 8, 8001)
    size = np.array([1.0, 3.0, 2.0, 5.0, 4.0, 7.0, 6.0, 8.0])
    load = impact_load(t, size[np.minimum(t.astype(int), 7)] * np.sin(np.pi * t) ** 2 * np.sign(np.sin(np.pi * t)), 2.0, 1.0)
    assert load.coefficient == pytest.approx(np.mean([8, 7, 6, 5, 4]) / 2, rel=1e-5)
    assert load.largest == pytest.approx(4.0, rel=1e-5)
    assert load.turn_mean == pytest.approx(np.mean(size) / 2, rel=1e-5)
    assert load.turn_spread == pytest.approx(np.std(size) / 2, rel=1e-5)


def test_root_mean_square_and_percentile_of_a_sine_over_its_peak():
    t = np.linspace(0, 6, 60_001)
    load = impact_load(t, 4.0 * np.sin(TURN * t), 4.0, 1.0)
    assert load.rms == pytest.approx(np.sqrt(0.5), rel=1e-4)
    assert load.percentile == pytest.approx(np.sin(0.95 * np.pi / 2), rel=1e-4)


def test_the_highest_and_the_lowest_place_of_motions_are_found_between_the_samples():
    t = np.linspace(0, 1, 73)
    swing, rise = 0.3 + 0.7 * np.cos(TURN * t + 0.1), np.exp(t)
    np.testing.assert_allclose(highest(t, np.stack([swing, -swing, rise, -rise])), [1.0, 0.4, np.e, -1.0], rtol=1e-5)


def test_the_highest_of_many_signals_do_not_depend_on_how_many_are_looked_at_at_once(monkeypatch):
    t = np.linspace(0, 1, 73)
    signals = np.sin(np.outer(np.arange(1, 8), TURN * t + 0.3))
    together = highest(t, signals)
    monkeypatch.setattr("drivewright.multibody.measures.BLOCK", 150)
    np.testing.assert_array_equal(highest(t, signals), together)
    np.testing.assert_allclose(together, [largest(t, np.maximum(signal, 0.0)) for signal in signals], rtol=1e-3)


def test_fewer_than_five_peaks_give_no_coefficient():
    t = np.linspace(0, 2, 201)
    assert np.isnan(impact_load(t, np.sin(TURN * t / 2), 1.0, 1.0).coefficient)
    assert np.isnan(impact_load(t, np.sin(20 * t), 0.0, 1.0).coefficient)
