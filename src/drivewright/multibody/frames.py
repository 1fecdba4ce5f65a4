"""Kernels: vectors of a body's frame, relative motion of two bodies' points, and forces on bodies."""

from drivewright._jit import inner
from drivewright.multibody.records import OneRecord, Records


@inner
def rotated(pose: OneRecord, x: float, y: float) -> tuple[float, float]:
    """A vector of the body's frame in the directions of the world."""
    return pose.c * x - pose.s * y, pose.s * x + pose.c * y


@inner
def relative_motion(poses: Records, pair: OneRecord) -> tuple[float, float, float, float, float, float, float, float]:
    """Point of body i minus point of body j [m], its rate [m/s], and the arms of both points [m], all in the world's axes."""
    one, two = poses[pair.i], poses[pair.j]
    px, py = rotated(one, pair.ax, pair.ay)
    qx, qy = rotated(two, pair.bx, pair.by)
    dx, dy = one.x + px - two.x - qx, one.y + py - two.y - qy
    vx, vy = one.vx - one.w * py - two.vx + two.w * qy, one.vy + one.w * px - two.vy - two.w * qx
    return dx, dy, vx, vy, px, py, qx, qy


@inner
def apply_force(pose: OneRecord, px: float, py: float, fx: float, fy: float) -> None:
    """Apply a force [N] at the arm (px, py) [m] of a body."""
    pose.fx += fx
    pose.fy += fy
    pose.ft += px * fy - py * fx


@inner
def apply_torque_pair(poses: Records, pair: OneRecord, torque: float) -> None:
    """Apply a torque [N m] to body i and its opposite to body j.  poses (bodies,) of POSE."""
    poses[pair.i].ft += torque
    poses[pair.j].ft -= torque
