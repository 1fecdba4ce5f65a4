"""Intervals in the studio: what its jobs tell the page, what is packed for the player, and what the page's modules make of it."""

import json
import shutil
import subprocess
from pathlib import Path

import chaos_toy
import numpy as np
import pytest

import drivewright
from drivewright import registry, runner
from drivewright.report.pack import floats, pack_plot_groups
from drivewright.spec import document
from drivewright.studio.design import Design
from drivewright.studio.jobs import JOBS
from drivewright.studio.preview import page_result
from drivewright.view.panels import known_plots

pytestmark = pytest.mark.interface

WEB = Path(drivewright.__file__).parent / "studio" / "web"


@pytest.fixture(autouse=True)
def _toy(monkeypatch):
    chaos_toy.install(monkeypatch.setattr)
    monkeypatch.setattr(registry, "is_known", lambda kind: True)


def design(**keys):
    return Design(document(chaos_toy.Chaotic(**keys)), Path.cwd())


def nothing(done, total, text="", partial=None):
    pass


def test_the_page_gets_numbers_and_ends_apart():
    result = runner.run(chaos_toy.Chaotic(size="11.6 mm"))
    told = json.loads(json.dumps(page_result(result, None, ["main"]), allow_nan=False))
    level, area = told["headline"]
    assert (level["number"], level["low"], level["high"], level["interval"]) == ("11.89", "11.45", "12.33", "ensemble")
    assert (area["low"], area["interval"]) == ("", "")
    check = next(each for each in told["checks"] if each["name"] == "low_enough")
    assert (check["low"], check["high"]) == ("11.45", "12.33\u00a0mm") and check["undecided"]


def test_plots_of_the_player_have_the_ends_of_their_lines():
    spec = chaos_toy.Chaotic()
    result, scene = runner.run(spec), chaos_toy.scene(spec)
    packed = pack_plot_groups(result, scene, tuple(known_plots(result).values()))
    series = {plot["name"]: plot["panels"][0]["series"][0] for plot in packed["plots"]}
    assert set(series) == {"course", "points", "stems"}
    table = result.tables["course"]
    for each in series.values():
        assert each["ends"] == [floats(1e3 * table[f"level.{end}"].data) for end in ("low", "high")]


def test_rows_of_a_study_have_their_intervals():
    found = JOBS["study"](design(), nothing, vary=["size=10 mm:13 mm:4"], on="serial")
    assert set(found["ends"]) == {"level", "check.low_enough"}
    names = [column["name"] for column in found["columns"]]
    assert names == ["size", "level", "area", "check.low_enough", "check.settled"]
    for row, (low, high) in zip(found["rows"], found["ends"]["level"], strict=True):
        assert low < row[1] < high
    json.dumps(found, allow_nan=False)


def test_sensitivity_names_the_keys_whose_effect_is_no_larger_than_chance():
    found = JOBS["sensitivity"](design(), nothing, targets=["level"], on="serial")["targets"][0]
    assert {"size", "load"} <= {*found["unclear"]}, "a step of 1 % is lost in noise of 10 % / sqrt(32)"
    steady = JOBS["sensitivity"](design(noise=0.0), nothing, targets=["level"], on="serial")["targets"][0]
    assert {bar["key"] for bar in steady["bars"]} >= {"size", "load"} and not {"size", "load"} & {*steady["unclear"]}
    larger = JOBS["sensitivity"](design(), nothing, targets=["level"], share=0.3, on="serial")["targets"][0]
    assert {bar["key"] for bar in larger["bars"]} >= {"size", "load"}


def test_a_requirement_is_told_as_met_by_its_whole_interval():
    table = {
        "unknowns": [{"key": "load", "lower": 0.999, "upper": 1.001}],
        "objectives": [{"value": "area", "goal": "minimise"}],
        "requirements": [{"value": "level", "at_most": "12 mm"}],
        "generations": 2,
        "population": 8,
    }
    found = JOBS["optimise"](design(size="11.9 mm", optimise=table), nothing, on="serial")
    (requirement,) = found["requirements"]
    assert found["feasible"] is requirement["ok"] is False
    assert " to " in requirement["value"]


# -- the page's own numbers ------------------------------------------------------------------------------------------------------


def in_node(body):
    node = shutil.which("node")
    if node is None:
        pytest.skip("node is not installed: the page's modules cannot run")
    script = f"import * as numbers from {json.dumps((WEB / 'numbers.js').as_uri())};\nconsole.log(JSON.stringify({body}));"
    found = subprocess.run([node, "--input-type=module", "-e", script], capture_output=True, encoding="utf-8", timeout=60)
    assert found.returncode == 0, found.stderr
    return json.loads(found.stdout)


def test_numbers_of_the_page_have_the_digits_of_their_interval():
    cases = [
        (10.234, 8.09, 12.38, "10.2"),
        (8.09, 8.09, 12.38, "8.1"),
        (0.31, -50.0, 56.0, "0"),
        (10.0123456, 10.0, 10.02, "10.012"),
        (12345.6, 12000.0, 12690.0, "12350"),
    ]
    assert in_node(f"{json.dumps([[v, [low, high]] for v, low, high, _ in cases])}.map(each => numbers.supported(...each))") == [
        told for *_, told in cases
    ]


def test_a_result_reads_with_its_interval_and_its_hint():
    fill = "(text, ...values) => { let n = 0; return text.replace(/\\*/g, () => values[n++]); }"
    given = {"shown": "exact", "number": "10.2", "low": "8.1", "high": "12.4", "unit": "mm", "interval": "ensemble"}
    assert in_node(f"numbers.withInterval({json.dumps(given)}, {fill})") == "10.2 (8.1 to 12.4)\u00a0mm"
    assert in_node(f"numbers.withInterval({json.dumps(given | {'low': ''})}, {fill})") == "exact"
    assert in_node(f"numbers.intervalHint({json.dumps(given)}, {fill})") == "95 % interval: ensemble"
    assert in_node(f"numbers.numberOf({json.dumps('10.2 (8.1 to 12.4) mm')})") == 10.2
    assert np.isclose(in_node(f"numbers.numberOf({json.dumps('1.50×10⁷ (1.10×10⁷ to 1.90×10⁷) N')})"), 1.5e7)
