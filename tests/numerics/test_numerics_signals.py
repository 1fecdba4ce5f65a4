"""Uneven samples: maxima, averages over time, orders, stretches - each against a closed form."""

import numpy as np
import pytest

from drivewright.errors import InputError
from drivewright.numerics.signals import (
    _amplitudes,
    local_maxima,
    local_maxima_of_rows,
    mean_of_largest,
    order_spectrum,
    percentile,
    root_mean_square,
    spectrogram,
    time_mean,
)

pytestmark = pytest.mark.analytical


def uneven(start, end, count, seed=3):
    """Scattered ascending times with both ends."""
    inner = np.random.default_rng(seed).uniform(start, end, count - 2)
    return np.sort(np.concatenate([[start], inner, [end]]))


# -- maxima --------------------------------------------------------------------------------------------------------------------


def test_the_top_of_a_parabola_is_exact():
    t = np.array([-1.3, -0.2, 0.55, 0.61, 1.9])
    times, values = local_maxima(t, 7.0 - 3.0 * (t - 0.4) ** 2)
    np.testing.assert_allclose(times, [0.4], rtol=1e-13)
    np.testing.assert_allclose(values, [7.0], rtol=1e-14)


def test_equal_shoulders_are_one_top_between_them():
    t = np.array([-1.3, 0.15, 0.65, 1.9])
    times, values = local_maxima(t, 7.0 - 3.0 * (t - 0.4) ** 2)
    np.testing.assert_allclose(times, [0.4], rtol=1e-13)
    np.testing.assert_allclose(values, [7.0], rtol=1e-14)


def test_shoulders_of_a_skew_top_give_the_same_in_the_mirror():
    t, x = np.array([0.0, 1.0, 1.5, 3.5]), np.array([0.0, 2.0, 2.0, -1.0])
    times, values = local_maxima(t, x)
    mirrored = local_maxima(-t[::-1], x[::-1])
    np.testing.assert_allclose(times, [1.25], rtol=1e-14)
    np.testing.assert_allclose(-mirrored[0], times, rtol=1e-14)
    np.testing.assert_allclose(mirrored[1], values, rtol=1e-14)
    # by hand: left parabola 2 + (4/3)(t - 1)(1.5 - t), right one 2 + 0.6 (t - 1)(1.5 - t)
    np.testing.assert_allclose(values, [2 + 0.0625 * 0.5 * (4 / 3 + 0.6)], rtol=1e-14)


def test_plateaus_count_once_and_ends_and_steps_never():
    t = np.array([0.0, 1.0, 2.0, 2.5, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0])
    x = np.array([9.0, 1.0, 3.0, 3.0, 3.0, 0.0, 0.5, 0.5, 2.0, 8.0])
    times, values = local_maxima(t, x)
    np.testing.assert_allclose((times, values), ([3.0], [3.0]))
    assert local_maxima(t, np.full(10, 2.0))[0].size == 0
    assert local_maxima(t, t)[0].size == 0


def test_the_error_of_a_top_stays_within_its_bound_and_reaches_for_it():
    shares = []
    for seed in range(60):
        t = uneven(0.0, 1.5, 25, seed)
        h = np.max(np.diff(t))
        times, values = local_maxima(t, t * np.exp(-2 * t))  # top 1/(2 e) at 1/2, third derivative at most 12 in size
        assert times.size == 1
        shares.append(abs(values[0] - 0.5 / np.e) / (h**3 * 12 / (9 * np.sqrt(3))))
    assert 0.005 < max(shares) < 1


def plateaus_and_ends(t):
    """Signals whose neighbours in the table would make tops of their ends, with plateaus, shoulders and rounding."""
    level = np.round(3 * np.sin(2.3 * t + 0.4))
    return np.array([np.sin(3 * t), -t, 2 * t, level, np.full(t.size, 5.0), np.repeat(t[::2], 2)[: t.size], -level])


