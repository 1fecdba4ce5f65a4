"""Two skins that may press on each other: hat functions of pressure on the one, what they do on both, and the gap between.

The pressure is linear between the corners of the first skin's elements and acts along normals midway between those of both skins, at points
of the second that rays along these normals meet: force and moment on both bodies are equal and opposite.  With u the displacements the hat
i weighs the gap

    g_i = int h_i (g0 - (u_first - u_second) . n) dA.
"""

from collections.abc import Callable
from typing import NamedTuple, TypeAlias

import numpy as np
import scipy

from drivewright._typing import Bools, Floats, Ints
from drivewright.errors import InputError
from drivewright.solids.contact import surfaces
from drivewright.solids.contact.condensing import Rows
from drivewright.solids.contact.surfaces import Skin

ALONG = 6  # Gauss points along an edge, and in both directions of a triangle
LEAST = 0.05  # of the area of a hat, within reach, below which the hat is left out
OVERLAP = 2e-3  # of the size of an element: what the elements' own shape may overlap

GapOf: TypeAlias = Callable[[Floats, Floats], Floats]  # (points (n, d) [mm], normals (n, d)) -> what is added to the gap (n,) [mm]


class Pairing(NamedTuple):
    """h hats of pressure between a first and a second skin.

    corners (h,): numbers of the first skin's nodes; places (h, d) of them; area (h,) [mm^2] and gap (h,) [mm^3] of the hats; first,
    second (h, d nodes): the functionals int h u.n of either body; tangents (h, d - 1, d) at right angles to n, and the
    functionals int h u.t of either body along them, first_along, second_along (h (d - 1), d nodes).  weights (h, q): of the integrals over
    q points (q, d), which lie `apart` (q,) [mm] from the second body as meshed, along the normals `outward`.
    """

    corners: Ints
    places: Floats
    area: Floats
    gap: Floats
    first: Rows
    second: Rows
    tangents: Floats
    first_along: Rows
    second_along: Rows
    weights: Rows
    points: Floats
    outward: Floats
    apart: Floats

    def gap_with(self, more: GapOf) -> Floats:
        """Gap (h,) [mm^3] of the hats with something else added to the meshes' own."""
        return self.weights @ (self.apart + more(self.points, self.outward))


def paired(
    first: Skin, second: Skin, nodes: tuple[int, int], reach: float, depth: float = 1.0, more: GapOf | None = None, press_fit: bool = False
) -> Pairing:
    """`Pairing` of two skins whose bodies have so many nodes; reach [mm]: the largest gap that may close; depth [mm] of a flat body.

    `more` adds to the gap, say a clearance or a rounded edge that the mesh does not have.  InputError where nothing faces within reach, or
    where the bodies overlap and it is no press fit.
    """
    local, weight = gauss(first.places.shape[2])
    element = np.repeat(np.arange(len(first.nodes)), len(local))
    spot, weights = np.tile(local, (len(first.nodes), 1)), np.tile(weight, len(first.nodes))
    points, normal, stretch = surfaces.normals(first, element, spot)
    normal = _midway(normal, surfaces.hit_by_rays(second, points, normal))
    hits = surfaces.hit_by_rays(second, points, normal)
    gap = np.where(np.isfinite(hits.distance), hits.distance, np.inf)
    if more is not None:
        gap = gap + more(points, normal)
    met = (hits.element >= 0) & (gap <= reach)
    _refuse_apart(met, hits.distance, reach)
    if not press_fit:
        _refuse_overlap(gap, points, first.size[element])
    area = depth * stretch * weights
    hat = surfaces.hats(spot)
    whole = np.bincount(first.corners[element].ravel(), (hat * area[:, None]).ravel(), nodes[0])
    part: Floats = np.bincount(first.corners[element[met]].ravel(), (hat * area[:, None])[met].ravel(), nodes[0]).astype(float)
    corners = np.flatnonzero(part > LEAST * np.where(whole > 0, whole, np.inf))
    row = np.full(nodes[0], -1)
    row[corners] = np.arange(len(corners))
    at, dim = np.flatnonzero(met), points.shape[1]
    owner, amount = row[first.corners[element[at]]], hat[at] * area[at, None]
    used = owner >= 0
    quadrature = Rows(
        (amount[used], (owner[used], np.broadcast_to(np.arange(len(at))[:, None], owner.shape)[used])), shape=(len(corners), len(at))
    )
    own = surfaces.shape_functions(spot[at], dim)
    place = np.zeros((nodes[0], dim))
    place[first.corners] = first.places[:, :dim]
    across = _tangents(quadrature @ normal[at])
    return Pairing(
        corners,
        place[corners],
        part[corners],
        quadrature @ gap[at],
        quadrature @ _normal_rows(own, first.nodes[element[at]], normal[at], nodes[0]),
        quadrature @ _normal_rows(hits.shape[at], second.nodes[hits.element[at]], normal[at], nodes[1]),
        across,
        _along_rows(quadrature @ _value_rows(own, first.nodes[element[at]], nodes[0]), across),
        _along_rows(quadrature @ _value_rows(hits.shape[at], second.nodes[hits.element[at]], nodes[1]), across),
        quadrature,
        points[at],
        normal[at],
        hits.distance[at],
    )


