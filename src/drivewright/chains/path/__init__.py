"""The path of a chain around sprockets and guides: which bodies it meets, in which order and on which side, and how tightly.

A path runs clockwise, as plates are numbered; a body inside of it has turn = -1 and lies on the right of the chain, one outside has +1.

balance  tensioners and pulls of the strands in balance, the chain as long as its links
order    which bodies the chain meets, one after another
route    the taut path around given bodies, in links and metres
"""

from drivewright.chains.path.balance import Balance, balanced, limit_speed
from drivewright.chains.path.order import met
from drivewright.chains.path.route import Route, Station, route, stations

__all__ = ["Balance", "Route", "Station", "balanced", "limit_speed", "met", "route", "stations"]
