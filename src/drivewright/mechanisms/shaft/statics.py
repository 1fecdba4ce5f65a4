"""The loaded shaft: deflections, reactions, forces and stresses along it."""

import numpy as np

from drivewright import shafts
from drivewright.mechanisms.shaft.refusals import is_rolling
from drivewright.result import Answer, Check, Column, Table, Value
from drivewright.shafts.beam import FREEDOMS

FINE = 21  # places along the shaft for its buckling
BALANCED = 1e-9  # of all forces; Newton's method stops at 1e-11
NO_FORCE = 1e-9  # of the largest load
SAMPLES = 241  # along the shaft, besides the nodes


def statics(model, done):
    """Equilibrium under all loads; `data` is the `Loaded` shaft for the analyses that start from it."""
    loaded = shafts.load(model.shaft, model.loads)
    checks = (*_slenderness(model),)
    values = {
        f"bearings.{m.support.name}.{key}": value
        for m, b in zip(loaded.equilibrium.model.mounts, model.spec.bearings, strict=True)
        if not is_rolling(b) and b.radial_stiffness not in (None, np.inf) and not b.radial_clearance
        for key, value in _linear_stiffness(m.support).items()
    }
    if not model.loaded:
        return Answer(
            values,
            (),
            checks,
            ("there are no loads: deflections and stresses are absent, flexibility is that of the unloaded shaft",),
            data=loaded,
        )
    drawn = shafts.diagram(loaded, SAMPLES)
    values |= _stations(model, loaded) | _bearings(model, loaded) | _extremes(model, drawn)
    return Answer(
        values, (_diagram_table(model, drawn), _reaction_table(model, loaded)), (*checks, *_checks(model, loaded, drawn)), data=loaded
    )


def _linear_stiffness(support):
    radial = support.stiffness[0]
    return {
        "stiffness.tangent": Value(radial, "N/m", f"change of radial force over displacement of bearing {support.name!r}, at any load"),
        "stiffness.secant": Value(radial, "N/m", f"radial force over displacement of bearing {support.name!r}, at any load"),
    }


def with_load(model, vector):
    """Component of a vector (x, y) along the unit loads."""
    return float(np.dot(model.direction, vector))


def _stations(model, loaded):
    found, u = loaded.equilibrium.model.beam, loaded.equilibrium.u
    values = {}
    for station in model.shaft.stations:
        at, name = FREEDOMS * found.node(station.position), f"stations.{station.name}"
        move, slope = u[at : at + 2], np.array([u[at + 4], -u[at + 3]])
        place = f"of station {station.name!r}"
        values |= {
            f"{name}.deflection": Value(with_load(model, move), "m", f"deflection {place} along the unit loads: positive with the load"),
            f"{name}.displacement": Value(float(np.hypot(*move)), "m", f"deflection {place}, magnitude"),
            f"{name}.deflection_x": Value(float(move[0]), "m", f"deflection {place} along x"),
            f"{name}.deflection_y": Value(float(move[1]), "m", f"deflection {place} along y (up)"),
            f"{name}.slope": Value(with_load(model, slope), "rad", f"slope {place}, positive where the deflection grows with z"),
        }
    return values


