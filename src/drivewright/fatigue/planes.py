"""Damage of a repeated block on one plane along one direction: kernels on numbers.

A plane is its unit normal n, a direction d a unit vector in it; with the strain e(t) and the stress s(t) the block resolves into
    shear g = 2 d.e.n,   normal strain n.e.n,   normal stress n.s.n.
Cycles are counted on g.  A cycle lasts from the turning point it starts at until g is back at that level, and has
    shear amplitude |g_start - g_turn|/2, and over that time, smaller cycles within included,
    normal strain amplitude (greatest - least)/2, mean normal stress (greatest + least)/2.
"""

from typing import NamedTuple, TypeAlias

import numpy as np

from drivewright._jit import by_reference, inner, kernel
from drivewright._typing import Floats, Ints
from drivewright.fatigue.curves import Curve, cycle_damage
from drivewright.fatigue.rainflow import block_cycles

NOISE = 1e-12  # of the largest change of the strain tensor: smaller reversals of the shear are rounding

Vector: TypeAlias = tuple[float, float, float]


class Block(NamedTuple):
    """Strain less its first sample, and stress [Pa]: (6, n) as xx, yy, zz, yz, xz, xy; changes of shear up to `gate` are none."""

    strain: Floats
    stress: Floats
    gate: float


@by_reference
class PlaneWorkspace(NamedTuple):
    """Working arrays for blocks of n samples.

    shear, normal (2n,) [-] and stress (2n,) [Pa]: the signals on a plane, over the block twice; turning, stack, start, end (2n + 2,):
    sample numbers, weight (2n + 2,) [-]: count of each cycle.
    """

    shear: Floats
    normal: Floats
    stress: Floats
    turning: Ints
    stack: Ints
    weight: Floats
    start: Ints
    end: Ints


class ClosedCycle(NamedTuple):
    """Samples, counted on beyond the end of the block, at which a cycle starts, turns and has closed; part of the last step until then."""

    first: int
    turn: int
    close: int
    part: float


class CycleMeasures(NamedTuple):
    """What one cycle has on the plane: shear amplitude [-], lowest and highest normal strain [-], least and most normal stress [Pa]."""

    shear: float
    lowest: float
    highest: float
    least: float
    most: float


def plane_workspace(size: int) -> PlaneWorkspace:
    """`PlaneWorkspace` for blocks of `size` samples."""
    shear, normal, stress = np.empty((3, 2 * size))
    turning, stack, start, end = np.empty((4, 2 * size + 2), np.int64)
    return PlaneWorkspace(shear, normal, stress, turning, stack, np.empty(2 * size + 2), start, end)


@kernel
def pack_block(strain: Floats, stress: Floats) -> Block:
    """The `Block` of a strain (n, 3, 3) [-] and a stress (n, 3, 3) [Pa], the symmetric part of each."""
    size = len(strain)
    packed, loads, largest = np.empty((6, size)), np.empty((6, size)), 0.0
    for k in range(size):
        for c in range(6):
            i, j = min(c, 2) if c < 3 else (1 if c == 3 else 0), c if c < 3 else (1 if c == 5 else 2)
            # Without the first sample a large constant strain costs no digits of the changes.
            packed[c, k] = 0.5 * (strain[k, i, j] + strain[k, j, i]) - 0.5 * (strain[0, i, j] + strain[0, j, i])
            loads[c, k] = 0.5 * (stress[k, i, j] + stress[k, j, i])
            largest = max(largest, abs(packed[c, k]))
    return Block(packed, loads, NOISE * largest)


@inner
def dot(a: Vector, b: Vector) -> float:
    """a . b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@inner
def cross(a: Vector, b: Vector) -> Vector:
    """a x b."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@inner
def turn_towards(a: Vector, b: Vector, angle: float) -> Vector:
    """a turned towards b."""
    c, s = np.cos(angle), np.sin(angle)
    return c * a[0] + s * b[0], c * a[1] + s * b[1], c * a[2] + s * b[2]


@inner
def tensor_weights(a: Vector, b: Vector) -> tuple[float, float, float, float, float, float]:
    """a.t.b of a symmetric tensor is the sum of these times its six numbers."""
    return (a[0] * b[0], a[1] * b[1], a[2] * b[2], a[1] * b[2] + a[2] * b[1], a[0] * b[2] + a[2] * b[0], a[0] * b[1] + a[1] * b[0])


@inner
def shear_weights(normal: Vector, direction: Vector) -> tuple[float, float, float, float, float, float]:
    """Those of the shear 2 d.t.n."""
    return tensor_weights(normal, (2.0 * direction[0], 2.0 * direction[1], 2.0 * direction[2]))


@inner
def contract(w: tuple[float, float, float, float, float, float], t: Floats, signal: Floats) -> None:
    """Writes a component of a symmetric tensor t (6, n) [- or Pa] into signal (>= n,): the sum of six weights times its rows."""
    xx, yy, zz, yz, xz, xy = t[0], t[1], t[2], t[3], t[4], t[5]
    for k in range(t.shape[1]):
        signal[k] = w[0] * xx[k] + w[1] * yy[k] + w[2] * zz[k] + w[3] * yz[k] + w[4] * xz[k] + w[5] * xy[k]


