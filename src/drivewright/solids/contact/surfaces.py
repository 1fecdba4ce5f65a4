"""The skin of a meshed body: its second-order elements as arrays, points and normals on them, and where a ray meets them.

Lengths are in millimetres, as in the mesh.  An element is an edge of a plane mesh or a triangle of a solid one; its shape functions are
the quadratic ones of its nodes: the corners, then the middles of its edges.
"""

from typing import Any, NamedTuple

import numpy as np

from drivewright._typing import Bools, Floats, Ints
from drivewright.errors import InputError
from drivewright.solids.engine import EngineObject, fe_module
from drivewright.solids.meshing import PURPOSE

NEAR = 6  # places of the other skin that a ray tries first
TURNS = 12  # of Newton's method along a ray
OVER = 1e-6  # by which a ray may miss an element, in its own coordinates
FACING = -0.2  # cosine between the normals of two skins above which they do not face each other


class Skin(NamedTuple):
    """e elements of a named part of a body's boundary.

    places (e, k, d) [mm] of their k nodes (3 on an edge, 6 on a triangle); nodes (e, k): numbers of them, corners before middles; outward
    (e,): whether the order of an element's corners points out of the material, 1 or -1.
    """

    places: Floats
    nodes: Ints
    outward: Floats

    @property
    def corners(self) -> Ints:
        """Numbers (e, c) of the corners, 2 or 3."""
        return self.nodes[:, : self.places.shape[2]]

    @property
    def size(self) -> Floats:
        """Longest edge (e,) of each element [mm]."""
        corner = self.places[:, : self.places.shape[2]]
        return np.max([np.linalg.norm(corner - np.roll(corner, n, axis=1), axis=2).max(axis=1) for n in (1, 2)], axis=0)


class Hits(NamedTuple):
    """Where n rays meet a skin: element (n,), -1 where none, shape functions (n, k) and unit normal (n, d) there, and distance (n,) [mm]
    along the ray."""

    element: Ints
    shape: Floats
    normal: Floats
    distance: Floats


def skin_of(mesh: EngineObject, region: str) -> Skin:
    """The `Skin` of all boundaries of a mesh whose names match `region`, a regular expression."""
    ng = fe_module("ngsolve", PURPOSE)
    elements = list(mesh.Boundaries(region).Elements())
    local = _reference(mesh.dim)
    rule = ng.IntegrationRule(points=[tuple(p) for p in local], weights=[0.0] * len(local))
    at = mesh.MapToAllElements(rule if mesh.dim == 2 else {ng.ET.TRIG: rule}, mesh.Boundaries(region))
    places = np.asarray(ng.CF((ng.x, ng.y, ng.z)[: mesh.dim])(at)).reshape(len(elements), len(local), mesh.dim)
    if mesh.dim == 3 and any(len(element.vertices) != 3 for element in elements):
        raise InputError(f"contact: the faces {region!r} have elements with four corners; mesh them with triangles")
    corners = np.array([[v.nr for v in element.vertices] for element in elements])
    at_vertices = np.array(mesh.ngmesh.Coordinates())[corners]
    assert np.abs(at_vertices - places[:, : mesh.dim]).max() < 1e-9 * max(np.abs(places).max(), 1.0)  # the engine's order of corners
    numbers = np.hstack([corners, mesh.nv + _edges(mesh, elements, corners)])
    return Skin(places, numbers, _outward(mesh, elements, places))


def shape_functions(local: Floats, dim: int) -> Floats:
    """Quadratic shape functions (n, k) at local coordinates (n, 1) of an edge or (n, 2) of a triangle: barycentric ones l_a, then products.

    Corners l (2 l - 1), middles 4 l_a l_b.
    """
    l = _barycentric(local)
    pairs = _pairs(dim)
    return np.concatenate([l * (2 * l - 1), 4 * l[..., pairs[:, 0]] * l[..., pairs[:, 1]]], axis=-1)


def hats(local: Floats) -> Floats:
    """Linear shape functions (n, c) of the corners."""
    return _barycentric(local)


def middles(skin: Skin) -> tuple[Floats, Floats, Floats]:
    """Points, unit normals and stretch of `normals` at the middles of all elements."""
    dim = skin.places.shape[2]
    return normals(skin, np.arange(len(skin.nodes)), np.full((len(skin.nodes), dim - 1), 1 / dim))


def at_nodes(skin: Skin) -> tuple[Floats, Floats]:
    """Points and unit normals (e, k, d) at the nodes of all elements."""
    local = _reference(skin.places.shape[2])
    element = np.repeat(np.arange(len(skin.nodes)), len(local))
    points, normal, _ = normals(skin, element, np.tile(local, (len(skin.nodes), 1)))
    return points.reshape(skin.places.shape), normal.reshape(skin.places.shape)


def tangents(skin: Skin, element: Ints, local: Floats) -> tuple[Floats, Floats]:
    """(points (n, d) [mm], derivatives (n, d - 1, d) by the local coordinates)."""
    nodes = skin.places[element]
    dim = nodes.shape[2]
    points = np.einsum("nk,nkd->nd", shape_functions(local, dim), nodes)
    return points, np.einsum("nik,nkd->nid", _slopes(local, dim), nodes)


def normals(skin: Skin, element: Ints, local: Floats) -> tuple[Floats, Floats, Floats]:
    """(points (n, d) [mm], unit normals (n, d) out of the material, stretch (n,) of lengths or areas)."""
    points, along = tangents(skin, element, local)
    across = np.stack([along[:, 0, 1], -along[:, 0, 0]], axis=1) if points.shape[1] == 2 else np.cross(along[:, 0], along[:, 1])
    stretch = np.linalg.norm(across, axis=1)
    return points, skin.outward[element, None] * across / stretch[:, None], stretch


