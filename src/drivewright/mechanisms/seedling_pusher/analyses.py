"""What is asked of the conjugate cams: pressure angles, curvature, real profiles, loads."""

import numpy as np

from drivewright import curves, materials
from drivewright.cams import pair_modulus, pressure_check
from drivewright.cams.conjugate_tables import DrivenMass, geometry_table, load_table
from drivewright.mechanisms.seedling_pusher.build import GRID, TURN, PusherModel
from drivewright.numerics.jets import variable
from drivewright.result import Answer, Answers, Check, Value, merge_answers

DRIVES = {"main": "rise", "return": "return"}  # the phase in which each cam pushes the lever


def cams(model: PusherModel, done: Answers) -> Answer:
    """Pressure angles per phase, curvature, real profiles, lost motion of both cams."""
    pair, limits, both = model.pair, model.spec.limits, ("cam.main", "cam.return")
    answers = [_one_cam(model, cam) for cam in pair.cams]
    distance = np.abs(pair.pitch(pair.cams[0], GRID).d0 - pair.pitch(pair.cams[1], GRID).d0)
    swing = float(np.arctan(model.spec.push.stroke / model.spec.lever.output_arm))
    spread = "its spread over the cycle: zero by construction, a check of the pitch curves"
    steepest, reach = (max(answer.data[name] for answer in answers) for name in ("steepest", "reach"))
    ratio = min(answer.data["ratio"] for answer in answers)
    values = {
        "cam.roller_distance": Value(float(np.mean(distance)), "m", "distance of the two roller centres, constant over the cycle"),
        "cam.roller_distance.variation": Value(float(np.ptp(distance)), "m", spread),
        "cam.max_pressure_angle": Value(steepest, "rad", "largest pressure angle of both cams, driving or driven"),
        "cam.curvature_ratio": Value(ratio, "-", "least convex radius of a pitch curve over the roller radius"),
        "cam.max_pitch_radius": Value(reach, "m", "largest radius of the pitch curves"),
        "lever.swing": Value(swing, "rad", "swing of the lever"),
    }
    checks = [Check("pitch_radius", reach, limits.pitch_radius, "<=", "m", "room for the cams", both)]
    if model.spec.cams.coplanar_rollers:
        message, least = "two rollers in one plane clear each other", 2 * model.spec.cams.roller_radius
        checks.append(Check("roller_clearance", float(np.min(distance)), least, ">=", "m", message, ("rollers",), True))
    return merge_answers((*answers, Answer(values, (geometry_table(pair),), tuple(checks))))


def _one_cam(model, cam):
    prefix, pair = f"cam.{cam.name}", model.pair
    trimmed, (radius, place), (least, reach) = pair.trimmed[cam.name], pair.min_convex_radius(cam), pair.pitch_radii(cam)
    lost_at, lost = curves.largest_lost_motion(trimmed, *pair.overtravel(cam))
    gap = curves.largest_profile_gap(trimmed)[1]
    steepest = {phase: pair.max_pressure_angle(cam, phase) for phase in ("rise", "return")}
    at_rest = np.array([0.0])
    rest = float(np.abs(cam.pressure_angle(pair.pivot_angle(at_rest), 0.0 * variable(at_rest)).d0[0]))
    values = {
        f"{prefix}.max_pressure_angle.{phase}": Value(angle, "rad", f"largest pressure angle in the {phase}, magnitude")
        for phase, angle in steepest.items()
    }
    values |= {
        f"{prefix}.pressure_angle.rest": Value(rest, "rad", "pressure angle with the rod in, magnitude"),
        f"{prefix}.rest_angle": Value(float(cam.rest_angle), "rad", "arm against the line lever pivot - cam axis, rod in"),
        f"{prefix}.min_convex_radius": Value(radius, "m", "sharpest convex radius of the pitch curve"),
        f"{prefix}.min_convex_radius.at": Value(place % TURN, "rad", "carrier angle of it"),
        f"{prefix}.min_pitch_radius": Value(least, "m", "least radius of the pitch curve"),
        f"{prefix}.max_pitch_radius": Value(reach, "m", "largest radius of the pitch curve"),
        f"{prefix}.lost_motion": Value(lost, "m", "how far the roller sinks beyond its programme, along its path, where undercut"),
        f"{prefix}.profile_gap": Value(gap, "m", "gap between the roller in its planned place and the real profile"),
        f"{prefix}.profile_loss": Value(curves.profile_loss(trimmed), "m", "intended contact off the real profile where undercut"),
        f"{prefix}.profile_area": Value(trimmed.area, "m^2", "area of the finished profile"),
        f"{prefix}.profile_perimeter": Value(trimmed.perimeter, "m", "perimeter of the finished profile"),
    }
    findings = ()
    if lost > 0:
        findings = (
            f"the {cam.name} cam is undercut: near carrier angle {np.degrees(lost_at % TURN):.1f} deg the roller sinks {1e3 * lost:.3f} mm "
            "beyond its programme; a larger prime radius, a smaller roller or a longer push or retraction mends it",
        )
    ratio = radius / model.spec.cams.roller_radius
    checks = _cam_checks(model.spec, cam.name, ratio, least, steepest[DRIVES[cam.name]])
    return Answer(values, (), checks, findings, data={"steepest": max(steepest.values()), "ratio": ratio, "reach": reach})


