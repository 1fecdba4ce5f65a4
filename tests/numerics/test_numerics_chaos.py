"""The largest exponent where it is known exactly or from the literature, and the period of an orbit."""

import numpy as np
import pytest

from drivewright.errors import InputError, SolverError
from drivewright.numerics.chaos import largest_exponent, orbit_period

pytestmark = pytest.mark.analytical


def exponent(step, state, scales=1.0, cycles=320, discard=50, seed=5, **options):
    return largest_exponent(step, state, scales, cycles=cycles, discard=discard, rng=np.random.default_rng(seed), **options)


def logistic(r):
    return lambda x: r * x * (1 - x)


def henon(s):
    return np.array([1 - 1.4 * s[0] ** 2 + s[1], 0.3 * s[0]])


def affine(matrix, offset):
    return lambda s: matrix @ s + offset


def test_logistic_map_is_ln_2():
    found = exponent(logistic(4.0), [0.3123], cycles=4000)
    assert found.per_cycle == pytest.approx(np.log(2), abs=4 * found.error)
    assert 1e-4 < found.error < 0.02


def test_logistic_map_on_its_two_cycle():
    # |f'| over the cycle: product 4 + 2 r - r^2 for the points of period 2
    r = 3.3
    found = exponent(logistic(r), [0.3], discard=300)
    assert found.per_cycle == pytest.approx(0.5 * np.log(abs(4 + 2 * r - r * r)), abs=1e-6)
    assert found.error < 1e-6


def test_henon_map():
    found = exponent(henon, [0.1, 0.2], [1.2, 0.4], cycles=6400)
    assert found.per_cycle == pytest.approx(0.4192, abs=4 * found.error)  # literature, recalled
    assert 0.001 < found.error < 0.01
    assert 1e-8 < found.widest < 1e-7


def test_the_error_bar_is_the_spread_of_independent_runs():
    runs = [exponent(henon, [0.1 + 0.01 * n, 0.2], [1.2, 0.4], cycles=480, seed=n) for n in range(24)]
    spread = np.std([each.per_cycle for each in runs], ddof=1)
    assert np.mean([each.error for each in runs]) == pytest.approx(spread, rel=0.4)


@pytest.mark.parametrize("eigenvalue", [0.8, 1.0, 1.7])
def test_linear_map_is_the_log_of_the_largest_eigenvalue(eigenvalue):
    basis = np.array([[1.0, 0.4, 0.2], [-0.3, 1.0, 0.1], [0.2, 0.5, 1.0]])
    matrix = basis @ np.diag([eigenvalue, 0.5, -0.3]) @ np.linalg.inv(basis)
    fixed = np.array([0.3, -0.2, 0.5])
    start = fixed if eigenvalue > 1 else fixed + 0.1
    found = exponent(affine(matrix, fixed - matrix @ fixed), start, [1.0, 0.1, 5.0], cycles=32 if eigenvalue > 1 else 320, discard=30)
    # off a fixed point that repels, rounding alone carries the state away: few cycles
    assert found.per_cycle == pytest.approx(np.log(eigenvalue), abs=1e-6)
    assert found.history.shape == (32 if eigenvalue > 1 else 320,)
    assert found.history[-1] == found.per_cycle


def test_a_decaying_spiral_counts_by_the_modulus():
    turn, radius = 0.77, 0.93
    matrix = radius * np.array([[np.cos(turn), -2 * np.sin(turn)], [0.5 * np.sin(turn), np.cos(turn)]])
    found = exponent(affine(matrix, np.array([0.2, 0.1])), [0.5, 0.5], cycles=3200)
    assert found.per_cycle == pytest.approx(np.log(radius), abs=5e-4)  # growth wavers with the direction, bounded: error 1/cycles


def test_rotation_neither_grows_nor_decays():
    c, s = np.cos(1.1), np.sin(1.1)
    found = exponent(affine(np.array([[c, -s], [s, c]]), np.zeros(2)), [0.7, 0.2])
    assert abs(found.per_cycle) < 1e-7 and found.error < 1e-7


