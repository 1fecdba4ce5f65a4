"""The bodies of an indexer condensed for all positions at once.

A pin presses on a strip of the cam, whose width is a choice and sets how deep it dents.  The local law of the contact (a line contact)
already holds that dent, so the dent of the same strip on a half-space, down to the depth of a pin's radius, is taken off the cam's own
flexibility; the strip's width then drops out.  The pin's displacement is the mean over its skin where the cam touches, without a dent.
"""

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np

from drivewright.indexing.drivetrain import Drivetrain
from drivewright.indexing.pin_wheel import PinWheel
from drivewright.indexing.solid import bodies as of
from drivewright.indexing.solid.parts import CamBody, Solids
from drivewright.indexing.solid.springs import Position
from drivewright.indexing.stiffness.assembly import cam_phases
from drivewright.solids.coupling import BodyName
from drivewright.solids.substructures import Substructure, radial_loads, rigid_substructure

Bodies: TypeAlias = dict[BodyName, Substructure]

STRIP = 0.2  # width sigma of the strip in radii of a pin
SHIFTS = (0, 1)  # rigid motions of the ring of a support in its housing


def condensed(
    wheel: PinWheel, drive: Drivetrain, solids: Solids, places: Sequence[Position], cams: int, fineness: float = 1.0, strip: float = STRIP
) -> Bodies:
    """{("cam", j), ("shaft", side), ("ring", side, end), ("wheel",): Substructure} for all positions at once."""
    pairs = sorted({(place.pin(int(c), j, cams), j) for place in places for c in np.flatnonzero(place.kept(False)) for j in range(cams)})
    width = solids.cam.thickness if solids.cam else None
    throws = [complex(c) for c in wheel.eccentricity * cam_phases(cams)]
    shaft = of.shaft(drive, solids.shaft, throws, fineness)
    made = _cams(wheel, drive, solids.cam, places, cams, fineness, strip * wheel.pin_radius)
    found: Bodies = {("cam", j): body for j, body in enumerate(made)}
    found |= {("shaft", side): shaft for side in (0, 1)}
    ring = rigid_substructure(list(radial_loads((), (0.0, 0.0, 0.0))), SHIFTS)
    found |= {("ring", side, end): ring for side in (0, 1) for end in (0, 1)}
    return found | {("wheel",): of.wheel(drive, wheel, solids.wheel, width, pairs, fineness)}


def _cams(
    wheel: PinWheel, drive: Drivetrain, body: CamBody | None, places: Sequence[Position], cams: int, fineness: float, sigma: float
) -> list[Substructure]:
    """Condensed cams, of two opposite ones the second from the first."""
    strips = {
        (place.number, int(c)): (touching_point(wheel, place, int(c)), complex(place.contacts.normal[c]))
        for place in places
        for c in np.flatnonzero(place.kept(False))
    }
    outline = wheel.profile.outline() if body else None
    found = []
    for holes in of.cam_holes(drive.spacing, cams):
        made = of.cam(outline, body, holes, strips, sigma, fineness)
        found.append(made if body is None else _without_strip(made, of.strip_compliance(sigma, wheel.pin_radius, body)))
    return found + [_exchanged(body) for body in found[: cams - len(found)]]


def touching_point(wheel: PinWheel, place: Position, c: int) -> complex:
    """Point of the profile [m] nearest to the pin of contact c, seen from cam 0."""
    here = place.contacts
    reach = wheel.pin_radius + here.gap[c]
    return complex(here.centre[c] - reach * here.normal[c] - wheel.eccentricity * np.exp(1j * place.crank))


def _without_strip(body: Substructure, compliance: float) -> Substructure:
    """The body whose contacts yield less by the compliance [m/N]."""
    taken = [compliance if name[0] == "contact" else 0.0 for name in body.number]
    return body._replace(flexibility=body.flexibility - np.diag(taken))


def _exchanged(body: Substructure) -> Substructure:
    """The body with its seats 0 and 1 named the other way round."""
    return body._replace(number={("seat", 1 - name[1], name[2]) if name[0] == "seat" else name: n for name, n in body.number.items()})
