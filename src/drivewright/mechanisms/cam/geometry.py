"""Geometry of a cam: motion, pressure angle, curvature, size of the face, closure."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial

import numpy as np

from drivewright import cams, curves
from drivewright.mechanisms.cam.arm_ends import end_measures, end_tables
from drivewright.mechanisms.cam.build import CamModel
from drivewright.mechanisms.cam.spec import TURN
from drivewright.motion import TableLaw
from drivewright.result import Answer, Answers, Check, Column, Table, Value, merge_answers


def motion(model: CamModel, done: Answers) -> Answer:
    """The programme over one turn, its jumps at the joints, and with a speed its velocities."""
    _, angle = model.cycle.samples()
    lift = [np.broadcast_to(part, angle.shape) for part in model.cycle.sampled()[1]]
    unit, peaks = _unit(model), model.programme.function.peaks()
    names = ("lift", "slope", "bend", "third")
    meanings = ("lift of the follower", *(f"{n} derivative of the lift" for n in ("first", "second", "third")))
    units = (unit, f"{unit}/rad", f"{unit}/rad^2", f"{unit}/rad^3")
    columns = (Column("angle", "rad", "cam angle", angle), *map(Column, names, units, meanings, lift))
    tables = (Table("motion", "Motion of the follower", columns), *_kinematics(model, angle, lift), *end_tables(model))
    return merge_answers((*(measure(model) for measure in motion_measures(model)), Answer(tables=tables, findings=_infinite(peaks))))


def motion_measures(model: CamModel) -> Iterator[Callable[[CamModel], Answer]]:
    """The functions that give the values and checks of the motion, as `geometry_measures`."""
    yield _lift
    yield _smoothing
    if model.turns:
        yield _peaks
    yield from end_measures(model)
    yield _continuity


def _unit(model):
    return "rad" if model.oscillating else "m"


def _lift(model):
    return Answer(
        {
            "lift": Value(float(np.ptp(model.cycle.sampled()[1].d0)), _unit(model), "stroke of the follower", label="Stroke"),
            "continuity": Value(
                float(model.programme.continuity),
                "-",
                "order of the highest continuous derivative of the lift",
                label="Order of continuity of the lift",
            ),
        }
    )


def _smoothing(model):
    """How far smoothed lifts depart from the rows of their tables."""
    found = [law.smoothing for segment in model.programme.segments if isinstance(law := segment.motion_law, TableLaw) and law.smoothing]
    if not found:
        return Answer()
    departure, jerk = max(each.departure for each in found), max(each.jerk for each in found)
    unit = model.programme.lift_unit
    return Answer(
        {
            "smoothing.departure": Value(
                departure, unit, "maximum deviation of the smoothed lift from a row of its table", label="Maximum deviation from the table"
            ),
            "smoothing.jerk": Value(
                jerk,
                "-",
                "RMS jerk of the smoothed lift over that of a spline through all rows",
                label="RMS jerk ratio, smoothed to unsmoothed",
            ),
        }
    )


def _rates(model):
    """(order, name, unit, kind) of velocity, acceleration and jerk."""
    kind = "angular " if model.oscillating else ""
    for order, name in enumerate(("velocity", "acceleration", "jerk"), start=1):
        yield order, name, f"{_unit(model)}/s^{order}".removesuffix("^1"), kind


def _peaks(model):
    """Peaks of velocity, acceleration and jerk at the cam's speed, where they are finite."""
    peaks = model.programme.function.peaks()
    return Answer(
        {
            f"max_{name}": Value(
                peaks[order - 1] * model.speed**order,
                unit,
                f"maximum magnitude of the {kind}{name} of the follower",
                label=f"Maximum follower {kind}{name}",
            )
            for order, name, unit, kind in _rates(model)
            if np.isfinite(peaks[order - 1])
        }
    )


