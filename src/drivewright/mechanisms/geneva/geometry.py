"""Sizes of wheel and locking disc: slots, walls, undercut, locking clearance, play in the dwell, mass."""

from collections.abc import Iterator

import numpy as np

from drivewright.indexing.geneva.locking import dwell_play, locking_angle, locking_clearance
from drivewright.mechanisms.geneva.build import GenevaModel
from drivewright.mechanisms.geneva.motion import FROM_CENTRES
from drivewright.result import Answer, Answers, Check, Column, Table, Value

LEAST_WALL = 1e-3  # m, of a roller: a thin sleeve


def geometry(model: GenevaModel, done: Answers) -> Answer:
    """Slot length, walls, undercut by the locking arcs, clearance of the locking disc, mass of the wheel."""
    gap = locking_clearance(model.shape)
    values = {**dict(_sizes(model)), **dict(_locking(model, gap)), **dict(_mass(model))}
    meaning = "distance between locking disc and wheel while the wheel turns"
    table = Table(
        "locking",
        "Clearance of the locking disc",
        (
            Column("angle", "rad", f"crank angle, {FROM_CENTRES}", gap.angle),
            Column("distance", "m", f"{meaning}, negative where they overlap", gap.distance, "Clearance, disc to wheel"),
        ),
    )
    return Answer(values, (table,), tuple(_checks(model, values)), tuple(_findings(model)))


def _sizes(model: GenevaModel) -> Iterator[tuple[str, Value]]:
    step, shape = model.step, model.shape
    for name, value, meaning, label in (
        ("centre_distance", step.centre_distance, "distance of the axes of crank and wheel", "Centre distance"),
        ("crank_radius", step.crank_radius, "radius of the pin's circle", "Crank radius"),
        ("crank_excess", step.excess, "crank radius beyond the one with which the pin enters along the slot", "Excess of the crank radius"),
        ("wheel.outer_radius", shape.outer_radius, "outer radius of the wheel", "Outer radius of the wheel"),
        ("slot.width", shape.slot_width, "width of a slot", "Slot width"),
        ("slot.length", shape.slot_length, "depth of a slot from the outer radius of the wheel", "Slot length"),
        ("slot.bottom", shape.slot_bottom, "distance of the bottom of a slot from the axis of the wheel", "Radius of the slot bottom"),
        ("slot.wall", shape.slot_wall, "minimum wall between two slots, at their bottoms", "Wall between slots"),
        ("slot.mouth_wall", shape.mouth_wall, "minimum wall between a slot and the locking arc beside it", "Wall at the mouth of a slot"),
        ("slot.undercut", shape.undercut, "length that the locking arcs take off the sides of a slot", "Undercut of the slot sides"),
    ):
        yield name, Value(value, "m", meaning, label=label)


def _locking(model: GenevaModel, gap) -> Iterator[tuple[str, Value]]:
    shape, least = model.shape, int(np.argmin(gap.distance))
    yield "locking.radius", Value(shape.locking_radius, "m", "radius of the locking disc", label="Radius of the locking disc")
    yield "locking.arc_radius", Value(shape.arc_radius, "m", "radius of the locking arcs of the wheel", label="Radius of the locking arcs")
    yield "locking.angle", Value(locking_angle(shape), "rad", "crank angle over which the disc locks the wheel", label="Locking angle")
    meaning = "minimum clearance between locking disc and wheel while the wheel turns"
    yield "locking.clearance", Value(float(gap.distance[least]), "m", meaning, label="Minimum locking clearance")
    meaning = "rotation of the locked wheel from the middle of its dwell either way"
    yield "dwell_play", Value(dwell_play(shape), "rad", meaning, label="Play of the wheel in the dwell")


def _mass(model: GenevaModel) -> Iterator[tuple[str, Value]]:
    mass, inertia = model.wheel_solid
    yield "wheel.mass", Value(mass, "kg", "mass of the wheel", label="Mass of the wheel")
    yield "wheel.inertia", Value(inertia, "kg m^2", "moment of inertia of the wheel about its axis", label="Moment of inertia of the wheel")
    yield "total_inertia", Value(model.inertia, "kg m^2", "moment of inertia of wheel and load together", label="Inertia of wheel and load")


