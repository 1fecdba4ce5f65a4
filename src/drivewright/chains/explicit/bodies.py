"""Kernels of what the chain touches beside involute teeth: roller seats, guides; and the motion of sprockets and guides themselves."""

import numpy as np

from drivewright._jit import elementwise, inner
from drivewright._typing import Floats, Records
from drivewright.chains.explicit.state import (
    DRIVE,
    FRICTION,
    GUIDE_DAMPING,
    IMPULSE_X,
    IMPULSE_Y,
    SLIDE_DAMPING,
    TORQUE,
    TURN_DAMPING,
    TURNING_IMPULSE,
    ChainConstants,
    Plates,
    Teeth,
    Touches,
    law_of,
)
from drivewright.chains.explicit.step import total, whole_vectors
from drivewright.chains.touching.guide import is_on_arc, nearest_on_plate
from drivewright.chains.touching.roller import roller_contact
from drivewright.contact.normal import stored_energy
from drivewright.contact.time_step import mean_force


@elementwise
def load_rollers(chain: ChainConstants, p: Plates, t: Touches, b: Records, teeth: Teeth, n: int, first: int, last: int, dt: float) -> None:
    """Rollers on the right-hand pins of the plates first .. last-1 in the gaps of sprocket n, and what they do to the plates.

    Depths as in `touching.roller`, of the roller's centre seen from that of the seat, mirrored to the right.
    """
    law, bx, by, spin = law_of(chain.laws, b[n], n), b.x[n], b.y[n], b.w[n]
    ex, ey, hx, hy = teeth.edge_x[n], teeth.edge_y[n], teeth.flank_x[n], teeth.flank_y[n]
    seat_at, seat_gap, flank_gap, low, ux, uy = teeth.seat_at[n], teeth.seat_gap[n], teeth.flank_gap[n], teeth.low[n], b.vx[n], b.vy[n]
    turned_c, turned_s = np.cos(b.psi[n]), np.sin(b.psi[n])
    for i in range(np.uint64(first), whole_vectors(first, last)):
        own = i < np.uint64(last)
        rx, ry = p.half[i] * p.c[i] + chain.offset * p.s[i], p.half[i] * p.s[i] - chain.offset * p.c[i]
        gx, gy = p.x[i] + rx - bx, p.y[i] + ry - by
        c, s = turned_c * t.seat_cos[i] - turned_s * t.seat_sin[i], turned_s * t.seat_cos[i] + turned_c * t.seat_sin[i]
        across, out = s * gx - c * gy, c * gx + s * gy - seat_at
        mirror = 1.0 if across >= 0.0 else -1.0
        across *= mirror
        depth, far, x, y, seated = roller_contact(across, out, ex, ey, hx, hy, seat_gap, flank_gap)
        near = 1.0 / max(far, 1e-15)
        nx, ny = (-x * near, -y * near) if seated else (x * near, y * near)
        nx *= mirror
        wx, wy = nx * s + ny * c, ny * s - nx * c
        zx, zy = p.vx[i] - p.w[i] * ry - ux + spin * gy, p.vy[i] + p.w[i] * rx - uy - spin * gx
        rate = -(wx * zx + wy * zy)
        elastic, force, touching = mean_force(law, depth, rate, dt)
        on = own & touching & (seat_at + out < low)
        elastic, force = (elastic if on else 0.0), (force if on else 0.0)
        fx, fy, power = force * wx, force * wy, (force - elastic) * rate
        right, left, before = t.right[i], t.left[i], t.power[i]
        t.right[i] = (force if seated else 0.0) if own else right
        t.left[i] = (0.0 if seated else force) if own else left
        t.power[i] = power if own else before
        t.lost[i] += dt * power
        t.stored[i] += stored_energy(law, -depth) if on else 0.0
        t.fx[i], t.fy[i], t.torque[i] = fx, fy, gy * fx - gx * fy
        p.fx[i] += fx
        p.fy[i] += fy
        p.moment[i] += rx * fy - ry * fx


@inner
def load_guide(
    chain: ChainConstants, p: Plates, t: Touches, b: Records, arcs: Records, n: int, first: int, last: int, power: Floats, dt: float
) -> None:
    """Plates first .. last-1 on guide n, the body `n` + number of sprockets; what friction and damping take goes to power (SUMS,) [W]."""
    load_plates_on_guide(chain, p, t, b, arcs, n, first, last, dt)
    power[GUIDE_DAMPING] -= total(t.guide_damped, first, last)
    power[FRICTION] += total(t.guide_rubbed, first, last)


