"""The kind `linkage`: planar linkages with ideal joints or joints with clearance."""

from pathlib import Path

from drivewright.mechanisms.linkage.analyses import ANALYSES
from drivewright.mechanisms.linkage.batch import batch
from drivewright.mechanisms.linkage.build import build, compile_ahead
from drivewright.mechanisms.linkage.claims import claims
from drivewright.mechanisms.linkage.construction import CONSTRUCTION
from drivewright.mechanisms.linkage.dimensions import SHEETS
from drivewright.mechanisms.linkage.plates import drawings, parts
from drivewright.mechanisms.linkage.scene import quick_scene, scene
from drivewright.mechanisms.linkage.spec import LinkageSpec
from drivewright.multibody.analyses.plots import simulation_plots
from drivewright.registry import Mechanism, oracle
from drivewright.result import Plot, Result

HEADLINE = (
    "output.max_acceleration",
    "output.travel_x",
    "output.travel_y",
    "efficiency",
    "drives.*.peak_torque",
    "drives.*.peak_force",
    "*.displacement",
    "*.impact_load_coefficient",
    "*.peak_acceleration_ratio",
    "*.max_acceleration",
    "*.max_angular_acceleration",
    "joints.*.max_force",
    "joints.*.impacts_per_turn",
    "joints.*.max_penetration",
    "lyapunov_exponent.per_turn",
    "tolerances.*.sigma",
    "wear.*.max_depth",
    "modes.*.frequency",
    "*.swing",
    "output.swing",
    "*.travel_x",
    "*.travel_y",
)

SOURCES = (
    "Yuan Yingcai, Liu Yilun, Wang Yiming: Nonlinear dynamic response of offset press' fold mechanism with clearances. Journal of Central "
    "South University (Science and Technology) 42(4), 2011, 972 ff. (in Chinese).",
    "Flores, Machado, Silva, Martins 2011; Lankarani, Nikravesh 1990; Hunt, Crossley 1975: impact laws (recalled, verified by closed form)",
)


def plots(result: Result[LinkageSpec]) -> tuple[Plot, ...]:
    """The plots of a result: its tables are named after the outputs and joints of the spec."""
    outputs = {output.name: output.point is not None for output in result.spec.outputs}
    clearances = {joint.name: joint.clearance for joint in result.spec.joints}
    return simulation_plots(result.tables, outputs, clearances, any(joint.has_play for joint in result.spec.joints))


mechanism = Mechanism(
    kind="linkage",
    summary="planar linkage with ideal joints or joints with clearance",
    spec=LinkageSpec,
    build=build,
    compile_ahead=compile_ahead,
    claims=claims,
    analyses=ANALYSES,
    folder=Path(__file__).parent,
    adjustable={
        "ground.points.*": 1.5,
        "bodies.*.points.*": 1.5,
        "joints.*.clearance": 5.0,
        "joints.*.bearing_radius": 3.0,
        "springs.*.stiffness": 4.0,
    },
    main_plots=("motion.*", "drive", "forces"),
    headline=HEADLINE,
    sources=SOURCES,
    scene=scene,
    moving_presets=True,
    quick_scene=quick_scene,
    dimensions=SHEETS,
    plots=plots,
    drawings=drawings,
    parts=parts,
    verify=oracle("linkage"),
    batch=batch,
    construction=CONSTRUCTION,
)
