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
_SEARCH_RADIUS = 1.25  # places up to this many radii from a pin's centre are looked at
_CAPACITY = 16


def find_play(drive: PinDrive, theta: ArrayLike, direction: float) -> Floats:
    """Free rotation [rad] of the wheel at the input angles theta in the direction (+1 forward, -1 backward); nan where nothing stops it.

    The wheel advances by steps that no pin can use to pass the profile, and by bisection where one has gone into it.  The first of the
    drive's levels that stops it counts.
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
    columns = (Column(name, "rad", f"free rotation {name}", free) for name, free in rotations.items())
    return Table("play", "Play of the wheel", (Column("angle", "rad", "input angle", angle), *columns))


def _play_of_cam(drive: PlaneDrive, theta: Floats, direction: float) -> Floats:
    """All in the frame that turns with the cam about the wheel's axis."""
    place, turn = (jet.d0 for jet in drive.pose(theta))
    upright = np.exp(-1j * turn)
    free, foot_points, curvatures = np.empty(len(theta)), np.empty(_CAPACITY, complex), np.empty(_CAPACITY)
    centres, place = drive.pin_centres(theta).d0 * upright[:, None], place * upright
    _free_rotations(drive.nodes, centres, place, drive.pin_radius, direction, drive.motion.pitch, free, foot_points, curvatures)
    return free


@inner
def _free_rotations(nodes, centres, place, radius, direction, limit, free, foot_points, curvatures):
    """Writes `free` (n,) [rad]: free rotation at n positions; centres (n, pins), place (n,) complex [m]."""
    for k in range(len(place)):
        free[k] = free_rotation(nodes, centres[k], place[k], radius, direction, limit, foot_points, curvatures)


@inner
def free_rotation(
    nodes: Nodes,
    centres: Complexes,
    place: complex,
    radius: float,
    direction: float,
    limit: float,
    foot_points: Complexes,
    curvatures: Floats,
) -> float:
    """Free rotation [rad] of one position up to `limit` [rad], nan beyond it.

    centres (pins,) complex [m], place complex [m]: pins and cam from the wheel's axis, in the frame that turns with the cam; direction:
    +1 or -1; foot_points (n,) complex [m], curvatures (n,) [1/m]: work arrays of the search.
    """
    turned, last = 0.0, 0.0
    while turned <= limit:
        gap, step = _approach(nodes, centres, place, radius, direction, turned, foot_points, curvatures)
        if gap < -_TOUCHING:
            return _bisected(nodes, centres, place, radius, direction, max(turned - last, 0.0), turned, foot_points, curvatures)
        if gap <= _TOUCHING:
            return turned
        last = step
        turned += step
    return np.nan


@inner
def _approach(nodes, centres, place, radius, direction, turned, foot_points, curvatures):
    """Least gap [m] of the pins that come nearer when the wheel turns on, and the step [rad] to take."""
    least, step = np.inf, np.inf
    turn = complex(np.cos(turned), direction * np.sin(turned))
    for k in range(len(centres)):
        centre = centres[k] * turn
        count = min(nearest(nodes, centre - place, _SEARCH_RADIUS * radius, foot_points, curvatures), _CAPACITY)
        step = min(step, (_SEARCH_RADIUS - 1.0) * radius / abs(centre))
        for j in range(count):
            arm = centre - place - foot_points[j]
            gap = abs(arm) - radius
            lever = direction * (centre.real * arm.imag - centre.imag * arm.real) / abs(arm)
            if lever < -1e-12:
                least = min(least, gap)
                step = min(step, max((gap + 0.02 * radius) / abs(centre), _LEAST_STEP), max(-gap / lever, _LEAST_STEP))
            elif gap < -_PENETRATION:
                least = min(least, gap)
    return least, step


@inner
def _bisected(nodes, centres, place, radius, direction, low, high, foot_points, curvatures):
    """Rotation between a free one and one where a pin is in the profile, to 1e-12 rad. Arrays as for `free_rotation`."""
    while high - low > 1e-12:
        middle = 0.5 * (low + high)
        gap, _ = _approach(nodes, centres, place, radius, direction, middle, foot_points, curvatures)
        if gap < 0.0:
            high = middle
        else:
            low = middle
    return low
