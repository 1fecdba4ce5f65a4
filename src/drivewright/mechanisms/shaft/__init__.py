"""The kind `shaft`: a shaft on elastic, rigid and rolling bearings."""

from pathlib import Path

from drivewright.mechanisms.shaft import frequencies, influence, rolling, rotation, sensitivity, solid, statics, strength
from drivewright.mechanisms.shaft.build import build
from drivewright.mechanisms.shaft.claims import claims
from drivewright.mechanisms.shaft.designs import batch
from drivewright.mechanisms.shaft.dimensions import SHEETS
from drivewright.mechanisms.shaft.plots import plots
from drivewright.mechanisms.shaft.scene import drawings, parts, scene
from drivewright.mechanisms.shaft.spec import ShaftSpec
from drivewright.mechanisms.shaft.supplied import supplied
from drivewright.registry import Analysis, Mechanism, oracle

ANALYSES = (
    Analysis("statics", statics.statics, "deflection, reactions, moments and stress under the loads"),
    Analysis(
        "rolling", rolling.rolling, "rolling bearings: stiffness, load distribution, life", needs=("statics",), missing=rolling.no_rolling
    ),
    Analysis(
        "flexibility",
        influence.flexibility,
        "flexibility and stiffness at the stations and their contributions",
        needs=("statics",),
        missing=influence.no_stations,
    ),
    Analysis(
        "failure",
        influence.failure,
        "limit loads at the stations and the part that fails first",
        needs=("statics", "flexibility"),
        missing=influence.no_strength,
    ),
    Analysis("strength", strength.strength, "fatigue and yield safety of every section", needs=("statics",), missing=strength.no_strength),
    Analysis("modes", frequencies.frequencies, "natural frequencies and critical speeds", needs=("statics",), missing=frequencies.no_modes),
    Analysis(
        "whirl", rotation.whirl, "whirl at speed, Campbell diagram and stability", needs=("statics", "modes"), missing=rotation.no_whirl
    ),
    Analysis(
        "unbalance",
        rotation.unbalance,
        "unbalance response of stations and gears",
        needs=("statics", "modes", "whirl"),
        missing=rotation.no_unbalance,
    ),
    Analysis(
        "sensitivities",
        sensitivity.sensitivities,
        "sensitivities of the flexibility",
        needs=("statics", "flexibility"),
        missing=influence.no_stations,
    ),
    Analysis(
        "solid", solid.solid, "the shaft as a solid of finite elements", default=False, needs=("statics",), missing=influence.no_stations
    ),
)

HEADLINE = (
    "stations.*.displacement",
    "gears.*.deflection",
    "gears.*.slope",
    "shaft.max_stress",
    "strength.min_safety",
    "shaft.system_*.time",
    "bearings.*.radial_force",
    "critical_speeds.lowest",
    "bearings.*.stiffness.tangent",
    "bearings.*.stiffness.secant",
    "flexibility.*",
    "stiffness.*",
    "modes.*.frequency",
    "critical_speeds.damped.*",
    "whirl.*.1",
    "stability.*",
    "unbalance.*.amplitude",
    "shaft.max_deflection",
    "stations.*.allowed_load",
    "bearings.*.max_pressure",
    "bearings.*.basic_life.time",
    "bearings.*.reference_life.time",
    "bearings.*.modified_life.time",
    "solid.deviation",
    "stations.*.deflection",
    "bearings.*.reaction",
)

SOURCES = (
    "Li Yanqi, Zhang, Chen: Transverse Stiffness Analysis of the Shaft System in the Drive Mechanism of Mobile-Head Spiral Winding "
    "Equipment.",
    "Cowper, The shear coefficient in Timoshenko's beam theory, 1966 (recalled, verified against the solid)",
    "ISO/TS 16281, ISO 281, ISO 76 (recalled, verified by closed forms and published results)",
)

mechanism = Mechanism(
    kind="shaft",
    summary="shaft on elastic, rigid and rolling bearings",
    spec=ShaftSpec,
    build=build,
    claims=claims,
    analyses=ANALYSES,
    folder=Path(__file__).parent,
    adjustable={
        "segments.*.diameter": 2.0,
        "segments.*.fillet_radius": 3.0,
        "bearings.*.position": 1.2,
        "bearings.*.static_rating": 5.0,
        "bearings.*.dynamic_rating": 5.0,
    },
    main_plots=("haigh", "unit_load", "modes", "campbell", "shares"),
    diagrams=("diagram/shear", "diagram/moment", "diagram/deflection", "diagram/slope", "stress/stress"),
    headline=HEADLINE,
    sources=SOURCES,
    scene=scene,
    dimensions=SHEETS,
    plots=plots,
    drawings=drawings,
    parts=parts,
    verify=oracle("shaft"),
    batch=batch,
    supplied=supplied,
)