@pytest.mark.parametrize("times", [uneven(0.0, 7.0, 80), np.sort(np.round(uneven(0.0, 7.0, 80), 1))])
def test_signals_side_by_side_have_the_maxima_of_each(times):
    signals = plateaus_and_ends(times)
    rows, tops, values = local_maxima_of_rows(times, signals)
    for number, signal in enumerate(signals):
        alone = local_maxima(times, signal)
        np.testing.assert_array_equal((tops[rows == number], values[rows == number]), alone)
    assert set(rows.tolist()) >= {0, 3, 6}


def with_jump(rise):
    """(times, samples) of a sine with its argument in turns, over two turns, raised by `rise` from time 0.8 on; both sides of the jump."""
    before, after = uneven(0.0, 0.8, 700), uneven(0.8, 2.0, 1000, seed=5)
    t = np.concatenate([before, after])
    return t, np.sin(2 * np.pi * t) + np.repeat([0.0, rise], [before.size, after.size])


def test_beside_a_jump_the_sample_counts_and_no_parabola_crosses_it():
    t, x = with_jump(-3.0)
    times, values = local_maxima(t, x)  # the tops of the sine, and the upper side of the fall, where it rises again
    np.testing.assert_allclose(times, [0.25, 0.8, 1.25], atol=1e-4)
    np.testing.assert_allclose(values, [1.0, np.sin(1.6 * np.pi), -2.0], atol=1e-4)
    assert values[1] == x[699], "the sample itself"
    times, values = local_maxima(-t[::-1], x[::-1])
    np.testing.assert_allclose(np.sort(values), np.sort([1.0, np.sin(1.6 * np.pi), -2.0]), atol=1e-4)


@pytest.mark.parametrize("copies", [2, 3, 5])
def test_what_is_between_the_two_sides_of_a_time_counts_for_nothing(copies):
    t, x = with_jump(2.0)
    between = np.full(copies, 99.0)  # as of events that follow one another at one time
    more_t, more_x = np.insert(t, 700, np.full(copies, t[700])), np.insert(x, 700, between)
    same_t, same_x = np.insert(t, 40, np.full(copies, t[40])), np.insert(x, 40, np.full(copies, x[40]))
    for other in ((more_t, more_x), (same_t, same_x)):
        for ours, plain in zip(local_maxima(*other), local_maxima(t, x), strict=True):
            np.testing.assert_array_equal(ours, plain)
        for q in (time_mean, root_mean_square, lambda t, x: percentile(t, x, 60), lambda t, x: order_spectrum(t, x, 1.0, [0, 1, 4])):
            np.testing.assert_array_equal(q(*other), q(t, x))


def test_the_spectrum_of_a_jump_is_that_of_its_closed_form():
    t, x = with_jump(2.0)
    orders = np.array([0.0, 0.5, 1.0, 3.0])
    # over two turns: sin(2 pi t), and 2 on [0.8, 2] with the mean 1.2 and the coefficients (1 - exp(-i 2 pi k 0.8)) 2 / (i 2 pi k) / 2
    step = 2 * (1 - np.exp(-2j * np.pi * orders[1:] * 0.8)) / (2j * np.pi * orders[1:]) / 2 * -1
    step[1] += 1 / 2j
    np.testing.assert_allclose(order_spectrum(t, x, 1.0, orders), [1.2, *(2 * np.abs(step))], rtol=2e-4)


def test_averages_keep_both_sides_of_a_jump():
    t, x = [0.0, 1.0, 1.0, 3.0], [1.0, 1.0, 4.0, 4.0]
    assert time_mean(t, x) == pytest.approx(3.0, rel=1e-15) and root_mean_square(t, x) ** 2 == pytest.approx(11.0, rel=1e-15)
    assert percentile(t, x, 30) == 1.0 and percentile(t, x, 40) == 4.0


