"""Statistics of a sample: closed forms, exact properties, and intervals that hold the truth as often as they say."""

import numpy as np
import pytest
from scipy import stats

from drivewright.studies.statistics import PERCENTS, capability, finite, percentiles, share, summary, varies

pytestmark = pytest.mark.analytical

SAMPLE = np.array([3.1, -0.4, 7.7, 2.2, 2.9, 5.0, 1.3])


def test_moments_and_intervals_are_the_textbook_ones():
    found, n = summary(SAMPLE), len(SAMPLE)
    mean, sigma = SAMPLE.mean(), SAMPLE.std(ddof=1)
    assert found.mean == pytest.approx((mean, *stats.t.interval(0.95, n - 1, mean, sigma / np.sqrt(n))), rel=1e-12)
    chi2 = stats.chi2.ppf([0.975, 0.025], n - 1)
    assert found.sigma == pytest.approx((sigma, *(sigma * np.sqrt((n - 1) / chi2))), rel=1e-12)
    assert found.skewness.value == pytest.approx(stats.skew(SAMPLE), rel=1e-12)
    assert (found.least, found.greatest, found.cases, found.absent) == (-0.4, 7.7, 7, 0)
    assert found.percentiles[PERCENTS.index(50.0)].value == 2.9


def test_the_order_of_the_cases_changes_no_bit():
    sample = np.random.default_rng(3).gumbel(size=501)
    assert summary(sample) == summary(sample[::-1]) == summary(np.random.default_rng(4).permutation(sample))


def numbers(found):
    return np.array([*found.mean, *found.sigma, found.least, found.greatest, *(x for each in found.percentiles for x in each)])


def test_another_unit_scales_and_another_zero_shifts():
    sample = np.random.default_rng(5).gumbel(size=2000)
    one, scaled, shifted = (summary(each) for each in (sample, -1e3 * sample, sample + 20.0))
    assert numbers(shifted)[[0, 1, 2]] == pytest.approx(numbers(one)[[0, 1, 2]] + 20.0, rel=1e-12)
    assert shifted.sigma == pytest.approx(one.sigma, rel=1e-9) and shifted.skewness == pytest.approx(one.skewness, rel=1e-9)
    assert scaled.sigma == pytest.approx(tuple(1e3 * x for x in one.sigma), rel=1e-12)
    assert scaled.skewness.value == pytest.approx(-one.skewness.value, rel=1e-9)
    mirrored = [tuple(-1e3 * x for x in (each.value, each.high, each.low)) for each in reversed(one.percentiles)]
    assert [tuple(each) for each in scaled.percentiles] == [pytest.approx(each, rel=1e-9, nan_ok=True) for each in mirrored]


def test_missing_numbers_are_left_out_and_counted():
    holed = np.insert(SAMPLE, [0, 3, 7], [np.nan, np.inf, -np.inf])
    assert summary(holed) == summary(SAMPLE)._replace(absent=3)


def test_samples_that_say_little_say_so():
    nothing, one, equal = summary([np.nan]), summary([4.0]), summary([0.1] * 10)
    assert nothing.cases == 0 and nothing.absent == 1 and np.isnan(nothing.mean.value)
    assert one.mean.value == 4.0 and np.all(np.isnan([one.mean.low, *one.sigma, *one.skewness]))
    assert equal.mean == (0.1, 0.1, 0.1) and equal.sigma == (0.0, 0.0, 0.0) and np.isnan(equal.skewness.value)


def test_rounding_is_no_variation():
    assert not varies([0.3, 0.1 + 0.2]) and not varies([5.0]) and not varies([]) and not varies([np.nan, 2.0])
    assert varies([1.0, 1.0 + 1e-9]) and varies([0.0, 1e-30])


