"""Curved meshes of CAD shapes with named boundaries whose lengths or areas are checked (extra `fe`); meshes are in millimetres."""

from collections.abc import Mapping

from drivewright.errors import SolverError
from drivewright.solids.engine import EngineObject, fe_module, interruptible
from drivewright.steps import note_step

PURPOSE = "a solid check"
CURVATURE_SAFETY = 0.5  # of Netgen: elements of two radii on a curved face, that the second order follows


def solid_mesh(shape: EngineObject, size: float, grading: float, name: str = "a body") -> EngineObject:
    """Curved second-order tetrahedra of an OCC shape [mm], of at most `size` [mm]; the faces keep their names and own sizes.

    `name`: of the body to who shows progress."""
    occ, ng = fe_module("netgen.occ", PURPOSE), fe_module("ngsolve", PURPOSE)
    ng.ngsglobals.msg_level = 0

    def generated() -> EngineObject:
        return ng.Mesh(occ.OCCGeometry(shape).GenerateMesh(maxh=size, curvaturesafety=CURVATURE_SAFETY, grading=grading)).Curve(2)

    note_step(f"meshing {name}")
    return interruptible(generated)


def boundary_measure(mesh: EngineObject, region: str) -> float:
    """Area [mm^2] of a solid mesh's faces, or length [mm] of a plane mesh's edges, whose names match a regular
    expression; 0 without any."""
    ng = fe_module("ngsolve", PURPOSE)
    return ng.Integrate(ng.CF(1) * ng.ds(region), mesh)


def check_boundary_measures(
    mesh: EngineObject,
    expected: Mapping[str, float],
    subject: str,
    advice: str,
    unit: str = "mm^2",
    relative: float = 0.01,
    absolute: float = 0.0,
) -> None:
    """SolverError where a named boundary has not its expected area [mm^2] or length [mm]: a boundary missed would be a load missed,
    silently."""
    for name, wanted in expected.items():
        actual = boundary_measure(mesh, name)
        if abs(actual - wanted) > relative * wanted + absolute:
            raise SolverError(f"{subject} {name!r} {actual:.5g} {unit} instead of {wanted:.5g} {unit}; {advice}")
