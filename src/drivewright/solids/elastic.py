"""Flexibility of an elastic solid that nothing holds, and then of the same solid on springs (extra `fe`).

The free body answers each load functional (say, a unit force spread evenly over a face) with an elastic displacement; a load that is not
in balance is balanced by spread-out body forces, which cancel as soon as springs complete the equilibrium.  Springs, rigid ones too, are
then a small dense system over the functionals and the rigid motions: one factorisation serves every set of springs.

Meshes are in millimetres; stresses in MPa inside; every number that comes out is SI.
"""

from collections.abc import Sequence
from functools import partial
from typing import Any, Literal, NamedTuple

import numpy as np

from drivewright._typing import ArrayLike, Floats, Ints
from drivewright.errors import InputError, SolverError
from drivewright.solids.deformation import DisplacedSurface, subdivided_triangle
from drivewright.solids.engine import EngineObject, fe_module, interruptible
from drivewright.solids.meshing import PURPOSE, boundary_measure
from drivewright.steps import note_step

MM = 1e-3  # metres in a millimetre
EXTRA_ORDER = 6  # of integration beyond the elements' own, for a strip that is narrower than they are
LOOSE = 1e-4  # a rigid motion with so small a share in the spring forces is not held: meshes are symmetric to about 1e-7 only


class Response(NamedTuple):
    """What a free body answers to n functionals.

    flexibility (n, n) [m/N]: symmetric, displacement measured by one under a unit load of another, rigid motion apart.
    resultants (m, n): what each unit load does on the m rigid motions that the body can make.
    fields: for each functional the coefficients of its displacement [mm/N].
    """

    flexibility: Floats
    resultants: Floats
    fields: tuple[EngineObject, ...]


class SpringSupported(NamedTuple):
    """A body on springs under L unit loads: flexibility (L, L) [m/N], forces of the S springs on it (S, L), rigid motions (m, L) [m/N]."""

    flexibility: Floats
    reactions: Floats
    motions: Floats


class Plane(NamedTuple):
    """A flat body: its thickness [m], and the state "strain" (long along its axis) or "stress" (a sheet)."""

    thickness: float
    state: Literal["strain", "stress"] = "strain"


