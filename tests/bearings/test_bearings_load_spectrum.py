"""Duty cycles and several bearings: Miner's sum, the mean load and the product of the probabilities."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from drivewright.bearings import mean_load, mean_speed, spectrum_life, system_life
from drivewright.errors import InputError

SHARES, SPEEDS, LOADS = (0.1, 0.2, 0.3, 0.4), (90.0, -40.0, 150.0, 60.0), (3000.0, 2000.0, 1000.0, 0.0)


@pytest.mark.property
@pytest.mark.parametrize("exponent", [3, 10 / 3])
def test_the_mean_load_lasts_as_long_as_miners_sum(exponent):
    """Revolutions to failure (C/P)^p a case, consumed at q |n|/2 pi in a second."""
    rating, turns = 30e3, np.abs(SPEEDS) * SHARES / (2 * np.pi)
    damage = sum(turn / (1e6 * (rating / load) ** exponent) for turn, load in zip(turns, LOADS, strict=True) if load)
    load, speed = mean_load(SHARES, SPEEDS, LOADS, exponent), mean_speed(SHARES, SPEEDS)
    assert 1e6 * (rating / load) ** exponent * 2 * np.pi / speed == pytest.approx(1 / damage, rel=1e-12)
    with np.errstate(divide="ignore"):
        lives = [1e6 * (rating / load) ** exponent * 2 * np.pi / abs(n) for load, n in zip(np.array(LOADS), SPEEDS, strict=True)]
    assert spectrum_life(SHARES, lives) == pytest.approx(1 / damage, rel=1e-12)


@pytest.mark.analytical
def test_a_printed_cycle():
    """3 kN for 10 %, 2 kN for 20 %, 1 kN for 30 % of the time, then nothing, at constant speed: W^3 = 2.7 + 1.6 + 0.3 (mechcollege.com)."""
    assert mean_load(SHARES, (100.0,) * 4, LOADS, 3) == pytest.approx(1e3 * np.cbrt(4.6), rel=1e-12)


@pytest.mark.property
def test_mean_speed_counts_rest_and_not_the_sense():
    assert mean_speed((0.25, 0.5, 0.25), (80.0, -20.0, 0.0)) == pytest.approx(30.0)


@pytest.mark.property
def test_limits_of_a_cycle():
    assert mean_load((0.5, 0.5), (10.0, 70.0), (800.0, 800.0), 3) == pytest.approx(800.0, rel=1e-12)
    assert mean_load((0.5, 0.5), (0.0, 70.0), (9000.0, 800.0), 3) == pytest.approx(800.0, rel=1e-12)
    assert mean_load((0.5, 0.5), (10.0, 70.0), (0.0, 0.0), 3) == 0.0
    assert mean_load((0.0, 1.0), (9.0, 0.01), (9000.0, 800.0), 3) == pytest.approx(800.0, rel=1e-12)
    assert spectrum_life((0.25, 0.75), (100.0, np.inf)) == pytest.approx(400.0)
    assert spectrum_life((0.25, 0.75), (np.inf, np.inf)) == np.inf
    assert_allclose(mean_load(SHARES, SPEEDS, np.array(LOADS) * 1e-6, 3), 1e-6 * mean_load(SHARES, SPEEDS, LOADS, 3), rtol=1e-12)


@pytest.mark.analytical
def test_bearings_of_one_slope():
    lives = (2e7, 5e7, 3e8)
    assert system_life(lives, (10 / 9,) * 3) == pytest.approx(sum(life ** (-10 / 9) for life in lives) ** -0.9, rel=1e-12)
    assert system_life((4e7,) * 2, (9 / 8,) * 2) == pytest.approx(4e7 * 2 ** (-8 / 9), rel=1e-12)
    assert system_life((4e7,), (1.3,)) == pytest.approx(4e7, rel=1e-12)


@pytest.mark.property
@pytest.mark.parametrize("reliability", [0.9, 0.99])
def test_the_product_of_the_probabilities_of_survival(reliability):
    """Balls and rollers together, far apart: at the life of the system they all survive with the reliability of one at its own."""
    lives, slopes = np.array([3e6, 8e7, 9e6, np.inf]), np.array([10 / 9, 9 / 8, 9 / 8, 10 / 9])
    time = system_life(lives, slopes)
    assert np.prod(reliability ** ((time / lives) ** slopes)) == pytest.approx(reliability, rel=1e-12)
    assert 1e6 < time < 3e6


@pytest.mark.property
def test_what_cannot_fail_does_not_count():
    assert system_life((5e6, np.inf), (10 / 9, 9 / 8)) == pytest.approx(5e6, rel=1e-12)
    assert system_life((np.inf, np.inf), (10 / 9, 9 / 8)) == np.inf
    assert system_life((2.0, 3.0), (10 / 9, 9 / 8)) * 1e9 == pytest.approx(system_life((2e9, 3e9), (10 / 9, 9 / 8)), rel=1e-12)


@pytest.mark.error
@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: mean_speed((0.5, 0.497), (1.0, 1.0)), "with the sum 0.997"),
        (lambda: mean_speed((0.5, 0.4), (1.0, 1.0)), "sum to 1, got 0.5, 0.4 with the sum 0.9"),
        (lambda: mean_speed((1.2, -0.2), (1.0, 1.0)), "at least 0"),
        (lambda: spectrum_life((), ()), "duty cycle"),
        (lambda: mean_load((0.5, 0.5), (0.0, 0.0), (10.0, 10.0), 3), "all speeds are 0"),
        (lambda: system_life((1.0, 0.0), (1.1, 1.1)), "a life above 0"),
        (lambda: system_life((1.0, -2.0), (1.1, 1.1)), "a life above 0"),
        (lambda: system_life((1.0,), (1.1, 1.1)), "a slope for every bearing"),
    ],
)
def test_refusals(call, words):
    with pytest.raises(InputError, match=words):
        call()


@pytest.mark.property
def test_thirds_are_thirds():
    """Rounded shares count as what they are rounded from."""
    assert mean_speed((0.333, 0.333, 0.333), (1.0, 2.0, 3.0)) == pytest.approx(2.0, rel=1e-12)
    assert spectrum_life((0.333, 0.333, 0.333), (3.0, 3.0, 3.0)) == pytest.approx(3.0, rel=1e-12)
