"""One torsion test from its readings to stiffness, play and hysteresis, and a test at several positions of the crank."""

from dataclasses import replace

import numpy as np

from drivewright._typing import Bools, Ints
from drivewright.errors import InputError
from drivewright.indexing.torsion_test.findings import FEWEST_CYCLES, findings
from drivewright.indexing.torsion_test.passes import WHOLE_PASS, Passes, drop_conditioning, estimate_drift, remove_drift, split_passes
from drivewright.indexing.torsion_test.reading import Readings
from drivewright.indexing.torsion_test.regression import Estimate, fit_line, inverse_estimate, slope_estimate
from drivewright.indexing.torsion_test.result import TorsionTestResult, TorsionTestSettings
from drivewright.indexing.torsion_test.series import remove_series_springs
from drivewright.indexing.torsion_test.shape import (
    LOST_AT,
    LoopShape,
    PiecewiseStiffness,
    average_loop,
    fit_pieces,
    fold_mid_line,
    measure_shape,
)

SAME_PLACE = 1e-3  # rad: crank angles this close are one position
JUMP_SURE = 4.0  # standard uncertainties of the jump of the angle at zero torque, from which the sides of a branch are taken apart ...
JUMP_LARGE = 0.02  # ... where it is also this part of the angle's range
NO_SHAPE = LoopShape(*[np.nan] * 6)
NO_PIECES = PiecewiseStiffness(*[np.nan] * 6)


def evaluate_loop(readings: Readings, setup: TorsionTestSettings | None = None, crank: float | None = None) -> TorsionTestResult:
    """The `TorsionTestResult` of the readings of one position; InputError where they hold no stiffness."""
    setup = TorsionTestSettings() if setup is None else setup
    passes, dropped = drop_conditioning(split_passes(readings))
    rate = estimate_drift(passes)
    passes = passes if rate is None else remove_drift(passes, rate)
    rated = float(np.max(np.abs(passes.torque))) if setup.rated_torque is None else float(setup.rated_torque)
    loop = average_loop(passes, WHOLE_PASS)
    seen = measure_shape(loop, rated) if loop else NO_SHAPE
    passes = passes._replace(angle=passes.angle - (seen.zero if np.isfinite(seen.zero) else passes.angle.mean()))
    curve = fold_mid_line(loop) if loop else None
    group, used, jumped = _groups(passes, LOST_AT * rated)
    whole, back = fit_line(passes.angle, passes.torque), fit_line(passes.torque, passes.angle)
    branch = fit_line(passes.torque[used], passes.angle[used], group[used])
    _refuse_backwards(branch)
    per_branch = inverse_estimate(branch, setup.confidence)
    found = TorsionTestResult(
        slope_estimate(whole, setup.confidence),
        inverse_estimate(back, setup.confidence),
        per_branch,
        _one_branch(passes, used, group, True, setup.confidence),
        _one_branch(passes, used, group, False, setup.confidence),
        remove_series_springs(per_branch, branch.freedom, setup.parts, setup.confidence) if setup.parts else per_branch,
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


def evaluate_positions(readings: Readings, setup: TorsionTestSettings | None = None) -> tuple[TorsionTestResult, ...]:
    """The `TorsionTestResult`s of a test at one or more positions of the crank, in rising order of the angle."""
    if readings.crank is None:
        return (evaluate_loop(readings, setup),)
    places = _places(readings.crank)
    found = []
    for place in sorted(set(places.tolist())):
        at = places == place
        rows = readings.select(at)
        try:
            found.append(evaluate_loop(rows, setup, place))
        except InputError as error:
            raise InputError(f"crank angle {np.degrees(place):g}°: {error}") from None
    return tuple(found)


def _places(crank):
    """Each sample's position, angles within `SAME_PLACE` made one."""
    order = np.argsort(crank, kind="stable")
    first = np.concatenate([[True], np.diff(crank[order]) > SAME_PLACE])
    places = np.empty(crank.size)
    places[order] = crank[order][first][np.cumsum(first) - 1]
    return places


def _groups(passes: Passes, near_zero: float) -> tuple[Ints, Bools, bool]:
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


def _one_branch(passes: Passes, used: Bools, group: Ints, way: bool, confidence: float) -> Estimate | None:
    samples = used & passes.side(way)
    if np.unique(group[samples]).size + 2 > np.sum(samples):
        return None
    line = fit_line(passes.torque[samples], passes.angle[samples], group[samples])
    return inverse_estimate(line, confidence) if line.slope > 0 else None


def _refuse_backwards(branch):
    if branch.slope <= 0:
        raise InputError(
            f"torsion test: the angle falls by {-branch.slope:.3g} rad per N·m of rising torque, so the stiffness would be "
            "negative; torque and angle have opposite signs; change the sign of one of the columns"
        )


def _bootstrap(passes: Passes, used: Bools, group: Ints, setup: TorsionTestSettings) -> dict[str, tuple[float, float]]:
    """Name -> (low, high): intervals of the confidence by drawing whole cycles with replacement; {} with fewer than 3 cycles."""
    cycles = [np.flatnonzero(passes.cycle == each) for each in np.unique(passes.cycle)]
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
