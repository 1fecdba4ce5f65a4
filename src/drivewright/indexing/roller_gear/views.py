"""Planar pictures of a roller-gear cam: its surface unrolled, and its section in the plane through its axis that meets the rollers."""

from typing import Any, NamedTuple

import numpy as np

from drivewright._typing import ArrayLike, Floats
from drivewright.errors import InputError
from drivewright.indexing.motion import TURN
from drivewright.indexing.roller_gear.design import RollerGear, roller_travel
from drivewright.indexing.roller_gear.envelope import flank_contact, rotate_about_y
from drivewright.indexing.roller_gear.trimming import FRONT

STEPS = 361  # points on a turn of a groove


class DevelopedSurface(NamedTuple):
    """The pitch surface unrolled: x = pitch_radius times the cam's angle, y along the path of the rollers [m].

    ribs: closed polygons (n, 2) of the material.  At the cam angle theta the ribs are shifted by -pitch_radius theta and the rollers are
    circles of roller_radius about `centres(theta)`; neighbours turns apart are the same rib.
    """

    ribs: tuple[Floats, ...]
    pitch_radius: float


def develop_surface(cam: RollerGear, start: float = -0.5, stop: float = 1.5) -> DevelopedSurface:
    """Developed surface of a cam from the turn `start` to the turn `stop` of its angle."""
    from shapely import Polygon, box, union_all

    if not start < stop:
        raise InputError(f"developed view: from turn {start} to turn {stop}; the first must be below the second.")
    half = developed_height(cam, cam.cam_length / 2)
    strip = box(start * TURN * cam.pitch_radius, -half, stop * TURN * cam.pitch_radius, half)
    first, last = groove_turns(cam)
    shifts = range(int(np.floor(start)) - last - 2, int(np.ceil(stop)) - first + 3)
    unrolled = [_unrolled_groove(cam, number) for number in range(cam.starts)]
    grooves = [Polygon(groove + (TURN * cam.pitch_radius * k, 0.0)).buffer(0) for groove in unrolled for k in shifts]
    return DevelopedSurface(_polygons(strip.difference(union_all(grooves))), cam.pitch_radius)


def developed_roller_centres(cam: RollerGear, theta: ArrayLike) -> Floats:
    """Centres (roller, theta, 2) [m] of the rollers in the developed view, the cam's rollers in order of psi."""
    psi = roller_angles(cam, np.atleast_1d(theta))
    if cam.kind == "globoidal":
        return np.stack([np.zeros_like(psi), cam.pin_circle_radius * psi], axis=-1)
    across = cam.hand_sign * (cam.pin_circle_radius * np.cos(psi) - cam.centre_distance)
    return np.stack([across, cam.pin_circle_radius * np.sin(psi)], axis=-1)


def roller_angles(cam: RollerGear, theta: ArrayLike) -> Floats:
    """Angles [rad] (roller, theta) of the cam's rollers on the turret from the line of centres; (roller,) at a single theta."""
    psi = _psi(cam, *roller_travel(cam, np.atleast_1d(theta), cam.rollers))
    return psi if np.ndim(theta) else psi[:, 0]


def axial_section(cam: RollerGear, theta: float) -> tuple[Floats, ...]:
    """Closed polygons (n, 2) [m], (y along the axis, distance from it), of the half of the cam that faces the rollers at the angle theta.

    The plane holds the cam's axis; of a globoidal cam it is the plane of the rollers' axes, of a barrel it is parallel to them.
    """
    from shapely import Polygon, union_all

    grooves = [Polygon(_groove(cam, theta, roller)).buffer(0) for roller in cam.rollers]
    return _polygons(Polygon(blank_section(cam)).difference(union_all(grooves)))


def blank_section(cam: RollerGear, count: int = 65) -> Floats:
    """Half-section (n, 2) [m] of the turned blank, (y along the axis, distance from it), counter-clockwise from the axis."""
    end, foot = cam.cam_length / 2, cam.roller_length / 2
    y = np.linspace(end, -end, count)
    if cam.kind == "barrel":
        top = np.array([[end, cam.height + foot], [-end, cam.height + foot]])
    else:
        top = np.column_stack([y, cam.centre_distance - np.sqrt((cam.pin_circle_radius - foot) ** 2 - y**2)])
    return np.concatenate([[[-end, 0.0], [end, 0.0]], top])


