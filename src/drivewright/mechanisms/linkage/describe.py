"""From the tables of the spec to the frozen description that the multibody kernel reads."""

import math

from drivewright import plugins
from drivewright.contact.impact import impact_law_names
from drivewright.contact.laws import contact_law_names
from drivewright.errors import SpecError
from drivewright.mechanisms.linkage.joints import NORMALS, Joint
from drivewright.mechanisms.linkage.spec import LinkageSpec
from drivewright.mechanisms.linkage.tables import CENTROID, GROUND, LinkageDrive, LinkageOutput, central_inertia, place, points_of
from drivewright.multibody import model
from drivewright.multibody.bodies import Marker
from drivewright.multibody.curve_files import actuator_curve, delayed, lift_curve, load_curve, profile_curve
from drivewright.multibody.forces.contact import Dry
from drivewright.multibody.forces.dry_contact import dry_contact
from drivewright.multibody.forces.joint_friction import JointFriction
from drivewright.multibody.model import MultibodyModel
from drivewright.spec.csv_columns import PURE


def describe(spec: LinkageSpec, ideal: bool = False) -> MultibodyModel:
    """The multibody `Model` of a LinkageSpec; `ideal` takes the play out of every joint."""
    bodies = tuple(_body(name, body) for name, body in spec.bodies.items())
    joints = tuple(_joint(spec, joint, ideal) for joint in spec.joints)
    drives, motors = _drives(spec)
    return model.MultibodyModel(bodies, joints, (*_forces(spec), *motors), drives, spec.gravity)


def _body(name, body):
    inertia = max(central_inertia(body), 0.0)  # the spec allows for rounding only
    return model.Body(name, body.mass, inertia, body.centroid, body.angle, body.velocity, body.angular_velocity)


def marker(spec: LinkageSpec, text: str) -> Marker:
    """The Marker of "BODY.POINT"."""
    body, point = place(text)
    return model.Marker(body, *points_of(spec, body)[point or CENTROID])


# -- joints --------------------------------------------------------------------------------------------------------------------


def _joint(spec, joint, ideal):
    if joint.kind in JOINTS:
        return JOINTS[joint.kind](spec, joint, ideal)
    return plugins.load("drivewright.joints", joint.kind, "kind of joint")(joint, *_markers(spec, joint))


def _markers(spec, item) -> tuple[Marker, Marker]:
    first, second = item.connects
    return marker(spec, first), marker(spec, second)


def _revolute(spec, joint, ideal):
    pin = model.Ideal() if ideal else PINS[joint.pin](spec, joint)
    rub = joint_friction(joint) if joint.is_ideal and not ideal else None
    return model.Revolute(joint.name, *_markers(spec, joint), pin, rub)


def _prismatic(spec, joint, ideal):
    return model.Prismatic(joint.name, *_markers(spec, joint), _unit(joint.axis), None if ideal else joint_friction(joint))


def _pin_slot(spec, joint, ideal):
    return model.PinSlot(joint.name, *_markers(spec, joint), _unit(joint.axis), None if ideal else joint_friction(joint))


def _rolling(spec, joint, ideal):
    resistance = None if ideal else joint_friction(joint)
    return model.Rolling(joint.name, *_markers(spec, joint), joint.radius, _unit(joint.axis), joint.track_radius, resistance)


def _gear(spec, joint, ideal):
    first, second = joint.connects
    return model.Gear(joint.name, first, second, joint.ratio, place(joint.carrier)[0])


def _cam(spec, joint, ideal):
    lift, turns = lift_curve(joint.lift)
    carrier, point = place(joint.carrier)
    origin = points_of(spec, carrier)[point] if point else (0.0, 0.0)
    cam, follower = joint.connects
    return model.CamPair(joint.name, cam, marker(spec, follower), lift, carrier, origin, None if turns else _unit(joint.axis))


def _unit(axis):
    length = math.hypot(*axis)
    return (axis[0] / length, axis[1] / length)


JOINTS = {"revolute": _revolute, "prismatic": _prismatic, "pin-slot": _pin_slot, "rolling": _rolling, "gear": _gear, "cam": _cam}


# -- play ----------------------------------------------------------------------------------------------------------------------


def _ideal(spec, joint):
    return model.Ideal()


def _link(spec, joint):
    return model.MasslessLink(joint.clearance, joint.link_damping, joint.link_angle)


def dry(spec: LinkageSpec, joint: Joint) -> Dry:
    """The dry contact of a joint: stiffness from radii and material, loss from the restitution."""
    key = f"joints.{joint.name}"
    if joint.normal in contact_law_names() and joint.normal in (*NORMALS, *impact_law_names()):
        raise SpecError(f"two contact laws are called {joint.normal!r}; uninstall the package that adds the second", key=f"{key}.normal")
    masses = {body: spec.bodies[body].mass for body in (place(text)[0] for text in joint.connects) if body != GROUND}
    light = min(masses, key=lambda body: masses[body])
    if joint.normal == "kelvin-voigt" and joint.damping is None and masses[light] == 0:
        raise SpecError(
            f"is missing: {light!r} has no mass, so the restitution does not determine the damping; give it", key=f"{key}.damping"
        )
    return dry_contact(
        joint.normal,
        joint.clearance or 0.0,
        joint.bearing_radius,
        joint.length,
        joint.modulus,
        joint.poisson,
        joint.restitution,
        0.0 if masses[light] == 0 else 1 / sum(1 / mass for mass in masses.values()),  # the ground does not move
        joint.stiffness,
        joint.damping,
        _friction(joint),
    )


