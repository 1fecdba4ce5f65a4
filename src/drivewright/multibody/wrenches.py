"""What joints can transmit, as unit wrenches in absolute coordinates, and where the bodies are that they act on."""

from collections.abc import Mapping
from typing import NamedTuple, TypeAlias

import numpy as np

from drivewright._typing import Floats
from drivewright.multibody.bodies import GROUND, Marker
from drivewright.multibody.observed import Observed

Torques: TypeAlias = Mapping[str, float | Floats]  # by body: a number, or one per state


class Reaction(NamedTuple):
    """On the joint's first body: force (m, 2) [N] in the world's axes and moment (m,) [N m] about the joint's point of that body.

    The point of a rolling wheel is its centre.  Of a gear it is the torque on its `first`, of a cam pair force and torque on the follower.
    """

    force: Floats
    moment: Floats


class Wrench(NamedTuple):
    """One unknown of m states: torques on bodies, and a force (m, 2) at a point (m, 2) [m] on `first`, with its opposite on `second`."""

    torques: Torques
    first: str = GROUND
    second: str = GROUND
    force: Floats | None = None
    point: Floats | None = None


class ObservedBodies(NamedTuple):
    """Bodies in m observed states: number in the arrays, centroid in its frame [m] and start angle [rad] by name of the body."""

    numbers: Mapping[str, int]
    centroids: Mapping[str, tuple[float, float]]
    start_angles: Mapping[str, float]
    observed: Observed

    def field(self, body: str, name: str) -> Floats:
        """One of observe.FIELDS (m,) of a body."""
        return self.observed.body(self.numbers[body], name)

    def arm(self, marker: Marker) -> Floats:
        """(m, 2) from the centroid to the marker, in the world's axes [m]."""
        cx, cy = self.centroids[marker.body]
        return self.rotated(marker.body, (marker.x - cx, marker.y - cy))

    def rotated(self, body: str, vector: tuple[float, float] | Floats) -> Floats:
        """A vector of a body's frame in the world's axes (m, 2)."""
        angle = self.field(body, "angle")
        (x, y), c, s = vector, np.cos(angle), np.sin(angle)
        return np.stack([c * x - s * y, s * x + c * y], axis=-1)

    def centre(self, body: str) -> Floats:
        """Place of a body's centroid (m, 2) [m]."""
        return np.stack([self.field(body, "x"), self.field(body, "y")], axis=-1)

    def point(self, marker: Marker) -> Floats:
        """Place of a marker (m, 2) [m]."""
        return self.centre(marker.body) + self.arm(marker)

    def velocity(self, marker: Marker) -> Floats:
        """Velocity of a marker (m, 2) [m/s]."""
        arm, w = self.arm(marker), self.field(marker.body, "w")
        return np.stack([self.field(marker.body, "vx") - w * arm[:, 1], self.field(marker.body, "vy") + w * arm[:, 0]], axis=-1)


def sum_torques(*torques: tuple[str, float | Floats]) -> Torques:
    """Torques by body; a body that is named twice gets both."""
    total: dict[str, float | Floats] = {}
    for body, torque in torques:
        total[body] = total.get(body, 0.0) + torque
    return total


def cross(a: Floats, b: Floats) -> Floats:
    """z of the cross products (m,) of vectors (m, 2)."""
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]


NORMAL_OF = np.array([[0.0, 1.0], [-1.0, 0.0]])  # rows (x, y) @ NORMAL_OF are (-y, x): turned by 90 degrees
