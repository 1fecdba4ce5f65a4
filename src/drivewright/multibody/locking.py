"""Self-locking friction: joint forces grow with the drive force, so that no force of the drives moves the mechanism.

With all friction at the share s of what it is, the balance of `forces.sliding_friction` has a solution from s = 0 up to where its Jacobian
becomes singular.  A share below 1 says how much less friction would let the mechanism move, and the Jacobian there, which joint it is.
"""

from typing import NamedTuple

import numpy as np

from drivewright._jit import plain
from drivewright._typing import Floats
from drivewright.errors import InputError
from drivewright.multibody.assembly import Assembly
from drivewright.multibody.drive_positions import drive_positions
from drivewright.multibody.dynamics import begin_sliding
from drivewright.multibody.forces.joint_friction import COEFFICIENT, FrictionWork, JointFrictions
from drivewright.multibody.forces.sliding_friction import friction_of_load
from drivewright.multibody.records import Records
from drivewright.multibody.system import System, joints_with_friction, motion

TRIES = 50
SETTLED = 1e-12
HALVINGS = 40


class Locking(NamedTuple):
    """Up to which share of the friction the mechanism moves, and the number of the joint that presses itself fast."""

    share: float
    joint: int


def refuse_locked(assembly: Assembly, system: System, t: Floats, y: Floats, accelerations: Floats) -> None:
    """InputError where friction locks the mechanism at one of the states y (m, n) at times t (m,): their accelerations (m, ...) are nan."""
    if len(joints_with_friction(system)) == 0 or np.all(np.isfinite(accelerations)):
        return
    first = int(np.argmin(np.all(np.isfinite(accelerations.reshape(len(t), -1)), axis=1)))
    raise InputError(locked_message(assembly, system, float(t[first]), y[first]))


def locked_message(assembly: Assembly, system: System, t: float, y: Floats) -> str:
    """What locks the mechanism at a state y (n,): the pose, the joint, and how much friction would let it move; "" where nothing does."""
    moving, frictions = motion(system), system.frictions
    assert isinstance(frictions, JointFrictions)
    begin_sliding(moving.system, moving.work, t, y.copy(), frictions, True)
    scratch, table = moving.work.friction, frictions.table
    found = locking(table, scratch)
    if found is None:
        return ""
    name = assembly.expanded.joints[table.joint[found.joint]].name
    places = drive_positions(assembly, system, moving.work)
    where = f", drive {' and '.join(places)}" if places else ""
    return (
        f"friction locks the mechanism at t = {t:.6g} s{where}: joint {name!r} is self-locking, so no drive force can move it. It moves "
        f"with up to {100 * found.share:.3g} % of the given friction. Lower the coefficient, lengthen a guide (bearing_length), or apply "
        "the forces closer to the joint"
    )


def locking(table: Records, scratch: FrictionWork) -> Locking | None:
    """The `Locking` of the state that the scratch holds; None where friction is in balance."""
    if _balance(table, scratch, 1.0) is not None:
        return None
    low, high = 0.0, 1.0
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if _balance(table, scratch, middle) is not None else (low, middle)
    solved = _balance(table, scratch, low)
    assert solved is not None  # without friction there is one
    friction, jacobian = solved
    direction = np.abs(np.linalg.svd(jacobian)[2][-1])
    return Locking(low, int(np.argmax(direction / np.where(friction == 0.0, np.inf, np.abs(friction)))))


def _balance(table, scratch, share):
    """(friction (n,), Jacobian (n, n)) in balance at a share of all coefficients; None where Newton's method leaves the branch from 0."""
    response, coefficients = scratch.response, share * scratch.joints[:, COEFFICIENT]
    friction = np.zeros(len(table))
    for _ in range(TRIES):
        loads = response[:, 0] + np.einsum("kli,l->ki", response[:, 1:], friction)
        parts = np.array([plain(friction_of_load)(table[k], *loads[k]) for k in range(len(table))])
        jacobian = np.eye(len(table)) + coefficients[:, None] * np.einsum("ki,kli->kl", parts[:, 1:], response[:, 1:])
        if not np.linalg.det(jacobian) > 0.0:
            return None
        step = np.linalg.solve(jacobian, friction + coefficients * parts[:, 0])
        friction = friction - step
        if np.max(np.abs(step)) <= SETTLED * np.max(np.abs(friction)):
            return friction, jacobian
    return None
