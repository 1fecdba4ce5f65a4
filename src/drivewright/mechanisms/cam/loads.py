"""Forces of the drive: contact, torque, Hertz pressure, sliding, spring, vibration."""

from functools import partial

import numpy as np

from drivewright import cams
from drivewright.mechanisms.cam.build import CamModel
from drivewright.mechanisms.cam.spec import CamSpec
from drivewright.result import Answer, Answers, Check, Column, Table, Value, merge_answers

NO_SPEED = "no [drive] speed"


def no_forces(spec: CamSpec) -> str | None:
    """Why there are no forces to compute, or None."""
    if spec.drive is None:
        return NO_SPEED
    loaded = spec.load.mass or spec.load.force or spec.load.damping or (spec.spring and (spec.spring.stiffness or spec.spring.preload))
    return None if loaded else "no [load] and no [spring]"


def no_spring(spec: CamSpec) -> str | None:
    """Why there is no spring to size, or None."""
    return f'closure = "{spec.closure}" needs no spring' if spec.closure != "force" else no_forces(spec)


def no_vibration(spec: CamSpec) -> str | None:
    """Why there is no vibration to compute, or None."""
    if spec.vibration is None or spec.drive is None:
        return NO_SPEED if spec.vibration else "no [vibration] natural_frequency"
    ratio = 2 * np.pi * spec.vibration.natural_frequency / spec.drive.speed
    return f"the natural frequency is {ratio:.3g} times the cam's speed, which is as good as rigid" if ratio > cams.STIFFEST else None


def forces(model: CamModel, done: Answers) -> Answer:
    """Force along the travel, normal force and Hertz pressure on every surface, torque, sliding and rolling speeds."""
    piece, angle = model.cycle.samples()
    state = model.cycle.at(piece, angle)
    required, torque = model.required(*state).d0 + 0 * angle, model.torque(*state).d0 + 0 * angle
    columns = (
        Column("angle", "rad", "cam angle", angle),
        Column("required_force", "N", "force on the follower along its travel", required),
        Column("torque", "N m", "torque on the cam shaft", torque),
    )
    least = "least torque on the cam shaft, negative where the follower drives the cam"
    values = {
        "max_torque": Value(model.cycle.maximum(model.torque).value, "N m", "largest torque on the cam shaft"),
        "min_torque": Value(model.cycle.minimum(model.torque).value, "N m", least),
    }
    drive = Answer(values, (Table("load", "Force and torque over the turn", columns),), findings=_flight(model, required))
    answers = []
    for track in model.tracks:
        normal_force = np.maximum(model.normal_force(track, *state).d0 + 0 * angle, 0.0)
        answers += [_contact(model, track, normal_force), _pressure(model, track, normal_force)]
    if len(model.tracks) > 1:
        changes = Value(float(cams.crossovers(model.cycle, model.required)), "-", "changes of the surface that drives, per turn")
        answers.append(Answer({"crossovers": changes}))
    return merge_answers((drive, *answers))


def _flight(model, required):
    """What to say where a follower closed by force would have to be pulled."""
    if model.spec.closure != "force" or not np.any(required < 0):
        return ()
    share = 100 * float(np.mean(required < 0))
    return (
        f"the follower leaves the cam over about {share:.0f} % of the turn: there the cam carries neither force nor torque; its "
        "flight and landing are not computed, and the forces after a landing are larger than those given",
    )


def _contact(model, track, normal_force):
    """Normal force of one surface, which pushes only and carries what falls to it, and the speeds there."""
    greatest = model.cycle.maximum(partial(model.normal_force, track))
    values = {f"{track.prefix}max_contact_force": Value(max(greatest.value, 0.0), "N", f"largest normal force{track.of}")}
    rolls = model.spec.follower.face == "roller"
    ends = [extreme(lambda a, lift: track.contact(a, lift).sliding).value for extreme in (model.cycle.maximum, model.cycle.minimum)]
    fastest = max(map(abs, ends)) * model.speed
    if rolls and track.cut:
        spin = fastest / track.radius
        values[f"{track.prefix}max_roller_speed"] = Value(spin, "rad/s", f"largest speed of the roller on its pin{track.of}")
    if not rolls and track.cut:
        values[f"{track.prefix}max_sliding_speed"] = Value(fastest, "m/s", f"largest sliding speed{track.of}")
    return Answer(values, (track.contact_table(model.cycle, normal_force, model.speed, rolls),))


