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
    answers = [part for track in model.tracks for part in (_contact(model, track, state), _pressure(model, track, state))]
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


def _contact(model, track, state):
    """Normal force of one surface, which pushes only and carries what falls to it, and the speeds there."""
    contact, angle = track.contact(*state), state[0].d0
    greatest = model.cycle.maximum(partial(model.normal_force, track))
    values = {f"{track.prefix}max_contact_force": Value(max(greatest.value, 0.0), "N", f"largest normal force{track.of}")}
    rolls = model.spec.follower.face == "roller"
    ends = [extreme(lambda a, lift: track.contact(a, lift).sliding).value for extreme in (model.cycle.maximum, model.cycle.minimum)]
    body = max(map(abs, ends)) * model.speed
    if rolls and track.cut:
        spin = body / track.radius
        values[f"{track.prefix}max_roller_speed"] = Value(spin, "rad/s", f"largest speed of the roller on its pin{track.of}")
    if not rolls and track.cut:
        values[f"{track.prefix}max_sliding_speed"] = Value(body, "m/s", f"largest sliding speed{track.of}")
    surface = f"{'circumferential speed of the roller' if rolls else 'sliding speed'}{track.of}"
    rolling = contact.rolling.d0 * model.speed + 0 * angle
    columns = (
        Column("angle", "rad", "cam angle", angle),
        Column("contact_force", "N", f"normal force{track.of}", _pushing_force(model, track, state)),
        Column("surface_speed", "m/s", surface, np.abs(contact.sliding.d0) * model.speed + 0 * angle),
        Column("rolling_speed", "m/s", f"speed of the contact along the profile{track.of}", rolling),
    )
    return Answer(values, (Table(f"contact{track.suffix}", f"Contact of cam and follower{track.of}", columns),))


def _pushing_force(model, track, state):
    return np.maximum(model.normal_force(track, *state).d0 + 0 * state[0].d0, 0.0)


def _pressure(model, track, state):
    """Hertz pressure of one surface, where it has a meaning."""
    if reason := _no_pressure(model, track):
        return Answer(findings=(f"{track.prefix}max_contact_pressure is absent: {reason}",))
    across = (track.radius, model.spec.face.width, cams.pair_modulus(model.material))
    pressure = cams.contact_pressure(_pushing_force(model, track, state), track.contact(*state), *across)
    columns = (
        Column("angle", "rad", "cam angle", state[0].d0),
        Column("contact_pressure", "Pa", f"peak Hertz pressure{track.of}", pressure),
    )
    table = Table(f"pressure{track.suffix}", f"Contact pressure{track.of}", columns)
    peak = cams.peak_contact_pressure(model.cycle, partial(model.normal_force, track), track.contact, *across)
    values = {f"{track.prefix}max_contact_pressure": Value(peak, "Pa", f"largest Hertz pressure{track.of}, steady contact")}
    name, allowed = f"contact_pressure{track.suffix}", model.spec.limits.contact_pressure or model.material.hertz_limit
    if allowed is None:
        unknown = f"no allowable pressure is known for {model.material.name}; give limits.contact_pressure"
        return Answer(values, (table,), findings=(f"check {name} is left out: {unknown}",))
    check = Check(name, peak, allowed, "<=", "Pa", "Hertz line contact of follower and cam", (track.name, "follower"))
    return Answer(values, (table,), (check,))


def _no_pressure(model, track):
    """Why a Hertz pressure has no meaning, or None."""
    if track.radius == 0:
        return "a knife edge has no contact pressure"
    if track.flat:
        return "the profile is undercut" if cams.min_flat_radius(model.cycle, track.flat_face).value <= 0 else None
    sharpest = model.cycle.maximum(lambda angle, lift: track.flank * track.contact(angle, lift).pitch_curvature).value
    return "the profile is undercut" if sharpest * track.radius >= 1 else None


def spring(model: CamModel, done: Answers) -> Answer:
    """Does the spring hold the follower on the cam; what preload, stiffness and speed are the limits."""
    cycle, reach, load, speed = model.cycle, model.follower.reach, model.load, model.speed
    least, needed, findings = cycle.minimum(model.required), cams.needed_preload(cycle, reach, load, speed), []
    values = {
        "min_required_force": Value(least.value, "N", "least force on the follower along its travel; below 0 it leaves the cam"),
        "min_required_force.at": Value(least.angle % (2 * np.pi), "rad", "cam angle of it, from the start of the programme"),
        "spring.needed_preload": Value(needed, "N", "least preload at this speed and stiffness"),
    }
    stiffness, jump = cams.needed_stiffness(cycle, reach, load, speed), cams.jump_speed(cycle, reach, load)
    for name, value, unit, meaning, absent in (
        (
            "spring.needed_stiffness",
            stiffness,
            "N/m",
            "least stiffness at this speed and preload",
            "none holds the follower at zero lift; give preload",
        ),
        ("spring.jump_speed", jump, "rad/s", "cam speed at which the follower leaves the cam", "the follower leaves the cam at no speed"),
    ):
        if np.isfinite(value):
            values[name] = Value(float(value), unit, meaning)
        else:
            findings.append(f"{name} is absent: {absent}")
    message = "the follower stays on the cam: least force along the travel"
    check = Check("separation", least.value, model.spec.limits.contact_force, ">=", "N", message, ("follower",))
    return Answer(values, (), (check,), tuple(findings))


def vibration(model: CamModel, done: Answers) -> Answer:
    """Steady vibration of the follower as one mass on a damped spring."""
    given, reach, speed = model.spec.vibration, model.follower.reach, model.speed
    assert given is not None
    frequency = 2 * np.pi * given.natural_frequency
    found = cams.periodic_response(model.cycle, reach, speed, frequency, given.damping_ratio)
    lift = reach * model.cycle.at(found.piece, found.angle)[1].d0
    swing, actual = (
        cams.free_amplitude(found, frequency, given.damping_ratio),
        cams.mass_acceleration(found, frequency, given.damping_ratio),
    )
    error, shock = (cams.response_peak(found, speed, quantity) for quantity in (found.error, actual))
    values = {
        "vibration.max_error": Value(error, "m", "largest deviation of the follower from its programme"),
        "vibration.max_acceleration": Value(shock, "m/s^2", "largest acceleration of the follower, vibration included"),
    }
    rests = [k for k, piece in enumerate(model.programme.pieces) if piece.phase == "dwell"]
    if rests:
        residual = max(float(swing[found.piece == k][0]) for k in rests)
        values["vibration.residual"] = Value(residual, "m", "amplitude that is left at the start of a dwell, the largest")
    table = Table(
        "vibration",
        "Vibration of the follower",
        (
            Column("angle", "rad", "cam angle", found.angle),
            Column("travel", "m", "planned travel", lift),
            Column("actual", "m", "travel with vibration", lift + found.error.d0),
            Column("error", "m", "deviation from the programme", found.error.d0),
            Column("acceleration", "m/s^2", "acceleration of the follower, vibration included", actual.d0),
        ),
    )
    limit, message = model.spec.limits.vibration, "deviation of the follower from its programme"
    return Answer(values, (table,), (Check("vibration", error, limit, "<=", "m", message, ("follower",)),) if limit else ())