def hit_by_rays(skin: Skin, start: Floats, direction: Floats) -> Hits:
    """`Hits` of the rays x = start + g direction (n, d), g of either sign, that meet a skin which faces them; the nearest."""
    from scipy.spatial import KDTree

    count, dim = start.shape
    grid = _samples(dim)
    at = np.einsum("sk,ekd->esd", shape_functions(grid, dim), skin.places).reshape(-1, dim)
    _, near = KDTree(at).query(start, k=min(NEAR, len(at)))
    best = Hits(np.full(count, -1), np.zeros((count, skin.places.shape[1])), np.zeros((count, dim)), np.full(count, np.inf))
    for tried in np.atleast_2d(near.T):
        element = tried // len(grid)
        local, distance, found = _along_ray(skin, element, grid[tried % len(grid)], start, direction)
        normal = normals(skin, element, local)[1]
        facing = np.einsum("nd,nd->n", normal, direction) < FACING
        better = found & facing & (np.abs(distance) < np.abs(best.distance))
        best.normal[better] = normal[better]
        best.element[better], best.distance[better] = element[better], distance[better]
        best.shape[better] = shape_functions(local, dim)[better]
    return best


# ---------------------------------------------------------------------------------------------------------------------- pieces


def _along_ray(skin: Skin, element: Ints, local: Floats, start: Floats, direction: Floats) -> tuple[Floats, Floats, Bools]:
    """(local coordinates, distance, whether on the element) of rays on one element each, by Newton's method."""
    local = local.copy()
    distance = np.einsum("nd,nd->n", tangents(skin, element, local)[0] - start, direction)
    for _ in range(TURNS):
        points, along = tangents(skin, element, local)
        miss = points - start - distance[:, None] * direction
        matrix = np.concatenate([np.swapaxes(along, 1, 2), -direction[:, :, None]], axis=2)
        flat = np.abs(np.linalg.det(matrix)) < 1e-12 * np.linalg.norm(along, axis=2).prod(axis=1)
        matrix[flat] = np.eye(start.shape[1])
        step = np.where(flat[:, None], 0.0, np.linalg.solve(matrix, miss[:, :, None])[:, :, 0])
        local = np.clip(local - step[:, :-1], -0.5, 1.5)
        distance = distance - step[:, -1]
    points = tangents(skin, element, local)[0]
    miss = np.linalg.norm(points - start - distance[:, None] * direction, axis=1)
    inside = (_barycentric(local) >= -OVER).all(axis=1)
    return local, distance, inside & (miss < 1e-7 * skin.size[element])


def _reference(dim: int) -> Floats:
    """Local coordinates of the nodes as the engine has them: corners at l_0 = 1, l_1 = 1 (, l_2 = 1), then middles."""
    if dim == 2:
        return np.array([[1.0], [0.0], [0.5]])
    return np.array([[1.0, 0.0], [0.0, 1.0], [0.0, 0.0], [0.5, 0.5], [0.0, 0.5], [0.5, 0.0]])


def _pairs(dim: int) -> Ints:
    """Corners (m, 2) at the ends of the edge that each middle lies on."""
    return np.array([[0, 1]]) if dim == 2 else np.array([[0, 1], [1, 2], [2, 0]])


def _barycentric(local: Floats) -> Floats:
    """(l_0, ..., l_last) with l_n the local coordinates but for the last, 1 less their sum."""
    return np.concatenate([local, 1 - local.sum(axis=-1, keepdims=True)], axis=-1)


def _slopes(local: Floats, dim: int) -> Floats:
    """Derivatives (n, d - 1, k) of the shape functions by the local coordinates."""
    l, pairs = _barycentric(local), _pairs(dim)
    rows = []
    for axis in range(dim - 1):
        turn = np.zeros(dim)
        turn[axis], turn[-1] = 1.0, -1.0
        middles = 4 * (l[:, pairs[:, 0]] * turn[pairs[:, 1]] + l[:, pairs[:, 1]] * turn[pairs[:, 0]])
        rows.append(np.concatenate([(4 * l - 1) * turn, middles], axis=1))
    return np.stack(rows, axis=1)


def _samples(dim: int) -> Floats:
    """Local coordinates of the places of an element by which it is found."""
    if dim == 2:
        return np.array([[0.15], [0.5], [0.85]])
    return np.array([[1 / 3, 1 / 3], [0.1, 0.1], [0.8, 0.1], [0.1, 0.8], [0.45, 0.45], [0.1, 0.45], [0.45, 0.1]])


def _edges(mesh: EngineObject, elements: Any, corners: Ints) -> Ints:
    """Numbers (e, m) of the edges between the pairs of corners."""
    found = []
    for element, own in zip(elements, corners.tolist(), strict=True):
        ends = {frozenset(v.nr for v in mesh[edge].vertices): edge.nr for edge in element.edges}
        found.append([ends[frozenset((own[a], own[b]))] for a, b in _pairs(mesh.dim)])
    return np.array(found)


def _outward(mesh: EngineObject, elements: Any, places: Floats) -> Floats:
    """1 where the normal by the order of an element's corners points out of the volume behind it, else -1."""
    corners = np.array(mesh.ngmesh.Coordinates())
    sides = [element.edges[0] if mesh.dim == 2 else element.faces[0] for element in elements]
    behind = np.array([np.mean([corners[v.nr] for v in mesh[mesh[side].elements[0]].vertices], axis=0) for side in sides])
    trial = Skin(places, np.zeros(places.shape[:2], int), np.ones(len(places)))
    points, normal, _ = middles(trial)
    return np.where(np.einsum("ed,ed->e", points - behind, normal) > 0, 1.0, -1.0)
