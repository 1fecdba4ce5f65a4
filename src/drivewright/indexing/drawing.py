"""Plate cams and their pins as shapes: outlines, poses over the input angle, common normals through the pitch point."""

from collections.abc import Iterator
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from drivewright._typing import ArrayLike, Bools, Complexes, Floats
from drivewright.curves import display_outline
from drivewright.indexing.motion import TURN
from drivewright.indexing.plane import PROFILE_TOLERANCE, PlaneDrive, envelope_points, pitch_point
from drivewright.scene import Body, Outline, Shape, circle, polygon

OUTLINE_TOLERANCE = 2e-6  # splines of the profile follow it to this [m]
SCREEN_TOLERANCE = 2e-5  # on screen it stays within this part of the pin circle's radius
_PROBE_DEPTH = 3  # times the tolerance on screen, at which a point is looked for in the cam
NORMAL_LENGTH = 1.4  # of a normal over the pin circle's radius


class PlacedCam(NamedTuple):
    """A cam on screen: the drive whose profile it has, and how far it is turned about the wheel's axis [rad]."""

    drive: PlaneDrive
    turned: float


def cam_poses(cam: PlacedCam, angle: Floats) -> Floats:
    """Pose of a cam at input angles."""
    place, turn = (np.broadcast_to(jet.d0, angle.shape) for jet in cam.drive.pose(angle))
    return poses(place * np.exp(1j * cam.turned), turn + cam.turned)


def poses(place: ArrayLike, angle: ArrayLike) -> Floats:
    """Poses (n, 3) [m, m, rad] of complex places [m] and angles [rad]."""
    return np.stack(np.broadcast_arrays(np.real(place), np.imag(place), angle), axis=1)


@lru_cache(maxsize=16)
def screen_outline(drive: PlaneDrive) -> Outline:
    """Outline of the trimmed profile, as fine as a picture needs."""
    drive.refuse()
    return display_outline(drive.family, SCREEN_TOLERANCE * drive.circle_radius)


def profile_outline(drive: PlaneDrive) -> Outline:
    """Exact outline of the trimmed profile."""
    return drive.profile.outline(OUTLINE_TOLERANCE)


def outer_radius(drive: PlaneDrive) -> float:
    """Outer edge of a cam around the pins [m]."""
    return edge_radius(drive, profile_outline(drive))


def edge_radius(drive: PlaneDrive, outline: Outline) -> float:
    """Outer edge [m] of a plate around an outline, two pin radii beyond it."""
    return float(np.max(np.hypot(*outline.points(1e-6).T))) + 2 * drive.pin_radius


def pin_centre_curves(drive: PlaneDrive, steps: int = 120) -> tuple[Floats, ...]:
    """Closed curves (n, 2) [m] of the pins' centres, seen from the cam: one for each pin that a step passes."""
    theta = np.linspace(0, TURN, steps, endpoint=False)
    paths, kinds = drive.pin_paths(theta).d0.T, drive.pins_passed
    curves = (paths[kind::kinds].ravel() for kind in range(kinds))
    return tuple(np.stack([np.real(points), np.imag(points)], axis=1) for points in curves)


def normal_bodies(drive: PlaneDrive, angle: Floats) -> Iterator[Body]:
    """The pitch point, and the common normal of every pin that touches a cam; a pin that does not shows the normal of another."""
    reach = 1.15 * max(drive.circle_radius, float(np.max(np.abs(drive.pose(angle)[0].d0))))
    pitch = pitch_point(drive, angle)
    turn = np.where(np.isfinite(pitch), pitch, drive.pose(angle)[0].d0)
    shown = np.where(np.abs(pitch) < reach, pitch, reach * turn / np.abs(turn))
    yield Body(
        "pitch_point",
        "pitch point (on the rim: beyond it)",
        (Shape("profile", circle((0, 0), 0.03 * drive.circle_radius)),),
        poses(shown, 0.0),
        "ground",
    )
    places, turns = normal_poses(drive, angle)
    line = polygon([(0.0, 0.0), (NORMAL_LENGTH * drive.circle_radius, 0.0)], closed=False)
    for pin in range(drive.pins):
        yield Body(f"normal{pin}", "common normals of cam 1", (Shape("axis", line),), poses(places[:, pin], turns[:, pin]), "ground")


def normal_poses(drive: PlaneDrive, angle: Floats) -> tuple[Floats, Floats]:
    """Foot and direction of the normal of every pin, towards the pitch point."""
    centre, turn = drive.pin_centres(angle).d0, np.broadcast_to(drive.pose(angle)[1].d0, angle.shape)[:, None]
    side = _touching_side(drive, angle)
    touched = side != 0
    towards_pin = -side * 1j * np.exp(1j * turn) * _unit(drive.pin_paths(angle).d1)
    pitch = pitch_point(drive, angle)[:, None]
    ahead = np.real(np.conj(towards_pin) * (np.where(np.isfinite(pitch), pitch, 0.0) - centre))
    normal = towards_pin * np.where(ahead >= 0, 1.0, -1.0)
    chosen = np.where(touched, np.arange(drive.pins), np.argmax(touched, axis=1)[:, None])
    rows, any_touch = np.arange(len(angle))[:, None], touched.any(axis=1)[:, None]
    return np.where(any_touch, centre[rows, chosen], 0.0), np.where(any_touch, np.angle(normal[rows, chosen]), 0.0)


def _touching_side(drive: PlaneDrive, angle: Floats) -> Floats:
    """+1 or -1 where a pin touches the cam on the left or right of its path, 0 where it does not; shape (angle, pins).

    Of the envelope's points of each pin those count with the cam behind them that no pin at any of the angles covers; the right one
    where both do.
    """
    from scipy.spatial import KDTree

    points, centre = envelope_points(drive, angle), drive.pin_paths(angle).d0
    depth = _PROBE_DEPTH * SCREEN_TOLERANCE * drive.circle_radius
    row, pin, side = np.nonzero(_in_cam(drive, points + depth * _unit(points - centre[..., None])))
    near = points[row, pin, side]
    tree = KDTree(np.stack([np.real(centre).ravel(), np.imag(centre).ravel()], axis=1))
    kept = np.isinf(tree.query(np.stack([near.real, near.imag], axis=1), distance_upper_bound=drive.pin_radius - PROFILE_TOLERANCE)[0])
    touching = np.zeros((*centre.shape, 2), dtype=bool)
    touching[row[kept], pin[kept], side[kept]] = True
    return np.where(touching[..., 1], -1.0, np.where(touching[..., 0], 1.0, 0.0))


def _in_cam(drive: PlaneDrive, points: Complexes) -> Bools:
    """Whether points seen from the cam, complex, lie in it; nan does not."""
    import shapely

    profile = shapely.polygons(screen_outline(drive).points())
    shapely.prepare(profile)
    return (shapely.contains_xy(profile, points.real, points.imag) == (drive.side == "inside")) & np.isfinite(points)


def _unit(z: Complexes) -> Complexes:
    with np.errstate(divide="ignore", invalid="ignore"):
        return z / np.abs(z)


def point_of(z: complex) -> tuple[float, float]:
    """(x, y) of a complex number."""
    return float(np.real(z)), float(np.imag(z))
