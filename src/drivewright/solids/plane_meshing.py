"""Curved triangle meshes of flat parts for plane stress (extra `fe`): outlines with holes, their boundaries named by their pieces."""

from collections.abc import Mapping, Sequence
from fnmatch import fnmatchcase

from drivewright.errors import InputError, SolverError
from drivewright.scene import Outline, Piece, Prism
from drivewright.solids import cad, outlines, pieces
from drivewright.solids.engine import EngineObject, fe_module, translated_errors
from drivewright.solids.meshing import check_boundary_measures

MM = 1e-3
PURPOSE = "a plate's stress"
CURVING = 4  # order of the curved elements: a quarter circle in two of them is right to 1e-6


def plane_mesh(
    outline: Outline, holes: Sequence[Outline] = (), *, size: float, fine: Mapping[str, float] | None = None, name: str = "plate"
) -> EngineObject:
    """Curved triangle mesh [mm] of a closed Outline less its holes, with elements of `size` [m].

    Its boundaries are called "outline:3", "hole0:1" after the given pieces; `fine` gives a smaller size [m] to some by their names.
    """
    occ, ng = fe_module("netgen.occ", PURPOSE), fe_module("ngsolve", PURPOSE)
    ng.ngsglobals.msg_level = 0
    given = {"outline": outline, **{f"hole{number}": hole for number, hole in enumerate(holes)}}
    named = {f"{label}:{number}": piece for label, one in given.items() for number, piece in enumerate(one.pieces)}
    sizes = {place: min([size, *(s for key, s in (fine or {}).items() if matches(key, place))]) for place in named}
    _check_sizes(sizes, fine or {}, named)
    outlines.prism_region(Prism(outline, tuple(holes), 0.0, 1.0), name)
    advice = "look for very short pieces, kinks and thin walls, or try another size"
    with translated_errors(SolverError, f"{name}: the mesher gave up", advice, PURPOSE):
        shape = cad.outline_face(occ, outline, name)
        for number, hole in enumerate(holes):
            shape = (shape - cad.outline_face(occ, hole, f"hole {number} of {name}")).faces[0]
        for edge in shape.edges:
            edge.name = _nearest(edge, named)
            edge.maxh = sizes[edge.name] / MM
        mesh = ng.Mesh(occ.OCCGeometry(shape, dim=2).GenerateMesh(maxh=size / MM, grading=0.3)).Curve(CURVING)
    check_boundary_measures(
        mesh,
        {place: pieces.length(piece) / MM for place, piece in named.items()},
        f"{name}: the mesh gives boundary",
        "look for holes that cross the outline, or try a smaller size",
        unit="mm",
        relative=2e-3,
        absolute=outlines.SNAP / MM,
    )
    return mesh


def matches(pattern: str, name: str) -> bool:
    """Whether the name of a boundary fits a pattern as in "hole0:*"."""
    return fnmatchcase(name, pattern)


def _nearest(edge: EngineObject, named: Mapping[str, Piece]) -> str:
    """Name of the given piece that an edge of the kernel [mm] lies on, by its middle."""
    from shapely import LineString, Point

    middle = edge.Value(sum(edge.parameter_interval) / 2)
    spot = Point(MM * middle.x, MM * middle.y)
    return min(named, key=lambda name: LineString(pieces.polyline(named[name], 1e-9)).distance(spot))


def _check_sizes(sizes: Mapping[str, float], fine: Mapping[str, float], named: Mapping[str, Piece]) -> None:
    for pattern in fine:
        if not any(matches(pattern, name) for name in named):
            raise InputError(f"no boundary of the plate matches {pattern!r}; there are {', '.join(named)}")
    place, least = min(sizes.items(), key=lambda item: item[1])
    if not least > 0:
        raise InputError(f"the elements at {place!r} should have the size {least:g} m; it must be above 0")
