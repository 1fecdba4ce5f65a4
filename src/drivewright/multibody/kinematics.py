"""Kernels: where the bodies are, how fast they move, and how the dependent coordinates follow the independent ones."""

from drivewright._jit import inner
from drivewright.multibody.curves import curve_at
from drivewright.multibody.frames import rotated
from drivewright.multibody.joints.rows import terms_of_row, velocity_product_of_row
from drivewright.multibody.records import OneRecord
from drivewright.multibody.system import BIAS, RESIDUAL, SCRATCH, System, Work
from drivewright.numerics.lanes import all_lanes, any_lane, opposite, where
from drivewright.numerics.small import lu_factor, lu_solve
from drivewright.numerics.trigonometry import cos_sin

CLOSED = 1e-7  # Newton's correction [rad], [lengths of the mechanism] below which one more evaluation is exact to rounding
TRIES = 12


@inner
def update_driven_coordinates(system: System, work: Work, t: float) -> None:
    """Coordinates that are given functions of time, with their rates and accelerations."""
    for d in range(system.driven.size):
        driven = system.driven[d]
        value, slope, second = curve_at(system.curves, system.pieces, driven.curve, t)
        coordinate = work.coordinates[driven.coordinate]
        coordinate.q = driven.sign * (driven.start + value)
        coordinate.v = driven.sign * slope
        coordinate.a = driven.sign * second


@inner
def update_poses(system: System, work: Work) -> None:
    """Pose of every body, and its partials, from the coordinates."""
    for i in range(1, system.bodies.size):
        body, here, base = system.bodies[i], work.poses[i], work.poses[system.bodies[i].parent]
        angle = body.inherits * base.angle + body.offset
        if body.turn >= 0:
            angle += work.coordinates[body.turn].q
        if any_lane(angle != here.angle):  # Newton's corrections leave most angles as they are
            here.angle = angle
            here.c, here.s = cos_sin(angle)
        if body.free >= 0:
            here.x, here.y = work.coordinates[body.free].q, work.coordinates[body.free + 1].q
            work.partial_velocities[i, body.free].x = work.partial_velocities[i, body.free + 1].y = 1.0
            continue
        slide = work.coordinates[body.slide].q if body.slide >= 0 else 0.0
        ax, ay = rotated(base, body.ax + slide * body.ex, body.ay + slide * body.ey)
        bx, by = rotated(here, body.bx + slide * body.fx, body.by + slide * body.fy)
        here.x, here.y = base.x + ax - bx, base.y + ay - by
        for k in range(work.coordinates.size):
            partial, parent = work.partial_velocities[i, k], work.partial_velocities[body.parent, k]
            partial.x = parent.x - ay * parent.t + by * partial.t
            partial.y = parent.y + ax * parent.t - bx * partial.t
        if body.slide >= 0:
            ex, ey = rotated(base, body.ex, body.ey)
            fx, fy = rotated(here, body.fx, body.fy)
            work.partial_velocities[i, body.slide].x += ex - fx
            work.partial_velocities[i, body.slide].y += ey - fy


@inner
def update_constraint_rows(system: System, work: Work) -> None:
    """Residual of every constraint row and its Jacobian."""
    for r in range(system.rows.size):
        row = system.rows[r]
        first, second = work.poses[row.i], work.poses[row.j]
        pix, piy = rotated(first, row.ax, row.ay)
        pjx, pjy = rotated(second, row.bx, row.by)
        dx, dy = first.x + pix - second.x - pjx, first.y + piy - second.y - pjy
        miss, ux, uy, gi, gj, gk, gl = terms_of_row(system, work, row, dx, dy)
        work.row_columns[RESIDUAL, r] = miss
        gi += ux * -piy + uy * pix
        gj -= ux * -pjy + uy * pjx
        for k in range(work.coordinates.size):
            one, two = work.partial_velocities[row.i, k], work.partial_velocities[row.j, k]
            work.constraint_jacobian[r, k] = (
                ux * (one.x - two.x)
                + uy * (one.y - two.y)
                + gi * one.t
                + gj * two.t
                + gk * work.partial_velocities[row.k, k].t
                + gl * work.partial_velocities[row.l, k].t
            )


@inner
def close_loops(system: System, work: Work) -> bool:
    """Move the dependent coordinates, by Newton's method, until every loop is closed; False where they cannot be."""
    if system.rows.size == 0:
        update_poses(system, work)
        return True
    return iterate_on_loops(system, work)


@inner
def iterate_on_loops(system: System, work: Work) -> bool:
    """`close_loops` where there are loops."""
    settled = closed = system.length < 0.0  # nowhere yet
    regular = system.length > 0.0
    for _ in range(TRIES):
        update_poses(system, work)
        update_constraint_rows(system, work)
        regular = regular & factor_jacobian(system, work)
        closed = regular & settled
        if all_lanes(closed | opposite(regular)):
            return closed
        lu_solve(work.lu, work.pivots, work.row_columns[RESIDUAL])
        largest = 0.0
        for r in range(system.rows.size):
            step = where(settled, 0.0, work.row_columns[RESIDUAL, r])
            work.coordinates[system.dependent[r]].q -= step
            largest = max(largest, abs(step) / system.sizes[system.dependent[r]])
        settled = settled | (largest < CLOSED)
    return closed


@inner
def jacobian_determinant(system: System, work: Work) -> float:
    """Determinant of the dependent coordinates' Jacobian, which is factored: 0 where the mechanism stands in a dead point of this split.

    Lengths count in lengths of the mechanism; its ratio to that at another pose depends on the sizes of the loops neither.
    """
    volume = 1.0
    for r in range(work.pivots.size):
        pivot = work.lu[r, r] * system.sizes[system.dependent[r]] / system.rows[r].extent
        volume *= where(work.pivots[r] == r, pivot, -pivot)
    return volume


