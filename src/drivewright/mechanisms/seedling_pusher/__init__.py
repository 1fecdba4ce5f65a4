"""Rice transplanter's planting arm: three-elliptic-gear planetary train and conjugate-cam seedling pusher."""

from pathlib import Path

from drivewright.mechanisms.seedling_pusher import analyses, dynamics, manufacture, planting, scene
from drivewright.mechanisms.seedling_pusher.build import build
from drivewright.mechanisms.seedling_pusher.claims import claims
from drivewright.mechanisms.seedling_pusher.designs import batch
from drivewright.mechanisms.seedling_pusher.diagram import diagram
from drivewright.mechanisms.seedling_pusher.dimensions import SHEETS
from drivewright.mechanisms.seedling_pusher.spec import SeedlingPusherSpec
from drivewright.registry import Analysis, Mechanism, oracle
from drivewright.result import Plot

ANALYSES = (
    Analysis("train", planting.train, "elliptic gear train, track of the tip, rotation of the arm"),
    Analysis("planting", planting.planting, "needle angles and requirements of planting"),
    Analysis("cams", analyses.cams, "pressure angle, curvature, finished profile and lost motion of both cams"),
    Analysis("load", analyses.load, "rod dynamics, normal forces, Hertz pressure, torque"),
    Analysis("contact", dynamics.contact, "contact dynamics of the lever with clearance: forces, separation, rod error"),
    Analysis("teeth", manufacture.teeth, "teeth of the elliptic gears", default=False, manufacture=True),
    Analysis("inspection", manufacture.inspection, "polar coordinates of both profiles with tolerance", default=False, manufacture=True),
    Analysis("poincare", dynamics.poincare, "Poincaré section of the rod error in the contact simulation", default=False),
    Analysis("clearance", dynamics.clearance_study, "peak force and rod error over clearance and speed", default=False),
)

PLOTS = (
    Plot("rod", "Rod motion over one carrier turn", "cycle", "carrier_angle", ("rod", "rod_velocity", "rod_acceleration")),
    Plot("planet", "Rotation of planet and planting arm", "cycle", "carrier_angle", ("planet_angle", "arm_rotation")),
    Plot("ratio", "Speed ratio of planet to carrier", "cycle", "carrier_angle", ("planet_ratio",)),
    Plot("needle", "Needle angle below the horizontal", "cycle", "carrier_angle", ("needle_angle",)),
    Plot(
        "pressure_angle",
        "Pressure angle of both cams",
        "cams",
        "carrier_angle",
        ("main.pressure_angle", "return.pressure_angle"),
        (("pressure_angle.main", "allowed"), ("-pressure_angle.main", "allowed")),
    ),
    Plot(
        "convexity",
        "Roller over convex radius of both cams",
        "cams",
        "carrier_angle",
        ("main.convex_ratio", "return.convex_ratio"),
        (("undercut.main", "undercut"),),
    ),
    Plot("force", "Normal force, quasi-static", "load", "carrier_angle", ("main.force", "return.force")),
    Plot("hertz", "Hertz pressure, quasi-static", "load", "carrier_angle", ("main.pressure", "return.pressure")),
    Plot("contact_force", "Contact force, dynamic, last turn", "contact", "carrier_angle", ("main.force", "return.force")),
    Plot("rod_error", "Rod error, last turn", "contact", "carrier_angle", ("rod_error",)),
    Plot("play_force", "Maximum normal force over clearance", "play", "clearance", ("peak_force",)),
    Plot("track", "Track of the needle tip, machine frame", "cycle", "tip_x", ("tip_y",), equal=True),
    Plot("axis_track", "Track of the planet axis, machine frame", "cycle", "axis_x", ("axis_y",), equal=True),
    Plot("rod_track", "Track of the rod end, machine frame", "cycle", "rod_end_x", ("rod_end_y",), equal=True),
    Plot("field_track", "Track of the needle tip over the field", "cycle", "field_x", ("tip_y",), equal=True),
)


mechanism = Mechanism(
    kind="seedling-pusher",
    summary="seedling pusher: conjugate cams on a three-elliptic-gear planetary train",
    spec=SeedlingPusherSpec,
    build=build,
    claims=claims,
    analyses=ANALYSES,
    folder=Path(__file__).parent,
    scene=scene.scene,
    programme=diagram,
    dimensions=SHEETS,
    plots=PLOTS,
    drawings=scene.drawings,
    parts=scene.parts,
    verify=oracle("seedling_pusher"),
    batch=batch,
    sources=(
        "Chen Jianneng, Wang Ying, Zhao Xiong, Zhao Yun: Reverse design and simulation of walking-type rice transplanter's "
        "seedling-pushing device based on conjugate cam. Transactions of the CSAM 42(12), 2011, 78-82 (in Chinese).",
    ),
    adjustable={
        "train.axis_ratio": 1.02,
        "train.bend": 1.3,
        "train.carrier_angle": 3.0,
        "arm.*": 1.3,
        "push.rise": 1.5,
        "push.retraction": 2.0,
        "lever.*": 1.3,
        "cams.*": 1.5,
    },
    main_plots=("rod/rod", "contact_force", "pressure_angle", "convexity", "needle"),
    headline=(
        "tip.track_height",
        "tip.track_width",
        "needle.take_angle",
        "needle.push_angle",
        "needle.angle_difference",
        "cam.main.max_pressure_angle.rise",
        "cam.return.max_pressure_angle.return",
        "cam.main.min_convex_radius",
        "cam.return.min_convex_radius",
        "cam.return.lost_motion",
        "lever.swing",
        "contact.peak_force",
        "contact.rod_error.max",
    ),
)
