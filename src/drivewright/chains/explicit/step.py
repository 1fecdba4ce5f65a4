"""Kernels of the explicit step.  Loops over plates and joints have no branches and only unit strides, so that they become vector code.

Leapfrog: rates at half steps, places and loads at whole ones; loads that depend on rates take them predicted from the last acceleration.
A contact's force is its mean over the step, see `contact.mean_force`.
"""

import numpy as np

from drivewright._jit import elementwise, inner
from drivewright._typing import Floats, Records
from drivewright.chains.explicit.state import PLATES_PER_VECTOR, ChainConstants, Joints, Plates, Teeth, Touches, flank_energy, law_of
from drivewright.chains.touching.flank import flank_contact, is_active
from drivewright.contact.time_step import mean_force


@elementwise
def load_joints(chain: ChainConstants, p: Plates, j: Joints) -> None:
    """Rolling joints: stretch d = P - Q - 2r u, force f = k d + beta k d' on both plates where the two pins touch, midway between them.

    u is the mean of the two plates' directions.  The rate d' seen by both plates turning together is the relative velocity of the
    two plates there: so the force is pure rolling, and conserves angular momentum with damping too.  Articulation, the turning of the
    two plates against each other, is resisted by the torque c (w - w1).
    """
    k, damping, rolling_diameter, offset = chain.joint_stiffness, chain.joint_damping, chain.rolling_diameter, chain.offset
    articulation = chain.articulation_damping
    for i in range(PLATES_PER_VECTOR * chain.blocks):
        c, s, c1, s1 = p.c[i], p.s[i], p.c1[i], p.s1[i]
        x, y, x1, y1 = p.x[i], p.y[i], p.x1[i], p.y1[i]
        px, py = x + (p.half[i] * c + offset * s), y + (p.half[i] * s - offset * c)
        qx, qy = x1 - (p.half1[i] * c1 - offset * s1), y1 - (p.half1[i] * s1 + offset * c1)
        ux, uy = c + c1, s + s1
        share = rolling_diameter / np.sqrt(ux * ux + uy * uy)
        mx, my = 0.5 * (px + qx), 0.5 * (py + qy)
        w, w1 = p.w[i], p.w1[i]
        rx = (p.vx[i] - w * (my - y)) - (p.vx1[i] - w1 * (my - y1))
        ry = (p.vy[i] + w * (mx - x)) - (p.vy1[i] + w1 * (mx - x1))
        j.fx[i] = k * (px - qx - share * ux) + damping * rx
        j.fy[i] = k * (py - qy - share * uy) + damping * ry
        j.mx[i] = mx
        j.my[i] = my
        j.rx[i] = rx
        j.ry[i] = ry
        j.turn[i] = articulation * (w - w1)
    n = chain.count - 1
    j.fx_[0], j.fy_[0], j.mx_[0], j.my_[0], j.turn_[0] = j.fx[n], j.fy[n], j.mx[n], j.my[n], j.turn[n]


@elementwise
def joint_damping_work(chain: ChainConstants, p: Plates, j: Joints, dt: float) -> None:
    """Power and work of the joints' damping: its force and torque, at the predicted rates, on the way between the half steps.

    So the leapfrog's balance of energy is exact, however fast the joints shake.
    """
    damping = chain.joint_damping
    for i in range(PLATES_PER_VECTOR * chain.blocks):
        mx, my, w, w1 = j.mx[i], j.my[i], p.w[i], p.w1[i]
        rx = (p.vx[i] - w * (my - p.y[i])) - (p.vx1[i] - w1 * (my - p.y1[i]))
        ry = (p.vy[i] + w * (mx - p.x[i])) - (p.vy1[i] + w1 * (mx - p.x1[i]))
        power = damping * (rx * j.rx[i] + ry * j.ry[i]) + j.turn[i] * (w - w1)
        j.power[i] = power
        j.lost[i] += dt * power


@elementwise
def load_gravity(chain: ChainConstants, p: Plates, t: Touches) -> None:
    """Loads start anew with the weight."""
    for i in range(PLATES_PER_VECTOR * chain.blocks):
        p.fx[i] = p.gx[i]
        p.fy[i] = p.gy[i]
        p.moment[i] = 0.0
        t.stored[i] = 0.0


