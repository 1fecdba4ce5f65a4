"""A rolling bearing with its own load distribution as a radial law: axial place and tilts held."""

from typing import NamedTuple

import numpy as np

from drivewright._jit import kernel, warmer
from drivewright._typing import Floats
from drivewright.bearings import BallBearing, RollerBearing, law_of, measures
from drivewright.bearings.response import response
from drivewright.units import SI

USUAL = 2e8  # N/m: where to start from


class RollingBearingLaw(NamedTuple):
    """law: of `drivewright.bearings`; axial [m]: where its inner ring is held along the axis."""

    law: tuple[object, ...]
    axial: float

    def __call__(self, strain: Floats) -> tuple[Floats, Floats, Floats]:
        flat = np.ascontiguousarray(strain).reshape(-1, 2)
        energy, force, stiffness = np.zeros(len(flat)), np.zeros((len(flat), 2)), np.zeros((len(flat), 2, 2))
        _respond_all(self.law, flat, self.axial, energy, force, stiffness)
        shape = strain.shape[:-1]
        return energy.reshape(shape), force.reshape(*shape, 2), stiffness.reshape(*shape, 2, 2)

    def secant(self, force: float) -> float:
        """A usual radial stiffness [N/m] to start from."""
        return USUAL


def rolling_bearing_law(bearing: BallBearing | RollerBearing) -> RollingBearingLaw:
    """A bearing with a contact angle is held where it just touches, one without in the middle of its axial play."""
    law = law_of(bearing)
    return RollingBearingLaw(law, 0.0 if bearing.contact_angle > 0 else float(measures(law).centre))


@kernel
def _respond_all(law, places, axial, energy, force, stiffness):
    """Writes energy (n,) [J], force (n, 2) [N], stiffness (n, 2, 2) [N/m] at radial displacements `places` (n, 2) [m].

    All other freedoms are held.
    """
    displacement, pull, slope = np.zeros(5), np.zeros(5), np.zeros((5, 5))
    displacement[2] = axial
    for i in range(len(places)):
        displacement[:2] = places[i]
        energy[i] = response(law, displacement, pull, slope)
        force[i] = pull[:2]
        stiffness[i] = slope[:2, :2]


@warmer
def warm_rolling() -> None:
    """Compile for `doctor --warm`."""
    rolling_bearing_law(BallBearing(balls=3, ball_diameter=SI(1.0), pitch_diameter=SI(5.0)))(np.zeros((1, 2)))
