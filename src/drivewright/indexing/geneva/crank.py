"""Motion of the crank over one turn: at constant speed, or from rest to rest by a motion law."""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Bools, Floats
from drivewright.motion.laws import MotionLaw
from drivewright.numerics.roots import bracketed_roots

TURN = 2 * np.pi
ROWS = (60, 360)  # samples of a dwell on either side, and of the step


class CrankSamples(NamedTuple):
    """A turn from -pi to pi, arrays (n,): time [s] from its start, angle [rad], speed [rad/s], acceleration [rad/s^2], jerk [rad/s^3], and
    whether the pin is in the slot.  Entry and exit stand twice, outside and inside."""

    time: Floats
    angle: Floats
    speed: Floats
    acceleration: Floats
    jerk: Floats
    engaged: Bools


class Crank(NamedTuple):
    """Mean speed [rad/s] of the crank, and the law by which it makes each turn from rest to rest, pin away from the wheel at both ends;
    None: at constant speed."""

    mean_speed: float
    law: MotionLaw | None = None

    @property
    def period(self) -> float:
        """Time of a turn [s]."""
        return TURN / self.mean_speed

    def at(self, u: Floats) -> tuple[Floats, Floats, Floats, Floats]:
        """Angle [rad], speed, acceleration and jerk at the parts u of a turn's time, 0..1."""
        if self.law is None:
            return TURN * u - np.pi, self.mean_speed + 0 * u, 0 * u, 0 * u
        moved, period = self.law(u), self.period
        return (TURN * moved.s - np.pi, TURN * moved.v / period, TURN * moved.a / period**2, TURN * moved.j / period**3)

    def part_at(self, angle: float) -> float:
        """The part u of a turn's time at which the crank stands at an angle within (-pi, pi)."""
        if self.law is None:
            return (angle + np.pi) / TURN
        return float(bracketed_roots(lambda u: self.at(u)[0] - angle, np.linspace(0, 1, 401))[0])

    def samples(self, half_engagement: float) -> CrankSamples:
        """`CrankSamples` of a turn, the pin in the slot within the crank angle +-half_engagement [rad]."""
        entry, exit_ = (self.part_at(sign * half_engagement) for sign in (-1, 1))
        stretches = ((0.0, entry, ROWS[0], False), (entry, exit_, ROWS[1], True), (exit_, 1.0, ROWS[0], False))
        u = np.concatenate([np.linspace(start, end, rows + 1) for start, end, rows, _ in stretches])
        engaged = np.concatenate([np.full(rows + 1, inside) for _, _, rows, inside in stretches])
        return CrankSamples(u * self.period, *self.at(u), engaged)
