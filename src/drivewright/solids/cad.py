"""CAD solids of parts with Netgen's OpenCASCADE kernel (extra `fe`): prisms of true arcs, lines and splines, round bars, turned and
grooved bodies.

A `scene.Part` is in metres; the shapes made here are in millimetres, the unit of STEP and STL files.
"""

from contextlib import contextmanager

import numpy as np

from drivewright.curves import outline_area
from drivewright.errors import InputError
from drivewright.scene import Arc, Bar, Grooved, Line, Prism, Turned
from drivewright.solids import chain, grooving, pieces, turning
from drivewright.solids.loading import failures, load

MM = 1e3
TOLERANCE = 1e-7  # m: a tenth of a micrometre in position keeps the curvature of a cam flank within a few per cent
COLOURS = {
    "steel": (0.62, 0.65, 0.70),
    "blue": (0.16, 0.38, 0.75),
    "orange": (0.90, 0.49, 0.13),
    "green": (0.20, 0.58, 0.30),
    "violet": (0.50, 0.32, 0.66),
    "ground": (0.35, 0.35, 0.35),
}


def solid(part, tolerance=TOLERANCE):
    """OCC shape [mm] of a part: its prisms, bars, turned and grooved bodies fused, placed at its pose, named and coloured.

    Splines become C2 B-splines with few poles, within `tolerance` [m] of the knots; arcs stay circles.
    """
    occ = load("netgen.occ", "a CAD solid")
    if not part.solids:
        raise InputError(f"part {part.name!r} is empty; give it a prism or a bar")
    shapes = [MAKERS[type(item)](occ, item, part.name, tolerance) for item in part.solids]
    with _kernel(f"part {part.name!r}", "fusing its solids"):
        shape = occ.Fuse(shapes).UnifySameDomain(True, True, False) if len(shapes) > 1 else shapes[0]
        x, y, angle = map(float, part.pose)
        shape = shape.Rotate(occ.Axis((0, 0, 0), occ.Z), np.degrees(angle)).Move(occ.Vec(MM * x, MM * y, 0.0))
        for body in shape.solids:  # after the last operation: names do not survive one
            body.name = part.name
            body.faces.col = tuple(c**2.2 for c in COLOURS.get(part.colour, COLOURS["steel"]))  # the kernel wants linear light
    return shape


def assembly(parts, tolerance=TOLERANCE):
    """One OCC compound [mm] of several parts, each solid with the name and the colour of its part."""
    names = [part.name for part in parts]
    if twice := sorted({name for name in names if names.count(name) > 1}):
        raise InputError(f"an assembly needs different names; {twice[0]!r} comes {names.count(twice[0])} times")
    if not parts:
        raise InputError("an assembly needs at least one part")
    return load("netgen.occ", "a CAD assembly").Compound([body for part in parts for body in solid(part, tolerance).solids])


def triangles(part, tolerance=1e-5):
    """Closed surface of a fused part as triangles, outward counter-clockwise: points (n, 3) [m] and corners (m, 3).

    Chords stay within about `tolerance` [m] of the surface: edges of h = sqrt(8 R tolerance) on a radius of curvature R.
    """
    meshing, occ = load("netgen.meshing", "an STL surface"), load("netgen.occ", "an STL surface")
    shape = solid(part)
    low, high = (np.array([corner[i] for i in range(3)]) for corner in shape.bounding_box)
    with _kernel(f"part {part.name!r}", "triangulating its surface"):
        _limit_faces(shape, MM * tolerance)
        mesh = occ.OCCGeometry(shape).GenerateMesh(
            maxh=float((high - low).max() / 4), curvaturesafety=0.3, grading=0.5, perfstepsend=meshing.MeshingStep.MESHSURFACE
        )
        corners = np.array([[vertex.nr - 1 for vertex in element.vertices] for element in mesh.Elements2D()])
    return np.array(mesh.Coordinates()) / MM, corners


