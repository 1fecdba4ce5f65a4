"""Meshes [mm] of cam, split shaft and pin wheel, second order, with named faces whose areas are checked (extra `fe`)."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from drivewright.errors import SolverError
from drivewright.indexing.drivetrain import SplitShaft
from drivewright.indexing.pin_wheel import PinWheel
from drivewright.indexing.solid.parts import CamBody, ShaftBody, WheelBody
from drivewright.scene import Outline, Part, Prism, circle
from drivewright.solids.cad import MM, cad_solid, frustum_solid
from drivewright.solids.engine import EngineObject, fe_module, translated_errors
from drivewright.solids.meshing import PURPOSE, check_boundary_measures, solid_mesh
from drivewright.solids.substructures import InterfaceName
from drivewright.solids.turning import Band, Frustum, split_rings

FLAT = 1e-4  # mm: a face no higher than this is a plane across the axis
NEAR = 1e-2  # mm: how far a face of a hole may seem to reach beyond it
CAM_TOLERANCE = 2e-6  # m: of the outline in the mesh, small against any strip
PER_THICKNESS, PER_PIN, PER_SHAFT = 0.6, 0.6, 0.3  # element sizes in thicknesses of the cam, radii of a pin, radii of a seat on the shaft
STRIPS = 2.0  # element size on the cam's profile in widths sigma of the strip that loads it
GRADING = 0.4  # of the elements, from fine to coarse
AREA = 0.02  # relative error of a named area that is refused: a face missed would be a load missed, silently


def cam_mesh(outline: Outline, cam: CamBody, holes: Sequence[complex], sigma: float, fineness: float = 1.0) -> EngineObject:
    """Half a cam, 0 <= z <= thickness/2; faces "middle" (z = 0), "profile", "seat0", "seat1" of the complex hole centres."""
    circles = [circle((c.real, c.imag), d / 2) for c, d in _holes(cam, holes)]
    shape = cad_solid(Part("cam", (Prism(outline, tuple(circles), 0.0, cam.thickness / 2),)), CAM_TOLERANCE)
    size = fineness * PER_THICKNESS * MM * cam.thickness
    for face in shape.faces:
        face.name = _cam_face(face, cam, holes)
        face.maxh = min(size, fineness * STRIPS * MM * sigma) if face.name == "profile" else size
    mesh = _generated(shape, size, "the cam")
    _check_areas(mesh, {f"seat{k}": np.pi * cam.hole_diameter * cam.thickness / 2 for k in (0, 1)}, "the cam")
    return mesh


def _holes(cam, holes):
    return [(c, cam.hole_diameter) for c in holes] + ([(0j, cam.bore)] if cam.bore else [])


def _cam_face(face, cam, holes):
    low, high = face.bounding_box
    if high[2] - low[2] < FLAT:
        return "middle" if high[2] < FLAT else "side"
    for name, (centre, diameter) in zip(("seat0", "seat1", "bore"), _holes(cam, holes), strict=False):
        far = [abs(corner[axis] - MM * at) for corner in (low, high) for axis, at in enumerate((centre.real, centre.imag))]
        if max(far) < MM * diameter / 2 + NEAR:
            return name
    return "profile"


class ShaftPiece(NamedTuple):
    """A piece of the split shaft, round about the line through the complex `axis` [m]; the `place` whose seat it is."""

    frustum: Frustum
    axis: complex
    place: InterfaceName | None


def shaft_mesh(
    shaft: SplitShaft, body: ShaftBody, throws: Sequence[complex], fineness: float = 1.0
) -> tuple[EngineObject, dict[InterfaceName, str]]:
    """(mesh, {place: name of its faces}): the split shaft with its crank pins at the complex `throws`.

    Places: ("support", end), ("crank", j), ("gear",).
    """
    occ = fe_module("netgen.occ", PURPOSE)
    seats = shaft_seats(shaft, body)
    pieces, names = shaft_pieces(shaft, body, throws), {place: f"seat{n}" for n, place in enumerate(seats)}
    with _mesher("the split shaft"):
        shape = occ.Glue([frustum_solid(occ, piece.frustum, "the split shaft", piece.axis) for piece in pieces])
    fine = fineness * PER_SHAFT * MM * min(piece.frustum.end for piece in pieces) / 2
    for face in shape.faces:
        place = _seat_under(face, pieces)
        face.name = "rest" if place is None else names[place]
        if face.name != "rest":
            face.maxh = fine
    mesh = _generated(shape, fineness * MM * max(piece.frustum.start for piece in pieces) / 4, "the split shaft")
    _check_areas(
        mesh,
        {name: sum(piece.frustum.lateral_area for piece in pieces if piece.place == place) for place, name in names.items()},
        "the split shaft",
    )
    return mesh, names


def shaft_seats(shaft: SplitShaft, body: ShaftBody) -> dict[InterfaceName, Band]:
    """{place: Band} of all seats on the split shaft."""
    seats: dict[InterfaceName, Band] = {("support", end): Band(z, body.support_width) for end, z in enumerate(shaft.supports)}
    seats |= {("crank", j): Band(z, body.crank_width) for j, z in enumerate(shaft.cams)}
    return seats | {("gear",): Band(shaft.gear, body.gear_width)}


def shaft_pieces(shaft: SplitShaft, body: ShaftBody, throws: Sequence[complex]) -> list[ShaftPiece]:
    """The split shaft as `ShaftPiece`s between all ends of sections and edges of seats."""
    seats = shaft_seats(shaft, body)
    begin, sections = _extended(shaft, seats.values())
    edges = [edge for band in seats.values() for edge in band._replace(position=band.position - begin).edges]
    return [_shaft_piece(frustum, begin, seats, body, throws) for frustum in split_rings(sections, edges)]


def _shaft_piece(
    frustum: Frustum, begin: float, seats: Mapping[InterfaceName, Band], body: ShaftBody, throws: Sequence[complex]
) -> ShaftPiece:
    low, high = begin + frustum.low, begin + frustum.high
    place = next((place for place, band in seats.items() if band.holds(low, high)), None)
    if place is not None and place[0] == "crank":
        return ShaftPiece(Frustum(low, high, body.crank_diameter, body.crank_diameter, 0.0), throws[place[1]], place)
    return ShaftPiece(frustum._replace(low=low, high=high), 0j, place)


def _extended(shaft, bands):
    """(z of the left end, sections (n, 4)) with the end sections lengthened to the outer edges of the seats."""
    sections = np.array([[s.length, s.start, s.end, s.bore] for s in shaft.sections])
    before = max(0.0, *(band.width / 2 - band.position for band in bands))
    behind = max(0.0, *(band.position + band.width / 2 - sections[:, 0].sum() for band in bands))
    first, last = [before, *sections[0, [1, 1, 3]]], [behind, *sections[-1, [2, 2, 3]]]
    sections = np.vstack([first, sections, last])
    return -before, sections[sections[:, 0] > 0]


def _seat_under(face: EngineObject, pieces: Sequence[ShaftPiece]) -> InterfaceName | None:
    """The place whose seat a face is, None across the axis and in a bore."""
    low, high = face.bounding_box
    if high[2] - low[2] < FLAT:
        return None
    piece = next(each for each in pieces if each.frustum.low < (low[2] + high[2]) / 2 / MM < each.frustum.high)
    outside = high[0] - low[0] > MM * piece.frustum.bore + FLAT
    return piece.place if outside else None


def wheel_mesh(wheel: PinWheel, body: WheelBody, cams: Sequence[float], width: float, fineness: float = 1.0) -> EngineObject:
    """The rings with their pins, pin 0 on the x axis; faces "pin<k>_<j>" where cam j at z = cams[j] touches, "flange"."""
    occ = fe_module("netgen.occ", PURPOSE)
    cuts = _pin_cuts(body, cams, width)
    middles = wheel.circle_radius * np.exp(2j * np.pi * np.arange(wheel.pins) / wheel.pins)
    with _mesher("the pin wheel"):
        shape = occ.Glue(
            [
                *_rings(occ, body),
                *(_cylinder(occ, c, wheel.pin_radius, low, high) for c in middles for low, high in zip(cuts[:-1], cuts[1:], strict=True)),
            ]
        )
    for face in shape.faces:
        face.name = _wheel_face(face, middles, body, cams, width)
        if face.name.startswith("pin"):
            face.maxh = fineness * PER_PIN * MM * wheel.pin_radius
    thickness = min(high - low for low, high in body.rings)
    mesh = _generated(shape, fineness * PER_THICKNESS * MM * thickness, "the pin wheel")
    areas = {f"pin{k}_{j}": 2 * np.pi * wheel.pin_radius * width for k in range(wheel.pins) for j in range(len(cams))}
    _check_areas(mesh, areas | {"flange": np.pi / 4 * (body.flange[1] ** 2 - body.flange[0] ** 2)}, "the pin wheel")
    return mesh


def _pin_cuts(body, cams, width):
    """Heights at which a pin is cut, from its ring to its end or to the other ring."""
    edges = sorted({z + side * width / 2 for z in cams for side in (-1, 1)})
    low, high = body.rings[0]
    if len(body.rings) == 2:
        first, last = _between(body.rings)
        return _distinct([first, *edges, last])
    return _distinct([*edges, low] if edges[-1] <= low + FLAT / MM else [high, *edges])


def _distinct(heights):
    return [heights[0], *(b for a, b in zip(heights[:-1], heights[1:], strict=True) if b - a > 1e-6)]


def _rings(occ, body):
    """All rings as tubes within one another, the last one cut where the flange begins and ends, and the drum."""
    for ring in body.rings:
        yield from _tubes(occ, (body.bore, *(body.flange if ring == body.rings[-1] else ()), body.rim), ring)
    if body.drum is not None:
        yield from _tubes(occ, body.drum, _between(body.rings))


def _between(rings):
    """Heights of the room between two rings."""
    return tuple(sorted(z for ring in rings for z in ring)[1:3])


def _tubes(occ, diameters, heights):
    for inner, outer in zip(diameters[:-1], diameters[1:], strict=True):
        if outer > inner:
            yield (_cylinder(occ, 0j, outer / 2, *heights) - _cylinder(occ, 0j, inner / 2, *heights)).solids[0]


def _cylinder(occ, centre, radius, low, high):
    return occ.Cylinder(occ.Pnt(MM * centre.real, MM * centre.imag, MM * low), occ.Z, r=MM * radius, h=MM * (high - low))


def flange_height(body: WheelBody, cams: Sequence[float]) -> float:
    """Height of the outer face of the last ring, away from the cams."""
    low, high = body.rings[-1]
    return high if (low + high) / 2 > np.mean(cams) else low


def _wheel_face(face, middles, body, cams, width):
    low, high = (np.array([corner[i] for i in range(3)]) / MM for corner in face.bounding_box)
    if high[2] - low[2] < FLAT / MM:
        flange = abs(high[2] - flange_height(body, cams)) < FLAT / MM and np.allclose([*high[:2], *-low[:2]], body.flange[1] / 2, atol=1e-5)
        return "flange" if flange else "rest"
    away = np.abs(middles - complex(*(low + high)[:2] / 2))
    bands = np.abs(np.array(cams) - (low[2] + high[2]) / 2) < width / 2
    on_pin = away.min() < FLAT / MM
    return f"pin{away.argmin()}_{bands.argmax()}" if on_pin and bands.any() else "rest"


def _generated(shape, size, what):
    with _mesher(what):
        return solid_mesh(shape, size, GRADING, what)


def _check_areas(mesh, areas, what):
    """SolverError where a named face has not the area [m^2] that it should."""
    expected = {name: MM**2 * area for name, area in areas.items()}
    check_boundary_measures(mesh, expected, f"solid check: the mesh of {what} gives face", "try a smaller fineness.", relative=AREA)


def _mesher(what):
    advice = "try another fineness, or move steps that lie close together further apart."
    return translated_errors(SolverError, f"solid check: {what} could not be meshed", advice, PURPOSE)
