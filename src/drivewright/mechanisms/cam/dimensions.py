"""What the keys of a cam's spec measure, in drawings of its presets."""

from collections.abc import Iterator

import numpy as np

from drivewright.dimensions import (
    Angle,
    Dimension,
    DimensionSheet,
    Length,
    Radius,
    body_of,
    circles_of,
    corners_of,
    direction,
    origin_of,
    turn,
)
from drivewright.mechanisms.cam.build import CamModel
from drivewright.scene import Point, Scene, place

AXIS: Point = (0.0, 0.0)


def _bore(scene: Scene) -> Radius:
    (centre, radius), *_ = circles_of(scene, "cam", "hole")
    return Radius("manufacture.bore", centre, radius, np.radians(215), diameter=True)


def _highest(scene: Scene, point: Point) -> Point:
    """Where a point of the follower is at the end of the first segment, given where it is at the start."""
    poses = body_of(scene, "follower").poses
    frame = int(np.argmax(np.hypot(*(poses - poses[0])[:, :2].T) + np.abs(poses[:, 2] - poses[0, 2])))
    x0, y0, a0 = poses[0]
    own = place([(point[0] - x0, point[1] - y0)], (0.0, 0.0, -a0))
    x, y = place(own, poses[frame])[0]
    return float(x), float(y)


def _slide(model: CamModel, scene: Scene) -> Iterator[Dimension]:
    """A roller on a slide."""
    roller, radius = circles_of(scene, "follower", "roller")[0]
    yield Length("follower.prime_radius", AXIS, roller)
    yield Length("follower.offset", AXIS, (roller[0], 0.0), -0.46)
    yield Radius("follower.roller_radius", roller, radius, np.radians(-15))
    yield Length("programme.0.rise", roller, _highest(scene, roller), -0.16)
    yield _bore(scene)


def _lever(model: CamModel, scene: Scene) -> Iterator[Dimension]:
    """A roller on a lever."""
    pivot = origin_of(scene, "follower")
    roller, radius = circles_of(scene, "follower", "roller")[0]
    yield Length("follower.prime_radius", AXIS, roller)
    yield Length("follower.pivot_distance", AXIS, pivot, -0.30)
    yield Length("follower.arm_length", roller, pivot, 0.16)
    yield Radius("follower.roller_radius", roller, radius, np.radians(100))
    start = direction(pivot, roller)
    yield Angle("programme.0.rise", pivot, start, turn(start, direction(pivot, _highest(scene, roller))), 0.36, times=-1)


def _lever_alone(model: CamModel, scene: Scene) -> Iterator[Dimension]:
    yield from _lever(model, scene)
    yield _bore(scene)


def _conjugate(model: CamModel, scene: Scene) -> Iterator[Dimension]:
    """The second roller of a lever on two cams."""
    first, second = (centre for centre, _ in circles_of(scene, "follower", "roller"))
    pivot = origin_of(scene, "follower")
    yield Length("follower.prime_radius", AXIS, first)
    yield Length("conjugate.prime_radius", AXIS, second)
    yield Length("follower.pivot_distance", AXIS, pivot, -0.6)
    yield Length("follower.arm_length", first, pivot, 0.14)


def _flat(model: CamModel, scene: Scene) -> Iterator[Dimension]:
    """A flat face on a slide."""
    _, radius = circles_of(scene, "cam", "base")[0]
    corners = corners_of(scene, "follower", "body")[4:]
    low = min(corners, key=lambda corner: (round(corner[1], 9), -corner[0]))
    yield Radius("follower.base_radius", AXIS, radius, np.radians(200))
    yield Length("programme.0.rise", low, _highest(scene, low), -0.12)
    yield _bore(scene)


def _valve(model: CamModel, scene: Scene) -> Iterator[Dimension]:
    """A rocker with a valve under its second arm."""
    pivot = origin_of(scene, "follower")
    roller, radius = circles_of(scene, "follower", "roller")[0]
    ends = [centre for centre, _ in circles_of(scene, "follower", "body")]
    pad = max(ends, key=lambda end: end[0])
    _, base = circles_of(scene, "cam", "base")[0]
    yield Radius("follower.base_radius", AXIS, base, np.radians(200))
    yield Radius("follower.roller_radius", roller, radius, np.radians(60))
    yield Length("follower.pivot_distance", AXIS, pivot, -0.34)
    yield Length("follower.arm_length", roller, pivot, 0.14)
    yield Length("valve.arm_length", pivot, pad, 0.14)
    yield Angle("valve.start_angle", pivot, 0.0, direction(pivot, pad), 0.6, times=-1)


SHEETS = (
    DimensionSheet("cam", "Disc cam, roller on a slide", "default", _slide, changes=("follower.offset=12 mm",)),
    DimensionSheet("cam-oscillating", "Disc cam, roller on a lever", "oscillating", _lever_alone),
    DimensionSheet("cam-flat", "Disc cam, flat face on a slide", "flat", _flat),
    DimensionSheet("cam-conjugate", "Conjugate cams, lever with two rollers", "conjugate", _conjugate),
    DimensionSheet("cam-valve-train", "Valve train, rocker with a roller", "valve_train", _valve),
)
