"""The ends of an oscillating follower's arms that the spec names: the valve, and the end of an arm along whose arc the lift is stated."""

from collections.abc import Callable, Iterator
from functools import partial
from typing import NamedTuple

import numpy as np

from drivewright import cams, motion
from drivewright.mechanisms.cam.build import CamModel
from drivewright.result import Answer, Column, Table, Value

RATIO = "travel of the valve per travel at the cam arm"
LIMITS = {"max": "Maximum", "min": "Minimum"}


class ArmEnd(NamedTuple):
    """What moves with a lift [m] over the cam angle: its name, what it is called in words, its motion."""

    name: str
    words: str
    lift: motion.Piecewise


def arm_ends(model: CamModel) -> Iterator[ArmEnd]:
    """The valve where there is one, and the arm's end whose arc the programme states."""
    if model.arm:
        yield ArmEnd("valve", "valve", model.valve_motion)
    if isinstance(model.programme, motion.MappedProgramme) and isinstance(model.programme.outer, cams.ArcArm):
        yield ArmEnd("arm_end", "arm end", model.programme.stated)


def end_measures(model: CamModel) -> Iterator[Callable[[CamModel], Answer]]:
    """The functions that give the values of these ends."""
    for end in arm_ends(model):
        yield partial(_lift_and_rates, end=end)
    if model.arm:
        yield _rocker


def _lift_and_rates(model, end):
    """Stroke, and with a speed maximum velocity and jerk, maximum and minimum acceleration."""
    least, greatest = end.lift.extremes(lambda k, x: end.lift.on_piece(k, x)[:2])
    stroke = Value(greatest - least, "m", f"lift of the {end.words}", label=f"{end.words} lift")
    return Answer({f"{end.name}.lift": stroke} | (_rates(model, end) if model.turns else {}))


def _rates(model, end):
    function, speed, words = end.lift, model.speed, end.words
    peaks = function.peaks()
    acceleration = [speed**2 * each for each in function.extremes(lambda k, x: function.on_piece(k, x)[2:4])]
    values = {
        "max_velocity": Value(peaks.Vm * speed, "m/s", f"maximum magnitude of the velocity of the {words}"),
        "max_acceleration": Value(
            acceleration[1], "m/s^2", f"maximum acceleration of the {words}", convention="positive in the direction of the lift"
        ),
        "min_acceleration": Value(
            acceleration[0], "m/s^2", f"minimum acceleration of the {words}", convention="negative against the direction of the lift"
        ),
        "max_jerk": Value(peaks.Jm * speed**3, "m/s^3", f"maximum magnitude of the jerk of the {words}"),
    }
    bound = {"max_acceleration": peaks.Am, "min_acceleration": peaks.Am, "max_jerk": peaks.Jm}
    finite = {name: value for name, value in values.items() if np.isfinite(bound.get(name, 0.0))}
    return {f"{end.name}.{name}": value._replace(label=f"{LIMITS[name[:3]]} {words} {name[4:]}") for name, value in finite.items()}


def _rocker(model):
    """Ratio of the rocker, and the wipe of its pad."""
    ratio, across = model.path.ratio, model.arm.across
    (low, high), (left, right) = (
        [extreme(lambda _, swing, q=quantity: q(swing)).value for extreme in (model.cycle.minimum, model.cycle.maximum)]
        for quantity in (ratio, across)
    )
    wipe = "wipe of the pad: travel of its contact across the end of the valve stem"
    return Answer(
        {
            "valve.min_rocker_ratio": Value(low, "-", f"minimum rocker ratio: {RATIO}"),
            "valve.max_rocker_ratio": Value(high, "-", f"maximum rocker ratio: {RATIO}"),
            "valve.wipe": Value(right - left, "m", wipe, label="Wipe of the pad on the valve stem"),
        }
    )


def end_tables(model: CamModel) -> Iterator[Table]:
    """Motion of these ends over the turn: lift, at the valve ratio and wipe, with a speed velocity, acceleration and jerk."""
    piece, angle = model.cycle.samples()
    for end in arm_ends(model):
        rates = end.lift.on_piece(piece, angle)
        columns = [Column("angle", "rad", "cam angle", angle), Column("lift", "m", f"lift of the {end.words}", rates.s)]
        if end.name == "valve":
            columns += _rocker_columns(model)
        if model.turns:
            columns += [
                Column(name, f"m/s^{order}".removesuffix("^1"), f"{name} of the {end.words}", rates[order] * model.speed**order)
                for order, name in enumerate(("velocity", "acceleration", "jerk"), start=1)
            ]
        yield Table(end.name, f"Motion of the {end.words}", tuple(columns))


def _rocker_columns(model):
    swing = model.cycle.sampled()[1]
    yield Column("rocker_ratio", "-", f"rocker ratio: {RATIO}", model.path.ratio(swing).d0)
    yield Column("wipe", "m", "position of the pad on the valve stem, from that at zero lift", model.arm.across(swing).d0)
