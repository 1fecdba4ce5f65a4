"""The profile of a pin wheel's cam in compiled code, for many designs: stretches of the envelope that no pin covers.

The exact route is `curves.trim`; here the centres of all pins stand as samples on a grid of cells, a point of the envelope is covered where
one of them, moved to its foot, is nearer than the pin's radius, and the ends of a bare stretch are found by bisection.  A stretch shorter
than a sample is not seen.
"""

from typing import NamedTuple

import numpy as np

from drivewright._jit import inner, kernel, outer

_BURIED = 2e-9  # a point deeper than this [m] in a pin is covered; the foot of a sample is exact to a fraction of it
_OWN = 2  # samples on either side of a point's own centre that are compared as they are
_HALVINGS = 36
_PARTS = 256  # of a law's table


class LawTable(NamedTuple):
    """s(u) as polynomials of degree 5 in x = (u - knots[k])/(knots[k + 1] - knots[k]): rows of coefficients."""

    knots: np.ndarray
    coefficients: np.ndarray


class Wheel(NamedTuple):
    """Measures of one design in SI; sense as in `PinWheel`."""

    pins: int
    circle_radius: float
    pin_radius: float
    eccentricity: float
    motion_angle: float
    sense: float


class Swept(NamedTuple):
    """Centres of pin 0 seen from the cam at theta + 2 pi turn: samples z, first and second derivative v, a, turn after turn."""

    theta: np.ndarray
    z: np.ndarray
    v: np.ndarray
    a: np.ndarray


class Cells(NamedTuple):
    """Samples by the square cells they lie in: `order[start[c]:start[c + 1]]` in cell c, `count` cells of `width` a side from -reach on."""

    start: np.ndarray
    order: np.ndarray
    count: int
    width: float
    reach: float


class Stretches(NamedTuple):
    """Bare stretches, the part on their left: points and headings `first[k]:first[k + 1]`, `length` samples of a side from `begin` on."""

    first: np.ndarray
    point: np.ndarray
    heading: np.ndarray
    side: np.ndarray
    begin: np.ndarray
    length: np.ndarray


def law_table(law):
    """The `LawTable` of a MotionLaw: quintics that agree with it in s, v, a at their ends, exact to about 1e-12."""
    knots, rows = [0.0], []
    for k, (low, high) in enumerate(zip(law.breaks[:-1], law.breaks[1:], strict=True)):
        u = np.linspace(low, high, max(2, int(np.ceil(_PARTS * (high - low)))) + 1)
        knots.extend(u[1:])
        rows.append(_quintics(u, *np.broadcast_arrays(*law.on_piece(k, u))[:3]))
    return LawTable(np.array(knots), np.concatenate(rows))


def _quintics(u, s, v, a):
    h = np.diff(u)
    c1, c2 = h * v[:-1], h**2 * a[:-1] / 2
    rise, slope, bend = np.diff(s) - c1 - c2, h * v[1:] - c1 - 2 * c2, h**2 * a[1:] - 2 * c2
    return np.stack(
        [s[:-1], c1, c2, 10 * rise - 4 * slope + bend / 2, -15 * rise + 7 * slope - bend, 6 * rise - 3 * slope + bend / 2], axis=1
    )


@outer
def motion_at(table, motion_angle, theta):
    """s and its first and second derivative by the input angle theta in 0 .. 2 pi."""
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


@outer
def centre_at(wheel, table, theta, turn):
    """Centre of pin 0 seen from the cam at theta + 2 pi turn, with first and second derivative by theta."""
    s, rate, bend = motion_at(table, wheel.motion_angle, theta)
    pitch = 2 * np.pi / wheel.pins
    arm = wheel.circle_radius * np.exp(1j * pitch * (turn + s))
    crank = wheel.eccentricity * np.exp(1j * wheel.sense * theta)
    rate, bend = pitch * rate, pitch * bend
    return arm - crank, 1j * (rate * arm - wheel.sense * crank), 1j * bend * arm - rate**2 * arm + crank


