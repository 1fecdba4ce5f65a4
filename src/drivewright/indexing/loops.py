"""Bare stretches of an envelope chained into the loop around the cam, compiled."""

import numpy as np

from drivewright._jit import kernel
from drivewright.curves.touching import BLOCK, Nodes

_STILL = 1e-10  # chords shorter than this [m] are left out
_APART = 1e-3  # ends of stretches further apart than this [m] do not meet
_SHORT = 1e-6  # a stretch closes by itself only where no other begins within this [m]


@kernel
def loop_around(found, inside):
    """Numbers of the stretches of the loop around the cam's axis: the smallest inside the pins, else the largest; empty where none is."""
    count = len(found.side)
    following, kept, area = _partners(found), np.zeros(0, np.int64), 0.0
    free = np.ones(count, np.bool_)
    for start in range(count):
        loop, k = np.empty(count, np.int64), start
        length = 0
        while k >= 0 and free[k]:
            free[k], loop[length] = False, k
            k, length = following[k], length + 1
        if not length or k != start:
            continue
        winding, size = _around(found, loop[:length])
        if abs(winding) > 0.5 and (not len(kept) or (abs(size) < area) == inside):
            kept, area = loop[:length].copy(), abs(size)
    return kept


@kernel
def _partners(found):
    """The stretch that begins where each ends; -1 where none does."""
    following = np.empty(len(found.side), np.int64)
    for k in range(len(following)):
        end, least, following[k] = found.point[found.first[k + 1] - 1], _APART, -1
        for other in range(len(following)):
            apart = abs(found.point[found.first[other]] - end) + (_SHORT if other == k else 0.0)
            if apart < least:
                least, following[k] = apart, other
    return following


@kernel
def _around(found, loop):
    """Times that a loop runs round the cam's axis, and its area."""
    angle, area = 0.0, 0.0
    last = found.point[found.first[loop[-1] + 1] - 1]
    for k in loop:
        for j in range(found.first[k], found.first[k + 1]):
            turn = last.conjugate() * found.point[j]
            angle += np.arctan2(turn.imag, turn.real)
            area += 0.5 * turn.imag
            last = found.point[j]
    return angle / (2 * np.pi), area


@kernel
def nodes_along(found, loop):
    """The `Nodes` of a loop of stretches."""
    room = 0
    for k in loop:
        room += found.first[k + 1] - found.first[k]
    a, b = np.empty(room, np.complex128), np.empty(room, np.complex128)
    leave, arrive = np.empty(room, np.complex128), np.empty(room, np.complex128)
    count = 0
    for k in loop:
        for j in range(found.first[k], found.first[k + 1] - 1):
            chord = abs(found.point[j + 1] - found.point[j])
            if chord > _STILL:
                a[count] = found.point[j]
                leave[count], arrive[count] = found.heading[j] * chord, found.heading[j + 1] * chord
                count += 1
    a, b, leave, arrive = a[:count], b[:count], leave[:count], arrive[:count]
    for k in range(count):
        b[k] = a[(k + 1) % count]  # no foot falls between two ends that differ by rounding
    middle, reach = _blocks(a, b)
    return Nodes(a, b, leave, arrive, middle, reach)


@kernel
def _blocks(a, b):
    count = (len(a) + BLOCK - 1) // BLOCK
    middle, reach = np.empty(count, np.complex128), np.zeros(count)
    for k in range(count):
        low, high = k * BLOCK, min((k + 1) * BLOCK, len(a))
        middle[k] = 0.5 * (a[low] + b[high - 1])
        for j in range(low, high):
            reach[k] = max(reach[k], abs(a[j] - middle[k]) + 2 * abs(b[j] - a[j]))
    return middle, reach


@kernel
def keep_loop(bare, found, loop):
    """Leaves of the bare samples those that lie on the loop."""
    size = bare.shape[1]
    for side in range(2):
        for k in range(size):
            bare[side, k] = False
    for k in loop:
        for step in range(found.length[k]):
            bare[found.side[k], (found.begin[k] + step) % size] = True
