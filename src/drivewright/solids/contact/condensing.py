"""Functionals of a body's skin as load vectors of its finite elements, and the body condensed to them.

Inside, lengths are in millimetres and pressures in MPa.
"""

from typing import NamedTuple

import numpy as np
import scipy

from drivewright._typing import Floats
from drivewright.solids.elastic import FreeBody
from drivewright.steps import note_step

Rows = scipy.sparse.csr_array


class Condensed(NamedTuple):
    """A body between n functionals F.

    loads (n, unknowns): F as rows; flexibility (n, n) = F K^-1 F' [mm/N of the functionals' own units], rigid motion apart; resultants
    (m, n): what the functionals' unit loads do on the m rigid motions that the body can make.
    """

    body: FreeBody
    loads: Rows
    flexibility: Floats
    resultants: Floats


def load_rows(body: FreeBody, weights: Rows) -> Rows:
    """Rows (n, unknowns) of the finite elements for functionals sum of weights (n, d nodes) times displacements of nodes, x of all nodes
    first; nodes are numbered as in `Skin`."""
    at_nodes = _node_values(body)
    count = at_nodes.shape[0]
    return Rows(scipy.sparse.hstack([weights[:, axis * count : (axis + 1) * count] @ at_nodes for axis in range(body.mesh.dim)]))


def condense(body: FreeBody, loads: Rows, name: str = "a body") -> Condensed:
    """`Condensed` body, of that name to who shows progress."""
    flexibility = np.empty((loads.shape[0],) * 2)
    for number in range(loads.shape[0]):
        note_step(f"condensing {name}", number + 1, loads.shape[0])
        flexibility[:, number] = loads @ solved(body, loads[[number]].toarray()[0])
    modes = np.array([mode.FV().NumPy() for mode in body.modes]).reshape(len(body.modes), loads.shape[1])
    return Condensed(body, loads, 0.5 * (flexibility + flexibility.T), np.asarray((loads @ modes.T).T))


def solved(body: FreeBody, load: Floats) -> Floats:
    """Displacement (unknowns,) [mm] under a load vector [N], balanced by inertia forces, without rigid part."""
    given = body.vector()
    given.FV().NumPy()[:] = load
    return body.elastic(given).FV().NumPy().copy()


def _node_values(body: FreeBody) -> Rows:
    """Matrix (nodes, unknowns of one component) from coefficients to values at corners and middles of edges.

    A second-order function is its linear part between the corners, and on each edge a bubble of its own.
    """
    ng, mesh, scalar = body.ng, body.mesh, body.space.components[0]
    corners, edges = mesh.nv, scalar.ndof - mesh.nv
    ends = np.array([[v.nr for v in edge.vertices] for edge in mesh.edges])
    assert len(ends) == edges  # one unknown for a corner, one for an edge
    shape = ng.GridFunction(scalar)
    shape.vec.FV().NumPy()[corners:] = 1.0
    middle = [(0.5,)] if mesh.dim == 2 else [(0.5, 0.5)]
    rule = ng.IntegrationRule(points=middle, weights=[0.0])
    at = mesh.MapToAllElements(rule if mesh.dim == 2 else {ng.ET.TRIG: rule}, mesh.Boundaries(".*"))
    bubble = float(np.asarray(shape(at)).ravel()[0])
    lines = np.arange(edges)
    half = Rows((np.full(2 * edges, 0.5), (np.repeat(lines, 2), ends.ravel())), shape=(edges, corners))
    top = scipy.sparse.hstack([scipy.sparse.eye_array(corners), Rows((corners, edges))])
    return Rows(scipy.sparse.vstack([top, scipy.sparse.hstack([half, bubble * scipy.sparse.eye_array(edges)])]))
