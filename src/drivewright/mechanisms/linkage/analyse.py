"""The motion of the outputs, of pins with play and of the bodies, beside the ideal mechanism."""

import numpy as np

from drivewright.errors import SolverError
from drivewright.mechanisms.linkage.advice import advice
from drivewright.mechanisms.linkage.build import TURN, ideal_at, ideal_record, record_of, run_of
from drivewright.mechanisms.linkage.ensemble import other_runs, settled_check, statistics, unsettled
from drivewright.mechanisms.linkage.member import acceleration, window_of
from drivewright.multibody.measures import largest
from drivewright.multibody.observe import FIELDS, PIN_FIELDS
from drivewright.multibody.record import POINT_FIELDS, last_of
from drivewright.numerics.ensemble import draw
from drivewright.result import Answer, Check, Column, Table, Value

ROWS = 4000  # of a table of the last turn, at most


def no_run(spec):
    """Why there is nothing to simulate."""
    if spec.simulate is None and spec.period is None:
        return "there is no [simulate] table, and no drive at constant speed whose turn could stand for it"
    return None


def no_outputs(spec):
    return no_run(spec) or (None if spec.outputs else "the spec declares no [[outputs]]")


def window(model):
    """The record after the discarded turns; all of it where the run did not get so far."""
    kept = window_of(model, run_of(model))
    if len(kept.t) < 3:
        raise SolverError(f"{len(kept.t)} states at t = {kept.t[-1]:.6g} s hold no peaks and means; see why the run ends there")
    return kept


# -- bodies and outputs --------------------------------------------------------------------------------------------------------


def motion(model, done):
    """Swing and peaks of the outputs, and the last turn as a table."""
    window(model)  # refuses a run that holds no numbers
    values, found = {}, statistics(model)
    for output in model.spec.outputs:
        name = output.name
        values[f"{name}.max_angular_acceleration"] = Value.of(
            found.of_run(f"{name}.alpha"), "rad/s^2", f"largest angular acceleration of {output.body!r}, magnitude"
        )
        values[f"{name}.swing"] = Value.of(found.of_run(f"{name}.swing"), "rad", f"range of the angle of {output.body!r} in the window")
        if output.point:
            values[f"{name}.max_acceleration"] = Value.of(
                found.of_run(f"{name}.acceleration"), "m/s^2", f"largest acceleration of point {output.point!r}, magnitude"
            )
    tables = (_motion_table(model),) if model.spec.outputs else ()
    return Answer(values, tables, advice(model.spec, run_of(model).end[1]))


def end(model, done):
    """Pose and rates of every body at the end of the run; of a motion that does not repeat itself with what another run would show."""
    values, last = {}, np.array([record_of(model).last, *(last_of(run) for run in other_runs(model))])
    told = (
        ("x", "x", "m", "centroid, x"),
        ("y", "y", "m", "centroid, y"),
        ("angle", "angle", "rad", "angle, not wrapped"),
        ("vx", "vx", "m/s", "velocity of the centroid, x"),
        ("vy", "vy", "m/s", "velocity of the centroid, y"),
        ("angular_velocity", "w", "rad/s", "angular velocity"),
    )
    for number, name in enumerate(model.assembly.names):
        if name in model.spec.bodies:
            for key, field, unit, meaning in told:
                drawn = draw(last[:, number, FIELDS.index(field)])
                values[f"bodies.{name}.{key}"] = Value.of(drawn, unit, f"{meaning}, at the end of the run")
    return Answer(values)


