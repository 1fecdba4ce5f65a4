"""Kernels: the equations of motion in the independent coordinates, for the integrators of `numerics`.

State y: the stored coordinates, the rates of the independent ones, and what the elements remember.  The dependent coordinates in
the state only start Newton's method: the loops are closed anew, exactly, at every evaluation.
"""

import numpy as np

from drivewright._jit import generic, implements, inner, per_lane
from drivewright._typing import Floats
from drivewright.multibody.chart import chart_offset, update_interpolated, update_kinematics, update_positions
from drivewright.multibody.curves import curve_at
from drivewright.multibody.forces.contact import LUGRE
from drivewright.multibody.forces.joint_friction import JointFrictions, NoJointFriction
from drivewright.multibody.forces.pin_contact import LASTING, SLOWEST, contact_signs, gap_motion
from drivewright.multibody.forces.sliding_friction import friction_event_value, joints_rub, rub, set_sliding, switch_joint
from drivewright.multibody.kinematics import jacobian_determinant, update_velocities
from drivewright.multibody.loads import apply_forces
from drivewright.multibody.mass_matrix import solve_accelerations, update_mass_matrix
from drivewright.multibody.system import Motion, System, Work
from drivewright.numerics.lanes import all_lanes, any_lane, where
from drivewright.numerics.ode import events, rate, switch

DECADE = 0.1  # part of its determinant to which a split may fall, or whose inverse it may reach, before another one is made
FIRST_PIN = 2  # among the event functions: before it stand the split's own and the singular position


@implements(rate, Motion)
def _(motion, t, y, dy):
    accelerations(motion.system, motion.work, t, y, dy)


@implements(events, Motion)
def _(motion, t, y, values):
    event_values(motion.system, motion.work, t, y, values)


@implements(switch, Motion)
def _(motion, index, t, y):
    contact_event(motion.system, motion.work, index, t, y)


@inner
def accelerations(system: System, work: Work, t: float, y: Floats, dy: Floats) -> None:
    """dy of the state y: rates of the stored coordinates, accelerations of the independent ones, rates of what elements remember.

    y, dy (states,) as in `loads.apply_forces`.
    """
    closed = update_kinematics(system, work, t, y)
    update_mass_matrix(system, work)
    apply_forces(system, work, t, y, dy)
    solve_accelerations(system, work)
    rub(system.frictions, system, work, y, dy)
    for k in range(system.stored.size):
        dy[k] = work.coordinates[system.stored[k]].v
    for m in range(system.independent.size):
        dy[system.stored.size + m] = where(closed, work.force[m], np.nan)


@inner
def event_values(system: System, work: Work, t: float, y: Floats, values: Floats) -> None:
    """Whether the split of the coordinates, or the chart, still serves (below 0 it does not); how far the state stands from the singular
    position of the chart; then the depth of every pin with play: it touches where this rises through 0 and lets go where it falls; then
    the other `contact_signs` of all pins, one kind after the other; then where ideal joints begin, or cease, to slide.

    y (states,) as in `loads.apply_forces`.
    """
    pins = system.contacts.size
    if system.chart.offsets.size > 0:
        update_interpolated(system, work, t, y)
        update_mass_matrix(system, work)
        values[1] = chart_offset(system, t, y)
        values[0] = 1.0 - (values[1] / system.chart.reach) ** 2
    else:
        if not all_lanes(is_current(system, work, t, y)):  # at the end of a step the last rates were those of this very state
            update_positions(system, work, t, y)
            if joints_rub(system.frictions) or any_lane(has_contact(system, y)):
                update_velocities(system, work)
                update_mass_matrix(system, work)
        values[0], values[1] = validity_of_split(system, work), 1.0
    for n in range(pins):
        depth, reversal, hold = contact_signs(system, n, work, y)
        values[FIRST_PIN + n], values[FIRST_PIN + pins + n], values[FIRST_PIN + 2 * pins + n] = depth, reversal, hold
    first = FIRST_PIN + 3 * pins
    for k in range(values.size - first):
        values[first + k] = friction_event_value(system.frictions, k, work, y)


