"""What cuts a profile: a circle or a straight line moving in the plane of the part, in pieces over one closed cycle.

Each family gives the pieces of its envelope and the gap between one of its members and a point: a point is left standing
when no member's gap is negative.  It is `whole` where its envelope is all that can bound the part.
"""

from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import Any

import numpy as np

from drivewright._typing import Complexes, Floats, Ints
from drivewright.curves.pieces import Member, Piece, gather
from drivewright.curves.plane import envelope_of_circle, envelope_of_line
from drivewright.errors import InputError
from drivewright.numerics.jets import Jet, exp, sqrt, variable

_BACK = 1e-3  # a turn [rad] so near to half a turn is a cusp of the path
_CORNER = 1e-9  # a turn [rad], or a step relative to the radius, below this is rounding and no corner


@dataclass(frozen=True)
class CircleFamily:
    """A roller or cutter of `radius` whose centre runs once along the closed `path` (Pieces of complex jets).

    Pieces of one `loop` follow one another; loops with other numbers are the paths of further cutters of the same part.
    `material` is "inside" when the part lies within the ring that the circle sweeps (disc cam, inner flank of a groove) and
    "outside" when it surrounds it (outer ring, outer flank).  `both` takes the envelope on both sides of the path, which bounds the
    part where the path turns back in loops (the pins of a wheel in its dwell); the second side is a loop of its own that runs backwards.
    """

    path: tuple[Piece, ...]
    radius: float
    material: str = "inside"
    both: bool = False

    def __post_init__(self):
        if not (np.isfinite(self.radius) and self.radius > 0):
            raise InputError(f"CircleFamily: radius = {self.radius:.6g} m; it must be positive and finite.")
        if self.material not in ("inside", "outside"):
            raise InputError(f"CircleFamily: material = {self.material!r}; it is 'inside' or 'outside' the swept ring.")
        _refuse_disorder(self.path)

    @property
    def whole(self) -> bool:
        """Whether the envelope is all that can bound the part."""
        return self.both

    @cached_property
    def side(self) -> float:
        """+1 when the profile lies to the left of the centre's travel, -1 to the right.

        The sense is that in which the path goes round the axis (the origin); if it does not, that in which it encloses its area.
        """
        t = np.concatenate([np.linspace(piece.start, piece.stop, 65) for piece in self.path])
        points = gather(self.path, np.repeat(np.arange(len(self.path)), 65), t).d0
        loops = np.split(points, 65 * self._first[1:])
        step: Complexes = np.concatenate([np.conj(loop) * np.roll(loop, -1) for loop in loops])
        turns = np.round(np.sum(np.angle(step)) / (2 * np.pi))
        turn = np.sign(turns if turns else np.sum(step.imag))
        return turn if self.material == "inside" else -turn

    def envelope(self) -> tuple[Piece, ...]:
        """Pieces of the envelope in the order of the motion, an arc put in wherever the path has a corner."""
        if not self.both:
            return tuple(self._envelope(self.side))
        loops = len(self._first)
        other = [
            replace(piece, start=piece.stop, stop=piece.start, loop=loops + piece.loop)
            for piece in reversed(list(self._envelope(-self.side)))
        ]
        return (*self._envelope(self.side), *other)

    def _envelope(self, side):
        stops, starts = self._ends
        for number, piece in enumerate(self.path):
            formula, numbers = (piece.at.formula, piece.at.numbers) if isinstance(piece.at, Member) else (piece.at, ())
            if number not in self._shrunk[side]:
                branch = Member(self._branches[formula], (side, *numbers))
                yield Piece(piece.start, piece.stop, branch, piece.label, piece.shape, number, piece.loop)
            yield from self._corner(piece, stops[number], starts[number], side)

    @cached_property
    def _branches(self):
        """By formula of the path that of the envelope's branches, one and the same for all pieces that share it."""
        formulas = {getattr(piece.at, "formula", piece.at) for piece in self.path}
        return {formula: partial(_branch, formula, self.radius) for formula in formulas}

    @cached_property
    def _first(self):
        """Number of the first piece of each loop of the path."""
        loops = np.array([piece.loop for piece in self.path])
        return np.flatnonzero(np.diff(loops, prepend=loops[0] - 1))

    @cached_property
    def _ends(self):
        """Jets at the stop of each piece, and at the start of the piece after it in its loop."""
        numbers = np.arange(len(self.path))
        stops, starts = (np.array([getattr(piece, end) for piece in self.path], float) for end in ("stop", "start"))
        after = np.concatenate([np.roll(loop, -1) for loop in np.split(numbers, self._first[1:])])
        jets = gather(self.path, np.concatenate([numbers, after]), np.concatenate([stops, starts[after]]))
        return jets[: len(numbers)], jets[len(numbers) :]

    @cached_property
    def _shrunk(self):
        """By side that bounds the part, the arcs whose envelope is their centre: the circle is as wide as the arc that it runs on."""
        arcs = np.array([number for number, piece in enumerate(self.path) if piece.shape == "arc"], dtype=int)
        sides = (1.0, -1.0) if self.both else (self.side,)
        if not len(arcs):
            return dict.fromkeys(sides, ())
        centre = gather(self.path, arcs, np.array([0.5 * (self.path[k].start + self.path[k].stop) for k in arcs]))
        slow = {side: np.abs(envelope_of_circle(centre, self.radius, side).d1) < _CORNER * np.abs(centre.d1) for side in sides}
        return {side: arcs[shortest] for side, shortest in slow.items()}

    def _corner(self, piece, before, after, side):
        turn = float(np.angle(after.d1 / before.d1))
        if abs(turn) < _CORNER:
            return
        if self.both and np.pi - abs(turn) < _BACK:  # the left side goes round in front of the tip, the right one, covered, behind it
            turn -= 2 * np.pi * (turn > 0)
        arm = side * self.radius * 1j * before.d1 / abs(before.d1)
        yield Piece(0.0, turn, Member(_around, (before.d0, arm)), f"{piece.label} corner", "arc", loop=piece.loop)

    def members(self, index: Ints, t: Floats) -> Complexes:
        """The centres at parameters t of the pieces `index`."""
        return gather(self.path, index, t).d0

    def gap(self, centre: Any, point: Any) -> Any:
        """|point - centre| - radius; the point may be a jet."""
        apart = point - centre
        return (sqrt(apart.abs2()) if isinstance(apart, Jet) else np.abs(apart)) - self.radius

    def deepest(self, members: Complexes, points: Complexes) -> Ints:
        """For each point the number of the member with the least gap."""
        from scipy.spatial import KDTree

        return np.asarray(KDTree(np.stack([members.real, members.imag], axis=1)).query(np.stack([points.real, points.imag], axis=1))[1])


