"""The indexer once more: its parts as solids of finite elements, the profile by polygons, the stiffness by its closed form.

Rows are tuples (name, ours, other, unit, allowed difference, route) in SI.
"""

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from drivewright._typing import Floats
from drivewright.indexing import roller_gear, solid
from drivewright.indexing.motion import TURN
from drivewright.indexing.plane import PlaneDrive, find_contacts, pitch_point
from drivewright.indexing.roller_gear import RollerGear
from drivewright.indexing.roller_gear.envelope import rotate_about_y
from drivewright.indexing.stiffness.loading import solve_loaded
from drivewright.indexing.stiffness.roller_contacts import RollerContacts
from drivewright.indexing.stiffness.roller_drive import RollerDrive
from drivewright.indexing.stiffness.roller_loading import solve_rollers
from drivewright.mechanisms.indexer.build import IndexerModel
from drivewright.mechanisms.indexer.shared_load import loaded_rollers
from drivewright.registry import Row
from drivewright.result import Result

POLYGON = "centre curve widened by the pin, as a polygon"
SWEPT = "distance of points of the flanks from the axes of all rollers at 2880 input angles"
TANGENT = "unit normals through the instant centre"
SOLID = "cams, shafts and wheel as solids of second-order elements"
BALANCE = "turn at which the forces of all contacts balance the torque, by bisection; shafts and bearings rigid"
CHORDS = 1200  # of the centre curve, in a turn
ANGLES = (0.25, 0.5, 0.75)  # of the index period
HALVINGS, LARGEST_TURN = 60, 0.1  # of the bisection, rad
ALLOWED = 0.3  # the solids yield more than beams and rigid cams; beyond this the reduced model is not good enough


def verify(model: IndexerModel, result: Result[Any]) -> Iterator[Row]:
    """Rows (name, ours, other, unit, allowed difference, route) of every independent route."""
    if model.spec.kind in ("barrel", "globoidal"):
        yield from _flanks(model.cam)
    else:
        for number, level in enumerate(model.plane.levels):
            yield from _profile(level, "" if not number else ".second")
            yield from _normals(level, model.angles)
    if model.translating and model.spec.load.torque and result.values["stiffness.undefined_fraction"].value < 1:
        yield from _solids(model)
    elif not model.translating and model.spec.load.torque:
        yield from _balances(model)


def _profile(drive: PlaneDrive, suffix: str) -> Iterator[Row]:
    """Area and perimeter of the cam as what the widened centre curve leaves."""
    from shapely import LineString, MultiLineString, Point, Polygon

    theta = np.linspace(0, TURN, CHORDS, endpoint=False)
    paths, kinds = drive.pin_paths(theta).d0.T, drive.pins_passed  # where a step passes several pins, each runs along a curve of its own
    loops = [np.append(paths[kind::kinds].ravel(), paths[kind, 0]) for kind in range(kinds)]
    curve = MultiLineString([LineString(np.stack([np.real(loop), np.imag(loop)], axis=1)) for loop in loops])
    swept = curve.buffer(drive.pin_radius, quad_segs=128)
    if drive.side == "inside":
        left = next(ring for ring in swept.interiors if Polygon(ring).contains(Point(0, 0)))
    else:
        left = swept.exterior
    area = Polygon(left).area
    ours = drive.profile
    yield f"profile{suffix}.area", ours.area, area, "m^2", 1e-4 * ours.area, POLYGON
    yield f"profile{suffix}.perimeter", ours.perimeter, left.length, "m", 2e-3 * ours.perimeter, POLYGON


def _normals(drive: PlaneDrive, angles: Floats) -> Iterator[Row]:
    """Every normal found on the profile passes through the pitch point: the largest distance of one."""
    far = 0.0
    for angle in angles:
        pitch = complex(pitch_point(drive, angle))
        if np.isfinite(pitch) and abs(pitch) < 10 * drive.circle_radius:
            contacts = find_contacts(drive, angle)
            live = contacts.intended
            far = max(far, float(np.max(np.abs(np.imag(np.conj(contacts.normal[live]) * (pitch - contacts.centre[live]))), initial=0.0)))
    yield "distance of the normals from the pitch point", far, 0.0, "m", 1e-7, TANGENT


