"""Plate and pins of the running chain as elastic solids in contact: stress, pressure, life."""

from collections.abc import Iterable, Iterator
from contextlib import contextmanager

import numpy as np

from drivewright._typing import Floats, Ints
from drivewright.chains.solid import tables
from drivewright.chains.solid.assumptions import peaks
from drivewright.chains.solid.fields import solid_fields
from drivewright.chains.solid.history import SkinLife, SolidHistory, skin_life, solid_history
from drivewright.chains.solid.joint import Fit, Material, RollingPins, rolling_pins, stack_of
from drivewright.chains.solid.meshes import usual_sizes
from drivewright.chains.solid.pitch import PlateAndPins, plate_and_pins
from drivewright.chains.stress.plate import SIDES, stress_history, worst
from drivewright.chains.stress.revolution import PlateRevolution, loads_at, turning_points
from drivewright.errors import InputError
from drivewright.mechanisms.silent_chain.build import ChainModel
from drivewright.mechanisms.silent_chain.missing import unless_impossible
from drivewright.mechanisms.silent_chain.spec import FINEST, Solid
from drivewright.mechanisms.silent_chain.stress import card_of, plane_basis, plate_revolution
from drivewright.numerics.ensemble import mean_of_members
from drivewright.result import Answer, Answers, Check, Table, Value
from drivewright.solids.contact.model import ACROSS, CoarseContact
from drivewright.solids.plane import plane_von_mises


@unless_impossible
def solid_stress(model: ChainModel, done: Answers) -> Answer:
    """Stress and life of a plate and of its pins as solids in contact, over a revolution of the chain."""
    if model.plate_refusal:
        return Answer(
            findings=(f"analysis 'solid_stress' is left out, because the plate cannot be drawn: {model.plate_refusal}",), outcome="left out"
        )
    runs = done["dynamics"].data
    if runs is None:
        return Answer(findings=("analysis 'solid_stress' is left out: the run of the chain failed",), outcome="left out")
    revolutions = [plate_revolution(model, run) for run in runs.members]
    if not all(each.whole for each in revolutions):
        return Answer(
            findings=(
                "analysis 'solid_stress' is left out: the run is shorter than a revolution of the chain; increase dynamics.duration, or "
                "leave it out",
            ),
            outcome="left out",
        )
    kept = [steps(model, each) for each in revolutions]
    with _fine_enough(model.spec.solid):
        rolling, solid = condensed(model, revolutions)
        histories = [solid_history(solid, loads_at(each.loads, rows)) for each, rows in zip(revolutions, kept, strict=True)]
    return _answer(model, rolling, histories, revolutions[0].time[kept[0]])


@contextmanager
def _fine_enough(given: Solid) -> Iterator[None]:
    """Says of a contact that is too narrow for its elements which keys of the spec help."""
    try:
        yield
    except CoarseContact as error:
        width = f"{error.width:.3g} mm" if error.width > 0 else "less than an element"
        finer = given.fineness * ACROSS * error.size / error.width if error.width > 0 else np.inf
        remedy = f"solid.fineness {np.ceil(10 * finer) / 10:.2g} or more, or " if finer <= FINEST else ""
        raise InputError(
            f"the contact of a pin with its seat has a width of {width}, less than two elements of {error.size:.3g} mm; with a clearance "
            f"of {1e6 * given.clearance:.4g} µm they touch almost along a line. Take {remedy}a smaller solid.clearance."
        ) from None


def steps(model: ChainModel, revolution: PlateRevolution) -> Ints:
    """Instants of a revolution that become load steps: turning points of the stress of the plane plate where it is worst."""
    basis = plane_basis(model)
    size = plane_von_mises(stress_history(basis, revolution.loads, [worst(basis, revolution.loads).row])[:, 0])
    return turning_points(size, model.spec.solid.load_steps)


