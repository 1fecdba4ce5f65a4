"""Damage of a repeated block on one plane along one direction, and the search for the worst: kernels on numbers.

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
_MAX_STARTS, _SAME_COSINE = 24, 0.95  # starts of climbs at most; cosine from which on frames are neighbours
_WIDE, _COARSE, _FINE = 0.12, 0.02, 1e-6  # sizes of the simplex [rad]
_MAX_REFINED, _RESTARTS = 4, 4  # hills climbed to the top at most, and how often
_COARSE_LOSS = 0.03  # part of the parameter that a climb in haste can leave, at most


Vector: TypeAlias = tuple[float, float, float]


class Block(NamedTuple):
    """Strain less its first sample, and stress [Pa]: (n, 6) as xx, yy, zz, yz, xz, xy; changes of shear up to `gate` are none."""

    strain: Floats
    stress: Floats
    gate: float


@by_reference
class PlaneWorkspace(NamedTuple):
    """Working arrays for blocks of n samples.

    shear, normal (2n,) [-] and stress (2n,) [Pa]: the signals on a plane, over the block twice; turning, stack, start, end (2n + 2,):
    sample numbers, weight (2n + 2,) [-]: count of each cycle; simplex (5, 4): a corner a row, three angles [rad] and log damage [-];
    height (h,) [-] and hills (h, 6) [-]: log damage, normal and direction on each of at most h hills.
    """

    shear: Floats
    normal: Floats
    stress: Floats
    turning: Ints
    stack: Ints
    weight: Floats
    start: Ints
    end: Ints
    simplex: Floats
    height: Floats
    hills: Floats


class CycleMeasures(NamedTuple):
    """What one cycle has on the plane: shear and normal strain amplitude [-], mean normal stress [Pa]."""

    shear: float
    normal: float
    mean: float


@kernel
def plane_workspace(size: int) -> PlaneWorkspace:
    """`PlaneWorkspace` for blocks of `size` samples."""
    turning, stack = np.empty(2 * size + 2, np.int64), np.empty(2 * size + 2, np.int64)
    start, end = np.empty(2 * size + 2, np.int64), np.empty(2 * size + 2, np.int64)
    signals = np.empty(2 * size), np.empty(2 * size), np.empty(2 * size)
    return PlaneWorkspace(
        signals[0],
        signals[1],
        signals[2],
        turning,
        stack,
        np.empty(2 * size + 2),
        start,
        end,
        np.empty((5, 4)),
        np.empty(_MAX_STARTS),
        np.empty((_MAX_STARTS, 6)),
    )


@kernel
def pack_block(strain: Floats, stress: Floats) -> Block:
    """The `Block` of a strain (n, 3, 3) [-] and a stress (n, 3, 3) [Pa], the symmetric part of each."""
    size = len(strain)
    packed, loads, largest = np.empty((size, 6)), np.empty((size, 6)), 0.0
    for k in range(size):
        for c in range(6):
            i, j = min(c, 2) if c < 3 else (1 if c == 3 else 0), c if c < 3 else (1 if c == 5 else 2)
            # Without the first sample a large constant strain costs no digits of the changes.
            packed[k, c] = 0.5 * (strain[k, i, j] + strain[k, j, i]) - 0.5 * (strain[0, i, j] + strain[0, j, i])
            loads[k, c] = 0.5 * (stress[k, i, j] + stress[k, j, i])
            largest = max(largest, abs(packed[k, c]))
    return Block(packed, loads, NOISE * largest)


@inner
def cross(a: Vector, b: Vector) -> Vector:
    """a x b."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@inner
def tensor_weights(a: Vector, b: Vector) -> tuple[float, float, float, float, float, float]:
    """a.t.b of a symmetric tensor is the sum of these times its six numbers."""
    return (a[0] * b[0], a[1] * b[1], a[2] * b[2], a[1] * b[2] + a[2] * b[1], a[0] * b[2] + a[2] * b[0], a[0] * b[1] + a[1] * b[0])


@inner
def contract(w: tuple[float, ...], t: Floats, k: int) -> float:
    """Sum of six weights times sample k of t (n, 6) [- or Pa, as the answer]: a component of a symmetric tensor."""
    return w[0] * t[k, 0] + w[1] * t[k, 1] + w[2] * t[k, 2] + w[3] * t[k, 3] + w[4] * t[k, 4] + w[5] * t[k, 5]


@inner
def resolve(block: Block, normal: Vector, direction: Vector, work: PlaneWorkspace) -> int:
    """Fills the signals (2n,) of `work`, shear and normal strain [-] and normal stress [Pa]; the number of cycles on the shear."""
    size = len(block.strain)
    sliding, opening = tensor_weights(direction, normal), tensor_weights(normal, normal)
    for k in range(size):
        work.shear[k] = work.shear[size + k] = 2.0 * contract(sliding, block.strain, k)
    cycles = block_cycles(work.shear, size, block.gate, work.turning, work.weight, work.start, work.end, work.stack)
    if cycles:
        for k in range(size):
            work.normal[k] = work.normal[size + k] = contract(opening, block.strain, k)
            work.stress[k] = work.stress[size + k] = contract(opening, block.stress, k)
    return cycles


