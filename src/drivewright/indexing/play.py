"""Play: how far the wheel turns by itself, the input standing still, until a pin touches the cam.

By symmetry every cam of a set allows the same: cam j with its pins is cam 0 with its pins turned about the wheel's axis.
"""

from collections.abc import Mapping

import numpy as np

from drivewright._jit import inner
from drivewright._typing import ArrayLike, Complexes, Floats
from drivewright.curves.touching import Nodes, nearest
from drivewright.indexing.motion import TURN
from drivewright.indexing.plane import PinDrive, PlaneDrive
from drivewright.result import Column, Table

FORWARD, BACKWARD = 1.0, -1.0
DIRECTIONS = {"forward": FORWARD, "backward": BACKWARD}
_TOUCHING = 1e-9  # a gap below this [m] is a contact
_PENETRATION = 5e-7  # a pin that turns away counts as inside the cam from this depth [m] on
_LEAST_STEP = 2e-6  # [rad]; in a smaller one no pin can pass a horn
_EXACT = 1e-13  # [rad]; a smaller step of Newton's method ends it
_SEARCH_RADIUS = 1.25  # places up to this many radii from a pin's centre are looked at
CAPACITY = 16  # places at which one pin may touch at once


def find_play(drive: PinDrive, theta: ArrayLike, direction: float) -> Floats:
    """Free rotation [rad] of the wheel at the input angles theta in the direction (+1 forward, -1 backward); nan where nothing stops it.

    Every pin advances by steps in which it cannot pass the profile, and by Newton's method where it has gone into it.  The pin that stops
    first counts, and so does the first of the drive's levels.
    """
    theta = np.atleast_1d(np.asarray(theta, dtype=float))
    return np.fmin.reduce([_play_of_cam(level, theta, float(direction)) for level in drive.levels])


def refine_about_peak(drive: PinDrive, angle: Floats, direction: float, finer: int = 16, passes: int = 3) -> Floats:
    """The input angles [rad] and, ever finer, others about the largest play, where the curve is pointed."""
    refined = angle
    for _ in range(passes):
        free = np.nan_to_num(find_play(drive, angle, direction), nan=-1.0)
        k = int(np.argmax(free))
        if free[k] <= 0:
            return refined
        angle = np.linspace(angle[max(k - 1, 0)], angle[min(k + 1, len(angle) - 1)], 2 * finer + 1)
        refined = np.union1d(refined, angle)
    return refined


def turn_angles(drive: PinDrive, points: int = 721) -> Floats:
    """Input angles [rad] over one turn, evenly `points` of them, and others about the largest play in either direction."""
    angle = np.linspace(0, TURN, points)
    for direction in DIRECTIONS.values():
        angle = np.union1d(angle, refine_about_peak(drive, angle, direction))
    return angle


def play_table(angle: Floats, rotations: Mapping[str, Floats]) -> Table:
    """Free rotations (n,) [rad] by direction over the input angle (n,) [rad]."""
    columns = (Column(name, "rad", f"free rotation of the wheel {name}", free, f"Play, {name}") for name, free in rotations.items())
    return Table("play", "Play of the wheel", (Column("angle", "rad", "input angle", angle), *columns))


def _play_of_cam(drive: PlaneDrive, theta: Floats, direction: float) -> Floats:
    """All in the frame that turns with the cam about the wheel's axis."""
    place, turn = (jet.d0 for jet in drive.pose(theta))
    upright = np.exp(-1j * turn)
    free, foot_points, curvatures = np.empty(len(theta)), np.empty(CAPACITY, complex), np.empty(CAPACITY)
    centres, place = drive.pin_centres(theta).d0 * upright[:, None], place * upright
    _free_rotations(drive.nodes, centres, place, drive.pin_radius, direction, drive.pin_pitch, free, foot_points, curvatures)
    return free


@inner
def _free_rotations(nodes, centres, place, radius, direction, limit, free, foot_points, curvatures):
    """Writes `free` (n,) [rad]: free rotation at n positions; centres (n, pins), place (n,) complex [m]."""
    pin = 0
    for k in range(len(place)):
        free[k], pin = free_rotation(nodes, centres[k], place[k], radius, direction, limit, pin, foot_points, curvatures)


