"""One link of a chain, and what follows from its joint alone.

Plate frame: x along the chain, clockwise around a sprocket that lies below; y away from the sprocket.  A plate's own pins sit at
(+-A/2, 0) of its *pin frame*, -e below its pitch line; the neighbour's pin lies inside, 2 r towards the plate's centre: the two pins
cross, tension presses them together, and they roll on each other.  With r = 0 the joint is a hinge and A the pitch.

Two surfaces of different radii, R1 on the right of a plate and R2 on the left of the next, are r = (R1 + R2)/2 and the *skew*
(R1 - R2)/2; a hollow one is negative, as its centre lies on the other side.  Rolling without slip keeps the centres R1 + R2 apart and turns
the line between them by R1/(R1 + R2) of the one plate's angle and R2/(R1 + R2) of the other's: exact for circular arcs of either sign.
"""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from drivewright.errors import InputError

if TYPE_CHECKING:
    from drivewright.chains.tooth import Tooth


class Link(NamedTuple):
    """What moves: hole pitch A [m], rolling radius r of both pins [m], flank angle a [rad], support w of the outer flanks [m]; skew k [m]
    of a joint with the radii r + k on the right of a plate and r - k on the left of the next.

    The right flank is the line n.X = w of the pin frame with n = (cos a, -sin a); the left flank is its mirror image.
    The offset e of the pins from the pitch line is not among them: no motion, force or contact depends on it.
    """

    hole_pitch: float
    radius: float
    flank_angle: float
    flank_support: float
    skew: float = 0.0

    @property
    def pitch(self) -> float:
        """Pitch of the straight chain, A - 2 r  [m]."""
        return self.hole_pitch - 2 * self.radius

    @property
    def radii(self) -> tuple[float, float]:
        """Radii of the rolling surfaces on the right of a plate and on the left of the next, hollow ones negative  [m]."""
        return self.radius + self.skew, self.radius - self.skew

    @property
    def effective_radius(self) -> float:
        """R of the joint, 1/R = 1/R1 + 1/R2  [m]; 0 of a hinge.  To second order in the angles nothing else of the radii counts."""
        right, left = self.radii
        return right * left / (right + left) if right * left else 0.0

    @property
    def first_share(self) -> float:
        """By how much of the first plate's angle the line between the centres turns, R1/(R1 + R2)  [-]; by the rest of the second one's."""
        return 0.5 + 0.5 * self.skew / self.radius if self.radius else 0.5


def design_link(pitch: float, radius: float, flank_angle: float, apothem: float, skew: float = 0.0) -> Link:
    """A `Link` from its pitch p, rolling radius r, flank angle a and the distance f0 from hole centre to flank: w = f0 + A/2 cos a; and its
    skew."""
    hole_pitch = pitch + 2 * radius
    return Link(hole_pitch, radius, flank_angle, apothem + 0.5 * hole_pitch * np.cos(flank_angle), skew)


def seat_height(link: Link, teeth: int) -> float:
    """Height h of a seated plate's pin line above the sprocket's centre: (A/2 cos t - r)/sin t, t = pi/z  [m].

    Neighbouring plates turned by 2t against each other close to a regular polygon; h follows from the joint alone.  With a skew k the
    line of the centres leans by k t/r: (A/2 cos t - r cos(k t/r))/sin t.
    """
    t = np.pi / teeth
    lean = link.skew * t / link.radius if link.skew else 0.0
    return (0.5 * link.hole_pitch * np.cos(t) - link.radius * np.cos(lean)) / np.sin(t)


def seat_shift(link: Link, teeth: int) -> float:
    """How far the middle of a seated plate's pins lies along the chain from the foot of the sprocket's centre, r sin(k t/r)/sin t  [m].

    It turns the teeth under the chain by an angle that does not change, and nothing else; 0 without skew.
    """
    t = np.pi / teeth
    return link.radius * np.sin(link.skew * t / link.radius) / np.sin(t) if link.skew else 0.0


def tooth_turn(link: Link, tooth: "Tooth") -> float:
    """Angle [rad] by which teeth stand turned from under plates that lie symmetrically, so that both flanks of a shifted plate touch:
    -s cos a/rb, s the `seat_shift`, for a flank's support moves by s cos a and an involute's by rb times the angle."""
    return float(-seat_shift(link, tooth.teeth) * np.cos(link.flank_angle) / tooth.base_radius)


def contact_pitch(link: Link, teeth: int) -> float:
    """Distance of a seated plate's two places of contact  [m]; A - 2 r cos t without skew.

    The contact lies R1 off the right pin's centre, turned by R2/(R1 + R2) 2t from the plate, and alike on the left.
    """
    t, (right, left) = np.pi / teeth, link.radii
    first = link.first_share
    along = link.hole_pitch - right * np.cos(2 * t * (1 - first)) - left * np.cos(2 * t * first)
    across = right * np.sin(2 * t * (1 - first)) - left * np.sin(2 * t * first)
    return float(np.hypot(along, across))


def rolled_length(link: Link, teeth: int) -> float:
    """Length along which the surfaces of a joint roll onto a sprocket, R 2 pi/z with the effective radius R  [m]; the same on both."""
    return 2 * np.pi / teeth * link.effective_radius


def seat_support(link: Link, teeth: int) -> float:
    """Support H of a seated plate's right flank: its signed distance from the sprocket's centre along n, w - h sin a  [m]; below 0."""
    return link.flank_support - seat_height(link, teeth) * np.sin(link.flank_angle)


def chordal_rise(link: Link, teeth: int) -> float:
    """How far a straight strand that leaves the seated polygon rises and falls over a tooth  [m].

    (p/2) tan(t/2) + 2 r (tan(t/2) - sin(t/2)),  t = pi/z, half-way between two seats; for r = 0 it is that of a roller chain,
    (p/2 / sin t)(1 - cos t).  With r > 0 the very top lies aside of the middle and higher by some millionths of the rise.  For two equal
    radii; `closure.departure` computes any joint.
    """
    if link.skew:
        raise InputError("chordal rise: the closed form is for two equal radii; take closure.departure with straight strands.")
    t = 0.5 * np.pi / teeth
    return 0.5 * link.pitch * np.tan(t) + 2 * link.radius * (np.tan(t) - np.sin(t))
