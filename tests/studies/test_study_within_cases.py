"""Spread within a case told apart from that of the keys, where both are known: y = f(keys) + noise of known variance."""

import numpy as np
import pytest

from drivewright.studies import sensitivity
from drivewright.studies.answers.within import separate_variances
from drivewright.studies.statistics import share, share_between

pytestmark = pytest.mark.analytical

SIGMA, NOISE = 1.0, 0.8  # by the keys; within a case
CLEAN = np.array([4.0, 1.0]) / 5.0  # first-order shares of y = 2 x1 + x2


def sample(n, rng, noise=NOISE):
    """(x (n, 2), y (n,), variance within each case (n,)): 2 x1 + x2 scaled to `SIGMA`, noise of uneven size."""
    x = rng.normal(size=(n, 2))
    within = noise**2 * rng.uniform(0.5, 1.5, size=n)
    return x, (2 * x[:, 0] + x[:, 1]) * SIGMA / np.sqrt(5) + np.sqrt(within) * rng.normal(size=n), within


def test_standard_deviations_add_in_squares():
    rng = np.random.default_rng(1)
    found = separate_variances(*sample(200_000, rng)[1:])
    assert found.within.value == pytest.approx(NOISE, rel=0.01)
    assert found.keys.value == pytest.approx(SIGMA, rel=0.01)
    assert found.sigma.value == pytest.approx(np.hypot(SIGMA, NOISE), rel=0.01)
    assert found.share.value == pytest.approx(NOISE**2 / (SIGMA**2 + NOISE**2), rel=0.02)


@pytest.mark.parametrize(("n", "noise"), [(30, 0.3), (30, 0.8), (200, 0.8)])
def test_interval_of_the_spread_by_the_keys_covers(n, noise):
    rng = np.random.default_rng(2)
    covers = []
    for _ in range(2000):
        found = separate_variances(*sample(n, rng, noise)[1:])
        true = noise**2 / (SIGMA**2 + noise**2)
        pairs = ((found.keys, SIGMA), (found.within, noise), (found.share, true))
        covers.append([each.low <= number <= each.high for each, number in pairs])
    keys, within, share_within = np.mean(covers, axis=0)
    assert 0.92 <= keys <= 0.98 and 0.92 <= within <= 0.98 and share_within >= 0.95


def test_cases_that_differ_no_more_than_one_by_itself():
    rng = np.random.default_rng(3)
    found = separate_variances(rng.normal(size=5000), np.full(5000, 1.5))
    assert found.keys.value == 0 and found.keys.low == 0 and found.share.value == 1


def test_without_intervals_nothing_is_taken_off():
    y = np.random.default_rng(4).normal(size=50)
    found = separate_variances(y, np.zeros(50))
    assert found.keys.value == pytest.approx(np.std(y, ddof=1)) and found.within.value == 0 and found.share.value == 0
    assert sensitivity.share_by_keys(y, np.zeros(50)) == 1


def test_share_by_keys_and_where_none_is_left():
    rng = np.random.default_rng(5)
    _, y, within = sample(100_000, rng)
    assert sensitivity.share_by_keys(y, within) == pytest.approx(SIGMA**2 / (SIGMA**2 + NOISE**2), rel=0.02)
    assert np.isnan(sensitivity.share_by_keys(y, 10 * within))
    y[::3] = np.nan
    within[::3] = 1e9
    assert sensitivity.share_by_keys(y, within) == pytest.approx(SIGMA**2 / (SIGMA**2 + NOISE**2), rel=0.02)


def test_shares_by_regression_and_ranks_are_those_without_the_noise():
    rng = np.random.default_rng(6)
    x, y, within = sample(200_000, rng)
    more = 1 / sensitivity.share_by_keys(y, within)
    assert more * sensitivity.regression(x, y).coefficients ** 2 == pytest.approx(CLEAN, abs=0.01)
    assert more * sensitivity.by_ranks(sensitivity.orders(x), y) == pytest.approx(CLEAN, abs=0.02)
    assert more * sensitivity.regression(x, y).determination == pytest.approx(1, abs=0.01)
    assert sensitivity.by_ranks(sensitivity.orders(x), y)[0] < 0.6, "or the noise would not matter"


def sobol(n, rng, product=0.0):
    """(a, b, mixed, variances within their cases) of y = 2 x1 + x2 + product x1 x2, with noise as large as the whole."""
    one, other = rng.normal(size=(2, n, 2))
    crossed = [np.column_stack([other[:, 0], one[:, 1]]), np.column_stack([one[:, 0], other[:, 1]])]
    noisy = [2 * x[:, 0] + x[:, 1] + product * x[:, 0] * x[:, 1] for x in (one, other, *crossed)]
    within = [rng.uniform(1.0, 9.0, size=n) for _ in noisy]
    y = [each + np.sqrt(part) * rng.normal(size=n) for each, part in zip(noisy, within, strict=True)]
    return (y[0], y[1], np.array(y[2:])), (within[0], within[1], np.array(within[2:]))


def test_sobol_indices_are_those_without_the_noise():
    y, within = sobol(200_000, np.random.default_rng(7), product=1.0)
    found, raw = sensitivity.indices(*y, within), sensitivity.indices(*y)
    assert found.first == pytest.approx(np.array([4, 1]) / 6, abs=0.02)
    assert found.total == pytest.approx(np.array([5, 2]) / 6, abs=0.02)
    assert raw.first[0] < 0.45 and raw.total[1] > 0.5, "or the noise would not matter"


def test_bootstrap_intervals_of_the_indices_cover():
    rng, covers = np.random.default_rng(8), []
    for _ in range(300):
        y, within = sobol(500, rng)
        found = sensitivity.indices(*y, within)
        ends = (*found.first_interval, *found.total_interval)
        covers += [low <= true <= high for true, (low, high) in zip((*CLEAN, *CLEAN), ends, strict=True)]
    assert 0.91 <= np.mean(covers) <= 0.98


def test_linear_contributions_are_those_without_the_noise():
    rng, sigmas, slope = np.random.default_rng(9), np.array([0.5, 2.0]), np.array([3.0, 0.2])
    within = np.array([0.4, 0.8, 0.1, 0.3])
    steps = np.array([-1.5, 1.5, -0.4, 0.4]) + np.sqrt(within) * rng.normal(size=(100_000, 4))
    plain = np.array([sensitivity.linear(0.0, row, sigmas, np.ones((2, 2)), within).contribution for row in steps[:20_000]])
    assert np.all(plain >= 0)
    # Where the slope stands out of the noise, the mean is that of the slope; where not, what is cut off at 0 makes it larger.
    assert plain[:, 0].mean() == pytest.approx((slope * sigmas)[0] ** 2, rel=0.02)
    raw = np.array([sensitivity.linear(0.0, row, sigmas, np.ones((2, 2))).contribution for row in steps[:20_000]])
    assert raw[:, 0].mean() == pytest.approx((slope * sigmas)[0] ** 2 + (0.4 + 0.8) / 4, rel=0.02)


def test_yield_reaches_from_what_surely_passes_to_what_may():
    found = share_between(40, 55, 70, 100)
    assert found.value == 0.55 and found.low == share(40, 100).low and found.high == share(70, 100).high
    assert share_between(55, 55, 55, 100) == share(55, 100)
