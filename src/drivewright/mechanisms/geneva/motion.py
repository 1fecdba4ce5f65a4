"""Motion of the wheel over a turn of the crank: kinematics by closed forms, peaks, dwell."""

from collections.abc import Iterator

import numpy as np

from drivewright.indexing.geneva.crank import TURN
from drivewright.mechanisms.geneva.build import GenevaModel
from drivewright.numerics.roots import extremes
from drivewright.result import Answer, Answers, Check, Column, Table, Value

FROM_CENTRES = "0 where the pin is nearest to the axis of the wheel"


def motion(model: GenevaModel, done: Answers) -> Answer:
    """Angle, speed, acceleration and jerk of the wheel; ratio of motion and dwell."""
    values = {**dict(_angles(model)), **dict(_ratios(model)), **dict(_peaks(model))}
    return Answer(values, (_over_turn(model), _over_step(model)), tuple(_checks(model, values)))


def cycle_columns(model: GenevaModel) -> tuple[Column, Column]:
    """Crank angle and time over a turn: what the plots stand over comes first."""
    angle = Column("angle", "rad", f"crank angle, {FROM_CENTRES}", model.samples.angle)
    time = Column("time", "s", "time from the middle of the dwell", model.samples.time)
    return (angle, time) if model.steady else (time, angle)


def _over_turn(model):
    wheel = model.wheel_by_time
    columns = (
        *cycle_columns(model),
        Column("crank_speed", "rad/s", "angular speed of the crank", model.samples.speed, "Crank speed"),
        Column("wheel", "rad", "angle of the wheel from the start of its step", wheel.d0, "Wheel angle"),
        Column("wheel_speed", "rad/s", "angular speed of the wheel", wheel.d1, "Wheel speed"),
        Column("wheel_acceleration", "rad/s^2", "angular acceleration of the wheel", wheel.d2, "Wheel acceleration"),
        Column("wheel_jerk", "rad/s^3", "angular jerk of the wheel within its step", wheel.d3, "Wheel jerk"),
    )
    return Table("motion", "Motion of the wheel over a turn", columns)


def _over_step(model):
    """The step over the crank angle, which no speed changes."""
    inside = model.samples.engaged
    angle, wheel = model.samples.angle[inside], model.wheel_by_angle[inside]
    columns = (
        Column("angle", "rad", f"crank angle, {FROM_CENTRES}", angle),
        Column("wheel", "rad", "angle of the wheel from the start of its step", wheel.d0, "Wheel angle"),
        Column("rate", "-", "speed of the wheel over that of the crank", wheel.d1, "Speed ratio"),
        Column("bend", "1/rad", "second derivative of the wheel angle by the crank angle", wheel.d2, "Second derivative"),
        Column("third", "1/rad^2", "third derivative of the wheel angle by the crank angle", wheel.d3, "Third derivative"),
    )
    return Table("step", "Step over the crank angle", columns)


def _angles(model: GenevaModel) -> Iterator[tuple[str, Value]]:
    step, crank = model.step, model.crank
    start, end = (crank.part_at(side * step.half_engagement) for side in (-1, 1))
    yield "step", Value(2 * step.half_pitch, "rad", "angle of the wheel from station to station", label="Step of the wheel")
    yield "motion_angle", Value(step.engagement, "rad", "crank angle of the step", label="Motion angle")
    yield "dwell_angle", Value(TURN - step.engagement, "rad", "crank angle of the dwell", label="Dwell angle")
    yield "motion_time", Value((end - start) * crank.period, "s", "time of the step", label="Motion time")
    yield "dwell_time", Value((1 - end + start) * crank.period, "s", "time of the dwell", label="Dwell time")
    ratio = (end - start) / (1 - end + start)
    yield "motion_to_dwell", Value(ratio, "-", "time of the step over that of the dwell", label="Motion to dwell")


def _ratios(model: GenevaModel) -> Iterator[tuple[str, Value]]:
    """Peaks by the crank angle: what tables of Geneva drives list."""
    step = model.step
    yield "max_speed_ratio", Value(step.largest_rate, "-", "maximum speed of the wheel over that of the crank", label="Maximum speed ratio")
    for name, value, meaning, label in (
        ("entry_bend", step.entry_bend, "acceleration of the wheel at entry over the crank speed squared", "Entry acceleration ratio"),
        ("max_bend", step.largest_bend, "maximum acceleration of the wheel over the crank speed squared", "Maximum acceleration ratio"),
        ("max_third", step.largest_third, "maximum jerk of the wheel over the crank speed cubed", "Maximum jerk ratio"),
    ):
        yield name, Value(value, "-", f"{meaning}, at a constant speed of the crank", label=label)
    yield (
        "max_bend.at",
        Value(
            step.largest_bend_angle,
            "rad",
            "crank angle from the line of centres at the maximum acceleration",
            label="Crank angle at maximum acceleration",
        ),
    )


def _peaks(model: GenevaModel) -> Iterator[tuple[str, Value]]:
    speed, acceleration, jerk = _extreme_rates(model)
    yield "max_speed", Value(speed, "rad/s", "maximum angular speed of the wheel", label="Maximum wheel speed")
    yield (
        "max_acceleration",
        Value(acceleration, "rad/s^2", "maximum angular acceleration of the wheel", label="Maximum wheel acceleration"),
    )
    yield "max_jerk", Value(jerk, "rad/s^3", "maximum angular jerk of the wheel within its step", label="Maximum wheel jerk")
    entry = model.wheel_by_time.d2[model.samples.engaged][0]
    meaning = "jump of the acceleration of the wheel where the pin enters and leaves"
    yield "acceleration_jump", Value(abs(entry), "rad/s^2", meaning, label="Acceleration jump at entry")


def _extreme_rates(model):
    """Largest speed, acceleration and jerk: in closed form at constant speed, else by search over the step."""
    step, w = model.step, model.crank.mean_speed
    if model.steady:
        return step.largest_rate * w, step.largest_bend * w**2, step.largest_third * w**3

    def rate(order):
        def size(u):
            angle, speed, acceleration, jerk = model.crank.at(np.asarray(u))
            over = step.pin_direction(angle)
            return np.abs(
                (
                    over.d1 * speed,
                    over.d2 * speed**2 + over.d1 * acceleration,
                    over.d3 * speed**3 + 3 * over.d2 * speed * acceleration + over.d1 * jerk,
                )[order]
            )

        return size

    ends = [model.crank.part_at(side * step.half_engagement) for side in (-1, 1)]
    return tuple(extremes(rate(order), *ends)[3] for order in range(3))


def _checks(model: GenevaModel, values: dict[str, Value]) -> Iterator[Check]:
    limits = model.spec.limits
    message = "crank angle in which the wheel rests; it follows from the number of slots: take fewer slots"
    yield Check.of(values["dwell_angle"], "dwell", limits.dwell, ">=", message, ("wheel",), label="Dwell angle")
    if limits.acceleration:
        message = "maximum angular acceleration of the wheel; reduce the speed or take more slots"
        check = Check.of(values["max_acceleration"], "acceleration", limits.acceleration, "<=", message, ("wheel",))
        yield check._replace(label="Maximum wheel acceleration")
