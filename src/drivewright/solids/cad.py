"""CAD solids of parts with Netgen's OpenCASCADE kernel (extra `fe`): prisms of true arcs, lines and splines, round bars, turned and
grooved bodies.

A `scene.Part` is in metres; the shapes made here are in millimetres, the unit of STEP and STL files.
"""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np
import scipy

from drivewright._typing import ArrayLike, Floats, Ints
from drivewright.curves import outline_area
from drivewright.errors import InputError, counted
from drivewright.scene import Arc, Bar, Grooved, Line, Outline, Part, Piece, Prism, Spline, Turned
from drivewright.solids import grooving, outlines, pieces, turning
from drivewright.solids.engine import EngineObject, fe_module, translated_errors

PURPOSE = "a CAD solid"
MM = 1e3  # millimetres in a metre
TOLERANCE = 1e-7  # m: a tenth of a micrometre in position keeps the curvature of a cam flank within a few per cent
MOST_TRIANGLES = 250_000  # of equal sides: a minute of the mesher
SLIMMEST = 1e4  # largest over smallest side of a part that the mesher still covers with triangles
COLOURS = {
    "steel": (0.62, 0.65, 0.70),
    "blue": (0.16, 0.38, 0.75),
    "orange": (0.90, 0.49, 0.13),
    "green": (0.20, 0.58, 0.30),
    "violet": (0.50, 0.32, 0.66),
    "ground": (0.35, 0.35, 0.35),
}


def cad_solid(part: Part, tolerance: float = TOLERANCE) -> EngineObject:
    """OCC shape [mm] of a part: its prisms, bars, turned and grooved bodies fused, placed at its pose, named and coloured.

    Splines become C2 B-splines with few poles, within `tolerance` [m] of the knots; arcs stay circles.
    """
    occ = fe_module("netgen.occ", PURPOSE)
    if not part.solids:
        raise InputError(f"part {part.name!r} is empty; give it a prism or a bar")
    shapes = [MAKERS[type(item)](occ, item, part.name, tolerance) for item in part.solids]
    with _kernel(f"part {part.name!r}", "fusing its solids"):
        shape = occ.Fuse(shapes).UnifySameDomain(True, True, False) if len(shapes) > 1 else shapes[0]
        x, y, angle = map(float, part.pose)
        shape = shape.Rotate(occ.Axis((0, 0, 0), occ.Z), np.degrees(angle)).Move(occ.Vec(MM * x, MM * y, 0.0))
        for body in shape.solids:  # after the last operation: names do not survive one
            body.name = part.name
            body.faces.col = tuple(c**2.2 for c in COLOURS.get(part.colour, COLOURS["steel"]))  # the kernel takes linear colours
    return shape


def cad_assembly(parts: Sequence[Part], tolerance: float = TOLERANCE) -> EngineObject:
    """One OCC compound [mm] of several parts, each solid with the name and the colour of its part."""
    names = [part.name for part in parts]
    if twice := sorted({name for name in names if names.count(name) > 1}):
        raise InputError(f"an assembly needs different names; {twice[0]!r} comes {names.count(twice[0])} times")
    if not parts:
        raise InputError("an assembly needs at least one part")
    return fe_module("netgen.occ", "a CAD assembly").Compound([body for part in parts for body in cad_solid(part, tolerance).solids])


