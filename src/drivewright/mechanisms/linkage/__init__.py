"""The kind `linkage`: planar linkages with ideal joints or joints with play."""

from pathlib import Path

from drivewright.mechanisms.linkage import analyse, energy, forces, many, nonlinear, rest, singular, tolerance, wear
from drivewright.mechanisms.linkage.build import build
from drivewright.mechanisms.linkage.claims import claims
from drivewright.mechanisms.linkage.plates import drawings, parts
from drivewright.mechanisms.linkage.plots import plots
from drivewright.mechanisms.linkage.scene import scene
from drivewright.mechanisms.linkage.spec import LinkageSpec
from drivewright.registry import Analysis, Mechanism, oracle


def _asked(table, also=None):
    return lambda spec: nonlinear.no_period(spec, table) or (also(spec) if also else None)


def _no_turns(spec):
    return analyse.no_outputs(spec) or (None if spec.period and spec.simulate else "there are no turns of a drive at constant speed")


ANALYSES = (
    Analysis("impact", analyse.impact, "impact load coefficient of every output", missing=analyse.no_play),
    Analysis("motion", analyse.motion, "outputs over the run", missing=analyse.no_run),
    Analysis("pins", analyse.pins, "forces, impacts and orbits of pins with play", missing=analyse.no_pins),
    Analysis("forces", forces.forces, "forces in all joints", missing=analyse.no_run),
    Analysis("energy", energy.energy, "energy audit and drive torque", missing=analyse.no_run),
    Analysis("singular", singular.singular, "singular positions passed", missing=analyse.no_run),
    Analysis("spectrum", nonlinear.spectrum, "accelerations in orders of the drive", missing=_no_turns),
    Analysis("poincare", nonlinear.poincare, "Poincare section", missing=_asked("poincare")),
    Analysis("lyapunov", nonlinear.lyapunov, "largest Lyapunov exponent", missing=_asked("lyapunov")),
    Analysis("end", analyse.end, "bodies at the end of the run", missing=analyse.no_run),
    Analysis("oil", rest.oil, "closed form of each oil film beside Reynolds' equation", missing=rest.no_oil),
    Analysis("rest", rest.rest, "equilibrium, holding torques, natural frequencies", default=False),
    Analysis("bifurcation", many.bifurcation, "bifurcation diagram", default=False, missing=_asked("bifurcation")),
    Analysis(
        "load_table", many.load_table, "impact load over speed and clearance", default=False, missing=_asked("table", analyse.no_play)
    ),
    Analysis("tolerances", tolerance.tolerances, "outputs under clearances and random dimensions", missing=tolerance.no_tolerances),
    Analysis("wear", wear.wear, "wear of a bearing, fed back into its contact", default=False, missing=wear.no_wear),
)

HEADLINE = (
    "output.max_acceleration",
    "*.impact_load_coefficient",
    "*.peak_acceleration_ratio",
    "*.max_acceleration",
    "*.max_angular_acceleration",
    "joints.*.max_force",
    "joints.*.impacts_per_turn",
    "joints.*.max_penetration",
    "drive.max_torque",
    "lyapunov_exponent.per_turn",
    "tolerances.*.sigma",
    "wear.*.max_depth",
    "modes.*.frequency",
    "*.swing",
    "output.swing",
)

SOURCES = (
    "Yuan Yingcai, Liu Yilun, Wang Yiming: Nonlinear dynamic response of offset press' fold mechanism with clearances. Journal of Central "
    "South University (Science and Technology) 42(4), 2011, 972 ff. (in Chinese).",
    "Flores, Machado, Silva, Martins 2011; Lankarani, Nikravesh 1990; Hunt, Crossley 1975: impact laws (recalled, verified by closed form)",
)

mechanism = Mechanism(
    kind="linkage",
    summary="planar linkage with ideal joints or joints with play",
    spec=LinkageSpec,
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
    verify=oracle("linkage"),
)
