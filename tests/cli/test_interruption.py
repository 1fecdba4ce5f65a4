"""Signals that end a command: finished work is kept, workers leave, nothing is said but one line, and the exit code tells the signal."""

import os
import re
import signal
import subprocess
import sys
import textwrap
import time
from pathlib import Path

import pytest
from places import EXAMPLES

import drivewright as dw
from drivewright.cli.interruption import ending_signals, exit_code

pytestmark = [pytest.mark.interface, pytest.mark.skipif(sys.platform == "win32", reason="has no such signals")]

CASES = 4000
SIGNALS = {"INT": 130, "TERM": 143, "HUP": 129}


def sweep(folder, workers=2, cases=CASES):
    chain = [str(EXAMPLES / "hyvo_chain.toml"), "--only", "closure", "--set", "closure.strands=straight"]
    vary = ["--vary", f"joint.rolling_radius=1.0 mm:1.6 mm:{cases}", "--workers", str(workers), "--no-figures"]
    return [sys.executable, "-m", "drivewright", "sweep", *chain, *vary, "--out", str(folder)]


@pytest.fixture(scope="module")
def compiled(tmp_path_factory):
    """Kernels on the disk: a first run says a line of its own about them."""
    assert subprocess.run(sweep(tmp_path_factory.mktemp("first") / "S", cases=4), capture_output=True).returncode == 0


def descendants(pid):
    """Processes below a process."""
    found = []
    for task in Path(f"/proc/{pid}/task").glob("*/children"):
        for child in map(int, task.read_text().split()):
            found += [child, *descendants(child)]
    return found


def alive(pid):
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def until(what, seconds=120):
    end = time.monotonic() + seconds
    while not what():
        assert time.monotonic() < end
        time.sleep(0.01)


def interrupted(command, ready, *signals, whole_group=False):
    """(exit code, what it said, processes that it left) of a command that gets signals when it is ready."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, start_new_session=True)
    until(lambda: process.poll() is not None or ready(process))
    below = descendants(process.pid)
    for each in signals:
        if process.poll() is None:  # it may be faster than the signal
            (os.killpg if whole_group else os.kill)(process.pid, each)
        time.sleep(0.1)  # of signals that come together the system delivers any first
    said = process.communicate(timeout=60)[1]
    until(lambda: not any(map(alive, below)), 20)
    return process.returncode, said


def parts(folder, count):
    return lambda process: len(list(folder.glob("parts/[0-9]*.parquet"))) >= count


def quiet(said):
    """One line beside those on how far the command is, and nothing from the interpreter or its helpers."""
    lines = [line for line in said.splitlines() if line and not re.match(r"[\w-]+\.toml: ", line)]
    assert len(lines) <= 2 and not re.search("leaked|Traceback|Error|resource_tracker", said), said
    assert "interrupted; what was finished before is kept, and the same command continues" in said


@pytest.mark.usefixtures("compiled")
@pytest.mark.parametrize("name", ["INT", "TERM", pytest.param("HUP", marks=pytest.mark.slow)])  # the next test sends HUP, too
def test_a_sweep_that_is_ended_keeps_what_is_done_and_leaves_nothing_behind(tmp_path, name):
    code, said = interrupted(sweep(tmp_path / "S"), parts(tmp_path / "S", 3), getattr(signal, f"SIG{name}"))
    assert code == SIGNALS[name]
    quiet(said)
    study = dw.open_study(tmp_path / "S")
    assert 0 < len(study) < CASES and study.counts == {"complete": len(study)}


@pytest.mark.usefixtures("compiled")
def test_a_terminal_that_closes_sends_its_signal_to_all_of_them(tmp_path):
    code, said = interrupted(sweep(tmp_path / "S"), parts(tmp_path / "S", 3), signal.SIGHUP, whole_group=True)
    assert code == 129
    quiet(said)


@pytest.mark.usefixtures("compiled")
def test_an_impatient_system_sends_more_than_one(tmp_path):
    many = [signal.SIGTERM, signal.SIGHUP, signal.SIGTERM, signal.SIGTERM]
    code, said = interrupted(sweep(tmp_path / "S"), parts(tmp_path / "S", 3), *many)
    assert code == 143
    quiet(said)


@pytest.mark.slow
@pytest.mark.parametrize("name", SIGNALS)
def test_a_signal_in_any_phase(tmp_path, name):
    """At forty moments of a sweep, from the first import to the last part; the same command goes on each time."""
    for moment in range(40):
        folder, delay = tmp_path / "S", 0.1 * moment
        start = time.monotonic()
        code, said = interrupted(
            sweep(folder), lambda process, start=start, delay=delay: time.monotonic() - start > delay, getattr(signal, f"SIG{name}")
        )
        assert code in (0, SIGNALS[name], -getattr(signal, f"SIG{name}")), said
        assert "leaked" not in said and (code < 0 or "Traceback" not in said), (delay, said)
    assert subprocess.run(sweep(folder), capture_output=True).returncode == 0
    assert len(dw.open_study(folder)) == CASES


CAUGHT = """
    import signal, sys
    from drivewright.cli.interruption import ending_signals, exit_code
    with ending_signals() as received:
        try:
            exec("signal.raise_signal(signal.SIGTERM)")
        except KeyboardInterrupt:
            sys.exit(exit_code(received))
