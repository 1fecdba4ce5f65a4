"""What the keys of the cutter measure: the teeth of a sprocket with a plate seated on them, and the rack that cuts them."""

from collections.abc import Iterator

import numpy as np

from drivewright._typing import Floats
from drivewright.chains.drive_scene import plate_shapes
from drivewright.chains.link import seat_height
from drivewright.chains.sprocket import Sprocket
from drivewright.dimensions import Angle, Dimension, Length, Radius, circles_of, corners_of, direction, still_body, still_scene, turn
from drivewright.mechanisms.silent_chain.build import ChainModel
from drivewright.scene import Arc, Body, Line, Outline, Scene, Shape, circle, place, polygon

TEETH = (1, 0, -1)  # of a sprocket, counted counter-clockwise from the one on the y axis
WITH_PIN = (*TEETH, -2)  # and the one beyond the measuring pin


def _sprocket(model: ChainModel) -> Sprocket:
    """The driving sprocket of a silent chain."""
    sprocket = model.sprockets[0]
    assert isinstance(sprocket, Sprocket)
    return sprocket


def _teeth(sprocket: Sprocket, numbers: tuple[int, ...]) -> Body:
    """Some teeth of a sprocket, that in the middle on the y axis."""
    half = sprocket.half_profile(1e-6)
    tooth = np.concatenate([half * (-1, 1), half[::-1]])
    around = np.concatenate([place(tooth, (0.0, 0.0, 2 * np.pi * number / sprocket.tooth.teeth)) for number in numbers])
    return still_body("sprocket", [Shape("edge", polygon(around, closed=False))], "orange")


def seated(model: ChainModel) -> Scene:
    """A plate seated on the tooth in the middle, the line of its pins, the root circle, and a measuring pin in the next space."""
    sprocket = _sprocket(model)
    height, step = seat_height(model.worn, sprocket.tooth.teeth), np.pi / sprocket.tooth.teeth
    line = Shape("axis", polygon([(-model.link.pitch, height), (1.6 * model.link.pitch, height)], closed=False))
    roots = Outline((Arc((0.0, 0.0), sprocket.root_radius, 0.5 * np.pi - 3 * step, 6 * step),), closed=False)
    pin = model.spec.cutter.measuring_pin or sprocket.best_pin
    centre = sprocket.pin_center_radius(pin) * np.exp(1j * (0.5 * np.pi - 3 * step))
    return still_scene(
        _teeth(sprocket, WITH_PIN),
        still_body("plate", plate_shapes(model.plate), "steel", (0.0, height, 0.0)),
        still_body("pin line", (line, Shape("base", roots)), "ground"),
        still_body("pin", (Shape("roller", circle((centre.real, centre.imag), pin / 2)),), "violet"),
    )


def seated_dimensions(model: ChainModel, scene: Scene) -> Iterator[Dimension]:
    """Depths of tips and roots below the line of the pins of the plate, chamfer, measuring pin."""
    (_, height), (right, _) = corners_of(scene, "pin line", "axis")
    teeth = np.array(corners_of(scene, "sprocket", "edge"))
    radius = np.hypot(*teeth.T)
    tip, root = float(radius.max()), float(radius.min())
    tops = teeth[(radius > tip - 1e-9) & (np.abs(teeth[:, 0]) < 0.2 * model.link.pitch)]
    edge = tops[np.argmin(tops[:, 0])]
    below = teeth[(radius < tip - 1e-9) & (teeth[:, 0] < edge[0]) & (teeth[:, 0] > -0.4 * model.link.pitch)]
    foot = below[np.argmax(np.hypot(*below.T))]
    top = foot * tip / np.hypot(*foot)
    yield Length("cutter.tip_depth", (0.0, tip), (0.0, height))
    yield Length("cutter.root_depth", (0.0, root), (0.0, height), 0.5)
    yield Length("cutter.chamfer", (float(foot[0]), float(foot[1])), (float(top[0]), float(top[1])))
    yield Radius("cutter.measuring_pin", *circles_of(scene, "pin", "roller")[0], np.radians(20), diameter=True)


# -- the cutter ------------------------------------------------------------------------------------------------------------------


def cutting(model: ChainModel) -> Scene:
    """The rack in the middle of its cut: a tooth of the sprocket stands between two of its teeth."""
    sprocket = _sprocket(model)
    return still_scene(_teeth(sprocket, TEETH), still_body("cutter", [Shape("edge", _rack(sprocket))], "blue"))


def _rack(sprocket: Sprocket) -> Outline:
    """Two teeth of the rack, pointing down to the root circle, each with two roundings."""
    hob, pitch, top = sprocket.hob, sprocket.cutter.pitch, sprocket.tip_radius + 0.2 * sprocket.cutter.pitch
    pieces: list[Line | Arc] = []
    at = np.array([-pitch, top])
    for middle in (-0.5 * pitch, 0.5 * pitch):
        reach = 0.5 * pitch - hob.place  # of the centre of a rounding from the middle of the tooth
        for side in (-1, 1):
            centre = np.array([middle + side * reach, hob.pitch_radius + hob.height])
            normal = hob.rounding * np.array([side * np.cos(hob.half_angle), -np.sin(hob.half_angle)])
            flank, tip = centre + normal, centre - (0.0, hob.rounding)
            head = flank + (top - flank[1]) * np.array([side * np.tan(hob.half_angle), 1.0])
            start = np.pi + hob.half_angle if side < 0 else 1.5 * np.pi
            arc = Arc((float(centre[0]), float(centre[1])), hob.rounding, start, 0.5 * np.pi - hob.half_angle)
            ends: tuple[Floats, ...] = (at, head, flank) if side < 0 else (at, tip)
            pieces += [Line(_pair(a), _pair(b)) for a, b in zip(ends, ends[1:], strict=False)] + [arc]
            pieces += [Line(_pair(flank), _pair(head))] if side > 0 else []
            at = head if side > 0 else tip
    pieces.append(Line(_pair(at), (pitch, top)))
    return Outline(tuple(pieces), closed=False)


def _pair(point: Floats) -> tuple[float, float]:
    return float(point[0]), float(point[1])


def cutting_dimensions(model: ChainModel, scene: Scene) -> Iterator[Dimension]:
    """Pitch, half angle and rounding of the rack's teeth."""
    roundings = circles_of(scene, "cutter", "edge")
    (first, _), _, (second, radius), (last, _) = roundings
    (outline,) = (shape.outline for body in scene.bodies if body.name == "cutter" for shape in body.shapes)
    flank = max((piece for piece in outline.pieces if isinstance(piece, Line)), key=lambda piece: abs(piece.start[1] - piece.end[1]))
    high, low = sorted((flank.start, flank.end), key=lambda point: -point[1])
    yield Length("cutter.pitch", first, second, 0.36)
    yield Angle("cutter.half_angle", low, 0.5 * np.pi, turn(0.5 * np.pi, direction(low, high)), 0.24, times=_sense(low, high))
    yield Radius("cutter.tip_rounding", last, radius, np.radians(-60))


def _sense(low: tuple[float, float], high: tuple[float, float]) -> float:
    """1 where the line leans to the left, as angles count, else -1."""
    return 1.0 if high[0] < low[0] else -1.0
