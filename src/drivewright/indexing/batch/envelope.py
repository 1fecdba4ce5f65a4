"""The profile of a pin wheel's cam in compiled code: segments of the envelope that no pin covers.

The exact route is `curves.trim`; here the centres of all pins stand as samples on a grid of cells, a point of the envelope is covered where
one of them, moved to its foot, is nearer than the pin's radius, and the ends of an exposed segment are found by bisection.
A segment shorter
than a sample is not seen.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from drivewright._jit import by_reference, inner, kernel
from drivewright._typing import Bools, Complexes, Floats, Ints
from drivewright.motion import MotionLaw

_COVER_DEPTH = 2e-9  # a point deeper than this [m] in a pin is covered; the foot of a sample is exact to a fraction of it
_OWN_SAMPLES = 2  # samples on either side of a point's own centre that are compared as they are
_HALVINGS = 28  # of a step of the samples: to some 1e-12 m
_TABLE_CELLS = 256  # of a law's table


class LawTable(NamedTuple):
    """s(u) as polynomials of degree 5 in x = (u - knots[k])/(knots[k + 1] - knots[k]).

    knots (n + 1,) [-]; coefficients (n, 6) [-], rising powers of x.
    """

    knots: Floats
    coefficients: Floats


class PinWheelSizes(NamedTuple):
    """Dimensions of one design: radii and eccentricity [m], motion_angle [rad]; sense +1 or -1 as in `PinWheel`."""

    pins: int
    circle_radius: float
    pin_radius: float
    eccentricity: float
    motion_angle: float
    sense: float


class PinPath(NamedTuple):
    """Centres of pin 0 seen from the cam at theta + 2 pi turn, turn after turn.

    theta (n,) [rad]; z (pins n,) complex [m], its first and second derivative by theta v, a (pins n,) [m/rad, m/rad^2].
    """

    theta: Floats
    z: Complexes
    v: Complexes
    a: Complexes


@by_reference
class CellGrid(NamedTuple):
    """Samples by the square cell in which they lie: in cell c those of the numbers `order[start[c]:start[c + 1]]`.

    start (per_side^2 + 1,), order (samples,), centre (samples,): z of the samples in that order [m], for a search runs along it;
    per_side cells of `width` [m] along x and along y, from -reach [m] on.
    """

    start: Ints
    order: Ints
    centre: Complexes
    per_side: int
    width: float
    reach: float


@by_reference
class ExposedSegments(NamedTuple):
    """Segments of the envelope that no pin covers, the material on their left.

    first (n + 1,): points and headings of segment k are `first[k]:first[k + 1]`; point (m,) complex [m], heading (m,) unit complex;
    side (n,): 0 left of the centre's travel, 1 right of it; begin, length (n,): the samples of that side.
    """

    first: Ints
    point: Complexes
    heading: Complexes
    side: Ints
    begin: Ints
    length: Ints


@lru_cache(maxsize=16)
def tabulate_law(law: MotionLaw) -> LawTable:
    """The `LawTable` of a MotionLaw: quintics that agree with it in s, v, a at their ends, exact to about 1e-12."""
    knots, rows = [0.0], []
    for k, (low, high) in enumerate(zip(law.breaks[:-1], law.breaks[1:], strict=True)):
        u = np.linspace(low, high, max(2, int(np.ceil(_TABLE_CELLS * (high - low)))) + 1)
        knots.extend(u[1:])
        rows.append(_quintics(u, *np.broadcast_arrays(*law.on_piece(k, u))[:3]))
    return LawTable(np.array(knots), np.concatenate(rows))


def _quintics(u: Floats, s: Floats, v: Floats, a: Floats) -> Floats:
    h = np.diff(u)
    c1, c2 = h * v[:-1], h**2 * a[:-1] / 2
    rise, slope, curve = np.diff(s) - c1 - c2, h * v[1:] - c1 - 2 * c2, h**2 * a[1:] - 2 * c2
    return np.stack(
        [s[:-1], c1, c2, 10 * rise - 4 * slope + curve / 2, -15 * rise + 7 * slope - curve, 6 * rise - 3 * slope + curve / 2], axis=1
    )


@inner
def motion_at(table: LawTable, motion_angle: float, theta: float) -> tuple[float, float, float]:
    """s [-] and its first and second derivative by the input angle theta [rad] in 0 .. 2 pi."""
    u = theta / motion_angle
    if u >= 1.0:
        return 1.0, 0.0, 0.0
    k, above = 0, len(table.coefficients)
    while above - k > 1:
        middle = (k + above) // 2
        if table.knots[middle] <= u:
            k = middle
        else:
            above = middle
    h = table.knots[k + 1] - table.knots[k]
    x, c = (u - table.knots[k]) / h, table.coefficients[k]
    s = c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * (c[4] + x * c[5]))))
    v = c[1] + x * (2 * c[2] + x * (3 * c[3] + x * (4 * c[4] + x * 5 * c[5])))
    a = 2 * c[2] + x * (6 * c[3] + x * (12 * c[4] + x * 20 * c[5]))
    return s, v / (h * motion_angle), a / (h * motion_angle) ** 2


@inner
def pin_centre_at(wheel: PinWheelSizes, table: LawTable, theta: float, turn: int) -> tuple[complex, complex, complex]:
    """Centre of pin 0 seen from the cam at theta + 2 pi turn [m], with first and second derivative by theta.

    z = R exp(i pitch (turn + s)) - e exp(i sense theta).
    """
    s, rate, acceleration = motion_at(table, wheel.motion_angle, theta)
    pitch = 2 * np.pi / wheel.pins
    arm = wheel.circle_radius * np.exp(1j * pitch * (turn + s))
    crank = wheel.eccentricity * np.exp(1j * wheel.sense * theta)
    rate, acceleration = pitch * rate, pitch * acceleration
    return arm - crank, 1j * (rate * arm - wheel.sense * crank), 1j * acceleration * arm - rate**2 * arm + crank


@kernel
def sample_pin_path(wheel: PinWheelSizes, table: LawTable, theta: Floats) -> PinPath:
    """The `PinPath` at the angles theta (n,) [rad] of every turn."""
    count = len(theta)
    size = count * wheel.pins
    z, v, a = np.empty(size, np.complex128), np.empty(size, np.complex128), np.empty(size, np.complex128)
    ways = np.exp(2j * np.pi * np.arange(wheel.pins) / wheel.pins)
    for j in range(count):
        arm_0 = pin_centre_at(wheel, table, theta[j], 0)
        crank = wheel.eccentricity * np.exp(1j * wheel.sense * theta[j])
        crank_rate = 1j * wheel.sense * crank
        for turn in range(wheel.pins):
            k, ahead = turn * count + j, ways[turn]
            z[k] = (arm_0[0] + crank) * ahead - crank
            v[k] = (arm_0[1] + crank_rate) * ahead - crank_rate
            a[k] = (arm_0[2] - crank) * ahead + crank
    return PinPath(theta, z, v, a)


@kernel
def sort_into_cells(path: PinPath, reach: float, width: float) -> CellGrid:
    """The `CellGrid` of square cells of `width` [m] that cover the square of half width `reach` [m]."""
    count = int(2 * reach / width) + 1
    number, start = np.empty(len(path.z), np.int64), np.zeros(count * count + 1, np.int64)
    for k in range(len(path.z)):
        number[k] = int((path.z[k].real + reach) / width) * count + int((path.z[k].imag + reach) / width)
        start[number[k] + 1] += 1
    for cell in range(count * count):
        start[cell + 1] += start[cell]
    order, following, centre = np.empty(len(path.z), np.int64), start.copy(), np.empty(len(path.z), np.complex128)
    for k in range(len(path.z)):
        place = following[number[k]]
        order[place], centre[place] = k, path.z[k]
        following[number[k]] += 1
    return CellGrid(start, order, centre, count, width, reach)


@inner
def is_covered(path: PinPath, cells: CellGrid, radius: float, margin: float, point: complex, own: int, last_cover: Ints) -> bool:
    """Whether a pin at another place than about the sample `own` covers the point; last_cover (1,): a sample to try first, and, written,
    the number of the one that does."""
    size, near = len(path.z), radius + margin
    if _covers_point(path, radius, near, point, own, last_cover[0], size):
        return True
    per_cell = 1.0 / cells.width
    x_in_cells, y_in_cells, near_in_cells = (point.real + cells.reach) * per_cell, (point.imag + cells.reach) * per_cell, near * per_cell
    low_x, high_x = _cell_range(x_in_cells, near_in_cells, cells.per_side)
    for x in range(low_x, high_x + 1):
        apart = max(x - x_in_cells, x_in_cells - x - 1.0, 0.0)  # of the column
        low_y, high_y = _cell_range(y_in_cells, np.sqrt(max(near_in_cells * near_in_cells - apart * apart, 0.0)), cells.per_side)
        first, last = cells.start[x * cells.per_side + low_y], cells.start[x * cells.per_side + high_y + 1]
        for place in range(first, last):
            arm = point - cells.centre[place]
            if arm.real * arm.real + arm.imag * arm.imag >= near * near:
                continue
            if _covers_point(path, radius, near, point, own, cells.order[place], size):
                last_cover[0] = cells.order[place]
                return True
    return False


@inner
def _cell_range(x, near, count):
    """First and last of `count` cells along an axis within `near` of x, both in widths of a cell from where the cells begin."""
    return max(int(x - near), 0), min(int(x + near), count - 1)


@inner
def _covers_point(path, radius, near, point, own, k, size):
    """Whether the pin at sample k, or between it and its neighbours, covers the point."""
    arm = point - path.z[k]
    square = arm.real * arm.real + arm.imag * arm.imag
    if square >= near * near:
        return False
    if square < (radius - _COVER_DEPTH) ** 2:
        return True
    apart = abs(k - own)
    if min(apart, size - apart) <= _OWN_SAMPLES:
        return False
    return _foot_distance_squared(path, arm, k) < (radius - _COVER_DEPTH) ** 2


@inner
def _foot_distance_squared(path, arm, k):
    """Square of the distance from the centre curve, by its second order, to the point at `arm` from sample k."""
    v, a, last = path.v[k], path.a[k], len(path.theta)
    j = k % last
    back = path.theta[j] - path.theta[j - 1] if j else 2 * np.pi - path.theta[last - 1]
    ahead = path.theta[j + 1] - path.theta[j] if j + 1 < last else 2 * np.pi - path.theta[j]
    curvature = v.real * v.real + v.imag * v.imag - (a.real * arm.real + a.imag * arm.imag)
    step = (v.real * arm.real + v.imag * arm.imag) / curvature if curvature > 0 else 0.0
    step = min(max(step, -back), ahead)
    x, y = arm.real - step * (v.real + 0.5 * step * a.real), arm.imag - step * (v.imag + 0.5 * step * a.imag)
    return x * x + y * y


@kernel
def find_exposed_samples(path: PinPath, cells: CellGrid, radius: float, margin: float, least: float = 0.0, most: float = np.inf) -> Bools:
    """(2, samples): True where no pin covers the point of the envelope, left of the centre's travel, then right of it.

    least, most [m]: points nearer to the cam's axis or further from it are not looked at, and not exposed.
    """
    exposed = np.zeros((2, len(path.z)), np.bool_)
    _mark_exposed(path, cells, radius, margin, least, most, exposed, np.zeros(1, np.int64))
    return exposed


@inner
def _mark_exposed(path, cells, radius, margin, least, most, exposed, last_cover):
    """Writes `exposed` (2, samples); last_cover (1,): the sample that covered the point before."""
    for side in range(2):
        for k in range(len(path.z)):
            point = path.z[k] + (1 - 2 * side) * radius * 1j * path.v[k] / abs(path.v[k])
            if least <= abs(point) <= most:
                exposed[side, k] = not is_covered(path, cells, radius, margin, point, k, last_cover)


@inner
def _exposed_end(wheel, table, path, cells, margin, last_cover, side, last, beyond):
    """Point and unit heading of the centre at the end of an exposed segment, between its sample `last` and the covered sample `beyond`.

    last_cover (1,): as for `is_covered`.
    """
    count = len(path.theta)
    ahead = beyond == last + 1 or (beyond == 0 and last > 1)
    turn, j = divmod(last if ahead else beyond, count)
    low = path.theta[j]
    high = path.theta[j + 1] if j + 1 < count else 2 * np.pi
    free, buried = (low, high) if ahead else (high, low)
    for _ in range(_HALVINGS):
        middle = 0.5 * (free + buried)
        point, _ = _envelope(wheel, table, side, middle, turn)
        if is_covered(path, cells, wheel.pin_radius, margin, point, turn * count + j, last_cover):
            buried = middle
        else:
            free = middle
    return _envelope(wheel, table, side, free, turn)


@inner
def _envelope(wheel, table, side, theta, turn):
    """Point (complex, [m]) of the envelope on a side and unit heading of the centre, at theta [rad] of a turn."""
    z, v, _ = pin_centre_at(wheel, table, theta, turn)
    heading = v / abs(v)
    return z + (1 - 2 * side) * wheel.pin_radius * 1j * heading, heading


@kernel
def trace_exposed_segments(
    wheel: PinWheelSizes, table: LawTable, path: PinPath, cells: CellGrid, margin: float, exposed: Bools
) -> ExposedSegments:
    """All `ExposedSegments` of `exposed` (2, samples), the left side forwards and the right side backwards."""
    size = len(path.z)
    runs, samples = 0, 0
    whole = np.ones(2, np.bool_)
    for side in range(2):
        for k in range(size):
            samples += exposed[side, k]
            runs += exposed[side, k] and not exposed[side, k - 1]
            whole[side] &= exposed[side, k]
        runs += whole[side]
    capacity = samples + 2 * runs + 2
    first = np.zeros(runs + 1, np.int64)
    side_of, begin, length = np.empty(runs, np.int64), np.empty(runs, np.int64), np.empty(runs, np.int64)
    point, heading = np.empty(capacity, np.complex128), np.empty(capacity, np.complex128)
    segments = ExposedSegments(first, point, heading, side_of, begin, length)
    number = 0
    for side in range(2):
        for k in range(1 if whole[side] else size):
            if whole[side] or (exposed[side, k] and not exposed[side, k - 1]):
                side_of[number], begin[number] = side, k
                _trace_segment(wheel, table, path, cells, margin, exposed, segments, number, whole[side])
                number += 1
    return segments


@kernel
def _trace_segment(wheel, table, path, cells, margin, exposed, segments, number, whole):
    """Writes one segment; a whole side ends where it begins."""
    side, k, at = segments.side[number], segments.begin[number], segments.first[number]
    size, last_cover = len(path.z), np.zeros(1, np.int64)
    if not whole:
        segments.point[at], segments.heading[at] = _exposed_end(wheel, table, path, cells, margin, last_cover, side, k, (k - 1) % size)
        at += 1
    length = 0
    while length < size and exposed[side, (k + length) % size]:
        here = (k + length) % size
        heading = path.v[here] / abs(path.v[here])
        segments.point[at], segments.heading[at] = path.z[here] + (1 - 2 * side) * wheel.pin_radius * 1j * heading, heading
        at, length = at + 1, length + 1
    if whole:
        segments.point[at], segments.heading[at] = segments.point[segments.first[number]], segments.heading[segments.first[number]]
    else:
        last = (k + length - 1) % size
        segments.point[at], segments.heading[at] = _exposed_end(
            wheel, table, path, cells, margin, last_cover, side, last, (last + 1) % size
        )
    at += 1
    segments.length[number], segments.first[number + 1] = length, at
    if side == 1:
        _reverse_segment(segments, segments.first[number], at - 1)


@inner
def _reverse_segment(segments, low, high):
    """The points from `low` to `high` in the other order; loops, for slices that overlap take seconds to compile."""
    point, heading = segments.point, segments.heading
    for k in range(low, (low + high) // 2 + 1):
        other = low + high - k
        point[k], point[other] = point[other], point[k]
        heading[k], heading[other] = -heading[other], -heading[k]
