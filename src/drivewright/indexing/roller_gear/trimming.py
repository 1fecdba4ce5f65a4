"""Which part of the flanks survives: no roller, at any angle of the cam, may cover a point of the finished cam.

A point fixed to the cam is followed through one turn past all rollers.  Seen from the turret it lies at the angle chi; of all rollers the
one next to chi is nearest.  The gap g = max(distance from its axis - r, distance beyond its ends) is sampled at the knots of a table of
phi and every dip is refined.  A dip below -TOUCH covers the point.  The contact of the point with its own roller is a dip of depth 0.
"""

import numpy as np

from drivewright._jit import inner, kernel, warmer
from drivewright.indexing.motion import TURN

TOUCH = 1e-7  # of the roller's radius
KNOTS = 360
AWAY = np.inf


def motion_table(motion, knots=KNOTS):
    """(ends (n + 1,), coefficients (n, 6)): phi on each cell as a quintic of theta - ends[i], exact phi, phi', phi'' at both ends.

    No cell crosses a joint of the law, where higher derivatives jump.
    """
    ends, rows = [0.0], []
    for stretch in motion.stretches:
        count = max(4, int(np.ceil(knots * (stretch.stop - stretch.start) / TURN)))
        theta = np.linspace(stretch.start, stretch.stop, count + 1)
        f, d1, d2, _ = motion.on(stretch, theta)
        rows.append(_quintic(np.diff(theta), f, d1, d2))
        ends.extend(theta[1:])
    return np.array(ends), np.concatenate(rows)


def _quintic(h, f, d1, d2):
    """Coefficients (n, 6), rising powers, of the quintic Hermite pieces."""
    a0, a1, a2 = f[:-1], d1[:-1], d2[:-1] / 2
    e0 = f[1:] - (a0 + h * (a1 + h * a2))
    e1, e2 = d1[1:] - (a1 + 2 * h * a2), d2[1:] - 2 * a2
    a3 = (10 * e0 - 4 * h * e1 + h**2 * e2 / 2) / h**3
    a4 = (-15 * e0 + 7 * h * e1 - h**2 * e2) / h**4
    a5 = (6 * e0 - 3 * h * e1 + h**2 * e2 / 2) / h**5
    return np.stack([a0, a1, a2, a3, a4, a5], axis=1)


def shape(cam):
    """Numbers of the cam that the kernels read: R, r, half length, C, h, cos b, sin b, hand sign, pitch, phase."""
    return np.array(
        [
            cam.pin_circle_radius,
            cam.roller_radius,
            cam.roller_length / 2,
            cam.centre_distance,
            cam.height,
            cam.cosine,
            cam.sine,
            cam.hand_sign,
            cam.motion.pitch,
            cam.phase,
        ]
    )


@inner
def gap_at(x, y, z, theta, phi, numbers):
    """Gap [m] of a point (x, y, z) of the cam to the nearest roller at the cam angle theta, negative inside the roller."""
    radius, roller, half, centre, height, cosine, sine, hand, pitch, phase = numbers
    s, c = np.sin(hand * theta), np.cos(hand * theta)
    px, pz = x * c + z * s + centre, z * c - x * s + height
    angle = np.arctan2(y, px) - phi - pitch * phase
    angle -= pitch * np.round(angle / pitch)
    away = np.hypot(px, y)
    out, side = away * np.cos(angle) - radius, away * np.sin(angle)
    return max(np.hypot(pz * cosine - out * sine, side) - roller, abs(out * cosine + pz * sine) - half)


@inner
def _phi(cells, cell, h):
    a = cells[cell]
    return a[0] + h * (a[1] + h * (a[2] + h * (a[3] + h * (a[4] + h * a[5]))))


