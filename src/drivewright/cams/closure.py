"""Form closure of a follower on its cam: a yoke, a groove, a second cam."""

from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from drivewright.cams.cycle import Cycle, Quantity
from drivewright.cams.followers import CamContact, ContactAt, TranslatingFlat, TranslatingRound
from drivewright.numerics.jets import Jet, cos


class Breadth(NamedTuple):
    """Mean of s(theta) + s(theta + pi) [m] and the largest departure from it [m]: the play or interference of a yoke."""

    mean: float
    error: float


def breadth(cycle: Cycle) -> Breadth:
    """`Breadth` of the lift over a turn.  A yoke between two faces or rollers wants error = 0."""

    def total(angle, lift):
        return lift + cycle.after(np.pi, angle)

    least, greatest = cycle.minimum(total).value, cycle.maximum(total).value
    return Breadth(0.5 * (least + greatest), 0.5 * (greatest - least))


def opposite_contact(cycle: Cycle, follower: TranslatingRound | TranslatingFlat, angle: Jet, lift: Jet) -> CamContact:
    """`CamContact` of the second face of a yoke: that of the first half a turn later, driving the return."""
    later = follower.contact(angle + np.pi, cycle.after(np.pi, angle))
    return replace(later, way=-later.way)


def crossovers(cycle: Cycle, required: Quantity) -> Any:
    """How often per turn the force that the motion of the follower requires changes its sign, so that the other flank or cam takes over.

    Of many designs a column (n, 1).
    """
    force = required(*cycle.sampled()).d0
    return np.apply_along_axis(_changes, -1, np.sign(force))[..., None] if np.ndim(force) > 1 else _changes(np.sign(force))


def _changes(signs):
    """How often the signs of a closed row change, zeros left aside."""
    signs = signs[signs != 0]
    return float(np.sum(signs != np.roll(signs, 1)))


def play(cycle: Cycle, contact: ContactAt, clearance: float) -> float:
    """Greatest travel [m] of the follower through a clearance [m] between two flanks: clearance/cos alpha."""
    return clearance * cycle.maximum(lambda angle, lift: 1 / cos(contact(angle, lift).pressure_angle)).value
