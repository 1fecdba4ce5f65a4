"""Outlines of a Geneva wheel and of the locking disc on its crank, and what is left between slots, arcs and bore.

The wheel in its own frame: slot k along the polar angle 2 pi k/n, its sides straight and parallel; between two slots an arc about the place
of the crank's axis in the dwell.  The disc in the frame of the crank, the pin on the x axis: a circle of the locking radius, and a relief
within half the engagement on either side of the pin.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from drivewright.indexing.geneva.step import GenevaStep
from drivewright.scene import Arc, Line, Outline, Piece, xy


@dataclass(frozen=True)
class GenevaShape:
    """Sizes of wheel and disc [m].

    pin_radius r; slot_clearance across the slot, end_clearance between pin and slot bottom; outer_radius of the wheel; locking_radius of
    the disc; locking_clearance between disc and wheel's arc; relief between the wheel's tips and the disc's relief.
    """

    step: GenevaStep
    pin_radius: float
    slot_clearance: float
    end_clearance: float
    outer_radius: float
    locking_radius: float
    locking_clearance: float
    relief: float

    # -- slots -------------------------------------------------------------------------------------------------------------------

    @property
    def slot_width(self) -> float:
        """Width of a slot [m]."""
        return 2 * self.pin_radius + self.slot_clearance

    @property
    def slot_end(self) -> float:
        """Distance of the centre of the slot's round bottom from the wheel's axis [m]."""
        return self.step.centre_distance - self.step.crank_radius - self.end_clearance + self.slot_clearance / 2

    @property
    def slot_bottom(self) -> float:
        """Distance of the slot's bottom from the wheel's axis [m]."""
        return self.slot_end - self.slot_width / 2

    @property
    def slot_length(self) -> float:
        """Depth of the slot from the wheel's outer radius [m]."""
        return self.outer_radius - self.slot_bottom

    @property
    def slot_wall(self) -> float:
        """Least wall between two slots, at their bottoms [m]."""
        return 2 * self.slot_end * float(np.sin(self.step.half_pitch)) - self.slot_width

    # -- locking arcs ------------------------------------------------------------------------------------------------------------

    @property
    def arc_radius(self) -> float:
        """Radius of the wheel's locking arcs [m]."""
        return self.locking_radius + self.locking_clearance

    @property
    def mouth_wall(self) -> float:
        """Wall between a slot and the locking arc beside it, where the pin enters [m]; negative where the arc cuts into the slot."""
        return self.step.fitting_radius - self.slot_width / 2 - self.arc_radius

    @cached_property
    def arc_half_angle(self) -> float:
        """Polar angle [rad] on the wheel from the middle of a locking arc to its end on the outer circle."""
        c, r, arc = self.step.centre_distance, self.outer_radius, self.arc_radius
        return float(np.arccos(np.clip((c * c + r * r - arc * arc) / (2 * c * r), -1.0, 1.0)))

    @property
    def _side_end(self) -> float:
        """Where the side of a slot ends on the outer circle [m]."""
        return float(np.sqrt(max(self.outer_radius**2 - self.slot_width**2 / 4, 0.0)))

    @property
    def _cut(self) -> float:
        """Where a locking arc first cuts the side of a slot, seen from its bottom [m]; inf where it does not."""
        aside = self.step.fitting_radius - self.slot_width / 2
        if self.arc_radius <= abs(aside):
            return np.inf
        along = self.step.centre_distance * float(np.cos(self.step.half_pitch))
        return along - float(np.sqrt(self.arc_radius**2 - aside**2))

    @property
    def side_end(self) -> float:
        """Distance from the wheel's axis at which the sides of a slot end [m]: at the outer circle, or where a locking arc cuts them."""
        return min(self._side_end, self._cut)

    @property
    def undercut(self) -> float:
        """Length that the locking arcs take off the sides of a slot [m]."""
        return self._side_end - self.side_end

    @property
    def mouth(self) -> complex:
        """End of the upper side of slot 0."""
        return complex(self.side_end, self.slot_width / 2)

    @property
    def horn(self) -> complex:
        """Point of the wheel at which its locking arc between the slots 0 and 1 begins."""
        end = self.outer_radius * np.exp(1j * (self.step.half_pitch - self.arc_half_angle))
        return self.mouth if self.undercut > 0 else complex(end)

    # -- outlines ----------------------------------------------------------------------------------------------------------------

    @cached_property
    def wheel_outline(self) -> Outline:
        """The wheel, counter-clockwise."""
        return Outline(tuple(piece for number in range(self.step.slots) for piece in self.sector(2 * number * self.step.half_pitch)))

    def sector(self, turned: float) -> list[Piece]:
        """From the bottom of a slot along its upper side, around the tip, along the locking arc, to the bottom of the next one."""
        beta, mouth, horn = self.step.half_pitch, self.mouth, self.horn
        bottom, half = complex(self.slot_end, self.slot_width / 2), self.slot_width / 2
        mirror, centre = np.exp(2j * beta), self.step.centre_distance * np.exp(1j * beta)
        first, last = horn - centre, mirror * np.conj(horn) - centre
        arc = Arc(xy(centre), self.arc_radius, float(np.angle(first)), float(np.angle(last / first)))
        tips = () if self.undercut > 0 else ((mouth, horn), (mirror * np.conj(horn), mirror * np.conj(mouth)))
        lands = [_about_origin(*ends) for ends in tips]
        pieces: list[Piece] = [
            Line(xy(bottom), xy(mouth)),
            *lands[:1],
            arc,
            *lands[1:],
            Line(xy(mirror * np.conj(mouth)), xy(mirror * np.conj(bottom))),
            Arc(xy(mirror * self.slot_end), half, 2 * beta - np.pi / 2, -np.pi),
        ]
        return [piece.transformed((0.0, 0.0, turned), False) for piece in pieces]

    @cached_property
    def relief_depth(self) -> float:
        """Least distance of the relief of the disc from the axis of the crank, on the line to the pin [m].

        The arc that leaves the round part at right angles follows the tips of the wheel; the relief is deeper than it, and than the tips
        on the line of centres, by the clearance.
        """
        half, radius = self.step.half_engagement, self.locking_radius
        upright = radius * (1 - float(np.sin(half))) / float(np.cos(half))
        return min(upright, self.step.centre_distance - self.outer_radius) - self.relief

    @cached_property
    def disc_outline(self) -> Outline:
        """The locking disc, counter-clockwise: its round part, then the relief."""
        half = self.step.half_engagement
        return Outline((Arc((0.0, 0.0), self.locking_radius, half, 2 * np.pi - 2 * half), self.disc_relief))

    @cached_property
    def disc_relief(self) -> Arc:
        """The relief, an arc from the lower end of the round part through the place of `relief_depth` to the upper end."""
        end = self.locking_radius * np.exp(1j * self.step.half_engagement)
        depth = float(end.real) - self.relief_depth
        relief = (end.imag**2 + depth**2) / (2 * depth)
        centre = self.relief_depth + relief
        start = float(np.angle(np.conj(end) - centre))
        return Arc((float(centre), 0.0), float(relief), start, -2 * (np.pi - abs(start)))


def _about_origin(start: complex, end: complex) -> Arc:
    """Arc about the wheel's axis, counter-clockwise by less than half a turn."""
    return Arc((0.0, 0.0), abs(start), float(np.angle(start)), float(np.angle(end / start)))
