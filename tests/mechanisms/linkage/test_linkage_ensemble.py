"""Statistics of linkages with play: exact where the motion repeats itself, with intervals from an ensemble where it does not."""

from types import SimpleNamespace

import numpy as np
import pytest
from places import EXAMPLES

import drivewright as dw
from drivewright.mechanisms.linkage.build import build
from drivewright.multibody.analyses import ensemble, turns
from drivewright.multibody.analyses.simulation_model import run_of
from drivewright.spec import load

pytestmark = pytest.mark.property

EXAMPLE = EXAMPLES / "slider_crank_clearance.toml"
EIGHT = "simulate.ensemble=8"
STATISTICS = (
    "slider.impact_load_coefficient",
    "slider.peak_acceleration_ratio",
    "slider.turn_peak_mean",
    "joints.wrist.max_force",
    "joints.wrist.max_penetration",
    "joints.wrist.impacts_per_turn",
    "joints.wrist.contact_share",
)


def slider(*changes, only=("impact", "pins")):
    return dw.run(load(EXAMPLE, changes), only=only)


def check(found, name):
    return next(one for one in found.checks if one.name == name)


@pytest.fixture(scope="module")
def chaotic():
    """Of eight members: the interval of four is more of a draw."""
    return slider('joints.wrist.clearance="0.1 mm"', EIGHT)


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
    again, other = (slider('joints.wrist.clearance="0.1 mm"', EIGHT, *more) for more in ((), ("simulate.seed=7",)))
    near = slider('joints.wrist.clearance="0.10000000001 mm"', EIGHT)
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
    assert any(finding.startswith("not settled, therefore not among the headline values: slider.") for finding in found.findings)


def test_the_exponent_has_an_interval():
    chaos, calm = (
        slider(f'joints.wrist.clearance="{play}"', "lyapunov.turns=32", only=("lyapunov",)).values["lyapunov_exponent.per_turn"]
        for play in ("0.1 mm", "0.02 mm")
    )
    assert chaos.interval == calm.interval == "ensemble"
    assert 0 < chaos.low < chaos.value < chaos.high
    assert calm.low < calm.value < calm.high < 0


def test_members_start_nearer_to_each_other_than_anybody_makes_them():
    model = build(load(EXAMPLE))
    starts = [ensemble.perturbed_start(model, number) for number in range(4)]
    np.testing.assert_array_equal(starts[0], model.assembly.state)
    ways = [np.linalg.norm((start - starts[0])[: len(model.assembly.system.stored)]) for start in starts[1:]]
    assert all(0 < way <= 1e-3 * 0.5e-3 / 0.05 for way in ways)  # the crank is 50 mm long: angles count in its lengths
    assert not np.allclose(starts[1], starts[2], rtol=0, atol=1e-12)


def test_forces_of_all_joints_and_works_of_a_chaotic_run_carry_intervals():
    found = slider('joints.wrist.clearance="0.1 mm"', only=("forces", "energy", "end", "poincare"))
    for name in (
        "joints.main.max_force",
        "joints.crank_pin.max_force",
        "joints.guide.max_force",
        "energy.pins",
        "energy.drives",
        "bodies.slider.x",
        "bodies.rod.angular_velocity",
    ):
        value = found.values[name]
        assert value.interval == "ensemble" and value.low < value.value < value.high, name
    for name in ("poincare.position", "poincare.velocity"):
        value = found.values[name]
        assert value.interval == "visits" and value.low <= value.value <= value.high and value.low < value.high
    assert found.values["bodies.slider.angle"].interval == ""  # it slides: every member has it


def test_the_audit_tells_the_worst_of_all_runs():
    model = build(load(EXAMPLE, ('joints.wrist.clearance="0.1 mm"',)))
    errors = [turns.audit_of_run(model, run).error for run in (run_of(model), *ensemble.other_runs(model))]
    assert len(errors) == 4 == len(set(errors))
    found = slider('joints.wrist.clearance="0.1 mm"', only=("energy",))
    assert found.values["energy.error"].value == pytest.approx(max(errors), rel=1e-6)
    assert check(found, "energy_audit").value == found.values["energy.error"].value


def test_a_motion_that_repeats_itself_gives_all_its_numbers_alone():
    found = slider('joints.wrist.clearance="0.02 mm"', only=("forces", "energy", "end"))
    assert {found.values[name].interval for name in ("joints.main.max_force", "energy.drives")} == {"periodic"}
    assert found.values["bodies.slider.x"].interval == ""


