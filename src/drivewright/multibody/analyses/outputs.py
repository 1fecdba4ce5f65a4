"""The motion of outputs and bodies, and the impact load coefficient beside the ideal mechanism."""

import numpy as np

from drivewright._typing import Floats
from drivewright.errors import SolverError
from drivewright.multibody.analyses.ensemble import other_runs, settled_check, statistics, unsettled
from drivewright.multibody.analyses.simulation_model import (
    SimulationModel,
    cycle_columns,
    ideal_at,
    ideal_record,
    last_turn,
    record_of,
    run_of,
)
from drivewright.multibody.analyses.turns import acceleration, window_record
from drivewright.multibody.assembly import Assembly
from drivewright.multibody.bodies import Marker
from drivewright.multibody.measures import largest
from drivewright.multibody.observe import FIELDS
from drivewright.multibody.record import POINT_FIELDS, Record, final_state
from drivewright.numerics.ensemble import predict_member
from drivewright.result import Answer, Check, Column, Table, Value


def window(model: SimulationModel) -> Record:
    """The record after the discarded turns; all of it where the run did not get so far."""
    kept = window_record(model, run_of(model))
    if len(kept.t) < 3:
        raise SolverError(f"{len(kept.t)} states at t = {kept.t[-1]:.6g} s hold no peaks and means; see why the run ends there")
    return kept


# -- bodies and outputs --------------------------------------------------------------------------------------------------------


def motion(model: SimulationModel) -> Answer:
    """Swing and peaks of the outputs, and the last turn as a table."""
    tables = (_motion_table(model),) if model.outputs else ()
    return Answer(output_values(model), tables)


def output_values(model: SimulationModel) -> dict[str, Value]:
    """Swing and peaks of the outputs."""
    window(model)  # refuses a run that holds no numbers
    values, run_statistics = {}, statistics(model)
    for output in model.outputs:
        name = output.name
        values[f"{name}.max_angular_acceleration"] = Value.of(
            run_statistics.of_run(f"{name}.alpha"), "rad/s^2", f"largest angular acceleration of {output.body!r}, magnitude"
        )
        values[f"{name}.swing"] = Value.of(
            run_statistics.of_run(f"{name}.swing"), "rad", f"range of the angle of {output.body!r} in the window"
        )
        if output.point:
            values[f"{name}.max_acceleration"] = Value.of(
                run_statistics.of_run(f"{name}.acceleration"), "m/s^2", f"largest acceleration of point {output.point!r}, magnitude"
            )
    return values


def end(model: SimulationModel) -> Answer:
    """Pose and rates of every body at the end of the run; of a motion that does not repeat itself with what another run would show."""
    values, last = {}, np.array([record_of(model).last, *(final_state(run) for run in other_runs(model))])
    fields = (
        ("x", "x", "m", "centroid, x"),
        ("y", "y", "m", "centroid, y"),
        ("angle", "angle", "rad", "angle, not wrapped"),
        ("vx", "vx", "m/s", "velocity of the centroid, x"),
        ("vy", "vy", "m/s", "velocity of the centroid, y"),
        ("angular_velocity", "w", "rad/s", "angular velocity"),
    )
    for number, name in enumerate(model.assembly.names):
        if name in model.bodies:
            for key, field, unit, meaning in fields:
                drawn = predict_member(last[:, number, FIELDS.index(field)])
                values[f"bodies.{name}.{key}"] = Value.of(drawn, unit, f"{meaning}, at the end of the run")
    return Answer(values | (_displacements(model, last) if model.period is None else {}))


def _displacements(model, last):
    """How far the points of outputs are from where they began, at the ends `last` (runs, bodies, FIELDS) of a run without turns."""
    values, markers = {}, model.markers
    for output in model.outputs:
        if output.point:
            start = record_of(model).points[output.name][0, [POINT_FIELDS.index(field) for field in ("x", "y")]]
            ways = np.hypot(*(end_points(model.assembly, last, markers[output.name]) - start).T)
            meaning = f"distance of point {output.point!r} from where it began, at the end of the run"
            values[f"{output.name}.displacement"] = Value.of(predict_member(ways), "m", meaning, f"Displacement of point {output.point!r}")
    return values


def end_points(assembly: Assembly, last: Floats, marker: Marker) -> Floats:
    """Places (runs, 2) [m] of a marker in the poses `last` (runs, bodies, FIELDS)."""
    x, y, angle = (last[:, assembly.names.index(marker.body), FIELDS.index(field)] for field in ("x", "y", "angle"))
    cx, cy = next((body.centroid for body in assembly.expanded.bodies if body.name == marker.body), (0.0, 0.0))
    place = x + 1j * y + np.exp(1j * angle) * complex(marker.x - cx, marker.y - cy)
    return np.stack([place.real, place.imag], axis=1)


def _motion_table(model):
    record = last_turn(model)
    columns, ideal = list(cycle_columns(model, record.t)), ideal_at(model, record.t) if model.has_play else None
    for output in model.outputs:
        for field, unit, meaning in _fields(output):
            data = record.point(output.name, field)
            columns.append(Column(f"{output.name}.{field}", unit, f"{meaning} of {output.name!r}", data))
            if ideal is not None:
                same = ideal[output.name][:, POINT_FIELDS.index(field)]
                columns.append(Column(f"{output.name}.ideal_{field}", unit, f"{meaning} of {output.name!r}, without play", same))
    return Table("motion", "Motion of the outputs over the last turn" if model.period else "Motion of the outputs", tuple(columns))


def _fields(output):
    if output.point is None:
        return (("angle", "rad", "angle"), ("w", "rad/s", "angular velocity"), ("alpha", "rad/s^2", "angular acceleration"))
    return (
        ("x", "m", "x"),
        ("y", "m", "y"),
        ("vx", "m/s", "velocity, x,"),
        ("vy", "m/s", "velocity, y,"),
        ("ax", "m/s^2", "acceleration, x,"),
        ("ay", "m/s^2", "acceleration, y,"),
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
            checks.append(Check.of(load, f"impact_load.{name}", limit, "<=", "impact load coefficient", (output.body,)))
    values["window.start"] = Value(float(record.t[0]), "s", "start of the window of peaks and means")
    values["window.end"] = Value(float(record.t[-1]), "s", "its end")
    return Answer(values, (), (*checks, settled_check("settled", drawn)), unsettled(values))


def _load_values(model, output):
    """{key: Value} of one output."""
    name, ideal, run_statistics = output.name, ideal_record(model), statistics(model)
    data, unit, word = acceleration(ideal, output)
    peak = largest(ideal.t, data)

    def of_run(field, meaning):
        return Value.of(run_statistics.of_run(f"{name}.{field}", f"{name}.peak"), "-", meaning)

    return {
        "ideal_peak": Value(peak, unit, f"largest {word} of {name!r} without play"),
        "peak_acceleration_ratio": of_run("ratio", f"largest {word} over that without play"),
        "impact_load_coefficient": of_run("coefficient", f"mean of the five largest peaks of the {word} over the ideal peak"),
        "percentile_ratio": of_run("percentile", f"level that the {word} keeps below 95 % of the time, over the ideal peak"),
        "rms_ratio": of_run("rms", f"root mean square of the {word} over the ideal peak"),
        "turn_peak_mean": Value.of(
            run_statistics.mean(f"{name}.turn_mean"), "-", f"mean over the turns of the largest {word}, over the ideal peak"
        ),
        "turn_peak_spread": of_run("turn_spread", "standard deviation of the same"),
    }
