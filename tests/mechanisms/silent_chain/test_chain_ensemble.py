"""Statistics of a running chain: the same for a hair's breadth and for any duration, and honest where they have not settled."""

import tomllib
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from places import EXAMPLES

import drivewright as dw
from drivewright.chains.explicit.batch import quantiles, revolution_time
from drivewright.chains.explicit.ensemble import (
    DISTURBANCE,
    Ensemble,
    amplitude_of,
    centre_distance,
    disturbed,
    ensemble,
    maximum_of,
    mean_of,
    range_of,
)
from drivewright.chains.explicit.motion import LOSSES, Motion
from drivewright.chains.explicit.run_in import SHORTEST, run_in_time
from drivewright.chains.explicit.simulate import Settings, first_start, tooth_time
from drivewright.chains.explicit.state import SUMS
from drivewright.errors import InputError
from drivewright.mechanisms.silent_chain.build import build
from drivewright.mechanisms.silent_chain.chain_drive import chain_drive
from drivewright.numerics.ensemble import estimate
from drivewright.spec import from_document
from drivewright.spec.parsing import change_key

pytestmark = pytest.mark.property

HYVO = EXAMPLES / "hyvo_chain.toml"
FLUCTUATION, RANGE = "dynamics.centre_distance.fluctuation", "dynamics.centre_distance.range"
OF_CHAOS = (
    "centre_distance.mean",
    "centre_distance.fluctuation",
    "centre_distance.range",
    "centre_distance.mesh_order_amplitude",
    "transmission_error",
    "tension.mean",
    "tension.maximum",
    "flank_force.maximum",
    "friction_utilisation",
)


def hyvo(*changes):
    """The worked Hy-Vo chain with some keys changed."""
    tables = tomllib.loads(HYVO.read_text())
    for change in changes:
        change_key(tables, change)
    return from_document(tables)


def run(*changes):
    return dw.run(hyvo(*changes), only=("dynamics",))


@pytest.fixture(scope="module")
def usual():
    return run()


@pytest.fixture(scope="module")
def another():
    """The same but for less than the width of an atom: another draw of the chaos."""
    return run('joint.rolling_radius="1.2000000001 mm"')


def width(result, name=FLUCTUATION):
    return result.values[name].high - result.values[name].low


def overlap(one, other, name=FLUCTUATION):
    a, b = one.values[name], other.values[name]
    return a.low <= b.high and b.low <= a.high


def test_every_statistic_of_the_running_chain_has_an_interval_and_has_settled(usual, another):
    draws = [draw for draw in (usual, another) if draw.check("settled").ok]  # chance calls one in thirty unsettled
    assert draws and usual.outcome == another.outcome == "complete"
    for name in OF_CHAOS:
        found = usual.values[f"dynamics.{name}"]
        assert found.low < found.value < found.high and found.interval == "ensemble", name
    assert width(usual) < 1.2 * usual[FLUCTUATION]
    assert usual[RANGE] > usual[FLUCTUATION]
    spectrum = usual.tables["spectrum"]
    assert np.all(spectrum["centre_distance.low"].data <= spectrum["centre_distance.high"].data)


def test_a_hair_s_breadth_of_the_rolling_radius_is_within_the_interval(usual, another):
    assert overlap(usual, another) and overlap(usual, another, "dynamics.centre_distance.mean")
    assert another[FLUCTUATION] != usual[FLUCTUATION]  # chaos all the same


@pytest.mark.slow
def test_the_duration_does_not_decide_the_fluctuation(usual):
    short, long = (run(f'dynamics.duration="{seconds} s"') for seconds in (0.3, 1))
    assert overlap(short, long) and overlap(usual, long)
    assert width(long) < 3 * width(short) < 5 * short[FLUCTUATION]  # four members tell a width to a factor of two
    assert long[RANGE] > short[RANGE]  # that of a longer run
    assert short.check("settled").ok or long.check("settled").ok


