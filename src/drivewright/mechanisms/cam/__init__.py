"""The kind `cam`: a disc cam with a translating or oscillating follower."""

from pathlib import Path

from drivewright.mechanisms.cam import film, geometry, loads, profiles, surge
from drivewright.mechanisms.cam.batch import batch
from drivewright.mechanisms.cam.build import build
from drivewright.mechanisms.cam.claims import claims
from drivewright.mechanisms.cam.diagram import diagram
from drivewright.mechanisms.cam.dimensions import SHEETS
from drivewright.mechanisms.cam.energy import energy
from drivewright.mechanisms.cam.scene import PLOTS, drawings, parts, scene
from drivewright.mechanisms.cam.spec import CamSpec
from drivewright.mechanisms.cam.varying import free_rest
from drivewright.registry import Analysis, Mechanism, oracle

ANALYSES = (
    Analysis("motion", geometry.motion, "motion programme and its derivatives"),
    Analysis("geometry", geometry.geometry, "pressure angle, curvature and closure"),
    Analysis("profile", profiles.finished_profiles, "finished profile: undercut, walls, inspection"),
    Analysis("forces", loads.forces, "contact force and pressure, torque, sliding", missing=loads.no_forces),
    Analysis("spring", loads.spring, "required spring preload and stiffness, jump speed", missing=loads.no_spring),
    Analysis("surge", surge.surge, "surge of the spring and its force", missing=surge.no_surge),
    Analysis("film", film.film, "oil film between cam and follower", missing=film.no_film),
    Analysis("vibration", loads.vibration, "steady vibration of the follower", missing=loads.no_vibration),
    Analysis("energy", energy, "energy audit over the turn", default=False, missing=loads.no_forces),
)


mechanism = Mechanism(
    kind="cam",
    summary="disc cam with a translating or oscillating follower",
    spec=CamSpec,
    build=build,
    batch=batch,
    claims=claims,
    analyses=ANALYSES,
    folder=Path(__file__).parent,
    scene=scene,
    programme=diagram,
    before_varying=free_rest,
    dimensions=SHEETS,
    plots=PLOTS,
    drawings=drawings,
    parts=parts,
    verify=oracle("cam"),
    sources=(
        "Norton, Cam Design and Manufacturing Handbook (recalled; verified by closed forms)",
        "Rothbart, Cam Design Handbook (recalled; verified by closed forms)",
    ),
    adjustable={
        "follower.prime_radius": 2.0,
        "follower.base_radius": 2.0,
        "follower.roller_radius": 2.0,
        "follower.half_face": 2.0,
        "follower.pivot_distance": 1.5,
        "conjugate.prime_radius": 2.0,
        "groove.clearance": 10.0,
        "spring.stiffness": 4.0,
        "spring.preload": 4.0,
        "face.width": 3.0,
        "manufacture.hub_diameter": 1.5,
        "manufacture.cutter_diameter": 10.0,
    },
    main_plots=("motion/lift", "kinematics/velocity", "kinematics/acceleration", "pressure_angle", "curvature"),
    headline=(
        "lift",
        "valve.lift",
        "max_pressure_angle",
        "min_pressure_angle",
        "min_convex_radius",
        "min_base_radius",
        "min_half_face",
        "lost_motion",
        "yoke.breadth",
        "max_contact_force",
        "max_contact_pressure",
        "max_torque",
        "spring.jump_speed",
        "surge.max_force",
        "film.at_peak_pressure",
        "vibration.residual",
    ),
)
