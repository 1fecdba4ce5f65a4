"""Torsion tests with a known answer: slopes, play, hysteresis, pieces and series springs in closed form."""

import numpy as np
import pytest
from torsion_loops import parallelogram, there_and_back, whole_loop_of

from drivewright.errors import InputError
from drivewright.indexing.torsion_test import (
    Readings,
    SeriesSpring,
    TorsionTestSettings,
    evaluate_loop,
    evaluate_positions,
    fit_line,
    fit_pieces,
    remove_series_springs,
)
from drivewright.indexing.torsion_test.passes import turning_points
from drivewright.indexing.torsion_test.regression import Estimate

pytestmark = pytest.mark.analytical

K, H, TOP = 2e5, 1.3e-3, 800.0


def closely(value):
    return pytest.approx(value, rel=1e-9)


@pytest.mark.parametrize(("cycles", "start"), [(1, 0), (1, 23), (3, 0), (4, 57), (5, 20)])
def test_a_parallelogram_returns_its_stiffness_wherever_it_begins(cycles, start):
    test = evaluate_loop(parallelogram(K, H, TOP, 41, cycles, start))
    assert test.whole_loop.value == closely(whole_loop_of(K, H, TOP, 41))
    assert [e.value for e in (test.per_branch, test.inverse, test.loading, test.unloading, test.corrected)] == [closely(K)] * 5
    assert test.per_branch.uncertainty == 0 and test.per_branch.low == test.per_branch.high == test.per_branch.value


def test_the_whole_loop_tends_to_the_formula_of_the_sheet():
    found = evaluate_loop(parallelogram(K, H, TOP, 4_001)).whole_loop.value
    assert found == pytest.approx(K / (1 + 3 * H**2 * K**2 / TOP**2), rel=2e-4) and found < 0.8 * K


def test_whole_loop_is_equation_3_of_the_paper():
    rng = np.random.default_rng(3)
    readings = parallelogram(K, H, TOP)
    torque, angle = readings.torque + rng.normal(0, 5, 82), readings.angle + rng.normal(0, 1e-4, 82)
    printed = (np.mean(angle * torque) - np.mean(angle) * np.mean(torque)) / (np.mean(angle**2) - np.mean(angle) ** 2)
    assert evaluate_loop(Readings(torque, angle)).whole_loop.value == closely(printed)


def test_play_and_hysteresis_of_a_parallelogram():
    test = evaluate_loop(parallelogram(K, H, TOP), TorsionTestSettings(rated_torque=700.0))
    assert test.shape.backlash == closely(2 * H) and test.shape.lost_motion == closely(0.06 * 700 / K)
    assert test.shape.hysteresis_energy == closely(4 * H * TOP) and test.shape.secant == closely(K)
    assert test.shape.hysteresis_loss == closely(4 * H * TOP / (TOP**2 / K + 4 * H * TOP))
    assert test.pieces[:3] == pytest.approx((K, K, K), rel=1e-9) and np.isnan(test.pieces.t1) and np.isnan(test.pieces.t2)


def test_backlash_inside_the_branches_is_lost_motion_and_leaves_their_stiffness():
    torque = np.tile(np.concatenate([np.linspace(-900, 900, 180), np.linspace(900, -900, 180)]), 3)
    test = evaluate_loop(Readings(torque, torque / K + 4e-4 * np.sign(torque)), TorsionTestSettings(rated_torque=1000.0))
    assert test.per_branch.value == closely(K) and test.shape.lost_motion == closely(8e-4 + 60 / K)
    assert test.whole_loop.value < 0.9 * K and test.inverse.value < 0.9 * K
    assert any("are split there" in text and "within 30 N·m" in text for text in test.findings)
    straight = evaluate_loop(Readings(torque, torque / K + 4e-5 * np.sin(torque)))
    assert not any("are split there" in text for text in straight.findings)


def test_one_branch_gives_a_stiffness_and_says_what_is_absent():
    torque = np.linspace(0, TOP, 30)
    test = evaluate_loop(Readings(torque, torque / K + 0.2))
    assert test.per_branch.value == test.loading.value == closely(K) and test.unloading is None and np.all(np.isnan(test.shape))
    assert any("one branch only" in text for text in test.findings)


def test_a_one_sided_loop_has_hysteresis_but_no_lost_motion():
    torque = np.concatenate([np.linspace(0, TOP, 50), np.linspace(TOP, 0, 50)])
    test = evaluate_loop(Readings(torque, torque / K + np.repeat([-H, H], 50)))
    assert test.per_branch.value == closely(K) and test.shape.hysteresis_energy == closely(2 * H * TOP)
    assert test.shape.backlash == closely(2 * H) and np.isnan(test.shape.lost_motion) and test.pieces.k1 == closely(K)


