"""What a first run says while it compiles."""

import os
import subprocess
import sys
import time
import tomllib

import pytest
from places import EXAMPLES

from drivewright import registry
from drivewright._jit import compilation
from drivewright._jit.compilation import BEGUN, DONE, FOUND, USUAL, Compilation, usual_seconds, watched_by
from drivewright.cli import show
from drivewright.steps import note_step

pytestmark = pytest.mark.interface


class Clock:
    def __init__(self):
        self.now = 100.0

    def monotonic(self):
        return self.now


@pytest.fixture
def clock(monkeypatch):
    clock = Clock()
    monkeypatch.setattr(compilation, "time", clock)
    monkeypatch.setattr(show, "time", clock)
    monkeypatch.setattr(compilation, "usual_seconds", lambda kind: {"a": [2.0], "b": [4.0], "c": [1.0]} if kind == "press" else {})
    return clock


def told(clock, kind, *steps):
    """[(words, seconds left)] as news of steps (kernel, what, seconds that pass before it)."""
    said = []
    compiling = Compilation(kind, lambda: said.append((compiling.words, compiling.left)))
    with watched_by(compiling):
        for kernel, what, seconds in steps:
            clock.now += seconds
            compilation.tell(kernel, what)
    return said


def test_the_time_that_is_left_follows_the_pace_of_this_machine(clock):
    said = told(clock, "press", ("a", BEGUN, 0), ("a", DONE, 6), ("b", BEGUN, 0), ("b", DONE, 9), ("c", BEGUN, 0), ("c", DONE, 3))
    assert said == [
        ("compiling kernels for 'press' (each once, when first needed) 1/3, about 7 s left", 7.0),
        ("", 15.0),
        ("compiling kernels for 'press' (each once, when first needed) 2/3, about 15 s left", 15.0),
        ("", 2.5),
        ("compiling kernels for 'press' (each once, when first needed) 3/3, about 2 s left", 2.5),
        ("", 0.0),
    ]


def test_it_counts_down_while_a_kernel_is_compiled(clock):
    compiling = Compilation("press")
    compiling("b", BEGUN)
    clock.now += 3
    assert compiling.words.endswith("1/3, about 4 s left") and compiling.seconds == 3
    clock.now += 7  # longer than usual: what comes after it is all that is known
    assert compiling.words.endswith("1/3, about 3 s left") and compiling.seconds == 10
    compiling("b", DONE)
    assert compiling.seconds == 10 and compiling.left == 7.5 and not compiling.words


def test_kernels_that_are_compiled_while_another_process_compiles_one(clock):
    """Their time is counted once, and the kernel waited for has come nearer when they are done."""
    steps = [("b", BEGUN, 0), ("a", BEGUN, 1), ("a", DONE, 2), ("b", DONE, 3)]
    assert told(clock, "press", *steps) == [
        ("compiling kernels for 'press' (each once, when first needed) 1/3, about 7 s left", 7.0),
        ("compiling kernels for 'press' (each once, when first needed) 1/3, about 4 s left", 4.0),
        ("compiling kernels for 'press' (each once, when first needed) 2/3, about 2 s left", 2.0),
        ("", 1.0),
    ]


def test_what_is_on_the_disk_already_is_not_waited_for(clock):
    said = told(clock, "press", ("b", FOUND, 0), ("a", BEGUN, 0), ("a", DONE, 2), ("x", BEGUN, 0))
    assert said[0] == ("compiling kernels for 'press' (each once, when first needed) 1/2, about 3 s left", 3.0)
    assert said[2] == ("compiling kernels for 'press' (each once, when first needed) 2/3, about 1 s left", 1.0)


def test_a_kind_that_nobody_measured(clock):
    said = told(clock, "stranger", ("a", BEGUN, 0), ("a", DONE, 2), ("b", BEGUN, 0))
    assert [words for words, _ in said] == [
        "compiling kernels for 'stranger' (each once, when first needed) 1/1",
        "",
        "compiling kernels for 'stranger' (each once, when first needed) 2/2",
    ]


def test_nobody_is_told_after_the_block(clock):
    assert told(clock, "press", ("a", BEGUN, 0)) and not compilation._watchers


def lines_of(clock, capsys, title, kind, *steps):
    """What stands on stderr, without a terminal, of steps (kernel, what, seconds that pass before it)."""
    with show.progress(title, kind):
        for kernel, what, seconds in steps:
            clock.now += seconds
            compilation.tell(kernel, what)
    return capsys.readouterr().err.splitlines()


def test_without_a_terminal_it_is_a_line_now_and_then(clock, capsys):
    assert lines_of(
        clock, capsys, "file.toml", "press", ("a", BEGUN, 0), ("a", DONE, 2), ("b", BEGUN, 0), ("b", DONE, 9), ("c", BEGUN, 0)
    ) == [
        "compiling kernels for 'press' (each once, when first needed) 1/3, about 7 s left",
        "compiling kernels for 'press' (each once, when first needed) 3/3, about 2 s left",
    ]


def test_where_kernels_cannot_be_kept_it_says_that_every_run_compiles(clock, capsys, monkeypatch):
    monkeypatch.setattr("drivewright._jit.disk_cache.is_kept", lambda: False)
    assert lines_of(clock, capsys, "file.toml", "press", ("a", BEGUN, 0), ("a", DONE, 2))[0].startswith(
        "compiling kernels for 'press' (in every run: the user's cache folder cannot be written to) 1/3"
    )


