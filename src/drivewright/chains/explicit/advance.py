"""Kernels of a run: loads, steps, and the search for contact candidates."""

import numpy as np

from drivewright._jit import inner, plain
from drivewright._typing import Floats, Records
from drivewright.chains.explicit.bodies import (
    drift_bodies,
    impulse,
    kick_bodies,
    load_guide,
    load_rollers,
    slide_acceleration,
    turn_acceleration,
)
from drivewright.chains.explicit.snapshots import Snapshots, take_snapshot
from drivewright.chains.explicit.state import ChainConstants, ContactCandidates, DriveArrays, Joints, Plates, Teeth, Touches
from drivewright.chains.explicit.step import (
    accelerate_plates,
    add_reaction,
    close_rates,
    close_ring,
    drift_plates,
    flank_damping_work,
    joint_damping_work,
    kick_plates,
    load_flanks,
    load_gravity,
    load_joints,
)
from drivewright.chains.touching.seats import nearest_gap, nearest_tooth


@inner
def run(drive: DriveArrays, snapshots: Snapshots, first: int, last: int, every: int, search_interval: float, dt: float) -> None:
    """Snapshots first .. last-1, `every` steps apart; candidates for contact are sought anew every `search_interval` steps."""
    chain, p, j, t, b, teeth = drive.chain, drive.plates, drive.joints, drive.touches, drive.bodies, drive.teeth
    arcs, candidates, gravity, clock, power, sums = drive.arcs, drive.candidates, drive.gravity, drive.clock, drive.power, drive.sums
    for number in range(first, last):
        for n in range(every):
            if clock[1] % search_interval == 0.0:
                find_candidates(chain, p, t, b, teeth, arcs, candidates)
            load(chain, p, j, t, b, teeth, arcs, candidates, gravity, power, dt)
            kick(chain, p, j, t, b, teeth, candidates, gravity, power, dt)
            if n == 0:
                take_snapshot(chain, p, j, t, b, clock, power, sums, snapshots, number, dt)
            drift(chain, p, b, clock, power, sums, dt)


def settle_rates(drive: DriveArrays, dt: float) -> None:
    """From rates at the first whole step to those half a step earlier, which the leapfrog starts with; once, so not worth compiling."""
    chain, p, j, t, b, teeth, arcs, candidates, gravity, _, power, _ = drive
    plain(find_candidates)(chain, p, t, b, teeth, arcs, candidates)
    plain(load)(chain, p, j, t, b, teeth, arcs, candidates, gravity, power, dt)
    plain(accelerate_plates)(chain, p, j)
    for half, rate in zip((p.hx, p.hy, p.hw), (p.fx, p.fy, p.moment), strict=True):
        half[: chain.count] -= 0.5 * dt * rate[: chain.count]
    for n in range(b.q.size):
        if b.slides[n]:
            b.hq[n] -= 0.5 * dt * plain(slide_acceleration)(b, gravity, n)
        if not b.driven[n]:
            b.hw[n] -= 0.5 * dt * plain(turn_acceleration)(b, n)
    t.lost[:] = 0.0


@inner
def load(
    chain: ChainConstants,
    p: Plates,
    j: Joints,
    t: Touches,
    b: Records,
    teeth: Teeth,
    arcs: Records,
    candidates: ContactCandidates,
    gravity: Floats,
    power: Floats,
    dt: float,
) -> None:
    """All loads at the present places and predicted rates. gravity (2,) [m/s^2]; power (SUMS,) [W, N, N m], written."""
    sprockets = teeth.base.size
    for n in range(b.q.size):
        b.fx[n], b.fy[n], b.torque[n] = 0.0, 0.0, 0.0
    for k in range(power.size):
        power[k] = 0.0
    load_joints(chain, p, j)
    load_gravity(chain, p, t)
    for r in range(candidates.size[0]):
        n, first, last = candidates.body[r], candidates.first[r], candidates.last[r]
        if n >= sprockets:
            load_guide(chain, p, t, b, arcs, n - sprockets, first, last, power, dt)
        elif teeth.rolls[n]:
            load_rollers(chain, p, t, b, teeth, n, first, last, dt)
        else:
            load_flanks(chain, p, t, b, teeth, n, first, last, dt)
        add_reaction(t, b, n, first, last)
    impulse(chain, p, b, gravity, power)