def test_every_top_of_a_beat_is_found():
    t = uneven(0.0, 20.0, 6000)
    times, values = local_maxima(t, np.sin(3 * t) + 0.01 * t)
    turned = (np.arccos(-0.01 / 3) + 2 * np.pi * np.arange(10)) / 3
    np.testing.assert_allclose(times, turned[turned < 20], atol=2e-4)
    np.testing.assert_allclose(values, np.sin(3 * times) + 0.01 * times, atol=1e-6)


def test_the_stated_overshoot_after_a_jump():
    h, k = 0.1, 0.7
    _, values = local_maxima([0.0, h, h + k, 2.0], [0.0, 5.0, 5.0 * (1 - 1e-12), 0.0])
    assert values[0] - 5.0 == pytest.approx(5.0 * k**2 / (4 * h * (h + k)), rel=1e-9)


def test_mean_of_the_largest():
    assert mean_of_largest([3.0, -9.0, 8.0, 1.0, 4.0], 3) == 5.0
    assert mean_of_largest([3.0, 1.0], 2) == 2.0


# -- averages over time --------------------------------------------------------------------------------------------------------


def test_averages_of_a_polygon_are_exact():
    t, x = [1.0, 2.0, 5.0, 5.0, 7.0], [0.0, 4.0, -2.0, 1.0, 1.0]  # with a jump at 5
    assert time_mean(t, x) == pytest.approx((2 + 3 + 2) / 6, rel=1e-14)
    assert root_mean_square(t, x) ** 2 == pytest.approx((16 / 3 + (16 - 8 + 4) + 2) / 6, rel=1e-14)


def test_averages_of_a_sine_over_a_part_of_its_period_at_second_order():
    exact_mean, exact_square = (1 - np.cos(2.3)) / 2.3, 0.5 - np.sin(4.6) / 9.2
    errors = []
    for count in (40, 400):
        t = np.linspace(0, 1, count) ** 1.5 * 2.3
        errors.append([abs(time_mean(t, np.sin(t)) - exact_mean), abs(root_mean_square(t, np.sin(t)) - np.sqrt(exact_square))])
        assert np.all(np.array(errors[-1]) < np.max(np.diff(t)) ** 2 / 8)
    np.testing.assert_allclose(np.log10(np.divide(*errors)), 2.0, atol=0.1)


def test_percentiles_of_a_polygon_by_hand():
    t, x = [0.0, 2.0, 3.0, 6.0, 10.0], [0.0, 4.0, 4.0, 1.0, 1.0]
    # below level L: L/2 on the way up, (L - 1) on the way down above 1, 4 at 1, 1 at 4
    assert percentile(t, x, 0) == 0.0
    assert percentile(t, x, 4) == pytest.approx(0.8)
    assert percentile(t, x, 5) == percentile(t, x, 30) == percentile(t, x, 45) == 1.0
    assert percentile(t, x, 60) == pytest.approx(2.0)
    assert percentile(t, x, 90) == pytest.approx(4.0) == percentile(t, x, 95)
    assert percentile(t, x, 100) == 4.0


def test_percentiles_above_a_plateau():
    t, x = [0.0, 4.0, 5.0, 6.0, 7.0, 8.0], [0.0, 0.0, 1.0, 2.0, 3.0, 4.0]
    for q, level in ((50, 0), (62.5, 1), (70, 1.6), (81.25, 2.5), (99, 3.92)):
        assert percentile(t, x, q) == pytest.approx(level, abs=1e-12)


@pytest.mark.parametrize("q", [3.0, 37.0, 50.0, 88.8])
def test_percentiles_weigh_by_time_not_by_sample(q):
    crowded = np.concatenate([np.linspace(0, 0.1, 5000), np.linspace(0.1, 1, 1000)[1:]])
    assert percentile(crowded, crowded**2, q) == pytest.approx((q / 100) ** 2, abs=3e-7)
    assert percentile(crowded, -(crowded**2), q) == pytest.approx(-((1 - q / 100) ** 2), abs=3e-7)


