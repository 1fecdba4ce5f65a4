"""Many linkages at once: value by value what a run gives, of one turn where every turn is like it."""

import numpy as np
import pytest
from places import EXAMPLES

import drivewright as dw
from drivewright import registry
from drivewright.errors import DrivewrightError
from drivewright.execution.keys import key_kind
from drivewright.execution.outputs import case_outputs
from drivewright.multibody.analyses.repeated_turn import repeated_turn
from drivewright.multibody.analyses.simulation_model import run_of
from drivewright.runner import run_analyses, select_analyses
from drivewright.spec import document, from_document, set_key, value_at
from drivewright.studies.sweeps import sweep

pytestmark = pytest.mark.property

LINKAGE = registry.mechanism("linkage")
ANALYSES = ("motion", "energy", "singular", "end")
LENGTHS = {  # some of these cannot go round
    "bodies.crank.points.A.0": (0.030, 0.055),
    "bodies.coupler.points.B.0": (0.085, 0.115),
    "bodies.rocker.points.B.0": (0.070, 0.105),
    "ground.points.O4.0": (0.105, 0.130),
}
OTHERS = {
    "drive.speed": (-40.0, 40.0),
    "bodies.coupler.mass": (0.0, 0.5),
    "bodies.coupler.centroid.1": (-0.01, 0.02),
    "springs.return.stiffness": (0.0, 800.0),
    "torques.load.torque": (-1.0, 1.0),
    "simulate.discard": (0.0, 0.9),
}


def four_bar(turns=2.0, **changes):
    """The example, without its random dimensions."""
    tables = document(dw.load(EXAMPLES / "four_bar.toml"))
    del tables["tolerances"]
    return from_document(tables | {"simulate": {"turns": turns}} | changes)


def outputs_of(spec, keys, design, analyses=ANALYSES):
    """{name: number} of a run of one design; none where it is refused or an analysis fails."""
    tables = document(spec)
    for key, number in zip(keys, design, strict=True):
        set_key(tables, key, key_kind(spec, key).given(number))
    try:
        changed = from_document(tables, type(spec))
        answers = run_analyses(changed, LINKAGE.build(changed), select_analyses(LINKAGE.analyses, analyses)).values()
    except DrivewrightError:
        return {}
    if any(answer.outcome == "partial" for answer in answers):
        return {}
    values = {name: value for answer in answers for name, value in answer.values.items()}
    return {name: output.value for name, output in case_outputs(values, [check for a in answers for check in a.checks]).items()}


def assert_same(spec, ranges, analyses=ANALYSES, count=16):
    """The batch equals the runs in every name that any of them has; how many of the designs were refused."""
    low, high = np.array(list(ranges.values())).T
    keys, designs = tuple(ranges), np.random.default_rng(11).uniform(low, high, (count, len(low)))
    runs = [outputs_of(spec, keys, design, analyses) for design in designs]
    names = tuple(dict.fromkeys(name for run in runs for name in run))
    found = LINKAGE.batch(spec, keys, names)(designs)
    for name in names:
        alone = np.array([run.get(name, np.nan) for run in runs])
        np.testing.assert_allclose(found[name], alone, rtol=1e-9, atol=1e-12 * np.nanmax(np.abs(alone)), err_msg=name)
    return sum(not run for run in runs)


def test_lengths_of_a_four_bar_some_of_which_cannot_go_round():
    assert 0 < assert_same(four_bar(), LENGTHS, count=24) < 12


def test_masses_loads_springs_and_the_speed():
    assert assert_same(four_bar(2.5), OTHERS) == 0


def test_forces_in_the_joints():
    assert assert_same(four_bar(1.5), {"bodies.coupler.mass": (0.1, 0.5), "bodies.crank.points.A.0": (0.03, 0.04)}, ("forces",), 3) == 0


def test_what_a_spec_refuses_is_refused():
    """A negative mass, an inertia below that of the mass in the centroid, a speed of 0; the other designs have their numbers."""
    spec, keys = four_bar(bodies=with_inertia_about("O4")), ("bodies.rocker.mass", "drive.speed")
    designs = np.array([[0.25, 30.0], [-0.1, 30.0], [0.3, 30.0], [0.25, 0.0], [0.2, 30.0], [np.nan, 30.0]])
    found = LINKAGE.batch(spec, keys, ("rocker.swing", "drive.max_torque"))(designs)
    for name, column in found.items():
        alone = [outputs_of(spec, keys, design).get(name, np.nan) for design in designs[:-1]]
        np.testing.assert_allclose(column[:-1], alone, rtol=1e-9)
        assert np.isnan(column).tolist() == [False, True, True, True, False, True]


