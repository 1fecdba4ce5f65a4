"""Closure of a chain around two sprockets: where rigid plates that roll on each other's pins leave the driven one, quasi-statically.

An elongated chain rides on the polygon of its own pitch: close `link._replace(hole_pitch=A + dp)` for plates stretched by dp, and
`link._replace(radius=r - dp/2)` for pins worn evenly, a layer dp/2 off each.  That is the measure of rigid polygons; which flanks of the
teeth such a chain touches at all is a question of its own.

comparison closures of many drives in numbers
departure  how a long strand leaves one sprocket
drive      quasi-static closure of a chain around two sprockets
loop       the loop of a chain around two sprockets at one angle of the driver, compiled
measures   mean and extremes of a quantity known by values and slopes at samples, compiled
model      a chain around two sprockets, its positions, and its motion over one tooth of the driver
positions  positions of a closed drive at any angle of the driver, the plates in them, and two chains side by side on the same shafts
start      where to start: a belt around the pitch circles, as long as the chain
strand     a strand between two sprockets, compiled
tables     tables of the rigid chain
tracking   the motion over one tooth of the driver, compiled
"""

from drivewright.chains.closure.departure import Departure, departure
from drivewright.chains.closure.drive import POSITIONS, close, phase_map
from drivewright.chains.closure.model import Closure, Drive, States
from drivewright.chains.closure.positions import Phased, mesh_order, phased, plates, states_at

__all__ = [
    "POSITIONS",
    "Closure",
    "Departure",
    "Drive",
    "Phased",
    "States",
    "close",
    "departure",
    "mesh_order",
    "phase_map",
    "phased",
    "plates",
    "states_at",
]
