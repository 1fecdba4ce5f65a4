"""Kernels: everything that follows from the coordinates and rates of a state, also across singular positions.

Where loops fold, the dependent coordinates' Jacobian is singular and Newton's method has nothing to hold on to.  The motion itself goes
through: along each branch the dependent coordinates, their derivatives and their drift are smooth functions of the independent ones and
of time.  So at such a place they are interpolated, by Lagrange's polynomial, between nodes on both sides of the singular position, at
which the loops are closed exactly; what the rest of the program sees is the smooth branch.  `multibody.singular` makes the charts.
"""

import numpy as np

from drivewright._jit import inner, per_lane
from drivewright._typing import Bools, Floats
from drivewright.multibody.kinematics import (
    close_loops,
    regular_dependency_on_drive,
    update_body_velocities,
    update_body_velocity_products,
    update_driven_coordinates,
    update_poses,
    update_velocities,
    update_velocity_products,
)
from drivewright.multibody.system import BIAS, SCRATCH, System, Work

FOLD = 0.2  # part of a chart's reach about its middle


@inner
def update_kinematics(system: System, work: Work, t: float, y: Floats) -> bool:
    """Coordinates and rates of a state, dependent ones included, poses, velocities and drift; False where the loops cannot be closed.

    y (states,) as in `loads.apply_forces`.
    """
    if system.chart.offsets.size > 0:
        return update_interpolated(system, work, t, y)
    return update_regular(system, work, t, y)


@inner
def update_regular(system: System, work: Work, t: float, y: Floats) -> bool:
    """`update_kinematics` where the loops determine the dependent coordinates: half of every right-hand side.

    y (states,) as in `loads.apply_forces`.
    """
    closed = update_positions(system, work, t, y)
    update_velocities(system, work)
    update_velocity_products(system, work)
    return closed


@inner
def update_positions(system: System, work: Work, t: float, y: Floats) -> bool:
    """Coordinates of the state, loops closed, bodies placed; False where the loops cannot be closed.

    y (states,) as in `loads.apply_forces`.
    """
    assign_state(system, work, t, y)
    return close_loops(system, work)


@inner
def assign_state(system: System, work: Work, t: float, y: Floats) -> None:
    """Coordinates and independent rates of a state into `work`, drives set.

    y (states,) as in `loads.apply_forces`.
    """
    for k in range(system.stored.size):
        work.coordinates[system.stored[k]].q = y[k]
    for m in range(system.independent.size):
        work.coordinates[system.independent[m]].v = y[system.stored.size + m]
    update_driven_coordinates(system, work, t)


@inner
def chart_offset(system: System, t: float, y: Floats) -> float:
    """x: how far a state stands from the singular position of the chart.

    y (states,) as in `loads.apply_forces`.
    """
    chart = system.chart
    x, m = chart.normal_time * (t - chart.origin_time), 0
    for k in range(system.stored.size):
        if m < system.independent.size and system.stored[k] == system.independent[m]:  # both ascend
            x += chart.normal[m] * (y[k] - chart.origin[m])
            m += 1
    return x


@inner
def lagrange_weight(offsets: Floats, k: int, x: float) -> float:
    """Lagrange's polynomial of the node k at x.

    offsets (nodes,): places of the nodes on the chart.
    """
    product = 1.0
    for j in range(offsets.size):
        if j != k:
            product *= (x - offsets[j]) / (offsets[k] - offsets[j])
    return product


@per_lane
def update_interpolated(system: System, work: Work, t: float, y: Floats) -> bool:
    """`update_kinematics` between the nodes of the chart.

    y (states,) as in `loads.apply_forces`.
    """
    x, closed = chart_offset(system, t, y), True
    _clear(work.node_sums)
    for k in range(system.chart.offsets.size):
        shift = system.chart.offsets[k] - x
        _node(system, work, k, shift, y)
        closed &= update_regular(system, work, t + shift * system.chart.pace, work.node_state)
        _add(system, work, lagrange_weight(system.chart.offsets, k, x))
    _assign(system, work, t, y)
    return closed