@elementwise
def load_flanks(chain: ChainConstants, p: Plates, t: Touches, b: Records, teeth: Teeth, n: int, first: int, last: int, dt: float) -> None:
    """Both flanks of the plates first .. last-1 on the involute teeth of sprocket n, and what they do to the plates.

    Depths as in `touching.flank`, forces by the law of the sprocket.
    """
    ca, sa, wide, offset = chain.cos, chain.sin, chain.flank_support, chain.offset
    law, rb, support = law_of(chain.laws, b[n], n), teeth.base[n], teeth.support[n]
    low, high, deep, top = teeth.low[n], teeth.high[n], chain.deepest, chain.highest
    bx, by, ux, uy, psi, spin = b.x[n], b.y[n], b.vx[n], b.vy[n], b.psi[n], b.w[n]
    for i in range(np.uint64(first), whole_vectors(first, last)):
        own = i < np.uint64(last)
        c, s, w = p.c[i], p.s[i], p.w[i]
        gx, gy = p.x[i] - bx, p.y[i] - by
        ex, ey = c * gx + s * gy, c * gy - s * gx - offset
        zx, zy = p.vx[i] - ux, p.vy[i] - uy
        dx, dy = c * zx + s * zy + w * (ey + offset), c * zy - s * zx - w * ex
        turned = rb * (p.angle[i] - psi - t.seat[i])
        turning = rb * (w - spin)
        pen_r, right, at_r = flank_contact(ca, sa, wide, rb, support, 1.0, ex, ey, turned)
        pen_l, left, at_l = flank_contact(ca, sa, wide, rb, support, -1.0, ex, ey, turned)
        rate_r = ca * dx - sa * dy - turning
        rate_l = -ca * dx - sa * dy + turning
        on_r = own & is_active(right, low, high, at_r, deep, top)
        on_l = own & is_active(left, low, high, at_l, deep, top)
        elastic_r, fr, _ = mean_force(law, pen_r, rate_r, dt)
        elastic_l, fl, _ = mean_force(law, pen_l, rate_l, dt)
        elastic_r, elastic_l = (elastic_r if on_r else 0.0), (elastic_l if on_l else 0.0)
        fr, fl = (fr if on_r else 0.0), (fl if on_l else 0.0)
        pen_r, pen_l = (max(pen_r, 0.0) if on_r else 0.0), (max(pen_l, 0.0) if on_l else 0.0)
        fx, fy = ca * (fl - fr), sa * (fl + fr)
        x, y, moment = c * fx - s * fy, s * fx + c * fy, fr * at_r - fl * at_l + offset * fx
        right_before, left_before = t.right[i], t.left[i]
        damped_right_before, damped_left_before = t.damped_right[i], t.damped_left[i]
        t.right[i], t.left[i] = (fr if own else right_before), (fl if own else left_before)
        t.damped_right[i] = fr - elastic_r if own else damped_right_before
        t.damped_left[i] = fl - elastic_l if own else damped_left_before
        t.fx[i], t.fy[i], t.torque[i] = x, y, rb * (fl - fr)
        t.stored[i] += flank_energy(chain.laws, law, pen_r, pen_l)
        p.fx[i] += x
        p.fy[i] += y
        p.moment[i] += moment


@elementwise
def flank_damping_work(
    chain: ChainConstants, p: Plates, t: Touches, b: Records, teeth: Teeth, n: int, first: int, last: int, dt: float
) -> None:
    """Power and work of the flanks' damping, as of the joints'."""
    ca, sa, rb = chain.cos, chain.sin, teeth.base[n]
    bx, by, ux, uy, spin = b.x[n], b.y[n], b.vx[n], b.vy[n], b.w[n]
    for i in range(np.uint64(first), whole_vectors(first, last)):
        own = i < np.uint64(last)
        c, s, w = p.c[i], p.s[i], p.w[i]
        gx, gy, zx, zy = p.x[i] - bx, p.y[i] - by, p.vx[i] - ux, p.vy[i] - uy
        across = ca * (c * zx + s * zy + w * (c * gy - s * gx))
        out = -sa * (c * zy - s * zx - w * (c * gx + s * gy))
        turning = rb * (w - spin)
        power, before = t.damped_right[i] * (out + across - turning) + t.damped_left[i] * (out - across + turning), t.power[i]
        t.power[i] = power if own else before
        t.lost[i] += dt * power if own else 0.0


