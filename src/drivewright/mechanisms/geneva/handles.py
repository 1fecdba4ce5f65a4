"""Sizes of a Geneva drive that a hand can move on the drawing."""

from collections.abc import Iterator

import numpy as np

from drivewright.mechanisms.geneva.build import GenevaModel
from drivewright.scene import Handle, xy

ASIDE = 2.0  # rad: where on the wheel's bore its handle is


def handles(model: GenevaModel) -> Iterator[Handle]:
    """Axes, pin, locking disc, wheel and bores; a size that follows from others has no handle."""
    spec, shape, step = model.spec, model.shape, model.step
    if spec.centre_distance is not None:
        yield Handle("centre_distance", (step.centre_distance, 0.0), (1.0, 0.0))
    if spec.crank_radius is not None:
        yield Handle("crank_radius", (step.crank_radius, 0.0), (1.0, 0.0), "crank")
    yield Handle("pin.radius", (step.crank_radius, spec.pin.radius), (0.0, 1.0), "pin")
    if spec.locking.radius is not None:
        yield Handle("locking.radius", (-shape.locking_radius, 0.0), (-1.0, 0.0), "crank")
    if spec.locking.bore is not None:
        yield Handle("locking.bore", (0.0, -spec.locking.bore / 2), (0.0, -0.5), "crank")
    if spec.wheel.outer_radius is not None:
        at = np.exp(1j * (0.5 * (step.half_pitch - shape.arc_half_angle) + 0.5 * np.angle(shape.mouth)))
        yield Handle("wheel.outer_radius", xy(shape.outer_radius * at), xy(at), "wheel")
    for key in ("bore", "hub_diameter"):
        if diameter := getattr(spec.wheel, key):
            out = complex(np.exp(1j * (step.half_pitch if key == "bore" else step.half_pitch + ASIDE)))
            yield Handle(f"wheel.{key}", xy(diameter / 2 * out), xy(0.5 * out), "wheel")
