"""The kind `silent-chain`: silent chains with rolling joints, and chains with round pins."""

from collections.abc import Callable
from pathlib import Path

from drivewright.errors import InputError, SpecError
from drivewright.mechanisms.silent_chain import closure, compare, contact, dynamics, layout, many, stress
from drivewright.mechanisms.silent_chain.build import ChainModel, build
from drivewright.mechanisms.silent_chain.claims import claims
from drivewright.mechanisms.silent_chain.designs import batch
from drivewright.mechanisms.silent_chain.geometry import geometry
from drivewright.mechanisms.silent_chain.meshing import meshing, no_meshing
from drivewright.mechanisms.silent_chain.plots import plots
from drivewright.mechanisms.silent_chain.scene import drawings, parts, scene
from drivewright.mechanisms.silent_chain.spec import SilentChainSpec
from drivewright.registry import Analysis, Mechanism, oracle
from drivewright.result import Answer, Answers


def unless_impossible(answer: Callable[[ChainModel, Answers], Answer]) -> Callable[[ChainModel, Answers], Answer]:
    """The analysis, left out with the reason where the bodies, the card or the place that it asks for cannot be."""

    def guarded(model: ChainModel, done: Answers) -> Answer:
        """Its answer, or why there is none."""
        try:
            return answer(model, done)
        except SpecError:  # it names the key to change
            raise
        except InputError as impossible:
            return Answer(findings=(f"{answer.__name__.replace('_', ' ')} is left out: {impossible}",), outcome="left out")

    return guarded


ANALYSES = (
    Analysis("meshing", meshing, "pitches, offset, modification of the teeth as published", missing=no_meshing),
    Analysis("layout", layout.layout, "chain length, pitch circles, speed and strand frequencies by formula"),
    Analysis("geometry", geometry, "plates and sprockets: walls, teeth, measuring pins, gaps"),
    Analysis("closure", closure.closure, "centre distance and transmission error over a tooth", missing=closure.no_closure),
    Analysis("contact", contact.contact, "pins under the force of a strand: pressure, shakedown, bending", missing=contact.no_contact),
    Analysis("trade_off", compare.trade_off, "what the rolling radius trades", missing=compare.no_comparison),
    Analysis("phase_map", compare.phases, "fluctuation over links, teeth and rolling radius", missing=compare.no_phase_map),
    Analysis(
        "dynamics",
        unless_impossible(dynamics.dynamics),
        "the running chain: centre distance, forces, spectrum",
        missing=dynamics.no_dynamics,
    ),
    Analysis(
        "quasi_static",
        unless_impossible(many.quasi_static),
        "the loaded chain at rest, teeth and joints elastic",
        default=False,
        missing=dynamics.no_dynamics,
    ),
    Analysis(
        "speeds",
        unless_impossible(many.speeds),
        "the running chain over the speed: Campbell diagram",
        default=False,
        missing=dynamics.no_dynamics,
    ),
    Analysis(
        "scatter",
        unless_impossible(many.scatter),
        "the running chain as it comes from manufacture",
        default=False,
        missing=dynamics.no_dynamics,
    ),
    Analysis(
        "stress",
        unless_impossible(stress.stress),
        "stress of a plate as it goes round, finite elements",
        default=False,
        needs=("dynamics",),
        missing=stress.no_stress,
    ),
    Analysis(
        "life",
        unless_impossible(stress.life),
        "fatigue life of a plate on its critical planes",
        default=False,
        needs=("stress",),
        missing=stress.no_stress,
    ),
)

HEADLINE = (
    "pin_offset",
    "pitch_deviation.drive",
    "pitch_deviation.driven",
    "modification.*",
    "centre_distance.mean",
    "centre_distance.fluctuation",
    "transmission_error",
    "pin.contact_pressure",
    "dynamics.centre_distance.mean",
    "dynamics.centre_distance.fluctuation",
    "dynamics.centre_distance.mesh_order_amplitude",
    "quasi_static.centre_distance.mean",
    "plate.max_von_mises",
    "plate.life",
)

SOURCES = (
    "An Lichi, Cheng Yabing, Li Jiabao, Xu Weilong: New design of Hy-Vo chain based on the ultra-small rolling radius, Machines 2022, "
    "10(5), 325, doi:10.3390/machines10050325 (read; equations corrected)",
    "Johnson, Contact Mechanics (1985); ISO 606 family of roller chains; uniform material law of Baumel and Seeger (recalled)",
)

mechanism = Mechanism(
    kind="silent-chain",
    summary="chain drive",
    spec=SilentChainSpec,
    build=build,
    claims=claims,
    analyses=ANALYSES,
    folder=Path(__file__).parent,
    headline=HEADLINE,
    sources=SOURCES,
    scene=scene,
    plots=plots,
    drawings=drawings,
    parts=parts,
    verify=oracle("silent_chain"),
    batch=batch,
)
