"""What the keys of a plate, its joint and its rows measure: one plate, two surfaces of different radii, the strand from above."""

from collections.abc import Iterator

import numpy as np

from drivewright.chains.plate_stack import strand_parts
from drivewright.chains.roller_link import pair_plate
from drivewright.dimensions import Dimension, Length, Radius, circles_of, corners_of, origin_of, still_body, still_scene
from drivewright.mechanisms.silent_chain.build import ChainModel
from drivewright.mechanisms.silent_chain.scene import link_shapes
from drivewright.scene import Arc, Body, Outline, Part, Point, Prism, Scene, Shape, polygon, rectangle

SHOWN_LINKS = 3  # of a strand seen from above
HALF_ARC = np.radians(35)  # of a rolling surface, drawn to either side of the place of contact


def plate_alone(model: ChainModel) -> Scene:
    """A plate with its pins, and its pitch line."""
    half = 0.5 * model.link.pitch
    height = float(np.asarray(model.offset))
    line = Shape("axis", polygon([(-1.3 * half, height), (1.3 * half, height)], closed=False))
    return still_scene(still_body("plate", link_shapes(model)[0]), still_body("pitch line", [line], "ground"))


def plate_dimensions(model: ChainModel, scene: Scene) -> Iterator[Dimension]:
    """Heights above the line of the pins, and the rounding of the crotch."""
    corners = np.array(corners_of(scene, "plate", "body"))
    back, toe = corners[:, 1].max(), corners[:, 1].min()
    left = float(corners[:, 0].min())
    arcs = circles_of(scene, "plate", "body")
    crotch, radius = max((arc for arc in arcs if arc[0][0] < 0), key=lambda arc: arc[0][0])
    floor = max(y for x, y in corners if abs(x) < 0.3 * model.link.pitch and y < 0)
    yield Length("plate.back", (left, 0.0), (left, float(back)), 0.06)
    yield Length("plate.toe", (left, 0.0), (left, float(toe)), -0.06, times=-1)
    yield Length("plate.crotch", (0.0, 0.0), (0.0, float(floor)), 0.0, times=-1)
    yield Radius("plate.crotch_radius", crotch, radius, np.radians(100 if crotch[0] < 0 else 80))


def rocker_dimensions(model: ChainModel, scene: Scene) -> Iterator[Dimension]:
    """Distances that are counted from the pitch line."""
    (start, end), *_ = (shape.outline.pieces[0].points(1e-6) for body in scene.bodies if body.name == "pitch line" for shape in body.shapes)
    half, height = 0.5 * model.link.pitch, float(start[1])
    right, turn = (half, height), model.spec.plate.flank_angle
    corners = np.array(corners_of(scene, "plate", "body"))
    support = float((corners @ (np.cos(turn), -np.sin(turn))).max())
    normal = np.array([np.cos(turn), -np.sin(turn)])
    foot = np.array(right) + (support - np.dot(right, normal)) * normal
    yield Length("plate.standard_apothem", right, (float(foot[0]), float(foot[1])))
    yield Length("joint.offset", (-half, 0.0), (-half, height), 0.1)


# -- a joint of two radii --------------------------------------------------------------------------------------------------------


def two_surfaces(model: ChainModel) -> Scene:
    """Two links of the straight strand with the rolling surfaces between them."""
    plate, (right, left) = pair_plate(model.link), model.link.radii
    contact = 0.5 * model.link.pitch - model.link.skew
    own = Arc((contact + right, 0.0), abs(right), np.pi - HALF_ARC, 2 * HALF_ARC)
    other = Arc((contact - left, 0.0), abs(left), -HALF_ARC, 2 * HALF_ARC)
    return still_scene(
        still_body("first", (Shape("body", plate), Shape("roller", Outline((own,), closed=False)))),
        Body("second", "second", (Shape("body", plate),), still_poses(model.link.pitch), "steel"),
        still_body("seat", (Shape("roller", Outline((other,), closed=False)),), "steel"),
    )


