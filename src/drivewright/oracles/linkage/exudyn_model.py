"""A planar multibody model in Exudyn: rigid bodies and constraints, a pin with dry play as a sphere in a hollow sphere.

Exudyn's contact, from its manual (ObjectContactSphereSphere):  F = K d^n (1 + 3/2 (1 - e) d'/d0') + c d'  while d > 0, with d0' the
speed at onset; it equals the law of `Dry` at e = 1 - 2 h/3, but is not kept from pulling.  Its friction grows in proportion to the
sliding speed up to a limit and is constant from there: Ambrosio's ramp without a dead range; its arms are shorter or longer
by d/2.  Only `verify`, tests and benchmarks import this: Exudyn is an optional dependency.
"""

from collections.abc import Iterable, Mapping
from functools import singledispatchmethod
from typing import Any, NamedTuple

import exudyn as exudyn_module
import numpy as np
from exudyn import itemInterface as item_interface

from drivewright._typing import Floats
from drivewright.errors import InputError, SolverError
from drivewright.multibody import model as mb
from drivewright.multibody.model import MultibodyModel

exudyn: Any = exudyn_module  # its stubs take the numbers of items for modules
item: Any = item_interface
LEAST_APPROACH = 1e-4  # floor of the speed at onset, as in the multibody kernel [m/s]


class Run(NamedTuple):
    """Times (m,) and, by body, (m, 6): x, y of the centroid, angle, and their rates."""

    time: Floats
    bodies: dict[str, Floats]


def run(model: MultibodyModel, start: Mapping[str, Iterable[float]], duration: float, step: float, samples: int = 200) -> Run:
    """Integrate `model` over `duration` [s] by the trapezoidal rule with constraints on velocity level, in steps of `step` [s].

    start: {body: (x, y, angle, vx, vy, angular velocity)} of every body's centroid, consistent with joints and drives.  A pin
    with play must start between centre and contact.  The histories have `samples` equal intervals.
    """
    twin = _Twin(model, start)
    for element in (*model.forces, *model.joints, *model.drives):
        twin.add(element)
    twin.system.Assemble()
    _solve(twin.system, duration, step, samples)
    return twin.histories()


