"""Where a round body comes nearest to a closed profile: all the places at once, compiled.

The profile is stored as nodes with exact points and tangents, so close that the cubic through two of them leaves it by less than a
nanometre; a place is sought on the cubic, or at a corner between two stretches.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from drivewright._jit import inner, kernel
from drivewright._typing import ArrayLike, Complexes, Floats, Ints
from drivewright.curves.pieces import gather

SAME = 1e-10  # feet nearer to each other than this [m] are one
CORNER = 1e-6  # a turn [rad] below this is a smooth joint
BLOCK = 32  # chords that are passed over together
_CHORDS = 16  # at least, on each stretch
_HALVINGS = 12
_TURN = 0.9  # least cosine of the turn on a chord


class Nodes(NamedTuple):
    """Chords of a closed profile: ends a, b (complex, [m]), derivatives by the chord's parameter there; blocks: middle and half width.

    Chord k runs from a[k] to b[k] = a[k + 1]; a turn between the tangents at b[k] and a[k + 1] is a corner.
    """

    a: Complexes  # (n,)
    b: Complexes  # (n,)
    leave: Complexes  # (n,)
    arrive: Complexes  # (n,)
    middle: Complexes  # (blocks,)
    reach: Floats  # (blocks,)


class Touches(NamedTuple):
    """Places where the distance from a centre to the profile is least among its neighbours; arrays over the places.

    centre: number of the centre; point (complex, [m]); gap [m]: distance less radius; curvature [1/m] of the profile, left turns positive,
    inf at a corner.
    """

    centre: Ints
    point: Complexes
    gap: Floats
    curvature: Floats


def nodes_of(spans: Sequence[Any], tolerance: float = 2e-10) -> Nodes:
    """Nodes of the spans of a Trimmed profile, in order; in their middles the cubics leave it by less than the tolerance [m]."""
    index = np.repeat(np.arange(len(spans)), _CHORDS + 1)
    t = np.concatenate([np.linspace(span.start, span.stop, _CHORDS + 1) for span in spans])
    halvings = 0
    while True:
        points, headings = _along(spans, index, t)
        chords = np.flatnonzero(index[1:] == index[:-1])
        middles = 0.5 * (t[chords] + t[chords + 1])
        exact, heading = _along(spans, index[chords], middles)
        a, b, leave, arrive = points[chords], points[chords + 1], headings[chords], headings[chords + 1]
        cubic = 0.5 * (a + b) + 0.125 * np.abs(b - a) * (leave - arrive)
        off = (np.abs(np.imag(np.conj(heading) * (cubic - exact))) > tolerance) | (np.real(np.conj(leave) * arrive) < _TURN)
        if not off.any() or halvings == _HALVINGS - 1:
            break
        halvings += 1
        t, index = np.insert(t, chords[off] + 1, middles[off]), np.insert(index, chords[off] + 1, index[chords[off]])
    b = np.roll(a, -1)  # so that no foot falls between two ends that differ by rounding
    chord = np.abs(b - a)
    return Nodes(a, b, leave * chord, arrive * chord, *_blocks(a, b, chord))


def _along(spans, index, t):
    """Points and unit tangents at parameters t of the spans `index`."""
    jet = gather(tuple(span.piece for span in spans), index, t)
    slope = jet.d1 * np.array([np.sign(span.stop - span.start) for span in spans])[index]
    return jet.d0, slope / np.abs(slope)


def _blocks(a, b, chord):
    starts = np.arange(0, len(a), BLOCK)
    middle = np.array([np.mean(a[k : k + BLOCK]) for k in starts])
    reach = np.array([np.max(np.abs(a[k : k + BLOCK] - m) + 2 * chord[k : k + BLOCK]) for k, m in zip(starts, middle, strict=True)])
    return middle, reach


def touches(nodes: Nodes, centres: ArrayLike, radius: float, reach: float) -> Touches:
    """Touches of circles of `radius` about the complex `centres` with gaps up to `reach` [m], in the order of the centres."""
    centres = np.asarray(centres, dtype=complex).ravel()
    room = 8
    while True:
        number = np.zeros(len(centres), dtype=np.int64)
        points = np.zeros((len(centres), room), dtype=np.complex128)
        curvature = np.zeros((len(centres), room))
        _search(nodes, centres, radius + reach, number, points, curvature)
        if np.all(number <= room):
            break
        room = int(np.max(number))
    index, slot = np.nonzero(np.arange(room) < number[:, None])
    point = points[index, slot]
    return Touches(index, point, np.abs(centres[index] - point) - radius, curvature[index, slot])


@kernel
def _search(nodes, centres, limit, number, points, curvature):
    """`nearest` of every centre (m,), into rows of `number` (m,), `found` and `curvature` (m, places)."""
    for k in range(len(centres)):
        number[k] = nearest(nodes, centres[k], limit, points[k], curvature[k])


@inner
def nearest(nodes: Nodes, centre: complex, limit: float, points: Complexes, curvature: Floats) -> int:
    """Writes points and curvatures of the places nearer to `centre` than `limit`; returns their number, which may exceed the room.

    points (room,) [m] and curvature (room,) [1/m], both written.
    """
    count = 0
    chords = len(nodes.a)
    for block in range(len(nodes.middle)):
        away, sight = centre - nodes.middle[block], limit + nodes.reach[block]
        if away.real * away.real + away.imag * away.imag > sight * sight:  # a root would cost more than the rest
            continue
        for k in range(block * BLOCK, min(block * BLOCK + BLOCK, chords)):
            before = _rate(nodes.a[k] - centre, nodes.leave[k])
            after = _rate(nodes.b[k] - centre, nodes.arrive[k])
            beyond = _rate(nodes.b[k] - centre, nodes.leave[(k + 1) % chords])
            at_end = after < 0.0 and beyond >= 0.0  # a corner, or a smooth joint within rounding
            if not at_end and not (before < 0.0 and after >= 0.0):
                continue
            u = 1.0 if at_end else _foot(nodes, k, centre)
            point, first, second = _cubic(nodes, k, u)
            if abs(point - centre) <= limit and not _known(points, min(count, len(points)), point):
                if count < len(points):
                    points[count] = point
                    corner = at_end and _turn(nodes.arrive[k], nodes.leave[(k + 1) % chords]) > CORNER
                    curvature[count] = np.inf if corner else _cross(first, second) / abs(first) ** 3
                count += 1
    return count


@inner
def _known(points: Complexes, count: int, point: complex) -> bool:
    """Whether a foot on the node between two chords, or between the last chord and the first, has been found already.

    points (room,) [m], of which `count` are known.
    """
    return count > 0 and min(abs(point - points[count - 1]), abs(point - points[0])) < SAME


@inner
def _cross(a: complex, b: complex) -> float:
    """Cross product of two vectors, complex."""
    return a.real * b.imag - a.imag * b.real


@inner
def _turn(a: complex, b: complex) -> float:
    """Sine of the angle between two vectors, complex, without its sign."""
    return abs(_cross(a, b)) / (abs(a) * abs(b))


@inner
def _rate(arm, slope):
    """Half the change of the square of the distance along the chord."""
    return arm.real * slope.real + arm.imag * slope.imag


@inner
def _cubic(nodes, k, u):
    """Point, first and second derivative of Hermite's cubic on chord k at u = 0..1."""
    a, b, p, q = nodes.a[k], nodes.b[k], nodes.leave[k], nodes.arrive[k]
    c2, c3 = 3.0 * (b - a) - 2.0 * p - q, 2.0 * (a - b) + p + q
    return a + u * (p + u * (c2 + u * c3)), p + u * (2.0 * c2 + 3.0 * u * c3), 2.0 * c2 + 6.0 * u * c3


@inner
def _foot(nodes, k, centre):
    """Parameter on chord k where the distance is least: Newton's method inside a shrinking bracket."""
    low, high = 0.0, 1.0
    u = 0.5
    for _ in range(60):
        point, first, second = _cubic(nodes, k, u)
        arm = point - centre
        rate = _rate(arm, first)
        if rate < 0.0:
            low = u
        else:
            high = u
        half_second_derivative = abs(first) ** 2 + _rate(arm, second)
        step = -rate / half_second_derivative if half_second_derivative > 0.0 else 0.0
        following = u + step
        if half_second_derivative <= 0.0 or following <= low or following >= high:
            following = 0.5 * (low + high)
        if abs(following - u) < 1e-15:
            break
        u = following
    return u
