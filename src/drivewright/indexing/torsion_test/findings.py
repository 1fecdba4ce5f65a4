"""Findings on a torsion test, for the reader of its numbers."""

from collections.abc import Iterator, Sequence

import numpy as np

from drivewright.indexing.torsion_test.passes import Passes
from drivewright.indexing.torsion_test.result import TorsionTestResult, TorsionTestSettings
from drivewright.indexing.torsion_test.series import DOUBTFUL_RATIO
from drivewright.indexing.torsion_test.shape import LOST_AT, HysteresisLoop

FEWEST_CYCLES = 3  # to resample
NOISE = 0.02  # of the work put in: so much energy may seem to come out of a loop without hysteresis
SAME_TORQUE = 0.05  # of the torque's range: two samples this close are at the same torque
GAP = 0.02  # of the angle's range, over the width of the loop: a larger gap between the ends of a loop is remarked


def findings(
    setup: TorsionTestSettings, test: TorsionTestResult, passes: Passes, loop: HysteresisLoop | None, dropped: Sequence[str], jumped: bool
) -> Iterator[str]:
    """Texts about an `TorsionTestResult`; `dropped` in words, `jumped` where the branches were taken apart at zero torque."""
    yield from _of_torque(setup, test)
    yield f"left out: {' and '.join(dropped)}" if dropped else "no cycle is left out as conditioning: the test has one loop only"
    if test.drift is None:
        yield "no drift was removed: without a repeated branch it cannot be separated from hysteresis; measure two cycles after the first"
    if loop is None:
        yield "the test has one branch only: lost motion, backlash and hysteresis are absent, and the whole loop is that branch"
    else:
        yield from _of_loop(test, passes, loop)
    if jumped:
        yield (
            f"the angle jumps at zero torque: the branches are split there, without the samples within "
            f"{LOST_AT * test.rated_torque:.4g} N·m, so that stiffness.per_branch is that of the drive in contact"
        )
    cycles = np.unique(passes.cycle).size
    if cycles < FEWEST_CYCLES:
        yield f"the bootstrap needs at least {FEWEST_CYCLES} cycles, and the test has {cycles}"
    yield from _of_series(setup, test)


def _of_torque(setup, test):
    reach = float(np.max(np.abs(test.torque)))
    if setup.rated_torque is None:
        yield f"no rated torque was given: the largest torque of the test, {reach:.6g} N·m, is used instead"
    elif np.isnan(test.shape.secant):
        yield (
            f"the secant from 50 to 100 % of the rated torque {test.rated_torque:.6g} N·m is absent: both branches must reach "
            f"that torque, and the test ends at {reach:.6g} N·m"
        )


def _of_loop(test, passes, loop):
    if test.shape.hysteresis_loss < -NOISE:
        yield (
            f"the loop runs in the wrong direction and would gain {-test.shape.hysteresis_energy:.3g} J in each cycle; check for drift of "
            "the angle, and for an angle that leads the torque in time"
        )
    if not loop.low < 0 < loop.high:
        yield f"both branches reach from {loop.low:.4g} to {loop.high:.4g} N·m, not beyond zero on both sides: lost motion is absent"
    if np.isnan(test.pieces.t1) and np.isfinite(test.pieces.k1):
        yield "the mid-line is straight: the three segments have one stiffness, and breakpoints are absent"
    begin, end, span = passes.torque[0], passes.torque[-1], np.ptp(passes.torque)
    gap, width = abs(passes.angle[-1] - passes.angle[0]), np.nan_to_num(abs(test.shape.backlash))
    if abs(end - begin) > SAME_TORQUE * span:
        yield f"the loop does not close: it begins at {begin:.4g} N·m and ends at {end:.4g} N·m; its area is that between the branches"
    elif gap > 1.25 * width + GAP * np.ptp(passes.angle) + 2 * abs(end - begin) / test.whole_loop.value:
        yield (
            f"the loop does not close: at the same torque the angle ends {gap:.3g} rad from where it began, by drift or slip, which "
            "one loop cannot separate"
        )


def _of_series(setup, test):
    ratio = test.corrected.value / test.per_branch.value
    if not setup.parts:
        yield "no stiffness of the loading bar or the support was given: stiffness.corrected is that of the branches as measured"
    elif ratio > DOUBTFUL_RATIO:
        yield (
            f"the corrected stiffness is {ratio:.3g} times the measured one: the rig causes most of the angle, and the errors of its "
            "stiffness enter in full; measure closer to the drive or stiffen the rig"
        )