@elementwise
def load_plates_on_guide(
    chain: ChainConstants, p: Plates, t: Touches, b: Records, arcs: Records, n: int, first: int, last: int, dt: float
) -> None:
    """Plates first .. last-1 on the arc of guide n: the plate's back or belly, half a pitch either way.

    r leads from the arc's centre to the nearest point of that line, which may be its end: where two plates make a corner towards the
    guide, the corner touches.  Depth R - |r|, normal r/|r|; friction -mu fn v/sqrt(v^2 + slip^2).
    """
    body = n + b.q.size - arcs.side.size
    turned_c, turned_s = (np.cos(b.psi[body]), np.sin(b.psi[body])) if b.swing[body] != 0.0 else (1.0, 0.0)
    middle_x = turned_c * arcs.middle_x[n] - turned_s * arcs.middle_y[n]
    middle_y = turned_s * arcs.middle_x[n] + turned_c * arcs.middle_y[n]
    law, side, half, opening, radius = law_of(chain.laws, b[body], body), arcs.side[n], chain.half_plate, arcs.opening[n], arcs.radius[n]
    friction, slip2 = arcs.friction[n], arcs.slip[n] ** 2
    bx, by, ux, uy, spin = b.x[body], b.y[body], b.vx[body], b.vy[body], b.w[body]
    py = -side * arcs.distance[n] - chain.offset  # of the line, above the mass centre
    for i in range(np.uint64(first), whole_vectors(first, last)):
        own = i < np.uint64(last)
        c, s, w = p.c[i], p.s[i], p.w[i]
        gx, gy = p.x[i] - bx, p.y[i] - by
        zx, zy = p.vx[i] - ux, p.vy[i] - uy
        ex, ry = c * gx + s * gy, c * gy - s * gx + py
        px, x, far = nearest_on_plate(ex, ry, half)
        by_far = 1.0 / max(far, 1e-15)
        nx, ny = x * by_far, ry * by_far
        vx, vy = c * zx + s * zy - w * py, c * zy - s * zx + w * px
        depth, rate = radius - far, -(nx * vx + ny * vy)
        within = is_on_arc(c, s, nx, ny, 1.0, middle_x, middle_y, opening)
        elastic, force, touching = mean_force(law, depth, rate, dt)
        on = own & touching & (side * ry > 0.0) & within
        elastic, force = (elastic if on else 0.0), (force if on else 0.0)
        slide = side * (ny * vx - nx * vy + far * spin)
        drag = -friction * force * slide / np.sqrt(slide * slide + slip2)
        fx, fy = nx * force + side * ny * drag, ny * force - side * nx * drag
        x, y, damped, rubbed = c * fx - s * fy, s * fx + c * fy, (force - elastic) * rate, drag * slide
        t.fx[i], t.fy[i], t.torque[i] = x, y, side * far * drag
        t.guide_damped[i], t.guide_rubbed[i] = damped, rubbed
        t.stored[i] += stored_energy(law, -depth) if on else 0.0
        p.fx[i] += x
        p.fy[i] += y
        p.moment[i] += px * fy - py * fx


@inner
def kick_bodies(b: Records, gravity: Floats, power: Floats, dt: float) -> None:
    """Accelerations of slides and free sprockets, half-step rates by them, their mean with those before; powers with these means.

    gravity (2,) [m/s^2]; power (SUMS,) [W, N, N m].
    """
    for n in range(b.q.size):
        if b.slides[n]:
            damped = b.slide_damping[n] * b.vq[n]
            b.aq[n] = slide_acceleration(b, gravity, n)
            set_rate(b, n, b.hq[n] + 0.5 * dt * b.aq[n])
            b.hq[n] += dt * b.aq[n]
            power[SLIDE_DAMPING] -= damped * b.vq[n]
        if b.swing[n] != 0.0:  # its friction is in that of the guide
            continue
        if b.driven[n]:
            power[DRIVE] -= b.torque[n] * b.w[n]
        else:
            damped = b.turn_damping[n] * b.w[n]
            b.aw[n] = turn_acceleration(b, n)
            b.w[n] = b.hw[n] + 0.5 * dt * b.aw[n]
            b.hw[n] += dt * b.aw[n]
            power[TORQUE] += b.load[n] * b.w[n]
            power[TURN_DAMPING] -= damped * b.w[n]


