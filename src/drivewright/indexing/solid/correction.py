"""The elasticity of the bodies as an option of the lumped model: condensed once, for any torque and position.

Every contact gets the compliance that cam and pin have under it alone, along the profile by interpolation, in series with its line contact;
the beams of the split shafts shear (Cowper), and have the seats of their bearings.  What is left out against the assembly: what the other
contacts do to a body, and the webs of the cranks.
"""

from collections.abc import Sequence

import numpy as np

from drivewright._typing import Complexes, Floats
from drivewright.errors import InputError
from drivewright.indexing.body_compliance import BodyCompliance
from drivewright.indexing.drivetrain import Drivetrain
from drivewright.indexing.pin_wheel import PinWheel
from drivewright.indexing.solid import bodies as of
from drivewright.indexing.solid.condensation import STRIP
from drivewright.indexing.solid.parts import Solids, check, seated
from drivewright.shafts import COWPER
from drivewright.solids.elastic import Response, spring_supported
from drivewright.solids.substructures import InterfaceName, Substructure

SPACING = 0.5  # of the nodes along the profile, in radii of a pin


def elastic_train(
    wheel: PinWheel,
    drive: Drivetrain,
    solids: Solids,
    *,
    cams: int = 2,
    fineness: float = 1.0,
    strip: float = STRIP,
    spacing: float = SPACING,
) -> Drivetrain:
    """The `Drivetrain` whose contacts and shafts also yield as the `Solids` do; what is None there stays as it is.

    fineness: factor on all element sizes; strip: width sigma of a contact on the cam, spacing: of the nodes, both in radii of a pin.
    """
    check(solids, wheel, drive, cams)
    if drive.pins is None or drive.pins.line is None:
        raise InputError("elastic bodies: their compliance is in series with a line contact; give the drive train one (`pin_contact`).")
    points, normals = profile_nodes(wheel, spacing * wheel.pin_radius)
    own = BodyCompliance(
        wheel.pin_radius,
        points,
        normals,
        _cam_compliance(wheel, drive, solids, points, normals, cams, fineness, strip * wheel.pin_radius),
        _pin_compliance(wheel, drive, solids, cams, fineness),
    )
    shaft = seated(drive.shaft, solids.shaft)
    if shaft is not None and solids.shaft is not None:
        shaft = shaft._replace(shear=COWPER)
    return drive._replace(shaft=shaft, bodies=own)


def profile_nodes(wheel: PinWheel, spacing: float) -> tuple[Complexes, Complexes]:
    """(points, normals out of the cam) in equal steps of about `spacing` [m] along the profile, complex, on its chords."""
    nodes = wheel.nodes
    chord = nodes.b - nodes.a
    along = np.cumsum(np.abs(chord))
    count = int(np.ceil(along[-1] / spacing))
    place = (np.arange(count) + 0.5) * along[-1] / count
    at = np.searchsorted(along, place)
    back = (along[at] - place) / np.abs(chord[at])
    outwards = -1j * wheel.orientation * (1.0 if wheel.side == "inside" else -1.0)
    return nodes.b[at] - back * chord[at], outwards * (chord / np.abs(chord))[at]


def _cam_compliance(
    wheel: PinWheel, drive: Drivetrain, solids: Solids, points: Complexes, normals: Complexes, cams: int, fineness: float, sigma: float
) -> Floats:
    """(cams, n) [m/N] along the normals at the nodes, the seats held and without the dent; opposite cams are alike."""
    if solids.cam is None:
        return np.zeros((cams, len(points)))
    strips = {(0, n): (complex(point), complex(normal)) for n, (point, normal) in enumerate(zip(points, normals, strict=True))}
    found, outline = [], wheel.profile.outline()
    for holes in of.cam_holes(drive.spacing, cams):
        body = of.cam(outline, solids.cam, holes, strips, sigma, fineness)
        own = held(body, [("seat", side, axis) for side in (0, 1) for axis in (0, 1)], [("contact", *key) for key in strips])
        found.append(np.maximum(np.diagonal(own) - of.strip_compliance(sigma, wheel.pin_radius, solids.cam), 0.0))
    return np.array(found + found[: cams - len(found)])


def _pin_compliance(wheel: PinWheel, drive: Drivetrain, solids: Solids, cams: int, fineness: float) -> Floats:
    """(cams, 2, 2) [m/N] of pin 0, which lies on the x axis, the flange held; without a solid wheel the spring behind the contact."""
    if solids.wheel is None or solids.cam is None:
        series = None if drive.pins is None else drive.pins.series
        return np.tile(np.zeros((2, 2)) if series is None else np.eye(2) / series, (cams, 1, 1))
    body = of.wheel(drive, wheel, solids.wheel, solids.cam.thickness, [(0, j) for j in range(cams)], fineness)
    flange: list[InterfaceName] = [("flange", motion) for motion in range(6)]
    return np.array([held(body, flange, [("pin", 0, j, axis) for axis in (0, 1)]) for j in range(cams)])


def held(body: Substructure, fixed: Sequence[InterfaceName], loaded: Sequence[InterfaceName]) -> Floats:
    """Flexibility [m/N] of the loaded functionals of a body while the fixed ones do not move."""
    at = [body.number[name] for name in (*fixed, *loaded)]
    response = Response(body.flexibility[np.ix_(at, at)], body.resultants[:, at], ())
    return spring_supported(response, np.full(len(fixed), np.inf)).flexibility
