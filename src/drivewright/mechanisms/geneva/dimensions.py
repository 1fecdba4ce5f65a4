"""What the keys of a Geneva drive's spec measure."""

from collections.abc import Iterator

import numpy as np

from drivewright.dimensions import (
    Dimension,
    DimensionSheet,
    Length,
    Radius,
    circles_of,
    corners_of,
    cut_prism,
    origin_of,
    placed_point,
    still_body,
    still_scene,
)
from drivewright.mechanisms.geneva.build import GenevaModel
from drivewright.mechanisms.geneva.scene import parts, scene
from drivewright.scene import Arc, Prism, Scene, Shape

BOTH = ("crank_radius=70.7106781187 mm", "wheel.outer_radius=72 mm", "locking.radius=45 mm")
WIDE = ("wheel.slot_clearance=3 mm", "wheel.end_clearance=5 mm", "locking.clearance=4 mm", "locking.relief=5 mm", "locking.radius=40 mm")


def _engaged(model: GenevaModel) -> Scene:
    """The drive a little before the pin is nearest to the axis of the wheel."""
    whole = scene(model)
    frame = int(np.argmin(np.abs(whole.cycle - np.radians(-30))))
    bodies = (
        still_body(body.name, (shape for shape in body.shapes if shape.label != "hub"), body.colour, tuple(body.poses[frame].tolist()))
        for body in whole.bodies
    )
    return still_scene(*bodies)


def _drive(model: GenevaModel, drawn: Scene) -> Iterator[Dimension]:
    crank, wheel = origin_of(drawn, "crank"), origin_of(drawn, "wheel")
    (pin, journal) = (max(circles_of(drawn, "pin", "roller")), max(circles_of(drawn, "pin", "hole")))
    yield Length("centre_distance", crank, wheel, -0.42)
    yield Length("crank_radius", crank, pin[0], 0.0)
    yield Radius("pin.radius", *pin, np.radians(115))
    yield Radius("pin.journal_radius", *journal, np.radians(-60))
    yield Radius("wheel.outer_radius", wheel, _rim(drawn, "wheel"), np.radians(62))
    yield Radius("locking.radius", crank, _rim(drawn, "crank"), np.radians(200))
    yield Radius("wheel.bore", *circles_of(drawn, "wheel", "hole")[0], np.radians(-30), diameter=True)
    yield Radius("locking.bore", *circles_of(drawn, "crank", "hole")[0], np.radians(100), diameter=True)


def _rim(drawn: Scene, name: str) -> float:
    """Radius of the arcs of a body's outline about its own axis."""
    outlines = (shape.outline for body in drawn.bodies if body.name == name for shape in body.shapes if shape.layer == "profile")
    arcs = (piece for outline in outlines for piece in outline.pieces if isinstance(piece, Arc))
    return next(arc.radius for arc in arcs if np.hypot(*arc.center) < 1e-9)


def _centred(model: GenevaModel) -> Scene:
    """The drive with the pin nearest to the axis of the wheel, without the arm of the crank."""
    whole = scene(model)
    middle = len(whole.cycle) // 2
    bodies = (
        still_body(
            body.name,
            (shape for shape in body.shapes if shape.layer in ("profile", "roller")),
            body.colour,
            tuple(body.poses[middle].tolist()),
        )
        for body in whole.bodies
        if body.name != "frame"
    )
    return still_scene(*bodies)


def _clearances(model: GenevaModel, drawn: Scene) -> Iterator[Dimension]:
    """The pin at the bottom of the slot."""
    shape, pin = model.shape, max(circles_of(drawn, "pin", "roller"))
    bottom = placed_point(drawn, "wheel", (shape.slot_bottom, 0.0))
    yield Length("crank_radius", origin_of(drawn, "crank"), pin[0], -0.4)
    yield Length("wheel.end_clearance", (pin[0][0] + pin[1], 0.0), bottom, 0.05)


def _locked(model: GenevaModel) -> Scene:
    """The drive in the middle of the dwell."""
    whole = scene(model)
    bodies = (
        still_body(
            body.name, (shape for shape in body.shapes if shape.layer in ("profile", "roller")), body.colour, tuple(body.poses[0].tolist())
        )
        for body in whole.bodies
        if body.name != "frame"
    )
    return still_scene(*bodies)


def _lock(model: GenevaModel, drawn: Scene) -> Iterator[Dimension]:
    shape = model.shape
    yield Length("locking.clearance", (shape.locking_radius, 0.0), (shape.arc_radius, 0.0), 0.05)
    lower, upper = (
        placed_point(drawn, "wheel", (shape.slot_end + 0.4 * shape.slot_length, side * (shape.pin_radius + shape.slot_clearance / 2)))
        for side in (-1, 1)
    )
    across = np.subtract(upper, lower) / shape.slot_width
    start = tuple(np.subtract(upper, across * shape.slot_clearance).tolist())
    yield Length("wheel.slot_clearance", start, upper, 0.06)


def _cut(model: GenevaModel) -> Scene:
    """The wheel with its hub, cut along its axis, which runs to the right."""
    wheel = next(part for part in parts(model) if part.name == "wheel")
    prisms = [solid for solid in wheel.solids if isinstance(solid, Prism)]
    shapes = [shape for prism in prisms[:1] for shape in cut_prism(prism)]
    for hub in prisms[1:]:
        shapes += [Shape("body", shape.outline) for shape in cut_prism(hub)]
    return still_scene(still_body("wheel", shapes))


def _section(model: GenevaModel, drawn: Scene) -> Iterator[Dimension]:
    profile, hub = corners_of(drawn, "wheel", "profile"), corners_of(drawn, "wheel", "body")
    left, right = min(x for x, _ in profile), max(x for x, _ in profile)
    top, end, hub_top = max(y for _, y in profile), max(x for x, _ in hub), max(y for _, y in hub)
    yield Length("wheel.thickness", (left, top), (right, top), 0.06)
    yield Length("wheel.hub_length", (right, hub_top), (end, hub_top), 0.06)
    yield Length("wheel.hub_diameter", (end, -hub_top), (end, hub_top), -0.08)


SHEETS = (
    DimensionSheet("geneva", "Geneva drive", "default", _drive, BOTH, scene=_engaged),
    DimensionSheet("geneva-clearances", "Geneva drive, pin nearest to the wheel", "default", _clearances, (*BOTH, *WIDE), scene=_centred),
    DimensionSheet("geneva-locked", "Geneva drive in the dwell", "default", _lock, WIDE, scene=_locked),
    DimensionSheet("geneva-section", "Geneva wheel, cut along its axis", "default", _section, scene=_cut),
)
