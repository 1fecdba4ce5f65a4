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
    aligned = "carrier angle at which planet and intermediate gear are collinear"
    height, width = (f"peak-to-peak {way} travel of the needle tip in the machine frame" for way in ("vertical", "horizontal"))
    values = {
        "train.collinear_angle": Value(
            float(collinear[-1]), "rad", f"{aligned}, second position", label="Carrier angle of collinearity, second"
        ),
        "train.collinear_angle.first": Value(
            float(collinear[0]), "rad", f"{aligned}, first position", label="Carrier angle of collinearity, first"
        ),
        "train.swing": Value(
            forth - back,
            "rad",
            "peak-to-peak rotation of the planting arm in the machine frame",
            label="Peak-to-peak rotation of planting arm",
        ),
        "tip.lowest_angle": Value(
            arm.lowest, "rad", "carrier angle at the lowest position of the tip", label="Carrier angle at lowest tip position"
        ),
        "tip.highest_angle": Value(
            arm.highest, "rad", "carrier angle at the highest position of the tip", label="Carrier angle at highest tip position"
        ),
        "tip.track_height": Value(arm.track_height, "m", height, label="Height of the tip track"),
        "tip.track_width": Value(arm.track_width, "m", width, label="Width of the tip track"),
    }
    message, limit = f"{height}; reduce arm.tip_distance or train.semi_major", model.spec.limits.track_height
    checks = (Check("track.height", arm.track_height, limit, "<=", "m", message, ("arm",), label="Height of the tip track"),)
    return Answer(values, (_cycle_table(model),), checks)


def _cycle_table(model):
    """Motion of all parts over one turn of the carrier."""
    planet, tip, axis, rod = model.arm.planet(GRID), model.arm.point(GRID), model.arm.axis(GRID), model.pair.travel(GRID)
    end = model.rod_end(GRID)
    speed, turned = model.spec.drive.speed, "rotation of the planet on the carrier"
    aligned = f"{turned}, 0 (mod 2 pi) where planet and intermediate gear are collinear"
    return Table(
        "cycle",
        "Motion over one carrier turn",
        (
            Column("carrier_angle", "rad", "carrier angle", GRID),
            Column("planet_angle", "rad", turned, planet.d0),
            Column("planet_phase", "rad", aligned, planet.d0 + model.arm.train.phase, "Phase of the planet"),
            Column(
                "planet_ratio",
                "-",
                "speed of the planet on the carrier over the carrier speed",
                planet.d1,
                "Speed ratio of planet to carrier",
            ),
            Column(
                "arm_rotation",
                "rad",
                "rotation of the planting arm in the machine frame",
                model.arm.rotation(GRID).d0,
                "Rotation of the planting arm",
            ),
            Column("needle_angle", "rad", "needle angle below the horizontal", model.needle_angle(GRID)),
            Column("tip_x", "m", "horizontal position of the needle tip, machine frame", tip.d0.real, "Needle tip, horizontal"),
            Column("tip_y", "m", "vertical position of the needle tip, machine frame", tip.d0.imag, "Needle tip, vertical"),
            Column(
                "field_x",
                "m",
                "horizontal position of the needle tip, field frame",
                tip.d0.real + model.advance * GRID / TURN,
                "Needle tip in the field, horizontal",
            ),
            Column("axis_x", "m", "horizontal position of the planet axis, machine frame", axis.d0.real, "Planet axis, horizontal"),
            Column("axis_y", "m", "vertical position of the planet axis, machine frame", axis.d0.imag, "Planet axis, vertical"),
            Column("rod_end_x", "m", "horizontal position of the rod end, machine frame", end.real, "Rod end, horizontal"),
            Column("rod_end_y", "m", "vertical position of the rod end, machine frame", end.imag, "Rod end, vertical"),
            Column("rod", "m", "travel of the rod", rod.d0),
            Column("rod_velocity", "m/s", "velocity of the rod in the arm", rod.d1 * speed),
            Column("rod_acceleration", "m/s^2", "acceleration of the rod in the arm", rod.d2 * speed**2),
            Column("rod_jerk", "m/s^3", "jerk of the rod in the arm", rod.d3 * speed**3),
            Column("lever_swing", "rad", "swing of the lever", model.pair.swing(GRID).d0),
        ),
    )


# -- planting ------------------------------------------------------------------------------------------------------------------


