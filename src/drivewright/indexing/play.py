"""Play: how far the wheel turns by itself, the input standing still, until a pin touches the cam.

By symmetry every cam of a set allows the same: cam j with its pins is cam 0 with its pins turned about the wheel's axis.
"""

import numpy as np

from drivewright._jit import outer
from drivewright.curves.touching import nearest

FORWARD, BACKWARD = 1.0, -1.0
_TOUCHING = 1e-9  # a gap below this [m] is a contact
_PASSED = 5e-7  # a pin that turns away counts as inside the cam from this depth [m] on
_LEAST_STEP = 2e-6  # [rad]; in a smaller one no pin can pass a horn
_SIGHT = 1.25  # places up to this many radii from a pin's centre are looked at
_ROOM = 16


def play(drive, theta, direction):
    """Free rotation [rad] of the wheel at the input angles theta in the direction (+1 forward, -1 backward); nan where nothing stops it.

    The wheel advances by steps that no pin can use to pass the profile, and by bisection where one has gone into it.  The first of the
    drive's levels that stops it counts.
    """
    theta = np.atleast_1d(np.asarray(theta, dtype=float))
    return np.fmin.reduce([_play(level, theta, float(direction)) for level in drive.levels])


def _play(drive, theta, direction):
    """All in the frame that turns with the cam about the wheel's axis."""
    place, turn = (jet.d0 for jet in drive.pose(theta))
    upright = np.exp(-1j * turn)
    free, found, curvature = np.empty(len(theta)), np.empty(_ROOM, complex), np.empty(_ROOM)
    centres, place = drive.centres(theta).d0 * upright[:, None], place * upright
    _plays(drive.nodes, centres, place, drive.pin_radius, direction, drive.motion.pitch, free, found, curvature)
    return free


@outer
def _plays(nodes, centres, place, radius, direction, limit, free, found, curvature):
    for k in range(len(place)):
        free[k] = free_rotation(nodes, centres[k], place[k], radius, direction, limit, found, curvature)


@outer
def free_rotation(nodes, centres, place, radius, direction, limit, found, curvature):
    """Free rotation of one position up to `limit` [rad], nan beyond it; `found`, `curvature` are room for the search."""
    turned, last = 0.0, 0.0
    while turned <= limit:
        gap, step = _approach(nodes, centres, place, radius, direction, turned, found, curvature)
        if gap < -_TOUCHING:
            return _bisected(nodes, centres, place, radius, direction, max(turned - last, 0.0), turned, found, curvature)
        if gap <= _TOUCHING:
            return turned
        last = step
        turned += step
    return np.nan


@outer
def _approach(nodes, centres, place, radius, direction, turned, found, curvature):
    """Least gap [m] of the pins that come nearer when the wheel turns on, and the step [rad] to take."""
    least, step = np.inf, np.inf
    turn = complex(np.cos(turned), direction * np.sin(turned))
    for k in range(len(centres)):
        centre = centres[k] * turn
        count = min(nearest(nodes, centre - place, _SIGHT * radius, found, curvature), _ROOM)
        step = min(step, (_SIGHT - 1.0) * radius / abs(centre))
        for j in range(count):
            arm = centre - place - found[j]
            gap = abs(arm) - radius
            lever = direction * (centre.real * arm.imag - centre.imag * arm.real) / abs(arm)
            if lever < -1e-12:
                least = min(least, gap)
                step = min(step, max((gap + 0.02 * radius) / abs(centre), _LEAST_STEP), max(-gap / lever, _LEAST_STEP))
            elif gap < -_PASSED:
                least = min(least, gap)
    return least, step


@outer
def _bisected(nodes, centres, place, radius, direction, low, high, found, curvature):
    """Rotation between a free one and one where a pin is in the profile, to 1e-12 rad."""
    while high - low > 1e-12:
        middle = 0.5 * (low + high)
        gap, _ = _approach(nodes, centres, place, radius, direction, middle, found, curvature)
        if gap < 0.0:
            high = middle
        else:
            low = middle
    return low
