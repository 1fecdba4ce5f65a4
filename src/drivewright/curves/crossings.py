"""Where a chain of smooth pieces crosses itself.

Chords of dense samples find the crossings, Newton's method on q(a) = q(b) makes them exact.  Tails between a cusp and a joint may
be thinner than the chords' error; they are sought from the joint.
"""

from typing import NamedTuple

import numpy as np

from drivewright.curves.pieces import Chain, gather
from drivewright.errors import counted

_TOLERANCE = 1e-12  # two branches meet when they are this close, relative to the size of the curve
_TAIL, _JOINT_TAIL = 0.5, 5e-3  # a tail shorter than this [samples], on one piece or across a joint, is one branch meeting itself
_NEAR, _SMALL = 1e-4, 2e-3  # relative to the size of the curve, sine
_MOST = 20_000  # places that are looked at one by one
_MOST_PAIRS = 5_000_000  # of chords whose boxes meet
_BEYOND = "its size and its details differ by more than numbers can hold"
_SAME = 1e-3  # crossings nearer than this [samples] on both branches are one


class Crossing(NamedTuple):
    """The chain passes `point` (complex) at the places `first` < `second`."""

    first: float
    second: float
    point: complex


def self_crossings(chain: Chain) -> tuple[Crossing, ...]:
    """All crossings of the chain with itself, in order of their first place; InputError where rounding makes it cross itself everywhere."""
    seeds = np.concatenate([_from_chords(chain), _from_joints(chain)])
    if not len(seeds):
        return ()
    counted(len(seeds), _MOST, "places at which a curve may cross itself", _BEYOND)
    places, steps, points = _refined(chain, seeds)
    kept, at = [], np.empty_like(steps)
    for k in np.lexsort((places[:, 1], places[:, 0])):
        if not np.any(np.all(_separation(chain, steps[k], at[: len(kept)]) < _SAME, axis=1)):
            at[len(kept)] = steps[k]
            kept.append(Crossing(float(places[k, 0]), float(places[k, 1]), complex(points[k])))
    return tuple(kept)


def _separation(chain, a, b):
    """Distance along the loop in samples, where the end of a piece and the start of the next are one place; inf between two loops."""
    ends = chain.first[chain.loops] - chain.loops  # steps at which the loops begin
    home, other = (np.clip(np.searchsorted(ends, place, side="right") - 1, 0, len(ends) - 2) for place in (a, b))
    length = np.diff(ends)[home]
    return np.where(home == other, np.abs((a - b + 0.5 * length) % length - 0.5 * length), np.inf)


def _from_chords(chain):
    """Places (n, 2) where two chords that are not neighbours cross."""
    start = chain.segments
    a, b = chain.z[start], chain.z[start + 1]
    i, j = _overlapping(a, b)
    apart = _separation(chain, i, j) > 1  # chord number k runs from step k to k + 1
    i, j = i[apart], j[apart]
    along_i, along_j, between = b[i] - a[i], b[j] - a[j], a[j] - a[i]
    with np.errstate(divide="ignore", invalid="ignore"):  # parallel chords: nan or inf, and no crossing
        area = _cross(along_i, along_j)
        s, r = _cross(between, along_j) / area, _cross(between, along_i) / area
        hit = (s >= 0) & (s <= 1) & (r >= 0) & (r <= 1)
    return np.stack([start[i[hit]] + s[hit], start[j[hit]] + r[hit]], axis=1)


def _overlapping(a, b):
    """Numbers i < j of the chords from a to b (n,) whose upright boxes meet.

    A binary tree of boxes over the chords in their order is compared with itself, level by level: about n log n comparisons.
    InputError where rounding lays most of them upon each other.
    """
    ends = np.stack([[a.real, b.real], [a.imag, b.imag]])
    low, high = np.min(ends, axis=1), np.max(ends, axis=1)
    levels = []
    while low.shape[1] > 1:
        if low.shape[1] % 2:
            low, high = np.pad(low, ((0, 0), (0, 1)), constant_values=np.inf), np.pad(high, ((0, 0), (0, 1)), constant_values=-np.inf)
        levels.append((low, high))
        low, high = np.minimum(low[:, ::2], low[:, 1::2]), np.maximum(high[:, ::2], high[:, 1::2])
    i = j = np.zeros(1, dtype=int)
    for low, high in reversed(levels):
        i, j = np.concatenate([2 * i, 2 * i, 2 * i + 1, 2 * i + 1]), np.concatenate([2 * j, 2 * j + 1, 2 * j, 2 * j + 1])
        meet = (i <= j) & (low[0, i] <= high[0, j]) & (low[0, j] <= high[0, i]) & (low[1, i] <= high[1, j]) & (low[1, j] <= high[1, i])
        i, j = i[meet], j[meet]
        counted(len(i), _MOST_PAIRS, "pairs of pieces of a curve that lie upon each other", _BEYOND)
    return i[i < j], j[i < j]


def _cusps(chain):
    """Places inside the pieces where the chain reverses."""
    start = chain.segments
    back = start[np.real(np.conj(chain.v[start]) * chain.v[start + 1]) < 0]
    speed = np.abs(chain.v)
    return back + speed[back] / (speed[back] + speed[back + 1])


