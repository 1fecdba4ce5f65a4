"""Forces over a turn: pin and slot, Hertz pressure on either side, sliding and wear, torque and power at the crank, energy audit."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from drivewright import materials
from drivewright._typing import Floats
from drivewright.cams import pressure_check
from drivewright.contact.hertz import line_contact
from drivewright.contact.wear import wear_volume
from drivewright.indexing.geneva.forces import PinForces, pin_forces
from drivewright.mechanisms.geneva.build import GenevaModel
from drivewright.mechanisms.geneva.motion import cycle_columns
from drivewright.mechanisms.geneva.spec import GenevaSpec
from drivewright.motion.motor_sizing import size_motor
from drivewright.multibody.analyses.energy_audit import audit_answer, audit_of_powers
from drivewright.numerics.quadrature import trapezoid
from drivewright.result import Answer, Answers, Column, Table, Value, merge_answers

SIDES = {"drive": ("driving", 1.0), "brake": ("braking", -1.0)}
MILLION = 1e6
AUDITED = {
    "drive": "the crank shaft",
    "load": "friction and process torque of the load",
    "pin": "friction of the pin",
    "bearing": "friction of the bearing",
}
AUDIT_LIMIT, AUDIT_ROWS = 1e-5, 1000


@dataclass(frozen=True)
class TurnForces:
    """Forces over the samples of a turn (n,); 0 in the dwell: torque T0 that moves the wheel, forces of the pin, torque at the crank."""

    load: Floats
    pin: PinForces
    crank_torque: Floats


@lru_cache(maxsize=16)
def turn_forces(model: GenevaModel) -> TurnForces:
    """`TurnForces` of a model."""
    crank, wheel, load = model.samples, model.wheel_by_time, model.spec.load
    moving = np.where(crank.engaged, 1.0, 0.0)
    torque = moving * (model.inertia * wheel.d2 + load.friction_torque + load.process_torque)
    found = pin_forces(model.step, model.spec.pin.radius, model.friction, crank.angle, crank.speed, wheel.d1, torque)
    pin = PinForces(*(moving * part for part in found))
    return TurnForces(torque, pin, pin.crank_torque + model.spec.drive.inertia * crank.acceleration)


def no_forces(spec: GenevaSpec) -> str | None:
    """Why there are none: the wheel has its own mass, so there always are."""
    return None


def forces(model: GenevaModel, done: Answers) -> Answer:
    """Pin force and Hertz pressure on either side of the slot, sliding and wear, torque and power at the crank."""
    turn = turn_forces(model)
    pressure = _pressures(model, turn.pin.normal)
    tables = (_force_table(model, turn, pressure), _torque_table(model, turn))
    values = {**dict(_side_values(model, turn, pressure)), **dict(_demand(model, turn)), **dict(_rubbing(model, turn))}
    return merge_answers((Answer(values, tables), _judged(model, values)))


def _pressures(model, normal):
    """Hertz pressure of the pin on the straight side of the slot [Pa]."""
    return np.asarray(line_contact(np.abs(normal), model.spec.wheel.thickness, model.spec.pin.radius, model.modulus).pressure)


def _force_table(model, turn, pressure):
    columns = [*cycle_columns(model)]
    for name, (words, sign) in SIDES.items():
        on = sign * turn.pin.normal > 0
        columns += [
            Column(
                f"{name}_force",
                "N",
                f"force of the pin on the {words} side of the slot",
                np.where(on, np.abs(turn.pin.normal), 0.0),
                f"Pin force, {words} side",
            ),
            Column(
                f"{name}_pressure",
                "Pa",
                f"Hertz pressure on the {words} side of the slot",
                np.where(on, pressure, 0.0),
                f"Hertz pressure, {words} side",
            ),
        ]
    columns += [
        Column(
            "sliding_speed", "m/s", "sliding speed of the pin in the slot, of a roller on its journal", turn.pin.sliding, "Sliding speed"
        ),
        Column("bearing_force", "N", "force on the bearing of the wheel", turn.pin.resultant),
    ]
    return Table("forces", "Forces of the pin over a turn", tuple(columns))


def _torque_table(model, turn):
    columns = (
        *cycle_columns(model),
        Column("load_torque", "N m", "torque that moves the wheel: inertia, friction, process", turn.load, "Torque on the wheel"),
        Column("crank_torque", "N m", "torque at the crank", turn.crank_torque),
        Column("crank_power", "W", "power at the crank", turn.crank_torque * model.samples.speed),
        Column("pin_loss", "W", "power lost by friction of the pin", turn.pin.pin_loss),
    )
    return Table("torque", "Torque and power over a turn", columns)


def _side_values(model: GenevaModel, turn: TurnForces, pressure: Floats) -> Iterator[tuple[str, Value]]:
    for name, (words, sign) in SIDES.items():
        force = np.maximum(sign * turn.pin.normal, 0.0)
        at = int(np.argmax(force))
        meaning = f"maximum force of the pin on the {words} side of the slot"
        yield f"max_force.{name}", Value(float(force[at]), "N", meaning, label=f"Maximum pin force, {words} side")
        if force[at] > 0:
            meaning = f"crank angle at the maximum force on the {words} side"
            yield (
                f"max_force.{name}.at",
                Value(float(model.samples.angle[at]), "rad", meaning, label=f"Crank angle at maximum, {words} side"),
            )
            meaning = f"maximum Hertz pressure on the {words} side of the slot"
            yield f"max_pressure.{name}", Value(float(pressure[at]), "Pa", meaning, label=f"Maximum Hertz pressure, {words} side")
    yield (
        "max_bearing_force",
        Value(
            float(np.max(turn.pin.resultant)), "N", "maximum force on the bearing of the wheel", label="Maximum force on the wheel bearing"
        ),
    )


def _demand(model: GenevaModel, turn: TurnForces) -> Iterator[tuple[str, Value]]:
    """Torque and power that the crank shaft has to deliver."""
    sizing = size_motor(model.samples.time, turn.crank_torque, model.samples.speed)
    for name, unit, words in (
        ("peak_torque", "N m", "maximum magnitude of the torque"),
        ("rms_torque", "N m", "RMS torque"),
        ("mean_torque", "N m", "mean torque"),
        ("peak_power", "W", "maximum power"),
        ("mean_power", "W", "mean power"),
        ("braking_power", "W", "maximum braking power"),
    ):
        label = "Maximum torque at the crank" if name == "peak_torque" else ""
        yield f"crank.{name}", Value(getattr(sizing, name), unit, f"{words} at the crank", label=label)


def _rubbing(model: GenevaModel, turn: TurnForces) -> Iterator[tuple[str, Value]]:
    """Sliding, friction work, the product of pressure and speed, and wear."""
    time, pin = model.samples.time, turn.pin
    work, path = trapezoid(pin.pin_loss, time), trapezoid(np.abs(pin.normal) * pin.sliding, time)
    meaning = "maximum sliding speed of the pin in the slot, of a roller on its journal, under load"
    yield "max_sliding_speed", Value(float(np.max(pin.sliding)), "m/s", meaning, label="Maximum sliding speed")
    yield "friction_work", Value(float(work), "J", "friction work of the pin in a step", label="Friction work of the pin in a step")
    mean = np.abs(pin.normal) / (2 * _rubbing_radius(model) * model.spec.wheel.thickness)
    meaning = "maximum of projected pressure times sliding speed: of a fixed pin in the slot, of a roller on its journal"
    yield "wear_index", Value(float(np.max(mean * pin.sliding)), "W/m^2", meaning, label="Wear index, pressure times speed")
    rate = model.spec.pin.wear_coefficient
    if rate:
        worn = float(wear_volume(rate, 1.0, MILLION * path))
        yield "wear.volume", Value(worn, "m^3", "volume worn off in a million steps", label="Wear volume in a million steps")
        if model.spec.pin.kind == "fixed":
            depth = worn / model.spec.slots / (model.spec.wheel.thickness * _swept(model))
            yield "wear.slot_depth", Value(depth, "m", "mean wear depth of a slot in a million steps", label="Slot wear in a million steps")


def _rubbing_radius(model):
    return model.spec.pin.radius if model.spec.pin.kind == "fixed" else model.journal_radius


def _swept(model):
    """Length of a slot that the pin sweeps [m]."""
    distance = model.step.pin_distance(model.samples.angle[model.samples.engaged])
    return float(np.ptp(distance))


def _judged(model: GenevaModel, values: dict[str, Value]) -> Answer:
    """The check of the larger pressure against the weaker material."""
    pressures = {name: values[f"max_pressure.{name}"].value for name in SIDES if f"max_pressure.{name}" in values}
    if not pressures:
        return Answer()
    side = max(pressures, key=lambda name: pressures[name])
    cards = [materials.material(name) for name in (model.spec.pin.material, model.spec.wheel.material)]
    weaker = min(cards, key=lambda card: -1.0 if card.hertz_limit is None else card.hertz_limit)
    message = f"maximum Hertz pressure of pin and slot, on the {SIDES[side][0]} side; widen the wheel, take a thicker pin or a lower speed"
    limit = model.spec.limits.contact_pressure
    return pressure_check("contact_pressure", pressures[side], limit, weaker, message, ("pin", "wheel"), "Maximum Hertz pressure")


# -- energy ----------------------------------------------------------------------------------------------------------------------


def no_audit(spec: GenevaSpec) -> str | None:
    """Why the energy is not audited."""
    if spec.centre_distance is None or spec.crank_radius is None:
        return None
    off = spec.crank_radius - spec.centre_distance * float(np.sin(np.pi / spec.slots))
    return None if off <= 1e-9 else "the pin enters with a shock, whose energy is that of entry.energy"


def energy(model: GenevaModel, done: Answers) -> Answer:
    """Work of the crank over a turn against load, friction and the motion of wheel and crank."""
    turn, crank, wheel = turn_forces(model), model.samples, model.wheel_by_time
    load = model.spec.load
    powers = np.stack(
        [
            turn.crank_torque * crank.speed,
            -(load.friction_torque + load.process_torque) * wheel.d1,
            -turn.pin.pin_loss,
            -turn.pin.bearing_torque * wheel.d1,
        ],
        axis=1,
    )
    kinetic = (model.inertia * wheel.d1**2 + model.spec.drive.inertia * crank.speed**2) / 2
    return audit_answer(audit_of_powers(crank.time, powers, kinetic, kinetic, drives=0), AUDITED, AUDIT_LIMIT, AUDIT_ROWS)