def test_without_outputs_the_bodies_tell_whether_a_motion_repeats_itself():
    spec = load(EXAMPLE, ('joints.wrist.clearance="0.02 mm"',)).replace(outputs=(), poincare=None)
    model = build(spec)
    assert list(model.markers) == ["crank", "rod", "slider"]
    assert ensemble.turns_to_repeat(model) == 1 and not ensemble.other_runs(model)


def test_the_load_table_carries_intervals_where_the_motion_is_chaotic():
    spec = load(EXAMPLE, ('table.speeds=["5000 rpm"]', 'table.clearances=["0.02 mm", "0.1 mm"]', 'table.output="slider"'))
    table = next(one for one in dw.run(spec, only=("load_table",)).tables.values() if one.name == "load_table")
    low, high = (column.data for column in table.bounds_of("coefficient"))
    value = table["coefficient"].data
    assert high[0] - low[0] < 3e-6 * value[0]  # repeats itself
    assert low[1] < value[1] < high[1] and high[1] - low[1] > 1e-3 * value[1]
    alone = slider('joints.wrist.clearance="0.1 mm"', only=("impact",)).values["slider.impact_load_coefficient"]
    assert value[1] == pytest.approx(alone.value, rel=1e-2) and low[1] < alone.value < high[1]


def test_a_bearing_that_wears_in_chaos_is_the_mean_of_several():
    changes = (
        'joints.wrist.wear_coefficient="1e-14 m^3/(N m)"',
        'joints.wrist.bearing_length="10 mm"',
        "joints.wrist.friction=0.1",
        'wear.joint="wrist"',
        "wear.cycles=1000",
        "wear.jumps=2",
        "wear.bins=36",
        "simulate.turns=16",
        "simulate.discard=4",
    )
    chaos = slider('joints.wrist.clearance="0.1 mm"', *changes, only=("wear",))
    depth, table = chaos.values["wear.wrist.max_depth"], chaos.tables["wear.wrist"]
    assert depth.interval == "ensemble" and 0 < depth.low < depth.value < depth.high
    low, high = (column.data for column in table.bounds_of("last"))
    mean = table["last"].data
    assert np.all((low <= mean) & (mean <= high)) and np.any(high > low)
    assert chaos.values["wear.wrist.volume"].value == pytest.approx(2 * np.pi * 0.01 * 0.01 * np.mean(mean), rel=1e-9)


# ------------------------------------------------------------------------------------------------------------ pieces


def test_means_of_turns_are_those_of_the_polygon():
    t = np.sort(np.concatenate([[0.0, 3.0], np.random.default_rng(3).uniform(0, 3, 40)]))
    x = 2.0 + 3.0 * t
    np.testing.assert_allclose(turns.mean_per_turn(t, x, np.arange(4.0)), 2 + 3 * (np.arange(3) + 0.5), rtol=1e-12)
    whole = np.trapezoid(np.sin(9 * t), t)
    assert np.sum(turns.mean_per_turn(t, np.sin(9 * t), np.arange(4.0))) == pytest.approx(whole, rel=1e-12)


@pytest.mark.parametrize("period", [1, 2, 3])
def test_a_motion_of_several_turns_is_seen(period):
    t = np.linspace(0, 13.0, 20_001)
    model = SimpleNamespace(period=1.0, markers={"o": None}, assembly=SimpleNamespace(system=SimpleNamespace(length=1.0)))
    assert ensemble.orbit_turns(model, seen_of(t, 2 * np.pi / period)) == period
    assert ensemble.orbit_turns(model, seen_of(t, 2 * np.pi / np.sqrt(2))) == 0
    assert ensemble.orbit_turns(model, seen_of(t, 2 * np.pi / period, turning=2 * np.pi)) == period  # an angle that grows for ever


def seen_of(t, speed, turning=0.0):
    """A marker that swings about, and along, as a cosine, and turns on besides."""
    x, rate, gain = np.cos(speed * t), -speed * np.sin(speed * t), -(speed**2) * np.cos(speed * t)
    fields = {"angle": x + turning * t, "w": rate + turning, "alpha": gain, "x": x, "vx": rate, "ax": gain}
    still = np.zeros_like(t)
    return SimpleNamespace(t=t, point=lambda name, field: fields.get(field, still))