def test_without_damping_of_the_articulation_the_run_does_not_settle():
    found = run("contact.articulation_damping_ratio=0")
    assert not found.check("settled").ok
    assert not found.values["dynamics.centre_distance.mean"].settled
    assert any("not settled: dynamics.centre_distance.mean" in finding for finding in found.findings)


def test_less_than_two_revolutions_cannot_tell():
    found = run('dynamics.duration="75 ms"', "dynamics.ensemble=2")
    assert not found.check("settled").ok and not found.values[FLUCTUATION].settled
    assert any("shorter than two revolutions" in finding for finding in found.findings)
    assert found.values[FLUCTUATION].interval == "ensemble"


def test_a_run_that_is_not_chaotic_stands_alone():
    found = run(
        'drive.speed="300 rpm"',
        'drive.preload="600 N"',
        "contact.articulation_damping_ratio=2",
        "driven.damping_ratio=1",
        'contact.stiffness="2e4 N/mm"',
        'contact.joint_damping="20 us"',
        'dynamics.settling="0.1 s"',
    )
    assert found.values[FLUCTUATION].interval in ("windows", "periodic")
    assert found.check("settled").ok
    assert found.values[FLUCTUATION].high - found.values[FLUCTUATION].low < 0.05 * found[FLUCTUATION]


# --------------------------------------------------------------------------------------------------------------- the pieces


@pytest.fixture(scope="module")
def system():
    return chain_drive(build(hyvo()))


def test_the_same_seed_gives_the_same_runs_in_any_number_of_threads(system):
    one, same, other = (
        ensemble(system, 6e-3, Settings(run_in=2e-3), 3, seed=seed, workers=workers) for seed, workers in ((0, 1), (0, 3), (1, 2))
    )
    for a, b in zip(one.members, same.members, strict=True):
        np.testing.assert_array_equal(a.rows, b.rows)
    np.testing.assert_array_equal(one.first.rows, other.first.rows)  # the first is undisturbed
    assert np.any(one.members[1].rows != other.members[1].rows)
    assert np.any(one.members[1].rows != one.members[2].rows)


def test_a_start_is_disturbed_by_nanometres(system):
    begin = first_start(system, Settings())
    moved = disturbed(begin, (0, 1)).poses - begin.poses
    assert np.std(moved[:, :2]) == pytest.approx(DISTURBANCE, rel=0.2)
    assert np.all(moved[:, 2] == 0.0) and np.max(np.abs(moved)) < 1e-8


@pytest.mark.parametrize("members", [0, 2.0, True])
def test_an_ensemble_has_members(system, members):
    with pytest.raises(InputError, match="1 member or more"):
        ensemble(system, 1e-3, members=members)


def test_the_run_in_lasts_two_periods_of_a_strand(system):
    begin = first_start(system, Settings())
    free = 82 - sum(map(len, begin.seated))
    wave = np.sqrt(begin.tension / system.chain.line_density)
    period = 2 * (0.5 * free + 1) * 9.525e-3 * wave / (wave**2 - begin.speed**2)
    assert run_in_time(system, begin) == pytest.approx(2 * period, rel=0.05)
    assert run_in_time(system, replace(begin, tension=100 * begin.tension)) == SHORTEST
    slack = replace(begin, tension=system.chain.line_density * begin.speed**2)  # waves that stand still have no period
    assert run_in_time(system, slack) == pytest.approx(revolution_time(system), rel=1e-9)


def synthetic(system, signal, revolutions=2.0, member=0):
    """A run whose centre distance is signal(time in revolutions, member)."""
    per_tooth = 24
    t = np.arange(int(revolutions * 82 * per_tooth) + 1) * tooth_time(system) / per_tooth
    made = Motion(system, Settings(), 1e-6, 1, t[:, None], np.zeros((len(t), 2, 7)), np.zeros((len(t), 1)), np.zeros((len(t), 9)))
    made.__dict__["centre_distance"] = signal(t / revolution_time(system), member)
    return made


