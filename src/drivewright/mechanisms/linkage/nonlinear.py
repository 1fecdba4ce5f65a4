"""Nonlinear motion: Poincare section, bifurcation diagram, Lyapunov exponent, spectrum in orders, table of impact load coefficients."""

from dataclasses import replace

import numpy as np

from drivewright import cases
from drivewright.errors import SolverError, UnknownName
from drivewright.mechanisms.linkage.analyse import acceleration
from drivewright.mechanisms.linkage.build import TURN, build, ideal_record, record_of, take_ideal_record
from drivewright.mechanisms.linkage.describe import output_marker
from drivewright.mechanisms.linkage.ensemble import settled_check, shifted
from drivewright.mechanisms.linkage.refusals import refuse_nonsense
from drivewright.multibody.measures import impact_load, largest
from drivewright.multibody.record import record
from drivewright.multibody.simulate import Settings, restated, simulate, tolerances
from drivewright.numerics.chaos import largest_exponent, orbit_period
from drivewright.numerics.ensemble import estimate
from drivewright.numerics.signals import order_spectrum, spectrogram
from drivewright.result import Answer, Column, Table, Value
from drivewright.spec import dimension_at
from drivewright.units import SI

SAME = 1e-3  # of the cloud's size: visits nearer to each other count as one point of the orbit
STILL = 1e-5  # of the range of the motion: a cloud smaller than this is one point
ORDERS = 60
ABOVE_ERROR = 1000.0  # separation of twins over the relative tolerance: below, the integrator's error would be taken for growth
PAIRS_OF_TWINS = 2  # of the ensemble, for the Lyapunov exponent: every turn of a pair is a sample
PER_OSCILLATION = 20  # samples of the highest order, at least


def no_period(spec, table):
    """Why there are no turns to look at."""
    if getattr(spec, table) is None:
        return f"the spec has no [{table}] table"
    return None if spec.period else "its drive has no constant speed, so that there are no turns"


# -- Poincare section ----------------------------------------------------------------------------------------------------------


def path_axis(spec, output):
    """Direction in which a point's path is told: the axis of a prismatic joint to the ground on its body, else the world's x."""
    for joint in spec.joints:
        first, second = (text.split(".")[0] for text in joint.connects)
        if joint.kind == "prismatic" and first == output.body and second == "ground":
            return np.array(joint.axis) / np.hypot(*joint.axis)
    return np.array([1.0, 0.0])


def zero_times(model, end):
    """Times at which the drive's angle is a whole number of turns, to the end of the last whole turn."""
    driven = model.assembly.system.driven[0]
    phase = -(driven.sign * driven.start) / model.spec.drive.speed % model.period
    phase = 0.0 if model.period - phase < 1e-9 * model.period else phase
    return phase + model.period * np.arange(int(np.floor((end - phase) / model.period + 1e-9)) + 1)


def section(model, output, duration, settings):
    """(times, positions, velocities) of an output once a turn."""
    times = np.minimum(zero_times(model, duration), duration)
    run = simulate(model.assembly, duration, settings, samples=times)
    seen, axis = record(run, {output.name: output_marker(model.spec, output)}), path_axis(model.spec, output)
    if output.point is None:
        return seen.t, seen.point(output.name, "angle"), seen.point(output.name, "w"), run
    along = axis[0] * seen.point(output.name, "x") + axis[1] * seen.point(output.name, "y")
    rate = axis[0] * seen.point(output.name, "vx") + axis[1] * seen.point(output.name, "vy")
    return seen.t, along, rate, run


def output_named(spec, name):
    for output in spec.outputs:
        if output.name == name:
            return output
    raise UnknownName("output", name, [output.name for output in spec.outputs])


def _units(output):
    return ("rad", "rad/s") if output.point is None else ("m", "m/s")


def poincare(model, done):
    """Position and velocity of an output at crank angle zero, once a turn."""
    output = output_named(model.spec, model.spec.poincare.output)
    t, position, velocity, run = section(model, output, model.duration, model.settings)
    kept = t >= model.spec.start_of_window * (1 - 1e-9)
    where, rate = _units(output)
    words = f"of {output.name!r} at crank angle zero"
    values = {"poincare.position": Value(float(position[-1]), where, f"position {words} after the last whole turn"),
              "poincare.velocity": Value(float(velocity[-1]), rate, f"velocity {words} after the last whole turn")}
    points = np.stack([position[kept], velocity[kept]], axis=1)
    if len(points) >= 6:
        period = orbit_period(points / np.maximum(np.ptp(points, axis=0), STILL * _spans(model, output)), SAME)
        values["poincare.period"] = Value(float(period), "-", "turns after which the motion repeats itself; 0: it does not")
    table = Table("poincare", f"Poincare section of {output.name!r}", (
        Column("position", where, f"position {words}", position[kept]), Column("velocity", rate, f"velocity {words}", velocity[kept]),
        Column("turn", "-", "turn of the drive", np.round(t[kept] / model.period))))
    return Answer(values, (table,))