def _limit_faces(shape, tolerance):
    """Mesh size on every face that is not plane: what the sharpest of its edges needs; lengths in mm."""
    for face in shape.faces:
        edges = [_along(edge, 33) for edge in face.edges]
        cloud = np.concatenate(edges)
        if np.linalg.svd(cloud - cloud.mean(axis=0), compute_uv=False)[2] > 1e-6:
            face.maxh = np.sqrt(8 * tolerance * min(map(_smallest_radius, edges)))


def _along(edge, count):
    """Points (count, 3) [mm] along an edge."""
    return np.array([[p.x, p.y, p.z] for p in map(edge.Value, np.linspace(*edge.parameter_interval, count).tolist())])


def _smallest_radius(points):
    """Least circumscribed radius of successive triples of points (n, 3)."""
    a, b = points[1:-1] - points[:-2], points[2:] - points[1:-1]
    cross = np.linalg.norm(np.cross(a, b), axis=1)
    lengths = [np.linalg.norm(v, axis=1) for v in (a, b, a + b)]
    return float((np.prod(lengths, axis=0) / np.maximum(2 * cross, 1e-12)).min())


def _prism(occ, prism, name, tolerance):
    """Outline minus holes, extruded."""
    if not prism.thickness > 0:
        raise InputError(f"part {name!r}: a prism of thickness {MM * prism.thickness:g} mm; it must be positive")
    label = f"part {name!r}"
    chain.region(prism, label)
    face = _face(occ, prism.outline, label, tolerance)
    for number, hole in enumerate(prism.holes):
        cutter = _face(occ, hole, f"hole {number} of {label}", tolerance)
        with _kernel(label, f"cutting hole {number}"):
            face = (face - cutter).faces[0]
    with _kernel(label, "extruding the outline"):
        return face.Move(occ.Vec(0, 0, MM * prism.z)).Extrude(occ.Vec(0, 0, MM * prism.thickness)).solids[0]


def _bar(occ, bar, name, tolerance):
    along = np.subtract(bar.end, bar.start)
    if not (np.hypot(*along) > 0 and bar.diameter > 0):
        raise InputError(
            f"part {name!r}: a bar of length {MM * np.hypot(*along):g} mm and diameter {MM * bar.diameter:g} mm; both must be positive"
        )
    with _kernel(f"part {name!r}", "making a bar"):
        foot = occ.Pnt(*(MM * float(c) for c in (*bar.start, bar.z)))
        return occ.Cylinder(foot, occ.Vec(*map(float, along), 0.0), r=MM * bar.diameter / 2, h=MM * float(np.hypot(*along))).solids[0]


def _turned(occ, turned, name, tolerance):
    """Half-section turned about its axis."""
    corners = turning.profile(turned.rings, f"part {name!r}")
    with _kernel(f"part {name!r}", "turning its profile"):
        foot = occ.Pnt(*(MM * float(c) for c in (*turned.start, turned.z)))
        return revolved(occ, corners, foot, occ.X, occ.Y).solids[0]


def revolved(occ, corners, foot, along, up, angle=360.0):
    """OCC solid [mm] of the half-section `corners` (n, 2) [m], (along the axis, radius), turned from `up` about `along` through `foot`."""
    points = [foot + (MM * float(s) * along + MM * float(r) * up) for s, r in corners]
    edges = [occ.Segment(a, b) for a, b in zip(points, points[1:] + points[:1], strict=True)]
    return occ.Face(occ.Wire(edges)).Revolve(occ.Axis(foot, along), angle)


