"""Meshes [mm] of a plate and of its pins, second order, faces named after the pieces of their outlines (extra `fe`)."""

from collections.abc import Mapping
from typing import NamedTuple

from drivewright.chains.plate import Plate
from drivewright.chains.stress.plate import SIDES
from drivewright.scene import Arc, Outline, Part, Piece, Prism
from drivewright.solids import cad, pieces
from drivewright.solids.elastic import MM
from drivewright.solids.engine import EngineObject, fe_module
from drivewright.solids.meshing import solid_mesh

GRADING = 0.35
FLAT = 1e-4  # mm: a bounding box so low is a flat face; boxes carry about 1e-7 of slack


class Sizes(NamedTuple):
    """Sizes of elements [m]: of a body, on a seat, at the edge of a seat where it meets the plate's faces; in a concave rounding in
    radii of it."""

    body: float
    seat: float
    edge: float
    rounding: float = 0.25


def usual_sizes(plate: Plate, fineness: float) -> Sizes:
    """`Sizes` in proportion to the pitch, with which the largest stress is right to about 2 %; a fineness of 2 halves all elements."""
    pitch = plate.link.pitch / fineness
    return Sizes(0.14 * pitch, 0.025 * pitch, 0.0165 * pitch, 0.36 / fineness)


def plate_mesh(plate: Plate, low: float, high: float, sizes: Sizes, half: float | None = None, shift: float = 0.0) -> EngineObject:
    """Mesh of a plate between the heights low and high [m], moved along x by `shift` [m].

    Faces: "seat left", "seat right", "flank left", ..., "low", "high".  half: 1 keeps the part right of the plate's middle, -1 the left,
    with the new face "cut".
    """
    occ = fe_module("netgen.occ", "stress of solids")
    shape = cad.cad_solid(Part("plate", (Prism(plate.outline, plate.holes, low, high - low),), (shift, 0.0, 0.0)))
    middle = shift / MM
    if half is not None:
        reach = 2 * plate.link.pitch / MM
        a, b = (middle, middle + reach) if half > 0 else (middle - reach, middle)
        shape = shape * occ.Box(occ.Pnt(a, -reach, low / MM - 1), occ.Pnt(b, reach, high / MM + 1))
    named = dict(plate.pieces)
    for side in SIDES:
        seat = plate.seat(side)
        for name, piece in plate.hole(side).items():
            same = isinstance(piece, Arc) and _same_circle(piece, seat)
            named[f"seat {side}" if same else f"hole {side} {name}"] = piece
            if same and name != "seat":
                named[f"seat {side} {name}"] = piece
    _name_faces(shape, named, shift, low, high, middle if half is not None else None)
    for face in shape.faces:
        if face.name.startswith("seat"):
            face.maxh = sizes.seat / MM
            for edge in face.edges:
                if _flat(edge):
                    edge.maxh = sizes.edge / MM
        elif (size := _rounding(named.get(face.name), sizes)) is not None:
            face.maxh = size / MM
    return solid_mesh(shape, sizes.body / MM, GRADING, "a plate")


def pin_mesh(outline: Outline, high: float, ends: tuple[float, ...], sizes: Sizes, shift: float = 0.0) -> EngineObject:
    """Mesh of a pin from its middle plane "low" at 0 up to `high` [m], moved along x by `shift` [m]; its skin is "skin".

    The skin is cut at the heights `ends` [m], where plates end.
    """
    occ = fe_module("netgen.occ", "stress of solids")
    cuts = sorted({0.0, high, *(z for z in ends if 0 < z < high)})
    parts = [
        cad.cad_solid(Part("pin", (Prism(outline, (), a, b - a),), (shift, 0.0, 0.0))) for a, b in zip(cuts[:-1], cuts[1:], strict=True)
    ]
    shape = occ.Glue(parts) if len(parts) > 1 else parts[0]
    for face in shape.faces:
        low_z, high_z = (corner[2] * MM for corner in face.bounding_box)
        if high_z - low_z > FLAT * MM:
            face.name, face.maxh = "skin", 1.3 * sizes.seat / MM
        else:
            face.name = "low" if abs(low_z) < 1e-6 else "high" if abs(high_z - high) < 1e-6 else "inside"
    return solid_mesh(shape, sizes.body / MM, GRADING, "a pin")


# ---------------------------------------------------------------------------------------------------------------------- pieces


def _name_faces(shape: EngineObject, named: Mapping[str, Piece], shift: float, low: float, high: float, cut: float | None) -> None:
    from shapely import LineString, Point

    lines = {name: LineString(pieces.polyline(piece, 1e-7)) for name, piece in named.items()}
    for face in shape.faces:
        (x0, _, z0), (x1, _, z1) = ([corner[i] for i in range(3)] for corner in face.bounding_box)
        if z1 - z0 < FLAT:
            face.name = "low" if abs(z0 * MM - low) < abs(z0 * MM - high) else "high"
        elif cut is not None and x1 - x0 < FLAT and abs(x0 - cut) < FLAT:
            face.name = "cut"
        else:
            edge = next(edge for edge in face.edges if _flat(edge))
            at = edge.Value(sum(edge.parameter_interval) / 2)
            spot = Point(MM * at.x - shift, MM * at.y)
            face.name = min(lines, key=lambda name: lines[name].distance(spot))


def _rounding(piece: Piece | None, sizes: Sizes) -> float | None:
    """Size [m] in a concave rounding, where stress concentrates; the outline runs counter-clockwise."""
    if not isinstance(piece, Arc) or piece.sweep > 0:
        return None
    return max(sizes.rounding * piece.radius, 0.5 * sizes.seat)


def _flat(edge: EngineObject) -> bool:
    a, b = edge.parameter_interval
    z = [edge.Value(a + share * (b - a)).z for share in (0.0, 0.5, 1.0)]
    return max(z) - min(z) < FLAT


def _same_circle(one: Arc, other: Arc) -> bool:
    return abs(complex(*one.center) - complex(*other.center)) + abs(one.radius - other.radius) < 1e-9