def last_turn(model):
    """The record of the last whole turn (of the whole run without turns), thinned to at most ROWS rows."""
    seen = record_of(model)
    turns = np.floor(seen.t[-1] / model.period + 1e-9) if model.period else 0
    start = (turns - 1) * model.period if turns >= 1 else 0.0
    end = turns * model.period if turns >= 1 else seen.t[-1]
    rows = np.flatnonzero((seen.t >= start * (1 - 1e-12)) & (seen.t <= end * (1 + 1e-12)))
    stride = max(1, -(-len(rows) // ROWS))
    return seen.take(rows[::stride])


def cycle_columns(model, t):
    """Time, the angle of a drive at constant speed, and where loops fold in a run that passes singular positions."""
    columns = (Column("time", "s", "time", t), *_folds(run_of(model), t))
    if model.period:
        turn = np.floor(t[0] / model.period + 1e-9)
        angle = (t - turn * model.period) * TURN / model.period
        columns = (Column("crank_angle", "rad", "angle of the drive since the start of the turn", angle), *columns)
    return columns


def _folds(run, t):
    if not run.passages:
        return ()
    near = [np.abs(t - passed.time) < passed.system.chart.reach * passed.system.chart.pace for passed in run.passages]
    return (Column("fold", "-", "1 near a singular position, where loops fold", np.any(near, axis=0).astype(float)),)


def _motion_table(model):
    seen = last_turn(model)
    columns, ideal = list(cycle_columns(model, seen.t)), ideal_at(model, seen.t) if model.played else None
    for output in model.spec.outputs:
        for field, unit, meaning in _told(output):
            data = seen.point(output.name, field)
            columns.append(Column(f"{output.name}.{field}", unit, f"{meaning} of {output.name!r}", data))
            if ideal is not None:
                same = ideal[output.name][:, POINT_FIELDS.index(field)]
                columns.append(Column(f"{output.name}.ideal_{field}", unit, f"{meaning} of {output.name!r}, without play", same))
    return Table("motion", "Motion of the outputs over the last turn" if model.period else "Motion of the outputs", tuple(columns))


def _told(output):
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


def no_play(spec):
    if no_outputs(spec):
        return no_outputs(spec)
    return None if any(joint.pin not in (None, "ideal") for joint in spec.joints) else "no joint has play"


def impact(model, done):
    """K_d of every output with its window and robust companions."""
    seen, values, checks, drawn = window(model), {}, [], []
    for output in model.spec.outputs:
        name, told = output.name, _load_values(model, output)
        values |= {f"{name}.{key}": value for key, value in told.items() if np.isfinite(value.value)}
        drawn += [value for value in told.values() if np.isfinite(value.value)]
        limit, load = model.spec.limits.impact_load_coefficient, told["impact_load_coefficient"]
        if limit and np.isfinite(load.value):
            checks.append(Check.of(load, f"impact_load.{name}", limit, "<=", "impact load coefficient", (output.body,)))
    values["window.start"] = Value(float(seen.t[0]), "s", "start of the window of peaks and means")
    values["window.end"] = Value(float(seen.t[-1]), "s", "its end")
    return Answer(values, (), (*checks, settled_check("settled", drawn)), unsettled(values))


def _load_values(model, output):
    """{key: Value} of one output."""
    name, ideal, found = output.name, ideal_record(model), statistics(model)
    data, unit, word = acceleration(ideal, output)
    peak = largest(ideal.t, data)

    def of_run(field, meaning):
        return Value.of(found.of_run(f"{name}.{field}", f"{name}.peak"), "-", meaning)

    return {
        "ideal_peak": Value(peak, unit, f"largest {word} of {name!r} without play"),
        "peak_acceleration_ratio": of_run("ratio", f"largest {word} over that without play"),
        "impact_load_coefficient": of_run("coefficient", f"mean of the five largest peaks of the {word} over the ideal peak"),
        "percentile_ratio": of_run("percentile", f"level that the {word} keeps below 95 % of the time, over the ideal peak"),
        "rms_ratio": of_run("rms", f"root mean square of the {word} over the ideal peak"),
        "turn_peak_mean": Value.of(found.mean(f"{name}.turn_mean"), "-", f"mean over the turns of the largest {word}, over the ideal peak"),
        "turn_peak_spread": of_run("turn_spread", "standard deviation of the same"),
    }


# -- pins with play ------------------------------------------------------------------------------------------------------------


def no_pins(spec):
    return no_run(spec) or (None if any(j.pin in ("dry", "lubricated") for j in spec.joints) else "no joint is dry or lubricated")


def pins(model, done):
    """Largest force and penetration, impacts and contact share of every pin with play; orbit and force over the last turn."""
    turn, limits = last_turn(model), model.spec.limits
    values, tables, checks = {}, [_impact_table(model, run_of(model))], []
    for number, name in enumerate(model.pins):
        told = _pin_values(model, name)
        values |= {f"joints.{name}.{key}": value for key, value in told.items()}
        tables.append(_pin_table(model, turn, number, name))
        for limit, key in (
            (limits.joint_force, "force"),
            (limits.penetration or model.assembly.system.contacts[number].clearance, "penetration"),
        ):
            if limit:
                checks.append(Check.of(told[f"max_{key}"], f"{key}.{name}", limit, "<=", f"largest {key} in joint {name!r}", (name,)))
    return Answer(values, tuple(tables), (*checks, settled_check("settled.joints", values.values())), unsettled(values))


def _pin_values(model, name):
    """{key: Value} of one pin with play."""
    found = statistics(model)
    told = {
        "max_force": Value.of(found.of_run(f"{name}.force"), "N", f"largest force in joint {name!r}"),
        "max_penetration": Value.of(found.of_run(f"{name}.depth"), "m", f"largest penetration in joint {name!r}"),
        "impacts_per_turn": Value.of(found.mean(f"{name}.hits"), "-", f"impacts of joint {name!r}"),
        "contact_share": Value.of(found.mean(f"{name}.touching"), "-", f"share of the time in which joint {name!r} touches"),
        "friction_power": Value.of(found.mean(f"{name}.lost"), "W", f"mean power lost by friction in joint {name!r}"),
    }
    return told if model.period else {key: value for key, value in told.items() if key != "impacts_per_turn"}


def _impact_table(model, run):
    t, pin, speed = run.impacts.T
    return Table(
        "impacts",
        "Impacts",
        (
            Column("time", "s", "time of the impact", t),
            Column("joint", "-", "joint", np.array(model.pins)[pin.astype(int)]),
            Column("speed", "m/s", "speed of approach", speed),
        ),
    )


def _pin_table(model, seen, number, name):
    pin = dict(zip(PIN_FIELDS, np.moveaxis(seen.pins[:, number], 1, 0), strict=True))
    clearance = model.assembly.system.contacts[number].clearance
    away = clearance + pin["depth"]  # distance of the centres
    return Table(
        f"pin.{name}",
        f"Joint {name!r} over the last turn" if model.period else f"Joint {name!r}",
        (
            *cycle_columns(model, seen.t),
            Column("x", "m", "journal's centre from the bearing's, x", -away * pin["nx"]),
            Column("y", "m", "journal's centre from the bearing's, y", -away * pin["ny"]),
            Column("depth", "m", "penetration, below 0 in flight", pin["depth"]),
            Column("force", "N", "force between journal and bearing", np.hypot(pin["fx"], pin["fy"])),
            Column("force_x", "N", "force on the journal's body, x", -pin["fx"]),
            Column("force_y", "N", "force on the journal's body, y", -pin["fy"]),
            Column("slip", "m/s", "sliding speed", pin["slip"]),
            Column("contact", "-", "1 in contact, 0 in flight", (pin["depth"] > 0).astype(float)),
        ),
    )