def test_the_rise_from_rest_and_the_first_cycle_are_left_out():
    def measured(torque, bad):
        angle = torque / K + H * np.where(np.diff(torque, prepend=-1) > 0, -1, 1)
        return Readings(torque, angle + np.where(np.arange(torque.size) < bad, 0.03 * torque / K, 0))

    one_and_a_quarter = np.concatenate([np.linspace(0, TOP, 40), np.linspace(TOP, -TOP, 80)[1:], np.linspace(-TOP, TOP, 80)[1:]])
    test = evaluate_loop(measured(one_and_a_quarter, 40))
    assert test.torque.size == 79 + 79 and test.torque[0] == closely(one_and_a_quarter[40])
    assert "left out: the first rise from rest" in test.findings
    three = there_and_back(TOP, 40, 3)
    test = evaluate_loop(measured(three, 160))
    assert test.torque.size == 320 and test.per_branch.value == closely(K)
    assert "left out: the first cycle (conditioning)" in test.findings
    named = evaluate_loop(measured(three, 160)._replace(cycle=np.repeat([7, 8, 9], 160)))
    assert named.torque.size == 320 and named.per_branch == test.per_branch


def test_an_unfinished_last_cycle_is_left_out_of_the_whole_loop():
    whole = parallelogram(K, H, TOP, 41, 3)
    test = evaluate_loop(Readings(*(np.concatenate([column, column[:30]]) for column in whole[:2])))
    assert test.torque.size == 164 and test.whole_loop.value == closely(whole_loop_of(K, H, TOP, 41))
    assert any("unfinished last cycle" in text for text in test.findings)


def test_drift_between_cycles_is_removed_and_hysteresis_stays():
    clean = parallelogram(K, H, TOP, 41, 4)
    drifting = clean._replace(angle=clean.angle + 3e-6 * np.arange(clean.angle.size))
    test = evaluate_loop(drifting)
    assert test.drift == pytest.approx(3e-6 * (test.torque.size - 1), rel=1e-6)
    assert test.shape.backlash == pytest.approx(2 * H, rel=1e-6) and test.per_branch.value == pytest.approx(K, rel=1e-6)
    alone = evaluate_loop(parallelogram(K, H, TOP))
    assert alone.drift is None and any("cannot be separated from hysteresis" in text for text in alone.findings)


def test_named_branches_may_mean_direction_or_size_of_the_torque():
    readings = Readings(there_and_back(TOP, 40, 1), there_and_back(TOP, 40, 1) / K)
    by_size = readings._replace(branch=np.repeat([1, -1, 1, -1], 40))
    rng = np.random.default_rng(2)
    noisy = by_size._replace(torque=by_size.torque + rng.normal(0, 300, 160))
    assert evaluate_loop(by_size).loading.value == closely(K) and evaluate_loop(by_size).unloading.value == closely(K)
    assert evaluate_loop(noisy).unloading is not None and np.unique(evaluate_loop(noisy).group).size == 3


def test_turning_points_stand_noise():
    rng = np.random.default_rng(1)
    torque = there_and_back(1000.0, 100, 2)
    cuts = turning_points(torque + rng.normal(0, 20, torque.size))
    assert np.allclose(cuts, [101, 301, 501, 701], atol=6)
    assert turning_points(np.array([0, 1, 2, 3, 2, 1, 0, -1.0])).tolist() == [4]
    assert turning_points(np.array([0, 1, 2, 3, 3, 2, 1, 0.0])).tolist() == [4]


@pytest.mark.parametrize(("t1", "t2", "k"), [(200.0, 550.0, (1e5, 2e5, 3e5)), (37.0, 700.0, (3e5, 1e5, 2e5))])
def test_pieces_find_their_breakpoints(t1, t2, k):
    torque = np.linspace(0, 800, 161)
    angle = np.minimum(torque, t1) / k[0] + np.clip(torque - t1, 0, t2 - t1) / k[1] + np.maximum(torque - t2, 0) / k[2]
    found = fit_pieces(torque, angle)
    assert found[:3] == pytest.approx(k, rel=2e-3) and found[3:5] == pytest.approx((t1, t2), abs=2)
    assert found.rms < 1e-4 * angle[-1]


