"""Kernels: the friction of ideal joints, whose size is that of the forces which they transmit, and these depend on it.

Accelerations and joint forces are linear in the friction f of all joints together.  With R_k what joint k transmits, and h_k(R_k) its
friction at the coefficient 1,

    f_k + g_k h_k(R_k0 + sum_l B_kl f_l) = 0,

a few equations, solved by Newton's method from f = 0 on.  Where their Jacobian loses its sign on the way there is no friction in balance:
the joints lock.
"""

from typing import Any

import numpy as np

from drivewright._jit import generic, implements, inner, per_lane
from drivewright._typing import Floats
from drivewright.contact.friction import stribeck
from drivewright.multibody.forces.joint_friction import (
    COEFFICIENT,
    FRICTION,
    LOAD,
    MOBILITY,
    NORMAL,
    PIN,
    RATE,
    SLIDE,
    TANGENTIAL,
    WHEEL,
    FrictionWork,
    JointFrictions,
    NoJointFriction,
)
from drivewright.multibody.frames import rotated
from drivewright.multibody.joint_loads import joints_carry, needs_at, needs_of_unit, update_row_gradients, wrench_of_joint
from drivewright.multibody.records import OneRecord
from drivewright.multibody.system import System, Work
from drivewright.numerics.small import ldl_substitute, lu_factor, lu_solve

TRIES = 30
SETTLED = 1e-12  # last correction over the largest friction
JUST_STICKING = 1.0 - 1e-9  # deflection of a joint that stops sliding
DAMPING_RATIO = 1.0  # of the spring by which a joint sticks
AT_REST = 1e-3  # part of Stribeck's speed below which a joint that is driven counts as coming to rest
SLOWEST = 1.0  # natural frequency of that spring that counts at least [rad/s]


@generic
def joints_rub(frictions: object) -> bool:
    """Whether any ideal joint has friction."""
    raise NotImplementedError


@generic
def rub(frictions: object, system: System, work: Work, y: Floats, dy: Floats) -> None:
    """Add the friction of all ideal joints to the loads of the bodies and to the accelerations in `work`, which are those without it; the
    rates of the joints' own states go into dy.

    y, dy (states,) as in `loads.apply_forces`, then three of each joint with friction (`joint_friction`).  nan where the joints lock.
    """
    raise NotImplementedError


@generic
def friction_event_value(frictions: object, k: int, work: Work, y: Floats) -> float:
    """What rises through 0 where joint k begins to slide, or slides no further."""
    raise NotImplementedError


@generic
def friction_states(frictions: object, work: Work, y: Floats, out: Floats) -> None:
    """FRICTION_FIELDS of every joint at the state y (states,) that `work` holds, into out (joints, FRICTION_FIELDS)."""
    raise NotImplementedError


@implements(joints_rub, NoJointFriction)
def _(frictions):
    return False


@implements(rub, NoJointFriction)
def _(frictions, system, work, y, dy):
    pass


@implements(friction_event_value, NoJointFriction)
def _(frictions, k, work, y):
    return 1.0


@implements(friction_states, NoJointFriction)
def _(frictions, work, y, out):
    pass


@implements(joints_rub, JointFrictions)
def _(frictions):
    return True


@implements(rub, JointFrictions)
def _(frictions, system, work, y, dy):
    add_friction(frictions, system, work, y, dy)


@implements(friction_event_value, JointFrictions)
def _(frictions, k, work, y):
    return event_value(frictions.table[k], work, y)


@implements(friction_states, JointFrictions)
def _(frictions, work, y, out):
    for k in range(frictions.table.size):
        found, friction = work.friction.joints[k], frictions.table[k]
        out[k, 0], out[k, 1], out[k, 2] = found[RATE], found[FRICTION], found[LOAD]
        largest = friction.static_friction
        out[k, 5], out[k, 6] = found[NORMAL], found[TANGENTIAL]
        out[k, 3], out[k, 4] = abs(found[COEFFICIENT]) / largest if largest > 0.0 else 0.0, y[friction.sliding]


# ------------------------------------------------------------------------------------------------------------- friction law