@kernel
def swept(wheel, table, theta):
    """The `Swept` centres at the angles theta of every turn."""
    count = len(theta)
    size = count * wheel.pins
    z, v, a = np.empty(size, np.complex128), np.empty(size, np.complex128), np.empty(size, np.complex128)
    for j in range(count):
        arm_0 = centre_at(wheel, table, theta[j], 0)
        crank = wheel.eccentricity * np.exp(1j * wheel.sense * theta[j])
        crank_rate = 1j * wheel.sense * crank
        for turn in range(wheel.pins):
            ahead = np.exp(2j * np.pi * turn / wheel.pins)
            k = turn * count + j
            z[k] = (arm_0[0] + crank) * ahead - crank
            v[k] = (arm_0[1] + crank_rate) * ahead - crank_rate
            a[k] = (arm_0[2] - crank) * ahead + crank
    return Swept(theta, z, v, a)


@kernel
def cells_of(path, reach, width):
    """The samples sorted into cells that cover the square of half width `reach` [m]."""
    count = int(2 * reach / width) + 1
    number, start = np.empty(len(path.z), np.int64), np.zeros(count * count + 1, np.int64)
    for k in range(len(path.z)):
        number[k] = int((path.z[k].real + reach) / width) * count + int((path.z[k].imag + reach) / width)
        start[number[k] + 1] += 1
    for cell in range(count * count):
        start[cell + 1] += start[cell]
    order, following = np.empty(len(path.z), np.int64), start.copy()
    for k in range(len(path.z)):
        order[following[number[k]]] = k
        following[number[k]] += 1
    return Cells(start, order, count, width, reach)


@outer
def covered(path, cells, radius, margin, point, own, hint):
    """Whether a pin at another place than about the sample `own` covers the point; writes the sample that does to hint[0]."""
    size, near = len(path.z), radius + margin
    if _buries(path, radius, near, point, own, hint[0], size):
        return True
    low_x, high_x = _range(cells, point.real, near)
    low_y, high_y = _range(cells, point.imag, near)
    for x in range(low_x, high_x + 1):
        first, last = cells.start[x * cells.count + low_y], cells.start[x * cells.count + high_y + 1]
        for place in range(first, last):
            if _buries(path, radius, near, point, own, cells.order[place], size):
                hint[0] = cells.order[place]
                return True
    return False


@inner
def _range(cells, x, near):
    low, high = int((x - near + cells.reach) / cells.width), int((x + near + cells.reach) / cells.width)
    return max(low, 0), min(high, cells.count - 1)


@inner
def _buries(path, radius, near, point, own, k, size):
    """Whether the pin at sample k, or between it and its neighbours, covers the point."""
    arm = point - path.z[k]
    square = arm.real * arm.real + arm.imag * arm.imag
    if square >= near * near:
        return False
    if square < (radius - _BURIED) ** 2:
        return True
    apart = abs(k - own)
    if min(apart, size - apart) <= _OWN:
        return False
    return _moved_to_foot(path, arm, k) < radius - _BURIED


@outer
def _moved_to_foot(path, arm, k):
    """Distance from the centre curve, by its second order, to the point at `arm` from sample k."""
    v, a, last = path.v[k], path.a[k], len(path.theta)
    j = k % last
    back = path.theta[j] - path.theta[j - 1] if j else 2 * np.pi - path.theta[last - 1]
    ahead = path.theta[j + 1] - path.theta[j] if j + 1 < last else 2 * np.pi - path.theta[j]
    bend = abs(v) ** 2 - (a.real * arm.real + a.imag * arm.imag)
    step = (v.real * arm.real + v.imag * arm.imag) / bend if bend > 0 else 0.0
    step = min(max(step, -back), ahead)
    return abs(arm - step * (v + 0.5 * step * a))


@kernel
def bare_samples(path, cells, radius, margin):
    """(2, samples) which points of the envelope no pin covers: left of the centre's travel, then right of it."""
    bare = np.zeros((2, len(path.z)), np.bool_)
    _look(path, cells, radius, margin, bare, np.zeros(1, np.int64))
    return bare


