"""The motion of outputs and bodies, and the impact load coefficient beside the ideal mechanism."""

import numpy as np

from drivewright.errors import SolverError
from drivewright.labels import in_words
from drivewright.multibody.analyses.ensemble import other_runs, settled_check, statistics, unsettled
from drivewright.multibody.analyses.simulation_model import (
    SimulationModel,
    cycle_columns,
    ideal_at,
    ideal_record,
    last_turn,
    over_last_turn,
    record_of,
    run_of,
)
from drivewright.multibody.analyses.turns import acceleration, window_record
from drivewright.multibody.measures import largest
from drivewright.multibody.observe import FIELDS
from drivewright.multibody.record import POINT_FIELDS, Record, final_state, marker_motion
from drivewright.numerics.ensemble import predict_member
from drivewright.result import Answer, Check, Column, Table, Value


def window(model: SimulationModel) -> Record:
    """The record after the discarded turns; all of it where the run did not get so far."""
    kept = window_record(model, run_of(model))
    if len(kept.t) < 3:
        raise SolverError(
            f"the run stops at t = {kept.t[-1]:.6g} s, so the evaluation window has too few states ({len(kept.t)}) for peaks and means"
        )
    return kept


# -- bodies and outputs --------------------------------------------------------------------------------------------------------


def motion(model: SimulationModel) -> Answer:
    """Swing, travel and peaks of the outputs, and the last turn as a table."""
    tables = (_motion_table(model),) if model.outputs else ()
    return Answer(output_values(model), tables)


def output_values(model: SimulationModel) -> dict[str, Value]:
    """Swing, travel and peaks of the outputs."""
    window(model)  # refuses a run that holds no numbers
    values, run_statistics = {}, statistics(model)
    for output in model.outputs:
        name = output.name
        body, label = f"body {in_words(output.body)}", in_words(name)
        values[f"{name}.max_angular_acceleration"] = Value.of(
            run_statistics.of_run(f"{name}.alpha"),
            "rad/s^2",
            f"peak magnitude of the angular acceleration of {body}",
            f"peak angular acceleration, {label}",
        )
        values[f"{name}.swing"] = Value.of(
            run_statistics.of_run(f"{name}.swing"), "rad", f"range of the angle of {body} in the window", f"swing angle, {label}"
        )
        if output.point:
            values[f"{name}.max_acceleration"] = Value.of(
                run_statistics.of_run(f"{name}.acceleration"),
                "m/s^2",
                f"peak magnitude of the acceleration of point {output.point} of {body}",
                f"peak acceleration, {label}",
            )
            for axis in "xy":
                values[f"{name}.travel_{axis}"] = Value.of(
                    run_statistics.of_run(f"{name}.travel_{axis}"),
                    "m",
                    f"range of {axis} of point {output.point} of {body} in the window",
                    f"travel in {axis}, {label}",
                )
    return values


def end(model: SimulationModel) -> Answer:
    """Pose and rates of every body at the end of the run; of a motion that does not repeat itself with what another run would show."""
    values, last = {}, np.array([record_of(model).last, *(final_state(run) for run in other_runs(model))])
    fields = (
        ("x", "x", "m", "position x", "of the centroid of"),
        ("y", "y", "m", "position y", "of the centroid of"),
        ("angle", "angle", "rad", "angle", "of"),
        ("vx", "vx", "m/s", "velocity x", "of the centroid of"),
        ("vy", "vy", "m/s", "velocity y", "of the centroid of"),
        ("angular_velocity", "w", "rad/s", "angular velocity", "of"),
    )
    for number, name in enumerate(model.assembly.names):
        if name in model.bodies:
            body = in_words(name)
            for key, field, unit, quantity, place in fields:
                drawn = predict_member(last[:, number, FIELDS.index(field)])
                meaning = f"{quantity} {place} body {body} at the end of the run"
                convention = "whole turns are counted" if key == "angle" else ""
                values[f"bodies.{name}.{key}"] = Value.of(drawn, unit, meaning, f"final {quantity} of {body}", convention)
    return Answer(values | (_displacements(model, last) if model.period is None else {}))


