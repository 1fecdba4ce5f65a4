"""Torsion tests of a drive with its input locked: torque and angle of the output over loops of loading and unloading.

`read` a CSV file, `evaluate` one loop or `evaluate_positions` of the crank.  SI throughout: N m, rad, N m/rad, J.

The order of work: samples -> passes between the turning points of the torque -> conditioning dropped -> drift and zero removed ->
regressions with uncertainties that stand autocorrelated errors -> shape of the loop -> series correction.
"""

from drivewright.indexing.torsion_test.evaluation import Evaluation, Setup, evaluate, evaluate_positions
from drivewright.indexing.torsion_test.reading import Readings, read
from drivewright.indexing.torsion_test.regression import Estimate, Line, fit_line
from drivewright.indexing.torsion_test.series import Part, correct
from drivewright.indexing.torsion_test.shape import Pieces, Shape, fit_pieces

__all__ = [
    "Estimate",
    "Evaluation",
    "Line",
    "Part",
    "Pieces",
    "Readings",
    "Setup",
    "Shape",
    "correct",
    "evaluate",
    "evaluate_positions",
    "fit_line",
    "fit_pieces",
    "read",
]