class FreeBody:
    """A homogeneous elastic body on a curved second-order NGSolve mesh in millimetres; modulus [Pa]; `plane` for a mesh in two dimensions.

    Half and quarter models: `symmetry` names the faces on which a displacement is 0, as dirichletx="...", dirichletz="...".  The body
    then has only those rigid motions that leave these faces in place.

    As many vertex displacements, chosen where they fix the rigid motions best, are pinned in the factorisation.  All loads being
    balanced the pins feel no force, and the rigid part of what they leave is taken out: no result depends on them.
    """

    def __init__(self, mesh: EngineObject, modulus: float, poisson: float, plane: Plane | None = None, **symmetry: str) -> None:
        self.ng = ng = fe_module("ngsolve", PURPOSE)
        ng.SetNumThreads(1)  # the same bits every time; a second thread gains nothing at this size
        self.modulus, self.poisson, self.plane = modulus, poisson, plane
        self.mesh, self.space = mesh, ng.VectorH1(mesh, order=2, **symmetry)
        corners = np.array(mesh.ngmesh.Coordinates())
        self.middle, self.size = (corners.max(axis=0) + corners.min(axis=0)) / 2, float(np.ptp(corners, axis=0).max())
        stiffness = interruptible(partial(_stiffness, ng, self.space, modulus * MM**2, poisson, plane))
        motions = _rigid_motions(ng, self.middle, self.size)
        self.basis = self._allowed(motions)
        motions = [_combination(ng, parts, motions) for parts in self.basis.T]
        self.modes = [self._interpolated(motion) for motion in motions]
        self._masses = [ng.LinearForm(ng.InnerProduct(motion, self.space.TestFunction()) * ng.dx).Assemble().vec for motion in motions]
        self._gram = np.array([[ng.InnerProduct(a, b) for b in self._masses] for a in self.modes])
        note_step("factorising the stiffness")
        self._inverse = interruptible(partial(_factorised, ng, stiffness, self._unpinned()))

    @property
    def unknowns(self) -> int:
        """Degrees of freedom of the finite elements."""
        return self.space.ndof

    def mean(self, region: str, direction: Sequence[float] | Floats) -> EngineObject:
        """Functional: mean displacement along `direction` (3,) over the faces whose names match `region`, a regular expression."""
        return self.weighted(region, self.ng.CF(tuple(map(float, direction))) / self.area(region))

    def volume_mean(self, direction: Sequence[float] | Floats) -> EngineObject:
        """Functional: mean displacement along `direction` (d,) over the volume."""
        ng = self.ng
        volume = ng.Integrate(ng.CF(1) * ng.dx, self.mesh)
        along = ng.CF(tuple(map(float, direction))) / volume
        return ng.LinearForm(ng.InnerProduct(along, self.space.TestFunction()) * ng.dx).Assemble().vec

    def weighted(self, region: str, weight: EngineObject) -> EngineObject:
        """Functional: integral over named faces [mm^2] of the displacement times `weight`, a vector coefficient function of (x, y, z)."""
        ng = self.ng
        self.area(region)
        return ng.LinearForm(ng.InnerProduct(weight, self.space.TestFunction()) * ng.ds(region)).Assemble().vec

    def mean_rotation(self, region: str, axis: int, radius: float) -> EngineObject:
        """Functional: rotation of named faces about the x, y or z axis (0, 1, 2), in least squares, times `radius` [m].

        About x and y from the displacements along z alone.
        """
        ng = self.ng
        self.area(region)
        if axis == 2:
            direction, square = ng.CF((-ng.y, ng.x, 0)), ng.x * ng.x + ng.y * ng.y
        else:
            arm = (ng.y, -ng.x)[axis]
            direction, square = ng.CF((0, 0, arm)), arm * arm
        moment = ng.Integrate(square * ng.ds(region), self.mesh)
        return self.weighted(region, radius / MM / float(moment) * direction)

    def gaussian_strip(self, region: str, point: complex, normal: complex, sigma: float, along: EngineObject | float = 1.0) -> EngineObject:
        """Functional: mean displacement along `normal` over named faces, weighted by exp(-r^2/2 sigma^2) of the distance r to a line
        along z through `point` (x + iy) [m] and by `along`, a coefficient function of z; sigma [m].

        Only the flank that faces along the normal counts.  A part linear along the flank brings the resultant to the point exactly, also
        at a corner.
        """
        ng = self.ng
        x, y = ng.x - float(point.real) / MM, ng.y - float(point.imag) / MM
        ahead = float(normal.real) * ng.specialcf.normal(3)[0] + float(normal.imag) * ng.specialcf.normal(3)[1]
        across = float(normal.real) * y - float(normal.imag) * x
        weight = along * ng.IfPos(ahead, ahead, 0) * ng.exp(-(x * x + y * y) / (2 * (sigma / MM) ** 2))
        area = ng.ds(region, bonus_intorder=EXTRA_ORDER)
        m0, m1, m2 = (float(ng.Integrate(weight * across**n * area, self.mesh)) for n in range(3))
        if not m2 * m0 > m1 * m1:
            raise SolverError(f"solid check: no part of the profile lies at the contact at ({point.real:.5g}, {point.imag:.5g}) m.")
        slope = -m1 / m2
        balanced = weight * (1 + slope * across) / (m0 + slope * m1)
        direction = ng.CF((float(normal.real), float(normal.imag), 0))
        return ng.LinearForm(ng.InnerProduct(balanced * direction, self.space.TestFunction()) * area).Assemble().vec

    def area(self, region: str) -> float:
        """Area [mm^2] of the faces whose names match `region`; InputError where there are none (NGSolve would integrate over nothing)."""
        area = boundary_measure(self.mesh, region)
        if not area > 0:
            raise InputError(f"no face of the mesh is called {region!r}; there are {', '.join(sorted(set(self.mesh.GetBoundaries())))}")
        return area

    def response(self, functionals: Sequence[EngineObject], name: str = "a body") -> Response:
        """The `Response` to functionals made by `mean`, `weighted`, `mean_rotation` or `gaussian_strip`; `name`: to who shows progress."""
        fields = []
        with self.ng.TaskManager():
            for number, functional in enumerate(functionals, 1):
                note_step(f"condensing {name}", number, len(functionals))
                fields.append(self.elastic(functional))
            product = self.ng.InnerProduct
            flexibility = MM * np.array([[product(g, w) for w in fields] for g in functionals])
            resultants = np.array([[product(mode, g) for g in functionals] for mode in self.modes])
        return Response(flexibility, resultants, tuple(fields))

    def surface(self, region: str, fields: Sequence[EngineObject], motions: Floats, parts: int = 2) -> DisplacedSurface:
        """The `DisplacedSurface` of named faces, displacements (L, n, 3) [m/N], each curved triangle in parts^2 flat ones.

        fields: L vectors of coefficients [mm/N]; motions (m, L) [m/N]: rigid motion to add to each.
        """
        ng = self.ng
        at, triangles = sampled_triangles(ng, self.mesh, self.mesh.Boundaries(region), parts)
        points = ng.CF((ng.x, ng.y, ng.z))(at)
        shape = ng.GridFunction(self.space)
        displacements = []
        for field, motion in zip(fields, (self.basis @ motions).T, strict=True):
            shape.vec.data = field
            displacements.append(MM * np.asarray(shape(at)) + _carried(points, motion, self.middle, self.size))
        return DisplacedSurface(MM * points, triangles, np.array(displacements))

    def vector(self) -> EngineObject:
        """An empty vector of coefficients."""
        return self.ng.GridFunction(self.space).vec

    def _interpolated(self, function: EngineObject) -> EngineObject:
        shape = self.ng.GridFunction(self.space)
        shape.Set(function)
        return shape.vec

    def _allowed(self, motions: Sequence[EngineObject]) -> Floats:
        """Orthonormal combinations (6, m), in the plane (3, m), of the rigid motions that are 0 wherever the symmetry wants it."""
        fixed = ~np.array(list(self.space.FreeDofs()))
        table = np.array([np.array(self._interpolated(motion))[fixed] for motion in motions])
        axes, sizes, _ = np.linalg.svd(table @ table.T)
        return axes[:, sizes <= 1e-12 * max(sizes[0], 1.0)]

    def _unpinned(self) -> EngineObject:
        """The unknowns but a few: those vertex displacements whose values under rigid motions are furthest from depending on each other."""
        from scipy.linalg import qr

        free = self.ng.BitArray(self.space.FreeDofs())
        if not self.modes:
            return free
        vertices = np.concatenate([self.space.Range(i).start + np.arange(self.mesh.nv) for i in range(self.mesh.dim)])
        vertices = vertices[np.array(list(free))[vertices]]
        table = np.array([np.array(mode)[vertices] for mode in self.modes])
        order = np.asarray(qr(table, mode="r", pivoting=True)[-1])
        for number in vertices[order[: len(table)]]:
            free.Clear(int(number))
        return free

    def elastic(self, functional: EngineObject) -> EngineObject:
        """Displacement [mm] under a load vector [N] that inertia forces balance, without rigid part."""
        balanced, shape = functional.CreateVector(), functional.CreateVector()
        balanced.data = functional
        self._subtract(balanced, self.modes, self._masses)
        shape.data = self._inverse * balanced
        self._subtract(shape, self._masses, self.modes)
        return shape

    def _subtract(self, vector: EngineObject, measures: Sequence[EngineObject], parts: Sequence[EngineObject]) -> None:
        """Take from a vector as much of the parts as makes its product with every measure 0."""
        if not measures:
            return
        amounts = np.linalg.solve(self._gram, [self.ng.InnerProduct(measure, vector) for measure in measures])
        for amount, part in zip(amounts, parts, strict=True):
            vector.data -= float(amount) * part