def _from_joints(chain):
    """Starting places for the small tails between a cusp and a joint at which the chain reverses once more.

    Such a tail has no one scale, so the branch beyond the cusp is tried in growing steps, each with the place on the other side of
    the joint that is equally far from the joint.
    """
    cusps, seeds = _cusps(chain), []
    for k in range(len(chain.pieces)):
        end, start = chain.first[k + 1] - 1, chain.first[chain.following[k]]
        if np.real(np.conj(chain.v[end]) * chain.v[start]) >= 0:
            continue
        last, following = chain.first[k], chain.first[chain.following[k] + 1] - 1
        before = cusps[(cusps > last) & (cusps < end)]
        after = cusps[(cusps > start) & (cusps < following)]
        if len(before):
            seeds += _ladder(chain, end, before[-1], last, np.arange(start, following + 1))
        if len(after):
            seeds += _ladder(chain, start, after[0], following, np.arange(end, last - 1, -1))
    return np.array(seeds).reshape(-1, 2)


def _ladder(chain, joint, cusp, limit, other):
    """Places beyond the cusp, at growing multiples of its distance from the joint, with their equals among the `other` samples."""
    places = cusp + (cusp - joint) * 2.0 ** np.arange(12)
    places = places[(places - limit) * (joint - limit) > 0]
    if not len(places):  # the cusp sits at the end of its piece
        return []
    far = np.abs(gather(chain.pieces, *chain.locate(places)).d0 - chain.z[joint])
    distance = np.maximum.accumulate(np.abs(chain.z[other] - chain.z[joint]))
    equal = other[0] + np.sign(other[-1] - other[0]) * np.interp(far, distance, np.arange(len(other)))
    return list(zip(places, equal, strict=True))


def _refined(chain, seeds, steps=15):
    """Newton on q(a) = q(b) for all seeds at once: places (n, 2) in order, the same without the joints, points.

    Seeds that meet nowhere or only themselves are dropped.
    """
    index, t = chain.locate(seeds.ravel())
    moving = np.arange(len(t))  # both places of every pair that is not settled
    for _ in range(steps):
        step = _step(gather(chain.pieces, index[moving], t[moving]))
        index[moving], there = _cross_joints(chain, index[moving], t[moving] + step)
        low, high = _range(chain, index[moving])
        t[moving] = np.clip(there, low, high)
        settled = np.abs(step) <= 1e-12 * np.maximum(np.abs(low), np.abs(high))  # the step made leaves its square
        moving = moving[np.repeat(~settled.reshape(-1, 2).all(axis=1), 2)]
        if not len(moving):
            break
    ends = gather(chain.pieces, index, t)
    q = ends.d0
    u = chain.place(index, t).reshape(-1, 2)
    u, index = np.take_along_axis(u, order := np.argsort(u, axis=1), 1), np.take_along_axis(index.reshape(-1, 2), order, 1)
    steps = u - index
    least = np.where(index[:, 0] == index[:, 1], _TAIL, _JOINT_TAIL)
    good = (np.abs(q[1::2] - q[::2]) <= _TOLERANCE * chain.size) & (_separation(chain, *steps.T) > least)
    if len(chain.loops) > 2:
        good &= ~_grazing(chain, u, ends)
    return u[good], steps[good], q[::2][good]


def _grazing(chain, u, ends):
    """True where a branch meets itself a little further on at next to no angle: beside the arc about a cusp, which it leaves slower than
    numbers can tell."""
    length = np.append(0.0, np.cumsum(np.abs(np.diff(chain.z)) * (np.diff(chain.index) == 0)))
    along = np.interp(u, np.arange(len(length)), length)
    bounds = chain.first[chain.loops]
    home = np.searchsorted(bounds, u, side="right") - 1
    whole = (length[bounds[1:] - 1] - length[bounds[:-1]])[np.clip(home[:, 0], 0, len(bounds) - 2)]
    apart = np.abs(along[:, 1] - along[:, 0])
    apart = np.where(home[:, 0] == home[:, 1], np.minimum(apart, np.abs(whole - apart)), np.inf)
    first, second = ends.d1[::2], ends.d1[1::2]
    with np.errstate(divide="ignore", invalid="ignore"):
        angle = np.abs(_cross(first, second)) / (np.abs(first) * np.abs(second))
    return (apart < _NEAR * chain.size) & ~(angle > _SMALL)


def _step(q):
    """Newton step for a and b in turn."""
    miss, from_a, from_b = q.d0[1::2] - q.d0[::2], q.d1[::2], q.d1[1::2]
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):  # tangent branches: no step
        area = _cross(from_a, from_b)
        step = np.stack([_cross(miss, from_b) / area, _cross(miss, from_a) / area], axis=1).ravel()
    return np.where(np.isfinite(step), step, 0.0)


def _range(chain, index):
    ends = np.array([sorted((piece.start, piece.stop)) for piece in chain.pieces])
    return ends[index, 0], ends[index, 1]


def _cross_joints(chain, index, t):
    """A parameter that has run over the end of its piece moves to the neighbouring piece's end."""
    starts, stops = (np.array([getattr(piece, end) for piece in chain.pieces]) for end in ("start", "stop"))
    sense = np.array([piece.sense for piece in chain.pieces])[index]
    over, under = sense * (t - stops[index]) > 0, sense * (t - starts[index]) < 0
    following, previous = chain.following[index], chain.previous[index]
    return (
        np.where(over, following, np.where(under, previous, index)),
        np.where(over, starts[following], np.where(under, stops[previous], t)),
    )


def _cross(a, b):
    """z component of the cross product of plane vectors."""
    return np.imag(np.conj(a) * b)