def test_the_time_at_or_below_a_percentile_is_that_share():
    t = uneven(0.0, 9.0, 4000)
    x = np.sin(t) + 0.3 * np.sin(3.7 * t)
    fine = np.linspace(0, 9, 200_001)
    for q in (12.0, 64.0):
        assert np.mean(np.interp(fine, t, x) <= percentile(t, x, q)) == pytest.approx(q / 100, abs=2e-5)


# -- orders --------------------------------------------------------------------------------------------------------------------

PERIOD = 0.021


def harmonics(t):
    w = 2 * np.pi / PERIOD
    return 0.8 + 2.0 * np.sin(3 * w * t + 0.3) + 0.7 * np.cos(w * t - 1.0) + 0.25 * np.cos(0.5 * w * t) + 0.1 * np.sin(11 * w * t)


def test_amplitudes_of_known_harmonics():
    t = 0.4 + uneven(0.0, 4 * PERIOD, 10_000)
    found = order_spectrum(t, harmonics(t), PERIOD, [0, 0.5, 1, 2, 3, 4.25, 11])
    np.testing.assert_allclose(found, [0.8, 0.25, 0.7, 0, 2.0, 0, 0.1], atol=3e-6)
    assert order_spectrum(t, -harmonics(t), PERIOD, 0)[0] == pytest.approx(0.8, abs=1e-6)


def test_the_damping_by_the_cells_is_taken_out():
    t = np.linspace(0, PERIOD, 801)
    found = order_spectrum(t, 2.0 * np.sin(40 * 2 * np.pi * t / PERIOD), PERIOD, [40])  # 20 even samples per oscillation
    assert found[0] == pytest.approx(2.0, rel=1e-4)


@pytest.mark.parametrize("per_oscillation, error", [(33, 2e-4), (133, 1e-6)])
def test_the_stated_error_of_the_spline(per_oscillation, error):
    t = uneven(0.0, 2.0, 6 * per_oscillation, 1)
    off = abs(order_spectrum(t, 2 * np.sin(6 * np.pi * t + 0.3), 1.0, [3])[0] / 2 - 1)
    assert 0.1 * error < off < 2 * error


def test_what_lies_beyond_folds_back_by_a_fifteenth_at_most():
    def folded(k):
        return _amplitudes(lambda t: np.sin(2 * np.pi * k * t + 0.4) / (2 * np.pi * k), 0.0, 1.0, np.array([1, 4]), 3)

    np.testing.assert_allclose(folded(60), [0.0, 1 / 15], atol=1e-12)  # 64 cells: order 60 looks like order 4
    np.testing.assert_allclose(folded(127), [1 / 127, 0.0], atol=1e-12)
    np.testing.assert_allclose(folded(28), [0.0, 0.0], atol=1e-12)


def test_nothing_folds_that_the_samples_resolve():
    t = np.linspace(0, 1, 1201)
    x = 0.5 * np.cos(2 * np.pi * t) + np.cos(2 * np.pi * 15 * t + 1) + np.sin(2 * np.pi * 17 * t)
    assert order_spectrum(t, x, 1.0, [1])[0] == pytest.approx(0.5, abs=1e-5)


def test_a_spectrogram_follows_a_growing_order():
    t = uneven(0.0, 10.4, 12_000)
    x = 1.5 * np.cos(4 * np.pi * t) + np.floor(t) * np.sin(6 * np.pi * t)
    times, amplitudes = spectrogram(t, x, 1.0, [0, 2, 3])
    np.testing.assert_allclose(times, np.arange(10) + 0.5)
    np.testing.assert_allclose(amplitudes[:, 1], 1.5, atol=2e-3)
    np.testing.assert_allclose(amplitudes[:, 2], np.arange(10), atol=2e-3)
    np.testing.assert_allclose(amplitudes[:, 0], 0.0, atol=2e-3)


