"""Every body of a pin-wheel indexer condensed to what its neighbours feel: flexibility and rigid motion between interface loads.

A functional of a body is a mean displacement over one of its places in one direction; its unit load is the unit force spread over that
place.  A rigid body has the same functionals without flexibility.
"""

from typing import Any, NamedTuple

import numpy as np

from drivewright.errors import SolverError
from drivewright.indexing.solid import meshes
from drivewright.indexing.stiffness.layout import bending_flexibility, torsion_flexibility
from drivewright.solids.elastic import MM as METRE
from drivewright.solids.elastic import FreeBody

HALVES = 2
EXTRA = 6  # orders of integration beyond the elements' own, for a strip that is narrower than they are
EULER = 0.5772156649015329
BALANCE = 3e-4  # relative difference of resultants to those of the undeformed geometry that is refused
PLANAR, NO_AXIAL, ALL = (0, 1, 5), (0, 1, 3, 4, 5), (0, 1, 2, 3, 4, 5)  # rigid motions: three shifts, three turns


TURN_RADIUS = 0.01  # m: at which the rotation of a gear's seat counts as a displacement


class Place(NamedTuple):
    """What the unit load of a functional does on a rigid body: force (3,), and moment (3,) [m] about the origin of its frame."""

    name: tuple
    force: np.ndarray
    moment: np.ndarray


class Condensed(NamedTuple):
    """A body between n functionals, numbered by their names.

    flexibility (n, n) [m/N]; resultants (m, n): force, and moment [m], of the unit loads on the rigid motions that the body makes.
    unknowns: of the mesh, 0 for a rigid body; free, fields, motions: for `FreeBody.surface`, None for a rigid one.
    """

    number: dict
    flexibility: np.ndarray
    resultants: np.ndarray
    motions: tuple
    unknowns: int = 0
    free: Any = None
    fields: tuple = ()


def rigid(places, motions):
    """`Condensed` of a rigid body."""
    resultants = np.array([np.concatenate([place.force, place.moment]) for place in places]).T[list(motions)]
    return Condensed(_numbered(places), np.zeros((len(places), len(places))), resultants, motions)


def elastic(free, functionals, places, motions, what):
    """`Condensed` of a `FreeBody`; SolverError where a load is not the one that it should be."""
    response = free.response(functionals)
    six = free.basis @ response.resultants
    moments = METRE * (free.size * six[3:] + np.cross(free.middle, six[:3].T).T)
    found = np.vstack([six[:3], moments])[list(motions)]
    wanted = rigid(places, motions).resultants
    _refuse_unbalanced(found, wanted, places, METRE * free.size, motions, what)
    return Condensed(_numbered(places), response.flexibility, found, motions, free.unknowns, free, response.fields)


def _numbered(places):
    return {place.name: n for n, place in enumerate(places)}


def _refuse_unbalanced(found, wanted, places, size, motions, what):
    scale = np.where(np.array(motions) < 3, 1.0, size)[:, None]
    off = np.abs((found - wanted) / scale).max(axis=0)
    if off.max() > BALANCE:
        raise SolverError(
            f"solid check: the load {places[int(off.argmax())].name} on the mesh of {what} is off by {off.max():.2g} of "
            "itself; try a smaller fineness."
        )


def vector_places(name, point):
    """The two `Place`s of the mean displacement at a point (x, y, z), along x and along y."""
    for axis in (0, 1):
        along = np.eye(3)[axis]
        yield Place((*name, axis), along, np.cross(point, along))


# ----------------------------------------------------------------------------------------------------------------------- cam


def cam(outline, body, holes, strips, sigma, fineness):
    """Condensed cam in its own frame: ("seat", side, axis) at the complex hole centres, ("contact", *key) of strips {key: (point, normal)}.

    point complex [m] on the profile, normal the direction of the displacement, out of the cam.
    """
    places = cam_places(holes, strips)
    if body is None:
        return rigid(places, PLANAR)
    mesh = meshes.cam_mesh(outline, body, holes, sigma, fineness)
    free = FreeBody(mesh, HALVES * body.modulus, body.poisson, dirichletz="middle")  # so stiff, the half carries the whole force
    functionals = [free.mean(f"seat{side}", np.eye(3)[axis]) for side in (0, 1) for axis in (0, 1)]
    functionals += [strip(free, point, normal, sigma) for point, normal in strips.values()]
    return elastic(free, functionals, places, PLANAR, "the cam")


