"""The Geneva drive once more: as a multibody system, by differences, as polygons cut from a disc, and by integration over time.

Rows are tuples (name, ours, other, unit, allowed difference, route) in SI.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from drivewright import materials
from drivewright._typing import Floats
from drivewright.indexing.geneva.forces import PinFriction, pin_forces
from drivewright.mechanisms.geneva.build import GenevaModel
from drivewright.mechanisms.geneva.loads import turn_forces
from drivewright.multibody import AppliedTorque, Body, JointDrive, LoadCurve, Marker, MultibodyModel, PinSlot, Revolute, assemble, line
from drivewright.multibody.model import GROUND
from drivewright.multibody.observe import FIELDS, observe
from drivewright.multibody.reactions import reactions
from drivewright.multibody.simulate import simulate
from drivewright.numerics.quadrature import trapezoid
from drivewright.registry import Row
from drivewright.result import Result

ENGINE = "multibody system of crank, pin in slot and wheel without friction; reactions by Newton's and Euler's equations"
DIFFERENCES = "differences of the angle over time"
POLYGONS = "polygons: slots and locking arcs cut from a disc"
APART = "distance of the polygons of disc and wheel, turned from entry to the line of centres"
MOMENTS = "power of the crank against that of the wheel and the losses"
FLIGHT = "wheel that moves freely, integrated over time"
INSIDE = 0.98  # of the engagement that the multibody system runs over
STATES = 201
QUARTER = 256  # chords of a quarter of a circle
PLACES = 25  # crank angles at which disc and wheel are looked at


def verify(model: GenevaModel, result: Result[Any]) -> Iterator[Row]:
    """All rows."""
    yield from _multibody(model)
    yield from _differences(model)
    yield from _powers(model, result)
    yield from _cut_wheel(model, result)
    yield from _apart(model, result)
    yield from _flight(model, result)


# -- dynamics --------------------------------------------------------------------------------------------------------------------


def _multibody(model: GenevaModel) -> Iterator[Row]:
    """Angle, acceleration, pin force and crank torque at the mean speed of the crank."""
    step, speed, load = model.step, model.crank.mean_speed, model.spec.load
    start = -INSIDE * step.half_engagement
    resisting = load.friction_torque + load.process_torque
    assembly = assemble(_system(model, start, resisting))
    run = simulate(assembly, 2 * abs(start) / speed, samples=np.linspace(0.0, 2 * abs(start) / speed, STATES))
    ((system, t, y),) = [(each.system, each.t, each.y) for each in run.stretches]
    observed = observe(system, t, y)
    found = reactions(assembly, system, observed)
    bodies = observed.bodies[:, list(assembly.names).index("wheel")]
    theta = start + speed * np.asarray(t)
    over = step.pin_direction(theta)
    torque = model.inertia * over.d2 * speed**2 + resisting
    ours = pin_forces(step, model.spec.pin.radius, PinFriction(), theta, speed + 0 * theta, over.d1 * speed, torque)
    turned = -(bodies[:, FIELDS.index("angle")] - bodies[0, FIELDS.index("angle")])
    yield _worst("angle of the wheel at the maximum difference", over.d0 - over.d0[0], turned, "rad", 1e-9, ENGINE)
    alpha = -bodies[:, FIELDS.index("alpha")]
    yield _worst("acceleration of the wheel at the maximum difference", over.d2 * speed**2, alpha, "rad/s^2", 1e-9, ENGINE)
    force = np.hypot(*found.joints["slot"].force.T)
    yield _worst("pin force without friction at the maximum difference", np.abs(ours.normal), force, "N", 1e-8, ENGINE)
    yield _worst("crank torque without friction at the maximum difference", ours.crank_torque, found.drives[:, 0], "N m", 1e-8, ENGINE)


def _system(model, start, resisting):
    """Crank at constant speed, wheel with all that turns with it; the crank stands at `start` [rad]."""
    step = model.step
    bodies = (Body("crank", 1.0, 1e-3, angle=start), Body("wheel", 1.0, model.inertia, angle=np.pi - float(step.pin_direction(start).d0)))
    joints = (
        Revolute("O1", Marker(GROUND), Marker("crank")),
        Revolute("O2", Marker(GROUND, step.centre_distance), Marker("wheel")),
        PinSlot("slot", Marker("crank", step.crank_radius), Marker("wheel"), (1.0, 0.0)),
    )
    torque = AppliedTorque("load", "wheel", LoadCurve(line(resisting, 0.0)))
    return MultibodyModel(bodies, joints, (torque,), (JointDrive("O1", line(0.0, model.crank.mean_speed)),))


def _worst(name, ours, other, unit, tolerance, route) -> Row:
    """The row of two histories, where they differ most."""
    at = int(np.argmax(np.abs(ours - other)))
    return name, float(ours[at]), float(other[at]), unit, tolerance * float(np.max(np.abs(ours))) + 1e-12, route


def _differences(model: GenevaModel) -> Iterator[Row]:
    """Speed, acceleration and jerk of the wheel over time."""
    step, crank = model.step, model.crank
    ends = [crank.part_at(side * INSIDE * step.half_engagement) for side in (-1, 1)]
    u = np.linspace(ends[0], ends[1], STATES)
    h = 1e-3 * (ends[1] - ends[0])
    before, here, after = (step.pin_direction(crank.at(u + k * h)[0]).d0 for k in (-1, 0, 1))
    angle, speed, acceleration, _ = crank.at(u)
    over, dt = step.pin_direction(angle), h * crank.period
    yield _worst("speed of the wheel at the maximum difference", over.d1 * speed, (after - before) / (2 * dt), "rad/s", 1e-4, DIFFERENCES)
    ours = over.d2 * speed**2 + over.d1 * acceleration
    yield _worst(
        "acceleration over time at the maximum difference", ours, (after - 2 * here + before) / dt**2, "rad/s^2", 1e-4, DIFFERENCES
    )


def _powers(model: GenevaModel, result: Result[Any]) -> Iterator[Row]:
    """Torque at the crank with friction, by the moment of the forces and by the balance of power; its mean over the turn."""
    turn, samples, wheel = turn_forces(model), model.samples, model.wheel_by_time
    moving = samples.engaged & (samples.speed > 0)
    ours = turn.pin.crank_torque[moving]
    power = turn.pin.wheel_torque * wheel.d1 + turn.pin.pin_loss
    yield _worst("crank torque with friction at the maximum difference", ours, power[moving] / samples.speed[moving], "N m", 1e-9, MOMENTS)
    if "crank.mean_power" in result.values and model.step.excess <= 1e-9:
        load = model.spec.load
        given = (load.friction_torque + load.process_torque) * 2 * model.step.half_pitch
        lost = trapezoid(turn.pin.pin_loss + turn.pin.bearing_torque * wheel.d1, samples.time)
        mean = (given + float(lost)) / model.crank.period
        yield "crank.mean_power", result["crank.mean_power"], mean, "W", 1e-4 * result["crank.peak_power"], MOMENTS


# -- solids ----------------------------------------------------------------------------------------------------------------------


def _disc(centre: complex, radius: float) -> Any:
    from shapely import Point

    return Point(centre.real, centre.imag).buffer(radius, quad_segs=QUARTER)


def _wheel(model: GenevaModel) -> Any:
    """The wheel as a disc from which slots and locking arcs are cut."""
    from shapely import LineString

    shape, step = model.shape, model.step
    body = _disc(0j, shape.outer_radius)
    for number in range(step.slots):
        along = np.exp(2j * step.half_pitch * number)
        start, end = shape.slot_end * along, 2 * shape.outer_radius * along
        slot = LineString([(start.real, start.imag), (end.real, end.imag)]).buffer(shape.slot_width / 2, quad_segs=QUARTER)
        arc = _disc(complex(step.centre_distance * along * np.exp(1j * step.half_pitch)), shape.arc_radius)
        body = body.difference(slot).difference(arc)
    return max(body.geoms, key=lambda piece: piece.area) if hasattr(body, "geoms") else body


def _polar_moment(corners: Floats) -> float:
    """Polar moment of area [m^4] of a polygon about the origin, by its triangles to the origin."""
    a, b = corners[:-1], corners[1:]
    cross = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    return float(abs(np.sum(cross * (np.sum(a * a, axis=1) + np.sum(a * b, axis=1) + np.sum(b * b, axis=1)))) / 12)


def _cut_wheel(model: GenevaModel, result: Result[Any]) -> Iterator[Row]:
    """Mass and moment of inertia of the wheel with bore and hub."""
    if "wheel.mass" not in result.values:
        return
    body, wheel = _wheel(model), model.spec.wheel
    density = materials.material(wheel.material).density
    area, polar = body.area * wheel.thickness, _polar_moment(np.array(body.exterior.coords)) * wheel.thickness
    long = wheel.thickness
    if wheel.hub_diameter:
        hub, long = wheel.hub_diameter / 2, wheel.thickness + wheel.hub_length
        area, polar = area + np.pi * hub**2 * wheel.hub_length, polar + np.pi * hub**4 / 2 * wheel.hub_length
    if wheel.bore:
        bore = wheel.bore / 2
        area, polar = area - np.pi * bore**2 * long, polar - np.pi * bore**4 / 2 * long
    mass, inertia = result["wheel.mass"], result["wheel.inertia"]
    yield "wheel.mass", mass, float(density * area), "kg", 1e-4 * mass, POLYGONS
    yield "wheel.inertia", inertia, float(density * polar), "kg m^2", 1e-4 * inertia, POLYGONS


def _apart(model: GenevaModel, result: Result[Any]) -> Iterator[Row]:
    """Least distance of disc and wheel over the step, where they do not overlap."""
    if result.values.get("locking.clearance") is None or result["locking.clearance"] <= 0:
        return
    from shapely import Polygon
    from shapely.affinity import rotate, translate

    shape, step = model.shape, model.step
    wheel = _wheel(model)
    disc = _disc(0j, shape.locking_radius)
    relief = _disc(complex(*shape.disc_relief.center), shape.disc_relief.radius)
    disc = disc.difference(relief)
    least = np.inf
    for theta in np.linspace(-step.half_engagement, 0.0, PLACES):
        turned = translate(rotate(wheel, np.pi - float(step.pin_direction(theta).d0), (0, 0), use_radians=True), step.centre_distance)
        least = min(least, rotate(disc, theta, (0, 0), use_radians=True).distance(turned))
    assert isinstance(wheel, Polygon)
    chord = max(shape.outer_radius, shape.arc_radius) * (np.pi / 4 / QUARTER) ** 2
    yield "locking.clearance", result["locking.clearance"], float(least), "m", 4 * chord, APART


# -- clearance -------------------------------------------------------------------------------------------------------------------


def _flight(model: GenevaModel, result: Result[Any]) -> Iterator[Row]:
    """Speed at which the other side of the slot meets the pin."""
    clearance = model.shape.slot_clearance
    if "crossing.speed" not in result.values or clearance <= 0 or result["crossing.speed"] <= 0:
        return
    step, load = model.step, model.spec.load
    speed = float(model.crank.at(np.array(model.crank.part_at(0.0)))[1])
    braking = -(load.friction_torque + load.process_torque) / model.inertia
    theta = np.linspace(-step.half_engagement, step.half_engagement, 200001)
    bend = step.pin_direction(theta).d2 * speed**2
    start = theta[int(np.flatnonzero((bend[:-1] >= braking) & (bend[1:] < braking))[0])]
    first = step.pin_direction(start)

    def across(t, state):
        at = start + speed * t
        return float(step.pin_distance(at) * (state[0] - step.pin_direction(at).d0)) - clearance

    across.terminal = True  # pyright: ignore[reportFunctionMemberAccess]  # as solve_ivp reads it
    horizon = (step.half_engagement - start) / speed
    flown = solve_ivp(
        lambda t, state: (state[1], braking),
        (0.0, horizon),
        (float(first.d0), float(first.d1 * speed)),
        events=across,
        rtol=1e-11,
        atol=1e-14,
        max_step=horizon / 200,
    )
    if not len(flown.t_events[0]):
        return
    t, (phi, rate) = float(flown.t_events[0][0]), flown.y_events[0][0]
    at = start + speed * t
    now, rho = step.pin_direction(at), float(step.pin_distance(at))
    met = rho * (rate - float(now.d1) * speed) + float(step.pin_travel_rate(at)) * speed * (phi - float(now.d0))
    yield "crossing.speed", result["crossing.speed"], met, "m/s", 1e-3 * result["crossing.speed"], FLIGHT
