"""A shaft as a solid: the flexibility between its stations by second-order finite elements (extra `fe`), for comparison with a beam.

The shaft lies along z from its left end, y up, x completes the right-handed frame; lengths in metres.  A bearing is a band of its width
on the shaft's surface whose mean displacement along y sits on a spring; tilting within the band is free, as on a narrow rolling bearing.
A unit force at a station is spread evenly over the cross-section and acts along -y, and displacements count along -y.

A quarter of the shaft is meshed, x <= 0 <= y: the deformation is symmetric about the plane x = 0 (no displacement across it) and
antisymmetric about y = 0 (no displacement within it).
"""

from contextlib import contextmanager
from time import perf_counter
from typing import NamedTuple

import numpy as np

from drivewright.errors import InputError, SolverError
from drivewright.result import Column, Table
from drivewright.solids import turning
from drivewright.solids.cad import MM, revolved
from drivewright.solids.elastic import FreeBody, combined, held
from drivewright.solids.loading import failures, load

DOWN = (0.0, -1.0, 0.0)
QUARTERS = 4
SYMMETRY = {"dirichletx": "upright|level", "dirichletz": "level"}
SAME = 1e-6  # m: cuts closer together than this are one
FINE = 0.5  # element size on the outside and in a bore, in radii: second-order chords leave 5e-4 of the second moment
WALL = 3.0  # and in thicknesses of the wall
DRAWN = 0.06  # the largest displacement is drawn as about this part of the shaft's length


class Band(NamedTuple):
    """A bearing seat: middle of the band [m], its width [m], radial stiffness [N/m] (inf is rigid)."""

    position: float
    width: float
    stiffness: float


class Piece(NamedTuple):
    """A length of shaft between two neighbouring cuts: its ends [m], outer diameter at either end, bore."""

    low: float
    high: float
    start: float
    end: float
    bore: float


class SolidFlexibility(NamedTuple):
    """Answer of the solid check for M stations and B bands.

    flexibility (M, M) [m/N]: mean displacement of the cross-section at one station under a unit force at another.
    reactions (B, M): force of each band on the shaft, along -y like the loads, per unit force.
    points (n, 3) [m], triangles (m, 3), fields (M, n, 3) [m/N]: the surface and how each unit force displaces it.
    """

    flexibility: np.ndarray
    reactions: np.ndarray
    unknowns: int
    elements: int
    seconds: float
    points: np.ndarray
    triangles: np.ndarray
    fields: np.ndarray


def solid_flexibility(sections, modulus, poisson, bands, stations, max_size=None):
    """`SolidFlexibility` of a shaft of `sections` (length, start, end, bore) [m] on two or more `Band`s.

    stations: positions (M,) [m]; modulus E [Pa], poisson -; `max_size` [m] bounds the elements, by default half the largest diameter.
    A station on a step is loaded over the smaller of the two cross-sections; a band across a step holds the mean over both diameters.
    """
    started = perf_counter()
    sections, bands, stations = turning.checked(sections, "shaft"), [Band(*map(float, band)) for band in bands], np.array(stations, float)
    _refuse(sections, modulus, poisson, bands, stations, max_size)
    pieces = cut_pieces(sections, bands, stations)
    mesh = _mesh(pieces, bands, max_size or sections[:, 1:3].max() / 2)
    body = FreeBody(mesh, QUARTERS * modulus, poisson, **SYMMETRY)  # so stiff, the quarter carries the whole force
    seats = [_joined("skin", [n for n, piece in enumerate(pieces) if _inside(piece, band)]) for band in bands]
    places = [f"cut{_nearest_cut(pieces, station)}" for station in stations]
    _check_areas(body, pieces)
    response = body.response([body.mean(name, DOWN) for name in (*seats, *places)])
    found = held(response, [band.stiffness for band in bands])
    fields = [combined(response.fields, [*force, *unit]) for force, unit in zip(found.reactions.T, np.eye(len(stations)), strict=True)]
    surface = _whole(*body.surface(f"skin.*|rest|cut0|cut{len(pieces)}", fields, found.motions))
    return SolidFlexibility(found.flexibility, found.reactions, body.unknowns, mesh.ne, perf_counter() - started, *surface)