@inner
def kick(
    chain: ChainConstants,
    p: Plates,
    j: Joints,
    t: Touches,
    b: Records,
    teeth: Teeth,
    candidates: ContactCandidates,
    gravity: Floats,
    power: Floats,
    dt: float,
) -> None:
    """Rates one step on under the loads, and what damping takes meanwhile. gravity (2,) [m/s^2]; power (SUMS,) [W, N, N m]."""
    accelerate_plates(chain, p, j)
    kick_plates(chain, p, dt)
    close_rates(chain, p)
    kick_bodies(b, gravity, power, dt)
    if chain.joint_damping + chain.articulation_damping > 0.0:
        joint_damping_work(chain, p, j, dt)
    for r in range(candidates.size[0]):
        n = candidates.body[r]
        if n < teeth.base.size and not teeth.rolls[n] and b.damping[n] > 0.0:
            flank_damping_work(chain, p, t, b, teeth, n, candidates.first[r], candidates.last[r], dt)


@inner
def drift(chain: ChainConstants, p: Plates, b: Records, clock: Floats, power: Floats, sums: Floats, dt: float) -> None:
    """Places one step on. clock (2,) [s, -]; power (SUMS,) [W, N, N m] and its integral sums (SUMS,) over time."""
    drift_plates(chain, p, dt)
    close_ring(chain, p)
    drift_bodies(b, clock, dt)
    for k in range(power.size):
        sums[k] += dt * power[k]
    clock[1] += 1.0


# ------------------------------------------------------------------------------------------------------- who may touch whom


@inner
def find_candidates(
    chain: ChainConstants, p: Plates, t: Touches, b: Records, teeth: Teeth, arcs: Records, candidates: ContactCandidates
) -> None:
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
                candidates.last[size - 1] = i + 1
            else:
                candidates.body[size], candidates.first[size], candidates.last[size] = n, i, i + 1
                size += 1
            before = i
            if n < teeth.base.size:
                t.seat[i] = seat_of(p, b, teeth, n, i)
                t.seat_cos[i], t.seat_sin[i] = np.cos(t.seat[i]), np.sin(t.seat[i])
    candidates.size[0] = size


@inner
def near(chain: ChainConstants, x: float, y: float, b: Records, teeth: Teeth, arcs: Records, n: int) -> bool:
    """Whether a plate at (x, y) may touch body n soon; of the sprockets only the nearest counts."""
    sprockets = teeth.base.size
    far = distance(x - b.x[n], y - b.y[n])
    if n >= sprockets:
        return near_arc(chain, x - b.x[n], y - b.y[n], far, arcs, n - sprockets)
    spare, nearest = far - teeth.reach[n], True
    if spare >= 0.0:
        return False
    for m in range(sprockets):
        nearest &= m == n or distance(x - b.x[m], y - b.y[m]) - teeth.reach[m] >= spare
    return nearest


@inner
def near_arc(chain: ChainConstants, x: float, y: float, far: float, arcs: Records, n: int) -> bool:
    """Whether a plate at (x, y), `far` [m] from the centre of guide n's arc, lies about as far as the arc and not beside it.

    It may come nearer by half a pitch, lie a pitch deeper, and as far beside the arc as guides turn about a pivot.
    """
    radius, room = arcs.radius[n] + abs(arcs.distance[n]), 2 * chain.half_plate
    if far > radius + 0.5 * room or far < arcs.radius[n] - abs(arcs.distance[n]) - room:
        return False
    cosine, sine = arcs.opening[n], np.sqrt(max(0.0, 1.0 - arcs.opening[n] ** 2))
    margin = min(0.3 + room / radius, np.pi)
    return cosine <= -0.9 or x * arcs.middle_x[n] + y * arcs.middle_y[n] >= far * (cosine * np.cos(margin) - sine * np.sin(margin))


@inner
def distance(x: float, y: float) -> float:
    """Length of (x, y) [m]; np.hypot takes three times as long, for lengths that no drive has."""
    return np.sqrt(x * x + y * y)


@inner
def seat_of(p: Plates, b: Records, teeth: Teeth, n: int, i: int) -> float:
    """Angle of the tooth (of the gap, for rollers) nearest to plate i, against psi; see `touching.seats`."""
    phi = teeth.pitch_angle[n]
    if teeth.rolls[n]:
        x, y = p.x[i] + p.half[i] * p.c[i] - b.x[n], p.y[i] + p.half[i] * p.s[i] - b.y[n]
        return nearest_gap(x, y, b.psi[n], phi)
    return nearest_tooth(p.x[i] - b.x[n], p.y[i] - b.y[n], b.psi[n], phi, p.angle[i])
