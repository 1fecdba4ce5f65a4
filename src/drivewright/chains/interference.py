"""Gaps between the plates of a chain and the real outline of a sprocket.

Sprocket frame: axis at the origin, a tooth on the y axis.  Gaps are negative where plate and tooth overlap.
"""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from drivewright._typing import ArrayLike, Floats
from drivewright.chains.closure import Closure, plates, states_at
from drivewright.chains.link import Link, seat_height
from drivewright.chains.plate import Plate
from drivewright.chains.sprocket import Sprocket
from drivewright.chains.tooth import Tooth
from drivewright.errors import counted
from drivewright.scene import Arc, Line, place

MOST_POINTS = 1_000_000  # along one outline
SPACING, TOLERANCE = 1e-2, 5e-5  # of the points of a plate and of the teeth, over the pitch, for the gaps of a whole drive


def folded(points: Floats, teeth: int) -> tuple[Floats, Floats]:
    """Points (..., 2) turned by whole teeth, and reflected, to the tooth on the y axis: radius, angle in [0, pi/z] from its centre line."""
    x, y = np.moveaxis(np.asarray(points, float), -1, 0)
    pitch = 2 * np.pi / teeth
    angle = np.arctan2(x, y)
    return np.hypot(x, y), np.abs(angle - pitch * np.round(angle / pitch))


def involute_gap(sprocket: Sprocket, points: Floats) -> Floats:
    """Exact distance [m] along the normal from the nearest tooth's involute to points (..., 2): rb (polar angle + inv - psi).

    nan below the base circle.  The foot is a real one while it lies between form and tip radius: see `foot_radius`.
    """
    radius, angle = folded(points, sprocket.tooth.teeth)
    base = sprocket.tooth.base_radius
    with np.errstate(invalid="ignore"):
        rest = np.sqrt(radius**2 - base**2) / base
    return base * (angle + rest - np.arctan(rest) - sprocket.half_angle)


def foot_radius(sprocket: Sprocket, points: Floats) -> Floats:
    """Radius [m] on which the foot of the normal through a point lies on the involute: one base tangent, shorter by the gap."""
    radius, _ = folded(points, sprocket.tooth.teeth)
    base = sprocket.tooth.base_radius
    with np.errstate(invalid="ignore"):
        return np.hypot(base, np.sqrt(radius**2 - base**2) - involute_gap(sprocket, points))


