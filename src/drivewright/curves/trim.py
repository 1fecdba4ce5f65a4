"""The profile that is really left when a circle or a line has swept through the blank.

The envelope q(t) of the cutting family is only a candidate: parts of it are cut away later by other members.  A test of the
local curvature misses those made by distant members, so trimming is global: the envelope is split where it crosses itself,
a part survives when no member of the whole family covers it, and the survivors are chained into the loop around the part.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple, Protocol

import numpy as np

from drivewright._typing import Complexes, Floats, Ints
from drivewright.curves.crossings import Crossing, self_crossings
from drivewright.curves.outlines import outline_of_spans, span_measures
from drivewright.curves.pieces import Chain, Piece, gather, sample
from drivewright.errors import InputError, SolverError
from drivewright.scene import Outline

_UNSEEN = 1e-7  # swallowtails too small for the samples are this shallow, relative to the size of the curve


class EnvelopeFamily(Protocol):
    """What sweeps through the blank: `CircleFamily`, `LineFamily`, or a cutter of another kind."""

    @property
    def material(self) -> str:
        """ "inside" or "outside": where the part is."""
        ...

    def envelope(self) -> Sequence[Piece]:
        """Pieces of the candidate for the profile, in the order of the motion."""
        ...

    def members(self, index: Ints, t: Floats) -> Any:
        """Members of the family at parameters t of the pieces `index`."""
        ...

    def gap(self, member: Any, point: Any, /) -> Any:
        """Distance [m] of a point from a member, negative inside."""
        ...

    def deepest(self, members: Any, points: Complexes, /) -> Ints:
        """For each point the number of the member with the least gap."""
        ...


class Span(NamedTuple):
    """A surviving stretch of one envelope piece, from parameter `start` to `stop`."""

    piece: Piece
    start: float
    stop: float


class Corner(NamedTuple):
    """A sharp corner of the profile: the envelope leaves at parameter `leaves` and goes on from `resumes`."""

    leaves: float
    resumes: float
    point: complex


@dataclass(frozen=True)
class Trimmed:
    """The surviving profile of a family.

    spans: stretches of the envelope in order around the profile; corners: the trim points between them; crossings: every
    self-intersection of the envelope; area [m^2], perimeter [m] of the closed profile (of the part, or of the hole in it); sense: +1
    where the spans run counter-clockwise.
    """

    family: EnvelopeFamily
    spans: tuple[Span, ...]
    corners: tuple[Corner, ...]
    crossings: tuple[Crossing, ...]
    area: float
    perimeter: float
    sense: float
    chain: Chain = field(repr=False)

    @property
    def undercut(self) -> bool:
        """True when some of the envelope was cut away."""
        return bool(self.removed)

    @cached_property
    def removed(self) -> tuple[tuple[float, float], ...]:
        """Intervals (start, stop) of the motion's parameter whose contact point was cut away, ascending."""
        return tuple(_merged(gap for piece in self.chain.pieces if piece.source is not None for gap in _missing(piece, self.spans)))

    def outline(self, tolerance: float = 1e-6) -> Outline:
        """Counter-clockwise Outline: true arcs on dwells and rounded corners, splines within `tolerance` [m] of their chords elsewhere."""
        return outline_of_spans(self.spans, tolerance)


def trim(family: EnvelopeFamily, interior: complex = 0j, samples: int = 1440, least: int = 96) -> Trimmed:
    """Profile left by the family around the point `interior` (for material "outside": around the whole sweep).

    samples: points on the envelope from which crossings are sought, at least `least` on each piece; a swallowtail narrower than
    two of them is not seen, it is shallower than 1e-7 of the profile's size.
    Raises InputError where nothing is left around the interior point, SolverError when the parts do not chain.
    """
    chain = sample(family.envelope(), samples, least)
    crossings = self_crossings(chain)
    cuts, partner = _cuts(crossings)
    if family.material == "inside":
        _refuse_swept(family, chain, interior)
    parts, following = _parts(chain, cuts)
    alive = _alive(family, chain, parts)
    turns_into = np.append(partner, np.arange(len(cuts), len(parts)))[following]
    loop = _choose(chain, parts, _loops(turns_into, alive), interior, family.material)
    spans, corners = _spans(chain, cuts, parts, following, loop)
    area, perimeter = span_measures(spans)
    return Trimmed(family, spans, corners, crossings, abs(area), perimeter, float(np.sign(area)), chain)


def _refuse_swept(family, chain, interior):
    gap = float(_least_gap(family, chain, np.array([complex(interior)]))[0])
    if gap <= 0:
        raise InputError(
            f"trim: the cutter passes {-gap * 1e3:.4g} mm over the interior point ({interior.real:.4g}, {interior.imag:.4g}) m, so no part "
            "is left around it. Enlarge the base circle or take a smaller roller."
        )


def _cuts(crossings):
    """Places where the chain is split, ascending, and for each the number of its partner."""
    places = np.array([place for crossing in crossings for place in crossing[:2]])
    order = np.argsort(places)
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    return places[order], rank[order ^ 1]


