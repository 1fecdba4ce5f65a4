"""The kind `silent-chain`: silent chains with rolling joints, and chains with round pins."""

from pathlib import Path

from drivewright.mechanisms.silent_chain import closure, contact, dynamics, stress
from drivewright.mechanisms.silent_chain.build import build
from drivewright.mechanisms.silent_chain.geometry import geometry
from drivewright.mechanisms.silent_chain.meshing import meshing, no_meshing
from drivewright.mechanisms.silent_chain.scene import drawings, parts, scene
from drivewright.mechanisms.silent_chain.spec import SilentChainSpec
from drivewright.registry import Analysis, Mechanism

ANALYSES = (
    Analysis("meshing", meshing, "pitches, offset, modification of the teeth as published", missing=no_meshing),
    Analysis("geometry", geometry, "plates and sprockets: walls, teeth, measuring pins, gaps"),
    Analysis("closure", closure.closure, "centre distance and transmission error over a tooth", missing=closure.no_closure),
    Analysis("contact", contact.contact, "pins under the force of a strand: pressure, shakedown, bending", missing=contact.no_contact),
    Analysis("dynamics", dynamics.dynamics, "the running chain: centre distance, forces, spectrum", missing=dynamics.no_dynamics),
    Analysis("stress", stress.stress, "stress of a plate as it goes round, finite elements", default=False, needs=("dynamics",),
             missing=stress.no_stress),
    Analysis("life", stress.life, "fatigue life of a plate on its critical planes", default=False, needs=("stress",),
             missing=stress.no_stress),
)

mechanism = Mechanism(kind="silent-chain", summary="chain drive", spec=SilentChainSpec, build=build, analyses=ANALYSES,
                      folder=Path(__file__).parent, scene=scene, drawings=drawings, parts=parts)
