"""Bodies from STEP files pressed on each other: the contact found, meshed finely and solved by one call (extra `fe`)."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from itertools import combinations
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from drivewright._typing import Bools, Floats
from drivewright.errors import InputError, SolverError, brief
from drivewright.solids.contact.model import ContactModel, ContactState, Functional, Pair
from drivewright.solids.contact.surfaces import Skin, at_nodes, hit_by_rays, middles, skin_of
from drivewright.solids.elastic import MM, FreeBody
from drivewright.solids.engine import EngineObject, fe_module, interruptible, translated_errors
from drivewright.solids.meshing import CURVATURE_SAFETY
from drivewright.solids.stresses import SkinStress, skin_stress
from drivewright.steps import Progress, detailed, note_step

PURPOSE = "contact of solids"
Point: TypeAlias = tuple[float, float, float]

GRADING = 0.3
ROUNDS = 12  # of meshing until the elements of the contact are small enough
FEW = 0.05  # part of a contact's elements that may be larger than that
WIDER = 3.0  # reach within which elements are small: beyond the contact too, for what goes on under its edge
SHRINK = 0.3  # of an element's size, per round
ASKED = 0.7  # of the size wanted, for the mesher's elements turn out larger
LESS = 0.85  # of that, more in every round: on flat faces each mesh is new, and some of its elements are always the larger ones
SLACK = 1.4  # of the size wanted: longest edges
TOUCHING = "(?!fixed|load).*"  # faces that may touch another body
STEP = b"ISO-10303-21"  # the first words of every STEP file
NEAR = 1e-3  # mm: a face so near to a point is the one meant


class SolidBody(NamedTuple):
    """An elastic body from a STEP file (its unit is the millimetre).

    modulus [Pa]; size [m] of its elements away from contacts.  A face is named by a point (x, y, z) [m] on it.  fixed: faces that do not
    move at all; planes: faces on planes of symmetry, which do not leave their plane, with the axis "x", "y" or "z" across it; loads: faces
    that carry a force (x, y, z) [N], spread evenly.
    """

    file: str | Path
    modulus: float
    poisson: float
    size: float
    fixed: Sequence[Point] = ()
    planes: Sequence[tuple[Point, str]] = ()
    loads: Sequence[tuple[Point, tuple[float, float, float]]] = ()


@dataclass(frozen=True, eq=False, repr=False)
class PressedBodies:
    """Bodies pressed on each other; pairs: the names of each two that may touch."""

    state: ContactState
    pairs: tuple[tuple[str, str], ...]
    _skins: dict[str, SkinStress] = field(default_factory=dict)

    def force(self, first: str, second: str) -> Floats:
        """Force (3,) [N] of the second body on the first."""
        number, sign = self._number(first, second)
        return sign * self.state.force(number)

    def area(self, first: str, second: str) -> float:
        """Area that presses [m^2], to about an element's own."""
        return self.state.area(self._number(first, second)[0])

    def pressure(self, first: str, second: str) -> tuple[Floats, Floats]:
        """Points (h, 3) [m] on the contact and pressure (h,) [Pa] there."""
        number, _ = self._number(first, second)
        return MM * self.state.model.pairings[number].places, self.state.pressure[number]

    def traction(self, first: str, second: str) -> tuple[Floats, Floats]:
        """Points (h, 3) [m] on the contact and traction by friction (h, 3) [Pa] of the second body on the first there."""
        number, sign = self._number(first, second)
        pairing, traction = self.state.model.pairings[number], self.state.traction[number]
        along = np.einsum("hk,hkd->hd", traction, pairing.tangents[: len(traction)])
        return MM * pairing.places, -sign * (along if len(along) else np.zeros_like(pairing.places))

    def skin(self, body: str) -> SkinStress:
        """Stress and displacement on a body's skin."""
        if body not in self._skins:
            self._skins[body] = skin_stress(self.state.model.bodies[body], [self.state.displacement(body)])
        return self._skins[body]

    def _number(self, first: str, second: str) -> tuple[int, float]:
        for number, pair in enumerate(self.pairs):
            if set(pair) == {first, second}:
                return number, 1.0 if pair[0] == first else -1.0
        raise InputError(f"contact: {first!r} and {second!r} do not come near each other; there are {self.pairs}")