def with_inertia_about(point):
    """Bodies whose rocker has its inertia stated about a pivot, as large as a mass of 0.26 kg in the centroid has there."""
    bodies = document(four_bar())["bodies"]
    rocker = bodies["rocker"] | {"inertia": f"{0.26 * 0.045**2} kg m^2", "inertia_about": point}
    return bodies | {"rocker": rocker}


# -- runs of which one turn does not stand for all -----------------------------------------------------------------------------

CRANK = [{"name": "crank", "body": "crank"}, {"name": "rocker", "body": "rocker"}]
WOUND = [{"name": "wound", "body": "crank", "stiffness": "0.3 N m/rad"}]
EVERY_TURN, NOT_ALIKE = True, False


def load(tmp_path, rows, over="time [s]", periodic=False):
    """A torque on the crank from a table."""
    path = tmp_path / "load.csv"
    path.write_text("\n".join([f"{over},torque [N m]", *(f"{x},{torque}" for x, torque in rows)]))
    return [{"body": "crank", "file": str(path), "periodic": periodic}]


LATE = [(0.0, 0.0), (0.25, 0.0), (0.3, 0.8), (0.4, 0.0), (1.0, 0.0)]
IN_TURNS = [(0.0, 0.0), (0.02, 0.4), (0.1, -0.4), (0.2, 0.0)]  # of 0.2 s
OUT_OF_STEP = [(0.0, 0.0), (0.02, 0.4), (0.15, 0.0)]
FAR_ROUND = [(0.0, 0.0), (400.0, 0.0), (500.0, 0.8), (640.0, 0.0), (1440.0, 0.0)]  # in the second turn only
TWICE_ROUND = [(0.0, 0.0), (400.0, 0.0), (500.0, 0.8), (600.0, 0.0), (720.0, 0.0)]
ROUND = [(0.0, 0.0), (90.0, 0.4), (200.0, -0.4), (360.0, 0.0)]


@pytest.mark.parametrize(
    ("changes", "alike"),
    [
        ({}, EVERY_TURN),
        ({"gravity": ["0 m/s^2", "-20 m/s^2"]}, EVERY_TURN),
        ({"outputs": CRANK}, NOT_ALIKE),
        ({"rotational_springs": WOUND}, NOT_ALIKE),
        ({"simulate": {"turns": 1.0}}, NOT_ALIKE),
        ({"simulate": {"turns": 2.0, "discard": 1.0}}, NOT_ALIKE),
        ({"simulate": {"turns": 2.0, "discard": 0.99}}, EVERY_TURN),
        ({"simulate": {"duration": "0.5011 s"}}, NOT_ALIKE),
        ({"load": (LATE,)}, NOT_ALIKE),
        ({"load": (IN_TURNS, "time [s]", True)}, EVERY_TURN),
        ({"load": (OUT_OF_STEP, "time [s]", True)}, NOT_ALIKE),
        ({"load": (FAR_ROUND, "angle [deg]")}, NOT_ALIKE),
        ({"load": (TWICE_ROUND, "angle [deg]", True)}, NOT_ALIKE),
        ({"load": (ROUND, "angle [deg]")}, EVERY_TURN),
    ],
)
def test_one_turn_stands_for_a_run_only_where_all_are_alike(changes, alike, tmp_path):
    tables = dict(changes)
    if "load" in tables:
        tables["torques"] = load(tmp_path, *tables.pop("load"))
    spec = four_bar(**tables)
    model = LINKAGE.build(spec)
    turn = repeated_turn(model)
    assert (turn is not model) == alike
    assert turn.run_length <= model.run_length
    assert_same(spec, {"bodies.crank.mass": (0.1, 0.3)}, ("motion", "energy"), 2)


def geared(ratio):
    """A crank that turns a second one by gears, and a rocker that follows the point where their couplers meet."""
    spec = document(four_bar(3.0))
    wheel = {"mass": "0.1 kg", "inertia": "2e-5 kg m^2", "points": {"O": ["0 mm", "0 mm"], "C": ["9 mm", "0 mm"]}, "angle": "20 deg"}
    rods = {
        name: {"mass": "0.05 kg", "inertia": "3e-5 kg m^2", "angle": angle, "points": {"A": ["0 mm", "0 mm"], "B": [length, "0 mm"]}}
        for name, length, angle in (("long", "80 mm", "40 deg"), ("short", "70 mm", "110 deg"))
    }
    spec["ground"] = {"points": {"O2": ["0 mm", "0 mm"], "O5": ["80 mm", "0 mm"]}}
    spec["bodies"] = {"crank": wheel, "other": wheel | {"angle": "70 deg"}, **rods}
    spec["joints"] = [
        {"name": "O2", "connects": ["ground.O2", "crank.O"]},
        {"name": "O5", "connects": ["ground.O5", "other.O"]},
        {"name": "gears", "kind": "gear", "connects": ["crank", "other"], "ratio": ratio},
        {"name": "A", "connects": ["crank.C", "long.A"]},
        {"name": "D", "connects": ["other.C", "short.A"]},
        {"name": "B", "connects": ["long.B", "short.B"]},
    ]
    spec["outputs"] = [{"name": "tip", "body": "long", "point": "B"}]
    for table in ("springs", "torques"):
        del spec[table]
    return from_document(spec)


