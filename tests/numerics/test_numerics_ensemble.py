"""Estimates from ensembles: coverage, false alarms and power by experiments with processes whose mean and memory are known."""

from functools import cache, partial

import numpy as np
import pytest
from scipy.signal import lfilter
from scipy.special import stdtrit

from drivewright.errors import InputError
from drivewright.numerics.ensemble import (
    ENOUGH,
    FALSE_ALARM,
    _autocorrelation_time,
    estimate,
    estimate_statistic,
    mean_of_members,
    predict_member,
)
from drivewright.result import Value

pytestmark = pytest.mark.analytical

TRIALS = 1000
# (members, windows, coefficient): from 4 members on any length, one run from 16 effective samples on.
SIZES = (
    (1, 64, 0.0),
    (1, 64, 0.5),
    (1, 256, 0.8),
    (2, 32, 0.5),
    (4, 6, 0.0),
    (4, 8, 0.5),
    (4, 32, 0.8),
    (8, 4, 0.5),
    (8, 16, 0.8),
    (16, 8, 0.9),
)


def autoregressive(trials, members, windows, coefficient, seed=1):
    """Stationary x_k = coefficient x_(k-1) + e_k of mean 0 and variance 1: tau = (1 + coefficient)/(1 - coefficient)."""
    noise = np.random.default_rng(seed).normal(size=(trials, members, windows))
    noise[..., 1:] *= np.sqrt(1 - coefficient**2)
    return lfilter([1.0], [1.0, -coefficient], noise, axis=-1)


@cache
def estimates(members, windows, coefficient):
    return [estimate(samples) for samples in autoregressive(TRIALS, members, windows, coefficient)]


def share(flags):
    return float(np.mean(list(flags)))


@pytest.mark.parametrize("size", SIZES)
def test_interval_covers_the_mean_in_92_to_98_percent(size):
    assert 0.92 <= share(e.low <= 0 <= e.high for e in estimates(*size)) <= 0.98


@pytest.mark.parametrize(("size", "tolerance"), [((1, 256, 0.8), 0.25), ((4, 32, 0.0), 0.1), ((4, 32, 0.8), 0.15), ((8, 16, 0.8), 0.25)])
def test_effective_samples_are_those_of_the_known_autocorrelation_time(size, tolerance):
    members, windows, coefficient = size
    k = np.arange(1, windows)
    known = members * windows / (1 + 2 * np.sum((1 - k / windows) * coefficient**k))
    assert np.median([e.effective for e in estimates(*size)]) == pytest.approx(known, rel=tolerance)


def test_half_width_is_that_of_the_standard_error():
    """sigma sqrt(tau / (members windows)) times Student's 1.96, from 77 effective samples."""
    expected = 1.99 * np.sqrt(3 / 256)
    assert np.median([(e.high - e.low) / 2 for e in estimates(8, 32, 0.5)]) == pytest.approx(expected, rel=0.08)


@pytest.mark.parametrize("size", [(4, 4, 0.0), (4, 8, 0.5), (2, 32, 0.8)])
def test_the_square_of_the_standard_error_of_members_is_unbiased(size):
    members, windows, coefficient = size
    k = np.arange(1, windows)
    known = (1 + 2 * np.sum((1 - k / windows) * coefficient**k)) / (members * windows)
    squares = np.array([estimate(x).error ** 2 for x in autoregressive(TRIALS, *size)])
    assert squares.mean() == pytest.approx(known, abs=4 * squares.std() / np.sqrt(TRIALS))


@pytest.mark.parametrize("size", [(1, 256, 0.5), (4, 8, 0.0), (4, 32, 0.5), (8, 16, 0.8)])
def test_settled_ensembles_raise_few_false_alarms(size):
    assert share(not e.settled for e in estimates(*size)) <= 3 * FALSE_ALARM


@pytest.mark.parametrize(("size", "deviations"), [((1, 256, 0.5), 6), ((4, 8, 0.0), 6), ((4, 32, 0.5), 6), ((8, 16, 0.8), 6)])
def test_a_drift_is_found(size, deviations):
    """A straight drift whose half means differ by so many standard deviations of that difference, in 95 % of the trials."""
    members, windows, coefficient = size
    error = np.sqrt((1 + coefficient) / (1 - coefficient) / (members * windows))
    drift = 4 * deviations * error * np.linspace(-0.5, 0.5, windows)
    assert share(not estimate(x + drift).settled for x in autoregressive(500, *size)) >= 0.95


@pytest.mark.parametrize(
    "samples",
    [np.arange(8.0), np.tile(np.arange(6.0), (4, 1)), np.repeat([1.0, 2.0], 4), np.exp(-np.arange(20) / 8)],
    ids=["ramp", "same ramp in all", "step", "decay"],
)
def test_a_drift_without_noise_is_not_settled_and_its_interval_holds_both_halves(samples):
    found, rows = estimate(samples), np.atleast_2d(samples)
    assert not found.settled
    for half in np.split(rows, 2, axis=1):
        assert found.low - 1e-12 <= half.mean() <= found.high + 1e-12


