"""The command line: exit codes, what goes to stdout and what to stderr, and nothing written over on failure."""

import json
import os
import subprocess
import sys
import time
from pathlib import Path

import pytest
from spec_cases import FULL, install

from drivewright import cli
from drivewright.errors import InputError, MissingExtra, SolverError
from drivewright.registry import Analysis
from drivewright.result import Answer, Check, Value

pytestmark = pytest.mark.interface

MODES = {"kind": "fine"}  # what the toy's analysis does in the test at hand


def answer(spec, done):
    if MODES["kind"] == "gives up":
        raise SolverError("no convergence; raise `max_steps`", partial=Answer({"half": Value(0.5, "-", "half way")}))
    if MODES["kind"] == "has no answer":
        raise InputError("no force holds it")
    if MODES["kind"] == "has a fault":
        raise ZeroDivisionError("division by zero")
    if MODES["kind"] == "is left out":
        raise MissingExtra("the reach", "fe")
    if MODES["kind"] == "interrupted":
        raise KeyboardInterrupt
    limit = Check("reach", spec.length, 0.1, "<=", "m", "must fit the box")
    if MODES["kind"] == "warns":
        return Answer({"reach": Value(spec.length, "m", "how far it reaches")}, checks=(limit,), warnings=("pins slip",))
    return Answer({"reach": Value(spec.length, "m", "how far it reaches")}, checks=(limit,), findings=("a finding",))


def build(spec):
    if MODES["kind"] == "cannot be built":
        raise InputError("no such toy can be built")
    if MODES["kind"] == "solver gives up in build":
        raise SolverError("no start position; turn the crank")
    return spec


@pytest.fixture(autouse=True)
def toy(monkeypatch, tmp_path):
    """The kind "toy", a spec of it, and the folder as the current one."""
    install(monkeypatch, tmp_path, Analysis("reach", answer, "how far"), build=build)
    monkeypatch.setitem(MODES, "kind", "fine")
    monkeypatch.chdir(tmp_path)
    (tmp_path / "lift.csv").write_text("angle [deg],lift [mm]\n0,0\n1,1\n")
    (tmp_path / "toy.toml").write_text(FULL)
    return tmp_path


@pytest.fixture
def drivewright(capsys):
    """Runs a command line: (exit code, stdout, stderr)."""

    def call(*arguments):
        with pytest.raises(SystemExit) as left:
            cli.main(list(arguments))
        return (left.value.code or 0, *capsys.readouterr())

    return call


def snapshot(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(Path(folder).rglob("*")) if path.is_file()}


def refused(found, code=2):
    """The message of a refusal: alone on stderr, nothing on stdout, no traceback."""
    got, out, err = found
    assert got == code and out == "" and err.startswith("drivewright: ") and "Traceback" not in err
    return err.removeprefix("drivewright: ").rstrip("\n")


# -- run -----------------------------------------------------------------------------------------------------------------------


def test_a_run_prints_the_result_and_writes_the_folder(drivewright, toy):
    code, out, err = drivewright("run", "toy.toml", "--no-figures")
    assert code == 0 and "How far it reaches" in out and "40 mm" in out and "a toy" in out and "report:" not in out
    assert "must fit the box" not in out and "must fit the box" in drivewright("run", "toy.toml", "--no-figures", "-v")[1]
    assert err.splitlines()[-1] == f"report: {toy}/out/toy/report.html" and "note: a finding" in err
    assert {"result.json", "report.html", "spec.toml"} <= set(snapshot(toy / "out" / "toy")) and not list((toy / "out").glob("*tmp*"))


def test_the_verdict_stands_before_the_report_and_a_warning_before_it(drivewright, toy, monkeypatch):
    assert drivewright("run", "toy.toml", "--no-figures")[2].splitlines()[-3:-1] == ["note: a finding", "verdict: 1 check passes"]
    monkeypatch.setitem(MODES, "kind", "warns")
    code, _, err = drivewright("run", "toy.toml", "--no-figures", "--strict")
    assert code == 0 and err.splitlines()[-3:-1] == ["warning: pins slip", "verdict: 1 check passes, 1 warning"]
    assert "note: pins slip" not in err


@pytest.mark.parametrize("command", [["run", "toy.toml", "--no-figures"], ["compare", "toy.toml", "toy.toml"]])
def test_what_was_asked_for_by_name_and_is_left_out_exits_with_2_and_says_why(drivewright, toy, monkeypatch, command):
    monkeypatch.setitem(MODES, "kind", "is left out")
    code, _, err = drivewright(*command, "--only", "reach")
    assert code == 2
    assert "analysis 'reach' (how far) is left out: the reach needs the extra 'fe'" in err
    assert "warning: " in err
    assert drivewright(*command)[0] == 0