def cam_places(holes, strips):
    seats = [place for side, c in enumerate(holes) for place in vector_places(("seat", side), (c.real, c.imag, 0.0))]
    contacts = [
        Place(("contact", *key), np.array([n.real, n.imag, 0.0]), np.array([0.0, 0.0, (p.conjugate() * n).imag]))
        for key, (p, n) in strips.items()
    ]
    return seats + contacts


def strip(free, point, normal, sigma):
    """Functional: mean displacement along `normal` over the profile, weighted by exp(-r^2/2 sigma^2) of the distance r to the point.

    Only the flank that faces along the normal counts.  A part linear along the flank brings the resultant to the point exactly, also at a
    corner.  Lengths in metres.
    """
    ng = free.ng
    x, y = ng.x - point.real / METRE, ng.y - point.imag / METRE
    ahead = normal.real * ng.specialcf.normal(3)[0] + normal.imag * ng.specialcf.normal(3)[1]
    along = normal.real * y - normal.imag * x
    weight = ng.IfPos(ahead, ahead, 0) * ng.exp(-(x * x + y * y) / (2 * (sigma / METRE) ** 2))
    area = ng.ds("profile", bonus_intorder=EXTRA)
    m0, m1, m2 = (float(ng.Integrate(weight * along**n * area, free.mesh)) for n in range(3))
    if not m2 * m0 > m1 * m1:
        raise SolverError(f"solid check: no part of the profile lies at the contact at ({point.real:.5g}, {point.imag:.5g}) m.")
    slope = -m1 / m2
    balanced = weight * (1 + slope * along) / (m0 + slope * m1)
    return (
        ng.LinearForm(ng.InnerProduct(balanced * ng.CF((float(normal.real), float(normal.imag), 0)), free.space.TestFunction()) * area)
        .Assemble()
        .vec
    )


def dent(sigma, depth, body):
    """Approach [m/N] of a Gaussian strip on a half-space of the cam's width b and a point at `depth` under it, mean over the strip:

    2 (1 - nu^2)/(pi E b) [ln(depth/sigma) + gamma/2 - 1/(2 (1 - nu))],

    from Flamant's line load in plane strain, and E ln|X - Y| = ln sigma - gamma/2 of two normal variables.
    """
    logarithm = np.log(depth / sigma) + EULER / 2 - 1 / (2 * (1 - body.poisson))
    return 2 * (1 - body.poisson**2) / (np.pi * body.modulus * body.thickness) * logarithm


# --------------------------------------------------------------------------------------------------------------------- shaft


def shaft(drive, body, throws, fineness):
    """Condensed split shaft, its axis at the origin and its crank pins at the complex `throws`.

    ("support", end, axis), ("crank", j, axis), ("gear", axis), and ("gear", "turn"): the rotation of the gear's seat times TURN_RADIUS.
    """
    places = shaft_places(drive.shaft, throws)
    if body is None:
        return rigid(places, NO_AXIAL)._replace(flexibility=beam_flexibility(drive.shaft, places))
    mesh, faces = meshes.shaft_mesh(drive.shaft, body, throws, fineness)
    free = FreeBody(mesh, drive.shaft.modulus, drive.shaft.poisson)
    functionals = [free.mean(faces[place.name[:-1]], place.force) for place in places[:-1]]
    functionals.append(turn(free, faces[("gear",)], TURN_RADIUS))
    return elastic(free, functionals, places, NO_AXIAL, "the split shaft")


