"""The kind `geneva`: an external Geneva drive."""

from pathlib import Path

from drivewright.mechanisms.geneva import bearing, entry, geometry, loads, motion
from drivewright.mechanisms.geneva.build import build
from drivewright.mechanisms.geneva.claims import claims
from drivewright.mechanisms.geneva.dimensions import SHEETS
from drivewright.mechanisms.geneva.scene import drawings, parts, plots, scene
from drivewright.mechanisms.geneva.spec import GenevaSpec
from drivewright.registry import Analysis, Mechanism, oracle

ANALYSES = (
    Analysis("motion", motion.motion, "step of the wheel and its derivatives, dwell"),
    Analysis("geometry", geometry.geometry, "slots, walls, locking disc, mass"),
    Analysis("entry", entry.pin_entry, "entry shock and crossing of the slot by clearance"),
    Analysis("forces", loads.forces, "pin force and Hertz pressure, sliding, torque and power"),
    Analysis("bearing", bearing.bearing, "load and life of the bearing of the wheel", missing=bearing.no_bearing),
    Analysis("energy", loads.energy, "energy audit over the turn", default=False, missing=loads.no_audit),
)

mechanism = Mechanism(
    kind="geneva",
    summary="external Geneva drive",
    spec=GenevaSpec,
    build=build,
    claims=claims,
    analyses=ANALYSES,
    folder=Path(__file__).parent,
    scene=scene,
    moving_presets=True,
    dimensions=SHEETS,
    plots=plots,
    drawings=drawings,
    parts=parts,
    verify=oracle("geneva"),
    sources=(
        "Bickford, Mechanisms for Intermittent Motion, 1972 (recalled; verified by closed forms)",
        "Norton, Design of Machinery (recalled; verified by closed forms)",
    ),
    adjustable={
        "centre_distance": 2.0,
        "crank_radius": 2.0,
        "pin.radius": 2.0,
        "wheel.thickness": 3.0,
        "wheel.bore": 2.0,
        "wheel.hub_diameter": 2.0,
        "wheel.slot_clearance": 10.0,
        "locking.clearance": 10.0,
        "locking.bore": 2.0,
    },
    main_plots=("motion/wheel", "motion/wheel_speed", "motion/wheel_acceleration", "pressure", "torque/crank_torque"),
    headline=(
        "motion_angle",
        "dwell_angle",
        "motion_to_dwell",
        "max_speed",
        "max_acceleration",
        "max_force.*",
        "max_pressure.*",
        "crank.peak_torque",
        "crank.rms_torque",
        "crank.peak_power",
        "entry.path_angle",
        "entry.speed_jump",
        "crossing.speed",
        "slot.length",
        "slot.wall",
        "slot.mouth_wall",
        "locking.clearance",
        "dwell_play",
        "wheel.inertia",
        "bearing.basic_life.time",
    ),
)
