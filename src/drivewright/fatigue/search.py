"""The plane and direction of the greatest damage.

A first climb, from the frame (normal and direction) of the greatest strains, gives a damage; planes that cannot do as much are ruled out by
`bounds`; on the others all directions of a grid are sampled, and the best frames that are not neighbours climbed from.  So every plane that
does more damage than the result has its normal within the grid's `reach` of a normal that was sampled in all its directions.
"""

import numpy as np

from drivewright._jit import inner, kernel
from drivewright.fatigue.bounds import SearchGrid, SearchWorkspace, frame_of, measure_shears, rule_out
from drivewright.fatigue.climbing import climb_tangents, nelder_mead
from drivewright.fatigue.curves import Curve
from drivewright.fatigue.planes import Block, PlaneWorkspace, Vector, dot, plane_damage

_SAME_HILL, _SAME_TOP = 0.95, 0.999  # cosines from which on frames have one hill, or are one top
_STEPS, _HASTE, _HASTY_GAIN = 12, 8, 0.003  # steps at most, and of a climb in haste; log damage that is not worth one more
_HASTY_LOSS, _MAX_REFINED = 0.2, 8  # log damage that a climb in haste can leave; hills climbed to the top at most
_AROUND, _NEARER = (0.12, -0.05, 0.02), 2e-3  # sizes of the simplexes around a top [rad], and where they end
_WIDE, _COARSE, _FINE, _RESTARTS = 0.12, 0.02, 1e-6, 4  # sizes of the simplexes [rad] where a top is an edge, and how often


@kernel
def worst_plane(
    block: Block, curve: Curve, grid: SearchGrid, work: PlaneWorkspace, search: SearchWorkspace
) -> tuple[float, Vector, Vector]:
    """(damage, normal, direction) where the damage is greatest of all planes and directions in them.

    The hills that the samples show are climbed in haste, the highest of these to the top.
    """
    normal, direction = frame_of(grid, measure_shears(block, grid, work, search))
    _climb(block, curve, normal, direction, work, search, 0)
    rule_out(block, curve, grid, np.exp(search.height[0]), work, search)
    _sample(block, curve, grid, work, search)
    hills = 1
    while hills < len(search.height):
        g = int(np.argmax(search.score))
        if search.score[g] == -np.inf:
            break
        normal, direction = frame_of(grid, g)
        _climb(block, curve, normal, direction, work, search, hills)
        _exclude_neighbours(grid, search.score, normal, direction)
        hills += 1
    return _refine_best(block, curve, search.hills[:hills], search.height[:hills], work, search)


@inner
def _sample(block, curve, grid, work, search):
    """Writes the log damage on the frames whose normal is not ruled out into `score` (frames,), -inf for the others."""
    directions = grid.directions.shape[1]
    for g in range(len(search.score)):
        search.score[g] = -np.inf
        if not np.isnan(search.shear[g // directions]):
            normal, direction = frame_of(grid, g)
            search.score[g] = np.log(plane_damage(block, curve, normal, direction, work))


@inner
def _climb(block, curve, normal, direction, work, search, hill):
    """Climbs in haste from a frame and keeps log damage, normal and direction there as number `hill`."""
    led, height, n, d = climb_tangents(block, curve, normal, direction, _HASTE, _HASTY_GAIN, work, search.tangent)
    if not led:
        other, normal, direction = nelder_mead(block, curve, normal, direction, _WIDE, _COARSE, work, search.simplex)
        if other > height:
            height, n, d = other, normal, direction
    search.height[hill] = height
    for i in range(3):
        search.hills[hill, i], search.hills[hill, 3 + i] = n[i], d[i]


@inner
def _exclude_neighbours(grid, score, normal, direction):
    """Sets the log damage to -inf in score (frames,) for frames of the grid near one that was climbed from."""
    for g in range(len(score)):
        if score[g] > -np.inf and _near(normal, direction, frame_of(grid, g), _SAME_HILL):
            score[g] = -np.inf


@inner
def _near(normal, direction, frame, cosine):
    """Whether the angles between two normals and between two directions have more than a cosine."""
    return abs(dot(frame[0], normal)) > cosine and abs(dot(frame[1], direction)) > cosine


@inner
def _row_vector(hill, first):
    """Three numbers of hill (6,) [-]."""
    return hill[first], hill[first + 1], hill[first + 2]


@kernel
def _refine_best(block, curve, hills, heights, work, search):
    """(damage, normal, direction) of the highest of the frames hills (h, 6) [-], log damages heights (h,) [-], climbed to the top."""
    best, normal, direction = -np.inf, (np.nan, np.nan, np.nan), (np.nan, np.nan, np.nan)
    for _ in range(_MAX_REFINED):
        h = np.argmax(heights)
        if heights[h] == -np.inf or heights[h] < best - _HASTY_LOSS:
            break
        height, n, d = _climb_to_top(block, curve, _row_vector(hills[h], 0), _row_vector(hills[h], 3), work, search)
        if height > best:
            best, normal, direction = height, n, d
        heights[h] = -np.inf
        for k in range(len(hills)):
            if _near(n, d, (_row_vector(hills[k], 0), _row_vector(hills[k], 3)), _SAME_TOP):
                heights[k] = -np.inf
    return np.exp(best), normal, direction


@inner
def _climb_to_top(block, curve, normal, direction, work, search):
    """(log damage, normal, direction) from a frame near the top: by simplexes and tangents in turn, where that does not end on a led top
    by simplexes alone."""
    led, height = False, -np.inf
    for size in _AROUND:
        _, normal, direction = nelder_mead(block, curve, normal, direction, size, _NEARER, work, search.simplex)
        led, height, normal, direction = climb_tangents(block, curve, normal, direction, _STEPS, 0.0, work, search.tangent)
    for k in range(0 if led else _RESTARTS):  # a simplex can collapse on an edge, one that is turned round then goes on
        height, normal, direction = nelder_mead(block, curve, normal, direction, _COARSE * (-0.5) ** k, _FINE, work, search.simplex)
    return height, normal, direction
