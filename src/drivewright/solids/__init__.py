"""CAD solids and finite elements of bodies: outlines, turned and grooved solids, elastic bodies in space and in plane stress.

Knows shapes, loads and springs, and no machine.  Volumes and surfaces of simple parts need no CAD kernel; all else needs the extra `fe`.

contact        elastic bodies pressed on each other
cad            CAD solids of parts with Netgen's OpenCASCADE kernel
coupling       the equilibrium of substructures on linear springs
nonlinear_coupling  the same on springs with laws of their own: contacts, bearings
deformation    the displaced surface of a solid
engine         the door to Netgen and NGSolve
facets         closed triangle surfaces of parts
grooving       grooves milled into turned bodies
meshing        curved meshes of CAD shapes with named boundaries whose lengths or areas are checked
shading        normals of a triangle surface, and the edges that are drawn
stacked        the union of prisms along one axis as a triangle surface
stresses       stress on the skin of an elastic body
pieces         the pieces of an outline (`scene.Line`, `Arc`, `Spline`)
plane_meshing  curved triangle meshes of flat parts for plane stress
substructures  elastic bodies condensed to the loads on their interfaces (substructures)
turning        turned bodies
volume         volume of a part from its horizontal sections, without a CAD kernel
"""

from importlib import import_module
from typing import Any

_WHERE = {
    "contact": ("ContactModel", "ContactState", "Functional", "Link", "Pair", "PressedBodies", "SolidBody", "press"),
    "cad": ("cad_assembly", "cad_solid"),
    "coupling": ("CoupledSolution", "InterfaceSpring", "solve_coupled"),
    "deformation": ("DisplacedSurface", "displaced_table"),
    "elastic": ("FreeBody", "Plane", "Response", "SpringSupported", "spring_supported", "superposed_field"),
    "facets": ("surface_triangles", "viewed_triangles"),
    "meshing": ("boundary_measure", "check_boundary_measures", "solid_mesh"),
    "nonlinear_coupling": ("NonlinearSolution", "NonlinearSpring", "solve_nonlinear"),
    "plane": ("PlaneBody", "Rim", "StressSurface", "field_table", "order_error", "plane_von_mises"),
    "plane_meshing": ("plane_mesh",),
    "stresses": ("SkinStress", "skin_stress"),
    "substructures": ("InterfaceLoad", "Substructure", "elastic_substructure", "radial_loads", "rigid_substructure"),
    "turning": ("Band", "Frustum", "half_section", "ring_volume", "split_rings"),
    "volume": ("part_volume",),
}
_MODULE = {name: module for module, names in _WHERE.items() for name in names}

__all__ = sorted(_MODULE)


def __getattr__(name: str) -> Any:
    if name not in _MODULE:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_MODULE[name]}"), name)
