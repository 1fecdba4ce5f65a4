"""The tooth of a roller chain: a concave seat arc, then a convex flank arc, for rollers on the joints of the plates."""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats


class RollerTooth(NamedTuple):
    """teeth z; pitch radius of the seated rollers' centres; seat radius ri and its whole seating angle; flank radius re; roller radius
    [m], [rad].

    A gap lies midway between two teeth; the bottom of its seat, a concave arc, touches the seated roller, so that the arc's centre lies
    outside the pitch circle where the seat is wider than the roller; convex arcs of flanks continue it smoothly on both sides.
    """

    teeth: int
    pitch_radius: float
    seat_radius: float
    seat_angle: float
    flank_radius: float
    roller_radius: float

    @property
    def seat_centre(self) -> float:
        """Distance of the centre of the seat's arc from that of the sprocket, root radius and ri  [m]."""
        return self.pitch_radius - self.roller_radius + self.seat_radius

    @property
    def flank_centre(self) -> Floats:
        """Centre of the right flank's arc from the seat's centre (towards the tooth, outward)  [m]: ri + re along the end of the seat."""
        half = 0.5 * self.seat_angle
        return (self.seat_radius + self.flank_radius) * np.array([np.sin(half), -np.cos(half)])
