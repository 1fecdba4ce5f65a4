"""Kinematics of the Scotch yoke: closed forms in the crank angle.

The pin at (r cos theta, r sin theta) runs in a slot tilted by t from the normal of the slide, whose line crosses the slide's axis at
    x = r cos(theta + t)/cos t,    dx/dtheta = -r sin(theta + t)/cos t,    d2x/dtheta2 = -x.
"""

from typing import NamedTuple

import numpy as np

from drivewright.claims import Claims, Derivative, Scaling
from drivewright.result import Answer, Answers, Check, Column, Table, Value
from yoke_drive.spec import YokeSpec


class Yoke(NamedTuple):
    """The model: the spec, the amplitude r/cos t of the slide [m] and the tilt t of its slot [rad]."""

    spec: YokeSpec
    amplitude: float
    tilt: float


def build(spec: YokeSpec) -> Yoke:
    """The yoke."""
    return Yoke(spec, spec.crank_radius / float(np.cos(spec.slot_tilt)), spec.slot_tilt)


def motion(yoke: Yoke, done: Answers) -> Answer:
    """The travel over the crank angle, its peaks, and whether the stroke is long enough."""
    theta, r = np.linspace(0.0, 2 * np.pi, 401), yoke.amplitude
    travel, rate = r * np.cos(theta + yoke.tilt), -r * np.sin(theta + yoke.tilt)
    columns = (
        Column("angle", "rad", "crank angle", theta),
        Column("travel", "m", "place of the slide", travel),
        Column("rate", "m/rad", "travel per crank angle", rate),
        Column("bend", "m/rad^2", "second derivative of the travel by the crank angle", -travel, "Second derivative"),
    )
    speed = yoke.spec.speed
    values = {
        "stroke": Value(2 * r, "m", "stroke of the slide"),
        "max_speed": Value(speed * r, "m/s", "largest speed of the slide, half-way", label="Peak slide speed"),
        "max_acceleration": Value(speed**2 * r, "m/s^2", "largest acceleration of the slide, at the ends", label="Peak slide acceleration"),
    }
    check = Check("stroke", 2 * r, yoke.spec.least_stroke, ">=", "m", "the stroke is long enough", label="Stroke")
    return Answer(values, (Table("motion", "The travel", columns),), (check,))


def claims(spec: YokeSpec) -> Claims:
    """The travel is kinematics."""
    derivatives = (Derivative("motion", "travel", "rate", "angle"), Derivative("motion", "rate", "bend", "angle"))
    speed = (Scaling("speed", {"max_speed": 1, "max_acceleration": 2, "stroke": 0}),)
    reasons = {"balances": "without masses there is no energy", "mirror": "nothing is stated about it", "limits": "nothing is elastic"}
    return Claims(derivatives, speed=speed, reasons=reasons)