@inner
def cycle_measures(work: PlaneWorkspace, cycle: int, gate: float) -> CycleMeasures:
    """The `CycleMeasures` of one cycle; where it closes between two samples, both signals are taken as straight there."""
    shear, normal, stress = work.shear, work.normal, work.stress
    first, turn = int(work.start[cycle]), int(work.end[cycle])
    reach = abs(shear[first] - shear[turn])
    low = high = normal[first]
    least = most = stress[first]
    back = reach
    for k in range(first + 1, len(shear)):
        before, back = back, abs(shear[k] - shear[turn])
        part = 1.0
        if k > turn and back > reach:
            part = (reach - before) / (back - before)
        strain, load = normal[k - 1] + part * (normal[k] - normal[k - 1]), stress[k - 1] + part * (stress[k] - stress[k - 1])
        low, high, least, most = min(low, strain), max(high, strain), min(least, load), max(most, load)
        if k > turn and back >= reach - gate:
            break
    return CycleMeasures(0.5 * reach, 0.5 * (high - low), 0.5 * (most + least))


@inner
def plane_damage(block: Block, curve: Curve, normal: Vector, direction: Vector, work: PlaneWorkspace) -> float:
    """Damage of one repeat, the sum of its cycles' after Miner."""
    damage = 0.0
    for cycle in range(resolve(block, normal, direction, work)):
        parts = cycle_measures(work, cycle, block.gate)
        damage += cycle_damage(curve, parts.shear + parts.normal, parts.mean)
    return damage


@kernel
def cycle_table(block: Block, curve: Curve, normal: Vector, direction: Vector) -> Floats:
    """(cycles, 6): shear amplitude [-], normal strain amplitude [-], mean normal stress [Pa], damage [-], sample of start and turn."""
    work = plane_workspace(len(block.strain))
    n, d = (normal[0], normal[1], normal[2]), (direction[0], direction[1], direction[2])
    cycles = resolve(block, n, d, work)
    table = np.empty((cycles, 6))
    for cycle in range(cycles):
        parts = cycle_measures(work, cycle, block.gate)
        damage = cycle_damage(curve, parts.shear + parts.normal, parts.mean)
        table[cycle, 0], table[cycle, 1], table[cycle, 2], table[cycle, 3] = parts.shear, parts.normal, parts.mean, damage
        table[cycle, 4], table[cycle, 5] = work.start[cycle], work.end[cycle]
    return table


# ------------------------------------------------------------------------------------------------------------ climbing


@inner
def turn_towards(a: Vector, b: Vector, angle: float) -> Vector:
    """a turned towards b."""
    c, s = np.cos(angle), np.sin(angle)
    return c * a[0] + s * b[0], c * a[1] + s * b[1], c * a[2] + s * b[2]


@inner
def turn_frame(normal: Vector, direction: Vector, first: float, second: float, third: float) -> tuple[Vector, Vector]:
    """(normal, direction) turned in their plane, then the direction about the normal, then the normal about the direction."""
    normal, direction = turn_towards(normal, direction, first), turn_towards(direction, normal, -first)
    direction = turn_towards(direction, cross(normal, direction), second)
    return turn_towards(normal, cross(normal, direction), third), direction


@inner
def _evaluate_corner(block, curve, normal, direction, work, row, x, y, z):
    """Writes three angles [rad] and the log damage there into a row of the simplex (5, 4)."""
    there, along = turn_frame(normal, direction, x, y, z)
    s = work.simplex
    s[row, 0], s[row, 1], s[row, 2] = x, y, z
    s[row, 3] = np.log(plane_damage(block, curve, there, along, work))


@inner
def _reflect(block, curve, normal, direction, work, low, factor):
    """Mirrors the lowest corner at the middle of the other three, its distance times factor, in the spare row 4; kept if it is higher."""
    s = work.simplex
    share = (1.0 + factor) / 3.0
    x, y, z = -factor * s[low, 0], -factor * s[low, 1], -factor * s[low, 2]
    for i in range(4):
        if i != low:
            x, y, z = x + share * s[i, 0], y + share * s[i, 1], z + share * s[i, 2]
    _evaluate_corner(block, curve, normal, direction, work, 4, x, y, z)
    kept = s[4, 3] > s[low, 3]
    if kept:
        for c in range(4):
            s[low, c] = s[4, c]
    return kept


@inner
def _shrink(block, curve, normal, direction, work, top):
    """Halves the distances [rad] of all corners of the simplex (5, 4) from its highest."""
    s = work.simplex
    for i in range(4):
        if i != top:
            x, y, z = 0.5 * (s[i, 0] + s[top, 0]), 0.5 * (s[i, 1] + s[top, 1]), 0.5 * (s[i, 2] + s[top, 2])
            _evaluate_corner(block, curve, normal, direction, work, i, x, y, z)


