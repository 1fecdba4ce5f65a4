"""What drives and motors give over time: force or torque, and the rate of the joint that they move."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.multibody.analyses.simulation_model import SimulationModel
from drivewright.multibody.curves import curve_values
from drivewright.multibody.forces.actuator import LinearActuator
from drivewright.multibody.forces.load import AppliedTorque
from drivewright.multibody.locking import refuse_locked
from drivewright.multibody.observe import Observed, concatenate, observe
from drivewright.multibody.reactions import drive_wrench, observed_bodies
from drivewright.multibody.simulate import Run, states_outside_folds
from drivewright.multibody.wrenches import NORMAL_OF, ObservedBodies


class Actuation(NamedTuple):
    """Of one drive or motor: torque [N m] or force [N] (m,) and the rate [rad/s] or [m/s] (m,) of its joint; its power is their product."""

    name: str
    turns: bool
    effort: Floats
    rate: Floats

    @property
    def power(self) -> Floats:
        """Given to the mechanism (m,) [W]."""
        return self.effort * self.rate


def observe_run(model: SimulationModel, run: Run, start: float = -np.inf) -> Observed:
    """`Observed` of a run from a time on, without the middles of folds; InputError where friction locks it."""
    parts = []
    for system, t, y in states_outside_folds(run, start):
        parts.append(observe(system, t, y))
        refuse_locked(model.assembly, system, t, y, parts[-1].frictions)
    return concatenate(parts)


def actuations(model: SimulationModel, observed: Observed) -> list[Actuation]:
    """The `Actuation` of every drive, then of every motor, in observed states."""
    return [*_drives(model, observed), *_motors(model, observed)]


def _drives(model: SimulationModel, observed: Observed) -> Iterator[Actuation]:
    expanded, places = model.assembly.expanded, observed_bodies(model.assembly, observed)
    names = [drive.joint for drive in model.assembly.model.drives]
    for number, (name, drive) in enumerate(zip(names, expanded.drives, strict=True)):
        joint = next(one for one in expanded.joints if one.name == drive.joint)
        wrench = drive_wrench(joint, places)
        rate = sum((torque * places.field(body, "w") for body, torque in wrench.torques.items()), np.zeros(len(observed.t)))
        if wrench.force is not None and wrench.point is not None:
            moved = velocity_at(places, wrench.first, wrench.point) - velocity_at(places, wrench.second, wrench.point)
            rate = np.sum(wrench.force * moved, axis=1)
        yield Actuation(name, joint.driven_motion == "rotation", observed.drives[:, number], rate)


def velocity_at(places: ObservedBodies, body: str, point: Floats) -> Floats:
    """Velocity (m, 2) of the material point of a body that is at (m, 2) in the world."""
    velocity = np.stack([places.field(body, "vx"), places.field(body, "vy")], axis=-1)
    return velocity + places.field(body, "w")[:, None] * (point - places.centre(body)) @ NORMAL_OF


def _motors(model: SimulationModel, observed: Observed) -> Iterator[Actuation]:
    places = observed_bodies(model.assembly, observed)
    for element in model.assembly.model.forces:
        if element.name not in model.motors:
            continue
        if isinstance(element, AppliedTorque):
            turned, rate = (places.field(element.body, name) - places.field(element.on, name) for name in ("angle", "w"))
            yield Actuation(model.motors[element.name], True, element.load.values(observed.t, turned, rate), rate)
        elif isinstance(element, LinearActuator):
            along = places.rotated(element.second.body, np.array(element.axis) / np.hypot(*element.axis))
            point = places.point(element.first)
            travel = np.sum(along * (point - places.point(element.second)), axis=1)
            rate = np.sum(along * (places.velocity(element.first) - velocity_at(places, element.second.body, point)), axis=1)
            at = {"time": observed.t, "travel": travel, "velocity": rate}[element.load.over]
            yield Actuation(model.motors[element.name], False, curve_values(element.load.curve, at), rate)
