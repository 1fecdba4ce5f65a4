"""One run in numbers: of every turn of its window, and of the window as a whole."""

from dataclasses import dataclass, field

import numpy as np

from drivewright._typing import Floats
from drivewright.multibody.analyses.energy_audit import Audit, audit, audit_of_samples
from drivewright.multibody.analyses.simulation_model import Output, SimulationModel, ideal_record, record_of, run_of
from drivewright.multibody.measures import ImpactLoad, highest, impact_load, largest, peaks
from drivewright.multibody.observe import PIN_FIELDS, POWER_FIELDS, concatenate, observe
from drivewright.multibody.reactions import reactions
from drivewright.multibody.record import Record, record
from drivewright.multibody.simulate import Run, states_outside_folds
from drivewright.numerics.signals import time_mean


@dataclass(frozen=True)
class RunNumbers:
    """One run in numbers: `turns` {name: (whole turns of the window,)}, `whole` {name: number of the whole window, or run}."""

    turns: dict[str, Floats] = field(default_factory=dict)
    whole: dict[str, float] = field(default_factory=dict)

    @property
    def turn_count(self) -> int:
        """Number of whole turns."""
        return next(iter(self.turns.values())).size if self.turns else 0


def acceleration(record: Record, output: Output) -> tuple[Floats, str, str]:
    """(samples, unit, word) of an output's acceleration: the point's where one is given, else that of the angle."""
    if output.point is None:
        return record.point(output.name, "alpha"), "rad/s^2", "angular acceleration"
    return np.hypot(record.point(output.name, "ax"), record.point(output.name, "ay")), "m/s^2", "acceleration"


def start_of_window(model: SimulationModel, end: float) -> float:
    """Start of the window of peaks and means [s], for a run that ends there: behind the discarded turns, unless it did not get so far."""
    start = model.window_start
    return start * (1 - 1e-12) if end > start else 0.0


def turn_ends(model: SimulationModel, start: float, end: float) -> Floats:
    """Ends (turns + 1,) of the whole turns of the drive between two times; the start alone without turns."""
    count = int((end - start) / model.period + 1e-9) if model.period else 0
    return start + (model.period or 0.0) * np.arange(count + 1, dtype=float)


def output_numbers(model: SimulationModel, run: Run) -> RunNumbers:
    """Outputs, drive and pins with play of a run; impact loads of a mechanism with play, as only there is something beside the ideal."""
    start = start_of_window(model, run.end[1])
    record, numbers = window_record(model, run), RunNumbers()
    ends = turn_ends(model, start, record.t[-1])
    turns = ends if model.assembly.freedom else ends[:1]  # kinematics is exact, and its turns are the same
    if model.outputs:
        _motions(record, model.outputs, turns, numbers)
    for output in model.outputs if model.has_play else ():
        add_impact_load(record, output, ends, numbers, ideal_peak(model, output))
    if model.assembly.model.drives:
        for kind, chosen in driven_columns(model).items():
            effort = np.max(np.abs(record.drives[:, chosen]), axis=1)
            numbers.whole[f"drive.{kind}"] = float(np.max(effort))
            numbers.turns.update({f"drive.{kind}": largest_per_turn(record.t, effort, turns)} if len(turns) > 1 else {})
    for number, name in enumerate(model.pins):
        _pin(model, run, record, number, name, ends, numbers)
    return numbers


def driven_columns(model: SimulationModel) -> dict[str, list[int]]:
    """{"torque": numbers of the drives that turn, "force": of those that push}, what there is of them."""
    assembly = model.assembly.model
    turning = [next(j for j in assembly.joints if j.name == drive.joint).driven_motion == "rotation" for drive in assembly.drives]
    kinds = {kind: [k for k, turns in enumerate(turning) if turns is wanted] for kind, wanted in (("torque", True), ("force", False))}
    return {kind: numbers for kind, numbers in kinds.items() if numbers}


def window_record(model: SimulationModel, run: Run) -> Record:
    """The record of a run in the window of peaks and means."""
    start = start_of_window(model, run.end[1])
    return record_of(model).after(start) if run is run_of(model) else record(run, model.markers, start)


