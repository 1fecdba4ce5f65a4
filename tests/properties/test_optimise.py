"""The optimiser: finds what it must, the same each time, and names the requirement to blame."""

import tomllib
from pathlib import Path

import numpy as np
import pytest

import drivewright as dw
from drivewright.cli import main
from drivewright.errors import SpecError
from drivewright.spec import from_document

EXAMPLES = Path(__file__).parents[2] / "examples"
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
    assert "the requirement to blame is cam.curvature_ratio >= 9" in found.findings[0]


def test_exit_code_4_and_the_blame_on_the_command_line(tmp_path, capsys):
    change = ["--set", "optimise.generations=5", "--set", "optimise.population=45", "--set", "optimise.requirements.3.at_least=9"]
    with pytest.raises(SystemExit) as left:
        main(["optimise", str(PUSHER), "--out", str(tmp_path / "o"), *change])
    printed = capsys.readouterr()
    assert left.value.code == 4
    assert "the requirement to blame is cam.curvature_ratio" in printed.err
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
value = "min_convex_radius"
[[optimise.requirements]]
value = "max_pressure_angle"
at_most = "25 deg"
"""


def test_a_kind_without_batch_is_run_design_by_design():
    """The smallest cam whose pressure angle stays below 25 deg: there the requirement is active."""
    found = dw.optimise(from_document(tomllib.loads(CAM)))
    assert found.feasible
    assert np.degrees(found.best["max_pressure_angle"]) == pytest.approx(25, abs=0.5)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            {"unknowns": [{"key": "follower.prime_radus", "lower": "30 mm", "upper": "80 mm"}]},
            "optimise.unknowns.0.key: this spec has no key 'follower.prime_radus'",
        ),
        ({"unknowns": [{"key": "follower.prime_radius", "lower": 30.0, "upper": "80 mm"}]}, "optimise.unknowns.0.lower: a bare number"),
        ({"unknowns": [{"key": "follower.prime_radius", "lower": "90 mm", "upper": "80 mm"}]}, "is not below upper bound"),
        ({"objectives": [{"value": "max_presure_angle"}]}, "did you mean 'max_pressure_angle'"),
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


def test_a_spec_without_the_table_says_so():
    data = tomllib.loads(CAM)
    del data["optimise"]
    with pytest.raises(SpecError, match="optimise: is missing"):
        dw.optimise(from_document(data))
