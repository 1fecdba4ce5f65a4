"""The classical method of Runge and Kutta, order 4, with steps of one size: for real-time use, where the work per step is given.

It has no error estimate: the step h must be chosen for the fastest part, a contact or a stiff damper above all.  An undamped
oscillation of the angular frequency w stays bounded where w h < 2 sqrt(2), a decay exp(-r t) where r h < 2.785; a tenth of that is
accurate.  Longer steps let the solution grow until the run ends with the outcome "not_finite".  Four rates a step.
An event ends its step and the next one is whole again.  Between the ends of the steps the cubic through them and their slopes.

Kutta, Z. Math. Phys. 46 (1901); Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I, table 1.2 (recalled).
"""

from typing import NamedTuple

import numpy as np

from drivewright._jit import by_reference, implements, inner
from drivewright._typing import Floats
from drivewright.numerics.ode.dense_output import hermite
from drivewright.numerics.ode.method import ERROR, STEP, TIME, Method, Tableau, begin, carry_over, interpolate, restart, step
from drivewright.numerics.ode.system import copy_where, rate, rate_at

_C = np.array([0, 1 / 2, 1 / 2, 1])
_A = np.array([[0, 0, 0, 0], [1 / 2, 0, 0, 0], [0, 1 / 2, 0, 0], [0, 0, 1, 0]])
_B = np.array([1 / 6, 1 / 3, 1 / 3, 1 / 6])


@by_reference
class RungeKutta4(NamedTuple):
    """Workspace: rates at the stages and, last, at the end of the step."""

    k: Floats  # (5, n)


def _workspace(n):
    return RungeKutta4(np.zeros((5, n)))


METHOD = Method(
    name="rk4",
    order=4,
    dense_order=3,
    tableau=Tableau(_A, _B, _C),
    citation="Kutta, Z. Math. Phys. 46 (1901)",
    workspace=_workspace,
    adaptive=False,
)


@implements(begin, RungeKutta4)
def _(work, system, control, clock, y):
    rate_at(system, clock[TIME], y, work.k[0])
    _equal_step(work.k[0], control, clock)


@implements(restart, RungeKutta4)
def _(work, system, control, clock, y):
    rate_at(system, clock[TIME], y, work.k[0])
    _equal_step(work.k[0], control, clock)


@inner
def _equal_step(f, control, clock):
    """The one size of all steps into the clock, 0 where the rate f (n,) is not finite, which ends the run."""
    clock[STEP] = control.max_step
    for i in range(f.size):
        if not np.isfinite(f[i]):
            clock[STEP], clock[ERROR] = 0.0, np.nan


@implements(step, RungeKutta4)
def _(work, system, control, clock, t, h, again, y, trial):
    for stage in range(1, 4):
        for i in range(y.size):
            trial[i] = y[i] + _C[stage] * h * work.k[stage - 1, i]  # the only entry in the row of the tableau
        rate(system, t + _C[stage] * h, trial, work.k[stage])
    for i in range(y.size):
        trial[i] = y[i]
        for stage in range(4):
            trial[i] += h * _B[stage] * work.k[stage, i]
    rate_at(system, t + h, trial, work.k[4])
    _equal_step(work.k[4], control, clock)
    return clock[STEP] > 0.0


@implements(interpolate, RungeKutta4)
def _(work, h, y, trial, dense):
    hermite(h, y, trial, work.k[0], work.k[4], dense)


@implements(carry_over, RungeKutta4)
def _(work, system, t, y, is_good):
    copy_where(is_good, work.k[4], work.k[0])
