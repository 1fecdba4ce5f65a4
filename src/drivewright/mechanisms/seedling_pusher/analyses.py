"""The conjugate cams: pressure angles, curvature, finished profiles, loads."""

import numpy as np

from drivewright import curves, materials
from drivewright.cams import pair_modulus, pressure_check
from drivewright.cams.conjugate_tables import DrivenMass, geometry_table, load_table
from drivewright.mechanisms.seedling_pusher.build import GRID, TURN, PusherModel
from drivewright.numerics.jets import variable
from drivewright.result import Answer, Answers, Check, Value, merge_answers

REMEDY = "enlarge the prime radius, reduce the roller radius or lengthen the push or the retraction"
DRIVES = {"main": "rise", "return": "return"}  # the phase in which each cam pushes the lever


def cams(model: PusherModel, done: Answers) -> Answer:
    """Pressure angles per phase, curvature, finished profiles, lost motion of both cams."""
    pair, limits, both = model.pair, model.spec.limits, ("cam.main", "cam.return")
    answers = [_one_cam(model, cam) for cam in pair.cams]
    distance = np.abs(pair.pitch(pair.cams[0], GRID).d0 - pair.pitch(pair.cams[1], GRID).d0)
    swing = float(np.arctan(model.spec.push.stroke / model.spec.lever.output_arm))
    spread = "peak-to-peak variation of the distance of the roller centres over the cycle: zero by design, a check of the pitch curves"
    steepest, reach = (max(answer.data[name] for answer in answers) for name in ("steepest", "reach"))
    ratio, room = min(answer.data["ratio"] for answer in answers), "Maximum pitch radius of both cams"
    values = {
        "cam.roller_distance": Value(float(np.mean(distance)), "m", "distance of the roller centres, mean over the cycle"),
        "cam.roller_distance.variation": Value(float(np.ptp(distance)), "m", spread, label="Distance of rollers, peak-to-peak"),
        "cam.max_pressure_angle": Value(
            steepest,
            "rad",
            "maximum magnitude of the pressure angle of both cams, driving or driven",
            label="Maximum pressure angle of both cams",
        ),
        "cam.curvature_ratio": Value(
            ratio, "-", "minimum convex radius of the pitch curves over the roller radius", label="Curvature ratio of both cams"
        ),
        "cam.max_pitch_radius": Value(reach, "m", "maximum distance of the pitch curves from the cam axis", label=room),
        "lever.swing": Value(swing, "rad", "swing of the lever"),
    }
    message = "maximum pitch radius of both cams, limited by the space available; reduce the prime radii"
    checks = [Check("pitch_radius", reach, limits.pitch_radius, "<=", "m", message, both, label=room)]
    if model.spec.cams.coplanar_rollers:
        message = "distance of the roller centres against the roller diameter, for rollers in one plane; reduce the roller radius"
        closest, diameter, label = float(np.min(distance)), 2 * model.spec.cams.roller_radius, "Distance of the roller centres"
        checks.append(Check("roller_clearance", closest, diameter, ">=", "m", message, ("rollers",), True, label=label))
    return merge_answers((*answers, Answer(values, (geometry_table(pair),), tuple(checks))))


def _one_cam(model, cam):
    pair = model.pair
    trimmed, (radius, place), (least, reach) = pair.trimmed[cam.name], pair.min_convex_radius(cam), pair.pitch_radii(cam)
    lost_at, lost = curves.largest_lost_motion(trimmed, *pair.overtravel(cam))
    gap = curves.largest_profile_gap(trimmed)[1]
    steepest = {phase: pair.max_pressure_angle(cam, phase) for phase in ("rise", "return")}
    at_rest = np.array([0.0])
    rest = float(np.abs(cam.pressure_angle(pair.pivot_angle(at_rest), 0.0 * variable(at_rest)).d0[0]))
    values = {
        f"max_pressure_angle.{phase}": Value(
            angle, "rad", f"maximum magnitude of the pressure angle in the {phase}", label=f"Max. pressure angle, {phase}"
        )
        for phase, angle in steepest.items()
    }
    arm = "angle of the roller arm from the line between lever pivot and cam axis, rod retracted"
    overtravel = "maximum overtravel of the roller beyond its programme into the undercut profile, along its path"
    distance = "maximum gap between the roller in its prescribed position and the finished profile"
    shift = "maximum distance of the prescribed contact point from the finished profile where undercut"
    values |= {
        "pressure_angle.rest": Value(rest, "rad", "magnitude of the pressure angle, rod retracted", label="Pressure angle at rest"),
        "rest_angle": Value(float(cam.rest_angle), "rad", arm, label="Roller arm angle at rest"),
        "min_convex_radius": Value(radius, "m", "minimum convex radius of the pitch curve", label="Minimum convex radius"),
        "min_convex_radius.at": Value(
            place % TURN, "rad", "carrier angle at the minimum convex radius of the pitch curve", label="Angle of min. convex radius"
        ),
        "min_pitch_radius": Value(least, "m", "minimum distance of the pitch curve from the cam axis", label="Minimum pitch radius"),
        "max_pitch_radius": Value(reach, "m", "maximum distance of the pitch curve from the cam axis", label="Maximum pitch radius"),
        "lost_motion": Value(lost, "m", overtravel, label="Lost motion"),
        "profile_gap": Value(gap, "m", distance, label="Profile gap"),
        "profile_loss": Value(curves.profile_loss(trimmed), "m", shift, label="Profile loss"),
        "profile_area": Value(trimmed.area, "m^2", "area within the finished profile", label="Area of the profile"),
        "profile_perimeter": Value(trimmed.perimeter, "m", "perimeter of the finished profile", label="Perimeter of the profile"),
    }
    findings = ()
    if lost > 0:
        findings = (
            f"the {cam.name} cam is undercut: near carrier angle {np.degrees(lost_at % TURN):.1f}° the roller overtravels its programme "
            f"by {1e3 * lost:.3f} mm; {REMEDY}",
        )
    ratio = radius / model.spec.cams.roller_radius
    checks = _cam_checks(model.spec, cam.name, ratio, least, steepest[DRIVES[cam.name]])
    data = {"steepest": max(steepest.values()), "ratio": ratio, "reach": reach}
    return Answer(_of_cam(cam.name, values), (), checks, findings, data=data)


