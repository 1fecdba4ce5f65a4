"""Planes that cannot be the most damaged, from bounds.

What cannot win.  Let D be a damage that some plane does, N = 1/D, and at this life, with the `Curve`'s constants,
    k = elastic (2N)^b,   q = p + k max(mean, 0)   of a cycle with the parameter p = shear + normal strain amplitude.
A cycle does no more damage than one of parameter q without mean stress, D(q), or else both do D and more.  Over its instants, with the
normal strain e and the normal stress s, q <= r/2 + B, r its shear range and
    B = 1/2 max(max e + k max s + max(k s - e), max e - min e)   over the block.
D(q) is convex where c >= -1; the shear ranges of all cycles add up to half the variation V of the shear.  So a block of n samples does
    U = n/2 D(B) + V/4 (D(Q) - D(B))/(Q - B)   at most, Q the greatest r/2 + B.
What happens between planes.  V, Q and B are greatest values of families of functions that are, as the frame is turned about any fixed axis,
trigonometric polynomials of degree 2.  One with |f - f0| <= A obeys f'^2 + 4 (f - f0)^2 <= 4 A^2 (Bernstein and Szego; recalled): so
    f(turned by t) <= f0 + A cos(max(a - 2t, 0)),   cos a = (f - f0)/A.
The grid's normals leave no other farther than `reach` t, and the same inequality bounds A by what the grid shows.  Where U then stays below
D, no plane whose normal is within t of it does D.  Not ruled out is anything where a mean normal stress can reach the fatigue strength.
"""

from functools import cache
from typing import NamedTuple

import numpy as np

from drivewright._jit import by_reference, elementwise, inner
from drivewright._typing import Floats
from drivewright.fatigue.curves import Curve, cycle_damage
from drivewright.fatigue.planes import Block, PlaneWorkspace, Vector, contract, cross, dot, extremes, shear_weights, tensor_weights

_NORMALS, _MIRRORED, _DIRECTIONS = 96, 56, 8  # of the grids
_EQUATOR = 64  # frames in the plane z = 0: they are their own images, and most tops of plane stress lie among them
_MAX_STARTS = 40  # hills at most, of which mirrored ones are two
_ROUNDING = 1e-9  # of a bound


@by_reference
class SearchGrid(NamedTuple):
    """Frames evenly over the half sphere and the half turn.

    normals (m, 3) [-]: no other is farther than `reach` [rad]; directions (m, d, 3) [-] in their planes, at equal angles over a half turn.
    mirrored: for blocks that are their own image in the plane z = 0, as those of plane stress are.  A frame and its image do the same
    damage there, so that the normals stand for their images as well.
    """

    normals: Floats
    directions: Floats
    reach: float
    mirrored: bool


@by_reference
class SearchWorkspace(NamedTuple):
    """Working arrays for a grid of m normals with d directions.

    shear, variation, rest, opposite (m,) [-]: greatest range of the shear, V, B and B of the negative on each normal; score (m d,)
    [-]: log damages; simplex (5, 4): a corner a row, three angles [rad] and log damage [-]; tangent (2, 2, 6) [-]: those of two frames;
    height (h,) [-] and hills (h, 6) [-]: log damage, normal and direction on each of at most h hills; equator (e,) [-]: log damages of
    frames in the plane z = 0, none where the grid is not mirrored.
    """

    shear: Floats
    variation: Floats
    rest: Floats
    opposite: Floats
    score: Floats
    simplex: Floats
    tangent: Floats
    height: Floats
    hills: Floats
    equator: Floats


@cache
def search_grid(normals: int = _NORMALS, directions: int = _DIRECTIONS) -> SearchGrid:
    """The `SearchGrid` of so many normals, along a spiral in steps of the golden angle, and directions on each."""
    k = np.arange(normals) + 0.5
    normal, direction = _spiral(k / normals, np.pi * (1 + 5**0.5) * k, directions)
    return SearchGrid(normal, direction, _reach(normal), False)


@cache
def mirrored_grid(normals: int = _MIRRORED, directions: int = _DIRECTIONS) -> SearchGrid:
    """The mirrored `SearchGrid`: normals over a quarter of the sphere, in steps of sqrt(2) pi around, which leave the smallest `reach` of
    the irrational steps that were tried."""
    k = np.arange(normals) + 0.5
    normal, direction = _spiral(k / normals, np.pi * (2**0.5 * k % 1), directions)
    return SearchGrid(normal, direction, _reach(np.concatenate([normal, normal * (1, 1, -1)])), True)


