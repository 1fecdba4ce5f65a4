"""Meshes [mm] of cam, split shaft and pin wheel, second order, with named faces whose areas are checked (extra `fe`)."""

from contextlib import contextmanager
from typing import NamedTuple

import numpy as np

from drivewright.errors import SolverError
from drivewright.scene import Part, Prism, circle
from drivewright.solids import turning
from drivewright.solids.cad import MM, revolved, solid
from drivewright.solids.loading import failures, load
from drivewright.solids.shaft_check import Band, cut_pieces

FLAT = 1e-4  # mm: a face no higher than this is a plane across the axis
NEAR = 1e-2  # mm: how far a face of a hole may seem to reach beyond it
CAM_TOLERANCE = 2e-6  # m: of the outline in the mesh, small against any strip
PER_THICKNESS, PER_PIN, PER_SHAFT = 0.6, 0.6, 0.3  # element sizes in thicknesses of the cam, radii of a pin, radii of a seat on the shaft
STRIPS = 2.0  # element size on the cam's profile in widths sigma of the strip that loads it
AREA = 0.02  # relative error of a named area that is refused: a face missed would be a load missed, silently


def cam_mesh(outline, cam, holes, sigma, fineness=1.0):
    """Half a cam, 0 <= z <= thickness/2; faces "middle" (z = 0), "profile", "seat0", "seat1" of the complex hole centres."""
    circles = [circle((c.real, c.imag), d / 2) for c, d in _holes(cam, holes)]
    shape = solid(Part("cam", (Prism(outline, tuple(circles), 0.0, cam.thickness / 2),)), CAM_TOLERANCE)
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


class Length(NamedTuple):
    """A piece of the split shaft from z = low to high, round about the line through the complex `axis`; the `place` whose seat it is."""

    low: float
    high: float
    start: float
    end: float
    bore: float
    axis: complex
    place: tuple | None


def shaft_mesh(shaft, body, throws, fineness=1.0):
    """(mesh, {place: name of its faces}): the split shaft with its crank pins at the complex `throws`.

    Places: ("support", end), ("crank", j), ("gear",).
    """
    occ = load("netgen.occ", "a solid check")
    seats = shaft_seats(shaft, body)
    lengths, names = shaft_lengths(shaft, body, throws), {place: f"seat{n}" for n, place in enumerate(seats)}
    with _meshing("the split shaft"):
        shape = occ.Glue([_turned(occ, length) for length in lengths])
    fine = fineness * PER_SHAFT * MM * min(length.end for length in lengths) / 2
    for face in shape.faces:
        face.name = names.get(_seat_under(face, lengths), "rest")
        if face.name != "rest":
            face.maxh = fine
    mesh = _generated(shape, fineness * MM * max(length.start for length in lengths) / 4, "the split shaft")
    _check_areas(
        mesh, {name: sum(_skin(length) for length in lengths if length.place == place) for place, name in names.items()}, "the split shaft"
    )
    return mesh, names


def shaft_seats(shaft, body):
    """{place: Band} of all seats on the split shaft."""
    seats = {("support", end): Band(z, body.support_width, np.inf) for end, z in enumerate(shaft.supports)}
    seats |= {("crank", j): Band(z, body.crank_width, np.inf) for j, z in enumerate(shaft.cams)}
    return seats | {("gear",): Band(shaft.gear, body.gear_width, np.inf)}


def shaft_lengths(shaft, body, throws):
    """The split shaft as `Length`s between all ends of sections and edges of seats."""
    seats = shaft_seats(shaft, body)
    begin, sections = _extended(shaft, seats.values())
    found = []
    for piece in cut_pieces(sections, [band._replace(position=band.position - begin) for band in seats.values()], ()):
        low, high = begin + piece.low, begin + piece.high
        place = next((place for place, band in seats.items() if abs((low + high) / 2 - band.position) < band.width / 2), None)
        if place is not None and place[0] == "crank":
            found.append(Length(low, high, body.crank_diameter, body.crank_diameter, 0.0, throws[place[1]], place))
        else:
            found.append(Length(low, high, piece.start, piece.end, piece.bore, 0j, place))
    return found


def _extended(shaft, bands):
    """(z of the left end, sections (n, 4)) with the end sections lengthened to the outer edges of the seats."""
    sections = np.array([[s.length, s.start, s.end, s.bore] for s in shaft.sections])
    before = max(0.0, *(band.width / 2 - band.position for band in bands))
    behind = max(0.0, *(band.position + band.width / 2 - sections[:, 0].sum() for band in bands))
    first, last = [before, *sections[0, [1, 1, 3]]], [behind, *sections[-1, [2, 2, 3]]]
    sections = np.vstack([first, sections, last])
    return -before, sections[sections[:, 0] > 0]


def _turned(occ, length):
    corners = turning.profile([(length.high - length.low, length.start, length.end, length.bore)], "the split shaft")
    return revolved(occ, corners, occ.Pnt(MM * length.axis.real, MM * length.axis.imag, MM * length.low), occ.Z, occ.X)


def _skin(length):
    """Area [m^2] of the outside of a length, pi (D + E)/2 times the slant."""
    return np.pi * (length.start + length.end) / 2 * np.hypot(length.high - length.low, (length.end - length.start) / 2)


def _seat_under(face, lengths):
    """The place whose seat a face is, None across the axis and in a bore."""
    low, high = face.bounding_box
    if high[2] - low[2] < FLAT:
        return None
    length = next(each for each in lengths if each.low < (low[2] + high[2]) / 2 / MM < each.high)
    outside = high[0] - low[0] > MM * length.bore + FLAT
    return length.place if outside else None


def wheel_mesh(wheel, body, cams, width, fineness=1.0):
    """The rings with their pins, pin 0 on the x axis; faces "pin<k>_<j>" where cam j at z = cams[j] touches, "flange"."""
    occ = load("netgen.occ", "a solid check")
    cuts = _pin_cuts(body, cams, width)
    middles = wheel.circle_radius * np.exp(2j * np.pi * np.arange(wheel.pins) / wheel.pins)
    with _meshing("the pin wheel"):
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


def flange_height(body, cams):
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
    occ, ng = load("netgen.occ", "a solid check"), load("ngsolve", "a solid check")
    ng.ngsglobals.msg_level = 0
    with _meshing(what):
        return ng.Mesh(occ.OCCGeometry(shape).GenerateMesh(maxh=size, curvaturesafety=0.5, grading=0.4)).Curve(2)


def _check_areas(mesh, areas, what):
    """SolverError where a named face has not the area [m^2] that it should."""
    ng = load("ngsolve", "a solid check")
    for name, area in areas.items():
        found = ng.Integrate(ng.CF(1) * ng.ds(name), mesh) / MM**2
        if abs(found / area - 1) > AREA:
            raise SolverError(
                f"solid check: the mesh of {what} gives face {name!r} {MM**2 * found:.5g} mm^2 instead of "
                f"{MM**2 * area:.5g} mm^2; try a smaller fineness."
            )


@contextmanager
def _meshing(what):
    """Turns the mesher's poor messages into ours."""
    try:
        yield
    except failures("a solid check") as error:
        raise SolverError(
            f"solid check: the mesher gave up on {what} ({error}); try another fineness, or move steps that lie close "
            "together further apart."
        ) from error