def _kinematics(model, angle, lift):
    """The table of velocity, acceleration and jerk at the cam's speed."""
    if model.turns:
        rates = [
            Column(name, unit, f"{kind}{name} of the follower", lift[order] * model.speed**order)
            for order, name, unit, kind in _rates(model)
        ]
        yield Table("kinematics", "Velocity, acceleration and jerk", (Column("angle", "rad", "cam angle", angle), *rates))


def _continuity(model):
    """Jumps of velocity and acceleration over their own peaks, laws and joints alike."""
    limits, function = model.spec.limits, model.programme.function
    return Answer(
        checks=tuple(
            Check(
                f"continuity.{name}",
                function.relative_jump(order),
                limit,
                "<=",
                "-",
                f"maximum jump of the {name} over its peak; choose motion laws whose {name} agrees at the joints",
                ("follower",),
                label=f"Relative {name} jump",
            )
            for order, name, limit in ((1, "velocity", limits.velocity_jump), (2, "acceleration", limits.acceleration_jump))
        )
    )


def _infinite(peaks):
    names = [name for name, peak in (("acceleration", peaks.Am), ("jerk", peaks.Jm)) if not np.isfinite(peak)]
    if not names:
        return ()
    return (
        f"the maximum {' and '.join(names)} {'are' if len(names) > 1 else 'is'} infinite: a lower derivative jumps at a joint; "
        "choose motion laws that match there",
    )


# -- geometry ------------------------------------------------------------------------------------------------------------------


def geometry(model: CamModel, done: Answers) -> Answer:
    """Pressure angles per phase and surface, curvature of the pitch curve, size of a flat face, closure."""
    measured = merge_answers(measure(model) for measure in geometry_measures(model))
    tables = tuple(table for track in model.tracks if track.cut for table in _tables(model, track))
    return merge_answers((existing(measured), Answer(tables=tables, findings=tuple(_absent(model, measured.values)))))


def geometry_measures(model: CamModel) -> Iterator[Callable[[CamModel], Answer]]:
    """The functions that give the values and checks of the geometry; of many designs columns (n, 1), nan where there is none.

    All models of one structure (follower, closure, phases of the programme) have the same ones.
    """
    yield _closure
    for number, track in enumerate(model.tracks):
        if track.cut:
            yield partial(_pressure, number=number)
            yield from (partial(_phase_pressure, number=number, phase=phase) for phase in ("rise", "return") if phase in model.phases)
            yield partial(_convex, number=number)
            if not track.flat:
                yield partial(_concave, number=number)
    if model.tracks[0].flat:
        yield _face
        yield _base_radius


def existing(answer: Answer) -> Answer:
    """The answer without the values and checks that are nan, as they do not exist for the design."""
    values = {name: value for name, value in answer.values.items() if not np.isnan(value.value)}
    return replace(answer, values=values, checks=tuple(check for check in answer.checks if not np.isnan(check.value)))


def _absent(model, values):
    """What to say of values that a design should have and does not."""
    for track in model.tracks:
        if track.cut and np.isnan(values[f"{track.prefix}min_convex_radius"].value):
            yield f"{track.prefix}min_convex_radius is absent: the radius of curvature of the {track.curve} passes through zero"
    if "min_base_radius" in values and np.isnan(values["min_base_radius"].value):
        yield "min_base_radius is absent: no base radius is free of undercut; move the pivot away or reduce the swing"


def _tables(model, track):
    yield track.geometry_table(model.cycle)
    if track.radius and not track.flat:
        yield track.undercut_table(model.cycle)


def _extreme_values(name, place, value, at):
    """A value and the cam angle where it stands; `at`: the label of that."""
    angle = Value(place.angle % TURN, "rad", f"cam angle at the {value.meaning}", label=at, convention="0 at the start of the programme")
    return {name: value, f"{name}.at": angle}


def _pressure_angle(track):
    return lambda angle, lift: track.contact(angle, lift).pressure_angle


