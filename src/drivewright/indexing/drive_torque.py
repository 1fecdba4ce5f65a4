"""Torque that a dial table asks of the input: its inertia, friction and steady torque through the ratio of the indexing drive.

Rigid parts without losses, the input at the constant speed w.  The wheel turns by phi(theta), so that its speed is phi' w and its
acceleration phi'' w^2; by the balance of power, T_in w = T phi' w,
    T = J phi'' w^2 + T_f sign(phi') + T_p,    T_in = phi' T.
The table is felt at the input as the moment of inertia J phi'^2.  In the dwell friction moves nothing and the cam carries T_p alone.
"""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.errors import InputError
from drivewright.indexing.motion import TURN, IndexMotion
from drivewright.result import Column, Table

POINTS = 720  # over a turn of the input
FEWEST = 16  # on a segment of the motion


class TableLoad(NamedTuple):
    """Moment of inertia [kg m^2] of all that turns with the wheel; friction [N m], against its motion; steady torque [N m], against the
    index direction also in the dwell."""

    inertia: float
    friction_torque: float = 0.0
    process_torque: float = 0.0


class DriveTorque(NamedTuple):
    """A turn of the input, arrays (n,): angle [rad] and time [s] of the input, speed [rad/s] and acceleration [rad/s^2] of the wheel,
    torque [N m] that moves it, torque [N m] at the input, moment of inertia [kg m^2] felt there.

    A joint of the motion stands twice, with the values before and after it.
    """

    angle: Floats
    time: Floats
    wheel_speed: Floats
    wheel_acceleration: Floats
    table_torque: Floats
    input_torque: Floats
    felt_inertia: Floats


def drive_torque(motion: IndexMotion, load: TableLoad, speed: float, points: int = POINTS) -> DriveTorque:
    """`DriveTorque` of a table at a constant speed [rad/s] of the input; about `points` samples over its turn.

    Raises InputError for a speed that is not above 0, and an inertia or a friction below 0.
    """
    _refuse(load, speed)
    angle, rate, second, moving = _samples(motion, points)
    way = np.where(moving, np.where(rate < 0, -1.0, 1.0), 0.0)
    wheel = load.inertia * second * speed**2 + load.friction_torque * way + load.process_torque
    return DriveTorque(angle, angle / speed, rate * speed, second * speed**2, wheel, rate * wheel, load.inertia * rate**2)


def _samples(motion: IndexMotion, points: int) -> tuple[Floats, Floats, Floats, Floats]:
    """(angle, phi', phi'', whether the wheel moves) over a turn, segment after segment, each by its own formula."""
    parts = []
    for number, segment in enumerate(motion.segments):
        theta = np.linspace(segment.start, segment.stop, max(FEWEST, int(np.ceil(points * (segment.stop - segment.start) / TURN))) + 1)
        found = motion.on_segment(number, theta)
        parts.append((theta, found.d1, found.d2, np.full(len(theta), segment.law_piece is not None)))
    angle, rate, second, moving = (np.concatenate(column) for column in zip(*parts, strict=True))
    return angle, rate, second, moving


def _refuse(load: TableLoad, speed: float) -> None:
    if not (np.isfinite(speed) and speed > 0):
        raise InputError(f"drive torque: the speed of the input is {speed:g} rad/s; it must be above 0 and finite.")
    for name, value, unit in (("inertia", load.inertia, "kg m^2"), ("friction_torque", load.friction_torque, "N m")):
        if not (np.isfinite(value) and value >= 0):
            raise InputError(f"drive torque: {name} = {value:g} {unit}; it must be 0 or more. Friction always opposes the motion.")


def drive_table(torque: DriveTorque, speed: float) -> Table:
    """Torque and power over a turn of the input at that speed [rad/s]."""
    return Table(
        "drive",
        "Torque and power at the input",
        (
            Column("angle", "rad", "input angle", torque.angle),
            Column("time", "s", "time from the start of the step", torque.time),
            Column("wheel_speed", "rad/s", "speed of the wheel", torque.wheel_speed),
            Column("wheel_acceleration", "rad/s^2", "angular acceleration of the wheel", torque.wheel_acceleration),
            Column("table_torque", "N m", "torque on the table", torque.table_torque),
            Column("input_torque", "N m", "torque at the input", torque.input_torque),
            Column("input_power", "W", "power at the input", torque.input_torque * speed),
            Column("felt_inertia", "kg m^2", "reflected inertia at the input", torque.felt_inertia),
        ),
    )
