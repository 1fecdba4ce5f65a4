"""What a moving system does at given states: poses, rates, accelerations, forces, powers, pins with play."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, cast

import numpy as np

from drivewright._jit import inner
from drivewright._typing import ArrayLike, Floats
from drivewright.multibody.chart import dependency_on_drive, update_kinematics
from drivewright.multibody.forces.contact import NO_FILM
from drivewright.multibody.forces.pin_contact import contact_state, film_force
from drivewright.multibody.forces.sliding_friction import friction_states, rub
from drivewright.multibody.loads import apply_loads, apply_springs, clear_forces, pin_forces
from drivewright.multibody.mass_matrix import solve_accelerations, update_mass_matrix
from drivewright.multibody.observed import FIELDS, FRICTION_FIELDS, PIN_FIELDS, POWER_FIELDS, Observed
from drivewright.multibody.system import BIAS, SCRATCH, Motion, System, Work, joints_with_friction, motion


def observe(system: System, t: ArrayLike, y: ArrayLike) -> Observed:
    """`Observed` of states y (m, n) at times t (m,)."""
    t, y = np.ascontiguousarray(t, float), np.ascontiguousarray(y, float)
    observed, loads = _room(system, t)
    if len(system.contacts):
        observe_pins(motion(system), t, y, np.zeros(y.shape[1]), observed.pins, loads)
    observe_all(motion(system), t, y, np.zeros(y.shape[1]), loads, observed.bodies, observed.powers, observed.drives, observed.frictions)
    return observed


def kernels_of_observation(system: System) -> list[Callable[[], object]]:
    """What compiles the kernels of `observe` for systems like this one."""
    t, y, kernels = np.zeros(1), np.zeros((1, 1)), cast(Any, (observe_pins, observe_all))
    observed, loads = _room(system, t)
    pins = partial(kernels[0].compile_for, motion(system), t, y, np.zeros(1), observed.pins, loads)
    filled = observed.bodies, observed.powers, observed.drives, observed.frictions
    bodies = partial(kernels[1].compile_for, motion(system), t, y, np.zeros(1), loads, *filled)
    return [pins, bodies] if len(system.contacts) else [bodies]


def _room(system, t):
    """(`Observed` at the times t (m,) to be filled, loads (m, bodies, 3) of the pins with play on the bodies; (m, 0, 3) without them)."""
    pins, bodies = len(system.contacts), len(system.bodies)
    rubbing = len(joints_with_friction(system))
    counts = (bodies, len(FIELDS)), (pins, len(PIN_FIELDS)), (len(POWER_FIELDS),), (len(system.driven),), (rubbing, len(FRICTION_FIELDS))
    return Observed(t, *(np.zeros((len(t), *count)) for count in counts)), np.zeros((len(t), bodies if pins else 0, 3))


def concatenate(parts: Sequence[Observed]) -> Observed:
    """One `Observed` of several, one after another."""
    return Observed(*(np.concatenate(fields) for fields in zip(*parts, strict=True)))


@inner
def observe_pins(motion: Motion, t: Floats, y: Floats, dy: Floats, pins: Floats, loads: Floats) -> None:
    """What the pins with play do, and how they load the bodies.

    t (m,) [s], y (m, n); pins as in `Observed`; loads (m, bodies, 3) [N, N, N m]; dy (n,) is scratch.
    """
    system, work = motion.system, motion.work
    for n in range(t.size):
        update_kinematics(system, work, t[n], y[n])
        update_mass_matrix(system, work)
        clear_forces(work)
        pin_forces(system, work, y[n], dy)
        for i in range(loads.shape[1]):
            here = work.poses[i]
            loads[n, i, 0], loads[n, i, 1], loads[n, i, 2] = here.fx, here.fy, here.ft
        for k in range(system.contacts.size):
            _pin(system, k, work, y[n], pins[n, k])


@inner
def observe_all(
    motion: Motion, t: Floats, y: Floats, rates: Floats, loads: Floats, bodies: Floats, powers: Floats, drives: Floats, frictions: Floats
) -> None:
    """What the bodies, the drives and the joints with friction do under the loads of `observe_pins`.

    t (m,) [s], y (m, n), rates (n,) scratch, loads (m, bodies or 0, 3); the arrays as in `Observed`, one row a time.
    """
    system, work = motion.system, motion.work
    for n in range(t.size):
        update_dynamics(system, work, t[n], y[n], rates, loads[n], powers[n])
        friction_states(system.frictions, work, y[n], frictions[n])
        for i in range(system.bodies.size):
            _body(work, i, bodies[n, i])
        for d in range(system.driven.size):
            drives[n, d] = _drive(system, work, d)
            powers[n, 4] += drives[n, d] * work.coordinates[system.driven[d].coordinate].v
            drives[n, d] *= system.driven[d].sign


@inner
def update_dynamics(system: System, work: Work, t: float, y: Floats, rates: Floats, loads: Floats, powers: Floats) -> None:
    """Everything about the system at a state: poses, rates, forces with their powers, and the accelerations of all coordinates.

    y (states,) as in `loads.apply_forces`; rates (states,) is scratch; loads (bodies or 0, 3) of the pins with play.
    """
    update_kinematics(system, work, t, y)
    update_mass_matrix(system, work)
    clear_forces(work)
    apply_springs(system, work)
    powers[0] = _power(work)
    apply_loads(system, work, t)
    powers[1] = _power(work) - powers[0]
    for i in range(loads.shape[0]):
        here = work.poses[i]
        here.fx, here.fy, here.ft = here.fx + loads[i, 0], here.fy + loads[i, 1], here.ft + loads[i, 2]
    powers[2] = _power(work) - powers[0] - powers[1]
    solve_accelerations(system, work)
    without = _power(work)
    rub(system.frictions, system, work, y, rates)
    powers[3] = _power(work) - without
    for m in range(system.independent.size):
        work.coordinates[system.independent[m]].a = work.force[m]
    for r in range(system.rows.size):
        a = work.row_columns[BIAS, r]
        for m in range(system.independent.size):
            a += work.dependency_matrix[r, m] * work.force[m]
        work.coordinates[system.dependent[r]].a = a


@inner
def _body(work, i, out):
    """Motion of body i, and the load on it, into out (FIELDS,)."""
    here = work.poses[i]
    ax, ay, alpha = here.bias_x, here.bias_y, 0.0
    for k in range(work.coordinates.size):
        partial, a = work.partial_velocities[i, k], work.coordinates[k].a
        ax, ay, alpha = ax + partial.x * a, ay + partial.y * a, alpha + partial.t * a
    out[0], out[1], out[2] = here.x, here.y, here.angle
    out[3], out[4], out[5] = here.vx, here.vy, here.w
    out[6], out[7], out[8] = ax, ay, alpha
    out[9], out[10], out[11] = here.fx, here.fy, here.ft


@inner
def _pin(system, number, work, y, out):
    """What the pin with play does at the state y, into out (PIN_FIELDS,)."""
    contact = system.contacts[number]
    depth, normal, rubbing, slip, _, nx, ny, wear_slope = contact_state(system, number, work, y)
    out[0], out[1], out[2], out[3], out[4], out[5] = depth, normal, rubbing, slip, nx, ny
    across = normal * wear_slope - rubbing  # along (-ny, nx)
    out[6], out[7] = -normal * nx - across * ny, -normal * ny + across * nx
    out[9] = work.poses[contact.j].w - work.poses[contact.i].w
    if contact.film != NO_FILM:
        fx, fy, drag = film_force(contact, work.poses, system.films)
        out[6], out[7], out[8] = out[6] + fx, out[7] + fy, drag


@inner
def _power(work):
    """Power of the forces and torques on all bodies [W]."""
    total = 0.0
    for i in range(work.poses.size):
        here = work.poses[i]
        total += here.fx * here.vx + here.fy * here.vy + here.ft * here.w
    return total


@inner
def _drive(system, work, d):
    """Generalised force of a driven coordinate: what inertia and loads of all bodies that follow it ask for."""
    k = system.driven[d].coordinate
    dependency_on_drive(system, work, d)
    column = work.row_columns[SCRATCH]
    total = 0.0
    for i in range(1, system.bodies.size):
        body, here = system.bodies[i], work.poses[i]
        x, y, t = work.partial_velocities[i, k].x, work.partial_velocities[i, k].y, work.partial_velocities[i, k].t
        for r in range(system.rows.size):
            held = work.partial_velocities[i, system.dependent[r]]
            x, y, t = x + held.x * column[r], y + held.y * column[r], t + held.t * column[r]
        ax, ay, alpha = here.bias_x, here.bias_y, 0.0
        for m in range(work.coordinates.size):
            partial, a = work.partial_velocities[i, m], work.coordinates[m].a
            ax, ay, alpha = ax + partial.x * a, ay + partial.y * a, alpha + partial.t * a
        total += x * (body.mass * (ax - system.gravity_x) - here.fx) + y * (body.mass * (ay - system.gravity_y) - here.fy)
        total += t * (body.inertia * alpha - here.ft)
    return total