def shaft_places(shaft, throws):
    """A rigid shaft without measures stands on its front support, as in the reduced model."""
    supports, cams, gear = (shaft.supports, shaft.cams, shaft.gear) if shaft else ((0.0, 1.0), [0.0] * len(throws), 0.0)
    places = [place for end, z in enumerate(supports) for place in vector_places(("support", end), (0.0, 0.0, z))]
    for j, (z, c) in enumerate(zip(cams, throws, strict=True)):
        places += vector_places(("crank", j), (c.real, c.imag, z))
    places += vector_places(("gear",), (0.0, 0.0, gear))
    return [*places, Place(("gear", "turn"), np.zeros(3), np.array([0.0, 0.0, TURN_RADIUS]))]


def beam_flexibility(shaft, places):
    """(n, n) of the reduced model's beam and rod: bending against the supports, torsion against the gear."""
    found = np.zeros((len(places), len(places)))
    if shaft is None:
        return found
    names = [("gear",), *(("crank", j) for j in range(len(shaft.cams)))]
    bending = bending_flexibility(shaft)
    for axis in (0, 1):
        at = [n for name in names for n, place in enumerate(places) if place.name == (*name, axis)]
        found[np.ix_(at, at)] += bending
    torsion = torsion_flexibility(shaft)
    cranks = {n: place for n, place in enumerate(places) if place.name[0] == "crank"}
    for n, first in cranks.items():
        for m, second in cranks.items():
            found[n, m] += first.moment[2] * torsion[first.name[1], second.name[1]] * second.moment[2]
    return found


def turn(free, region, radius):
    """Functional: rotation of named faces about the z axis, in least squares, times `radius` [m]."""
    ng = free.ng
    around = ng.CF((-ng.y, ng.x, 0))
    moment = ng.Integrate((ng.x * ng.x + ng.y * ng.y) * ng.ds(region), free.mesh)
    return free.weighted(region, radius / METRE / float(moment) * around)


# --------------------------------------------------------------------------------------------------------------------- wheel


def wheel(drive, wheel, body, width, touched, fineness):
    """Condensed pin wheel with pin 0 on the x axis: ("pin", k, j, axis) for `touched` (k, j), and ("flange", motion) of its output.

    Rotations of the flange are times the radius of the pin circle.
    """
    heights = drive.shaft.cams if drive.shaft else None
    radius = wheel.circle_radius
    if body is None:
        return rigid(wheel_places(wheel, np.zeros(wheel.pins), touched, 0.0), PLANAR)
    places = wheel_places(wheel, heights, touched, meshes.flange_height(body, heights))
    free = FreeBody(meshes.wheel_mesh(wheel, body, heights, width, fineness), body.modulus, body.poisson)
    functionals = [free.mean(f"pin{place.name[1]}_{place.name[2]}", place.force) for place in places if place.name[0] == "pin"]
    functionals += [free.mean("flange", along) for along in np.eye(3)]
    functionals += [_tilt(free, axis, radius) for axis in (0, 1)] + [turn(free, "flange", radius)]
    return elastic(free, functionals, places, ALL, "the pin wheel")


def wheel_places(wheel, heights, touched, flange):
    middles = wheel.circle_radius * np.exp(2j * np.pi * np.arange(wheel.pins) / wheel.pins)
    places = [place for k, j in touched for place in vector_places(("pin", k, j), (middles[k].real, middles[k].imag, heights[j]))]
    places += [Place(("flange", n), along, np.cross((0.0, 0.0, flange), along)) for n, along in enumerate(np.eye(3))]
    return [*places, *(Place(("flange", 3 + n), np.zeros(3), wheel.circle_radius * along) for n, along in enumerate(np.eye(3)))]


def _tilt(free, axis, radius):
    """Functional: rotation of the flange about x (axis 0) or y (1), from its displacement along z, times `radius` [m]."""
    ng = free.ng
    arm = (ng.y, -ng.x)[axis]
    moment = ng.Integrate(arm * arm * ng.ds("flange"), free.mesh)
    return free.weighted("flange", radius / METRE / float(moment) * ng.CF((0, 0, arm)))