"""


@pytest.mark.parametrize("name", SIGNALS)
def test_what_a_library_makes_of_an_interrupt_is_one(name):
    """Arrow swallows it within a conversion and says that it cannot convert."""
    code = """
        import os, signal, sys, time
        import drivewright.cli, drivewright.cli.app

        def app(args, **settings):
            try:
                os.kill(os.getpid(), getattr(signal, "SIG" + args[1]))
                time.sleep(5)
            except BaseException:
                pass
            raise TypeError("unexpected argument type")

        drivewright.cli.app.app = app
        drivewright.cli.main(["sweep", sys.argv[1]])
    """
    command = [sys.executable, "-c", textwrap.dedent(code), name]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=60, start_new_session=True)
    said = "interrupted; what was finished before is kept, and the same command continues\n"
    assert (ended.returncode, ended.stdout, ended.stderr) == (SIGNALS[name], "", said)


def test_a_thread_without_memory_is_told_also_where_a_library_has_swallowed_its_interrupt():
    code = """
        import _thread, time
        import drivewright.cli, drivewright.cli.app

        def app(args, **settings):
            try:
                drivewright.cli._starved.set()
                _thread.interrupt_main()
                time.sleep(5)
            except BaseException:
                pass
            raise TypeError("unexpected argument type")

        drivewright.cli.app.app = app
        drivewright.cli.main(["run"])
    """
    ended = subprocess.run([sys.executable, "-c", textwrap.dedent(code)], capture_output=True, text=True, timeout=60)
    assert ended.returncode not in (0, 1, 130) and "memory" in ended.stderr and "interrupted" not in ended.stderr


def test_an_interrupt_while_a_class_is_made_keeps_its_exit_code(tmp_path):
    """CPython would otherwise end by SIGINT, as an interrupt that nobody has caught."""
    (tmp_path / "caught.py").write_text(textwrap.dedent(CAUGHT))
    assert subprocess.run([sys.executable, "-m", "caught"], cwd=tmp_path).returncode == 143


# -- in this process -----------------------------------------------------------------------------------------------------------


def test_the_first_signal_interrupts_and_the_next_ones_change_nothing():
    before = signal.getsignal(signal.SIGTERM)
    try:
        with pytest.raises(KeyboardInterrupt), ending_signals() as received:
            signal.raise_signal(signal.SIGTERM)
        signal.raise_signal(signal.SIGTERM)
        signal.raise_signal(signal.SIGHUP)
        assert received[0] == signal.SIGTERM and exit_code(received) == 143 and exit_code([]) == 130
    finally:
        signal.signal(signal.SIGTERM, before)
        signal.signal(signal.SIGHUP, signal.SIG_DFL)


def test_ctrl_c_is_known_and_gives_all_handlers_back():
    with pytest.raises(KeyboardInterrupt), ending_signals() as received:
        signal.raise_signal(signal.SIGINT)
    assert received == [signal.SIGINT] and exit_code(received) == 130
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler and signal.getsignal(signal.SIGTERM) == signal.SIG_DFL


def test_handlers_are_given_back_and_what_is_ignored_stays_so():
    signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with ending_signals() as received:
            signal.raise_signal(signal.SIGHUP)
        assert received == [] and signal.getsignal(signal.SIGHUP) == signal.SIG_IGN
        assert signal.getsignal(signal.SIGTERM) == signal.SIG_DFL
    finally:
        signal.signal(signal.SIGHUP, signal.SIG_DFL)
