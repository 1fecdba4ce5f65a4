"""Which part of the flanks survives: no roller, at any angle of the cam, may cover a point of the finished cam.

A point fixed to the cam is followed through one turn past all rollers.  Seen from the turret it lies at the angle chi; of all rollers the
one next to chi is nearest.  The gap g = max(distance from its axis - r, distance beyond its ends) is sampled at the knots of a table of
phi and every dip is refined.  A dip below -TOUCH covers the point.  The contact of the point with its own roller is a dip of depth 0.
"""

import numpy as np

from drivewright._jit import inner, kernel, warmer
from drivewright._typing import Bools, Floats
from drivewright.indexing.motion import TURN, IndexMotion
from drivewright.indexing.roller_gear.design import RollerGear
from drivewright.indexing.roller_gear.envelope import FlankContact

TOUCH = 1e-7  # of the roller's radius
KNOTS = 360
FAR = np.inf
FRONT = np.pi / 2  # rad from the line of centres: a roller beyond it is on the far side of the turret


def tabulate_motion(motion: IndexMotion, knots: int = KNOTS) -> tuple[Floats, Floats]:
    """(ends (n + 1,), coefficients (n, 6)): phi on each cell as a quintic of theta - ends[i], exact phi, phi', phi'' at both ends.

    No cell crosses a joint of the law, where higher derivatives jump.
    """
    ends, rows = [0.0], []
    for number, segment in enumerate(motion.segments):
        count = max(4, int(np.ceil(knots * (segment.stop - segment.start) / TURN)))
        theta = np.linspace(segment.start, segment.stop, count + 1)
        f, d1, d2, _ = motion.on_segment(number, theta)
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


def kernel_parameters(cam: RollerGear) -> Floats:
    """(10,): parameters of the cam for the kernels, SI: R, r, half length, C, h, cos b, sin b, hand sign, pitch of the rollers, phase."""
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
            cam.pin_pitch,
            cam.phase,
        ]
    )


@inner
def roller_gap(x: float, y: float, z: float, theta: float, phi: float, parameters: Floats) -> float:
    """Gap [m] of a point (x, y, z) of the cam to the nearest roller at the cam angle theta, negative inside the roller.

    parameters (10,): `kernel_parameters`.
    """
    radius, roller, half, centre, height, cosine, sine, hand, pitch, phase = parameters
    s, c = np.sin(hand * theta), np.cos(hand * theta)
    px, pz = x * c + z * s + centre, z * c - x * s + height
    angle = np.arctan2(y, px) - phi - pitch * phase
    angle -= pitch * np.round(angle / pitch)
    away = np.hypot(px, y)
    out, side = away * np.cos(angle) - radius, away * np.sin(angle)
    return max(np.hypot(pz * cosine - out * sine, side) - roller, abs(out * cosine + pz * sine) - half)


@inner
def _phi(cells, cell, h):
    """phi [rad] of a cell of the table (cells (n, 6)) at h [rad] from its start."""
    a = cells[cell]
    return a[0] + h * (a[1] + h * (a[2] + h * (a[3] + h * (a[4] + h * a[5]))))


@inner
def _gap_near(x, y, z, theta, i, j, ends, cells, parameters):
    """Gap at a theta near knot i = end of cell i - 1 and start of cell i; j is the cell before, the last one for i = 0.

    Arrays as for `minimum_gaps`; x, y, z [m], theta [rad].
    """
    turn = ends[-1]
    if theta >= ends[i]:
        phi = _phi(cells, i, theta - ends[i])
    elif i > 0:
        phi = _phi(cells, j, theta - ends[j])
    else:
        phi = _phi(cells, j, theta + turn - ends[j])  # a step too much, which only names another roller
    return roller_gap(x, y, z, theta, phi, parameters)


