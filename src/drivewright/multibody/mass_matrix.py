"""Kernels: mass matrix and accelerations in the independent coordinates, without friction of the joints."""

from drivewright._jit import inner
from drivewright.multibody.system import BIAS, System, Work
from drivewright.numerics.lanes import all_lanes
from drivewright.numerics.small import ldl_factor, ldl_substitute


@inner
def update_mass_matrix(system: System, work: Work) -> None:
    """Partial velocities R = d(body)/d(independent) of the bodies, and the factors of the mass matrix  sum R^T M R."""
    free = system.independent.size
    for m in range(free):
        for n in range(m + 1):
            work.mass[m, n] = 0.0
    for i in range(1, system.bodies.size):
        body = system.bodies[i]
        if body.driven:  # its partials stay zero
            continue
        reduce_partial_velocities(system, work, i)
        if all_lanes((body.mass == 0.0) & (body.inertia == 0.0)):
            continue
        for m in range(free):
            one = work.reduced_partial_velocities[i, m]
            for n in range(m + 1):
                two = work.reduced_partial_velocities[i, n]
                work.mass[m, n] += body.mass * (one.x * two.x + one.y * two.y) + body.inertia * one.t * two.t
    ldl_factor(work.mass)


@inner
def solve_accelerations(system: System, work: Work) -> None:
    """Solve  sum R^T M R a = sum R^T (F - M b)  for the independent accelerations (in work.force), after `update_mass_matrix`."""
    free = system.independent.size
    for m in range(free):
        work.force[m] = 0.0
    for i in range(1, system.bodies.size):
        body, forces = system.bodies[i], work.poses[i]
        fx, fy, ft = forces.fx, forces.fy, forces.ft
        massless = all_lanes((body.mass == 0.0) & (body.inertia == 0.0))
        if body.driven or (massless and all_lanes((fx == 0.0) & (fy == 0.0) & (ft == 0.0))):
            continue
        if not massless:
            bx, by, bt = bias_acceleration(system, work, i)
            fx += body.mass * (system.gravity_x - bx)
            fy += body.mass * (system.gravity_y - by)
            ft -= body.inertia * bt
        for m in range(free):
            partial = work.reduced_partial_velocities[i, m]
            work.force[m] += partial.x * fx + partial.y * fy + partial.t * ft
    ldl_substitute(work.mass, work.force)


@inner
def reduce_partial_velocities(system: System, work: Work, i: int) -> None:
    """Partial velocities of body i by the independent coordinates, the dependent ones following."""
    for m in range(system.independent.size):
        partial = work.partial_velocities[i, system.independent[m]]
        x, y, t = partial.x, partial.y, partial.t
        for r in range(system.rows.size):
            dependent = work.partial_velocities[i, system.dependent[r]]
            x += dependent.x * work.dependency_matrix[r, m]
            y += dependent.y * work.dependency_matrix[r, m]
            t += dependent.t * work.dependency_matrix[r, m]
        reduced = work.reduced_partial_velocities[i, m]
        reduced.x, reduced.y, reduced.t = x, y, t


@inner
def bias_acceleration(system: System, work: Work, i: int) -> tuple[float, float, float]:
    """Acceleration of body i with the independent accelerations zero."""
    bx, by, bt = work.poses[i].bias_x, work.poses[i].bias_y, 0.0
    for d in range(system.driven.size):
        k = system.driven[d].coordinate
        partial, a = work.partial_velocities[i, k], work.coordinates[k].a
        bx, by, bt = bx + partial.x * a, by + partial.y * a, bt + partial.t * a
    for r in range(system.rows.size):
        partial, a = work.partial_velocities[i, system.dependent[r]], work.row_columns[BIAS, r]
        bx, by, bt = bx + partial.x * a, by + partial.y * a, bt + partial.t * a
    return bx, by, bt