def press(
    bodies: Mapping[str, SolidBody],
    contact_size: float,
    reach: float,
    *,
    friction: float = 0.0,
    press_fit: bool = False,
    progress: Progress | None = None,
) -> PressedBodies:
    """`PressedBodies` of two or more `SolidBody`s: small displacements, surfaces that press and do not pull.

    contact_size [m]: of the elements where bodies come nearer than `reach` [m], the largest gap that may close; half the contact's width at
    most, a tenth of it for a pressure right to about 1 %.  friction: Coulomb's coefficient, with all loads applied at once.  press_fit: an
    overlap before any load is meant.  `progress(done, total, what)` is called, with 0 of 1, as bodies are meshed and condensed: `what` says
    how far that is.
    """
    _refuse_text("contact", contact_size=contact_size, reach=reach, friction=friction)
    if not (contact_size > 0 and reach > 0):
        raise InputError(f"contact: contact_size {contact_size:g} m and reach {reach:g} m; both must be above 0")
    if len(bodies) < 2:
        raise InputError(f"contact: {len(bodies)} bodies; give two or more")
    for name, body in bodies.items():
        if wrong := [axis for _, axis in body.planes if axis not in ("x", "y", "z")]:
            raise InputError(f"contact: a plane of symmetry of {name!r} has the axis {wrong[0]!r}; give 'x', 'y' or 'z', the one across it")
    if not friction >= 0:
        raise InputError(f"contact: a coefficient of friction of {friction:g}; it must be 0 or more")
    if progress is None:
        return _pressed(bodies, contact_size, reach, friction, press_fit)
    with detailed(progress) as step:
        step(0, 1, "pressing")
        return _pressed(bodies, contact_size, reach, friction, press_fit)


# ---------------------------------------------------------------------------------------------------------------------- pieces


def _pressed(bodies: Mapping[str, SolidBody], contact_size: float, reach: float, friction: float, press_fit: bool) -> PressedBodies:
    shapes = {name: _named(name, body) for name, body in bodies.items()}
    meshes = _meshes(shapes, bodies, contact_size / MM, reach / MM)
    free = {name: _free(meshes[name], body) for name, body in bodies.items()}
    near = [pair for pair in combinations(bodies, 2) if shapes[pair[0]].Distance(shapes[pair[1]]) <= reach / MM]
    if not near:
        gap = min(MM * one.Distance(other) for one, other in combinations(shapes.values(), 2))
        raise InputError(
            f"contact: no two bodies come nearer than the reach of {1e3 * reach:.4g} mm; the smallest gap is {1e3 * gap:.4g} mm"
        )
    pairs = [
        Pair((first, TOUCHING), (second, TOUCHING), reach, press_fit=press_fit, friction=friction, label=f"{first!r} at {second!r}")
        for first, second in near
    ]
    loads = {
        f"{name} {number}": Functional(name, free[name].mean(f"load{number}", np.array(force) / np.linalg.norm(force)))
        for name, body in bodies.items()
        for number, (_, force) in enumerate(body.loads)
    }
    amounts = {f"{name} {n}": float(np.linalg.norm(force)) for name, body in bodies.items() for n, (_, force) in enumerate(body.loads)}
    return PressedBodies(ContactModel(free, pairs, [], loads).solve(amounts), tuple(near))


def _named(name: str, body: SolidBody) -> EngineObject:
    """Shape [mm] of a file with its faces named."""
    occ, path = fe_module("netgen.occ", PURPOSE), Path(body.file)
    if not path.is_file():
        raise InputError(f"contact: no file {str(path)!r} for the body {name!r}; give the path of a STEP file")
    _refuse_text(f"contact: {name!r}", modulus=body.modulus, poisson=body.poisson, size=body.size)
    if not (body.size > 0 and body.modulus > 0 and -1 < body.poisson < 0.5):
        raise InputError(
            f"contact: {name!r} has elements of {body.size:g} m, a modulus of {body.modulus:g} Pa and Poisson's ratio {body.poisson:g}; "
            "the first two must be above 0, the last between -1 and 0.5"
        )
    unreadable = f"contact: {path.name!r} cannot be read as a STEP file"
    with path.open("rb") as file:
        if STEP not in file.read(1000):
            raise InputError(f"{unreadable}: it does not begin with {STEP.decode()}; export the body as STEP AP214 or AP242")
    with translated_errors(InputError, unreadable, "export it again as AP214 or AP242", PURPOSE):
        shape = occ.OCCGeometry(str(path)).shape
    if len(shape.solids) != 1:
        raise InputError(f"contact: {path.name!r} holds {len(shape.solids)} solids; a body takes one. Fuse them, or give each its own file")
    for face in shape.faces:
        face.name = "skin"
    for words, points in (
        ("fixed", body.fixed),
        *((f"plane{axis}", [point for point, own in body.planes if own == axis]) for axis in "xyz"),
        *((f"load{number}", [point]) for number, (point, _) in enumerate(body.loads)),
    ):
        for point in points:
            _face_at(occ, shape, point, name).name = words
    return shape