def profile_gap(sprocket: Sprocket, points: Floats, tolerance: float = 1e-8) -> Floats:
    """Signed distance [m] of points (n, 2) from the sprocket's whole outline, chamfer and root included, within `tolerance` [m].

    By symmetry the nearest point of the outline lies in the same half of the same tooth.
    """
    radius, angle = folded(points, sprocket.tooth.teeth)
    z = radius * np.exp(1j * (0.5 * np.pi - angle))
    profile = sprocket.half_profile(tolerance) @ (1, 1j)
    gaps = [_signed(profile, part) for part in np.array_split(z, max(1, len(z) // 2000))]
    return np.concatenate(gaps)


def _signed(profile, z):
    """Distance of complex points from a polyline, positive on its right-hand side; at a corner the side of the segment faced squarely."""
    start, along = profile[:-1], np.diff(profile)
    from_start = z[:, None] - start
    part = np.clip(np.real(np.conj(along) * from_start) / np.abs(along) ** 2, 0.0, 1.0)
    off = from_start - part * along
    distance = np.abs(off)
    side = np.imag(np.conj(along / np.abs(along)) * off)  # square distance, the larger the more squarely the segment is faced
    nearest = np.min(distance, axis=1)
    close = distance <= nearest[:, None] * (1 + 1e-9) + 1e-15
    chosen = np.argmax(np.where(close, np.abs(side), -1.0), axis=1)
    return -np.sign(side[np.arange(len(z)), chosen]) * nearest


def in_sprocket(points: Floats, pose: Floats, sprocket_angle: float = 0.0) -> Floats:
    """Points (n, 2) of a plate at a pose (x, y, angle) in the frame of a sprocket turned by sprocket_angle [rad]."""
    return place(place(points, pose), (0.0, 0.0, -sprocket_angle))


def seated_poses(link: Link, teeth: int, numbers: Sequence[int] | range, sprocket_angle: float = 0.0) -> Floats:
    """Poses (n, 3) of plates seated astride of the teeth with these numbers, clockwise from the tooth on the y axis."""
    turn = sprocket_angle - 2 * np.pi / teeth * np.asarray(numbers, float)
    h = seat_height(link, teeth)
    return np.stack([-h * np.sin(turn), h * np.cos(turn), turn], axis=1)


class FlankGap(NamedTuple):
    """Exact gap [m] of a straight flank to the involute it faces, along its normal; radius [m] of its foot on the
    involute, and height [m] of its foot on the flank in the pin frame."""

    gap: float
    radius: float
    height: float


def flank_gap(link: Link, tooth: Tooth, pose: Floats, side: str, sprocket_angle: float = 0.0) -> FlankGap:
    """`FlankGap` of an active flank ("left" or "right") of a plate at a pose (x, y, angle), by supports: the involute's less the plate's.

    Flank and involutes are taken as endless; of the involutes, one base pitch apart, the nearest is meant.  The contact is real where its
    radius lies between form and tip radius and its height on the flank.
    """
    x, y, turn = in_sprocket_pose(pose, sprocket_angle)
    x, turn = (x, turn) if side == "right" else (-x, -turn)
    a, base = link.flank_angle, tooth.base_radius
    normal = np.exp(1j * (turn - a))
    pitch = 2 * np.pi * base / tooth.teeth
    plate, involute = float(np.real((x + 1j * y) * np.conj(normal)) + link.flank_support), tooth.support + base * turn
    gap = (involute - plate + 0.5 * pitch) % pitch - 0.5 * pitch
    touch = (plate + gap + 1j * base) * normal
    on_flank = (touch - gap * normal - x - 1j * y) * np.exp(-1j * turn)
    return FlankGap(float(gap), float(abs(touch)), float(on_flank.imag))


def in_sprocket_pose(pose: Floats, sprocket_angle: float) -> tuple[float, float, float]:
    """A pose (x, y, angle) seen from the sprocket."""
    (x, y), turn = place(np.asarray(pose, float)[None, :2], (0.0, 0.0, -sprocket_angle))[0], pose[2] - sprocket_angle
    return x, y, turn


class PlateGap(NamedTuple):
    """Least signed gap [m] of a plate's whole outline to the sprocket, the place (x, y) in the pin frame and the piece of the outline."""

    gap: float
    point: tuple[float, float]
    piece: str


def plate_gaps(
    plate: Plate, sprocket: Sprocket, poses: ArrayLike, sprocket_angle: float = 0.0, spacing: float = 2e-5, tolerance: float = 1e-8
) -> tuple[PlateGap, ...]:
    """`PlateGap` of a plate at each of the poses (n, 3) about a sprocket with its axis at the origin; samples every `spacing` [m].

    Between samples the gap is smaller by spacing^2/(8 radius of the tooth's flank) at most where a straight piece touches.
    """
    names, points = sampled(plate.pieces, spacing)
    return tuple(_plate_gap(sprocket, names, points, in_sprocket(points, pose, sprocket_angle), tolerance) for pose in np.atleast_2d(poses))


def min_chain_gap(
    plate: Plate, sprocket: Sprocket, poses: Floats, sprocket_angle: float, spacing: float = 2e-5, tolerance: float = 1e-8
) -> float:
    """Least gap [m] of all plates of a chain at poses (n, 3) about a sprocket: those whose toes can reach it, and of plates that meet
    their teeth alike one."""
    p = plate.link.pitch
    distance, polar = np.hypot(poses[:, 0], poses[:, 1]), np.arctan2(poses[:, 1], poses[:, 0])
    tooth = np.mod(polar - sprocket_angle + 1e-6, 2 * np.pi / sprocket.tooth.teeth)
    alike = np.round(np.stack([distance / p, tooth, np.mod(poses[:, 2] - polar, 2 * np.pi)], axis=1), 7)
    different = np.unique(alike, axis=0, return_index=True)[1]
    near = poses[[row for row in different if distance[row] < sprocket.tip_radius + 1.5 * p]]
    return min(gap.gap for gap in plate_gaps(plate, sprocket, near, sprocket_angle, spacing, tolerance))


def min_drive_gaps(
    closure: Closure,
    plate: Plate,
    sprockets: Sequence[Sprocket],
    positions: int = 6,
    spacing: float = SPACING,
    tolerance: float = TOLERANCE,
) -> tuple[float, ...]:
    """Least gap [m] of all plates of a closed drive to each sprocket, at so many positions within a tooth of the driver.

    spacing, tolerance: of the points of a plate and of the teeth, over the pitch; a gap is known within `tolerance`, see `profile_gap`.
    """
    states = states_at(closure, np.linspace(0, 2 * np.pi / closure.drive.driver_teeth, positions, endpoint=False))
    poses, p = plates(closure, states), plate.link.pitch
    shafts = (np.zeros(positions), states.driver_angle), (states.centre_distance, states.driven_angle)
    return tuple(
        min(
            min_chain_gap(plate, sprocket, poses[k] - (centre[k], 0.0, 0.0), angle[k] - 0.5 * np.pi, spacing * p, tolerance * p)
            for k in range(positions)
        )
        for sprocket, (centre, angle) in zip(sprockets, shafts, strict=True)
    )


def _plate_gap(sprocket, names, points, here, tolerance):
    far = np.hypot(*here.T)
    lowest = profile_gap(sprocket, here[[np.argmin(far)]], tolerance)[0]
    near = np.flatnonzero(far - sprocket.tip_radius <= max(lowest, 0.0))  # no other point can have a smaller gap
    gaps = profile_gap(sprocket, here[near], tolerance)
    least = int(np.argmin(gaps))
    x, y = map(float, points[near[least]])
    return PlateGap(float(gaps[least]), (x, y), str(names[near[least]]))


def sampled(pieces: Mapping[str, Arc | Line], spacing: float) -> tuple[NDArray[np.str_], Floats]:
    """Names (n,) and points (n, 2) along named pieces, no further apart than `spacing` [m]."""
    names, points = [], []
    for name, piece in pieces.items():
        length = piece.radius * abs(piece.sweep) if isinstance(piece, Arc) else np.hypot(*np.subtract(piece.end, piece.start))
        counted(length / spacing, MOST_POINTS, f"points along the {name}", "place them further apart")
        course = piece.points(spacing * spacing / 8 / getattr(piece, "radius", np.inf))
        chords = [np.linspace(a, b, int(np.ceil(np.hypot(*(b - a)) / spacing)) + 1) for a, b in zip(course[:-1], course[1:], strict=True)]
        points += chords
        names += [name] * sum(map(len, chords))
    return np.array(names), np.concatenate(points)


def overlap_area(plate: Plate, sprocket: Sprocket, pose: Floats, sprocket_angle: float = 0.0, tolerance: float = 1e-7) -> float:
    """Area [m^2] that a plate at a pose and the sprocket have in common."""
    import shapely

    body = shapely.Polygon(in_sprocket(plate.outline.points(tolerance), pose, sprocket_angle))
    return float(shapely.intersection(body, shapely.Polygon(sprocket.outline(tolerance).points(tolerance))).area)


def seating_speeds(plate: Plate, tooth: Tooth, side: str) -> tuple[float, float]:
    """Speeds (approach, sliding) [m/s] of a flank's contact point per rad/s of the joint as the plate arrives on its tooth.

    The plate, the last one clockwise, rolls on the pin of its seated neighbour and turns about the pins' contact.  Approach is along the
    flank's normal, positive towards the tooth; sliding is along the flank, positive outwards.
    """
    link = plate.link
    half = np.pi / tooth.teeth
    pivot = -0.5 * link.hole_pitch + link.radius * np.exp(1j * half)
    speed = -1j * (complex(*plate.contact(tooth, side)) - pivot)
    normal = np.exp(-1j * link.flank_angle)
    normal = normal if side == "right" else -np.conj(normal)
    along = 1j * normal if side == "right" else -1j * normal
    return float(np.real(speed * np.conj(normal))), float(np.real(speed * np.conj(along)))
