"""A shaft as a solid: the flexibility between its stations by second-order finite elements (extra `fe`), for comparison with a beam.

The shaft lies along z from its left end, y up, x completes the right-handed frame; lengths in metres.  A bearing is a band of its width
on the shaft's surface whose mean displacement along y sits on a spring; tilting within the band is free, as on a narrow rolling bearing.
A unit force at a station is spread evenly over the cross-section and acts along -y, and displacements count along -y.

A quarter of the shaft is meshed, x <= 0 <= y: the deformation is symmetric about the plane x = 0 (no displacement across it) and
antisymmetric about y = 0 (no displacement within it).
"""

from collections.abc import Iterable, Iterator, Sequence
from time import perf_counter
from typing import NamedTuple

import numpy as np

from drivewright._typing import ArrayLike, Floats
from drivewright.errors import InputError, SolverError
from drivewright.result import Table
from drivewright.shafts.assembly import assemble, nodal_forces
from drivewright.shafts.beam import POINT
from drivewright.shafts.equilibrium import ShaftEquilibrium, solve
from drivewright.shafts.influence import flexibility
from drivewright.shafts.model import Shaft, Support
from drivewright.solids.cad import MM, frustum_solid
from drivewright.solids.deformation import DisplacedSurface, displaced_table, exaggeration_for, with_mirror_images
from drivewright.solids.elastic import FreeBody, spring_supported, superposed_field
from drivewright.solids.engine import EngineObject, fe_module, translated_errors
from drivewright.solids.meshing import PURPOSE, check_boundary_measures, solid_mesh
from drivewright.solids.turning import SAME, Band, Frustum, checked_rings, split_rings

DOWN = (0.0, -1.0, 0.0)
QUARTERS = 4
SYMMETRY = {"dirichletx": "upright|level", "dirichletz": "level"}
QUARTER_IMAGES = tuple(((x, y, 1), (x * y, 1, y)) for x in (1, -1) for y in (1, -1))  # changed sign in y = 0, mirrored in x = 0
GRADING = 0.3  # of the elements, from fine to coarse
FINE = 0.5  # element size on the outside and in a bore, in radii: second-order chords leave 5e-4 of the second moment
WALL = 3.0  # and in thicknesses of the wall
DRAWN = 0.06  # the largest displacement is drawn as about this part of the shaft's length
ALLOWED, AT_SHOULDERS = 0.01, 0.05  # of the diagonals: what a beam does not know of the ground under a bearing, and of shoulders


class SolidFlexibility(NamedTuple):
    """Answer of the solid check for M stations and B bands.

    flexibility (M, M) [m/N]: mean displacement of the cross-section at one station under a unit force at another.
    reactions (B, M): force of each band on the shaft, along -y like the loads, per unit force.
    surface: of the whole shaft, displacements (M, n, 3) [m/N] by each unit force.
    """

    flexibility: Floats
    reactions: Floats
    unknowns: int
    elements: int
    seconds: float
    surface: DisplacedSurface