class _Twin:
    """The Exudyn system of a model while it grows."""

    def __init__(self, model, start):
        exudyn.config.printToConsole = False
        self.model, self.start = model, {mb.GROUND: (0.0,) * 6, **{name: tuple(map(float, row)) for name, row in start.items()}}
        self.container = exudyn.SystemContainer()
        self.system = self.container.AddSystem()
        self.centroids = {mb.GROUND: (0.0, 0.0), **{body.name: body.centroid for body in model.bodies}}
        self.joints = {joint.name: joint for joint in model.joints}
        self.nodes = {mb.GROUND: self.system.AddNode(item.NodePointGround())}
        self.objects = {mb.GROUND: self.system.AddObject(item.ObjectGround())}
        self.sensors = {body.name: self._body(body) for body in model.bodies}

    def _body(self, body):
        row = self.start[body.name]
        node = self.system.AddNode(item.NodeRigidBody2D(referenceCoordinates=row[:3], initialVelocities=row[3:]))
        number = self.system.AddObject(item.ObjectRigidBody2D(mass=body.mass, inertia=body.inertia, nodeNumber=node))
        whole = self.system.AddMarker(item.MarkerBodyMass(bodyNumber=number))
        self.system.AddLoad(item.LoadMassProportional(markerNumber=whole, loadVector=[*map(float, self.model.gravity), 0.0]))
        self.nodes[body.name], self.objects[body.name] = node, number
        kinds = (exudyn.OutputVariableType.Coordinates, exudyn.OutputVariableType.Coordinates_t)
        return [self.system.AddSensor(item.SensorNode(nodeNumber=node, storeInternal=True, outputVariableType=kind)) for kind in kinds]

    def marker(self, place):
        """At a Marker of the model."""
        centroid = self.centroids[place.body]
        return self.system.AddMarker(
            item.MarkerBodyRigid(bodyNumber=self.objects[place.body], localPosition=[place.x - centroid[0], place.y - centroid[1], 0.0])
        )

    def angle_marker(self, body):
        """On the rotation of a body since the start."""
        return self.system.AddMarker(item.MarkerNodeCoordinate(nodeNumber=self.nodes[body], coordinate=0 if body == mb.GROUND else 2))

    def place(self, marker):
        """Where a Marker is at the start."""
        x, y, angle = self.start[marker.body][:3]
        cx, cy = self.centroids[marker.body]
        return complex(x, y) + complex(marker.x - cx, marker.y - cy) * np.exp(1j * angle)

    def histories(self):
        data = {name: [self.system.GetSensorStoredData(sensor) for sensor in pair] for name, pair in self.sensors.items()}
        time = next(iter(data.values()))[0][:, 0]
        return Run(time, {name: np.hstack([q[:, 1:] + self.start[name][:3], v[:, 1:]]) for name, (q, v) in data.items()})

    # -- one method per kind of element

    @singledispatchmethod
    def add(self, element: object) -> None:
        raise InputError(
            f"verify: the Exudyn model does not support {type(element).__name__} ('{getattr(element, 'name', '')}'); it supports revolute, "
            "prismatic and pin-slot joints, springs, constant torques and forces, and drives of constant speed."
        )

    @add.register
    def _(self, joint: mb.Revolute):
        if isinstance(joint.model, mb.Dry):
            self._contact(joint)
        elif isinstance(joint.model, mb.Ideal):
            self.system.AddObject(item.ObjectJointRevolute2D(markerNumbers=[self.marker(joint.first), self.marker(joint.second)]))
        else:
            raise InputError(
                f"verify: joint '{joint.name}' is a {type(joint.model).__name__}; the Exudyn model supports ideal and dry pins."
            )

    def _contact(self, joint):
        dry, gap = joint.model, _checked_gap(joint, self.place(joint.first) - self.place(joint.second))
        memory = self.system.AddNode(item.NodeGenericData(initialCoordinates=[gap, 0.0, 0.0, 0.0], numberOfDataCoordinates=4))
        self.system.AddObject(
            item.ObjectContactSphereSphere(
                markerNumbers=[self.marker(joint.second), self.marker(joint.first)],
                nodeNumber=memory,
                isHollowSphere1=True,
                spheresRadii=[dry.bearing_radius - dry.clearance, dry.bearing_radius],
                contactStiffness=dry.stiffness,
                contactStiffnessExponent=dry.exponent,
                contactDamping=dry.damping,
                minimumImpactVelocity=LEAST_APPROACH,
                restitutionCoefficient=1 - 2 * dry.hysteresis / 3,
                impactModel=1,
                dynamicFriction=dry.friction.coefficient if dry.friction.law != "none" else 0.0,
                frictionProportionalZone=dry.friction.speed,
            )
        )

    @add.register
    def _(self, joint: mb.Prismatic):
        self._slide(joint, True)

    @add.register
    def _(self, joint: mb.PinSlot):
        self._slide(joint, False)

    def _slide(self, joint, locked):
        along = complex(*joint.axis)
        turned = along * np.exp(1j * (self.start[joint.second.body][2] - self.start[joint.first.body][2]))
        self.system.AddObject(
            item.ObjectJointPrismatic2D(
                markerNumbers=[self.marker(joint.first), self.marker(joint.second)],
                constrainRotation=locked,
                axisMarker0=[turned.real, turned.imag, 0.0],
                normalMarker1=[-along.imag, along.real, 0.0],
            )
        )

    @add.register
    def _(self, spring: mb.PointSpring):
        self.system.AddObject(
            item.ObjectConnectorSpringDamper(
                markerNumbers=[self.marker(spring.first), self.marker(spring.second)],
                referenceLength=spring.free_length,
                stiffness=spring.stiffness,
                damping=spring.damping,
            )
        )

    @add.register
    def _(self, spring: mb.RotationalSpring):
        at_start = self.start[spring.first][2] - self.start[spring.second][2]
        self.system.AddObject(
            item.ObjectConnectorCoordinateSpringDamper(
                markerNumbers=[self.angle_marker(spring.second), self.angle_marker(spring.first)],
                stiffness=spring.stiffness,
                damping=spring.damping,
                offset=spring.rest - at_start,
            )
        )

    @add.register
    def _(self, torque: mb.AppliedTorque):
        value = _constant(torque.name, torque.load.curve)
        for body, moment in ((torque.body, value), (torque.on, -value)):
            marker = self.marker(mb.Marker(body, *self.centroids[body]))
            self.system.AddLoad(item.LoadTorqueVector(markerNumber=marker, loadVector=[0.0, 0.0, moment]))

    @add.register
    def _(self, force: mb.AppliedForce):
        value = _constant(force.name, force.load.curve)
        self.system.AddLoad(
            item.LoadForceVector(
                markerNumber=self.marker(force.point),
                loadVector=[value * force.direction[0], value * force.direction[1], 0.0],
                bodyFixed=force.follows,
            )
        )

    @add.register
    def _(self, drive: mb.JointDrive):
        joint = self.joints[drive.joint]
        if not isinstance(joint, mb.Revolute) or np.any(drive.motion.coefficients[:, 2:]) or np.ptp(drive.motion.coefficients[:, 1]):
            raise InputError(
                f"verify: the drive of '{drive.joint}' does not turn a revolute joint at constant speed; "
                "the Exudyn model supports no other drive."
            )
        first, second = joint.first.body, joint.second.body
        self.system.AddObject(
            item.ObjectConnectorCoordinate(
                markerNumbers=[self.angle_marker(second), self.angle_marker(first)],
                velocityLevel=True,
                offset=self.start[first][5] - self.start[second][5],
            )
        )