@inner
def _rank_corners(s):
    """(highest, lowest corner, log damage of the next to the lowest, size [rad]) of a simplex (5, 4): three angles [rad], log damage."""
    top, low = 0, 0
    for i in range(1, 4):
        top, low = i if s[i, 3] > s[top, 3] else top, i if s[i, 3] < s[low, 3] else low
    second, width = np.inf, 0.0
    for i in range(4):
        second = second if i == low else min(second, s[i, 3])
        for c in range(3):
            width = max(width, abs(s[i, c] - s[top, c]))
    return top, low, second, width


@inner
def nelder_mead(
    block: Block, curve: Curve, normal: Vector, direction: Vector, size: float, finest: float, work: PlaneWorkspace
) -> tuple[float, Vector, Vector]:
    """(log damage, normal, direction) on the hill that starts here: the simplex of Nelder and Mead from `size` to `finest` [rad].

    The hills have edges, where one cycle or one extreme takes over from another; methods with slopes or fixed axes get stuck on them.
    """
    s = work.simplex
    for i in range(4):
        _evaluate_corner(block, curve, normal, direction, work, i, size * (i == 1), size * (i == 2), size * (i == 3))
    for _ in range(400):
        top, low, second, width = _rank_corners(s)
        if width < finest or s[top, 3] == np.inf:
            break
        highest = s[top, 3]
        kept = _reflect(block, curve, normal, direction, work, low, 1.0)
        if kept and s[4, 3] > highest:
            _reflect(block, curve, normal, direction, work, low, -2.0)
        elif not (kept and s[4, 3] > second) and not _reflect(block, curve, normal, direction, work, low, -0.5):
            _shrink(block, curve, normal, direction, work, top)
    top = _rank_corners(s)[0]
    normal, direction = turn_frame(normal, direction, s[top, 0], s[top, 1], s[top, 2])
    return s[top, 3], normal, direction


@kernel
def worst_plane(block: Block, curve: Curve, grid: Floats, work: PlaneWorkspace, score: Floats) -> tuple[float, Vector, Vector]:
    """(damage, normal, direction) where the damage is greatest of all planes and directions in them.

    grid (frames, 6) [-]: normals and directions to start from; score (frames,) [-], log damages, is overwritten.
    The best of the hills that the grid shows are climbed in haste, then the highest of these to the top.
    """
    for g in range(len(grid)):
        score[g] = np.log(plane_damage(block, curve, (grid[g, 0], grid[g, 1], grid[g, 2]), (grid[g, 3], grid[g, 4], grid[g, 5]), work))
    hills = 0
    for _ in range(_MAX_STARTS):
        g = np.argmax(score)
        if score[g] == -np.inf:
            break
        n, d = (grid[g, 0], grid[g, 1], grid[g, 2]), (grid[g, 3], grid[g, 4], grid[g, 5])
        work.height[hills], normal, direction = nelder_mead(block, curve, n, d, _WIDE, _COARSE, work)
        for i in range(3):
            work.hills[hills, i], work.hills[hills, 3 + i] = normal[i], direction[i]
        _exclude_neighbours(grid, score, n, d)
        hills += 1
    return _refine_best(block, curve, work.hills[:hills], work.height[:hills], work)


@kernel
def _refine_best(block, curve, hills, heights, work):
    """(damage, normal, direction) of the highest of the frames hills (h, 6) [-], log damages heights (h,) [-], climbed to the top."""
    best, normal, direction = -np.inf, (np.nan, np.nan, np.nan), (np.nan, np.nan, np.nan)
    for _ in range(_MAX_REFINED):
        h = np.argmax(heights) if len(hills) else -1
        if h < 0 or heights[h] == -np.inf or heights[h] < best + _COARSE_LOSS / curve.b:
            break
        n, d = (hills[h, 0], hills[h, 1], hills[h, 2]), (hills[h, 3], hills[h, 4], hills[h, 5])
        height = -np.inf
        for k in range(_RESTARTS):  # a simplex can collapse on an edge, one that is turned round then goes on
            height, n, d = nelder_mead(block, curve, n, d, _COARSE * (-0.5) ** k, _FINE, work)
        if height > best:
            best, normal, direction = height, n, d
        _exclude_neighbours(hills, heights, n, d)
        heights[h] = -np.inf
    return np.exp(best), normal, direction


@inner
def _exclude_neighbours(grid, score, n, d):
    """Sets score (frames,) to -inf for the frames of grid (frames, 6) [-] near one that was climbed from."""
    for g in range(len(grid)):
        along = abs(grid[g, 0] * n[0] + grid[g, 1] * n[1] + grid[g, 2] * n[2])
        beside = abs(grid[g, 3] * d[0] + grid[g, 4] * d[1] + grid[g, 5] * d[2])
        if along > _SAME_COSINE and beside > _SAME_COSINE:
            score[g] = -np.inf
