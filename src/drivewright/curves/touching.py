"""Where a round body comes nearest to a closed profile: all the places at once, compiled.

The profile is stored as nodes with exact points and tangents, so close that the cubic through two of them leaves it by less than a
nanometre; a place is sought on the cubic, or at a corner between two stretches.  Circles around runs of chords, two in one up to a circle
around all, tell which chords a search can leave out: it costs about the logarithm of their number.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from drivewright._jit import inner, kernel
from drivewright._typing import ArrayLike, Complexes, Floats, Ints
from drivewright.curves.pieces import gather

SAME = 1e-10  # feet nearer to each other than this [m] are one
CORNER = 1e-6  # a turn [rad] below this is a smooth joint
_RUN = 8  # chords that are passed over together
_CHORDS = 16  # at least, on each stretch
_HALVINGS = 12
_TURN = 0.9  # least cosine of the turn on a chord


class Nodes(NamedTuple):
    """Chords of a closed profile: ends a, b (complex, [m]), derivatives by the chord's parameter there; circles around runs of chords.

    Chord k runs from a[k] to b[k] = a[k + 1]; a turn between the tangents at b[k] and a[k + 1] is a corner.  middle, radius: the
    `bounding_circles`.
    """

    a: Complexes  # (n,)
    b: Complexes  # (n,)
    leave: Complexes  # (n,)
    arrive: Complexes  # (n,)
    middle: Complexes  # (circles,)
    radius: Floats  # (circles,)


class Touches(NamedTuple):
    """Places where the distance from a centre to the profile is least among its neighbours; arrays over the places.

    centre: number of the centre; point (complex, [m]); gap [m]: distance less radius; curvature [1/m] of the profile, left turns positive,
    inf at a corner.
    """

    centre: Ints
    point: Complexes
    gap: Floats
    curvature: Floats


class _Places(NamedTuple):
    """Places on the spans of a profile: number of the span, its parameter, how far along the span, point [m], unit tangent; all (n,)."""

    span: Ints
    t: Floats
    along: Floats
    point: Complexes
    heading: Complexes

    def of(self, chosen: Any) -> "_Places":
        """Some of the places."""
        return _Places(self.span[chosen], self.t[chosen], self.along[chosen], self.point[chosen], self.heading[chosen])

    def and_of(self, other: "_Places") -> "_Places":
        """The places of both, one after the other."""
        return _Places(
            np.append(self.span, other.span),
            np.append(self.t, other.t),
            np.append(self.along, other.along),
            np.append(self.point, other.point),
            np.append(self.heading, other.heading),
        )


def nodes_of(spans: Sequence[Any], tolerance: float = 2e-10) -> Nodes:
    """Nodes of the spans of a Trimmed profile, in order; in their middles the cubics leave it by less than the tolerance [m]."""
    t = np.concatenate([np.linspace(span.start, span.stop, _CHORDS + 1) for span in spans])
    places = _on_spans(spans, np.repeat(np.arange(len(spans)), _CHORDS + 1), t)
    start = np.flatnonzero(np.diff(places.span) == 0)
    low, high = places.of(start), places.of(start + 1)
    starts, stops = low.of(slice(0)), high.of(slice(0))
    for halving in range(_HALVINGS):
        middle = _on_spans(spans, low.span, 0.5 * (low.t + high.t))
        cubic = 0.5 * (low.point + high.point) + 0.125 * np.abs(high.point - low.point) * (low.heading - high.heading)
        far = np.abs(np.imag(np.conj(middle.heading) * (cubic - middle.point))) > tolerance
        off = (far | (np.real(np.conj(low.heading) * high.heading) < _TURN)) & (halving < _HALVINGS - 1)
        starts, stops = starts.and_of(low.of(~off)), stops.and_of(high.of(~off))
        if not off.any():
            break
        low, high = low.of(off).and_of(middle.of(off)), middle.of(off).and_of(high.of(off))
    order = np.lexsort((starts.along, starts.span))
    a = starts.point[order]
    b = np.roll(a, -1)  # so that no foot falls between two ends that differ by rounding
    chord = np.abs(b - a)
    return Nodes(a, b, starts.heading[order] * chord, stops.heading[order] * chord, *bounding_circles(a, b))


def _on_spans(spans, index, t):
    """`_Places` at parameters t of the spans `index`."""
    jet = gather(tuple(span.piece for span in spans), index, t)
    sense = np.array([np.sign(span.stop - span.start) for span in spans])[index]
    slope = jet.d1 * sense
    return _Places(index, t, sense * t, jet.d0, slope / np.abs(slope))


@kernel
def bounding_circles(a: Complexes, b: Complexes) -> tuple[Complexes, Floats]:
    """Middles (2 m,) [m] and radii (2 m,) [m] of circles around the chords from a to b (n,) complex [m] and the cubics on them.

    A binary tree: circle k holds the circles 2 k and 2 k + 1, circle m + k the k-th run of chords, m a power of two; circle 1 holds all,
    circle 0 and those of runs that do not exist have the radius -inf.
    """
    runs = 1
    while runs * _RUN < len(a):
        runs *= 2
    middle, radius = np.zeros(2 * runs, np.complex128), np.full(2 * runs, -np.inf)
    for run in range((len(a) + _RUN - 1) // _RUN):
        low, high = run * _RUN, min((run + 1) * _RUN, len(a))
        middle[runs + run] = 0.5 * (a[low] + b[high - 1])
        for k in range(low, high):
            radius[runs + run] = max(radius[runs + run], abs(a[k] - middle[runs + run]) + 2 * abs(b[k] - a[k]))
    for k in range(runs - 1, 0, -1):
        middle[k], radius[k] = _circle_around(middle[2 * k], radius[2 * k], middle[2 * k + 1], radius[2 * k + 1])
    return middle, radius


@inner
def _circle_around(a: complex, a_radius: float, b: complex, b_radius: float) -> tuple[complex, float]:
    """The least circle around the circles about a and b; radius -inf: around none."""
    apart = abs(b - a)
    if apart + b_radius <= a_radius:
        return a, a_radius
    if apart + a_radius <= b_radius:
        return b, b_radius
    radius = 0.5 * (apart + a_radius + b_radius)
    return a + (b - a) * ((radius - a_radius) / apart), radius


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
    count, circle, runs = 0, 1, len(nodes.middle) // 2
    while circle > 0:
        if not _in_sight(nodes, circle, centre, limit):
            circle = _after(circle)
        elif circle < runs:
            circle = 2 * circle
        else:
            first = (circle - runs) * _RUN
            count = _nearest_of_run(nodes, first, min(first + _RUN, len(nodes.a)), centre, limit, points, curvature, count)
            circle = _after(circle)
    return count


@inner
def _in_sight(nodes, circle, centre, limit):
    """Whether anything in a circle may be nearer to the centre than the limit [m]."""
    away, sight = centre - nodes.middle[circle], limit + nodes.radius[circle]
    return sight >= 0.0 and away.real * away.real + away.imag * away.imag <= sight * sight  # a root would cost more than the rest


@inner
def _after(circle):
    """The circle after those within a circle; 0 after the last."""
    while circle & 1:
        circle >>= 1
    return circle + 1 if circle > 0 else 0


@inner
def _nearest_of_run(nodes, first, last, centre, limit, points, curvature, count):
    """`nearest` on the chords from `first` to `last`; count: of the places found before, and with the new ones."""
    before = _rate(nodes.a[first] - centre, nodes.leave[first])
    for k in range(first, last):
        ahead = k + 1 if k + 1 < len(nodes.a) else 0
        arm = nodes.b[k] - centre
        after, beyond = _rate(arm, nodes.arrive[k]), _rate(arm, nodes.leave[ahead])
        at_end = after < 0.0 and beyond >= 0.0  # a corner, or a smooth joint within rounding
        if at_end or (before < 0.0 and after >= 0.0):
            u = 1.0 if at_end else _foot(nodes, k, centre)
            point, along, bend = _cubic(nodes, k, u)
            if abs(point - centre) <= limit and not _known(points, min(count, len(points)), point):
                if count < len(points):
                    points[count] = point
                    corner = at_end and _turn(nodes.arrive[k], nodes.leave[ahead]) > CORNER
                    curvature[count] = np.inf if corner else _cross(along, bend) / abs(along) ** 3
                count += 1
        before = beyond
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
