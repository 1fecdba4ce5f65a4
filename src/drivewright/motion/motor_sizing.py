"""What a motor has to deliver over a repeated cycle: rms and peak torque, speed and power, and the reflected inertia.

The samples run over one whole cycle, the last one being the first a period later; they may be uneven, and two at one time are a jump.
Means over time are by the trapezoidal rule, sum of w_i f_i with w_i = (t_{i+1} - t_{i-1})/2 over the period: exact to rounding for
harmonics sampled evenly (below half of the samples' number), of second order elsewhere, and never negative where f is not.
"""

from typing import NamedTuple

import numpy as np

from drivewright._typing import ArrayLike, Floats
from drivewright.errors import InputError


class MotorSizing(NamedTuple):
    """Demand of a cycle, SI; the power T w is positive from the motor into the machine.

    rms_torque = sqrt(mean T^2) heats the windings, peak_torque = max |T| is what the motor must have at hand; speeds are of |w|;
    braking_power: largest power that comes back, 0 where none does.
    """

    period: float
    rms_torque: float
    peak_torque: float
    mean_torque: float
    mean_speed: float
    peak_speed: float
    rms_power: float
    peak_power: float
    mean_power: float
    braking_power: float


class ReflectedInertia(NamedTuple):
    """Moment of inertia [kg m^2] of moving masses as a shaft feels it, J = 2 E_kin/w^2: mean over the cycle's time, and largest."""

    mean: float
    peak: float


def cycle_weights(time: ArrayLike) -> Floats:
    """Weights (n,) of the trapezoidal mean over a cycle sampled at time (n,) [s]; their sum is 1.

    Raises InputError for fewer than two samples, times that go back, and a cycle without duration.
    """
    t = np.asarray(time, dtype=float)
    if t.ndim != 1 or len(t) < 2 or not np.isfinite(t).all():
        raise InputError(f"cycle: {t.size} samples of time, of shape {t.shape}; give two or more finite times in one row.")
    steps = np.diff(t)
    if np.any(steps < 0):
        k = int(np.argmin(steps))
        raise InputError(f"cycle: the time goes back from {t[k]:.6g} s to {t[k + 1]:.6g} s at sample {k + 1}. Sort the samples by time.")
    period = t[-1] - t[0]
    if not period > 0:
        raise InputError(f"cycle: all {len(t)} samples are at {t[0]:.6g} s; a cycle has a duration. Give its end.")
    return (np.append(steps, 0.0) + np.append(0.0, steps)) / (2 * period)


def mean_over_cycle(time: ArrayLike, quantity: ArrayLike) -> float:
    """Mean over the time of a cycle of a quantity sampled at time (n,) [s], both (n,)."""
    weights = cycle_weights(time)
    return float(weights @ _samples(quantity, len(weights), "quantity"))


def rms_over_cycle(time: ArrayLike, torque: ArrayLike) -> float:
    """Root mean square sqrt(1/T integral of torque^2 dt) over a cycle sampled at time (n,) [s], in the unit of torque (n,)."""
    weights = cycle_weights(time)
    return float(np.sqrt(weights @ _samples(torque, len(weights), "torque") ** 2))


def size_motor(time: ArrayLike, torque: ArrayLike, speed: ArrayLike) -> MotorSizing:
    """The `MotorSizing` of a shaft under torque [N m] at a speed [rad/s], each (n,) or one constant, at time (n,) [s] over one cycle."""
    weights = cycle_weights(time)
    t, turning, speeds = np.asarray(time, dtype=float), *(_samples(each, len(weights), what) for each, what in _named(torque, speed))
    power = turning * speeds
    return MotorSizing(
        period=float(t[-1] - t[0]),
        rms_torque=float(np.sqrt(weights @ turning**2)),
        peak_torque=float(np.max(np.abs(turning))),
        mean_torque=float(weights @ turning),
        mean_speed=float(weights @ np.abs(speeds)),
        peak_speed=float(np.max(np.abs(speeds))),
        rms_power=float(np.sqrt(weights @ power**2)),
        peak_power=float(np.max(power)),
        mean_power=float(weights @ power),
        braking_power=float(max(0.0, -np.min(power))),
    )


def reflected_inertia(time: ArrayLike, kinetic_energy: ArrayLike, speed: ArrayLike) -> ReflectedInertia:
    """The `ReflectedInertia` at a shaft of that speed [rad/s] of masses with that kinetic energy [J], sampled at time (n,) [s].

    Raises InputError where the shaft stands: nothing moves then, and 2 E/w^2 has no value.
    """
    weights = cycle_weights(time)
    energies, speeds = _samples(kinetic_energy, len(weights), "kinetic energy"), _samples(speed, len(weights), "speed")
    if np.any(speeds == 0):
        raise InputError("reflected inertia: the shaft stands at some samples, where 2 E/w^2 has no value. Take the inertia by position.")
    felt = 2 * energies / speeds**2
    return ReflectedInertia(float(weights @ felt), float(np.max(felt)))


def through_reducer(torque: ArrayLike, speed: ArrayLike, ratio: float, efficiency: float = 1.0) -> tuple[Floats, Floats]:
    """(torque, speed) at the fast side of a reducer: speed w i; torque T/(i eta) while it drives, T eta/i while power comes back.

    torque [N m], speed [rad/s] at the slow side, any matching shapes; ratio i > 0 (above 1 slows down), efficiency eta in 0..1.
    """
    if not (np.isfinite(ratio) and ratio > 0):
        raise InputError(f"reducer: ratio = {ratio:g}; it is above 0, and above 1 where the motor turns faster than the machine.")
    if not 0 < efficiency <= 1:
        raise InputError(f"reducer: efficiency = {efficiency:g}; it lies above 0 and is at most 1, e.g. 0.95.")
    slow, turning = np.asarray(torque, dtype=float), np.asarray(speed, dtype=float)
    loss = np.where(slow * turning >= 0, 1 / efficiency, efficiency)
    return slow * loss / ratio, turning * ratio


def _named(torque, speed):
    return (torque, "torque"), (speed, "speed")


def _samples(given, count, what):
    """A quantity at every sample; one number stands for all of them."""
    values = np.asarray(given, dtype=float)
    if values.shape not in ((), (count,)):
        raise InputError(f"cycle: {what} has the shape {values.shape}, time has {count} samples. Give one value for each, or a constant.")
    if not np.isfinite(values).all():
        raise InputError(f"cycle: {what} is not finite at {np.count_nonzero(~np.isfinite(values))} of {values.size} samples.")
    return np.broadcast_to(values, (count,))
