"""--units: the pages and the terminal in millimetres, SI or inches, result.json in SI."""

import json

import pytest
from typer.testing import CliRunner

from drivewright.cli import show
from drivewright.cli.app import app
from drivewright.errors import UnknownName
from drivewright.result import Check

pytestmark = pytest.mark.interface

CAM = "examples/disc_cam.toml"


def told(*arguments):
    run = CliRunner().invoke(app, list(arguments))
    assert run.exit_code == 0, run.output
    return run.output


def test_run_in_inches_and_in_si(tmp_path):
    common = ("run", CAM, "--only", "geometry,forces", "--no-figures", "--out")
    inch, si = (told(*common, str(tmp_path / system), "--units", system, "-v") for system in ("inch", "si"))
    assert "1.2445 in" in inch and " lbf" in inch and " mm" not in inch.split("design checks")[1]
    assert "0.031611 m " in si and " mm" not in si
    records = [json.loads((tmp_path / system / "result.json").read_text()) for system in ("inch", "si")]
    assert records[0]["values"] == records[1]["values"] and records[0]["digest"] == records[1]["digest"]
    assert 'units = "inch"' in (tmp_path / "inch" / "spec.toml").read_text()


def test_the_key_of_the_spec_does_the_same_and_the_option_is_stronger(tmp_path):
    common = ("run", CAM, "--only", "geometry", "--no-figures", "--out", str(tmp_path / "run"), "--set", "units=inch")
    assert "1.2445 in" in told(*common) and "31.611 mm" in told(*common, "--units", "mm")


def test_what_was_read_as_something_is_said(tmp_path):
    output = told("run", CAM, "--only", "geometry", "--no-figures", "--out", str(tmp_path / "run"), "--set", "drive.speed=10 Hz")
    assert "note: drive.speed: '10 Hz' is read as 10 rev/s" in output


def test_compare_in_inches(tmp_path):
    output = told("compare", CAM, CAM, "--only", "geometry", "--units", "inch", "--out", str(tmp_path / "both"))
    assert "1.2445\xa0in" in output and "\xa0mm" not in output
    assert json.loads((tmp_path / "both" / "compare.json").read_text())["units"]["min_convex_radius"] == "m"


def test_an_unknown_system_is_refused(tmp_path):
    run = CliRunner().invoke(app, ["run", CAM, "--units", "inches", "--out", str(tmp_path / "run")])
    assert run.exit_code != 0 and "units: must be one of" in str(run.exception) + run.output
    with pytest.raises(UnknownName, match="system of units"):
        show.system_of("feet")


def test_numbers_of_the_terminal():
    assert show.number(0.0254, "m", system="inch") == "1 in" and show.number(0.0254, "m", 0.0127, 0.0381, system="inch").endswith(" in")
    assert show.number(343.15, "K") == "70 °C" and show.number(343.15, "K", system="inch") == "158 °F"
    assert show.number(12345678.0, "s") == "3429.4 h" and show.number(34.03e6, "rev") == "34.03 million rev"


def test_checks_of_the_terminal(capsys):
    show.checks([Check("a", 0.0508, 0.0254, ">=", "m", "wall"), Check("b", 343.15, 363.15, "<=", "K", "oil")], "inch")
    rows = capsys.readouterr().out
    assert "2 in" in rows and ">= 1 in" in rows and "158 °F" in rows and "<= 194 °F" in rows and "36 °F" in rows


def test_a_run_is_told_on_one_screen(tmp_path):
    """Key numbers, failed checks, one line on analyses that did not run, verdict, report; everything with -v."""
    common = ("run", CAM, "--no-figures", "--out", str(tmp_path / "run"))
    short, long = told(*common), told(*common, "-v")
    assert len(short.splitlines()) <= 40 < len(long.splitlines())
    assert "Stroke" in short and "stroke of the follower" not in short and "verdict: all 13 checks pass" in short
    assert short.count("note:") == 1 and "analyses not run" in short and long.count("is left out") > 1 and "analyses not run" not in long