def test_windows_are_revolutions_and_their_parts(system):
    seen = synthetic(system, lambda x, _: x, 2.6)
    assert [(rows.start, rows.stop) for rows in seen.windows()] == [(0, 82 * 24 + 1), (82 * 24, 2 * 82 * 24 + 1)]
    assert [(rows.start, rows.stop) for rows in seen.windows(4)] == [  # of 20 whole teeth each, two of the 82 left over
        (24 * tooth, 24 * (tooth + 20) + 1) for tooth in (0, 20, 40, 60, 82, 102, 122, 142)
    ]
    short = synthetic(system, lambda x, _: x, 0.5)
    assert (short.revolutions, [(rows.start, rows.stop) for rows in short.windows()]) == (0, [(0, 41 * 24 + 1)])


def test_statistics_are_those_of_their_windows(system):
    turns = 2 * np.pi
    wave = lambda x, k: 0.2 + 1e-6 * x + (3 + k) * 1e-6 * np.sin(82 * turns * x) + 1e-6 * np.cos(164 * turns * x)  # noqa: E731
    runs = Ensemble(tuple(synthetic(system, wave, member=k) for k in range(2)))
    np.testing.assert_allclose(runs.windows(mean_of(centre_distance)), 0.2 + 1e-6 * np.array([[0.5, 1.5]] * 2), rtol=1e-12)
    np.testing.assert_allclose(runs.windows(amplitude_of(centre_distance)), 1e-6 * np.array([[3, 3], [4, 4]]), rtol=4e-3)
    np.testing.assert_allclose(runs.windows(amplitude_of(centre_distance, 2.0)), 1e-6, rtol=1e-2)
    greatest = runs.windows(maximum_of(centre_distance))
    assert np.all(greatest[:, 1] - greatest[:, 0] == pytest.approx(1e-6, rel=1e-6))
    assert runs.extreme(range_of(centre_distance)).value > runs.estimate(range_of(centre_distance)).value


def test_a_drift_of_the_mean_is_told_and_a_pattern_that_goes_round_is_none(system):
    random = np.random.default_rng(3)
    noise = [[random.normal(0, 1e-6, 4) for _ in range(3)] for _ in range(4)]
    going_round = lambda x: 2e-5 * np.sin(2 * np.pi * x)  # noqa: E731

    def seen(drift):
        step = lambda x, k: 0.2 + going_round(x) + drift * x + np.concatenate(noise[k])[np.minimum((4 * x).astype(int), 11)]  # noqa: E731
        return Ensemble(tuple(synthetic(system, step, 3.0, k) for k in range(4)))

    mean, spread = mean_of(centre_distance), range_of(centre_distance)
    assert seen(0.0).estimate(mean, spread).settled
    drifting = seen(4e-6).estimate(mean, spread)
    assert not drifting.settled and drifting.interval == "ensemble"


def by_revolution(system, levels, ripple=0.0):
    """Members whose centre distance keeps a level in every revolution: levels (members, revolutions), and a ripple of tooth after tooth."""

    def signal(x, member):
        row = np.asarray(levels[member])
        return 0.2 + row[np.minimum(x.astype(int), len(row) - 1)] + ripple * np.sin(82 * 2 * np.pi * x)

    return Ensemble(tuple(synthetic(system, signal, float(len(levels[0])), k) for k in range(len(levels))))


def with_settings(run, settings):
    """A synthetic run with other settings."""
    made = replace(run, settings=settings)
    made.__dict__["centre_distance"] = run.centre_distance
    return made


MEAN, RIPPLE = mean_of(centre_distance), range_of(centre_distance)


def test_memory_as_long_as_a_revolution_cannot_settle_by_a_small_drift_alone(system):
    """The level of each half is its own all along: small beside the ripple, but no two samples of it are independent."""
    alone = by_revolution(system, [[1e-7, -1e-7]], 2e-5)
    assert alone._drift(MEAN) < 0.01 * np.max(alone.windows(RIPPLE)) and not alone.estimate(MEAN, RIPPLE).settled
    many = by_revolution(system, [[way, -way] * 8 for way in (1e-7, -1e-7)], 2e-5)  # sixteen revolutions that alternate
    assert many.estimate(MEAN, RIPPLE).settled


