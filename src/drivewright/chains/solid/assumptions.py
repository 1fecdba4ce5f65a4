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
from drivewright.errors import InputError


class Peaks(NamedTuple):
    """What an assumption leaves: greatest von Mises stress [Pa] of the plate and of the pins; greatest pressure [Pa] on a seat."""

    plate: float
    pin: float
    pressure: float


def with_fit(solid: PlateAndPins, fit: Fit) -> list[Floats]:
    """Gaps [mm^3] of both seats' hats for another fit, as `ContactModel.solve` takes them.

    Hats are those of the seat that the bodies were condensed with: one that bears all round serves all.  Friction stays as it was.
    InputError where another fit bears beyond it.
    """
    if solid.fit.seat is not None and (fit.seat is None or fit.seat > solid.fit.seat):
        wanted = "all round" if fit.seat is None else f"{np.degrees(fit.seat):.4g}° to either side"
        made = f"{np.degrees(solid.fit.seat):.4g}° to either side"
        raise InputError(
            f"stress of solids: the plate was condensed with a bearing seat of {made}, but the fit needs {wanted}; condense it with a fit "
            "of the same seat, or without a fit."
        )
    return [
        pairing.gap_with(seat_gap(solid.plate, side, fit, solid.stack.own))
        for side, pairing in zip(SIDES, solid.model.pairings, strict=True)
    ]


def peaks(history: SolidHistory) -> Peaks:
    """The greatest that a history holds."""
    return Peaks(history.worst("plate")[0], max(history.worst(side)[0] for side in SIDES), float(history.seat_pressure.max()))


def over_fits(solid: PlateAndPins, fits: Sequence[Fit], loads: Loads) -> list[SolidHistory]:
    """The `SolidHistory` of each fit under the same loads."""
    return [solid_history(solid._replace(fit=fit), loads, with_fit(solid, fit)) for fit in fits]
