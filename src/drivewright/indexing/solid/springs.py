"""The springs between the bodies of an indexer at one position, with the laws of the reduced model.

Bodies are ("cam", j), ("shaft", side), ("ring", side, end) of a support in its housing and ("wheel",).
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple, TypeAlias

import numpy as np

from drivewright._typing import Bools
from drivewright.indexing.contacts import CamContacts
from drivewright.indexing.drivetrain import SIDES, BearingModel, Drivetrain, GearMesh, PinContact
from drivewright.indexing.solid.bodies import TURN_RADIUS
from drivewright.indexing.stiffness.assembly import cam_phases, flank_directions
from drivewright.indexing.stiffness.laws import GearFlankLaw, PinContactLaw, radial_bearing_law
from drivewright.indexing.stiffness.solve import CONTACT_GAP
from drivewright.solids.coupling import BodyName, InterfaceSpring, StrainTerm
from drivewright.solids.nonlinear_coupling import NonlinearSpring
from drivewright.solids.substructures import InterfaceName

Spring: TypeAlias = InterfaceSpring | NonlinearSpring


class Position(NamedTuple):
    """One position: number, crank angle with its sense, wheel's angle and number of pins, contacts of cam 0."""

    number: int
    crank: float
    wheel: float
    of_wheel: int
    contacts: CamContacts

    def kept(self, bonded: bool) -> Bools:
        """Which contacts take part: all that may close, of bonded ones the intended ones without a gap."""
        here = self.contacts
        return here.intended & (here.gap < CONTACT_GAP) if bonded else np.isfinite(here.gap)

    def pin(self, c: int, cam: int, cams: int) -> int:
        """Number of the pin at contact c of a cam: what touches cam 0, a part j/n of the wheel on."""
        return int(self.contacts.pin[c] + self.of_wheel * cam // cams) % self.of_wheel


class PositionSettings(NamedTuple):
    """What is alike at all positions: number of cams, whether pins stick, whether the wheel is a solid, a usual force [N]."""

    cams: int
    bonded: bool
    solid_wheel: bool
    usual: float


def springs_between(drive: Drivetrain, place: Position, settings: PositionSettings) -> Iterator[Spring]:
    """All springs of a `Position`, linear ones and those with laws of their own."""
    yield from _pins(drive, place, settings)
    for side in (0, 1):
        yield from _cranks(drive, place, settings, side)
        for end in (0, 1):
            yield from _support(drive, place, settings, side, end)
        yield from _gear(drive.gear, place, side)
    flange = _vector(("wheel",), ("flange",), np.exp(-1j * place.wheel), 1.0)
    yield from _bearing("wheel bearing", drive.wheel, settings.usual, flange)
    if settings.solid_wheel:  # its output does not move along the axis, nor tilt
        for motion in (2, 3, 4):
            yield InterfaceSpring("output", ((("wheel",), ("flange", motion), 1.0),), 0.0)


def _vector(body: BodyName, name: InterfaceName, back: complex, factor: float) -> list[tuple[StrainTerm, ...]]:
    """Terms of the two components of a displacement, `back` turning them into the body's own frame."""
    return [
        tuple((body, (*name, axis), factor * part) for axis, part in enumerate((turned.real, turned.imag))) for turned in (back, 1j * back)
    ]


def _pins(drive: Drivetrain, place: Position, settings: PositionSettings) -> Iterator[Spring]:
    """d = n . u_cam - n . u_pin less the gap of every contact; a solid pin yields itself, in place of the spring behind the contact."""
    yielding = PinContact() if drive.pins is None else drive.pins
    pin = yielding._replace(series=None) if settings.solid_wheel else yielding
    rigid = pin.line is None and pin.series is None
    law = None if rigid else PinContactLaw(pin, settings.bonded)
    back = np.exp(-1j * place.wheel)
    for j, way in enumerate(cam_phases(settings.cams)):
        for c in np.flatnonzero(place.kept(settings.bonded)):
            normal, number = place.contacts.normal[c] * way * back, place.pin(int(c), j, settings.cams)
            terms = (
                (("cam", j), ("contact", place.number, int(c)), 1.0),
                (("wheel",), ("pin", number, j, 0), -normal.real),
                (("wheel",), ("pin", number, j, 1), -normal.imag),
            )
            if rigid and settings.bonded:
                yield InterfaceSpring("pin", terms, 0.0)
                continue
            gap = 0.0 if settings.bonded else float(place.contacts.gap[c])
            usual = settings.usual if law is None else law.secant(settings.usual)
            yield NonlinearSpring("pin", (terms,), law, usual if gap < CONTACT_GAP else 0.0, (gap,))


def _cranks(drive: Drivetrain, place: Position, settings: PositionSettings, side: int) -> Iterator[Spring]:
    for j, way in enumerate(cam_phases(settings.cams)):
        seat = _vector(("cam", j), ("seat", side), 1 / way, 1.0)
        journal = _vector(("shaft", side), ("crank", j), np.exp(-1j * place.crank), -1.0)
        yield from _bearing("crank", drive.crank, settings.usual, [a + b for a, b in zip(seat, journal, strict=True)])


def _support(drive: Drivetrain, place: Position, settings: PositionSettings, side: int, end: int) -> Iterator[Spring]:
    """A support bearing between the shaft and its ring, and the ring in the housing."""
    rows = _vector(("shaft", side), ("support", end), np.exp(-1j * place.crank), 1.0)
    ring = _vector(("ring", side, end), (), 1.0, -1.0)
    yield from _bearing("support", drive.support, settings.usual, [a + b for a, b in zip(rows, ring, strict=True)])
    for axis in (0, 1):
        yield InterfaceSpring("support", ((("ring", side, end), (axis,), 1.0),), 0.0 if drive.housing is None else 1 / drive.housing)


def _bearing(group: str, bearing: BearingModel | None, usual: float, rows: Sequence[tuple[StrainTerm, ...]]) -> Iterator[Spring]:
    if bearing is None:
        yield from (InterfaceSpring(group, row, 0.0) for row in rows)
    else:
        law = radial_bearing_law(bearing)
        yield NonlinearSpring(group, tuple(rows), law, float(law.secant(usual)), (0.0, 0.0))


def _gear(gear: GearMesh | None, place: Position, side: int) -> Iterator[Spring]:
    """Both flanks, of which only one presses, or the shaft held where the gear would sit."""
    if gear is None:
        yield InterfaceSpring("gear", ((("shaft", side), ("gear", "turn"), 1.0),), 0.0)
        return
    for along in flank_directions(gear, side):
        turned = along * np.exp(-1j * place.crank)
        arm = -SIDES[side] * gear.pitch_radius * along.imag
        terms = (
            (("shaft", side), ("gear", 0), -turned.real),
            (("shaft", side), ("gear", 1), -turned.imag),
            (("shaft", side), ("gear", "turn"), -arm / TURN_RADIUS),
        )
        yield NonlinearSpring("gear", (terms,), GearFlankLaw(gear.stiffness), gear.stiffness, (gear.backlash / 2,))
