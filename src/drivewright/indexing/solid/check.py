"""Torsional stiffness of a pin-wheel indexer with its bodies as solids, beside that of the reduced model (extra `fe`).

Cams, eccentric shafts and pin wheel are meshed once with curved second-order tetrahedra and condensed to the loads between them; at every
position they are joined by springs: bearings between the mean displacements of their seats, the pins that carry in the reduced model, gears
along their line of action, all at the secant that they have there.  What is compared is thus the elasticity of the bodies alone.

A pin presses on a strip of the cam, whose width is a choice and sets how deep it dents.  The local law of the contact (a line contact)
already holds that dent, so the dent of the same strip on a half-space, down to the depth of a pin's radius, is taken off the cam's own
flexibility; the strip's width then drops out.  The pin's displacement is the mean over its skin where the cam touches, without a dent.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from time import perf_counter
from typing import Literal, TypeAlias

import numpy as np

from drivewright._typing import ArrayLike, Floats
from drivewright.errors import InputError
from drivewright.indexing.contacts import CamContacts
from drivewright.indexing.drivetrain import SIDES, Drivetrain
from drivewright.indexing.pin_wheel import PinWheel
from drivewright.indexing.solid import bodies as of
from drivewright.indexing.solid.parts import CamBody, Solids, check
from drivewright.indexing.solid.springs import Position, springs, touched
from drivewright.indexing.stiffness import TorsionalStiffness, solve_torsional_stiffness
from drivewright.indexing.stiffness.assembly import cam_phases
from drivewright.result import Table
from drivewright.solids.coupling import BodyName, CoupledSolution, InterfaceSpring, functional_offsets, solve_coupled
from drivewright.solids.deformation import DisplacedSurface, displaced_table, exaggeration_for, with_mirror_images
from drivewright.solids.elastic import superposed_field
from drivewright.solids.substructures import Substructure

Bodies: TypeAlias = dict[BodyName, Substructure]

HALVES = (((1, 1, 1), (1, 1, 1)), ((1, 1, -1), (1, 1, -1)))  # the upper half of a cam, and its image in the middle plane
DRAWN = 0.03  # the largest displacement is drawn as about this part of the cam
STRIP = 0.2  # width sigma of the strip in radii of a pin
GROUPS = ("pin", "crank", "support", "gear", "wheel bearing", "output", "cam", "shaft", "wheel")


@dataclass(frozen=True, eq=False)
class SolidStiffness:
    """Answer of the solid check at p positions; nan where the reduced model does not carry.

    secant (p,) [N m/rad] with solids; reduced: the `TorsionalStiffness` beside it; shares: compliance [rad/(N m)] of each of GROUPS (p,),
    which add up to 1/secant: springs first, then the elasticity of cams, shafts and wheel.
    astray (p,): largest force of a pin whose sign is another than in the reduced model, over the largest of all; 0 where the contact state
    is that of the solids too.
    unknowns: {"cam", "shaft", "wheel"} of one mesh each, 0 where a body is not a solid.
    surface: the `DisplacedSurface` of cam 0, displacements (p, n, 3) [m]; None without a solid cam.
    """

    theta: Floats
    torque: float
    secant: Floats
    reduced: TorsionalStiffness
    shares: dict[str, Floats]
    astray: Floats
    unknowns: dict[str, int]
    seconds: float
    surface: DisplacedSurface | None = None

    @property
    def ratio(self) -> Floats:
        """Stiffness with solids over that of the reduced model."""
        return self.secant / self.reduced.secant


def solid_stiffness(
    wheel: PinWheel,
    drive: Drivetrain,
    solids: Solids,
    theta: ArrayLike,
    contacts: Sequence[CamContacts],
    torque: float,
    *,
    cams: int = 2,
    model: Literal["unilateral", "bonded"] = "unilateral",
    fineness: float = 1.0,
    strip: float = STRIP,
) -> SolidStiffness:
    """`SolidStiffness` of a `PinWheel`, its `Drivetrain` and `Solids` at the angles theta (p,) [rad] under a torque [N m].

    contacts: `CamContacts` of cam 0, one a position, as for the reduced model; fineness: factor on all element sizes; strip: width sigma of
    a
    contact on the cam in radii of a pin.
    """
    started = perf_counter()
    check(solids, wheel, drive, cams)
    theta = np.atleast_1d(np.asarray(theta, dtype=float))
    reduced = solve_torsional_stiffness(drive, theta, contacts, wheel.eccentricity, torque, cams=cams, sense=int(wheel.sense), model=model)
    places = {i: _position(wheel, reduced, contacts, i) for i, outcome in enumerate(reduced.outcome) if outcome == "carried"}
    if not places:
        raise InputError(f"solid check: no position carries the torque: {reduced.reasons[0]}.")
    bodies = condensed(wheel, drive, solids, places, cams, fineness, strip)
    found = {i: _coupled(bodies, drive, solids, wheel, place, i, model, torque) for i, place in places.items()}
    shares = {group: _spread(theta, {i: each[group] for i, (_, each, _) in found.items()}) for group in GROUPS}
    astray = _spread(theta, {i: each for i, (_, _, each) in found.items()})
    unknowns = {name: bodies[key].unknowns for name, key in (("cam", ("cam", 0)), ("shaft", ("shaft", 0)), ("wheel", ("wheel",)))}
    surface = None if solids.cam is None else _deformed(bodies, {i: each[0] for i, each in found.items()}, len(theta))
    return SolidStiffness(
        theta, torque, 1 / np.sum(list(shares.values()), axis=0), reduced, shares, astray, unknowns, perf_counter() - started, surface
    )


def _spread(theta: Floats, values: Mapping[int, float]) -> Floats:
    return np.array([values.get(i, np.nan) for i in range(len(theta))])


def _position(wheel: PinWheel, reduced: TorsionalStiffness, contacts: Sequence[CamContacts], i: int) -> Position:
    here = contacts[i]
    turned = float(np.angle(np.mean(here.centre * np.exp(-2j * np.pi * here.pin / wheel.pins))))
    return Position(
        wheel.sense * reduced.theta[i],
        turned,
        wheel.pins,
        here,
        reduced.pin_forces[i],
        reduced.crank_forces[i],
        reduced.support_forces[i],
        reduced.gear_forces[i],
        complex(reduced.wheel_forces[i]),
    )


def condensed(
    wheel: PinWheel,
    drive: Drivetrain,
    solids: Solids,
    places: Mapping[int, Position],
    cams: int,
    fineness: float = 1.0,
    strip: float = STRIP,
) -> Bodies:
    """{("cam", j), ("shaft", side), ("wheel",): Substructure} for all positions at once."""
    pairs = sorted(set().union(*(touched(place)[0] for place in places.values())))
    width = solids.cam.thickness if solids.cam else None
    throws = [complex(c) for c in wheel.eccentricity * cam_phases(cams)]
    shaft = of.shaft(drive, solids.shaft, throws, fineness)
    made = _cams(wheel, drive, solids.cam, places, cams, fineness, strip * wheel.pin_radius)
    found: Bodies = {("cam", j): body for j, body in enumerate(made)}
    found |= {("shaft", side): shaft for side in (0, 1)}
    return found | {("wheel",): of.wheel(drive, wheel, solids.wheel, width, pairs, fineness)}


def _cams(
    wheel: PinWheel, drive: Drivetrain, body: CamBody | None, places: Mapping[int, Position], cams: int, fineness: float, sigma: float
) -> list[Substructure]:
    """Condensed cams; half a turn brings the holes back on each other, so that two opposite cams are one body with its seats exchanged."""
    strips = {
        (i, c): (complex(point), complex(place.contacts.normal[c]))
        for i, place in places.items()
        for c in touched(place)[1]
        for point in [_touching_point(wheel, place, c)]
    }
    outline = wheel.profile.outline() if body else None
    half = cams // 2 if cams % 2 == 0 else cams
    found = []
    for way in cam_phases(cams)[:half]:
        holes = [complex(side * drive.spacing / 2 / way) for side in SIDES]
        made = of.cam(outline, body, holes, strips, sigma, fineness)
        found.append(made if body is None else _undented(made, of.dent(sigma, wheel.pin_radius, body)))
    return found + [_exchanged(body) for body in found[: cams - half]]


def _touching_point(wheel: PinWheel, place: Position, c: int) -> complex:
    """Where contact c touches, seen from cam 0."""
    here = place.contacts
    return here.centre[c] - wheel.pin_radius * here.normal[c] - wheel.eccentricity * np.exp(1j * place.crank)


def _undented(body: Substructure, dent: float) -> Substructure:
    taken = [dent if name[0] == "contact" else 0.0 for name in body.number]
    return body._replace(flexibility=body.flexibility - np.diag(taken))


def _exchanged(body: Substructure) -> Substructure:
    """The body with its seats 0 and 1 named the other way round."""
    return body._replace(number={("seat", 1 - name[1], name[2]) if name[0] == "seat" else name: n for name, n in body.number.items()})


def _coupled(
    bodies: Bodies, drive: Drivetrain, solids: Solids, wheel: PinWheel, place: Position, number: int, model: str, torque: float
) -> tuple[CoupledSolution, dict[str, float], float]:
    """(`CoupledSolution`, {group: compliance [rad/(N m)]}, part of the pins' force that is astray) of one position."""
    links = list(springs(drive, place, number, model == "bonded", solids.wheel is not None))
    if solids.wheel is not None:  # its output does not move along the axis, nor tilt
        links += [InterfaceSpring("output", ((("wheel",), ("flange", motion), 1.0),), 0.0) for motion in (2, 3, 4)]
    found = solve_coupled(bodies, links, (("wheel",), ("flange", 5), torque / wheel.circle_radius))
    pins = found.forces[[link.group == "pin" for link in links]]
    wrong = np.where(np.sign(pins) == np.sign(place.pins[place.pins != 0]), 0.0, np.abs(pins))
    return found, _shares(bodies, drive, links, found, torque), wrong.max() / np.abs(pins).max()


def _shares(bodies: Bodies, drive: Drivetrain, links: Sequence[InterfaceSpring], found: CoupledSolution, torque: float) -> dict[str, float]:
    """Work of springs and bodies over torque^2; of the output shaft, in series, its compliance."""
    shares: dict[str, float] = dict.fromkeys(GROUPS, 0.0)
    for link, force, strain in zip(links, found.forces, found.strains, strict=True):
        shares[link.group] += force * strain / torque**2
    start, _ = functional_offsets(bodies)
    for name, body in bodies.items():
        loads = found.loads[start[name] : start[name] + len(body.flexibility)]
        shares[name[0]] += float(loads @ body.flexibility @ loads) / torque**2
    shares["output"] += 0.0 if drive.wheel_torsion is None else 1 / drive.wheel_torsion
    return shares


# ------------------------------------------------------------------------------------------------------------------- surface


def _deformed(bodies: Bodies, found: Mapping[int, CoupledSolution], count: int) -> DisplacedSurface:
    """`DisplacedSurface` of cam 0, displacements (count, n, 3) [m] relative to its middle, mirrored in its middle plane."""
    body = bodies[("cam", 0)]
    assert body.free is not None  # a solid cam has its mesh
    start, _ = functional_offsets(bodies)
    at = slice(start[("cam", 0)], start[("cam", 0)] + len(body.flexibility))
    fields = [superposed_field(body.fields, each.loads[at]) for each in found.values()]
    surface = body.free.surface("profile|seat.*|bore|side", fields, np.zeros((len(body.free.basis.T), len(fields))))
    whole = with_mirror_images(surface, HALVES)
    displacements = np.full((count, len(whole.points), 3), np.nan)
    displacements[list(found)] = whole.displacements
    return whole._replace(displacements=displacements)


def surface_table(
    solid: SolidStiffness, position: int, name: str = "solid_cam", title: str = "Deformed cam", exaggeration: float | None = None
) -> Table:
    """Table of the deformed cam 0 at one position for a plot of style "mesh": three rows a triangle, without its motion as a whole."""
    surface = solid.surface
    if surface is None:
        raise InputError("solid check: the cam is rigid and has no deformed surface; give it as a solid.")
    displacement = surface.displacements[position]
    factor = exaggeration or exaggeration_for(np.ptp(surface.points[:, 0]), displacement, DRAWN, (1,))
    drawn = (0, "across"), (1, "height"), (2, "along the axis")
    return displaced_table(name, title, surface, displacement, factor, drawn, ((0, "across, unloaded"), (1, "height, unloaded")))
