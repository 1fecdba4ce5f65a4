"""Kernels of a run: loads, steps, and who may touch whom."""

import numpy as np

from drivewright._jit import inner, outer, plain
from drivewright.chains.dynamics.bodies import (
    drift_bodies,
    impulse,
    kick_bodies,
    load_guide,
    load_rollers,
    slide_acceleration,
    turn_acceleration,
)
from drivewright.chains.dynamics.shots import shoot
from drivewright.chains.dynamics.step import (
    acceleration,
    close_rates,
    close_ring,
    drift_plates,
    kick_plates,
    load_flanks,
    load_gravity,
    load_joints,
    lose_flanks,
    lose_joints,
    take_on,
)


@outer
def run(drive, shots, first, last, every, again, dt):
    """Shots first .. last-1, `every` steps apart; candidates for contact are sought anew every `again` steps."""
    chain, p, j, t, b, teeth, arcs, runs, gravity, clock, power, sums = drive
    for shot in range(first, last):
        for n in range(every):
            if clock[1] % again == 0.0:
                seek(chain, p, t, b, teeth, arcs, runs)
            load(chain, p, j, t, b, teeth, arcs, runs, gravity, power, dt)
            kick(chain, p, j, t, b, teeth, runs, gravity, power, dt)
            if n == 0:
                shoot(chain, p, j, t, b, clock, power, sums, shots, shot, dt)
            drift(chain, p, b, clock, power, sums, dt)


def settle_rates(drive, dt):
    """From rates at the first whole step to those half a step earlier, which the leapfrog starts with; once, so not worth compiling."""
    chain, p, j, t, b, teeth, arcs, runs, gravity, _, power, _ = drive
    plain(seek)(chain, p, t, b, teeth, arcs, runs)
    plain(load)(chain, p, j, t, b, teeth, arcs, runs, gravity, power, dt)
    rates = np.array([plain(acceleration)(p, j, i) for i in range(chain.count)]).T
    for half, rate in zip((p.hx, p.hy, p.hw), rates, strict=True):
        half[: chain.count] -= 0.5 * dt * rate
    for n in range(b.q.size):
        if b.slides[n]:
            b.hq[n] -= 0.5 * dt * plain(slide_acceleration)(b, gravity, n)
        if not b.driven[n]:
            b.hw[n] -= 0.5 * dt * plain(turn_acceleration)(b, n)
    t.lost[:] = 0.0


@inner
def load(chain, p, j, t, b, teeth, arcs, runs, gravity, power, dt):
    """All loads at the present places and predicted rates."""
    sprockets = teeth.base.size
    for n in range(b.q.size):
        b.fx[n], b.fy[n], b.torque[n] = 0.0, 0.0, 0.0
    for k in range(power.size):
        power[k] = 0.0
    load_joints(chain, p, j)
    load_gravity(chain, p, t)
    for r in range(runs.size[0]):
        n, first, last = runs.body[r], runs.first[r], runs.last[r]
        if n >= sprockets:
            load_guide(chain, p, t, b, arcs, n - sprockets, first, last, power, dt)
        elif teeth.rolls[n]:
            load_rollers(chain, p, t, b, teeth, n, first, last, dt)
        else:
            load_flanks(chain, p, t, b, teeth, n, first, last, dt)
        take_on(p, t, b, n, first, last)
    impulse(chain, p, b, gravity, power)


@inner
def kick(chain, p, j, t, b, teeth, runs, gravity, power, dt):
    """Rates one step on under the loads, and what damping takes meanwhile."""
    kick_plates(chain, p, j, dt)
    close_rates(chain, p)
    kick_bodies(b, gravity, power, dt)
    if chain.joint_damping + chain.articulation_damping > 0.0:
        lose_joints(chain, p, j, dt)
    for r in range(runs.size[0]):
        n = runs.body[r]
        if n < teeth.base.size and not teeth.rolls[n] and b.damping[n] > 0.0:
            lose_flanks(chain, p, t, b, teeth, n, runs.first[r], runs.last[r], dt)


@inner
def drift(chain, p, b, clock, power, sums, dt):
    """Places one step on."""
    drift_plates(chain, p, dt)
    close_ring(chain, p)
    drift_bodies(b, clock, dt)
    for k in range(power.size):
        sums[k] += dt * power[k]
    clock[1] += 1.0


# ------------------------------------------------------------------------------------------------------- who may touch whom


@inner
def seek(chain, p, t, b, teeth, arcs, runs):
    """Runs of plates near each body, the tooth that each of them may sit on; directions anew from the angles, free of drift."""
    for i in range(chain.count):
        p.c[i], p.s[i] = np.cos(p.angle[i]), np.sin(p.angle[i])
        t.right[i], t.left[i], t.power[i] = 0.0, 0.0, 0.0
    close_ring(chain, p)
    size = 0
    for n in range(b.q.size):
        before = -2
        for i in range(chain.count):
            if not near(chain, p.x[i], p.y[i], b, teeth, arcs, n):
                continue
            if i == before + 1:
                runs.last[size - 1] = i + 1
            else:
                runs.body[size], runs.first[size], runs.last[size] = n, i, i + 1
                size += 1
            before = i
            if n < teeth.base.size:
                t.seat[i] = seat_of(p, b, teeth, n, i)
    runs.size[0] = size


@inner
def near(chain, x, y, b, teeth, arcs, n):
    """Whether a plate at (x, y) may touch body n soon; of the sprockets only the nearest counts."""
    sprockets = teeth.base.size
    far = np.hypot(x - b.x[n], y - b.y[n])
    if n >= sprockets:
        return far < arcs.radius[n - sprockets] + abs(arcs.distance[n - sprockets]) + 4 * chain.half_plate
    spare, nearest = far - teeth.reach[n], True
    for m in range(sprockets):
        nearest &= m == n or np.hypot(x - b.x[m], y - b.y[m]) - teeth.reach[m] >= spare
    return spare < 0 and nearest


@inner
def seat_of(p, b, teeth, n, i):
    """Angle of the tooth (of the gap, for rollers) nearest to plate i, against psi: for plates less a right angle, and in whole turns
    as the plate's own angle."""
    phi = teeth.pitch_angle[n]
    if teeth.rolls[n]:
        x, y = p.x[i] + p.half[i] * p.c[i] - b.x[n], p.y[i] + p.half[i] * p.s[i] - b.y[n]
        return (np.floor((np.arctan2(y, x) - b.psi[n]) / phi) + 0.5) * phi
    polar = np.arctan2(p.y[i] - b.y[n], p.x[i] - b.x[n])
    seat = np.round((polar - b.psi[n]) / phi) * phi - 0.5 * np.pi
    return seat + 2 * np.pi * np.round((p.angle[i] - b.psi[n] - seat) / (2 * np.pi))