@inner
def whole_vectors(first: int, last: int) -> np.uint64:
    """End of the whole vectors, from `first` on, that hold the plates first .. last-1; those behind `last` are left as they are.

    A run of few plates, as on an idler, would else go through its loop plate by plate.
    """
    most = np.uint64(PLATES_PER_VECTOR)
    return np.uint64(first) + (np.uint64(last - first) + (most - np.uint64(1))) // most * most


@inner
def total(row: Floats, first: int, last: int) -> float:
    """Sum of row[first:last] in eight strands."""
    a, b, c, d = 0.0, 0.0, 0.0, 0.0
    i = np.uint64(first)
    whole = np.uint64(first + (last - first) // 4 * 4)
    for m in range(i, whole, np.uint64(4)):
        a += row[m]
        b += row[m + np.uint64(1)]
        c += row[m + np.uint64(2)]
        d += row[m + np.uint64(3)]
    for m in range(whole, np.uint64(last)):
        a += row[m]
    return (a + b) + (c + d)


@inner
def add_reaction(t: Touches, b: Records, n: int, first: int, last: int) -> None:
    """What the plates first .. last-1 do to body n: the opposite of its forces on them."""
    b.fx[n] -= total(t.fx, first, last)
    b.fy[n] -= total(t.fy, first, last)
    b.torque[n] += total(t.torque, first, last)


@elementwise
def accelerate_plates(chain: ChainConstants, p: Plates, j: Joints) -> None:
    """Loads of the plates become accelerations, by their own load and the joints on both sides."""
    for i in range(PLATES_PER_VECTOR * chain.blocks):
        x, y = p.x[i], p.y[i]
        fx, fy, gx, gy = j.fx[i], j.fy[i], j.fx_[i], j.fy_[i]
        turn = j.turn_[i] - j.turn[i]
        moment = p.moment[i] + turn - (j.mx[i] - x) * fy + (j.my[i] - y) * fx + (j.mx_[i] - x) * gy - (j.my_[i] - y) * gx
        p.fx[i] = (p.fx[i] + gx - fx) * p.by_mass[i]
        p.fy[i] = (p.fy[i] + gy - fy) * p.by_mass[i]
        p.moment[i] = moment * p.by_inertia[i]


@elementwise
def kick_plates(chain: ChainConstants, p: Plates, dt: float) -> None:
    """Half-step rates by the accelerations, and the mean of these rates with those before."""
    for i in range(PLATES_PER_VECTOR * chain.blocks):
        ax, ay, a = p.fx[i], p.fy[i], p.moment[i]
        hx, hy, hw = p.hx[i], p.hy[i], p.hw[i]
        p.vx[i] = hx + 0.5 * dt * ax
        p.vy[i] = hy + 0.5 * dt * ay
        p.w[i] = hw + 0.5 * dt * a
        p.hx[i] = hx + dt * ax
        p.hy[i] = hy + dt * ay
        p.hw[i] = hw + dt * a


@elementwise
def drift_plates(chain: ChainConstants, p: Plates, dt: float) -> None:
    """Places by the half-step rates, directions by the increment of the angle (series, exact to 1e-19); rates predicted there."""
    for i in range(PLATES_PER_VECTOR * chain.blocks):
        e, c, s = dt * p.hw[i], p.c[i], p.s[i]
        e2 = e * e
        sin, versin = e * (1.0 - e2 * (1.0 / 6.0 - e2 / 120.0)), e2 * (0.5 - e2 * (1.0 / 24.0 - e2 / 720.0))
        p.x[i] += dt * p.hx[i]
        p.y[i] += dt * p.hy[i]
        p.angle[i] += e
        p.c[i] = c - (c * versin + s * sin)
        p.s[i] = s - (s * versin - c * sin)
        p.vx[i] = p.hx[i] + 0.5 * dt * p.fx[i]
        p.vy[i] = p.hy[i] + 0.5 * dt * p.fy[i]
        p.w[i] = p.hw[i] + 0.5 * dt * p.moment[i]


@inner
def close_rates(chain: ChainConstants, p: Plates) -> None:
    """The rates behind the last plate are a copy of those of the first one."""
    n = chain.count
    p.vx[n], p.vy[n], p.w[n] = p.vx[0], p.vy[0], p.w[0]


@inner
def close_ring(chain: ChainConstants, p: Plates) -> None:
    """The place behind the last plate holds a copy of the first one."""
    n = chain.count
    p.x[n], p.y[n], p.c[n], p.s[n] = p.x[0], p.y[0], p.c[0], p.s[0]
    close_rates(chain, p)