@inner
def _dip(x, y, z, i, j, ends, cells, parameters):
    """Least gap between the knots beside knot i, by golden section. Arrays as for `minimum_gaps`; x, y, z [m]."""
    golden = 0.6180339887498949
    a = ends[i] - (ends[j + 1] - ends[j])
    b = ends[i + 1]
    p, q = b - golden * (b - a), a + golden * (b - a)
    gp = _gap_near(x, y, z, p, i, j, ends, cells, parameters)
    gq = _gap_near(x, y, z, q, i, j, ends, cells, parameters)
    least = min(gp, gq)
    for _ in range(32):
        if gp < gq:
            b, q, gq = q, p, gp
            p = b - golden * (b - a)
            gp = _gap_near(x, y, z, p, i, j, ends, cells, parameters)
            least = min(least, gp)
        else:
            a, p, gp = p, q, gq
            q = a + golden * (b - a)
            gq = _gap_near(x, y, z, q, i, j, ends, cells, parameters)
            least = min(least, gq)
    return least


@kernel
def minimum_gaps(points: Floats, ends: Floats, cells: Floats, parameters: Floats, limit: float) -> Floats:
    """Least gap [m] (n,) of points (n, 3) of the cam to any roller at any angle of a turn; the search ends below -limit [m].

    ends (m + 1,) [rad], cells (m, 6): the table of phi; parameters (10,): `kernel_parameters`.
    """
    count = len(cells)
    reach = 1.2 * parameters[2] * parameters[6] + 1.5 * parameters[1] * parameters[5]  # rollers stay well within this height
    sines, cosines = np.sin(parameters[7] * ends), np.cos(parameters[7] * ends)
    result, gaps = np.empty(len(points)), np.empty(count)
    for n in range(len(points)):
        x, y, z = points[n]
        for i in range(count):
            px, pz = x * cosines[i] + z * sines[i] + parameters[3], z * cosines[i] - x * sines[i] + parameters[4]
            near = px > 0 and abs(pz) <= reach
            gaps[i] = roller_gap(x, y, z, ends[i], cells[i, 0], parameters) if near else FAR
        least = gaps.min()
        for i in range(count):
            j, k = (i - 1) % count, (i + 1) % count
            curvature = gaps[j] + gaps[k] - 2 * gaps[i]
            if least < -limit:
                break
            if gaps[i] < FAR and gaps[i] <= gaps[j] and gaps[i] <= gaps[k] and gaps[i] < max(least, 0.0) + curvature:
                least = min(least, _dip(x, y, z, i, j, ends, cells, parameters))
        result[n] = least
    return result


def in_front_of_blank(cam: RollerGear, contact: FlankContact) -> Bools:
    """Where contacts lie within the blank, of rollers on the cam's side of the turret: long steps bring them round to the other."""
    return (cam.in_blank(contact.point) >= -1e-12) & (np.abs(contact.psi) < FRONT)


class TrimmingTest:
    """Which points of one cam, in its own frame, lie on the finished cam."""

    def __init__(self, cam: RollerGear, knots: int = KNOTS):
        self.cam, self.parameters, self.table = cam, kernel_parameters(cam), tabulate_motion(cam.motion, knots)

    def minimum_gaps(self, points: Floats) -> Floats:
        """Least gap [m] (...,) of points (..., 3) to any roller over a turn; what is deeper than TOUCH is only known to be so."""
        flat = np.ascontiguousarray(points, dtype=float).reshape(-1, 3)
        limit = TOUCH * self.cam.roller_radius
        return minimum_gaps(flat, *self.table, self.parameters, limit).reshape(np.shape(points)[:-1])

    def on_cam(self, contact: FlankContact) -> Bools:
        """True where a Contact lies inside the blank, is no undercut and is covered by no roller."""
        on_cam = in_front_of_blank(self.cam, contact) & (contact.opening > 0)
        on_cam[on_cam] = self.minimum_gaps(contact.point[on_cam]) >= -TOUCH * self.cam.roller_radius
        return on_cam


@warmer
def _warm():
    ends = np.linspace(0.0, TURN, 5)
    minimum_gaps(np.zeros((1, 3)), ends, np.zeros((4, 6)), np.ones(10), 1e-9)
