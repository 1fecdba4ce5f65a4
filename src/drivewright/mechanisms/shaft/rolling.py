"""The rolling bearings under the shaft's load: stiffness with the load behind it, load distribution, pressure, life."""

import numpy as np

from drivewright import bearings
from drivewright.errors import InputError, SolverError
from drivewright.mechanisms.shaft.refusals import is_rolling
from drivewright.result import Answer, Check, Column, Table, Value

LEAST_E = 0.19  # axial over radial force up to which P = Fr in every deep-groove bearing (ISO 281, recalled)
LOADS = np.geomspace(0.02, 4.0, 25)  # of the curve of stiffness, over the bearing's load


def no_rolling(spec):
    return None if any(is_rolling(b) or b.table or b.radial_clearance for b in spec.bearings) else "all bearings are linear springs"


def rolling(model, done):
    """Every bearing that is not linear, at the equilibrium of the loads."""
    at_rest = done["statics"].data.equilibrium
    values, tables, checks, findings = {}, [], [], []
    for number, mount in enumerate(at_rest.model.mounts):
        if mount.support.law is None:
            continue
        found = _stiffness(model, at_rest, number)
        values |= found
        if not found:
            findings.append(f"stiffness of bearing {mount.support.name!r} is absent: nothing loads it")
        inner = model.rolling.get(mount.support.name)
        if inner is not None and _is_idle(at_rest, number):
            findings.append(f"bearing {mount.support.name!r} carries nothing under these loads")
        elif inner is not None:
            state = bearings.solve(inner, displacement=mount.rows @ at_rest.unknowns - mount.support.offset)
            values |= _elements(model, mount.support.name, inner, state)
            tables += [_element_table(mount.support.name, state), *_curve(model, mount.support.name, inner, state)]
            checks += _checks(model, mount.support.name, inner, state)
            findings += _findings(mount.support.name, inner, state)
    return Answer(values, tuple(tables), tuple(checks), tuple(findings))


def _is_idle(at_rest, number):
    """Whether a bearing carries no more than rounding leaves to it."""
    forces = np.abs(at_rest.reactions[:, :3])
    return not forces[number].max() > 1e-9 * forces.max()


def _stiffness(model, at_rest, number):
    """Tangent along the radial reaction and secant, with the load behind them; nothing where there is no load."""
    force, moved = -at_rest.reactions[number, :2], at_rest.relative[number, :2]
    size, name = float(np.hypot(*force)), at_rest.model.mounts[number].support.name
    way = force / size if size > 0 else model.direction
    tangent = float(way @ at_rest.tangent[number, :2, :2] @ way)
    values = {f"bearings.{name}.stiffness.load": Value(size, "N", f"radial force of bearing {name!r} behind its stiffness")}
    if tangent > 0:
        values[f"bearings.{name}.stiffness.tangent"] = Value(
            tangent, "N/m", f"change of radial force over displacement of bearing {name!r}, all else held"
        )
    if size > 0 and way @ moved > 0:
        values[f"bearings.{name}.stiffness.secant"] = Value(
            size / float(way @ moved), "N/m", f"radial force over displacement of bearing {name!r}, from the seat's axis"
        )
    for freedom, key, unit in ((2, "axial", "N/m"), (3, "tilt_x", "N m/rad"), (4, "tilt_y", "N m/rad")):
        own = float(at_rest.tangent[number, freedom, freedom])
        if np.isfinite(own):
            values[f"bearings.{name}.stiffness.{key}"] = Value(
                own, unit, f"tangent stiffness of bearing {name!r}, {key.replace('_', ' about ')}"
            )
    return values if tangent > 0 else {}


def _elements(model, name, inner, state):
    about, unit = f"of bearing {name!r}", f"bearings.{name}"
    loaded = int(np.sum(state.element_loads > 0))
    values = {
        f"{unit}.max_element_load": Value(float(state.element_loads.max()), "N", f"load of the most loaded rolling element {about}"),
        f"{unit}.max_pressure": Value(float(state.pressures.max()), "Pa", f"largest Hertz pressure {about}"),
        f"{unit}.loaded_elements": Value(float(loaded), "-", f"rolling elements under load {about}"),
    }
    if state.pressures.max() > 0:
        values[f"{unit}.static_safety"] = Value(
            static_safety(inner, state), "-", f"load at the permissible static pressure over the load {about}"
        )
    values |= _basic_life(name, inner, state)
    life = state.reference_life
    if life is not None and np.isfinite(life):
        values[f"{unit}.reference_life"] = Value(float(life), "-", f"reference life L10r {about}, revolutions")
        if model.spec.drive:
            values[f"{unit}.reference_life.time"] = Value(
                float(life) * 2 * np.pi / model.spec.drive.speed, "s", f"the same {about} at the shaft's speed"
            )
    return values