@inner
def _gap_near(x, y, z, theta, i, j, ends, cells, numbers):
    """Gap at a theta near knot i = end of cell i - 1 and start of cell i; j is the cell before, the last one for i = 0."""
    turn = ends[-1]
    if theta >= ends[i]:
        phi = _phi(cells, i, theta - ends[i])
    elif i > 0:
        phi = _phi(cells, j, theta - ends[j])
    else:
        phi = _phi(cells, j, theta + turn - ends[j])  # a pitch too much, which only names another roller
    return gap_at(x, y, z, theta, phi, numbers)


@inner
def _dip(x, y, z, i, j, ends, cells, numbers):
    """Least gap between the knots beside knot i, by golden section."""
    golden = 0.6180339887498949
    a = ends[i] - (ends[j + 1] - ends[j])
    b = ends[i + 1]
    p, q = b - golden * (b - a), a + golden * (b - a)
    gp = _gap_near(x, y, z, p, i, j, ends, cells, numbers)
    gq = _gap_near(x, y, z, q, i, j, ends, cells, numbers)
    least = min(gp, gq)
    for _ in range(32):
        if gp < gq:
            b, q, gq = q, p, gp
            p = b - golden * (b - a)
            gp = _gap_near(x, y, z, p, i, j, ends, cells, numbers)
            least = min(least, gp)
        else:
            a, p, gp = p, q, gq
            q = a + golden * (b - a)
            gq = _gap_near(x, y, z, q, i, j, ends, cells, numbers)
            least = min(least, gq)
    return least


@kernel
def least_gaps(points, ends, cells, numbers, limit):
    """Least gap [m] (n,) of points (n, 3) of the cam to any roller at any angle of a turn; the search ends below -limit."""
    count = len(cells)
    reach = 1.2 * numbers[2] * numbers[6] + 1.5 * numbers[1] * numbers[5]  # rollers stay well within this height
    sines, cosines = np.sin(numbers[7] * ends), np.cos(numbers[7] * ends)
    result, gaps = np.empty(len(points)), np.empty(count)
    for n in range(len(points)):
        x, y, z = points[n]
        for i in range(count):
            px, pz = x * cosines[i] + z * sines[i] + numbers[3], z * cosines[i] - x * sines[i] + numbers[4]
            near = px > 0 and abs(pz) <= reach
            gaps[i] = gap_at(x, y, z, ends[i], cells[i, 0], numbers) if near else AWAY
        least = gaps.min()
        for i in range(count):
            j, k = (i - 1) % count, (i + 1) % count
            bend = gaps[j] + gaps[k] - 2 * gaps[i]
            if least < -limit:
                break
            if gaps[i] < AWAY and gaps[i] <= gaps[j] and gaps[i] <= gaps[k] and gaps[i] < max(least, 0.0) + bend:
                least = min(least, _dip(x, y, z, i, j, ends, cells, numbers))
        result[n] = least
    return result


class Survivors:
    """Cover test of one cam; `margin` says for points of its frame whether they lie on the finished cam."""

    def __init__(self, cam, knots=KNOTS):
        self.cam, self.numbers, self.table = cam, shape(cam), motion_table(cam.motion, knots)

    def least_gap(self, points):
        """Least gap [m] (...,) of points (..., 3) to any roller over a turn; what is deeper than TOUCH is only known to be so."""
        flat = np.ascontiguousarray(points, dtype=float).reshape(-1, 3)
        limit = TOUCH * self.cam.roller_radius
        return least_gaps(flat, *self.table, self.numbers, limit).reshape(np.shape(points)[:-1])

    def alive(self, touching):
        """True where a Contact lies inside the blank, is no undercut and is covered by no roller."""
        alive = (self.cam.in_blank(touching.point) >= -1e-12) & (touching.opening > 0)
        alive[alive] = self.least_gap(touching.point[alive]) >= -TOUCH * self.cam.roller_radius
        return alive


@warmer
def _warm():
    ends = np.linspace(0.0, TURN, 5)
    least_gaps(np.zeros((1, 3)), ends, np.zeros((4, 6)), np.ones(10), 1e-9)
