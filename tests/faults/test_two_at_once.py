"""Two commands at one folder, a reader beside a writer, a folder that goes away, clocks and limits: an answer or one clear message."""

import os
import re
import resource
import shutil
import subprocess
import sys
import time

import pytest
from places import EXAMPLES

import drivewright as dw
from drivewright.cli import main
from drivewright.execution import executors, processes
from drivewright.studies.sweeps import open_study, sweep

pytestmark = pytest.mark.property

CHAIN = EXAMPLES / "hyvo_chain.toml"
CAM = EXAMPLES / "disc_cam.toml"


def spec():
    return dw.load(CHAIN, ('study.analyses=["closure"]', 'closure.strands="straight"'))


def levels(count):
    return {"joint.rolling_radius": dw.linspace("1.0 mm", "1.6 mm", count)}


def started(*arguments, **more):
    command = [sys.executable, "-m", "drivewright", *map(str, arguments)]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **more)


def sweep_arguments(folder, count=400):
    vary = ["--vary", f"joint.rolling_radius=1.0 mm:1.6 mm:{count}", "--only", "closure", "--set", "closure.strands=straight"]
    return ["sweep", CHAIN, *vary, "--out", folder, "--no-figures"]


def test_of_two_sweeps_in_one_folder_one_works_and_the_other_says_so(tmp_path):
    two = [started(*sweep_arguments(tmp_path / "S"), "--on", "serial") for _ in range(2)]
    said = [each.communicate(timeout=120)[1] for each in two]
    codes = [each.returncode for each in two]
    assert set(codes) <= {0, 2} and 0 in codes
    assert all("another process works on this study" in text for text, code in zip(said, codes, strict=True) if code)
    assert len(dw.open_study(tmp_path / "S")) == 400


def test_a_table_beside_a_sweep_has_whole_rows(tmp_path, capsys):
    """It is written from what is acknowledged at that moment."""
    seen = []

    def look(done, total, what):
        if not done:
            return
        with pytest.raises(SystemExit) as left:
            main(["table", str(tmp_path / "S")])
        seen.append((left.value.code, len((tmp_path / "S" / "table.csv").read_text().splitlines()) - 1, done))

    sweep(spec(), levels(60), out=tmp_path / "S", on="serial", progress=look)
    assert seen and all(code == 0 and rows == done for code, rows, done in seen)


def test_a_reader_while_damaged_parts_are_computed_again(tmp_path):
    """The reader either has all rows that the ledger names, or says which part it misses; never other rows."""
    whole = sweep(spec(), levels(60), out=tmp_path / "S", on="serial").table
    for part in (tmp_path / "S" / "parts").iterdir():
        part.write_bytes(part.read_bytes()[:-3])

    def look(done, total, what):
        opened = open_study(tmp_path / "S", skip_damaged=True)
        assert len(opened) == done and opened.table.equals(whole.take(opened.table["case"])) or not done

    assert sweep(spec(), levels(60), out=tmp_path / "S", on="serial", progress=look).table.equals(whole)


def test_a_run_and_an_export_in_one_folder(tmp_path):
    for _ in range(2):
        two = [
            started("run", CAM, "--only", "profile", "--no-figures", "--out", tmp_path / "run"),
            started("export", CAM, "--to", "dxf,svg,csv", "--out", tmp_path / "run", "--anyway"),
        ]
        said = [each.communicate(timeout=120)[1] for each in two]
        assert [each.returncode for each in two] == [0, 0], said
    assert (tmp_path / "run" / "result.json").is_file() and {f.suffix for f in (tmp_path / "run" / "cad").iterdir()} == {
        ".dxf",
        ".svg",
        ".csv",
    }
    assert os.listdir(tmp_path) == ["run"]


@pytest.mark.parametrize("what", ["everything", "the parts", "the ledger"])
def test_a_study_that_vanishes_on_the_way(tmp_path, what, capsys):
    """A message, not a traceback; the same command makes it again."""
    folder = tmp_path / "S"

    def vanish(done, total, what=what):
        if done > 20:
            if what == "the ledger":
                (folder / "ledger.sqlite").unlink(missing_ok=True)
            else:
                shutil.rmtree(folder if what == "everything" else folder / "parts", ignore_errors=True)

    try:
        sweep(spec(), levels(60), out=folder, on="serial", progress=lambda done, total, text: vanish(done, total))
    except dw.DrivewrightError as error:
        assert str(folder) in str(error)
    again = sweep(spec(), levels(60), out=folder, on="serial")
    assert again.complete and again.table.equals(sweep(spec(), levels(60), on="serial").table)