@inner
def _repeat(signal):
    """Writes the first half of a signal (2n,) of any unit into the second."""
    size = len(signal) // 2
    for k in range(size):
        signal[size + k] = signal[k]


@inner
def resolve(block: Block, normal: Vector, direction: Vector, work: PlaneWorkspace) -> int:
    """Fills the signals (2n,) of `work`, shear and normal strain [-] and normal stress [Pa]; the number of cycles on the shear."""
    contract(shear_weights(normal, direction), block.strain, work.shear)
    _repeat(work.shear)
    cycles = block_cycles(work.shear, block.strain.shape[1], block.gate, work.turning, work.weight, work.start, work.end, work.stack)
    if cycles:
        opening = tensor_weights(normal, normal)
        contract(opening, block.strain, work.normal)
        contract(opening, block.stress, work.stress)
        _repeat(work.normal)
        _repeat(work.stress)
    return cycles


@inner
def extremes(x: Floats, first: int, stop: int) -> tuple[float, float]:
    """(least, greatest) of x[first:stop], in four strands: one alone would wait for itself."""
    a = b = c = d = e = f = g = h = x[first]
    k = first
    while k + 4 <= stop:
        a, b, c, d = min(a, x[k]), min(b, x[k + 1]), min(c, x[k + 2]), min(d, x[k + 3])
        e, f, g, h = max(e, x[k]), max(f, x[k + 1]), max(g, x[k + 2]), max(h, x[k + 3])
        k += 4
    while k < stop:
        a, e, k = min(a, x[k]), max(e, x[k]), k + 1
    return min(min(a, b), min(c, d)), max(max(e, f), max(g, h))


@inner
def closed_cycle(work: PlaneWorkspace, number: int, gate: float) -> ClosedCycle:
    """The `ClosedCycle` of that number; shears [-] within the gate of where it starts close it."""
    shear, first, turn = work.shear, int(work.start[number]), int(work.end[number])
    level = shear[turn]
    reach = abs(shear[first] - level)
    close = turn + 1
    while close < len(shear) - 1 and abs(shear[close] - level) < reach - gate:
        close += 1
    before, back = abs(shear[close - 1] - level), abs(shear[close] - level)
    return ClosedCycle(first, turn, close, (reach - before) / (back - before) if back > reach else 1.0)


@inner
def cycle_measures(work: PlaneWorkspace, cycle: ClosedCycle) -> CycleMeasures:
    """The `CycleMeasures` of a cycle; where it closes between two samples, both signals are taken as straight there."""
    normal, stress, first, close = work.normal, work.stress, cycle.first, cycle.close
    strain = normal[close - 1] + cycle.part * (normal[close] - normal[close - 1])
    load = stress[close - 1] + cycle.part * (stress[close] - stress[close - 1])
    (low, high), (least, most) = extremes(normal, first, close), extremes(stress, first, close)
    reach = abs(work.shear[first] - work.shear[cycle.turn])
    return CycleMeasures(0.5 * reach, min(low, strain), max(high, strain), min(least, load), max(most, load))


@inner
def plane_damage(block: Block, curve: Curve, normal: Vector, direction: Vector, work: PlaneWorkspace) -> float:
    """Damage of one repeat, the sum of its cycles' after Miner."""
    damage = 0.0
    for cycle in range(resolve(block, normal, direction, work)):
        parts = cycle_measures(work, closed_cycle(work, cycle, block.gate))
        damage += cycle_damage(curve, parts.shear + 0.5 * (parts.highest - parts.lowest), 0.5 * (parts.most + parts.least))
    return damage


def cycle_table(block: Block, curve: Curve, normal: Vector | Floats, direction: Vector | Floats) -> Floats:
    """(cycles, 6): shear amplitude [-], normal strain amplitude [-], mean normal stress [Pa], damage [-], sample of start and turn."""
    return _cycle_table(block, curve, normal, direction, plane_workspace(block.strain.shape[1]))


@kernel
def _cycle_table(block, curve, normal, direction, work):
    """`cycle_table` of a normal and a direction (3,) [-], with a `PlaneWorkspace`."""
    n, d = (normal[0], normal[1], normal[2]), (direction[0], direction[1], direction[2])
    cycles = resolve(block, n, d, work)
    table = np.empty((cycles, 6))
    for cycle in range(cycles):
        parts = cycle_measures(work, closed_cycle(work, cycle, block.gate))
        opening, mean = 0.5 * (parts.highest - parts.lowest), 0.5 * (parts.most + parts.least)
        damage = cycle_damage(curve, parts.shear + opening, mean)
        table[cycle, 0], table[cycle, 1], table[cycle, 2], table[cycle, 3] = parts.shear, opening, mean, damage
        table[cycle, 4], table[cycle, 5] = work.start[cycle], work.end[cycle]
    return table
