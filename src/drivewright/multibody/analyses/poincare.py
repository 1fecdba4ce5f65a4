"""Poincare section: position and velocity of a motion once a turn of the drive."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from drivewright._typing import Bools, Floats
from drivewright.errors import SolverError
from drivewright.labels import in_words
from drivewright.multibody.analyses.simulation_model import Output, SimulationModel, ideal_record
from drivewright.multibody.record import record
from drivewright.multibody.simulate import Run, Settings, simulate
from drivewright.numerics.chaos import orbit_period
from drivewright.result import Answer, Column, Table, Value

SAME = 1e-3  # of the cloud's size: visits nearer to each other count as one point of the orbit
STILL = 1e-5  # of the range of the motion: a cloud smaller than this is one point


class Section(NamedTuple):
    """Visits once a turn, of any time history: t (m,) [s], position (m,), velocity (m,) in the units of `units`."""

    t: Floats
    position: Floats
    velocity: Floats
    units: tuple[str, str] = ("m", "m/s")


def section_answer(
    name: str, section: Section, period: float, spans: Floats, start: float = 0.0, at: str = "crank angle zero", still: float = STILL
) -> Answer:
    """The section of the motion `name` with a turn of `period` [s], from a time on: last visit, turns after which it repeats, all visits.

    spans (2,): range of position and velocity of the motion, beside which a cloud smaller than the part `still` of it is one point; `at`:
    where in its turn the drive is at the visits.
    """
    t, position, velocity, (where, rate) = section
    kept = t >= start * (1 - 1e-9)
    words = f"of {in_words(name)} at {at}"
    points = np.stack([position[kept], velocity[kept]], axis=1)
    enough, turns = len(points) >= 6, 0
    if enough:
        turns = orbit_period(points / np.maximum(np.ptp(points, axis=0), still * spans), SAME)
    visits = kept if enough and not turns else np.full(len(t), False)
    values = {
        "poincare.position": _visit(position, visits, where, f"position {words} after the last whole turn", f"final position at {at}"),
        "poincare.velocity": _visit(velocity, visits, rate, f"velocity {words} after the last whole turn", f"final velocity at {at}"),
    }
    if enough:
        meaning, label = "number of turns after which the motion repeats itself", "period of the motion in turns"
        values["poincare.period"] = Value(float(turns), "-", meaning, label=label, convention="0: the motion does not repeat itself")
    table = Table(
        "poincare",
        f"Poincaré section of {in_words(name)}",
        (
            Column("position", where, f"position {words}", position[kept], f"position at {at}"),
            Column("velocity", rate, f"velocity {words}", velocity[kept], f"velocity at {at}"),
            Column("turn", "-", "turn of the drive", np.round(t[kept] / period)),
        ),
    )
    return Answer(values, (table,))


def _visit(visited: Floats, drawn: Bools, unit: str, meaning: str, label: str) -> Value:
    """The last of the visits (m,); of a motion that does not repeat itself with the range in which 95 % of those drawn lie."""
    last = Value(float(visited[-1]), unit, meaning, label=label)
    if not np.any(drawn):
        return last
    low, high = np.percentile(visited[drawn], [2.5, 97.5])
    return last._replace(low=float(min(low, last.value)), high=float(max(high, last.value)), interval="visits")


# -- of a simulated mechanism ----------------------------------------------------------------------------------------------------


def poincare(model: SimulationModel, output: Output) -> Answer:
    """Position and velocity of an output at crank angle zero, once a turn."""
    section, _ = simulate_section(model, output, model.run_length, model.settings)
    return section_answer(output.name, section, model.turn_length, _spans(model, output), model.window_start)


def zero_times(model: SimulationModel, end: float) -> Floats:
    """Times at which the drive's angle is a whole number of turns, to the end of the last whole turn."""
    driven, period = model.assembly.system.driven[0], model.turn_length
    phase = float(-(driven.sign * driven.start) / model.drive_speed % period)
    phase = 0.0 if period - phase < 1e-9 * period else phase
    return phase + period * np.arange(int(np.floor((end - phase) / period + 1e-9)) + 1, dtype=float)


def simulate_section(model: SimulationModel, output: Output, duration: float, settings: Settings) -> tuple[Section, Run]:
    """The `Section` of an output, and the run that gives it."""
    times = np.minimum(zero_times(model, duration), duration)
    run = simulate(model.assembly, duration, settings, samples=times)
    run_record, axis = record(run, {output.name: output.marker}), output.axis
    if output.point is None:
        return Section(run_record.t, run_record.point(output.name, "angle"), run_record.point(output.name, "w"), units_of(output)), run
    along = axis[0] * run_record.point(output.name, "x") + axis[1] * run_record.point(output.name, "y")
    rate = axis[0] * run_record.point(output.name, "vx") + axis[1] * run_record.point(output.name, "vy")
    return Section(run_record.t, along, rate, units_of(output)), run


def visited_points(model: SimulationModel, name: str, turns: float, discard: float) -> tuple[Floats, Floats]:
    """(positions (m,), velocities (m,)) of an output once a turn, in `units_of` it, over so many turns less the first ones discarded.

    SolverError where the run stops before its end.
    """
    section, run = simulate_section(model, model.output(name), turns * model.turn_length, replace(model.settings, per_step=1))
    if run.advice:
        raise SolverError(run.advice)
    kept = section.t >= discard * model.turn_length * (1 - 1e-9)
    return section.position[kept], section.velocity[kept]


def units_of(output: Output) -> tuple[str, str]:
    """Units of an output's position and velocity."""
    return ("rad", "rad/s") if output.point is None else ("m", "m/s")


def _spans(model: SimulationModel, output: Output) -> Floats:
    """Range (2,) of position and velocity of an output over the ideal mechanism's turn."""
    record, axis = ideal_record(model), output.axis
    if output.point is None:
        return np.array([np.ptp(record.point(output.name, "angle")), np.ptp(record.point(output.name, "w"))])
    along = (axis[0] * record.point(output.name, x) + axis[1] * record.point(output.name, y) for x, y in (("x", "y"), ("vx", "vy")))
    return np.array([np.ptp(part) for part in along])