def _bearings(model, loaded):
    values = {}
    for mount, reaction, moved in zip(
        loaded.equilibrium.model.mounts, loaded.equilibrium.reactions, loaded.equilibrium.relative, strict=True
    ):
        name, at = f"bearings.{mount.support.name}", f"of bearing {mount.support.name!r}"
        slope = slope_at(loaded, mount.support.position)
        values |= {
            f"{name}.reaction": Value(
                -with_load(model, reaction[:2]), "N", f"radial reaction {at} on the shaft along the unit loads, positive against the load"
            ),
            f"{name}.reaction_x": Value(reaction[0], "N", f"reaction {at} on the shaft along x"),
            f"{name}.reaction_y": Value(reaction[1], "N", f"reaction {at} on the shaft along y"),
            f"{name}.radial_force": Value(float(np.hypot(*reaction[:2])), "N", f"radial force {at}, magnitude"),
            f"{name}.displacement": Value(
                with_load(model, moved[:2]), "m", f"displacement of the shaft in bearing {mount.support.name!r}, positive with the load"
            ),
            f"{name}.slope": Value(float(np.hypot(*slope)), "rad", f"slope of the shaft in bearing {mount.support.name!r}, magnitude"),
        }
        if abs(reaction[2]) > 0:
            values[f"{name}.axial_force"] = Value(reaction[2], "N", f"axial reaction {at} on the shaft, positive to the right")
        if np.any(np.abs(reaction[3:]) > 1e-12 * (1 + np.abs(reaction[:2]).max())):
            values[f"{name}.moment"] = Value(float(np.hypot(*reaction[3:])), "N m", f"moment {at} on the shaft, magnitude")
    return values


def slope_at(loaded, position):
    """Slope (x, y) of the shaft at a place with a node."""
    at = FREEDOMS * loaded.equilibrium.model.beam.node(position)
    return np.array([loaded.equilibrium.u[at + 4], -loaded.equilibrium.u[at + 3]])


def _extremes(model, drawn):
    told = (
        ("max_deflection", np.hypot(*drawn.deflection.T), "m", "largest deflection along the shaft"),
        ("max_moment", np.hypot(*drawn.moment.T), "N m", "largest bending moment"),
        ("max_stress", drawn.von_mises, "Pa", "largest von Mises stress, nominal: without notches"),
    )
    values = {}
    for name, data, unit, meaning in told:
        at = int(np.argmax(data))
        values |= {
            f"shaft.{name}": Value(float(data[at]), unit, meaning),
            f"shaft.{name}.at": Value(float(drawn.z[at]), "m", f"where {name} is"),
        }
    return values


def _checks(model, loaded, drawn):
    limits, shock = model.spec.limits, model.spec.limits.shock_factor
    stress, under = float(drawn.von_mises.max()), f", at {shock:g} times the load" if shock > 1 else ""
    if model.yield_strength and stress > 0:
        yield Check(
            "yield_safety",
            model.yield_strength / (shock * stress),
            limits.yield_safety,
            ">=",
            "-",
            f"yield strength over the largest nominal stress{under}",
            ("shaft",),
        )
    yield Check(
        "equilibrium",
        shafts.imbalance(loaded, model.loads),
        BALANCED,
        "<=",
        "-",
        "forces and moments on the shaft that do not balance, over the sum of all",
        ("shaft",),
    )
    yield Check(
        "small_deflections",
        _farthest(loaded, drawn) / model.shaft.length,
        limits.largest_deflection,
        "<=",
        "-",
        "largest deflection over the length of the shaft: beyond it the linear theory does not hold",
        ("shaft",),
    )
    slope = float(np.hypot(*drawn.slope.T).max())
    yield Check(
        "small_slopes", slope, limits.largest_slope, "<=", "rad", "largest slope: beyond it the linear theory does not hold", ("shaft",)
    )
    pressed = drawn.axial.min() < -NO_FORCE * np.abs(loaded.force).max(initial=0)
    factor = shafts.buckling_factor(shafts.load(model.shaft, model.loads, np.linspace(0.0, model.shaft.length, FINE))) if pressed else None
    if factor is not None:
        yield Check(
            "buckling",
            factor / shock,
            limits.buckling,
            ">=",
            "-",
            f"axial force at which the shaft buckles over the axial force{under}",
            ("shaft",),
        )
    for station in model.shaft.stations if limits.deflection else ():
        at = FREEDOMS * loaded.equilibrium.model.beam.node(station.position)
        size = float(np.hypot(*loaded.equilibrium.u[at : at + 2]))
        yield Check(f"deflection.{station.name}", size, limits.deflection, "<=", "m", f"deflection of station {station.name!r}", ("shaft",))
    for bearing, reaction in zip(model.spec.bearings, loaded.equilibrium.reactions, strict=True):
        yield from _bearing_checks(model, loaded, bearing, float(np.hypot(*reaction[:2])), under)


