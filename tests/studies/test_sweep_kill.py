"""A long sweep is killed in the middle and given again: every case once, nothing acknowledged computed twice, no worker left behind."""

import os
import signal
import sqlite3
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pyarrow.parquet as parquet
import pytest
from places import EXAMPLES

pytestmark = pytest.mark.interface

EXAMPLE = EXAMPLES / "hyvo_chain.toml"
CASES = 1500
PATIENCE = 240  # seconds; a machine may be busy, and compiles the first time


def command(folder, workers):
    return [
        sys.executable,
        "-m",
        "drivewright",
        "sweep",
        str(EXAMPLE),
        "--only",
        "closure",
        "--set",
        "closure.strands=straight",
        "--vary",
        f"joint.rolling_radius=1.0 mm:1.6 mm:{CASES}",
        "--out",
        str(folder),
        "--workers",
        str(workers),
        "--no-figures",
    ]


def acknowledged(folder, mode="ro"):
    """(first, count, name) of the ledger; none where there is no ledger yet.

    After a kill in the middle of a commit only a reader that may write, "rw", can roll it back.
    """
    try:
        with sqlite3.connect(f"file:{folder}/ledger.sqlite?mode={mode}", uri=True) as ledger:
            return ledger.execute("select first, count, name from parts order by first").fetchall()
    except sqlite3.Error:
        return []


def descendants(pid):
    """Processes below a process."""
    found, parents = [], {}
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rpartition(")")[2].split()
        except OSError:
            continue
        parents[int(stat.parent.name)] = int(fields[1])
    todo = [pid]
    while todo:
        mother = todo.pop()
        children = [child for child, parent in parents.items() if parent == mother]
        found += children
        todo += children
    return found


def running(pid):
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def wait_for(what, seconds=PATIENCE):
    start = time.monotonic()
    while not (found := what()):
        assert time.monotonic() - start < seconds
        time.sleep(0.02)
    return found


@pytest.fixture(scope="module")
def killed(tmp_path_factory):
    """(folder, parts acknowledged when it was killed, their stamps, workers then): killed with SIGKILL after some parts."""
    folder = tmp_path_factory.mktemp("killed") / "S"
    process = subprocess.Popen(command(folder, 2), stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    wait_for(lambda: process.poll() is not None or len(acknowledged(folder)) >= 4)
    workers = descendants(process.pid)
    process.send_signal(signal.SIGKILL)
    process.wait()
    died = time.monotonic()
    wait_for(lambda: not any(map(running, workers)), 20)
    parts = acknowledged(folder, "rw")
    return folder, parts, stamps(folder, parts), workers, time.monotonic() - died


def stamps(folder, parts):
    """What changes when a file is written again."""
    found = {name: (folder / "parts" / name).stat() for _, _, name in parts}
    return {name: (stat.st_ino, stat.st_mtime_ns, stat.st_size) for name, stat in found.items()}


@pytest.fixture(scope="module")
def finished(killed):
    """The folder after the same command again, with a part that no ledger names lying about."""
    folder = killed[0]
    (folder / "parts" / "000000000700-000000000799.parquet").write_bytes(b"half a part")
    (folder / "parts" / ".000000000700-000000000799.parquet.tmp").write_bytes(b"less than that")
    done = subprocess.run(command(folder, 2), capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return folder


def rows(folder):
    """Every part that lies there, as an outsider reads them."""
    return [parquet.read_table(file) for file in sorted((folder / "parts").glob("*.parquet"))]


def test_it_was_killed_in_the_middle(killed):
    _, parts, _, workers, _ = killed
    assert 0 < sum(count for _, count, _ in parts) < CASES
    assert len(workers) >= 2


def test_the_workers_leave_with_their_parent(killed):
    """They look every quarter of a second; the rest is for a busy machine."""
    assert killed[4] < 5


def test_every_case_is_there_once(finished):
    cases = np.concatenate([table["case"].to_numpy() for table in rows(finished)])
    assert np.array_equal(np.sort(cases), np.arange(CASES))
    assert {status for table in rows(finished) for status in table["status"].to_pylist()} == {"complete"}


def test_what_was_acknowledged_is_not_computed_again(killed, finished):
    _, parts, before, _, _ = killed
    assert set(parts) <= set(acknowledged(finished))
    assert stamps(finished, parts) == before


def test_only_what_the_ledger_names_is_left(finished):
    assert sorted(os.listdir(finished / "parts")) == sorted(name for _, _, name in acknowledged(finished))


def test_the_answer_is_that_of_an_undisturbed_run_with_another_number_of_workers(finished, tmp_path):
    import drivewright as dw

    assert subprocess.run(command(tmp_path / "S", 1), capture_output=True).returncode == 0
    assert dw.open_study(finished).table.equals(dw.open_study(tmp_path / "S").table)


def test_a_complete_study_is_not_computed_again(finished):
    before = stamps(finished, acknowledged(finished))
    done = subprocess.run(command(finished, 1), capture_output=True, text=True)
    assert done.returncode == 0 and f"{CASES} of {CASES} cases" in done.stderr
    assert stamps(finished, acknowledged(finished)) == before