def _checks(model: GenevaModel, values: dict[str, Value]) -> Iterator[Check]:
    limits, shape = model.spec.limits, model.shape
    for name, value, limit, message, parts, label in (
        (
            "slot_wall",
            values["slot.wall"].value,
            limits.slot_wall,
            "minimum wall between two slots; take a thinner pin",
            ("wheel",),
            "Wall between slots",
        ),
        (
            "mouth_wall",
            values["slot.mouth_wall"].value,
            limits.mouth_wall,
            "minimum wall between a slot and the locking arc; take a smaller locking disc or a thinner pin",
            ("wheel",),
            "Wall at the mouth of a slot",
        ),
        (
            "locking_clearance",
            values["locking.clearance"].value,
            limits.locking_clearance,
            "minimum clearance between locking disc and wheel while the wheel turns; enlarge locking.relief or reduce the disc",
            ("wheel", "crank"),
            "Minimum locking clearance",
        ),
    ):
        yield Check(name, value, limit, ">=", "m", message, parts, True, label=label)
    yield from _bore_checks(model, shape)
    message = "diameter of the end mill against the width of a slot; take a smaller end mill"
    cutter = model.spec.manufacture.cutter_diameter
    yield Check("cutter", cutter, shape.slot_width, "<=", "m", message, ("wheel",), label="Diameter of the end mill for a slot")
    if model.spec.pin.kind == "roller":
        message = "wall of the roller around its journal; reduce the journal or enlarge the pin"
        wall = model.spec.pin.radius - model.journal_radius
        yield Check("roller_wall", wall, LEAST_WALL, ">=", "m", message, ("pin",), True, label="Wall of the roller")
    message = "rotation of the locked wheel either way; reduce the clearance of the locking disc"
    yield Check.of(values["dwell_play"], "dwell_play", limits.dwell_play, "<=", message, ("wheel", "crank"), label="Play in the dwell")


def _bore_checks(model, shape):
    """Material between bores, hub, slots and relief."""
    wheel, wall = model.spec.wheel, model.spec.limits.bore_wall
    if wheel.bore:
        message = "minimum wall between the bore of the wheel and the slots; reduce the bore or the length of the slots"
        yield Check(
            "bore_wall",
            shape.slot_bottom - wheel.bore / 2,
            wall,
            ">=",
            "m",
            message,
            ("wheel",),
            True,
            label="Wall at the bore of the wheel",
        )
    if wheel.hub_diameter:
        message = "distance from the hub of the wheel out to the slots; reduce the hub diameter"
        yield Check(
            "hub_clearance",
            shape.slot_bottom - wheel.hub_diameter / 2,
            0.0,
            ">=",
            "m",
            message,
            ("wheel",),
            label="Clearance, hub to slots",
        )
        if wheel.bore:
            message = "wall between the bore and the hub of the wheel; reduce the bore or enlarge the hub"
            yield Check(
                "hub_wall",
                (wheel.hub_diameter - wheel.bore) / 2,
                wall,
                ">=",
                "m",
                message,
                ("wheel",),
                True,
                label="Wall between bore and hub",
            )
    if bore := model.spec.locking.bore:
        message = "minimum wall between the bore of the locking disc and its relief; reduce the bore or the number of slots"
        yield Check(
            "disc_wall", shape.relief_depth - bore / 2, wall, ">=", "m", message, ("crank",), True, label="Wall at the bore of the disc"
        )


def _findings(model: GenevaModel) -> Iterator[str]:
    if model.shape.undercut > 0:
        yield (
            f"the locking arcs cut {1e3 * model.shape.undercut:.3g} mm off the sides of the slots: the pin enters beside them. "
            "Take a smaller locking disc (locking.radius) or a thinner pin"
        )
