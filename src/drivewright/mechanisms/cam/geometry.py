"""What is asked of a cam's geometry: motion, pressure angle, curvature, size of the face, closure."""

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
            "lift": Value(float(np.ptp(model.cycle.sampled()[1].d0)), _unit(model), "stroke of the follower"),
            "continuity": Value(float(model.programme.continuity), "-", "order of the highest derivative of the lift that does not jump"),
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
            "smoothing.departure": Value(departure, unit, "largest departure of the smoothed lift from a row of its table"),
            "smoothing.jerk": Value(jerk, "-", "rms jerk of the smoothed lift over that of a spline through all rows"),
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
            f"max_{name}": Value(peaks[order - 1] * model.speed**order, unit, f"largest {kind}{name} of the follower, magnitude")
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
                f"largest jump of the {name} over its peak",
                ("follower",),
                label=f"{name} jump over its peak",
            )
            for order, name, limit in ((1, "velocity", limits.velocity_jump), (2, "acceleration", limits.acceleration_jump))
        )
    )


def _infinite(peaks):
    names = [name for name, peak in (("acceleration", peaks.Am), ("jerk", peaks.Jm)) if not np.isfinite(peak)]
    return (f"the largest {' and the largest '.join(names)} are infinite: at a joint a lower derivative jumps",) if names else ()


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
            yield f"{track.prefix}min_convex_radius is absent: the radius of the {track.curve} passes through zero"
    if "min_base_radius" in values and np.isnan(values["min_base_radius"].value):
        yield "min_base_radius is absent: no base radius is free of undercut; move the pivot away or reduce the swing"


def _tables(model, track):
    yield track.geometry_table(model.cycle)
    if track.radius and not track.flat:
        yield track.undercut_table(model.cycle)


def _extreme_values(name, place, unit, meaning):
    """A value and the cam angle where it stands."""
    return {
        name: Value(place.value, unit, meaning),
        f"{name}.at": Value(place.angle % TURN, "rad", f"cam angle of {name}, from the start of the programme"),
    }


def _pressure_angle(track):
    return lambda angle, lift: track.contact(angle, lift).pressure_angle


def _pressure(model, number):
    """Extremes of the pressure angle over the turn, signed."""
    track = model.tracks[number]
    high, low = (extreme(_pressure_angle(track)) for extreme in (model.cycle.maximum, model.cycle.minimum))
    values = _extreme_values(f"{track.prefix}max_pressure_angle", high, "rad", "largest pressure angle, positive where it opposes the rise")
    values |= _extreme_values(f"{track.prefix}min_pressure_angle", low, "rad", "least pressure angle, positive where it opposes the rise")
    if track.flank < 0:  # the walls of a groove share their normals
        return Answer(values)
    given = model.spec.limits.pressure_angle
    limit = np.radians(45 if model.oscillating else 30) if given is None else given
    size = np.maximum(high.value, -low.value)
    check = Check(f"pressure_angle{track.suffix}", size, limit, "<=", "rad", "largest pressure angle, magnitude", (track.name,))
    return Answer(values, (), (check,))


def _phase_pressure(model, number, phase):
    """Largest magnitude of the pressure angle in a phase."""
    track, cycle = model.tracks[number], model.phases.get(phase)
    if cycle is None:
        return Answer()
    size = np.maximum(cycle.maximum(_pressure_angle(track)).value, -cycle.minimum(_pressure_angle(track)).value)
    name, meaning = f"{track.prefix}max_pressure_angle.{phase}", f"largest pressure angle in the {phase}, magnitude"
    return Answer({name: Value(size, "rad", meaning)})


def _convex(model, number):
    """Sharpest convex place of the pitch curve (of the profile under a flat face), and undercut of a profile worked from outside."""
    track = model.tracks[number]
    if track.flat:
        least = cams.min_flat_radius(model.cycle, track.flat_face)
        message = "least radius of curvature of the profile: below 0 the face cuts it away"
        check = Check("undercut", least.value, 0.0, ">=", "m", message, ("cam",), True, label="undercut, profile radius")
        return Answer(_radius_values(track, "convex", least.where(np.greater(least.value, 0))), (), (check,))
    place = cams.min_pitch_radius(model.cycle, track.contact, 1)
    return Answer(_radius_values(track, "convex", place), (), _undercut(model, track, place) if track.flank > 0 else ())


