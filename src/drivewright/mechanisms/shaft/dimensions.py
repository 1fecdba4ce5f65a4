"""What the keys of a shaft's spec measure, on a stepped and hollow spindle at rest."""

from collections.abc import Iterator
from dataclasses import replace

from drivewright.dimensions import Dimension, DimensionSheet, Length, circles_of, corners_of, origin_of
from drivewright.mechanisms.shaft.bearing_drawing import AROUND, BEARINGS, along_axis, along_axis_dimensions, cut, cut_dimensions
from drivewright.mechanisms.shaft.build import ShaftModel
from drivewright.mechanisms.shaft.load_drawing import (
    DIRECTIONS,
    MESH,
    PLACES,
    direction_dimensions,
    gear_mesh,
    load_directions,
    mesh_dimensions,
    place_dimensions,
)
from drivewright.mechanisms.shaft.notch_drawing import GEAR, NOTCHES, gear_dimensions, notch_dimensions, notched
from drivewright.mechanisms.shaft.scene import drawings, scene
from drivewright.scene import Body, Scene, Shape


def _hollow(model: ShaftModel) -> Scene:
    """The scene with the outline and the bores of the turned part."""
    bent = scene(model)
    bores = tuple(Shape("edge", outline) for outline in drawings(model)[0].on("hole"))
    profile = tuple(Shape("edge", outline) for outline in drawings(model)[0].on("profile"))
    still = bent.bodies[0].poses
    return replace(bent, bodies=(Body("turned", "turned part", profile + bores, still, "blue"), *bent.bodies))


def _spindle(model: ShaftModel, scene: Scene) -> Iterator[Dimension]:
    corners = [(x, y) for x, y in corners_of(scene, "rest", "base") if y > 0]
    steps = sorted({x for x, _ in corners})
    left, right = steps[0], steps[-1]
    radius = {end: max(y for x, y in corners if x == end) for end in (left, right)}
    tallest = max(y for _, y in corners)
    top = max(y for x, y in corners if x == steps[-2])
    bores = [y for x, y in corners_of(scene, "turned", "edge") if x == left]
    inner = min(abs(y) for y in bores)
    yield Length("segments.0.length", (left, tallest), (steps[1], tallest), 0.16)
    yield Length("segments.1.length", (steps[1], tallest), (steps[2], tallest), 0.16)
    yield Length("segments.0.diameter", (left, -radius[left]), (left, radius[left]), 0.12)
    yield Length("segments.0.bore", (left, -inner), (left, inner), -0.1)
    yield Length("segments.4.diameter", (steps[-2], -top), (steps[-2], top), -0.1)
    yield Length("segments.4.end_diameter", (right, -radius[right]), (right, radius[right]), -0.12)
    for name, aside in (("rear_1", -0.24), ("front_2", -0.34)):
        (centre, _), *_ = circles_of(scene, f"bearing.{name}", "roller")
        yield Length(f"bearings.{name}.position", (left, 0.0), (centre[0], 0.0), aside)
    nose = origin_of(scene, "load.1")
    yield Length("stations.nose.position", (left, 0.0), (nose[0], 0.0), -0.44)


SHORT = ("bearings.A.position=20 mm", "bearings.B.position=150 mm", "stations.m2.position=100 mm")

SHEETS = (
    DimensionSheet("shaft", "Shaft: segments, bearings and stations", "spindle", _spindle, left_out=("shaft.", "gear"), scene=_hollow),
    DimensionSheet("shaft-notches", "Shaft: notches and fillets", "default", notch_dimensions, changes=(*SHORT, *NOTCHES), scene=notched),
    DimensionSheet("shaft-gear", "Shaft: gears", "default", gear_dimensions, changes=GEAR, left_out=("shaft.",)),
    DimensionSheet("shaft-loads", "Shaft: places of loads", "default", place_dimensions, changes=PLACES, left_out=("shaft.", "bearing.")),
    DimensionSheet(
        "shaft-directions",
        "Shaft: directions of loads, along the axis",
        "default",
        direction_dimensions,
        changes=DIRECTIONS,
        scene=load_directions,
    ),
    DimensionSheet("shaft-mesh", "Shaft: mesh of a gear, along the axis", "default", mesh_dimensions, changes=MESH, scene=gear_mesh),
    DimensionSheet("shaft-bearings", "Shaft: rolling bearings cut along the axis", "default", cut_dimensions, changes=BEARINGS, scene=cut),
    DimensionSheet(
        "shaft-bearing-seat", "Shaft: seat and balls, along the axis", "default", along_axis_dimensions, changes=AROUND, scene=along_axis
    ),
)