@pytest.mark.parametrize(("ratio", "alike"), [(-1.0, EVERY_TURN), (-2.0, EVERY_TURN), (-0.5, NOT_ALIKE), (0.62, NOT_ALIKE)])
def test_gears_repeat_where_both_wheels_come_round(ratio, alike):
    spec = geared(ratio)
    model = LINKAGE.build(spec)
    assert (repeated_turn(model) is not model) == alike
    assert_same(spec, {"bodies.crank.points.C.0": (0.008, 0.010), "joints.gears.ratio": (ratio, ratio)}, count=3)


def parallelogram(rocker, start=50.0):
    """Cranks of 40 mm that come in line with the frame twice a turn, or nearly so."""
    spec = document(four_bar(2.0))
    spec["ground"]["points"]["O4"] = ["100 mm", "0 mm"]
    spec["bodies"]["crank"]["angle"] = spec["bodies"]["rocker"]["angle"] = f"{start} deg"
    spec["bodies"]["rocker"] |= {"centroid": ["20 mm", "0 mm"], "points": {"O4": ["0 mm", "0 mm"], "B": [f"{rocker} mm", "0 mm"]}}
    spec["bodies"]["coupler"]["angle"] = "0 deg"
    return from_document(spec | {"outputs": [{"name": "point", "body": "coupler", "point": "C"}]})


@pytest.mark.parametrize(
    ("rocker", "start", "alike"),
    [
        (40.0, 50.0, NOT_ALIKE),  # it folds
        (40.01, 50.0, NOT_ALIKE),  # the first turn splits its coordinates a sample before the others do
        (40.05, 30.0, EVERY_TURN),
    ],
)
def test_a_linkage_that_folds_or_nearly_so_has_the_whole_run_unless_all_turns_split_alike(rocker, start, alike):
    spec = parallelogram(rocker, start)
    model = LINKAGE.build(spec)
    assert (repeated_turn(model) is not model) == alike
    assert_same(spec, {"bodies.crank.mass": (0.1, 0.3), "drive.speed": (20.0, 30.0)}, count=2)


def test_a_run_that_stops_before_a_fold_has_no_values():
    spec = parallelogram(40.0)
    stopping = spec.model_copy(update={"simulate": spec.simulate.model_copy(update={"singular": "stop"})})
    found = LINKAGE.batch(spec, ("drive.speed",), ("point.swing",))(np.array([[20.0]]))
    assert np.isfinite(found["point.swing"]).all()
    assert LINKAGE.batch(stopping, ("drive.speed",), ("point.swing",)) is None


def leg(angle=0.0, crank=15.0, speed=60.0):
    """The example of ten bars, whose loops come so near to folding that their coordinates are split anew twice a turn."""
    tables = document(dw.load(EXAMPLES / "jansen_leg.toml"))
    tables["bodies"]["crank"] |= {"angle": f"{angle} deg", "points": {"O": ["0 mm", "0 mm"], "P": [f"{crank} mm", "0 mm"]}}
    return from_document(tables | {"drive": {"joint": "shaft", "speed": f"{speed} rpm"}, "simulate": {"turns": 2.5}})


@pytest.mark.parametrize(
    ("changes", "splits", "alike"),
    [
        ({}, 2, EVERY_TURN),
        ({"angle": 105.0, "crank": 15.3, "speed": -60.0}, 2, EVERY_TURN),
        ({"angle": 45.0}, 2, NOT_ALIKE),  # samples added in the first turn go on over the second one
        ({"angle": -60.0}, 2, NOT_ALIKE),
    ],
)
def test_a_turn_in_which_coordinates_are_split_anew_stands_for_those_with_the_same_splits(changes, splits, alike):
    spec = leg(**changes)
    model = LINKAGE.build(spec)
    turn = repeated_turn(model)
    assert len([part for part in run_of(model).stretches if part.t_end < model.turn_length]) == splits
    assert (turn is not model) == alike
    assert_same(spec, {"bodies.foot.mass": (0.05, 0.09)}, ("motion", "energy", "forces"), 2)


