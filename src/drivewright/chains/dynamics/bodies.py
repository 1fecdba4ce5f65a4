"""Kernels of what the chain touches beside involute teeth: roller seats, guides; and the motion of sprockets and guides themselves."""

import numpy as np

from drivewright._jit import inner
from drivewright.chains.dynamics.state import (
    DRIVE,
    FRICTION,
    GUIDE_DAMPING,
    IMPULSE_X,
    IMPULSE_Y,
    SLIDE_DAMPING,
    TORQUE,
    TURN_DAMPING,
    TURNING_IMPULSE,
)
from drivewright.chains.dynamics.step import total


@inner
def load_rollers(chain, p, t, b, teeth, n, first, last, dt):
    """Rollers on the right-hand pins of the plates first .. last-1 in the gaps of sprocket n.

    e is the roller's centre seen from that of the seat, mirrored to the right, y outward.  Within the seat's angle the depth is
    |e| + roller - ri, beyond it re + roller - |e - F| with F the centre of the flank's arc: both depth and normal are continuous.
    """
    k, damping, bx, by, spin = b.stiffness[n], b.damping[n], b.x[n], b.y[n], b.w[n]
    ex, ey, hx, hy = teeth.edge_x[n], teeth.edge_y[n], teeth.flank_x[n], teeth.flank_y[n]
    for i in range(first, last):
        rx, ry = p.half[i] * p.c[i] + chain.offset * p.s[i], p.half[i] * p.s[i] - chain.offset * p.c[i]
        gx, gy = p.x[i] + rx - bx, p.y[i] + ry - by
        c, s = np.cos(b.psi[n] + t.seat[i]), np.sin(b.psi[n] + t.seat[i])
        across, out = s * gx - c * gy, c * gx + s * gy - teeth.seat_at[n]
        mirror = 1.0 if across >= 0.0 else -1.0
        across *= mirror
        seated = ex * out - ey * across <= 0.0
        far = np.hypot(across, out) if seated else np.hypot(across - hx, out - hy)
        depth = far - teeth.seat_gap[n] if seated else teeth.flank_gap[n] - far
        near = 1.0 / max(far, 1e-15)
        nx, ny = (-across * near, -out * near) if seated else ((across - hx) * near, (out - hy) * near)
        nx *= mirror
        wx, wy = nx * s + ny * c, ny * s - nx * c
        zx, zy = p.vx[i] - p.w[i] * ry - b.vx[n] + spin * gy, p.vy[i] + p.w[i] * rx - b.vy[n] - spin * gx
        rate = -(wx * zx + wy * zy)
        on = depth > 0.0 and teeth.seat_at[n] + out < teeth.low[n]
        force = max(k * depth + damping * rate, 0.0) if on else 0.0
        t.fx[i], t.fy[i] = force * wx, force * wy
        t.torque[i] = -force * (gx * wy - gy * wx)
        t.power[i] = (force - k * depth) * rate if on else 0.0
        t.lost[i] += dt * t.power[i]
        t.stored[i] += 0.5 * k * depth * depth if on else 0.0
        t.right[i], t.left[i] = (force, 0.0) if seated else (0.0, force)
        p.moment[i] += force * (rx * wy - ry * wx)


@inner
def load_guide(chain, p, t, b, arcs, n, first, last, power):
    """Plates first .. last-1 on the arc of guide n, the body `n` + number of sprockets: the plate's back or belly as a straight line.

    depth = R + b -+ D_y with D its pin frame's origin seen from the arc's centre; friction -mu fn v/sqrt(v^2 + slip^2).
    """
    body = n + b.q.size - arcs.side.size
    k, damping, side, off = b.stiffness[body], b.damping[body], arcs.side[n], chain.offset
    lift = arcs.radius[n] + arcs.distance[n]
    for i in range(first, last):
        c, s, w = p.c[i], p.s[i], p.w[i]
        gx, gy = p.x[i] - b.x[body], p.y[i] - b.y[body]
        ex, ey = c * gx + s * gy, c * gy - s * gx - off
        zx, zy = p.vx[i] - b.vx[body], p.vy[i] - b.vy[body]
        depth = lift - side * ey
        rate = -side * (c * zy - s * zx - w * ex)
        within = side * (c * arcs.middle_y[n] - s * arcs.middle_x[n]) >= arcs.opening[n]
        on = depth > 0.0 and abs(ex) <= chain.half_plate and within
        force = max(k * depth + damping * rate, 0.0) if on else 0.0
        height = side * arcs.distance[n] + off  # of the mass centre above the place of contact
        slide = c * zx + s * zy + w * height
        drag = -arcs.friction[n] * force * slide / np.sqrt(slide * slide + arcs.slip[n] ** 2)
        t.fx[i], t.fy[i] = c * drag - s * side * force, s * drag + c * side * force
        t.torque[i] = side * arcs.radius[n] * drag
        t.stored[i] += 0.5 * k * depth * depth if on else 0.0
        p.moment[i] += -ex * side * force + height * drag
        power[GUIDE_DAMPING] -= (force - k * depth) * rate if on else 0.0
        power[FRICTION] += drag * slide