def _grooved(occ, grooved, name, tolerance):
    """Half-section turned about its axis, less the grooves; what is left and what is cut away must make up the blank again."""
    label = f"part {name!r}"
    grooving.checked(grooved, label)
    section = _face(occ, grooved.section, label, tolerance)
    with _kernel(label, "turning its section and milling its grooves"):
        body = section.Revolve(occ.Axis((0, 0, 0), occ.X), 360)
        for walls in grooved.grooves:
            tool = grooving.tool(occ, MM * np.asarray(walls, float))
            left, chips = body - tool, body * tool
            if len(left.solids) != 1 or abs(left.mass + chips.mass - body.mass) > 1e-4 * body.mass or not chips.mass > 0:
                raise InputError(
                    f"{label}: the CAD kernel cut {chips.mass:.6g} mm^3 from a blank of {body.mass:.6g} mm^3 and left "
                    f"{left.mass:.6g} mm^3 in {len(left.solids)} pieces; look for walls that cross or miss the body"
                )
            body = left.solids[0]
        return body.Move(occ.Vec(*(MM * float(c) for c in (*grooved.start, grooved.z)))).solids[0]


def _face(occ, outline, name, tolerance):
    """Plane face of a closed outline, with a check that the kernel understood it."""
    outline = chain.joined(outline, name)
    ends = chain.joints(outline)
    with _kernel(name, "making a face of its outline"):
        edges = [_edge(occ, piece, a, b, tolerance, name) for piece, a, b in zip(outline.pieces, ends[:-1], ends[1:], strict=True)]
        face = occ.Face(occ.Wire(edges))
        wanted = MM**2 * outline_area(outline)
        if abs(face.mass - wanted) > 1e-4 * wanted:
            raise InputError(
                f"{name}: the CAD kernel made a face of {face.mass:.6g} mm^2 of an outline of {wanted:.6g} mm^2; "
                "look for nearly touching or very short pieces"
            )
    return face


def _edge(occ, piece, a, b, tolerance, name):
    """Edge [mm] of a piece between the points a and b."""
    if isinstance(piece, Line):
        return occ.Segment(_point(occ, a), _point(occ, b))
    if isinstance(piece, Arc):
        if 2 * piece.radius * np.sin(piece.sweep / 4) ** 2 < chain.SNAP:  # nearly straight: three points on a line crash the kernel
            return occ.Segment(_point(occ, a), _point(occ, b))
        return occ.ArcOfCircle(_point(occ, a), _point(occ, pieces.end(pieces.halves(piece)[0])), _point(occ, b))
    return _spline_edge(occ, piece, a, b, tolerance, name)


def _spline_edge(occ, spline, a, b, tolerance, name):
    """B-spline edge within `tolerance` [m] of the curve through the knots; spans are halved until the kernel's own curve is.

    OpenCASCADE mis-scales a last tangent that it is given (by 2.2 for unevenly spaced points), so no tangent is given: two extra
    points near either end let its own four-point estimate find the tangent.
    """
    curve, sparse = pieces.interpolant(spline), pieces.fit(spline, tolerance / 2)
    breaks = np.unique(sparse.t)
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


def _distance(edge, at, points, curve):
    """Largest distance [m], across the curve, between an edge and the curve at and between the knots of both."""
    chord = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    low, high = edge.parameter_interval
    s = np.union1d(pieces.between(curve.x), pieces.between(at))
    parameter = low + (high - low) * np.interp(s, at, chord) / chord[-1]
    found = np.array([[p.x, p.y] for p in map(edge.Value, parameter.tolist())]) / MM
    tangent = curve(s, 1)
    offset = found - curve(s)
    return float(np.abs(tangent[:, 0] * offset[:, 1] - tangent[:, 1] * offset[:, 0]).max() / np.hypot(*tangent.T).min())


MAKERS = {Prism: _prism, Bar: _bar, Turned: _turned, Grooved: _grooved}


def _point(occ, p):
    return occ.Pnt(MM * float(p[0]), MM * float(p[1]), 0.0)


@contextmanager
def _kernel(name, step):
    """Turns the kernel's poor messages into ours, with the part and the step."""
    try:
        yield
    except failures("a CAD solid") as error:
        raise InputError(
            f"{name}: the CAD kernel failed at {step} ({error}); look for kinks, overlaps and tiny pieces, or fuse fewer solids"
        ) from error
