"""A rolling bearing in the plane of its axis: rings as rectangles, and an element above and below."""

from collections.abc import Iterator

import numpy as np

from drivewright.bearings.ball import BallBearing
from drivewright.bearings.roller import RollerBearing
from drivewright.scene import Outline, Shape, circle, polygon, rectangle

BALL_WIDTH, ROLLER_WIDTH = 1.9, 1.3  # of the rings over the size of an element along the axis


def bearing_section(bearing: BallBearing | RollerBearing, position: float, bore: float, mirrored: bool = False) -> Iterator[Shape]:
    """Shapes of a bearing on a shaft of the diameter `bore` [m], its middle at `position` [m] along x; mirrored: turned round."""
    if isinstance(bearing, BallBearing):
        element, width = bearing.ball_diameter, BALL_WIDTH * bearing.ball_diameter
    else:
        element, width = bearing.roller_diameter, ROLLER_WIDTH * bearing.roller_length
    inside, outside = bore / 2, bearing.pitch_diameter - bore / 2
    for side in (1, -1):
        middle = side * bearing.pitch_diameter / 2
        yield Shape("body", rectangle((position, side * 0.5 * (inside + outside)), width, max(outside - inside, element)))
        yield Shape("roller", _element(bearing, position, middle, mirrored))


def _element(bearing: BallBearing | RollerBearing, position: float, middle: float, mirrored: bool) -> Outline:
    if isinstance(bearing, BallBearing):
        return circle((position, middle), bearing.ball_diameter / 2)
    turn = (1 if mirrored else -1) * np.sign(middle) * bearing.contact_angle
    length, diameter = bearing.roller_length, bearing.roller_diameter
    corners = 0.5 * np.array([(-length, -diameter), (length, -diameter), (length, diameter), (-length, diameter)])
    c, s = np.cos(turn), np.sin(turn)
    return polygon(corners @ np.array([[c, s], [-s, c]]) + (position, middle))