def test_longer_windows_overlap_and_resolve_half_orders():
    t = np.linspace(2.0, 7.0, 2501)
    times, amplitudes = spectrogram(t, np.cos(np.pi * t) + 0.3 * np.cos(4 * np.pi * t), 1.0, [0.5, 1, 2], turns=2)
    np.testing.assert_allclose(times, [3.0, 4.0, 5.0, 6.0])
    np.testing.assert_allclose(amplitudes, np.tile([1.0, 0.0, 0.3], (4, 1)), atol=1e-6)


def test_one_window_is_the_spectrum():
    t = uneven(0.0, 3 * PERIOD, 900)
    whole = order_spectrum(t, harmonics(t), PERIOD, [1 / 3, 1, 11])
    _, rows = spectrogram(t, harmonics(t), PERIOD, [1 / 3, 1, 11], turns=3)
    np.testing.assert_allclose(rows, [whole], rtol=1e-5)


def test_rounding_does_not_cost_the_last_window():
    t = np.linspace(0, 0.3, 301)
    assert 0.3 / 0.1 < 3
    assert spectrogram(t, np.sin(20 * np.pi * t), 0.1, [1])[1].shape == (3, 1)


T = np.linspace(0, 2, 41)


@pytest.mark.parametrize(
    "call, words",
    [
        (lambda: local_maxima_of_rows(T, np.stack([T, np.full(T.size, np.inf)])), r"sample 0 is not finite"),
        (lambda: local_maxima(T, T[:-1]), r"shapes \(41,\) and \(40,\)"),
        (lambda: time_mean(T[:2], T[:2]), "3 samples or more"),
        (lambda: root_mean_square(T, np.where(T[7] == T, np.nan, T)), r"sample 7 is not finite \(t = 0.35, x = nan\)"),
        (lambda: time_mean(np.where(T[7] == T, 0.0, T), T), r"t\[7\] = 0 follows 0.3; sort"),
        (lambda: local_maxima([0.0, 1.0, 0.5, 2.0], [0.0, 1.0, 2.0, 0.0]), r"t\[2\] = 0.5 follows 1"),
        (lambda: time_mean([1.0, 1.0, 1.0], [0.0, 1.0, 2.0]), "t must increase"),
        (lambda: mean_of_largest([1.0, 2.0], 5), "the 5 largest of 2 values do not exist; lengthen the run"),
        (lambda: mean_of_largest([1.0, 2.0], 0), "the 0 largest"),
        (lambda: percentile(T, T, 101), "0 .. 100, got 101"),
        (lambda: order_spectrum(T, T, 0.7, [1]), "covers 2.857143 periods, but must cover a whole number"),
        (lambda: order_spectrum(T, T, 0.9999, [1]), "covers 2.0002 periods"),
        (lambda: order_spectrum(T, T, 100.0, [0]), "covers 0.02 periods"),
        (lambda: order_spectrum(T, T, 1e9, [0]), "covers 2e-09 periods"),
        (lambda: order_spectrum(T, T, 0.0, [1]), "period must be above 0, got 0"),
        (lambda: order_spectrum(T, T, 1.0, [1, 1.3]), r"order 1.3 is no multiple of 1/2, the resolution of 2 periods"),
        (lambda: order_spectrum(T, T, 1.0, [-1, 1]), "order -1 is no multiple"),
        (lambda: order_spectrum(T, T, 1.0, [10]), "order 10 oscillates 20 times among 40 samples; it takes more than 2"),
        (lambda: spectrogram(T, T, 1.0, [1], turns=3), "no window of 3 periods fits into a signal of 2"),
        (lambda: spectrogram(T, T, 1.0, [1], turns=0), "no window of 0 periods"),
    ],
)
def test_messages(call, words):
    with pytest.raises(InputError, match=words):
        call()
