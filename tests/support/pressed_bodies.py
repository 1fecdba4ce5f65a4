"""Meshes of bodies that press on each other: discs, a plate with a hole, blocks, balls [mm]."""

import numpy as np

E, NU = 206e9, 0.3
SHEET = 1e-3  # m


def _meshed(shape, size, dim, grading=0.3):
    import netgen.occ as occ
    import ngsolve as ng

    ng.ngsglobals.msg_level = 0
    return ng.Mesh(occ.OCCGeometry(shape, dim=dim).GenerateMesh(maxh=size, grading=grading)).Curve(2)


def quarter_disc(radius, way, size, patch):
    """A quarter of a disc that touches the line y = 0 at the origin from above (1) or below (-1): "contact", "free", "flat", "sym"."""
    return _meshed(quarter_disc_face(radius, way, size, patch), radius / 6, 2)


def quarter_disc_face(radius, way, size, patch, contact="contact", flat="flat"):
    """The shape of a `quarter_disc`, a material "disc1" or "disc-1", with names of its own for two of its edges."""
    import netgen.occ as occ

    def at(turn):
        return occ.Pnt(radius * np.sin(turn), way * (radius - radius * np.cos(turn)), 0)

    end, centre = patch / radius, occ.Pnt(0, way * radius, 0)
    arcs = [occ.ArcOfCircle(at(0), at(end / 2), at(end)), occ.ArcOfCircle(at(end), at((end + np.pi / 2) / 2), at(np.pi / 2))]
    face = occ.Face(occ.Wire([*arcs, occ.Segment(at(np.pi / 2), centre), occ.Segment(centre, at(0))]))
    for edge, name in zip(face.edges, (contact, "free", flat, "sym"), strict=True):
        edge.name = name
    face.name, face.edges[0].maxh = f"disc{way}", size
    return face


def bowl(radius, way, size, patch):
    """Half a disc that touches the line y = 0 at the origin from above (1) or below (-1), both sides of it: "contact", "free", "flat"."""
    import netgen.occ as occ

    def at(turn):
        return occ.Pnt(radius * np.sin(turn), way * (radius - radius * np.cos(turn)), 0)

    turns = np.array([-np.pi / 2, -patch / radius, patch / radius, np.pi / 2])
    arcs = [occ.ArcOfCircle(at(a), at((a + b) / 2), at(b)) for a, b in zip(turns, turns[1:], strict=False)]
    face = occ.Face(occ.Wire([*arcs, occ.Segment(at(np.pi / 2), at(-np.pi / 2))]))
    for edge, name in zip(face.edges, ("free", "contact", "free", "flat"), strict=True):
        edge.name = name
    face.edges[1].maxh = size
    return _meshed(face, radius / 6, 2)


def half_disc(radius, size):
    """The right half of a disc about the origin: "contact", "sym"."""
    import netgen.occ as occ

    arc = occ.ArcOfCircle(occ.Pnt(0, -radius, 0), occ.Pnt(radius, 0, 0), occ.Pnt(0, radius, 0))
    face = occ.Face(occ.Wire([arc, occ.Segment(occ.Pnt(0, radius, 0), occ.Pnt(0, -radius, 0))]))
    face.edges[0].name, face.edges[1].name = "contact", "sym"
    face.edges[0].maxh = size
    return _meshed(face, radius / 4, 2)


def half_plate(radius, far, size):
    """The right half of a round plate with a hole: "contact", "far", "sym"."""
    import netgen.occ as occ

    p = occ.Pnt
    edges = [
        occ.Segment(p(0, -far, 0), p(0, -radius, 0)),
        occ.ArcOfCircle(p(0, -radius, 0), p(radius, 0, 0), p(0, radius, 0)),
        occ.Segment(p(0, radius, 0), p(0, far, 0)),
        occ.ArcOfCircle(p(0, far, 0), p(far, 0, 0), p(0, -far, 0)),
    ]
    face = occ.Face(occ.Wire(edges))
    for edge, name in zip(face.edges, ("sym", "contact", "sym", "far"), strict=True):
        edge.name = name
    face.edges[1].maxh = size
    return _meshed(face, far / 8, 2)


def block(low, high, size):
    """A rectangle between two corners: "bottom", "top", "left", "right"."""
    import netgen.occ as occ

    face = occ.WorkPlane().MoveTo(*low).Rectangle(high[0] - low[0], high[1] - low[1]).Face()
    face.edges.Min(occ.Y).name, face.edges.Max(occ.Y).name = "bottom", "top"
    face.edges.Min(occ.X).name, face.edges.Max(occ.X).name = "left", "right"
    return _meshed(face, size, 2)


def quarter_ball(radius, way, size, patch, whole=False):
    """A quarter of half a ball that touches z = 0 at the origin from above (1) or below (-1): "contact", "symx", "symy", "flat".

    whole: both sides of x = 0, without "symx".
    """
    import netgen.occ as occ

    low, high = sorted((0.0, way * radius))
    ball = occ.Sphere(occ.Pnt(0, 0, way * radius), radius) * occ.Box(
        occ.Pnt(-radius if whole else 0, 0, low), occ.Pnt(radius, radius, high)
    )
    core = occ.Cylinder(occ.Pnt(0, 0, -1), occ.Z, r=patch, h=2)
    shape = occ.Glue([ball - core, ball * core])
    for face in shape.faces:
        (x0, y0, z0), (x1, y1, z1) = ([corner[i] for i in range(3)] for corner in face.bounding_box)
        face.name = "rest"
        if x1 - x0 < 1e-3:
            face.name = "symx"
        elif y1 - y0 < 1e-3:
            face.name = "symy"
        elif z1 - z0 < 1e-3:
            face.name = "flat"
        elif x1 < 1.01 * patch and y1 < 1.01 * patch and min(abs(z0), abs(z1)) < 1e-3:
            face.name, face.maxh = "contact", size
    return _meshed(shape, radius / 4, 3)
