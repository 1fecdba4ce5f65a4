"""What is asked of the conjugate cams: pressure angles, curvature, real profiles, loads."""

import numpy as np

from drivewright import curves, materials
from drivewright.contact import hertz
from drivewright.mechanisms.seedling_pusher.build import GRID, TURN, ConjugateCam, PusherModel
from drivewright.numerics.jets import variable
from drivewright.numerics.roots import extremes
from drivewright.result import Answer, Answers, Check, Column, Table, Value

SAMPLES = 181  # per smooth piece, before an extreme is refined


def cams(model: PusherModel, done: Answers) -> Answer:
    """Pressure angles per phase, curvature, real profiles, lost motion of both cams."""
    found = [_one_cam(model, cam) for cam in model.cams]
    values = {k: v for f in found for k, v in f.values.items()}
    distance = np.abs(model.pitch(model.cams[0], GRID).d0 - model.pitch(model.cams[1], GRID).d0)
    swing = float(np.arctan(model.spec.push.stroke / model.spec.lever.output_arm))
    values |= {
        "cam.roller_distance": Value(float(np.mean(distance)), "m", "distance of the two roller centres, constant over the cycle"),
        "cam.roller_distance.variation": Value(
            float(np.ptp(distance)), "m", "its spread over the cycle: zero by construction, a check of the pitch curves"
        ),
        "cam.max_pressure_angle": Value(
            max(f.data["steepest"] for f in found), "rad", "largest pressure angle of both cams, driving or driven"
        ),
        "cam.curvature_ratio": Value(
            min(f.data["ratio"] for f in found), "-", "least convex radius of a pitch curve over the roller radius"
        ),
        "cam.max_pitch_radius": Value(max(f.data["reach"] for f in found), "m", "largest radius of the pitch curves"),
        "lever.swing": Value(swing, "rad", "swing of the lever"),
    }
    checks = [c for f in found for c in f.checks]
    checks.append(
        Check(
            "pitch_radius",
            values["cam.max_pitch_radius"].value,
            model.spec.limits.pitch_radius,
            "<=",
            "m",
            "room for the cams",
            ("cam.main", "cam.return"),
        )
    )
    if model.spec.cams.coplanar_rollers:
        checks.append(
            Check(
                "roller_clearance",
                float(np.min(distance)),
                2 * model.spec.cams.roller_radius,
                ">=",
                "m",
                "two rollers in one plane clear each other",
                ("rollers",),
                True,
            )
        )
    return Answer(values, (cam_table(model),), tuple(checks), tuple(x for f in found for x in f.findings))


DRIVES = {"main": "rise", "return": "return"}  # the phase in which each cam pushes the lever


def phase_extreme(model: PusherModel, cam: ConjugateCam, phase: str) -> tuple[float, float]:
    """(largest magnitude of the pressure angle, carrier angle) in a phase, over its smooth pieces one-sidedly."""
    found = [
        extremes(lambda t, k=k: np.abs(model.pressure_angle(cam, t, k).d0), low, high, SAMPLES)
        for low, high, name, k in model.pieces()
        if name == phase
    ]
    return max((greatest, place) for _, _, place, greatest in found)


def least_convex_radius(model: PusherModel, cam: ConjugateCam) -> tuple[float, float]:
    """(radius [m], carrier angle) of the sharpest convex place of the pitch curve."""
    found = [extremes(lambda t, k=k: model.curvature(cam, t, k), low, high, SAMPLES)[3:1:-1] for low, high, _, k in model.pieces()]
    sharpest, where = max(found)
    return 1 / sharpest, where