def _refuse_text(where: str, **numbers: object) -> None:
    """InputError for a quantity that is no number, such as "2 mm": this call takes SI numbers."""
    for name, value in numbers.items():
        if not isinstance(value, (int, float, np.number)):
            raise InputError(f"{where}: {name} is {brief(value)}; give a number in SI units, such as 2e-3 for 2 mm or 206e9 for 206 GPa")


def _face_at(occ: EngineObject, shape: EngineObject, point: Point, name: str) -> EngineObject:
    spot = occ.Vertex(occ.Pnt(*(float(c) / MM for c in point)))
    gaps = [face.Distance(spot) for face in shape.faces]
    least = int(np.argmin(gaps))
    if gaps[least] > NEAR:
        raise InputError(
            f"contact: no face of {name!r} lies at ({', '.join(f'{1e3 * c:.5g}' for c in point)}) mm; "
            f"the nearest is {gaps[least]:.4g} mm away"
        )
    return shape.faces[least]


def _free(mesh: EngineObject, body: SolidBody) -> FreeBody:
    """The body, held on its fixed faces and planes of symmetry."""
    held = {axis: ["fixed"] if body.fixed else [] for axis in "xyz"}
    for _, axis in body.planes:
        held[axis].append(f"plane{axis}")
    symmetry: Any = {f"dirichlet{axis}": "|".join(sorted(set(names))) for axis, names in held.items() if names}
    return FreeBody(mesh, body.modulus, body.poisson, None, **symmetry)


def _meshes(shapes: Mapping[str, EngineObject], bodies: Mapping[str, SolidBody], fine: float, reach: float) -> dict[str, EngineObject]:
    """Meshes [mm] with elements of the size `fine` wherever two bodies come nearer than `reach`: meshed again until they are."""
    ng, occ, netgen = (fe_module(module, PURPOSE) for module in ("ngsolve", "netgen.occ", "netgen.meshing"))
    ng.ngsglobals.msg_level = 0
    wanted: dict[str, list[tuple[Floats, float]]] = {name: [] for name in shapes}
    for number in range(ROUNDS):
        meshes = {}
        for name, shape in shapes.items():
            note_step(f"meshing {name}, round {number + 1}")
            sizes = netgen.MeshingParameters(maxh=bodies[name].size / MM, grading=GRADING, curvaturesafety=CURVATURE_SAFETY)
            for point, size in wanted[name]:
                sizes.RestrictH(*map(float, point), h=float(size))
            advice = "look for very small faces, or give a larger size"
            with translated_errors(SolverError, f"contact: the mesher gave up on {name!r}", advice, PURPOSE):
                meshes[name] = interruptible(partial(_curved_mesh, ng, occ.OCCGeometry(shape), sizes))
        skins = {name: skin_of(mesh, ".*") for name, mesh in meshes.items()}
        more = {name: _too_large(name, skins, fine, reach, ASKED * LESS**number) for name in shapes}
        if not any(len(places) for places, _ in more.values()):
            return meshes
        for name, (places, size) in more.items():
            wanted[name] += list(zip(places, size, strict=True))
    raise SolverError(
        f"contact: elements of {fine:.3g} mm were not reached in {ROUNDS} rounds of meshing; give a larger contact_size or reach"
    )


def _curved_mesh(ng: EngineObject, geometry: EngineObject, sizes: EngineObject) -> EngineObject:
    return ng.Mesh(geometry.GenerateMesh(mp=sizes)).Curve(2)


def _too_large(name: str, skins: Mapping[str, Skin], fine: float, reach: float, asked: float) -> tuple[Floats, Floats]:
    """Places (n, 3) and sizes (n,) [mm], `asked` of the size wanted at least, for elements of a skin near another that are larger."""
    own = skins[name]
    near = np.any([_may_touch(own, skin, reach) for other, skin in skins.items() if other != name], axis=0)
    chosen = near & (own.size > SLACK * fine)
    if chosen.sum() <= FEW * near.sum():
        chosen[:] = False
    return middles(own)[0][chosen], np.maximum(SHRINK * own.size[chosen], asked * fine)


def _may_touch(own: Skin, other: Skin, reach: float) -> Bools:
    """Elements (e,) whose gap, carried on from its nodes, may come within reach [mm]."""
    points, normal = at_nodes(own)
    gap = hit_by_rays(other, points.reshape(-1, 3), normal.reshape(-1, 3)).distance.reshape(points.shape[:2])
    least = gap.min(axis=1)
    largest = np.where(np.isfinite(gap), gap, -np.inf).max(axis=1)
    return np.isfinite(least) & (2 * least - largest <= WIDER * reach)
