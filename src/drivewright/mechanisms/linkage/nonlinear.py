"""Nonlinear motion: Poincare section, Lyapunov exponent, spectrum in orders."""

import numpy as np

from drivewright import cases
from drivewright.errors import SolverError, UnknownName
from drivewright.mechanisms.linkage.build import TURN, ideal_record, record_of
from drivewright.mechanisms.linkage.describe import output_marker
from drivewright.mechanisms.linkage.ensemble import settled_check, shifted
from drivewright.mechanisms.linkage.member import acceleration
from drivewright.multibody.record import record
from drivewright.multibody.simulate import Settings, restated, simulate, tolerances
from drivewright.numerics.chaos import largest_exponent, orbit_period
from drivewright.numerics.ensemble import estimate
from drivewright.numerics.signals import order_spectrum, spectrogram
from drivewright.result import Answer, Column, Table, Value

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


def units_of(output):
    return ("rad", "rad/s") if output.point is None else ("m", "m/s")


def poincare(model, done):
    """Position and velocity of an output at crank angle zero, once a turn."""
    output = output_named(model.spec, model.spec.poincare.output)
    t, position, velocity, run = section(model, output, model.duration, model.settings)
    kept = t >= model.spec.start_of_window * (1 - 1e-9)
    where, rate = units_of(output)
    words = f"of {output.name!r} at crank angle zero"
    points = np.stack([position[kept], velocity[kept]], axis=1)
    enough, period = len(points) >= 6, 0
    if enough:
        period = orbit_period(points / np.maximum(np.ptp(points, axis=0), STILL * _spans(model, output)), SAME)
    visits = kept if enough and not period else np.full(len(t), False)
    values = {
        "poincare.position": _visit(position, visits, where, f"position {words} after the last whole turn"),
        "poincare.velocity": _visit(velocity, visits, rate, f"velocity {words} after the last whole turn"),
    }
    if enough:
        values["poincare.period"] = Value(float(period), "-", "turns after which the motion repeats itself; 0: it does not")
    table = Table(
        "poincare",
        f"Poincare section of {output.name!r}",
        (
            Column("position", where, f"position {words}", position[kept]),
            Column("velocity", rate, f"velocity {words}", velocity[kept]),
            Column("turn", "-", "turn of the drive", np.round(t[kept] / model.period)),
        ),
    )
    return Answer(values, (table,))


def _visit(visited, drawn, unit, meaning):
    """The last of the visits (m,); of a motion that does not repeat itself with the range in which 95 % of those drawn lie."""
    last = Value(float(visited[-1]), unit, meaning)
    if not np.any(drawn):
        return last
    low, high = np.percentile(visited[drawn], [2.5, 97.5])
    return last._replace(low=float(min(low, last.value)), high=float(max(high, last.value)), interval="visits")


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
        return largest_exponent(
            Turn(model),
            shifted(model, number),
            scales,
            cycles=asked.turns,
            discard=asked.discard,
            rng=np.random.default_rng(model.spec.simulate.seed + number),
            continuous=inside,
            separation=float(np.clip(ABOVE_ERROR * model.settings.rtol, 1e-8, 1e-4)),
        )

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
    table = Table(
        "lyapunov",
        "Largest Lyapunov exponent: convergence",
        (Column("turn", "-", "turns counted", turns), Column("exponent", "-", "mean growth per turn so far", history)),
    )
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
        tables.append(
            Table(
                f"spectrum.{output.name}",
                f"Spectrum of the {word} of {output.name!r}",
                (
                    Column("order", "-", "oscillations per turn", orders),
                    column,
                    *(column.bounds(low, high) if turns > 1 else ()),
                    Column("ideal_amplitude", unit, "the same without play", order_spectrum(ideal.t, same, model.period, orders)),
                ),
            )
        )
    return Answer(tables=tuple(tables))


def _amplitudes(turns):
    """(amplitude, low, high) of each order from the amplitudes (turns, orders) of single turns: the root of their mean square, so that
    what is irregular keeps its size however many turns there are, with its interval.  A motion that repeats itself has the same in all."""
    found = [estimate(power, scale=float(np.max(turns**2))) for power in (turns**2).T]
    power = np.array([[one.value, one.low, one.high] for one in found])
    return np.sqrt(np.maximum(power, 0.0)).T
