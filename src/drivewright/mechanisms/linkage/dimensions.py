"""What the keys of a linkage's spec measure: points of a body lie in the frame of the body, whose x axis turns by its angle."""

import math
from collections.abc import Iterator

from drivewright.dimensions import Angle, Dimension, DimensionSheet, Length, origin_of, placed_point, pose_of
from drivewright.mechanisms.linkage.build import LinkageModel
from drivewright.mechanisms.linkage.joint_drawing import PLAY, WHEEL, pin_dimensions, pin_with_play, wheel_dimensions
from drivewright.scene import Scene


def _four_bar(model: LinkageModel, scene: Scene) -> Iterator[Dimension]:
    crank, coupler, rocker = (origin_of(scene, name) for name in ("crank", "coupler", "rocker"))
    yield Length("ground.points.O4.0", crank, rocker, -0.16)
    yield Length("bodies.crank.points.A.0", crank, coupler, 0.1)
    yield Angle("bodies.crank.angle", crank, 0.0, pose_of(scene, "crank")[2] % math.tau, 0.2)
    points = model.spec.bodies["coupler"].points
    b, c = (placed_point(scene, "coupler", points[name]) for name in "BC")
    foot = placed_point(scene, "coupler", (points["C"][0], 0.0))
    yield Length("bodies.coupler.points.B.0", coupler, b, -0.1)
    yield Length("bodies.coupler.points.C.0", coupler, foot, 0.34)
    yield Length("bodies.coupler.points.C.1", foot, c, -0.28)
    yield Length("bodies.rocker.points.B.0", rocker, b, -0.1)


def _slider_crank(model: LinkageModel, scene: Scene) -> Iterator[Dimension]:
    bodies = model.spec.bodies
    crank, rod, slider = (origin_of(scene, name) for name in ("crank", "rod", "slider"))
    wrist = placed_point(scene, "rod", bodies["rod"].points["B"])
    yield Length("bodies.crank.points.A.0", crank, placed_point(scene, "crank", bodies["crank"].points["A"]), 0.12)
    yield Length("bodies.crank.centroid.0", crank, placed_point(scene, "crank", bodies["crank"].centroid), -0.12)
    yield Length("bodies.rod.points.B.0", rod, wrist, 0.1)
    yield Length("bodies.rod.centroid.0", rod, placed_point(scene, "rod", bodies["rod"].centroid), -0.12)
    yield Angle("bodies.crank.angle", crank, 0.0, pose_of(scene, "crank")[2] % math.tau, 0.16)


SLIDER_CRANK = ("bodies.crank.angle=50 deg", "bodies.rod.angle=-20 deg")

SHEETS = (
    DimensionSheet("linkage", "Four-bar linkage", "default", _four_bar, changes=("bodies.crank.angle=40 deg",)),
    DimensionSheet("linkage-slider-crank", "Slider-crank", "slider_crank", _slider_crank, changes=SLIDER_CRANK),
    DimensionSheet("linkage-wheel", "Rolling joint on a round track", "default", wheel_dimensions, changes=WHEEL),
    DimensionSheet("linkage-pin", "Pin with play in its bearing", "default", pin_dimensions, changes=PLAY, scene=pin_with_play),
)
