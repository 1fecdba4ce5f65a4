"""The plane and direction of the greatest damage.

A first climb, from the frame (normal and direction) of the greatest strains, gives a damage; for blocks that are their own image in the
plane z = 0, climbs from the tops among the frames in it follow.  Planes that cannot do as much are ruled out by `bounds`; on the others all
directions of a grid are sampled, and the best frames that are not neighbours climbed from.  So every plane that does more damage than the
result has its normal, or the image of it, within the grid's `reach` of a normal that was sampled in all its directions.
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
_EQUATOR_LOSS = 0.5  # log damage of a frame beside a top of the equator, below it
_NO_GAIN = 1e-10  # log damage of a climb from a top that confirms it
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
    hills = _climb_from_equator(block, curve, work, search)
    rule_out(block, curve, grid, np.exp(search.height[:hills].max()), work, search)
    _sample(block, curve, grid, work, search)
    while hills < len(search.height):
        g = int(np.argmax(search.score))
        if search.score[g] == -np.inf:
            break
        normal, direction = frame_of(grid, g)
        _climb(block, curve, normal, direction, work, search, hills)
        _exclude_neighbours(grid, search.score, normal, direction)
        hills += 1
    return _refine_best(block, curve, grid, hills, work, search)


@inner
def _climb_from_equator(block, curve, work, search):
    """Climbs from the tops among the frames of `equator` (e,), which are their own images; the number of hills, the first one with them."""
    score, hills = search.equator, 1
    for k in range(len(score)):
        normal, direction = _equator_frame(k, len(score))
        score[k] = np.log(plane_damage(block, curve, normal, direction, work))
    for k in range(len(score)):
        top = score[k] > score[k - 1] and score[k] >= score[(k + 1) % len(score)]
        if top and score[k] > search.height[0] - _EQUATOR_LOSS and hills < len(search.height):
            normal, direction = _equator_frame(k, len(score))
            _climb(block, curve, normal, direction, work, search, hills)
            hills += 1
    return hills


@inner
def _equator_frame(k, count):
    """(normal, direction) number k of so many in the plane z = 0."""
    angle = np.pi * (k + 0.5) / count
    return (np.cos(angle), np.sin(angle), 0.0), (-np.sin(angle), np.cos(angle), 0.0)


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
        if score[g] > -np.inf and _near(normal, direction, frame_of(grid, g), _SAME_HILL, grid.mirrored):
            score[g] = -np.inf


@inner
def _near(normal, direction, frame, cosine, mirrored):
    """Whether the angles between two normals and between two directions have more than a cosine; mirrored: or those to their images."""
    if abs(dot(frame[0], normal)) > cosine and abs(dot(frame[1], direction)) > cosine:
        return True
    return mirrored and abs(dot(frame[0], _image(normal))) > cosine and abs(dot(frame[1], _image(direction))) > cosine


@inner
def _image(v):
    """A vector's image in the plane z = 0, in its unit."""
    return v[0], v[1], -v[2]


@inner
def _row_vector(hill, first):
    """Three numbers of hill (6,) [-]."""
    return hill[first], hill[first + 1], hill[first + 2]


@inner
def _refine_best(block, curve, grid, hills, work, search):
    """(damage, normal, direction) of the highest of so many hills of a `SearchWorkspace`, climbed to the top."""
    best, normal, direction, sure = -np.inf, (np.nan, np.nan, np.nan), (np.nan, np.nan, np.nan), True
    heights = search.height[:hills]
    for _ in range(_MAX_REFINED):
        h = np.argmax(heights)
        if heights[h] == -np.inf or heights[h] < best - _HASTY_LOSS:
            break
        start = _row_vector(search.hills[h], 0), _row_vector(search.hills[h], 3)
        led, height, n, d = _climb_to_top(block, curve, start[0], start[1], 1.0, work, search)
        heights[h] = -np.inf
        _exclude_hills(search, heights, start, grid.mirrored)
        _exclude_hills(search, heights, (n, d), grid.mirrored)
        if height > best:
            best, normal, direction, sure = height, n, d, led
    while not sure:  # on an edge one climb can end before the top
        _, height, n, d = _climb_to_top(block, curve, normal, direction, -1.0, work, search)
        sure = not height > best + _NO_GAIN
        if height > best:
            best, normal, direction = height, n, d
    return np.exp(best), normal, direction


@inner
def _exclude_hills(search, heights, frame, mirrored):
    """Sets the log damage to -inf in heights (h,) for the hills of a `SearchWorkspace` that are at a frame."""
    for k in range(len(heights)):
        if _near(frame[0], frame[1], (_row_vector(search.hills[k], 0), _row_vector(search.hills[k], 3)), _SAME_TOP, mirrored):
            heights[k] = -np.inf


@inner
def _climb_to_top(block, curve, normal, direction, sense, work, search):
    """(whether tangents lead to the top, log damage, normal, direction) from a frame near it: by simplexes and tangents in turn, where that
    does not end on a led top by simplexes alone, of which the sense (1 or -1) turns the first corners round."""
    led, height = False, -np.inf
    for size in _AROUND:
        _, normal, direction = nelder_mead(block, curve, normal, direction, sense * size, _NEARER, work, search.simplex)
        led, height, normal, direction = climb_tangents(block, curve, normal, direction, _STEPS, 0.0, work, search.tangent)
    for k in range(0 if led else _RESTARTS):  # a simplex can collapse on an edge, one that is turned round then goes on
        height, normal, direction = nelder_mead(block, curve, normal, direction, sense * _COARSE * (-0.5) ** k, _FINE, work, search.simplex)
    return led, height, normal, direction
