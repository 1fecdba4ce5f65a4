"""Answers about a shaft as values and arrays of a result; `direction` is the unit vector (x, y) of the unit loads."""

from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from drivewright._typing import Floats
from drivewright.result import Array, Value
from drivewright.shafts.equilibrium import ShaftEquilibrium
from drivewright.shafts.influence import Flexibility
from drivewright.shafts.loaded import Diagram
from drivewright.shafts.mode_shapes import first_mode_along
from drivewright.shafts.model import Station
from drivewright.shafts.sensitivity import FlexibilitySlope
from drivewright.shafts.strength import LimitLoad
from drivewright.shafts.supports import SupportStiffness
from drivewright.shafts.tables import station_pairs
from drivewright.shafts.vibration import CriticalSpeeds, Modes

NO_MOMENT = 1e-12  # [N m] over the radial reaction [N] + 1 N: what rounding leaves


def station_values(equilibrium: ShaftEquilibrium, direction: Floats) -> dict[str, Value]:
    """Deflection [m] and slope [rad] of every station."""
    values = {}
    for station in equilibrium.model.beam.shaft.stations:
        move, slope = equilibrium.displacement_at(station.position), equilibrium.slope_at(station.position)
        name, at = f"stations.{station.name}", f"of station {station.name!r}"
        along = f"deflection of {station.name!r} along unit loads"
        rising = "positive where the deflection grows with z"
        values |= {
            f"{name}.deflection": Value(float(np.dot(direction, move)), "m", along, convention="positive with the load"),
            f"{name}.displacement": Value(float(np.hypot(*move)), "m", f"deflection {at}, magnitude"),
            f"{name}.deflection_x": Value(float(move[0]), "m", f"deflection {at} along x"),
            f"{name}.deflection_y": Value(float(move[1]), "m", f"deflection {at} along y", convention="positive up"),
            f"{name}.slope": Value(float(np.dot(direction, slope)), "rad", f"slope {at}", convention=rising),
        }
    return values


def support_values(equilibrium: ShaftEquilibrium, direction: Floats, along: str = "along unit loads") -> dict[str, Value]:
    """Reaction [N, N m] of every support on the shaft, displacement [m] and slope [rad] of the shaft in it; `along` names the direction."""
    values = {}
    supports = equilibrium.model.beam.shaft.supports
    for support, reaction, moved in zip(supports, equilibrium.reactions, equilibrium.relative, strict=True):
        name, at, inside = f"bearings.{support.name}", f"of bearing {support.name!r}", f"of the shaft in bearing {support.name!r}"
        slope, words = float(np.hypot(*equilibrium.slope_at(support.position))), f"reaction of {support.name!r} {along}, on the shaft"
        radial, displacement = -float(np.dot(direction, reaction[:2])), float(np.dot(direction, moved[:2]))
        values |= {
            f"{name}.reaction": Value(radial, "N", words, convention="positive against the load"),
            f"{name}.reaction_x": Value(reaction[0], "N", f"reaction {at} along x, on the shaft"),
            f"{name}.reaction_y": Value(reaction[1], "N", f"reaction {at} along y, on the shaft"),
            f"{name}.radial_force": Value(float(np.hypot(*reaction[:2])), "N", f"radial force {at}, magnitude"),
            f"{name}.displacement": Value(
                displacement,
                "m",
                f"displacement in bearing {support.name!r}, of the shaft against the seat",
                convention="positive with the load",
            ),
            f"{name}.slope": Value(slope, "rad", f"slope {inside}, magnitude"),
        }
        if abs(reaction[2]) > 0:
            values[f"{name}.axial_force"] = Value(
                reaction[2], "N", f"axial reaction {at}, on the shaft", convention="positive to the right"
            )
        if np.any(np.abs(reaction[3:]) > NO_MOMENT * (1 + np.abs(reaction[:2]).max())):
            values[f"{name}.moment"] = Value(float(np.hypot(*reaction[3:])), "N m", f"moment {at} on the shaft, magnitude")
    return values


