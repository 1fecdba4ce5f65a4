"""The method of Dormand and Prince, order 5(4): explicit, seven stages of which the last is the first of the next step.

Dormand & Prince, J. Comp. Appl. Math. 6 (1980); interpolant of order 4 and step control: Hairer, Norsett & Wanner, Solving
Ordinary Differential Equations I (code DOPRI5).  Both recalled; the tests check every order condition.
"""

from typing import NamedTuple

import numpy as np

from drivewright._jit import by_reference, implements, inner, per_lane
from drivewright._typing import Floats
from drivewright.numerics.lanes import where
from drivewright.numerics.ode.method import ERROR, STEP, TIME, Method, Tableau, begin, carry_over, first_step, interpolate, restart, step
from drivewright.numerics.ode.system import copy, copy_where, rate, rate_at

_C = np.array([0, 1 / 5, 3 / 10, 4 / 5, 8 / 9, 1, 1])
_A = np.array(
    [
        [0, 0, 0, 0, 0, 0],
        [1 / 5, 0, 0, 0, 0, 0],
        [3 / 40, 9 / 40, 0, 0, 0, 0],
        [44 / 45, -56 / 15, 32 / 9, 0, 0, 0],
        [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729, 0, 0],
        [9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656, 0],
        [35 / 384, 0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84],  # also the result: the last stage is the first of the next step
    ]
)
_ERROR = np.array([71 / 57600, 0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40])  # order 5 minus order 4
_DENSE = np.array(
    [
        -12715105075 / 11282082432,
        0,
        87487479700 / 32700410799,
        -10690763975 / 1880347072,
        701980252875 / 199316789632,
        -1453857185 / 822651844,
        69997945 / 29380423,
    ]
)


@by_reference
class DormandPrince(NamedTuple):
    """Workspace: rates at the stages, the first at the start of the step."""

    k: Floats  # (7, n)


def _workspace(n):
    return DormandPrince(np.empty((7, n)))


METHOD = Method(
    name="dopri5",
    order=5,
    dense_order=4,
    tableau=Tableau(np.hstack([_A, np.zeros((7, 1))]), np.append(_A[6], 0.0), _C),
    citation="Dormand & Prince, J. Comp. Appl. Math. 6 (1980)",
    workspace=_workspace,
)


@implements(begin, DormandPrince)
def _(work, system, control, clock, y):
    rate_at(system, clock[TIME], y, work.k[0])
    first_step(work.k[0], control, clock, y)


@implements(restart, DormandPrince)
def _(work, system, control, clock, y):
    rate_at(system, clock[TIME], y, work.k[0])


@implements(step, DormandPrince)
def _(work, system, control, clock, t, h, again, y, trial):
    _stages(system, t, h, y, work.k, trial)
    error = _error(h, y, trial, work.k, control)
    clock[STEP] = h * _growth(error, clock, where(again, 1.0, 5.0))
    return error <= 1.0  # nan is no success either


@implements(interpolate, DormandPrince)
def _(work, h, y, trial, dense):
    _interpolant(h, y, trial, work.k, dense)


@implements(carry_over, DormandPrince)
def _(work, system, t, y, is_good):
    copy_where(is_good, work.k[6], work.k[0])


@inner
def _stages(system, t, h, y, k, trial):
    """Rates k[1..6] of the step from (t, y), k[0] being known, and its result in `trial`."""
    for stage in range(1, 7):
        copy(y, trial)
        for j in range(stage):
            weight = h * _A[stage, j]
            for i in range(y.size):
                trial[i] += weight * k[j, i]
        rate(system, t + _C[stage] * h, trial, k[stage])


@inner
def _error(h, y, trial, k, control):
    """Root mean square of the estimated error over its tolerance. y, trial (n,); k (7, n): the stages' rates."""
    total = 0.0
    for i in range(y.size):
        error = 0.0
        for j in range(7):
            error += _ERROR[j] * k[j, i]
        total += (h * error / (control.atol[i] + control.rtol * max(abs(y[i]), abs(trial[i])))) ** 2
    return np.sqrt(total / y.size)


@per_lane
def _growth(error, clock, limit):
    """Factor on the step: proportional-integral control, which settles where pure error control would hunt."""
    if not np.isfinite(error):
        clock[ERROR] = np.nan
        return 0.1
    previous = clock[ERROR] if np.isfinite(clock[ERROR]) else 1e-4
    if error > 1.0:
        clock[ERROR] = previous
        return max(0.2, 0.9 * error**-0.17)
    clock[ERROR] = max(error, 1e-4)
    return min(limit, max(0.2, 0.9 * max(error, 1e-8) ** -0.17 * previous**0.04))


@inner
def _interpolant(h, y, trial, k, dense):
    """Coefficients of the polynomial through both ends of the step, with their slopes, and of order 4 between.

    y, trial (n,); k (7, n); dense (5, n), written.
    """
    for i in range(y.size):
        quartic = 0.0
        for j in range(7):
            quartic += _DENSE[j] * k[j, i]
        rise = trial[i] - y[i]
        dense[0, i] = y[i]
        dense[1, i] = rise
        dense[2, i] = h * k[0, i] - rise
        dense[3, i] = rise - h * k[6, i] - dense[2, i]
        dense[4, i] = h * quartic
