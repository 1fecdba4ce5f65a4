"""Passes of a torsion test: stretches over which the torque rises or falls, and what has to go before they are compared."""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Bools, Floats, Ints
from drivewright.errors import InputError
from drivewright.indexing.torsion_test.reading import Readings

FEWEST = 8  # samples of a test
TURNING = 0.1  # of the torque's range: so far the torque must come back before that is a turning point, not noise
HOLD_BAND = 0.01  # of the torque's range: samples this close to an extreme are held there
WHOLE_PASS = 0.9  # of the torque's range: a pass so long is a whole branch
KNOTS = 9  # of the shape of a branch, when its drift is looked for


class Passes(NamedTuple):
    """torque [N m], angle [rad], number of the pass of each sample (m,); rising (p,) says which passes load in the sense of +torque.

    cycle (m,): number of the cycle, for resampling.
    """

    torque: Floats
    angle: Floats
    number: Ints
    rising: Bools
    cycle: Ints

    def side(self, rising: bool) -> Bools:
        """Samples of one branch: those of all passes with rising (True) or falling torque."""
        return self.rising[self.number] == rising

    def span(self, samples: Bools) -> float:
        """Part of the whole range of the torque that some samples (mask) cover."""
        return float(np.ptp(self.torque[samples]) / np.ptp(self.torque)) if np.any(samples) else 0.0


def split_passes(readings: Readings) -> Passes:
    """The `Passes` of a test, cut at the turning points of the torque; InputError where there is too little to see.

    A turning point counts once the torque has come back by 10 % of its range, so that noise makes none.  Where the readings name
    branches the cuts are between those; what loads and what unloads is always read off the torque, because "loading" may mean growing
    torque or growing size of torque.
    """
    torque, angle = (np.asarray(column, dtype=float) for column in readings[:2])
    _refuse(torque, angle)
    cuts = turning_points(torque) if readings.branch is None else 1 + np.flatnonzero(np.diff(readings.branch))
    number = np.searchsorted(cuts, np.arange(torque.size), side="right")
    directions = np.array([_trend(torque[number == each]) for each in range(len(cuts) + 1)])
    merged = np.concatenate([[0], np.cumsum(directions[1:] != directions[:-1])])  # +T -> 0 -> -T in two named branches is one pass
    rising = directions[np.concatenate([[True], directions[1:] != directions[:-1]])] > 0
    number = merged[number]
    cycle = _cycles(torque, number, rising) if readings.cycle is None else np.asarray(readings.cycle)
    return Passes(torque, angle, number, rising, cycle)


def _refuse(torque, angle):
    if torque.shape != angle.shape or torque.ndim != 1:
        raise InputError(f"torsion test: torque {torque.shape} and angle {angle.shape} must be rows of the same length")
    if torque.size < FEWEST:
        raise InputError(f"torsion test: {torque.size} samples are too few for a stiffness with an uncertainty; give at least {FEWEST}")
    if not (np.all(np.isfinite(torque)) and np.all(np.isfinite(angle))):
        raise InputError("torsion test: torque and angle must be finite; drop the samples that are not")
    for what, column, unit in (("torque", torque, "N m"), ("angle", angle, "rad")):
        if np.ptp(column) <= 1e-9 * np.max(np.abs(column)):
            raise InputError(f"torsion test: the {what} is {column[0]:g} {unit} in all samples; a stiffness needs a {what} that changes")


def turning_points(torque: Floats) -> Ints:
    """Numbers of the samples that begin a new pass: behind an extreme from which the torque comes back by `TURNING` of its range.

    The samples at the extreme, as far as they stay within `HOLD_BAND` of the range, are shared by halves.
    """
    back = TURNING * np.ptp(torque)
    extremes, direction, low, high = [], 0, 0, 0
    for sample, value in enumerate(torque):
        high = sample if value > torque[high] else high
        low = sample if value < torque[low] else low
        if direction >= 0 and torque[high] - value >= back:
            extremes += [high] if direction else []
            direction, low, high = -1, sample, sample
        elif direction <= 0 and value - torque[low] >= back:
            extremes += [low] if direction else []
            direction, low, high = 1, sample, sample
    return np.array([_middle(torque, extreme) for extreme in extremes], dtype=int)


def _middle(torque, extreme):
    """The sample behind the middle of those held at an extreme."""
    away = np.abs(torque - torque[extreme]) > HOLD_BAND * np.ptp(torque)
    before, after = np.flatnonzero(away[:extreme]), np.flatnonzero(away[extreme:])
    first = before[-1] + 1 if before.size else 0
    return first + (extreme + after[0] - first + 1) // 2


