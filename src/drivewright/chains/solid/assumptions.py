"""What plate and pins bear under assumptions that a drawing leaves open: clearance, seat, edges of the holes, load.

The bodies are condensed once; an assumption changes the gap between them, or the load, and costs one small quadratic programme.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.chains.solid.history import SolidHistory, solid_history
from drivewright.chains.solid.joint import Fit, seat_gap
from drivewright.chains.solid.pitch import PlateAndPins
from drivewright.chains.stress.plate import SIDES, Loads


class Borne(NamedTuple):
    """What an assumption leaves: greatest von Mises stress [Pa] of the plate, of its seats alone, of the pins; pressure [Pa] on a seat."""

    plate: float
    seat: float
    pin: float
    pressure: float


def with_fit(solid: PlateAndPins, fit: Fit) -> list[Floats]:
    """Gaps [mm^3] of both seats' hats for another fit, as `ContactModel.solve` takes them.

    Hats are those within reach of the fit that the bodies were condensed with: one with the whole seat and little clearance serves all.
    """
    return [
        pairing.gap_with(seat_gap(solid.plate, side, fit, solid.stack.own))
        for side, pairing in zip(SIDES, solid.model.pairings, strict=True)
    ]


def borne(history: SolidHistory) -> Borne:
    """The greatest that a history holds."""
    seat = history.solid.plate.seat("right")
    skin = history.skins["plate"]
    centre = np.where(skin.points[:, 0] > 0, seat.center[0], -seat.center[0])
    near = np.abs(np.hypot(skin.points[:, 0] - centre, skin.points[:, 1] - seat.center[1]) - seat.radius) < 1e-6
    return Borne(
        history.worst("plate")[0],
        float(skin.mises[:, near].max()),
        max(history.worst(side)[0] for side in SIDES),
        max(float(part.max(initial=0.0)) for state in history.states for part in state.pressure),
    )


def over_fits(solid: PlateAndPins, fits: Sequence[Fit], loads: Loads) -> list[SolidHistory]:
    """The `SolidHistory` of each fit under the same loads."""
    return [solid_history(solid._replace(fit=fit), loads, with_fit(solid, fit)) for fit in fits]
