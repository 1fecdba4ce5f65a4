"""Snapshots of a run: what the kernel copies out at a sample, for `measure` to make sense of."""

from typing import NamedTuple

import numpy as np

from drivewright._jit import by_reference, inner
from drivewright._typing import Floats, Records
from drivewright.chains.explicit.state import SUMS, ChainConstants, Joints, Plates, Touches
from drivewright.chains.explicit.step import total

SCALARS = ("t", "joint damping", "contact damping", *SUMS)
BODIES = ("q", "vq", "psi", "w", "fx", "fy", "torque", "hq", "hw")
PLATES = ("x", "y", "angle", "c", "s", "vx", "vy", "w", "hx", "hy", "hw", "fx", "fy", "rx", "ry", "stored", "left", "right")


@by_reference
class Snapshots(NamedTuple):
    """scalars (S, SCALARS), bodies (S, BODIES, B), plates (S, PLATES, N), joints by the plate behind them."""

    scalars: Floats
    bodies: Floats
    plates: Floats


def empty_snapshots(samples: int, bodies: int, count: int) -> Snapshots:
    """Room for so many."""
    return Snapshots(np.zeros((samples, len(SCALARS))), np.zeros((samples, len(BODIES), bodies)), np.zeros((samples, len(PLATES), count)))


@inner
def take_snapshot(
    chain: ChainConstants,
    p: Plates,
    j: Joints,
    t: Touches,
    b: Records,
    clock: Floats,
    power: Floats,
    sums: Floats,
    snapshots: Snapshots,
    number: int,
    dt: float,
) -> None:
    """One snapshot, at a whole step under its loads: rates are the means of the half steps on both sides, h those of the later one.

    clock (2,) [s, -]; power (SUMS,) and its integral sums (SUMS,).
    """
    out, n = snapshots.plates[number], chain.count
    for row, values in enumerate(
        (p.x, p.y, p.angle, p.c, p.s, p.vx, p.vy, p.w, p.hx, p.hy, p.hw, j.fx, j.fy, j.rx, j.ry, t.stored, t.left, t.right)
    ):
        for i in range(n):
            out[row, i] = values[i]
    bodies = snapshots.bodies[number]
    for m in range(b.q.size):
        for row, value in enumerate((b.q[m], b.vq[m], b.psi[m], b.w[m], b.fx[m], b.fy[m], b.torque[m], b.hq[m], b.hw[m])):
            bodies[row, m] = value
    record_works(n, j, t, clock, power, sums, snapshots.scalars[number], dt)


@inner
def record_works(n: int, j: Joints, t: Touches, clock: Floats, power: Floats, sums: Floats, out: Floats, dt: float) -> None:
    """Time and works up to now; this step, already in the sums of the damping, counts with half its weight: the trapezoidal rule.

    clock (2,) [s, -]; power (SUMS,), sums (SUMS,); out (SCALARS,), a row of `Snapshots.scalars`.
    """
    out[0] = clock[0]
    out[1] = 0.5 * dt * total(j.power, 0, n) - total(j.lost, 0, n)
    out[2] = 0.5 * dt * total(t.power, 0, n) - total(t.lost, 0, n)
    for k in range(power.size):
        out[3 + k] = sums[k] + 0.5 * dt * power[k]
