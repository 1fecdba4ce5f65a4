"""What keyways, grooves, holes and fillets measure: the turned part with its notches drawn on it."""

from collections.abc import Iterator

import numpy as np

from drivewright.dimensions import Dimension, Length, Radius, circles_of, corners_of, still_body, still_scene
from drivewright.mechanisms.shaft.build import ShaftModel
from drivewright.mechanisms.shaft.scene import drawings
from drivewright.mechanisms.shaft.strength_tables import NotchTable
from drivewright.scene import Arc, Outline, Scene, Shape, circle, rectangle
from drivewright.shafts.drawing import radius_at

KEYWAY = 0.28  # of the diameter: how wide a keyway is drawn


def notched(model: ShaftModel) -> Scene:
    """The turned part with its notches and the fillets of its steps."""
    shapes = [shape for shape in drawings(model)[0].shapes if shape.layer == "profile"]
    notches = [still_body(notch.name, _notch(model, notch), "orange") for notch in model.spec.notches]
    return still_scene(still_body("turned", shapes), *notches, still_body("fillet", _fillets(model), "orange"))


def _notch(model: ShaftModel, notch: NotchTable) -> Iterator[Shape]:
    """Outline of a notch where it stands: a keyway and a hole in the middle, a groove on the upper and the lower edge."""
    radius = radius_at(model.shaft, notch.position)
    if notch.kind == "keyway":
        yield Shape("edge", rectangle((notch.position + notch.length / 2, 0.0), notch.length, 2 * KEYWAY * radius))
    elif notch.kind == "cross-hole" and notch.diameter:
        yield Shape("edge", circle((notch.position, 0.0), notch.diameter / 2))
    elif notch.kind == "retaining-ring" and notch.depth and notch.width:
        for side in (1, -1):
            yield Shape("edge", rectangle((notch.position, side * (radius - notch.depth / 2)), notch.width, notch.depth))
    elif notch.kind == "round-groove" and notch.depth and notch.radius:
        for side in (1, -1):
            yield Shape("edge", circle((notch.position, side * (radius - notch.depth + notch.radius)), notch.radius))


def _fillets(model: ShaftModel) -> Iterator[Shape]:
    """Quarter circles in the corner of every step, above and below the axis, on the side of the smaller diameter."""
    shaft, fillets = model.shaft, [segment.fillet_radius for segment in model.spec.segments]
    for place, given in zip(shaft.ends[1:-1], fillets[:-1], strict=True):
        left, right = radius_at(shaft, place, "left"), radius_at(shaft, place)
        if not given or left == right:
            continue
        way, start = (1.0, np.pi) if left > right else (-1.0, 1.5 * np.pi)
        for side in (1, -1):
            centre = (float(place + way * given), side * (min(left, right) + given))
            turned = start if side > 0 else (0.5 * np.pi if way > 0 else 0.0)
            yield Shape("edge", Outline((Arc(centre, given, turned, np.pi / 2),), closed=False))


def notch_dimensions(model: ShaftModel, scene: Scene) -> Iterator[Dimension]:
    """Places and sizes, from the shapes drawn."""
    key = corners_of(scene, "key", "edge")
    start, end = min(key), max(key)
    yield Length("notches.key.position", (0.0, start[1]), start, -0.3)
    yield Length("notches.key.length", start, (end[0], start[1]), -0.2)
    (hole, bore), *_ = circles_of(scene, "oil", "edge")
    yield Radius("notches.oil.diameter", hole, bore, np.radians(45), diameter=True)
    yield Length("notches.oil.position", (0.0, hole[1]), hole, -0.42)
    ring = [corner for corner in corners_of(scene, "ring", "edge") if corner[1] > 0]
    low, high = min(y for _, y in ring), max(y for _, y in ring)
    left, right = min(x for x, _ in ring), max(x for x, _ in ring)
    yield Length("notches.ring.width", (left, high), (right, high), 0.08)
    yield Length("notches.ring.depth", (right, low), (right, high), -0.05)
    round_centre, round_radius = max(circles_of(scene, "neck", "edge"), key=lambda each: each[0][1])
    bottom = round_centre[1] - round_radius
    edge = radius_at(model.shaft, round_centre[0])
    yield Radius("notches.neck.radius", round_centre, round_radius, np.radians(-50))
    yield Length("notches.neck.depth", (round_centre[0], bottom), (round_centre[0], edge), 0.04)
    fillet = max(circles_of(scene, "fillet", "edge"), key=lambda each: each[0][1])
    yield Radius("segments.0.fillet_radius", *fillet, np.radians(-45))


def gear_dimensions(model: ShaftModel, scene: Scene) -> Iterator[Dimension]:
    """A gear on the shaft."""
    gear = corners_of(scene, "gear.wheel", "body")
    left, right = min(x for x, _ in gear), max(x for x, _ in gear)
    low, high = min(y for _, y in gear), max(y for _, y in gear)
    yield Length("gears.wheel.position", (0.0, 0.0), ((left + right) / 2, 0.0), 0.0)
    yield Length("gears.wheel.pitch_diameter", (left, low), (left, high), 0.06)
    yield Length("gears.wheel.face_width", (left, high), (right, high), 0.06)


NOTCHES = (
    'notches=[{name="key", kind="keyway", position="15 mm", length="45 mm"},'
    '{name="oil", kind="cross-hole", position="95 mm", diameter="8 mm"},'
    '{name="neck", kind="round-groove", position="125 mm", depth="5 mm", radius="8 mm"},'
    '{name="ring", kind="retaining-ring", position="170 mm", depth="5 mm", width="12 mm", radius="0.5 mm"}]',
    'segments=[{length="80 mm", diameter="40 mm", fillet_radius="8 mm"}, {length="110 mm", diameter="64 mm"}]',
)
GEAR = (
    'gears=[{name="wheel", position="190 mm", pitch_diameter="120 mm", torque="30 N m", face_width="40 mm"},'
    '{name="pinion", position="300 mm", pitch_diameter="40 mm", torque="-30 N m", face_width="24 mm"}]',
)
