"""Kernels that a second process compiles meanwhile: those that the run comes to, and no process where none is of use."""

import subprocess
import sys
from dataclasses import replace
from functools import partial

import pytest
from places import EXAMPLES

from drivewright import load, registry
from drivewright._jit import compilation
from drivewright.execution import helper
from drivewright.execution.helper import compiling_ahead

pytestmark = pytest.mark.interface

RUN = """
import importlib, sys
from drivewright import load, registry, run
spec = load(sys.argv[1], {changes!r})
kernels = [getattr(importlib.import_module("drivewright." + name.rpartition(".")[0]), name.rpartition(".")[2]) for name in {names!r}]
for compile_kernel in registry.mechanism(spec.mechanism).compile_ahead(spec):
    compile_kernel()
ahead = [len(kernel.signatures) for kernel in kernels]
run(spec, {only!r})
print(ahead, [len(kernel.signatures) for kernel in kernels])
"""


KINEMATICS = ["multibody.continuation.continue_through", "multibody.chart.solve_kinematics"]


@pytest.mark.parametrize(
    ("example", "names", "only", "changes"),
    [
        ("four_bar", ["multibody.tolerance.scatter", *KINEMATICS, "multibody.observe.observe_all"], ("motion", "tolerances"), ()),
        (
            "slider_crank_clearance",
            [*KINEMATICS, "multibody.observe.observe_all", "multibody.observe.observe_pins", "numerics.ode.advancing.advance"],
            ("motion", "impact"),
            ("simulate.turns=2", "simulate.discard=0", "simulate.ensemble=1"),
        ),
        ("hyvo_chain", ["chains.explicit.advance.run"], ("dynamics",), ("dynamics.ensemble=1",)),
    ],
)
def test_what_is_compiled_ahead_is_what_the_run_asks_for(example, names, only, changes):
    code = RUN.format(changes=changes, names=names, only=only)
    run = subprocess.run(
        [sys.executable, "-c", code, EXAMPLES / f"{example}.toml"], capture_output=True, text=True, timeout=300, check=True
    )
    assert run.stdout.splitlines()[-1] == f"{[1] * len(names)} {[1] * len(names)}"


@pytest.fixture
def begun(monkeypatch):
    """What became of the processes that were started."""
    seen = []

    class Process:
        def __init__(self, prepare):
            seen.append(prepare.args[0].mechanism)

        def close(self):
            seen.append("closed")

    monkeypatch.setattr("drivewright.execution.executors.ProcessExecutor", Process)
    monkeypatch.setattr(helper, "worker_count", lambda workers: 2)
    monkeypatch.setattr(helper, "is_first_run", lambda: False)
    return seen


def test_meanwhile_this_process_compiles_what_comes_last(begun, monkeypatch):
    """One kernel at each look at what another process compiles, from the end, and none twice."""
    done, kind = [], registry.mechanism("linkage")
    kernels = [partial(done.append, name) for name in ("first", "second", "third")]
    monkeypatch.setattr(helper.registry, "mechanism", lambda name: replace(kind, compile_ahead=lambda spec: kernels))
    with compiling_ahead(load(EXAMPLES / "four_bar.toml")):
        assert compilation.work_meanwhile() and done == ["third"]
        assert [compilation.work_meanwhile() for _ in range(3)] == [True, True, False]
    assert done == ["third", "second", "first"] and not compilation.work_meanwhile()


def test_a_process_is_started_once_and_only_where_something_is_compiled(begun):
    with compiling_ahead(load(EXAMPLES / "four_bar.toml")):
        compilation.tell("one", compilation.FOUND)
        assert begun == []
        for kernel in ("two", "three"):
            compilation.tell(kernel, compilation.BEGUN)
        assert begun == ["linkage"]
    assert begun == ["linkage", "closed"]
    compilation.tell("four", compilation.BEGUN)
    assert len(begun) == 2


def test_in_a_first_run_it_is_started_at_once(begun, monkeypatch):
    monkeypatch.setattr(helper, "is_first_run", lambda: True)
    with compiling_ahead(load(EXAMPLES / "four_bar.toml")):
        assert begun == ["linkage"]


def test_one_core_and_kinds_that_compile_little_have_none(begun, monkeypatch):
    with compiling_ahead(load(EXAMPLES / "disc_cam.toml")):
        compilation.tell("one", compilation.BEGUN)
    monkeypatch.setattr(helper, "worker_count", lambda workers: 1)
    with compiling_ahead(load(EXAMPLES / "four_bar.toml")):
        compilation.tell("one", compilation.BEGUN)
    assert begun == []


def test_a_process_that_cannot_start_is_done_without(begun, monkeypatch):
    def refuse(prepare):
        begun.append("refused")
        raise BrokenPipeError("as where the system's own helper has died")

    monkeypatch.setattr("drivewright.execution.executors.ProcessExecutor", refuse)
    with compiling_ahead(load(EXAMPLES / "four_bar.toml")):
        compilation.tell("one", compilation.BEGUN)
        compilation.tell("two", compilation.BEGUN)
    with helper.helping_hand(print) as compute:
        assert compute is map
    assert begun == ["refused", "refused"]


def test_kernels_that_are_not_kept_are_compiled_by_nobody_else(begun, monkeypatch):
    monkeypatch.setattr(helper, "is_kept", lambda: False)
    with compiling_ahead(load(EXAMPLES / "four_bar.toml")):
        compilation.tell("one", compilation.BEGUN)
    assert begun == []
