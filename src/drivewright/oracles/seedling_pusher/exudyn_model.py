"""The cam pair as a multibody model in Exudyn: polyline cams, two rollers on a lever, a rod in the lever's slot.

Frame: the planting arm, cam axis at the origin, lever pivot on -y; both cams turn by minus the orbit angle of the pivot.
Only `verify` imports this: Exudyn is an optional dependency.
"""

from collections.abc import Callable
from typing import Any

import exudyn as exudyn_module
import numpy as np
from exudyn import itemInterface as item_interface

from drivewright.errors import SolverError
from drivewright.mechanisms.seedling_pusher.build import TURN, PusherModel
from drivewright.oracles.seedling_pusher.multibody_run import MultibodyRun
from drivewright.oracles.seedling_pusher.rolled_motion import roller_at_rest

exudyn: Any = exudyn_module  # its stubs take the numbers of items for modules
item: Any = item_interface

FACETS = 720  # per cam; rod error of the published design without push force: 180 give 0.09 mm, 360 0.026 mm, 720 and 1440 0.012 mm
STEPS = 5000  # per turn
STIFFNESS = 2e11  # contact force per area of overlap [N/m^2]; 2e9 gives 0.4 mm of rod error
LEVER_INERTIA = 1e-7  # the mass is the rod's; the solver needs a value above 0 here [kg m^2]


def simulate(model: PusherModel, planet: Callable[[Any], Any]) -> MultibodyRun:
    """One turn of the carrier from the start of the push, without play; `planet(t)` gives the pivot's orbit angle."""
    exudyn.config.printToConsole = False
    container = exudyn.SystemContainer()
    system = container.AddSystem()
    lever, lever_marker = _lever(system, model)
    rod = _rod(system, model, lever_marker)
    _cams(system, model, planet, lever)
    sensors = [
        system.AddSensor(
            item.SensorNode(
                nodeNumber=system.GetObject(body)["nodeNumber"],
                storeInternal=True,
                outputVariableType=exudyn.OutputVariableType.Coordinates,
            )
        )
        for body in (lever, rod)
    ]
    system.Assemble()
    _solve(system, TURN / model.spec.drive.speed)
    swing, travel = (system.GetSensorStoredData(sensor) for sensor in sensors)
    return MultibodyRun(swing[:, 0] * model.spec.drive.speed, -swing[:, 1], travel[:, 1])


def _lever(system, model):
    """(body, marker at the pivot) of the lever; a positive swing turns it clockwise."""
    node = system.AddNode(item.Node1D(referenceCoordinates=[0]))
    body = system.AddObject(
        item.ObjectRotationalMass1D(inertia=LEVER_INERTIA, nodeNumber=node, referencePosition=[0, -model.spec.lever.pivot_distance, 0])
    )
    return body, _marker(system, body)


def _rod(system, model, lever):
    """The rod: it slides along -y, with a pin in the slot of the lever, and is pushed back while it pushes."""
    spec, down = model.spec, [[0, 1, 0], [-1, 0, 0], [0, 0, 1]]
    start = [spec.lever.output_arm, -spec.lever.pivot_distance, 0]
    node = system.AddNode(item.Node1D(referenceCoordinates=[0]))
    body = system.AddObject(item.ObjectMass1D(mass=spec.load.mass, nodeNumber=node, referencePosition=start, referenceRotation=down))
    pin = _marker(system, body)
    system.AddObject(item.ObjectJointPrismatic2D(markerNumbers=[pin, lever], constrainRotation=False))
    time = spec.push.rise / spec.drive.speed

    def resistance(system, t, load):
        return [0, spec.load.push_force if t < time else 0, 0]

    system.AddLoad(item.LoadForceVector(markerNumber=pin, loadVectorUserFunction=resistance))
    return body


def _cams(system, model, planet, lever):
    """Both cams on one turning ground, each in contact with its roller."""
    ground = system.AddObject(item.ObjectGround(referenceRotation=_rotation(-model.pair.orbit * planet(model.pair.start))))
    cams, centre = _marker(system, ground), -1j * model.spec.lever.pivot_distance
    for cam in model.pair.cams:
        facets = _facets(model.pair.trimmed[cam.name])
        memory = system.AddNode(item.NodeGenericData(initialCoordinates=[-1, 0, 0] * FACETS, numberOfDataCoordinates=3 * FACETS))
        at_rest = roller_at_rest(cam) - centre
        roller = _marker(system, lever, [at_rest.real, at_rest.imag, 0])
        system.AddObject(
            item.ObjectContactCurveCircles(
                markerNumbers=[cams, roller],
                nodeNumber=memory,
                circlesRadii=[cam.roller_radius],
                contactModel=1,
                segmentsData=exudyn.MatrixContainer(facets),
                contactStiffness=STIFFNESS,
            )
        )

    def turn(system, t):
        angle = model.pair.orbit * planet(model.pair.start + model.spec.drive.speed * t)
        system.SetObjectParameter(ground, "referenceRotation", _rotation(-angle))
        return True

    system.SetPreStepUserFunction(turn)


def _facets(trimmed):
    """Segments (FACETS, 4) of a finished profile, counter-clockwise and equally long along it."""
    points = trimmed.outline(1e-8).points(1e-8)
    z = np.append(points @ (1, 1j), points[0] @ (1, 1j))
    along = np.append(0, np.cumsum(np.abs(np.diff(z))))
    corners = np.interp(np.linspace(0, along[-1], FACETS + 1), along, z)
    ends = np.column_stack([corners.real, corners.imag])
    return np.hstack([ends[:-1], ends[1:]])


def _marker(system, body, place=(0, 0, 0)):
    return system.AddMarker(item.MarkerBodyRigid(bodyNumber=body, localPosition=list(map(float, place))))


def _rotation(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])


def _solve(system, period):
    settings = exudyn.SimulationSettings()
    settings.timeIntegration.endTime, settings.timeIntegration.numberOfSteps = period, STEPS
    settings.timeIntegration.minimumStepSize = 1e-9  # it halves its steps where a roller changes from one facet to the next
    # The contact has no damping of its own: at 0.8 the lever hops from facet to facet at low speed, by 0.5 mm at the rod.
    settings.timeIntegration.generalizedAlpha.spectralRadius = 0.5
    settings.timeIntegration.verboseMode = 0
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = period / 2000
    try:
        system.SolveDynamic(settings)
    except Exception as error:  # Exudyn's own errors share no base class
        raise SolverError(f"verify: Exudyn did not solve the cam pair ({error}); try another drive.speed or a smaller push_force") from None
