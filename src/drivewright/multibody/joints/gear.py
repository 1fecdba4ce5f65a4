"""The pair of gears, or the belt."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from drivewright.multibody.bodies import GROUND, Marker
from drivewright.multibody.index import ModelIndex
from drivewright.multibody.joints.joint import Joint, JointDrawing, RowFields
from drivewright.multibody.wrenches import ObservedBodies, Wrench, sum_torques
from drivewright.scene import Shape, circle


@dataclass(frozen=True)
class Gear(Joint):
    """Relative to the carrier, `second` turns `ratio` times as far as `first`: negative for outer gears, positive for a ring or a belt."""

    first: str
    second: str
    ratio: float
    carrier: str = GROUND

    @property
    def bodies(self) -> tuple[str, str]:
        """Names of the two bodies that a message about the joint names."""
        return self.first, self.second

    @property
    def reaction_marker(self) -> Marker:
        """The point of a body about which its reaction is stated."""
        return Marker(self.first)

    def constraint_rows(self, index: ModelIndex) -> list[RowFields]:
        """Fields of its constraint rows."""
        i, j, k = (index.number(name, f"gear {self.name!r}") for name in (self.second, self.first, self.carrier))
        return [{"i": i, "j": j, "k": k, "lift": -1, "gi": 1.0, "gj": -self.ratio, "gk": self.ratio - 1.0, "constant": np.nan}]

    def wrenches(self, bodies: ObservedBodies) -> list[Wrench]:
        """What it can transmit."""
        return [Wrench(sum_torques((self.first, -self.ratio), (self.second, 1.0), (self.carrier, self.ratio - 1.0)))]

    def guide_shapes(self, body: str, drawing: JointDrawing) -> Iterable[Shape]:
        """The pitch circle: centre distance a = |r1 - sign r2| with r1 / r2 = |ratio|; none without two pins on the carrier."""
        if body not in self.bodies:
            return
        pins = [self._pin_of(gear, drawing) for gear in self.bodies]
        if pins[0] is None or pins[1] is None or self.ratio == 1.0:
            return
        distance = np.hypot(*np.subtract(pins[0][1][1:], pins[1][1][1:]))
        second = distance / abs(1.0 - self.ratio)
        own, radius = (pins[0], second * abs(self.ratio)) if body == self.first else (pins[1], second)
        if radius > 0:
            yield Shape("pitch", circle(own[0][1:], float(radius)))

    def _pin_of(self, body, drawing):
        """(marker on the body, marker on the carrier) of the pin between them; None without one."""
        for joint in drawing.joints:
            pin = joint.pin_markers
            if pin and {pin[0].body, pin[1].body} == {body, self.carrier}:
                return pin if pin[0].body == body else pin[::-1]
        return None