def sampled_triangles(ng: Any, mesh: EngineObject, elements: EngineObject, parts: int) -> tuple[EngineObject, Ints]:
    """(places of evaluation, flat triangles (m, 3) of them): each curved triangle among the elements in parts^2."""
    grid, local = subdivided_triangle(parts)
    rule = ng.IntegrationRule(points=[tuple(p) for p in grid / parts], weights=[0.0] * len(grid))
    at = mesh.MapToAllElements({ng.ET.TRIG: rule}, elements)
    count = len(ng.CF(1)(at)) // len(grid)
    return at, (np.arange(count)[:, None, None] * len(grid) + local).reshape(-1, 3)


def superposed_field(fields: Sequence[EngineObject], amounts: Sequence[float] | Floats) -> EngineObject:
    """One vector of the finite elements: the sum of amounts times fields."""
    total = fields[0].CreateVector()
    total[:] = 0.0
    for amount, field in zip(amounts, fields, strict=True):
        total.data += float(amount) * field
    return total


def spring_supported(response: Response, stiffness: ArrayLike) -> SpringSupported:
    """The `SpringSupported` of a free body's `Response`: its first functionals are springs of `stiffness` (S,) [N/m] (inf is
    rigid), the rest loads.

    With R the forces of the springs on the body, a the rigid motions that they hold and H the resultants,

        [G_ss + 1/k  H_s'] [R]     [G_sl]
        [H_s         0   ] [a] = - [H_l ]     and     D = G_ll + G_ls R + H_l' a.

    InputError where a load drives a rigid motion that no spring holds.
    """
    stiffness = np.asarray(stiffness, float)
    count = len(stiffness)
    flexibility, resultants = response.flexibility, response.resultants
    basis = _held_motions(resultants[:, :count], resultants[:, count:])
    kept = basis.T @ resultants
    springs = flexibility[:count, :count] + np.diag(1.0 / stiffness)
    scale = np.abs(springs).max()  # brings the balance rows to the size of the others
    matrix = np.block([[springs, scale * kept[:, :count].T], [scale * kept[:, :count], np.zeros((len(kept), len(kept)))]])
    right = np.vstack([flexibility[:count, count:], scale * kept[:, count:]])
    solution = -np.asarray(np.linalg.solve(matrix, right), float)
    return SpringSupported(flexibility[count:, count:] + right.T @ solution, solution[:count], scale * basis @ solution[count:])