def solid_flexibility(
    sections: Sequence[Sequence[float]] | Floats,
    modulus: float,
    poisson: float,
    bands: Iterable[Sequence[float]],
    stations: ArrayLike,
    max_size: float | None = None,
) -> SolidFlexibility:
    """`SolidFlexibility` of a shaft of `sections` (length, start, end, bore) [m] on two or more `Band`s (position, width, stiffness).

    stations: positions (M,) [m]; modulus E [Pa], poisson -; `max_size` [m] bounds the elements, by default half the largest diameter.
    A station on a step is loaded over the smaller of the two cross-sections; a band across a step holds the mean over both diameters.
    """
    started = perf_counter()
    rings, seats, places = checked_rings(sections, "shaft"), [Band(*map(float, band)) for band in bands], np.array(stations, float)
    _refuse(rings, modulus, poisson, seats, places, max_size)
    pieces = split_rings(rings, [*(edge for band in seats for edge in band.edges), *places])
    mesh = _mesh(pieces, seats, max_size or rings[:, 1:3].max() / 2)
    body = FreeBody(mesh, QUARTERS * modulus, poisson, None, **SYMMETRY)  # so stiff, the quarter carries the whole force
    skins = [_any_of("skin", [n for n, piece in enumerate(pieces) if band.holds(piece.low, piece.high)]) for band in seats]
    cuts = [f"cut{_nearest_cut(pieces, place)}" for place in places]
    _check_areas(mesh, pieces)
    response = body.response([body.mean(name, DOWN) for name in (*skins, *cuts)])
    supported = spring_supported(response, [band.stiffness for band in seats])
    fields = [
        superposed_field(response.fields, [*force, *unit]) for force, unit in zip(supported.reactions.T, np.eye(len(places)), strict=True)
    ]
    quarter = body.surface(f"skin.*|rest|cut0|cut{len(pieces)}", fields, supported.motions)
    surface = with_mirror_images(quarter, QUARTER_IMAGES)
    return SolidFlexibility(supported.flexibility, supported.reactions, body.unknowns, mesh.ne, perf_counter() - started, surface)


def surface_table(
    solid: SolidFlexibility,
    station: int,
    force: float = 1.0,
    name: str = "solid_surface",
    title: str = "Deformed solid",
    exaggeration: float | None = None,
) -> Table:
    """Table of the deformed surface for a plot of style "mesh": three rows a triangle.

    `station` numbers the loaded one, `force` [N] acts there along -y; displacements are drawn `exaggeration` times as large, by default
    a round number that makes them visible.
    """
    displacement = force * solid.surface.displacements[station]
    factor = exaggeration or exaggeration_for(float(np.ptp(solid.surface.points[:, 2])), displacement, DRAWN)
    drawn = (2, "position along the shaft"), (1, "height"), (0, "depth")
    rest = (2, "position along the unloaded shaft"), (1, "height of the unloaded shaft")
    return displaced_table(name, title, solid.surface, displacement, factor, drawn, rest)


# -- beside the beam -----------------------------------------------------------------------------------------------------------


def bearing_bands(equilibrium: ShaftEquilibrium, direction: ArrayLike, point_width: float) -> tuple[Band, ...]:
    """A `Band` for every bearing of a shaft at rest that resists along `direction` (x, y): its width [m], or `point_width` where it is a
    point, and its radial tangent stiffness there, its seat in series.  At an end of the shaft the band lies inside it."""
    return tuple(_bearing_bands(equilibrium, np.asarray(direction, float), point_width))


def _bearing_bands(equilibrium: ShaftEquilibrium, direction: Floats, point_width: float) -> Iterator[Band]:
    shaft, way = equilibrium.model.beam.shaft, np.concatenate([direction, np.zeros(3)])
    for support, tangent in zip(shaft.supports, equilibrium.tangent, strict=True):
        rigid = np.isinf(np.diag(tangent)) @ np.abs(way) > 0
        stiffness = np.inf if rigid else float(way @ np.where(np.isfinite(tangent), tangent, 0.0) @ way)
        if stiffness > 0:
            yielding = 1 / stiffness + float(np.sum(direction**2 / np.array(support.seat[:2])))
            own = support.width > POINT * shaft.length
            width = support.width if own else min(point_width, shaft.length / 10)
            middle = float(np.clip(support.position, width / 2, shaft.length - width / 2))
            yield Band(middle, width, 1 / yielding if yielding else np.inf)


def beam_on_bands(shaft: Shaft, bands: Sequence[Band], stations: Sequence[float], direction: ArrayLike) -> Floats:
    """Flexibility (M, M) [m/N] of the beam between stations [m], along `direction` (x, y), on the bands in place of its bearings."""
    supports = tuple(
        Support(f"band {n}", band.position, (band.stiffness,) * 2 + (0.0,) * 3, width=band.width) for n, band in enumerate(bands)
    )
    system = assemble(shaft._replace(supports=supports))
    return flexibility(solve(system, nodal_forces(system, ())), stations, direction).delta