@inner
def move_bodies(b, gravity, clock, power, dt):
    """Sprockets and guides one step on: slides by the leapfrog, driven angles by their law, free ones by the leapfrog."""
    later = clock[0] + dt
    for n in range(b.q.size):
        add_power(b, n, power, 1.0)
        if b.slides[n]:
            b.aq[n] = slide_acceleration(b, gravity, n)
            b.hq[n] += dt * b.aq[n]
            b.q[n] += dt * b.hq[n]
            b.vq[n] = b.hq[n] + 0.5 * dt * b.aq[n]
            place(b, n)
        if b.driven[n]:
            follow(b, n, later)
        else:
            b.aw[n] = turn_acceleration(b, n)
            b.hw[n] += dt * b.aw[n]
            b.psi[n] += dt * b.hw[n]
            b.w[n] = b.hw[n] + 0.5 * dt * b.aw[n]
    clock[0] = later


@inner
def slide_acceleration(b, gravity, n):
    """Acceleration of body n along its slide."""
    along = (b.fx[n] + b.mass[n] * gravity[0]) * b.ux[n] + (b.fy[n] + b.mass[n] * gravity[1]) * b.uy[n]
    return (along + b.force[n] - b.spring[n] * b.q[n] - b.slide_damping[n] * b.vq[n]) / b.mass[n]


@inner
def turn_acceleration(b, n):
    """Angular acceleration of the free body n."""
    return (b.torque[n] + b.load[n] - b.turn_damping[n] * b.w[n]) / b.inertia[n]


@inner
def add_power(b, n, power, share):
    """Powers of drive and load, and the losses of body n, added to `power`."""
    if b.slides[n]:
        power[SLIDE_DAMPING] -= share * b.slide_damping[n] * b.vq[n] ** 2
    if b.driven[n]:
        power[DRIVE] -= share * b.torque[n] * b.w[n]
    else:
        power[TORQUE] += share * b.load[n] * b.w[n]
        power[TURN_DAMPING] -= share * b.turn_damping[n] * b.w[n] ** 2


@inner
def place(b, n):
    """Centre and its velocity of a body on its slide."""
    b.x[n] = b.x0[n] + b.q[n] * b.ux[n]
    b.y[n] = b.y0[n] + b.q[n] * b.uy[n]
    b.vx[n] = b.vq[n] * b.ux[n]
    b.vy[n] = b.vq[n] * b.uy[n]


@inner
def follow(b, n, time):
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
def impulse(chain, p, b, gravity, power):
    """Force and moment about the origin with which bodies and weight act on all plates, to check the momenta by."""
    for n in range(b.q.size):
        power[IMPULSE_X] -= b.fx[n]
        power[IMPULSE_Y] -= b.fy[n]
        power[TURNING_IMPULSE] -= b.torque[n] + b.x[n] * b.fy[n] - b.y[n] * b.fx[n]
    if gravity[0] != 0.0 or gravity[1] != 0.0:
        mass, count = chain.mass, chain.count
        power[IMPULSE_X] += count * mass * gravity[0]
        power[IMPULSE_Y] += count * mass * gravity[1]
        power[TURNING_IMPULSE] += mass * (total(p.x, 0, count) * gravity[1] - total(p.y, 0, count) * gravity[0])