@inner
def unit_force(work: Work, friction: OneRecord) -> tuple[float, float, float, float]:
    """(x, y) of a unit force of friction on the first body, torque of it about that body's centroid, and that of its opposite about the
    centroid of the second."""
    if friction.kind == PIN or friction.kind == WHEEL:
        return 0.0, 0.0, 1.0, -1.0
    one, two = work.poses[friction.i], work.poses[friction.j]
    ux, uy = rotated(two, friction.ex, friction.ey)
    px, py = rotated(one, friction.ax, friction.ay)
    qx, qy = one.x + px - two.x, one.y + py - two.y
    return ux, uy, px * uy - py * ux, qy * ux - qx * uy


@inner
def joint_rate(work: Work, friction: OneRecord, unit: tuple[float, float, float, float]) -> float:
    """Rate [m/s], or of rotation [rad/s], of the first body relative to the second along a unit force."""
    one, two = work.poses[friction.i], work.poses[friction.j]
    ux, uy, ti, tj = unit
    return ux * (one.vx - two.vx) + uy * (one.vy - two.vy) + ti * one.w + tj * two.w


@inner
def sliding_coefficient(friction: OneRecord, rate: Any) -> Any:
    """Coefficient at a rate, viscous part included, above 0."""
    speed = abs(rate)
    return stribeck(speed, friction.friction, friction.static_friction, friction.stribeck_speed) + friction.viscous * speed


@inner
def sticking_share(friction: OneRecord, rate: float, y: Floats) -> float:
    """u + tau u': friction of a joint that sticks over the largest one."""
    return y[friction.deflection] + y[friction.relaxation] * rate / friction.presliding


@per_lane
def event_value(friction: OneRecord, work: Work, y: Floats) -> Any:
    """`friction_event_value` of one joint."""
    rate = joint_rate(work, friction, unit_force(work, friction))
    if y[friction.sliding] == 0.0:
        return abs(sticking_share(friction, rate, y)) - 1.0
    return -y[friction.sliding] * rate


@inner
def switch_joint(frictions: JointFrictions, index: int, work: Work, y: Floats) -> None:
    """Joint `index` begins to slide, or to stick; whichever else slides no further sticks as well.  y (states,) as in `rub`."""
    for k in range(frictions.table.size):
        friction, found = frictions.table[k], work.friction.joints[k]
        rate = joint_rate(work, friction, unit_force(work, friction))
        if y[friction.sliding] != 0.0:
            if k == index or y[friction.sliding] * rate <= 0.0:
                stick(friction, found[LOAD], found[MOBILITY], JUST_STICKING * y[friction.sliding], y)
        elif k == index:
            slide(friction, np.sign(sticking_share(friction, rate, y)), y)


@inner
def stick(friction: OneRecord, load: Any, mobility: Any, deflection: Any, y: Floats) -> None:
    """From here on the joint sticks; tau [s] damps its spring, of the stiffness mu_s h/d, by `DAMPING_RATIO`.  y (states,)."""
    frequency = np.sqrt(friction.static_friction * load * mobility / friction.presliding + SLOWEST**2)
    y[friction.sliding], y[friction.deflection], y[friction.relaxation] = 0.0, deflection, 2.0 * DAMPING_RATIO / frequency


@inner
def slide(friction: OneRecord, direction: float, y: Floats) -> None:
    """From here on the joint slides.  y (states,)."""
    y[friction.sliding] = y[friction.deflection] = direction


@inner
def set_sliding(frictions: JointFrictions, work: Work, y: Floats) -> None:
    """What moves slides, what does not sticks without deflection.  y (states,) as in `rub`."""
    for k in range(frictions.table.size):
        friction, found = frictions.table[k], work.friction.joints[k]
        if found[RATE] == 0.0:
            stick(friction, found[LOAD], found[MOBILITY], 0.0, y)
        else:
            slide(friction, np.sign(found[RATE]), y)