def condensed(model: ChainModel, revolutions: Iterable[PlateRevolution]) -> tuple[RollingPins, PlateAndPins]:
    """The joint under the greatest force that a pin bears, and the plate with its pins ready for any load."""
    spec, given = model.spec, model.spec.solid
    material = Material(spec.material.youngs_modulus, spec.material.poisson_ratio)
    stack, sizes = stack_of(model.plate, spec.plate.lacing), usual_sizes(model.plate, given.fineness)
    fit = Fit(given.clearance, given.edge_radius, given.seat, given.friction)
    several = list(revolutions)
    greatest = max(float(np.linalg.norm(np.asarray(each.loads.pins), axis=2).max()) for each in several)
    rolling = rolling_pins(model.plate, stack, fit, material, 0.5 * greatest, sizes)
    heights = several[0].contact_heights
    return rolling, plate_and_pins(model.plate, stack, fit, material, rolling.shares, heights, sizes)


def _answer(model: ChainModel, rolling: RollingPins, histories: list[SolidHistory], time: Floats) -> Answer:
    spec, first = model.spec, histories[0]
    card = card_of(model)
    plates = [skin_life(each.skins["plate"], each.searched["plate"], card, spec.fatigue.plane) for each in histories]
    pins = [{side: skin_life(each.skins[side], each.searched[side], card, spec.fatigue.plane) for side in SIDES} for each in histories]
    pressure = tables.rolling_table(rolling, model.link.radius, spec.material.youngs_modulus, spec.material.poisson_ratio)
    values = _stresses(rolling, histories, float(np.max(pressure["pressure"].data))) | {
        "solid.plate.min_life": _mean_life(
            [each.least for each in plates],
            "minimum fatigue life of a plate in revolutions of the chain, by the solid model",
            "Minimum plate life (solid)",
        ),
        "solid.pin.min_life": _mean_life(
            [min(each["left"].least, each["right"].least) for each in pins],
            "minimum fatigue life of a pin outside its rolling contact in revolutions of the chain, by the solid model",
            "Minimum pin life (solid)",
        ),
    }
    limit = spec.limits.yield_safety
    checks = tuple(
        Check(
            f"solid.{name}.yield",
            spec.material.yield_strength / values[f"solid.{name}.max_stress"].value,
            limit,
            ">=",
            "-",
            f"yield strength over the maximum von Mises stress of a {name}, by the solid model; a thicker {name} increases it",
            ("chain",),
            label=f"Yield safety of the {name} (solid)",
        )
        for name in ("plate", "pin")
    )
    found = (*_pictures(first, time, plates[0], pins[0]), pressure)
    fields = solid_fields(first, time, {"plate": plates[0], **pins[0]})
    return Answer(values, found, checks, tuple(_remarks(model, rolling, histories)), fields=(fields,))


def _stresses(rolling: RollingPins, histories: list[SolidHistory], pressure: float) -> dict[str, Value]:
    """Stresses and pressures; `pressure` [Pa]: the greatest between the pins."""
    first, most = histories[0], [peaks(each) for each in histories]
    x, y, z = first.skins["plate"].points[first.worst("plate")[2]]
    return {
        "solid.plate.max_stress": _mean(
            [each.plate for each in most],
            "Pa",
            "maximum von Mises stress of a plate over a revolution of the chain, as a solid in contact with its pins",
            "Maximum plate stress (solid)",
        ),
        "solid.plate.max_stress.x": Value(
            float(x), "m", "place of the maximum stress along the plate, from its middle", label="Maximum plate stress (solid), x"
        ),
        "solid.plate.max_stress.y": Value(
            float(y), "m", "place of the maximum stress across the plate, above the pin line", label="Maximum plate stress (solid), y"
        ),
        "solid.plate.max_stress.z": Value(
            float(z),
            "m",
            "place of the maximum stress along the pins, from the middle of the chain",
            label="Maximum plate stress (solid), z",
        ),
        "solid.pin.max_stress": _mean(
            [each.pin for each in most],
            "Pa",
            "maximum von Mises stress of a pin over a revolution of the chain, outside its rolling contact",
            "Maximum pin stress (solid)",
        ),
        "solid.seat.max_pressure": _mean(
            [each.pressure for each in most],
            "Pa",
            "maximum pressure of a pin on its seat in a plate; it grows with sharper edges of the hole",
            "Maximum seat pressure (solid)",
        ),
        "solid.rolling.max_pressure": Value(
            pressure,
            "Pa",
            "maximum Hertz pressure between two pins under the largest force, with the line load as distributed by their bending",
            label="Maximum rolling pressure (solid)",
        ),
        "solid.rolling.line_load_ratio": Value(
            float(rolling.line_load.max() / np.average(rolling.line_load, weights=rolling.shares / rolling.line_load)),
            "-",
            "maximum line load between two pins over its mean along them",
            label="Line load, maximum over mean",
        ),
    }