def extreme_values(along: Diagram) -> dict[str, Value]:
    """The largest deflection [m], bending moment [N m] and stress [Pa] along the shaft, and where [m] they are."""
    values = {}
    for name, data, unit, what, more in (
        ("max_deflection", np.hypot(*along.deflection.T), "m", "maximum deflection", " along the shaft"),
        ("max_moment", np.hypot(*along.moment.T), "N m", "maximum bending moment", ""),
        ("max_stress", along.von_mises, "Pa", "maximum von Mises stress", ", nominal: without notches"),
    ):
        at = int(np.argmax(data))
        values[f"shaft.{name}"] = Value(float(data[at]), unit, what + more)
        values[f"shaft.{name}.at"] = Value(float(along.z[at]), "m", f"position of the {what}")
    return values


def stiffness_values(name: str, stiffness: SupportStiffness) -> dict[str, Value]:
    """The `SupportStiffness` of the support of this name, with the load behind it; nothing where there is no load."""
    rows = (
        ("load", stiffness.load, "N", f"operating load of bearing {name!r}, the radial force to which its stiffness belongs"),
        (
            "tangent",
            stiffness.tangent,
            "N/m",
            f"tangent stiffness of bearing {name!r}, radial: change of force over change of displacement, all else held",
        ),
        ("secant", stiffness.secant, "N/m", f"secant stiffness of bearing {name!r}, radial: force over displacement from the seat's axis"),
        ("axial", stiffness.axial, "N/m", f"axial stiffness of bearing {name!r}, tangent"),
        ("tilt_x", stiffness.tilt_x, "N m/rad", f"tilt stiffness x of bearing {name!r}, tangent, about x"),
        ("tilt_y", stiffness.tilt_y, "N m/rad", f"tilt stiffness y of bearing {name!r}, tangent, about y"),
    )
    values = {f"bearings.{name}.stiffness.{key}": Value(value, unit, meaning) for key, value, unit, meaning in rows if np.isfinite(value)}
    return values if stiffness.tangent > 0 else {}


def pair_values(key: str, names: Sequence[str], matrix: Floats, unit: str, meaning: str) -> dict[str, Value]:
    """`key.A.B` of a symmetric matrix (stations, stations) for every pair; the meaning says {a!r} and {b!r} where it names them."""
    return {
        f"{key}.{names[i]}.{names[j]}": Value(float(matrix[i, j]), unit, meaning.format(a=names[i], b=names[j]))
        for i, j in station_pairs(names)
    }


def station_array(names: tuple[str, ...], matrix: Floats, unit: str) -> Array:
    """A matrix (stations, stations) as an array of the result."""
    return Array(unit, ("station", "station"), (names, names), matrix)


def flexibility_arrays(found: Flexibility, stations: tuple[str, ...], supports: tuple[str, ...]) -> dict[str, Array]:
    """The `Flexibility`, its parts and the reactions under unit forces as arrays, by the names of stations and supports."""
    return {
        "flexibility": station_array(stations, found.delta, "m/N"),
        "flexibility.shares": Array("m/N", ("part", "station", "station"), (found.names, stations, stations), found.shares),
        "reactions.unit_load": Array("-", ("bearing", "station"), (supports, stations), found.reactions),
    }


def limit_values(station: str, limits: Sequence[LimitLoad], shock_factor: float) -> dict[str, Value]:
    """The least of the `LimitLoad`s of a force at a station of this name, and the steady force [N] that is allowed there."""
    first = min(limits, key=lambda limit: limit.force)
    name, at_limit = f"stations.{station}", f"limit force at {station!r}, acting alone, limited by {first.part}"
    allowed = f"allowable force at {station!r}, steady and acting alone, with the shock factor {shock_factor:g}"
    return {
        f"{name}.limit_load": Value(first.force, "N", at_limit),
        f"{name}.allowed_load": Value(first.force / shock_factor, "N", allowed),
    }


