"""What the keys of a chain's spec measure, on two neighbouring links of its straight strand."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

import numpy as np

from drivewright.dimensions import Angle, Dimension, DimensionSheet, Length, Radius, circles_of, direction, origin_of, turn
from drivewright.mechanisms.silent_chain.build import ChainModel
from drivewright.mechanisms.silent_chain.scene import scene
from drivewright.scene import Body, Line, Point, Scene, place

STRAIGHT = 1e-9  # rad between two links in one line


def _links(model: ChainModel) -> Scene:
    """Two links of a straight strand, the first one level."""
    whole = scene(model)
    links = [body for body in whole.bodies if body.name.startswith("link")]
    first, second = next(pair for pair in pairwise(links) if abs(np.sin(pair[0].poses[0, 2] - pair[1].poses[0, 2])) < STRAIGHT)
    still = whole.frames[0].poses
    return replace(whole, bodies=(_placed("first", first, first, still), _placed("second", second, first, still)), frames=whole.frames[:1])


def _placed(name: str, body: Body, ground: Body, still: np.ndarray) -> Body:
    """A link as the other one sees it, standing still."""
    x, y, angle = ground.poses[0]
    at = place(place([body.poses[0, :2]], (-x, -y, 0.0)), (0.0, 0.0, -angle))[0]
    return replace(body, name=name, poses=still + (*at, body.poses[0, 2] - angle))


def _flank(scene: Scene) -> tuple[Point, Point]:
    """Lower and upper end of the outer flank on the left of the first link: the leftmost straight edge there that is not level."""
    outlines = (shape.outline for shape in scene.bodies[0].shapes if shape.layer == "body")
    lines = [piece for outline in outlines for piece in outline.pieces if isinstance(piece, Line)]
    steep = [line for line in lines if abs(line.start[1] - line.end[1]) > abs(line.start[0] - line.end[0])]
    left = min(steep, key=lambda line: line.start[0] + line.end[0])
    low, high = sorted((left.start, left.end), key=lambda point: point[1])
    return low, high


def _silent(model: ChainModel, scene: Scene) -> Iterator[Dimension]:
    low, high = _flank(scene)
    pin, _ = min(circles_of(scene, "first", "roller"))
    along = np.array(high) - low
    foot = np.array(low) + along * np.dot(np.array(pin) - low, along) / np.dot(along, along)
    yield Length("pitch", origin_of(scene, "first"), origin_of(scene, "second"), 0.25)
    yield Radius("joint.rolling_radius", *max(circles_of(scene, "second", "roller")), np.radians(60))
    yield Length("plate.apothem", pin, (float(foot[0]), float(foot[1])))
    yield Angle("plate.flank_angle", low, np.pi / 2, turn(np.pi / 2, direction(low, high)), 0.26)


def _roller(model: ChainModel, scene: Scene) -> Iterator[Dimension]:
    (first, _), (second, radius) = (circles_of(scene, name, "roller")[0] for name in ("first", "second"))
    yield Length("pitch", first, second, 0.3)
    yield Radius("roller.diameter", second, radius, np.radians(-60), diameter=True)


SHEETS = (
    DimensionSheet("silent-chain", "Silent chain: two plates of a straight strand", "default", _silent, scene=_links, variant=("roller",)),
    DimensionSheet(
        "silent-chain-roller", "Roller chain: two links of a straight strand", "roller", _roller, scene=_links, variant=("roller",)
    ),
)
