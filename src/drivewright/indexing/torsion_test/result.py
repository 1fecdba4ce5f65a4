"""Settings of the evaluation of a torsion test, and its result."""

from dataclasses import dataclass
from typing import NamedTuple

from drivewright._typing import Floats, Ints
from drivewright.indexing.torsion_test.regression import Estimate, RegressionLine
from drivewright.indexing.torsion_test.series import SeriesSpring
from drivewright.indexing.torsion_test.shape import Branch, LoopShape, PiecewiseStiffness


class TorsionTestSettings(NamedTuple):
    """How a test is to be evaluated: rated torque [N m] (None: the largest of the data), springs in series, confidence of the
    intervals, resampled tests and the seed of their draw."""

    rated_torque: float | None = None
    parts: tuple[SeriesSpring, ...] = ()
    confidence: float = 0.95
    resamples: int = 1000
    seed: int = 1


@dataclass(frozen=True)
class TorsionTestResult:
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
    shape: LoopShape
    pieces: PiecewiseStiffness
    rated_torque: float
    drift: float | None  # rad over the whole test
    bootstrap: dict[str, tuple[float, float]]
    findings: tuple[str, ...]
    torque: Floats
    angle: Floats
    group: Ints
    line: RegressionLine
    whole_line: RegressionLine
    mid_line: Branch | None
    crank: float | None = None