@inner
def _clear(sums):
    """Zeros into `sums` (rows, columns)."""
    for r in range(sums.shape[0]):
        for column in range(sums.shape[1]):
            sums[r, column] = 0.0


@inner
def _node(system, work, k, shift, y):
    """The state of node k: independent coordinates shifted, dependent ones where Newton's method starts, the same rates.

    y (n,) as in `loads.apply_forces`.
    """
    chart, m, r = system.chart, 0, 0
    for s in range(system.stored.size):
        if m < system.independent.size and system.stored[s] == system.independent[m]:
            work.node_state[s] = y[s] + shift * chart.direction[m]
            m += 1
        else:
            work.node_state[s] = chart.guesses[k, r]
            r += 1
    for m in range(system.independent.size):
        work.node_state[system.stored.size + m] = y[system.stored.size + m]


@inner
def _add(system, work, part):
    """Add a part of what `work` holds of the dependent coordinates to the sums."""
    free = system.independent.size
    for r in range(system.rows.size):
        dependent = work.coordinates[system.dependent[r]]
        work.node_sums[r, 0] += part * dependent.q
        work.node_sums[r, 1] += part * dependent.v
        work.node_sums[r, 2] += part * work.row_columns[BIAS, r]
        for m in range(free):
            work.node_sums[r, 3 + m] += part * work.dependency_matrix[r, m]
    for d in range(system.driven.size):
        regular_dependency_on_drive(system, work, d)
        for r in range(system.rows.size):
            work.node_sums[r, 3 + free + d] += part * work.row_columns[SCRATCH, r]


@inner
def _assign(system, work, t, y):
    """The sums as what follows from the state, and the bodies accordingly. y (n,) as in `loads.apply_forces`."""
    assign_state(system, work, t, y)
    for r in range(system.rows.size):
        dependent = work.coordinates[system.dependent[r]]
        dependent.q, dependent.v = work.node_sums[r, 0], work.node_sums[r, 1]
        work.row_columns[BIAS, r] = work.node_sums[r, 2]
        for m in range(work.dependency_matrix.shape[1]):
            work.dependency_matrix[r, m] = work.node_sums[r, 3 + m]
    update_poses(system, work)
    update_body_velocities(system, work)
    update_body_velocity_products(system, work)


@inner
def dependency_on_drive(system: System, work: Work, d: int) -> None:
    """d(dependent)/d(driven coordinate d) at the state that `work` holds, in work.row_columns[COLUMN]."""
    if system.chart.offsets.size > 0:
        for r in range(system.rows.size):
            work.row_columns[SCRATCH, r] = work.dependency_matrix[r, system.independent.size + d]
    else:
        regular_dependency_on_drive(system, work, d)


@inner
def solve_kinematics(system: System, work: Work, t: float, y: Floats) -> bool:
    """`update_kinematics`, to be called from Python.

    y (states,) as in `loads.apply_forces`.
    """
    return update_kinematics(system, work, t, y)


@inner
def solve_kinematics_all(system: System, work: Work, t: Floats, y: Floats, q: Floats, v: Floats) -> None:
    """Coordinates and rates (m, coordinates) of states y (m, n) at the times t (m,).

    q, v (m, coordinates) [m, rad; per s].
    """
    for n in range(t.size):
        update_kinematics(system, work, t[n], y[n])
        for k in range(work.coordinates.size):
            q[n, k], v[n, k] = work.coordinates[k].q, work.coordinates[k].v


def outside_fold(system: System, t: Floats, y: Floats) -> Bools:
    """Which of the states y (m, n) at the times t (m,) are not in the middle of a chart, where forces in the joints are mere limits."""
    if len(system.chart.offsets) == 0:
        return np.full(len(t), True)
    return np.abs(chart_offsets(system, t, y)) > FOLD * system.chart.reach


def chart_offsets(system: System, t: Floats, y: Floats) -> Floats:
    """x (m,) of states y (m, n) at the times t (m,)."""
    chart = system.chart
    z = np.asarray(y)[:, np.searchsorted(system.stored, system.independent)]
    return (z - chart.origin) @ chart.normal + chart.normal_time * (np.asarray(t) - chart.origin_time)
