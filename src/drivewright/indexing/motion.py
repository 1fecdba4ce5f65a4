"""The motion of an indexing wheel over the angle of its input: one step a turn, then a dwell."""

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

from drivewright._typing import ArrayLike, Ints, Numbers
from drivewright.errors import InputError
from drivewright.motion import MotionLaw, TableLaw, law
from drivewright.numerics.jets import Jet
from drivewright.result import Column, Table

TURN = 2 * np.pi
ROWS = 1e-6  # of the step, by which rows with few digits may miss it
JOINT = 1e-9  # of a derivative's size: a smaller jump is rounding
NO_DWELL: Literal["no-dwell"] = "no-dwell"


@dataclass(frozen=True)
class MotionSegment:
    """A smooth segment of one turn of the input, angles [rad]; `law_piece` is its first piece of the law, None in the dwell."""

    start: float
    stop: float
    law_piece: int | None


@dataclass(frozen=True, eq=False)
class IndexMotion:
    """phi(theta) = pitch (n + s((theta - 2 pi n)/motion_angle)), pitch = 2 pi/divisions, n = floor(theta/(2 pi)); then a dwell.

    divisions: steps of the wheel in a turn; motion_angle [rad]: part of the input's turn in which the wheel moves.
    """

    law: MotionLaw
    divisions: int
    motion_angle: float

    @property
    def pitch(self) -> float:
        """Angle of one step [rad]."""
        return TURN / self.divisions

    @cached_property
    def segments(self) -> tuple[MotionSegment, ...]:
        """Smooth segments of one turn, the dwell last."""
        first = self._first_pieces
        ends = self.motion_angle * np.asarray(self.law.breaks)[first]
        moving = tuple(MotionSegment(float(a), float(b), int(k)) for k, a, b in zip(first[:-1], ends[:-1], ends[1:], strict=True))
        return moving if self.motion_angle >= TURN else (*moving, MotionSegment(self.motion_angle, TURN, None))

    @cached_property
    def _first_pieces(self) -> Ints:
        """Number of the law's first piece in each segment, and of all pieces: polynomials that meet without a jump up to the third
        derivative, as the many of a spline of degree 5, are one segment."""
        function, count = self.law.function, len(self.law.breaks) - 1
        if function.amplitude.size:
            return np.arange(count + 1)
        sharp = np.zeros(count + 1, dtype=bool)
        sharp[[0, -1]] = True
        for order in range(4):
            jumps = np.abs(function.jumps(order))
            size = np.max(np.abs(function(0.5 * (self.law.breaks[1:] + self.law.breaks[:-1]))[order]))
            sharp[1:-1] |= jumps[1:-1] > JOINT * size
        return np.flatnonzero(sharp)

    def on_segment(self, number: int | Ints, theta: ArrayLike, turn: Numbers = 0) -> Jet:
        """Jet of phi [rad] by the input angle theta, counted in turn number `turn`, by the formula of a segment; one-sided at its ends.

        number: of the segment, or an array of them; the dwell comes after the pieces of the law.
        """
        theta, firsts = np.asarray(theta, dtype=float), self._first_pieces
        last = len(firsts) - 2
        moving, segment = np.asarray(number) <= last, np.minimum(number, last)
        low, high = firsts[segment], firsts[segment + 1]
        u = np.clip(theta / self.motion_angle, self.law.breaks[low], self.law.breaks[high])
        piece = np.clip(np.searchsorted(self.law.breaks, u, side="right") - 1, low, high - 1)
        s, *rates = (np.asarray(part, dtype=float) for part in self.law.on_piece(piece, u))
        derivatives = (np.where(moving, self.pitch * d / self.motion_angle**k, 0.0) for k, d in enumerate(rates, start=1))
        return Jet(self.pitch * (turn + np.where(moving, s, 1.0)), *derivatives)

    def __call__(self, theta: ArrayLike) -> Jet:
        """Jet of phi [rad] by the input angle theta [rad], any turn; at a joint the segment that begins there."""
        theta = np.asarray(theta, dtype=float)
        turn = np.floor(theta / TURN)
        inside = theta - TURN * turn
        starts = np.array([segment.start for segment in self.segments])
        return self.on_segment(np.clip(np.searchsorted(starts, inside, side="right") - 1, 0, len(starts) - 1), inside, turn)


