"""What is asked of the conjugate cams: pressure angles, curvature, real profiles, loads."""

import numpy as np

from drivewright import curves, materials
from drivewright.cams import pair_modulus, roller_pressure
from drivewright.mechanisms.seedling_pusher.build import GRID, TURN, PusherModel
from drivewright.numerics.jets import variable
from drivewright.result import Answer, Answers, Check, Column, Table, Value, merge_answers

SAMPLES = 181  # per smooth piece


def cams(model: PusherModel, done: Answers) -> Answer:
    """Pressure angles per phase, curvature, real profiles, lost motion of both cams."""
    pair, limits, both = model.pair, model.spec.limits, ("cam.main", "cam.return")
    found = [_one_cam(model, cam) for cam in pair.cams]
    distance = np.abs(pair.pitch(pair.cams[0], GRID).d0 - pair.pitch(pair.cams[1], GRID).d0)
    swing = float(np.arctan(model.spec.push.stroke / model.spec.lever.output_arm))
    spread = "its spread over the cycle: zero by construction, a check of the pitch curves"
    steepest, ratio, reach = (most(x.data[name] for x in found) for name, most in (("steepest", max), ("ratio", min), ("reach", max)))
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
    return merge_answers((*found, Answer(values, (_cam_table(model),), tuple(checks))))


DRIVES = {"main": "rise", "return": "return"}  # the phase in which each cam pushes the lever


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


def _cam_table(model):
    """Pressure angle and curvature of both cams over the push cycle, one-sided at the joints."""
    pair = model.pair
    parts = [(np.linspace(low, high, SAMPLES), k) for low, high, _, k in pair.pieces]
    t = np.concatenate([x for x, _ in parts])
    columns = [
        Column("carrier_angle", "rad", "turn of the carrier, one turn from the start of the push", t),
        Column("planet_angle", "rad", "planet relative to the carrier", model.arm.planet(t).d0),
    ]
    for name, cam in ((cam.name, cam) for cam in pair.cams):
        pressure = np.concatenate([pair.pressure_angle(cam, x, k).d0 for x, k in parts])
        kappa = np.concatenate([pair.curvature(cam, x, k) for x, k in parts])
        pitch = np.concatenate([pair.pitch(cam, x, k).d0 for x, k in parts])
        columns += [
            Column(f"{name}.pressure_angle", "rad", f"{name} cam, signed", pressure),
            Column(f"{name}.curvature", "1/m", f"curvature of the {name} pitch curve, convex positive", kappa),
            Column(f"{name}.convex_ratio", "-", f"{name} cam: undercut above 1", kappa * cam.roller_radius),
            Column(f"{name}.pitch_radius", "m", f"radius of the {name} pitch curve", np.abs(pitch)),
        ]
    return Table("cams", "Cams over the push cycle", tuple(columns))


# -- loads -----------------------------------------------------------------------------------------------------------------------


QUANTITIES = {  # unit and meaning of the columns, by the last part of their names
    "carrier_angle": ("rad", "turn of the carrier"),
    "velocity": ("m/s", "rod velocity in the arm"),
    "acceleration": ("m/s^2", "rod acceleration in the arm"),
    "rod_force": ("N", "force the rod needs along its travel"),
    "force": ("N", "normal force of the roller"),
    "pressure": ("Pa", "Hertz pressure"),
    "torque": ("N m", "torque of the pusher about the planet axis"),
}


def load(model: PusherModel, done: Answers) -> Answer:
    """Rod dynamics at the given speed, quasi-static normal forces, Hertz pressure, torque."""
    rows = [_forces(model, np.linspace(low, high, SAMPLES), phase, k) for low, high, phase, k in model.pair.pieces]
    joined = {name: np.concatenate([row[name] for row in rows]) for name in rows[0]}
    velocity, acceleration, torque = (float(np.max(np.abs(joined[name]))) for name in ("velocity", "acceleration", "torque"))
    columns = tuple(Column(name, *QUANTITIES[name.split(".")[-1]], data) for name, data in joined.items())
    values = {
        "rod.max_velocity": Value(velocity, "m/s", "peak rod velocity in the arm"),
        "rod.max_acceleration": Value(acceleration, "m/s^2", "peak rod acceleration in the arm"),
        "drive.max_torque": Value(torque, "N m", "peak torque of the pusher on the carrier, relative to the arm"),
    }
    rod = Answer(values, (Table("load", "Loads over the push cycle", columns),))
    return merge_answers((rod, *(_contact_load(model, cam.name, joined) for cam in model.pair.cams)))


def _contact_load(model, name, joined):
    """Largest force and pressure of one roller."""
    force, pressure = (float(joined[f"{name}.{quantity}"].max()) for quantity in ("force", "pressure"))
    values = {
        f"cam.{name}.max_force": Value(force, "N", "largest normal force, no clearance"),
        f"cam.{name}.max_contact_pressure": Value(pressure, "Pa", "largest Hertz pressure on the intended profile"),
    }
    material, check = materials.material(model.spec.contact.material), f"contact_pressure.{name}"
    allowed = model.spec.limits.contact_pressure or material.hertz_limit
    if allowed is None:
        unknown = f"no allowable pressure is known for {material.name}; give limits.contact_pressure"
        return Answer(values, findings=(f"check {check} is left out: {unknown}",))
    message = "Hertz line contact of roller and cam (meaningless where undercut)"
    return Answer(values, checks=(Check(check, pressure, allowed, "<=", "Pa", message, (f"cam.{name}",)),))


def _forces(model, t, phase, piece):
    """Forces on one smooth piece: the rod needs m a + push force; the main cam gives the positive part, the return cam the rest."""
    spec, pair, speed = model.spec, model.pair, model.spec.drive.speed
    rod, swing = pair.travel(t, piece), pair.swing(t, piece)
    acceleration = rod.d2 * speed**2
    needed = spec.load.mass * acceleration + (spec.load.push_force if phase == "rise" else 0.0)
    moment = pair.lever_moment(needed, swing.d0)
    row = {"carrier_angle": t, "velocity": rod.d1 * speed, "acceleration": acceleration, "rod_force": needed}
    row["torque"] = moment * swing.d1 / model.arm.planet(t).d1
    across = (spec.cams.roller_radius, spec.cams.face_width, pair_modulus(materials.material(spec.contact.material)))
    for cam in pair.cams:
        row[f"{cam.name}.force"] = pair.roller_force(cam, moment, t, piece)
        row[f"{cam.name}.pressure"] = roller_pressure(row[f"{cam.name}.force"], pair.curvature(cam, t, piece), *across)
    return row
