"""Torsion tests under noise: intervals cover as often as they say, and conventions change nothing."""

import numpy as np
import pytest
from torsion_loops import first_order, parallelogram

from drivewright.indexing.torsion_test import Readings, TorsionTestSettings, evaluate_loop, fit_line
from drivewright.indexing.torsion_test.regression import _newey_west, student_half_width

pytestmark = pytest.mark.property

K, H, TOP = 2e5, 4e-4, 1000.0


@pytest.mark.parametrize(("rho", "least"), [(0.0, 0.925), (0.6, 0.925), (0.9, 0.90)])
def test_intervals_cover_the_slope_under_errors_of_first_order(rho, least):
    rng = np.random.default_rng(11)
    x = parallelogram(samples=60, cycles=2).torque
    group, inside, naive, runs = np.arange(240) // 60, 0, 0, 300
    for _ in range(runs):
        line = fit_line(x, 3e-6 * x + first_order(rng, 240, rho, 1e-5), group)
        off = abs(line.slope - 3e-6)
        inside += off < student_half_width(0.95, line.freedom) * np.sqrt(line.variance)
        plain = line.residuals @ line.residuals / 235 / sum(np.var(x[group == g]) * 60 for g in range(4))
        naive += off < 1.96 * np.sqrt(plain)
    assert least <= inside / runs <= 0.99
    if rho > 0.5:
        assert naive / runs < 0.8  # what least squares alone would have claimed


def test_intervals_cover_with_slow_noise_under_white_noise():
    rng = np.random.default_rng(12)
    x = parallelogram(samples=60, cycles=2).torque
    hits = 0
    for _ in range(300):
        line = fit_line(x, x + rng.normal(0, 60, 240) + first_order(rng, 240, 0.95, 60), np.arange(240) // 60)
        hits += abs(line.slope - 1) < student_half_width(0.95, line.freedom) * np.sqrt(line.variance)
    assert hits / 300 > 0.82


def test_the_stiffness_of_a_noisy_test_lies_in_its_intervals():
    rng = np.random.default_rng(13)
    clean, hits, boots = parallelogram(K, H, TOP, 40, 5), [], []
    for _ in range(80):
        noisy = clean._replace(angle=clean.angle + first_order(rng, clean.angle.size, 0.7, 5e-5))
        test = evaluate_loop(noisy, TorsionTestSettings(resamples=200))
        hits.append(test.per_branch.low < K < test.per_branch.high)
        low, high = test.bootstrap["per_branch"]
        boots.append(low < K < high)
        assert test.corrected == test.per_branch and low < test.per_branch.value < high
    assert 0.9 <= np.mean(hits) <= 0.995 and np.mean(boots) > 0.7  # four cycles are few to draw from


def test_the_bootstrap_is_repeatable_and_needs_three_cycles():
    rng = np.random.default_rng(14)
    clean = parallelogram(K, H, TOP, 40, 9)
    noisy = clean._replace(angle=clean.angle + rng.normal(0, 5e-5, clean.angle.size))
    first, again, other = (evaluate_loop(noisy, TorsionTestSettings(seed=seed)).bootstrap for seed in (1, 1, 2))
    assert first == again != other and set(first) == {"whole_loop", "inverse", "per_branch"}
    test = evaluate_loop(noisy)
    for name in first:
        assert first[name][0] < getattr(test, name).value < first[name][1]
    short = evaluate_loop(Readings(noisy.torque[:240], noisy.angle[:240]))
    assert short.bootstrap == {} and any("needs at least 3 cycles, and the test has 2" in text for text in short.findings)


@pytest.fixture(scope="module")
def noisy():
    rng = np.random.default_rng(15)
    clean = parallelogram(K, H, TOP, 40, 4)
    return Readings(clean.torque + rng.normal(0, 3, 320), clean.angle + 1e-4 * np.tanh(clean.torque / 80) + rng.normal(0, 2e-5, 320))


def numbers(test):
    stiff = [v for name in ("whole_loop", "inverse", "per_branch", "corrected") for v in getattr(test, name)]
    return np.array(stiff), np.array(test.shape[:5]), np.array(test.pieces[:5])


def same(left, right, **factors):
    for a, b in zip(numbers(left), numbers(right), strict=True):
        np.testing.assert_allclose(a, b, rtol=1e-6)


def test_the_zero_of_the_angle_changes_nothing(noisy):
    same(evaluate_loop(noisy), evaluate_loop(noisy._replace(angle=noisy.angle + 0.37)))


def test_the_sense_of_turning_changes_nothing(noisy):
    turned = evaluate_loop(Readings(-noisy.torque, -noisy.angle))
    same(evaluate_loop(noisy), turned)
    assert turned.loading.value == pytest.approx(evaluate_loop(noisy).unloading.value, rel=1e-12)


def test_units_scale_and_nothing_else(noisy):
    """Metres, kilograms and radians are conventions: k goes with torque over angle, energy with their product."""
    before, after = evaluate_loop(noisy), evaluate_loop(Readings(noisy.torque * 8.85, noisy.angle * 3437.7))
    for a, b, factors in zip(
        numbers(before),
        numbers(after),
        (8.85 / 3437.7, np.array([3437.7, 3437.7, 8.85 * 3437.7, 1, 8.85 / 3437.7]), np.array([8.85 / 3437.7] * 3 + [8.85] * 2)),
        strict=True,
    ):
        np.testing.assert_allclose(a * factors, b, rtol=1e-5)


def test_the_uncertainty_falls_with_the_root_of_the_number_of_cycles():
    def spread(cycles, seed):
        rng = np.random.default_rng(seed)
        clean = parallelogram(K, H, TOP, 40, cycles)
        return evaluate_loop(clean._replace(angle=clean.angle + rng.normal(0, 5e-5, clean.angle.size))).per_branch.uncertainty

    few, many = (np.mean([spread(cycles, seed) for seed in range(8)]) for cycles in (3, 9))
    assert few / many == pytest.approx(2.0, rel=0.12)  # 2 and 8 cycles after the first


def test_higher_confidence_is_a_wider_interval_by_student(noisy):
    wide, narrow = (evaluate_loop(noisy, TorsionTestSettings(confidence=c)) for c in (0.99, 0.9))
    f = narrow.line.freedom
    ratio = (1 / wide.per_branch.low - 1 / wide.per_branch.high) / (1 / narrow.per_branch.low - 1 / narrow.per_branch.high)
    assert ratio == pytest.approx(student_half_width(0.99, f) / student_half_width(0.9, f), rel=1e-9) and student_half_width(
        0.95, 4
    ) == pytest.approx(2.776445, rel=1e-6)


def test_newey_west_is_the_weighted_sum_over_all_pairs():
    scores, lags = np.random.default_rng(16).normal(size=30), 8  # 1.3 sqrt(30), rounded up
    weights = np.maximum(1 - np.abs(np.subtract.outer(np.arange(30), np.arange(30))) / (lags + 1), 0)
    assert _newey_west(scores, 3) == pytest.approx(scores @ weights @ scores * 30 / 27, rel=1e-12)


def test_errors_that_alternate_do_not_count_for_more_than_they_are():
    x = np.linspace(-1, 1, 80)
    assert fit_line(x, x + 0.1 * (-1.0) ** np.arange(80) + np.random.default_rng(17).normal(0, 0.01, 80)).freedom <= 78
