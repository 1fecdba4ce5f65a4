"""A worker that is killed at any moment of a sweep costs no case and changes none."""

import os
import signal
import threading
from multiprocessing import active_children

import pytest
from places import EXAMPLES

import drivewright as dw
from drivewright.studies.sweeps import sweep

pytestmark = pytest.mark.property

LEVELS = {"joint.rolling_radius": dw.linspace("1.0 mm", "1.6 mm", 300)}


def spec():
    return dw.load(EXAMPLES / "hyvo_chain.toml", ('study.analyses=["closure"]', 'closure.strands="straight"'))


def kill_one(killed):
    for child in active_children():
        if child.is_alive():
            os.kill(child.pid, signal.SIGKILL)
            killed.append(child.pid)
            return


def killed_after(folder, seconds):
    """The study of two workers of which one is killed, and whether it was."""
    killed = []
    timer = threading.Timer(seconds, kill_one, [killed])
    timer.start()
    study = sweep(spec(), LEVELS, out=folder, workers=2)
    timer.cancel()
    return study, bool(killed)


@pytest.fixture(scope="module")
def plain():
    return sweep(spec(), LEVELS, on="serial").table


def test_in_the_middle(tmp_path, plain):
    study, _ = killed_after(tmp_path / "S", 2.0)
    assert study.table.equals(plain) and study.counts == {"complete": 300}


@pytest.mark.slow
def test_at_any_moment(tmp_path, plain):
    killed = 0
    for moment in range(16):
        study, was_killed = killed_after(tmp_path / f"S{moment}", 0.1 + 0.3 * moment)
        assert study.table.equals(plain), f"killed after {0.1 + 0.3 * moment} s"
        killed += was_killed
    print("workers killed:", killed)
    assert killed > 5
