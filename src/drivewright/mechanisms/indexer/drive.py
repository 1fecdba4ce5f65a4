"""Torque at the input for a table with inertia and friction, and what a motor has to deliver."""

from collections.abc import Iterator

import numpy as np

from drivewright.indexing.drive_torque import DriveTorque, TableLoad, drive_table, drive_torque
from drivewright.mechanisms.indexer.build import IndexerModel
from drivewright.mechanisms.indexer.spec import IndexerSpec, IndexerTable
from drivewright.motion.motor_sizing import MotorSizing, mean_over_cycle, size_motor, through_reducer
from drivewright.result import Answer, Answers, Check, Value

DEMAND = {  # field of a `MotorSizing`: unit, meaning
    "peak_torque": ("N m", "maximum magnitude of the torque {place}"),
    "rms_torque": ("N m", "RMS torque {place}"),
    "mean_torque": ("N m", "mean torque {place}"),
    "peak_power": ("W", "maximum power {place}"),
    "rms_power": ("W", "RMS power {place}"),
    "mean_power": ("W", "mean power {place}"),
    "braking_power": ("W", "maximum braking power {place}"),
}


def no_drive(spec: IndexerSpec) -> str | None:
    """Why there is none."""
    if spec.table is None:
        return "[table] is not given"
    return None if spec.load.speed else "load.speed is not given"


def drive(model: IndexerModel, done: Answers) -> Answer:
    """Torque and power over a turn of the input at constant speed, inertia reflected to it, demand on the motor."""
    speed, given = model.spec.load.speed, model.spec.table
    assert speed is not None
    assert given is not None
    torque = drive_torque(model.drive.motion, TableLoad(given.inertia, given.friction_torque, given.process_torque), speed)
    values = dict(_input_values(torque, given, speed))
    values |= dict(_motor_values(model, torque, speed))
    return Answer(values, (drive_table(torque, speed),), tuple(_checks(model, values)), tuple(_findings(model, torque)))


def _input_values(torque: DriveTorque, given: IndexerTable, speed: float) -> Iterator[tuple[str, Value]]:
    yield from _demand("drive", size_motor(torque.time, torque.input_torque, speed), "at the input")
    largest, felt = float(np.max(np.abs(torque.table_torque))), torque.felt_inertia
    yield "drive.table_torque.maximum", Value(largest, "N m", "maximum torque on the table")
    yield "drive.reflected_inertia.mean", Value(mean_over_cycle(torque.time, felt), "kg m^2", "mean reflected inertia at the input")
    yield "drive.reflected_inertia.maximum", Value(float(np.max(felt)), "kg m^2", "maximum reflected inertia at the input")
    rubbing = mean_over_cycle(torque.time, np.abs(torque.wheel_speed)) * float(torque.time[-1]) * given.friction_torque
    yield "drive.friction_work", Value(rubbing, "J", "friction work of the table in a step")


def _motor_values(model: IndexerModel, torque: DriveTorque, speed: float) -> Iterator[tuple[str, Value]]:
    """Demand at the motor's shaft, behind reducer and losses."""
    motor = model.spec.motor
    if motor is None:
        return
    fast, turning = through_reducer(torque.input_torque, speed, motor.ratio, motor.efficiency)
    yield from _demand("motor", size_motor(torque.time, fast, turning), "at the motor")
    yield "motor.speed", Value(speed * motor.ratio, "rad/s", "speed of the motor")
    felt = mean_over_cycle(torque.time, torque.felt_inertia) / motor.ratio**2
    largest = float(np.max(torque.felt_inertia)) / motor.ratio**2
    yield "motor.reflected_inertia.mean", Value(felt, "kg m^2", "mean reflected inertia at the motor")
    yield "motor.reflected_inertia.maximum", Value(largest, "kg m^2", "maximum reflected inertia at the motor")
    if motor.inertia:
        meaning = "maximum reflected inertia at the motor over the inertia of the motor"
        yield "motor.inertia_ratio", Value(largest / motor.inertia, "-", meaning, label="Maximum inertia ratio at the motor")


def _demand(prefix: str, sizing: MotorSizing, place: str) -> Iterator[tuple[str, Value]]:
    for name, (unit, meaning) in DEMAND.items():
        label = f"Maximum torque {place}" if name == "peak_torque" else ""
        yield f"{prefix}.{name}", Value(getattr(sizing, name), unit, meaning.format(place=place), label=label)


def _checks(model: IndexerModel, values: dict[str, Value]) -> Iterator[Check]:
    """What the motor delivers, continuously and for a short time."""
    motor = model.spec.motor
    if motor is None:
        return
    if motor.rated_torque:
        rms, message = values["motor.rms_torque"], "RMS torque at the motor against its rated torque; take a larger motor or a lower speed"
        yield Check.of(rms, "motor.rated_torque", motor.rated_torque, "<=", message, label="RMS torque at the motor")
    if motor.maximum_torque:
        peak, message = values["motor.peak_torque"], "torque at the motor against its maximum torque; take a larger motor or a lower speed"
        yield Check.of(peak, "motor.maximum_torque", motor.maximum_torque, "<=", message, label="Maximum torque at the motor")


def _findings(model: IndexerModel, torque: DriveTorque) -> Iterator[str]:
    """Where the table loads the rollers beyond the torque at which they are judged."""
    largest, taken = float(np.max(np.abs(torque.table_torque))), model.spec.load.torque
    if taken and largest > abs(taken):
        yield (
            f"the table needs up to {largest:.4g} N·m from the wheel at this speed, and load.torque is {abs(taken):.4g} N·m: forces, "
            "pressures and stiffness are those at load.torque"
        )
