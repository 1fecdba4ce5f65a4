"""The translating follower in the frame of its cam.

The cam turns counter-clockwise by `angle` (a jet); the follower slides along +y at x = offset.  Zero lift puts the centre of its
roller at the prime radius.  `side` = -1 is a roller on the far side of the cam, pushed towards -y when the lift falls.

    centre of the roller   B = (e + i side (s0 + side s)) e^{-i angle},   s0 = sqrt(R^2 - e^2)

A cam that turns clockwise is the mirror image: -conj(B).  R and e are numbers, or columns (n, 1) of many designs.
"""

from typing import Any

import numpy as np

from drivewright._typing import Numbers
from drivewright.cams.refusals import first_refused
from drivewright.curves import derivative
from drivewright.errors import DoesNotAssemble
from drivewright.numerics.jets import Jet, atan, exp


def rest_height(prime_radius: Numbers, offset: Numbers) -> Any:
    """s0 = sqrt(R^2 - e^2) [m]: height of the roller's centre at zero lift.  Raises DoesNotAssemble unless |e| < R."""
    if refused := first_refused(np.less(np.abs(offset), prime_radius), offset, prime_radius):
        raise DoesNotAssemble(
            f"translating follower: offset {1e3 * refused[0]:.6g} mm is not within prime_radius {1e3 * refused[1]:.6g} mm; the follower "
            "would pass beside the cam. Reduce the offset or enlarge the prime radius."
        )
    return np.sqrt(prime_radius**2 - offset**2)


def pitch_curve(angle: Jet, lift: Jet, prime_radius: Numbers, offset: Numbers = 0.0, side: int = 1) -> Jet:
    """Centre of the roller in the cam frame [m]: a complex jet, from the jets of the cam angle and of the lift [m]."""
    return (offset + 1j * (side * rest_height(prime_radius, offset) + lift)) * exp(-1j * angle)


def pressure_angle(angle: Jet, lift: Jet, prime_radius: Numbers, offset: Numbers = 0.0, side: int = 1) -> Jet:
    """Angle between the common normal and the follower's path [rad], a jet with one valid derivative.

    tan(alpha) = side (ds/dtheta - e)/(s0 + side s): positive where it opposes the roller's way out of the cam.
    """
    height = rest_height(prime_radius, offset) + side * lift
    return atan(side * (derivative(lift) / derivative(angle) - offset) / height)
