"""A study by its command and by its functions: columns, statuses, exit codes, an interruption, both routes to a number."""

import json
import math
import os
import signal
import sqlite3
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pyarrow as pa
import pytest
import study_toy
from places import EXAMPLES
from study_toy import TOY, Toy, exact, install, rough

import drivewright as dw
from drivewright import runner
from drivewright.cli import main
from drivewright.studies.variation import geomspace, normal, tolerance, with_variation

pytestmark = pytest.mark.interface

CHAIN = str(EXAMPLES / "hyvo_chain.toml")
RADIUS = "joint.rolling_radius"


@pytest.fixture
def toy(monkeypatch, tmp_path):
    """A toy's spec file."""
    install(monkeypatch.setattr)
    (tmp_path / "toy.toml").write_text('mechanism = "toy"\nsize = "10 mm"\n')
    return tmp_path / "toy.toml"


def command(*arguments):
    """Exit code of `drivewright sweep ...`."""
    with pytest.raises(SystemExit) as end:
        main(["sweep", *map(str, arguments), "--no-figures"])
    return end.value.code or 0


def sweep(spec, vary, **more):
    return dw.sweep(spec, vary, on="serial", **more)


# -- a real drive --------------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def chains(tmp_path_factory):
    """The folder of the seven chains."""
    folder = tmp_path_factory.mktemp("chains") / "S"
    assert command(CHAIN, "--only", "meshing", "--vary", f"{RADIUS}=1.0 mm:1.6 mm:7", "--out", folder, "--on", "serial") == 0
    return dw.open_study(folder)


def test_a_row_for_every_case_with_all_values_of_a_run(chains):
    assert chains.complete and len(chains) == 7 and not chains.interrupted and chains.seconds > 0
    assert chains["case"].tolist() == list(range(7)) and chains.counts == {"complete": 7} and set(chains["message"]) == {""}
    assert chains[RADIUS] == pytest.approx(np.linspace(1e-3, 1.6e-3, 7), rel=1e-15)
    for case in (0, 4):
        run = dw.run(dw.load(CHAIN, [f'{RADIUS}="{chains[RADIUS][case].item()!r} m"']), "meshing")
        assert {name: chains[name][case] for name in chains.value_names} == pytest.approx(
            {n: v.value for n, v in run.values.items()}, rel=1e-9
        )
        about = {name: (value.unit, value.meaning) for name, value in run.values.items()}
        assert {name: (chains.unit(name), chains.meaning(name)) for name in run.values} == about
        assert chains.check_names == tuple(check.name for check in run.checks)
        for check in run.checks:
            assert chains[f"check.{check.name}"][case] == pytest.approx(check.margin) and (check.margin >= 0) == check.ok
            assert chains.unit(f"check.{check.name}") == check.unit and check.message in chains.meaning(f"check.{check.name}")


def test_types_units_and_order_of_the_columns(chains):
    names = chains.table.column_names
    assert names[:4] == ["case", "status", "message", RADIUS] and names[4:-1] == list(chains.value_names) and names[-1] == "check.offset"
    assert [chains.table.schema.field(name).type for name in names] == [pa.int64(), pa.string(), pa.string()] + [pa.float64()] * (
        len(names) - 3
    )
    assert [chains.unit(name) for name in names[:4]] == ["-", "", "", "m"]
    assert [chains.meaning(name) for name in names[:4]] == [
        "number of the case",
        "complete, partial or failed",
        "why it is not complete, or what was left out",
        "varied",
    ]
    assert all(chains.meaning(name) for name in names)


def test_the_folder_holds_the_spec_with_its_study(chains):
    spec = dw.load(chains.folder / "study.toml")
    assert spec == chains.spec and spec.study.analyses == ("meshing",) and spec.study.vary[0].key == RADIUS
    assert sorted(os.listdir(chains.folder)) == [".lock", "ledger.sqlite", "parts", "study.toml"]


def test_the_command_says_what_it_did(tmp_path, capsys):
    assert command(CHAIN, "--only", "meshing", "--vary", f"{RADIUS}=1.0 mm,-1 mm,1.2 mm", "--out", tmp_path / "S", "--on", "serial") == 0
    said = capsys.readouterr()
    assert (
        f"{tmp_path / 'S'}: 3 of 3 cases" in said.err and "note: 1 x joint.rolling_radius: must be greater than 0 mm, got -1 mm" in said.err
    )
    study = dw.open_study(tmp_path / "S")
    least, greatest = (f"{1e3 * end:.5g} mm" for end in (np.nanmin(study["pin_offset"]), np.nanmax(study["pin_offset"])))
    assert "2 complete, 1 failed" in said.out and "pin_offset" in said.out and least in said.out and greatest in said.out


