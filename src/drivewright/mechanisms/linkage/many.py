"""A linkage under many values of its keys: bifurcation diagram, table of impact load coefficients."""

from dataclasses import replace

import numpy as np

from drivewright import cases
from drivewright.errors import SolverError
from drivewright.mechanisms.linkage.build import build, take_ideal_record
from drivewright.mechanisms.linkage.ensemble import Statistics, member_run, repeats
from drivewright.mechanisms.linkage.member import Member, acceleration, add_load, ends_of_turns, starting
from drivewright.mechanisms.linkage.nonlinear import output_named, section, units_of
from drivewright.mechanisms.linkage.refusals import refuse_nonsense
from drivewright.multibody.measures import largest
from drivewright.multibody.record import record
from drivewright.result import Answer, Column, Table
from drivewright.spec import dimension_at
from drivewright.units import SI


def varied(spec, changes):
    """The spec with keys {dotted key: SI value} changed; the changed tables and the whole are checked as on reading."""
    for key, value in changes.items():
        spec = _changed(spec, key.split("."), SI(value) if dimension_at(type(spec), key)[1] else value)
    refuse_nonsense(spec)
    return spec


def _changed(node, path, value):
    """A copy of a table, a list of named tables or a table of tables with the value at the path changed."""
    step, *rest = path
    if isinstance(node, tuple):
        return tuple(_changed(one, rest, value) if step in (getattr(one, "name", None), str(n)) else one for n, one in enumerate(node))
    if isinstance(node, dict):
        return type(node)({**node, step: _changed(node[step], rest, value)})
    return node.model_copy(update={step: _changed(getattr(node, step), rest, value)}) if rest else node.replace(**{step: value})


def bifurcation(model, done):
    """Points of the Poincare section over a key of the spec."""
    asked = model.spec.bifurcation
    output, dimension = output_named(model.spec, asked.output), dimension_at(type(model.spec), asked.over)[1]
    start, stop = (dimension.parse(bound) if dimension else float(bound) for bound in (asked.start, asked.stop))
    rows = cases.run(lambda value: _visits(model.spec, asked, output, value), np.linspace(start, stop, asked.steps).tolist(), workers=None)
    found = [(row.case, *row.value) for row in rows.rows if row.ok]
    failed = tuple(f"bifurcation: {asked.over} = {row.case:.6g} is left out: {row.reason}" for row in rows.failed)
    where, rate = units_of(output)
    words = f"of {output.name!r} at crank angle zero"
    columns = [np.concatenate([np.empty(0), *parts]) for parts in zip(*((np.full(len(p), v), p, r) for v, p, r in found), strict=True)]
    columns = columns or [np.empty(0)] * 3
    table = Table(
        "bifurcation",
        f"Bifurcation over {asked.over}",
        (
            Column("parameter", dimension.unit if dimension else "-", asked.over, columns[0]),
            Column("position", where, f"position {words}", columns[1]),
            Column("velocity", rate, f"velocity {words}", columns[2]),
        ),
    )
    return Answer(tables=(table,), findings=failed, outcome="partial" if rows.interrupted else "complete")


def _visits(spec, asked, output, value):
    """(positions, velocities) of the Poincare section of one run, the first turns discarded."""
    model = build(varied(spec, {asked.over: value}))
    settings = replace(model.settings, per_step=1)
    t, position, velocity, run = section(model, output, asked.turns * model.period, settings)
    if run.advice:
        raise SolverError(run.advice)
    kept = t >= asked.discard * model.period * (1 - 1e-9)
    return position[kept], velocity[kept]


def load_table(model, done):
    """Impact load coefficient and its companions over speeds and clearances."""
    asked, spec = model.spec.table, model.spec
    output = output_named(spec, asked.output)
    played = [joint.name for joint in spec.joints if joint.pin not in (None, "ideal", "bushing")]
    points = [(speed, clearance) for speed in asked.speeds for clearance in asked.clearances]

    def task(point):
        changes = {"drive.speed": point[0]} | {f"joints.{name}.clearance": point[1] for name in played}
        return loads_of(build(varied(spec, changes)), output, ideal[point[0]])

    ideal = {speed: ideal_peak(build(varied(spec, {"drive.speed": speed})), output) for speed in asked.speeds}
    rows = cases.run(task, points, workers=None)
    good = [row for row in rows.rows if row.ok]
    failed = tuple(f"table: {row.case[0]:.6g} rad/s, {1e3 * row.case[1]:.4g} mm is left out: {row.reason}" for row in rows.failed)
    speed, clearance = (np.array([row.case[k] for row in good]) for k in (0, 1))
    loads = [_load_columns(name, words, output, [row.value for row in good]) for name, words in LOAD_WORDS.items()]
    columns = (
        Column("speed", "rad/s", "speed of the drive", speed),
        Column("clearance", "m", "radial clearance of every joint with play", clearance),
        *sum(loads, ()),
        Column(
            "ideal_peak", acceleration_unit(output), "largest acceleration without play", np.array([ideal[row.case[0]] for row in good])
        ),
    )
    return Answer(
        tables=(Table("load_table", f"Impact load of {output.name!r}", columns),),
        findings=failed,
        outcome="partial" if rows.interrupted else "complete",
    )


def _load_columns(name, words, output, found):
    """A number of the impact load with its interval, of the `Statistics` of every case."""
    of_cases = [each.of_run(f"{output.name}.{name}", f"{output.name}.peak") for each in found]
    value, low, high = np.array([(each.value, each.low, each.high) for each in of_cases]).reshape(-1, 3).T
    column = Column(name, "-", words, value)
    return column, *column.bounds(low, high)


LOAD_WORDS = {
    "coefficient": "impact load coefficient",
    "largest": "largest peak over the ideal one",
    "percentile": "95th percentile over it",
    "rms": "root mean square over it",
    "turn_mean": "mean largest peak of a turn over it",
    "turn_spread": "standard deviation of it",
}  # by the fields of an ImpactLoad


def acceleration_unit(output):
    return "rad/s^2" if output.point is None else "m/s^2"


def ideal_peak(model, output):
    """Largest acceleration of an output without play."""
    seen = take_ideal_record(model)
    return largest(seen.t, acceleration(seen, output)[0])


def loads_of(model, output, peak):
    """`Statistics` of the impact load of one output: of a run, and unless that repeats itself, of the others of the ensemble."""
    first, seen = _load(model, 0, output, peak)
    period = repeats(model, seen)
    others = () if period or not first.counted else [_load(model, number, output, peak)[0] for number in range(1, model.ensemble)]
    return Statistics((first, *others), period)


def load_of(model, output, peak=None):
    """(*ImpactLoad, ideal peak) of one output in one run of a model, whose ideal peak may be known already."""
    peak = ideal_peak(model, output) if peak is None else peak
    found = _load(model, 0, output, peak)[0]
    return (*(found.whole[f"{output.name}.{name}"] for name in LOAD_WORDS), peak)


def _load(model, number, output, peak):
    """(`Member` that holds the impact load of an output alone, record of the window) of one run of the ensemble."""
    run, found = member_run(model, number, per_step=1), Member()
    start = starting(model, run.end[1])
    seen = record(run, model.markers, start)
    add_load(seen, output, ends_of_turns(model, start, seen.t[-1]), found, peak)
    return found, seen