def test_json_alone_goes_to_stdout(drivewright, toy):
    code, out, err = drivewright("run", "toy.toml", "--no-figures", "--json", "--out", "r")
    record = json.loads(out)
    assert code == 0 and record == json.loads((toy / "r" / "result.json").read_text()) and record["values"]["reach"]["value"] == 0.04


def test_several_specs_get_a_folder_each(drivewright, toy):
    (toy / "b").mkdir()
    (toy / "other.toml").write_text(FULL.replace('"40 mm"', '"50 mm"'))
    code, out, _ = drivewright("run", "toy.toml", "other.toml", "--no-figures", "--json", "--out", "all")
    assert code == 0 and [r["values"]["reach"]["value"] for r in json.loads(out)] == [0.04, 0.05]
    assert (toy / "all" / "toy" / "result.json").is_file() and (toy / "all" / "other" / "result.json").is_file()
    (toy / "b" / "toy.toml").write_text(FULL)
    assert "same file name" in refused(drivewright("run", "toy.toml", "b/toy.toml"))


@pytest.mark.parametrize("change", ['length="6.35 mm"', "length=6.35mm", "length = 6.35 mm", "joints.rocker.clearance=6.35 mm"])
def test_set_works_with_and_without_quotes_and_reaches_the_effective_spec(drivewright, toy, change):
    code, out, _ = drivewright("run", "toy.toml", "--no-figures", "--json", "--set", change, "--set", "title=changed")
    assert code == 0 and json.loads(out)["title"] == "changed" and '"6.35 mm"' in (toy / "out" / "toy" / "spec.toml").read_text()


def test_strict_exits_with_3_when_a_check_fails_and_only_then(drivewright, toy):
    code, out, _ = drivewright("run", "toy.toml", "--no-figures", "--strict", "--set", "length=150 mm")
    assert code == 3 and "FAILS" in out and "-50 mm" in out and (toy / "out" / "toy" / "result.json").is_file()
    assert drivewright("run", "toy.toml", "--no-figures", "--set", "length=150 mm")[0] == 0
    assert drivewright("run", "toy.toml", "--no-figures", "--strict")[0] == 0


def test_a_solver_that_gives_up_exits_with_4_and_leaves_a_partial_result(drivewright, toy, monkeypatch):
    monkeypatch.setitem(MODES, "kind", "gives up")
    code, out, err = drivewright("run", "toy.toml", "--no-figures", "--strict")
    record = json.loads((toy / "out" / "toy" / "result.json").read_text())
    assert code == 4 and record["outcome"] == "partial" and record["values"]["half"]["value"] == 0.5
    assert "analysis 'reach' (how far) gave up: no convergence; raise `max_steps`" in err and "Traceback" not in err


@pytest.mark.parametrize(
    ("arguments", "wanted"),
    [
        (
            ["nope.toml"],
            "nope.toml: there is no such file; `drivewright examples` lists worked ones to copy, `drivewright new KIND nope.toml` writes a",
        ),
        (["."], ".: is a folder; a spec is a TOML file"),
        (["toy.toml", "--set", "lenght=3 mm"], "toy.toml: lenght: unknown key (did you mean 'length'?)"),
        (["toy.toml", "--set", "length=3"], 'toy.toml: length: unit missing: a length, e.g. "3 mm"'),
        (["toy.toml", "--set", "length"], "toy.toml: --set takes key=value"),
        (["toy.toml", "--only", "raech"], "toy.toml: no analysis is called 'raech' (did you mean 'reach'?)"),
        (["toy.toml", "--out", "toy.toml"], "toy.toml: is a file, a run folder cannot take its place"),
        (["toy.toml", "--out", "full"], "full: is not empty and is no run folder"),
    ],
)
def test_a_mistake_is_one_message_and_nothing_is_written(drivewright, toy, arguments, wanted):
    (toy / "full").mkdir()
    (toy / "full" / "thesis.txt").write_text("years of work")
    before = snapshot(toy)
    assert wanted in refused(drivewright("run", "--no-figures", *arguments)) and snapshot(toy) == before


