"""Impact load of a mechanism with play over its speed and its clearances."""

from collections.abc import Callable, Mapping, Sequence
from typing import TypeAlias

import numpy as np

from drivewright import cases
from drivewright.labels import in_words
from drivewright.multibody.analyses.ensemble import Statistics, ensemble_run, orbit_turns
from drivewright.multibody.analyses.simulation_model import Output, SimulationModel, simulate_ideal
from drivewright.multibody.analyses.turns import RunNumbers, acceleration, add_impact_load, start_of_window, turn_ends
from drivewright.multibody.measures import largest
from drivewright.multibody.record import Record, record
from drivewright.result import Answer, Column, Table

Point: TypeAlias = tuple[float, float]  # speed of the drive [rad/s], clearance of every joint with play [m]
LOAD_WORDS = {
    "coefficient": "impact load coefficient",
    "largest": "peak ratio",
    "percentile": "95th-percentile ratio",
    "rms": "RMS ratio",
    "turn_mean": "mean turn peak ratio",
    "turn_spread": "std. dev. of turn peak ratio",
}  # by the fields of an ImpactLoad: labels; all are over the peak of the ideal mechanism


def load_table(
    output: Output, points: Sequence[Point], model_at: Callable[[Point], SimulationModel], ideal: Mapping[float, float]
) -> Answer:
    """Impact load coefficient and its companions at speeds and clearances; `ideal`: largest acceleration without play by the speed."""

    def task(point: Point) -> Statistics:
        return impact_loads(model_at(point), output, ideal[point[0]])

    rows = cases.run(task, points, workers=None)
    good = [row for row in rows.rows if row.ok]
    failed = tuple(f"table: {row.case[0]:.6g} rad/s, {1e3 * row.case[1]:.4g} mm is left out: {row.reason}" for row in rows.failed)
    speed, clearance = (np.array([row.case[k] for row in good]) for k in (0, 1))
    loads = [_load_columns(name, words, output, [row.value for row in good]) for name, words in LOAD_WORDS.items()]
    columns = (
        Column("speed", "rad/s", "drive speed", speed),
        Column("clearance", "m", "radial clearance of every joint with clearance", clearance, "radial clearance"),
        *sum(loads, ()),
        Column(
            "ideal_peak",
            acceleration_unit(output),
            "peak acceleration of the mechanism with ideal joints",
            np.array([ideal[row.case[0]] for row in good]),
            "ideal peak acceleration",
        ),
    )
    return Answer(
        tables=(Table("load_table", f"Impact load of {in_words(output.name)}", columns),),
        findings=failed,
        outcome="partial" if rows.interrupted else "complete",
    )


def _load_columns(name: str, words: str, output: Output, cases: Sequence[Statistics]) -> tuple[Column, ...]:
    """A number of the impact load with its interval, of the `Statistics` of every case."""
    of_cases = [each.of_run(f"{output.name}.{name}", f"{output.name}.peak") for each in cases]
    value, low, high = np.array([(each.value, each.low, each.high) for each in of_cases]).reshape(-1, 3).T
    column = Column(name, "-", f"{words} of the acceleration, relative to its peak with ideal joints", value, words)
    return column, *column.bounds(low, high)


def acceleration_unit(output: Output) -> str:
    """Unit of an output's acceleration."""
    return "rad/s^2" if output.point is None else "m/s^2"


def ideal_acceleration_peak(model: SimulationModel, output: Output) -> float:
    """Largest acceleration of an output without play."""
    record = simulate_ideal(model)
    return largest(record.t, acceleration(record, output)[0])


def impact_loads(model: SimulationModel, output: Output, peak: float) -> Statistics:
    """`Statistics` of the impact load of one output: of a run, and unless that repeats itself, of the others of the ensemble."""
    first, record = _load(model, 0, output, peak)
    period = orbit_turns(model, record)
    others = () if period or not first.turn_count else [_load(model, number, output, peak)[0] for number in range(1, model.ensemble)]
    return Statistics((first, *others), period)


def impact_load_of_run(model: SimulationModel, output: Output, peak: float | None = None) -> tuple[float, ...]:
    """(*ImpactLoad, ideal peak) of one output in one run of a model, whose ideal peak may be known already."""
    peak = ideal_acceleration_peak(model, output) if peak is None else peak
    load_numbers = _load(model, 0, output, peak)[0]
    return (*(load_numbers.whole[f"{output.name}.{name}"] for name in LOAD_WORDS), peak)


def _load(model: SimulationModel, number: int, output: Output, peak: float) -> tuple[RunNumbers, Record]:
    """(numbers of the impact load of an output alone, record of the window) of one run of the ensemble."""
    run, numbers = ensemble_run(model, number, per_step=1), RunNumbers()
    start = start_of_window(model, run.end[1])
    run_record = record(run, model.markers, start)
    add_impact_load(run_record, output, turn_ends(model, start, run_record.t[-1]), numbers, peak)
    return numbers, run_record