def _pressure(model, number):
    """Extremes of the pressure angle over the turn, signed."""
    track = model.tracks[number]
    high, low = (extreme(_pressure_angle(track)) for extreme in (model.cycle.maximum, model.cycle.minimum))
    values = {}
    for name, words, place in (("max", "maximum", high), ("min", "minimum", low)):
        label, at = (track.label(text) for text in (f"{words.capitalize()} pressure angle", f"Cam angle at {words} pressure angle"))
        value = Value(place.value, "rad", f"{words} pressure angle over the turn{track.of}", label=label, convention=_sense(track))
        values |= _extreme_values(f"{track.prefix}{name}_pressure_angle", place, value, at)
    if track.flank < 0:  # the walls of a groove share their normals
        return Answer(values)
    given = model.spec.limits.pressure_angle
    limit = np.radians(45 if model.oscillating else 30) if given is None else given
    size = np.maximum(high.value, -low.value)
    remedy = "reduce the tilt or the offset of the face" if track.flat else "enlarge the prime radius or lengthen the segment"
    message, label = f"maximum magnitude of the pressure angle; {remedy}", track.label("Maximum pressure angle")
    return Answer(values, (), (Check(f"pressure_angle{track.suffix}", size, limit, "<=", "rad", message, (track.name,), label=label),))


def _sense(track):
    """The convention of sign of a pressure angle."""
    return "positive where it opposes " + ("the outward motion of the second roller" if track.name == "conjugate" else "the rise")


def _phase_pressure(model, number, phase):
    """Largest magnitude of the pressure angle in a phase."""
    track, cycle = model.tracks[number], model.phases.get(phase)
    if cycle is None:
        return Answer()
    size = np.maximum(cycle.maximum(_pressure_angle(track)).value, -cycle.minimum(_pressure_angle(track)).value)
    meaning, label = f"maximum magnitude of the pressure angle in the {phase}{track.of}", track.label(f"Maximum pressure angle, {phase}")
    return Answer({f"{track.prefix}max_pressure_angle.{phase}": Value(size, "rad", meaning, label=label)})


def _convex(model, number):
    """Minimum convex radius of the pitch curve (of the profile under a flat face), and undercut of a profile worked from outside."""
    track = model.tracks[number]
    if track.flat:
        least = cams.min_flat_radius(model.cycle, track.flat_face)
        message = "minimum radius of curvature of the profile; below 0 the flat face undercuts it: enlarge the base radius"
        check = Check("undercut", least.value, 0.0, ">=", "m", message, ("cam",), True, label="Undercut, profile radius")
        return Answer(_radius_values(track, "convex", least.where(np.greater(least.value, 0))), (), (check,))
    place = cams.min_pitch_radius(model.cycle, track.contact, 1)
    return Answer(_radius_values(track, "convex", place), (), _undercut(model, track, place) if track.flank > 0 else ())


def _concave(model, number):
    """Minimum concave radius of the pitch curve, and undercut of an outer wall."""
    track = model.tracks[number]
    place = cams.min_pitch_radius(model.cycle, track.contact, -1)
    return Answer(_radius_values(track, "concave", place), (), _undercut(model, track, place) if track.flank < 0 else ())


def _radius_values(track, name, place):
    """A least radius of curvature of the pitch curve, and that of the profile which a round face leaves on the outside of a cam: the face
    takes its radius from a convex bend."""
    meaning = f"minimum radius of curvature of the {track.curve} where it is {name} as seen from outside{track.of}"
    value = Value(place.value, "m", meaning, label=track.label(f"Minimum {name} radius, {track.curve}"))
    values = _extreme_values(f"{track.prefix}min_{name}_radius", place, value, track.label(f"Cam angle at minimum {name} radius"))
    if track.flat or track.flank < 0:
        return values
    radius = place.value + (track.radius if name == "concave" else -track.radius)
    meaning = f"minimum radius of curvature of the profile where it is {name} as seen from outside{track.of}"
    value = Value(cams.nan_unless(radius > 0, radius), "m", meaning, label=track.label(f"Minimum {name} radius, profile"))
    return values | {f"{track.prefix}profile.min_{name}_radius": value}