def _pressure(model, track, normal_force):
    """Hertz pressure of one surface, where it has a meaning."""
    if reason := track.without_pressure(model.cycle):
        return Answer(findings=(f"{track.prefix}max_contact_pressure is absent: {reason}",))
    width, modulus = model.spec.face.width, cams.pair_modulus(model.material)
    force_at = partial(model.normal_force, track)
    peak = cams.peak_contact_pressure(model.cycle, force_at, track.contact, track.radius, width, modulus)
    values = {f"{track.prefix}max_contact_pressure": Value(peak, "Pa", f"largest Hertz pressure{track.of}, steady contact")}
    tables = (track.pressure_table(model.cycle, normal_force, width, modulus),)
    name, message = f"contact_pressure{track.suffix}", "Hertz line contact of follower and cam"
    check = cams.pressure_check(name, peak, model.spec.limits.contact_pressure, model.material, message, (track.name, "follower"))
    return merge_answers((Answer(values, tables), check))


def spring(model: CamModel, done: Answers) -> Answer:
    """Does the spring hold the follower on the cam; what preload, stiffness and speed are the limits."""
    cycle, reach, load, speed = model.cycle, model.follower.reach, model.load, model.speed
    least, needed, findings = cycle.minimum(model.required), cams.needed_preload(cycle, reach, load, speed), []
    values = {
        "min_required_force": Value(least.value, "N", "least force on the follower along its travel; below 0 it leaves the cam"),
        "min_required_force.at": Value(least.angle % (2 * np.pi), "rad", "cam angle of it, from the start of the programme"),
        "spring.needed_preload": Value(needed, "N", "least preload at this speed and stiffness"),
    }
    stiffness = cams.needed_stiffness(cycle, reach, load, speed)
    if np.isfinite(stiffness):
        values["spring.needed_stiffness"] = Value(float(stiffness), "N/m", "least stiffness at this speed and preload")
    else:
        findings.append("spring.needed_stiffness is absent: none holds the follower at zero lift; give preload")
    jump = cams.jump_speed(cycle, reach, load)
    if np.isfinite(jump):
        values["spring.jump_speed"] = Value(float(jump), "rad/s", "cam speed at which the follower leaves the cam")
    else:
        findings.append("spring.jump_speed is absent: the follower leaves the cam at no speed")
    message = "the follower stays on the cam: least force along the travel"
    check = Check("separation", least.value, model.spec.limits.contact_force, ">=", "N", message, ("follower",))
    return Answer(values, (), (check,), tuple(findings))


def vibration(model: CamModel, done: Answers) -> Answer:
    """Steady vibration of the follower as one mass on a damped spring."""
    given, reach, speed = model.spec.vibration, model.follower.reach, model.speed
    assert given is not None
    frequency, damping_ratio = 2 * np.pi * given.natural_frequency, given.damping_ratio
    response = cams.periodic_response(model.cycle, reach, speed, frequency, damping_ratio)
    acceleration = cams.mass_acceleration(response, frequency, damping_ratio)
    error, shock = (cams.response_peak(response, speed, quantity) for quantity in (response.error, acceleration))
    values = {
        "vibration.max_error": Value(error, "m", "largest deviation of the follower from its programme"),
        "vibration.max_acceleration": Value(shock, "m/s^2", "largest acceleration of the follower, vibration included"),
    }
    dwells = [k for k, piece in enumerate(model.programme.pieces) if piece.phase == "dwell"]
    if dwells:
        swing = cams.free_amplitude(response, frequency, damping_ratio)
        residual = max(float(swing[response.piece == k][0]) for k in dwells)
        values["vibration.residual"] = Value(residual, "m", "amplitude that is left at the start of a dwell, the largest")
    limit, message = model.spec.limits.vibration, "deviation of the follower from its programme"
    checks = (Check("vibration", error, limit, "<=", "m", message, ("follower",)),) if limit else ()
    return Answer(values, (cams.vibration_table(model.cycle, response, reach, acceleration),), checks)