def _spans(model, output):
    """Range of position and velocity of an output over the ideal mechanism's turn."""
    seen, axis = ideal_record(model), path_axis(model.spec, output)
    if output.point is None:
        return np.array([np.ptp(seen.point(output.name, "angle")), np.ptp(seen.point(output.name, "w"))])
    along = (axis[0] * seen.point(output.name, x) + axis[1] * seen.point(output.name, y) for x, y in (("x", "y"), ("vx", "vy")))
    return np.array([np.ptp(part) for part in along])


# -- Lyapunov exponent ---------------------------------------------------------------------------------------------------------


def lyapunov(model, done):
    """Largest Lyapunov exponent per turn of the drive, by Benettin's method, with its convergence."""
    asked, system = model.spec.lyapunov, model.assembly.system
    if model.assembly.freedom == 0:
        return Answer(findings=("the Lyapunov exponent does not exist: the drive leaves the mechanism no freedom",))
    free = len(system.stored) + len(system.independent)
    scales = tolerances(system, model.settings, TURN / model.period) / model.settings.rtol
    inside = np.arange(len(scales)) < free
    inside[: len(system.stored)] = ~np.isin(system.stored, system.dependent)  # a dependent coordinate has no neighbours of its own

    def one(number):
        return largest_exponent(Turn(model), shifted(model, number), scales, cycles=asked.turns, discard=asked.discard,
                                rng=np.random.default_rng(model.spec.simulate.seed + number), continuous=inside,
                                separation=float(np.clip(ABOVE_ERROR * model.settings.rtol, 1e-8, 1e-4)))

    pairs = [row.value for row in cases.run(one, range(min(PAIRS_OF_TWINS, model.ensemble)), workers=None).rows if row.ok]
    if not pairs:
        return Answer(findings=("the Lyapunov exponent is left out: the motion leaves the finite numbers",), outcome="partial")
    return _exponent_answer(pairs)


def _exponent_answer(pairs):
    """Value, interval and convergence of exponents from motions that start almost alike, each with a twin."""
    history = np.mean([found.history for found in pairs], axis=0)
    turns = np.arange(1.0, len(history) + 1)
    growth = np.diff([found.history * turns for found in pairs], axis=1, prepend=0.0)
    exponent = Value.of(estimate(growth), "-", "largest Lyapunov exponent per turn; above 0: chaos")
    error = float(np.sqrt(np.sum([found.error**2 for found in pairs])) / len(pairs))
    values = {"lyapunov_exponent.per_turn": exponent, "lyapunov_exponent.error": Value(error, "-", "its standard error")}
    table = Table("lyapunov", "Largest Lyapunov exponent: convergence", (
        Column("turn", "-", "turns counted", turns), Column("exponent", "-", "mean growth per turn so far", history)))
    return Answer(values, (table,), (settled_check("settled.lyapunov", [exponent]),))


class Turn:
    """State at the start of a turn -> state at its end: the map whose neighbours the exponent compares."""

    def __init__(self, model):
        self.model = model
        self.settings = Settings(model.settings.rtol, model.settings.atol, max_steps=model.settings.max_steps)
        stored, tree = list(model.assembly.system.stored), model.assembly.tree
        self.spinning = [stored.index(tree.link(f"link:{joint.name}").turn) for joint in model.links]

    def __call__(self, state):
        # Every turn is run from time 0: the drive's angle is the same, and the state carries all that pins remember.
        run = simulate(self.model.assembly, self.model.period, self.settings, samples=np.empty(0), state=state)
        if run.advice:
            raise SolverError(f"a turn did not end: {run.stop}")
        end = restated(*run.end, self.model.assembly.system)  # the coordinates may have been split anew on the way
        end[self.spinning] %= TURN  # a link that spins would drown the separation in the rounding of its angle
        return end


# -- spectrum ------------------------------------------------------------------------------------------------------------------