# -- what a search does with it ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("changes", "keys", "names"),
    [
        ({}, ("drive.joint",), ("rocker.swing",)),
        ({}, ("simulate.samples_per_turn",), ("rocker.swing",)),
        ({}, ("drive.speed",), ("no such value",)),
        ({}, ("tolerances.samples",), ("rocker.swing",)),
        ({"drive": None}, ("bodies.crank.mass",), ("rocker.swing",)),
        ({"simulate": None, "drive": None}, ("bodies.crank.mass",), ("rocker.swing",)),
        ({"play": "0.1 mm"}, ("drive.speed",), ("rocker.swing",)),
    ],
)
def test_what_is_beyond_the_batch_runs_one_by_one(changes, keys, names):
    tables = document(four_bar())
    if "play" in changes:
        tables["joints"][2] |= {"model": "massless-link", "clearance": changes["play"]}
    else:
        tables |= changes
    for name in [name for name, table in tables.items() if table is None]:
        del tables[name]
    if "drive" not in tables and "simulate" in tables:
        tables["simulate"] = {"duration": "0.01 s"}
    assert LINKAGE.batch(from_document(tables), keys, names) is None


def test_every_value_of_a_default_run_is_in_the_batch():
    spec = four_bar(1.25)
    run = outputs_of(spec, (), (), ())
    found = LINKAGE.batch(spec, ("drive.speed",), tuple(run))(np.array([[value_at(spec, "drive.speed")]]))
    for name, value in run.items():
        np.testing.assert_allclose(found[name][0], value, rtol=1e-9, atol=1e-12, err_msg=name)


def test_who_else_is_in_the_batch_changes_no_bit():
    spec, names = four_bar(), ("rocker.swing", "drive.max_torque", "check.inertia.rocker")
    designs = np.random.default_rng(4).uniform(*np.array(list(LENGTHS.values())).T, (12, len(LENGTHS)))
    evaluate = LINKAGE.batch(spec, tuple(LENGTHS), names)
    together, alone = evaluate(designs), [evaluate(design[None]) for design in designs]
    for each in names:
        np.testing.assert_array_equal(together[each], [one[each][0] for one in alone], err_msg=each)


@pytest.mark.slow
def test_a_search_by_the_batch_finds_the_four_bar_that_a_search_by_runs_finds(monkeypatch):
    table = {
        "population": 8,
        "generations": 3,
        "unknowns": [
            {"key": "bodies.crank.points.A.0", "lower": "30 mm", "upper": "75 mm"},
            {"key": "bodies.rocker.points.B.0", "lower": "70 mm", "upper": "110 mm"},
        ],
        "objectives": [{"value": "drive.max_torque"}],
        "requirements": [{"value": "rocker.swing", "at_least": "60 deg"}, {"value": "check.drive_torque"}],
    }
    spec = four_bar(2.0, optimise=table, limits={"drive_torque": "3 N m"})
    by_batch = dw.optimise(spec)
    monkeypatch.setattr("drivewright.studies.search.evaluator.compiled", lambda problem: None)
    by_runs = dw.optimise(spec, workers=1)
    for name, column in by_runs.history.items():
        np.testing.assert_allclose(by_batch.history[name], column, rtol=1e-9)
    assert by_batch.feasible and by_runs.feasible
    assert not np.isfinite(by_batch.history["rocker.swing"]).all()


def test_a_study_takes_the_batch_and_says_why_a_linkage_cannot_go_round(monkeypatch):
    """Every value of a run, none of them by a run but where the crank is too long; without a remark, as the routes agree."""
    spec, levels = four_bar(1.25), {"bodies.crank.points.A.0": ["35 mm", "38 mm", "80 mm", "40 mm", "42 mm"]}
    by_batch = sweep(spec, levels, on="serial")
    assert by_batch.remarks == ()
    assert by_batch["status"].tolist() == ["complete", "complete", "failed", "complete", "complete"]
    monkeypatch.setattr("drivewright.studies.sweeps.with_batch", lambda task, plan: (task, ()))
    by_runs = sweep(spec, levels, on="serial")
    assert by_batch["message"][2] == by_runs["message"][2] != ""
    for name in outputs_of(spec, (), (), ()):
        np.testing.assert_allclose(by_batch[name], by_runs[name], rtol=1e-9, atol=1e-12, err_msg=name)