@inner
def has_contact(system: System, y: Floats) -> bool:
    """Whether a pin with play touches.

    y (states,) as in `loads.apply_forces`.
    """
    touches = 0.0
    for n in range(system.contacts.size):
        touches += abs(y[system.contacts[n].memory])
    return touches != 0.0


@per_lane
def is_current(system: System, work: Work, t: float, y: Floats) -> bool:
    """Whether the bodies are placed for this state already: driven and independent coordinates are the same, and these have their rates.

    y (states,) as in `loads.apply_forces`.
    """
    for d in range(system.driven.size):
        driven = system.driven[d]
        value, _, _ = curve_at(system.curves, system.pieces, driven.curve, t)
        if work.coordinates[driven.coordinate].q != driven.sign * (driven.start + value):
            return False
    m = 0
    for k in range(system.stored.size):
        if m < system.independent.size and system.stored[k] == system.independent[m]:  # both ascend
            if work.coordinates[system.stored[k]].q != y[k] or work.coordinates[system.stored[k]].v != y[system.stored.size + m]:
                return False
            m += 1
    return True


@generic
def friction_event(frictions: object, system: System, work: Work, index: int, t: float, y: Floats) -> None:
    """The joint with friction of this number begins, or ceases, to slide.  y (states,) as in `sliding_friction.rub`."""
    raise NotImplementedError


@implements(friction_event, NoJointFriction)
def _(frictions, system, work, index, t, y):
    pass


@implements(friction_event, JointFrictions)
def _(frictions, system, work, index, t, y):
    accelerations(system, work, t, y, work.friction.rates)
    switch_joint(frictions, index, work, y)


@inner
def begin_sliding(system: System, work: Work, t: float, y: Floats, frictions: JointFrictions, settled: bool) -> None:
    """Rates of the state into the scratch of the friction; joints with friction, those of the system, slide at the start where they move,
    and stick where they do not, unless that is `settled` already.

    y (states,) as in `sliding_friction.rub`.
    """
    accelerations(system, work, t, y, work.friction.rates)
    if not settled:
        set_sliding(frictions, work, y)


@inner
def validity_of_split(system: System, work: Work) -> float:
    """Above 0 while the determinant is within a decade of that where the coordinates were split, with the same sign.

    It changes its sign in the singular position of a single loop, and stays small about that of several, so that no step of the
    integrator is so long that it misses one.
    """
    if all_lanes(system.reference_determinant == 0.0):
        return where(system.reference_determinant == 0.0, 1.0, 1.0)
    share = jacobian_determinant(system, work) / system.reference_determinant
    return where(system.reference_determinant == 0.0, 1.0, min(share - DECADE, 1.0 - DECADE * share))


@inner
def contact_event(system: System, work: Work, index: int, t: float, y: Floats) -> None:
    """A pin comes into contact: store the speed of approach.  It loses contact, or is compressed again while in contact: discard it.  Or a
    joint with friction begins, or ceases, to slide.

    y (states,) as in `loads.apply_forces`.
    """
    pins, pin = system.contacts.size, index - FIRST_PIN
    if pin >= 3 * pins:
        friction_event(system.frictions, system, work, pin - 3 * pins, t, y)
        return
    if pin >= pins:
        if pin < 2 * pins:
            y[system.contacts[pin - pins].memory] = LASTING
        return
    contact = system.contacts[pin]
    update_kinematics(system, work, t, y)
    _, rate, _, _, _, _, _ = gap_motion(system, pin, work, 0.0)
    if (y[contact.memory] != 0.0) == (rate > 0.0):  # a touch, or a letting go, seen twice by rounding
        return
    y[contact.memory] = 0.0 if y[contact.memory] != 0.0 else max(rate, SLOWEST)
    if contact.law == LUGRE:
        y[contact.bristle] = 0.0
