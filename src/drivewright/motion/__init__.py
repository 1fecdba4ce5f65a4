"""Motion laws s(u) with v, a, j, and programmes of segments on any driving angle.

`laws`          the named laws and their registry
`acceleration`  laws stated by pieces of acceleration
`piecewise`     piecewise polynomials and waves: derivatives, peaks, jumps
`splines`, `tables`, `ripple`  laws through points and from measured lifts; ripple that their digits leave
`programme`     segments of one turn
`motor_sizing`  torque, power and reflected inertia over a cycle
`diagram`       a programme as a diagram: samples of its segments, ends and jumps
`mapped`        programmes stated in one coordinate and followed in another
"""

from drivewright.motion.acceleration import Acceleration, hold, integrate, wave
from drivewright.motion.laws import MotionLaw, law, names, register
from drivewright.motion.mapped import CoordinateMap, MappedPiecewise, MappedProgramme
from drivewright.motion.motor_sizing import MotorSizing, size_motor
from drivewright.motion.piecewise import Motion, Peaks, Piecewise
from drivewright.motion.programme import Joint, Piece, Programme, Segment, compose_motion
from drivewright.motion.ripple import Ripple
from drivewright.motion.tables import TableLaw

__all__ = [
    "Acceleration",
    "CoordinateMap",
    "Joint",
    "MappedPiecewise",
    "MappedProgramme",
    "Motion",
    "MotionLaw",
    "MotorSizing",
    "Peaks",
    "Piece",
    "Piecewise",
    "Programme",
    "Ripple",
    "Segment",
    "TableLaw",
    "compose_motion",
    "hold",
    "integrate",
    "law",
    "names",
    "register",
    "size_motor",
    "wave",
]
