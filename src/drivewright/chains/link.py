"""One link of a chain, and what follows from its joint alone.

Plate frame: x along the chain, clockwise around a sprocket that lies below; y away from the sprocket.  A plate's own pins sit at
(+-A/2, 0) of its *pin frame*, -e below its pitch line; the neighbour's pin lies inside, 2 r towards the plate's centre: the two pins
cross, tension presses them together, and they roll on each other.  With r = 0 the joint is a hinge and A the pitch.
"""

from typing import NamedTuple

import numpy as np


class Link(NamedTuple):
    """What moves: hole pitch A [m], rolling radius r of both pins [m], flank angle a [rad], support w of the outer flanks [m].

    The right flank is the line n.X = w of the pin frame with n = (cos a, -sin a); the left flank is its mirror image.
    The offset e of the pins from the pitch line is not among them: no motion, force or contact depends on it.
    """

    hole_pitch: float
    radius: float
    flank_angle: float
    flank_support: float

    @property
    def pitch(self) -> float:
        """Pitch of the straight chain, A - 2 r  [m]."""
        return self.hole_pitch - 2 * self.radius


def design_link(pitch: float, radius: float, flank_angle: float, apothem: float) -> Link:
    """A `Link` from its pitch p, rolling radius r, flank angle a and the distance f0 from hole centre to flank: w = f0 + A/2 cos a."""
    hole_pitch = pitch + 2 * radius
    return Link(hole_pitch, radius, flank_angle, apothem + 0.5 * hole_pitch * np.cos(flank_angle))


def seat_height(link: Link, teeth: int) -> float:
    """Height h of a seated plate's pin line above the sprocket's centre: (A/2 cos t - r)/sin t, t = pi/z  [m].

    Neighbouring plates turned by 2t against each other close to a regular polygon; h follows from the joint alone.
    """
    t = np.pi / teeth
    return (0.5 * link.hole_pitch * np.cos(t) - link.radius) / np.sin(t)


def seat_support(link: Link, teeth: int) -> float:
    """Support H of a seated plate's right flank: its signed distance from the sprocket's centre along n, w - h sin a  [m]; below 0."""
    return link.flank_support - seat_height(link, teeth) * np.sin(link.flank_angle)


def chordal_rise(link: Link, teeth: int) -> float:
    """How far a straight strand that leaves the seated polygon rises and falls over a tooth  [m].

    (p/2) tan(t/2) + 2 r (tan(t/2) - sin(t/2)),  t = pi/z, half-way between two seats; for r = 0 it is that of a roller chain,
    (p/2 / sin t)(1 - cos t).  With r > 0 the very top lies aside of the middle and higher by some millionths of the rise.
    """
    t = 0.5 * np.pi / teeth
    return 0.5 * link.pitch * np.tan(t) + 2 * link.radius * (np.tan(t) - np.sin(t))
