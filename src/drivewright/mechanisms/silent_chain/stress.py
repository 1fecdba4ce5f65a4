"""Stress and life of a plate that goes round: loads from the dynamics, elements by superposition, critical planes."""

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
        return Answer(findings=(f"stress is left out: no plate can be drawn: {reason}",), outcome="left out")
    basis, revolution = plane_basis(model), plate_revolution(model, done["dynamics"].data.first)
    loads = revolution.loads
    peak = worst(basis, loads)
    history = plane_von_mises(stress_history(basis, loads, [peak.row])[:, 0])
    x, y = peak.place
    values = {
        "plate.max_von_mises": Value(peak.stress, "Pa", "greatest von Mises stress of a plate as it goes round, beside its loaded flanks"),
        "plate.max_von_mises.x": Value(x, "m", "where it is, along the plate from its middle"),
        "plate.max_von_mises.y": Value(y, "m", "where it is, above the line of the pins"),
    }
    safety, message = model.spec.material.yield_strength / peak.stress, "yield strength over the greatest von Mises stress of a plate"
    check = Check("plate.yield", safety, model.spec.limits.yield_safety, ">=", "-", message, ("chain",))
    picture = stress_picture(basis, loads, peak.instant)
    return Answer(values, (history_table(revolution, history), picture), (check,), data=StressedPlate(basis, revolution))


@unless_impossible
def life(model: ChainModel, done: Answers) -> Answer:
    """Life of a plate and of a pin in revolutions of the chain."""
    stressed, card = done["stress"].data, card_of(model)
    if stressed is None:
        return Answer(findings=("life is left out: there is no stress",), outcome="left out")
    basis, turn = stressed
    if not turn.whole:
        return Answer(
            findings=("life is left out: the run is shorter than a revolution of the chain; give dynamics.duration more, or none",),
            outcome="left out",
        )
    lives = plate_life(basis, fewer_instants(turn.loads, MOST_INSTANTS), card, model.spec.fatigue.plane, LEAST)
    shortest, revolution = float(np.min(lives.life)), turn.time[-1] - turn.time[0]
    values = {
        "plate.life": Value(shortest, "-", f"revolutions of the chain, {fatigue.life_text(shortest, card)}"),
        "plate.life.time": Value(shortest * revolution, "s", "the same as time at this speed"),
    }
    findings = [
        f"plate: life of {fatigue.life_text(shortest, card)} revolutions of the chain of {revolution:.4g} s; one revolution takes up "
        f"{float(np.max(lives.damage)):.3g} of it",
        *(
            ["the fatigue data are estimated from the tensile strength by the uniform material law; bring data from tests"]
            if card.estimated
            else []
        ),
        "the pins roll under their contact pressure: its fatigue is not Brown and Miller's; see pin.shakedown",
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
