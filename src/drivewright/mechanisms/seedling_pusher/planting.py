"""Train and track of the needle, and the requirements of planting."""

import numpy as np

from drivewright.mechanisms.seedling_pusher.build import GRID, TURN, PusherModel
from drivewright.numerics.roots import extremes
from drivewright.result import Answer, Answers, Check, Column, Table, Value


def train(model: PusherModel, done: Answers) -> Answer:
    """Collinear phase, tip track, arm rotation."""
    arm = model.arm
    collinear = arm.train.collinear_angles()
    _, back, _, forth = extremes(lambda t: arm.rotation(t).d0, 0, TURN)
    aligned = "carrier angle where planet and intermediate gear are collinear, the"
    values = {
        "train.collinear_angle": Value(float(collinear[-1]), "rad", f"{aligned} later one"),
        "train.collinear_angle.first": Value(float(collinear[0]), "rad", f"{aligned} earlier one"),
        "train.swing": Value(forth - back, "rad", "oscillation of the planting arm in the world"),
        "tip.lowest_angle": Value(arm.lowest, "rad", "carrier angle where the tip is lowest"),
        "tip.highest_angle": Value(arm.highest, "rad", "carrier angle where the tip is highest"),
        "tip.track_height": Value(arm.track_height, "m", "highest minus lowest point of the tip track, machine frame"),
        "tip.track_width": Value(arm.track_width, "m", "width of the tip track, machine frame"),
    }
    checks = (Check("track.height", arm.track_height, model.spec.limits.track_height, "<=", "m", "height of the tip track", ("arm",)),)
    return Answer(values, (_cycle_table(model),), checks)


def _cycle_table(model):
    """Everything that moves, over one turn of the carrier."""
    planet, tip, axis, rod = model.arm.planet(GRID), model.arm.point(GRID), model.arm.axis(GRID), model.pair.travel(GRID)
    end = model.rod_end(GRID)
    speed, aligned = model.spec.drive.speed, "the same, 0 (mod 2 pi) where planet and intermediate gear are collinear"
    return Table(
        "cycle",
        "One turn of the carrier",
        (
            Column("carrier_angle", "rad", "turn of the carrier", GRID),
            Column("planet_angle", "rad", "planet on the carrier", planet.d0),
            Column("planet_phase", "rad", aligned, planet.d0 + model.arm.train.phase),
            Column("planet_ratio", "-", "planet speed relative to the carrier, over carrier speed", planet.d1),
            Column("arm_rotation", "rad", "arm in the world", model.arm.rotation(GRID).d0),
            Column("needle_angle", "rad", "needle below the horizontal", model.needle_angle(GRID)),
            Column("tip_x", "m", "needle tip, machine frame", tip.d0.real),
            Column("tip_y", "m", "needle tip, machine frame", tip.d0.imag),
            Column("field_x", "m", "needle tip, field frame", tip.d0.real + model.advance * GRID / TURN),
            Column("axis_x", "m", "planet axis, machine frame", axis.d0.real),
            Column("axis_y", "m", "planet axis, machine frame", axis.d0.imag),
            Column("rod_end_x", "m", "end of the pusher rod, machine frame", end.real, "rod end, horizontal"),
            Column("rod_end_y", "m", "end of the pusher rod, machine frame", end.imag, "rod end, vertical"),
            Column("rod", "m", "travel of the pusher rod", rod.d0),
            Column("rod_velocity", "m/s", "velocity of the rod in the arm", rod.d1 * speed),
            Column("rod_acceleration", "m/s^2", "acceleration of the rod in the arm", rod.d2 * speed**2),
            Column("rod_jerk", "m/s^3", "jerk of the rod in the arm", rod.d3 * speed**3),
            Column("lever_swing", "rad", "swing of the lever", model.pair.swing(GRID).d0),
        ),
    )


# -- planting ------------------------------------------------------------------------------------------------------------------


