"""A plate's back or belly, a straight line of a pitch, on the convex arc of a guide."""

import numpy as np

from drivewright._jit import inner


@inner
def nearest_on_plate(along: float, up: float, half: float) -> tuple[float, float, float]:
    """(arm, x, distance) [m]: the nearest point (x, up) of the line from the arc's centre; `arm` is that from the plate's middle.

    (along, up) [m] is the middle of that line from the arc's centre, in the plate's frame.  The line ends `half` [m] either way, and the
    nearest point may be its end: where two plates make a corner towards the guide, the corner touches.
    """
    arm = min(max(-along, -half), half)
    x = along + arm
    return arm, x, np.sqrt(x * x + up * up)  # np.hypot keeps loops from becoming vector code


@inner
def is_on_arc(c: float, s: float, x: float, y: float, distance: float, middle_x: float, middle_y: float, opening: float) -> bool:
    """Whether (x, y) of the plate's frame, turned by (c, s) = (cos, sin), lies in the arc's angle: half of it has the cosine `opening`."""
    return (c * x - s * y) * middle_x + (s * x + c * y) * middle_y >= opening * distance