def _cycles(torque, number, rising):
    """Number of the cycle of each sample: one ends where the torque comes back to where the test began, on the same branch."""
    way, starts = 1 if rising[0] else -1, []
    for each in range(2, len(rising), 2):
        back = (number == each) & (way * (torque - torque[0]) >= 0)
        starts += [int(np.argmax(back))] if np.any(back) else []
    return np.searchsorted(starts, np.arange(torque.size), side="right")


def _trend(values):
    """+1 where values rise on the whole, else -1."""
    return 1 if np.dot(np.arange(values.size) - (values.size - 1) / 2, values) > 0 else -1


def drop_conditioning(passes: Passes) -> tuple[Passes, tuple[str, ...]]:
    """(passes without the conditioning, what was dropped in words).

    The first cycle goes where what stays still holds both branches as far as they reach; else the first pass, where it starts on the way
    (a rise from rest); else nothing: a single loop is taken as it is.  An unfinished last cycle goes in the same way, so that the whole
    loop has as much of one branch as of the other.
    """
    dropped = []
    for candidates in ((_first_cycle, _rise_from_rest), (_unfinished_end,)):
        for samples, words in (candidate(passes) for candidate in candidates):
            if np.any(samples) and _holds(passes, ~samples):
                passes, dropped = _without(passes, samples), [*dropped, words]
                break
    return passes, tuple(dropped)


def _first_cycle(passes):
    return passes.cycle == passes.cycle[0], "the first cycle (conditioning)"


def _rise_from_rest(passes):
    first = passes.number == 0
    return first & (passes.span(first) < WHOLE_PASS), "the first rise from rest"


def _unfinished_end(passes):
    last = passes.cycle == passes.cycle[-1]
    finished = all(passes.span(last & passes.side(way)) >= WHOLE_PASS * passes.span(passes.side(way)) for way in (True, False))
    return last & (not finished), "the unfinished last cycle"


def _holds(passes, samples):
    """Whether some samples (mask) have both branches as whole as all samples together."""
    spans = [(passes.span(passes.side(way) & samples), passes.span(passes.side(way))) for way in (True, False)]
    return all(kept >= max(0.5, every - 0.05) for kept, every in spans)


def _without(passes, drop):
    left, number = np.unique(passes.number[~drop], return_inverse=True)
    return Passes(passes.torque[~drop], passes.angle[~drop], number, passes.rising[left], passes.cycle[~drop])


def estimate_drift(passes: Passes) -> float | None:
    """Drift of the angle [rad per sample], or None where the test cannot tell.

    Hysteresis depends on torque and direction only: what changes from one pass of a branch to the next pass of the same branch is drift.
    So angle = shape(torque, branch) + d t, t counted in samples, by least squares; the shape of each branch is a polygon over 9
    torques.  A single loop passes each branch once; there drift cannot be told from hysteresis, and none is removed.
    """
    if max(np.sum(passes.rising), np.sum(~passes.rising)) < 2 or not _overlapping(passes):
        return None
    t = np.arange(passes.torque.size) / passes.torque.size
    knots = np.linspace(passes.torque.min(), passes.torque.max(), KNOTS)
    hats = np.column_stack([np.interp(passes.torque, knots, unit) for unit in np.eye(KNOTS)])
    shapes = np.hstack([hats * passes.side(way)[:, None] for way in (True, False)])
    scale = np.max(np.abs(passes.angle - passes.angle.mean()))
    found = np.linalg.lstsq(np.column_stack([shapes, t]), (passes.angle - passes.angle.mean()) / scale, rcond=None)[0]
    return float(found[-1]) * scale / passes.torque.size


def _overlapping(passes):
    """Whether two passes of one branch share at least half the torque's range."""
    ends = [(passes.torque[passes.number == n].min(), passes.torque[passes.number == n].max()) for n in range(len(passes.rising))]
    half = 0.5 * np.ptp(passes.torque)
    return any(
        min(a[1], b[1]) - max(a[0], b[0]) >= half
        for i, a in enumerate(ends)
        for b, way in zip(ends[:i], passes.rising[:i], strict=True)
        if way == passes.rising[i]
    )


def remove_drift(passes: Passes, per_sample: float) -> Passes:
    """The same with a drift [rad per sample] taken off, unmoved in the middle."""
    t = np.arange(passes.torque.size)
    return passes._replace(angle=passes.angle - per_sample * (t - t.mean()))