def ideal_peak(model: SimulationModel, output: Output) -> float:
    """Largest acceleration of an output without play."""
    ideal = ideal_record(model)
    return largest(ideal.t, acceleration(ideal, output)[0])


def joint_force_numbers(model: SimulationModel, run: Run) -> RunNumbers:
    """Force in every joint, tension of the massless links and whether they are pushed, the middles of folds left out."""
    start, limit, numbers = start_of_window(model, run.end[1]), model.limits.link_compression, RunNumbers()
    observed = concatenate([observe(*states) for states in states_outside_folds(run, start)])
    ends, forces = turn_ends(model, start, observed.t[-1]), reactions(model.assembly, run.end[0], observed)
    for name, joint in forces.joints.items():
        size = np.hypot(*joint.force.T)
        numbers.whole[f"{name}.force"] = float(np.max(size))
        numbers.turns.update({f"{name}.force": largest_per_turn(observed.t, size, ends)} if len(ends) > 1 else {})
    for name, tension in forces.tensions.items():
        pushed, top = (tension < -limit).astype(float), float(np.max(tension))
        numbers.whole.update({f"{name}.tension": float(np.min(tension)), f"{name}.pushed": time_mean(observed.t, pushed)})
        if len(ends) > 1:
            numbers.turns.update(
                {
                    f"{name}.tension": top - largest_per_turn(observed.t, top - tension, ends),
                    f"{name}.pushed": mean_per_turn(observed.t, pushed, ends),
                }
            )
    return numbers


def energy_numbers(model: SimulationModel, run: Run) -> RunNumbers:
    """Works over the run, by turns of the window too, and what the energy audit leaves over."""
    account = audit_of_run(model, run)
    ends = turn_ends(model, start_of_window(model, run.end[1]), run.end[1])
    numbers = RunNumbers({}, {"gap": float(np.max(np.abs(account.gap))), "error": account.error, "power_error": account.power_error})
    for k, name in enumerate(POWER_FIELDS):
        numbers.whole[name] = float(account.works[-1, k])
        numbers.turns.update({name: np.diff(np.interp(ends, account.t, account.works[:, k]))} if len(ends) > 1 else {})
    return numbers


def audit_of_run(model: SimulationModel, run: Run) -> Audit:
    """The `Audit` of a run with two points a step."""
    run_record = record_of(model) if run is run_of(model) else record(run, {})
    return audit_of_samples(run_record) if model.assembly.freedom == 0 else audit(run_record)  # kinematics has samples, not steps


def _motions(record, outputs, ends, numbers):
    """Largest magnitudes, and the ranges of angles and coordinates of the outputs, in SI."""
    sizes = {f"{output.name}.{key}": x for output in outputs for key, x in _sizes(record, output).items()}
    ranges = {f"{output.name}.swing": record.point(output.name, "angle") for output in outputs}
    ranges |= {f"{output.name}.travel_{axis}": record.point(output.name, axis) for output in outputs if output.point for axis in "xy"}
    top = highest(record.t, np.array([*sizes.values(), *ranges.values(), *(-x for x in ranges.values())]))
    largest_sizes, above, below = np.split(top, [len(sizes), len(sizes) + len(ranges)])
    numbers.whole.update(zip(sizes, largest_sizes.tolist(), strict=True))
    numbers.whole.update(zip(ranges, (above + below).tolist(), strict=True))
    if len(ends) > 1:
        numbers.turns.update({name: largest_per_turn(*peaks(record.t, x), ends) for name, x in sizes.items()})
        numbers.turns.update({name: _range_per_turn(record.t, x, ends) for name, x in ranges.items()})


def _sizes(record, output):
    """{name: magnitude (m,)} of the accelerations of an output."""
    size = {"alpha": np.abs(record.point(output.name, "alpha"))}
    return size | ({"acceleration": acceleration(record, output)[0]} if output.point else {})


