"""The kind `silent-chain`: silent chains with rolling joints, and chains with round pins."""

from pathlib import Path

from drivewright.mechanisms.silent_chain import capacity, closure, compare, contact, dynamics, layout, many, missing, solid, stress
from drivewright.mechanisms.silent_chain.build import build
from drivewright.mechanisms.silent_chain.chain_drive import compile_ahead
from drivewright.mechanisms.silent_chain.claims import claims
from drivewright.mechanisms.silent_chain.designs import batch
from drivewright.mechanisms.silent_chain.geometry import geometry
from drivewright.mechanisms.silent_chain.meshing import meshing
from drivewright.mechanisms.silent_chain.plots import plots
from drivewright.mechanisms.silent_chain.scene import drawings, parts, scene
from drivewright.mechanisms.silent_chain.sizing import supplied
from drivewright.mechanisms.silent_chain.spec import SilentChainSpec
from drivewright.registry import Analysis, Mechanism, oracle

ANALYSES = (
    Analysis("meshing", meshing, "pitches, offset, modification of the teeth as published", missing=missing.no_meshing),
    Analysis("layout", layout.layout, "chain length, pitch circles, speed and strand frequencies by formula"),
    Analysis("geometry", geometry, "plates and sprockets: walls, teeth, measuring pins, gaps"),
    Analysis("closure", closure.closure, "centre distance and transmission error over a tooth", missing=missing.no_closure),
    Analysis("contact", contact.contact, "pins under the force of a strand: pressure, shakedown, bending", missing=missing.no_contact),
    Analysis("wear", capacity.wear, "elongation by wear of the joints, and the life until its limit", missing=missing.no_wear),
    Analysis("rating", capacity.rating, "rated power against the power transmitted", missing=missing.no_rating),
    Analysis("trade_off", compare.trade_off, "what the rolling radius trades", missing=missing.no_trade_off),
    Analysis("phase_map", compare.phases, "fluctuation over links, teeth and rolling radius", missing=missing.no_phase_map),
    Analysis("dynamics", dynamics.dynamics, "the running chain: centre distance, forces, spectrum", missing=missing.no_dynamics),
    Analysis(
        "quasi_static", many.quasi_static, "the loaded chain at rest, teeth and joints elastic", default=False, missing=missing.no_dynamics
    ),
    Analysis("speeds", many.speeds, "the running chain over the speed: Campbell diagram", default=False, missing=missing.no_dynamics),
    Analysis("scatter", many.scatter, "the running chain as it comes from manufacture", default=False, missing=missing.no_dynamics),
    Analysis(
        "stress",
        stress.stress,
        "stress of a plate as it goes round, finite elements",
        default=False,
        needs=("dynamics",),
        missing=missing.no_stress,
    ),
    Analysis(
        "life", stress.life, "fatigue life of a plate on its critical planes", default=False, needs=("stress",), missing=missing.no_stress
    ),
    Analysis(
        "solid_stress",
        solid.solid_stress,
        "plate and pins as solids in contact as they go round: stress, pressure, life",
        default=False,
        needs=("dynamics",),
        missing=missing.no_solid_stress,
        fields=True,
    ),
)

HEADLINE = (
    "pin_offset",
    "pitch_deviation.drive",
    "pitch_deviation.driven",
    "modification.*",
    "centre_distance.mean",
    "centre_distance.fluctuation",
    "layout.tensioner.*.travel",
    "layout.tensioner.*.force",
    "transmission_error",
    "pin.contact_pressure",
    "chain.static_safety",
    "wear.life",
    "rating.rated_power",
    "dynamics.centre_distance.mean",
    "dynamics.centre_distance.fluctuation",
    "dynamics.centre_distance.mesh_order_amplitude",
    "dynamics.tensioner.*.travel.mean",
    "dynamics.tensioner.*.force",
    "quasi_static.centre_distance.mean",
    "solid.plate.max_stress",
    "solid.pin.max_stress",
    "solid.plate.min_life",
    "solid.pin.min_life",
    "plate.max_von_mises",
    "plate.life",
)

SOURCES = (
    "An Lichi, Cheng Yabing, Li Jiabao, Xu Weilong: New design of Hy-Vo chain based on the ultra-small rolling radius, Machines 2022, "
    "10(5), 325, doi:10.3390/machines10050325 (read; equations corrected)",
    "Donghua Chain Group, Product Catalogue Drive Chains 2020 (read as text): dimensions of roller chains by number; ASME B29.1 and Galaxy "
    "Chain's tables of strengths (read on public pages); see the page on roller chains by number",
    "Johnson, Contact Mechanics (1985); ISO 606 family of roller chains; uniform material law of Baumel and Seeger (recalled)",
)

mechanism = Mechanism(
    kind="silent-chain",
    summary="chain drive",
    spec=SilentChainSpec,
    build=build,
    compile_ahead=compile_ahead,
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
    supplied=supplied,
)
