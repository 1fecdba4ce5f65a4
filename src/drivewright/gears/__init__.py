"""Non-circular gears: pitch curves, trains, and teeth cut by a rack.

`rolling`            what follows for any two pitch curves that roll on each other
`elliptic`           congruent ellipses about a focus
`noncircular`        pairs from any ratio function
`integral`           running integral of a periodic function: arc lengths
`train`              pairs in a row on a carrier
`planet_arm`         an arm rigid with the planet, track of its end
`elliptic_batch`, `elliptic_track`  kernels of the same for many designs at once
`rack`, `teeth`      the rack's motion around the blank; the gear that it leaves
"""

from drivewright.gears.elliptic import EllipticGearPair
from drivewright.gears.noncircular import NonCircularPair
from drivewright.gears.planet_arm import PlanetArm
from drivewright.gears.rack import Rack, RackFamily
from drivewright.gears.rolling import RollingPair
from drivewright.gears.teeth import Gear, Undercut, cut_gear
from drivewright.gears.train import GearTrain

__all__ = [
    "EllipticGearPair",
    "Gear",
    "GearTrain",
    "NonCircularPair",
    "PlanetArm",
    "Rack",
    "RackFamily",
    "RollingPair",
    "Undercut",
    "cut_gear",
]
