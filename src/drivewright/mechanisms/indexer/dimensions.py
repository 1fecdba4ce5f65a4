"""What the keys of an indexer's spec measure."""

from collections.abc import Iterator

import numpy as np

from drivewright.dimensions import Dimension, DimensionSheet, Length, Radius, circles_of, corners_of, origin_of
from drivewright.mechanisms.indexer.build import IndexerModel
from drivewright.mechanisms.indexer.scene import parts
from drivewright.scene import Bar, Body, Frame, Grooved, Outline, Prism, Scene, Shape, polygon


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


def _plan(model: IndexerModel) -> Scene:
    """A globoidal drive seen along the wheel's axis: wheel and rollers, and the cam's blank in section, from the solids of both."""
    cam, turret = parts(model)
    still = np.zeros((2, 3))
    (blank,) = (solid for solid in cam.solids if isinstance(solid, Grooved))
    halves = tuple(Shape("profile", blank.section.transformed((0.0, 0.0, 0.0), mirror)) for mirror in (False, True))
    discs = tuple(Shape("body", solid.outline) for solid in turret.solids if isinstance(solid, Prism))
    rollers = tuple(Shape("roller", _strip(solid)) for solid in turret.solids if isinstance(solid, Bar))
    bodies = (
        Body("cam", "cam", halves, still + cam.pose, "blue"),
        Body("wheel", "wheel with rollers", (*discs, *rollers), still, "orange"),
    )
    return Scene(np.array([0.0, 1.0]), "", "-", 1.0, bodies, (Frame("machine", "machine frame", still),))


def _strip(bar: Bar) -> Outline:
    """A bar seen from above."""
    start, end = np.array(bar.start), np.array(bar.end)
    along = (end - start) / np.hypot(*(end - start))
    side = bar.diameter / 2 * np.array([-along[1], along[0]])
    return polygon([start - side, end - side, end + side, start + side])


def _globoidal(model: IndexerModel, scene: Scene) -> Iterator[Dimension]:
    """Rollers that stand radially on the wheel, between the ribs of an hourglass-shaped cam."""
    wheel, cam = origin_of(scene, "wheel"), origin_of(scene, "cam")
    ((_, throat),) = {arc for arc in circles_of(scene, "cam", "profile") if np.hypot(*arc[0]) < 1e-9}
    corners = np.array(corners_of(scene, "wheel", "roller")).reshape(-1, 4, 2)
    first = corners[np.argmin(np.abs(np.arctan2(*corners.mean(axis=1).T[::-1])))]
    tip = first[1:3].mean(axis=0)
    reach = float(np.hypot(*tip))
    foot, middle = (tuple((tip * length / reach).tolist()) for length in (throat, (throat + reach) / 2))
    ends = sorted(corners_of(scene, "cam", "profile"), key=lambda corner: corner[1])
    third = corners[len(corners) // 4]
    yield Length("centre_distance", wheel, cam, -0.42)
    yield Length("pin_circle_radius", wheel, middle)
    yield Length("pin_length", foot, tuple(tip.tolist()), 0.12)
    yield Length("pin_radius", tuple(third[1].tolist()), tuple(third[2].tolist()), -0.06, times=2)
    yield Length("cam_length", (ends[0][0], ends[0][1]), (ends[0][0], ends[-1][1]), -0.3)


SHEETS = (
    DimensionSheet("indexer", "Pin-wheel indexer", "default", _pin_wheel, left_out=("normal", "pitch_point")),
    DimensionSheet("indexer-parallel", "Parallel indexer", "parallel", _parallel, left_out=("normal", "pitch_point")),
    DimensionSheet("indexer-globoidal", "Globoidal indexer", "globoidal", _globoidal, scene=_plan),
)