def _undercut(model, track, place):
    """Radius of the pitch curve over that of the face, where the face is inside the bend; the plot shows the reciprocal, free of poles."""
    if np.all(track.radius == 0):
        return ()
    ratio, recommended, parts = place.value / track.radius, model.spec.limits.curvature_ratio, (track.name,)
    over, remedy = (
        "minimum radius of curvature of the pitch curve over the face radius",
        "enlarge the prime radius or reduce the face radius",
    )
    message, margin = f"{over}; below 1 the profile is undercut: {remedy}", f"{over}, recommended value; {remedy}"
    label, advised = track.label("Undercut, pitch/face radius"), track.label("Curvature ratio, recommended")
    return (
        Check(f"undercut{track.suffix}", ratio, 1.0, ">=", "-", message, parts, True, label=label),
        Check(f"curvature_margin{track.suffix}", ratio, recommended, ">=", "-", margin, parts, label=advised),
    )


def _face(model):
    """How large a flat face must be."""
    low, high = cams.face_ends(model.cycle, model.follower)
    slope = [extreme(lambda _, lift: curves.derivative(lift)).value for extreme in (model.cycle.minimum, model.cycle.maximum)]
    half = 0.5 * (high - low) if model.oscillating else max(-slope[0], slope[1])
    about = "" if model.oscillating else " about the cam axis: max |ds/dtheta|"
    origin = (
        "0 at the foot of the pivot" if model.oscillating else "0 at the follower's line, positive on the side of the contact in the rise"
    )
    values = {
        f"face.{end}": Value(
            place,
            "m",
            f"{words} position of the contact along the face",
            label=f"{words.capitalize()} contact position on the face",
            convention=origin,
        )
        for end, words, place in (("start", "minimum", low), ("end", "maximum", high))
    }
    half_used = f"half the length of the face that the contact uses{about}"
    values["min_half_face"] = Value(half, "m", half_used, label="Required half length of the face")
    given = model.spec.follower
    if given.half_face is None:
        return Answer(values)
    middle = given.arm_length if model.oscillating else given.face_offset
    used = np.maximum(high - middle, middle - low)
    message = "maximum distance of the contact from the middle of the face; lengthen the face (half_face) or shift it (face_offset)"
    check = Check("half_face", used, given.half_face, "<=", "m", message, ("follower",), label="Half length of the face in use")
    return Answer(values, (), (check,))


def _base_radius(model):
    """How large a flat-faced cam must be."""
    base = cams.min_base_radius(model.cycle, model.follower)
    meaning = "minimum base radius at which the flat face does not undercut the profile"
    return Answer({"min_base_radius": Value(base, "m", meaning, label="Minimum base radius without undercut")})


def _closure(model):
    """What the chosen closure requires of the shape."""
    limits = model.spec.limits
    if model.spec.closure == "yoke":
        error, label = cams.breadth(model.cycle).error, "Breadth error of the yoke"
        meaning = "maximum clearance or interference of the yoke: deviation of s(theta) + s(theta + pi) from its mean"
        breadth = "distance between the two faces, or the two roller centres, of the yoke"
        values = {
            "yoke.breadth": Value(model.yoke_breadth, "m", breadth, label="Breadth of the yoke"),
            "yoke.breadth_error": Value(error, "m", meaning, label=label),
        }
        message = "deviation of s(theta) + s(theta + pi) from a constant; the return must mirror the rise half a turn later"
        parts = ("follower", "cam")
        return Answer(values, (), (Check("closure.breadth", error, limits.breadth_error, "<=", "m", message, parts, True, label=label),))
    if model.spec.closure == "groove":
        travel, label = cams.play(model.cycle, model.tracks[0].contact, model.clearance), "Follower play in the groove"
        meaning = "maximum travel of the follower through the clearance of the groove"
        message = f"{meaning}; reduce groove.clearance or the pressure angle"
        check = Check("groove.play", travel, limits.play, "<=", "m", message, ("follower",), label=label)
        return Answer({"groove.play": Value(travel, "m", meaning, label=label)}, (), (check,))
    return Answer()
