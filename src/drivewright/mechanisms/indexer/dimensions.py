"""What the keys of an indexer's spec measure."""

from collections.abc import Iterator

import numpy as np

from drivewright.dimensions import Dimension, DimensionSheet, Length, Radius, circles_of, origin_of
from drivewright.mechanisms.indexer.build import IndexerModel
from drivewright.scene import Scene


def _pin_wheel(model: IndexerModel, scene: Scene) -> Iterator[Dimension]:
    """Wheel, pins and cranks of a pin-wheel drive."""
    wheel, cam = origin_of(scene, "wheel"), origin_of(scene, "cam1")
    pins = circles_of(scene, "wheel", "roller")
    upper = pins[2]
    yield Length("pin_circle_radius", wheel, upper[0], 0.0)
    yield Radius("pin_radius", *pins[3], np.radians(60))
    yield Length("eccentricity", wheel, cam, -0.12)
    yield Length("shaft_spacing", origin_of(scene, "crank1"), origin_of(scene, "crank2"), -0.56)


def _parallel(model: IndexerModel, scene: Scene) -> Iterator[Dimension]:
    """Wheel and cams of a parallel drive."""
    wheel, cam = origin_of(scene, "wheel"), origin_of(scene, "cam1")
    pins = circles_of(scene, "wheel", "roller")
    pin = max(pins, key=lambda each: each[0][1])
    yield Length("centre_distance", wheel, cam, -0.5)
    yield Length("pin_circle_radius", wheel, pin[0], 0.0)
    yield Radius("pin_radius", *pin, np.radians(60))


SHEETS = (
    DimensionSheet("indexer", "Pin-wheel indexer", "default", _pin_wheel, left_out=("normal", "pitch_point")),
    DimensionSheet("indexer-parallel", "Parallel indexer", "parallel", _parallel, left_out=("normal", "pitch_point")),
)