def test_a_large_drift_is_chance_only_where_there_are_samples_enough(system):
    """Levels that last a revolution leave two samples of each of four members: too few to call a drift of a third chance."""
    levels = 1e-6 * np.array([[1.3, -1.0], [-0.7, 1.0], [1.3, 1.0], [-0.7, -1.0]])
    runs = by_revolution(system, levels)
    assert runs._drift(MEAN) == pytest.approx(0.3e-6, rel=0.01)
    assert not runs.is_settled(MEAN, 1e-6)
    assert runs.is_settled(MEAN, 1e-5)  # the same drift where it does not matter


def test_runs_that_are_not_chaotic_settle_by_their_drift(system):
    for drift, settled in ((1e-6, True), (4e-6, False)):
        run = synthetic(system, lambda x, _, drift=drift: 0.2 + drift * (x - 1) + 1e-5 * np.sin(164 * np.pi * x))
        assert Ensemble((run,), chaotic=False).is_settled(MEAN, 2e-5) == settled


def test_one_revolution_and_a_half_cannot_tell(system):
    assert not Ensemble((synthetic(system, lambda x, _: 0.2 + 1e-6 * np.sin(164 * np.pi * x), 1.5),), chaotic=False).is_settled(MEAN, 1.0)


@pytest.mark.parametrize("apart, before, members", [(0.9e-2, 0.5, 1), (1.1e-2, 0.0, 4)])
def test_runs_that_stay_together_are_one(system, apart, before, members):
    """Nowhere further apart than a hundredth of the range of the steady part; what was before it does not count."""
    settings = Settings(settle=0.5 * revolution_time(system))

    undisturbed = first_start(system, settings).poses

    def solved(model, duration, settings, begin):
        off = lambda x: np.where(x < 0.4, before, np.where(np.abs(x - 1.2) < 0.01, apart, 0.0))  # noqa: E731
        signal = lambda x, other: 0.2 + 1e-5 * (0.5 * np.sin(164 * np.pi * x) + other * off(x))  # noqa: E731
        made = synthetic(system, signal, 2.6, float(np.any(begin.poses != undisturbed)))
        return with_settings(made, settings)

    found = ensemble(system, 1.0, settings, 4, solve=solved, workers=1)
    assert (len(found.members), found.chaotic) == (members, members > 1)


def test_the_drift_of_an_ensemble_is_that_of_its_worst_member():
    runs = Ensemble(tuple(SimpleNamespace(energy_drift=drift) for drift in (1e-5, 3e-4, 2e-5)))
    assert runs.energy_drift == 3e-4


def test_every_work_is_in_the_balance_of_energy():
    """The sums of a run are works, but for the impulses; the dampings of joints and contacts are counted by themselves."""
    works = {name for name in SUMS if "impulse" not in name} | {"joint damping", "contact damping"}
    assert set(LOSSES) == works and len(LOSSES) == len(works)


def test_what_repeats_is_periodic_and_its_interval_is_rounding(system):
    runs = Ensemble((synthetic(system, lambda x, _: 0.2 + 1e-6 * np.sin(82 * 2 * np.pi * x)),), chaotic=False)
    for statistic, spread in ((mean_of(centre_distance), range_of(centre_distance)), (range_of(centre_distance), None)):
        found = runs.estimate(statistic, spread)
        assert found.interval == "periodic" and found.settled and found.high - found.low < 1e-5 * 2e-6


