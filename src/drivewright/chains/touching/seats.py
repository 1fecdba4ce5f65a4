"""Which tooth or gap of a sprocket a plate may sit on."""

import numpy as np

from drivewright._jit import inner


@inner
def nearest_tooth(x: float, y: float, rotation: float, pitch_angle: float, angle: float) -> float:
    """Angle of the tooth nearest to (x, y) [m] from the sprocket's centre, against its rotation [rad].

    For a plate astride of the tooth: less a right angle, and in whole turns as the plate's own angle.
    """
    seat = np.round((np.arctan2(y, x) - rotation) / pitch_angle) * pitch_angle - 0.5 * np.pi
    return seat + 2 * np.pi * np.round((angle - rotation - seat) / (2 * np.pi))


@inner
def nearest_gap(x: float, y: float, rotation: float, pitch_angle: float) -> float:
    """Angle of the gap between teeth nearest to a roller at (x, y) [m] from the sprocket's centre, against its rotation [rad]."""
    return (np.floor((np.arctan2(y, x) - rotation) / pitch_angle) + 0.5) * pitch_angle