class _Part(NamedTuple):
    """Places from `start` to `stop` on the loop of the chain that has the samples from `low` to `high`; stop may run over its end."""

    start: float
    stop: float
    low: int
    high: int

    def inside(self, place):
        """The place on the loop itself."""
        return self.low + (place - self.low) % (self.high - self.low)

    @property
    def samples(self):
        """Numbers of the samples on it."""
        return self.inside(np.arange(int(np.ceil(self.start)), int(np.ceil(self.stop))))


def _parts(chain, cuts):
    """Parts of the chain, number k from cut k to the next cut of its loop, then the loops without a cut; and which part follows each."""
    bounds = chain.first[chain.loops]
    home = np.searchsorted(bounds, cuts, side="right") - 1
    parts: dict[int, _Part] = {}
    following, free = {}, len(cuts)
    for loop, (low, high) in enumerate(zip(bounds[:-1], bounds[1:], strict=True)):
        own = np.flatnonzero(home == loop)
        for k, after in zip(own, np.roll(own, -1), strict=True):
            parts[int(k)] = _Part(cuts[k], cuts[after] + (high - low if after <= k else 0), low, high)
            following[int(k)] = after
        if not len(own):
            parts[free], following[free] = _Part(float(low), float(high), low, high), free
            free += 1
    return [parts[k] for k in range(free)], np.array([following[k] for k in range(free)], dtype=int)


def _alive(family, chain, parts):
    """Whether each part survives: no member covers its middle or a sample on it."""
    middles = gather(chain.pieces, *chain.locate(np.array([part.inside(0.5 * (part.start + part.stop)) for part in parts]))).d0
    gaps = _least_gap(family, chain, np.append(chain.z, middles))
    least = [min(np.min(gaps[part.samples], initial=np.inf), gaps[len(chain.z) + k]) for k, part in enumerate(parts)]
    return np.array(least) >= -_UNSEEN * chain.size


def _least_gap(family, chain, points):
    """Least gap [m] between each point and the family's members at the samples; a negative one means covered."""
    source = np.array([-1 if piece.source is None else piece.source for piece in chain.pieces])[chain.index]
    members = family.members(source[source >= 0], chain.t[source >= 0])
    return family.gap(members[..., family.deepest(members, points)], points)


def _loops(turns_into, alive):
    """Closed sequences of surviving parts: at its end each turns into the part that starts at the partner of that cut."""
    left = set(np.flatnonzero(alive))
    loops = []
    while left:
        start = k = min(left)
        loop = []
        while k in left:
            left.remove(k)
            loop.append(int(k))
            k = turns_into[k]
        if k == start:
            loops.append(loop)
    return loops


def _choose(chain, parts, loops, interior, material):
    """The loop that winds around the interior point: the smallest for material inside, the largest for material outside."""
    around = []
    for loop in loops:
        points = np.concatenate([chain.z[parts[k].samples] for k in loop])
        arms = points - interior
        winding = np.sum(np.angle(np.roll(arms, -1) / arms)) / (2 * np.pi)
        if abs(winding) > 0.5:
            around.append((abs(np.sum(np.imag(np.conj(arms) * np.roll(arms, -1)))), loop))
    if not around:
        raise SolverError(
            f"trim: {len(loops)} closed loops survive of {len(parts)} parts of the envelope, none around the interior point "
            f"({interior.real:.4g}, {interior.imag:.4g}) m: either a self-intersection was missed (raise `samples` above {len(chain.t)}), "
            "or the motion turns back so far in a loop that the other side of its path bounds the part (smooth the motion)."
        )
    return (min if material == "inside" else max)(around)[1]


def _spans(chain, cuts, parts, following, loop):
    """Spans of the parts of the loop, in order, and the corners between them; a loop without a cut has none."""
    spans = tuple(span for k in loop for span in _split(chain, parts[k]))
    if loop[0] >= len(cuts):
        return spans, ()
    index, t = chain.locate(cuts[np.stack([following[loop], np.roll(loop, -1)])].ravel())
    leaves, resumes = t.reshape(2, -1)
    points = gather(chain.pieces, index[: len(loop)], leaves).d0
    return spans, tuple(Corner(float(a), float(b), complex(point)) for a, b, point in zip(leaves, resumes, points, strict=True))


def _split(chain, part):
    """Spans of the part, one per piece."""
    spans = []
    begin, end = np.searchsorted(chain.first, [part.low, part.high])  # pieces of its loop
    for turn in (0, part.high - part.low):
        above = np.searchsorted(chain.first, [part.start - turn, part.stop - turn], side="right")
        for k in range(max(begin, above[0] - 1), min(end, above[1])):
            piece = chain.pieces[k]
            low, high = max(part.start, chain.first[k] + turn), min(part.stop, chain.first[k + 1] - 1 + turn)
            if high > low:
                _, t = chain.locate(np.array([low, high]) - turn)
                spans.append(Span(piece, float(t[0]), float(t[1])))
    return spans


def _missing(piece, spans):
    """Intervals of a piece, one that runs forwards, that no span holds."""
    at = piece.start
    for start, stop in sorted((span.start, span.stop) for span in spans if span.piece is piece):
        if start > at:
            yield at, start
        at = stop
    if at < piece.stop:
        yield at, piece.stop


def _merged(intervals):
    merged = []
    for start, stop in sorted(intervals):
        if merged and start <= merged[-1][1]:
            merged[-1] = (merged[-1][0], max(stop, merged[-1][1]))
        else:
            merged.append((start, stop))
    return merged
