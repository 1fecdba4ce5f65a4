"""Problems that do not go into lanes, handed in among others: they are solved alone, with the same trajectory."""

from typing import NamedTuple

import numpy as np
import pytest

from drivewright import cases
from drivewright._jit import implements
from drivewright.numerics.ode import Functions, integrate, rate
from drivewright.numerics.ode.together import WORTHWHILE, together

pytestmark = pytest.mark.property


class Stepped(NamedTuple):
    """A spring that is stiffer on one side, by a branch."""

    stiffness: float


@implements(rate, Stepped)
def _(system, t, y, dy):
    dy[0] = y[1]
    if y[0] > 0.0:
        dy[1] = -2.0 * system.stiffness * y[0]
    else:
        dy[1] = -system.stiffness * y[0]


def by_functions(stiffness):
    """The same spring in ordinary Python functions."""
    return Functions(lambda t, y: [y[1], -(1.0 + (y[0] > 0.0)) * stiffness * y[0]])


@pytest.mark.parametrize("system", [Stepped, by_functions])
def test_systems_with_branches_go_alone(system):
    def task(stiffness):
        return integrate(system(stiffness), 0.0, 2.0, [0.3, 0.1], 1e-6).y

    with together(WORTHWHILE, 1) as threads:
        found = cases.run(task, [1.0, 2.0, 5.0], threads)
    for row, alone in zip(found.rows, cases.run(task, [1.0, 2.0, 5.0]).rows, strict=True):
        np.testing.assert_array_equal(row.value, alone.value)
