"""A motion programme: segments that follow each other around a closed cycle."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from drivewright._typing import Floats, Ints, Numbers
from drivewright.errors import InputError
from drivewright.motion.laws import MotionLaw, law
from drivewright.motion.piecewise import CLOSURE, Motion, Piecewise, joined
from drivewright.numerics.jets import Jet, compose
from drivewright.units import display

TURN = 2 * math.pi
DWELL = MotionLaw("dwell", Piecewise(np.array([0.0, 1.0]), np.zeros((1, 1)), np.zeros((1, 0), complex), np.zeros((1, 0))))


@dataclass(frozen=True, eq=False)
class Segment:
    """A stretch of the cycle: its angle [rad], its law (a `MotionLaw`, a law's name or "dwell") and its rise [m or rad].

    A dwell has no rise, nor has a table, whose lifts are absolute.  A negative rise is a return.
    """

    angle: float
    law: MotionLaw | str
    rise: float = 0.0

    def __post_init__(self):
        if isinstance(self.law, str):
            object.__setattr__(self, "law", DWELL if self.law == DWELL.name else law(self.law))
        if not isinstance(self.law, MotionLaw):
            raise InputError(f"segment: its law is {self.law!r}; give a MotionLaw, the name of one, or 'dwell'.")
        if not (math.isfinite(self.angle) and self.angle > 0):
            raise InputError(f"segment {self.law.name!r}: its angle is {math.degrees(self.angle):.9g}°; it must be positive and finite.")
        if not math.isfinite(self.rise):
            raise InputError(f"segment {self.law.name!r}: its rise is {self.rise}; it must be finite.")
        self._refuse_rise()

    @property
    def motion_law(self) -> MotionLaw:
        """The law itself, where it was given by name too."""
        assert isinstance(self.law, MotionLaw)
        return self.law

    def _refuse_rise(self):
        law = self.motion_law
        reason = "a dwell does not move" if law.name == DWELL.name else "the lifts of a table are absolute" if law.span else ""
        if reason and self.rise != 0:
            raise InputError(f"segment {self.motion_law.name!r}: a rise is given, but {reason}; leave the rise out.")
        if not reason and self.rise == 0:
            raise InputError(f"segment {self.motion_law.name!r}: no rise is given; give one, or make it a dwell.")

    def placed(self, start: float, level: float) -> Piecewise:
        """Its motion as a function of the cycle's angle, beginning at angle `start` and lift `level`."""
        if self.motion_law.span is not None:
            return self.motion_law.function.scaled(width=self.angle, start=start)
        offset = level - self.rise * self.motion_law(0.0).s
        return self.motion_law.function.scaled(width=self.angle, height=self.rise, start=start, level=float(offset))


class Piece(NamedTuple):
    """A smooth interval [theta0, theta1] of the cycle, of a segment (by index), in a phase: 'rise', 'return' or 'dwell'."""

    theta0: float
    theta1: float
    segment: int
    phase: str


class Joint(NamedTuple):
    """What lift and its derivatives jump by where a segment begins, at `angle`; 0.0 where they are continuous."""

    angle: float
    ds: float
    dv: float
    da: float
    dj: float


@dataclass(frozen=True, eq=False)
class Programme:
    """Segments in order on a closed cycle [rad]; called with theta it gives Motion(s, s', s'', s''') of the lift [m or rad].

    Derivatives are with respect to theta, which is taken modulo the cycle.  The lift starts at 0, or at the first row of a
    table that comes first.  Raises InputError where angles do not fill the cycle or the lift does not close; a jump of
    velocity or acceleration is no error but stands in `joints()`.  `lift_unit`, "m" or "rad" where it is known, is that of the
    lifts in these errors.
    """

    segments: tuple[Segment, ...]
    cycle: float = TURN
    lift_unit: str = ""

    def __post_init__(self):
        object.__setattr__(self, "segments", tuple(self.segments))
        _refuse_angles(self.segments, self.cycle)
        _refuse_tables(self.segments, self.levels, self.lift_unit)
        if abs(self.levels[-1] - self.levels[0]) > CLOSURE * np.ptp(self._sampled_lift):
            raise InputError(_does_not_close(self.segments, float(self.levels[-1] - self.levels[0]), self.lift_unit))

    @cached_property
    def starts(self) -> Floats:
        """Angle at which each segment begins, and the cycle itself (n+1,)."""
        return np.append(np.cumsum([0.0, *(segment.angle for segment in self.segments[:-1])]), self.cycle)

    @cached_property
    def levels(self) -> Floats:
        """Lift at the start of each segment and at the end of the cycle (n+1,)."""
        first = self.segments[0].motion_law
        levels = [float(first(0.0).s) if first.span is not None else 0.0]
        for segment in self.segments:
            levels.append(float(segment.placed(0.0, levels[-1]).on_piece(-1, segment.angle).s))
        return np.array(levels)

    @property
    def function(self) -> Piecewise:
        """The whole cycle as one `Piecewise`."""
        return self.stated

    @cached_property
    def stated(self) -> Piecewise:
        """The whole cycle of the lift that the segments state."""
        parts = [segment.placed(start, level) for segment, start, level in zip(self.segments, self.starts, self.levels, strict=False)]
        whole = joined(parts, closed=True)
        return Piecewise(np.append(whole.breaks[:-1], self.cycle), whole.poly, whole.amplitude, whole.frequency, closed=True)

    def __call__(self, theta: Numbers) -> Motion:
        return self.function(np.mod(theta, self.cycle))

    def on_piece(self, k: int | Ints, theta: Numbers) -> Motion:
        """Motion by the formula of piece k (or pieces, an array), one-sided at its ends; theta within breaks[k] .. breaks[k + 1]."""
        return self.function.on_own_piece(k, theta, "programme on a piece: theta")

    @property
    def breaks(self) -> Floats:
        """Ends of the smooth pieces [rad], 0 and the cycle included."""
        return self.function.breaks

    @cached_property
    def pieces(self) -> tuple[Piece, ...]:
        """The smooth intervals of the cycle, in order."""
        s = self._sampled_lift
        moves, up = np.ptp(s, axis=1) > CLOSURE * np.ptp(s), s[:, -1] >= s[:, 0]
        phases = np.where(moves, np.where(up, "rise", "return"), "dwell").tolist()
        owners = np.repeat(np.arange(len(self.segments)), [segment.motion_law.function.count for segment in self.segments]).tolist()
        ends = self.stated.breaks.tolist()
        return tuple(map(Piece, ends[:-1], ends[1:], owners, phases))

    @cached_property
    def _sampled_lift(self):
        """Lift at nine places of every piece, ends included (pieces, 9)."""
        return self.stated.on_piece(*self.stated.samples(8)).s

    def joints(self) -> list[Joint]:
        """The `Joint` at the start of every segment; the first is where the cycle closes."""
        jumps = [self.function.jumps(order) for order in range(4)]
        at = np.searchsorted(self.function.breaks, self.starts[:-1])
        return [Joint(float(angle), *(float(jump[k]) for jump in jumps)) for k, angle in zip(at, self.starts, strict=False)]

    @property
    def continuity(self) -> int:
        """Order of the highest derivative that nowhere jumps, inside the laws included."""
        return self.function.continuity


def compose_motion(motion: Callable[[Any], Motion], theta: Jet) -> Motion:
    """Motion(s, ds/dt, ...) of motion(theta(t)) by the chain rule; `theta` is a jet, `motion` a programme, a law or one piece of it."""
    return Motion(*compose(motion(theta.d0), theta))


def _refuse_angles(segments, cycle):
    if not segments:
        raise InputError("programme: it has no segment; give at least one.")
    if not (math.isfinite(cycle) and cycle > 0):
        raise InputError(f"programme: its cycle is {math.degrees(cycle):.9g}°; it must be positive and finite.")
    total = math.fsum(segment.angle for segment in segments)
    missing = math.degrees(cycle - total)
    if abs(cycle - total) > CLOSURE * cycle:
        remedy = f"add a dwell of {missing:.9g}° or lengthen a segment" if missing > 0 else "shorten a segment"
        raise InputError(
            f"programme: the angles of its segments sum to {math.degrees(total):.9g}°, {abs(missing):.9g}° "
            f"{'less' if missing > 0 else 'more'} than the cycle of {math.degrees(cycle):.9g}°; {remedy}."
        )


def _refuse_tables(segments, levels, unit):
    for number, (segment, level) in enumerate(zip(segments, levels, strict=False), 1):
        span = segment.motion_law.span
        if span is None:
            continue
        if abs(span - segment.angle) > CLOSURE * segment.angle:
            raise InputError(
                f"programme, segment {number}: its table ends at {math.degrees(span):.9g}°, but the segment spans "
                f"{math.degrees(segment.angle):.9g}°; make the last angle of the table and the segment's angle equal, over a whole turn "
                "by repeating the first lift at the end."
            )
        first = float(segment.motion_law(0.0).s)
        if abs(first - level) > CLOSURE * np.max(np.abs([first, *levels])):
            raise InputError(
                f"programme, segment {number}: its table starts at a lift of {_lift(first, unit)}, but the segment before ends at "
                f"{_lift(level, unit)}. The lifts of a table are absolute: shift them by {_lift(level - first, unit)}, or change "
                "the rise before."
            )


def _does_not_close(segments, gap, unit):
    """What an open cycle is off by, the rises that make it so, and a rise that would close it."""
    way = "above" if gap > 0 else "below"
    rises = [(number, segment.rise) for number, segment in enumerate(segments, 1) if segment.rise]
    complaint = f"programme: the lift ends {_lift(abs(gap), unit)} {way} its start, and a closed cycle must end where it starts"
    if not rises:
        return f"{complaint}; change the last lift of its table."
    given = ", ".join(_lift(rise, unit) for _, rise in rises)
    number, rise = rises[-1]
    if math.isclose(rise, gap):
        return f"{complaint}: its rises are {given}; as a dwell segment {number} closes it."
    return f"{complaint}: its rises are {given}; with {_lift(rise - gap, unit)} in segment {number} it closes."


def _lift(value, unit):
    """A lift in the unit people read, in SI where it is not known whether it is a length or an angle."""
    factor, shown = display(unit) if unit else (1.0, "(SI)")
    return f"{value * factor:.9g} {shown}"