def test_the_pusher_takes_its_compiled_route_for_the_values_it_offers(monkeypatch, tmp_path):
    asked, ask = [], runner.run_analyses
    monkeypatch.setattr(runner, "run_analyses", lambda *arguments: asked.append(1) or ask(*arguments))
    monkeypatch.chdir(tmp_path)
    spec, key, names = EXAMPLES / "seedling_pusher.toml", "train.carrier_angle", ("cam.max_pressure_angle", "cam.curvature_ratio")
    assert command(spec, "--only", "cams", "--vary", f"{key}=5 deg:9 deg:9", "--values", ",".join(names), "--on", "serial") == 0
    study = dw.open_study(Path("out") / "seedling_pusher-study")
    assert len(asked) == 1 + 3 and study.value_names == names and study.check_names == () and study.counts == {"complete": 9}
    (remark,) = study.remarks
    assert remark.startswith("the compiled route was taken for the values named; in the cases compared it differs from a run by ")
    off = float(remark.split(" by ")[1].split(" of a value")[0])
    runs = [dw.run(dw.load(spec, [f"{key}={math.degrees(study[key][case])!r} deg"]), "cams") for case in (0, 4, 8)]
    differences = [abs(study[name][case] / run[name] - 1) for case, run in zip((0, 4, 8), runs, strict=True) for name in names]
    assert 1e-9 < off < 1e-3 and max(differences) == pytest.approx(off, rel=0.5)


def test_a_solver_that_gives_up_makes_a_partial_row():
    spec = dw.load(EXAMPLES / "slider_crank_clearance.toml", ['study.analyses=["motion"]', "simulate.turns=2.0", "simulate.discard=0.0"])
    study = sweep(spec, {"simulate.max_steps": [50]})
    assert study.counts == {"partial": 1} and study.answered and "limit of 50 steps is reached. Raise max_steps" in study["message"][0]


# -- rows ----------------------------------------------------------------------------------------------------------------------


@pytest.mark.faults
@pytest.mark.usefixtures("toy")
def test_every_way_to_end_is_a_row():
    study = sweep(Toy(), {"count": [1, 7, 13, 2], "colour": ["red", "black"], "ratio": [-1.0, 4.0]})
    at = {(c, k, r): n for n, (c, k, r) in enumerate(zip(study["count"], study["colour"], study["ratio"], strict=True))}
    assert [study["status"][at[c, "red", 4.0]] for c in (1, 7, 13, 2)] == ["complete", "partial", "failed", "complete"]
    assert set(study["status"][study["colour"] == "black"]) == {"failed"}
    messages = [study["message"][at[key]] for key in ((1, "red", 4.0), (7, "red", 4.0), (13, "red", 4.0), (1, "black", 4.0))]
    fault = messages[2]
    assert fault.startswith("analysis 'main' (what it is) failed by a fault of the program, not of the spec: ZeroDivisionError: unlucky")
    assert messages == [
        "",
        "analysis 'main' (what it is) gave up: 7 steps were not enough; raise max_steps",
        fault,
        "analysis 'main' (what it is) has no answer for this design: colour: black cannot be seen; take another one",
    ]
    nulls = study.table.to_pylist()
    assert nulls[at[1, "red", -1.0]]["root"] is None and nulls[at[1, "red", 4.0]]["root"] == 2.0
    assert (
        nulls[at[7, "red", 4.0]]["area"] == 1e-4 and nulls[at[7, "red", 4.0]]["root"] is None and nulls[at[13, "red", 4.0]]["area"] is None
    )
    assert study.counts == {"complete": 4, "failed": 10, "partial": 2} and study.answered
    assert repr(study) == "<Study of 'toy': 16 of 16 cases, {'complete': 4, 'failed': 10, 'partial': 2}>"
    html = study._repr_html_()
    assert "<b>Study</b>" in html and "4 of 16 cases complete" in html and "in memory" in html
    assert all(f"<code>{key}</code>" in html for key in study.plan.keys) and "8 × failed" in html
    kept = replace(study, folder=Path("/tmp/<S>"))._repr_html_()
    assert "/tmp/&lt;S&gt;" in kept and "<S>" not in kept