@inner
def set_coefficients(frictions: JointFrictions, system: System, work: Work, y: Floats, dy: Floats) -> None:
    """Unit forces, rates and coefficients of all joints, and the rates of their states.  y, dy (states,).

    Where the drives leave no freedom a joint has no memory: it slides the way that it is moved, and at rest nothing is known of it.
    """
    is_driven = system.independent.size == 0
    for k in range(frictions.table.size):
        friction, found = frictions.table[k], work.friction.joints[k]
        unit = unit_force(work, friction)
        work.friction.unit[k, 0], work.friction.unit[k, 1], work.friction.unit[k, 2], work.friction.unit[k, 3] = unit
        rate = found[RATE] = joint_rate(work, friction, unit)
        sliding = y[friction.sliding]
        dy[friction.sliding] = dy[friction.deflection] = dy[friction.relaxation] = 0.0
        if is_driven:
            share = rate / (AT_REST * friction.stribeck_speed)
            found[COEFFICIENT] = min(max(share, -1.0), 1.0) * sliding_coefficient(friction, rate)
        elif sliding != 0.0:
            size = sliding_coefficient(friction, rate)
            found[COEFFICIENT] = sliding * size if sliding * rate >= 0.0 else sliding * friction.static_friction
        else:
            dy[friction.deflection] = rate / friction.presliding
            found[COEFFICIENT] = friction.static_friction * sticking_share(friction, rate, y) + friction.viscous * rate


# ----------------------------------------------------------------------------------------------------------------- balance


@per_lane
def add_friction(frictions: JointFrictions, system: System, work: Work, y: Floats, dy: Floats) -> None:
    """`rub`.  y, dy (states,)."""
    scratch = work.friction
    set_coefficients(frictions, system, work, y, dy)
    respond(frictions, system, work)
    balanced = solve_friction(frictions, scratch)
    for k in range(frictions.table.size):
        friction, unit = frictions.table[k], scratch.unit[k]
        if not balanced:
            scratch.joints[k, FRICTION] = np.nan
        size = scratch.joints[k, FRICTION]
        for m in range(system.independent.size):
            work.force[m] += size * scratch.accelerations[k, m]
        one, two = work.poses[friction.i], work.poses[friction.j]
        one.fx, one.fy, one.ft = one.fx + size * unit[0], one.fy + size * unit[1], one.ft + size * unit[2]
        two.fx, two.fy, two.ft = two.fx - size * unit[0], two.fy - size * unit[1], two.ft + size * unit[3]


@inner
def respond(frictions: JointFrictions, system: System, work: Work) -> None:
    """What every joint transmits without friction, and per unit of the friction of every joint."""
    scratch = work.friction
    update_row_gradients(system, work, scratch.rows)
    needs_at(system, work, work.force, scratch.wrenches)
    transmit(frictions, system, work, 0)
    for k in range(frictions.table.size):
        friction, unit, acceleration = frictions.table[k], scratch.unit[k], scratch.accelerations[k]
        for m in range(acceleration.size):
            one, two = work.reduced_partial_velocities[friction.i, m], work.reduced_partial_velocities[friction.j, m]
            acceleration[m] = unit[0] * (one.x - two.x) + unit[1] * (one.y - two.y) + unit[2] * one.t + unit[3] * two.t
            scratch.given[m] = acceleration[m]
        ldl_substitute(work.mass, acceleration)
        mobility = 0.0
        for m in range(acceleration.size):
            mobility += scratch.given[m] * acceleration[m]
        scratch.joints[k, MOBILITY] = mobility
        needs_of_unit(system, work, friction, unit, acceleration, scratch.wrenches)
        transmit(frictions, system, work, 1 + k)


@inner
def transmit(frictions: JointFrictions, system: System, work: Work, column: int) -> None:
    """What every joint transmits where the bodies need what stands in the scratch, as two numbers [N], into a column of the response."""
    scratch = work.friction
    joints_carry(system, work, scratch.wrenches, scratch.rows)
    for k in range(frictions.table.size):
        friction, two = frictions.table[k], work.poses[frictions.table[k].j]
        fx, fy, moment = wrench_of_joint(system, work, friction, scratch)
        if friction.kind == WHEEL:
            ux, uy = wheel_normal(work, friction)
            fx, fy = fx * ux + fy * uy, fy * ux - fx * uy
        elif friction.kind != PIN:
            ux, uy = rotated(two, friction.ex, friction.ey)
            fx, fy = fy * ux - fx * uy, 2.0 * moment / friction.guide if friction.kind == SLIDE and friction.guide > 0.0 else 0.0
        scratch.response[k, column, 0], scratch.response[k, column, 1] = fx, fy


