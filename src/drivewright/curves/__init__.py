"""Plane curves as complex jets, envelopes of moving circles and lines, and the profile that is really left of them.

`plane`      tangent, curvature, offset, envelopes of one jet
`pieces`     pieces of a curve and dense samples of them
`families`   circles and lines that move: their envelopes
`crossings`, `trim`  self-crossings of an envelope; what remains of it
`undercut`   gap and lost motion on a trimmed profile
`touching`   places where a circle touches a profile
`outlines`, `toolpath`  outlines of arcs, lines and splines; their parallels for a cutter
`display`    outlines for pictures, from chords
"""

from drivewright.curves.crossings import Crossing
from drivewright.curves.display import display_outline, simple_outline
from drivewright.curves.families import CircleFamily, LineFamily
from drivewright.curves.outlines import outline_area, outline_of_spans, perimeter
from drivewright.curves.pieces import Member, Piece
from drivewright.curves.plane import curvature, curvature_rate, derivative, envelope_of_circle, envelope_of_line, normal, offset, tangent
from drivewright.curves.toolpath import offset_outline
from drivewright.curves.trim import Corner, Span, Trimmed, trim
from drivewright.curves.undercut import largest_lost_motion, largest_profile_gap, lost_motion, profile_gap, profile_loss

__all__ = [
    "CircleFamily",
    "Corner",
    "Crossing",
    "LineFamily",
    "Member",
    "Piece",
    "Span",
    "Trimmed",
    "curvature",
    "curvature_rate",
    "derivative",
    "display_outline",
    "envelope_of_circle",
    "envelope_of_line",
    "largest_lost_motion",
    "largest_profile_gap",
    "lost_motion",
    "normal",
    "offset",
    "offset_outline",
    "outline_area",
    "outline_of_spans",
    "perimeter",
    "profile_gap",
    "profile_loss",
    "simple_outline",
    "tangent",
    "trim",
]
