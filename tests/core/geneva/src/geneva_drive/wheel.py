"""Kinematics of the external Geneva wheel (Bickford, Mechanisms for Intermittent Motion, recalled): closed forms in the crank angle.

The crank angle theta is 0 on the line of centres.  With  r = sin(pi/n),  the ratio of crank radius and centre distance:
    psi = atan2(r sin theta, 1 - r cos theta),   dpsi/dtheta = (r cos theta - r^2)/(1 - 2 r cos theta + r^2).
"""

from typing import NamedTuple

import numpy as np

from drivewright.claims import Claims, Derivative, Scaling
from drivewright.result import Answer, Answers, Check, Column, Table, Value
from geneva_drive.spec import GenevaSpec


class Wheel(NamedTuple):
    """The model: the spec, the ratio r [-] and half the angle of engagement [rad] of the crank."""

    spec: GenevaSpec
    ratio: float
    half_angle: float


def build(spec: GenevaSpec) -> Wheel:
    """The wheel whose slots the pin enters and leaves along their direction, so without a shock."""
    return Wheel(spec, float(np.sin(np.pi / spec.slots)), float(np.pi / 2 - np.pi / spec.slots))


def motion(wheel: Wheel, done: Answers) -> Answer:
    """The step over the crank angle, its peaks, and whether the dwell is long enough."""
    theta, r = np.linspace(-wheel.half_angle, wheel.half_angle, 401), wheel.ratio
    square = 1 - 2 * r * np.cos(theta) + r**2
    angle = np.arctan2(r * np.sin(theta), 1 - r * np.cos(theta))
    rate = (r * np.cos(theta) - r**2) / square
    bend = -r * (1 - r**2) * np.sin(theta) / square**2
    columns = (
        Column("angle", "rad", "crank angle from the line of centres", theta, "Crank angle"),
        Column("wheel", "rad", "wheel angle", angle, "Wheel angle"),
        Column("rate", "-", "wheel angle per crank angle", rate, "Speed ratio"),
        Column("bend", "1/rad", "its second derivative by the crank angle", bend, "Second derivative"),
    )
    speed, dwell = wheel.spec.speed, 2 * np.pi - 2 * wheel.half_angle
    values = {
        "step": Value(2 * np.pi / wheel.spec.slots, "rad", "angle of the wheel from station to station", label="Step of the wheel"),
        "max_speed": Value(speed * r / (1 - r), "rad/s", "largest speed of the wheel, at the line of centres", label="Peak wheel speed"),
        "max_acceleration": Value(
            float(np.max(np.abs(bend))) * speed**2, "rad/s^2", "largest acceleration of the wheel", label="Peak wheel acceleration"
        ),
    }
    check = Check("dwell", dwell, np.radians(wheel.spec.least_dwell), ">=", "rad", "the wheel rests long enough", label="Dwell angle")
    return Answer(values, (Table("motion", "The step", columns),), (check,))


def claims(spec: GenevaSpec) -> Claims:
    """The step is kinematics."""
    derivatives = (Derivative("motion", "wheel", "rate", "angle"), Derivative("motion", "rate", "bend", "angle"))
    speed = (Scaling("speed", {"max_speed": 1, "max_acceleration": 2, "step": 0}),)
    reasons = {"balances": "without masses there is no energy", "mirror": "it is symmetric", "limits": "nothing is elastic"}
    return Claims(derivatives, speed=speed, reasons=reasons)
