"""What the keys of a spec measure, as lengths, radii and angles in a drawing of a scene: plain data, which `view.dimensions` draws.

A kind declares `DimensionSheet`s beside its scene.  The points come from the scene, by the functions at the end, so that a length that is
drawn and the key's value agree only where the key measures that length.
"""

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from drivewright.scene import Arc, Body, Frame, Point, Pose, Prism, Scene, Shape, place, rectangle


class Length(NamedTuple):
    """The distance from `start` to `end` (x, y) [m], which is `times` the key's value.

    The line of measure lies `aside` of it, to the left seen from the start, as a share of the scene's size.
    """

    key: str
    start: Point
    end: Point
    aside: float = 0.0
    times: float = 1.0

    @property
    def drawn(self) -> float:
        """The key's value by the drawing."""
        return math.dist(self.start, self.end) / self.times


class Radius(NamedTuple):
    """A circle (centre, radius [m]) with an arrow at the angle `towards`; or its diameter."""

    key: str
    centre: Point
    radius: float
    towards: float
    diameter: bool = False

    @property
    def drawn(self) -> float:
        """The key's value by the drawing."""
        return 2 * self.radius if self.diameter else self.radius


class Angle(NamedTuple):
    """The angle at `centre` from the direction `start` through `sweep` [rad], on an arc of `radius`, as a share of the scene's size; the
    angle is `times` the key's value, -1 where the key counts clockwise."""

    key: str
    centre: Point
    start: float
    sweep: float
    radius: float
    times: float = 1.0

    @property
    def drawn(self) -> float:
        """The key's value by the drawing."""
        return self.sweep / self.times


Dimension: TypeAlias = Length | Radius | Angle


class DimensionSheet(NamedTuple):
    """One drawing of a kind: a preset, with `changes` as on the command line, at the start of its scene, seen by the first observer.

    Bodies whose name begins with one of `left_out` are not drawn.  `scene(model)` replaces the kind's own.  The drawing is of the designs
    that agree with its own in every key of `variant` (a table: whether it is given); of all, where that is empty.
    """

    name: str
    title: str
    preset: str
    dimensions: Callable[[Any, Scene], Iterable[Dimension]]
    changes: tuple[str, ...] = ()
    left_out: tuple[str, ...] = ()
    scene: Callable[[Any], Scene] | None = None
    variant: tuple[str, ...] = ()


def shown(sheet: DimensionSheet, scene: Scene) -> Scene:
    """What a sheet shows of a scene: no traces, nothing that is left out."""
    return replace(scene, bodies=tuple(body for body in scene.bodies if not body.name.startswith(sheet.left_out or ("\0",))), traces=())


# -- scenes made for a drawing ---------------------------------------------------------------------------------------------------


def still_body(name: str, shapes: Iterable[Shape], colour: str = "blue", pose: Pose = (0.0, 0.0, 0.0)) -> Body:
    """A body that stands still at a pose."""
    return Body(name, name, tuple(shapes), np.array([pose, pose], float), colour)


def still_scene(*bodies: Body) -> Scene:
    """A scene of bodies that stand still."""
    return Scene(np.array([0.0, 1.0]), "", "-", 1.0, bodies, (Frame("machine", "machine frame", np.zeros((2, 3))),))


def cut_prism(prism: Prism) -> Iterator[Shape]:
    """Upper and lower half of a disc with a hole, cut along its axis, which runs to the right."""
    points, hole = prism.outline.points(), prism.holes[0].points()
    top, bottom, inner = points[:, 1].max(), points[:, 1].min(), hole[:, 1].max()
    for low, high in ((inner, top), (bottom, -inner)):
        yield Shape("profile", rectangle((prism.z + prism.thickness / 2, (low + high) / 2), prism.thickness, high - low))


# -- points of a scene -----------------------------------------------------------------------------------------------------------


def body_of(scene: Scene, name: str) -> Body:
    """The body of a name."""
    return next(body for body in scene.bodies if body.name == name)


def pose_of(scene: Scene, name: str) -> Pose:
    """Pose of a body at the start of the cycle."""
    x, y, angle = body_of(scene, name).poses[0]
    return float(x), float(y), float(angle)


def origin_of(scene: Scene, name: str) -> Point:
    """Origin of a body at the start of the cycle."""
    return pose_of(scene, name)[:2]


def placed_point(scene: Scene, name: str, point: Point) -> Point:
    """A body's own point at the start of the cycle."""
    x, y = place([point], pose_of(scene, name))[0]
    return float(x), float(y)


def circles_of(scene: Scene, name: str, layer: str) -> list[tuple[Point, float]]:
    """(centre, radius [m]) of every arc on a layer of a body, one for each place."""
    arcs = (piece for outline in _outlines(scene, name, layer) for piece in outline.pieces if isinstance(piece, Arc))
    return list(dict.fromkeys((placed_point(scene, name, arc.center), float(arc.radius)) for arc in arcs))


def corners_of(scene: Scene, name: str, layer: str) -> list[Point]:
    """Points of every outline on a layer of a body."""
    return [placed_point(scene, name, (x, y)) for outline in _outlines(scene, name, layer) for x, y in outline.points()]


def _outlines(scene: Scene, name: str, layer: str) -> Iterator[Any]:
    yield from (shape.outline for shape in body_of(scene, name).shapes if shape.layer == layer)


def direction(start: Point, end: Point) -> float:
    """Angle [rad] of the line from one point to another."""
    return math.atan2(end[1] - start[1], end[0] - start[0])


def turn(start: float, end: float) -> float:
    """The smaller angle [rad] from one direction to another, counter-clockwise positive."""
    return float((end - start + np.pi) % (2 * np.pi) - np.pi)