@pytest.mark.usefixtures("toy")
def test_a_value_with_the_name_of_a_key_that_varies():
    study = sweep(Toy(), {"size": ["8 mm", "12 mm", "13 mm"]})
    assert study.value_names == ("value.size", "area", "root") and study["size"].tolist() == study["value.size"].tolist() == [
        8e-3,
        12e-3,
        13e-3,
    ]
    assert (study.meaning("size"), study.meaning("value.size"), study.unit("value.size")) == ("varied", "size again", "m")
    assert (
        study["check.small"] == pytest.approx([4e-3, 0, -1e-3])
        and study.meaning("check.small") == "margin to the limit (0 or more passes): it fits"
    )
    assert sweep(Toy(), {"ratio": [1]}).value_names == ("size", "area", "root")


@pytest.mark.usefixtures("toy")
def test_a_margin_that_rounding_makes_negative_is_none():
    """A check passes exactly where its column is not below 0."""
    study = sweep(Toy(), {"size": ["12 mm", f"{12 * (1 + 1e-12)!r} mm", f"{12 * (1 + 1e-6)!r} mm"]})
    assert study["check.small"].tolist()[:2] == [0.0, 0.0] and -2e-8 < study["check.small"][2] < 0


@pytest.mark.usefixtures("toy")
def test_columns_come_in_the_order_in_which_the_cases_bring_them():
    study = sweep(Toy(), {"flag": [False, True], "count": [1, 3], "force": tolerance("0.3 N")})
    assert study.table.column_names[3:] == ["flag", "count", "force", "size", "area", "root", "check.small", "bonus"]
    assert np.isnan(study["bonus"][~study["flag"]]).all() and (study["bonus"][study["flag"]] == 1 + study["count"][study["flag"]]).all()
    types = [study.table.schema.field(name).type for name in ("flag", "count", "force")]
    assert types == [pa.bool_(), pa.int64(), pa.float64()] and [study.unit(name) for name in ("flag", "count", "force")] == ["", "-", "N"]
    assert study.plan.inner == 1000 and study["case"].tolist() == list(range(4000))


@pytest.mark.usefixtures("toy")
@pytest.mark.parametrize(
    ("settings", "columns"),
    [
        ({"values": ["root", "check.small"]}, ["root", "check.small"]),
        ({"analyses": ["more"]}, ["more"]),
        ({"values": ["more"], "every_analysis": True}, ["more"]),
        ({"every_analysis": True}, ["size", "area", "root", "more", "check.small"]),
    ],
)
def test_what_is_kept(settings, columns):
    assert sweep(with_variation(Toy(), {"count": [1]}, **settings), None).table.column_names[4:] == columns


@pytest.mark.usefixtures("toy")
def test_keys_of_lists_and_dictionaries_reach_the_drive(monkeypatch):
    seen, build = [], TOY.build
    install(monkeypatch.setattr, replace(TOY, build=lambda spec: seen.append(spec) or build(spec)))
    spec = Toy(parts=({"name": "left"}, {}), bodies={"arm": {}})
    vary = {
        "parts.left.width": ["1 mm"],
        "parts.1.width": ["2 mm"],
        "bodies.arm.mass": ["3 kg"],
        "bodies.arm.at.1": ["4 mm"],
        "teeth.0": [5],
        "offset": ["6 mm"],
        "form": ["square"],
        "flag": [True],
    }
    assert sweep(spec, vary).counts == {"complete": 1}
    expected = Toy(
        parts=({"name": "left", "width": "1 mm"}, {"width": "2 mm"}),
        bodies={"arm": {"mass": "3 kg", "at": ["1 mm", "4 mm"]}},
        teeth=(5, 23),
        offset="6 mm",
        form="square",
        flag=True,
    )
    assert seen == [expected]


# -- routes --------------------------------------------------------------------------------------------------------------------

DESIGNS = {"size": ["1 mm", "-2 mm", "13 mm", "9 mm"], "ratio": [0.25, -1.0, 1.0, 4.0]}


def counted(monkeypatch, batch):
    """The calls of the runner with a toy that offers a compiled route."""
    calls, ask = [], runner.run_analyses
    install(monkeypatch.setattr, replace(TOY, batch=batch))
    monkeypatch.setattr(runner, "run_analyses", lambda *arguments: calls.append(1) or ask(*arguments))
    return calls


