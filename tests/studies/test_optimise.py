"""The optimiser: finds what it must, the same each time, and names the requirement to blame."""

import tomllib

import numpy as np
import pytest
from places import EXAMPLES

import drivewright as dw
from drivewright.cli import main
from drivewright.errors import SolverError, SpecError
from drivewright.spec import document, from_document, value_at
from drivewright.studies.search.problem import prepare

pytestmark = pytest.mark.property

PUSHER = EXAMPLES / "seedling_pusher.toml"


def pusher(**changes):
    data = tomllib.loads(PUSHER.read_text())
    data["optimise"] |= changes
    return from_document(data)


@pytest.fixture(scope="module")
def found():
    return dw.optimise(dw.load(PUSHER))


def test_it_finds_a_design_no_worse_than_the_reference(found):
    """Design B, rounded outwards: 55 +- 0.5 deg, 20.15 deg, 1.575, 35.95 mm."""
    best = found.best
    assert found.feasible and all(requirement.ok for requirement in found.requirements)
    assert abs(np.degrees(best["needle.angle_difference"]) - 55) <= 0.5
    assert np.degrees(best["cam.max_pressure_angle"]) <= 20.15
    assert best["cam.curvature_ratio"] >= 1.575
    assert 1e3 * best["cam.max_pitch_radius"] <= 35.95
    assert best.ok, [c for c in best.checks if not c.ok]


def test_the_push_ends_at_the_lowest_point_by_construction(found):
    assert found.best["tip.height_at_push_end"] == pytest.approx(0, abs=1e-12)


def test_the_unknowns_stay_within_their_bounds_and_the_rest_is_untouched(found):
    spec = pusher()
    low, high = found.problem.bounds.T
    assert np.all(found.front >= low) and np.all(found.front <= high)
    assert found.best.spec.drive == spec.drive and found.best.spec.train.semi_major == spec.train.semi_major


def test_the_same_seed_gives_the_same_design():
    small = {"population": 45, "generations": 12}
    first, second, other = (dw.optimise(pusher(seed=seed, **small)) for seed in (4, 4, 5))
    assert np.array_equal(first.front, second.front) and first.evaluations == second.evaluations
    assert not np.array_equal(first.front, other.front)


def test_the_history_holds_every_evaluation(found):
    history = found.history
    assert len(history["violation"]) == found.evaluations == len(history["train.bend"])
    feasible = history["violation"] <= 0
    assert found.front_values["cam.max_pressure_angle"][0] <= history["cam.max_pressure_angle"][feasible].min() + 1e-12


def test_an_impossible_requirement_is_blamed_by_name():
    data = tomllib.loads(PUSHER.read_text())
    data["optimise"] |= {"population": 45, "generations": 15}
    data["optimise"]["requirements"].append({"value": "cam.curvature_ratio", "at_least": 9.0})
    found = dw.optimise(from_document(data))
    assert not found.feasible
    assert "the limiting requirement is cam.curvature_ratio >= 9" in found.findings[0]


def test_exit_code_4_and_the_blame_on_the_command_line(tmp_path, capsys):
    change = ["--set", "optimise.generations=5", "--set", "optimise.population=45", "--set", "optimise.requirements.3.at_least=9"]
    with pytest.raises(SystemExit) as left:
        main(["optimise", str(PUSHER), "--out", str(tmp_path / "o"), *change])
    printed = capsys.readouterr()
    assert left.value.code == 4
    assert "the limiting requirement is cam.curvature_ratio" in printed.err
    assert (tmp_path / "o" / "best.toml").is_file() and (tmp_path / "o" / "history.parquet").is_file()
    assert dw.load(tmp_path / "o" / "best.toml").push.end_event == "lowest"