def _checked_gap(joint, eccentricity):
    """Gap at the start; refuses what Exudyn's contact cannot represent or start from."""
    dry = joint.model
    gap = dry.clearance - abs(eccentricity)
    if not 0 < gap < dry.clearance:
        raise InputError(
            f"verify: joint '{joint.name}' starts {abs(eccentricity):.3g} m off centre with a clearance of {dry.clearance:.3g} m; "
            "Exudyn must start between centre and contact. Give start poses with an eccentricity of half the clearance."
        )
    if dry.law is not None or dry.cylinder or not dry.hysteresis < 1.5:
        other = "the cylinder law" if dry.cylinder else f"a hysteresis of {dry.hysteresis:g}"
        law = other if dry.law is None else f"a law of its own, {type(dry.law).__name__},"
        raise InputError(
            f"verify: joint '{joint.name}' has {law}; Exudyn's contact is K d^n with a hysteresis below 1.5. "
            "Use another law or a higher restitution."
        )
    law, coefficient, dead = dry.friction.law, dry.friction.coefficient, dry.friction.dead_speed
    if law != "none" and coefficient and (law != "ambrosio" or dead):
        raise InputError(
            f"verify: joint '{joint.name}' has friction '{law}' with a dead speed of {dead:g} m/s; Exudyn's is a ramp from 0. "
            "Use 'ambrosio' with dead_speed 0."
        )
    return gap


def _constant(name, curve):
    if np.any(curve.coefficients[:, 1:]) or np.ptp(curve.coefficients[:, 0]):
        raise InputError(f"verify: '{name}' is not constant; the Exudyn model supports constant torques and forces only.")
    return float(curve.coefficients[0, 0])


def _solve(system, duration, step, samples):
    settings = exudyn.SimulationSettings()
    time = settings.timeIntegration
    time.endTime, time.numberOfSteps, time.verboseMode = duration, max(1, round(duration / step)), 0
    # The default tolerances lie below the rounding of a contact force of 1e10 N/m^1.5.
    time.newton.relativeTolerance, time.newton.absoluteTolerance = 1e-7, 1e-6
    # Its own advice on steps at an impact ends below any least step, or with a larger one in an answer off by 1e-5 m.
    time.discontinuous.useRecommendedStepSize = False
    time.minimumStepSize = 1e-11
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = duration / samples
    try:
        system.SolveDynamic(settings, solverType=exudyn.DynamicSolverType.TrapezoidalIndex2)
    except Exception as error:  # Exudyn's own errors share no base class
        raise SolverError(f"verify: Exudyn did not solve the linkage ({error}); use a smaller step.") from None
