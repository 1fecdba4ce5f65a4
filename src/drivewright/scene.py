"""Plain data for everything that draws: figures, the motion player, DXF, STEP, the studio.

A `Scene` is labelled planar shapes that move rigidly through one cycle; a `Drawing` is one flat part on named layers;
a `Part` is a set of prisms, bars, turned and grooved bodies at its start position.  Lengths in metres, angles in radians, y up,
counter-clockwise positive.  Nothing here computes mechanics or knows a file format.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias

import numpy as np

from drivewright._typing import ArrayLike, Bools, Floats

FINEST = 1e-9  # of its radius that a chord of an arc keeps at most: 70 000 points of a circle

Point: TypeAlias = tuple[float, float]  # (x, y) [m]
Pose: TypeAlias = tuple[float, float, float]  # (x [m], y [m], angle [rad])


def place(points: ArrayLike, pose: Iterable[float], mirror: bool = False) -> Floats:
    """Points (n, 2) reflected about the x axis where asked, then carried by a pose (x, y, angle)."""
    x, y, angle = pose
    c, s = np.cos(angle), np.sin(angle)
    flip = np.array([1.0, -1.0 if mirror else 1.0])
    return (np.asarray(points, float) * flip) @ np.array([[c, s], [-s, c]]) + (x, y)


def _point(point: Point, pose: Pose, mirror: bool) -> Point:
    """One point of `place`, without arrays: outlines have thousands."""
    (x, y), c, s = point, math.cos(pose[2]), math.sin(pose[2])
    y = -y if mirror else y
    return float(c * x - s * y + pose[0]), float(s * x + c * y + pose[1])


class Line(NamedTuple):
    """Straight segment between two points (x, y)."""

    start: Point
    end: Point

    def points(self, tolerance: float) -> Floats:
        """The two ends (2, 2) [m]."""
        return np.array([self.start, self.end], float)

    def transformed(self, pose: Pose, mirror: bool) -> "Line":
        """The same reflected about the x axis where asked, then carried by a pose."""
        return Line(_point(self.start, pose, mirror), _point(self.end, pose, mirror))


class Arc(NamedTuple):
    """True circular arc: from angle `start` through the signed angle `sweep` (counter-clockwise positive)."""

    center: Point
    radius: float
    start: float
    sweep: float

    def points(self, tolerance: float) -> Floats:
        """Points (n, 2) [m] whose chords keep `tolerance` [m], or `FINEST` of the radius where that is more."""
        step = 2 * np.arccos(1 - min(max(tolerance, FINEST * self.radius) / max(self.radius, tolerance), 1.0))
        angles = self.start + self.sweep * np.linspace(0, 1, max(3, int(np.ceil(abs(self.sweep) / step)) + 1))
        return np.asarray(self.center) + self.radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)

    def transformed(self, pose: Pose, mirror: bool) -> "Arc":
        """The same reflected about the x axis where asked, then carried by a pose."""
        sign = -1.0 if mirror else 1.0
        return Arc(_point(self.center, pose, mirror), self.radius, sign * self.start + pose[2], sign * self.sweep)


class Spline(NamedTuple):
    """Smooth curve through dense `knots` (n, 2) with unit end tangents; the knots lie on the exact curve."""

    knots: Floats
    start_tangent: Point
    end_tangent: Point

    def points(self, tolerance: float) -> Floats:
        """The knots (n, 2) [m]."""
        return np.asarray(self.knots, float)

    def transformed(self, pose: Pose, mirror: bool) -> "Spline":
        """The same reflected about the x axis where asked, then carried by a pose."""
        turn = (0.0, 0.0, pose[2])
        return Spline(place(self.knots, pose, mirror), _point(self.start_tangent, turn, mirror), _point(self.end_tangent, turn, mirror))


Piece: TypeAlias = Line | Arc | Spline


class Outline(NamedTuple):
    """Chain of pieces end to end, closed unless stated otherwise."""

    pieces: tuple[Piece, ...]
    closed: bool = True

    def points(self, tolerance: float = 1e-5) -> Floats:
        """Polyline (n, 2) within `tolerance` [m] of the arcs; splines give their own knots."""
        chains = [piece.points(tolerance) for piece in self.pieces]
        joined = np.concatenate([chains[0], *(chain[1:] for chain in chains[1:])])
        return joined[:-1] if self.closed and len(joined) > 2 and np.allclose(joined[0], joined[-1], atol=1e-12) else joined

    def transformed(self, pose: Pose, mirror: bool = False) -> "Outline":
        """The same outline reflected about the x axis where asked, then carried by a pose (x, y, angle)."""
        return Outline(tuple(piece.transformed(pose, mirror) for piece in self.pieces), self.closed)


def xy(z: complex) -> Point:
    """The point (x, y) of a complex number."""
    return float(z.real), float(z.imag)


def circle(center: Point, radius: float) -> Outline:
    """Outline of a full circle, in two half arcs as most CAD kernels want it."""
    x, y = center
    return Outline((Arc((x, y), radius, 0.0, np.pi), Arc((x, y), radius, np.pi, np.pi)))


def polygon(points: ArrayLike, closed: bool = True) -> Outline:
    """Outline of straight segments through `points` (n, 2)."""
    corners: list[Point] = [(x, y) for x, y in np.asarray(points, float).tolist()]
    ends = corners[1:] + corners[:1] if closed else corners[1:]
    return Outline(tuple(Line(a, b) for a, b in zip(corners, ends, strict=False)), closed)


def rectangle(center: Point, width: float, height: float) -> Outline:
    """Outline of a rectangle, `width` along x, about its centre."""
    (x, y), half, rise = center, width / 2, height / 2
    return polygon([(x - half, y - rise), (x + half, y - rise), (x + half, y + rise), (x - half, y + rise)])


def capsule(start: Point, end: Point, radius: float) -> Outline:
    """Outline of a bar with round ends: all points within `radius` of the segment start - end."""
    (x0, y0), (x1, y1) = start, end
    angle = float(np.arctan2(y1 - y0, x1 - x0))
    side = radius * np.array([-np.sin(angle), np.cos(angle)])
    a, b = np.array(start, float), np.array(end, float)
    return Outline(
        (
            Line(tuple(a - side), tuple(b - side)),
            Arc(tuple(b), radius, angle - np.pi / 2, np.pi),
            Line(tuple(b + side), tuple(a + side)),
            Arc(tuple(a), radius, angle + np.pi / 2, np.pi),
        )
    )


class Shape(NamedTuple):
    """One outline on a layer: profile, pitch, base, roller, body, hole, axis, ground, defect, or edge (a line that covers nothing).

    `label` is what a legend calls it where it is not what the layer says.
    """

    layer: str
    outline: Outline
    label: str = ""


@dataclass(frozen=True)
class Body:
    """A rigid body: shapes in its own frame and its pose (x [m], y [m], angle [rad]) in every frame of the cycle.

    Where play or deflection is drawn `magnified` times its real size, `rest` (frames, 3) is where the body would be without it, and the
    label ends in the factor ("deflection × 2000"); a viewer may draw  rest + k (poses - rest)  for k from 0 up to `most`.
    `shown` (frames,) tells where in the cycle it is drawn; None: always.
    """

    name: str
    label: str
    shapes: tuple[Shape, ...]
    poses: Floats
    colour: str = "steel"  # a role the viewer turns into a colour: steel, blue, orange, green, violet, ground
    rest: Floats | None = None
    most: float = np.inf
    magnified: float = 1.0
    shown: Bools | None = None


@dataclass(frozen=True)
class Trace:
    """The path of a point of a body over the cycle."""

    name: str
    label: str
    body: str
    point: Point
    colour: str = ""  # a role; the viewer gives each trace one of its own unless one is named


@dataclass(frozen=True)
class Frame:
    """An observer: everything is drawn relative to `poses` (frames, 3).

    `advance` (x, y) [m] is how far the observer's own motion carries on from one cycle to the next;
    `shapes` stand still for this observer (soil line, box); `axes` are the names of what points to the right and up.
    """

    name: str
    label: str
    poses: Floats
    advance: Point = (0.0, 0.0)
    shapes: tuple[Shape, ...] = ()
    axes: tuple[str, str] = ("x", "y")


class Handle(NamedTuple):
    """A place on the drawing that a hand can move, and the key of the spec that follows it.

    `point` (x, y) [m] stands in the frame of `body`, in the machine frame where that is "".  Without `direction` the key is a point
    (x, y) in the same frame, and both of its components follow; with it the key is one number, and the handle moves by
    `direction` [m per SI unit of the key].  `label` names it beside the pointer: "A of crank".
    """

    key: str
    point: Point
    direction: Point | None = None
    body: str = ""
    label: str = ""


class Label(NamedTuple):
    """A word on the drawing, or a number with its unit, beside `point` (x, y) [m] in the frame of `body` ("": the machine frame).

    `value` [in the SI `unit`] stands behind the text; `above` says on which side of the point both stand.
    """

    text: str
    point: Point
    body: str = ""
    above: bool = True
    value: float | None = None
    unit: str = ""


@dataclass(frozen=True)
class Scene:
    """One cycle of a mechanism.  `cycle` (frames,) is the driving quantity; first and last frame close the cycle."""

    cycle: Floats
    cycle_label: str
    cycle_unit: str
    period: float
    bodies: tuple[Body, ...]
    frames: tuple[Frame, ...]
    traces: tuple[Trace, ...] = ()
    table: str = ""  # name of the result's table that shares this cycle, for the linked cursor
    marks: tuple[tuple[float, str], ...] = ()  # (cycle value, label)
    handles: tuple[Handle, ...] = ()  # what a hand can move
    labels: tuple[Label, ...] = ()  # names and numbers on the drawing


@dataclass(frozen=True)
class Drawing:
    """One flat part for manufacture: shapes on layers; `thickness` [m]; `milled` where an end mill can go round its profile."""

    name: str
    title: str
    shapes: tuple[Shape, ...]
    thickness: float = 0.0
    milled: bool = True

    def on(self, layer: str) -> tuple[Outline, ...]:
        """The outlines on a layer."""
        return tuple(shape.outline for shape in self.shapes if shape.layer == layer)


class Prism(NamedTuple):
    """Outline minus holes, extruded from height z over `thickness`."""

    outline: Outline
    holes: tuple[Outline, ...]
    z: float
    thickness: float


class Bar(NamedTuple):
    """Round bar lying in the plane from `start` to `end` (x, y) at height z."""

    start: Point
    end: Point
    z: float
    diameter: float


class Turned(NamedTuple):
    """Body of revolution about a line in the plane: from `start` (x, y) at height z in the x direction, ring after ring.

    Each of `rings` is (length, outer diameter at its start, outer diameter at its end, bore diameter); a solid one has the bore 0.
    """

    start: Point
    z: float
    rings: tuple[tuple[float, float, float, float], ...]


class Grooved(NamedTuple):
    """Body of revolution about a line in the plane, from `start` (x, y) at height z in the x direction, with grooves milled into it.

    section: closed Outline of its half-section, (distance along the axis, radius).  Each of `grooves` is an array (2, n, m, 3) of points of
    its two walls: n along the groove, m from above the body down to the floor; coordinates along the axis, across it in the plane, up.
    Floor, mouth and ends of a groove run straight from wall to wall; mouth and ends lie outside the body.
    """

    start: Point
    z: float
    section: Outline
    grooves: tuple[Floats, ...]


class Turning(NamedTuple):
    """How a part turns about a line in space: by `angles` (frames,) [rad] from its start position, right-handed about `direction` through
    `point` (x, y, z) [m], at the frames of the scene."""

    point: tuple[float, float, float]
    direction: tuple[float, float, float]
    angles: Floats


@dataclass(frozen=True)
class Part:
    """A named solid of an assembly: prisms, bars, turned and grooved bodies fused together, placed at `pose` (x, y, angle).

    It moves with the `body` of the scene, of its own name unless given; what is none of its bodies stands still.  A scene that shows a
    drive from another side, or unrolled, does not move its solids: those have a `turning` of their own.
    """

    name: str
    solids: tuple[Prism | Bar | Turned | Grooved, ...]
    pose: Pose = (0.0, 0.0, 0.0)
    colour: str = "steel"
    body: str = ""
    turning: Turning | None = None
