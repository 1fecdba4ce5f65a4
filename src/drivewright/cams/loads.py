"""Forces of a cam drive: what the follower asks for, what the contact carries, what the shaft feels, what the spring must do.

Everything that acts on the follower is reduced to one coordinate x [m], its travel; x = reach * lift.  No friction.
"""

from typing import Any, NamedTuple

import numpy as np

from drivewright._typing import Numbers
from drivewright.cams.cycle import Cycle
from drivewright.cams.followers import CamContact
from drivewright.curves import derivative
from drivewright.errors import SolverError
from drivewright.numerics.jets import Jet

STEPS = 60


class FollowerLoad(NamedTuple):
    """What acts along the travel x; `force` and the spring press the follower onto the cam.  Of many designs columns (n, 1)."""

    mass: Numbers = 0.0  # kg
    damping: Numbers = 0.0  # N s/m
    stiffness: Numbers = 0.0  # N/m
    preload: Numbers = 0.0  # N, of the spring at x = 0
    force: Numbers = 0.0  # N


def follower_force(travel: Jet, load: FollowerLoad, speed: Numbers) -> Jet:
    """Q = m w^2 x'' + c w x' + k x + P + F [N]: the force that the cam must exert along the travel, a jet of the cam angle.

    Where Q < 0 a one-sided contact is lost, and a second flank or cam takes over.
    """
    velocity = derivative(travel)
    inertia = load.mass * speed**2 * derivative(velocity)
    return inertia + load.damping * speed * velocity + load.stiffness * travel + (load.preload + load.force)


def cam_normal_force(required: Jet, contact: CamContact) -> Jet:
    """N = Q/leverage [N]: force between the surfaces from the force along the travel; both jets."""
    return required / contact.leverage


def drive_torque(travel: Jet, required: Jet) -> Jet:
    """T = Q dx/dtheta [N m] that the cam shaft must be given, from the power balance T w = Q v."""
    return required * derivative(travel)


def needed_preload(cycle: Cycle, reach: Numbers, load: FollowerLoad, speed: Numbers) -> Any:
    """Least preload [N] of the spring that keeps the contact closed with the stiffness as it is; 0 where none is needed."""
    lowest = cycle.minimum(lambda _, lift: follower_force(reach * lift, load._replace(preload=0.0), speed))
    return np.maximum(-lowest.value, 0.0)


def needed_stiffness(cycle: Cycle, reach: Numbers, load: FollowerLoad, speed: Numbers) -> Any:
    """Least stiffness [N/m] of the spring that keeps the contact closed with the preload as it is; inf where no stiffness does.

    The greatest -Q0/x over the cycle, Q0 the force without the spring's stiffness, by Dinkelbach's iteration (recalled): the
    place where Q0 + k x is least gives the next k.
    """
    stiffness: Any = 0.0
    hopeless: Any = False
    for _ in range(STEPS):
        tried = load._replace(stiffness=stiffness)
        lowest = cycle.minimum(lambda _, lift, tried=tried: follower_force(reach * lift, tried, speed))
        x = reach * cycle.at(lowest.piece, lowest.angle)[1].d0
        settled = np.logical_or(hopeless, lowest.value >= -1e-13 * stiffness * np.abs(x))
        if np.all(settled):
            return np.where(hopeless, np.inf, stiffness)[()]
        hopeless = np.logical_or(hopeless, np.less_equal(x, 0) & ~settled)
        with np.errstate(divide="ignore", invalid="ignore"):  # of what is settled
            stiffness = np.where(settled | hopeless, stiffness, stiffness - np.divide(lowest.value, x))[()]
    raise SolverError("cam spring: the stiffness did not settle; give a preload and let the stiffness be.", partial=stiffness)


def jump_speed(cycle: Cycle, reach: Numbers, load: FollowerLoad) -> Any:
    """Least speed [rad/s] of the cam at which the follower loses contact; 0 where it does at rest, inf where it never does.

    m x'' w^2 + c x' w + (k x + P + F) = 0 gives a speed at every place; the place where the force at that speed is least gives the next.
    """
    rests = np.greater(cycle.minimum(lambda _, lift: follower_force(reach * lift, load, 0.0)).value, 0)
    at_samples = _separating_speed(cycle, reach, load, *cycle.samples())
    speed: Any = np.where(rests, np.min(at_samples, axis=-1, keepdims=np.ndim(at_samples) > 1), 0.0)[()]
    for _ in range(STEPS):
        finite = np.where(np.isfinite(speed), speed, 0.0)[()]
        lowest = cycle.minimum(lambda _, lift, speed=finite: follower_force(reach * lift, load, speed))
        lower = np.where(finite > 0, _separating_speed(cycle, reach, load, lowest.piece, lowest.angle), np.inf)
        faster = np.less(lower, finite * (1 - 1e-14))
        if not np.any(faster):
            return speed
        speed = np.where(faster, lower, speed)[()]
    raise SolverError(f"cam spring: the jump speed did not settle; it is below {np.max(speed):.6g} rad/s.", partial=speed)


def _separating_speed(cycle, reach, load, piece, angle):
    """Least positive root w of m x'' w^2 + c x' w + (k x + P + F) = 0 at each place; inf where there is none."""
    _, lift = cycle.at(piece, angle)
    a, b, c = load.mass * reach * lift.d2, load.damping * reach * lift.d1, load.stiffness * reach * lift.d0 + load.preload + load.force
    with np.errstate(divide="ignore", invalid="ignore"):
        speed = 2 * c / (np.sqrt(b**2 - 4 * a * c) - b)  # this form does not cancel for small a; the other root is larger or negative
    return np.where(speed > 0, speed, np.inf)