def test_without_a_terminal_a_line_now_and_then_says_how_far_it_is(clock, capsys, monkeypatch):
    monkeypatch.setattr("drivewright.steps.EACH", 0.0)
    with show.progress("file.toml", "stranger") as step:
        for done, seconds in enumerate([0, 29, 2, 5, 20]):
            clock.now += seconds
            step(done, 5, f"stress {done}")
        clock.now += 31
        note_step("load steps", 3, 24)
        clock.now += 31
        step(0, 0, "of unknown length")
    assert capsys.readouterr().err.splitlines() == [
        "file.toml: 2 of 5 done, stress 2",
        "file.toml: 4 of 5 done, stress 4: load steps, 3 of 24",
        "file.toml: of unknown length",
    ]


def test_two_quick_kernels_are_not_worth_a_line(clock, capsys):
    assert lines_of(clock, capsys, "file.toml", "stranger", ("a", BEGUN, 0), ("a", DONE, 1), ("b", BEGUN, 0), ("b", DONE, 0.9)) == []


def test_slow_kernels_that_nobody_measured_are_told_after_two_seconds(clock, capsys):
    steps = ("a", BEGUN, 0), ("a", DONE, 2.5), ("b", BEGUN, 0), ("b", DONE, 1)
    assert lines_of(clock, capsys, "file.toml", "stranger", *steps) == [
        "compiling kernels for 'stranger' (each once, when first needed) 2/2"
    ]
    assert lines_of(clock, capsys, "file.toml", "", *steps) == ["compiling kernels for 'file.toml' (each once, when first needed) 2/2"]


def test_one_kernel_that_takes_long_is_told_every_ten_seconds(clock, capsys):
    lines = show._Lines("stranger")
    lines.compilation.on_news = lambda: None  # without the thread that looks by itself
    lines.compilation("a", BEGUN)
    for _ in range(25):
        clock.now += 1
        lines.look()
    assert capsys.readouterr().err.splitlines() == ["compiling kernels for 'stranger' (each once, when first needed) 1/1"] * 3


def test_a_thread_looks_while_a_kernel_is_compiled(monkeypatch, capsys):
    monkeypatch.setattr(show._Lines, "FIRST", 0.0)
    with show.progress("file.toml", "stranger"):
        compilation.tell("a", BEGUN)
        deadline = time.monotonic() + 20
        err = ""
        while "compiling" not in err and time.monotonic() < deadline:
            time.sleep(0.05)
            err += capsys.readouterr().err
    assert "compiling kernels for 'stranger' (each once, when first needed) 1/1" in err


@pytest.mark.parametrize("kind", ["cam", "geneva", "indexer", "linkage", "seedling-pusher", "shaft", "silent-chain"])
def test_every_kind_has_been_measured(kind):
    kernels = tomllib.loads(USUAL.read_text())[kind]
    assert registry.mechanism(kind) and usual_seconds(kind) == kernels
    assert all(0 <= each < 60 for seconds in kernels.values() for each in seconds) and (kernels or kind in ("cam", "geneva"))


def test_a_kernel_with_two_signatures_counts_twice(clock, monkeypatch):
    monkeypatch.setattr(compilation, "usual_seconds", lambda kind: {"a": [2.0, 1.0], "b": [4.0]})
    said = told(clock, "press", ("a", BEGUN, 0), ("a", DONE, 2), ("a", FOUND, 0), ("b", BEGUN, 0))
    assert [words for words, _ in said] == [
        "compiling kernels for 'press' (each once, when first needed) 1/3, about 7 s left",
        "",
        "compiling kernels for 'press' (each once, when first needed) 2/2, about 4 s left",
    ]


KERNELS = """
import drivewright as dw
from drivewright._jit.compilation import watched_by

@dw.kernel
def twice(x):
    return 2 * x

with watched_by(print):
    print(twice(2.0), twice(3.0), twice(1))
"""


def test_a_kernel_is_begun_and_done_once_and_found_after_that(tmp_path):
    script = tmp_path / "kernels.py"
    script.write_text(KERNELS)
    env = os.environ | {"XDG_CACHE_HOME": str(tmp_path / "cache"), "PYTHONPATH": str(tmp_path)}
    said = [
        subprocess.run([sys.executable, "-c", "import kernels"], capture_output=True, text=True, timeout=300, env=env, check=True).stdout
        for _ in range(2)
    ]
    assert said[0].splitlines() == [*["kernels.twice begun", "kernels.twice done"] * 2, "4.0 6.0 2"]
    assert said[1].splitlines() == [*["kernels.twice found"] * 2, "4.0 6.0 2"]


@pytest.mark.slow
def test_a_first_run_says_so_and_a_second_one_does_not(tmp_path):
    """Of the kind that compiles least among those whose first kernel is worth a line wherever it is compiled."""
    spec, out = str(EXAMPLES / "seedling_pusher.toml"), str(tmp_path / "out")
    command = [sys.executable, "-m", "drivewright", "run", spec, "--no-figures", "--out", out]
    env = os.environ | {"XDG_CACHE_HOME": str(tmp_path / "cache")}
    said = [subprocess.run(command, capture_output=True, text=True, timeout=300, env=env, check=True).stderr for _ in range(2)]
    assert "compiling kernels for 'seedling-pusher' (each once, when first needed) 1/" in said[0]
    assert "compiling" not in said[1]
