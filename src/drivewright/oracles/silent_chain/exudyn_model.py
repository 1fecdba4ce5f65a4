"""A chain drive in Exudyn: rigid plates, sprockets that slide and turn, springs of hinges and the integration are Exudyn's.

What Exudyn does not have comes from `chain_forces`, by a user function: rolling joints, dampers that turn with the plates, involute
flanks, seats of rollers.  Its own contact of curves with circles (`ObjectContactCurveCircles`, version 1.13) cannot stand for these: it
turns every circle's force into a moment with the lever arm of the first circle's marker, which is wrong for all plates that lie at
another angle; the curve's own speed of rotation enters the rate of the gap with the wrong arm; and its force is a stiffness per length
of all segments that overlap the circle, so that the number of segments of an arc changes it.  Only `verify`, tests and benchmarks
import this: Exudyn is an optional dependency.
"""

from typing import Any, NamedTuple

import exudyn as exudyn_module
import numpy as np
from exudyn import itemInterface as item_interface

from drivewright._typing import Complexes, Floats
from drivewright.chains.explicit.assembly import Start
from drivewright.chains.model import ChainDrive
from drivewright.errors import InputError, SolverError
from drivewright.oracles.silent_chain.chain_forces import RollingJoints, ToothContacts, Wheels, plates_of, unknown

exudyn: Any = exudyn_module  # its stubs take the numbers of items for modules
item: Any = item_interface


class Run(NamedTuple):
    """Times (m,) [s]; per sprocket (m, sprockets) its place along its slide [m] and its angle [rad]; mass centres and angles of the plates
    (m, N, 3); tension of every joint (m, N) [N]."""

    time: Floats
    slides: Floats
    angles: Floats
    plates: Floats
    tension: Floats

    def centre(self, model: ChainDrive, number: int) -> Complexes:
        """Centre of a sprocket (m,), x + iy  [m]."""
        sprocket = model.sprockets[number]
        along = np.exp(1j * sprocket.slide.direction) if sprocket.slide else 0j
        return np.asarray(complex(*sprocket.centre) + self.slides[:, number] * along, complex)


def run(model: ChainDrive, begin: Start, duration: float, step: float, samples: int, solver: str = "RK44") -> Run:
    """The `Run` of a drive from `begin` over `duration` [s], by one of Exudyn's explicit solvers in steps of `step` [s] or less."""
    missing = unknown(model)
    if missing:
        raise InputError(
            f"verify: the chain has {missing}; the Exudyn model supports sprockets at constant speed or free, with linear contacts."
        )
    twin = _Twin(model, begin)
    every = max(1, round(duration / step / samples))
    twin.solve(every * samples, duration, samples, solver)
    return twin.history()


class _Wheel(NamedTuple):
    """A sprocket at the start: centre, direction of its slide, angle, the speed of a driven one; which of the coordinates behind those of
    the plates are its place and its angle."""

    centre: complex
    along: complex
    angle: float
    speed: float
    slides: int | None
    turns: int | None


