"""Free rotation of the turret of a roller-gear drive, by its own test: points of the finished cam against the rollers."""

import numpy as np

from drivewright._typing import ArrayLike, Bools, Floats
from drivewright.indexing.roller_gear.design import RollerGear
from drivewright.indexing.roller_gear.envelope import rotate_about_y
from drivewright.indexing.roller_gear.flanks import CamFlanks, find_trim_edges

CLOSE = 1e-7  # rad; rounding of a touching point
TOUCHING = 1e-12  # rad; a smaller rotation is rounding


def find_turret_play(flanks: CamFlanks, direction: float, theta: ArrayLike | None = None) -> Floats:
    """Rotation (theta,) [rad] that the turret can make in a direction (+1 forward, -1 backward) from its ideal place to the first contact.

    theta: angles of the cam, those of `flanks` where not given, whose contact points are among the points tested.  inf where nothing stops
    the turret.  Contact of the cam with the ends of the rollers is left out.  Between the points of the table the cam is not seen,
    so that the result is too large by the second order of its step.
    """
    theta = flanks.theta if theta is None else np.atleast_1d(np.asarray(theta, dtype=float))
    points = np.concatenate([flanks.contact.point[flanks.on_cam], find_trim_edges(flanks)])
    return np.array([_free(flanks.cam, points, angle, direction) for angle in theta])


def _free(cam: RollerGear, points: Floats, theta: float, direction: float) -> float:
    x, y, z = np.moveaxis(rotate_about_y(points, cam.hand_sign * theta), -1, 0)
    x, z = x + cam.centre_distance, z + cam.height
    away = np.hypot(x, y)
    reach, reached = _half_angle(cam, away, z)
    psi = cam.motion(theta).d0 + cam.pin_pitch * cam.phase
    ahead = direction * (np.arctan2(y, x) - psi) - reach
    free = np.mod(ahead + CLOSE, cam.pin_pitch) - CLOSE
    least = float(np.min(free[reached & (x > 0)], initial=np.inf))
    return least if least > TOUCHING else 0.0


def _half_angle(cam: RollerGear, away: Floats, z: Floats) -> tuple[Floats, Bools]:
    """Angle between a roller and a point, both seen from the turret's axis, at which the point is on the roller; False where none is."""
    radius, roller, half = cam.pin_circle_radius, cam.roller_radius, cam.roller_length / 2
    if cam.kind == "barrel":
        cosine = (away**2 + radius**2 - roller**2) / (2 * away * radius)
        return np.arccos(np.clip(cosine, -1, 1)), (np.abs(cosine) <= 1) & (np.abs(z) <= half)
    sine = np.sqrt(np.maximum(roller**2 - z**2, 0.0)) / away
    along = np.sqrt(np.maximum(away**2 - roller**2 + z**2, 0.0)) - radius
    return np.arcsin(np.clip(sine, 0, 1)), (np.abs(z) <= roller) & (sine <= 1) & (np.abs(along) <= half * (1 + 1e-12))
