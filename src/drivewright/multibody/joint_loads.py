"""Kernels: what chosen joints transmit at a known state, from the balance of every body.

What every body needs beside its loads, M a - F - M g, comes from its joints.  The multipliers of the rows that close loops are those with
which the dependent coordinates are in balance; a joint of the tree then carries what all bodies beyond it need.
"""

from drivewright._jit import inner
from drivewright._typing import Floats
from drivewright.multibody.forces.joint_friction import FrictionWork
from drivewright.multibody.frames import rotated
from drivewright.multibody.joints.rows import terms_of_row
from drivewright.multibody.mass_matrix import bias_acceleration
from drivewright.multibody.records import OneRecord
from drivewright.multibody.system import SCRATCH, System, Work
from drivewright.numerics.small import lu_solve_transposed

MULTIPLIER = 6  # place of a row's multiplier behind its gradient


@inner
def update_row_gradients(system: System, work: Work, rows: Floats) -> None:
    """(ux, uy, gi, gj, gk, gl) of every row, torques about its points, into rows (rows, 7)."""
    for r in range(system.rows.size):
        row = system.rows[r]
        first, second = work.poses[row.i], work.poses[row.j]
        pix, piy = rotated(first, row.ax, row.ay)
        pjx, pjy = rotated(second, row.bx, row.by)
        dx, dy = first.x + pix - second.x - pjx, first.y + piy - second.y - pjy
        _, rows[r, 0], rows[r, 1], rows[r, 2], rows[r, 3], rows[r, 4], rows[r, 5] = terms_of_row(system, work, row, dx, dy)


@inner
def needs_at(system: System, work: Work, accelerations: Floats, needs: Floats) -> None:
    """M a - F - M g of every body (bodies, 3), at independent accelerations (independent,), without friction."""
    for i in range(1, system.bodies.size):
        body, here = system.bodies[i], work.poses[i]
        ax, ay, alpha = bias_acceleration(system, work, i)
        for m in range(accelerations.size):
            partial = work.reduced_partial_velocities[i, m]
            ax, ay, alpha = ax + partial.x * accelerations[m], ay + partial.y * accelerations[m], alpha + partial.t * accelerations[m]
        needs[i, 0] = body.mass * (ax - system.gravity_x) - here.fx
        needs[i, 1] = body.mass * (ay - system.gravity_y) - here.fy
        needs[i, 2] = body.inertia * alpha - here.ft


@inner
def needs_of_unit(system: System, work: Work, friction: OneRecord, unit: Floats, accelerations: Floats, needs: Floats) -> None:
    """The same of a unit force of a joint's friction, unit (4,), alone, with the accelerations (independent,) that it gives."""
    for i in range(1, system.bodies.size):
        body, ax, ay, alpha = system.bodies[i], 0.0, 0.0, 0.0
        for m in range(accelerations.size):
            partial = work.reduced_partial_velocities[i, m]
            ax, ay, alpha = ax + partial.x * accelerations[m], ay + partial.y * accelerations[m], alpha + partial.t * accelerations[m]
        needs[i, 0], needs[i, 1], needs[i, 2] = body.mass * ax, body.mass * ay, body.inertia * alpha
    needs[friction.i, 0] -= unit[0]
    needs[friction.i, 1] -= unit[1]
    needs[friction.i, 2] -= unit[2]
    needs[friction.j, 0] += unit[0]
    needs[friction.j, 1] += unit[1]
    needs[friction.j, 2] -= unit[3]


@inner
def joints_carry(system: System, work: Work, needs: Floats, rows: Floats) -> None:
    """Multipliers of the rows into rows (rows, 7), and what the joint of every body gives it into needs (bodies, 3), which go in as what
    every body needs."""
    _multipliers(system, work, needs, rows)
    for r in range(system.rows.size):
        _give(system, work, system.rows[r], rows[r], needs)
    for back in range(system.bodies.size - 1):
        i = system.bodies.size - 1 - back  # parents come first
        here, parent = work.poses[i], system.bodies[i].parent
        base = work.poses[parent]
        needs[parent, 0] += needs[i, 0]
        needs[parent, 1] += needs[i, 1]
        needs[parent, 2] += needs[i, 2] + (here.x - base.x) * needs[i, 1] - (here.y - base.y) * needs[i, 0]


@inner
def _multipliers(system, work, needs, rows):
    """J^T lambda = sum P^T needs over the dependent coordinates.  needs (bodies, 3), rows (rows, 7)."""
    if system.rows.size == 0:
        return
    column = work.row_columns[SCRATCH]
    for r in range(system.rows.size):
        k, total = system.dependent[r], 0.0
        for i in range(1, system.bodies.size):
            partial = work.partial_velocities[i, k]
            total += partial.x * needs[i, 0] + partial.y * needs[i, 1] + partial.t * needs[i, 2]
        column[r] = total
    lu_solve_transposed(work.lu, work.pivots, column)
    for r in range(system.rows.size):
        rows[r, MULTIPLIER] = column[r]


@inner
def _give(system, work, row, gradient, needs):
    """Take what a row gives its bodies from their needs (bodies, 3).  gradient (7,)."""
    size = gradient[MULTIPLIER]
    fx, fy = size * gradient[0], size * gradient[1]
    pix, piy = rotated(work.poses[row.i], row.ax, row.ay)
    pjx, pjy = rotated(work.poses[row.j], row.bx, row.by)
    needs[row.i, 0] -= fx
    needs[row.i, 1] -= fy
    needs[row.i, 2] -= size * gradient[2] + pix * fy - piy * fx
    needs[row.j, 0] += fx
    needs[row.j, 1] += fy
    needs[row.j, 2] -= size * gradient[3] - pjx * fy + pjy * fx
    needs[row.k, 2] -= size * gradient[4]
    needs[row.l, 2] -= size * gradient[5]


@inner
def wrench_of_joint(system: System, work: Work, friction: OneRecord, scratch: FrictionWork) -> tuple[float, float, float]:
    """(force x, y [N], moment about the joint's point on the first body [N m]) of a joint on its first body."""
    one = work.poses[friction.i]
    px, py = rotated(one, friction.ax, friction.ay)
    if friction.child >= 0:
        here, needs = work.poses[friction.child], scratch.wrenches[friction.child]
        x, y = here.x - one.x - px, here.y - one.y - py
        sign = 1.0 if friction.child == friction.i else -1.0
        return sign * needs[0], sign * needs[1], sign * (needs[2] + x * needs[1] - y * needs[0])
    fx = fy = moment = 0.0
    for r in range(system.rows.size):
        if system.rows[r].joint == friction.joint:
            size = scratch.rows[r, MULTIPLIER]
            fx += size * scratch.rows[r, 0]
            fy += size * scratch.rows[r, 1]
            moment += size * scratch.rows[r, 2]
    return fx, fy, moment
