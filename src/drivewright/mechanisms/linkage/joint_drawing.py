"""What the keys of joints measure: a wheel on its track, and a pin with play, as large as it is given."""

from collections.abc import Iterator

import numpy as np

from drivewright.dimensions import (
    Angle,
    Dimension,
    Length,
    Radius,
    body_of,
    circles_of,
    corners_of,
    direction,
    origin_of,
    still_body,
    still_scene,
)
from drivewright.mechanisms.linkage.build import LinkageModel
from drivewright.mechanisms.linkage.describe import marker
from drivewright.mechanisms.linkage.plates import pin_radius
from drivewright.multibody.analyses.cycle_poses import start_poses
from drivewright.scene import Point, Scene, Shape, circle, place, polygon, rectangle

JOINT = "B"  # of the preset, whose pin is drawn
SECTION = 2.6  # radii of the bearing from its axis to its section


def wheel_dimensions(model: LinkageModel, scene: Scene) -> Iterator[Dimension]:
    """Radii of a wheel and of the round track inside it."""
    centre, radius = max(_circles(scene, "wheel"), key=lambda each: each[1])
    track, round_track = max(_circles(scene, "ground"), key=lambda each: each[1])
    yield Radius("joints.roll.radius", centre, radius, np.radians(30))
    yield Radius("joints.roll.track_radius", track, round_track, np.radians(200))


def _circles(scene: Scene, name: str) -> list[tuple[Point, float]]:
    layers = dict.fromkeys(shape.layer for shape in body_of(scene, name).shapes)
    return [found for layer in layers for found in circles_of(scene, name, layer)]


# -- a pin with play -------------------------------------------------------------------------------------------------------------


def pin_with_play(model: LinkageModel) -> Scene:
    """Bearing and journal of a joint where they stand at the start, with the massless link between their axes, and the bearing from the
    side."""
    joint = next(joint for joint in model.spec.joints if joint.name == JOINT)
    poses = start_poses(model)
    first, second = (
        np.array(place([found[1:]], poses[found.body][0])[0]) for found in (marker(model.spec, text) for text in joint.connects)
    )
    way = second - first
    bearing, journal = pin_radius(model.spec, joint, bearing=True), pin_radius(model.spec, joint)
    middle = (SECTION * bearing + joint.length / 2, 0.0)
    return still_scene(
        still_body("bearing", [Shape("body", circle((0.0, 0.0), bearing))], "green"),
        still_body("journal", [Shape("roller", circle((0.0, 0.0), journal))], "orange", (float(way[0]), float(way[1]), 0.0)),
        still_body("link", [Shape("axis", polygon([np.zeros(2), way], closed=False))], "ground"),
        still_body("side", [Shape("body", rectangle(middle, joint.length, 2 * bearing))], "green"),
    )


def pin_dimensions(model: LinkageModel, scene: Scene) -> Iterator[Dimension]:
    """Radius and length of the bearing, clearance, direction of the link."""
    bearing, journal = origin_of(scene, "bearing"), origin_of(scene, "journal")
    (_, radius), *_ = circles_of(scene, "bearing", "body")
    side = corners_of(scene, "side", "body")
    top, left, right = max(y for _, y in side), min(x for x, _ in side), max(x for x, _ in side)
    yield Radius(f"joints.{JOINT}.bearing_radius", bearing, radius, np.radians(200))
    yield Length(f"joints.{JOINT}.clearance", bearing, journal, 0.0)
    yield Angle(f"joints.{JOINT}.link_angle", bearing, 0.0, direction(bearing, journal), 0.18)
    yield Length(f"joints.{JOINT}.bearing_length", (left, top), (right, top), 0.08)


WHEEL = (
    'ground={points={T=["0 mm", "-80 mm"]}}',
    'bodies={wheel={mass="1 kg", inertia="1e-3 kg m^2", points={M=["0 mm", "0 mm"]}}}',
    'joints=[{name="roll", kind="rolling", connects=["wheel.M", "ground.T"], radius="30 mm", track_radius="50 mm"}]',
    'simulate={duration="0.1 s"}',
    "drive=",
    "outputs=[]",
)
PLAY = (
    "joints.B.model=massless-link",
    "joints.B.clearance=5 mm",
    "joints.B.bearing_radius=20 mm",
    "joints.B.bearing_length=36 mm",
    "joints.B.link_angle=35 deg",
)