def still_poses(x: float) -> np.ndarray:
    """Poses of a body that stands still at a place on the x axis [m]."""
    return np.array([(x, 0.0, 0.0)] * 2)


def surface_dimensions(model: ChainModel, scene: Scene) -> Iterator[Dimension]:
    """Radii of both surfaces."""
    ((own, radius),), ((other, seat),) = (circles_of(scene, name, "roller") for name in ("first", "seat"))
    yield Length("pitch", origin_of(scene, "first"), origin_of(scene, "second"), 0.3)
    yield Radius("joint.rolling_radius", own, radius, np.pi - 0.8 * HALF_ARC)
    yield Radius("joint.seat_radius", other, seat, -0.8 * HALF_ARC)


# -- the strand from above -------------------------------------------------------------------------------------------------------


def from_above(model: ChainModel) -> Scene:
    """Links of the straight strand in all rows, seen from above: the chain runs to the right, its width upwards."""
    poses = np.array([(number * model.link.pitch, 0.0, 0.0) for number in range(SHOWN_LINKS)])
    roller = model.roller_link
    parts = tuple(roller.parts(poses)) if roller else strand_parts(model.plate, poses, model.spec.plate.lacing)
    bodies = []
    for row in range(model.rows):
        height = (row - 0.5 * (model.rows - 1)) * model.row_pitch
        for number, part in enumerate(parts):
            bodies.append(still_body(f"link {row} {number}", _seen_from_above(part), part.colour, (part.pose[0], height, 0.0)))
        pins = [Shape("edge", rectangle((x, 0.0), width, model.contact_length)) for x, width in _pins(model, poses)]
        bodies.append(still_body(f"pins {row}", pins, "orange", (0.0, height, 0.0)))
    return still_scene(*bodies)


def _seen_from_above(part: Part) -> Iterator[Shape]:
    """Its plates as rectangles; pins and rollers, which have no hole, are left out."""
    for solid in part.solids:
        if isinstance(solid, Prism) and np.ptp(points := solid.outline.points(), axis=0)[0] > 2 * solid.thickness:
            (left, _), (right, _) = points.min(axis=0), points.max(axis=0)
            yield Shape("body", rectangle((0.5 * (left + right), solid.z + 0.5 * solid.thickness), right - left, solid.thickness))


def _pins(model: ChainModel, poses: np.ndarray) -> Iterator[Point]:
    """(place [m], width [m]) of a pin or bush of every joint."""
    width = 0.6 * model.roller_diameter if model.spec.roller else np.ptp(model.plate.own_pins[1].points()[:, 0])
    yield from ((float(x) + 0.5 * model.link.pitch, float(width)) for x, _, _ in poses[:-1])


def width_dimensions(model: ChainModel, scene: Scene) -> Iterator[Dimension]:
    """Thickness of a plate, length of contact, distance of the rows."""
    plate = corners_of(scene, "link 0 0", "body")[:4]
    left, (low, high) = min(x for x, _ in plate), _ends(plate)
    pin = corners_of(scene, "pins 0", "edge")[-4:]
    right = max(x for x, _ in pin)
    yield Length("plate.thickness", (left, low), (left, high), 0.1)
    yield Length("joint.contact_length", (right, _ends(pin)[0]), (right, _ends(pin)[1]), -0.4)
    if model.rows > 1:
        middles = [origin_of(scene, f"pins {row}")[1] for row in (0, 1)]
        yield Length("row_pitch", (0.0, middles[0]), (0.0, middles[1]), 0.3)


def roller_width_dimensions(model: ChainModel, scene: Scene) -> Iterator[Dimension]:
    """Width between the inner plates of a roller chain, its plates and bushes."""
    inner = corners_of(scene, "link 0 0", "body")
    left = min(x for x, _ in inner)
    below, above = max(y for _, y in inner if y < 0), min(y for _, y in inner if y > 0)
    yield Length("roller.inner_width", (left, below), (left, above), 0.1)
    yield from width_dimensions(model, scene)


def _ends(points: list[Point]) -> tuple[float, float]:
    return min(y for _, y in points), max(y for _, y in points)