def groove_turns(cam: RollerGear) -> tuple[int, int]:
    """First and last turn of the travel in which a roller of some start is near the cam."""
    return min(cam.rollers) // cam.starts, max(cam.rollers) // cam.starts


def groove_travel_range(cam: RollerGear) -> tuple[float, float]:
    """(start, stop) [rad] of the travel in which a roller is near the cam: the whole turns of the rollers that meet it."""
    first, last = groove_turns(cam)
    return TURN * first, TURN * (last + 1)


def groove_floor(cam: RollerGear) -> float:
    """u [m] of the floor of the grooves: the tips clear it by a twentieth of their radius.  It is as flat as the tip of a roller."""
    return cam.roller_length / 2 + cam.roller_radius / 20


def groove_mouth(cam: RollerGear) -> float:
    """u [m] at which a groove is clear of the blank, below the feet of the rollers."""
    foot = cam.pin_circle_radius - cam.roller_length / 2
    sagitta = foot - np.sqrt(max(foot**2 - cam.roller_radius**2, 0.0)) if cam.kind == "globoidal" else 0.0
    return -cam.roller_length / 2 - sagitta - cam.roller_radius / 20


def _psi(cam, travel, start):
    return cam.motion(travel).d0 + cam.pin_pitch * (cam.phase + start)


def developed_height(cam: RollerGear, axial: float) -> float:
    """Height in the developed view of the end of the cam."""
    return cam.pin_circle_radius * np.arcsin(axial / cam.pin_circle_radius) if cam.kind == "globoidal" else axial


def _lag(cam: RollerGear, point: Floats, travel: Floats) -> Floats:
    """Angle [rad] of the cam by which a point of its surface passes the reference plane later than at `travel`."""
    x, _, z = np.moveaxis(rotate_about_y(point, cam.hand_sign * travel), -1, 0)
    away = np.arctan2(z, -x) if cam.kind == "globoidal" else -np.arctan2(x, -z)
    return -cam.hand_sign * away


def _unrolled_groove(cam: RollerGear, start: int) -> Floats:
    """Closed polygon (n, 2) [m] of the groove of a start in the developed view."""
    first, last = groove_turns(cam)
    travel = np.linspace(*groove_travel_range(cam), (last - first + 1) * (STEPS - 1) + 1)
    travel = travel[np.abs(_psi(cam, travel, start)) < FRONT]
    shape = np.array([_unrolled(cam, travel, side, start) for side in (1.0, -1.0)])
    return np.concatenate([shape[0], shape[1, ::-1]])


def _unrolled(cam: RollerGear, travel: Floats, side: float, start: int) -> Floats:
    point = flank_contact(cam, travel, 0.0, side, start).point
    distance = cam.pitch_radius * (travel + _lag(cam, point, travel))
    away = np.hypot(point[:, 0], point[:, 2])
    chi = np.arctan2(point[:, 1], cam.centre_distance - away)
    return np.column_stack([distance, cam.pin_circle_radius * chi if cam.kind == "globoidal" else point[:, 1]])


def _groove(cam: RollerGear, theta: float, roller: int) -> Floats:
    """Section (n, 2) of the groove of a roller: down one wall, along the floor, up the other."""
    travel, start = (each[0] for each in roller_travel(cam, np.linspace(theta - 0.6, theta + 0.6, 121), [roller]))
    down, flat = np.linspace(groove_mouth(cam), groove_floor(cam), 17), np.linspace(1, -1, 9)[1:-1]
    u = np.concatenate([down, np.full(len(flat), groove_floor(cam)), down[::-1]])[:, None]
    side = np.concatenate([np.ones(len(down)), flat, -np.ones(len(down))])[:, None]  # from flank +1 through the axis to flank -1
    contact = flank_contact(cam, travel, u, 1.0, start)
    point = contact.point + (side[..., None] - 1) * cam.roller_radius * contact.normal
    passing = travel + _lag(cam, point, travel)
    at = theta + TURN * (roller // cam.starts)
    spots = np.stack([point[..., 1], np.hypot(point[..., 0], point[..., 2])], axis=-1)
    return np.array([[np.interp(at, when, where[:, i]) for i in (0, 1)] for when, where in zip(passing, spots, strict=True)])


def _polygons(shape: Any) -> tuple[Floats, ...]:
    parts = getattr(shape, "geoms", [shape])
    return tuple(np.array(part.exterior.coords)[:-1] for part in parts if part.area > 0)
