"""Loss of motion by an undercut profile, as three different lengths.

The *profile gap* is the distance between the follower in its planned place and the real profile, square to it.  The *lost motion* is how
far the follower sinks along its travel until it rests on the real profile; it slides on the way and may touch elsewhere than at the
nearest point.  The *profile loss* is how far the intended point of contact lies off the real profile.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from drivewright._typing import ArrayLike, Complexes, Floats
from drivewright.curves.pieces import gather
from drivewright.curves.trim import Trimmed
from drivewright.errors import SolverError

TOUCHING = 1e-12  # of the profile's size: the follower rests
NUDGE = 1e-7  # the same: over which the rate of a gap is taken
MOST_STEPS = 200
BOLD = 8.0  # a step of Newton's method over the one that cannot pass a contact


def profile_gap(trimmed: Trimmed, t: ArrayLike) -> Floats:
    """Gap [m] between the follower in its planned place at the parameters t and the real profile.

    For a circle: distance from its planned centre to the profile minus the radius; for a line: its distance from the profile.
    0 exactly where the planned contact point survives.
    """
    return _where_missing(trimmed, t, lambda missing: np.maximum(_nearest(trimmed, _planned(trimmed, missing))[0], 0.0))


def lost_motion(trimmed: Trimmed, t: ArrayLike, place: Callable[[Floats, Floats], Any], fastest: float = 1.0) -> Floats:
    """How far [m] the follower sinks along its travel at the parameters t until it rests on the real profile; 0 where nothing is lost.

    place(t, depth): members of the family (as its `members`) sunk by `depth` (n,) [m] of travel from their planned place; fastest: the
    most that a point of a member may come nearer to the profile per depth.  SolverError where it falls through.
    """
    return _where_missing(trimmed, t, lambda missing: _first_contact(trimmed, missing, place, fastest))


def largest_profile_gap(trimmed: Trimmed) -> tuple[float, float]:
    """(parameter, profile gap [m]) where it is greatest; (nan, 0.0) for an untrimmed profile."""
    return _largest(trimmed, lambda t: profile_gap(trimmed, t))


def largest_lost_motion(trimmed: Trimmed, place: Callable[[Floats, Floats], Any], fastest: float = 1.0) -> tuple[float, float]:
    """(parameter, lost motion [m]) where it is greatest; (nan, 0.0) for an untrimmed profile."""
    return _largest(trimmed, lambda t: lost_motion(trimmed, t, place, fastest))


def _where_missing(trimmed, t, quantity):
    """found(t) at the parameters whose contact point was cut away, 0 at the others."""
    t = np.asarray(t, dtype=float)
    flat = t.ravel()
    lost, missing = np.zeros(flat.shape), np.zeros(flat.shape, dtype=bool)
    for start, stop in trimmed.removed:
        missing |= (flat >= start) & (flat <= stop)
    if missing.any():
        lost[missing] = quantity(flat[missing])
    return lost.reshape(t.shape)


def _largest(trimmed, lost_at):
    best = (np.nan, 0.0)
    for start, stop in trimmed.removed:
        deepest = best
        for _ in range(3):  # each pass narrows the place by 32
            t = np.linspace(start, stop, 65)
            lost = lost_at(t)
            k = int(np.argmax(lost))
            start, stop = t[max(k - 1, 0)], t[min(k + 1, 64)]
            deepest = float(t[k]), float(lost[k])
        best = max(best, deepest, key=lambda place_and_value: place_and_value[1])
    return best


def _planned(trimmed, t):
    """The members at parameters t."""
    starts = np.array([piece.start for piece in trimmed.chain.pieces if piece.source is not None])
    return trimmed.family.members(np.clip(np.searchsorted(starts, t, side="right") - 1, 0, len(starts) - 1), t)


def _nearest(trimmed, members, count=257, steps=6):
    """(least gap between each member and the surviving profile, point there): of `count` points per span, refined by Newton."""
    family, spans = trimmed.family, trimmed.spans
    s = np.concatenate([np.linspace(span.start, span.stop, count) for span in spans])
    pieces = tuple(span.piece for span in spans)
    points = gather(pieces, np.repeat(np.arange(len(spans)), count), s).d0
    gaps = family.gap(members[..., None], points)
    best = np.argmin(gaps, axis=-1)
    least, at, point = np.min(gaps, axis=-1), s[best], points[best]
    low = np.where(best % count > 0, s[best - 1], at)
    high = np.where(best % count < count - 1, s[np.minimum(best + 1, len(s) - 1)], at)
    for _ in range(steps):
        touch = gather(pieces, best // count, at)
        gap = family.gap(members, touch)
        least, point = np.where(gap.d0 < least, gap.d0, least), np.where(gap.d0 < least, touch.d0, point)
        at = _downhill(at, gap, low, high)
    return least, point


def _downhill(t, gap, low, high):
    """One Newton step towards gap' = 0 inside [low, high]; none where that would be a maximum."""
    with np.errstate(divide="ignore", invalid="ignore"):
        step = np.where(gap.d2 > 0, -gap.d1 / gap.d2, 0.0)
    return np.clip(t + np.where(np.isfinite(step), step, 0.0), low, high)


