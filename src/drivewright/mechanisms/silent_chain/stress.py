"""Stress and life of a plate over its circulation: loads from the dynamics, elements by superposition, critical planes."""

import numpy as np

from drivewright import fatigue
from drivewright.chains.explicit.motion import Motion
from drivewright.chains.stress.life import life_map, life_table, plate_life
from drivewright.chains.stress.plate import Basis, plate_basis, plate_body, stress_history, stress_picture, worst
from drivewright.chains.stress.revolution import PlateRevolution, StressedPlate, fewer_instants, history_table
from drivewright.fatigue.material import StrainLife
from drivewright.mechanisms.silent_chain.build import ChainModel
from drivewright.mechanisms.silent_chain.missing import unless_impossible
from drivewright.result import Answer, Answers, Check, Value
from drivewright.solids.plane import plane_von_mises

LEAST = 0.3  # of the greatest stress: points below it are not looked at for life
MOST_INSTANTS = 500  # of a revolution, for life
DOT = 0.015  # of the pitch: a point of the life map


@unless_impossible
def stress(model: ChainModel, done: Answers) -> Answer:
    """Stress of a plate over a revolution of the chain."""
    reason = model.plate_refusal
    if reason:
        return Answer(findings=(f"analysis 'stress' is left out, because the plate cannot be drawn: {reason}",), outcome="left out")
    basis, revolution = plane_basis(model), plate_revolution(model, done["dynamics"].data.first)
    loads = revolution.loads
    peak = worst(basis, loads)
    history = plane_von_mises(stress_history(basis, loads, [peak.row])[:, 0])
    x, y = peak.place
    values = {
        "plate.max_von_mises": Value(
            peak.stress,
            "Pa",
            "maximum von Mises stress of a plate over a revolution of the chain, outside its loaded flanks",
            label="Maximum plate stress",
        ),
        "plate.max_von_mises.x": Value(
            x, "m", "place of the maximum stress along the plate, from its middle", label="Maximum plate stress, x"
        ),
        "plate.max_von_mises.y": Value(
            y, "m", "place of the maximum stress across the plate, above the pin line", label="Maximum plate stress, y"
        ),
    }
    safety = model.spec.material.yield_strength / peak.stress
    message = "yield strength over the maximum von Mises stress of a plate; a thicker plate or thicker walls increase it"
    check = Check("plate.yield", safety, model.spec.limits.yield_safety, ">=", "-", message, ("chain",), label="Yield safety of the plate")
    picture = stress_picture(basis, loads, peak.instant)
    return Answer(values, (history_table(revolution, history), picture), (check,), data=StressedPlate(basis, revolution))


@unless_impossible
def life(model: ChainModel, done: Answers) -> Answer:
    """Life of a plate and of a pin in revolutions of the chain."""
    stressed, card = done["stress"].data, card_of(model)
    if stressed is None:
        return Answer(findings=("analysis 'life' is left out: the stress of the plate is not known",), outcome="left out")
    basis, turn = stressed
    if not turn.whole:
        return Answer(
            findings=(
                "analysis 'life' is left out: the run is shorter than a revolution of the chain; increase dynamics.duration, or leave it "
                "out",
            ),
            outcome="left out",
        )
    lives = plate_life(basis, fewer_instants(turn.loads, MOST_INSTANTS), card, model.spec.fatigue.plane, LEAST)
    shortest, revolution = float(np.min(lives.life)), turn.time[-1] - turn.time[0]
    values = {
        "plate.life": Value(
            shortest,
            "-",
            f"fatigue life of a plate in revolutions of the chain, {fatigue.life_text(shortest, card)}",
            label="Plate life in chain revolutions",
        ),
        "plate.life.time": Value(
            shortest * revolution, "s", "fatigue life of a plate as time at this speed", label="Plate life at this speed"
        ),
    }
    findings = [
        f"plate: the life is {fatigue.life_text(shortest, card)} revolutions of the chain of {revolution:.4g} s each; one revolution "
        f"causes a damage of {float(np.max(lives.damage)):.3g}",
        *(
            ["the fatigue data are estimated from the tensile strength by the uniform material law; give test data in fatigue.card"]
            if card.estimated
            else []
        ),
        "the rolling contact fatigue of the pins is not covered by the Brown-Miller criterion; see the check pin.shakedown",
    ]
    return Answer(values, (life_table(basis, lives), life_map(basis, lives, DOT * model.link.pitch)), (), tuple(findings))


def card_of(model: ChainModel) -> StrainLife:
    """The strain-life card: as given, else estimated from the tensile strength."""
    material = model.spec.material
    return model.spec.fatigue.card or fatigue.uniform_material_law(
        material.tensile_strength, material.youngs_modulus, material.poisson_ratio, yield_strength=material.yield_strength
    )


def plate_revolution(model: ChainModel, motion: Motion) -> PlateRevolution:
    """Of the link with fewer plates, which carry the most."""
    on_drive, on_driven = (model.plate.contact(side.tooth, "right")[1] for side in model.sides)
    return PlateRevolution(motion, model.rows * min(model.spec.plate.lacing), (on_drive, on_driven), 0.5 * model.closure.mean)


def plane_basis(model: ChainModel) -> Basis:
    """The plate in plane stress under unit loads."""
    material = model.spec.material
    return plate_basis(
        model.plate, plate_body(model.plate, material.youngs_modulus, material.poisson_ratio, fineness=model.spec.fatigue.fineness)
    )
