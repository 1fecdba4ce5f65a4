"""Torque, power and inertia over a cycle: closed forms, uneven samples, jumps, what is refused."""

import numpy as np
import pytest

from drivewright.errors import InputError
from drivewright.motion.motor_sizing import cycle_weights, mean_over_cycle, reflected_inertia, rms_over_cycle, size_motor, through_reducer

EVEN = np.linspace(0.3, 2.3, 41)  # two seconds that do not begin at 0


@pytest.mark.analytical
def test_a_constant_torque_is_its_own_rms():
    sizing = size_motor(EVEN, -3.0, 10.0)
    assert (sizing.rms_torque, sizing.peak_torque, sizing.mean_torque) == pytest.approx((3.0, 3.0, -3.0))
    assert (sizing.mean_power, sizing.peak_power, sizing.braking_power) == pytest.approx((-30.0, -30.0, 30.0))
    assert sizing.period == pytest.approx(2.0)


@pytest.mark.analytical
def test_sine_of_torque_has_amplitude_over_root_two():
    torque = 7.0 * np.sin(2 * np.pi * EVEN / 2 + 0.4)
    assert rms_over_cycle(EVEN, torque) == pytest.approx(7 / np.sqrt(2), rel=1e-13)
    assert mean_over_cycle(EVEN, torque + 1.5) == pytest.approx(1.5, rel=1e-13)


@pytest.mark.analytical
def test_torque_and_speed_in_phase_give_half_the_peak_power():
    phase = 2 * np.pi * EVEN / 2
    sizing = size_motor(EVEN, 4 * np.sin(phase), 5 * np.sin(phase))
    assert sizing.mean_power == pytest.approx(10.0)
    assert sizing.rms_power == pytest.approx(20 * np.sqrt(3 / 8))
    assert sizing.braking_power == 0.0
    assert (sizing.peak_power, sizing.peak_speed) == pytest.approx((20.0, 5.0))


@pytest.mark.analytical
def test_speed_that_changes_sign_has_the_mean_of_its_size():
    time = np.linspace(0, 1, 2001)
    assert size_motor(time, 1.0, np.sin(2 * np.pi * time)).mean_speed == pytest.approx(2 / np.pi, rel=1e-6)


@pytest.mark.property
def test_weights_of_uneven_samples_are_half_the_distance_of_the_neighbours():
    assert cycle_weights([1.0, 2.0, 4.0, 5.0]) == pytest.approx(np.array([0.5, 1.5, 1.5, 0.5]) / 4)


@pytest.mark.property
def test_jump_is_two_samples_at_one_time():
    """Two thirds of the cycle at 6 N m, a third at 0: rms 6 sqrt(2/3)."""
    assert rms_over_cycle([0, 2, 2, 3], [6, 6, 0, 0]) == pytest.approx(6 * np.sqrt(2 / 3))


@pytest.mark.order
def test_uneven_samples_are_of_second_order():
    counts, errors = np.array([100, 300, 1000]), []
    for n in counts:
        u = np.linspace(0, 1, n + 1)
        time = u + 0.1 * np.sin(2 * np.pi * u) * u  # uneven, the ends in place
        errors.append(abs(rms_over_cycle(time, np.exp(time)) - np.sqrt((np.e**2 - 1) / 2)))
    slope = np.polyfit(np.log(counts), np.log(errors), 1)[0]
    assert slope == pytest.approx(-2, abs=0.1)


@pytest.mark.property
def test_time_in_other_units_changes_no_torque_and_the_torque_scales():
    rng = np.random.default_rng(3)
    time, torque, speed = np.sort(rng.random(30)), rng.normal(size=30), rng.normal(size=30)
    plain, scaled = size_motor(time, torque, speed), size_motor(60 * time, 5 * torque, speed / 60)
    powers = {"period": 60, "rms_torque": 5, "peak_torque": 5, "mean_torque": 5, "mean_speed": 1 / 60, "peak_speed": 1 / 60}
    for name, value in plain._asdict().items():
        assert getattr(scaled, name) == pytest.approx(value * powers.get(name, 5 / 60)), name


@pytest.mark.property
def test_power_that_comes_back_is_the_braking_power():
    sizing = size_motor([0, 1, 2], [3, -4, 3], 2.0)
    assert (sizing.peak_power, sizing.braking_power, sizing.peak_torque) == (6.0, 8.0, 4.0)


@pytest.mark.analytical
def test_inertia_of_a_mass_behind_a_ratio():
    """A mass with J behind the ratio r turns with w r: J r^2 at the shaft."""
    time, ratio, speed = np.linspace(0, 1, 101), np.linspace(0, 0.4, 101), 30.0
    felt = reflected_inertia(time, 0.5 * 2.0 * (ratio * speed) ** 2, speed)
    assert felt.peak == pytest.approx(2.0 * 0.4**2)
    assert felt.mean == pytest.approx(2.0 * 0.4**2 / 3, rel=1e-4)


@pytest.mark.property
def test_reducer_keeps_the_power_but_for_its_loss():
    torque, speed = np.array([10.0, -10.0, 10.0]), np.array([3.0, 3.0, -3.0])
    fast, turning = through_reducer(torque, speed, 5.0, 0.8)
    assert turning == pytest.approx([15, 15, -15])
    assert fast * turning == pytest.approx([37.5, -24, -24])


@pytest.mark.error
@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (([0.0], [1.0]), "1 samples of time"),
        (([0, 2, 1], [1, 1, 1]), "goes back from 2 s to 1 s at sample 2"),
        (([1, 1], [1, 1]), "all 2 samples are at 1 s"),
        (([0, 1], [1, 2, 3]), "torque has the shape"),
        (([0, 1], [1, np.nan]), "not finite at 1 of 2"),
    ],
)
def test_what_is_no_cycle_is_refused(arguments, words):
    with pytest.raises(InputError, match=words):
        rms_over_cycle(*arguments)


@pytest.mark.error
def test_shaft_that_stands_has_no_reflected_inertia():
    with pytest.raises(InputError, match="the shaft stands"):
        reflected_inertia([0, 1], [1, 1], [1, 0])


@pytest.mark.error
@pytest.mark.parametrize(
    ("ratio", "efficiency", "words"), [(0.0, 1.0, "ratio = 0"), (2.0, 1.2, "efficiency = 1.2"), (2.0, 0.0, "efficiency")]
)
def test_reducer_without_meaning_is_refused(ratio, efficiency, words):
    with pytest.raises(InputError, match=words):
        through_reducer(1.0, 1.0, ratio, efficiency)