class _Twin:
    """The Exudyn system of a drive."""

    def __init__(self, model, begin):
        exudyn.config.printToConsole = False
        self.model, self.begin, self.count = model, begin, model.chain.count
        self.joints, self.teeth = RollingJoints(model), ToothContacts(model)
        self.container = exudyn.SystemContainer()
        self.system = self.container.AddSystem()
        self.ground = self.system.AddMarker(item.MarkerNodeCoordinate(nodeNumber=self.system.AddNode(item.NodePointGround()), coordinate=0))
        self.start, nodes, bodies = self._plates()
        self.hinged = model.chain.link.radius == 0.0
        if self.hinged:
            self._hinges(bodies)
        self._articulations(nodes)
        self.wheels = [self._wheel(number, sprocket, nodes) for number, sprocket in enumerate(model.sprockets)]
        self._forces(nodes)
        self.sensor = self.system.AddSensor(item.SensorUserFunction(sensorUserFunction=self._state, storeInternal=True))
        self.system.Assemble()

    def _plates(self):
        """(poses of the mass centres (N, 3), nodes, bodies)."""
        offset, angle = self.model.chain.centre_offset, self.begin.poses[:, 2]
        up = offset * np.stack([-np.sin(angle), np.cos(angle), 0.0 * angle], axis=1)
        poses = self.begin.poses + up
        rates = self.begin.rates.copy()
        rates[:, 0] -= up[:, 1] * rates[:, 2]
        rates[:, 1] += up[:, 0] * rates[:, 2]
        nodes, bodies = [], []
        for pose, rate in zip(poses, rates, strict=True):
            nodes.append(self.system.AddNode(item.NodeRigidBody2D(referenceCoordinates=pose.tolist(), initialVelocities=rate.tolist())))
            mass, inertia = self.model.chain.mass, self.model.chain.inertia
            bodies.append(self.system.AddObject(item.ObjectRigidBody2D(mass=mass, inertia=inertia, nodeNumber=nodes[-1])))
            if any(self.model.gravity):
                whole = self.system.AddMarker(item.MarkerBodyMass(bodyNumber=bodies[-1]))
                self.system.AddLoad(item.LoadMassProportional(markerNumber=whole, loadVector=[*map(float, self.model.gravity), 0.0]))
        return poses, nodes, bodies

    def _hinges(self, bodies):
        """Joints of a chain that does not roll: a spring between two pins, in both directions.

        Its damper would take the rate in the frame at rest, ours is that in a frame that turns with the plates.
        """
        chain, halves, k = self.model.chain, 0.5 * self.model.chain.hole_pitches, self.model.chain.joint_stiffness
        for i in range(self.count):
            n = (i + 1) % self.count
            pins = [
                self.system.AddMarker(item.MarkerBodyPosition(bodyNumber=bodies[at], localPosition=[x, -chain.centre_offset, 0.0]))
                for at, x in ((i, halves[i]), (n, -halves[n]))
            ]
            self.system.AddObject(item.ObjectConnectorCartesianSpringDamper(markerNumbers=pins, stiffness=[k, k, 0.0]))

    def _articulations(self, nodes):
        if not self.model.chain.articulation_damping:
            return
        turns = [self.system.AddMarker(item.MarkerNodeCoordinate(nodeNumber=node, coordinate=2)) for node in nodes]
        for i in range(self.count):
            pair, damping = [turns[i], turns[(i + 1) % self.count]], self.model.chain.articulation_damping
            self.system.AddObject(item.ObjectConnectorCoordinateSpringDamper(markerNumbers=pair, damping=damping))

    def _coordinate(self, nodes, place, rate):
        """(place among the `nodes` of the user function, marker) of a new coordinate."""
        node = self.system.AddNode(item.Node1D(referenceCoordinates=[place], initialVelocities=[rate]))
        nodes.append(node)
        return node, self.system.AddMarker(item.MarkerNodeCoordinate(nodeNumber=node, coordinate=0))

    def _wheel(self, number, sprocket, nodes):
        along = np.exp(1j * sprocket.slide.direction) if sprocket.slide else 0j
        centre = complex(*sprocket.centre) + float(self.begin.q[number]) * along
        slides, turns = self._slide(number, sprocket, nodes), self._turn(number, sprocket, nodes)
        speed = sprocket.drive.speed if sprocket.drive else 0.0
        return _Wheel(centre, along, float(self.begin.psi[number]), speed, slides, turns)

    def _slide(self, number, sprocket, nodes):
        """Number of the place along the slide among the coordinates behind those of the plates, or None."""
        slide = sprocket.slide
        if not slide:
            return None
        place, rate = float(self.begin.q[number]), float(self.begin.rate_q[number])
        node, marker = self._coordinate(nodes, place, rate)
        self.system.AddObject(item.ObjectMass1D(mass=sprocket.mass, nodeNumber=node))
        weight = sprocket.mass * float(np.dot(self.model.gravity, (np.cos(slide.direction), np.sin(slide.direction))))
        self.system.AddLoad(item.LoadCoordinate(markerNumber=marker, load=slide.force + weight))
        self.system.AddObject(
            item.ObjectConnectorCoordinateSpringDamper(
                markerNumbers=[self.ground, marker], stiffness=slide.stiffness, damping=slide.damping, offset=-place
            )
        )
        return len(nodes) - 1 - self.count

    def _turn(self, number, sprocket, nodes):
        """Number of the angle among the coordinates behind those of the plates, or None where it is driven."""
        if sprocket.drive:
            return None
        angle, rate = float(self.begin.psi[number]), float(self.begin.rate_psi[number])
        node, marker = self._coordinate(nodes, angle, rate)
        self.system.AddObject(item.ObjectRotationalMass1D(inertia=sprocket.inertia, nodeNumber=node))
        self.system.AddLoad(item.LoadCoordinate(markerNumber=marker, load=sprocket.torque + sprocket.damping * sprocket.reference_speed))
        self.system.AddObject(item.ObjectConnectorCoordinateSpringDamper(markerNumbers=[self.ground, marker], damping=sprocket.damping))
        return len(nodes) - 1 - self.count

    def _forces(self, nodes):
        """What comes from `chain_forces`, on all coordinates at once."""
        plates, load = 3 * self.count, np.zeros(2 * self.count + len(nodes))

        def force(system, time, number, q, rates):
            """Forces on all coordinates, from the coordinates off the start and their rates."""
            load[:] = 0.0
            q, rates = np.asarray(q), np.asarray(rates)
            chain, own = plates_of(self.start + q[:plates].reshape(-1, 3), rates[:plates].reshape(-1, 3)), load[:plates].reshape(-1, 3)
            if self.joints.damping or not self.hinged:
                self.joints.add(chain, own, springs=not self.hinged)
            pulls, moments = self.teeth.add(chain, self._moved(time, q[plates:], rates[plates:]), own)
            for wheel, pull, moment in zip(self.wheels, pulls, moments, strict=True):
                if wheel.slides is not None:
                    load[plates + wheel.slides] = (pull * np.conj(wheel.along)).real
                if wheel.turns is not None:
                    load[plates + wheel.turns] = moment
            return load

        self.system.AddObject(item.ObjectGenericODE2(nodeNumbers=nodes, forceUserFunction=force))

    def _moved(self, time, q, rates):
        """`Wheels` from the coordinates behind those of the plates."""
        rows = []
        for wheel in self.wheels:
            centre, velocity, angle, spin = wheel.centre, 0j, wheel.angle + wheel.speed * time, wheel.speed
            if wheel.slides is not None:
                centre, velocity = centre + q[wheel.slides] * wheel.along, rates[wheel.slides] * wheel.along
            if wheel.turns is not None:
                angle, spin = wheel.angle + q[wheel.turns], rates[wheel.turns]
            rows.append((centre, velocity, angle, spin))
        centre, velocity, angle, spin = zip(*rows, strict=True)
        return Wheels(np.array(centre), np.array(velocity), np.array(angle), np.array(spin))

    def _state(self, system, time, sensors, factors, configuration):
        """All coordinates and their rates."""
        return np.concatenate([system.systemData.GetODE2Coordinates(), system.systemData.GetODE2Coordinates_t()])

    def solve(self, steps, duration, samples, solver):
        """Run `steps` steps over a duration [s] with one of Exudyn's solvers, writing so many samples."""
        settings = exudyn.SimulationSettings()
        time = settings.timeIntegration
        time.endTime, time.numberOfSteps, time.verboseMode = duration, steps, 0
        time.explicit.computeEndOfStepAccelerations = False
        settings.linearSolver.solverType = exudyn.LinearSolverType.EigenSparse
        settings.solution.file.write = False
        settings.solution.sensors.writePeriod = duration / samples
        try:
            self.system.SolveDynamic(settings, solverType=getattr(exudyn.DynamicSolverType, solver))
        except Exception as error:  # Exudyn's own errors share no base class
            raise SolverError(f"verify: Exudyn failed to run the chain ({error}); try a smaller step.") from None

    def history(self):
        """The `Run` from what the sensor has seen."""
        data = self.system.GetSensorStoredData(self.sensor)
        time, plates, half = data[:, 0], 3 * self.count, (data.shape[1] - 1) // 2
        q, rates = data[:, 1 : 1 + half], data[:, 1 + half :]
        poses = self.start + q[:, :plates].reshape(len(time), -1, 3)
        spins = rates[:, :plates].reshape(len(time), -1, 3)
        tension = np.array([self.joints.tension(plates_of(*both)) for both in zip(poses, spins, strict=True)])
        slides, angles = (np.tile(first, (len(time), 1)) for first in (self.begin.q, self.begin.psi))
        for number, wheel in enumerate(self.wheels):
            if wheel.slides is not None:
                slides[:, number] += q[:, plates + wheel.slides]
            angles[:, number] += wheel.speed * time if wheel.turns is None else q[:, plates + wheel.turns]
        return Run(time, slides, angles, poses, tension)
