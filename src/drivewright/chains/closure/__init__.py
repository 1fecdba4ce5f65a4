"""Closure of a chain around two sprockets: where rigid plates that roll on each other's pins leave the driven one, quasi-statically.

An elongated chain rides on the polygon of its own pitch: close `link._replace(hole_pitch=A + dp)` for plates stretched by dp, and
`link._replace(radius=r - dp/2)` for pins worn evenly, a layer dp/2 off each.  That is the measure of rigid polygons; which flanks of the
teeth such a chain touches at all is a question of its own.
"""

from drivewright.chains.closure.departure import Departure, departure
from drivewright.chains.closure.drive import POSITIONS, close, phase_map
from drivewright.chains.closure.model import Closure, Drive, States
from drivewright.chains.closure.positions import Phased, phased, plates, states_at

__all__ = [
    "POSITIONS",
    "Closure",
    "Departure",
    "Drive",
    "Phased",
    "States",
    "close",
    "departure",
    "phase_map",
    "phased",
    "plates",
    "states_at",
]