def test_a_compiled_route_that_gives_the_numbers_of_a_run_is_taken_without_a_word(monkeypatch):
    install(monkeypatch.setattr)
    plain = sweep(Toy(), DESIGNS)
    calls = counted(monkeypatch, exact)
    study = sweep(Toy(), DESIGNS)
    assert study.remarks == () and study.table.schema.equals(plain.table.schema, check_metadata=True)
    for name in study.table.column_names:
        assert study[name].tolist() == plain[name].tolist() or study[name] == pytest.approx(plain[name], rel=1e-9, nan_ok=True)
    # First, middle and last are compared; run is what the route cannot speak for: ratio -1 (a size of -2 mm is stopped by the spec).
    assert len(calls) == 3 + 3 and study.counts == {"complete": 12, "failed": 4}


def test_a_rough_compiled_route_is_taken_only_for_values_that_are_named(monkeypatch):
    counted(monkeypatch, rough)
    vary = {"size": ["1 mm", "3 mm", "4 mm", "5 mm"]}
    everything, named = sweep(Toy(), vary), sweep(with_variation(Toy(), vary, values=["area"]), None)
    assert everything.remarks == () and everything["area"] == pytest.approx(everything["size"] ** 2, rel=1e-12)
    assert named["area"] == pytest.approx(1.001 * named["size"] ** 2, rel=1e-12) and named.value_names == ("area",)
    (remark,) = named.remarks
    assert remark.startswith("the compiled route was taken") and remark.endswith("differs from a run by 0.001 of a value at most")


@pytest.mark.parametrize(
    ("vary", "names"),
    [
        ({"size": ["1 mm", "2 mm", "3 mm"]}, ["area"]),
        ({"size": ["1 mm", "2 mm"], "force": ["1 N", "2 N"]}, ["area"]),
        ({"size": ["1 mm", "2 mm"], "colour": ["a", "b"]}, ["area"]),
        ({"count": [1, 2, 3, 4]}, ["bonus"]),
        ({"size": ["-1 mm", "-2 mm", "-3 mm", "-4 mm"]}, ["area"]),
    ],
)
def test_where_the_compiled_route_says_no_each_case_is_a_run(monkeypatch, vary, names):
    counted(monkeypatch, rough)
    study = sweep(with_variation(Toy(flag=True), vary, values=names), None)
    install(monkeypatch.setattr)
    assert study.remarks == () and study.table.equals(sweep(with_variation(Toy(flag=True), vary, values=names), None).table)


def without_roots(spec, keys, names):
    """A compiled route that never has a root, and has the area also where there is none."""
    return lambda designs: {
        name: np.where(name == "root", np.nan, study_toy.exact(spec, keys, ("area",))(abs(designs))["area"]) for name in names
    }


def test_a_compiled_route_that_lacks_a_value_of_the_run_is_not_the_same(monkeypatch):
    calls = counted(monkeypatch, without_roots)
    study = sweep(with_variation(Toy(), {"ratio": [1, 4, 9, 16]}, values=["root", "area"]), None)
    assert study.remarks[0].endswith("differs from a run by 1 of a value at most") and len(calls) == 1 + 3
    assert sweep(Toy(), {"ratio": [1, 4, 9, 16]})["root"].tolist() == [1, 2, 3, 4]


def test_a_value_that_no_route_has_does_not_make_a_design_silent(monkeypatch):
    calls = counted(monkeypatch, without_roots)
    study = sweep(with_variation(Toy(), {"ratio": [-1, -4, -9, -16]}, values=["root", "area"]), None)
    assert len(calls) == 1 + 3 and np.isnan(study["root"]).all() and study["area"] == pytest.approx([1e-4] * 4) and study.remarks == ()


def test_a_compiled_route_that_is_silent_where_a_run_answers_is_not_the_same(monkeypatch):
    def deaf(spec, keys, names):
        return lambda designs: {name: np.full(len(designs), np.nan) for name in names}

    calls = counted(monkeypatch, deaf)
    study = sweep(Toy(), {"size": ["1 mm", "3 mm", "4 mm", "5 mm"]})
    assert study["area"] == pytest.approx(study["size"] ** 2) and len(calls) == 3 + 4 and study.remarks == ()


# -- the command ---------------------------------------------------------------------------------------------------------------


def test_levels_of_text_and_flags(toy, tmp_path):
    assert command(toy, "--vary", "colour=red,dark blue", "--vary", "flag=true,false", "--out", tmp_path / "S") == 0
    study = dw.open_study(tmp_path / "S")
    assert study["colour"].tolist() == ["red", "red", "dark blue", "dark blue"] and study["flag"].tolist() == [True, False] * 2
    assert study.table.schema.field("colour").type == pa.string() and study.unit("colour") == ""


