"""One torsion test from its readings to stiffness, play and hysteresis, and a test at several positions of the crank."""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from drivewright.errors import InputError
from drivewright.indexing.torsion_test.findings import FEWEST_CYCLES, findings
from drivewright.indexing.torsion_test.passes import WHOLE, drift, settled, split, without_drift
from drivewright.indexing.torsion_test.regression import Estimate, Line, fit_line, inverse_estimate, slope_estimate
from drivewright.indexing.torsion_test.series import correct
from drivewright.indexing.torsion_test.shape import LOST_AT, Pieces, Shape, fit_pieces, folded, loop_of, shape

SAME_PLACE = 1e-3  # rad: crank angles this close are one position
JUMP_SURE = 4.0  # standard uncertainties of the jump of the angle at zero torque, from which the sides of a branch are taken apart ...
JUMP_LARGE = 0.02  # ... where it is also this part of the angle's range
NO_SHAPE = Shape(*[np.nan] * 6)
NO_PIECES = Pieces(*[np.nan] * 6)


class Setup(NamedTuple):
    """How a test is to be evaluated: rated torque [N m] (None: the largest of the data), springs in series (`Part`s), confidence of the
    intervals, resampled tests and the seed of their draw."""

    rated_torque: float | None = None
    parts: tuple = ()
    confidence: float = 0.95
    resamples: int = 1000
    seed: int = 1


@dataclass(frozen=True)
class Evaluation:
    """What one loop, or several cycles of it, says.  Stiffness in N m/rad as `Estimate`s.

    whole_loop: ordinary least squares of torque on angle over all samples (paper, eq. 3); inverse: of angle on torque, turned;
    per_branch: of angle on torque, each pass of a branch with an intercept of its own; loading, unloading: one branch alone, None where it
    is missing; corrected: per_branch without the springs in series.  bootstrap: name -> (low, high) of resampled cycles.
    torque, angle: the samples used, without drift and zero; group: number of the intercept of `line`, the fit behind per_branch, that
    belongs to each sample, -1 for none; whole_line: the fit behind whole_loop; mid_line: (torque, angle) from zero torque on, or None.
    """

    whole_loop: Estimate
    inverse: Estimate
    per_branch: Estimate
    loading: Estimate | None
    unloading: Estimate | None
    corrected: Estimate
    shape: Shape
    pieces: Pieces
    rated_torque: float
    drift: float | None  # rad over the whole test
    bootstrap: dict
    findings: tuple
    torque: np.ndarray
    angle: np.ndarray
    group: np.ndarray
    line: Line
    whole_line: Line
    mid_line: tuple | None
    crank: float | None = None


def evaluate(readings, setup=None, crank=None):
    """The `Evaluation` of the readings of one position; InputError where they hold no stiffness."""
    setup = Setup() if setup is None else setup
    passes, dropped = settled(split(readings))
    rate = drift(passes)
    passes = passes if rate is None else without_drift(passes, rate)
    rated = float(np.max(np.abs(passes.torque))) if setup.rated_torque is None else float(setup.rated_torque)
    loop = loop_of(passes, WHOLE)
    seen = shape(loop, rated) if loop else NO_SHAPE
    passes = passes._replace(angle=passes.angle - (seen.zero if np.isfinite(seen.zero) else passes.angle.mean()))
    curve = folded(loop) if loop else None
    group, used, jumped = _groups(passes, LOST_AT * rated)
    whole, back = fit_line(passes.angle, passes.torque), fit_line(passes.torque, passes.angle)
    branch = fit_line(passes.torque[used], passes.angle[used], group[used])
    _refuse_backwards(branch)
    per_branch = inverse_estimate(branch, setup.confidence)
    found = Evaluation(
        slope_estimate(whole, setup.confidence),
        inverse_estimate(back, setup.confidence),
        per_branch,
        *(_one_branch(passes, used, group, way, setup.confidence) for way in (True, False)),
        correct(per_branch, branch.freedom, setup.parts, setup.confidence) if setup.parts else per_branch,
        seen,
        fit_pieces(*curve) if curve else NO_PIECES,
        rated,
        None if rate is None else rate * (passes.torque.size - 1),
        _bootstrap(passes, used, group, setup),
        (),
        passes.torque,
        passes.angle,
        _numbered(used, group),
        branch,
        whole,
        curve,
        crank,
    )
    return replace(found, findings=tuple(findings(setup, found, passes, loop, dropped, jumped)))


