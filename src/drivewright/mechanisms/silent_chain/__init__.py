"""The kind `silent-chain`: silent chains with rolling joints, and chains with round pins."""

from pathlib import Path

from drivewright.mechanisms.silent_chain import capacity, closure, compare, contact, dynamics, layout, many, missing, solid, stress
from drivewright.mechanisms.silent_chain.build import build
from drivewright.mechanisms.silent_chain.chain_drive import compile_ahead
from drivewright.mechanisms.silent_chain.claims import claims
from drivewright.mechanisms.silent_chain.designs import batch
from drivewright.mechanisms.silent_chain.dimensions import SHEETS
from drivewright.mechanisms.silent_chain.geometry import geometry
from drivewright.mechanisms.silent_chain.meshing import meshing
from drivewright.mechanisms.silent_chain.plots import plots
from drivewright.mechanisms.silent_chain.scene import drawings, parts, scene
from drivewright.mechanisms.silent_chain.sizing import supplied
from drivewright.mechanisms.silent_chain.spec import SilentChainSpec
from drivewright.registry import Analysis, Mechanism, oracle

ANALYSES = (
    Analysis("meshing", meshing, "pitches, pin offset and tooth modification by the published method", missing=missing.no_meshing),
    Analysis("layout", layout.layout, "chain length, pitch circles, speed and strand frequencies by formula"),
    Analysis("geometry", geometry, "plates and sprockets: walls, teeth, measurement over pins, gaps"),
    Analysis(
        "closure", closure.closure, "centre distance and transmission error of the rigid chain over one tooth", missing=missing.no_closure
    ),
    Analysis(
        "contact", contact.contact, "strand tensions and stresses of the pins: pressure, shakedown, bending", missing=missing.no_contact
    ),
    Analysis("wear", capacity.wear, "elongation by wear of the joints, and the wear life", missing=missing.no_wear),
    Analysis("rating", capacity.rating, "rated power and design power", missing=missing.no_rating),
    Analysis("trade_off", compare.trade_off, "trade-offs over the rolling radius", missing=missing.no_trade_off),
    Analysis(
        "phase_map", compare.phases, "fluctuation of the centre distance over links, teeth and rolling radius", missing=missing.no_phase_map
    ),
    Analysis(
        "dynamics", dynamics.dynamics, "dynamics of the running chain: centre distance, forces, spectrum", missing=missing.no_dynamics
    ),
    Analysis(
        "quasi_static",
        many.quasi_static,
        "the loaded chain at rest, with elastic teeth and joints",
        default=False,
        missing=missing.no_dynamics,
    ),
    Analysis("speeds", many.speeds, "the running chain over speed: Campbell diagram", default=False, missing=missing.no_dynamics),
    Analysis("scatter", many.scatter, "the running chain with manufacturing scatter", default=False, missing=missing.no_dynamics),
    Analysis(
        "stress",
        stress.stress,
        "stress of a plate over a revolution of the chain, by finite elements",
        default=False,
        needs=("dynamics",),
        missing=missing.no_stress,
    ),
    Analysis(
        "life",
        stress.life,
        "fatigue life of a plate by the critical plane method",
        default=False,
        needs=("stress",),
        missing=missing.no_stress,
    ),
    Analysis(
        "solid_stress",
        solid.solid_stress,
        "plate and pins as solids in contact over a revolution: stress, pressure, life",
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
    adjustable={
        "joint.rolling_radius": 1.5,
        "joint.contact_length": 2.0,
        "plate.thickness": 2.0,
        "plate.apothem": 1.3,
        "drive.preload": 3.0,
    },
    main_plots=("centre_distance", "running/tension", "spectrum", "trade_off"),
    headline=HEADLINE,
    sources=SOURCES,
    scene=scene,
    dimensions=SHEETS,
    plots=plots,
    drawings=drawings,
    parts=parts,
    verify=oracle("silent_chain"),
    batch=batch,
    supplied=supplied,
)
