"""The parallel-shaft indexer: two plate cams on the input shaft hold a wheel with two levels of rollers.

The wheel turns about 0, the input shaft stands at the centre distance C on the x axis and turns against the wheel, clockwise, as outer
gears do: w = -theta.  Only so is the pitch point C/(1 + phi') between the shafts, where the rollers are.  A turn of the input is one step
of 2 pi/S, S stations.  Each level has N rollers, a multiple of S; in the dwell, and so at theta = 0, one roller of the first level stands
`pin_phase` pitches 2 pi/N in front of the line of centres, one of the second level half a pitch behind that one.  With the phase 1/4 the
first is pressed forward by the dwell arc of its cam, the second as far behind the line backward: together they lock the wheel, and for a
symmetric law the second cam is the mirror image of the first.
Seen from the cam a roller's centre runs along (R exp(i psi) - C) exp(i theta), psi its angle on the wheel: the pitch curve of an
oscillating roller follower with the arm R and the pivot distance C.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from drivewright._typing import ArrayLike
from drivewright.errors import InputError
from drivewright.indexing.motion import TURN, IndexMotion
from drivewright.indexing.plane import PlaneDrive, refuse_overlap
from drivewright.numerics.jets import Jet, constant, variable


@dataclass(frozen=True, eq=False)
class PlateCam(PlaneDrive):
    """One cam of the drive with the rollers of its level.

    lead: place of a roller in the dwell from the line of centres, in pitches of the rollers.
    """

    pins: int
    circle_radius: float
    pin_radius: float
    centre_distance: float
    motion: IndexMotion
    lead: float

    @property
    def phase(self) -> float:
        """Angle of roller 0 at theta = 0 [rad]."""
        return self.lead * self.pin_pitch

    def pose(self, theta: ArrayLike) -> tuple[Jet, Jet]:
        """The input shaft and its turn -theta."""
        theta = np.asarray(theta, dtype=float)
        return constant(np.full(theta.shape, complex(self.centre_distance))), -variable(theta)

    def refuse(self) -> None:
        """InputError where rollers overlap or, on the line of centres, reach the input shaft's axis."""
        refuse_overlap(self)
        reach = self.circle_radius + self.pin_radius
        if self.centre_distance <= reach:
            raise InputError(
                f"centre_distance = {self.centre_distance * 1e3:.4g} mm: the rollers reach {reach * 1e3:.4g} mm from the wheel's axis and "
                f"sweep over the axis of the cams, so no cam remains. Take more than {reach * 1e3:.4g} mm, plus room for the shaft."
            )


@dataclass(frozen=True, eq=False)
class ParallelIndexer:
    """Wheel with two levels of `pins` rollers each, the second turned by half a pitch, and the cams at `centre_distance` [m].

    pin_phase: place of a roller of the first level in the dwell, in pitches of the rollers in front of the line of centres.
    """

    pins: int
    circle_radius: float
    pin_radius: float
    centre_distance: float
    motion: IndexMotion
    pin_phase: float = 0.25

    @property
    def pin_pitch(self) -> float:
        """Angle between neighbouring rollers of a level [rad]."""
        return TURN / self.pins

    @property
    def levels(self) -> tuple[PlateCam, PlateCam]:
        """The two cams, each with the rollers of its level."""
        return self._levels

    @cached_property
    def _levels(self) -> tuple[PlateCam, PlateCam]:
        given = self.pins, self.circle_radius, self.pin_radius, self.centre_distance, self.motion
        return PlateCam(*given, self.pin_phase), PlateCam(*given, self.pin_phase - 0.5)

    def refuse(self) -> None:
        """InputError where the measures leave one of the cams nothing."""
        for level in self.levels:
            level.refuse()