def _of_cam(name, values):
    """Values of one cam, told from those of the other one by name, meaning and label."""
    return {
        f"cam.{name}.{key}": value._replace(meaning=f"{value.meaning} ({name} cam)", label=f"{value.label}, {name} cam")
        for key, value in values.items()
    }


def _cam_checks(spec, name, ratio, least_radius, driving):
    limits, parts = spec.limits, (f"cam.{name}",)
    wall = least_radius - spec.cams.roller_radius - spec.cams.hub_diameter / 2
    over = "minimum convex radius of the pitch curve over the roller radius"
    undercut, margin = f"{over}; below 1 the profile is undercut: {REMEDY}", f"{over}, recommended value; {REMEDY}"
    angle = "maximum pressure angle while the cam drives; enlarge its prime radius or the carrier angle of its motion"
    thickness = "minimum wall thickness between profile and hub; reduce the hub diameter or enlarge the prime radius"
    checks = (
        Check("undercut", ratio, 1.0, ">=", "-", undercut, parts, True, label="Undercut, pitch/roller"),
        Check("curvature_margin", ratio, limits.curvature_ratio, ">=", "-", margin, parts, label="Curvature ratio, recommended"),
        Check("pressure_angle", driving, limits.pressure_angle, "<=", "rad", angle, parts, label="Driving pressure angle"),
        Check("hub_wall", wall, limits.hub_wall, ">=", "m", thickness, parts, label="Wall between profile and hub"),
    )
    return tuple(check._replace(name=f"{check.name}.{name}", label=f"{check.label}, {name} cam") for check in checks)


def load(model: PusherModel, done: Answers) -> Answer:
    """Rod dynamics at the given speed, quasi-static normal forces, Hertz pressure, torque."""
    spec, material = model.spec, materials.material(model.spec.contact.material)
    driven = DrivenMass(spec.drive.speed, spec.load.mass, spec.load.push_force, spec.cams.face_width, pair_modulus(material))
    table = load_table(model.pair, driven)
    velocity, acceleration, torque = (float(np.max(np.abs(table[name].data))) for name in ("velocity", "acceleration", "torque"))
    values = {
        "rod.max_velocity": Value(velocity, "m/s", "maximum magnitude of the velocity of the rod in the arm", label="Maximum rod velocity"),
        "rod.max_acceleration": Value(
            acceleration, "m/s^2", "maximum magnitude of the acceleration of the rod in the arm", label="Maximum rod acceleration"
        ),
        "drive.max_torque": Value(
            torque, "N m", "maximum magnitude of the torque of the pusher about the planet axis", label="Maximum torque of the pusher"
        ),
    }
    return merge_answers((Answer(values, (table,)), *(_contact_load(spec, cam.name, table, material) for cam in model.pair.cams)))


def _contact_load(spec, name, table, material):
    """Maximum force and pressure of one roller."""
    force, pressure = (float(table[f"{name}.{quantity}"].data.max()) for quantity in ("force", "pressure"))
    values = {
        "max_force": Value(force, "N", "maximum normal force without clearance, quasi-static", label="Maximum normal force"),
        "max_contact_pressure": Value(pressure, "Pa", "maximum Hertz pressure on the prescribed profile", label="Maximum Hertz pressure"),
    }
    message = (
        "maximum Hertz pressure of the line contact of roller and cam, not valid where undercut; widen the cams or enlarge the rollers"
    )
    limit, label = spec.limits.contact_pressure, f"Maximum Hertz pressure, {name} cam"
    check = pressure_check(f"contact_pressure.{name}", pressure, limit, material, message, (f"cam.{name}",), label)
    return merge_answers((Answer(_of_cam(name, values)), check))
