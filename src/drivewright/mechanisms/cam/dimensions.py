"""What the keys of a cam's spec measure, in drawings of its presets."""

import math
from collections.abc import Iterator
from dataclasses import replace

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
    cut_prism,
    direction,
    origin_of,
    still_body,
    still_scene,
    turn,
)
from drivewright.mechanisms.cam.build import CamModel
from drivewright.mechanisms.cam.scene import parts, scene
from drivewright.scene import Body, Point, Prism, Scene, Shape, place, polygon

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


def _segment(scene: Scene) -> Angle:
    """The cam angle of the first segment, back from the roller, since the profile comes to the roller as the cam turns."""
    frames, poses = scene.cycle, body_of(scene, "cam").poses[:, 2]
    turned = float(np.interp(scene.marks[1][0], frames, poses))
    return Angle("programme.0.angle", AXIS, np.pi / 2, -turned, 0.3, times=-math.copysign(1.0, turned))


def _groove(model: CamModel, scene: Scene) -> Iterator[Dimension]:
    """A roller in a groove, on a slide."""
    roller, radius = circles_of(scene, "follower", "roller")[0]
    ((_, disc),) = circles_of(scene, "outer wall", "body")
    walls = np.array(corners_of(scene, "outer wall", "profile"))
    outermost = walls[np.argmax(np.hypot(*walls.T))]
    way = outermost / np.hypot(*outermost)
    yield Length("follower.prime_radius", AXIS, roller)
    yield Radius("follower.roller_radius", roller, radius, np.radians(200))
    yield Length("limits.wall", _pair(outermost), _pair(disc * way))
    yield _segment(scene)
    yield _bore(scene)


def _pair(point: np.ndarray) -> Point:
    return float(point[0]), float(point[1])


def _yoke(model: CamModel, scene: Scene) -> Iterator[Dimension]:
    """A cam of constant breadth between two flat faces."""
    upper = [corner for corner in corners_of(scene, "follower", "body") if corner[1] > 0]
    low = max((corner for corner in upper if corner[1] < min(y for _, y in upper) + 1e-9), key=lambda corner: corner[0])
    yield Length("follower.prime_radius", (low[0], 0.0), low, -0.1)
    yield Length("programme.0.rise", low, _highest(scene, low), -0.2)
    yield _segment(scene)
    yield _bore(scene)


def _shoe(model: CamModel, scene: Scene) -> Iterator[Dimension]:
    """A curved shoe beside the line of the slide."""
    faces = circles_of(scene, "follower", "body")
    centre, radius = max(faces, key=lambda face: face[1])
    yield Length("follower.prime_radius", AXIS, centre)
    yield Radius("follower.face_radius", centre, radius, np.radians(-95))
    yield Length("follower.face_offset", (0.0, centre[1]), centre, 0.06)
    yield _segment(scene)


def _tilted(model: CamModel, scene: Scene) -> Iterator[Dimension]:
    """A tilted flat face on a slide."""
    corners = corners_of(scene, "follower", "body")[-4:]
    first, second = corners[0], corners[1]
    left, right = sorted((first, second))
    yield Angle("follower.face_angle", left, 0.0, direction(left, right), 0.4, times=model.follower.sense)
    _, radius = circles_of(scene, "cam", "base")[0]
    yield Radius("follower.base_radius", AXIS, radius, np.radians(200))
    yield _segment(scene)


def _flat_lever(model: CamModel, scene: Scene) -> Iterator[Dimension]:
    """A flat face on a lever."""
    pivot = origin_of(scene, "follower")
    start, end = (np.array(corner) for corner in corners_of(scene, "follower", "body")[-4:][:2])
    along = (end - start) / np.hypot(*(end - start))
    foot = start + along * np.dot(np.array(pivot) - start, along)
    yield Length("follower.pivot_distance", AXIS, pivot, -0.3)
    yield Length("follower.face_offset", pivot, _pair(foot), 0.1)
    yield Radius("follower.base_radius", AXIS, circles_of(scene, "cam", "base")[0][1], np.radians(200))
    yield _segment(scene)


def _second_slide(model: CamModel, scene: Scene) -> Iterator[Dimension]:
    """The second roller of a slide on two cams."""
    (first, _), (second, radius) = circles_of(scene, "follower", "roller")
    yield Length("follower.prime_radius", AXIS, first)
    yield Length("conjugate.prime_radius", AXIS, second)
    yield Radius("conjugate.roller_radius", second, radius, np.radians(-40))
    yield Length("conjugate.offset", (0.0, second[1]), second, -0.14)


def _across(model: CamModel) -> Scene:
    """The cam cut along its axis, which runs to the right, from its solids."""
    (cam,) = (part for part in parts(model) if part.name == "cam")
    prisms = [solid for solid in cam.solids if isinstance(solid, Prism)]
    return still_scene(still_body("cam", [shape for prism in prisms for shape in cut_prism(prism)]))