@pytest.mark.needs_optimise
def test_several_objectives_give_a_front():
    data = tomllib.loads(PUSHER.read_text())
    data["optimise"] |= {
        "population": 60,
        "generations": 60,
        "objectives": [{"value": "cam.max_pressure_angle"}, {"value": "cam.max_pitch_radius"}],
    }
    data["optimise"]["requirements"] = [
        r for r in data["optimise"]["requirements"] if r["value"] in ("cam.curvature_ratio", "needle.angle_difference")
    ]
    found = dw.optimise(from_document(data))
    angle, size = found.front_values["cam.max_pressure_angle"], found.front_values["cam.max_pitch_radius"]
    assert found.method == "nsga2" and found.feasible and len(angle) > 5
    order = np.argsort(angle)
    assert np.all(np.diff(size[order]) <= 0), "a design of the front is beaten by another one"
    assert np.array_equal(found.front, dw.optimise(from_document(data)).front)


CAM = """
mechanism = "cam"
[follower]
motion = "translating"
roller_radius = "8 mm"
prime_radius = "40 mm"
[[programme]]
angle = "90 deg"
law = "cycloidal"
rise = "20 mm"
[[programme]]
angle = "180 deg"
law = "cycloidal"
rise = "-20 mm"
[[programme]]
angle = "90 deg"
law = "dwell"
[optimise]
population = 8
generations = 8
[[optimise.unknowns]]
key = "follower.prime_radius"
lower = "30 mm"
upper = "80 mm"
[[optimise.objectives]]
value = "profile.perimeter"
[[optimise.requirements]]
value = "max_pressure_angle"
at_most = "25 deg"
"""


def test_values_beyond_the_batch_are_run_design_by_design():
    """The smallest cam whose pressure angle stays below 25 deg: there the requirement is active."""
    found = dw.optimise(from_document(tomllib.loads(CAM)))
    assert found.feasible
    assert np.degrees(found.best["max_pressure_angle"]) == pytest.approx(25, abs=0.5)


def search(example, key, lower, upper, objective, *requirements, changes=()):
    """A small search from an example: its spec with an [optimise] table."""
    table = {
        "population": 8,
        "generations": 1,
        "unknowns": [{"key": key, "lower": lower, "upper": upper}],
        "objectives": [{"value": objective}],
        "requirements": list(requirements),
    }
    return from_document(document(dw.load(EXAMPLES / f"{example}.toml", changes)) | {"optimise": table}, folder=EXAMPLES)


CHAIN = {
    "mechanism": "silent-chain",
    "pitch": "9.525 mm",
    "links": 82,
    "teeth": [35, 37],
    "joint": {"rolling_radius": "1.2 mm"},
    "plate": {"apothem": "2.6 mm"},
    "limits": {"teeth": 17},
}


def chain_of(*teeth, **more):
    table = {
        "population": 8,
        "generations": 3,
        "unknowns": [{"key": "teeth.0", "lower": teeth[0], "upper": teeth[1]}],
        "objectives": [{"value": "layout.pitch_diameter.drive"}],
        **more,
    }
    return from_document(CHAIN | {"optimise": table})


@pytest.mark.parametrize(
    ("spec", "analyses"),
    [
        (
            search("disc_cam", "follower.roller_radius", "4 mm", "8 mm", "max_contact_pressure", {"value": "check.undercut"}),
            ("geometry", "forces"),
        ),
        (
            search(
                "pressure_roller_shaft", "segments.0.diameter", "15 mm", "25 mm", "shaft.max_deflection", {"value": "check.yield_safety"}
            ),
            ("statics",),
        ),
        (search("pressure_roller_shaft", "bearings.B.position", "120 mm", "150 mm", "shaft.max_deflection"), ("statics",)),
        (search("four_bar", "bodies.rocker.mass", "0.1 kg", "0.4 kg", "joints.B.max_force", changes=["simulate.turns=2"]), ("forces",)),
        (search("cycloid_reducer", "eccentricity", "1 mm", "1.5 mm", "pressure_angle.maximum"), ("contacts",)),
    ],
    ids=["cam", "shaft", "shaft by name", "linkage", "indexer"],
)
def test_every_kind_runs_the_analyses_that_give_what_is_looked_at(spec, analyses):
    """Whatever the search finds is what a run of that design gives."""
    found = dw.optimise(spec, on="serial")
    assert found.problem.analyses == analyses and found.evaluations == 16
    (name,) = [objective for objective, _ in found.problem.objectives]
    assert found.best[name] == found.front_values[name][0] == np.nanmin(found.history[name][found.history["violation"] <= 0])
    assert value_at(found.best.spec, found.problem.keys[0]) == found.front[0][0]
    assert all(requirement.ok for requirement in found.requirements)