def test_two_windows_that_agree_by_chance_are_not_a_narrow_interval(system):
    """A beat of 1.7 to the revolution, amplitude 1e-6: both revolutions have all but the same mean, their quarters have not."""
    beat = lambda x, _: 0.2 + 1e-6 * np.sin(2 * np.pi * x / 1.7 + 0.925 * np.pi - 2 * np.pi / 1.7)  # noqa: E731
    runs = Ensemble((synthetic(system, beat, 2.0),), chaotic=False)
    chance, found = runs.estimate(MEAN, RIPPLE), runs.estimate_mean(centre_distance, RIPPLE)
    assert found.value == chance.value and found.interval == "windows"
    quarters = estimate(runs.windows(MEAN, 4))
    assert chance.high - chance.low < 0.1 * (quarters.high - quarters.low) and quarters.high - quarters.low > 6e-7
    np.testing.assert_allclose([found.high - found.value, found.value - found.low], 0.5 * (quarters.high - quarters.low), rtol=1e-6)
    level = by_revolution(system, [[0.0, 3e-6, -1e-6]], 1e-6)
    assert level.estimate_mean(centre_distance, RIPPLE).high >= level.estimate(MEAN, RIPPLE).high
    assert (
        Ensemble((synthetic(system, lambda x, _: 0.2 + 1e-6 * np.sin(164 * np.pi * x)),)).estimate_mean(centre_distance).interval
        == "periodic"
    )


@pytest.mark.parametrize("grows, settled", [(1.4, True), (1.6, False), (0.1, True)])
def test_a_motion_in_which_a_disturbance_grows_has_not_settled(system, grows, settled):
    """The distance of two runs in the second window over that in the first; from far below what would make them two."""
    settings = Settings()
    undisturbed = first_start(system, settings).poses

    def solved(model, duration, settings, begin):
        other = float(np.any(begin.poses != undisturbed))
        signal = lambda x, _: 0.2 + 1e-5 * np.sin(164 * np.pi * x) + other * 1e-9 * np.where(x < 1, 1.0, grows)  # noqa: E731
        return synthetic(system, signal, 2.0)

    found = ensemble(system, 1.0, settings, 4, solve=solved, workers=1)
    assert not found.chaotic and found.growth == pytest.approx(grows, rel=1e-3) and found.stable == settled
    assert found.estimate(MEAN, RIPPLE).settled == found.estimate(RIPPLE).settled == settled
    assert found.estimate(MEAN, RIPPLE).interval == "periodic"


def test_a_distance_of_rounding_is_no_growth(system):
    settings = Settings()
    undisturbed = first_start(system, settings).poses

    def solved(model, duration, settings, begin):
        other = float(np.any(begin.poses != undisturbed))
        return synthetic(system, lambda x, _: 0.2 + 1e-5 * np.sin(164 * np.pi * x) + other * 1e-13 * x**4, 2.0)

    found = ensemble(system, 1.0, settings, 2, solve=solved, workers=1)
    assert found.growth == 1.0 and found.stable


def test_percentiles_are_enclosed_by_order_statistics():
    value, low, high = quantiles(np.arange(20.0), (5, 50, 95))
    np.testing.assert_allclose(value, [0.95, 9.5, 18.05])
    assert np.isnan([low[0], high[2]]).all() and (low[1], high[1]) == (5.0, 14.0)
    random, inside = np.random.default_rng(1), 0
    for _ in range(2000):
        _, least, most = quantiles(random.exponential(size=40), (50,))
        inside += least[0] <= np.log(2) <= most[0]
    assert 0.94 < inside / 2000 < 0.99


def test_the_stored_energy_of_a_slow_run_is_that_of_its_joints(system):
    """Drift counts against all that is stored: a chain that hardly moves stores it in its joints."""
    made = synthetic(system, lambda x, _: x)
    columns = {"kinetic": 1e-6, "elastic": 2e-2, "drive": -3e-5}
    ramp = np.linspace(0, 1, len(made.t))
    fake = SimpleNamespace(
        t=made.t, model=system, tooth_time=made.tooth_time, energy_gap=3e-5 * ramp, column=lambda name: np.full(len(ramp), columns[name])
    )
    assert Motion.energy_drift.fget(fake) == pytest.approx(3e-5 / 2.0001e-2 / (made.t[-1]), rel=1e-9)
    fake.t = made.t[:100]  # a short run is held against a revolution
    assert Motion.energy_drift.fget(fake) == pytest.approx(3e-5 / 2.0001e-2 / revolution_time(system), rel=1e-6)