@inner
def factor_jacobian(system: System, work: Work) -> bool:
    """LU decomposition of the rows' Jacobian by the dependent coordinates; False where it is singular."""
    for r in range(system.rows.size):
        for m in range(system.rows.size):
            work.lu[r, m] = work.constraint_jacobian[r, system.dependent[m]]
    return lu_factor(work.lu, work.pivots)


@inner
def update_velocities(system: System, work: Work) -> None:
    """Rates of the dependent coordinates and velocities of all bodies, from the rates of the independent and driven coordinates.

    With them the dependency matrix d(dependent)/d(independent).
    """
    column = work.row_columns[SCRATCH]
    for m in range(-1, system.independent.size if system.rows.size > 0 else -1):  # -1: the driven coordinates together
        for r in range(system.rows.size):
            if m >= 0:
                column[r] = -work.constraint_jacobian[r, system.independent[m]]
            else:
                column[r] = _driven_part(system, work, r, False)
        lu_solve(work.lu, work.pivots, column)
        for r in range(system.rows.size):
            dependent = work.coordinates[system.dependent[r]]
            if m >= 0:
                work.dependency_matrix[r, m] = column[r]
                dependent.v += column[r] * work.coordinates[system.independent[m]].v
            else:
                dependent.v = column[r]
    update_body_velocities(system, work)


@inner
def update_body_velocities(system: System, work: Work) -> None:
    """Velocities of all bodies from the rates of all coordinates."""
    for i in range(1, system.bodies.size):
        body, here, base = system.bodies[i], work.poses[i], work.poses[system.bodies[i].parent]
        here.w = body.inherits * base.w
        if body.turn >= 0:
            here.w += work.coordinates[body.turn].v
        if body.free >= 0:
            here.vx, here.vy = work.coordinates[body.free].v, work.coordinates[body.free + 1].v
            continue
        slide, slip = slide_of(work, body)
        ax, ay = rotated(base, slip * body.ex - base.w * (body.ay + slide * body.ey), slip * body.ey + base.w * (body.ax + slide * body.ex))
        bx, by = rotated(here, slip * body.fx - here.w * (body.by + slide * body.fy), slip * body.fy + here.w * (body.bx + slide * body.fx))
        here.vx, here.vy = base.vx + ax - bx, base.vy + ay - by


@inner
def regular_dependency_on_drive(system: System, work: Work, d: int) -> None:
    """d(dependent)/d(driven coordinate d), in work.row_columns[COLUMN]."""
    column = work.row_columns[SCRATCH]
    for r in range(system.rows.size):
        column[r] = -work.constraint_jacobian[r, system.driven[d].coordinate]
    if system.rows.size > 0:
        lu_solve(work.lu, work.pivots, column)


@inner
def slide_of(work: Work, body: OneRecord) -> tuple[float, float]:
    """Displacement and speed along the slide by which a body hangs; zero where it has none."""
    if body.slide < 0:
        return 0.0, 0.0
    return work.coordinates[body.slide].q, work.coordinates[body.slide].v


@inner
def _driven_part(system, work, r, acceleration):
    """What the driven coordinates' rates, or accelerations, do to a row, with the opposite sign."""
    total = 0.0
    for d in range(system.driven.size):
        k = system.driven[d].coordinate
        coordinate = work.coordinates[k]
        total -= work.constraint_jacobian[r, k] * (coordinate.a if acceleration else coordinate.v)
    return total


@inner
def update_velocity_products(system: System, work: Work) -> None:
    """Accelerations that the velocities alone cause: of the bodies (bx, by), and of the dependent coordinates (DRIFT)."""
    update_body_velocity_products(system, work)
    if system.rows.size > 0:
        for r in range(system.rows.size):
            work.row_columns[BIAS, r] = _driven_part(system, work, r, True) - velocity_product_of_row(system, work, system.rows[r])
        lu_solve(work.lu, work.pivots, work.row_columns[BIAS])


@inner
def update_body_velocity_products(system: System, work: Work) -> None:
    """Accelerations of the bodies (bx, by) with the second derivatives of all coordinates zero."""
    for i in range(1, system.bodies.size):
        body, here, base = system.bodies[i], work.poses[i], work.poses[system.bodies[i].parent]
        if body.free >= 0:
            continue
        slide, slip = slide_of(work, body)
        # d2/dt2 of R (a + s e) at zero accelerations: R (-w^2 (a + s e) + 2 s' w (e turned by 90 deg))
        wp, w = base.w, here.w
        ax, ay = rotated(
            base,
            wp * wp * (body.ax + slide * body.ex) + 2 * slip * wp * body.ey,
            wp * wp * (body.ay + slide * body.ey) - 2 * slip * wp * body.ex,
        )
        bx, by = rotated(
            here, w * w * (body.bx + slide * body.fx) + 2 * slip * w * body.fy, w * w * (body.by + slide * body.fy) - 2 * slip * w * body.fx
        )
        here.bias_x, here.bias_y = base.bias_x - ax + bx, base.bias_y - ay + by


@inner
def evaluate_at_time(system: System, work: Work, t: float) -> None:
    """Driven coordinates set, bodies placed and rows measured at the coordinates in `work`; the loops stay as they are."""
    update_driven_coordinates(system, work, t)
    evaluate_rows(system, work)


@inner
def evaluate_rows(system: System, work: Work) -> None:
    """Bodies placed and rows measured at the coordinates in `work`, driven ones included."""
    update_poses(system, work)
    update_constraint_rows(system, work)