def planting(model: PusherModel, done: Answers) -> Answer:
    """Needle angles at the two events, the hole in the soil, clearances: the requirements of planting."""
    take, push = take_event(model), push_event(model)
    if take is None:
        return Answer(findings=("the tip never crosses the gate line: no take angle; move events.gate_point onto the track",))
    arm, pair = model.arm, model.pair
    take_angle, push_angle = float(model.needle_angle(take)), float(model.needle_angle(push))
    difference, clear = push_angle - take_angle, axis_clearance(model)
    mouth = arm.opening_width(model.spec.field.mouth_height, model.advance)
    start_depth, end_depth = (float(arm.height(t)) for t in (pair.start, pair.start + model.spec.push.rise))
    values = {
        "needle.take_event": Value(take, "rad", "carrier angle of taking"),
        "needle.push_event": Value(push, "rad", "carrier angle of pushing"),
        "needle.take_angle": Value(take_angle, "rad", "needle below the horizontal where it takes"),
        "needle.push_angle": Value(push_angle, "rad", "needle below the horizontal where it pushes"),
        "needle.angle_difference": Value(difference, "rad", "push angle minus take angle"),
        "tip.height_at_push_start": Value(start_depth, "m", "tip above its lowest point when the push starts"),
        "tip.height_at_push_end": Value(end_depth, "m", "the same when the push ends"),
        "rod.needle_distance": Value(abs(model.rod_distance), "m", "distance of the rod's line from the needle's"),
        "planting.mouth_width": Value(mouth, "m", "width of the hole at the soil surface"),
        "planting.axis_clearance": Value(clear, "m", "planet axis to the lower half of planted seedlings"),
    }
    checks = _planting_checks(model, take_angle, push_angle, difference, start_depth, mouth, clear)
    return Answer(values, (), checks, _rod_findings(model))


def _rod_findings(model):
    if model.pair.orbit > 0:
        return ()
    return (
        'cams.orbit = "clockwise": this train turns the arm counter-clockwise on the carrier, so the lever pivot can orbit the cams '
        "clockwise only with everything mirrored, the rod on the far side of the planet axis from the needle; "
        '"counter-clockwise" puts rod and needle together',
    )


def _planting_checks(model, take, push, difference, start_depth, mouth, clear):
    limits, parts = model.spec.limits, ("arm",)
    deviation, depth, distance = abs(difference - limits.angle_difference), model.spec.field.mouth_height, abs(model.rod_distance)
    slope = "difference of the two from the slope of the seedling box"
    clearance = "track of the planet axis in the field stays off the lower half of planted seedlings"
    return (
        Check("take_angle.lower", take, limits.take_angle[0], ">=", "rad", "needle at taking: steep enough to grip", parts),
        Check("take_angle.upper", take, limits.take_angle[1], "<=", "rad", "needle at taking: flat enough to spare the seedlings", parts),
        Check("push_angle.lower", push, limits.push_angle[0], ">=", "rad", "needle at pushing: steep enough to plant upright", parts),
        Check("push_angle.upper", push, limits.push_angle[1], "<=", "rad", "needle at pushing: not steeper than upright", parts),
        Check("angle_difference", deviation, limits.angle_difference_tolerance, "<=", "rad", slope, parts),
        Check("push_start_in_soil", start_depth, depth, "<=", "m", "the tip is in the soil when the push starts", parts),
        Check("rod_at_needle", distance, limits.rod_distance, "<=", "m", "the rod runs along the needle", ("rod", "arm")),
        Check("mouth_width", mouth, limits.mouth_width, "<=", "m", "hole that the needle leaves in the soil surface", parts),
        Check("axis_clearance", clear, limits.axis_clearance, ">=", "m", clearance, parts),
    )


def push_event(model: PusherModel) -> float:
    """Carrier angle that counts as pushing."""
    start, rise = model.pair.start, model.spec.push.rise
    return float({"lowest": model.arm.lowest, "push-end": start + rise, "push-start": start}[model.spec.events.push])


def take_event(model: PusherModel) -> float | None:
    """Carrier angle that counts as taking; None where a gate line is never crossed."""
    events = model.spec.events
    if events.take == "top":
        return model.arm.highest
    if events.take == "angle":
        return events.take_angle
    return _gate_crossing(model)


def _gate_crossing(model):
    """The last crossing of the gate line on the way down to the lowest point."""
    events, arm = model.spec.events, model.arm
    crossings = arm.line_crossings(complex(*events.gate_point), events.gate_direction)
    return float(min(crossings, key=lambda t: (arm.lowest - t) % TURN)) if len(crossings) else None


def axis_clearance(model: PusherModel) -> float:
    """Least distance in the field from the planet axis to the lower half of any planted seedling [m].

    A seedling stands upright over the point where the tip was lowest, one per turn.
    """
    arm, field = model.arm, model.spec.field
    lowest = arm.point(arm.lowest).d0
    surface = lowest.imag + field.mouth_height
    top = surface + field.seedling_height / 2
    t = np.linspace(0, TURN, 1441)
    axis = arm.axis(t).d0 + model.advance * t / TURN
    rows = lowest.real + model.advance * (arm.lowest / TURN - np.arange(0, 4))
    above = np.maximum(axis.imag - top, 0.0)
    return float(np.min(np.hypot(axis.real[:, None] - rows, above[:, None])))