@inner
def free_rotation(
    nodes: Nodes,
    centres: Complexes,
    place: complex,
    radius: float,
    direction: float,
    limit: float,
    likely: int,
    foot_points: Complexes,
    curvatures: Floats,
) -> tuple[float, int]:
    """Free rotation [rad] of one position up to `limit` [rad], nan beyond it, and the number of the pin that stops the wheel.

    centres (pins,) complex [m], place complex [m]: pins and cam from the wheel's axis, in the frame that turns with the cam; direction:
    +1 or -1; likely: the pin to ask first, as the one that stops the wheel at a position nearby, for no pin is followed beyond the least
    rotation of those before it; foot_points (n,) complex [m], curvatures (n,) [1/m]: work arrays of the search.
    """
    least, stopping, pins = np.inf, likely, len(centres)
    for k in range(pins):
        pin = (likely + k) % pins
        turned = _pin_rotation(nodes, centres[pin], place, radius, direction, min(limit, least), foot_points, curvatures)
        if turned < least:
            least, stopping = turned, pin
            if least == 0.0:
                break
    return (least if least <= limit else np.nan), stopping


@inner
def pin_within_cam(
    nodes: Nodes,
    centres: Complexes,
    place: complex,
    radius: float,
    direction: float,
    turned: float,
    likely: int,
    foot_points: Complexes,
    curvatures: Floats,
) -> int:
    """A pin that is inside the cam when the wheel is `turned` [rad], so that the wheel is free for less than that; -1 where none is.

    Arguments as for `free_rotation`.
    """
    pins = len(centres)
    for k in range(pins):
        pin = (likely + k) % pins
        gap, _, _, _ = _approach(nodes, centres[pin], place, radius, direction, turned, foot_points, curvatures)
        if gap < -_PENETRATION:
            return pin
    return -1


@inner
def _pin_rotation(nodes, centre, place, radius, direction, limit, foot_points, curvatures):
    """Rotation [rad] up to `limit` at which a pin touches the cam; inf where it does not. Arguments as for `free_rotation`."""
    low, turned = 0.0, 0.0
    while True:
        gap, rate, step, free = _approach(nodes, centre, place, radius, direction, turned, foot_points, curvatures)
        if gap < -_TOUCHING:
            return _contact_rotation(nodes, centre, place, radius, direction, low, turned, foot_points, curvatures)
        if gap <= _TOUCHING:
            return turned + min(-gap / rate, _LEAST_STEP) if turned > 0.0 else 0.0
        if turned >= limit or turned + free >= limit:
            return np.inf
        low, turned = turned, min(turned + step, limit)


@inner
def _approach(nodes, centre, place, radius, direction, turned, foot_points, curvatures):
    """Least gap [m] of a pin where it comes nearer as the wheel turns on, its rate [m/rad], the step [rad] to take, and the rotation [rad]
    within which the pin touches nothing new whatever its way."""
    turn = complex(np.cos(turned), direction * np.sin(turned))
    at, size = centre * turn, abs(centre)
    arm = at - place
    count = min(nearest(nodes, arm, _SEARCH_RADIUS * radius, foot_points, curvatures), CAPACITY)
    least, rate, nearest_gap = np.inf, 0.0, (_SEARCH_RADIUS - 1.0) * radius
    step = nearest_gap / size
    for j in range(count):
        away = arm - foot_points[j]
        gap = abs(away) - radius
        lever = direction * (at.real * away.imag - at.imag * away.real) / abs(away)
        nearest_gap = min(nearest_gap, gap)
        if lever < -1e-12:
            step = min(step, max((gap + 0.02 * radius) / size, _LEAST_STEP), max(-gap / lever, _LEAST_STEP))
        if gap < least and (lever < -1e-12 or gap < -_PENETRATION):
            least, rate = gap, lever
    return least, rate, step, nearest_gap / size


@inner
def _contact_rotation(nodes, centre, place, radius, direction, low, high, foot_points, curvatures):
    """Rotation [rad] between a free one and one where the pin is in the cam: Newton's method inside a shrinking bracket.

    Arguments as for `free_rotation`.
    """
    turned, before = high, high - low
    while high - low > _EXACT:
        gap, rate, _, _ = _approach(nodes, centre, place, radius, direction, turned, foot_points, curvatures)
        if gap < 0.0:
            high = turned
        else:
            low = turned
        following = turned - gap / rate if rate < 0.0 else low
        step = abs(following - turned)
        if step < _EXACT and rate < 0.0:
            return following
        if not low < following < high or step > 0.5 * before:
            following = 0.5 * (low + high)
            step = abs(following - turned)
        turned, before = following, step
    return low
