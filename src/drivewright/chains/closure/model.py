"""A chain around two sprockets, its positions, and its motion over one tooth of the driver."""

from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from drivewright._typing import Bools, Floats, Ints
from drivewright.chains.link import Link

Strands = Literal["straight", "equilibrium"]


class Drive(NamedTuple):
    """A chain of `links` plates around a driver and a driven sprocket.

    strands: "equilibrium" bends each strand until its force is the same all along; "straight" is the simpler measure.
    """

    link: Link
    driver_teeth: int
    driven_teeth: int
    links: int
    strands: Strands = "equilibrium"


class States(NamedTuple):
    """Positions of a drive, one per row.

    driver_angle, driven_angle, centre_distance [rad, rad, m]; strand_angle (.., 2): direction of the force in the upper strand, from the
    driver on, and in the lower one, back to it [rad]; seats (.., 4): the teeth where the chain leaves the driver, meets and leaves the
    driven sprocket, meets the driver.  The centre of tooth j of a sprocket at the angle psi lies at psi + j 2 pi/z.
    """

    driver_angle: Floats
    driven_angle: Floats
    centre_distance: Floats
    strand_angle: Floats
    seats: Ints

    @property
    def seated(self) -> Ints:
        """(.., 2) plates seated on the driver and on the driven sprocket."""
        seats = self.seats
        return np.stack([seats[..., 3] - seats[..., 0], seats[..., 1] - seats[..., 2]], axis=-1) + 1

    @property
    def wrap(self) -> Floats:
        """(.., 2) by how much the strands' forces turn around the driver and around the driven sprocket [rad]; together 2 pi."""
        turned = self.strand_angle[..., 0] - self.strand_angle[..., 1]
        return np.stack([2 * np.pi - turned, turned], axis=-1)


@dataclass(frozen=True, eq=False)
class Closure:
    """The motion over one tooth of the driver, both ends included.

    `event` (S,) marks the samples where a plate seats or leaves; the seats of a sample hold from there to the next one.
    mean, fluctuation: integral mean and greatest less least centre distance [m].  transmission_error (S,): psi_2 - psi_1 z1/z2, its
    integral mean taken off [rad]; transmission_ripple: greatest less least.  All extremes are those of the curves, not of the samples.
    before, after (S, 2): dpsi_2/dpsi_1 [-] and dSd/dpsi_1 [m] on either side of a sample.
    residual [m]: by how much a strand misses its end at most.
    """

    drive: Drive
    states: States
    event: Bools
    before: Floats
    after: Floats
    transmission_error: Floats
    transmission_ripple: float
    mean: float
    fluctuation: float
    residual: float

    @property
    def driver_angle(self) -> Floats:
        """(S,) samples of the driver's angle [rad]."""
        return self.states.driver_angle

    @property
    def centre_distance(self) -> Floats:
        """(S,)  [m]."""
        return self.states.centre_distance

    @property
    def free_plates(self) -> float:
        """Number of free plates of a strand, mean over the samples and both strands."""
        return float(0.5 * (self.drive.links - np.mean(np.sum(self.states.seated, axis=1))))

    def mean_wrap(self, number: int) -> float:
        """Wrap of the driver (0) or the driven sprocket (1), mean over the tooth  [rad]."""
        wraps, angle = self.states.wrap[:, number], self.driver_angle
        return float(np.sum(0.5 * (wraps[1:] + wraps[:-1]) * np.diff(angle)) / np.ptp(angle))
