"""Flat elastic bodies in plane stress (extra `fe`): an outline with holes, loaded along its rim, held by nothing.

A load that is not in balance is balanced by the inertia forces of the rigid motion that it causes (d'Alembert, even density): the body
flies, and no support disturbs its stresses.  One factorisation serves any number of loads.  Loads are given, and displacements and
stresses found, at the same integration points of the rim; stresses come raw from the element inside, unaveraged.

Meshes are in millimetres, stiffness in N/mm inside; every number that goes in or comes out is SI.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import scipy
from numpy.typing import NDArray

from drivewright._typing import ArrayLike, Bools, Floats, Ints
from drivewright.errors import InputError
from drivewright.result import Column, Table
from drivewright.solids.elastic import sampled_triangles
from drivewright.solids.engine import EngineObject, fe_module
from drivewright.solids.plane_meshing import MM, PURPOSE, matches

ALONG_EDGE = 8  # Gauss points on an edge of an element


class Rim(NamedTuple):
    """Integration points on the boundary of a body.

    name (n,): boundary that they lie on; points (n, 2) [m]; normals (n, 2) out of the material; lengths (n,) [m], the weights of an
    integral along the rim.
    """

    name: NDArray[np.str_]
    points: Floats
    normals: Floats
    lengths: Floats


class StressSurface(NamedTuple):
    """points (n, 2) [m], flat triangles (m, 3) of them, counter-clockwise, and stress (L, n, 3) [Pa] there: sxx, syy, sxy."""

    points: Floats
    triangles: Ints
    stress: Floats


def plane_von_mises(stress: ArrayLike) -> Floats:
    """Von Mises stress sqrt(sx^2 - sx sy + sy^2 + 3 sxy^2) of stresses (..., 3) in plane stress."""
    x, y, xy = np.moveaxis(np.asarray(stress, float), -1, 0)
    return np.sqrt(x**2 - x * y + y**2 + 3 * xy**2)


class PlaneBody:
    """A plate of even thickness [m] on a mesh made by `plane_mesh`; modulus [Pa]; elements of an order from 2 up.

    `rim` is the `Rim` where loads are given and displacements and stresses found.  Fields of displacement are rows of coefficients.
    """

    def __init__(self, mesh: EngineObject, *, thickness: float, modulus: float, poisson: float, order: int = 4) -> None:
        _check_material(thickness, modulus, poisson, order)
        self.ng = ng = fe_module("ngsolve", PURPOSE)
        ng.SetNumThreads(1)  # the same bits every time
        self.mesh, self.thickness, self.modulus, self.poisson, self.order = mesh, thickness, modulus, poisson, order
        self._space = ng.VectorH1(mesh, order=order)
        self._shape = ng.GridFunction(self._space)
        self.rim, self._trace = _rim(ng, mesh, self._space.components[0])
        motions = _rigid_motions(ng, mesh)
        test = self._space.TestFunction()
        self._modes = np.array([self._interpolated(motion) for motion in motions])
        self._masses = np.array([ng.LinearForm(motion * test * ng.dx).Assemble().vec.FV().NumPy().copy() for motion in motions])
        self._gram = self._modes @ self._masses.T
        with ng.TaskManager():
            self._inverse = self._stiffness().mat.Inverse(self._unpinned(), inverse="sparsecholesky")

    @property
    def unknowns(self) -> int:
        """Degrees of freedom of the finite elements."""
        return self._space.ndof

    def with_higher_order(self) -> "PlaneBody":
        """The same body on the same mesh with elements one order higher."""
        return PlaneBody(self.mesh, thickness=self.thickness, modulus=self.modulus, poisson=self.poisson, order=self.order + 1)

    def on(self, pattern: str) -> Bools:
        """Which points of the rim (n,) lie on boundaries whose names match a pattern as in "hole0:*"; InputError where none does."""
        names = np.unique(self.rim.name)
        matching = [name for name in names if matches(pattern, name)]
        if not matching:
            raise InputError(f"no boundary of the plate matches {pattern!r}; there are {', '.join(names)}")
        return np.isin(self.rim.name, matching)

    def resultant(self, tractions: ArrayLike) -> tuple[Floats, Floats]:
        """Forces (L, 2) [N] and moments about the origin (L,) [N m] of tractions (L, n, 2) [Pa] on the rim."""
        force = self._forces(tractions)
        x, y = self.rim.points.T
        return force.sum(axis=1), (x * force[..., 1] - y * force[..., 0]).sum(axis=1)

    def solve(self, tractions: ArrayLike) -> Floats:
        """Fields (L, unknowns) [m] of displacement, without rigid part, under tractions (L, n, 2) [Pa] on the rim."""
        force = self._forces(tractions)
        right = np.concatenate([(self._trace.T @ force[..., axis].T).T for axis in (0, 1)], axis=1)
        right -= _parts(self._gram, self._modes, right) @ self._masses
        fields = np.array([self._solved(row) for row in right])
        return fields - _parts(self._gram.T, self._masses, fields) @ self._modes

    def displacement(self, fields: Floats) -> Floats:
        """Displacement (L, n, 2) [m] of the points of the rim."""
        half = fields.shape[1] // 2
        return np.stack([(self._trace @ part.T).T for part in (fields[:, :half], fields[:, half:])], axis=-1)

    def stress(self, fields: Floats) -> Floats:
        """Stress (L, n, 3) [Pa], sxx, syy, sxy, at the points of the rim."""
        at = self.mesh.MapToAllElements(_rule(self.ng)[0], self.mesh.Boundaries(".*"))
        return self._stresses(fields, self.ng.BoundaryFromVolumeCF(self.ng.Grad(self._shape)), at)

    def surface(self, fields: Floats, parts: int = 2) -> StressSurface:
        """The `StressSurface`: stress all over the plate, each triangle of the mesh in parts^2; neighbours share no points."""
        ng = self.ng
        at, triangles = sampled_triangles(ng, self.mesh, self.mesh.Materials(".*"), parts)
        points = MM * ng.CF((ng.x, ng.y))(at)
        return StressSurface(points, _counter_clockwise(points, triangles), self._stresses(fields, ng.Grad(self._shape), at))

    def _forces(self, tractions: ArrayLike) -> Floats:
        return self.thickness * self.rim.lengths[:, None] * np.asarray(tractions, float)

    def _solved(self, right: Floats) -> Floats:
        given, solution = self._shape.vec.CreateVector(), self._shape.vec.CreateVector()
        given.FV().NumPy()[:] = right
        solution.data = self._inverse * given
        return MM * solution.FV().NumPy()

    def _stresses(self, fields: Floats, gradient: EngineObject, at: EngineObject) -> Floats:
        vector, gradients = self._shape.vec.FV().NumPy(), []
        for field in fields:
            vector[:] = field / MM
            gradients.append(np.asarray(gradient(at)))
        return self._hooke(np.array(gradients))

    def _hooke(self, gradient: Floats) -> Floats:
        """Plane stress: E/(1 - nu^2) (exx + nu eyy), likewise y, and E/(1 + nu) exy; gradient (..., 4) row by row."""
        xx, xy, yx, yy = np.moveaxis(gradient, -1, 0)
        factor, nu = self.modulus / (1 - self.poisson**2), self.poisson
        return np.stack([factor * (xx + nu * yy), factor * (yy + nu * xx), factor * (1 - nu) * (xy + yx) / 2], axis=-1)

    def _stiffness(self) -> EngineObject:
        """Bilinear form t int s(u) : e(v) in N/mm."""
        ng, nu = self.ng, self.poisson
        u, v = self._space.TnT()
        factor = self.thickness / MM * self.modulus * MM**2 / (1 - nu**2)
        strain, virtual = ng.Sym(ng.Grad(u)), ng.Sym(ng.Grad(v))
        form = ng.BilinearForm(self._space, symmetric=True)
        form += factor * ((1 - nu) * ng.InnerProduct(strain, virtual) + nu * ng.Trace(strain) * ng.Trace(virtual)) * ng.dx
        with ng.TaskManager():
            return form.Assemble()

    def _interpolated(self, motion: EngineObject) -> Floats:
        self._shape.Set(motion)
        return self._shape.vec.FV().NumPy().copy()

    def _unpinned(self) -> EngineObject:
        """All unknowns but three vertex displacements that rigid motions cannot leave at 0: balanced loads do not feel the pins."""
        corners, half = np.array(self.mesh.ngmesh.Coordinates()), self._space.components[0].ndof
        first = int(corners[:, 0].argmin())
        last = int(np.hypot(*(corners - corners[first]).T).argmax())
        across = 0 if abs(corners[last, 1] - corners[first, 1]) > abs(corners[last, 0] - corners[first, 0]) else half
        free = self.ng.BitArray(self._space.FreeDofs())
        for number in (first, half + first, across + last):
            free.Clear(number)
        return free


def field_table(name: str, title: str, surface: StressSurface, columns: Sequence[Column]) -> Table:
    """Table for a plot of style "mesh", three rows a triangle: x, y, a depth of 0, and the columns, whose data are at the points."""
    rows = surface.triangles.ravel()
    x, y = surface.points[rows].T
    flat = Column("depth", "m", "flat", np.zeros(len(x)))
    place = Column("x", "m", "along the plate", x), Column("y", "m", "across the plate", y), flat
    return Table(name, title, place + tuple(column._replace(data=np.asarray(column.data)[rows]) for column in columns))


def order_error(body: PlaneBody, tractions: ArrayLike) -> Floats:
    """How far the elements are from the truth under tractions (L, n, 2): the largest change of von Mises stress on the rim by one order
    more, over the largest such stress, for each load (L,)."""
    low, high = (plane_von_mises(one.stress(one.solve(tractions))) for one in (body, body.with_higher_order()))
    return np.abs(high - low).max(axis=1) / high.max(axis=1)


# ---------------------------------------------------------------------------------------------------------------------- pieces


def _parts(gram: Floats, tests: Floats, rows: Floats) -> Floats:
    """Amounts (L, 3) that make rows less amounts times the other set have no product with any of the tests (3, n)."""
    return np.asarray(np.linalg.solve(gram, tests @ rows.T), float).T


def _rigid_motions(ng: Any, mesh: EngineObject) -> list[EngineObject]:
    corners = np.array(mesh.ngmesh.Coordinates())
    (x, y), size = (corners.max(axis=0) + corners.min(axis=0)) / 2, np.ptp(corners, axis=0).max()
    return [ng.CF((1, 0)), ng.CF((0, 1)), ng.CF((float(y) - ng.y, ng.x - float(x))) / float(size)]


def _rule(ng: Any) -> tuple[EngineObject, Floats, Floats]:
    """Gauss points and weights on the reference edge, as NGSolve wants them and as arrays."""
    node, weight = np.polynomial.legendre.leggauss(ALONG_EDGE)
    node, weight = (1 + node) / 2, weight / 2
    return ng.IntegrationRule(points=[(float(s),) for s in node], weights=[0.0] * ALONG_EDGE), node, weight


def _rim(ng: Any, mesh: EngineObject, scalar: EngineObject) -> "tuple[Rim, scipy.sparse.csr_array]":
    """The `Rim` and the sparse matrix that takes a scalar's coefficients to its values there."""
    rule, node, weight = _rule(ng)
    at = mesh.MapToAllElements(rule, mesh.Boundaries(".*"))
    elements = list(scalar.Elements(ng.BND))
    unknowns = np.array([element.dofs for element in elements])
    stretch = np.hypot(*np.asarray(ng.specialcf.JacobianMatrix(2, 1)(at)).T).reshape(len(elements), -1)
    points = MM * np.asarray(ng.CF((ng.x, ng.y))(at))
    rim = Rim(
        np.repeat([element.mat for element in elements], len(node)),
        points,
        _outward(ng, mesh, elements, points, at),
        MM * (stretch * weight).ravel(),
    )
    values = _shape_values(ng, scalar, unknowns, node, at)
    rows = np.broadcast_to(np.arange(len(rim.name)).reshape(len(elements), -1, 1), values.shape)
    columns = np.broadcast_to(unknowns[:, None, :], values.shape)
    return rim, scipy.sparse.csr_array((values.ravel(), (rows.ravel(), columns.ravel())), shape=(len(rim.name), scalar.ndof))


