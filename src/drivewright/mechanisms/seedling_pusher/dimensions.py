"""What the keys of a seedling pusher's spec measure, at the start of its carrier's turn."""

import math
from collections.abc import Iterator

import numpy as np

from drivewright.dimensions import Angle, Dimension, DimensionSheet, Length, Radius, body_of, circles_of, direction, origin_of, turn
from drivewright.mechanisms.seedling_pusher.build import PusherModel
from drivewright.mechanisms.seedling_pusher.field_drawing import (
    GATE_LINE,
    TURNS,
    cams_cut,
    cams_dimensions,
    carrier_turns,
    field_dimensions,
    over_field,
    turn_dimensions,
)
from drivewright.scene import Point, Scene


def _ends(scene: Scene, name: str) -> tuple[Point, Point]:
    """Both ends of a body that is one bar."""
    (first, _), (second, _) = circles_of(scene, name, "body")
    return first, second


def _needle(scene: Scene) -> tuple[Point, Point]:
    """Back and tip of the needle: the slim bar of the arm."""
    _, *bar = circles_of(scene, "arm", "body")
    planet = origin_of(scene, "arm")
    back, tip = sorted((centre for centre, _ in bar), key=lambda centre: math.dist(centre, planet))
    return back, tip


def _train(model: PusherModel, scene: Scene) -> Iterator[Dimension]:
    """Carrier, arm and needle."""
    sun, middle, planet = (origin_of(scene, name) for name in ("sun", "intermediate", "planet"))
    back, tip = _needle(scene)
    first, second, line = direction(sun, middle), direction(middle, planet), direction(planet, tip)
    yield Length("train.semi_major", sun, middle, -0.14, times=2)
    yield Angle("train.carrier_angle", sun, 0.0, first, 0.42)
    yield Angle("train.bend", middle, first, turn(first, second), 0.10)
    yield Length("arm.tip_distance", planet, tip, 0.12)
    yield Angle("arm.tip_angle", planet, first, turn(first, line), 0.50, times=-1)
    yield Angle("arm.needle_angle", tip, line + np.pi, turn(line, direction(back, tip)), 0.22, times=-1)
    yield Length("push.stroke", *_stroke(scene), 0.06)


def _stroke(scene: Scene) -> tuple[Point, Point]:
    """The end of the rod, drawn in and pushed out, with the arm where it is at the start."""
    arm, rod = (body_of(scene, name).poses for name in ("arm", "rod"))
    travel = np.hypot(*(rod - arm)[:, :2].T)
    end = max(_ends(scene, "rod"), key=lambda point: -point[1])
    way = (rod - arm)[int(np.argmax(travel)), :2]
    turned = -arm[int(np.argmax(travel)), 2] + arm[0, 2]
    step = (way[0] + 1j * way[1]) * np.exp(1j * turned)
    return end, (end[0] + float(step.real), end[1] + float(step.imag))


def _lever(model: PusherModel, scene: Scene) -> Iterator[Dimension]:
    """Cams, lever and rod."""
    planet, pivot = origin_of(scene, "arm"), origin_of(scene, "lever")
    (main, radius), (back, _) = circles_of(scene, "lever", "roller")
    slot = max((centre for centre, _ in circles_of(scene, "lever", "body")), key=lambda centre: math.dist(centre, pivot))
    yield Length("lever.pivot_distance", planet, pivot, -0.5)
    yield Length("lever.arm_main", pivot, main, -0.12)
    yield Length("lever.arm_return", pivot, back, 0.12)
    yield Length("lever.output_arm", pivot, slot, -0.1)
    yield Length("lever.rod_length", *_ends(scene, "rod"), 0.12)
    yield Length("cams.prime_radius_main", planet, main, 0.0)
    yield Length("cams.prime_radius_return", planet, back, 0.0)
    yield Radius("cams.roller_radius", main, radius, np.radians(90))


SHEETS = (
    DimensionSheet("seedling-pusher", "Seedling pusher: train, arm and push", "default", _train, left_out=("cam", "lever")),
    DimensionSheet(
        "seedling-pusher-lever",
        "Seedling pusher: cams and lever",
        "default",
        _lever,
        left_out=("sun", "intermediate", "planet", "carrier", "field"),
    ),
    DimensionSheet(
        "seedling-pusher-field",
        "Seedling pusher: field and gate",
        "default",
        field_dimensions,
        changes=GATE_LINE,
        left_out=("cam.", "lever", "rod"),
        scene=over_field,
    ),
    DimensionSheet(
        "seedling-pusher-turn",
        "Seedling pusher: carrier angles of push and taking",
        "default",
        turn_dimensions,
        changes=TURNS,
        scene=carrier_turns,
    ),
    DimensionSheet("seedling-pusher-cams", "Seedling pusher: cams cut along their axis", "default", cams_dimensions, scene=cams_cut),
)
