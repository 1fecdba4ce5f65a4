"""Train and track of the needle, and the requirements of planting."""

import numpy as np

from drivewright.mechanisms.seedling_pusher.build import GRID, TURN, PusherModel
from drivewright.numerics.roots import bracketed_roots, extremes
from drivewright.result import Answer, Answers, Check, Column, Table, Value


def train(model: PusherModel, done: Answers) -> Answer:
    """Collinear phase, tip track, arm rotation."""
    top, bottom = (model.tip(t).d0.imag for t in (model.highest, model.lowest))
    collinear = model.train.collinear_angles()
    rotation = extremes(lambda t: model.arm_rotation(t).d0, 0, TURN)
    left, right = extremes(lambda t: model.tip(t).d0.real, 0, TURN)[1::2]
    values = {
        "train.collinear_angle": Value(
            float(collinear[-1]), "rad", "carrier angle where planet and intermediate gear are collinear, the later one"
        ),
        "train.collinear_angle.first": Value(
            float(collinear[0]), "rad", "carrier angle where planet and intermediate gear are collinear, the earlier one"
        ),
        "train.swing": Value(rotation[3] - rotation[1], "rad", "oscillation of the planting arm in the world"),
        "tip.lowest_angle": Value(model.lowest, "rad", "carrier angle where the tip is lowest"),
        "tip.highest_angle": Value(model.highest, "rad", "carrier angle where the tip is highest"),
        "tip.track_height": Value(float(top - bottom), "m", "highest minus lowest point of the tip track, machine frame"),
        "tip.track_width": Value(right - left, "m", "width of the tip track, machine frame"),
    }
    checks = (Check("track.height", float(top - bottom), model.spec.limits.track_height, "<=", "m", "height of the tip track", ("arm",)),)
    return Answer(values, (_cycle_table(model),), checks)


def _cycle_table(model):
    """Everything that moves, over one turn of the carrier."""
    planet, tip, axis, rod = model.planet(GRID), model.tip(GRID), model.planet_axis(GRID), model.rod(GRID)
    speed = model.spec.drive.speed
    return Table(
        "cycle",
        "One turn of the carrier",
        (
            Column("carrier_angle", "rad", "turn of the carrier", GRID),
            Column("planet_angle", "rad", "planet on the carrier", planet.d0),
            Column(
                "planet_phase",
                "rad",
                "the same, 0 (mod 2 pi) where planet and intermediate gear are collinear",
                planet.d0 + model.train.phase,
            ),
            Column("planet_ratio", "-", "planet speed relative to the carrier, over carrier speed", planet.d1),
            Column("arm_rotation", "rad", "arm in the world", model.arm_rotation(GRID).d0),
            Column("needle_angle", "rad", "needle below the horizontal", model.needle_angle(GRID)),
            Column("tip_x", "m", "needle tip, machine frame", tip.d0.real),
            Column("tip_y", "m", "needle tip, machine frame", tip.d0.imag),
            Column("field_x", "m", "needle tip, field frame", tip.d0.real + advance(model) * GRID / TURN),
            Column("axis_x", "m", "planet axis, machine frame", axis.d0.real),
            Column("axis_y", "m", "planet axis, machine frame", axis.d0.imag),
            Column("rod", "m", "travel of the pusher rod", rod.d0),
            Column("rod_velocity", "m/s", "velocity of the rod in the arm", rod.d1 * speed),
            Column("rod_acceleration", "m/s^2", "acceleration of the rod in the arm", rod.d2 * speed**2),
            Column("rod_jerk", "m/s^3", "jerk of the rod in the arm", rod.d3 * speed**3),
            Column("lever_swing", "rad", "swing of the lever", model.swing(GRID).d0),
        ),
    )


def advance(model: PusherModel) -> float:
    """How far the machine drives per carrier turn, signed [m]."""
    return model.spec.field.spacing * (1 if model.spec.field.travel == "+x" else -1)


# -- planting ------------------------------------------------------------------------------------------------------------------


def planting(model: PusherModel, done: Answers) -> Answer:
    """Needle angles at the two events, the hole in the soil, clearances: the requirements of planting."""
    take, push = take_event(model), push_event(model)
    if take is None:
        return Answer(findings=("the tip never crosses the gate line: no take angle; move events.gate_point onto the track",))
    take_angle, push_angle = float(model.needle_angle(take)), float(model.needle_angle(push))
    difference, mouth, clear = push_angle - take_angle, mouth_width(model), axis_clearance(model)
    start_depth = float(_height(model, model.push_start))
    values = {
        "needle.take_event": Value(take, "rad", "carrier angle of taking"),
        "needle.push_event": Value(push, "rad", "carrier angle of pushing"),
        "needle.take_angle": Value(take_angle, "rad", "needle below the horizontal where it takes"),
        "needle.push_angle": Value(push_angle, "rad", "needle below the horizontal where it pushes"),
        "needle.angle_difference": Value(difference, "rad", "push angle minus take angle"),
        "tip.height_at_push_start": Value(start_depth, "m", "tip above its lowest point when the push starts"),
        "tip.height_at_push_end": Value(float(_height(model, model.push_start + model.spec.push.rise)), "m", "the same when the push ends"),
        "rod.needle_distance": Value(abs(model.rod_distance), "m", "distance of the rod's line from the needle's"),
        "planting.mouth_width": Value(mouth, "m", "width of the hole at the soil surface"),
        "planting.axis_clearance": Value(clear, "m", "planet axis to the lower half of planted seedlings"),
    }
    checks = _planting_checks(model, take_angle, push_angle, difference, start_depth, mouth, clear)
    return Answer(values, (), checks, _rod_findings(model))