def cad_triangles(part: Part, tolerance: float = 1e-5) -> tuple[Floats, Ints]:
    """Closed surface of a fused part as triangles, outward counter-clockwise: points (n, 3) [m] and corners (m, 3).

    Chords stay within about `tolerance` [m] of the surface: edges of h = sqrt(8 R tolerance) on a radius of curvature R.
    """
    meshing, occ = fe_module("netgen.meshing", "an STL surface"), fe_module("netgen.occ", "an STL surface")
    shape = cad_solid(part)
    low, high = (np.array([corner[i] for i in range(3)]) for corner in shape.bounding_box)
    _refuse_slim(part, high - low)
    with _kernel(f"part {part.name!r}", "triangulating its surface"):
        triangles = _limit_faces(shape, MM * tolerance)
        counted(triangles, MOST_TRIANGLES, f"triangles of the surface of part {part.name!r}", "export STEP, which needs none")
        mesh = occ.OCCGeometry(shape).GenerateMesh(
            maxh=float((high - low).max() / 4), curvaturesafety=0.3, grading=0.5, perfstepsend=meshing.MeshingStep.MESHSURFACE
        )
        corners = np.array([[vertex.nr - 1 for vertex in element.vertices] for element in mesh.Elements2D()])
    return np.array(mesh.Coordinates()) / MM, corners


def _refuse_slim(part: Part, sides: Floats) -> None:
    """InputError for a part [mm] so slim that the mesher would not come to an end."""
    if sides.max() > SLIMMEST * sides.min():
        raise InputError(
            f"part {part.name!r} is {sides.max():.4g} mm long and {sides.min():.4g} mm thick: its surface cannot be divided into "
            f"triangles beyond a ratio of {SLIMMEST:g}; export STEP, which needs none, or change its sizes"
        )


def _limit_faces(shape: EngineObject, tolerance: float) -> float:
    """Mesh size on every face that is not plane: what the sharpest of its edges needs; lengths in mm.  How many triangles that makes of
    equal sides."""
    triangles = 0.0
    for face in shape.faces:
        edges = [_along(edge, 33) for edge in face.edges]
        cloud = np.concatenate(edges)
        if np.linalg.svd(cloud - cloud.mean(axis=0), compute_uv=False)[2] > 1e-6:
            face.maxh = np.sqrt(8 * tolerance * min(map(_smallest_radius, edges)))
            triangles += face.mass / (np.sqrt(3) / 4 * face.maxh**2)
    return triangles


def _along(edge: EngineObject, count: int) -> Floats:
    """Points (count, 3) [mm] along an edge."""
    start, end = edge.parameter_interval
    return np.array([[p.x, p.y, p.z] for p in map(edge.Value, np.linspace(start, end, count).tolist())])


def _smallest_radius(points: Floats) -> float:
    """Least circumscribed radius of successive triples of points (n, 3)."""
    a, b = points[1:-1] - points[:-2], points[2:] - points[1:-1]
    cross = np.linalg.norm(np.cross(a, b), axis=1)
    lengths = [np.linalg.norm(v, axis=1) for v in (a, b, a + b)]
    return float((np.prod(lengths, axis=0) / np.maximum(2 * cross, 1e-12)).min())


def _prism(occ: Any, prism: Prism, name: str, tolerance: float) -> EngineObject:
    """Outline minus holes, extruded."""
    if not prism.thickness > 0:
        raise InputError(f"part {name!r}: a prism of thickness {MM * prism.thickness:g} mm; it must be positive")
    label = f"part {name!r}"
    outlines.prism_region(prism, label)
    face = outline_face(occ, prism.outline, label, tolerance)
    for number, hole in enumerate(prism.holes):
        cutter = outline_face(occ, hole, f"hole {number} of {label}", tolerance)
        with _kernel(label, f"cutting hole {number}"):
            face = (face - cutter).faces[0]
    with _kernel(label, "extruding the outline"):
        return face.Move(occ.Vec(0, 0, MM * prism.z)).Extrude(occ.Vec(0, 0, MM * prism.thickness)).solids[0]


def _bar(occ: Any, bar: Bar, name: str, tolerance: float) -> EngineObject:
    along = np.subtract(bar.end, bar.start)
    if not (np.hypot(*along) > 0 and bar.diameter > 0):
        raise InputError(
            f"part {name!r}: a bar of length {MM * np.hypot(*along):g} mm and diameter {MM * bar.diameter:g} mm; both must be positive"
        )
    with _kernel(f"part {name!r}", "making a bar"):
        foot = occ.Pnt(*(MM * float(c) for c in (*bar.start, bar.z)))
        return occ.Cylinder(foot, occ.Vec(*map(float, along), 0.0), r=MM * bar.diameter / 2, h=MM * float(np.hypot(*along))).solids[0]


