"""An arm rigid with the planet of a gear train, and the track of the point at its end.

World: sun axis at the origin, y up; the carrier turns clockwise by t [rad], 0 at the start.  Functions of t take arrays and give
jets in it.  `elliptic_track` states the same for many designs of elliptic gears at once.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from drivewright._typing import ArrayLike, Floats
from drivewright.errors import InputError
from drivewright.gears.train import GearTrain
from drivewright.numerics.jets import Jet, exp, variable
from drivewright.numerics.roots import bracketed_roots, extremes

TURN = 2 * np.pi
GRID = np.linspace(0, TURN, 721)


@dataclass(frozen=True)
class PlanetArm:
    """An arm on the planet of a train of three gears with carrier arms of equal length.

    carrier_arm [m], carrier_angle [rad]: first arm above the horizontal at t = 0; bend [rad]: from the first to the second arm,
    counter-clockwise; distance [m], start [rad]: of the point from the planet's axis, and the direction of that line at t = 0.
    """

    train: GearTrain
    carrier_arm: float
    carrier_angle: float
    bend: float
    distance: float
    start: float

    def planet(self, t: ArrayLike) -> Jet:
        """Planet relative to the carrier [rad], 0 at the start, counter-clockwise."""
        return self.train.planet(t)

    def rotation(self, t: ArrayLike) -> Jet:
        """Rotation of the arm in the world [rad]: that of the planet on the carrier less t."""
        return self.planet(t) - variable(t)

    def axis(self, t: ArrayLike) -> Jet:
        """Axis of the planet in the world, complex jet [m]."""
        first = exp(1j * (self.carrier_angle - variable(t)))
        return self.carrier_arm * (1 + np.exp(1j * self.bend)) * first

    def point(self, t: ArrayLike) -> Jet:
        """The point in the world, complex jet [m]."""
        return self.axis(t) + self.distance * exp(1j * self.direction(t))

    def direction(self, t: ArrayLike) -> Jet:
        """Direction of the line planet axis - point in the world [rad], continuous."""
        return self.start + self.rotation(t)

    # -- track -------------------------------------------------------------------------------------------------------------------

    @cached_property
    def lowest(self) -> float:
        """Carrier angle in [0, 2 pi) where the point is lowest."""
        angles, heights = self._extremes
        return float(angles[np.argmin(heights)])

    @cached_property
    def highest(self) -> float:
        """Carrier angle in [0, 2 pi) where the point is highest."""
        angles, heights = self._extremes
        return float(angles[np.argmax(heights)])

    @cached_property
    def _extremes(self):
        """(carrier angles in [0, 2 pi) where the height of the point is an extreme, the heights [m]), from the roots of its exact
        derivative."""
        turning = bracketed_roots(lambda t: self.point(t).imag.d1, GRID)
        if not len(turning):
            raise InputError("the height of the point on the planet is constant over the turn: lengthen its arm or change the train")
        angles = np.unique(np.mod(turning, TURN))
        return angles, self.point(angles).d0.imag

    @property
    def track_height(self) -> float:
        """Highest less lowest point of the track [m]."""
        top, bottom = (self.point(t).d0.imag for t in (self.highest, self.lowest))
        return float(top - bottom)

    @property
    def track_width(self) -> float:
        """Rightmost less leftmost point of the track [m]."""
        _, left, _, right = extremes(lambda t: self.point(t).d0.real, 0, TURN)
        return right - left

    def height(self, t: ArrayLike) -> Floats:
        """The point above its lowest place [m]."""
        return self.point(t).d0.imag - self.point(self.lowest).d0.imag

    def line_crossings(self, through: complex, direction: float) -> Floats:
        """Carrier angles in [0, 2 pi] where the track crosses the line through a point [m] in a direction [rad]."""
        normal = 1j * np.exp(1j * direction)
        return bracketed_roots(lambda t: ((self.point(t).d0 - through) * np.conj(normal)).real, GRID)

    def opening(self, height: float) -> tuple[float, float] | None:
        """Carrier angles at which the point passes a height [m] above its lowest place, down before and up after it; None if never."""
        grid = self.lowest + np.linspace(-np.pi, np.pi, 721)
        crossings = bracketed_roots(lambda t: self.height(t) - height, grid)
        before, after = crossings[crossings < self.lowest], crossings[crossings > self.lowest]
        return (before[-1], after[0]) if len(before) and len(after) else None

    def opening_width(self, height: float, advance: float) -> float:
        """Width of the track at a height [m], on a machine that advances along +x by so much per turn [m]; 0 where it never gets there."""
        crossings = self.opening(height)
        if crossings is None:
            return 0.0
        x = [self.point(t).d0.real + advance * t / TURN for t in crossings]
        return float(abs(x[1] - x[0]))