@inner
def wheel_normal(work: Work, friction: OneRecord) -> tuple[float, float]:
    """Unit vector from the track to the wheel's centre: across a straight track; between the centres where `guide`, the radius of the
    track, is not 0."""
    one, two = work.poses[friction.i], work.poses[friction.j]
    if friction.guide == 0.0:
        return rotated(two, -friction.ey, friction.ex)
    px, py = rotated(one, friction.ax, friction.ay)
    qx, qy = rotated(two, friction.bx, friction.by)
    dx, dy = one.x + px - two.x - qx, one.y + py - two.y - qy
    distance = np.sqrt(dx * dx + dy * dy)
    return dx / distance, dy / distance


@inner
def friction_of_load(friction: OneRecord, p: float, q: float) -> tuple[float, float, float]:
    """(h, dh/dp, dh/dq): friction at the coefficient 1 of a joint that transmits (p, q)."""
    if friction.kind == PIN:
        size = np.sqrt(p * p + q * q)
        return (friction.arm * size, friction.arm * p / size, friction.arm * q / size) if size > 0.0 else (0.0, 0.0, 0.0)
    if friction.kind == SLIDE and abs(q) > abs(p):
        return abs(q), 0.0, np.sign(q)
    arm = friction.arm if friction.kind == WHEEL else 1.0
    return arm * abs(p), arm * np.sign(p), 0.0


@inner
def solve_friction(frictions: JointFrictions, scratch: FrictionWork) -> bool:
    """Newton's method for the friction of all joints, into their FRICTION, and LOAD; False where they lock."""
    n = frictions.table.size
    for k in range(n):
        scratch.joints[k, FRICTION] = 0.0
    for _ in range(TRIES):
        for k in range(n):
            load_of(frictions.table[k], scratch, k)
        if not lu_factor(scratch.matrix, scratch.columns[1]) or _determinant_sign(scratch) < 0.0:
            return False
        lu_solve(scratch.matrix, scratch.columns[1], scratch.columns[0])
        step = size = 0.0
        for k in range(n):
            scratch.joints[k, FRICTION] -= scratch.columns[0, k]
            step, size = max(step, abs(scratch.columns[0, k])), max(size, abs(scratch.joints[k, FRICTION]))
        if step <= SETTLED * size:
            return True
    return False


@inner
def load_of(friction: OneRecord, scratch: FrictionWork, k: int) -> None:
    """LOAD of joint k at the friction of all, its equation's residual and its row of the Jacobian."""
    p, q = scratch.response[k, 0, 0], scratch.response[k, 0, 1]
    for l in range(scratch.joints.shape[0]):
        p += scratch.response[k, 1 + l, 0] * scratch.joints[l, FRICTION]
        q += scratch.response[k, 1 + l, 1] * scratch.joints[l, FRICTION]
    load, by_p, by_q = friction_of_load(friction, p, q)
    coefficient = scratch.joints[k, COEFFICIENT]
    scratch.joints[k, LOAD], scratch.joints[k, NORMAL], scratch.joints[k, TANGENTIAL] = load, p, q
    scratch.columns[0, k] = scratch.joints[k, FRICTION] + coefficient * load
    for l in range(scratch.joints.shape[0]):
        scratch.matrix[k, l] = coefficient * (by_p * scratch.response[k, 1 + l, 0] + by_q * scratch.response[k, 1 + l, 1])
    scratch.matrix[k, k] += 1.0


@inner
def _determinant_sign(scratch):
    """Sign of the determinant of the factored Jacobian."""
    sign = 1.0
    for k in range(scratch.matrix.shape[0]):
        sign *= np.sign(scratch.matrix[k, k])
        if scratch.columns[1, k] != k:
            sign = -sign
    return sign
