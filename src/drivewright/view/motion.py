"""Poses (x, y, angle) seen by an observer, and between two frames of a cycle."""

import numpy as np

from drivewright._typing import ArrayLike, Floats
from drivewright.scene import Frame, Point


def seen_from(poses: ArrayLike, observer: ArrayLike) -> Floats:
    """Poses (n, 3) of a body in the frame of an observer with poses (n, 3):  R(-t_o) (p - p_o), t - t_o."""
    observer = np.asarray(observer, float)
    dx, dy, turn = (np.asarray(poses, float) - observer).T
    c, s = np.cos(observer[:, 2]), np.sin(observer[:, 2])
    return np.stack([c * dx + s * dy, c * dy - s * dx, turn], axis=1)


def path(point: Point, poses: Floats) -> Floats:
    """Path (n, 2) of a body's own point (x, y) through its poses (n, 3)."""
    x, y = point
    c, s = np.cos(poses[:, 2]), np.sin(poses[:, 2])
    return np.stack([poses[:, 0] + c * x - s * y, poses[:, 1] + s * x + c * y], axis=1)


def step_back(frame: Frame) -> Floats:
    """How far the traces of the cycle before lie from this one's, for an observer that travels on by `advance` each cycle.

    The observer's own heading is taken from its first frame.
    """
    (x, y), angle = frame.advance, frame.poses[0, 2]
    return np.array([np.cos(angle) * x + np.sin(angle) * y, np.cos(angle) * y - np.sin(angle) * x])


def fractions(cycle: ArrayLike) -> Floats:
    """The driving quantity as 0 ... 1 over the cycle, whichever way it runs."""
    cycle = np.asarray(cycle, float)
    return (cycle - cycle[0]) / (cycle[-1] - cycle[0])


def pose_at(poses: Floats, cycle: ArrayLike, phase: float) -> Floats:
    """Pose (3,) at a phase 0 ... 1 of the cycle, between the frames by straight interpolation of the continuous angle."""
    continuous = np.column_stack([poses[:, :2], np.unwrap(poses[:, 2])])
    return np.array([np.interp(phase, fractions(cycle), column) for column in continuous.T])
