"""Commands print JSON where machines read: nothing else on stdout, numbers in SI, the same exit codes."""

import json

import numpy as np
import pytest
from places import EXAMPLES

from drivewright.cli import main
from drivewright.cli.records import plain

pytestmark = pytest.mark.interface

CAM = str(EXAMPLES / "disc_cam.toml")
SEARCH = """
[optimise]
population = 8
generations = 1
unknowns = [{ key = "follower.prime_radius", lower = "30 mm", upper = "80 mm" }]
objectives = [{ value = "profile.perimeter" }]
requirements = [{ value = "max_pressure_angle", at_most = "35 deg" }]
"""


@pytest.fixture
def printed(capsys):
    """What a command prints, read as JSON, and its exit code."""

    def run(*arguments):
        with pytest.raises(SystemExit) as end:
            main([*map(str, arguments), "--json"])
        return json.loads(capsys.readouterr().out, parse_constant=lambda name: pytest.fail(name)), end.value.code or 0

    return run


def test_a_study(printed, tmp_path):
    command = ("sweep", CAM, "--vary", "follower.prime_radius=4 mm,40 mm,41 mm", "--out", tmp_path / "S", "--on", "serial")
    record, code = printed(*command, "--no-figures")
    assert code == 0 and record["counts"] == {"complete": 2, "failed": 1} and record["varied"] == ["follower.prime_radius"]
    angle = record["values"]["max_pressure_angle"]
    assert angle["unit"] == "rad" and angle["least"]["case"] == 2 and angle["greatest"]["case"] == 1
    assert 0.4 < angle["least"]["value"] < angle["greatest"]["value"] < 0.5 and record["reasons"][0]["status"] == "failed"


def test_a_search(printed, tmp_path):
    (tmp_path / "cam.toml").write_text((EXAMPLES / "disc_cam.toml").read_text() + SEARCH)
    record, code = printed("optimise", tmp_path / "cam.toml", "--out", tmp_path / "O", "--on", "serial")
    assert code == 0 and record["feasible"] and record["unknowns"]["follower.prime_radius"]["unit"] == "m"
    assert 0.03 <= record["unknowns"]["follower.prime_radius"]["value"] <= 0.08 and record["requirements"][0]["ok"]
    assert record["objectives"]["profile.perimeter"]["goal"] == "minimise" and len(record["front"]["profile.perimeter"]) == 1


def test_designs_side_by_side(printed, tmp_path):
    (tmp_path / "other.toml").write_text((EXAMPLES / "disc_cam.toml").read_text().replace("600 rpm", "500 rpm"))
    record, code = printed("compare", CAM, tmp_path / "other.toml", "--out", tmp_path / "C", "--labels", "a,b")
    assert code == 0 and record["labels"] == ["a", "b"] and record["differing"] == {"drive.speed": ["600 rpm", "500 rpm"]}


def test_an_independent_route(printed):
    record, code = printed("verify", CAM)
    assert code == 0 and record["ok"] and record["rows"] and {"name", "ours", "other", "allowed", "ok"} <= set(record["rows"][0])


def test_published_numbers(printed):
    record, code = printed("validate", "motion-laws")
    rows = record["motion-laws"]["rows"]
    assert code == 0 and record["motion-laws"]["citation"] and all(row["verdict"] == row["pinned"] for row in rows)


def test_the_examples(printed):
    record, _ = printed("examples")
    by_name = {each["name"]: each for each in record}
    assert by_name["disc_cam"]["mechanism"] == "cam" and not by_name["disc_cam"]["study"] and by_name["shaft_tolerance"]["study"]


def test_what_is_installed(printed):
    record, code = printed("doctor")
    assert code == 0 and all(row["ok"] for row in record["self_test"]) and set(record["extras"]) >= {"fe", "frames"}
    assert "cam" in record["mechanisms"] and record["installed"]["drivewright"]


def test_what_json_does_not_know():
    found = plain({1: np.float64(2.0), "a": np.array([1.0, np.nan]), "b": (float("inf"), True, None), "c": EXAMPLES})
    assert found == {"1": 2.0, "a": [1.0, None], "b": [None, True, None], "c": str(EXAMPLES)}
