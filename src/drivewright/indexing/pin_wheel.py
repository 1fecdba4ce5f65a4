"""The wheel of pins and the cams inside or around it: an envelope trimmed by every pin of every step.

The cam's centre runs on a circle of radius e and the cam does not turn; the wheel turns by phi(theta).  Seen from the cam, the centre of
pin k is p_k = R exp(i (phi + 2 pi k/N)) - e exp(i s theta); p_0 over N turns of the crank is one closed curve that all pins share.  With
s = +1 it gives N - 1 lobes inside the pins, with s = -1 N + 1 around them.  In the dwell the curve turns back in small circles, so the
profile is made of both sides of it.  Source: Liu Mingtao et al. 2017, derived anew.
"""

from dataclasses import dataclass

import numpy as np

from drivewright._typing import ArrayLike
from drivewright.errors import InputError
from drivewright.indexing.motion import IndexMotion
from drivewright.indexing.plane import PlaneDrive, refuse_overlap
from drivewright.numerics.jets import Jet, constant, exp, variable


@dataclass(frozen=True, eq=False)
class PinWheel(PlaneDrive):
    """Wheel of `pins` pins of `pin_radius` on `circle_radius`, cam on the eccentricity [m], and the wheel's motion over the crank.

    side: "inside" the pins (N - 1 lobes), or "outside", around them (N + 1).
    """

    pins: int
    circle_radius: float
    pin_radius: float
    eccentricity: float
    motion: IndexMotion
    side: str = "inside"

    @property
    def sense(self) -> float:
        """Sense in which the crank turns against the wheel's index direction: +1 inside, -1 outside."""
        return 1.0 if self.side == "inside" else -1.0

    @property
    def lobes(self) -> int:
        """Lobes of the cam."""
        return self.pins - int(self.sense)

    def crank_vector(self, theta: ArrayLike) -> Jet:
        """Centre of the cam e exp(i s theta): complex jet by theta."""
        return self.eccentricity * exp(1j * self.sense * variable(theta))

    def pose(self, theta: ArrayLike) -> tuple[Jet, Jet]:
        """The cam's centre and its turn, which is 0."""
        return self.crank_vector(theta), constant(np.zeros(np.shape(theta)))

    def refuse(self) -> None:
        """InputError for measures that leave no cam or no wheel."""
        refuse_impossible(self)


def refuse_impossible(wheel: PinWheel) -> None:
    """InputError for measures that leave no cam or no wheel."""
    refuse_overlap(wheel)
    if wheel.eccentricity + wheel.pin_radius >= wheel.circle_radius:
        raise InputError(
            f"eccentricity + pin_radius = {(wheel.eccentricity + wheel.pin_radius) * 1e3:.4g} mm reaches the middle of the pin circle of "
            f"radius {wheel.circle_radius * 1e3:.4g} mm; nothing is left of the cam. Take a larger pin circle."
        )
