"""Curves made of smooth pieces joined end to end, and points spread along them."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from drivewright._typing import Complexes, Floats, Ints
from drivewright.errors import InputError
from drivewright.numerics.jets import Jet

_JOINT = 1e-8  # two pieces meet when their ends are this close, relative to the size of the curve

_SHARP, _HALVINGS = 0.25, 9  # steps that turn more [rad] are halved, at a cusp so often
_SLOW = 0.05  # a place is slow where the speed is below this part of the piece's greatest


@dataclass(frozen=True)
class Piece:
    """A smooth stretch of a curve or of a motion: `at(t)` for t from `start` to `stop`.

    `at` maps an array of t to a complex Jet (a line family: to the two real Jets direction, support).
    `shape` is "smooth", "arc" for a true circular arc (a dwell), or "line" for a straight one.
    `stop` below `start` runs the piece backwards.  `source` tells pieces of the given motion from corners put between them.
    Pieces of one `loop` follow one another and close; loops with other numbers are closed curves of their own.
    """

    start: float
    stop: float
    at: Callable[[Any], Any]
    label: str = ""
    shape: str = "smooth"
    source: int | None = None
    loop: int = 0

    @property
    def sense(self) -> float:
        """+1 where the piece runs with its parameter, -1 where against it."""
        return 1.0 if self.stop >= self.start else -1.0


class Member(NamedTuple):
    """An `at` of a whole set of pieces that differ in numbers only: formula(*numbers, t), which takes arrays of every number too."""

    formula: Callable[..., Any]
    numbers: tuple[Any, ...]  # floats, or arrays of what differs from piece to piece

    def __call__(self, t):
        return self.formula(*self.numbers, t)


def gather(pieces: Sequence[Piece], index: Ints, t: Floats) -> Any:
    """Values of piece `index[k]` at `t[k]`: a Jet, or a tuple of Jets, of the shape of t; pieces with one formula together."""
    formulas = {}
    number = np.array([formulas.setdefault(getattr(piece.at, "formula", piece.at), len(formulas)) for piece in pieces])[index]
    order = np.argsort(number, kind="stable")
    first = np.unique(number[order], return_index=True)[1]
    groups = zip(np.split(index[order], first[1:]), np.split(t[order], first[1:]), strict=True)
    values = [_spread(_together(pieces, own, part), part.shape) for own, part in groups]
    back = np.empty_like(order)
    back[order] = np.arange(len(order))
    if isinstance(values[0], Jet):
        return _joined(values)[back]
    return tuple(_joined(column)[back] for column in zip(*values, strict=True))


def _together(pieces, index, t):
    """Values of pieces that have one formula."""
    at = pieces[index[0]].at
    if not isinstance(at, Member):
        return at(t)
    used, own = np.unique(index, return_inverse=True)
    return at.formula(*np.array([pieces[k].at.numbers for k in used]).T[:, own], t)


def _spread(value, shape):
    """The jet, or each jet of the tuple, with all parts of one shape (a constant may come as a scalar)."""
    if isinstance(value, Jet):
        return Jet(*(np.broadcast_to(part, shape) for part in value))
    return tuple(_spread(jet, shape) for jet in value)


def _joined(jets):
    return Jet(*(np.concatenate(column) for column in zip(*jets, strict=True)))


@dataclass(frozen=True)
class Chain:
    """Pieces joined end to end into closed loops, with samples: piece index, parameter, point z, velocity v along the chain.

    A place on the chain is a float u: the sample number, fractions in between.
    """

    pieces: tuple[Piece, ...]
    index: Ints
    t: Floats
    z: Complexes
    v: Complexes

    @cached_property
    def first(self) -> Ints:
        """Sample number at which each piece starts, and the total number at the end."""
        return np.append(np.searchsorted(self.index, np.arange(len(self.pieces))), len(self.t))

    @cached_property
    def loops(self) -> Ints:
        """Number of the first piece of each loop, and the number of pieces at the end."""
        loop = np.array([piece.loop for piece in self.pieces])
        return np.append(np.flatnonzero(np.diff(loop, prepend=loop[0] - 1)), len(loop))

    @cached_property
    def loop(self) -> Ints:
        """Which of the `loops` each piece is in."""
        return np.repeat(np.arange(len(self.loops) - 1), np.diff(self.loops))

    @cached_property
    def following(self) -> Ints:
        """Number of the piece after each piece of its loop."""
        following = np.arange(1, len(self.pieces) + 1)
        following[self.loops[1:] - 1] = self.loops[:-1]
        return following

    @cached_property
    def previous(self) -> Ints:
        """Number of the piece before each piece of its loop."""
        return np.argsort(self.following)

    @cached_property
    def segments(self) -> Ints:
        """Sample numbers that start a chord inside a piece."""
        return np.flatnonzero(self.index[:-1] == self.index[1:])

    @cached_property
    def size(self) -> float:
        """Largest extent of the curve [m]."""
        return float(max(np.ptp(self.z.real), np.ptp(self.z.imag)))

    def locate(self, u: Floats) -> tuple[Ints, Floats]:
        """Piece index and parameter at the places u."""
        u = np.mod(u, len(self.t))
        index = np.clip(np.searchsorted(self.first, u, side="right") - 1, 0, len(self.pieces) - 1)
        u = np.minimum(u, self.first[index + 1] - 1)
        below = np.minimum(np.floor(u).astype(int), self.first[index + 1] - 2)
        return index, self.t[below] + (u - below) * (self.t[below + 1] - self.t[below])

    def place(self, index: Ints, t: Floats) -> Floats:
        """The places u of parameters t on pieces `index`."""
        u = np.empty(len(t))
        for k in np.unique(index):
            span = slice(self.first[k], self.first[k + 1])
            sense = self.pieces[k].sense
            u[index == k] = self.first[k] + np.interp(sense * t[index == k], sense * self.t[span], np.arange(int(span.stop - span.start)))
        return u


def sample(pieces: Sequence[Piece], count: int = 1440, least: int = 96) -> Chain:
    """Chain of the pieces with about `count` samples, spread half by parameter, half by arc length; at least `least` per piece."""
    coarse = [np.linspace(piece.start, piece.stop, 33) for piece in pieces]
    speeds = np.abs(gather(pieces, np.repeat(np.arange(len(pieces)), 33), np.concatenate(coarse)).d1).reshape(-1, 33)
    lengths = [_running_length(speed, t) for speed, t in zip(speeds, coarse, strict=True)]
    total = sum(length[-1] for length in lengths)
    spans = np.array([abs(piece.stop - piece.start) for piece in pieces])
    spread = []
    for t, length, span in zip(coarse, lengths, spans / spans.sum(), strict=True):
        share = 0.5 * span * np.linspace(0, 1, 33) + 0.5 * length / total
        number = max(least, int(np.ceil(count * share[-1])))
        spread.append(_ends_exact(np.interp(np.linspace(0, share[-1], number), share, t), t))
    index, t, jets = _crowded(pieces, spread)
    senses = np.array([piece.sense for piece in pieces])[index]
    chain = Chain(tuple(pieces), index, t, jets.d0, jets.d1 * senses)
    _refuse_gaps(chain)
    return chain


def _crowded(pieces, spread):
    """(index, t, jets) of samples at the parameters `spread` of each piece and more of them where the curve is slow or turns sharply.

    Sharp turns are halved in curves of several loops, both sides of a path that turns back; one loop alone has cusps that rounding makes.
    """
    index, t = _labelled(spread)
    jet = gather(pieces, index, t)
    speeds = np.split(np.abs(jet.d1), np.cumsum([len(part) for part in spread])[:-1])
    denser = [_denser(piece, part, speed) for piece, part, speed in zip(pieces, spread, speeds, strict=True)]
    if sum(map(len, denser)) > len(t):
        index, t = _labelled(denser)
        jet = gather(pieces, index, t)
    for _ in range(_HALVINGS if pieces[-1].loop else 0):  # a curve that swings round between two samples would be one long chord
        with np.errstate(invalid="ignore"):
            turn = np.abs(np.angle(np.conj(jet.d1[:-1]) * jet.d1[1:]))
        sharp = np.flatnonzero((turn > _SHARP) & (index[1:] == index[:-1]))
        if not len(sharp):
            break
        middle = 0.5 * (t[sharp] + t[sharp + 1])
        between = gather(pieces, index[sharp], middle)
        t, index = np.insert(t, sharp + 1, middle), np.insert(index, sharp + 1, index[sharp])
        jet = Jet(*(np.insert(part, sharp + 1, new) for part, new in zip(jet, between, strict=True)))
    return index, t, jet


def _labelled(parts):
    """(number of the part, value) of arrays one after the other."""
    return np.repeat(np.arange(len(parts)), [len(part) for part in parts]), np.concatenate(parts)


def _denser(piece, t, speed, parts=16):
    """Parameters t, `parts` times as many about the places where the piece is slow: cusps come in narrow pairs."""
    slow = np.flatnonzero((speed[1:-1] <= speed[:-2]) & (speed[1:-1] <= speed[2:]) & (speed[1:-1] < _SLOW * np.max(speed))) + 1
    if not len(slow):
        return t
    steps = np.unique(np.clip(slow[:, None] + np.arange(-3, 3), 0, len(t) - 2))
    between = t[steps, None] + (t[steps + 1] - t[steps])[:, None] * np.arange(1, parts) / parts
    return np.sort(np.concatenate([t, between.ravel()]))[:: int(piece.sense)]


def _running_length(speed, t):
    return np.append(0.0, np.cumsum(0.5 * (speed[1:] + speed[:-1]) * np.abs(np.diff(t))))


def _ends_exact(t, like):
    t[0], t[-1] = like[0], like[-1]
    return t


def _refuse_gaps(chain):
    ends, starts = chain.first[1:] - 1, chain.first[chain.following]
    miss = np.abs(chain.z[ends] - chain.z[starts])
    worst = int(np.argmax(miss))
    if miss[worst] > _JOINT * chain.size:
        here, there = chain.pieces[worst], chain.pieces[chain.following[worst]]
        raise InputError(
            f"curve: piece '{here.label}' ends at t = {here.stop:.6g} and piece '{there.label}' starts at t = {there.start:.6g}, "
            f"{miss[worst] * 1e3:.4g} mm apart. Pieces must follow one another without a jump and close after the last."
        )