def planting(model: PusherModel, done: Answers) -> Answer:
    """Needle angles at the two events, hole in the soil, clearances: the requirements of planting."""
    take, push = take_event(model), push_event(model)
    if take is None:
        return Answer(findings=("the tip never crosses the gate line, so there is no take angle; move events.gate_point onto the track",))
    arm, pair = model.arm, model.pair
    take_angle, push_angle = float(model.needle_angle(take)), float(model.needle_angle(push))
    difference, clear = push_angle - take_angle, axis_clearance(model)
    mouth = arm.opening_width(model.spec.field.mouth_height, model.advance)
    start_depth, end_depth = (float(arm.height(t)) for t in (pair.start, pair.start + model.spec.push.rise))
    values = {
        "needle.take_event": Value(take, "rad", "carrier angle at taking"),
        "needle.push_event": Value(push, "rad", "carrier angle at pushing"),
        "needle.take_angle": Value(take_angle, "rad", "angle of the needle to the horizontal at taking", **_needle("at taking")),
        "needle.push_angle": Value(push_angle, "rad", "angle of the needle to the horizontal at pushing", **_needle("at pushing")),
        "needle.angle_difference": Value(
            difference, "rad", "needle angle at pushing minus needle angle at taking", label="Difference of push and take angle"
        ),
        "tip.height_at_push_start": Value(
            start_depth,
            "m",
            "height of the tip above its lowest position at the start of the push",
            label="Tip height at the start of the push",
        ),
        "tip.height_at_push_end": Value(
            end_depth, "m", "height of the tip above its lowest position at the end of the push", label="Tip height at the end of the push"
        ),
        "rod.needle_distance": Value(
            abs(model.rod_distance),
            "m",
            "distance of the line of the rod from the line of the needle",
            label="Distance between rod and needle",
        ),
        "planting.mouth_width": Value(
            mouth, "m", "width of the hole that the needle leaves in the soil surface", label="Width of the planting hole"
        ),
        "planting.axis_clearance": Value(
            clear,
            "m",
            "minimum distance of the planet axis from the lower half of planted seedlings",
            label="Clearance of planet axis to seedlings",
        ),
    }
    checks = _planting_checks(model, take_angle, push_angle, difference, start_depth, mouth, clear)
    return Answer(values, (), checks, _rod_findings(model))


def _needle(place):
    return {"label": f"Needle angle {place}", "convention": "positive below the horizontal"}


def _rod_findings(model):
    if model.pair.orbit > 0:
        return ()
    return (
        'cams.orbit = "clockwise": this train turns the arm counter-clockwise on the carrier, so the lever pivot orbits the cams '
        "clockwise only in the mirror image, with rod and needle on opposite sides of the planet axis; "
        'with "counter-clockwise" the rod runs along the needle',
    )


def _planting_checks(model, take, push, difference, start_depth, mouth, clear):
    limits, parts, tolerance = model.spec.limits, ("arm",), model.spec.limits.angle_difference_tolerance
    deviation, depth, distance = abs(difference - limits.angle_difference), model.spec.field.mouth_height, abs(model.rod_distance)
    turn = "change arm.needle_angle, arm.tip_angle or the train"
    grip, flat = (
        f"needle angle at taking, steep enough to grip; {turn}",
        f"needle angle at taking, flat enough to spare the seedlings; {turn}",
    )
    upright, past = (
        f"needle angle at pushing, steep enough to plant upright; {turn}",
        f"needle angle at pushing, not beyond upright; {turn}",
    )
    slope = f"difference of push and take angle against the slope of the seedling box; {turn}"
    soil = "height of the tip at the start of the push against the soil surface; shorten push.rise or shift the end of the push"
    beside = "distance between rod and needle; change lever.pivot_distance, lever.output_arm or arm.needle_angle"
    hole = "width of the hole that the needle leaves in the soil surface; change the train or arm.tip_distance"
    clearance = "minimum distance of the planet axis from the lower half of planted seedlings; enlarge arm.tip_distance"
    (take_low, take_high), (push_low, push_high), both = limits.take_angle, limits.push_angle, ("rod", "arm")
    return (
        Check("take_angle.lower", take, take_low, ">=", "rad", grip, parts, label="Minimum needle angle at taking"),
        Check("take_angle.upper", take, take_high, "<=", "rad", flat, parts, label="Maximum needle angle at taking"),
        Check("push_angle.lower", push, push_low, ">=", "rad", upright, parts, label="Minimum needle angle at pushing"),
        Check("push_angle.upper", push, push_high, "<=", "rad", past, parts, label="Maximum needle angle at pushing"),
        Check("angle_difference", deviation, tolerance, "<=", "rad", slope, parts, label="Deviation of the angle difference"),
        Check("push_start_in_soil", start_depth, depth, "<=", "m", soil, parts, label="Tip height at the start of the push"),
        Check("rod_at_needle", distance, limits.rod_distance, "<=", "m", beside, both, label="Distance between rod and needle"),
        Check("mouth_width", mouth, limits.mouth_width, "<=", "m", hole, parts, label="Width of the planting hole"),
        Check("axis_clearance", clear, limits.axis_clearance, ">=", "m", clearance, parts, label="Clearance of planet axis to seedlings"),
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
