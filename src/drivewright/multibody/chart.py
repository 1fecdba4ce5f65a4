"""Kernels: everything that follows from the coordinates and rates of a state, also across singular positions.

Where loops fold, the dependent coordinates' Jacobian is singular and Newton's method has nothing to hold on to.  The motion itself goes
through: along each branch the dependent coordinates, their derivatives and their drift are smooth functions of the independent ones and
of time.  So at such a place they are interpolated, by Lagrange's polynomial, between nodes on both sides of the singular position, at
which the loops are closed exactly; what the rest of the program sees is the smooth branch.  `multibody.singular` makes the charts.
"""

import numpy as np

from drivewright._jit import inner, outer
from drivewright.multibody.kinematics import bend, body_bends, body_velocities, close, drive, led, move, place
from drivewright.multibody.system import COLUMN, DRIFT

FOLD = 0.2  # part of a chart's reach about its middle


@inner
def configure(system, work, t, y):
    """Coordinates and rates of a state, dependent ones included, poses, velocities and drift; False where the loops cannot be closed."""
    if system.chart.offsets.size > 0:
        return interpolated(system, work, t, y)
    return regular(system, work, t, y)


@outer
def regular(system, work, t, y):
    """`configure` where the loops determine the dependent coordinates; called, not inlined: it is half of every right-hand side."""
    closed = pose(system, work, t, y)
    move(system, work)
    bend(system, work)
    return closed


@outer
def pose(system, work, t, y):
    """Coordinates of the state, loops closed, bodies placed; False where the loops cannot be closed."""
    take(system, work, t, y)
    return close(system, work)


@inner
def take(system, work, t, y):
    """Coordinates and independent rates of a state into `work`, drives set."""
    for k in range(system.stored.size):
        work.coordinates[system.stored[k]].q = y[k]
    for m in range(system.independent.size):
        work.coordinates[system.independent[m]].v = y[system.stored.size + m]
    drive(system, work, t)


@inner
def offset_of(system, t, y):
    """x: how far a state stands from the singular position of the chart."""
    chart = system.chart
    x, m = chart.normal_time * (t - chart.origin_time), 0
    for k in range(system.stored.size):
        if m < system.independent.size and system.stored[k] == system.independent[m]:  # both ascend
            x += chart.normal[m] * (y[k] - chart.origin[m])
            m += 1
    return x


@inner
def weight(offsets, k, x):
    """Lagrange's polynomial of the node k at x."""
    product = 1.0
    for j in range(offsets.size):
        if j != k:
            product *= (x - offsets[j]) / (offsets[k] - offsets[j])
    return product


@outer
def interpolated(system, work, t, y):
    """`configure` between the nodes of the chart."""
    x, closed = offset_of(system, t, y), True
    work.sums[:] = 0.0
    for k in range(system.chart.offsets.size):
        shift = system.chart.offsets[k] - x
        _node(system, work, k, shift, y)
        closed &= regular(system, work, t + shift * system.chart.pace, work.node)
        _add(system, work, weight(system.chart.offsets, k, x))
    _assign(system, work, t, y)
    return closed


@inner
def _node(system, work, k, shift, y):
    """The state of node k: independent coordinates shifted, dependent ones where Newton's method starts, the same rates."""
    chart, m, r = system.chart, 0, 0
    for s in range(system.stored.size):
        if m < system.independent.size and system.stored[s] == system.independent[m]:
            work.node[s] = y[s] + shift * chart.direction[m]
            m += 1
        else:
            work.node[s] = chart.guesses[k, r]
            r += 1
    for m in range(system.independent.size):
        work.node[system.stored.size + m] = y[system.stored.size + m]


@inner
def _add(system, work, part):
    """Add a part of what `work` holds of the dependent coordinates to the sums."""
    free = system.independent.size
    for r in range(system.rows.size):
        dependent = work.coordinates[system.dependent[r]]
        work.sums[r, 0] += part * dependent.q
        work.sums[r, 1] += part * dependent.v
        work.sums[r, 2] += part * work.columns[DRIFT, r]
        for m in range(free):
            work.sums[r, 3 + m] += part * work.follow[r, m]
    for d in range(system.driven.size):
        led(system, work, d)
        for r in range(system.rows.size):
            work.sums[r, 3 + free + d] += part * work.columns[COLUMN, r]


@inner
def _assign(system, work, t, y):
    """The sums as what follows from the state, and the bodies accordingly."""
    take(system, work, t, y)
    for r in range(system.rows.size):
        dependent = work.coordinates[system.dependent[r]]
        dependent.q, dependent.v = work.sums[r, 0], work.sums[r, 1]
        work.columns[DRIFT, r] = work.sums[r, 2]
        for m in range(work.follow.shape[1]):
            work.follow[r, m] = work.sums[r, 3 + m]
    place(system, work)
    body_velocities(system, work)
    body_bends(system, work)


@inner
def lead(system, work, d):
    """d(dependent)/d(driven coordinate d) at the state that `work` holds, in work.columns[COLUMN]."""
    if system.chart.offsets.size > 0:
        for r in range(system.rows.size):
            work.columns[COLUMN, r] = work.follow[r, system.independent.size + d]
    else:
        led(system, work, d)


@outer
def configure_at(system, work, t, y):
    """`configure`, to be called from Python."""
    return configure(system, work, t, y)


@outer
def configure_all(system, work, t, y, q, v):
    """Coordinates and rates (m, coordinates) of states y (m, n) at the times t (m,)."""
    for n in range(t.size):
        configure(system, work, t[n], y[n])
        for k in range(work.coordinates.size):
            q[n, k], v[n, k] = work.coordinates[k].q, work.coordinates[k].v


def clear_of_fold(system, t, y):
    """Which of the states y (m, n) at the times t (m,) are not in the middle of a chart, where forces in the joints are mere limits."""
    if len(system.chart.offsets) == 0:
        return np.full(len(t), True)
    return np.abs(offsets_of(system, t, y)) > FOLD * system.chart.reach


def offsets_of(system, t, y):
    """x (m,) of states y (m, n) at the times t (m,)."""
    chart = system.chart
    z = np.asarray(y)[:, np.searchsorted(system.stored, system.independent)]
    return (z - chart.origin) @ chart.normal + chart.normal_time * (np.asarray(t) - chart.origin_time)
