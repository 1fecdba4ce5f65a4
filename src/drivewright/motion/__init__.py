"""Motion laws s(u) with v, a, j, and programmes of segments on any driving angle."""

from drivewright.motion.acceleration import Acceleration, hold, integrate, wave
from drivewright.motion.laws import MotionLaw, law, names, register
from drivewright.motion.piecewise import Motion, Peaks, Piecewise
from drivewright.motion.programme import Joint, Piece, Programme, Segment, through
from drivewright.motion.ripple import Ripple
from drivewright.motion.tables import TableLaw

__all__ = [
    "Acceleration",
    "Joint",
    "Motion",
    "MotionLaw",
    "Peaks",
    "Piece",
    "Piecewise",
    "Programme",
    "Ripple",
    "Segment",
    "TableLaw",
    "hold",
    "integrate",
    "law",
    "names",
    "register",
    "through",
    "wave",
]
