"""One turn of a cam in smooth pieces: every quantity has a value on either side of a joint, and its extremes are exact."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol, TypeAlias

import numpy as np

from drivewright._typing import Floats, Ints, Numbers
from drivewright.numerics.jets import Jet, variable
from drivewright.numerics.roots import bracketed_roots

STEP = np.radians(0.5)
EQUAL = 1e-12  # values closer than this, relative to the largest, are one; the first of them is named

Quantity: TypeAlias = Callable[[Jet, Jet], Jet]  # of the jets angle and lift


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
    """A greatest or least value, the angle [rad] and the smooth piece where it stands."""

    value: float
    angle: float
    piece: int


@dataclass(frozen=True, eq=False)
class Cycle:
    """The motion over one turn: `motion.breaks` (n+1,) [rad] and `motion.on_piece(k, angle)` -> (s, s', s'', s''') on piece k.

    `chosen` restricts everything to some of the pieces, such as those of one phase.  A *quantity* below is a function of the
    two jets angle and lift that returns a jet with a valid slope.
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

    def samples(self, step: float = STEP, least: int = 8) -> tuple[Ints, Floats]:
        """(piece, angle): places at most `step` apart with both ends of every piece, so that each joint stands twice."""
        pieces, breaks = self.pieces, self.motion.breaks
        counts = np.maximum(np.ceil(np.diff(breaks)[pieces] / step).astype(int), least) + 1
        # linspace gives both ends exactly.
        angle = np.concatenate([np.linspace(breaks[k], breaks[k + 1], count) for k, count in zip(pieces, counts, strict=True)])
        return np.repeat(pieces, counts), angle

    def maximum(self, quantity: Quantity, step: float = STEP) -> Extreme:
        """`Extreme` of a quantity; of equal ones the first.  The angle is exact to rounding."""
        piece, angle = self.samples(step)
        sampled = quantity(*self.at(piece, angle))
        values, slope = np.broadcast_to(sampled.d0, angle.shape), np.broadcast_to(sampled.d1, angle.shape)
        piece, angle, values = np.concatenate([[piece, angle, values], self._tops(quantity, piece, angle, values, slope)], axis=1)
        close = np.flatnonzero(values >= values.max() - EQUAL * np.max(np.abs(values)))
        first = close[np.argmin(angle[close])]
        return Extreme(float(values[first]), float(angle[first]), int(piece[first]))

    def minimum(self, quantity: Quantity, step: float = STEP) -> Extreme:
        """`Extreme` of the least value of a quantity; of equal ones the first."""
        opposite = self.maximum(lambda angle, lift: -quantity(angle, lift), step)
        return opposite._replace(value=-opposite.value)

    def _tops(self, quantity, piece, angle, value, slope):
        """(piece, angle, value) where the slope passes through zero between two samples that may be as high as the highest."""
        inside = (piece[:-1] == piece[1:]) & (slope[:-1] > 0) & (slope[1:] < 0)
        reach = np.maximum(value[:-1] + slope[:-1] * np.diff(angle), value[1:] - slope[1:] * np.diff(angle))
        worth = inside & (reach > value.max() + EQUAL * np.max(np.abs(value)))
        tops = [top for k in np.flatnonzero(worth) for top in self._between(quantity, piece[k], angle[k : k + 2])]
        return np.array(tops).reshape(-1, 3).T

    def _between(self, quantity, piece, ends):
        """(piece, angle, value) of the hill between two angles of a piece; none where the slope jumps over zero at a pole."""
        for top in bracketed_roots(lambda x: quantity(*self.at(np.full(x.shape, piece), x)).d1, ends):
            yield piece, top, quantity(*self.at(piece, top)).d0