def evaluate_positions(readings, setup=None):
    """The `Evaluation`s of a test at one or more positions of the crank, in rising order of the angle."""
    if readings.crank is None:
        return (evaluate(readings, setup),)
    places = _places(readings.crank)
    found = []
    for place in sorted(set(places.tolist())):
        at = places == place
        rows = type(readings)(*(None if column is None else column[at] for column in readings))
        try:
            found.append(evaluate(rows, setup, place))
        except InputError as error:
            raise InputError(f"crank angle {np.degrees(place):g} deg: {error}") from None
    return tuple(found)


def _places(crank):
    """Each sample's position, angles within `SAME_PLACE` made one."""
    order = np.argsort(crank, kind="stable")
    first = np.concatenate([[True], np.diff(crank[order]) > SAME_PLACE])
    places = np.empty(crank.size)
    places[order] = crank[order][first][np.cumsum(first) - 1]
    return places


def _groups(passes, near_zero):
    """(number of the intercept of each sample, mask of the samples that count, whether the sides of zero torque were taken apart).

    A branch that jumps in angle at zero torque - the play of a drive without friction - is two straight parts.  Each then has its own
    intercept, and what lies within `near_zero` [N m] is left out.  Otherwise a whole pass is one straight part.
    """
    everything = np.ones(passes.torque.size, dtype=bool)
    if not _jumps(passes):
        return passes.number, everything, False
    used = np.abs(passes.torque) > near_zero
    sides = 2 * passes.number + (passes.torque > 0)
    enough = used & (np.bincount(sides[used], minlength=sides.max() + 1)[sides] >= 3)
    return (sides, enough, True) if np.sum(enough) >= 6 else (passes.number, everything, False)


def _jumps(passes):
    """Whether the angle steps forward at zero torque, surely and by an amount that matters, in passes that go through zero."""
    low, high = passes.torque.min(), passes.torque.max()
    if low > -0.2 * high or high < -0.2 * low:
        return False
    sides = np.sign(passes.torque)
    slope = fit_line(passes.torque, passes.angle, 2 * passes.number + (sides > 0))
    straightened = passes.angle - slope.slope * passes.torque
    step = fit_line(0.5 * sides, straightened, passes.number)
    return step.slope > JUMP_LARGE * np.ptp(passes.angle) and step.slope > JUMP_SURE * np.sqrt(step.variance)


def _numbered(used, group):
    """Number of each sample's intercept, -1 for samples that do not count."""
    numbers = np.full(group.size, -1)
    numbers[used] = np.unique(group[used], return_inverse=True)[1]
    return numbers


def _one_branch(passes, used, group, way, confidence):
    samples = used & passes.side(way)
    if np.unique(group[samples]).size + 2 > np.sum(samples):
        return None
    line = fit_line(passes.torque[samples], passes.angle[samples], group[samples])
    return inverse_estimate(line, confidence) if line.slope > 0 else None


def _refuse_backwards(branch):
    if branch.slope <= 0:
        raise InputError(
            f"torsion test: the angle falls by {-branch.slope:.3g} rad per N m of rising torque, so the stiffness would be "
            "negative; torque and angle count in opposite senses: turn the sign of one of the columns"
        )


def _bootstrap(passes, used, group, setup):
    """Name -> (low, high): intervals of the confidence by drawing whole cycles with replacement; {} with fewer than 3 cycles."""
    cycles = [np.flatnonzero(passes.block == block) for block in np.unique(passes.block)]
    if len(cycles) < FEWEST_CYCLES or setup.resamples < 1:
        return {}
    draws = np.random.default_rng(setup.seed).integers(len(cycles), size=(setup.resamples, len(cycles)))
    counts = np.array([np.bincount(draw, minlength=len(cycles)) for draw in draws])
    torque, angle = passes.torque, passes.angle
    sums = np.array([[c.size, *(np.sum(v[c]) for v in (torque, angle, torque * torque, angle * angle, torque * angle))] for c in cycles])
    n, t, a, tt, aa, ta = (counts @ sums).T
    inner = [_inner_sums(torque, angle, c[used[c]], group) for c in cycles]
    inner_tt, inner_ta = (counts @ np.array(inner)).T
    found = {
        "whole_loop": (n * ta - t * a) / (n * aa - a * a),
        "inverse": (n * tt - t * t) / (n * ta - t * a),
        "per_branch": inner_tt / inner_ta,
    }
    tails = [50 * (1 - setup.confidence), 50 * (1 + setup.confidence)]
    return {name: tuple(np.percentile(values, tails).tolist()) for name, values in found.items()}


def _inner_sums(torque, angle, samples, group):
    """(sum of torque^2, sum of torque angle) of some samples about the means of their groups."""
    _, number, count = np.unique(group[samples], return_inverse=True, return_counts=True)
    inside = torque[samples] - (np.bincount(number, torque[samples]) / count)[number]
    return inside @ inside, inside @ angle[samples]