def sensitivity_values(slopes: Iterable[FlexibilitySlope], names: Sequence[str]) -> dict[str, Value]:
    """Every finite entry of `relative_flexibility_slopes` [-], by pair of stations and parameter."""
    values = {}
    for parameter, held, slope in slopes:
        short, words = _parameter_words(parameter)
        for i, j in station_pairs(names):
            if np.isfinite(slope[i, j]):
                pair = f"at {names[i]}" if i == j else f"{names[i]}/{names[j]}"
                meaning = f"relative change of flexibility {names[i]}/{names[j]} over relative change of {words}; {held}"
                values[f"sensitivity.{names[i]}.{names[j]}.{parameter}"] = Value(
                    float(slope[i, j]), "-", meaning, label=f"Sensitivity {pair}, {short}"
                )
    return values


def _parameter_words(parameter: str) -> tuple[str, str]:
    """A parameter of a `FlexibilitySlope` for a label and in words: "bearings.A.stiffness" -> "bearing A", "stiffness of bearing A"."""
    table, _, rest = parameter.partition(".")
    name = rest.rpartition(".")[0]
    if table == "distance":
        return rest, f"distance {rest}"
    if table == "stations":
        return f"station {name}", f"position of station {name}"
    if table == "segments":
        return f"segment {int(name) + 1}", f"diameter of segment {int(name) + 1}"
    if table == "bearings":
        return (f"bearing {name}", f"stiffness of bearing {name}") if name else ("all bearings", "stiffness of all bearings")
    return "Young's modulus", "Young's modulus"


def frequency_values(
    bending: Floats, axial: Floats, torsional: Floats, critical: CriticalSpeeds, lowest_excited: float | None = None
) -> dict[str, Value]:
    """Natural frequencies [Hz] of bending, along the axis and of torsion, and critical speeds [rad/s], each numbered from 1; beside them
    the lowest critical speed that an unbalance excites."""
    rows = (
        ("modes", ".frequency", "Hz", "natural frequency {n} of bending, at rest", bending),
        ("axial_modes", ".frequency", "Hz", "natural frequency {n} along the axis, at rest", axial),
        ("critical_speeds.forward", "", "rad/s", "forward critical speed {n}, whirling with the shaft", critical.forward),
        ("critical_speeds.backward", "", "rad/s", "backward critical speed {n}, whirling against the shaft", critical.backward),
        ("torsional_modes", ".frequency", "Hz", "natural frequency {n} of torsion, of the free shaft", torsional),
    )
    values = {
        f"{key}.{n}{suffix}": Value(float(number), unit, meaning.format(n=n))
        for key, suffix, unit, meaning, numbers in rows
        for n, number in enumerate(numbers, 1)
    }
    if lowest_excited:
        meaning = "lowest unbalance-excited critical speed: forward whirl, also backward whirl for anisotropic bearings"
        values["critical_speeds.lowest"] = Value(lowest_excited, "rad/s", meaning)
    return values


def massless_values(frequencies: Floats) -> dict[str, Value]:
    """Natural frequencies [Hz] of `massless_frequencies`, numbered from 1."""
    return {
        f"massless_modes.{n}.frequency": Value(float(each), "Hz", f"natural frequency {n} on a massless shaft, of the stations' masses")
        for n, each in enumerate(frequencies, 1)
    }


def massless_findings(frequencies: Floats, modes: Modes, stations: Sequence[Station], direction: Floats) -> Iterator[str]:
    """How far the lowest of `massless_frequencies` is from the first mode along `direction`; nothing where stations have inertia."""
    along = first_mode_along(modes, direction)
    if along is not None and not any(station.diametral for station in stations):
        error = frequencies[0] / modes.frequencies[along] - 1
        yield (
            "neglecting the shaft's own mass (K = inverse of the flexibility) changes the frequency of "
            f"mode {along + 1} by {100 * error:+.1f} %"
        )