def spectrum(model, done):
    """Amplitudes of every output's acceleration in orders of the drive, with and without play."""
    seen, tables = record_of(model), []
    start = model.spec.start_of_window
    turns = int(np.floor((seen.t[-1] - start) / model.period + 1e-9))
    if turns < 1:
        return Answer(findings=("the spectrum is left out: the window has no whole turn",))
    samples = max(2 * model.spec.simulate.samples_per_turn, PER_OSCILLATION * ORDERS)
    times = start + np.linspace(0, turns * model.period, turns * samples + 1)
    run = simulate(model.assembly, model.duration, model.settings, samples=np.minimum(times, model.duration))
    even, ideal = record(run, model.markers), ideal_record(model)
    orders = np.arange(ORDERS + 1.0)
    for output in model.spec.outputs:
        data, unit, word = acceleration(even, output)
        same, _, _ = acceleration(ideal, output)
        amplitude, low, high = _amplitudes(spectrogram(even.t, data, model.period, orders)[1])
        column = Column("amplitude", unit, f"amplitude of the {word}", amplitude)
        tables.append(Table(f"spectrum.{output.name}", f"Spectrum of the {word} of {output.name!r}", (
            Column("order", "-", "oscillations per turn", orders), column, *(column.bounds(low, high) if turns > 1 else ()),
            Column("ideal_amplitude", unit, "the same without play", order_spectrum(ideal.t, same, model.period, orders)))))
    return Answer(tables=tuple(tables))


def _amplitudes(turns):
    """(amplitude, low, high) of each order from the amplitudes (turns, orders) of single turns: the root of their mean square, so that
    what is irregular keeps its size however many turns there are, with its interval.  A motion that repeats itself has the same in all."""
    found = [estimate(power, scale=float(np.max(turns**2))) for power in (turns**2).T]
    power = np.array([[one.value, one.low, one.high] for one in found])
    return np.sqrt(np.maximum(power, 0.0)).T


# -- many runs -----------------------------------------------------------------------------------------------------------------


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
    where, rate = _units(output)
    words = f"of {output.name!r} at crank angle zero"
    columns = [np.concatenate([np.empty(0), *parts]) for parts in zip(*((np.full(len(p), v), p, r) for v, p, r in found), strict=True)]
    columns = columns or [np.empty(0)] * 3
    table = Table("bifurcation", f"Bifurcation over {asked.over}", (
        Column("parameter", dimension.unit if dimension else "-", asked.over, columns[0]),
        Column("position", where, f"position {words}", columns[1]), Column("velocity", rate, f"velocity {words}", columns[2])))
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
        return load_of(build(varied(spec, changes)), output, ideal[point[0]])

    ideal = {speed: ideal_peak(build(varied(spec, {"drive.speed": speed})), output) for speed in asked.speeds}
    rows = cases.run(task, points, workers=None)
    good = [row for row in rows.rows if row.ok]
    failed = tuple(f"table: {row.case[0]:.6g} rad/s, {1e3 * row.case[1]:.4g} mm is left out: {row.reason}" for row in rows.failed)
    load = np.array([row.value for row in good]).reshape(-1, 7)
    columns = (Column("speed", "rad/s", "speed of the drive", np.array([row.case[0] for row in good])),
               Column("clearance", "m", "radial clearance of every joint with play", np.array([row.case[1] for row in good])),
               *(Column(name, "-", words, load[:, k]) for k, (name, words) in enumerate(LOAD_WORDS.items())),
               Column("ideal_peak", acceleration_unit(output), "largest acceleration without play", load[:, 6]))
    return Answer(tables=(Table("load_table", f"Impact load of {output.name!r}", columns),), findings=failed,
                  outcome="partial" if rows.interrupted else "complete")


LOAD_WORDS = {
    "coefficient": "impact load coefficient",
    "largest": "largest peak over the ideal one",
    "percentile": "95th percentile over it",
    "rms": "root mean square over it",
    "turn_mean": "mean largest peak of a turn over it",
    "turn_spread": "standard deviation of it",
}


def acceleration_unit(output):
    return "rad/s^2" if output.point is None else "m/s^2"


def ideal_peak(model, output):
    """Largest acceleration of an output without play."""
    seen = take_ideal_record(model)
    return largest(seen.t, acceleration(seen, output)[0])


def load_of(model, output, peak=None):
    """(*ImpactLoad, ideal peak) of one output of a model, whose ideal peak may be known already; only the window is observed."""
    peak = ideal_peak(model, output) if peak is None else peak
    run = simulate(model.assembly, model.duration, replace(model.settings, per_step=1))
    if run.advice:
        raise SolverError(run.advice)
    seen = record(run, {output.name: output_marker(model.spec, output)}, model.spec.start_of_window * (1 - 1e-12))
    return (*impact_load(seen.t, acceleration(seen, output)[0], peak, model.period), peak)
