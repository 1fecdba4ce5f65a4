"""The stretch of a run that is drawn: the last whole turn, a whole run without turns, or the start; and how finely it is sampled."""

from types import SimpleNamespace

import numpy as np
import pytest

from drivewright.multibody.analyses import cycle_poses as module
from drivewright.multibody.analyses.cycle_poses import FINE, FRAMES, FREE_FRAMES, cycle_poses

pytestmark = pytest.mark.property


@pytest.fixture
def runs(monkeypatch):
    """[(end, samples)] of the simulations that are asked for."""
    asked = []

    def simulate(assembly, end, settings, samples):
        asked.append((end, samples))
        return "run"

    monkeypatch.setattr(module, "simulate", simulate)
    return asked


def model(period, **more):
    given = {"period": period, "assembly": SimpleNamespace(freedom=1), "settings": None, "duration": 1.0, "has_play": False}
    return SimpleNamespace(**{**given, **more})


@pytest.mark.parametrize(
    ("end", "stretch"),
    [
        (0.5, (0.0, 0.5)),
        (1.3, (0.5, 1.0)),  # of the turn that has begun nothing is drawn
        (2.0, (1.5, 2.0)),
        (2.0 - 1e-12, (1.5, 2.0 - 1e-12)),  # a run that ends a rounding short of its turn has it all the same, and no sample beyond
    ],
)
@pytest.mark.parametrize("fine", [1, FINE])
def test_the_last_whole_turn_is_drawn(runs, end, stretch, fine):
    start, last, run = module._sampled(model(0.5), end, fine)
    assert (start, last) == pytest.approx(stretch, abs=1e-15) and run == "run" and last <= end
    ((until, samples),) = runs
    assert until == last and len(samples) == fine * (FRAMES - 1) + 1
    assert samples[[0, -1]] == pytest.approx(stretch) and np.ptp(np.diff(samples)) < 1e-12


@pytest.mark.parametrize(("period", "end"), [(0.0, 3.0), (0.5, 0.4)])
def test_a_run_without_a_whole_turn_is_drawn_from_its_start_with_more_frames(runs, period, end):
    assert module._sampled(model(period), end, 2)[:2] == (0.0, end)
    assert runs[0][1][[0, -1]] == pytest.approx([0, end]) and len(runs[0][1]) == 2 * (FREE_FRAMES - 1) + 1


def test_a_run_that_stops_at_once_is_none(runs):
    assert module._sampled(model(0.0), 0.0, 1) == (0.0, 0.0, None) and not runs


@pytest.mark.parametrize("has_play", [False, True])
def test_without_a_run_two_frames_are_the_start(monkeypatch, has_play):
    pose = np.array([[0.1, 0.2, 0.3]])
    monkeypatch.setattr(module, "start_poses", lambda model: {"arm": pose})
    still = cycle_poses(model(0.5, duration=None, has_play=has_play))
    assert still.period == 0 and still.frames("arm") == pytest.approx(np.repeat(pose, 2, axis=0))
    assert len(still.poses["arm"]) == still.fine + 1 and len(still.cycle) == 2
