"""Observers and paths against composition of rigid motions by complex numbers."""

import numpy as np
import pytest

from drivewright.scene import Frame, place
from drivewright.view.motion import fractions, path, pose_at, seen_from, step_back

pytestmark = pytest.mark.analytical

RNG = np.random.default_rng(7)
POSES, EYES = RNG.uniform(-2, 2, (2, 40, 3))
POINT = (0.3, -0.7)


def as_complex(xy):
    return np.asarray(xy)[..., 0] + 1j * np.asarray(xy)[..., 1]


def test_a_point_seen_by_an_observer():
    world = as_complex(POSES) + np.exp(1j * POSES[:, 2]) * complex(*POINT)
    expected = np.exp(-1j * EYES[:, 2]) * (world - as_complex(EYES))
    assert as_complex(path(POINT, seen_from(POSES, EYES))) == pytest.approx(expected, abs=1e-12)


def test_an_observer_sees_itself_at_rest_and_the_world_frame_changes_nothing():
    assert seen_from(EYES, EYES) == pytest.approx(np.zeros_like(EYES), abs=1e-15)
    assert seen_from(POSES, np.zeros_like(POSES)) == pytest.approx(POSES)


def test_path_agrees_with_place():
    for row in POSES[:5]:
        assert path(POINT, row[None])[0] == pytest.approx(place([POINT], row)[0])


def test_fractions_run_from_0_to_1_either_way():
    cycle = np.array([0.3, 0.5, 1.3])
    assert fractions(cycle) == pytest.approx([0, 0.2, 1])
    assert fractions(-cycle) == pytest.approx([0, 0.2, 1])


def test_pose_between_frames_goes_the_short_way_round():
    cycle = np.array([0.0, 1.0, 3.0])
    poses = np.array([[0, 0, 3.0], [1, 2, -3.0], [3, 2, -2.0]])
    assert pose_at(poses, cycle, 1 / 6) == pytest.approx([0.5, 1.0, np.pi])  # half way from 3.0 to 2 pi - 3.0
    assert pose_at(poses, cycle, 2 / 3) == pytest.approx([2, 2, 2 * np.pi - 2.5])
    assert pose_at(poses, cycle, 1.0) == pytest.approx([3, 2, 2 * np.pi - 2.0])


def test_the_cycle_before_lies_back_by_the_advance():
    """A point at rest in the world, seen by an observer that travels on: cycle n sees it n advances further back."""
    heading, advance = 0.4, np.array([0.14, 0.03])
    eye = np.array([[0.2, 0.1, heading]])
    frame = Frame("field", "field", eye, tuple(advance))
    still = np.array([[1.0, 2.0, 0.0]])
    now = seen_from(still, eye)
    before = seen_from(still, eye - [[*advance, 0.0]])
    assert (before - now)[0, :2] == pytest.approx(step_back(frame))