def solid_and_beam(
    equilibrium: ShaftEquilibrium, stations: Sequence[float], direction: ArrayLike, point_width: float
) -> tuple[SolidFlexibility, Floats]:
    """The `SolidFlexibility` of a shaft at rest, and the flexibility (M, M) [m/N] of the beam, both on its `bearing_bands`."""
    shaft, bands = equilibrium.model.beam.shaft, bearing_bands(equilibrium, direction, point_width)
    solid = solid_flexibility([section[:4] for section in shaft.sections], shaft.modulus, shaft.poisson, bands, tuple(stations))
    return solid, beam_on_bands(shaft, bands, stations, direction)


def relative_difference(beam: Floats, solid: Floats) -> float:
    """Largest |a_ij - b_ij|/sqrt(b_ii b_jj) of the flexibilities a of the beam and b of the solid, both (stations, stations) [m/N]."""
    scale = np.sqrt(np.outer(np.diag(solid), np.diag(solid)))
    return float(np.abs((beam - solid) / scale).max())


def allowed_difference(shaft: Shaft) -> float:
    """Largest difference of beam and solid that needs no explanation, over the diagonals."""
    ends = [(section.start, section.end, section.bore) for section in shaft.sections]
    smooth = all(one[1] == two[0] and one[2] == two[2] for one, two in zip(ends, ends[1:], strict=False))
    return ALLOWED if smooth else AT_SHOULDERS


# -- what cannot be meshed -----------------------------------------------------------------------------------------------------


def _refuse(sections: Floats, modulus: float, poisson: float, bands: Sequence[Band], stations: Floats, max_size: float | None) -> None:
    """InputError for what has no solution or cannot be meshed."""
    length = sections[:, 0].sum()
    if not (np.isfinite(modulus) and modulus > 0 and -1 < poisson < 0.5):
        raise InputError(f"solid check: modulus {modulus:g} Pa and Poisson's ratio {poisson:g}; a solid needs E > 0 and -1 < nu < 0.5")
    if max_size is not None and not max_size > 0:
        raise InputError(f"solid check: max_size {MM * max_size:g} mm; elements need a positive size, or be left out for half the diameter")
    if len(bands) < 2:
        raise InputError(f"solid check: {len(bands)} bearing; it needs two or more, since bands hold mean displacements but no tilt")
    if not len(stations):
        raise InputError("solid check: no station; give at least one position to load")
    for number, band in enumerate(bands):
        low, high = band.position - band.width / 2, band.position + band.width / 2
        if not (band.width > 0 and band.stiffness > 0 and np.isfinite(band.position)):
            raise InputError(
                f"solid check: band {number} at {MM * band.position:g} mm has width {MM * band.width:g} mm and stiffness "
                f"{band.stiffness:g} N/m; both must be positive"
            )
        if low < -SAME or high > length + SAME:
            raise InputError(
                f"solid check: band {number} reaches from {MM * low:g} to {MM * high:g} mm, beyond the shaft of 0 ... "
                f"{MM * length:g} mm; make it narrower or move it"
            )
    ordered = sorted(bands)
    for left, right in zip(ordered[:-1], ordered[1:], strict=True):
        if left.position + left.width / 2 > right.position - right.width / 2 + SAME:
            raise InputError(f"solid check: the bands at {MM * left.position:g} and {MM * right.position:g} mm overlap; make them narrower")
    for station in stations:
        if not -SAME <= station <= length + SAME:
            raise InputError(
                f"solid check: a station at {MM * station:g} mm lies outside the shaft of 0 ... {MM * length:g} mm; move it onto the shaft"
            )


# -- the mesh of a quarter -----------------------------------------------------------------------------------------------------