def _first_contact(trimmed, t, place, fastest):
    """Depths at which the members first touch the profile.

    gap/fastest cannot pass a contact; Newton's step, by the rate at the nearest point, is taken where it does not.
    """
    size, depth = trimmed.chain.size, np.zeros(t.shape)
    gap, point = _nearest(trimmed, place(t, depth))
    for _ in range(MOST_STEPS):
        if np.all(gap <= TOUCHING * size):
            return depth
        rate = (trimmed.family.gap(place(t, depth + NUDGE * size), point) - trimmed.family.gap(place(t, depth), point)) / (NUDGE * size)
        safe = np.maximum(gap, 0.0) / fastest
        with np.errstate(divide="ignore", invalid="ignore"):
            bold = np.where(rate < 0, np.clip(-np.maximum(gap, 0.0) / rate, safe, BOLD * safe), safe)
        trial, (ahead, near) = depth + bold, _nearest(trimmed, place(t, depth + bold))
        passed = ahead < -TOUCHING * size
        if passed.any():
            trial = np.where(passed, depth + safe, trial)
            ahead, near = _nearest(trimmed, place(t, trial))
        depth, gap, point = trial, ahead, near
        if np.any(depth > size):
            break
    raise SolverError(
        "undercut: the follower finds nothing to rest on where the profile is cut away; it falls through. "
        "Enlarge the prime radius or take a smaller face radius"
    )


def profile_loss(trimmed: Trimmed, samples: int = 20_001) -> float:
    """Greatest distance [m] of an intended point of contact from the real profile; 0.0 for an untrimmed one.

    Not the lost motion: the follower sinks until it touches elsewhere, while the intended point lies off the profile altogether.
    `samples` per stretch of the profile set the error, about (spacing)^2 / (8 loss).
    """
    from scipy.spatial import KDTree

    cut = np.zeros(len(trimmed.chain.t), dtype=bool)
    moving = np.array([piece.source is not None for piece in trimmed.chain.pieces])[trimmed.chain.index]
    for start, stop in trimmed.removed:
        cut |= moving & (trimmed.chain.t > start) & (trimmed.chain.t < stop)
    if not cut.any():
        return 0.0
    along = (span.piece.at(np.linspace(span.start, span.stop, samples)).d0 for span in trimmed.spans)
    points: Complexes = np.concatenate([np.broadcast_to(stretch, samples) for stretch in along])
    flat = np.stack([points.real, points.imag], axis=1)
    lost = trimmed.chain.z[cut]
    return float(KDTree(flat).query(np.stack([lost.real, lost.imag], axis=1))[0].max())