def _spiral(height, around, directions):
    """normals (m, 3) [-] at heights (m,) [-] and angles around (m,) [rad], and directions (m, d, 3) [-] in their planes."""
    flat = np.sqrt(1 - height**2)
    normal = np.stack([flat * np.cos(around), flat * np.sin(around), height], axis=1)
    first = np.stack([-np.sin(around), np.cos(around), 0 * height], axis=1)
    turn = np.pi * np.arange(directions) / directions
    return normal, np.cos(turn)[:, None] * first[:, None] + np.sin(turn)[:, None] * np.cross(normal, first)[:, None]


def _reach(normal):
    """Angle [rad] from the direction that is farthest from all normals (m, 3) and their opposites: the largest empty cap on the sphere
    is that above a facet of their convex hull."""
    from scipy.spatial import ConvexHull

    return float(np.arccos(np.min(-ConvexHull(np.concatenate([normal, -normal])).equations[:, 3])))


def search_workspace(grid: SearchGrid) -> SearchWorkspace:
    """`SearchWorkspace` for a grid."""
    normals, directions = grid.directions.shape[:2]
    shear, variation, rest, opposite = np.empty((4, normals))
    score, simplex, tangent = np.empty(normals * directions), np.empty((5, 4)), np.empty((2, 2, 6))
    starts = _MAX_STARTS // (1 + grid.mirrored)
    height, hills, equator = np.empty(starts), np.empty((starts, 6)), np.empty(_EQUATOR * grid.mirrored)
    return SearchWorkspace(shear, variation, rest, opposite, score, simplex, tangent, height, hills, equator)


@inner
def row_of(a: Floats, i: int) -> Vector:
    """Row i of a (m, 3), in its unit."""
    return a[i, 0], a[i, 1], a[i, 2]


@inner
def frame_of(grid: SearchGrid, g: int) -> tuple[Vector, Vector]:
    """(normal, direction) number g of a grid, which has those of the first normal first."""
    i, j = divmod(g, grid.directions.shape[1])
    return row_of(grid.normals, i), row_of(grid.directions[i], j)


@inner
def _variation(x, size):
    """Sum of the changes of x[:size] [-] from sample to sample, in four strands as in `extremes`; the first follows on the last."""
    a, b, c, d = abs(x[0] - x[size - 1]), 0.0, 0.0, 0.0
    k = 1
    while k + 4 <= size:
        a, b = a + abs(x[k] - x[k - 1]), b + abs(x[k + 1] - x[k])
        c, d = c + abs(x[k + 2] - x[k + 1]), d + abs(x[k + 3] - x[k + 2])
        k += 4
    while k < size:
        a, k = a + abs(x[k] - x[k - 1]), k + 1
    return (a + b) + (c + d)


@elementwise
def _combine(a, x, b, y, size, total):
    """Writes a x + b y [-] of two shears (>= size,) into total (>= size,)."""
    for k in range(size):
        total[k] = a * x[k] + b * y[k]


@inner
def measure_shears(block: Block, grid: SearchGrid, work: PlaneWorkspace, search: SearchWorkspace) -> int:
    """Fills `shear` and `variation` (m,) [-]; the number of the frame with the greatest sum of shear and normal strain.

    Between two directions a range is at most the greater of theirs over the cosine of half the angle between them, and so is V.
    """
    directions, size = grid.directions.shape[1], block.strain.shape[1]
    between = 1.0 / np.cos(0.5 * np.pi / directions)
    best, frame = -1.0, 0
    for i in range(len(grid.normals)):
        normal, first = row_of(grid.normals, i), row_of(grid.directions[i], 0)
        second = cross(normal, first)
        contract(tensor_weights(normal, normal), block.strain, work.normal)
        low, high = extremes(work.normal, 0, size)
        contract(shear_weights(normal, first), block.strain, work.normal)
        contract(shear_weights(normal, second), block.strain, work.stress)
        search.shear[i] = search.variation[i] = 0.0
        for j in range(directions):
            d = row_of(grid.directions[i], j)
            _combine(dot(d, first), work.normal, dot(d, second), work.stress, size, work.shear)
            least, most = extremes(work.shear, 0, size)
            search.shear[i] = max(search.shear[i], between * (most - least))
            search.variation[i] = max(search.variation[i], between * _variation(work.shear, size))
            if most - least + high - low > best:
                best, frame = most - least + high - low, i * directions + j
    return frame


