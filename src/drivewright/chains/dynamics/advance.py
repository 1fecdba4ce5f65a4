"""Kernels of a run: loads, steps, and who may touch whom."""

import numpy as np

from drivewright._jit import inner, outer, plain
from drivewright.chains.dynamics.bodies import impulse, load_guide, load_rollers, move_bodies, slide_acceleration, turn_acceleration
from drivewright.chains.dynamics.measure import measure
from drivewright.chains.dynamics.step import (
    acceleration,
    close_ring,
    drift_plates,
    kick_plates,
    load_flanks,
    load_gravity,
    load_joints,
    take_on,
)


@outer
def run(drive, log, first, last, every, again, dt):
    """Samples first .. last-1 of the log, `every` steps apart; candidates for contact are sought anew every `again` steps."""
    for sample in range(first, last):
        for n in range(every):
            if drive.clock[1] % again == 0.0:
                seek(drive)
            load(drive, dt)
            if n == 0:
                measure(drive, log, sample, dt)
            advance(drive, dt)


def settle_rates(drive, dt):
    """From rates at the first whole step to those half a step earlier, which the leapfrog starts with; once, so not worth compiling."""
    chain, p, b = drive.chain, drive.plates, drive.bodies
    plain(seek)(drive)
    plain(load)(drive, dt)
    rates = np.array([plain(acceleration)(p, drive.joints, i) for i in range(chain.count)]).T
    for half, rate in zip((p.hx, p.hy, p.hw), rates, strict=True):
        half[: chain.count] -= 0.5 * dt * rate
    for n in range(b.q.size):
        if b.slides[n]:
            b.hq[n] -= 0.5 * dt * plain(slide_acceleration)(b, drive.gravity, n)
        if not b.driven[n]:
            b.hw[n] -= 0.5 * dt * plain(turn_acceleration)(b, n)
    drive.joints.lost[:] = 0.0
    drive.touches.lost[:] = 0.0


@inner
def load(drive, dt):
    """All loads at the present places and rates."""
    chain, p, j, t, b, runs = drive.chain, drive.plates, drive.joints, drive.touches, drive.bodies, drive.runs
    sprockets = drive.teeth.base.size
    for n in range(b.q.size):
        b.fx[n], b.fy[n], b.torque[n] = 0.0, 0.0, 0.0
    for k in range(drive.power.size):
        drive.power[k] = 0.0
    load_joints(chain, p, j, dt)
    load_gravity(chain, p, t)
    for r in range(runs.size[0]):
        n, first, last = runs.body[r], runs.first[r], runs.last[r]
        if n >= sprockets:
            load_guide(chain, p, t, b, drive.arcs, n - sprockets, first, last, drive.power)
        elif drive.teeth.rolls[n]:
            load_rollers(chain, p, t, b, drive.teeth, n, first, last, dt)
        else:
            load_flanks(chain, p, t, b, drive.teeth, n, first, last, dt)
        take_on(p, t, b, n, first, last)
    impulse(chain, p, b, drive.gravity, drive.power)


@inner
def advance(drive, dt):
    """One step of everything under the loads."""
    kick_plates(drive.chain, drive.plates, drive.joints, dt)
    drift_plates(drive.chain, drive.plates, dt)
    close_ring(drive.chain, drive.plates)
    move_bodies(drive.bodies, drive.gravity, drive.clock, drive.power, dt)
    for k in range(drive.power.size):
        drive.sums[k] += dt * drive.power[k]
    drive.clock[1] += 1.0


# ------------------------------------------------------------------------------------------------------- who may touch whom


@inner
def seek(drive):
    """Runs of plates near each body, the tooth that each of them may sit on; directions anew from the angles, free of drift."""
    chain, p, t, b, runs = drive.chain, drive.plates, drive.touches, drive.bodies, drive.runs
    for i in range(chain.count):
        p.c[i], p.s[i] = np.cos(p.angle[i]), np.sin(p.angle[i])
        t.right[i], t.left[i], t.power[i] = 0.0, 0.0, 0.0
    close_ring(chain, p)
    runs.size[0] = 0
    for n in range(b.q.size):
        before = -2
        for i in range(chain.count):
            if not near(drive, n, i):
                continue
            if i == before + 1:
                runs.last[runs.size[0] - 1] = i + 1
            else:
                k = runs.size[0]
                runs.body[k], runs.first[k], runs.last[k] = n, i, i + 1
                runs.size[0] = k + 1
            before = i
            if n < drive.teeth.base.size:
                t.seat[i] = seat_of(drive, n, i)


@inner
def near(drive, n, i):
    """Whether plate i may touch body n soon; of the sprockets only the nearest counts."""
    b, p, sprockets = drive.bodies, drive.plates, drive.teeth.base.size
    far = np.hypot(p.x[i] - b.x[n], p.y[i] - b.y[n])
    if n >= sprockets:
        return far < drive.arcs.radius[n - sprockets] + abs(drive.arcs.distance[n - sprockets]) + 4 * drive.chain.half_plate
    if far >= drive.teeth.reach[n]:
        return False
    for m in range(sprockets):
        if m != n and np.hypot(p.x[i] - b.x[m], p.y[i] - b.y[m]) - drive.teeth.reach[m] < far - drive.teeth.reach[n]:
            return False
    return True


@inner
def seat_of(drive, n, i):
    """Angle of the tooth (of the gap, for rollers) nearest to plate i, against psi: for plates less a right angle, and in whole turns
    as the plate's own angle."""
    b, p, phi = drive.bodies, drive.plates, drive.teeth.pitch_angle[n]
    if drive.teeth.rolls[n]:
        x, y = p.x[i] + p.half[i] * p.c[i] - b.x[n], p.y[i] + p.half[i] * p.s[i] - b.y[n]
        return (np.floor((np.arctan2(y, x) - b.psi[n]) / phi) + 0.5) * phi
    polar = np.arctan2(p.y[i] - b.y[n], p.x[i] - b.x[n])
    seat = np.round((polar - b.psi[n]) / phi) * phi - 0.5 * np.pi
    return seat + 2 * np.pi * np.round((p.angle[i] - b.psi[n] - seat) / (2 * np.pi))
