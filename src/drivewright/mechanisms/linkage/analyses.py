"""The analyses of a linkage, and the keys of the spec that they need."""

import math
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from drivewright._typing import Floats
from drivewright.mechanisms.linkage.advice import advice
from drivewright.mechanisms.linkage.build import LinkageModel, build
from drivewright.mechanisms.linkage.describe import driven_joint, joint_friction
from drivewright.mechanisms.linkage.joints import Joint
from drivewright.mechanisms.linkage.spec import LinkageSpec
from drivewright.mechanisms.linkage.tables import Deviation, place
from drivewright.multibody.analyses.bifurcation import bifurcation
from drivewright.multibody.analyses.energy import energy
from drivewright.multibody.analyses.friction import friction
from drivewright.multibody.analyses.impact_load import ideal_acceleration_peak, load_table
from drivewright.multibody.analyses.joint_forces import joint_forces
from drivewright.multibody.analyses.lyapunov import lyapunov
from drivewright.multibody.analyses.motors import motors
from drivewright.multibody.analyses.oil_films import oil_films
from drivewright.multibody.analyses.outputs import end, impact, motion
from drivewright.multibody.analyses.pins import pins
from drivewright.multibody.analyses.poincare import poincare, units_of, visited_points
from drivewright.multibody.analyses.rest import rest
from drivewright.multibody.analyses.simulation_model import run_of
from drivewright.multibody.analyses.singular_positions import singular_positions
from drivewright.multibody.analyses.spectrum import spectrum
from drivewright.multibody.analyses.tolerances import tolerances
from drivewright.multibody.analyses.wear import WearingBearing, wear
from drivewright.multibody.tolerance import Source, play
from drivewright.registry import Analysis
from drivewright.result import Answer, Answers
from drivewright.spec import dimension_at
from drivewright.units import SI

# -- what is missing ---------------------------------------------------------------------------------------------------------------


def no_run(spec: LinkageSpec) -> str | None:
    """Why there is nothing to simulate."""
    if spec.simulate is None and spec.period is None:
        return "the spec has neither a [simulate] table nor a drive at constant speed"
    return None


def _no_outputs(spec: LinkageSpec) -> str | None:
    return no_run(spec) or (None if spec.outputs else "the spec has no [[outputs]]")


def _no_play(spec: LinkageSpec) -> str | None:
    if _no_outputs(spec):
        return _no_outputs(spec)
    return None if any(joint.has_play for joint in spec.joints) else "no joint has clearance"


def _no_pins(spec: LinkageSpec) -> str | None:
    return no_run(spec) or (None if any(j.has_contact for j in spec.joints) else "no joint is dry or lubricated")


def _no_turns(spec: LinkageSpec) -> str | None:
    return _no_outputs(spec) or (
        None if spec.period and spec.simulate else "the spec has no [simulate] table or no drive at constant speed"
    )


def _no_friction(spec: LinkageSpec) -> str | None:
    return no_run(spec) or (
        None if any(joint_friction(joint) for joint in spec.joints if joint.is_ideal) else "no ideal joint has friction"
    )


def _no_drives(spec: LinkageSpec) -> str | None:
    return no_run(spec) or (None if spec.all_drives else "the spec has no drive")


def _no_oil(spec: LinkageSpec) -> str | None:
    return None if any(joint.pin == "lubricated" for joint in spec.joints) else "no joint is lubricated"


def _no_tolerances(spec: LinkageSpec) -> str | None:
    if spec.tolerances is None:
        return "the spec has no [tolerances] table"
    if not spec.outputs:
        return "the spec has no [[outputs]]"
    if not sources_of(spec):
        return "no joint has a clearance and no dimension has a tolerance"
    drives = list(spec.all_drives.values())
    if not drives or drives[0].motor:
        return "no drive with prescribed motion sets the position of the mechanism"
    if len(drives) > 1:
        return "several drives set the position of the mechanism, but tolerances.angle is a single angle"
    return None if driven_joint(spec, drives[0]).kind == "revolute" else f"the driven joint {drives[0].joint!r} slides and has no angle"


def _no_wear(spec: LinkageSpec) -> str | None:
    if spec.wear is None:
        return "the spec has no [wear] table"
    joint = _wearing_joint(spec)
    if joint.pin != "dry":
        return f'joint {joint.name!r} is {joint.pin or joint.kind}; wear requires model = "dry" and a clearance'
    return no_run(spec) or (f"joint {joint.name!r} has no wear_coefficient" if joint.wear_coefficient is None else None)


def _no_table(table: str, also: Callable[[LinkageSpec], str | None] = lambda spec: None) -> Callable[[LinkageSpec], str | None]:
    """Why there are no turns for the analysis that a table requests."""

    def missing(spec: LinkageSpec) -> str | None:
        if getattr(spec, table) is None:
            return f"the spec has no [{table}] table"
        return also(spec) if spec.period else "no drive has a constant speed, so turns are not defined"

    return missing


# -- analyses that take more than the model --------------------------------------------------------------------------------------


def _motion(model: LinkageModel, done: Answers) -> Answer:
    answer = motion(model)
    return replace(answer, checks=advice(model.spec, run_of(model).end[1]))


def _poincare(model: LinkageModel, done: Answers) -> Answer:
    assert model.spec.poincare is not None
    return poincare(model, model.output(model.spec.poincare.output))


def _lyapunov(model: LinkageModel, done: Answers) -> Answer:
    assert model.spec.lyapunov is not None
    return lyapunov(model, model.spec.lyapunov.turns, model.spec.lyapunov.discard)