def _friction(joint):
    if joint.friction == 0 and not (joint.friction_law == "lugre" and (joint.static_friction or joint.viscous_friction)):
        return model.Friction("none")
    if joint.friction_law != "lugre":
        dead = joint.friction_dead_speed if joint.friction_law == "ambrosio" else 0.0
        return model.Friction(joint.friction_law, joint.friction, joint.friction_speed, dead)
    static = joint.friction if joint.static_friction is None else joint.static_friction
    return model.Friction(
        "lugre",
        joint.friction,
        joint.friction_speed,
        0.0,
        static,
        1 / joint.bristle_deflection,
        joint.bristle_damping,
        joint.viscous_friction,
    )


def joint_friction(joint: Joint) -> JointFriction | None:
    """The friction of an ideal joint; None where it has none, or is no ideal joint."""
    if joint.kind == "rolling":
        rolls = joint.rolling_resistance or joint.friction
        return JointFriction(1.0, 1.0, presliding=joint.bristle_deflection, arm=joint.rolling_resistance) if rolls else None
    static = joint.friction if joint.static_friction is None else joint.static_friction
    if joint.kind not in ("revolute", "prismatic", "pin-slot") or not max(joint.friction, static, joint.viscous_friction):
        return None
    return JointFriction(
        joint.friction,
        static,
        joint.friction_speed,
        joint.viscous_friction,
        joint.bristle_deflection,
        arm=joint.bearing_radius,
        guide=joint.bearing_length or 0.0,
    )


def _lubricated(spec, joint):
    return model.Lubricated(dry(spec, joint), joint.viscosity, joint.film, joint.roughness)


def _bushing(spec, joint):
    return model.Bushing(joint.stiffness, joint.damping or 0.0, joint.rotational_stiffness, joint.rotational_damping)


PINS = {"ideal": _ideal, "massless-link": _link, "dry": dry, "lubricated": _lubricated, "bushing": _bushing}


# -- forces and drive ----------------------------------------------------------------------------------------------------------


def _forces(spec):
    """Springs, torques and forces, each with a name."""
    for number, item in enumerate(spec.springs, 1):
        yield model.PointSpring(item.name or f"spring {number}", *_markers(spec, item), item.stiffness, item.free_length, item.damping)
    for number, item in enumerate(spec.rotational_springs, 1):
        name = item.name or f"rotational spring {number}"
        yield model.RotationalSpring(name, item.body, item.on, item.stiffness, item.rest, item.damping)
    for number, item in enumerate(spec.torques, 1):
        yield model.AppliedTorque(item.name or f"torque {number}", item.body, _load(item, item.torque, "torque", "torque"), item.on)
    for number, item in enumerate(spec.forces, 1):
        point = marker(spec, f"{item.body}.{item.point}")
        yield model.AppliedForce(item.name or f"force {number}", point, item.force, _load(item, 1.0, "factor", PURE), item.follows)


def _load(item, steady, what, dimension):
    return load_curve(item.file, what, dimension, item.periodic) if item.file else model.LoadCurve(model.line(steady, 0.0))


def _drives(spec):
    """(prescribed motions, motors) of the drives."""
    drives = list(spec.all_drives.values())
    motions = tuple(model.JointDrive(drive.joint, _motion(spec, drive)) for drive in drives if not drive.motor)
    return motions, tuple(_motor(spec, drive) for drive in drives if drive.motor)


def motor_name(spec: LinkageSpec, drive: LinkageDrive) -> str:
    """Name of the torque or force that a motor gives."""
    return "motor" if len(spec.all_drives) == 1 else f"motor {drive.joint}"


def _motion(spec, drive):
    if drive.speed:
        return model.line(drive.phase, drive.speed)
    return delayed(profile_curve(drive.profile, drive.ends, driven_joint(spec, drive).kind), drive.delay)


def _motor(spec, drive):
    joint, name = driven_joint(spec, drive), motor_name(spec, drive)
    if joint.kind == "prismatic":
        return model.LinearActuator(name, *_markers(spec, joint), _unit(joint.axis), actuator_curve(drive.motor))
    body, on = driven_bodies(spec, drive)
    return model.AppliedTorque(name, body, load_curve(drive.motor, "torque", "torque"), on)


def driven_bodies(spec: LinkageSpec, drive: LinkageDrive) -> tuple[str, str]:
    """(the body that a drive moves, the one it moves it from): first and second of the joint, the ground never first."""
    first, second = (place(text)[0] for text in driven_joint(spec, drive).connects)
    return (second, first) if first == GROUND else (first, second)


def driven_joint(spec: LinkageSpec, drive: LinkageDrive) -> Joint:
    """The Joint of a drive."""
    return next(joint for joint in spec.joints if joint.name == drive.joint)


def output_marker(spec: LinkageSpec, output: LinkageOutput) -> Marker:
    """The Marker of an output's point; of its centroid where it names none."""
    return marker(spec, f"{output.body}.{output.point or CENTROID}")