def test_a_bound_of_a_percentile_is_the_outermost_case_that_is_still_sure():
    """Of n cases the smallest is above the percentile p with probability (1 - p)^n; a bound exists where that is 2.5 % at most."""
    for percent in (1.0, 5.0):
        n = int(np.ceil(np.log(0.025) / np.log(1 - percent / 100)))
        place = PERCENTS.index(percent)
        assert np.isnan(percentiles(np.arange(n - 1.0))[place].low)
        assert percentiles(np.arange(float(n)))[place].low == 0.0
        opposite = PERCENTS.index(100 - percent)
        assert np.isnan(percentiles(np.arange(n - 1.0))[opposite].high)
        assert percentiles(np.arange(float(n)))[opposite].high == n - 1


def test_the_intervals_hold_the_truth_as_often_as_they_say():
    """2000 samples of 60: each interval misses in 5 % of them (binomial scatter 0.5 %); a percentile's in 5 % at most."""
    rng, misses = np.random.default_rng(11), np.zeros(3)
    for _ in range(2000):
        found = summary(rng.normal(5.0, 2.0, 60))
        quartile = found.percentiles[PERCENTS.index(25.0)]
        for place, (interval, truth) in enumerate(((found.mean, 5.0), (found.sigma, 2.0), (quartile, stats.norm.ppf(0.25, 5.0, 2.0)))):
            misses[place] += not interval.low <= truth <= interval.high
    assert misses[0] == pytest.approx(100, abs=30) and misses[1] == pytest.approx(100, abs=30)
    assert 100 * (1 - 0.5) < misses[2] < 100 + 30


def test_percentile_intervals_need_no_normal_distribution():
    rng, place = np.random.default_rng(12), PERCENTS.index(95.0)
    found = [percentiles(np.sort(rng.pareto(1.1, 300)))[place] for _ in range(1000)]
    truth = 20 ** (1 / 1.1) - 1
    missed = sum(not each.low <= truth <= each.high for each in found)
    assert 20 <= missed <= 71


def test_clopper_and_pearson():
    """Each end is where the other tail of the binomial distribution is 2.5 %."""
    for passes, count in ((3, 10), (1, 40), (499, 500)):
        found = share(passes, count)
        assert found.value == passes / count
        assert stats.binom.sf(passes - 1, count, found.low) == pytest.approx(0.025, rel=1e-9)
        assert stats.binom.cdf(passes, count, found.high) == pytest.approx(0.025, rel=1e-9)
    assert share(0, 20) == pytest.approx((0.0, 0.0, 1 - 0.025 ** (1 / 20)))
    assert share(20, 20) == pytest.approx((1.0, 0.025 ** (1 / 20), 1.0))
    assert np.all(np.isnan(share(0, 0)))


def test_capability_is_the_mean_margin_over_three_sigma():
    assert capability(summary(SAMPLE)).value == pytest.approx(SAMPLE.mean() / (3 * SAMPLE.std(ddof=1)), rel=1e-12)
    assert capability(summary(-SAMPLE)).value == pytest.approx(-capability(summary(SAMPLE)).value, rel=1e-12)
    assert np.isnan(capability(summary([2.0, 2.0])).value) and np.isnan(capability(summary([np.nan])).value)


def test_finite_is_sorted():
    assert finite([[3.0, np.nan], [1.0, np.inf]]).tolist() == [1.0, 3.0]


@pytest.mark.parametrize("n", [10, 60, 400])
def test_intervals_of_skewness_and_capability_cover_as_often_as_they_say(n):
    """Normally distributed margins with a mean of four standard deviations: no skewness, Cpk 4/3."""
    found = [summary(sample) for sample in np.random.default_rng(n).normal(4.0, 1.0, (1500, n))]
    for estimates, truth in (([each.skewness for each in found], 0.0), ([capability(each) for each in found], 4 / 3)):
        assert 0.92 < np.mean([each.low <= truth <= each.high for each in estimates]) < 0.98


def test_two_cases_have_no_interval_of_their_skewness():
    assert summary([1.0, 2.0]).skewness == (pytest.approx(0.0), pytest.approx(np.nan, nan_ok=True), pytest.approx(np.nan, nan_ok=True))
    assert np.isnan(capability(summary([2.0, 2.0])).low)