@pytest.mark.parametrize(
    ("mode", "code", "wanted"),
    [("cannot be built", 2, "toy.toml: no such toy can be built"), ("solver gives up in build", 4, "no start position; turn the crank")],
)
def test_a_failing_run_leaves_the_old_run_folder_as_it_was(drivewright, toy, monkeypatch, mode, code, wanted):
    assert drivewright("run", "toy.toml", "--no-figures")[0] == 0
    before = snapshot(toy)
    monkeypatch.setitem(MODES, "kind", mode)
    assert wanted in refused(drivewright("run", "toy.toml", "--no-figures", "--set", "length=1 mm"), code)
    assert refused(drivewright("run", "toy.toml", "--set", "turns=0")) == "toy.toml: turns: must be at least 1, got 0"
    assert snapshot(toy) == before


@pytest.mark.faults
@pytest.mark.parametrize(
    ("mode", "wanted"),
    [
        ("has no answer", ("note: analysis 'reach' (how far) has no answer for this design: no force holds it",)),
        (
            "has a fault",
            ("note: analysis 'reach' (how far) failed by a fault of the program, not of the spec: ZeroDivisionError", "Please report it"),
        ),
    ],
)
def test_an_analysis_that_fails_leaves_a_partial_result_on_disk(drivewright, toy, monkeypatch, mode, wanted):
    monkeypatch.setitem(MODES, "kind", mode)
    code, _, err = drivewright("run", "toy.toml", "--no-figures")
    record = json.loads((toy / "out" / "toy" / "result.json").read_text())
    assert code == 4 and record["outcome"] == "partial" and [text for text in wanted if text not in err] == [] and "Traceback" not in err
    assert any(wanted[0].removeprefix("note: ") in finding for finding in record["findings"])


@pytest.mark.faults
def test_the_traceback_of_a_fault_is_shown_on_request(drivewright, toy, monkeypatch):
    monkeypatch.setitem(MODES, "kind", "has a fault")
    monkeypatch.setenv("DRIVEWRIGHT_DEBUG", "")
    code, _, err = drivewright("--debug", "run", "toy.toml", "--no-figures")
    assert code == 4 and "Traceback" in err and "ZeroDivisionError: division by zero" in err


def test_a_disk_that_is_full_is_one_message_and_the_old_folder_stays(drivewright, toy, monkeypatch):
    assert drivewright("run", "toy.toml", "--no-figures")[0] == 0
    before, write = snapshot(toy), Path.write_text

    def full(path, *given, **named):
        if path.name == "result.json":
            raise OSError(28, "No space left on device", str(path))
        return write(path, *given, **named)

    monkeypatch.setattr(Path, "write_text", full)
    message = refused(drivewright("run", "toy.toml", "--no-figures", "--set", "length=1 mm"))
    assert "No space left on device" in message and "nothing was written over" in message and snapshot(toy) == before


def test_an_interrupt_exits_with_130_and_leaves_no_rubbish(drivewright, toy, monkeypatch):
    monkeypatch.setitem(MODES, "kind", "interrupted")
    before = snapshot(toy)
    code, out, err = drivewright("run", "toy.toml", "--no-figures")
    assert code == 130 and out == "" and "interrupted; what was not written yet is lost" in err and snapshot(toy) == before
    assert "Traceback" not in err
    Path("toy.toml").rename("sweep")  # a file may be called like a command
    assert "what was not written yet is lost" in drivewright("run", "sweep", "--no-figures")[2]


# -- the other commands --------------------------------------------------------------------------------------------------------


def test_new_writes_a_spec_that_runs_and_refuses_to_write_over_it(drivewright, toy):
    (toy / "presets").mkdir()
    (toy / "presets" / "default.toml").write_text(FULL)
    (toy / "presets" / "lift.csv").write_text("angle [deg],lift [mm]\n0,0\n7,7\n")
    (toy / "new").mkdir()
    code, out, err = drivewright("new", "toy", "new/mine.toml")
    assert code == 0 and out == "" and "wrote new/mine.toml (presets of toy: default)" in err
    assert (toy / "new" / "lift.csv").read_text().endswith("7,7\n")
    before = snapshot(toy)
    assert refused(drivewright("new", "toy", "new/mine.toml")).startswith("new/mine.toml exists and is left alone")
    assert snapshot(toy) == before
    assert drivewright("run", "new/mine.toml", "--no-figures")[0] == 0
    assert "note: lift.csv exists and is left alone" in drivewright("new", "toy", "here.toml")[2]
    assert (toy / "lift.csv").read_text().endswith("1,1\n")


def test_the_gallery_is_written_and_its_path_printed(drivewright, toy):
    code, out, _ = drivewright("examples", "--gallery", "--out", "here")
    assert code == 0 and out.strip() == "here/gallery/index.html" and (toy / out.strip()).is_file()
    assert "leave the name" in refused(drivewright("examples", "disc_cam", "--gallery"))