def cut_pieces(sections, bands, stations):
    """The shaft as `Piece`s between all ends of sections, edges of bands and stations."""
    ends = np.concatenate([[0.0], np.cumsum(np.asarray(sections, float)[:, 0])])
    edges = [band.position + side * band.width / 2 for band in bands for side in (-1, 1)]
    cuts = _merged(ends, [*edges, *stations])
    pieces = []
    for low, high in zip(cuts[:-1], cuts[1:], strict=True):
        number = int(np.searchsorted(ends, (low + high) / 2)) - 1
        length, start, end, bore = sections[number]
        at_low, at_high = (start + (end - start) * np.clip((cut - ends[number]) / length, 0.0, 1.0) for cut in (low, high))
        pieces.append(Piece(float(low), float(high), float(at_low), float(at_high), float(bore)))
    return pieces


def surface_table(solid, station, force=1.0, name="solid_surface", title="Deformed solid", exaggeration=None):
    """Table of the deformed surface for a plot of style "mesh": three rows a triangle.

    `station` numbers the loaded one, `force` [N] acts there along -y; displacements are drawn `exaggeration` times as large, by default
    a round number that makes them visible.
    """
    displacement = force * solid.fields[station]
    size = np.linalg.norm(displacement, axis=1)
    factor = exaggeration or _round_factor(DRAWN * np.ptp(solid.points[:, 2]) / max(size.max(), 1e-300))
    drawn = solid.points + factor * displacement
    rows = solid.triangles.ravel()
    told = f"displacement, drawn {f'{factor:,.0f}'.replace(',', ' ') if factor >= 1 else f'{factor:.2g}'} times as large"
    columns = (
        ("z", "position along the shaft", drawn[:, 2]),
        ("y", "height", drawn[:, 1]),
        ("x", "depth", drawn[:, 0]),
        ("displacement", told, size),
        ("rest_z", "position along the unloaded shaft", solid.points[:, 2]),
        ("rest_y", "height of the unloaded shaft", solid.points[:, 1]),
    )
    return Table(name, title, tuple(Column(key, "m", meaning, data[rows]) for key, meaning, data in columns))


def _refuse(sections, modulus, poisson, bands, stations, max_size):
    """InputError for what has no solution or cannot be meshed."""
    length = sections[:, 0].sum()
    if not (np.isfinite(modulus) and modulus > 0 and -1 < poisson < 0.5):
        raise InputError(f"solid check: modulus {modulus:g} Pa and Poisson's ratio {poisson:g}; a solid wants E > 0 and -1 < nu < 0.5")
    if max_size is not None and not max_size > 0:
        raise InputError(f"solid check: max_size {MM * max_size:g} mm; elements want a positive size, or None for half the diameter")
    if len(bands) < 2:
        raise InputError(f"solid check: {len(bands)} bearing; it wants two or more, for bands hold mean displacements and no tilt")
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
            raise InputError(f"solid check: a station at {MM * station:g} mm is off the shaft of 0 ... {MM * length:g} mm; move it onto it")


def _merged(fixed, others):
    """`fixed` cuts and those of the others that are not next to one already there, in order."""
    cuts = list(fixed)
    for cut in others:
        if min(abs(cut - known) for known in cuts) > SAME:
            cuts.append(cut)
    return np.sort(cuts)


def _inside(piece, band):
    return abs((piece.low + piece.high) / 2 - band.position) < band.width / 2


def _nearest_cut(pieces, position):
    return int(np.argmin([abs(cut - position) for cut in (*(piece.low for piece in pieces), pieces[-1].high)]))


def _joined(name, numbers):
    """Regular expression of several named faces."""
    return "|".join(f"{name}{number}" for number in numbers)


def _mesh(pieces, bands, max_size):
    """Curved mesh [mm] of the glued pieces with the faces cut0, cut1 ... across, skin0, skin1 ... outside, upright, level, rest."""
    occ, ng = load("netgen.occ", "a solid check"), load("ngsolve", "a solid check")
    ng.ngsglobals.msg_level = 0
    with _meshing(max_size):
        shape = occ.Glue([_solid(occ, piece) for piece in pieces])
        for face in shape.faces:
            face.name, piece = _name(face, pieces)
            if piece is not None:
                width = min((band.width for band in bands if _inside(piece, band)), default=np.inf)
                face.maxh = MM * min(max_size, _size(piece, width, outside=face.name != "rest"))
        return ng.Mesh(occ.OCCGeometry(shape).GenerateMesh(maxh=MM * max_size, curvaturesafety=0.5, grading=0.3)).Curve(2)


