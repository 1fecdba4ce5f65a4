"""What the keys of rolling bearings measure: cut along the axis, and seen along it."""

from collections.abc import Iterator

import numpy as np

from drivewright.bearings import BallBearing
from drivewright.bearings.drawing import bearing_section
from drivewright.dimensions import (
    Angle,
    Dimension,
    Length,
    Radius,
    circles_of,
    corners_of,
    direction,
    origin_of,
    still_body,
    still_scene,
    turn,
)
from drivewright.mechanisms.shaft.build import ShaftModel
from drivewright.mechanisms.shaft.scene import drawings
from drivewright.scene import Body, Point, Scene, Shape, circle, polygon, rectangle
from drivewright.shafts.drawing import radius_at

CONTACT = 0.9  # half the length of a line of contact as drawn, over the diameter of a ball


def cut(model: ShaftModel) -> Scene:
    """The shaft with its rolling bearings, cut along the axis: rings, elements, lines of contact, the width of a reaction."""
    shapes = [shape for shape in drawings(model)[0].shapes if shape.layer == "profile"]
    return still_scene(still_body("turned", shapes), *(body for bearing in model.spec.bearings for body in _bearing(model, bearing.name)))


def _bearing(model: ShaftModel, name: str) -> Iterator[Body]:
    given = next(bearing for bearing in model.spec.bearings if bearing.name == name)
    rolling, position, radius = model.rolling[name], given.position, radius_at(model.shaft, given.position)
    shapes = list(bearing_section(rolling, position, 2 * radius))
    if envelope := given.envelope:
        height = 0.5 * (envelope.outer_diameter - envelope.bore)
        middles = (side * 0.5 * (envelope.bore + height) for side in (1, -1))
        rings = [Shape("body", rectangle((position, middle), envelope.width, height)) for middle in middles]
        shapes = [*rings, *(shape for shape in shapes if shape.layer == "roller")]
    yield still_body(name, shapes, "green")
    if given.width:
        ends = [(position + side * given.width / 2, -radius) for side in (-1, 1)]
        yield still_body(f"reaction {name}", [Shape("edge", polygon(ends, closed=False))], "orange")
    if isinstance(rolling, BallBearing) and rolling.contact_angle:
        way = CONTACT * rolling.ball_diameter * np.array([np.sin(rolling.contact_angle), np.cos(rolling.contact_angle)])
        middle = np.array([position, rolling.pitch_diameter / 2])
        line = polygon([middle - way, middle + way], closed=False)
        yield still_body(f"contact {name}", [Shape("axis", line)], "ground")


def cut_dimensions(model: ShaftModel, scene: Scene) -> Iterator[Dimension]:
    """A ball bearing and a roller bearing by their inner geometry, and one by its boundary dimensions."""
    (low, below), (high, above) = _lowest_and_highest(scene, "A")
    yield Radius("bearings.A.geometry.ball_diameter", high, above, np.radians(200), diameter=True)
    yield Length("bearings.A.geometry.pitch_diameter", low, high, 0.16)
    yield _contact("bearings.A.geometry.contact_angle", scene, "A")
    below, above = sorted(_rollers(scene, "B"), key=lambda corners: corners[0][1])
    yield Length("bearings.B.roller_geometry.pitch_diameter", _middle(below), _middle(above), 0.14)
    yield Length("bearings.B.roller_geometry.roller_length", above[3], above[2], 0.08)
    yield Length("bearings.B.roller_geometry.roller_diameter", above[1], above[2], -0.06)
    axis = direction(above[0], above[1])
    yield Angle("bearings.B.roller_geometry.contact_angle", _middle(below), np.pi / 2, turn(0.0, -axis), 0.2)
    start, end = corners_of(scene, "reaction B", "edge")
    yield Length("bearings.B.width", start, end, -0.2)
    yield from _boundary(scene)


