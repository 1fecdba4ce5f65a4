"""What the follower's face sweeps when it goes once around the cam: its family in the cam frame, and its overtravel."""

from collections.abc import Callable, Iterable
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from drivewright.cams.followers import OscillatingFlat, OscillatingRound, TranslatingFlat, TranslatingRound
from drivewright.curves import CircleFamily, LineFamily, Piece, Span
from drivewright.motion import Programme
from drivewright.numerics.jets import Jet, constant, variable

RoundFollower: TypeAlias = TranslatingRound | OscillatingRound
FlatFollower: TypeAlias = TranslatingFlat | OscillatingFlat
Follower: TypeAlias = RoundFollower | FlatFollower


def path(programme: Programme, draw: Callable[[Jet, Jet], Any]) -> tuple[Piece, ...]:
    """`curves.Piece`s of draw(angle, lift) over the programme, split where it has a joint or a jump; dwells are marked as arcs."""
    first = _cuts(programme)
    last = [*first[1:], programme.function.count]
    return tuple(_piece(programme, draw, a, b - 1) for a, b in zip(first, last, strict=True))


def family(follower: Follower, programme: Programme, flank: int = 1) -> CircleFamily | LineFamily:
    """The `curves` family that the face sweeps in the cam frame: circles or lines.  flank -1: the outer wall of a groove."""
    if isinstance(follower, FlatFollower):
        return LineFamily(path(programme, follower.face))
    return CircleFamily(path(programme, follower.pitch), follower.radius, "inside" if flank > 0 else "outside")


class Overtravel(NamedTuple):
    """The motion of a follower along its travel beyond its programme, into an undercut cam: what `curves.lost_motion` wants.

    place(angle, depth): members of the family, `depth` [m] of travel (of the arm's end where it swings) below the planned place;
    fastest: the most that a point of the face comes nearer per depth.
    """

    place: Callable[[Any, Any], Any]
    fastest: float


def overtravel(follower: Follower, programme: Programme, flank: int = 1) -> Overtravel:
    """The `Overtravel` of a follower into its cam; flank -1: outwards, into the outer wall of a groove."""

    def lift(angle, depth):
        return constant(programme(angle).s - flank * getattr(follower, "side", 1) * depth / follower.reach)

    if not isinstance(follower, FlatFollower):
        return Overtravel(lambda angle, depth: follower.pitch(variable(angle), lift(angle, depth)).d0, 1.0)

    def face(angle, depth):
        direction, support = follower.face(variable(angle), lift(angle, depth))
        return np.stack([np.exp(1j * direction.d0), support.d0 + 0j])

    # A line about a pivot, which lies outside the cam: no point of the cam is farther from it than twice its distance from the centre.
    return Overtravel(face, 2 * follower.pivot_distance / follower.reach if isinstance(follower, OscillatingFlat) else 1.0)


def spans(pieces: Iterable[Piece]) -> tuple[Span, ...]:
    """The whole of the pieces as spans, for a profile that nothing trims (a knife edge, a pitch curve)."""
    return tuple(Span(piece, piece.start, piece.stop) for piece in pieces)


def _cuts(programme):
    """Numbers of the smooth pieces that begin at a joint of segments or with a jump of lift, velocity or acceleration."""
    function = programme.function
    jump = np.any([function.jumps(order)[:-1] != 0 for order in range(3)], axis=0)
    jump[np.searchsorted(function.breaks, programme.starts[:-1])] = True
    return np.flatnonzero(jump)


def _piece(programme, draw, first, last):
    function = programme.function
    still = all(programme.pieces[k].phase == "dwell" for k in range(first, last + 1))
    name = programme.segments[programme.pieces[first].segment].law.name

    def at(angle):
        # One-sided at the ends: the pieces outside this stretch have another formula.
        k = np.clip(np.searchsorted(function.breaks, angle, side="right") - 1, first, last)
        return draw(variable(angle), Jet(*function.on_piece(k, np.asarray(angle, float))))

    return Piece(float(function.breaks[first]), float(function.breaks[last + 1]), at, name, "arc" if still else "smooth")
