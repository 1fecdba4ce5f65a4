"""Stress on the skin of an elastic body, raw from the elements behind it (extra `fe`); coefficients of displacement are in millimetres."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from drivewright._typing import Bools, Floats, Ints
from drivewright.fatigue import von_mises
from drivewright.solids.elastic import MM, FreeBody, lame_constants, sampled_triangles


class SkinStress(NamedTuple):
    """points (n, d) [m] on elements of a body's skin, which share none; parts (m, d) of them: triangles, or pieces of a line in the plane;
    stress (L, n, 3, 3) [Pa] of L fields and displacement (L, n, d) [m]."""

    points: Floats
    parts: Ints
    stress: Floats
    displacement: Floats

    @property
    def mises(self) -> Floats:
        """Von Mises stress (L, n) [Pa]."""
        return von_mises(self.stress)


def skin_stress(body: FreeBody, fields: Sequence[Floats], region: str = ".*", parts: int = 1) -> SkinStress:
    """`SkinStress` of coefficients (unknowns,) [mm] on the faces, in the plane the edges, whose names match `region`.

    parts: into how many an element's edge is cut.  Faces inside, where glued pieces meet, are no skin.
    """
    ng, mesh, dim = body.ng, body.mesh, body.mesh.dim
    body.area(region)
    if dim == 3:
        at, pieces = sampled_triangles(ng, mesh, mesh.Boundaries(region), parts)
    else:
        ends = [(float(s),) for s in np.linspace(0, 1, parts + 1)]
        at = mesh.MapToAllElements(ng.IntegrationRule(points=ends, weights=[0.0] * len(ends)), mesh.Boundaries(region))
        first = np.arange(len(ng.CF(1)(at))).reshape(-1, parts + 1)[:, :-1].ravel()
        pieces = np.stack([first, first + 1], axis=1)
    shape = ng.GridFunction(body.space)
    stress, moved = [], []
    for field in fields:
        shape.vec.FV().NumPy()[:] = field
        stress.append(hooke(body, np.asarray(ng.BoundaryFromVolumeCF(ng.Grad(shape))(at)).reshape(-1, dim, dim)))
        moved.append(MM * np.asarray(shape(at)))
    points = MM * np.asarray(ng.CF((ng.x, ng.y, ng.z)[:dim])(at))
    skin = SkinStress(points, pieces, np.array(stress), np.array(moved))
    outside = np.array(
        [len(mesh[(each.faces if dim == 3 else each.edges)[0]].elements) == 1 for each in mesh.Boundaries(region).Elements()]
    )
    return skin if outside.all() else _of_elements(skin, outside)


def _of_elements(skin: SkinStress, kept: Bools) -> SkinStress:
    """The elements (e,) of a skin that are kept; they have equally many points and parts, one element's behind another's."""
    count, size = len(kept), len(skin.points) // len(kept)
    number = np.cumsum(kept) - 1
    parts = skin.parts.reshape(count, -1, skin.parts.shape[1]) + size * (number - np.arange(count))[:, None, None]
    points = np.repeat(kept, size)
    return SkinStress(
        skin.points[points], parts[kept].reshape(-1, skin.parts.shape[1]), skin.stress[:, points], skin.displacement[:, points]
    )


def hooke(body: FreeBody, gradient: Floats) -> Floats:
    """Stress (n, 3, 3) [Pa] of gradients of displacement (n, d, d): 2 mu e + lambda tr(e) I; in plane strain szz = nu (sxx + syy)."""
    shear, volume = lame_constants(body.modulus, body.poisson, body.plane)
    dim = gradient.shape[-1]
    strain = 0.5 * (gradient + np.swapaxes(gradient, 1, 2))
    flat = 2 * shear * strain + volume * np.trace(strain, axis1=1, axis2=2)[:, None, None] * np.eye(dim)
    stress = np.zeros((len(gradient), 3, 3))
    stress[:, :dim, :dim] = flat
    if body.plane and body.plane.state == "strain":
        stress[:, 2, 2] = body.poisson * np.trace(flat, axis1=1, axis2=2)
    return stress