def _rod_findings(model):
    if model.orbit > 0:
        return ()
    return (
        'cams.orbit = "clockwise": this train turns the arm counter-clockwise on the carrier, so the lever pivot can orbit the cams '
        "clockwise only with everything mirrored, the rod on the far side of the planet axis from the needle; "
        '"counter-clockwise" puts rod and needle together',
    )


def _planting_checks(model, take, push, difference, start_depth, mouth, clear):
    limits, both = model.spec.limits, ("arm",)
    wanted, tolerance = limits.angle_difference, limits.angle_difference_tolerance
    return (
        Check("take_angle.lower", take, limits.take_angle[0], ">=", "rad", "needle at taking: steep enough to grip", both),
        Check("take_angle.upper", take, limits.take_angle[1], "<=", "rad", "needle at taking: flat enough to spare the seedlings", both),
        Check("push_angle.lower", push, limits.push_angle[0], ">=", "rad", "needle at pushing: steep enough to plant upright", both),
        Check("push_angle.upper", push, limits.push_angle[1], "<=", "rad", "needle at pushing: not steeper than upright", both),
        Check(
            "angle_difference",
            abs(difference - wanted),
            tolerance,
            "<=",
            "rad",
            "difference of the two from the slope of the seedling box",
            both,
        ),
        Check(
            "push_start_in_soil", start_depth, model.spec.field.mouth_height, "<=", "m", "the tip is in the soil when the push starts", both
        ),
        Check("rod_at_needle", abs(model.rod_distance), limits.rod_distance, "<=", "m", "the rod runs along the needle", ("rod", "arm")),
        Check("mouth_width", mouth, limits.mouth_width, "<=", "m", "hole that the needle leaves in the soil surface", both),
        Check(
            "axis_clearance",
            clear,
            limits.axis_clearance,
            ">=",
            "m",
            "track of the planet axis in the field stays off the lower half of planted seedlings",
            both,
        ),
    )


def push_event(model: PusherModel) -> float:
    """Carrier angle that counts as pushing."""
    start, rise = model.push_start, model.spec.push.rise
    return float({"lowest": model.lowest, "push-end": start + rise, "push-start": start}[model.spec.events.push])


def take_event(model: PusherModel) -> float | None:
    """Carrier angle that counts as taking; None where a gate line is never crossed."""
    events = model.spec.events
    if events.take == "top":
        return model.highest
    if events.take == "angle":
        return events.take_angle
    return _gate_crossing(model)


def _gate_crossing(model):
    """The last crossing of the gate line on the way down to the lowest point."""
    events = model.spec.events
    normal = 1j * np.exp(1j * events.gate_direction)
    crossings = bracketed_roots(lambda t: ((model.tip(t).d0 - complex(*events.gate_point)) * np.conj(normal)).real, GRID)
    return float(min(crossings, key=lambda t: (model.lowest - t) % TURN)) if len(crossings) else None


def _height(model, t):
    """Tip above its lowest point [m]."""
    return model.tip(t).d0.imag - model.tip(model.lowest).d0.imag


def _surface_crossings(model):
    """Carrier angles where the tip passes the soil surface, around the lowest point: into it and out of it."""
    grid = model.lowest + np.linspace(-np.pi, np.pi, 721)
    crossings = bracketed_roots(lambda t: _height(model, t) - model.spec.field.mouth_height, grid)
    before, after = crossings[crossings < model.lowest], crossings[crossings > model.lowest]
    return (before[-1], after[0]) if len(before) and len(after) else None


def mouth_width(model: PusherModel) -> float:
    """Width of the hole that the tip cuts at the soil surface, field frame [m]; 0 where the tip never leaves the soil."""
    crossings = _surface_crossings(model)
    if crossings is None:
        return 0.0
    x = [model.tip(t).d0.real + advance(model) * t / TURN for t in crossings]
    return float(abs(x[1] - x[0]))


def axis_clearance(model: PusherModel) -> float:
    """Least distance in the field from the planet axis to the lower half of any planted seedling [m].

    A seedling stands upright over the point where the tip was lowest, one per turn.
    """
    lowest = model.tip(model.lowest).d0
    surface = lowest.imag + model.spec.field.mouth_height
    top = surface + model.spec.field.seedling_height / 2
    t = np.linspace(0, TURN, 1441)
    axis = model.planet_axis(t).d0 + advance(model) * t / TURN
    rows = lowest.real + advance(model) * (model.lowest / TURN - np.arange(0, 4))
    above = np.maximum(axis.imag - top, 0.0)
    return float(np.min(np.hypot(axis.real[:, None] - rows, above[:, None])))