@inner
def drift_bodies(b: Records, clock: Floats, dt: float) -> None:
    """Places and predicted rates of sprockets and guides one step on; driven angles by their law. clock (2,) [s, -]."""
    later = (clock[1] + 1.0) * dt  # not summed up: a sum of so many steps loses digits
    for n in range(b.q.size):
        if b.slides[n]:
            b.q[n] += dt * b.hq[n]
            place_body(b, n)
            set_rate(b, n, b.hq[n] + 0.5 * dt * b.aq[n])
        if b.swing[n] != 0.0:
            continue
        if b.driven[n]:
            follow(b, n, later)
        else:
            b.psi[n] += dt * b.hw[n]
            b.w[n] = b.hw[n] + 0.5 * dt * b.aw[n]
    clock[0] = later


@inner
def place_body(b: Records, n: int) -> None:
    """Centre of body n by its place on the slide, or about its pivot; there the way on, and the angle of a guide."""
    if b.lever[n] == 0.0:
        b.x[n], b.y[n] = b.x0[n] + b.q[n] * b.ux[n], b.y0[n] + b.q[n] * b.uy[n]
        return
    angle = b.q[n] / b.lever[n]
    c, s, rx, ry = np.cos(angle), np.sin(angle), b.x0[n] - b.px[n], b.y0[n] - b.py[n]
    x, y = c * rx - s * ry, s * rx + c * ry
    b.x[n], b.y[n] = b.px[n] + x, b.py[n] + y
    b.ux[n], b.uy[n] = -y / b.lever[n], x / b.lever[n]
    if b.swing[n] != 0.0:
        b.psi[n] = angle


@inner
def set_rate(b: Records, n: int, rate: float) -> None:
    """Rate of body n along its slide, and of its centre; of a guide about its pivot also that of its angle."""
    b.vq[n] = rate
    b.vx[n], b.vy[n] = rate * b.ux[n], rate * b.uy[n]
    if b.swing[n] != 0.0:
        b.w[n] = rate * b.swing[n]


@inner
def slide_acceleration(b: Records, gravity: Floats, n: int) -> float:
    """Acceleration of body n along its slide. gravity (2,) [m/s^2]; in [m/s^2]."""
    along = (b.fx[n] + b.weight[n] * gravity[0]) * b.ux[n] + (b.fy[n] + b.weight[n] * gravity[1]) * b.uy[n] + b.torque[n] * b.swing[n]
    return (along + b.force[n] - b.spring[n] * b.q[n] - b.slide_damping[n] * b.vq[n]) / b.mass[n]


@inner
def turn_acceleration(b: Records, n: int) -> float:
    """Angular acceleration of the free body n."""
    return (b.torque[n] + b.load[n] - b.turn_damping[n] * b.w[n]) / b.inertia[n]


@inner
def follow(b: Records, n: int, time: float) -> None:
    """Prescribed angle and speed: w = start + (speed - start)(x - sin(2 pi x)/(2 pi)), x = t/ramp up to 1, and its integral."""
    change, ramp = b.speed[n] - b.start[n], b.ramp[n]
    if time >= ramp:
        b.w[n] = b.speed[n]
        b.psi[n] = b.psi0[n] + 0.5 * (b.start[n] + b.speed[n]) * ramp + b.speed[n] * (time - ramp)
    else:
        x = time / ramp
        b.w[n] = b.start[n] + change * (x - np.sin(2 * np.pi * x) / (2 * np.pi))
        b.psi[n] = b.psi0[n] + b.start[n] * time + change * ramp * (0.5 * x * x - (1 - np.cos(2 * np.pi * x)) / (4 * np.pi**2))


@inner
def impulse(chain: ChainConstants, p: Plates, b: Records, gravity: Floats, power: Floats) -> None:
    """Force and moment about the origin with which bodies and weight act on all plates, to check the momenta by.

    gravity (2,) [m/s^2]; power (SUMS,) [W, N, N m].
    """
    for n in range(b.q.size):
        power[IMPULSE_X] -= b.fx[n]
        power[IMPULSE_Y] -= b.fy[n]
        power[TURNING_IMPULSE] -= b.torque[n] + b.x[n] * b.fy[n] - b.y[n] * b.fx[n]
    if gravity[0] != 0.0 or gravity[1] != 0.0:
        mass, count = chain.mass, chain.count
        power[IMPULSE_X] += count * mass * gravity[0]
        power[IMPULSE_Y] += count * mass * gravity[1]
        power[TURNING_IMPULSE] += mass * (total(p.x, 0, count) * gravity[1] - total(p.y, 0, count) * gravity[0])