def test_transients_are_discarded_and_every_cycle_after_them_counts():
    calls = []

    def step(s):
        calls.append(1)
        return s * (3.0 if len(calls) <= 2 * 20 else 0.9)

    found = exponent(step, [1e-12], cycles=40, discard=20)
    assert len(calls) == 2 * 60
    np.testing.assert_allclose(found.history, np.log(0.9), atol=1e-7)


def test_the_history_is_the_running_mean():
    factors = iter(np.repeat([2.0, 0.5, 3.0] * 20, 2))
    found = exponent(lambda s: next(factors) * s, [0.0], cycles=33, discard=0)
    expected = np.cumsum(np.log([2.0, 0.5, 3.0] * 11)) / np.arange(1, 34)
    np.testing.assert_allclose(found.history, expected, atol=1e-12)
    assert found.widest == pytest.approx(3e-8, rel=1e-6)
    assert found.error == pytest.approx(np.std(np.log([2.0, 0.5, 3.0] * 11)[1:].reshape(16, 2).mean(axis=1), ddof=1) / 4, rel=1e-9)


def test_scales_are_units():
    plain = exponent(henon, [0.1, 0.2], [1.2, 0.4], cycles=64)
    units = np.array([1e-3, 250.0])
    scaled = exponent(lambda s: units * henon(s / units), units * [0.1, 0.2], units * [1.2, 0.4], cycles=64)
    # 50 discarded cycles of chaos amplify the rounding of 1e-16 by e^21: the histories part, but slowly
    np.testing.assert_allclose(scaled.history[:20], plain.history[:20], atol=1e-4)


def test_memory_is_taken_over_never_perturbed():
    seen = []

    def step(s):
        x, flag, last = s
        assert flag in (0.0, 1.0)
        seen.append((flag, last))
        x = 4 * x * (1 - x)
        return np.array([x, float(x > 0.5), np.inf if x > 0.5 else x])

    with_memory = exponent(step, [0.3123, 0.0, 0.2], [1.0, 1e-9, 1e-9], cycles=200, continuous=[True, False, False])
    alone = exponent(logistic(4.0), [0.3123], 1.0, cycles=200)
    np.testing.assert_allclose(with_memory.history, alone.history, rtol=1e-9)
    for state, twin in zip(seen[::2], seen[1::2], strict=True):
        np.testing.assert_array_equal(state, twin)


def test_memory_that_differs_at_the_end_of_a_cycle_is_reset():
    def step(s):
        x, count = s
        return np.array([0.5 * x + 0.1 * count, count + (x != 0.0)])  # the twin's count would run ahead, were it kept

    found = exponent(step, [0.0, 0.0], cycles=64, discard=0, continuous=[True, False])
    np.testing.assert_allclose(found.per_cycle, np.log(0.5), atol=1e-7)


def test_a_twin_that_falls_onto_the_state_gives_an_upper_bound():
    found = exponent(lambda s: np.full(2, 0.4), [0.3, 0.4])
    assert found.per_cycle == pytest.approx(np.log(np.finfo(float).eps / 1e-8), abs=1e-6)


def test_the_step_may_write_into_its_argument_and_the_start_is_left_alone():
    def step(s):
        s *= 0.7
        return s

    start = np.array([0.3, 0.1])
    assert exponent(step, start).per_cycle == pytest.approx(np.log(0.7), abs=1e-9)
    np.testing.assert_array_equal(start, [0.3, 0.1])


def test_the_step_may_answer_in_a_buffer_of_its_own():
    buffer = np.empty(2)

    def step(s):
        np.multiply(s, 0.9, out=buffer)
        return buffer

    assert exponent(step, [0.3, 0.1]).per_cycle == pytest.approx(np.log(0.9), abs=1e-7)