@pytest.mark.parametrize("shape", [(1, 1), (1, 2), (1, 3), (2, 2), (1, 5)])
def test_few_windows_are_never_settled(shape):
    rng = np.random.default_rng(3)
    for _ in range(200):
        assert not estimate(rng.normal(size=shape)).settled


def test_long_memory_is_not_settled():
    """32 windows of one run that remembers 40 have fewer than the samples that a drift takes to be seen."""
    found = [estimate(x) for x in autoregressive(500, 1, 32, 0.95)]
    assert share(e.settled for e in found) < 0.3


def test_members_that_disagree_for_good_count_once_each():
    """Each on an attractor of its own: the windows of one say nothing about the others."""
    rng = np.random.default_rng(4)
    samples = np.array([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0])[:, None] + 0.01 * rng.normal(size=(8, 50))
    found = estimate(samples)
    assert found.effective == pytest.approx(8, rel=0.15)
    assert 0.7 < (found.high - found.low) / 2 / (2.45 * np.std(np.arange(8), ddof=1) / np.sqrt(8)) < 1.3


def test_alternating_windows_are_not_counted_twice():
    found = estimate(np.tile([1.0, 3.0], (2, 10)) + 1e-3 * np.random.default_rng(5).normal(size=(2, 20)))
    assert found.effective == pytest.approx(40, rel=1e-3)
    assert found.low <= 2 <= found.high


def test_the_standard_error_of_one_run_is_that_of_its_interval():
    for samples in autoregressive(20, 1, 64, 0.5):
        found = estimate(samples)
        if found.settled:  # that of a drift is widened
            assert (found.high - found.low) / 2 == pytest.approx(stdtrit(found.effective - 1, 0.975) * found.error, rel=1e-12)


def test_sums_of_pairs_of_lags_never_rise_again():
    """1, 0.1 and then at most 0.1 until the sum is negative: tau = 2 (1 + 0.1 + 0.1) - 1."""
    assert _autocorrelation_time(np.array([1.0, 0.0, 0.1, 0.0, 0.4, 0.2, -1.0, 0.0])) == pytest.approx(1.4, rel=1e-12)


# -- periodic ------------------------------------------------------------------------------------------------------------------


def test_a_constant_is_periodic():
    found = estimate(np.full((4, 8), 3.5))
    assert (found.value, found.interval, found.settled, found.effective) == (3.5, "periodic", True, 32)
    assert found.high - found.value == pytest.approx(3.5e-9) == found.value - found.low


def test_rounding_is_periodic_and_more_is_not():
    wobble = np.random.default_rng(6).uniform(-0.5, 0.5, size=(4, 8))
    assert estimate(7.0 * (1 + 1e-9 * wobble)).interval == "periodic"
    assert estimate(7.0 * (1 + 1e-8 * wobble)).interval == "ensemble"
    assert estimate(7.0 * (1 + 1e-8 * wobble), rounding=1e-7).interval == "periodic"
    assert estimate(1e-12 * wobble, scale=1.0).interval == "periodic"
    assert estimate(1e-12 * wobble).interval == "ensemble"


def test_one_window_is_not_called_periodic():
    assert estimate(np.full((4, 1), 2.0)).interval == "ensemble"
    assert estimate([2.0]).interval == ""


# -- units and order -----------------------------------------------------------------------------------------------------------


def test_scale_shift_and_order_of_members():
    samples = autoregressive(1, 4, 16, 0.5)[0]
    found, moved, turned = estimate(samples), estimate(5.0 - 1e3 * samples), estimate(samples[::-1])
    assert moved.value == pytest.approx(5.0 - 1e3 * found.value)
    assert (moved.low, moved.high) == pytest.approx((5.0 - 1e3 * found.high, 5.0 - 1e3 * found.low))
    assert moved.effective == pytest.approx(found.effective) == turned.effective
    assert (turned.low, turned.high) == pytest.approx((found.low, found.high))


@pytest.mark.parametrize("bad", [np.zeros((2, 0)), np.zeros((2, 2, 2)), np.array([[1.0, np.nan]])])
def test_what_is_no_ensemble_is_refused(bad):
    with pytest.raises(InputError, match="members, windows"):
        estimate(bad)


# -- statistics that are not means -----------------------------------------------------------------------------------------------


def root_mean_square(samples, axis):
    return np.sqrt(np.mean(samples**2, axis=axis))


STATISTICS = {"largest": np.max, "percentile": partial(np.quantile, q=0.9), "root mean square": root_mean_square}