def _widths(model: CamModel, scene: Scene) -> Iterator[Dimension]:
    corners = corners_of(scene, "cam", "profile")
    start, face, end = sorted({round(x, 9) for x, _ in corners})
    top = max(y for x, y in corners if x < face - 1e-9)
    hub = max(y for x, y in corners if x > face + 1e-9)
    inner = min(abs(y) for _, y in corners)
    yield Length("face.width", (start, top), (face, top), 0.1)
    yield Length("manufacture.hub_length", (face, hub), (end, hub), 0.1)
    yield Length("manufacture.hub_diameter", (end, -hub), (end, hub), -0.3)
    yield Length("manufacture.bore", (end, -inner), (end, inner), -0.14)


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
    yield Length("conjugate.arm_length", second, pivot, -0.12)
    yield Radius("conjugate.roller_radius", second, circles_of(scene, "follower", "roller")[1][1], np.radians(-120))


def _flat(model: CamModel, scene: Scene) -> Iterator[Dimension]:
    """A flat face on a slide."""
    _, radius = circles_of(scene, "cam", "base")[0]
    corners = corners_of(scene, "follower", "body")[4:]
    low = min(corners, key=lambda corner: (round(corner[1], 9), -corner[0]))
    yield Radius("follower.base_radius", AXIS, radius, np.radians(200))
    yield Length("programme.0.rise", low, _highest(scene, low), -0.12)
    start, end = corners_of(scene, "face", "edge")
    yield Length("follower.half_face", start, end, 0.16)
    yield _bore(scene)


def _with_face(model: CamModel) -> Scene:
    """The scene with half the flat face as long as it is given, from the line of the slide on, where a face without tilt touches."""
    whole, half = scene(model), model.spec.follower.half_face
    _, radius = circles_of(whole, "cam", "base")[0]
    assert half is not None
    return replace(
        whole,
        bodies=(
            *whole.bodies,
            Body(
                "face",
                "face",
                (Shape("edge", polygon([(0.0, radius), (half, radius)], closed=False)),),
                np.zeros_like(whole.bodies[0].poses),
                "orange",
            ),
        ),
    )


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


SECOND = ("conjugate.roller_radius=10 mm", "conjugate.arm_length=65 mm")
SECOND_SLIDE = (
    "follower.motion=translating",
    "follower.pivot_distance=",
    "follower.arm_length=",
    "conjugate.offset=8 mm",
    "conjugate.roller_radius=10 mm",
    "programme.0.rise=20 mm",
    "programme.2.rise=-20 mm",
)
SHOE = (
    "follower.face=shoe",
    "follower.roller_radius=",
    "follower.face_radius=30 mm",
    "follower.prime_radius=55 mm",
    "follower.face_offset=6 mm",
)
FLAT_LEVER = (
    "follower.face=flat",
    "follower.roller_radius=",
    "follower.prime_radius=",
    "follower.base_radius=40 mm",
    "follower.face_offset=8 mm",
)

FACE = ("closure", "follower.motion", "follower.face")
SHEETS = (
    DimensionSheet("cam", "Disc cam, roller on a slide", "default", _slide, changes=("follower.offset=12 mm",), variant=FACE),
    DimensionSheet("cam-oscillating", "Disc cam, roller on a lever", "oscillating", _lever_alone, variant=(*FACE, "valve")),
    DimensionSheet("cam-flat", "Disc cam, flat face on a slide", "flat", _flat, scene=_with_face, variant=FACE),
    DimensionSheet("cam-conjugate", "Conjugate cams, lever with two rollers", "conjugate", _conjugate, changes=SECOND, variant=FACE),
    DimensionSheet(
        "cam-conjugate-slide", "Conjugate cams, slide with two rollers", "conjugate", _second_slide, changes=SECOND_SLIDE, variant=FACE
    ),
    DimensionSheet("cam-groove", "Groove cam, roller on a slide", "groove", _groove, changes=("limits.wall=8 mm",), variant=FACE),
    DimensionSheet("cam-yoke", "Cam of constant breadth in a yoke", "yoke", _yoke, variant=FACE),
    DimensionSheet("cam-shoe", "Disc cam, curved shoe on a slide", "default", _shoe, changes=SHOE, variant=FACE),
    DimensionSheet("cam-tilted", "Disc cam, tilted flat face", "flat", _tilted, changes=("follower.face_angle=12 deg",), variant=FACE),
    DimensionSheet("cam-flat-lever", "Disc cam, flat face on a lever", "oscillating", _flat_lever, changes=FLAT_LEVER, variant=FACE),
    DimensionSheet("cam-section", "Cam cut along its axis: widths and hub", "default", _widths, scene=_across),
    DimensionSheet("cam-valve-train", "Valve train, rocker with a roller", "valve_train", _valve, variant=(*FACE, "valve")),
)
