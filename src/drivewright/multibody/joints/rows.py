"""Kernels: the constraint rows of all joints, each an equation r(q, t) = 0.

A row sees the difference d = P_i - P_j of two points, the angles theta of four bodies i, j, k, l, and its own fields.  What a kind of
row states is its residual r, the gradient of r by d and by the angles, and the velocity-product term: d2r/dt2 with the accelerations of
all coordinates zero.  The joints of the package need three kinds, distinguished by an integer in `row.kind`:

LINEAR    (R_k e).(P_i - P_j) + gi theta_i + gj theta_j + gk theta_k - lift(theta_l - theta_k) - constant = 0
DISTANCE  |P_i - P_j| - constant = 0
CIRCLE    (gi + gj) phi - gi theta_i - gj theta_j - constant = 0, phi the direction from P_j to P_i

Another kind is an equation: a NamedTuple class with formulas under @implements(row_terms, ...) and @implements(row_velocity_product, ...).
A joint writes it into the field `kind` of its rows.  A model that has such rows has kernels of its own; all others share theirs.
"""

from typing import Any, NamedTuple

import numpy as np

from drivewright._jit import generic, implements, inner
from drivewright.multibody.curves import curve_at
from drivewright.multibody.frames import rotated
from drivewright.multibody.records import OneRecord

LINEAR, DISTANCE, CIRCLE, FURTHER = range(4)  # FURTHER and above: equations that a model brings

Terms = tuple[float, float, float, float, float, float, float]


@generic
def row_terms(equation: Any, row: OneRecord, pose: OneRecord, dx: float, dy: float, ti: float, tj: float, tl: float) -> Terms:
    """(r, dr/dx, dr/dy, dr/d(ti), dr/d(tj), dr/d(tk), dr/d(tl)) of an equation.

    `pose` is that of the body k: its angle theta_k and its cosine c and sine s; (dx, dy) [m] in the world's axes; ti, tj, tl [rad].
    """
    raise NotImplementedError


@generic
def row_velocity_product(
    equation: Any, row: OneRecord, pose: OneRecord, dx: float, dy: float, vx: float, vy: float, wi: float, wj: float, wl: float
) -> float:
    """d2r/dt2 of an equation where d and the angles change at constant rates: (vx, vy) [m/s] of d, wi, wj, wl and pose.w [rad/s]."""
    raise NotImplementedError


class NoEquations(NamedTuple):
    """The rows of the joints of the package alone."""

    codes: int = FURTHER


class Equations(NamedTuple):
    """An equation for the rows of kind `code`, and those for the others."""

    code: int
    equation: tuple[Any, ...]
    others: "NoEquations | Equations"


@implements(row_terms, NoEquations)
def _(equations, row, pose, dx, dy, ti, tj, tl):
    return np.nan, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0


@implements(row_velocity_product, NoEquations)
def _(equations, row, pose, dx, dy, vx, vy, wi, wj, wl):
    return np.nan


@implements(row_terms, Equations)
def _(equations, row, pose, dx, dy, ti, tj, tl):
    if row.kind == equations.code:
        return row_terms(equations.equation, row, pose, dx, dy, ti, tj, tl)
    return row_terms(equations.others, row, pose, dx, dy, ti, tj, tl)


@implements(row_velocity_product, Equations)
def _(equations, row, pose, dx, dy, vx, vy, wi, wj, wl):
    if row.kind == equations.code:
        return row_velocity_product(equations.equation, row, pose, dx, dy, vx, vy, wi, wj, wl)
    return row_velocity_product(equations.others, row, pose, dx, dy, vx, vy, wi, wj, wl)


@inner
def terms_of_row(system: Any, work: Any, row: OneRecord, dx: float, dy: float) -> Terms:
    """(residual, its gradient by (dx, dy) and by the angles of the bodies i, j, k, l) of a row of any kind."""
    first, second, third = work.poses[row.i], work.poses[row.j], work.poses[row.k]
    gi, gj, gk, gl = row.gi, row.gj, row.gk, 0.0
    if row.kind == LINEAR:
        ux, uy = rotated(third, row.ex, row.ey)
        residual = ux * dx + uy * dy + gi * first.angle + gj * second.angle + gk * third.angle - row.constant
        gk += ux * dy - uy * dx
        if row.lift >= 0:
            lift, slope, _ = curve_at(system.curves, system.pieces, row.lift, work.poses[row.l].angle - third.angle)
            residual -= lift
            gl -= slope
            gk += slope
    elif row.kind >= FURTHER:
        return row_terms(system.equations, row, third, dx, dy, first.angle, second.angle, work.poses[row.l].angle)
    else:
        distance = np.sqrt(dx * dx + dy * dy)
        ux, uy = dx / distance, dy / distance
        if row.kind == DISTANCE:
            residual = distance - row.constant
        else:
            rolled, reach = gi * first.angle + gj * second.angle + row.constant, gi + gj
            phi = np.arctan2(dy, dx)
            phi += 2 * np.pi * np.floor((rolled / reach - phi) / (2 * np.pi) + 0.5)  # the turn on which the wheel is
            residual = reach * phi - rolled
            ux, uy = -reach * uy / distance, reach * ux / distance
            gi, gj = -gi, -gj
    return residual, ux, uy, gi, gj, gk, gl


@inner
def velocity_product_of_row(system: Any, work: Any, row: OneRecord) -> float:
    """Second derivative of a row's residual with all coordinates' accelerations zero."""
    first, second, third = work.poses[row.i], work.poses[row.j], work.poses[row.k]
    pix, piy = rotated(first, row.ax, row.ay)
    pjx, pjy = rotated(second, row.bx, row.by)
    wi, wj, wk = first.w, second.w, third.w
    dx, dy = first.x + pix - second.x - pjx, first.y + piy - second.y - pjy
    vx, vy = first.vx - wi * piy - second.vx + wj * pjy, first.vy + wi * pix - second.vy - wj * pjx
    ax, ay = first.bias_x - wi * wi * pix - second.bias_x + wj * wj * pjx, first.bias_y - wi * wi * piy - second.bias_y + wj * wj * pjy
    if row.kind == LINEAR:
        ux, uy = rotated(third, row.ex, row.ey)
        total = ux * ax + uy * ay + 2 * wk * (ux * vy - uy * vx) - wk * wk * (ux * dx + uy * dy)
        if row.lift >= 0:
            cam = work.poses[row.l]
            _, _, curvature = curve_at(system.curves, system.pieces, row.lift, cam.angle - third.angle)
            total -= curvature * (cam.w - wk) ** 2
        return total
    if row.kind >= FURTHER:
        cam = work.poses[row.l]
        _, ux, uy, _, _, _, _ = row_terms(system.equations, row, third, dx, dy, first.angle, second.angle, cam.angle)
        return ux * ax + uy * ay + row_velocity_product(system.equations, row, third, dx, dy, vx, vy, wi, wj, cam.w)
    distance = np.sqrt(dx * dx + dy * dy)
    ux, uy = dx / distance, dy / distance
    along, across = ux * vx + uy * vy, ux * vy - uy * vx
    if row.kind == DISTANCE:
        return ux * ax + uy * ay + across * across / distance
    return (row.gi + row.gj) * (ux * ay - uy * ax - 2 * along * across / distance) / distance