@outer
def _look(path, cells, radius, margin, bare, hint):
    for side in range(2):
        for k in range(len(path.z)):
            point = path.z[k] + (1 - 2 * side) * radius * 1j * path.v[k] / abs(path.v[k])
            bare[side, k] = not covered(path, cells, radius, margin, point, k, hint)


@outer
def _edge(wheel, table, path, cells, margin, hint, side, last, beyond):
    """Point and unit heading of the centre where a bare stretch ends, between its sample `last` and the covered one `beyond` beside it."""
    count = len(path.theta)
    ahead = beyond == last + 1 or (beyond == 0 and last > 1)
    turn, j = divmod(last if ahead else beyond, count)
    low = path.theta[j]
    high = path.theta[j + 1] if j + 1 < count else 2 * np.pi
    bare, buried = (low, high) if ahead else (high, low)
    for _ in range(_HALVINGS):
        middle = 0.5 * (bare + buried)
        point, _ = _envelope(wheel, table, side, middle, turn)
        if covered(path, cells, wheel.pin_radius, margin, point, turn * count + j, hint):
            buried = middle
        else:
            bare = middle
    return _envelope(wheel, table, side, bare, turn)


@outer
def _envelope(wheel, table, side, theta, turn):
    z, v, _ = centre_at(wheel, table, theta, turn)
    heading = v / abs(v)
    return z + (1 - 2 * side) * wheel.pin_radius * 1j * heading, heading


@kernel
def stretches_of(wheel, table, path, cells, margin, bare):
    """All bare `Stretches`, the left side forwards and the right side backwards."""
    size = len(path.z)
    runs, points = 0, 0
    whole = np.ones(2, np.bool_)
    for side in range(2):
        for k in range(size):
            points += bare[side, k]
            runs += bare[side, k] and not bare[side, k - 1]
            whole[side] &= bare[side, k]
        runs += whole[side]
    room = points + 2 * runs + 2
    first = np.zeros(runs + 1, np.int64)
    kind, begin, length = np.empty(runs, np.int64), np.empty(runs, np.int64), np.empty(runs, np.int64)
    point, heading = np.empty(room, np.complex128), np.empty(room, np.complex128)
    found = Stretches(first, point, heading, kind, begin, length)
    number = 0
    for side in range(2):
        for k in range(1 if whole[side] else size):
            if whole[side] or (bare[side, k] and not bare[side, k - 1]):
                kind[number], begin[number] = side, k
                _run(wheel, table, path, cells, margin, bare, found, number, whole[side])
                number += 1
    return found


@kernel
def _run(wheel, table, path, cells, margin, bare, found, number, whole):
    """Writes one stretch; a whole side ends where it begins."""
    side, k, at = found.side[number], found.begin[number], found.first[number]
    size, hint = len(path.z), np.zeros(1, np.int64)
    if not whole:
        found.point[at], found.heading[at] = _edge(wheel, table, path, cells, margin, hint, side, k, (k - 1) % size)
        at += 1
    length = 0
    while length < size and bare[side, (k + length) % size]:
        here = (k + length) % size
        heading = path.v[here] / abs(path.v[here])
        found.point[at], found.heading[at] = path.z[here] + (1 - 2 * side) * wheel.pin_radius * 1j * heading, heading
        at, length = at + 1, length + 1
    if whole:
        found.point[at], found.heading[at] = found.point[found.first[number]], found.heading[found.first[number]]
    else:
        last = (k + length - 1) % size
        found.point[at], found.heading[at] = _edge(wheel, table, path, cells, margin, hint, side, last, (last + 1) % size)
    at += 1
    found.length[number], found.first[number + 1] = length, at
    if side == 1:
        _turn_round(found, found.first[number], at - 1)


@outer
def _turn_round(found, low, high):
    """The points from `low` to `high` in the other order; loops, for slices that overlap take seconds to compile."""
    point, heading = found.point, found.heading
    for k in range(low, (low + high) // 2 + 1):
        other = low + high - k
        point[k], point[other] = point[other], point[k]
        heading[k], heading[other] = -heading[other], -heading[k]