def _range_per_turn(t, x, ends):
    low, high = np.min(x), np.max(x)
    return largest_per_turn(t, x - low, ends) + largest_per_turn(t, high - x, ends) - (high - low)


def add_impact_load(record: Record, output: Output, ends: Floats, numbers: RunNumbers, peak: float) -> None:
    """Add the impact load of an output, and its largest acceleration over that without play, to a `RunNumbers`."""
    name, data = output.name, acceleration(record, output)[0]
    period = ends[1] - ends[0] if len(ends) > 1 else None
    load = impact_load(record.t, data, peak, period)
    numbers.whole[f"{name}.ratio"] = largest(record.t, data) / peak if peak else np.nan
    numbers.whole.update({f"{name}.{field}": value for field, value in zip(ImpactLoad._fields, load, strict=True)})
    if np.isfinite(load.turn_mean):
        numbers.turns[f"{name}.peak"] = numbers.turns[f"{name}.turn_mean"] = largest_per_turn(*peaks(record.t, np.abs(data)), ends) / peak


def _pin(model, run, record, number, name, ends, numbers):
    pin = dict(zip(PIN_FIELDS, np.moveaxis(record.pins[:, number], 1, 0), strict=True))
    force, span = np.hypot(pin["fx"], pin["fy"]), record.t[-1] - record.t[0]
    at = run.impacts[(run.impacts[:, 1] == number) & (run.impacts[:, 0] >= record.t[0]) & (run.impacts[:, 0] <= record.t[-1]), 0]
    means = {"touching": (pin["depth"] > 0).astype(float), "lost": np.abs(pin["friction"] * pin["slip"]) + pin["drag"] * pin["spin"]}
    numbers.whole.update(
        {
            f"{name}.force": float(np.max(force)),
            f"{name}.depth": max(float(np.max(pin["depth"])), 0.0),
            f"{name}.hits": len(at) * (model.period or 0.0) / span,
        }
    )
    numbers.whole.update({f"{name}.{key}": float(mean_per_turn(record.t, x, record.t[[0, -1]])[0]) for key, x in means.items()})
    numbers.whole[f"{name}.coefficient"] = _mean_coefficient(record.t, pin)
    if len(ends) > 1:
        numbers.turns.update(
            {
                f"{name}.force": largest_per_turn(record.t, force, ends),
                f"{name}.hits": np.histogram(at, ends)[0].astype(float),
                f"{name}.depth": np.maximum(largest_per_turn(record.t, pin["depth"], ends), 0.0),
            }
        )
        numbers.turns.update({f"{name}.{key}": mean_per_turn(record.t, x, ends) for key, x in means.items()})


def _mean_coefficient(t, pin):
    """Work of friction over that of the normal force times the sliding path: the coefficient at which the pin slid; nan without sliding."""
    pressed, lost = np.abs(pin["normal"] * pin["slip"]), np.abs(pin["friction"] * pin["slip"])
    work = time_mean(t, pressed)
    return float(time_mean(t, lost) / work) if work > 0.0 else np.nan


def largest_per_turn(t: Floats, x: Floats, ends: Floats) -> Floats:
    """Largest of x (m,) between every two of the ends; 0 where there is none."""
    turns = np.searchsorted(ends, t, side="right") - 1
    numbers = np.zeros(len(ends) - 1)
    inside = (turns >= 0) & (turns < len(numbers))
    np.maximum.at(numbers, turns[inside], x[inside])
    return numbers


def mean_per_turn(t: Floats, x: Floats, ends: Floats) -> Floats:
    """Time means (turns,) of the polygon x (m,) between every two of the ends."""
    whole = np.concatenate([[0.0], np.cumsum(np.diff(t) * 0.5 * (x[1:] + x[:-1]))])
    row = np.clip(np.searchsorted(t, ends, side="right") - 1, 0, len(t) - 2)
    part = ends - t[row]
    slope = np.divide(x[row + 1] - x[row], t[row + 1] - t[row], out=np.zeros(len(ends)), where=t[row + 1] > t[row])
    return np.diff(whole[row] + part * (x[row] + 0.5 * part * slope)) / np.diff(ends)