def _farthest(loaded, drawn):
    """The largest displacement of the shaft, across or along its axis."""
    found, u = loaded.equilibrium.model.beam, loaded.equilibrium.u
    return float(max(np.hypot(*drawn.deflection.T).max(), np.abs(u[2 : found.size : FREEDOMS]).max()))


def _bearing_checks(model, loaded, bearing, force, under):
    limits = model.spec.limits
    if limits.slope:
        slope = float(np.hypot(*slope_at(loaded, bearing.position)))
        yield Check(
            f"slope.{bearing.name}", slope, limits.slope, "<=", "rad", f"slope of the shaft in bearing {bearing.name!r}", (bearing.name,)
        )
    if bearing.static_rating and force > 0:  # of a rolling bearing beside the check of its pressure
        name = "static_rating" if bearing.name in model.rolling else "static_safety"
        yield Check(
            f"{name}.{bearing.name}",
            bearing.static_rating / (limits.shock_factor * force),
            limits.static_safety,
            ">=",
            "-",
            f"static rating of bearing {bearing.name!r} over its radial force{under}",
            (bearing.name,),
        )


def _slenderness(model):
    """Whether a length may have been given in a wrong unit."""
    ratio = model.shaft.length / min(min(s.start, s.end) for s in model.shaft.sections)
    limits, message = model.spec.limits, "length of the shaft over its least diameter; far off, a unit may have slipped"
    yield Check("slenderness", ratio, limits.slenderness, "<=", "-", message, ("shaft",))
    yield Check("stockiness", ratio, limits.stockiness, ">=", "-", message, ("shaft",))


def _diagram_table(model, drawn):
    pairs = (
        ("deflection", drawn.deflection, "m", "deflection"),
        ("slope", drawn.slope, "rad", "slope"),
        ("shear", drawn.shear, "N", "shear force"),
        ("moment", drawn.moment, "N m", "bending moment"),
    )
    columns = [Column("z", "m", "distance from the left end", drawn.z)]
    for name, data, unit, meaning in pairs:
        columns += [
            Column(name, unit, f"{meaning}, in the direction of the unit loads", data @ model.direction),
            Column(
                f"{name}_across",
                unit,
                f"{meaning}, square to it: a quarter of a turn clockwise",
                data @ [model.direction[1], -model.direction[0]],
            ),
        ]
    columns += [
        Column("axial", "N", "axial force, tension positive", drawn.axial),
        Column("torque", "N m", "torque", drawn.torque),
        Column("bending_stress", "Pa", "nominal stress by bending and tension", drawn.bending),
        Column("torsion_stress", "Pa", "nominal shear stress by torsion", drawn.torsion),
        Column("stress", "Pa", "von Mises stress, nominal", drawn.von_mises),
    ]
    return Table("diagram", "The loaded shaft along its length", tuple(columns))


def _reaction_table(model, loaded):
    reactions, moved = loaded.equilibrium.reactions, loaded.equilibrium.relative
    names = np.array([bearing.name for bearing in model.spec.bearings])
    units, told = ("N", "N", "N", "N m", "N m"), ("along x", "along y", "along z", "moment about x", "moment about y")
    columns = [Column("bearing", "-", "bearing", names)]
    columns += [
        Column(f"reaction_{key}", unit, f"reaction on the shaft, {words}", reactions[:, i])
        for i, (key, unit, words) in enumerate(zip(("x", "y", "z", "tilt_x", "tilt_y"), units, told, strict=True))
    ]
    columns += [
        Column(f"displacement_{key}", unit, f"of the shaft against the seat, {key}", moved[:, i])
        for i, (key, unit) in enumerate(zip(("x", "y", "z", "tilt_x", "tilt_y"), ("m", "m", "m", "rad", "rad"), strict=True))
    ]
    return Table("reactions", "Bearings under load", tuple(columns))