def _held_motions(springs: Floats, loads: Floats) -> Floats:
    """Orthonormal rigid motions (m, h) that the springs' resultants (m, S) feel; refuses loads (m, L) on the others."""
    axes, sizes, _ = np.linalg.svd(springs)
    sizes = np.concatenate([sizes, np.zeros(len(axes) - len(sizes))])
    kept = sizes > LOOSE * sizes[0]
    loose = np.abs(axes[:, ~kept].T @ loads).max(axis=0, initial=0.0)
    if loose.max(initial=0.0) > LOOSE:
        raise InputError(
            f"load {int(loose.argmax())} pushes the body where no spring holds it (a share of {loose.max():.3g} of the load "
            "acts on a free rigid motion); add a support in that direction"
        )
    return axes[:, kept]


def _stiffness(ng: Any, space: EngineObject, modulus: float, poisson: float, plane: Plane | None) -> EngineObject:
    """Bilinear form int 2 mu e(u) : e(v) + lambda div u div v, in the plane times the thickness."""
    u, v = space.TnT()
    shear, volume = lame_constants(modulus, poisson, plane)
    depth = plane.thickness / MM if plane else 1.0
    form = ng.BilinearForm(space, symmetric=True)
    form += depth * (2 * shear * ng.InnerProduct(ng.Sym(ng.Grad(u)), ng.Sym(ng.Grad(v))) + volume * ng.div(u) * ng.div(v)) * ng.dx
    with ng.TaskManager():
        form.Assemble()
    return form


def _factorised(ng: Any, stiffness: EngineObject, unpinned: EngineObject) -> EngineObject:
    """Inverse of a stiffness on the unknowns that are not pinned."""
    with ng.TaskManager():
        return stiffness.mat.Inverse(unpinned, inverse="sparsecholesky")


def lame_constants(modulus: float, poisson: float, plane: Plane | None = None) -> tuple[float, float]:
    """Lame's (mu, lambda) with which s = 2 mu e + lambda tr(e) I;  in plane stress lambda = E nu/(1 - nu^2)."""
    shear = modulus / 2 / (1 + poisson)
    if plane and plane.state == "stress":
        return shear, modulus * poisson / (1 - poisson**2)
    return shear, modulus * poisson / (1 + poisson) / (1 - 2 * poisson)


def _rigid_motions(ng: Any, middle: Floats, size: float) -> list[EngineObject]:
    """Shifts, then turns about the middle with size 1 at the distance `size`: three and three, in the plane two and one."""
    if len(middle) == 2:
        x, y = (c - float(m) for c, m in zip((ng.x, ng.y), middle, strict=True))
        return [ng.CF((1, 0)), ng.CF((0, 1)), ng.CF((-y, x)) / size]
    x, y, z = (c - float(m) for c, m in zip((ng.x, ng.y, ng.z), middle, strict=True))
    return [ng.CF(c) for c in ((1, 0, 0), (0, 1, 0), (0, 0, 1))] + [ng.CF(c) / size for c in ((0, -z, y), (z, 0, -x), (-y, x, 0))]


def _combination(ng: Any, parts: Floats, functions: Sequence[EngineObject]) -> EngineObject:
    """Coefficient function sum of parts times functions."""
    nothing = ng.CF((0,) * functions[0].dim)
    return sum((float(part) * function for part, function in zip(parts, functions, strict=True)), nothing)


def _carried(points: Floats, motion: Floats, middle: Floats, size: float) -> Floats:
    """Displacement (n, 3) of points (n, 3) by amounts (6,) of the rigid motions."""
    return motion[:3] + np.cross(motion[3:], (points - middle) / size)