@pytest.mark.parametrize("name", STATISTICS)
@pytest.mark.parametrize("size", [(4, 16, 0.5), (8, 16, 0.8), (8, 64, 0.5)])
def test_interval_covers_the_statistic_of_a_run(name, size):
    members, windows, coefficient = size
    statistic = STATISTICS[name]
    known = float(np.mean(statistic(autoregressive(1, 50_000, windows, coefficient, seed=7)[0], axis=1)))
    found = [estimate_statistic(x, statistic) for x in autoregressive(1000, *size)]
    assert 0.92 <= share(e.low <= known <= e.high for e in found) <= 0.98


def test_growth_of_the_spread_is_found_where_the_mean_stays():
    """Amplitudes six times as large in the second half: the largest has not settled, and the mean does not tell."""
    rows = autoregressive(300, 8, 32, 0.0) * np.repeat([1.0, 6.0], 16)
    assert share(not estimate_statistic(x, np.max).settled for x in rows) >= 0.95
    assert share(not estimate_statistic(x, np.max).settled for x in autoregressive(TRIALS, 8, 32, 0.0)) <= 3 * FALSE_ALARM


def test_a_step_of_the_mean_unsettles_a_statistic_that_does_not_feel_it():
    """The range of each half stays, and the mean moves by a standard deviation."""
    rows = autoregressive(200, 8, 32, 0.0)
    moved = rows + np.repeat([0.0, 1.0], 16)
    assert share(estimate_statistic(x, np.ptp).settled for x in rows) >= 0.95
    assert share(not estimate_statistic(x, np.ptp).settled for x in moved) >= 0.99


@pytest.mark.parametrize("shape", [(2, 2), (2, 1), (5, 1)])
def test_statistics_of_few_windows_are_never_settled(shape):
    rng = np.random.default_rng(3)
    assert not any(estimate_statistic(rng.normal(size=shape), np.max).settled for _ in range(200))


def test_both_tests_of_a_statistic_share_the_false_alarm():
    """Half of it each: no more than 1 % of 2000 settled ensembles, and three standard deviations of that count."""
    alarms = share(not estimate_statistic(x, np.max).settled for x in autoregressive(2000, 8, 16, 0.0, seed=11))
    assert alarms <= FALSE_ALARM + 3 * np.sqrt(FALSE_ALARM / 2000)


def test_a_statistic_of_one_member_has_no_interval_and_of_a_constant_no_width():
    alone = estimate_statistic([1.0, 2.0, 3.0, 2.0], np.max)
    assert (alone.value, alone.interval, alone.settled) == (3.0, "", False)
    assert np.isnan(alone.low) and np.isnan(alone.high)
    assert estimate_statistic(np.full((3, 4), 2.0), np.max).interval == "periodic"


def test_numbers_of_members_have_students_interval():
    """Means 2 and 5; t(2) = 4.3027 times the standard deviations 1 and 2 of three, over sqrt(3)."""
    mean, reach = mean_of_members(np.array([[1.0, 3.0], [2.0, 5.0], [3.0, 7.0]]))
    np.testing.assert_allclose(mean, [2.0, 5.0])
    np.testing.assert_allclose(reach, 4.3027 * np.array([1.0, 2.0]) / np.sqrt(3), rtol=1e-4)


# -- as a value of a result ----------------------------------------------------------------------------------------------------


def test_value_of_an_estimate():
    found = estimate(autoregressive(1, 8, 16, 0.5)[0] + 10)
    value = Value.of(found, "m", "fluctuation")
    assert value == Value(found.value, "m", "fluctuation", found.low, found.high, "ensemble", True, found.error, "Fluctuation")
    assert value.record() == {
        "value": found.value,
        "unit": "m",
        "label": "Fluctuation",
        "meaning": "fluctuation",
        "low": found.low,
        "high": found.high,
        "interval": "ensemble",
    }
    assert all(type(each) is float for each in (value.value, value.low, value.high))


def test_value_without_interval_and_not_settled():
    value = Value.of(estimate([2.0]), "m", "fluctuation")
    assert value.record() == {"value": 2.0, "unit": "m", "label": "Fluctuation", "meaning": "fluctuation", "settled": False}
    assert ENOUGH > 1


def test_one_more_draw_lies_in_the_interval_of_a_draw_as_often_as_it_says():
    rng, hits = np.random.default_rng(5), 0
    for _ in range(4000):
        numbers = rng.normal(3.0, 2.0, 5)
        found = predict_member(numbers[:4])
        assert found.value == numbers[0] and found.low < found.value < found.high
        hits += found.low < numbers[4] < found.high
    assert 0.94 < hits / 4000 < 0.96
    assert not np.isfinite(predict_member(np.array([1.5])).low)


def test_means_of_members_cover_as_often_as_they_say():
    numbers = np.random.default_rng(6).normal(1.0, 0.3, (4, 20_000))
    mean, reach = mean_of_members(numbers)
    assert 0.945 < np.mean(np.abs(mean - 1.0) < reach) < 0.955
    assert np.all(np.isnan(mean_of_members(numbers[:1])[1]))