@pytest.mark.parametrize(
    ("arguments", "wanted"),
    [
        (["new", "camm"], "no mechanism is called 'camm' (did you mean 'cam'?)"),
        (["new", "cam", "--preset", "groves"], "no preset of cam is called 'groves' (did you mean 'groove'?)"),
        (["new", "cam", "no/such/folder/x.toml"], "no/such/folder/x.toml: there is no folder 'no/such/folder'"),
        (["schema", "camm"], "no mechanism is called 'camm'"),
        (["examples", "yoke"], "no example is called 'yoke' (did you mean 'yoke_cam'?)"),
        (["export", "nope.toml", "--to", "dxf"], "nope.toml: there is no such file"),
        (["optimise", "nope.toml"], "nope.toml: there is no such file"),
        (["verify", "nope.toml"], "nope.toml: there is no such file"),
    ],
)
def test_other_commands_refuse_the_same_way(drivewright, toy, arguments, wanted):
    before = snapshot(toy)
    assert wanted in refused(drivewright(*arguments)) and snapshot(toy) == before


@pytest.mark.parametrize(
    "arguments", [["run"], ["run", "toy.toml", "--bogus"], ["fly"], ["new"], ["export", "toy.toml"], ["run", "toy.toml", "--out"]]
)
def test_a_command_line_that_is_none_exits_with_2(drivewright, toy, arguments):
    before = snapshot(toy)
    code, out, err = drivewright(*arguments)
    assert code == 2 and out == "" and "Error: " in err and "Traceback" not in err and snapshot(toy) == before


def test_the_schema_and_the_version_go_to_stdout(drivewright):
    code, out, err = drivewright("schema", "toy")
    assert code == 0 and err == "" and json.loads(out)["properties"]["length"]["x-dimension"] == "length"
    from drivewright import __version__

    assert drivewright("--version") == (0, f"{__version__}\n", "")


def test_help_lists_every_command(drivewright):
    code, out, _ = drivewright("--help")
    assert code == 0
    for command in ("new", "run", "export", "optimise", "verify", "validate", "examples", "schema", "doctor"):
        assert f"\n  {command} " in out


# -- as a process --------------------------------------------------------------------------------------------------------------


def process(*arguments, cwd=None):
    return subprocess.run(
        [sys.executable, "-c", "from drivewright.cli import main; main()", *arguments], capture_output=True, text=True, cwd=cwd
    )


def test_a_mistake_in_a_real_process_has_no_traceback(tmp_path):
    done = process("run", "nope.toml", cwd=tmp_path)
    assert (done.returncode, done.stdout) == (2, "") and done.stderr.count("\n") == 1 and "Traceback" not in done.stderr


def test_help_starts_fast_and_loads_nothing_heavy(tmp_path):
    code = (
        "import sys\nfrom drivewright.cli import main\ntry: main(['--help'])\nexcept SystemExit: pass\n"
        "print('LOADED', *sorted({m.split('.')[0] for m in sys.modules}))"
    )
    started = time.perf_counter()
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=tmp_path, check=True)
    assert time.perf_counter() - started < 5  # the benchmark shows the real number; this only catches a wrong import on a loaded machine
    assert not set(done.stdout.split("LOADED")[1].split()) & {
        "numpy",
        "scipy",
        "numba",
        "matplotlib",
        "pyarrow",
        "pint",
        "pydantic",
        "rich",
        "tomlkit",
    }


def test_a_reader_that_goes_away_is_no_traceback(tmp_path):
    code = "from drivewright.cli import main; main(['schema', 'cam'])"
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=tmp_path) as running:
        running.stdout.close()
        assert "Traceback" not in running.stderr.read()


@pytest.mark.parametrize("encoding", ["ascii", "cp1252"])
def test_a_pipe_that_does_not_have_every_letter_ends_no_command(encoding, tmp_path):
    """As on Windows, where pipes have the letters of the country."""
    spec = Path(__file__).parents[2] / "examples" / "disc_cam.toml"
    command = [
        sys.executable,
        "-m",
        "drivewright",
        "run",
        str(spec),
        "--set",
        "title=Nocken 凸轮",
        "--no-figures",
        "--out",
        str(tmp_path / "R"),
    ]
    done = subprocess.run(command, capture_output=True, env={**os.environ, "PYTHONIOENCODING": encoding}, timeout=300)
    assert done.returncode == 0 and b"Nocken ??" in done.stdout, done.stderr