def _displacements(model, last):
    """How far the points of outputs are from where they began, at the ends `last` (runs, bodies, FIELDS) of a run without turns."""
    values, markers = {}, model.markers
    for output in model.outputs:
        if output.point:
            start, ends = record_of(model).points[output.name][0], marker_motion(model.assembly, last, markers[output.name])
            ways = np.hypot(*(ends - start)[:, [POINT_FIELDS.index(field) for field in ("x", "y")]].T)
            label = in_words(output.name)
            meaning = f"distance of point {output.point} of {label} from its initial position, at the end of the run"
            values[f"{output.name}.displacement"] = Value.of(predict_member(ways), "m", meaning, f"displacement, {label}")
    return values


def _motion_table(model):
    record = last_turn(model)
    columns, ideal = list(cycle_columns(model, record.t)), ideal_at(model, record.t) if model.has_play else None
    for output in model.outputs:
        for field, unit, meaning in _fields(output):
            data, label = record.point(output.name, field), f"{meaning} of {in_words(output.name)}"
            columns.append(Column(f"{output.name}.{field}", unit, label, data))
            if ideal is not None:
                same = ideal[output.name][:, POINT_FIELDS.index(field)]
                columns.append(Column(f"{output.name}.ideal_{field}", unit, f"{label}, ideal joints", same, f"{label}, ideal"))
    return Table("motion", f"Motion of the outputs{over_last_turn(model)}", tuple(columns))


def _fields(output):
    if output.point is None:
        return (("angle", "rad", "angle"), ("w", "rad/s", "angular velocity"), ("alpha", "rad/s^2", "angular acceleration"))
    return (
        ("x", "m", "position x"),
        ("y", "m", "position y"),
        ("vx", "m/s", "velocity x"),
        ("vy", "m/s", "velocity y"),
        ("ax", "m/s^2", "acceleration x"),
        ("ay", "m/s^2", "acceleration y"),
    )


# -- impact load coefficient ---------------------------------------------------------------------------------------------------


def impact(model: SimulationModel) -> Answer:
    """K_d of every output with its window and robust companions."""
    record, values, checks, drawn = window(model), {}, [], []
    for output in model.outputs:
        name, loads = output.name, _load_values(model, output)
        values |= {f"{name}.{key}": value for key, value in loads.items() if np.isfinite(value.value)}
        drawn += [value for value in loads.values() if np.isfinite(value.value)]
        limit, load = model.limits.impact_load_coefficient, loads["impact_load_coefficient"]
        if limit and np.isfinite(load.value):
            words = "impact load coefficient; reduce the clearance or the speed"
            label = f"impact load coefficient, {in_words(name)}"
            checks.append(Check.of(load, f"impact_load.{name}", limit, "<=", words, (output.body,), label))
    words = "of the time window over which peaks and means are evaluated"
    values["window.start"] = Value(float(record.t[0]), "s", f"start {words}", label="start of the evaluation window")
    values["window.end"] = Value(float(record.t[-1]), "s", f"end {words}", label="end of the evaluation window")
    return Answer(values, (), (*checks, settled_check("settled", drawn)), unsettled(values))


def _load_values(model, output):
    """{key: Value} of one output."""
    name, ideal, run_statistics = output.name, ideal_record(model), statistics(model)
    data, unit, word = acceleration(ideal, output)
    peak, label = largest(ideal.t, data), in_words(name)
    relative = f"of the {word} of {label}, relative to its peak with ideal joints"

    def of_run(field, meaning, short):
        return Value.of(run_statistics.of_run(f"{name}.{field}", f"{name}.peak"), "-", f"{meaning} {relative}", f"{short}, {label}")

    return {
        "ideal_peak": Value(peak, unit, f"peak {word} of {label} with ideal joints", label=f"ideal peak {word}, {label}"),
        "peak_acceleration_ratio": of_run("ratio", "peak", "peak acceleration ratio"),
        "impact_load_coefficient": of_run("coefficient", "mean of the five largest peaks", "impact load coefficient"),
        "percentile_ratio": of_run("percentile", "95th percentile", "95th-percentile ratio"),
        "rms_ratio": of_run("rms", "root mean square", "RMS acceleration ratio"),
        "turn_peak_mean": Value.of(
            run_statistics.mean(f"{name}.turn_mean"), "-", f"mean of the peaks per turn {relative}", f"mean turn peak ratio, {label}"
        ),
        "turn_peak_spread": of_run("turn_spread", "standard deviation of the peaks per turn", "std. dev. of turn peak ratio"),
    }
