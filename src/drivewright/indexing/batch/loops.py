"""Exposed segments of an envelope chained into the loop around the cam, compiled."""

import numpy as np

from drivewright._jit import kernel
from drivewright._typing import Bools, Ints
from drivewright.curves.touching import Nodes, bounding_circles
from drivewright.indexing.batch.envelope import ExposedSegments

_STILL = 1e-10  # chords shorter than this [m] are left out
APART = 1e-3  # ends of segments further apart than this [m] do not meet
_SHORT = 1e-6  # a segment closes by itself only where no other begins within this [m]


@kernel
def find_cam_loop(segments: ExposedSegments, inside: bool) -> Ints:
    """Numbers (n,) of the segments of the loop around the cam's axis: inside the pins the smallest, else the largest; empty without one."""
    count = len(segments.side)
    following, kept, area = _successors(segments), np.zeros(0, np.int64), 0.0
    free = np.ones(count, np.bool_)
    for start in range(count):
        loop, k = np.empty(count, np.int64), start
        length = 0
        while k >= 0 and free[k]:
            free[k], loop[length] = False, k
            k, length = following[k], length + 1
        if not length or k != start:
            continue
        winding, size = _winding_and_area(segments, loop[:length])
        if abs(winding) > 0.5 and (not len(kept) or (abs(size) < area) == inside):
            kept, area = loop[:length].copy(), abs(size)
    return kept


@kernel
def _successors(segments):
    """(n,): the segment that begins where each ends; -1 where none does."""
    following = np.empty(len(segments.side), np.int64)
    for k in range(len(following)):
        end, least, following[k] = segments.point[segments.first[k + 1] - 1], APART, -1
        for other in range(len(following)):
            apart = abs(segments.point[segments.first[other]] - end) + (_SHORT if other == k else 0.0)
            if apart < least:
                least, following[k] = apart, other
    return following


@kernel
def _winding_and_area(segments, loop):
    """Times that a loop runs round the cam's axis, and its area."""
    angle, area = 0.0, 0.0
    last = segments.point[segments.first[loop[-1] + 1] - 1]
    for k in loop:
        for j in range(segments.first[k], segments.first[k + 1]):
            turn = last.conjugate() * segments.point[j]
            angle += np.arctan2(turn.imag, turn.real)
            area += 0.5 * turn.imag
            last = segments.point[j]
    return angle / (2 * np.pi), area


@kernel
def loop_nodes(segments: ExposedSegments, loop: Ints) -> Nodes:
    """The `Nodes` (ends and tangents of chords [m]) of a loop (n,) of segments."""
    capacity = 0
    for k in loop:
        capacity += segments.first[k + 1] - segments.first[k]
    a, b = np.empty(capacity, np.complex128), np.empty(capacity, np.complex128)
    leave, arrive = np.empty(capacity, np.complex128), np.empty(capacity, np.complex128)
    count = 0
    for k in loop:
        for j in range(segments.first[k], segments.first[k + 1] - 1):
            chord = abs(segments.point[j + 1] - segments.point[j])
            if chord > _STILL:
                a[count] = segments.point[j]
                leave[count], arrive[count] = segments.heading[j] * chord, segments.heading[j + 1] * chord
                count += 1
    a, b, leave, arrive = a[:count], b[:count], leave[:count], arrive[:count]
    for k in range(count):
        b[k] = a[(k + 1) % count]  # no foot falls between two ends that differ by rounding
    middle, radius = bounding_circles(a, b)
    return Nodes(a, b, leave, arrive, middle, radius)


@kernel
def restrict_to_loop(exposed: Bools, segments: ExposedSegments, loop: Ints) -> None:
    """Keeps of `exposed` (2, samples), in place, the samples that lie on the loop (n,)."""
    size = exposed.shape[1]
    for side in range(2):
        for k in range(size):
            exposed[side, k] = False
    for k in loop:
        for step in range(segments.length[k]):
            exposed[segments.side[k], (segments.begin[k] + step) % size] = True