def _concave(model, number):
    """Sharpest concave place of the pitch curve, and undercut of an outer wall."""
    track = model.tracks[number]
    place = cams.min_pitch_radius(model.cycle, track.contact, -1)
    return Answer(_radius_values(track, "concave", place), (), _undercut(model, track, place) if track.flank < 0 else ())


def _radius_values(track, name, place):
    """A least radius of curvature of the pitch curve, and that of the profile which a round face leaves on the outside of a cam: the face
    takes its radius from a convex bend."""
    meaning = f"least radius of curvature of the {track.curve} where it is {name} seen from outside"
    values = _extreme_values(f"{track.prefix}min_{name}_radius", place, "m", meaning)
    if track.flat or track.flank < 0:
        return values
    radius = place.value + (track.radius if name == "concave" else -track.radius)
    meaning = f"least radius of curvature of the profile where it is {name} seen from outside"
    return values | {f"{track.prefix}profile.min_{name}_radius": Value(cams.nan_unless(radius > 0, radius), "m", meaning)}


def _undercut(model, track, place):
    """Radius of the pitch curve over that of the face, where the face is inside the bend; the plot shows the reciprocal, free of poles."""
    if np.all(track.radius == 0):
        return ()
    ratio, recommended, parts = place.value / track.radius, model.spec.limits.curvature_ratio, (track.name,)
    message = "least radius of the pitch curve over that of the face: below 1 the profile cuts itself away"
    label, advised = f"undercut, pitch/face radius{track.surface}", f"recommended pitch/face ratio{track.surface}"
    margin = "least convex radius over roller radius, recommended"
    return (
        Check(f"undercut{track.suffix}", ratio, 1.0, ">=", "-", message, parts, True, label=label),
        Check(f"curvature_margin{track.suffix}", ratio, recommended, ">=", "-", margin, parts, label=advised),
    )


def _face(model):
    """How large a flat face must be."""
    low, high = cams.face_ends(model.cycle, model.follower)
    slope = [extreme(lambda _, lift: curves.derivative(lift)).value for extreme in (model.cycle.minimum, model.cycle.maximum)]
    half = 0.5 * (high - low) if model.oscillating else max(-slope[0], slope[1])
    about = "" if model.oscillating else ", about the cam's axis: max |ds/dtheta|"
    origin = "the foot of the pivot" if model.oscillating else "the follower's line"
    values = {
        "face.start": Value(low, "m", f"least place of the contact on the face, from {origin}"),
        "face.end": Value(high, "m", f"greatest place of the contact on the face, from {origin}"),
        "min_half_face": Value(half, "m", f"half the length of face that is used{about}"),
    }
    given = model.spec.follower
    if given.half_face is None:
        return Answer(values)
    middle = given.arm_length if model.oscillating else given.face_offset
    used, message = np.maximum(high - middle, middle - low), "the contact stays on the flat face, measured from its middle"
    check = Check("half_face", used, given.half_face, "<=", "m", message, ("follower",), label="half length of face in use")
    return Answer(values, (), (check,))


def _base_radius(model):
    """How large a flat-faced cam must be."""
    base = cams.min_base_radius(model.cycle, model.follower)
    return Answer({"min_base_radius": Value(base, "m", "least base radius without undercut")})


def _closure(model):
    """What the chosen closure asks of the shape."""
    limits = model.spec.limits
    if model.spec.closure == "yoke":
        error, meaning = cams.breadth(model.cycle).error, "largest play or interference of the yoke: departure of s(theta) + s(theta + pi)"
        values = {
            "yoke.breadth": Value(model.yoke_breadth, "m", "distance of the two faces, or roller centres, of the yoke"),
            "yoke.breadth_error": Value(error, "m", meaning),
        }
        message = "the yoke fits at every angle: s(theta) + s(theta + pi) is constant"
        parts, label = ("follower", "cam"), "error of the constant breadth"
        return Answer(values, (), (Check("closure.breadth", error, limits.breadth_error, "<=", "m", message, parts, True, label=label),))
    if model.spec.closure == "groove":
        travel, meaning = cams.play(model.cycle, model.tracks[0].contact, model.clearance), "travel through the clearance of the groove"
        check = Check("groove.play", travel, limits.play, "<=", "m", meaning, ("follower",), label="play in the groove")
        return Answer({"groove.play": Value(travel, "m", meaning)}, (), (check,))
    return Answer()
