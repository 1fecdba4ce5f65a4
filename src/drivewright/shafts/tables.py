"""Answers about a shaft as tables of a result; `direction` is the unit vector (x, y) of the unit loads."""

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from drivewright._typing import Floats
from drivewright.result import Column, Table
from drivewright.shafts.equilibrium import ShaftEquilibrium
from drivewright.shafts.influence import Flexibility
from drivewright.shafts.loaded import Diagram
from drivewright.shafts.mode_shapes import planar_shape
from drivewright.shafts.sensitivity import FlexibilitySlope
from drivewright.shafts.strength import LimitLoad
from drivewright.shafts.unit_loads import SAMPLES, flexibility_on_rigid_bearings, unit_deflection
from drivewright.shafts.vibration import Modes

UNIT_LOADS = ("along the unit loads", "across the unit loads, 90° clockwise from them")
PARTS = ("bending", "shear", "tension")  # of a flexibility; the others are bearings


def diagram_table(along: Diagram, direction: Floats, named: tuple[str, str] = UNIT_LOADS) -> Table:
    """The loaded shaft along its length: vectors along `direction` and 90° clockwise from it, as `named`; forces and stresses."""
    columns = [Column("z", "m", "distance from the left end", along.z)]
    for name, data, unit, meaning in (
        ("deflection", along.deflection, "m", "deflection"),
        ("slope", along.slope, "rad", "slope"),
        ("shear", along.shear, "N", "shear force"),
        ("moment", along.moment, "N m", "bending moment"),
    ):
        columns.append(Column(name, unit, f"{meaning} {named[0]}", data @ direction))
        across = data @ [direction[1], -direction[0]]
        columns.append(Column(f"{name}_across", unit, f"{meaning} {named[1]}", across))
    columns += [
        Column("axial", "N", "axial force, tension positive", along.axial),
        Column("torque", "N m", "torque", along.torque),
        Column("bending_stress", "Pa", "nominal stress from bending and tension", along.bending),
        Column("torsion_stress", "Pa", "nominal shear stress from torsion", along.torsion),
        Column("stress", "Pa", "von Mises stress, nominal", along.von_mises),
    ]
    return Table("diagram", "Loaded shaft along its length", tuple(columns))


def reaction_table(equilibrium: ShaftEquilibrium) -> Table:
    """A row for every support: reaction on the shaft and displacement in it."""
    keys, names = ("x", "y", "z", "tilt_x", "tilt_y"), [support.name for support in equilibrium.model.beam.shaft.supports]
    words = ("along x", "along y", "along z", "about x", "about y")
    columns = [Column("bearing", "-", "bearing", np.array(names))]
    for key, unit, way, data in zip(keys, ("N", "N", "N", "N m", "N m"), words, equilibrium.reactions.T, strict=True):
        columns.append(Column(f"reaction_{key}", unit, f"reaction {way}, on the shaft", data))
    for key, unit, way, data in zip(keys, ("m", "m", "m", "rad", "rad"), words, equilibrium.relative.T, strict=True):
        columns.append(Column(f"displacement_{key}", unit, f"displacement {way}, of the shaft against the seat", data))
    return Table("reactions", "Bearings under load", tuple(columns))


def unit_load_table(equilibrium: ShaftEquilibrium, flexibility: Flexibility, names: Sequence[str], direction: Floats) -> Table:
    """Deflection along the shaft under a unit force at each of its stations, with the bearings as they are and rigid."""
    shaft = equilibrium.model.beam.shaft
    z = np.linspace(0.0, shaft.length, SAMPLES)
    rigid = flexibility_on_rigid_bearings(shaft, [station.position for station in shaft.stations], direction)
    columns = [Column("z", "m", "distance from the left end", z)]
    for words, suffix, at_rest, each in (("", "", equilibrium, flexibility), (" on rigid bearings", ".rigid", *rigid)):
        for name, unknowns in zip(names, each.unknowns.T, strict=True):
            deflection = unit_deflection(at_rest, unknowns, z, direction)
            columns.append(Column(f"{name}{suffix}", "m/N", f"force at {name!r}{words}", deflection))
    return Table("unit_load", "Deflection under unit force at a station", tuple(columns))


def station_pairs(names: Sequence[str]) -> list[tuple[int, int]]:
    """Numbers (i, j >= i) of all pairs of stations: the entries of a symmetric matrix."""
    return [(i, j) for i in range(len(names)) for j in range(i, len(names))]


def share_table(flexibility: Flexibility, names: Sequence[str]) -> Table:
    """A row for every entry of the flexibility, a column for every part of it."""
    pairs = station_pairs(names)
    entries = np.array([f"{names[i]}, {names[j]}" for i, j in pairs])
    columns = [
        Column("entry", "-", "stations", entries),
        Column("total", "m/N", "flexibility", np.array([flexibility.delta[p] for p in pairs])),
    ]
    for name, share in zip(flexibility.names, flexibility.shares, strict=True):
        columns.append(Column(name, "m/N", name if name in PARTS else f"bearing {name}", np.array([share[p] for p in pairs])))
    return Table("shares", "Flexibility contributions", tuple(columns))


def sensitivity_table(slopes: Iterable[FlexibilitySlope], names: Sequence[str]) -> Table:
    """A row for every parameter of `relative_flexibility_slopes`, a column for every entry of the flexibility."""
    pairs = station_pairs(names)
    parameters, held, relative = zip(*slopes, strict=True)
    columns = [Column("parameter", "-", "parameter", np.array(parameters)), Column("held", "-", "held quantities", np.array(held))]
    for i, j in pairs:
        columns.append(
            Column(
                f"{names[i]}.{names[j]}",
                "-",
                f"sensitivity of {names[i]}/{names[j]}, relative change over relative change",
                np.array([each[i, j] for each in relative]),
            )
        )
    return Table("sensitivities", "Sensitivities of the flexibility", tuple(columns))


def limit_table(limits: Mapping[str, Sequence[LimitLoad]], shock_factor: float) -> Table:
    """A row for every one of the `LimitLoad`s of a force at a station, by the station's name; a station without any has no row."""
    rows = [(name, limit, limit.force == min(each.force for each in loads)) for name, loads in limits.items() for limit in loads]
    force = np.array([limit.force for _, limit, _ in rows])
    columns = (
        Column("station", "-", "station of the force", np.array([name for name, _, _ in rows])),
        Column("part", "-", "part at its limit", np.array([limit.part for _, limit, _ in rows])),
        Column("load", "N", "force at the limit", force),
        Column("steady_load", "N", "steady force, over the shock factor", force / shock_factor),
        Column("first", "-", "first to fail, 1 if so", np.array([first for _, _, first in rows], float)),
    )
    return Table("failure", "Limit loads at the stations", columns)


def mode_table(equilibrium: ShaftEquilibrium, modes: Modes) -> Table:
    """The shape of every mode over the nodes, each scaled to 1."""
    beam = equilibrium.model.beam
    columns = [Column("z", "m", "distance from the left end", beam.z)]
    for number, (frequency, shape) in enumerate(zip(modes.frequencies, modes.shapes.T, strict=True), 1):
        planar = planar_shape(beam, shape)
        plane = "" if planar.alone else f" along {planar.plane}"
        columns.append(Column(f"mode_{number}", "-", f"mode {number}, {frequency:.4g} Hz{plane}", planar.deflection))
    return Table("modes", "Shapes of the natural modes", tuple(columns))