def _turned(occ: Any, turned: Turned, name: str, tolerance: float) -> EngineObject:
    """Half-section turned about its axis."""
    corners = turning.half_section(turned.rings, f"part {name!r}")
    with _kernel(f"part {name!r}", "turning its profile"):
        foot = occ.Pnt(*(MM * float(c) for c in (*turned.start, turned.z)))
        return revolved(occ, corners, foot, occ.X, occ.Y).solids[0]


def revolved(occ: Any, corners: Floats, foot: EngineObject, along: EngineObject, up: EngineObject, angle: float = 360.0) -> EngineObject:
    """OCC solid [mm] of the half-section `corners` (n, 2) [m], (along the axis, radius), turned from `up` about `along` through `foot`."""
    points = [foot + (MM * float(s) * along + MM * float(r) * up) for s, r in corners]
    edges = [occ.Segment(a, b) for a, b in zip(points, points[1:] + points[:1], strict=True)]
    return occ.Face(occ.Wire(edges)).Revolve(occ.Axis(foot, along), angle)


def frustum_solid(occ: Any, frustum: turning.Frustum, name: str, axis: complex = 0j, quarter: bool = False) -> EngineObject:
    """OCC solid [mm] of a `Frustum` about the line through (x, y) = `axis` [m] along z; of its `quarter` x <= 0 <= y."""
    rings = [(frustum.high - frustum.low, frustum.start, frustum.end, frustum.bore)]
    foot = occ.Pnt(MM * axis.real, MM * axis.imag, MM * frustum.low)
    corners = turning.half_section(rings, name)
    return revolved(occ, corners, foot, occ.Z, occ.Y, 90.0) if quarter else revolved(occ, corners, foot, occ.Z, occ.X)


def _grooved(occ: Any, grooved: Grooved, name: str, tolerance: float) -> EngineObject:
    """Half-section turned about its axis, less the grooves; what is left and what is cut away must make up the blank again."""
    label = f"part {name!r}"
    grooving.check_grooves(grooved, label)
    section = outline_face(occ, grooved.section, label, tolerance)
    with _kernel(label, "turning its section and milling its grooves"):
        body = section.Revolve(occ.Axis((0, 0, 0), occ.X), 360)
        for walls in grooved.grooves:
            tool = grooving.groove_tool(occ, MM * np.asarray(walls, float))
            left, chips = body - tool, body * tool
            if len(left.solids) != 1 or abs(left.mass + chips.mass - body.mass) > 1e-4 * body.mass or not chips.mass > 0:
                raise InputError(
                    f"{label}: the CAD kernel cut {chips.mass:.6g} mm³ from a blank of {body.mass:.6g} mm³ and left "
                    f"{left.mass:.6g} mm³ in {len(left.solids)} pieces; look for walls that cross or miss the body"
                )
            body = left.solids[0]
        return body.Move(occ.Vec(*(MM * float(c) for c in (*grooved.start, grooved.z)))).solids[0]


def outline_face(occ: Any, outline: Outline, name: str, tolerance: float = TOLERANCE) -> EngineObject:
    """Plane OCC face [mm] of a closed outline, with a check that the kernel understood it."""
    outline = outlines.normalised(outline, name)
    ends = outlines.piece_ends(outline)
    with _kernel(name, "making a face of its outline"):
        edges = [_edge(occ, piece, a, b, tolerance, name) for piece, a, b in zip(outline.pieces, ends[:-1], ends[1:], strict=True)]
        face = occ.Face(occ.Wire(edges))
        wanted = MM**2 * outline_area(outline)
        if abs(face.mass - wanted) > 1e-4 * wanted:
            raise InputError(
                f"{name}: the CAD kernel made a face of {face.mass:.6g} mm² of an outline of {wanted:.6g} mm²; "
                "look for nearly touching or very short pieces"
            )
    return face