def _flanks(cam: RollerGear, count: int = 200) -> Iterator[Row]:
    """Points of the finished flanks that some roller touches and none enters: least distance from any roller's skin."""
    flanks = roller_gear.compute_flanks(cam)
    points = flanks.contact.point[flanks.on_cam]
    points = points[np.linspace(0, len(points) - 1, count).astype(int)]
    theta = np.linspace(0, TURN, 2880, endpoint=False)
    angle = cam.hand_sign * theta[:, None]
    least = np.full(count, np.inf)
    at = rotate_about_y(points[None], angle) + (cam.centre_distance, 0.0, cam.height)
    for roller in cam.rollers:
        psi = cam.motion(theta).d0 + cam.pin_pitch * (cam.phase + roller)
        along, across = np.exp(1j * psi)[:, None], at[..., 0] + 1j * at[..., 1]
        local = across / along - cam.pin_circle_radius  # radially from the middle of the roller, and sideways
        u, sideways, height = (local.real, local.imag, at[..., 2]) if cam.kind == "globoidal" else (at[..., 2], local.imag, local.real)
        gap = np.hypot(sideways, height) - cam.roller_radius
        least = np.fmin(least, np.where(np.abs(u) <= 0.5 * cam.roller_length * (1 + 1e-9), gap, np.inf).min(axis=0))
    yield "least gap between flanks and rollers", 0.0, float(least.min()), "m", 2e-7, SWEPT
    yield "greatest of the least gaps of a point", 0.0, float(least.max()), "m", 2e-6, SWEPT


def _balances(model: IndexerModel) -> Iterator[Row]:
    """Torsional stiffness of the contacts alone, without interference, at three angles."""
    loaded = loaded_rollers(model)
    yields = RollerDrive(loaded.yields.radius, loaded.yields.series)
    angles = model.angles if len(model.angles) == 1 else model.drive.motion.motion_angle * np.array(ANGLES)
    found, contacts = solve_rollers(loaded._replace(yields=yields, model="unilateral"), angles, model.torque)
    for angle, here, secant in zip(angles, contacts, found.secant, strict=True):
        if np.isfinite(secant):
            other = model.torque / _balanced_turn(here, model.torque, yields.series)
            name = f"stiffness of the contacts at {np.degrees(angle):.4g} deg"
            yield name, float(secant), other, "N m/rad", 1e-6 * float(secant), BALANCE


def _balanced_turn(contacts: RollerContacts, torque: float, series: float | None) -> float:
    """Rotation [rad] of the wheel; the line contact is Palmgren's, F = 8.06e10 L^(8/9) d^(10/9) in SI."""
    line, softness = 8.06e10 * contacts.length ** (8 / 9), 0.0 if series is None else 1 / series

    def force(approach: float, k: int) -> float:
        most = line[k] * max(approach, 0.0) ** (10 / 9)
        return most if not softness else _bisected(lambda pull: (pull / line[k]) ** 0.9 + pull * softness - approach, 0.0, most)

    way = float(np.sign(torque))

    def excess(turn: float) -> float:
        pressed = -contacts.arm * turn * way - contacts.gap
        return -way * sum(float(arm) * force(float(depth), k) for k, (arm, depth) in enumerate(zip(contacts.arm, pressed, strict=True)))

    return way * _bisected(lambda turn: excess(turn) - abs(torque), 0.0, LARGEST_TURN)


def _bisected(rising: Callable[[float], float], low: float, high: float) -> float:
    """Where a rising function is 0, to the last digits."""
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if rising(middle) < 0 else (low, middle)
    return 0.5 * (low + high)


def _solids(model: IndexerModel) -> Iterator[Row]:
    """Torsional stiffness at three angles, the contact state and the forces of the bearings those of the solids."""
    parts, train = model.solids, model.train
    if train is None or not any(parts):
        return
    angles = model.angles if len(model.angles) == 1 else model.wheel.motion.motion_angle * np.array(ANGLES)
    reduced, near = solve_loaded(model.loaded_wheel, angles, model.torque)
    train = train._replace(shaft=solid.seated(train.shaft, parts.shaft))
    elastic = solid.solid_stiffness(
        model.wheel, train, parts, angles, near, model.torque, cams=model.spec.cams, model=model.spec.contact.model
    )
    for angle, ours, other in zip(angles, reduced.secant, elastic.secant, strict=True):
        if np.isfinite(other) and np.isfinite(ours):
            yield f"stiffness at {np.degrees(angle):.4g} deg", float(ours), float(other), "N m/rad", ALLOWED * ours, SOLID
