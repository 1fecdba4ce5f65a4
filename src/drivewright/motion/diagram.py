"""The segments of a motion programme as they are drawn: sampled piece by piece, so that every jump of a derivative stands as two values."""

from collections.abc import Sequence

import numpy as np

from drivewright._typing import Floats
from drivewright.motion.piecewise import Piecewise
from drivewright.motion.programme import Programme
from drivewright.motion_diagram import DiagramSegment

FINE = 96  # intervals of a segment, shared by its pieces
LEAST = 4  # intervals of a piece
MOST_PIECES = 400  # of a segment; one with more is sampled evenly


def diagram_segments(programme: Programme, points: Sequence[Sequence[Sequence[float]]] = ()) -> tuple[DiagramSegment, ...]:
    """The segments of a programme as it states them; `points` are those of the splines, () for a segment with another law."""
    return tuple(
        DiagramSegment(
            segment.motion_law.name,
            segment.angle,
            segment.rise,
            _course(segment.placed(0.0, float(level)), segment.angle),
            segment.motion_law.span is not None,
            points[number] if number < len(points) else (),
        )
        for number, (segment, level) in enumerate(zip(programme.segments, programme.levels, strict=False))
    )


def _course(function: Piecewise, angle: float) -> Floats:
    """(5, n): angle [rad], value and three derivatives on every piece of a function, at both ends of each."""
    if function.count > MOST_PIECES:
        theta = np.linspace(0.0, angle, 2 * MOST_PIECES + 1)
        motion = function(theta)
    else:
        pieces, theta = function.samples(max(LEAST, FINE // function.count))
        motion = function.on_piece(pieces, theta)
    return np.stack([np.ravel(np.broadcast_to(part, np.shape(theta))) for part in (theta, *motion)])