def _solid(occ, piece):
    length = piece.high - piece.low
    corners = turning.profile([(length, piece.start, piece.end, piece.bore)], "shaft")
    return revolved(occ, corners, occ.Pnt(0.0, 0.0, MM * piece.low), occ.Z, occ.Y, 360.0 / QUARTERS)


def _size(piece, width, outside):
    """Element size on the outside or in the bore of a piece; under a bearing the band's width counts too, within reason."""
    diameter = min(piece.start, piece.end)
    wall = WALL * (diameter - piece.bore) / 2
    return min(FINE * diameter / 2, wall, max(width, diameter / 10)) if outside else min(FINE * piece.bore / 2, wall)


def _name(face, pieces):
    """(name, Piece of a face along the shaft) by its place and its area, which tells a shared cross-section from the shoulder around it."""
    low, high = face.bounding_box
    if (flat := next((n for n in range(3) if high[n] - low[n] < 1e-4), None)) in (0, 1):
        return ("upright", "level")[flat], None
    if flat == 2:
        number = _nearest_cut(pieces, face.center.z / MM)
        return (f"cut{number}" if abs(face.mass / _cut_area(pieces, number) - 1) < 1e-3 else "rest"), None
    middle = (low[2] + high[2]) / 2 / MM
    number = next(n for n, piece in enumerate(pieces) if piece.low < middle < piece.high)
    outside = abs(face.mass / _skin_area(pieces[number]) - 1) < 1e-3
    return f"skin{number}" if outside else "rest", pieces[number]


def _cut_area(pieces, number):
    """Area [mm^2] of a quarter of the cross-section that the pieces on both sides of a cut share."""
    before, behind = pieces[max(number - 1, 0) : number], pieces[number : number + 1]
    beside = [(piece.end, piece.bore) for piece in before] + [(piece.start, piece.bore) for piece in behind]
    outer, bore = min(d for d, _ in beside), max(b for _, b in beside)
    return MM**2 * np.pi / 4 * (outer**2 - bore**2) / QUARTERS


def _skin_area(piece):
    """Area [mm^2] of a quarter of the outside of a piece, pi (D + E)/2 times the slant."""
    slant = np.hypot(piece.high - piece.low, (piece.end - piece.start) / 2)
    return MM**2 * np.pi * (piece.start + piece.end) / 2 * slant / QUARTERS


def _check_areas(body, pieces):
    """SolverError where a named face of the mesh has not the area that it should: a face missed would be a load missed, silently."""
    wanted = {f"cut{n}": _cut_area(pieces, n) for n in range(len(pieces) + 1)}
    wanted |= {f"skin{n}": _skin_area(piece) for n, piece in enumerate(pieces)}
    for name, area in wanted.items():
        if abs(body.area(name) / area - 1) > 0.01:
            raise SolverError(
                f"solid check: the mesh gives face {name!r} {body.area(name):.5g} mm^2 instead of {area:.5g} mm^2; try a smaller max_size"
            )


def _whole(points, triangles, fields):
    """The surface and displacements of all four quarters: mirrored in x = 0, and with changed sign in y = 0."""
    found = []
    for x in (1, -1):
        for y in (1, -1):
            turned = triangles if x == y else triangles[:, ::-1]
            found.append((points * (x, y, 1), turned + len(found) * len(points), fields * (x * y, 1, y)))
    points, triangles, fields = zip(*found, strict=True)
    return np.concatenate(points), np.concatenate(triangles), np.concatenate(fields, axis=1)


@contextmanager
def _meshing(max_size):
    """Turns the mesher's poor messages into ours."""
    try:
        yield
    except failures("a solid check") as error:
        raise SolverError(
            f"solid check: the mesher gave up ({error}); try another max_size than {MM * max_size:g} mm, or move stations, "
            "steps and the edges of bearings that lie close together further apart"
        ) from error


def _round_factor(factor):
    """The largest of 1, 2, 5 times a power of ten up to `factor`."""
    power = 10.0 ** np.floor(np.log10(factor))
    return next(step * power for step in (5, 2, 1) if step * power <= factor * (1 + 1e-12))