def test_an_unknown_that_may_also_be_a_word_is_a_number():
    problem = prepare(dw.load(EXAMPLES / "pin_indexer_two_way.toml"))
    assert problem.keys[2] == "motion.motion_to_dwell" and problem.kinds[2].name == "number"
    assert problem.bounds[2].tolist() == [1.0, 2.0] and problem.design(problem.bounds[:, 0]).motion.motion_to_dwell == 1.0


def test_whole_numbers_reach_both_bounds_and_no_design_is_evaluated_twice():
    found = dw.optimise(chain_of(30, 34))
    teeth = found.history["teeth.0"]
    assert sorted(teeth) == [30, 31, 32, 33, 34] and found.table.schema.field("teeth.0").type == "int64"
    assert found.front[0][0] == 30 and found.best.spec.teeth == (30, 37)
    assert found.unknown_rows() == [("teeth.0", "30", "30", "34")]
    pitch_diameter = 9.525e-3 / np.sin(np.pi / 30)
    assert found.best["layout.pitch_diameter.drive"] == pytest.approx(pitch_diameter, rel=1e-12)


def test_as_large_as_possible_is_the_other_end():
    found = dw.optimise(chain_of(30, 34, objectives=[{"value": "layout.pitch_diameter.drive", "goal": "maximise"}]))
    assert found.front[0][0] == 34 and found.objective_rows()[0][2] == "as large as possible"


def test_every_whole_number_has_an_equal_share_of_the_search():
    problem = prepare(chain_of(30, 33))
    low, high = problem.space[0]
    teeth, counts = np.unique(problem.designs(np.linspace(low, high, 4001)[:, None]), return_counts=True)
    assert teeth.tolist() == [30, 31, 32, 33] and np.all(abs(counts - 1000) <= 1), counts


def test_a_check_without_a_limit_has_to_pass():
    """The least number of teeth that passes the check is the answer; below it the margin is negative."""
    least = 17
    found = dw.optimise(chain_of(10, 30, requirements=[{"value": "check.teeth.drive"}]))
    assert found.best.spec.teeth[0] == least and found.best.check("teeth.drive").ok
    assert found.problem.limits == (("check.teeth.drive", ">=", 0.0),) and found.problem.scales == [least]
    assert np.array_equal(found.history["check.teeth.drive"] >= 0, found.history["teeth.0"] >= least)
    missed = dw.optimise(chain_of(10, 15, requirements=[{"value": "check.teeth.drive"}]))
    assert not missed.feasible and missed.best.spec.teeth[0] == 15
    assert "the limiting requirement is check.teeth.drive >= 0: the least violating design reaches -2," in missed.findings[0]
    assert "and 0 of the designs tried meet this one at all" in missed.findings[0]


def test_a_design_that_fails_never_wins_however_large_the_objective_is():
    """Contact pressures are millions of pascals; a roller larger than the prime circle leaves no cam and no pressure."""
    found = dw.optimise(search("disc_cam", "follower.roller_radius", "20 mm", "90 mm", "max_contact_pressure"), on="serial")
    failed = np.isnan(found.history["max_contact_pressure"])
    assert failed.any() and found.feasible and found.front_values["max_contact_pressure"][0] > 1e6
    assert np.all(found.history["violation"][failed] > 0) and np.all(found.history["violation"][~failed] == 0)