@inner
def _measure_rests(block, grid, factor, work, search):
    """Fills `rest` and `opposite` (m,) [-], B for k = factor [1/Pa]; (least, greatest) normal stress [Pa] on the grid's normals."""
    size, least, most = block.strain.shape[1], np.inf, -np.inf
    for i in range(len(grid.normals)):
        normal = row_of(grid.normals, i)
        weights = tensor_weights(normal, normal)
        contract(weights, block.strain, work.normal)
        contract(weights, block.stress, work.stress)
        for k in range(size):
            work.shear[k] = factor * work.stress[k] - work.normal[k]
        (low, high), (bottom, top), (under, over) = (
            extremes(work.normal, 0, size),
            extremes(work.stress, 0, size),
            extremes(work.shear, 0, size),
        )
        search.rest[i] = 0.5 * max(high + factor * top + over, high - low)
        search.opposite[i] = 0.5 * max(-low - factor * bottom - under, high - low)
        least, most = min(least, bottom), max(most, top)
    return least, most


class Family(NamedTuple):
    """|f - middle| <= amplitude, in the unit of f, for all functions of a family on all planes."""

    middle: float
    amplitude: float


@inner
def _family(most: float, opposite: float, reach: float) -> Family:
    """The `Family` whose functions reach `most` on the normals of a grid, and their negatives `opposite`, in the unit of f."""
    amplitude = 0.5 * (most + opposite) / np.cos(2.0 * reach)
    return Family(most - amplitude * np.cos(2.0 * reach), amplitude)


@inner
def greatest_around(value: float, family: Family, reach: float) -> float:
    """Upper bound of f, in its unit, on planes up to `reach` [rad] from one where its greatest is `value`."""
    if not family.amplitude > 0.0:
        return value
    angle = np.arccos(min(max((value - family.middle) / family.amplitude, -1.0), 1.0))
    return family.middle + family.amplitude * np.cos(max(angle - 2.0 * reach, 0.0))


@inner
def damage_limit(curve: Curve, shares: float, travel: float, rest: float, whole: float) -> float:
    """U, the most damage of at most `shares` cycles, from V, B and Q [-]."""
    small = cycle_damage(curve, rest, 0.0)
    if not whole > rest:
        return np.inf
    return shares * small + 0.25 * travel * (cycle_damage(curve, whole, 0.0) - small) / (whole - rest)


@inner
def rule_out(block: Block, curve: Curve, grid: SearchGrid, damage: float, work: PlaneWorkspace, search: SearchWorkspace) -> None:
    """Writes nan to `shear` (m,), which `measure_shears` filled, of the normals around which no plane does as much as a `damage` [-]."""
    reach, life = grid.reach, 2.0 / damage
    least, most = _measure_rests(block, grid, curve.elastic * life**curve.b, work, search)
    stress = _family(most, -least, reach)
    if not damage > 0.0 or curve.c < -1.0 or stress.middle + stress.amplitude >= curve.strength:
        return
    travel = rest = opposite_rest = whole = opposite_whole = -np.inf
    for i in range(len(grid.normals)):
        travel, half = max(travel, search.variation[i]), 0.5 * search.shear[i]
        rest, opposite_rest = max(rest, search.rest[i]), max(opposite_rest, search.opposite[i])
        whole, opposite_whole = max(whole, half + search.rest[i]), max(opposite_whole, half + search.opposite[i])
    travels, rests, wholes = _family(travel, travel, reach), _family(rest, opposite_rest, reach), _family(whole, opposite_whole, reach)
    for i in range(len(grid.normals)):
        limit = damage_limit(
            curve,
            0.5 * block.strain.shape[1],
            greatest_around(search.variation[i], travels, reach),
            greatest_around(search.rest[i], rests, reach),
            greatest_around(0.5 * search.shear[i] + search.rest[i], wholes, reach),
        )
        if limit < (1.0 - _ROUNDING) * damage:
            search.shear[i] = np.nan