def _cam_checks(spec, name, ratio, least_radius, driving):
    limits, parts = spec.limits, (f"cam.{name}",)
    wall = least_radius - spec.cams.roller_radius - spec.cams.hub_diameter / 2
    undercut = "convex radius of the pitch curve over roller radius: below 1 the profile cuts itself away"
    margin = "least convex radius over roller radius, recommended"
    return (
        Check(f"undercut.{name}", ratio, 1.0, ">=", "-", undercut, parts, True),
        Check(f"curvature_margin.{name}", ratio, limits.curvature_ratio, ">=", "-", margin, parts),
        Check(f"pressure_angle.{name}", driving, limits.pressure_angle, "<=", "rad", "pressure angle while this cam drives", parts),
        Check(f"hub_wall.{name}", wall, limits.hub_wall, ">=", "m", "wall between profile and hub", parts),
    )


def load(model: PusherModel, done: Answers) -> Answer:
    """Rod dynamics at the given speed, quasi-static normal forces, Hertz pressure, torque."""
    spec, material = model.spec, materials.material(model.spec.contact.material)
    driven = DrivenMass(spec.drive.speed, spec.load.mass, spec.load.push_force, spec.cams.face_width, pair_modulus(material))
    table = load_table(model.pair, driven)
    velocity, acceleration, torque = (float(np.max(np.abs(table[name].data))) for name in ("velocity", "acceleration", "torque"))
    values = {
        "rod.max_velocity": Value(velocity, "m/s", "peak rod velocity in the arm"),
        "rod.max_acceleration": Value(acceleration, "m/s^2", "peak rod acceleration in the arm"),
        "drive.max_torque": Value(torque, "N m", "peak torque of the pusher on the carrier, relative to the arm"),
    }
    return merge_answers((Answer(values, (table,)), *(_contact_load(spec, cam.name, table, material) for cam in model.pair.cams)))


def _contact_load(spec, name, table, material):
    """Largest force and pressure of one roller."""
    force, pressure = (float(table[f"{name}.{quantity}"].data.max()) for quantity in ("force", "pressure"))
    values = {
        f"cam.{name}.max_force": Value(force, "N", "largest normal force, no clearance"),
        f"cam.{name}.max_contact_pressure": Value(pressure, "Pa", "largest Hertz pressure on the intended profile"),
    }
    message = "Hertz line contact of roller and cam (meaningless where undercut)"
    check = pressure_check(f"contact_pressure.{name}", pressure, spec.limits.contact_pressure, material, message, (f"cam.{name}",))
    return merge_answers((Answer(values), check))
