"""Flexibility and stiffness at the stations, who contributes what, and what fails first."""

import numpy as np

from drivewright import bearings, shafts
from drivewright.errors import InputError
from drivewright.mechanisms.shaft.refusals import is_rolling
from drivewright.mechanisms.shaft.statics import BALANCED
from drivewright.result import Answer, Array, Check, Column, Table, Value
from drivewright.shafts.unit_loads import SAMPLES, flexibility_on_rigid_bearings, peak_unit_stress, unit_deflection

NO_STRESS = 1e-9  # of a force over the square of the shaft's length: that at a station on a bearing is rounding


def no_stations(spec):
    return None if spec.stations else "the spec declares no [[stations]]"


def flexibility(model, done):
    """Flexibility, its shares, stiffness, reactions per unit load, at the equilibrium of the loads; `data` is the `Flexibility`."""
    at_rest = done["statics"].data.equilibrium
    try:
        found = shafts.flexibility(at_rest, model.places, model.direction)
    except InputError as error:
        return Answer(findings=(f"flexibility and stiffness are absent: {error}",), outcome="left out")
    labels, bearings = model.names, tuple(support.name for support in model.shaft.supports)
    arrays = {
        "flexibility": Array("m/N", ("station", "station"), (labels, labels), found.delta),
        "flexibility.shares": Array("m/N", ("part", "station", "station"), (found.names, labels, labels), found.shares),
        "reactions.unit_load": Array("-", ("bearing", "station"), (bearings, labels), found.reactions),
    }
    values = {
        f"flexibility.{a}.{b}": Value(float(found.delta[i, j]), "m/N", f"displacement of {a!r} by a unit force at {b!r}")
        for i, a in enumerate(labels)
        for j, b in enumerate(labels)
        if j >= i
    }
    findings = []
    try:
        stiff = shafts.stiffness(found.delta, labels)
        arrays["stiffness"] = Array("N/m", ("station", "station"), (labels, labels), stiff)
        values |= {
            f"stiffness.{a}.{b}": Value(float(stiff[i, j]), "N/m", f"force at {a!r} by a unit displacement of {b!r}, others held")
            for i, a in enumerate(labels)
            for j, b in enumerate(labels)
            if j >= i
        }
        values["condition_number"] = Value(found.condition, "-", "condition number of flexibility and stiffness")
    except InputError as error:
        findings.append(f"array 'stiffness' is absent: {error}")
    if any(support.law is not None for support in model.shaft.supports):
        findings.append("bearings are not linear: flexibility and stiffness are tangents at the equilibrium of the given loads")
    off = shafts.unit_imbalance(found, model.shaft, model.places, model.direction)
    check = Check(
        "equilibrium.unit_loads",
        off,
        BALANCED,
        "<=",
        "-",
        "forces and moments that do not balance under a unit force at a station, the largest",
        ("shaft",),
    )
    return Answer(values, (_unit_table(model, found, at_rest), _share_table(model, found)), (check,), tuple(findings), arrays, data=found)


def _unit_table(model, found, at_rest):
    """Deflection along the shaft under a unit force at each station, with the bearings as they are and rigid."""
    z = np.linspace(0.0, model.shaft.length, SAMPLES)
    columns = [Column("z", "m", "distance from the left end", z)]
    shown = [
        ("", "", at_rest, found),
        (", bearings rigid", ".rigid", *flexibility_on_rigid_bearings(model.shaft, model.places, model.direction)),
    ]
    for words, suffix, rest, answer in shown:
        for name, u in zip(model.names, answer.unknowns.T, strict=True):
            columns.append(Column(f"{name}{suffix}", "m/N", f"force at {name!r}{words}", unit_deflection(rest, u, z, model.direction)))
    return Table("unit_load", "Deflection by a unit force at a station", tuple(columns))


def _share_table(model, found):
    """One row for every flexibility entry and part."""
    pairs = [(i, j) for i in range(len(model.names)) for j in range(i, len(model.names))]
    entries = np.array([f"{model.names[i]}, {model.names[j]}" for i, j in pairs])
    columns = [Column("entry", "-", "stations", entries), Column("total", "m/N", "flexibility", np.array([found.delta[p] for p in pairs]))]
    columns += [
        Column(name, "m/N", name if number < 2 else f"bearing {name}" if name != "tension" else name, np.array([share[p] for p in pairs]))
        for number, (name, share) in enumerate(zip(found.names, found.shares, strict=True))
    ]
    return Table("shares", "Who contributes what to the flexibility", tuple(columns))


# -- what fails first ----------------------------------------------------------------------------------------------------------


def no_strength(spec):
    if no_stations(spec):
        return no_stations(spec)
    rated = any(b.static_rating or is_rolling(b) for b in spec.bearings)
    known = spec.material.yield_strength or spec.material.card
    return None if rated or known else "neither a static rating of a bearing nor a yield strength is given"


def failure(model, done):
    """For a force at each station alone: at which size a bearing reaches its static rating, and the shaft its yield strength."""
    found, at_rest = done["flexibility"].data, done["statics"].data.equilibrium
    shock, rows, values = model.spec.limits.shock_factor, [], {}
    for number, name in enumerate(model.names):
        limits = list(_limits(model, found, at_rest, number))
        if not limits:  # it stands on a bearing that has no rating
            continue
        what, least = min(limits, key=lambda row: row[1])
        values |= {
            f"stations.{name}.limit_load": Value(least, "N", f"force at {name!r} alone at which {what} is at its limit"),
            f"stations.{name}.allowed_load": Value(
                least / shock, "N", f"steady force at {name!r} alone that is allowed, with the shock factor {shock:g}"
            ),
        }
        rows += [(name, part, load, load / shock, load == least) for part, load in limits]
    if not rows:
        return Answer(findings=("what fails first is absent: no bearing has a static rating, and no yield strength is given",))
    names, parts, loads, steady, first = zip(*rows, strict=True)
    return Answer(
        values,
        (
            Table(
                "failure",
                "What fails first",
                (
                    Column("station", "-", "station of the force", np.array(names)),
                    Column("part", "-", "what reaches its limit", np.array(parts)),
                    Column("load", "N", "force at which it does", np.array(loads)),
                    Column("steady_load", "N", "the same over the shock factor", np.array(steady)),
                    Column("first", "-", "1 where it is the first", np.array(first, float)),
                ),
            ),
        ),
    )


def static_rating(model, bearing):
    """C0 of a bearing [N]: as given, of a rolling bearing else by its inner geometry; None where neither is known."""
    rolling = model.rolling.get(bearing.name)
    return bearing.static_rating if rolling is None else rolling.static_rating or bearings.geometric_static_rating(rolling)


def _limits(model, found, at_rest, station):
    """(what, force at the station) of every bearing with a rating and of the shaft."""
    for number, bearing in enumerate(model.spec.bearings):
        share = abs(found.reactions[number, station])
        if static_rating(model, bearing) and share > 1e-12:
            yield f"bearing {bearing.name}", static_rating(model, bearing) / share
    stress = peak_unit_stress(at_rest, found.unknowns[:, station], model.direction)
    if model.yield_strength and stress > NO_STRESS / model.shaft.length**2:
        yield "shaft, yield", model.yield_strength / stress
