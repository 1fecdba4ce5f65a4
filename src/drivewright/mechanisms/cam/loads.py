"""Forces of the drive: contact, torque, Hertz pressure, sliding, spring, vibration."""

from collections.abc import Callable, Iterator
from functools import partial
from typing import cast

import numpy as np

from drivewright import cams
from drivewright._typing import Bools
from drivewright.mechanisms.cam.build import CamModel
from drivewright.mechanisms.cam.geometry import existing
from drivewright.mechanisms.cam.spec import CamSpec
from drivewright.mechanisms.cam.surge import jump_with_surge, surge_force
from drivewright.result import Answer, Answers, Check, Column, Table, Value, merge_answers

NO_SPEED = "no [drive] speed"


def no_forces(spec: CamSpec) -> str | None:
    """Why there are no forces to compute, or None."""
    if spec.drive is None:
        return NO_SPEED
    return None if np.all(is_loaded(spec)) else "no [load] and no [spring]"


def is_loaded(spec: CamSpec) -> Bools:
    """Whether a spec states anything that the follower moves; of many designs a column (n, 1)."""
    load, spring = spec.load, spec.spring
    parts = (load.mass, load.force, load.damping, *((spring.stiffness, spring.preload) if spring else ()))
    return np.any(np.stack(np.broadcast_arrays(*parts)) != 0, axis=0)


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
    _, angle = model.cycle.samples()
    state = model.cycle.sampled()
    required, torque = model.required(*state).d0 + 0 * angle, model.torque(*state).d0 + 0 * angle
    columns = (
        Column("angle", "rad", "cam angle", angle),
        Column("required_force", "N", "force on the follower along its travel", required),
        Column("torque", "N m", "torque on the cam shaft", torque),
    )
    tables = [Table("load", "Force and torque over the turn", columns)]
    findings = list(_flight(model, required))
    for track in model.tracks:
        normal_force = np.maximum(model.normal_force(track, *state).d0 + 0 * angle, 0.0)
        tables.append(track.contact_table(model.cycle, normal_force, model.speed, model.spec.follower.face == "roller"))
        if reason := track.without_pressure(model.cycle):
            findings.append(f"{track.prefix}max_contact_pressure is absent: {reason}")
        else:
            tables.append(track.pressure_table(model.cycle, normal_force, model.spec.face.width, cams.pair_modulus(model.material)))
            findings += _no_allowable(model, track)
    measured = existing(merge_answers(measure(model) for measure in force_measures(model)))
    return merge_answers((measured, Answer(tables=tuple(tables), findings=tuple(findings))))


def force_measures(model: CamModel) -> Iterator[Callable[[CamModel], Answer]]:
    """The functions that give the values and checks of the forces, as `geometry_measures`."""
    yield _torque
    for number in range(len(model.tracks)):
        yield partial(_contact_force, number=number)
        if model.tracks[number].cut:
            yield partial(_surface_speed, number=number)
        yield partial(_pressure, number=number)
    if len(model.tracks) > 1:
        yield _crossovers


def _torque(model):
    least = "least torque on the cam shaft, negative where the follower drives the cam"
    return Answer(
        {
            "max_torque": Value(model.cycle.maximum(model.torque).value, "N m", "largest torque on the cam shaft"),
            "min_torque": Value(model.cycle.minimum(model.torque).value, "N m", least),
        }
    )


def _crossovers(model):
    count = cams.crossovers(model.cycle, model.required)
    return Answer({"crossovers": Value(count, "-", "changes of the surface that drives, per turn")})


def _flight(model, required):
    """What to say where a follower closed by force would have to be pulled."""
    if model.spec.closure != "force" or not np.any(required < 0):
        return ()
    share, angle = 100 * float(np.mean(required < 0)), np.degrees(model.cycle.minimum(model.required).angle % (2 * np.pi))
    return (
        f"the follower leaves the cam over about {share:.0f} % of the turn, with the least force at cam angle {angle:.1f} deg: there the "
        "cam carries neither force nor torque; its flight and landing are not computed, and the forces after a landing are larger "
        "than those given",
    )


def _contact_force(model, number):
    """Normal force of one surface, which pushes only and carries what falls to it."""
    track = model.tracks[number]
    greatest = np.maximum(model.cycle.maximum(partial(model.normal_force, track)).value, 0.0)
    return Answer({f"{track.prefix}max_contact_force": Value(greatest, "N", f"largest normal force{track.of}")})


def _surface_speed(model, number):
    """Greatest speed of the roller on its pin, or of the face over the cam."""
    track = model.tracks[number]
    ends = [extreme(lambda a, lift: track.contact(a, lift).sliding).value for extreme in (model.cycle.maximum, model.cycle.minimum)]
    fastest = np.maximum(*map(np.abs, ends)) * model.speed
    if model.spec.follower.face == "roller":
        spin = Value(fastest / track.radius, "rad/s", f"largest speed of the roller on its pin{track.of}")
        return Answer({f"{track.prefix}max_roller_speed": spin})
    return Answer({f"{track.prefix}max_sliding_speed": Value(fastest, "m/s", f"largest sliding speed{track.of}")})


