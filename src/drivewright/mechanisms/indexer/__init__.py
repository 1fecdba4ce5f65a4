"""The kind `indexer`: indexing drives with pins or rollers, and the evaluation of torsion tests."""

from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

from drivewright.mechanisms.indexer import assembly, drive, geometry, loads, roller, shared_load, stiffness, stress, torsion
from drivewright.mechanisms.indexer.batch import batch
from drivewright.mechanisms.indexer.build import IndexerModel, build
from drivewright.mechanisms.indexer.claims import claims
from drivewright.mechanisms.indexer.dimensions import SHEETS
from drivewright.mechanisms.indexer.plots import plots
from drivewright.mechanisms.indexer.scene import drawings, parts, scene
from drivewright.mechanisms.indexer.spec import IndexerSpec
from drivewright.registry import Analysis, Mechanism, oracle
from drivewright.result import Answer, Answers

Question: TypeAlias = Callable[[IndexerModel, Answers], Answer]


def by_kind(plane: Question, spatial: Question) -> Question:
    """The analysis of the plane or of the spatial kinds."""
    return lambda model, done: (spatial if model.spec.kind in ("barrel", "globoidal") else plane)(model, done)


def by_motion(translating: Question, turning: Question) -> Question:
    """The analysis of the kinds whose cams translate on cranks, or of those whose cams turn."""
    return lambda model, done: (translating if model.translating else turning)(model, done)


def no_torque(spec: IndexerSpec) -> str | None:
    """Why there is no stiffness."""
    return None if spec.load.torque else "load.torque is not given"


ANALYSES = (
    Analysis("motion", geometry.motion, "motion of the wheel over the input"),
    Analysis("drive", drive.drive, "input torque and power for a dial table", missing=drive.no_drive),
    Analysis("profile", by_kind(geometry.profile, roller.surface), "cam profile, curvature and undercut"),
    Analysis(
        "contacts",
        by_kind(geometry.contact_map, roller.contact_map),
        "pins in contact, direction of push, pressure angle",
        needs=("profile",),
    ),
    Analysis("play", by_kind(geometry.free_play, roller.free_play), "play of the wheel in both directions", needs=("profile",)),
    Analysis(
        "stiffness",
        by_motion(stiffness.torsional, shared_load.torsional),
        "torsional stiffness and compliance contributions",
        missing=no_torque,
    ),
    Analysis("stress", stress.stress, "forces and contact pressure of the rollers", needs=("profile",), missing=stress.no_stress),
    Analysis(
        "assembly",
        assembly.assembly,
        "cams, shafts and wheel as elastic solids in contact: torsional stiffness and compliance by body",
        default=False,
        missing=assembly.no_assembly,
        fields=True,
    ),
    Analysis("bearings", loads.bearing_loads, "loads and lives of the bearings", missing=loads.no_loads),
)

HEADLINE = (
    "pressure_angle.maximum",
    "profile.min_convex_radius",
    "play.forward.maximum",
    "play.backward.maximum",
    "stiffness.mean",
    "stiffness.minimum",
    "pins.max_force",
    "pins.max_pressure",
    "shared.max_force",
    "shared.max_pressure",
    "drive.peak_torque",
    "motor.peak_torque",
    "contacts.minimum",
    "contacts.maximum",
    "profile.area",
    "profile.perimeter",
    "profile.m*_radius",
    "stiffness.minimum.at",
    "stiffness.range",
    "stiffness.undefined_fraction",
    "assembly.stiffness.mean",
    "assembly.stiffness.minimum",
    "assembly.stiffness.ratio",
    "drive.rms_torque",
    "motor.rms_torque",
    "dwell.pins.max_force",
    "dwell.pins.max_pressure",
    "crank.max_load",
    "support.max_load",
)

SOURCES = (
    "Liu Mingtao, Zhai Fengxiao, Li Yanqi, Guo Zhiquan: Factors influencing the torsional stiffness of inner parallel indexing cam "
    "mechanism, 2017, doi:10.13364/j.issn.1672-6510.20160015 (read; equations corrected)",
    "Palmgren's line contact and bearing approaches, ISO 281 (recalled, verified by closed forms)",
)

mechanism = Mechanism(
    kind="indexer",
    summary="indexing drive with pins or rollers",
    spec=IndexerSpec,
    build=build,
    claims=claims,
    analyses=ANALYSES,
    folder=Path(__file__).parent,
    adjustable={
        "pin_circle_radius": 1.5,
        "pin_radius": 1.5,
        "pin_length": 2.0,
        "eccentricity": 2.0,
        "cam_width": 3.0,
        "cam_length": 1.5,
        "centre_distance": 1.5,
        "shaft_spacing": 2.0,
        "contact.interference": 5.0,
        "shafts.diameters.*": 2.0,
        "motor.ratio": 5.0,
        "motor.rated_torque": 5.0,
    },
    main_plots=("motion/wheel", "pressure_angle", "play", "stiffness", "pin_forces"),
    headline=HEADLINE,
    sources=SOURCES,
    scene=scene,
    dimensions=SHEETS,
    plots=plots,
    drawings=drawings,
    parts=parts,
    verify=oracle("indexer"),
    batch=batch,
    commands=(torsion.command,),
)