def test_pieces_and_secant_of_a_softening_loop():
    torque = np.concatenate([np.linspace(-1000, 1000, 401), np.linspace(1000, -1000, 401)])
    size = np.abs(torque)
    angle = np.sign(torque) * (np.minimum(size, 250) / 1e5 + np.clip(size - 250, 0, 350) / 2e5 + np.maximum(size - 600, 0) / 4e5)
    test = evaluate_loop(Readings(torque, angle + np.repeat([-1e-4, 1e-4], 401)), TorsionTestSettings(rated_torque=1000.0))
    assert test.pieces[:5] == pytest.approx((1e5, 2e5, 4e5, 250, 600), rel=5e-3)
    assert test.shape.secant == closely(500 / (100 / 2e5 + 400 / 4e5)) and test.shape.backlash == closely(2e-4)


def test_a_turning_point_of_one_sample_serves_both_branches():
    torque = there_and_back(TOP, 20, 1)
    test = evaluate_loop(Readings(torque, torque / K), TorsionTestSettings(rated_torque=TOP))
    assert test.shape.secant == closely(K) and not any("close" in text or "absent: both" in text for text in test.findings)
    assert np.isnan(evaluate_loop(Readings(torque, torque / K), TorsionTestSettings(rated_torque=1.1 * TOP)).shape.secant)


def test_series_springs_in_closed_form():
    measured, parts = Estimate(1e5, 2e3, 0, 0), (SeriesSpring("bar", 4e5, 1e4), SeriesSpring("support", 8e5, 5e4))
    found = remove_series_springs(measured, 1e9, parts)
    k = 1 / (1 / 1e5 - 1 / 4e5 - 1 / 8e5)
    u = k**2 * np.sqrt((2e3 / 1e5**2) ** 2 + (1e4 / 4e5**2) ** 2 + (5e4 / 8e5**2) ** 2)
    assert found.value == closely(k) and found.uncertainty == closely(u)
    reach = pytest.approx(1.959964 * u / k**2, rel=1e-5)
    assert 1 / found.low - 1 / k == reach and 1 / k - 1 / found.high == reach
    wanted = r"1/100000 - 1/400000 - 1/50000 .* is not positive.*Check the bar stiffness .*well above 100000 N·m/rad"
    with pytest.raises(InputError, match=wanted):
        remove_series_springs(measured, 10, (SeriesSpring("support", 4e5), SeriesSpring("bar", 5e4)))


def test_the_series_correction_undoes_the_rig():
    bar, support = SeriesSpring("bar", 9e5), SeriesSpring("support", 7e5)
    rig = 1 / (1 / K + 1 / bar.stiffness + 1 / support.stiffness)
    test = evaluate_loop(parallelogram(rig, H, TOP), TorsionTestSettings(parts=(bar, support)))
    assert test.per_branch.value == closely(rig) and test.corrected.value == closely(K)
    assert not any("corrected" in text for text in test.findings)
    soft = evaluate_loop(parallelogram(0.45 * K, H, TOP), TorsionTestSettings(parts=(SeriesSpring("bar", 0.45 * K / 0.55),)))
    assert soft.corrected.value == closely(K)
    assert any("corrected stiffness is 2.22 times the measured one" in text for text in soft.findings)


def test_positions_of_the_crank_are_evaluated_one_by_one():
    loops = [parallelogram(k, H, TOP) for k in (3e5, 1e5, 2e5)]
    crank = np.repeat([0.6, 0.1, 0.3], 82)
    torque, angle = (np.concatenate([loop[n] for loop in loops]) for n in (0, 1))
    tests = evaluate_positions(Readings(torque, angle, crank=crank))
    assert [test.crank for test in tests] == [0.1, 0.3, 0.6]
    assert [test.per_branch.value for test in tests] == [closely(k) for k in (1e5, 2e5, 3e5)]


def test_a_line_by_groups_is_the_weighted_mean_of_its_slopes():
    rng = np.random.default_rng(5)
    x, y, group = rng.normal(size=60), rng.normal(size=60), np.repeat([4, 9, 2], 20)
    slopes, weights = zip(*((np.polyfit(x[group == g], y[group == g], 1)[0], 20 * np.var(x[group == g])) for g in (2, 4, 9)), strict=True)
    found = fit_line(x, y, group)
    assert found.slope == closely(np.average(slopes, weights=weights))
    means = [np.mean(y[group == g]) - found.slope * np.mean(x[group == g]) for g in (2, 4, 9)]
    assert found.intercepts == pytest.approx(means)
    assert found.residuals == pytest.approx(y - found.slope * x - np.repeat([means[1], means[2], means[0]], 20))
