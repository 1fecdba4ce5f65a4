"""Torsion tests of a drive with its input locked: torque and angle of the output over loops of loading and unloading.

`read_test` a CSV file, `evaluate_loop` one loop or `evaluate_positions` of the crank.  SI throughout: N m, rad, N m/rad, J.

The order of work: samples -> passes between the turning points of the torque -> conditioning dropped -> drift and zero removed ->
regressions with uncertainties that stand autocorrelated errors -> shape of the loop -> series correction.

answers     values, tables and plots of a torsion test, for every kind that brings one
evaluation  one torsion test from its readings to stiffness, play and hysteresis, and a test at several positions of the crank
findings    what a reader of a torsion test's numbers has to know, in words
reading     a torsion test as a CSV file: `torque [N m],angle [arcmin]`, in the order of measuring
regression  a straight line through autocorrelated readings: slope, and how sure it is
result      settings of the evaluation of a torsion test, and its result
"""

from drivewright.indexing.torsion_test.evaluation import evaluate_loop, evaluate_positions
from drivewright.indexing.torsion_test.reading import Readings, read_test
from drivewright.indexing.torsion_test.regression import Estimate, RegressionLine, fit_line
from drivewright.indexing.torsion_test.result import TorsionTestResult, TorsionTestSettings
from drivewright.indexing.torsion_test.series import SeriesSpring, remove_series_springs
from drivewright.indexing.torsion_test.shape import LoopShape, PiecewiseStiffness, fit_pieces

__all__ = [
    "Estimate",
    "TorsionTestResult",
    "RegressionLine",
    "SeriesSpring",
    "PiecewiseStiffness",
    "Readings",
    "TorsionTestSettings",
    "LoopShape",
    "remove_series_springs",
    "evaluate_loop",
    "evaluate_positions",
    "fit_line",
    "fit_pieces",
    "read_test",
]