def _bifurcation(model: LinkageModel, done: Answers) -> Answer:
    table, spec = model.spec.bifurcation, model.spec
    assert table is not None
    output, dimension = model.output(table.output), dimension_at(type(spec), table.over)[1]
    start, stop = (dimension.parse(bound) if dimension else float(bound) for bound in (table.start, table.stop))
    values, unit = np.linspace(start, stop, table.steps), dimension.unit if dimension else "-"

    def visits(value: float) -> tuple[Floats, Floats]:
        return visited_points(build(spec.replace({table.over: SI(value)})), table.output, table.turns, table.discard)

    return bifurcation(output.name, table.over, unit, units_of(output), values, visits)


def _load_table(model: LinkageModel, done: Answers) -> Answer:
    table, spec = model.spec.table, model.spec
    assert table is not None
    output = model.output(table.output)
    with_play = [joint.name for joint in spec.joints if joint.pin not in (None, "ideal", "bushing")]
    speed_key = f"{spec.turning_drive}.speed"
    points = [(speed, clearance) for speed in table.speeds for clearance in table.clearances]

    def model_at(point: tuple[float, float]) -> LinkageModel:
        return build(spec.replace({speed_key: SI(point[0])} | {f"joints.{name}.clearance": SI(point[1]) for name in with_play}))

    ideal = {speed: ideal_acceleration_peak(build(spec.replace({speed_key: SI(speed)})), output) for speed in table.speeds}
    return load_table(output, points, model_at, ideal)


def _tolerances(model: LinkageModel, done: Answers) -> Answer:
    assert model.spec.tolerances is not None
    return tolerances(model, sources_of(model.spec), model.spec.tolerances.angle, model.spec.tolerances.samples)


def sources_of(spec: LinkageSpec) -> list[Source]:
    """All that is random: the play of every pin that states a clearance, whatever its model, and the tolerances of points."""
    plays = [
        play(joint.name, joint.clearance)
        for joint in spec.joints
        if joint.kind == "revolute" and joint.model != "bushing" and joint.clearance
    ]
    dimensions = spec.tolerances.dimensions if spec.tolerances else ()
    return plays + [_deviation(spec, item) for item in dimensions if item.tolerance > 0]


def _deviation(spec: LinkageSpec, item: Deviation) -> Source:
    length = math.hypot(*item.axis)
    marks = tuple(output.name for output in spec.outputs if output.point and f"{output.body}.{output.point}" == item.at)
    direction = (item.axis[0] / length, item.axis[1] / length)
    return Source(item.at, item.tolerance, item.distribution, tuple(_ends_at(spec, item.at)), direction, marks)


def _ends_at(spec: LinkageSpec, text: str) -> Iterator[tuple[str, int]]:
    """(joint, end) of all joints that hold on to a point."""
    for joint in spec.joints:
        ends = (joint.connects[1], joint.carrier) if joint.kind == "cam" else joint.connects
        for number, at in enumerate(ends):
            if at == text:
                yield joint.name, number


def _wear(model: LinkageModel, done: Answers) -> Answer:
    return wear(model, wearing_bearing(model.spec))


def wearing_bearing(spec: LinkageSpec) -> WearingBearing:
    """The bearing that wears, of a spec with an analysis of wear."""
    table, joint = spec.wear, _wearing_joint(spec)
    assert table is not None and joint.clearance is not None and joint.wear_coefficient is not None
    return WearingBearing(
        joint.name,
        place(joint.connects[0])[0],
        joint.bearing_radius,
        joint.length,
        joint.clearance,
        joint.wear_coefficient,
        table.cycles,
        table.jumps,
        table.bins,
    )


def _wearing_joint(spec: LinkageSpec) -> Joint:
    return next(joint for joint in spec.joints if spec.wear and joint.name == spec.wear.joint)


def _of_model(answer: Callable[[LinkageModel], Answer]) -> Callable[[LinkageModel, Answers], Answer]:
    return lambda model, done: answer(model)


ANALYSES: tuple[Analysis[LinkageSpec, LinkageModel], ...] = (
    Analysis("impact", _of_model(impact), "impact load coefficient of every output", missing=_no_play),
    Analysis("motion", _motion, "motion of the outputs", missing=no_run),
    Analysis("pins", _of_model(pins), "forces, impacts and orbits of pins with clearance", missing=_no_pins),
    Analysis("forces", _of_model(joint_forces), "forces in all joints", missing=no_run),
    Analysis("energy", _of_model(energy), "energy audit and drive torque", missing=no_run),
    Analysis("friction", _of_model(friction), "friction in ideal joints and efficiency", missing=_no_friction),
    Analysis("motors", _of_model(motors), "motor sizing: torque, power, reflected inertia", missing=_no_drives),
    Analysis("singular", _of_model(singular_positions), "singular positions passed", missing=no_run),
    Analysis("spectrum", _of_model(spectrum), "acceleration spectra by orders of the drive", missing=_no_turns),
    Analysis("poincare", _poincare, "Poincaré section", missing=_no_table("poincare")),
    Analysis("lyapunov", _lyapunov, "largest Lyapunov exponent", missing=_no_table("lyapunov")),
    Analysis("end", _of_model(end), "final positions and velocities of the bodies", missing=no_run),
    Analysis("oil", _of_model(oil_films), "oil film models compared with Reynolds' equation", missing=_no_oil),
    Analysis("rest", _of_model(rest), "equilibrium, holding torques, natural frequencies", default=False),
    Analysis("bifurcation", _bifurcation, "bifurcation diagram", default=False, missing=_no_table("bifurcation")),
    Analysis("load_table", _load_table, "impact load over speed and clearance", default=False, missing=_no_table("table", _no_play)),
    Analysis("tolerances", _tolerances, "output deviations from clearances and tolerances", missing=_no_tolerances),
    Analysis("wear", _wear, "wear of a bearing with feedback to its contact", default=False, missing=_no_wear),
)
