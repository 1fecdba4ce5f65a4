"""Forces of a cam drive: force that the motion of the follower requires, contact force, torque on the shaft, required spring force.

Everything that acts on the follower is reduced to one coordinate x [m], its travel; x = reach * lift.  No friction.
A `LoadPath` says where the load acts: on the follower itself, or at a valve that a second arm drives.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from drivewright._typing import Numbers
from drivewright.cams.cycle import Cycle
from drivewright.cams.followers import CamContact
from drivewright.cams.valve import GuidedArm
from drivewright.curves import derivative
from drivewright.errors import SolverError
from drivewright.numerics.jets import Jet, constant

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


@dataclass(frozen=True)
class LoadPath:
    """Where the load of a follower acts, and what the follower itself weighs.

    reach: travel of the follower x [m] per lift [m or rad]; arm: the second arm of a rocker, at whose valve the load acts, otherwise the
    load acts along x; inertia: of an oscillating follower about its pivot [kg m^2].  Of many designs columns (n, 1).
    """

    reach: Numbers = 1.0
    arm: GuidedArm | None = None
    inertia: Numbers = 0.0

    def travel(self, lift: Jet) -> Jet:
        """Travel y [m] of what carries the load, a jet of the cam angle."""
        return self.arm.lift(lift) if self.arm else self.reach * lift

    def ratio(self, lift: Jet) -> Jet:
        """dy/dx: travel of the load per travel of the follower, a jet."""
        return self.arm.ratio(lift) / self.reach if self.arm else constant(np.ones_like(lift.d0))

    def force(self, lift: Jet, load: FollowerLoad, speed: Numbers) -> Jet:
        """Q = Q_load dy/dx + J/reach^2 w^2 x'' [N]: the force that the cam must exert along the follower's travel, a jet."""
        own = FollowerLoad(mass=self.inertia / np.square(self.reach))
        at_load = follower_force(self.travel(lift), load, speed)
        along = self.ratio(lift) * at_load if self.arm else at_load
        return along + follower_force(self.reach * lift, own, speed) if np.any(self.inertia) else along


AddedForce: TypeAlias = Callable[[Jet, Jet], Jet]  # force [N] along the follower's travel beside that of the load, of angle and lift


def cam_normal_force(required: Jet, contact: CamContact) -> Jet:
    """N = Q/leverage [N]: force between the surfaces from the force along the travel; both jets."""
    return required / contact.leverage


def drive_torque(travel: Jet, required: Jet) -> Jet:
    """T = Q dx/dtheta [N m] that the cam shaft must be given, from the power balance T w = Q v."""
    return required * derivative(travel)


def needed_preload(cycle: Cycle, path: LoadPath, load: FollowerLoad, speed: Numbers, also: AddedForce | None = None) -> Any:
    """Least preload [N] of the spring that keeps the contact closed with the stiffness as it is; 0 where none is needed."""

    def missing(angle, lift):
        """Preload at the load that would just close the contact."""
        force = path.force(lift, load._replace(preload=0.0), speed)
        return -(force + also(angle, lift) if also else force) / path.ratio(lift)

    return np.maximum(cycle.maximum(missing).value, 0.0)


def needed_stiffness(cycle: Cycle, path: LoadPath, load: FollowerLoad, speed: Numbers) -> Any:
    """Least stiffness [N/m] of the spring that keeps the contact closed with the preload as it is; inf where no stiffness does.

    The greatest -Q0/(y dy/dx) over the cycle, Q0 the force without the spring's stiffness, by Dinkelbach's iteration (recalled): the
    place where Q0 + k y dy/dx is least gives the next k.
    """
    stiffness: Any = 0.0
    hopeless: Any = False
    for _ in range(STEPS):
        tried = load._replace(stiffness=stiffness)
        lowest = cycle.minimum(lambda _, lift, tried=tried: path.force(lift, tried, speed))
        lift = cycle.at(lowest.piece, lowest.angle)[1]
        x = path.travel(lift).d0 * path.ratio(lift).d0
        settled = np.logical_or(hopeless, lowest.value >= -1e-13 * stiffness * np.abs(x))
        if np.all(settled):
            return np.where(hopeless, np.inf, stiffness)[()]
        hopeless = np.logical_or(hopeless, np.less_equal(x, 0) & ~settled)
        with np.errstate(divide="ignore", invalid="ignore"):  # of what is settled
            stiffness = np.where(settled | hopeless, stiffness, stiffness - np.divide(lowest.value, x))[()]
    raise SolverError(
        "cam spring: the required stiffness did not converge; give a preload and keep the stiffness fixed.", partial=stiffness
    )


class Jump(NamedTuple):
    """Speed [rad/s] of the cam from which on the follower loses contact, and the cam angle [rad] where it does; of many designs columns.

    0 where it does at rest, inf where it never does (then the angle is nan).
    """

    speed: Numbers
    angle: Numbers


def jump(cycle: Cycle, path: LoadPath, load: FollowerLoad) -> Jump:
    """The `Jump` of a follower whose spring has no mass.

    The force Q = A w^2 + B w + C is 0 at one speed at every place; the place where Q at that speed is least gives the next.
    """
    at_rest = cycle.minimum(lambda _, lift: path.force(lift, load, 0.0))
    rests = np.greater(at_rest.value, 0)
    at_samples = _separating_speed(path, load, cycle.at(*cycle.samples())[1])
    speed: Any = np.where(rests, np.min(at_samples, axis=-1, keepdims=np.ndim(at_samples) > 1), 0.0)[()]
    for _ in range(STEPS):
        finite = np.where(np.isfinite(speed), speed, 0.0)[()]
        lowest = cycle.minimum(lambda _, lift, speed=finite: path.force(lift, load, speed))
        lower = np.where(finite > 0, _separating_speed(path, load, cycle.at(lowest.piece, lowest.angle)[1]), np.inf)
        faster = np.less(lower, finite * (1 - 1e-14))
        if not np.any(faster):
            return Jump(speed, np.where(np.isfinite(speed), lowest.angle, np.nan)[()])
        speed = np.where(faster, lower, speed)[()]
    raise SolverError(f"cam spring: the jump speed did not converge; it is below {np.max(speed):.6g} rad/s.", partial=speed)


def _separating_speed(path, load, lift):
    """Least positive root w of the force A w^2 + B w + C = 0 at each place; inf where there is none."""
    still, unit = load._replace(mass=0.0, damping=0.0), FollowerLoad(mass=load.mass)
    a = path.force(lift, unit, 1.0).d0
    b = (path.ratio(lift) * follower_force(path.travel(lift), FollowerLoad(damping=load.damping), 1.0)).d0
    c = path.force(lift, still, 0.0).d0
    with np.errstate(divide="ignore", invalid="ignore"):
        speed = 2 * c / (np.sqrt(b**2 - 4 * a * c) - b)  # this form does not cancel for small a; the other root is larger or negative
    return np.where(speed > 0, speed, np.inf)