def test_a_sample_with_its_method_and_seed(toy, tmp_path):
    arguments = ["--vary", "size=+-0.3 mm", "--vary", "ratio=0:1", "--sample", "8", "--method", "sobol", "--seed", "5"]
    assert command(toy, *arguments, "--out", tmp_path / "S") == 0
    study = dw.open_study(tmp_path / "S")
    assert (len(study), study.plan.seed, study.spec.study.method) == (8, 5, "sobol")
    assert sorted(np.floor(8 * study["ratio"]).tolist()) == list(range(8))
    same = with_variation(Toy(), {"size": tolerance("0.3 mm"), "ratio": {"lower": 0, "upper": 1}}, samples=8, method="sobol", seed=5)
    assert sweep(same, None).table.equals(study.table)


def test_points_crossed_with_levels_and_a_key_set(toy, tmp_path):
    (tmp_path / "p.csv").write_text("size [cm],ratio\n0.8,4\n1.3,9\n")
    arguments = ["--points", tmp_path / "p.csv", "--vary", "count=1,2", "--set", "flag=true", "--all", "--values", "bonus, root,more"]
    assert command(toy, *arguments, "--out", tmp_path / "S") == 0
    study = dw.open_study(tmp_path / "S")
    assert study.table.column_names[3:] == ["size", "ratio", "count", "root", "bonus", "more"] or set(study.value_names) == {
        "root",
        "bonus",
        "more",
    }
    assert study["count"].tolist() == [1, 1, 2, 2] and study["size"] == pytest.approx([8e-3, 13e-3] * 2)
    assert study["root"].tolist() == [2, 3, 2, 3] and study["bonus"].tolist() == [2, 2, 3, 3]
    assert study["more"] == pytest.approx(2 / study["size"])


