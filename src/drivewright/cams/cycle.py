"""One turn of a cam in smooth pieces: every quantity has a value on either side of a joint, and its extremes are exact."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple, Protocol, TypeAlias

import numpy as np

from drivewright._typing import Floats, Ints, Numbers
from drivewright.cams.refusals import nan_unless
from drivewright.numerics.jets import Jet, variable
from drivewright.numerics.roots import roots_in_brackets

STEP, LEAST = np.radians(0.5), 8  # of the samples: angle between two of them, and intervals of a piece
EQUAL = 1e-12  # values closer than this, relative to the largest, are one; the first of them is named

Quantity: TypeAlias = Callable[[Jet, Jet], Jet]  # of the jets angle and lift


class SampledJet(Jet):
    """The lift at the samples of a `Cycle`: what is computed there is worth keeping, as one quantity after another is computed."""


class PiecewiseMotion(Protocol):
    """What a `Cycle` needs of a motion over one turn; a `motion.Programme` has it."""

    @property
    def breaks(self) -> Floats:
        """Ends of the smooth pieces [rad]."""
        ...

    def on_piece(self, k: Any, theta: Any, /) -> Any:
        """Motion (s, v, a, j) by the formula of piece k."""
        ...


class Extreme(NamedTuple):
    """A greatest or least value, the angle [rad] and the smooth piece where it stands; of many designs each a column (n, 1)."""

    value: float
    angle: float
    piece: int

    def where(self, good: Any) -> "Extreme":
        """The same for the designs for which it is `good`; nan for the others."""
        return self._replace(value=nan_unless(good, self.value), angle=nan_unless(good, self.angle))


@dataclass(frozen=True, eq=False)
class Cycle:
    """The motion over one turn: `motion.breaks` (n+1,) [rad] and `motion.on_piece(k, angle)` -> (s, s', s'', s''') on piece k.

    `chosen` restricts everything to some of the pieces, such as those of one phase.  A *quantity* below is a function of the
    two jets angle and lift that returns a jet with a valid slope: of shape (m,) as the angles, or (n, m) for n designs whose numbers
    are columns (n, 1).
    """

    motion: PiecewiseMotion
    chosen: tuple[int, ...] | None = None

    @property
    def pieces(self) -> Ints:
        """Numbers of the smooth pieces that count."""
        return np.arange(len(self.motion.breaks) - 1) if self.chosen is None else np.array(self.chosen)

    def at(self, piece: int | Ints, angle: Numbers) -> tuple[Jet, Jet]:
        """(angle, lift): the jets at these angles by the formulas of these pieces."""
        return variable(angle), Jet(*self.motion.on_piece(piece, angle))

    def at_angle(self, angle: Numbers) -> tuple[Jet, Jet]:
        """(angle, lift): the same by the piece in which each angle lies; at a joint by the later one."""
        breaks = self.motion.breaks
        return self.at(np.clip(np.searchsorted(breaks, angle, side="right") - 1, 0, len(breaks) - 2), angle)

    def after(self, shift: float, angle: Jet) -> Jet:
        """The jet of the lift a fixed angle later in the turn."""
        return self.at_angle(np.mod(angle.d0 + shift, self.motion.breaks[-1]))[1]

    def samples(self, step: float = STEP, least: int = LEAST) -> tuple[Ints, Floats]:
        """(piece, angle): places at most `step` apart with both ends of every piece, so that each joint stands twice."""
        return self._finest[:2] if (step, least) == (STEP, LEAST) else self._places(step, least)

    def sampled(self) -> tuple[Jet, "SampledJet"]:
        """(angle, lift): the jets at `samples()`, the same objects each time."""
        return self._finest[2:]

    @cached_property
    def _finest(self) -> tuple[Ints, Floats, Jet, "SampledJet"]:
        """(piece, angle, jet of the angle, jet of the lift) at the usual step."""
        piece, angle = self._places(STEP, LEAST)
        of_angle, lift = self.at(piece, angle)
        return piece, angle, of_angle, SampledJet(*lift)

    def _places(self, step, least):
        pieces, breaks = self.pieces, self.motion.breaks
        counts = np.maximum(np.ceil(np.diff(breaks)[pieces] / step).astype(int), least) + 1
        # linspace gives both ends exactly.
        angle = np.concatenate([np.linspace(breaks[k], breaks[k + 1], count) for k, count in zip(pieces, counts, strict=True)])
        return np.repeat(pieces, counts), angle

    def maximum(self, quantity: Quantity, step: float = STEP) -> Extreme:
        """`Extreme` of a quantity; of equal ones the first.  The angle is exact to rounding."""
        piece, angle = self.samples(step)
        sampled = quantity(*(self.sampled() if step == STEP else self.at(piece, angle)))
        values, slope, angle, piece = np.broadcast_arrays(sampled.d0, sampled.d1, angle, piece)
        tops = self._tops(quantity, piece, angle, values, slope)
        return _first_greatest(*(np.concatenate(pair, axis=-1) for pair in zip((values, angle, piece), tops, strict=True)))

    def minimum(self, quantity: Quantity, step: float = STEP) -> Extreme:
        """`Extreme` of the least value of a quantity; of equal ones the first."""
        opposite = self.maximum(lambda angle, lift: -quantity(angle, lift), step)
        return opposite._replace(value=-opposite.value)

    def _tops(self, quantity, piece, angle, value, slope):
        """(value, angle, piece), each (..., k), where the slope passes through zero between two samples that may be as high as the highest.

        All hills of all designs are climbed at once; a design with fewer than k of them, or one whose slope jumps over zero at a pole,
        names a sample again.
        """
        inside = (piece[..., :-1] == piece[..., 1:]) & (slope[..., :-1] > 0) & (slope[..., 1:] < 0)
        width = np.diff(angle)
        with np.errstate(invalid="ignore"):  # inf - inf at a pole
            reach = np.maximum(value[..., :-1] + slope[..., :-1] * width, value[..., 1:] - slope[..., 1:] * width)
        worth = inside & (reach > value.max(axis=-1, keepdims=True) + EQUAL * np.max(np.abs(value), axis=-1, keepdims=True))
        left = _numbers_of(worth)
        ends = [np.take_along_axis(part, left + right, axis=-1) for right in (0, 1) for part in (angle, slope)]
        own = np.take_along_axis(piece, left, axis=-1)
        if not left.size:
            return ends[0], ends[0], own
        top = roots_in_brackets(lambda x: quantity(*self.at(own, x)).d1, ends[0], ends[2], ends[1], ends[3])
        top = np.where(np.isfinite(top), top, ends[0])
        return np.broadcast_to(quantity(*self.at(own, top)).d0, top.shape), top, own


def _numbers_of(chosen):
    """Numbers (..., k) of the chosen samples (..., m) of each design, k those of the design with the most; 0 where a design has fewer."""
    flat = chosen.reshape(-1, chosen.shape[-1])
    row, sample = np.nonzero(flat)
    place = np.arange(len(row)) - np.searchsorted(row, row)
    numbers = np.zeros((len(flat), place.max(initial=-1) + 1), int)
    numbers[row, place] = sample
    return numbers.reshape(*chosen.shape[:-1], -1) if numbers.size else np.zeros((*chosen.shape[:-1], 0), int)


def _first_greatest(values, angle, piece):
    """`Extreme` of places (m,), or of places (n, m) of n designs; nan where a value is nan."""
    greatest = values.max(axis=-1, keepdims=True)
    close = values >= greatest - EQUAL * np.max(np.abs(values), axis=-1, keepdims=True)
    first = np.argmin(np.where(close, angle, np.inf), axis=-1, keepdims=True)
    value, angle, piece = (np.take_along_axis(part, first, axis=-1) for part in (values, angle, piece))
    value = np.where(np.isnan(greatest), np.nan, value)
    if values.ndim > 1:
        return Extreme(value, angle, piece)  # pyright: ignore[reportArgumentType]  columns of many designs
    return Extreme(float(value[0]), float(angle[0]), int(piece[0]))
