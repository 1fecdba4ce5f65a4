"""Every body of a pin-wheel indexer condensed to the loads on its interfaces, a `Substructure`."""

from collections.abc import Mapping, Sequence
from typing import TypeAlias

import numpy as np

from drivewright._typing import Floats
from drivewright.contact import gaussian_strip_approach
from drivewright.indexing.drivetrain import SIDES, Drivetrain, SplitShaft
from drivewright.indexing.pin_wheel import PinWheel
from drivewright.indexing.solid import meshes
from drivewright.indexing.solid.parts import CamBody, ShaftBody, WheelBody
from drivewright.indexing.stiffness.assembly import cam_phases
from drivewright.indexing.stiffness.layout import bending_flexibility, torsion_flexibility
from drivewright.scene import Outline
from drivewright.solids.elastic import FreeBody
from drivewright.solids.substructures import (
    ALL,
    NO_AXIAL,
    PLANAR,
    InterfaceLoad,
    Substructure,
    elastic_substructure,
    radial_loads,
    rigid_substructure,
)

ContactKey: TypeAlias = tuple[int, int]  # position, number of the contact
Strip: TypeAlias = tuple[complex, complex]  # point [m] on the profile, normal

STIFFENED = 2  # times as stiff as it is, half a cam carries the whole force
TURN_RADIUS = 0.01  # m: at which the rotation of a gear's seat counts as a displacement


# ----------------------------------------------------------------------------------------------------------------------- cam


def cam(
    outline: Outline | None,
    body: CamBody | None,
    holes: Sequence[complex],
    strips: Mapping[ContactKey, Strip],
    sigma: float,
    fineness: float,
) -> Substructure:
    """Condensed cam in its own frame: ("seat", side, axis) at the complex hole centres, ("contact", *key) of strips {key: (point, normal)}.

    point complex [m] on the profile, normal the direction of the displacement, out of the cam.
    """
    places = cam_places(holes, strips)
    if body is None or outline is None:
        return rigid_substructure(places, PLANAR)
    mesh = meshes.cam_mesh(outline, body, holes, sigma, fineness)
    free = FreeBody(mesh, STIFFENED * body.modulus, body.poisson, dirichletz="middle")
    functionals = [free.mean(f"seat{side}", np.eye(3)[axis]) for side in (0, 1) for axis in (0, 1)]
    functionals += [free.gaussian_strip("profile", point, normal, sigma) for point, normal in strips.values()]
    return elastic_substructure(free, functionals, places, PLANAR, "the cam")


def cam_holes(spacing: float, cams: int) -> list[list[complex]]:
    """Centres [m] of both holes of each cam in its own frame, `spacing` [m] apart; of an even number those of the first half.

    Half a turn brings the holes back on each other, so that two opposite cams are one body with its seats exchanged.
    """
    count = cams // 2 if cams % 2 == 0 else cams
    return [[complex(side * spacing / 2 / way) for side in SIDES] for way in cam_phases(cams)[:count]]


def cam_places(holes: Sequence[complex], strips: Mapping[ContactKey, Strip]) -> list[InterfaceLoad]:
    """Interface loads of a cam: its two seats along x and y, then each contact along its normal."""
    seats = [place for side, c in enumerate(holes) for place in radial_loads(("seat", side), (c.real, c.imag, 0.0))]
    contacts = [
        InterfaceLoad(("contact", *key), np.array([n.real, n.imag, 0.0]), np.array([0.0, 0.0, (p.conjugate() * n).imag]))
        for key, (p, n) in strips.items()
    ]
    return seats + contacts


def strip_compliance(sigma: float, depth: float, body: CamBody) -> float:
    """Approach [m/N] of a Gaussian strip over the cam's whole thickness to the `depth` [m] under it."""
    return float(gaussian_strip_approach(sigma, depth, body.modulus, body.poisson)) / body.thickness


# --------------------------------------------------------------------------------------------------------------------- shaft


def shaft(drive: Drivetrain, body: ShaftBody | None, throws: Sequence[complex], fineness: float) -> Substructure:
    """Condensed split shaft, its axis at the origin and its crank pins at the complex `throws`.

    ("support", end, axis), ("crank", j, axis), ("gear", axis), and ("gear", "turn"): the rotation of the gear's seat times TURN_RADIUS.
    """
    places = shaft_places(drive.shaft, throws)
    if body is None or drive.shaft is None:
        return rigid_substructure(places, NO_AXIAL)._replace(flexibility=beam_flexibility(drive.shaft, places))
    mesh, faces = meshes.shaft_mesh(drive.shaft, body, throws, fineness)
    free = FreeBody(mesh, drive.shaft.modulus, drive.shaft.poisson)
    functionals = [free.mean(faces[place.name[:-1]], place.force) for place in places[:-1]]
    functionals.append(free.mean_rotation(faces[("gear",)], 2, TURN_RADIUS))
    return elastic_substructure(free, functionals, places, NO_AXIAL, "the split shaft")