def refuse_stations(pins: int, stations: int) -> None:
    """InputError where the stations of a wheel do not divide its pins: after a step the pins must stand where others stood before it."""
    if stations >= 1 and pins % stations == 0:
        return
    least = max(stations, 1)
    fitting = [str(number) for number in (pins - pins % least, pins + -pins % least) if number >= 3]
    dividing = ", ".join(str(number) for number in range(1, pins + 1) if pins % number == 0)
    raise InputError(
        f"stations = {stations} does not divide pins = {pins}: a step of {360 / least:.4g}° would pass {pins / least:.4g} pins, but it "
        "must pass a whole number. "
        f"Take {' or '.join(fitting)} pins, or stations from {dividing}."
    )


def step_angle(name: str, motion_to_dwell: Numbers | Literal["no-dwell"]) -> Numbers:
    """Input angle [rad] in which the wheel moves, 2 pi r/(1 + r), r = motion_to_dwell; a full turn for "no-dwell" and for "uniform"."""
    if isinstance(motion_to_dwell, str) or name == "uniform":
        return TURN
    return TURN * motion_to_dwell / (1 + motion_to_dwell)


def index_motion(name: str, divisions: int, motion_to_dwell: float | Literal["no-dwell"] = 1.0, **parameters: float) -> IndexMotion:
    """IndexMotion of the law `name` with the `step_angle` of that ratio.

    Raises InputError for a law whose velocity jumps or that does not go from rest to rest where a dwell follows.
    """
    found = law(name, **parameters)
    if motion_to_dwell == NO_DWELL or name == "uniform":
        return IndexMotion(found, divisions, TURN)
    if isinstance(motion_to_dwell, str) or not (np.isfinite(motion_to_dwell) and motion_to_dwell > 0):
        raise InputError(f"motion_to_dwell = {motion_to_dwell}; the ratio of motion to dwell is above 0 and finite, or {NO_DWELL!r}.")
    if found.continuity < 1:
        raise InputError(
            f"motion law {name!r}: its velocity jumps by {found.peaks().Vm:.4g}, which causes an impact at the ends of the dwell. "
            f'Take a law from rest to rest, as "modified-sine", or motion_to_dwell = "{NO_DWELL}".'
        )
    return IndexMotion(found, divisions, float(step_angle(name, motion_to_dwell)))


def index_motion_of_rows(rows: TableLaw, divisions: int) -> IndexMotion:
    """IndexMotion through rows of input angle and wheel angle [rad]; the last row is the end of the step, its input angle the motion angle.

    Raises InputError where the rows do not begin at 0, do not end at 2 pi/divisions, or take more than a turn of the input.
    """
    span, step = float(rows.span or 0.0), TURN / divisions
    first, last = (float(rows(u).s) for u in (0.0, 1.0))
    if rows.lift_unit == "m":
        raise InputError("the lift in the table is a length, but the wheel turns; give the wheel's angle: lift [deg].")
    if abs(first) > JOINT * step:
        raise InputError(f"the wheel's angle in the table starts at {np.degrees(first):.9g}°; start it at 0, the angle in the dwell.")
    if abs(last - step) > ROWS * step:
        raise InputError(
            f"the wheel's angle in the table ends at {np.degrees(last):.9g}°, but a step of {divisions} stations is "
            f"{np.degrees(step):.9g}°. Scale the column, or change stations."
        )
    if span > TURN * (1 + JOINT):
        raise InputError(f"the table ends at an input angle of {np.degrees(span):.9g}°; a step takes at most one turn of the input, 360°.")
    law_of_step = MotionLaw(rows.name, rows.function.scaled(height=1 / last))
    return IndexMotion(law_of_step, divisions, min(span, TURN))


def motion_table(motion: IndexMotion, points: int = 721) -> Table:
    """The wheel's angle and its derivatives by the input angle over one turn of the input."""
    angle = np.linspace(0, TURN, points)
    phi, rate, second, third = motion(angle)
    return Table(
        "motion",
        "Motion of the wheel",
        (
            Column("angle", "rad", "input angle", angle),
            Column("wheel", "rad", "wheel angle", phi),
            Column("rate", "-", "speed of the wheel over that of the input", rate, "Speed ratio, wheel to input"),
            Column("bend", "1/rad", "second derivative of the wheel angle", second),
            Column("third", "1/rad^2", "third derivative of the wheel angle", third),
        ),
    )
