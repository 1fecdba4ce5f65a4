"""The finished profile: what the follower's face leaves standing when it has gone once around the cam."""

import numpy as np

from drivewright.curves import CircleFamily, LineFamily, Piece, Span
from drivewright.numerics.jets import Jet, variable


def path(programme, draw):
    """`curves.Piece`s of draw(angle, lift) over the programme, split where it has a joint or a jump; dwells are marked as arcs."""
    first = _cuts(programme)
    last = [*first[1:], programme.function.count]
    return tuple(_piece(programme, draw, a, b - 1) for a, b in zip(first, last, strict=True))


def family(follower, programme, flank=1):
    """The `curves` family that the face sweeps in the cam frame: circles or lines.  flank -1: the outer wall of a groove."""
    if hasattr(follower, "face"):
        return LineFamily(path(programme, follower.face))
    return CircleFamily(path(programme, follower.pitch), follower.radius, "inside" if flank > 0 else "outside")


def spans(pieces):
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