@dataclass(frozen=True)
class LineFamily:
    """A flat face moving through one cycle: pieces whose `at(t)` gives the jets (direction beta, support p).

    The face is the line Re(conj(n) z) = p with n = e^{i beta}; the part lies on its side Re(conj(n) z) <= p, the follower beyond.
    """

    motion: tuple[Piece, ...]
    material: str = "inside"

    whole = True  # the envelope is all that can bound the part

    def __post_init__(self):
        if self.material != "inside":
            raise InputError(f"LineFamily: material = {self.material!r}; a straight face can only cut what lies 'inside' its envelope.")
        _refuse_disorder(self.motion)

    def envelope(self) -> tuple[Piece, ...]:
        """Pieces of the envelope in the order of the motion, a straight piece put in wherever the contact point jumps."""
        pieces = [Piece(piece.start, piece.stop, self._branch(piece), piece.label, piece.shape, k) for k, piece in enumerate(self.motion)]
        size = max(abs(_end(piece, piece.start).d0) for piece in pieces)
        joined = []
        for piece, following in _pairs(pieces):
            joined += [piece, *self._corner(_end(piece, piece.stop).d0, _end(following, following.start).d0, piece, size)]
        return tuple(joined)

    def _branch(self, piece):
        return lambda t: envelope_of_line(*piece.at(t))

    def _corner(self, before, after, piece, size):
        if abs(after - before) > _CORNER * size:
            yield Piece(0.0, 1.0, lambda u: before + (after - before) * variable(u), f"{piece.label} corner", "line")

    def members(self, index: Ints, t: Floats) -> Complexes:
        """Rows of unit normal and support at parameters t of the pieces `index`."""
        direction, support = gather(self.motion, index, t)
        return np.stack([np.exp(1j * direction.d0), support.d0 + 0j])

    def gap(self, member: Any, point: Any) -> Any:
        """p - Re(conj(n) z); the point may be a jet."""
        normal, support = member
        return support.real - (normal.conj() * point).real

    def deepest(self, members: Complexes, points: Complexes) -> Ints:
        """For each point the number of the member with the least gap."""
        normal, support = members
        reach = np.stack([points.real, points.imag], axis=1) @ np.stack([normal.real, normal.imag])
        return np.argmin(support.real - reach, axis=1)


def _around(centre, arm, angle):
    return centre + arm * exp(1j * variable(angle))


def _branch(formula, radius, side, *where):
    return envelope_of_circle(formula(*where), radius, side)


def _pairs(pieces):
    return zip(pieces, (*pieces[1:], pieces[0]), strict=True)


def _end(piece, t):
    return piece.at(np.array([float(t)]))[0]


def _refuse_disorder(pieces):
    if not pieces:
        raise InputError("family: it has no pieces; give at least one covering the cycle.")
    for piece, following in zip(pieces, pieces[1:], strict=False):
        if not piece.start < piece.stop or abs(following.start - piece.stop) > 1e-9 * abs(pieces[-1].stop - pieces[0].start):
            raise InputError(
                f"family: piece '{piece.label}' runs from {piece.start:.6g} to {piece.stop:.6g} and the next starts at "
                f"{following.start:.6g}. Each must run upwards and start where the one before stops."
            )
