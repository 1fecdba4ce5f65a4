"""Kernels that write one row of the record: energies, works, momenta, and what the plates, joints and sprockets feel."""

from typing import NamedTuple

import numpy as np

from drivewright._jit import inner
from drivewright.chains.dynamics.bodies import add_power, slide_acceleration, turn_acceleration
from drivewright.chains.dynamics.state import SUMS
from drivewright.chains.dynamics.step import acceleration, total

ROW = ("t", "kinetic", "potential", "momentum x", "momentum y", "angular momentum", "contacts", "open joints", "utilisation",
       "joint damping", "contact damping", *SUMS)
(T, KINETIC, POTENTIAL, MOMENTUM_X, MOMENTUM_Y, ANGULAR, CONTACTS, OPEN, UTILISATION, JOINT_DAMPING, CONTACT_DAMPING, WORKS) = range(12)
BODY = ("q", "vq", "psi", "w", "fx", "fy", "torque")
PLATE = ("x", "y", "angle", "left x", "left y", "right x", "right y", "left flank", "right flank")
PRESSED = 0.05  # part of the largest joint force below which friction utilisation is not asked for


class Log(NamedTuple):
    """Rows (samples, ROW), bodies (samples, bodies, BODY), tension (samples, joints), plate (samples, PLATE); of which joints, plate."""

    rows: np.ndarray
    bodies: np.ndarray
    tension: np.ndarray
    plate: np.ndarray
    joints: np.ndarray
    watched: np.ndarray


@inner
def measure(drive, log, sample, dt):
    """One row of the record, at a whole step under its loads, before the rates move on."""
    row = log.rows[sample]
    row[T] = drive.clock[0]
    measure_plates(drive, row, dt)
    measure_joints(drive, log, sample)
    measure_bodies(drive, log, sample, dt)
    measure_works(drive, row, dt)
    measure_watched(drive, log, sample)


@inner
def twice(v, a, dt):
    """Product of the rates half a step before and after: v^2 - (dt a/2)^2.

    With it the leapfrog's kinetic energy changes by exactly the mean force of two steps times the path between them, so that the energy of
    a linear system without damping does not change at all.
    """
    return v * v - 0.25 * dt * dt * a * a


@inner
def measure_plates(drive, row, dt):
    """Kinetic energy (product of the half steps on both sides), momenta, energy of weight and contacts of all plates."""
    chain, p, t, m = drive.chain, drive.plates, drive.touches, drive.chain.mass
    for i in range(chain.count):
        ax, ay, a = acceleration(p, drive.joints, i)
        vx, vy, w = p.hx[i] + 0.5 * dt * ax, p.hy[i] + 0.5 * dt * ay, p.hw[i] + 0.5 * dt * a
        row[KINETIC] += 0.5 * (m * (twice(vx, ax, dt) + twice(vy, ay, dt)) + chain.inertia * twice(w, a, dt))
        row[POTENTIAL] += t.stored[i] - m * (drive.gravity[0] * p.x[i] + drive.gravity[1] * p.y[i])
        row[MOMENTUM_X] += m * vx
        row[MOMENTUM_Y] += m * vy
        row[ANGULAR] += m * (p.x[i] * vy - p.y[i] * vx) + chain.inertia * w
        row[CONTACTS] += (t.right[i] > 0.0) + (t.left[i] > 0.0)


@inner
def along(drive, i):
    """(tension, force across) of joint i, in the mean direction of its plates, and the energy stored in it."""
    chain, p, j = drive.chain, drive.plates, drive.joints
    ux, uy = p.c[i] + p.c1[i], p.s[i] + p.s1[i]
    size = np.hypot(ux, uy)
    ux, uy = ux / size, uy / size
    px, py = p.x[i] + p.half[i] * p.c[i] + chain.offset * p.s[i], p.y[i] + p.half[i] * p.s[i] - chain.offset * p.c[i]
    qx, qy = p.x1[i] - p.half1[i] * p.c1[i] + chain.offset * p.s1[i], p.y1[i] - p.half1[i] * p.s1[i] - chain.offset * p.c1[i]
    dx, dy = px - qx - chain.rolling * ux, py - qy - chain.rolling * uy
    return -j.fx[i] * ux - j.fy[i] * uy, j.fy[i] * ux - j.fx[i] * uy, 0.5 * chain.joint_stiffness * (dx * dx + dy * dy)


@inner
def measure_joints(drive, log, sample):
    """Energy stored in the joints, how many are open (pushed apart), the most friction that pure rolling asks for, tensions."""
    row, most = log.rows[sample], 0.0
    for i in range(drive.chain.count):
        tension, across, energy = along(drive, i)
        row[POTENTIAL] += energy
        row[OPEN] += tension <= 0.0
        most = max(most, tension)
    for i in range(drive.chain.count):
        tension, across, energy = along(drive, i)
        if tension > PRESSED * most:
            row[UTILISATION] = max(row[UTILISATION], abs(across) / tension)
    for k in range(log.joints.size):
        log.tension[sample, k] = along(drive, log.joints[k])[0]


@inner
def measure_bodies(drive, log, sample, dt):
    """Energy and motion of sprockets and guides; those that are driven count as outside."""
    b, row, gravity = drive.bodies, log.rows[sample], drive.gravity
    for n in range(b.q.size):
        out = log.bodies[sample, n]
        out[0], out[1], out[2], out[3] = b.q[n], b.vq[n], b.psi[n], b.w[n]
        out[4], out[5], out[6] = b.fx[n], b.fy[n], b.torque[n]
        if b.slides[n]:
            a, q, weight = slide_acceleration(b, gravity, n), b.q[n], b.mass[n] * (gravity[0] * b.ux[n] + gravity[1] * b.uy[n])
            row[KINETIC] += 0.5 * b.mass[n] * twice(b.hq[n] + 0.5 * dt * a, a, dt)
            row[POTENTIAL] += 0.5 * b.spring[n] * q * q - (b.force[n] + weight) * q
        if not b.driven[n]:
            a = turn_acceleration(b, n)
            row[KINETIC] += 0.5 * b.inertia[n] * twice(b.hw[n] + 0.5 * dt * a, a, dt)
        add_power(b, n, drive.power, 1.0)


@inner
def measure_works(drive, row, dt):
    """Works up to now; this step counts with half its weight, the trapezoidal rule, which the leapfrog obeys exactly."""
    j, t, count = drive.joints, drive.touches, drive.chain.count
    row[JOINT_DAMPING] = 0.5 * dt * total(j.power, 0, count) - total(j.lost, 0, count)
    row[CONTACT_DAMPING] = 0.5 * dt * total(t.power, 0, count) - total(t.lost, 0, count)
    for k in range(drive.power.size):
        row[WORKS + k] = drive.sums[k] + 0.5 * dt * drive.power[k]
    for n in range(drive.bodies.q.size):
        add_power(drive.bodies, n, drive.power, -1.0)  # the step itself will add them


@inner
def measure_watched(drive, log, sample):
    """Pose of the watched plate and the forces on it: pins in its own frame, flanks along their normals."""
    p, j, t, i, out = drive.plates, drive.joints, drive.touches, log.watched[0], log.plate[sample]
    c, s = p.c[i], p.s[i]
    out[0], out[1], out[2] = p.x[i], p.y[i], p.angle[i]
    out[3], out[4] = c * j.fx_[i] + s * j.fy_[i], c * j.fy_[i] - s * j.fx_[i]
    out[5], out[6] = -c * j.fx[i] - s * j.fy[i], s * j.fx[i] - c * j.fy[i]
    out[7], out[8] = t.left[i], t.right[i]
