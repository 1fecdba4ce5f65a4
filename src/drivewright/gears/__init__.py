"""Non-circular gears: pitch curves, trains, and teeth cut by a rack."""

from drivewright.gears.elliptic import EllipticGearPair
from drivewright.gears.noncircular import NonCircularPair
from drivewright.gears.rack import Rack, RackFamily
from drivewright.gears.rolling import RollingPair
from drivewright.gears.teeth import Gear, Undercut, cut_gear
from drivewright.gears.train import GearTrain

__all__ = ["EllipticGearPair", "Gear", "GearTrain", "NonCircularPair", "Rack", "RackFamily", "RollingPair", "Undercut", "cut_gear"]