def _outward(ng: Any, mesh: EngineObject, elements: list[EngineObject], points: Floats, at: EngineObject) -> Floats:
    """Unit normals (n, 2) out of the material; the mesher's own point inwards along a hole."""
    corners = MM * np.array(mesh.ngmesh.Coordinates())
    insides = np.array([np.mean([corners[v.nr] for v in mesh[mesh[edge.edges[0]].elements[0]].vertices], axis=0) for edge in elements])
    normals = np.asarray(ng.specialcf.normal(2)(at)).reshape(len(elements), -1, 2)
    outward = np.sum(normals * (points.reshape(normals.shape) - insides[:, None]), axis=(1, 2)) > 0
    return np.where(outward[:, None, None], normals, -normals).reshape(-1, 2)


def _shape_values(ng: Any, scalar: EngineObject, unknowns: Ints, node: Floats, at: EngineObject) -> Floats:
    """Values (edges, points, unknowns of an edge) of the shape functions: linear ones of the two ends, then the edge's own, all edges at
    once."""
    shape = ng.GridFunction(scalar)
    vector = shape.vec.FV().NumPy()
    values = np.empty((len(unknowns), len(node), unknowns.shape[1]))
    values[..., 0], values[..., 1] = node, 1 - node
    for own in range(2, unknowns.shape[1]):
        vector[:] = 0.0
        vector[unknowns[:, own]] = 1.0
        values[..., own] = np.asarray(shape(at)).reshape(len(unknowns), -1)
    return values


def _counter_clockwise(points: Floats, triangles: Ints) -> Ints:
    a, b, c = (points[triangles[:, k]] for k in range(3))
    turn = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
    return np.where(turn[:, None] > 0, triangles, triangles[:, ::-1])


def _check_material(thickness: float, modulus: float, poisson: float, order: int) -> None:
    if not (thickness > 0 and modulus > 0 and -1 < poisson <= 0.5):
        raise InputError(
            f"a plate of thickness {thickness:g} m, modulus {modulus:g} Pa and Poisson's ratio {poisson:g}; the first two "
            "must be above 0, the last between -1 and 0.5"
        )
    if order not in range(2, 10):
        raise InputError(f"elements of order {order}; choose one from 2 to 9")
