"""What clearance and a wrong centre distance do: entry of the pin, crossing of the slot, impulses."""

from collections.abc import Iterator

import numpy as np

from drivewright.indexing.geneva.clearance import Crossing, Entry, crossing, entry
from drivewright.mechanisms.geneva.build import GenevaModel
from drivewright.result import Answer, Answers, Check, Value


def pin_entry(model: GenevaModel, done: Answers) -> Answer:
    """Angle and shock at entry, crossing from the driving to the braking side, impulses and energies of both."""
    step, clearance = model.step, model.shape.slot_clearance
    found = entry(step, clearance, model.entry_speed)
    turning = float(model.crank.at(np.array(model.crank.part_at(0.0)))[1])
    crossed = crossing(step, clearance, turning, _bend(model, turning))
    values = {**dict(_entry_values(model, found)), **dict(_crossing_values(model, crossed))}
    return Answer(values, (), tuple(_checks(model, found, values)), tuple(_findings(model, found)))


def _bend(model, speed):
    """Second derivative by the crank angle that the wheel takes by itself."""
    load = model.spec.load
    return -(load.friction_torque + load.process_torque) / (model.inertia * speed**2)


def _entry_values(model: GenevaModel, found: Entry) -> Iterator[tuple[str, Value]]:
    yield "entry.angle", Value(found.angle, "rad", "crank angle at which the pin first touches the slot", label="Crank angle at entry")
    meaning = "angle between the path of the pin and the side of the slot at entry"
    yield "entry.path_angle", Value(found.path_angle, "rad", meaning, label="Entry angle of the pin")
    meaning = "speed at which the pin meets the side of the slot at entry"
    yield "entry.normal_speed", Value(found.normal_speed, "m/s", meaning, label="Entry speed normal to the slot")
    yield "entry.speed_jump", Value(found.speed_jump, "rad/s", "jump of the wheel speed at entry", label="Jump of the wheel speed at entry")
    arm = float(model.step.pin_distance(found.angle))
    impulse = model.inertia * found.speed_jump / arm
    yield "entry.impulse", Value(impulse, "N s", "impulse of the pin on the wheel at entry, without rebound", label="Impulse at entry")
    energy = model.inertia * found.speed_jump**2 / 2
    yield "entry.energy", Value(energy, "J", "energy lost at entry, without rebound", label="Energy lost at entry")


def _crossing_values(model: GenevaModel, crossed: Crossing) -> Iterator[tuple[str, Value]]:
    meaning = "crank angle at which the pin has crossed the slot and meets its other side"
    yield "crossing.angle", Value(crossed.angle, "rad", meaning, label="Crank angle at the crossing")
    yield (
        "crossing.speed",
        Value(crossed.speed, "m/s", "speed at which the other side of the slot meets the pin", label="Speed at the crossing"),
    )
    mass = model.inertia / float(model.step.pin_distance(crossed.angle)) ** 2
    yield (
        "crossing.impulse",
        Value(mass * crossed.speed, "N s", "impulse at the crossing, without rebound", label="Impulse at the crossing"),
    )
    yield (
        "crossing.energy",
        Value(mass * crossed.speed**2 / 2, "J", "energy lost at the crossing, without rebound", label="Energy lost at the crossing"),
    )


def _checks(model: GenevaModel, found: Entry, values: dict[str, Value]) -> Iterator[Check]:
    message = (
        "angle between the path of the pin and the slot at entry; bring crank_radius to centre_distance sin(180°/slots), or reduce the "
        "clearance of the slot"
    )
    limit = model.spec.limits.entry_angle
    yield Check.of(values["entry.path_angle"], "entry_angle", limit, "<=", message, ("crank", "wheel"), label="Entry angle of the pin")
    message = "crank radius off the one with which the pin enters the slot, against half the clearance of the slot"
    off = abs(model.step.excess) if abs(model.step.excess) > FIT else 0.0
    room, parts = model.shape.slot_clearance / 2, ("crank", "wheel")
    yield Check("fit", off, room, "<=", "m", message, parts, True, label="Fit of the pin at entry")


FIT = 1e-9  # m: rounding of a radius that follows from the other length


def _findings(model: GenevaModel, found: Entry) -> Iterator[str]:
    if found.miss > FIT:
        way, remedy = ("beyond", "shorten") if model.step.excess > 0 else ("short of", "lengthen")
        yield (
            f"the pin's circle is {1e3 * abs(model.step.excess):.3g} mm {way} the one that fits, more than the slot has room for: the pin "
            f"strikes the tip of the wheel at entry, and the shock is not limited by entry.speed_jump; {remedy} the crank radius to "
            f"{1e3 * model.step.fitting_radius:.6g} mm"
        )