def test_the_same_seed_gives_the_same_numbers():
    first, second = (exponent(henon, [0.1, 0.2], cycles=64) for _ in range(2))
    np.testing.assert_array_equal(first.history, second.history)


def test_an_orbit_that_leaves_says_when_and_keeps_what_it_had():
    def step(s):
        return s * 2 if s[0] < 1e3 else s * np.nan

    with pytest.raises(SolverError, match="after 31 cycles the state or its twin is no longer finite") as caught:
        exponent(step, [1e-6, 1e-6], discard=10)
    np.testing.assert_allclose(caught.value.partial, np.log(2), atol=1e-6)
    assert caught.value.partial.shape == (20,)
    with pytest.raises(SolverError, match="after 1 cycles"):  # the twin alone leaves
        exponent(lambda s: s if s[0] == 0.3 else s * np.nan, [0.3])
    with pytest.raises(SolverError, match="is below its rounding error") as caught:
        exponent(lambda s: s + 4e3, [0.3], discard=0)  # an angle that nobody wraps
    assert caught.value.partial.shape == (112,)  # 100 eps 4e3 n reaches 1e-8 at n = 113


@pytest.mark.parametrize(
    "options, words",
    [
        ({"cycles": 31}, "takes 32 cycles or more, got 31"),
        ({"discard": -1}, "and -1 to discard"),
        ({"scales": [1.0, 0.0]}, "every scale must be above 0, got 0"),
        ({"scales": [1.0, np.nan]}, "every scale must be above 0, got nan"),
        ({"separation": 0.1}, "separation of 0.1 must be small"),
        ({"scales": [1.0, 1e-9]}, "far above the rounding of the state, 4.4e-08 of the scales"),
        ({"scales": [1.0, 1e-7]}, "4.4e-10 of the scales"),
        ({"continuous": [True]}, r"shapes \(2,\) and \(1,\)"),
        ({"continuous": [False, False]}, "0 continuous"),
    ],
)
def test_messages(options, words):
    with pytest.raises(InputError, match=words):
        exponent(henon, [0.1, 0.2], **options)


# -- periods -------------------------------------------------------------------------------------------------------------------


def orbit(r, count=64, transient=3000):
    x, points = 0.3, []
    for _ in range(transient + count):
        x = r * x * (1 - x)
        points.append(x)
    return np.array(points[transient:])


@pytest.mark.parametrize("r, period", [(2.8, 1), (3.3, 2), (3.5, 4), (3.835, 3), (3.55, 8), (3.9, 0), (4.0, 0)])
def test_periods_of_the_logistic_map(r, period):
    assert orbit_period(orbit(r), 1e-6) == period


def test_the_third_visit_is_needed():
    points = np.tile([0.1, 0.5, 0.9, 0.3], 3)
    assert orbit_period(points, 0.01) == 4
    assert orbit_period(points[:-1], 0.01) == 0


def test_a_tolerance_per_component():
    points = np.column_stack([np.tile([1.0, 2.0], 10), np.tile([5.0, 5.3, 5.0, 5.2], 5)])
    assert orbit_period(points, [0.01, 0.01]) == 4
    assert orbit_period(points, [0.01, 0.15]) == 2
    assert orbit_period(points, [1.5, 0.5]) == 1
    assert orbit_period(points, [1.5, 0.15]) == 2


def test_a_slow_drift_is_no_period():
    assert orbit_period(0.3 + 0.0009 * np.arange(40), 1e-3) == 0
    assert orbit_period(np.exp(1j * 0.4 * np.arange(100)).view(float).reshape(-1, 2), 1e-3) == 0


@pytest.mark.parametrize("points, tolerance", [([1.0, 1.0], 0.1), ([1.0, 1.0, np.nan], 0.1), ([1.0] * 5, 0.0), (np.ones((3, 1, 1)), 0.1)])
def test_period_messages(points, tolerance):
    with pytest.raises(InputError, match="3 finite points or more and a tolerance above 0"):
        orbit_period(points, tolerance)
