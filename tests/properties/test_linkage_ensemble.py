"""Statistics of linkages with play: exact where the motion repeats itself, with intervals from an ensemble where it does not."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import drivewright as dw
from drivewright.mechanisms.linkage import ensemble
from drivewright.mechanisms.linkage.build import build
from drivewright.spec import load

EXAMPLE = Path(__file__).parents[2] / "examples" / "slider_crank_clearance.toml"
STATISTICS = ("slider.impact_load_coefficient", "slider.peak_acceleration_ratio", "slider.turn_peak_mean", "joints.wrist.max_force",
              "joints.wrist.max_penetration", "joints.wrist.impacts_per_turn", "joints.wrist.contact_share")


def slider(*changes, only=("impact", "pins")):
    return dw.run(load(EXAMPLE, changes), only=only)


def check(found, name):
    return next(one for one in found.checks if one.name == name)


@pytest.fixture(scope="module")
def chaotic():
    return slider('joints.wrist.clearance="0.1 mm"')


def test_a_motion_that_repeats_itself_needs_no_ensemble():
    spec = load(EXAMPLE, ('joints.wrist.clearance="0.02 mm"',))
    found, model = dw.run(spec, only=("impact", "pins")), build(spec)
    assert ensemble.statistics(model).period == 1 and len(ensemble.statistics(model).members) == 1
    for name in STATISTICS:
        value = found.values[name]
        assert value.interval == "periodic" and value.settled
        assert value.low <= value.value <= value.high and value.high - value.low <= 2.1e-6 * abs(value.value)
    assert check(found, "settled").ok and check(found, "settled.joints").ok


def test_a_chaotic_motion_carries_intervals(chaotic):
    for name in STATISTICS:
        value = chaotic.values[name]
        assert value.interval == "ensemble" and value.low < value.value < value.high
    value = chaotic.values["slider.turn_peak_mean"]
    assert value.high - value.low < 0.5 * value.value
    assert chaotic.values["slider.ideal_peak"].interval == ""


def test_the_same_seed_gives_the_same_numbers_and_another_overlapping_ones(chaotic):
    again, other = slider('joints.wrist.clearance="0.1 mm"'), slider('joints.wrist.clearance="0.1 mm"', "simulate.seed=7")
    near = slider('joints.wrist.clearance="0.10000000001 mm"')
    for name in STATISTICS:
        one = chaotic.values[name]
        assert again.values[name] == one
        for found in (other, near):
            value = found.values[name]
            assert value != one
            assert value.low < one.high and one.low < value.high


def test_a_statistic_without_rest_is_told_and_is_no_headline():
    found = slider('joints.wrist.clearance="0.1 mm"', "simulate.turns=3", "simulate.discard=1", "simulate.ensemble=2")
    assert not check(found, "settled").ok
    assert not found.values["slider.turn_peak_mean"].settled


def test_the_exponent_has_an_interval():
    chaos, calm = (slider(f'joints.wrist.clearance="{play}"', "lyapunov.turns=32", only=("lyapunov",)).values["lyapunov_exponent.per_turn"]
                   for play in ("0.1 mm", "0.02 mm"))
    assert chaos.interval == calm.interval == "ensemble"
    assert 0 < chaos.low < chaos.value < chaos.high
    assert calm.low < calm.value < calm.high < 0


def test_members_start_nearer_to_each_other_than_anybody_makes_them():
    model = build(load(EXAMPLE))
    starts = [ensemble.shifted(model, number) for number in range(4)]
    np.testing.assert_array_equal(starts[0], model.assembly.state)
    ways = [np.linalg.norm((start - starts[0])[: len(model.assembly.system.stored)]) for start in starts[1:]]
    assert all(0 < way <= 1e-3 * 0.5e-3 / 0.05 for way in ways)  # the crank is 50 mm long: angles count in its lengths
    assert not np.allclose(starts[1], starts[2], rtol=0, atol=1e-12)


# ------------------------------------------------------------------------------------------------------------ pieces


def test_means_of_turns_are_those_of_the_polygon():
    t = np.sort(np.concatenate([[0.0, 3.0], np.random.default_rng(3).uniform(0, 3, 40)]))
    x = 2.0 + 3.0 * t
    np.testing.assert_allclose(ensemble.means_of_turns(t, x, np.arange(4.0)), 2 + 3 * (np.arange(3) + 0.5), rtol=1e-12)
    whole = np.trapezoid(np.sin(9 * t), t)
    assert np.sum(ensemble.means_of_turns(t, np.sin(9 * t), np.arange(4.0))) == pytest.approx(whole, rel=1e-12)


@pytest.mark.parametrize("period", [1, 2, 3])
def test_a_motion_of_several_turns_is_seen(period):
    t = np.linspace(0, 13.0, 20_001)
    seen, output = seen_of(t, 2 * np.pi / period), SimpleNamespace(name="o", point=None)
    model = SimpleNamespace(period=1.0, spec=SimpleNamespace(outputs=[output]))
    assert ensemble.repeats(model, seen) == period
    assert ensemble.repeats(model, seen_of(t, 2 * np.pi / np.sqrt(2))) == 0


def seen_of(t, speed):
    fields = {"angle": np.cos(speed * t), "w": -speed * np.sin(speed * t), "alpha": -speed**2 * np.cos(speed * t)}
    return SimpleNamespace(t=t, point=lambda name, field: fields[field])
