"""A plate with both its own pins as elastic solids in contact, through a history of loads (extra `fe`).

The half above the middle plane is meshed.  The plate flies: what pins and flanks leave unbalanced accelerates it (d'Alembert).  Each pin is
pushed into its seat along its rolling contact, with the shares along its length that a straight joint has; the part of its force across the
chain acts on its whole volume.  Flanks press on strips at the heights where a seated plate touches its sprockets.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.chains.plate import Plate
from drivewright.chains.solid.joint import OUTWARD, STRIP, Fit, Material, Stack, pin_body, seat_pair, strip_rows, turn_row
from drivewright.chains.solid.meshes import Sizes, plate_mesh
from drivewright.chains.stress.plate import SIDES, Loads
from drivewright.solids.contact.model import ContactModel, Functional, Link
from drivewright.solids.elastic import FreeBody, superposed_field
from drivewright.solids.engine import EngineObject

FLANK = 0.5  # width sigma of a flank's strip in radii of the seat
MARGIN = np.radians(10.0)  # of a force's direction from the end of a seat that bears in part


class PlateAndPins(NamedTuple):
    """A condensed plate "plate" with pins "left" and "right" in a `Fit`; heights [m] where flanks touch; model: its loads are "left x",
    "left y", "left flank 0", ..."""

    plate: Plate
    stack: Stack
    fit: Fit
    heights: tuple[float, ...]
    model: ContactModel


def plate_and_pins(
    plate: Plate, stack: Stack, fit: Fit, material: Material, shares: Floats, heights: Sequence[float], sizes: Sizes
) -> PlateAndPins:
    """`PlateAndPins` whose pins share their force by `shares` (k,) along their rolling contact."""
    body = FreeBody(plate_mesh(plate, *stack.own, sizes), *material, dirichletz="low")
    bodies, pairs, links, loads = {"plate": body}, [], [], {}
    sigma = STRIP * plate.seat("right").radius
    for side, outline in zip(SIDES, plate.own_pins, strict=True):
        way, pin = OUTWARD[side], pin_body(outline, stack, material, sizes, 0.0)
        bodies[side] = pin
        pairs.append(seat_pair(plate, "plate", side, side, fit, stack.own, 0.0))
        links.append(Link((Functional(side, turn_row(pin)),)))
        rows = strip_rows(pin, complex(way * plate.link.pitch / 2), -way, sigma, stack.end)
        loads[f"{side} x"] = Functional(side, superposed_field(rows, way * shares))
        loads[f"{side} y"] = Functional(side, pin.volume_mean((0, 1, 0)))
        for number, height in enumerate(heights):
            loads[f"{side} flank {number}"] = Functional("plate", _flank(body, plate, side, height))
    return PlateAndPins(plate, stack, fit, tuple(heights), ContactModel(bodies, pairs, links, loads, ("plate",)))


def forces_at(solid: PlateAndPins, loads: Loads, instant: int) -> dict[str, float]:
    """Forces {load: N} on the half model at one instant of the `Loads` of one plate."""
    pins, flanks, heights = (np.asarray(part, float)[instant] for part in loads)
    half, found = 0.5, {}
    for number, side in enumerate(SIDES):
        found[f"{side} x"], found[f"{side} y"] = half * _on_seat(pins[number], side, solid.fit)
        if flanks[number] > 0:
            nearest = int(np.abs(np.array(solid.heights) - heights[number]).argmin())
            found[f"{side} flank {nearest}"] = half * flanks[number]
    return found


def _on_seat(force: Floats, side: str, fit: Fit) -> Floats:
    """A pin's force (2,) [N], turned back onto a seat that bears only in part: its shape, not its contact, holds a real pin there."""
    if fit.seat is None:
        return force
    along = complex(*force) * OUTWARD[side]
    most = max(fit.seat - MARGIN, 0.0)
    turned = abs(along) * np.exp(1j * np.clip(np.angle(along), -most, most)) * OUTWARD[side]
    return np.array([turned.real, turned.imag])


def _flank(body: FreeBody, plate: Plate, side: str, height: float) -> EngineObject:
    """Load vector of a unit force into an outer flank at a height [m]."""
    (x0, y0), (x1, y1) = plate.flank(side)
    x = x0 + (height - y0) / (y1 - y0) * (x1 - x0)
    along = complex(x1 - x0, y1 - y0) / np.hypot(x1 - x0, y1 - y0)
    normal = along * 1j if (along * 1j).real * OUTWARD[side] > 0 else -along * 1j
    row = body.gaussian_strip(f"flank {side}", complex(x, height), normal, FLANK * plate.seat("right").radius)
    row.data = -1.0 * row
    return row