def test_a_clock_that_jumps_changes_nothing(tmp_path, monkeypatch):
    """Wall clock and file times run back and forth between two parts; nothing here trusts them."""
    plain, now, jumps = sweep(spec(), levels(60), on="serial").table, time.time, [0.0]
    monkeypatch.setattr(time, "time", lambda: now() + jumps[-1])

    def jump(done, total, what):
        jumps.append((-1) ** len(jumps) * 10.0 ** (len(jumps) % 10))
        for file in (tmp_path / "S").rglob("*"):
            os.utime(file, (max(0.0, time.time()),) * 2)

    assert sweep(spec(), levels(60), out=tmp_path / "S", on="serial", progress=jump).table.equals(plain)
    assert sweep(spec(), levels(60), out=tmp_path / "S", on="serial").table.equals(plain) and len(jumps) > 2


def test_a_thousand_workers_are_a_few(monkeypatch):
    monkeypatch.setattr(executors, "ProcessExecutor", executors.InProcessExecutor)
    assert len(executors.make_executors(1000)) == processes.most_processes() <= 4 * (os.cpu_count() or 1)


@pytest.mark.skipif(sys.platform != "linux", reason="limits the address space")
@pytest.mark.parametrize("megabytes", [200, 400, *(pytest.param(most, marks=pytest.mark.slow) for most in (800, 1600))])
def test_little_memory_is_told(tmp_path, megabytes):
    """One line, or Python's own where not even the interpreter's libraries can be loaded; never a hang or half a study."""
    limit = megabytes << 20
    process = started(
        *sweep_arguments(tmp_path / "S"), "--workers", "2", preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
    )
    said = process.communicate(timeout=120)[1]
    assert process.returncode != 0 or len(dw.open_study(tmp_path / "S")) == 400
    assert process.returncode in (0, 2) and "Traceback" not in said, (process.returncode, said[-2000:])


STARVED = """
import sys, threading
from drivewright import cli
from drivewright.cli import app
cli.GRACE = 0.1

def starve():
    raise {error}

def wait(*args, **options):
    threading.Thread(target=starve).start()
    threading.Event().wait(60)

app.app = wait
cli.main([])
"""


@pytest.mark.parametrize(
    ("error", "code", "words"),
    [
        ('RuntimeError("can\'t start new thread")', 2, "drivewright: there is no memory left"),
        ("MemoryError()", 2, "drivewright: there is no memory left"),
    ],
)
def test_a_thread_that_memory_did_not_suffice_for_ends_the_command(error, code, words):
    run = subprocess.run([sys.executable, "-c", STARVED.format(error=error)], capture_output=True, text=True, timeout=30, check=False)
    assert run.returncode == code and run.stderr.startswith(words) and len(run.stderr.splitlines()) == 1


def _bytes(folder):
    """All files of a run or a study but those that keep times."""
    files = {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    return {name: content for name, content in files.items() if not name.startswith(("ledger", ".lock", "parts/"))}


@pytest.mark.slow
@pytest.mark.parametrize("command", [["run", CAM], ["export", CAM, "--to", "dxf,svg,csv", "--anyway"]])
def test_the_same_command_gives_the_same_bytes_on_one_and_on_eight_threads(tmp_path, command):
    for name, threads in (("one", 1), ("eight", 8)):
        names = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")
        done = started(*command, "--out", tmp_path / name, env=os.environ | dict.fromkeys(names, str(threads)))
        said = done.communicate(timeout=120)[1]
        assert done.returncode == 0, said
    one, eight = _bytes(tmp_path / "one"), _bytes(tmp_path / "eight")
    assert one.keys() == eight.keys()
    assert [name for name in one if _untimed(one[name]) != _untimed(eight[name])] == []


def _untimed(content):
    """Without the seconds that computing took, and the text that says them."""
    return re.sub(rb'"seconds": [0-9.e-]+|<dt>seconds</dt><dd>[^<]*', b"", content)


@pytest.mark.slow
def test_a_study_has_the_same_table_on_one_and_eight_threads_serial_and_parallel(tmp_path):
    tables = []
    for threads, place in ((1, ["--on", "serial"]), (8, ["--on", "serial"]), (8, ["--workers", "2"])):
        folder = tmp_path / f"{threads}{place[-1]}"
        environment = os.environ | dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"), str(threads))
        done = started(*sweep_arguments(folder, 120), *place, env=environment)
        said = done.communicate(timeout=120)[1]
        assert done.returncode == 0, said
        for form in ("csv", "parquet"):
            with pytest.raises(SystemExit) as left:
                main(["table", str(folder), "--to", form])
            assert left.value.code == 0
        tables.append([(folder / f"table.{form}").read_bytes() for form in ("csv", "parquet")])
    assert tables[0] == tables[1] == tables[2]
