"""What the keys of a chain's spec measure, on two neighbouring links of its straight strand."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

import numpy as np

from drivewright.dimensions import Angle, Dimension, DimensionSheet, Length, Radius, circles_of, direction, origin_of, turn
from drivewright.mechanisms.silent_chain.build import ChainModel
from drivewright.mechanisms.silent_chain.drive_drawing import ON_PIVOTS, ON_SLIDES, laid_out, pivot_dimensions, slide_dimensions
from drivewright.mechanisms.silent_chain.plate_drawing import (
    from_above,
    plate_alone,
    plate_dimensions,
    rocker_dimensions,
    roller_width_dimensions,
    surface_dimensions,
    two_surfaces,
    width_dimensions,
)
from drivewright.mechanisms.silent_chain.scene import scene
from drivewright.mechanisms.silent_chain.tooth_drawing import cutting, cutting_dimensions, seated, seated_dimensions
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


def _hinge(model: ChainModel, scene: Scene) -> Iterator[Dimension]:
    yield Length("pitch", origin_of(scene, "first"), origin_of(scene, "second"), 0.25)
    yield Radius("joint.pin_diameter", *min(circles_of(scene, "first", "roller")), np.radians(120), diameter=True)


TEETH = ("teeth=[17, 37]", "cutter.tip_depth=1.8 mm", "cutter.root_depth=6.6 mm", "cutter.chamfer=0.6 mm", "cutter.measuring_pin=6 mm")
CUTTER = ("teeth=[17, 37]", "cutter.pitch=9.525 mm", "cutter.tip_rounding=0.7 mm")
PLATE = ("plate.back=3.4 mm", "plate.toe=-6 mm", "plate.crotch=-1.6 mm", "plate.crotch_radius=0.9 mm")
WIDTH = ("rows=2", "row_pitch=9 mm", "joint.contact_length=5 mm")
TWO_RADII = ("joint.kind=asymmetric", "joint.seat_radius=6 mm", "joint.rolling_radius=2.4 mm")
HINGE = ("joint.kind=revolute", "joint.rolling_radius=", "joint.pin_diameter=3.4 mm", "plate.apothem=3.2 mm")
CHAIN = ("roller",)
SHEETS = (
    DimensionSheet("silent-chain", "Silent chain: two plates of a straight strand", "default", _silent, scene=_links, variant=CHAIN),
    DimensionSheet("silent-chain-plate", "Silent chain: plate", "default", plate_dimensions, PLATE, scene=plate_alone, variant=CHAIN),
    DimensionSheet(
        "silent-chain-arc",
        "Silent chain: plate with rocker arcs",
        "classical",
        rocker_dimensions,
        scene=plate_alone,
        variant=(*CHAIN, "joint.kind"),
    ),
    DimensionSheet(
        "silent-chain-two-radii",
        "Joint of two radii",
        "default",
        surface_dimensions,
        TWO_RADII,
        scene=two_surfaces,
        variant=(*CHAIN, "joint.kind"),
    ),
    DimensionSheet(
        "silent-chain-hinge", "Silent chain with hinged joints", "default", _hinge, HINGE, scene=_links, variant=(*CHAIN, "joint.kind")
    ),
    DimensionSheet(
        "silent-chain-width", "Silent chain: two rows seen from above", "default", width_dimensions, WIDTH, scene=from_above, variant=CHAIN
    ),
    DimensionSheet(
        "silent-chain-teeth", "Silent chain: plate seated on a sprocket", "default", seated_dimensions, TEETH, scene=seated, variant=CHAIN
    ),
    DimensionSheet("silent-chain-cutter", "Cutter of a sprocket", "default", cutting_dimensions, CUTTER, scene=cutting, variant=CHAIN),
    DimensionSheet("silent-chain-roller", "Roller chain: two links of a straight strand", "roller", _roller, scene=_links, variant=CHAIN),
    DimensionSheet(
        "silent-chain-roller-width",
        "Roller chain seen from above",
        "roller",
        roller_width_dimensions,
        ("roller.inner_width=5.72 mm",),
        scene=from_above,
        variant=CHAIN,
    ),
    DimensionSheet("silent-chain-slides", "Chain drive: tensioners on slides", "roller", slide_dimensions, ON_SLIDES, scene=laid_out),
    DimensionSheet("silent-chain-pivots", "Chain drive: tensioners about pivots", "roller", pivot_dimensions, ON_PIVOTS, scene=laid_out),
)