def test_the_study_of_the_spec_file(toy, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with toy.open("a") as file:
        file.write(
            '[study]\nvalues = ["area"]\n[[study.vary]]\nkey = "size"\nlower = "1 mm"\nupper = "4 mm"\nsteps = 3\nspacing = "logarithmic"\n'
        )
    assert command(toy) == 0
    study = dw.open_study(tmp_path / "out" / "toy-study")
    assert (
        study["size"] == pytest.approx([1e-3, 2e-3, 4e-3])
        and study["area"] == pytest.approx(study["size"] ** 2)
        and study.value_names == ("area",)
    )
    assert command(toy, "--vary", "ratio=1,4", "--values", "root", "--out", "other") == 0
    other = dw.open_study("other")
    assert other.plan.keys == ("ratio",) and other["root"].tolist() == [1, 2]


def test_no_case_with_an_answer_is_exit_four(toy, tmp_path, capsys):
    assert command(toy, "--vary", "colour=black", "--vary", "count=1,2", "--out", tmp_path / "S") == 4
    assert "note: 2 x analysis 'main' (what it is) has no answer for this design: colour: black cannot be seen" in capsys.readouterr().err
    assert (
        command(toy, "--vary", "colour=black,red", "--out", tmp_path / "T")
        == command(toy, "--vary", "count=7", "--out", tmp_path / "U")
        == 0
    )


def test_many_cases_want_yes(toy, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("drivewright.studies.sweeps.MANY", 3)
    arguments = [toy, "--vary", "count=1,2,3,4", "--out", tmp_path / "S"]
    assert command(*arguments) == 2 and not (tmp_path / "S").exists()
    assert "4 cases are more than 3; give --yes" in capsys.readouterr().err
    assert command(*arguments, "--yes") == 0


def test_bad_input_is_exit_two_and_writes_nothing(toy, tmp_path):
    assert command(toy, "--vary", "size=1:2:3", "--out", tmp_path / "S") == command(toy, "--out", tmp_path / "S") == 2
    assert command(toy, "--vary", "count=1,2", "--only", "mein", "--out", tmp_path / "S") == 2
    assert not (tmp_path / "S").exists()


# -- interrupted ---------------------------------------------------------------------------------------------------------------

START = "import sys; sys.path.insert(0, {!r}); import study_toy; study_toy.install(); from drivewright.cli import main; main()"
SLOWLY = ["--set", f"count={study_toy.SLOW}", "--vary", "size=1 mm:4 mm:60", "--no-figures"]


def acknowledged(folder):
    """Names of the parts in the ledger; none where there is no ledger yet."""
    try:
        with sqlite3.connect(f"file:{folder}/ledger.sqlite?mode=ro", uri=True) as ledger:
            return [name for (name,) in ledger.execute("select name from parts")]
    except sqlite3.Error:
        return []


def test_ctrl_c_keeps_what_was_finished_and_the_same_command_goes_on(toy, tmp_path):
    """Case by case 0.05 s; interrupted after some, then finished, and the same as without a break."""
    folder, code = tmp_path / "S", START.format(str(Path(study_toy.__file__).parent))
    process = subprocess.Popen(
        [sys.executable, "-c", code, "sweep", str(toy), *SLOWLY, "--out", str(folder), "--on", "serial"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    started = time.monotonic()
    while len(acknowledged(folder)) < 2 and process.poll() is None and time.monotonic() - started < 120:
        time.sleep(0.02)
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=120)
    assert process.returncode == 130 and "Traceback" not in err and out == ""
    assert "interrupted; what was finished before is kept, and the same command continues" in err
    half = dw.open_study(folder)
    assert 0 < len(half) < 60 and f"{len(half)} of 60 cases" in err and not half.complete and half.counts == {"complete": len(half)}
    stamps = {name: (folder / "parts" / name).stat().st_mtime_ns for name in acknowledged(folder)}
    assert command(toy, *SLOWLY[:-1], "--out", folder, "--on", "serial") == 0
    whole = dw.open_study(folder)
    assert whole.complete and whole["case"].tolist() == list(range(60)) and whole.seconds > 60 * study_toy.PATIENCE
    assert {name: (folder / "parts" / name).stat().st_mtime_ns for name in stamps} == stamps
    assert whole["area"] == pytest.approx(np.linspace(1e-3, 4e-3, 60) ** 2, rel=1e-12)


@pytest.mark.usefixtures("toy")
def test_ctrl_c_in_python_returns_what_is_there(tmp_path):
    def stop(done, total, what):
        if done >= 3:
            raise KeyboardInterrupt

    study = sweep(Toy(), {"size": dw.linspace("1 mm", "4 mm", 500)}, out=tmp_path / "S", progress=stop)
    assert study.interrupted and 3 <= len(study) < 500 and study.table.equals(dw.open_study(tmp_path / "S").table)
    assert not sweep(Toy(), {"size": dw.linspace("1 mm", "4 mm", 500)}, out=tmp_path / "S").interrupted
    assert sweep(Toy(), {"size": dw.linspace("1 mm", "4 mm", 500)}, progress=stop).interrupted


@pytest.mark.usefixtures("toy")
def test_progress_tells_how_many_are_not_complete(tmp_path):
    seen = []
    study = sweep(Toy(), {"count": [1, 13, 7, 2]}, out=tmp_path / "S", progress=lambda *step: seen.append(step))
    assert seen[0] == (0, 4, "") and seen[-1] == (4, 4, "2 not complete") and all(total == 4 for _, total, _ in seen)
    assert study.complete
    seen.clear()
    sweep(Toy(), {"count": [1, 13, 7, 2]}, out=tmp_path / "S", progress=lambda *step: seen.append(step))
    assert seen == []


# -- from Python ---------------------------------------------------------------------------------------------------------------


@pytest.mark.usefixtures("toy")
def test_from_python_as_the_docstrings_say(tmp_path):
    vary = {
        "size": dw.linspace("8 mm", "12 mm", 3),
        "force": geomspace("1 N", "4 N", 3),
        "ratio": normal(1.0, 0.1, lower=0.5),
        "form": ["round"],
    }
    study = sweep(with_variation(Toy(), vary, samples=4), None, out=tmp_path / "S")
    assert isinstance(study, dw.Study) and study.folder == (tmp_path / "S").resolve() and len(study) == 36
    assert study.plan.keys == ("size", "force", "form", "ratio") and study.plan.shape == (3, 3, 1)
    memory, opened = sweep(Toy(study=study.spec.study), None), dw.open_study(str(tmp_path / "S"))
    assert memory.folder is None and memory.seconds > 0 and memory.table.equals(study.table) and opened.table.equals(study.table)
    assert opened.plan.digest == study.plan.digest and opened.spec == study.spec and opened.seconds == study.seconds
    assert study["size"].dtype == float and study["form"].dtype == object


def test_json_can_say_what_a_study_is(chains):
    """What is in the metadata is text that travels."""
    assert json.loads(json.dumps({name: [chains.unit(name), chains.meaning(name)] for name in chains.table.column_names}))


def test_the_help_of_the_table_says_what_its_checks_are(capsys):
    with pytest.raises(SystemExit):
        main(["table", "--help"])
    assert "check.NAME are margins to the limits" in " ".join(capsys.readouterr().out.split())
