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
    return (
        f"the natural frequency is {ratio:.3g} times the cam's speed: the follower is practically rigid" if ratio > cams.STIFFEST else None
    )


def forces(model: CamModel, done: Answers) -> Answer:
    """Force along the travel, normal force and Hertz pressure on every surface, torque, sliding and rolling speeds."""
    _, angle = model.cycle.samples()
    state = model.cycle.sampled()
    required, torque = model.required(*state).d0 + 0 * angle, model.torque(*state).d0 + 0 * angle
    columns = (
        Column("angle", "rad", "cam angle", angle),
        Column("required_force", "N", "force of the cam on the follower along its travel", required, "Force along the travel"),
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
    sense = "negative where the follower drives the cam"
    return Answer(
        {
            f"{name}_torque": Value(
                extreme(model.torque).value, "N m", f"{words} torque on the cam shaft", label=f"Cam torque, {words}", convention=sense
            )
            for name, words, extreme in (("max", "maximum", model.cycle.maximum), ("min", "minimum", model.cycle.minimum))
        }
    )


def _crossovers(model):
    count = cams.crossovers(model.cycle, model.required)
    meaning = "number of times per turn that another surface takes over the drive of the follower"
    return Answer({"crossovers": Value(count, "-", meaning, label="Crossovers of the contact per turn")})


def _flight(model, required):
    """The finding where a follower closed by force would have to be pulled."""
    if model.spec.closure != "force" or not np.any(required < 0):
        return ()
    share, angle = 100 * float(np.mean(required < 0)), np.degrees(model.cycle.minimum(model.required).angle % (2 * np.pi))
    return (
        f"the follower leaves the cam over about {share:.0f} % of the turn, with the minimum force at cam angle {angle:.1f}°: there the "
        "cam transmits neither force nor torque. Flight and landing are not computed, and the forces after landing exceed those given; "
        "increase the preload or the stiffness of the spring, or reduce the speed",
    )


def _contact_force(model, number):
    """Normal force of one surface, which pushes only and carries what falls to it."""
    track = model.tracks[number]
    greatest = np.maximum(model.cycle.maximum(partial(model.normal_force, track)).value, 0.0)
    return Answer(
        {
            f"{track.prefix}max_contact_force": Value(
                greatest, "N", f"maximum normal force{track.of}", label=track.label("Maximum normal force")
            )
        }
    )


def _surface_speed(model, number):
    """Maximum speed of the roller on its pin, or of the face over the cam."""
    track = model.tracks[number]
    ends = [extreme(lambda a, lift: track.contact(a, lift).sliding).value for extreme in (model.cycle.maximum, model.cycle.minimum)]
    fastest = np.maximum(*map(np.abs, ends)) * model.speed
    if model.spec.follower.face == "roller":
        meaning, label = f"maximum angular speed of the roller on its pin{track.of}", track.label("Maximum roller speed")
        return Answer({f"{track.prefix}max_roller_speed": Value(fastest / track.radius, "rad/s", meaning, label=label)})
    meaning, label = f"maximum sliding speed of the follower's face{track.of}", track.label("Maximum sliding speed")
    return Answer({f"{track.prefix}max_sliding_speed": Value(fastest, "m/s", meaning, label=label)})


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
    meaning, label = f"maximum Hertz pressure in steady contact{track.of}", track.label("Maximum Hertz pressure")
    values = {f"{track.prefix}max_contact_pressure": Value(peak, "Pa", meaning, label=label)}
    return Answer(values, (), _pressure_check(model, track, peak).checks)


def _pressure_check(model, track, peak):
    name, label = f"contact_pressure{track.suffix}", track.label("Maximum Hertz pressure")
    message = "maximum Hertz pressure of the line contact of cam and follower; widen the face, enlarge the radii or reduce the force"
    return cams.pressure_check(name, peak, model.spec.limits.contact_pressure, model.material, message, (track.name, "follower"), label)


def _no_allowable(model, track):
    """The finding where no allowable pressure is known."""
    return _pressure_check(model, track, 0.0).findings


def spring(model: CamModel, done: Answers) -> Answer:
    """Whether the spring holds the follower on the cam; the limits of its preload and stiffness, and of the speed."""
    measured = merge_answers(measure(model) for measure in spring_measures(model))
    absent = {
        "spring.needed_stiffness": "the surge of a spring with mass depends on its stiffness; vary spring.stiffness instead"
        if model.surge
        else "no stiffness holds the follower on the cam at zero lift; give a preload",
        "spring.jump_speed": "the follower stays on the cam at every speed",
    }
    findings = tuple(f"{name} is absent: {reason}" for name, reason in absent.items() if np.isnan(measured.values[name].value))
    return merge_answers((existing(measured), Answer(findings=findings)))


def spring_measures(model: CamModel) -> Iterator[Callable[[CamModel], Answer]]:
    """The functions that give the values and checks of the spring, as `geometry_measures`."""
    yield from (_separation, _needed_preload, _needed_stiffness, _jump)


def _separation(model):
    """Minimum force along the travel, which must press the follower onto the cam."""
    least, label = model.cycle.minimum(model.required), "Minimum force along the travel"
    values = {
        "min_required_force": Value(
            least.value,
            "N",
            "minimum force of the cam on the follower along its travel",
            label=label,
            convention="negative where the follower leaves the cam",
        ),
        "min_required_force.at": Value(
            least.angle % (2 * np.pi),
            "rad",
            "cam angle at the minimum force along the travel",
            label="Cam angle at minimum force",
            convention="0 at the start of the programme",
        ),
    }
    message = (
        "minimum force along the travel, with which the follower stays on the cam; increase the preload or the stiffness of the spring"
    )
    limit = model.spec.limits.contact_force
    return Answer(values, (), (Check("separation", least.value, limit, ">=", "N", message, ("follower",), label=label),))


def _needed_preload(model):
    also = surge_force(model) if model.surge else None
    needed = cams.needed_preload(model.cycle, model.path, model.load, model.speed, also)
    meaning = "minimum preload with which the follower stays on the cam, at this speed and stiffness"
    return Answer({"spring.needed_preload": Value(needed, "N", meaning, label="Required spring preload")})


def _needed_stiffness(model):
    stiffness = np.inf if model.surge else cams.needed_stiffness(model.cycle, model.path, model.load, model.speed)
    stiffness = cams.nan_unless(np.isfinite(stiffness), stiffness)
    meaning = "minimum stiffness with which the follower stays on the cam, at this speed and preload"
    return Answer({"spring.needed_stiffness": Value(stiffness, "N/m", meaning, label="Required spring stiffness")})


def _jump(model):
    """Speed from which on the follower leaves the cam, against the speed of the drive; with surge where the spring has a mass."""
    quiet = cams.jump(model.cycle, model.path, model.load)
    found = jump_with_surge(model, cast(float, quiet.speed)) if model.surge else quiet
    speed = cams.nan_unless(np.isfinite(found.speed), found.speed)
    values = {
        "spring.jump_speed": Value(speed, "rad/s", "cam speed at which the follower leaves the cam", label="Jump speed"),
        "spring.jump_speed.at": Value(
            cast(float, found.angle) % (2 * np.pi),
            "rad",
            "cam angle at which the follower leaves the cam at the jump speed",
            label="Cam angle of separation",
            convention="0 at the start of the programme",
        ),
    }
    if model.surge and np.isfinite(quiet.speed):
        values["spring.jump_speed.without_surge"] = Value(
            cast(float, quiet.speed), "rad/s", "jump speed of a spring without mass", label="Jump speed without surge"
        )
    return Answer(values, (), (_jump_check(model, speed, found.angle),))


def _jump_check(model, speed, angle):
    """The check of a jump speed; its message names speed and angle."""
    message, remedy = "the follower leaves the cam", "; increase the preload or the stiffness of the spring"
    if np.ndim(speed) == 0 and np.isfinite(speed):
        message += f" at {60 * speed / (2 * np.pi):.5g} rpm, at cam angle {np.degrees(angle % (2 * np.pi)):.1f}°"
    message += remedy
    return Check("jump_speed", speed, model.speed, ">=", "rad/s", message, ("follower", "spring"), label="Jump speed")


def vibration(model: CamModel, done: Answers) -> Answer:
    """Steady vibration of the follower as one mass on a damped spring."""
    given, reach, speed = model.spec.vibration, model.follower.reach, model.speed
    assert given is not None
    frequency, damping_ratio = 2 * np.pi * given.natural_frequency, given.damping_ratio
    response = cams.periodic_response(model.cycle, reach, speed, frequency, damping_ratio)
    acceleration = cams.mass_acceleration(response, frequency, damping_ratio)
    error, shock = (cams.response_peak(response, speed, quantity) for quantity in (response.error, acceleration))
    deviation, label = "deviation of the vibrating follower from its programme", "Maximum deviation from the programme"
    values = {
        "vibration.max_error": Value(error, "m", f"maximum {deviation}", label=label),
        "vibration.max_acceleration": Value(
            shock,
            "m/s^2",
            "maximum magnitude of the acceleration of the follower, vibration included",
            label="Maximum acceleration with vibration",
        ),
    }
    dwells = [k for k, piece in enumerate(model.programme.pieces) if piece.phase == "dwell"]
    if dwells:
        swing = cams.free_amplitude(response, frequency, damping_ratio)
        residual = max(float(swing[response.piece == k][0]) for k in dwells)
        meaning = "maximum amplitude of the residual vibration at the start of a dwell"
        values["vibration.residual"] = Value(residual, "m", meaning, label="Maximum residual vibration in dwell")
    limit, message = model.spec.limits.vibration, f"maximum {deviation}; reduce the speed or choose a smoother motion law"
    checks = (Check("vibration", error, limit, "<=", "m", message, ("follower",), label=label),) if limit else ()
    return Answer(values, (cams.vibration_table(model.cycle, response, reach, acceleration),), checks)