def gauss(dim: int) -> tuple[Floats, Floats]:
    """Points (n, d - 1) and weights (n,) on an edge, or on a triangle by Gauss points of a square with one side drawn together."""
    node, weight = np.polynomial.legendre.leggauss(ALONG)
    node, weight = (1 + node) / 2, weight / 2
    if dim == 2:
        return node[:, None], weight
    x, y = np.meshgrid(node, node, indexing="ij")
    points = np.stack([x.ravel(), (y * (1 - x)).ravel()], axis=1)
    return points, (np.outer(weight, weight) * (1 - x)).ravel()


# ---------------------------------------------------------------------------------------------------------------------- pieces


def _midway(normal: Floats, hits: surfaces.Hits) -> Floats:
    """Unit normals (n, d) midway between those of a first skin and those of a second that their rays hit, where they do."""
    both = normal - hits.normal
    return both / np.linalg.norm(both, axis=1, keepdims=True)


def _normal_rows(shape: Floats, nodes: Ints, normal: Floats, count: int) -> Rows:
    """Matrix (n, d count) that takes displacements of nodes to u.n at n points."""
    return Rows(scipy.sparse.hstack([_value_rows(shape * normal[:, [axis]], nodes, count) for axis in range(normal.shape[1])]))


def _value_rows(shape: Floats, nodes: Ints, count: int) -> Rows:
    """Matrix (n, count) that takes values at nodes to n points."""
    rows = np.broadcast_to(np.arange(len(shape))[:, None], shape.shape)
    return Rows((shape.ravel(), (rows.ravel(), nodes.ravel())), shape=(len(shape), count))


def _along_rows(values: Rows, across: Floats) -> Rows:
    """Matrix (h k, d nodes) that takes displacements of nodes to those of hats along their k tangents (h, k, d)."""
    count, ways, dim = across.shape
    several = Rows(scipy.sparse.kron(values, np.ones((ways, 1))))
    flat = across.reshape(count * ways, dim)
    return Rows(scipy.sparse.hstack([several.multiply(flat[:, [axis]]) for axis in range(dim)]))


def _tangents(normal: Floats) -> Floats:
    """Unit vectors (h, d - 1, d) at right angles to vectors (h, d) and to each other."""
    normal = normal / np.linalg.norm(normal, axis=1, keepdims=True)
    if normal.shape[1] == 2:
        return np.stack([-normal[:, 1], normal[:, 0]], axis=1)[:, None]
    one: Floats = np.cross(normal, np.eye(3)[np.abs(normal).argmin(axis=1)])
    one /= np.linalg.norm(one, axis=1, keepdims=True)
    other: Floats = np.cross(normal, one)
    return np.stack([one, other], axis=1)


def _refuse_apart(met: Bools, distance: Floats, reach: float) -> None:
    if not met.any():
        least = np.abs(distance).min()
        found = (
            f"the nearest points that face each other are {least:.4g} mm apart" if np.isfinite(least) else "no two points face each other"
        )
        raise InputError(
            f"contact: nothing lies within the reach of {reach:.4g} mm; {found}. Move the bodies together or give a larger reach."
        )


def _refuse_overlap(gap: Floats, points: Floats, size: Floats) -> None:
    deep = np.where(np.isfinite(gap), -gap, 0.0) - OVERLAP * size
    worst = int(deep.argmax())
    if deep[worst] > 0:
        at = ", ".join(f"{x:.4g}" for x in points[worst])
        raise InputError(
            f"contact: the bodies overlap by {-gap[worst]:.3g} mm at ({at}) mm before any load. Move them apart by that much, or give "
            "press_fit=True where an interference is intended."
        )
