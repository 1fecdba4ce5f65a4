"""Many pin wheels at once whose motion may differ: designs of one law are evaluated together."""

from collections.abc import Iterator, Mapping
from typing import NamedTuple

import numpy as np

from drivewright import motion
from drivewright._typing import ArrayLike, Bools, Floats
from drivewright.errors import InputError
from drivewright.indexing.batch.pin_wheels import PinWheelValues, evaluate_pin_wheels, feasible_designs
from drivewright.indexing.motion import TURN
from drivewright.motion import MotionLaw


class DesignValues(NamedTuple):
    """Values of N designs, arrays (N,), nan for an impossible one: `PinWheelValues`, and the motion of the wheel over the input.

    motion_angle [rad]: part of the input's turn in which the wheel moves; velocity_factor [-], acceleration_factor [1/rad]: the largest
    first and second derivative of the wheel's angle by the input's, pitch Vm/motion_angle and pitch Am/motion_angle^2.
    """

    wheels: PinWheelValues
    motion_angle: Floats
    velocity_factor: Floats
    acceleration_factor: Floats


def evaluate_designs(
    law: str,
    parameters: Mapping[str, ArrayLike],
    pins: int,
    circle_radius: ArrayLike,
    pin_radius: ArrayLike,
    eccentricity: ArrayLike,
    motion_angle: ArrayLike,
    side: str = "inside",
    factors: bool = True,
    play: bool = True,
    wheels: PinWheelValues | None = None,
) -> DesignValues:
    """`DesignValues` of N pin wheels that share number of pins, side and the name of their motion law.

    The parameters of the law [-], radii and eccentricity [m] and motion_angle [rad] are arrays (N,) or numbers.  An impossible design, as
    pins that overlap or parameters that make no law from rest to rest, is a row of nan.  factors: whether the factors of velocity and
    acceleration are wanted, play: whether the play is; else they are nan.  wheels: the values (N,) where they are known.
    """
    columns = np.broadcast_arrays(*np.atleast_1d(circle_radius, pin_radius, eccentricity, motion_angle), *parameters.values())
    circle, pin, throw, angle, *shapes = (np.asarray(column, float) for column in columns)
    sizes, pitch = np.stack([circle, pin, throw, angle], axis=1), TURN / pins
    values = np.full((len(PinWheelValues._fields) + 3, len(angle)), np.nan)
    for rows, made in _laws(law, dict(zip(parameters, shapes, strict=True)), len(angle)):
        own = rows & feasible_designs(sizes, pins, made)
        if not own.any():
            continue
        if wheels is None:
            found = evaluate_pin_wheels(made, pins, circle[own], pin[own], throw[own], angle[own], side, play)
        else:
            found = PinWheelValues(*(column[own] for column in wheels))
        peaks = made.peaks() if factors else None
        peak_speed, peak_acceleration = (peaks.Vm, peaks.Am) if peaks else (np.nan, np.nan)
        values[:, own] = [*found, angle[own], pitch * peak_speed / angle[own], pitch * peak_acceleration / angle[own] ** 2]
    return DesignValues(PinWheelValues(*values[:-3]), *values[-3:])


def _laws(name: str, parameters: Mapping[str, Floats], count: int) -> Iterator[tuple[Bools, MotionLaw]]:
    """(which of `count` designs, their law) for every set of parameters that makes a law from rest to rest, or uniform motion."""
    shapes = np.stack([*parameters.values()], axis=1) if parameters else np.zeros((count, 0))
    for shape in np.unique(shapes, axis=0):
        try:
            law = motion.law(name, **dict(zip(parameters, shape, strict=True)))
        except InputError:
            continue
        if law.continuity >= 1 or law.name == "uniform":
            yield np.all(shapes == shape, axis=1), law