def _pictures(first: SolidHistory, time: Floats, plate: SkinLife, pins: dict[str, SkinLife]) -> tuple[Table, ...]:
    """Tables of one run: history, plate, the pin with the greatest stress, its seat and the section through its hole, lives."""
    side = max(SIDES, key=lambda name: first.worst(name)[0])
    instant, pin_instant = first.worst("plate")[1], first.worst(side)[1]
    return (
        tables.history_table(first, time),
        tables.stress_table("solid_plate", "Plate at its worst instant (solid)", first, "plate", instant),
        tables.stress_table("solid_pin", "Pin at its worst instant (solid)", first, side, pin_instant),
        tables.section_table(first, side, pin_instant),
        tables.seat_table(first, side, pin_instant),
        tables.life_table("solid_plate_life", "Life on the plate surface (solid)", first.skins["plate"], plate, "plate"),
        tables.life_table("solid_pin_life", "Life on the pin surface (solid)", first.skins[side], pins[side], side),
    )


def _remarks(model: ChainModel, rolling: RollingPins, histories: list[SolidHistory]) -> Iterable[str]:
    unknowns = {name: body.unknowns for name, body in histories[0].solid.model.bodies.items()}
    yield (
        f"solids: {len(histories[0].states)} load steps of a revolution, turning points of the stress (solid.load_steps); "
        f"{unknowns['plate']} unknowns of the plate, {unknowns['left']} of a pin; with elements half as large the maximum stress "
        "changes by about 2 %, the pressure at the edges of a hole by up to 20 % (solid.fineness)"
    )
    if rolling.state.model.bodies["own pin"].basis.shape[1] < 3:
        yield "solids: a lacing wider than 1 x 2 is modelled as a cell of an endless stack of plates, whose pins do not bend"
    yield (
        "solids: the stress in the rolling contact follows from Hertz (pin.contact_pressure, pin.shakedown) and is not included in that "
        "of the pins; clearance, friction and edge radius of the holes are assumptions (solid.clearance, solid.friction, solid.edge_radius)"
    )
    if card_of(model).estimated:
        yield "solids: the fatigue data are estimated from the tensile strength by the uniform material law; give test data in fatigue.card"


def _mean(numbers: list[float], unit: str, meaning: str, label: str) -> Value:
    """Mean over the runs with its 95 % interval."""
    mean, half = mean_of_members(np.array(numbers))
    if not np.isfinite(half):
        return Value(float(mean), unit, meaning, label=label)
    return Value(float(mean), unit, meaning, float(mean - half), float(mean + half), "ensemble", label=label)


def _mean_life(lives: list[float], meaning: str, label: str) -> Value:
    """Geometric mean over the runs with its 95 % interval; inf where a run does no damage."""
    logs = np.log(np.array(lives))
    mean, half = mean_of_members(logs)
    if not np.isfinite(mean) or not np.isfinite(half):
        return Value(float(np.exp(mean)), "-", meaning, label=label)
    return Value(float(np.exp(mean)), "-", meaning, float(np.exp(mean - half)), float(np.exp(mean + half)), "ensemble", label=label)
