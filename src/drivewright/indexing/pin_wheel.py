"""The wheel of pins and the cams inside or around it: an envelope trimmed by every pin of every step.

The cam's centre runs on a circle of radius e and the cam does not turn; the wheel turns by phi(theta).  Seen from the cam, the centre of
pin k is p_k = R exp(i (phi + 2 pi k/N)) - e exp(i s theta); p_0 over N turns of the crank is one closed curve that all pins share.  With
s = +1 it gives N - 1 lobes inside the pins, with s = -1 N + 1 around them; where a step passes m pins, m such curves give N - m or N + m.
In the dwell the curve turns back in small circles, so the profile is made of both sides of it.  Source: Liu Mingtao et al. 2017, derived
anew.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from drivewright._typing import ArrayLike
from drivewright.errors import InputError
from drivewright.indexing.motion import TURN, IndexMotion
from drivewright.indexing.plane import PlaneDrive, refuse_overlap
from drivewright.numerics.jets import Jet, constant, exp, variable


@dataclass(frozen=True, eq=False)
class PinWheel(PlaneDrive):
    """Wheel of `pins` pins of `pin_radius` on `circle_radius`, cam on the eccentricity [m], and the wheel's motion over the crank.

    side: "inside" the pins (N - 1 lobes), or "outside", around them (N + 1).  pin_phase: place of pin 0 in the dwell before theta = 0, in
    pitches of the pins ahead of the crank.
    """

    pins: int
    circle_radius: float
    pin_radius: float
    eccentricity: float
    motion: IndexMotion
    side: str = "inside"
    pin_phase: float = 0.0

    @property
    def phase(self) -> float:
        """Angle of pin 0 at theta = 0 [rad]."""
        return self.pin_phase * self.pin_pitch

    @property
    def sense(self) -> float:
        """Sense in which the crank turns against the wheel's index direction: +1 inside, -1 outside."""
        return 1.0 if self.side == "inside" else -1.0

    @property
    def lobes(self) -> int:
        """Lobes of the cam."""
        return self.pins - int(self.sense) * self.pins_passed

    def crank_vector(self, theta: ArrayLike) -> Jet:
        """Centre of the cam e exp(i s theta): complex jet by theta."""
        return self.eccentricity * exp(1j * self.sense * variable(theta))

    def pose(self, theta: ArrayLike) -> tuple[Jet, Jet]:
        """The cam's centre and its turn, which is 0."""
        return self.crank_vector(theta), constant(np.zeros(np.shape(theta)))

    def seen_from_cam(self, point: Jet, theta: ArrayLike) -> Jet:
        """The point from the cam's centre, for the cam does not turn."""
        return point - self.crank_vector(theta)

    def refuse(self) -> None:
        """InputError for measures that leave no cam or no wheel."""
        refuse_impossible(self)


def refuse_impossible(wheel: PinWheel) -> None:
    """InputError for measures that leave no cam or no wheel."""
    refuse_overlap(wheel)
    if wheel.eccentricity + wheel.pin_radius >= wheel.circle_radius:
        raise InputError(
            f"eccentricity + pin_radius = {(wheel.eccentricity + wheel.pin_radius) * 1e3:.4g} mm reaches the middle of the pin circle of "
            f"radius {wheel.circle_radius * 1e3:.4g} mm, so no cam remains. Take a larger pin circle."
        )


def wall_thicknesses(wheel: PinWheel, spacing: float, hole_diameter: float, profile_radius: tuple[float, float]) -> tuple[float, float]:
    """(between the two bearing holes of a cam, between them and its profile) [m], below 0 where they overlap.

    The holes of `hole_diameter` lie `spacing` apart on a line through the cam's centre; profile_radius: least and greatest distance of the
    profile from that centre.
    """
    least, greatest = profile_radius
    inside = least - 0.5 * (spacing + hole_diameter)
    outside = 0.5 * (spacing - hole_diameter) - greatest
    return spacing - hole_diameter, inside if wheel.side == "inside" else outside


def profile_findings(wheel: PinWheel) -> Iterator[str]:
    """Measures that cut parts of the profile away."""
    if wheel.motion.motion_angle < TURN and wheel.pin_radius >= wheel.eccentricity:
        yield (
            f"the pin radius of {1e3 * wheel.pin_radius:.4g} mm is not below the eccentricity of {1e3 * wheel.eccentricity:.4g} mm: "
            "undercut removes the tops of the lobes, which would carry in the dwell; take thinner pins"
        )
    # speed of the crank's circle over that of the pins'
    ratio = wheel.eccentricity * wheel.motion.divisions / wheel.circle_radius
    if wheel.motion.law.name == "uniform" and ratio > 1:
        steps = "pins" if wheel.pins_passed == 1 else "stations"
        yield (
            f"eccentricity times {steps} over pin_circle_radius is {ratio:.4g}, above 1: the pitch curve has loops, and undercut "
            "removes parts of the profile; take a smaller eccentricity or a larger pin circle"
        )


def sleeve_findings(eccentricity: float, bore: float, shaft_diameter: float) -> Iterator[str]:
    """A bearing bore that leaves no eccentric sleeve around a split shaft; all [m]."""
    if bore / 2 - eccentricity - shaft_diameter / 2 <= 0:
        yield (
            f"a bore of {1e3 * bore:.4g} mm on an eccentricity of {1e3 * eccentricity:.4g} mm leaves no sleeve around a shaft of "
            f"{1e3 * shaft_diameter:.4g} mm (at most {1e3 * max(bore - 2 * eccentricity, 0):.4g} mm); "
            "make shaft and crank pins in one piece"
        )