def _boundary(scene: Scene) -> Iterator[Dimension]:
    rings = corners_of(scene, "C", "body")
    right, left = max(x for x, _ in rings), min(x for x, _ in rings)
    outer, inner = max(y for _, y in rings), min(abs(y) for _, y in rings)
    yield Length("bearings.C.envelope.width", (left, outer), (right, outer), 0.06)
    yield Length("bearings.C.envelope.outer_diameter", (right, -outer), (right, outer), -0.2)
    yield Length("bearings.C.envelope.bore", (right, -inner), (right, inner), -0.1)
    yield _contact("bearings.C.envelope.contact_angle", scene, "C")


def _contact(key: str, scene: Scene, name: str) -> Angle:
    """The angle of the line of contact from the radius, at the ball above the axis."""
    start, end = corners_of(scene, f"contact {name}", "axis")
    centre = (0.5 * (start[0] + end[0]), 0.5 * (start[1] + end[1]))
    return Angle(key, centre, np.pi / 2, turn(np.pi / 2, direction(start, end)), 0.16, times=-1)


def _lowest_and_highest(scene: Scene, name: str) -> list[tuple[Point, float]]:
    found = sorted(circles_of(scene, name, "roller"), key=lambda ball: ball[0][1])
    return [found[0], found[-1]]


def _rollers(scene: Scene, name: str) -> Iterator[list[Point]]:
    corners = corners_of(scene, name, "roller")
    yield from (corners[:4], corners[4:])


def _middle(corners: list[Point]) -> Point:
    x, y = np.mean(corners, axis=0)
    return float(x), float(y)


# -- seen along the axis ---------------------------------------------------------------------------------------------------------


def along_axis(model: ShaftModel) -> Scene:
    """The balls of the first bearing around its seat, and the shaft's common axis."""
    given = model.spec.bearings[0]
    bearing = model.rolling[given.name]
    assert isinstance(bearing, BallBearing)
    turns = bearing.first_element + 2 * np.pi * np.arange(bearing.balls) / bearing.balls
    balls = [circle((r * np.cos(a), r * np.sin(a)), bearing.ball_diameter / 2) for a in turns for r in (bearing.pitch_diameter / 2,)]
    x, y = given.seat_offset
    reach = 0.5 * bearing.pitch_diameter
    cross = [polygon(ends, closed=False) for ends in ([(-reach, 0.0), (reach, 0.0)], [(0.0, -reach), (0.0, reach)])]
    return still_scene(
        still_body("balls", [Shape("roller", ball) for ball in balls], "green", (x, y, 0.0)),
        still_body("pitch", [Shape("base", circle((0.0, 0.0), bearing.pitch_diameter / 2))], "ground", (x, y, 0.0)),
        still_body("axis", [Shape("axis", line) for line in cross], "ground"),
    )


def along_axis_dimensions(model: ShaftModel, scene: Scene) -> Iterator[Dimension]:
    """The first ball, and the offset of the seat from the common axis."""
    seat = origin_of(scene, "balls")
    (first, _), *_ = circles_of(scene, "balls", "roller")
    yield Angle("bearings.A.geometry.first_element", seat, 0.0, direction(seat, first), 0.34)
    yield Length("bearings.A.seat_offset.0", (0.0, seat[1]), seat, -0.12)
    yield Length("bearings.A.seat_offset.1", (seat[0], 0.0), seat, -0.12)


BEARINGS = (
    'segments=[{length="150 mm", diameter="40 mm"}]',
    'stations=[{name="m2", position="100 mm"}]',
    'bearings=[{name="A", position="25 mm", geometry={balls=9, ball_diameter="14 mm", pitch_diameter="66 mm", contact_angle="30 deg"}},'
    '{name="B", position="75 mm", width="14 mm", roller_geometry={rollers=14, roller_diameter="10 mm", roller_length="16 mm",'
    'pitch_diameter="66 mm", contact_angle="15 deg"}},'
    '{name="C", position="120 mm", envelope={type="angular-contact", bore="40 mm", outer_diameter="90 mm", width="23 mm",'
    'contact_angle="40 deg"}}]',
)
AROUND = (
    'bearings=[{name="A", position="60 mm", seat_offset=["5 mm", "4 mm"],'
    'geometry={balls=9, ball_diameter="8 mm", pitch_diameter="40 mm", first_element="25 deg"}},'
    '{name="B", position="150 mm", radial_stiffness="3e7 N/m"}]',
)