def _pressure(model, number):
    """Hertz pressure of one surface, nan where it has no meaning."""
    track = model.tracks[number]
    smooth = track.has_pressure(model.cycle)
    if not np.any(smooth):
        peak = np.nan
    else:
        width, modulus, force_at = model.spec.face.width, cams.pair_modulus(model.material), partial(model.normal_force, track)
        peak = cams.peak_contact_pressure(model.cycle, force_at, track.contact, track.radius, width, modulus)
        peak = cams.nan_unless(smooth, peak)
    values = {f"{track.prefix}max_contact_pressure": Value(peak, "Pa", f"largest Hertz pressure{track.of}, steady contact")}
    return Answer(values, (), _pressure_check(model, track, peak).checks)


def _pressure_check(model, track, peak):
    name, message = f"contact_pressure{track.suffix}", "Hertz line contact of follower and cam"
    return cams.pressure_check(name, peak, model.spec.limits.contact_pressure, model.material, message, (track.name, "follower"))


def _no_allowable(model, track):
    """What to say where nobody states an allowable pressure."""
    return _pressure_check(model, track, 0.0).findings


def spring(model: CamModel, done: Answers) -> Answer:
    """Does the spring hold the follower on the cam; what preload, stiffness and speed are the limits."""
    measured = merge_answers(measure(model) for measure in spring_measures(model))
    absent = {
        "spring.needed_stiffness": "with its mass the spring surges otherwise at another stiffness"
        if model.surge
        else "none holds the follower at zero lift; give preload",
        "spring.jump_speed": "the follower leaves the cam at no speed",
    }
    findings = tuple(f"{name} is absent: {reason}" for name, reason in absent.items() if np.isnan(measured.values[name].value))
    return merge_answers((existing(measured), Answer(findings=findings)))


def spring_measures(model: CamModel) -> Iterator[Callable[[CamModel], Answer]]:
    """The functions that give the values and checks of the spring, as `geometry_measures`."""
    yield from (_separation, _needed_preload, _needed_stiffness, _jump)


def _separation(model):
    """Least force along the travel, which must press the follower onto the cam."""
    least = model.cycle.minimum(model.required)
    values = {
        "min_required_force": Value(least.value, "N", "least force on the follower along its travel; below 0 it leaves the cam"),
        "min_required_force.at": Value(least.angle % (2 * np.pi), "rad", "cam angle of it, from the start of the programme"),
    }
    message = "the follower stays on the cam: least force along the travel"
    limit, label = model.spec.limits.contact_force, "separation, least force"
    return Answer(values, (), (Check("separation", least.value, limit, ">=", "N", message, ("follower",), label=label),))


def _needed_preload(model):
    also = surge_force(model) if model.surge else None
    needed = cams.needed_preload(model.cycle, model.path, model.load, model.speed, also)
    return Answer({"spring.needed_preload": Value(needed, "N", "least preload at this speed and stiffness")})


def _needed_stiffness(model):
    stiffness = np.inf if model.surge else cams.needed_stiffness(model.cycle, model.path, model.load, model.speed)
    stiffness = cams.nan_unless(np.isfinite(stiffness), stiffness)
    return Answer({"spring.needed_stiffness": Value(stiffness, "N/m", "least stiffness at this speed and preload")})


def _jump(model):
    """Speed from which on the follower leaves the cam, against the speed of the drive; with surge where the spring has a mass."""
    quiet = cams.jump(model.cycle, model.path, model.load)
    found = jump_with_surge(model, cast(float, quiet.speed)) if model.surge else quiet
    speed = cams.nan_unless(np.isfinite(found.speed), found.speed)
    values = {
        "spring.jump_speed": Value(speed, "rad/s", "cam speed at which the follower leaves the cam"),
        "spring.jump_speed.at": Value(cast(float, found.angle) % (2 * np.pi), "rad", "cam angle of separation, at the jump speed"),
    }
    if model.surge and np.isfinite(quiet.speed):
        values["spring.jump_speed.without_surge"] = Value(
            cast(float, quiet.speed), "rad/s", "jump speed without surge, a spring without mass"
        )
    return Answer(values, (), (_jump_check(model, speed, found.angle),))


def _jump_check(model, speed, angle):
    """The check of a jump speed; its message names speed and angle."""
    message = "the follower leaves the cam"
    if np.ndim(speed) == 0 and np.isfinite(speed):
        message += f" at {60 * speed / (2 * np.pi):.5g} rpm, at cam angle {np.degrees(angle % (2 * np.pi)):.1f} deg"
    return Check("jump_speed", speed, model.speed, ">=", "rad/s", message, ("follower", "spring"), label="Jump speed")


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
