"""A roller in the gap of a roller chain's sprocket: a concave seat between two convex arcs of flanks."""

import numpy as np

from drivewright._jit import inner


@inner
def roller_contact(
    across: float, out: float, edge_x: float, edge_y: float, flank_x: float, flank_y: float, seat_gap: float, flank_gap: float
) -> tuple[float, float, float, float, bool]:
    """(depth, distance, x, y, whether in the seat) of a roller at (across, out) [m] from the seat's centre, across >= 0, out outward.

    Within the seat, whose end lies in the direction of the edge, the depth is |e| - seat_gap, seat radius less the roller's; beyond it
    flank_gap - |e - F|, with F the centre of the flank's arc and flank_gap its radius with the roller's.  (x, y) leads from the centre of
    the arc to the roller, `distance` is its length: both depth and normal are continuous.
    """
    seated = edge_x * out - edge_y * across <= 0.0
    x, y = (across, out) if seated else (across - flank_x, out - flank_y)
    distance = np.sqrt(x * x + y * y)  # np.hypot keeps loops from becoming vector code
    return distance - seat_gap if seated else flank_gap - distance, distance, x, y, seated