def _basic_life(name, inner, state):
    """L10 of ISO 281 where the equivalent load is the radial one: no axial force that counts, no contact angle."""
    radial, axial = float(np.hypot(*state.force[:2])), abs(state.force[2])
    if inner.dynamic_rating is None or inner.contact_angle or not radial > 0 or axial > LEAST_E * radial:
        return {}
    return {
        f"bearings.{name}.basic_life": Value(
            float(bearings.basic_life(inner, radial)),
            "-",
            f"basic life L10 (ISO 281) of bearing {name!r}, revolutions, at P = its radial force",
        )
    }


def static_safety(inner, state):
    """(permissible pressure / pressure)^3 of balls, ^2 of rollers: how many times the load would reach the static rating."""
    pressure, power = bearings.PERMISSIBLE[bearings.contact_of(inner)]
    return float((pressure / state.pressures.max()) ** power)


def _checks(model, name, inner, state):
    limits = model.spec.limits
    shock = limits.shock_factor
    if state.pressures.max() > 0:
        under = f", at {shock:g} times the load" if shock > 1 else ""
        yield Check(
            f"static_safety.{name}",
            static_safety(inner, state) / shock,
            limits.static_safety,
            ">=",
            "-",
            f"static load of bearing {name!r} by its contact pressure over its load{under}",
            (name,),
        )
    life = state.reference_life
    if limits.life and model.spec.drive and life is not None and np.isfinite(life):
        seconds = float(life) * 2 * np.pi / model.spec.drive.speed
        yield Check(
            f"life.{name}",
            seconds,
            limits.life,
            ">=",
            "s",
            f"reference life of bearing {name!r}: {seconds / 3600:.4g} h of {limits.life / 3600:.4g} h",
            (name,),
        )


def _findings(name, inner, state):
    if inner.dynamic_rating is None:
        yield f"life of bearing {name!r} is absent: it has no dynamic_rating"
    if inner.contact_angle and getattr(state, "reversed_elements", 0):
        yield (
            f"bearing {name!r}: {state.reversed_elements} of its elements bear on the side that an angular-contact bearing does not have; "
            "it needs more preload or axial load, or turn it round (carries)"
        )


def _element_table(name, state):
    n = len(state.element_loads)
    return Table(
        f"elements.{name}",
        f"Rolling elements of bearing {name}",
        (
            Column(
                "angle", "rad", "place of the element, from x towards y", 2 * np.pi * np.arange(n + 1) / n + state.bearing.first_element
            ),
            Column("load", "N", "load", _round(state.element_loads)),
            Column("contact_angle", "rad", "contact angle", _round(state.contact_angles)),
            Column("inner_pressure", "Pa", "peak pressure at the inner race", _round(state.pressures[:, 0])),
            Column("outer_pressure", "Pa", "peak pressure at the outer race", _round(state.pressures[:, 1])),
        ),
    )


def _round(data):
    """Once round: the first element again at the end."""
    return np.concatenate([data, data[:1]])


def _curve(model, name, inner, state):
    """Displacement and stiffness over the load, its direction kept."""
    force = state.force * [1, 1, 1, 0, 0]
    if not np.hypot(*force[:2]) > 0:
        return
    way, rows = force[:2] / np.hypot(*force[:2]), []
    held = ("tilt_x", "tilt_y") + (() if bearings.contact_of(inner) == "point" or inner.contact_angle else ("z",))
    for factor in LOADS:
        try:
            found = bearings.solve(inner, force=factor * np.where([True, True, "z" not in held, True, True], force, 0.0), held=held)
        except (InputError, SolverError):
            return
        moved = float(way @ found.displacement[:2])
        load = factor * float(np.hypot(*force[:2]))
        rows.append((load, moved, float(way @ found.stiffness[:2, :2] @ way), load / moved if moved > 0 else np.nan))
    load, moved, tangent, secant = np.array(rows).T
    yield Table(
        f"curve.{name}",
        f"Bearing {name} over its load",
        (
            Column("load", "N", "radial force, axial force in proportion", load),
            Column("displacement", "m", "radial displacement", moved),
            Column("tangent", "N/m", "tangent stiffness", tangent),
            Column("secant", "N/m", "secant stiffness", secant),
        ),
    )
