"""The linear springs between the bodies at one position: each law at its secant in the equilibrium of the reduced model.

A spring's force is s = stiffness (d - offset) at the strain d.  With the bodies of the reduced model they give its own displacements.
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple, TypeAlias

import numpy as np

from drivewright._typing import Complexes, Floats
from drivewright.contact import PowerLaw, power_law_depth
from drivewright.errors import SolverError
from drivewright.indexing.contacts import CamContacts
from drivewright.indexing.drivetrain import SIDES, BearingModel, Drivetrain, GearMesh, PinContact, PowerLawBearing
from drivewright.indexing.solid.bodies import TURN_RADIUS
from drivewright.indexing.stiffness.assembly import cam_phases, flank_directions
from drivewright.indexing.stiffness.laws import pin_compliance, radial_bearing_law
from drivewright.solids.coupling import BodyName, InterfaceSpring
from drivewright.solids.substructures import InterfaceName

Term: TypeAlias = tuple[BodyName, InterfaceName, float]  # body, functional, factor

LEAST = 1e-6  # of the typical force: below it a bearing keeps the secant that it has there
MOST_STEPS = 100


class Position(NamedTuple):
    """One position of the reduced model: crank angle with its sense, wheel's angle and number of pins, contacts, forces."""

    crank: float
    wheel: float
    of_wheel: int
    contacts: CamContacts
    pins: Floats  # (cams, k) [N]
    cranks: Complexes  # (2, cams) [N]
    supports: Complexes  # (2, 2) [N]
    gears: Complexes  # (2,) [N]
    bearing: complex


def springs(drive: Drivetrain, place: Position, number: int, both: bool, solid_pins: bool) -> Iterator[InterfaceSpring]:
    """All `InterfaceSpring`s of a `Position`; bodies are ("cam", j), ("shaft", side), ("wheel",), `number` is that of the position."""
    typical = np.abs(place.cranks).max()
    yield from _pins(drive, place, number, both, solid_pins)
    for side in (0, 1):
        for j, way in enumerate(cam_phases(len(place.pins))):
            seat = _vector(("cam", j), ("seat", side), 1 / way, 1.0)
            journal = _vector(("shaft", side), ("crank", j), np.exp(-1j * place.crank), -1.0)
            yield from _bearing("crank", drive.crank, place.cranks[side, j], typical, [a + b for a, b in zip(seat, journal, strict=True)])
        for end in (0, 1):
            rows = _vector(("shaft", side), ("support", end), np.exp(-1j * place.crank), 1.0)
            yield from _bearing("support", drive.support, place.supports[side, end], typical, rows, drive.housing)
        yield from _gear(drive.gear, place, side)
    flange = _vector(("wheel",), ("flange",), np.exp(-1j * place.wheel), 1.0)
    yield from _bearing("wheel bearing", drive.wheel, place.bearing, typical, flange)


def _vector(body: BodyName, name: InterfaceName, back: complex, factor: float) -> list[tuple[Term, ...]]:
    """Terms of the two components of a displacement, `back` turning them into the body's own frame."""
    return [
        tuple((body, (*name, axis), factor * part) for axis, part in enumerate((turned.real, turned.imag))) for turned in (back, 1j * back)
    ]


def _pins(drive: Drivetrain, place: Position, number: int, both: bool, solid_pins: bool) -> Iterator[InterfaceSpring]:
    """d = n . u_cam - n . u_pin of the contacts that carry; a solid pin yields itself, in place of the spring behind the contact."""
    yielding = PinContact() if drive.pins is None else drive.pins._replace(series=None) if solid_pins else drive.pins
    back = np.exp(-1j * place.wheel)
    for j, way in enumerate(cam_phases(len(place.pins))):
        for c, force in enumerate(place.pins[j]):
            if force == 0:
                continue
            normal = place.contacts.normal[c] * way * back
            pin = _pin(place, c, j)
            terms = (
                (("cam", j), ("contact", number, c), 1.0),
                (("wheel",), ("pin", pin, j, 0), -normal.real),
                (("wheel",), ("pin", pin, j, 1), -normal.imag),
            )
            yield InterfaceSpring("pin", terms, pin_compliance(yielding, abs(force)), 0.0 if both else place.contacts.gap[c])


def _pin(place: Position, c: int, j: int) -> int:
    """Number of the pin at contact c of cam j: what touches cam 0, a part j/n of the wheel on."""
    return int(place.contacts.pin[c] + place.of_wheel * j // len(place.pins)) % place.of_wheel


def touched(place: Position) -> tuple[set[tuple[int, int]], set[int]]:
    """({(pin, cam)}, {contact}) of all contacts that carry."""
    at = [(int(j), int(c)) for j, c in np.argwhere(place.pins)]
    return {(_pin(place, c, j), j) for j, c in at}, {c for _, c in at}


def _bearing(
    group: str, bearing: BearingModel | None, force: complex, typical: float, rows: Sequence[Sequence[Term]], behind: float | None = None
) -> Iterator[InterfaceSpring]:
    """Two springs with the secant of a bearing's law, alike in all directions, and a stiffness behind it."""
    softness = 0.0 if behind is None else 1 / behind
    offset = 0j
    if bearing is not None:
        force = force if abs(force) > LEAST * typical else complex(LEAST * typical)
        away = displacement(bearing, force)
        secant = (away / force).real
        softness, offset = softness + secant, away - secant * force
    for row, part in zip(rows, (offset.real, offset.imag), strict=True):
        yield InterfaceSpring(group, tuple(row), softness, part)


def displacement(bearing: BearingModel, force: complex) -> complex:
    """Displacement [m] of a bearing under a radial force [N], both complex."""
    if isinstance(bearing, PowerLawBearing):
        depth = float(power_law_depth(PowerLaw(bearing.constant, bearing.exponent), abs(force)))
        return force / abs(force) * (depth + bearing.clearance)
    law, wanted = radial_bearing_law(bearing), np.array([force.real, force.imag])
    at = wanted / law.secant(abs(force))
    energy, found, slope = law(at)
    for _ in range(MOST_STEPS):
        missing = wanted - found
        if np.abs(missing).max() < 1e-10 * abs(force):
            return complex(at[0], at[1])
        step, value = np.linalg.solve(slope + 1e-9 * np.trace(slope) * np.eye(2), missing), energy - wanted @ at
        while (trial := law(at + step))[0] - wanted @ (at + step) > value + 1e-14 * abs(value):
            step = step / 2
        at, (energy, found, slope) = at + step, trial
    raise SolverError(f"solid check: no displacement of a bearing under {abs(force):.4g} N found; is that far beyond what it carries?")


def _gear(gear: GearMesh | None, place: Position, side: int) -> Iterator[InterfaceSpring]:
    """The flanks that carry, or the shaft held where the gear would sit."""
    if gear is None:
        yield InterfaceSpring("gear", ((("shaft", side), ("gear", "turn"), 1.0),), 0.0)
        return
    directions = flank_directions(gear, side)
    pressed = np.linalg.solve([directions.real, directions.imag], [place.gears[side].real, place.gears[side].imag])
    for force, along in zip(pressed, directions, strict=True):
        if force > LEAST * np.abs(pressed).max():
            turned = along * np.exp(-1j * place.crank)
            arm = -SIDES[side] * gear.pitch_radius * along.imag
            terms = (
                (("shaft", side), ("gear", 0), -turned.real),
                (("shaft", side), ("gear", 1), -turned.imag),
                (("shaft", side), ("gear", "turn"), -arm / TURN_RADIUS),
            )
            yield InterfaceSpring("gear", terms, 1 / gear.stiffness, gear.backlash / 2)
