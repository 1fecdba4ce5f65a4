"""Von Mises stress on the deformed bodies of an indexer as `SurfaceFields`, at the positions where cam, wheel and shaft bear most.

A contact presses on a strip of the cam whose width is a choice, and bearings on the mean displacement of their seats: stress right beneath
a contact is Hertz's and left out, stress in the seats and in the sharp corners of the meshes is that of the model.
"""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from drivewright._typing import Bools, Complexes, Floats, Ints
from drivewright.indexing.drivetrain import SIDES, Drivetrain
from drivewright.indexing.solid.bodies import STIFFENED
from drivewright.indexing.solid.condensation import Bodies
from drivewright.indexing.solid.springs import Position
from drivewright.indexing.solid.surfaces import CAM_FACES
from drivewright.indexing.stiffness.assembly import cam_phases
from drivewright.solids.coupling import BodyName, CoupledSolution, functional_offsets
from drivewright.solids.deformation import exaggeration_for
from drivewright.solids.elastic import superposed_field
from drivewright.solids.stresses import skin_stress
from drivewright.surface_fields import ScalarField, SurfaceBody, SurfaceFields, kept_steps, single

STEPS = 3  # positions that are kept
DRAWN = 0.02  # of the size of the largest body: the largest displacement as drawn
BESIDE = 5.0  # widths of its strip beside a loaded contact that are left out
MISSING = "not evaluated beside a loaded contact, where the Hertz pressure acts"
NOTES = (
    "stress on a cam is not given within a pin radius of a loaded contact, where the Hertz pressure of the pin acts",
    "bearings and pins load the mean displacement of their seats, and corners are sharp, so stress there depends on the mesh",
    "displacements are drawn without the motion of each body as a whole",
)


WHEEL: BodyName = ("wheel",)


class Loaded(NamedTuple):
    """A position in equilibrium, and the points [m] of each cam where a contact presses, in the cam's own frame."""

    place: Position
    coupled: CoupledSolution
    pressed: tuple[Complexes, ...]


def stress_fields(
    drive: Drivetrain, bodies: Bodies, loaded: Sequence[Loaded], eccentricity: float, cams: int, strip: float
) -> SurfaceFields:
    """`SurfaceFields` "assembly" of all solids among the bodies, displacements without each body's motion as a whole.

    strip: width sigma [m] of a contact on a cam.
    """
    solids = [key for key, body in bodies.items() if body.free is not None and key[0] in PLACES]
    found = [_body(key, drive, bodies, loaded, eccentricity, cams, strip) for key in solids]
    greatest = {body.name: np.nanmax(body.fields[0].values, axis=1) for body in found}
    steps = kept_steps(len(loaded), [int(sizes.argmax()) for sizes in greatest.values()], STEPS)
    kept = tuple(_of_steps(body, steps) for body in found)
    moved = np.concatenate([body.displacements.reshape(-1, 3) for body in kept]).astype(float)
    scale = exaggeration_for(max(float(np.ptp(body.points, axis=0).max()) for body in kept), moved, DRAWN)
    labels = tuple(f"input at {np.degrees(abs(loaded[step].place.crank)):.4g}°" for step in steps)
    worst = int(max(range(len(steps)), key=lambda n: greatest[kept[0].name][steps[n]]))
    return SurfaceFields("assembly", "Cams, shafts and wheel as solids", labels, worst, kept, scale, NOTES)


def _body(
    key: BodyName, drive: Drivetrain, bodies: Bodies, loaded: Sequence[Loaded], eccentricity: float, cams: int, strip: float
) -> SurfaceBody:
    body, (start, _) = bodies[key], functional_offsets(bodies)
    free, at = body.free, slice(start[key], start[key] + len(body.flexibility))
    assert free is not None  # a solid has its mesh
    is_cam = key[0] == "cam"
    vectors = [superposed_field(body.fields, each.coupled.loads[at]) for each in loaded]
    region = CAM_FACES if is_cam else ".*"
    skin = skin_stress(free, [vector.FV().NumPy() for vector in vectors], region)
    mises = skin.mises / (STIFFENED if is_cam else 1)  # half a cam carries the whole force on twice the modulus
    if is_cam:
        flat = skin.points[:, 0] + 1j * skin.points[:, 1]
        for row, each in zip(mises, loaded, strict=True):
            near = _near(flat, each.pressed[key[1]], BESIDE * strip)
            row[skin.parts[near[skin.parts].any(axis=1)]] = np.nan  # elements as a whole
    places = np.array([PLACES[key[0]](key, drive, each.place, eccentricity * cam_phases(cams)) for each in loaded])
    fields = (ScalarField("mises", "Pa", "Von Mises stress", single(mises), missing=MISSING if is_cam else ""),)
    name, label = "_".join(map(str, key)), " ".join([str(key[0]), *(str(number + 1) for number in key[1:])]).capitalize()
    return SurfaceBody(name, label, skin.points, skin.parts, single(skin.displacement), fields, places, is_cam, key == WHEEL)


def _near(points: Complexes, pressed: Complexes, reach: float) -> Bools:
    """Which points (n,) lie within `reach` [m] of one of those that are pressed (k,)."""
    return (np.abs(points[:, None] - pressed).min(axis=1, initial=np.inf)) < reach


def _of_steps(body: SurfaceBody, steps: Ints) -> SurfaceBody:
    fields = tuple(each._replace(values=each.values[steps]) for each in body.fields)
    places = None if body.places is None else body.places[steps]
    return body._replace(displacements=body.displacements[steps], fields=fields, places=places)


def _cam_place(key: BodyName, drive: Drivetrain, place: Position, throws: Complexes) -> tuple[float, ...]:
    """A cam moves on a circle without turning; cam j is cam 0 turned by its phase."""
    centre = throws[key[1]] * np.exp(1j * place.crank)
    height = drive.shaft.cams[key[1]] if drive.shaft else 0.0
    return centre.real, centre.imag, height, float(np.angle(throws[key[1]]))


def _shaft_place(key: BodyName, drive: Drivetrain, place: Position, throws: Complexes) -> tuple[float, ...]:
    return SIDES[key[1]] * drive.spacing / 2, 0.0, 0.0, place.crank


def _wheel_place(key: BodyName, drive: Drivetrain, place: Position, throws: Complexes) -> tuple[float, ...]:
    return 0.0, 0.0, 0.0, place.wheel


PLACES = {"cam": _cam_place, "shaft": _shaft_place, "wheel": _wheel_place}


def pressed_points(points: Mapping[int, complex], forces: Floats, kept: Sequence[int]) -> tuple[Complexes, ...]:
    """For each cam the points [m] of its loaded contacts: points {contact: of cam 0}, forces (cams, k) [N] of k contacts."""
    return tuple(np.array([points[c] for c in kept if row[c] > 0], complex) for row in forces)
