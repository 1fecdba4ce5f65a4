"""Curved triangle meshes of flat parts for plane stress (extra `fe`): outlines with holes, their boundaries named by their pieces."""

from contextlib import contextmanager
from fnmatch import fnmatchcase

from drivewright.errors import InputError, SolverError
from drivewright.scene import Prism
from drivewright.solids import cad, chain, pieces
from drivewright.solids.loading import failures, load

MM = 1e-3
WHAT = "a plate's stress"
CURVING = 4  # order of the curved elements: a quarter circle in two of them is right to 1e-6


def plane_mesh(outline, holes=(), *, size, fine=None, name="plate"):
    """Curved triangle mesh [mm] of a closed Outline less its holes, with elements of `size` [m].

    Its boundaries are called "outline:3", "hole0:1" after the given pieces; `fine` gives a smaller size [m] to some by their names.
    """
    occ, ng = load("netgen.occ", WHAT), load("ngsolve", WHAT)
    ng.ngsglobals.msg_level = 0
    given = {"outline": outline, **{f"hole{number}": hole for number, hole in enumerate(holes)}}
    named = {f"{label}:{number}": piece for label, one in given.items() for number, piece in enumerate(one.pieces)}
    sizes = {place: min([size, *(s for key, s in (fine or {}).items() if matches(key, place))]) for place in named}
    _check_sizes(sizes, fine or {}, named)
    chain.region(Prism(outline, tuple(holes), 0.0, 1.0), name)
    with _kernel(name):
        shape = cad._face(occ, outline, name, cad.TOLERANCE)
        for number, hole in enumerate(holes):
            shape = (shape - cad._face(occ, hole, f"hole {number} of {name}", cad.TOLERANCE)).faces[0]
        for edge in shape.edges:
            edge.name = _nearest(edge, named)
            edge.maxh = sizes[edge.name] / MM
        mesh = ng.Mesh(occ.OCCGeometry(shape, dim=2).GenerateMesh(maxh=size / MM, grading=0.3)).Curve(CURVING)
    _check_lengths(ng, mesh, named, name)
    return mesh


def matches(pattern, name):
    """Whether the name of a boundary fits a pattern as in "hole0:*"."""
    return fnmatchcase(name, pattern)


def _nearest(edge, named):
    """Name of the given piece that an edge of the kernel [mm] lies on, by its middle."""
    from shapely import LineString, Point

    middle = edge.Value(sum(edge.parameter_interval) / 2)
    spot = Point(MM * middle.x, MM * middle.y)
    return min(named, key=lambda name: LineString(pieces.polyline(named[name], 1e-9)).distance(spot))


def _check_sizes(sizes, fine, named):
    for pattern in fine:
        if not any(matches(pattern, name) for name in named):
            raise InputError(f"no boundary of the plate matches {pattern!r}; there are {', '.join(named)}")
    place, least = min(sizes.items(), key=lambda item: item[1])
    if not least > 0:
        raise InputError(f"the elements at {place!r} should have the size {least:g} m; it must be above 0")


def _check_lengths(ng, mesh, named, name):
    """SolverError where a boundary of the mesh has not the length of its piece: one missed would be a load missed, silently."""
    for place, piece in named.items():
        wanted = pieces.length(piece)
        found = MM * ng.Integrate(ng.CF(1) * ng.ds(place), mesh)
        if abs(found - wanted) > 2e-3 * wanted + chain.SNAP:
            raise SolverError(
                f"{name}: the mesh gives boundary {place!r} {1e3 * found:.5g} mm instead of {1e3 * wanted:.5g} mm; look for "
                "holes that cross the outline, or try a smaller size"
            )


@contextmanager
def _kernel(name):
    """Turns the kernel's and the mesher's poor messages into ours."""
    try:
        yield
    except failures(WHAT) as error:
        raise SolverError(
            f"{name}: the mesher gave up ({error}); look for very short pieces, kinks and thin walls, or try another size"
        ) from error
