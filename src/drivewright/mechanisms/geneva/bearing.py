"""Load and life of the bearing of the wheel, which takes the force of the pin."""

import numpy as np

from drivewright import bearings
from drivewright.bearings.load_spectrum import mean_load
from drivewright.mechanisms.geneva.build import GenevaModel
from drivewright.mechanisms.geneva.loads import turn_forces
from drivewright.mechanisms.geneva.spec import GenevaSpec
from drivewright.motion.motor_sizing import cycle_weights
from drivewright.result import Answer, Answers, Check, Value


def no_bearing(spec: GenevaSpec) -> str | None:
    """Why there is no life."""
    return None if spec.bearing.bearing else "bearing.bearing is not given"


def bearing(model: GenevaModel, done: Answers) -> Answer:
    """Mean load over the turns of the wheel, basic life, static safety; one bearing takes the whole force."""
    load, speed = turn_forces(model).pin.resultant, model.wheel_by_time.d1
    rolling, largest = model.rolling, float(np.max(load))
    assert rolling is not None, "the analysis is left out without a bearing"
    mean = mean_load(cycle_weights(model.samples.time), speed, load, bearings.life_exponent(rolling))
    values = {
        "bearing.max_load": Value(largest, "N", "maximum load of the bearing of the wheel", label="Maximum load of the bearing"),
        "bearing.mean_load": Value(
            mean, "N", "constant load with the same life, over the turns of the wheel", label="Equivalent load of the bearing"
        ),
    }
    checks = []
    if largest > 0:
        safety = bearings.static_rating(rolling) / largest
        values["bearing.static_safety"] = Value(safety, "-", "static rating over the maximum load", label="Static safety of the bearing")
    if mean > 0 and (life := bearings.basic_life(rolling, mean)) is not None:
        turning = 2 * model.step.half_pitch / model.crank.period
        values["bearing.basic_life"] = Value(
            float(life), "rev", "basic life L10 in turns of the wheel", label="Basic life L10 of the bearing"
        )
        values["bearing.basic_life.time"] = Value(
            bearings.life_duration(life, turning), "s", "basic life L10h at the speed of the crank", label="Basic life L10h of the bearing"
        )
        if model.spec.limits.life:
            message = "basic life of the bearing of the wheel; take a bearing of larger dynamic rating or a lower speed"
            life_time = values["bearing.basic_life.time"]
            checks.append(
                Check.of(life_time, "bearing_life", model.spec.limits.life, ">=", message, ("wheel",), label="Basic life of the bearing")
            )
    return Answer(values, (), tuple(checks))