def _edge(occ: Any, piece: Piece, a: Floats, b: Floats, tolerance: float, name: str) -> EngineObject:
    """Edge [mm] of a piece between the points a and b."""
    if isinstance(piece, Line):
        return occ.Segment(_point(occ, a), _point(occ, b))
    if isinstance(piece, Arc):
        if 2 * piece.radius * np.sin(piece.sweep / 4) ** 2 < outlines.SNAP:  # nearly straight: three points on a line crash the kernel
            return occ.Segment(_point(occ, a), _point(occ, b))
        return occ.ArcOfCircle(_point(occ, a), _point(occ, pieces.end(pieces.halves(piece)[0])), _point(occ, b))
    return _spline_edge(occ, piece, a, b, tolerance, name)


def _spline_edge(occ: Any, spline: Spline, a: Floats, b: Floats, tolerance: float, name: str) -> EngineObject:
    """B-spline edge within `tolerance` [m] of the curve through the knots; spans are halved until the kernel's own curve is.

    OpenCASCADE mis-scales a last tangent that it is given (by 2.2 for unevenly spaced points), so no tangent is given: two extra
    points near either end let its own four-point estimate find the tangent.
    """
    curve, sparse = pieces.interpolant(spline), pieces.fit(spline, tolerance / 2)
    breaks, miss = np.unique(sparse.t), np.inf
    for _ in range(8):
        first, last = breaks[1] - breaks[0], breaks[-1] - breaks[-2]
        at = np.union1d(breaks, breaks[[0, 0, -1, -1]] + [first / 16, first / 4, -last / 4, -last / 16])
        points = sparse(at)
        points[0], points[-1] = a, b
        edge = occ.SplineInterpolation([_point(occ, p) for p in points])
        miss = _distance(edge, at, points, curve)
        if miss <= tolerance:
            return edge
        breaks = np.union1d(breaks, (breaks[1:] + breaks[:-1]) / 2)
    raise InputError(
        f"{name}: a spline misses its knots by {MM * miss:.3g} mm; give knots on a smooth curve, or a wider tolerance than "
        f"{MM * tolerance:.3g} mm"
    )


def _distance(edge: EngineObject, at: Floats, points: Floats, curve: "scipy.interpolate.PPoly") -> float:
    """Largest distance [m], across the curve, between an edge and the curve at and between the knots of both."""
    chord = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    low, high = edge.parameter_interval
    s = np.union1d(pieces.between(curve.x), pieces.between(at))
    parameter = low + (high - low) * np.interp(s, at, chord) / chord[-1]
    on_edge = np.array([[p.x, p.y] for p in map(edge.Value, parameter.tolist())]) / MM
    tangent = curve(s, 1)
    offset = on_edge - curve(s)
    return float(np.abs(tangent[:, 0] * offset[:, 1] - tangent[:, 1] * offset[:, 0]).max() / np.hypot(*tangent.T).min())


MAKERS: dict[type, Callable[..., EngineObject]] = {Prism: _prism, Bar: _bar, Turned: _turned, Grooved: _grooved}


def _point(occ: Any, p: ArrayLike) -> EngineObject:
    x, y = np.asarray(p, float)
    return occ.Pnt(MM * float(x), MM * float(y), 0.0)


@contextmanager
def _kernel(name: str, step: str) -> Iterator[None]:
    """Turns the kernel's poor messages into ours, with the part and the step."""
    advice = "look for kinks, overlaps and tiny pieces, or fuse fewer solids"
    with translated_errors(InputError, f"{name}: the CAD kernel failed at {step}", advice, PURPOSE):
        yield