def test_where_no_design_can_be_computed_the_reason_is_told(tmp_path, capsys):
    spec = search("disc_cam", "follower.roller_radius", "80 mm", "90 mm", "max_contact_pressure")
    with pytest.raises(SolverError, match="none of them could be computed; the commonest reason: follower.prime_radius: .*leaves no cam"):
        dw.optimise(spec, on="serial", out=tmp_path / "o")
    (tmp_path / "s.toml").write_text(spec.to_toml())
    with pytest.raises(SystemExit) as left:
        main(["optimise", str(tmp_path / "s.toml"), "--out", str(tmp_path / "o")])
    assert left.value.code == 4 and "none of them could be computed" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            {"unknowns": [{"key": "follower.prime_radus", "lower": "30 mm", "upper": "80 mm"}]},
            "optimise.unknowns.0.key: this spec has no key 'follower.prime_radus'",
        ),
        ({"unknowns": [{"key": "follower.prime_radius", "lower": 30.0, "upper": "80 mm"}]}, "optimise.unknowns.0.lower: unit missing"),
        ({"unknowns": [{"key": "follower.prime_radius", "lower": "90 mm", "upper": "80 mm"}]}, "is not below upper bound"),
        ({"objectives": [{"value": "max_presure_angle"}]}, "did you mean 'max_pressure_angle'"),
        ({"unknowns": [{"key": "follower.motion", "lower": 1, "upper": 2}]}, "optimise.unknowns.0.key: follower.motion takes"),
        (
            {"unknowns": 2 * [{"key": "follower.prime_radius", "lower": "30 mm", "upper": "80 mm"}]},
            "optimise.unknowns.1.key: follower.prime_radius occurs twice",
        ),
        ({"objectives": [{"value": "check.pressure_angel"}]}, "did you mean 'check.pressure_angle'"),
        ({"requirements": [{"value": "max_pressure_angle"}]}, "needs at_least, at_most, or both"),
        ({"requirements": [{"value": "max_pressure_angle", "at_most": "25 mm"}]}, "optimise.requirements.0.at_most: wants an angle"),
        (
            {"method": "differential-evolution", "objectives": [{"value": "min_convex_radius"}, {"value": "max_pressure_angle"}]},
            "takes one objective",
        ),
    ],
)
def test_a_wrong_table_is_refused_by_key(change, message):
    data = tomllib.loads(CAM)
    data["optimise"] |= change
    with pytest.raises(SpecError) as error:
        dw.optimise(from_document(data))
    assert message in str(error.value)


@pytest.mark.parametrize(
    ("teeth", "message"),
    [
        ((30.5, 34), "optimise.unknowns.0.lower: wants a whole number, got 30.5"),
        ((30, "34 mm"), "optimise.unknowns.0.upper: wants a whole"),
        ((30, 30), "optimise.unknowns.0: lower bound 30 is not below upper bound 30"),
    ],
)
def test_bounds_of_whole_numbers_are_whole(teeth, message):
    with pytest.raises(SpecError) as error:
        dw.optimise(chain_of(*teeth))
    assert message in str(error.value)


def test_a_spec_without_the_table_says_so():
    data = tomllib.loads(CAM)
    del data["optimise"]
    with pytest.raises(SpecError, match="optimise: is missing"):
        dw.optimise(from_document(data))


def test_a_check_that_a_computed_design_does_not_have_is_met():
    data = tomllib.loads((EXAMPLES / "disc_cam.toml").read_text())
    data["optimise"] = {
        "unknowns": [{"key": "programme.0.angle", "lower": "80 deg", "upper": "130 deg"}],
        "objectives": [{"value": "max_jerk"}],
        "requirements": [{"value": "check.cutter"}],
    }
    problem = prepare(from_document(data, folder=EXAMPLES))
    computed = {"max_jerk": np.array([1.0, 1.0, 1.0, np.nan]), "check.cutter": np.array([np.nan, 1e-3, -1e-3, np.nan])}
    assert (problem.total_violation(computed) <= 0).tolist() == [True, True, False, False]