def _nearest_cut(pieces: Sequence[Frustum], position: float) -> int:
    return int(np.argmin([abs(cut - position) for cut in (*(piece.low for piece in pieces), pieces[-1].high)]))


def _any_of(name: str, numbers: Iterable[int]) -> str:
    """Regular expression of several named faces."""
    return "|".join(f"{name}{number}" for number in numbers)


def _mesh(pieces: Sequence[Frustum], bands: Sequence[Band], max_size: float) -> EngineObject:
    """Curved mesh [mm] of the glued pieces with the faces cut0, cut1 ... across, skin0, skin1 ... outside, upright, level, rest."""
    occ = fe_module("netgen.occ", PURPOSE)
    advice = (
        f"try another max_size than {MM * max_size:g} mm, or move stations, steps and the edges of bearings that lie close together "
        "further apart"
    )
    with translated_errors(SolverError, "solid check: the shaft could not be meshed", advice, PURPOSE):
        shape = occ.Glue([frustum_solid(occ, piece, "shaft", quarter=True) for piece in pieces])
        for face in shape.faces:
            face.name, piece = _name(face, pieces)
            if piece is not None:
                width = min((band.width for band in bands if band.holds(piece.low, piece.high)), default=np.inf)
                face.maxh = MM * min(max_size, _size(piece, width, outside=face.name != "rest"))
        return solid_mesh(shape, MM * max_size, GRADING)


def _size(piece: Frustum, width: float, outside: bool) -> float:
    """Element size on the outside or in the bore of a piece; under a bearing the band's width counts too, within reason."""
    diameter = min(piece.start, piece.end)
    wall = WALL * (diameter - piece.bore) / 2
    return min(FINE * diameter / 2, wall, max(width, diameter / 10)) if outside else min(FINE * piece.bore / 2, wall)


def _name(face: EngineObject, pieces: Sequence[Frustum]) -> tuple[str, Frustum | None]:
    """(name, `Frustum` of a face along the shaft) by its place and its area: a shared cross-section is less than the shoulder around it."""
    low, high = face.bounding_box
    if (flat := next((n for n in range(3) if high[n] - low[n] < 1e-4), None)) in (0, 1):
        return ("upright", "level")[flat], None
    if flat == 2:
        number = _nearest_cut(pieces, face.center.z / MM)
        return (f"cut{number}" if abs(face.mass / _cut_area(pieces, number) - 1) < 1e-3 else "rest"), None
    middle = (low[2] + high[2]) / 2 / MM
    number = min(range(len(pieces)), key=lambda n: max(pieces[n].low - middle, middle - pieces[n].high))
    outside = abs(face.mass / _skin_area(pieces[number]) - 1) < 1e-3
    return f"skin{number}" if outside else "rest", pieces[number]


def _cut_area(pieces: Sequence[Frustum], number: int) -> float:
    """Area [mm^2] of a quarter of the cross-section that the pieces on both sides of a cut share."""
    before, behind = pieces[max(number - 1, 0) : number], pieces[number : number + 1]
    beside = [(piece.end, piece.bore) for piece in before] + [(piece.start, piece.bore) for piece in behind]
    outer, bore = min(d for d, _ in beside), max(b for _, b in beside)
    return MM**2 * np.pi / 4 * (outer**2 - bore**2) / QUARTERS


def _check_areas(mesh: EngineObject, pieces: Sequence[Frustum]) -> None:
    expected = {f"cut{n}": _cut_area(pieces, n) for n in range(len(pieces) + 1)}
    expected |= {f"skin{n}": _skin_area(piece) for n, piece in enumerate(pieces)}
    check_boundary_measures(mesh, expected, "solid check: the mesh gives face", "try a smaller max_size")


def _skin_area(piece: Frustum) -> float:
    """Area [mm^2] of a quarter of the outside of a piece."""
    return MM**2 * piece.lateral_area / QUARTERS
