"""What the keys of loads and gears measure: places along the shaft, and directions seen along its axis, x to the right and y up."""

from collections.abc import Iterator

import numpy as np

from drivewright.dimensions import Angle, Dimension, Length, body_of, corners_of, direction, origin_of, still_body, still_scene, turn
from drivewright.mechanisms.shaft.build import ShaftModel, tooth_load
from drivewright.scene import Body, Outline, Point, Scene, Shape, circle, place, polygon

SHAFT, ARROW, HEAD = 20e-3, 45e-3, 8e-3  # radius of a shaft, length of an arrow and of its head as drawn [m]
CENTRE: Point = (0.0, 0.0)


def place_dimensions(model: ShaftModel, scene: Scene) -> Iterator[Dimension]:
    """Places of a load and of the ends of a line load, and the width of a reaction."""
    point, first, *_, last = (origin_of(scene, body.name) for body in scene.bodies if body.name.startswith("load."))
    yield Length("loads.0.position", CENTRE, (point[0], 0.0), 0.16)
    yield Length("line_loads.0.start", CENTRE, (first[0], 0.0), -0.12)
    yield Length("line_loads.0.end", CENTRE, (last[0], 0.0), -0.2)


# -- seen along the axis ---------------------------------------------------------------------------------------------------------


def _arrow(vector: np.ndarray) -> tuple[Shape, ...]:
    """An arrow from the axis in the direction of a vector (x, y)."""
    turned = (0.0, 0.0, float(np.arctan2(vector[1], vector[0])))
    head = polygon(place([(ARROW, 0.0), (ARROW - HEAD, 0.4 * HEAD), (ARROW - HEAD, -0.4 * HEAD)], turned))
    return Shape("edge", polygon(place([(0.0, 0.0), (ARROW - HEAD, 0.0)], turned), closed=False)), Shape("body", head)


def load_directions(model: ShaftModel) -> Scene:
    """The shaft with the force and the moment of the first load and the first line load, and an unbalance."""
    (load, *_), (line, *_) = model.loads.points, model.loads.lines
    vectors = {"force": load.force, "moment": load.moment, "line": line.first}
    arrows = [
        still_body(name, _arrow(np.array(vector[:2])), colour)
        for (name, vector), colour in zip(vectors.items(), ("orange", "violet", "green"), strict=True)
    ]
    return still_scene(_shaft(), *arrows, _unbalance("unbalance", model.spec.stations[0].unbalance_angle))


def _shaft() -> Body:
    return still_body("shaft", [Shape("body", circle(CENTRE, SHAFT))])


def _unbalance(name: str, angle: float) -> Body:
    """An unbalance as a spot on the shaft."""
    return still_body(name, [Shape("roller", circle((0.7 * SHAFT * np.cos(angle), 0.7 * SHAFT * np.sin(angle)), 0.12 * SHAFT))], "orange")


def direction_dimensions(model: ShaftModel, scene: Scene) -> Iterator[Dimension]:
    """Angles from x towards y."""
    for name, key, radius in (
        ("force", "loads.0.angle", 0.22),
        ("line", "line_loads.0.angle", 0.28),
        ("moment", "loads.0.moment_angle", 0.34),
    ):
        ahead = direction(CENTRE, _tip(scene, name))
        yield Angle(key, CENTRE, 0.0, ahead, radius)
    yield _spot("stations.m2.unbalance_angle", scene, "unbalance", CENTRE, 0.16)


def _tip(scene: Scene, name: str) -> Point:
    return max(corners_of(scene, name, "body"), key=lambda point: float(np.hypot(*point)))


def _spot(key: str, scene: Scene, name: str, centre: Point, radius: float) -> Angle:
    x, y = np.mean(corners_of(scene, name, "roller"), axis=0)
    return Angle(key, centre, 0.0, direction(centre, (float(x), float(y))), radius)


# -- a gear seen along the axis --------------------------------------------------------------------------------------------------


def gear_mesh(model: ShaftModel) -> Scene:
    """Pitch circles of the first gear and its mate, the tangent and the force of the teeth at their pitch point."""
    gear = model.spec.gears[0]
    radius, way = gear.pitch_diameter / 2, np.array([np.cos(gear.mesh_angle), np.sin(gear.mesh_angle)])
    mate = 1.7 * radius * way
    point = radius * way
    force = np.array(tooth_load(gear).force[:2])
    across = np.array([-way[1], way[0]]) * radius
    lines: list[Outline] = [polygon(ends, closed=False) for ends in ([CENTRE, mate], [point - across, point + across])]
    return still_scene(
        _shaft(),
        still_body("gear", [Shape("base", circle(CENTRE, radius))], "violet"),
        still_body("mate", [Shape("base", circle((float(mate[0]), float(mate[1])), 0.7 * radius))], "ground"),
        still_body("lines", [Shape("axis", line) for line in lines], "ground"),
        still_body("force", _arrow(force), "orange", (float(point[0]), float(point[1]), 0.0)),
        _unbalance("gear unbalance", gear.unbalance_angle),
    )


def mesh_dimensions(model: ShaftModel, scene: Scene) -> Iterator[Dimension]:
    """Direction of the mating gear, pressure angle, unbalance."""
    start, mate, low, high = corners_of(scene, "lines", "axis")
    yield Angle("gears.wheel.mesh_angle", CENTRE, 0.0, direction(start, mate), 0.3)
    point, outlines = origin_of(scene, "force"), [shape.outline for shape in body_of(scene, "force").shapes]
    tip = max((place(outlines[1].points(), (*point, 0.0))), key=lambda each: float(np.hypot(each[0] - point[0], each[1] - point[1])))
    ahead = direction(point, (float(tip[0]), float(tip[1])))
    tangent = min((direction(point, high), direction(point, low)), key=lambda angle: abs(turn(angle, ahead)))
    sweep = turn(tangent, ahead)
    yield Angle("gears.wheel.pressure_angle", point, tangent, sweep, 0.3, times=float(np.sign(sweep)))
    yield _spot("gears.wheel.unbalance_angle", scene, "gear unbalance", CENTRE, 0.16)


PLACES = (
    'loads=[{name="belt", position="60 mm", force="500 N"}]',
    'line_loads=[{name="felt", start="180 mm", end="300 mm", force="5 N/mm"}]',
)
DIRECTIONS = (
    'loads=[{position="60 mm", force="500 N", angle="-60 deg", moment="10 N m", moment_angle="35 deg"}]',
    'line_loads=[{start="180 mm", end="300 mm", force="5 N/mm", angle="130 deg"}]',
    'stations=[{name="m2", position="245 mm", mass="8 kg", unbalance="50 g mm", unbalance_angle="80 deg"}]',
)
MESH = (
    'gears=[{name="wheel", position="190 mm", pitch_diameter="120 mm", torque="30 N m", mesh_angle="40 deg", unbalance="50 g mm",'
    'unbalance_angle="110 deg"},{name="pinion", position="300 mm", pitch_diameter="40 mm", torque="-30 N m"}]',
)
