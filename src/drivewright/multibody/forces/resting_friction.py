"""The friction with which joints that stick hold a mechanism at rest."""

import numpy as np

from drivewright._typing import Floats
from drivewright.multibody.dynamics import begin_sliding
from drivewright.multibody.forces.joint_friction import LOAD, JointFrictions
from drivewright.multibody.forces.sliding_friction import JUST_STICKING
from drivewright.multibody.system import PIECE, Motion, System, motion

ROUNDS = 20  # loads of the joints follow from their friction, and the friction from the loads
SETTLED = 1e-13  # change of a deflection


def balance_sticking(moving: Motion, t: float, y: Floats, frictions: JointFrictions) -> None:
    """Deflect the joints that stick, in y (states,), so that they hold what they can: their joints do not accelerate at the start.

    With a the accelerations, G_k what a unit of friction of joint k is to the coordinates, and A_k the accelerations that it gives, the
    change of the friction f is the shortest with sum_l (G_k.A_l) df_l = -G_k.a for all joints that stick.  Several of them may share a
    load in many ways: they share it alike.  A joint that cannot hold is deflected to its limit, and slides from there.  Without this a
    mechanism at rest would first sink into the springs by which its joints stick.
    """
    table, scratch, first = frictions.table, moving.work.friction, len(moving.system.stored)
    sticking = [k for k, one in enumerate(table) if y[one.sliding] == 0.0]
    for _ in range(ROUNDS if sticking else 0):
        begin_sliding(*moving, t, y, frictions, True)
        found = scratch.rates[first : first + len(moving.system.independent)]
        if not np.all(np.isfinite(found)):  # joints lock on the way: the run will say so
            y[table.deflection] = np.where(y[table.sliding] == 0.0, 0.0, y[table.deflection])
            return
        forces = np.array([_generalised(moving, table[k], scratch.unit[k]) for k in sticking])
        change = np.linalg.lstsq(forces @ scratch.accelerations[sticking].T, -forces @ found, rcond=1e-10)[0]
        largest = 0.0
        for k, more in zip(sticking, change, strict=True):
            one, before = table[k], y[table[k].deflection]
            limit = one.static_friction * scratch.joints[k, LOAD]
            after = np.clip(before - more / limit, -JUST_STICKING, JUST_STICKING) if limit > 0.0 else 0.0
            y[one.deflection], largest = after, max(largest, abs(after - before))
        if largest <= SETTLED:
            return


def holding_shares(system: System, t: float, y: Floats) -> Floats:
    """Friction over what each joint can hold (joints,), at the places of a state y (states,), at rest with all joints sticking."""
    frictions, y = system.frictions, y.copy()
    assert isinstance(frictions, JointFrictions)
    table = frictions.table
    first = len(system.stored)
    y[first : first + len(system.independent)], y[table.sliding], y[table.deflection] = 0.0, 0.0, 0.0
    balance_sticking(motion(system), t, y, frictions)
    return np.abs(y[table.deflection])


def with_loads(system: System, factor: float) -> System:
    """The system with all applied forces and torques times a factor; where there are none, with gravity times it."""
    if len(system.forces) + len(system.torques) == 0:
        return system._replace(gravity_x=factor * system.gravity_x, gravity_y=factor * system.gravity_y)
    forces, pieces = system.forces.copy(), system.pieces.copy()
    forces.ex, forces.ey = factor * forces.ex, factor * forces.ey
    for curve in system.curves[system.torques.curve]:
        rows = slice(curve.first, curve.first + curve.count)
        for name in PIECE.names or ():
            if name != "start":
                pieces[name][rows] *= factor
    return system._replace(forces=forces.view(np.recarray), pieces=pieces.view(np.recarray))


def _generalised(moving, one, unit):
    """What a unit of friction of a joint is to the independent coordinates (m,)."""
    first, second = moving.work.reduced_partial_velocities[one.i], moving.work.reduced_partial_velocities[one.j]
    return unit[0] * (first.x - second.x) + unit[1] * (first.y - second.y) + unit[2] * first.t + unit[3] * second.t