def shaft_places(shaft: SplitShaft | None, throws: Sequence[complex]) -> list[InterfaceLoad]:
    """A rigid shaft without measures stands on its front support, as in the reduced model."""
    supports, cams, gear = (shaft.supports, shaft.cams, shaft.gear) if shaft else ((0.0, 1.0), [0.0] * len(throws), 0.0)
    places = [place for end, z in enumerate(supports) for place in radial_loads(("support", end), (0.0, 0.0, z))]
    for j, (z, c) in enumerate(zip(cams, throws, strict=True)):
        places += radial_loads(("crank", j), (c.real, c.imag, z))
    places += radial_loads(("gear",), (0.0, 0.0, gear))
    return [*places, InterfaceLoad(("gear", "turn"), np.zeros(3), np.array([0.0, 0.0, TURN_RADIUS]))]


def beam_flexibility(shaft: SplitShaft | None, places: Sequence[InterfaceLoad]) -> Floats:
    """(n, n) of the reduced model's beam and rod: bending against the supports, torsion against the gear."""
    found = np.zeros((len(places), len(places)))
    if shaft is None:
        return found
    names = [("gear",), *(("crank", j) for j in range(len(shaft.cams)))]
    bending = bending_flexibility(shaft)
    for axis in (0, 1):
        at = [n for name in names for n, place in enumerate(places) if place.name == (*name, axis)]
        found[np.ix_(at, at)] += bending
    torsion = torsion_flexibility(shaft)
    cranks = {n: place for n, place in enumerate(places) if place.name[0] == "crank"}
    for n, first in cranks.items():
        for m, second in cranks.items():
            found[n, m] += first.moment[2] * torsion[first.name[1], second.name[1]] * second.moment[2]
    return found


# --------------------------------------------------------------------------------------------------------------------- wheel


def wheel(
    drive: Drivetrain, wheel: PinWheel, body: WheelBody | None, width: float | None, touched: Sequence[tuple[int, int]], fineness: float
) -> Substructure:
    """Condensed pin wheel with pin 0 on the x axis: ("pin", k, j, axis) for `touched` (k, j), and ("flange", motion) of its output.

    Rotations of the flange are times the radius of the pin circle.
    """
    heights = drive.shaft.cams if drive.shaft else None
    radius = wheel.circle_radius
    if body is None or heights is None or width is None:
        return rigid_substructure(wheel_places(wheel, np.zeros(wheel.pins), touched, 0.0), PLANAR)
    places = wheel_places(wheel, heights, touched, meshes.flange_height(body, heights))
    free = FreeBody(meshes.wheel_mesh(wheel, body, heights, width, fineness), body.modulus, body.poisson)
    functionals = [free.mean(f"pin{place.name[1]}_{place.name[2]}", place.force) for place in places if place.name[0] == "pin"]
    functionals += [free.mean("flange", along) for along in np.eye(3)]
    functionals += [free.mean_rotation("flange", axis, radius) for axis in (0, 1, 2)]
    return elastic_substructure(free, functionals, places, ALL, "the pin wheel")


def wheel_places(
    wheel: PinWheel, heights: Sequence[float] | Floats, touched: Sequence[tuple[int, int]], flange: float
) -> list[InterfaceLoad]:
    """Interface loads of the wheel: each touched pin (k, j) at the height of cam j along x and y, then the motions of the flange."""
    middles = wheel.circle_radius * np.exp(2j * np.pi * np.arange(wheel.pins) / wheel.pins)
    places = [place for k, j in touched for place in radial_loads(("pin", k, j), (middles[k].real, middles[k].imag, heights[j]))]
    places += [InterfaceLoad(("flange", n), along, np.cross((0.0, 0.0, flange), along)) for n, along in enumerate(np.eye(3))]
    return [*places, *(InterfaceLoad(("flange", 3 + n), np.zeros(3), wheel.circle_radius * along) for n, along in enumerate(np.eye(3)))]