def _one_cam(model, cam):
    prefix, spec = f"cam.{cam.name}", model.spec
    radius, where = least_convex_radius(model, cam)
    trimmed = model.trimmed[cam.name]
    lost_at, lost = curves.largest_lost_motion(trimmed, *model.overtravel(cam))
    reach = extremes(lambda t: np.abs(model.pitch(cam, t).d0), model.push_start, model.push_start + TURN)
    steepest = {phase: phase_extreme(model, cam, phase)[0] for phase in ("rise", "return")}
    values = {
        f"{prefix}.max_pressure_angle.{phase}": Value(angle, "rad", f"largest pressure angle in the {phase}, magnitude")
        for phase, angle in steepest.items()
    }
    dwell = float(np.abs(cam.pressure_angle(model.pivot_angle(np.array([0.0])), 0.0 * variable(np.array([0.0]))).d0[0]))
    values |= {
        f"{prefix}.pressure_angle.rest": Value(dwell, "rad", "pressure angle with the rod in, magnitude"),
        f"{prefix}.rest_angle": Value(float(cam.rest_angle), "rad", "arm against the line lever pivot - cam axis, rod in"),
        f"{prefix}.min_convex_radius": Value(radius, "m", "sharpest convex radius of the pitch curve"),
        f"{prefix}.min_convex_radius.at": Value(where % TURN, "rad", "carrier angle of it"),
        f"{prefix}.min_pitch_radius": Value(reach[1], "m", "least radius of the pitch curve"),
        f"{prefix}.max_pitch_radius": Value(reach[3], "m", "largest radius of the pitch curve"),
        f"{prefix}.lost_motion": Value(lost, "m", "how far the roller sinks beyond its programme, along its path, where undercut"),
        f"{prefix}.profile_gap": Value(
            curves.largest_profile_gap(trimmed)[1], "m", "gap between the roller in its planned place and the real profile"
        ),
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
    return Answer(
        values,
        (),
        _cam_checks(model, cam, radius, reach, steepest[DRIVES[cam.name]]),
        findings,
        data={"steepest": max(steepest.values()), "ratio": radius / spec.cams.roller_radius, "reach": reach[3]},
    )


def _cam_checks(model, cam, radius, reach, driving):
    spec, parts = model.spec, (f"cam.{cam.name}",)
    ratio = radius / spec.cams.roller_radius
    wall = reach[1] - spec.cams.roller_radius - spec.cams.hub_diameter / 2
    return (
        Check(
            f"undercut.{cam.name}",
            ratio,
            1.0,
            ">=",
            "-",
            "convex radius of the pitch curve over roller radius: below 1 the profile cuts itself away",
            parts,
            True,
        ),
        Check(
            f"curvature_margin.{cam.name}",
            ratio,
            spec.limits.curvature_ratio,
            ">=",
            "-",
            "least convex radius over roller radius, recommended",
            parts,
        ),
        Check(
            f"pressure_angle.{cam.name}", driving, spec.limits.pressure_angle, "<=", "rad", "pressure angle while this cam drives", parts
        ),
        Check(f"hub_wall.{cam.name}", wall, spec.limits.hub_wall, ">=", "m", "wall between profile and hub", parts),
    )


def cam_table(model: PusherModel) -> Table:
    """Pressure angle and curvature of both cams over the push cycle, one-sided at the joints."""
    parts = [(np.linspace(low, high, SAMPLES), k) for low, high, _, k in model.pieces()]
    t = np.concatenate([x for x, _ in parts])
    columns = [
        Column("carrier_angle", "rad", "turn of the carrier, one turn from the start of the push", t),
        Column("planet_angle", "rad", "planet relative to the carrier", model.planet(t).d0),
    ]
    for cam in model.cams:
        kappa = np.concatenate([model.curvature(cam, x, k) for x, k in parts])
        pitch = np.concatenate([model.pitch(cam, x, k).d0 for x, k in parts])
        columns += [
            Column(
                f"{cam.name}.pressure_angle",
                "rad",
                f"{cam.name} cam, signed",
                np.concatenate([model.pressure_angle(cam, x, k).d0 for x, k in parts]),
            ),
            Column(f"{cam.name}.curvature", "1/m", f"curvature of the {cam.name} pitch curve, convex positive", kappa),
            Column(f"{cam.name}.convex_ratio", "-", f"{cam.name} cam: undercut above 1", kappa * cam.roller_radius),
            Column(f"{cam.name}.pitch_radius", "m", f"radius of the {cam.name} pitch curve", np.abs(pitch)),
        ]
    return Table("cams", "Cams over the push cycle", tuple(columns))


# -- loads -----------------------------------------------------------------------------------------------------------------------


def load(model: PusherModel, done: Answers) -> Answer:
    """Rod dynamics at the given speed, quasi-static normal forces, Hertz pressure, torque."""
    parts = [(np.linspace(low, high, SAMPLES), phase, k) for low, high, phase, k in model.pieces()]
    rows = [_forces(model, t, phase, k) for t, phase, k in parts]
    joined = {name: np.concatenate([row[name] for row in rows]) for name in rows[0]}
    material = materials.material(model.spec.contact.material)
    allowed = model.spec.limits.contact_pressure or material.hertz_limit
    values = {
        "rod.max_velocity": Value(float(np.max(np.abs(joined["velocity"]))), "m/s", "peak rod velocity in the arm"),
        "rod.max_acceleration": Value(float(np.max(np.abs(joined["acceleration"]))), "m/s^2", "peak rod acceleration in the arm"),
        "drive.max_torque": Value(
            float(np.max(np.abs(joined["torque"]))), "N m", "peak torque of the pusher on the carrier, relative to the arm"
        ),
    }
    checks, findings = [], []
    for cam in model.cams:
        force, pressure = joined[f"{cam.name}.force"], joined[f"{cam.name}.pressure"]
        values[f"cam.{cam.name}.max_force"] = Value(float(force.max()), "N", "largest normal force, no clearance")
        values[f"cam.{cam.name}.max_contact_pressure"] = Value(
            float(pressure.max()), "Pa", "largest Hertz pressure on the intended profile"
        )
        if allowed is None:
            unknown = f"no allowable pressure is known for {material.name}; give limits.contact_pressure"
            findings.append(f"check contact_pressure.{cam.name} is left out: {unknown}")
            continue
        checks.append(
            Check(
                f"contact_pressure.{cam.name}",
                float(pressure.max()),
                allowed,
                "<=",
                "Pa",
                "Hertz line contact of roller and cam (meaningless where undercut)",
                (f"cam.{cam.name}",),
            )
        )
    units = {"carrier_angle": "rad", "velocity": "m/s", "acceleration": "m/s^2", "torque": "N m", "rod_force": "N"}
    table = Table(
        "load",
        "Loads over the push cycle",
        tuple(
            Column(name, units.get(name, "N" if name.endswith("force") else "Pa"), MEANINGS.get(name.split(".")[-1], name), data)
            for name, data in joined.items()
        ),
    )
    return Answer(values, (table,), tuple(checks), tuple(findings))


MEANINGS = {
    "carrier_angle": "turn of the carrier",
    "velocity": "rod velocity in the arm",
    "acceleration": "rod acceleration in the arm",
    "rod_force": "force the rod needs along its travel",
    "force": "normal force of the roller",
    "pressure": "Hertz pressure",
    "torque": "torque of the pusher about the planet axis",
}


def _forces(model, t, phase, piece):
    """Forces on one smooth piece: the rod needs m a + push force; the main cam gives the positive part, the return cam the rest."""
    spec = model.spec
    rod, swing, planet = model.rod(t, piece), model.swing(t, piece), model.planet(t)
    acceleration = rod.d2 * spec.drive.speed**2
    needed = spec.load.mass * acceleration + (spec.load.push_force if phase == "rise" else 0.0)
    # Virtual work: rod force times travel = lever torque times swing; travel per swing is dg/dphi = l / cos^2(phi).
    lever = needed * spec.lever.output_arm / np.cos(swing.d0) ** 2
    row = {
        "carrier_angle": t,
        "velocity": rod.d1 * spec.drive.speed,
        "acceleration": acceleration,
        "rod_force": needed,
        "torque": lever * swing.d1 / planet.d1,
    }
    for cam in model.cams:
        leverage = cam.arm * np.cos(model.pressure_angle(cam, t, piece).d0)
        force = np.maximum(cam.side * lever, 0.0) / leverage
        row[f"{cam.name}.force"] = force
        row[f"{cam.name}.pressure"] = _pressure(model, cam, force, model.curvature(cam, t, piece))
    return row


def _pressure(model, cam, force, bend):
    """Hertz pressure of roller on cam: 1/R = 1/r + kappa/(1 - r kappa), infinite curvature where the profile has a cusp."""
    spec, material = model.spec, materials.material(model.spec.contact.material)
    slack = np.maximum(1 - cam.roller_radius * bend, 1e-9)
    relative = 1 / cam.roller_radius + bend / slack
    modulus = hertz.effective_modulus(material.modulus, material.poisson, material.modulus, material.poisson)
    return hertz.line_contact(force, spec.cams.face_width, 1 / np.maximum(relative, 1e-9), modulus).pressure
