"""A rotor at speed as values, tables, findings and plots of a result: whirl, Campbell diagram, stability, unbalance response."""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from drivewright._typing import Floats
from drivewright.result import Column, Plot, Table, Value
from drivewright.shafts.unbalance import RESONANCE, Orbits, Unbalance
from drivewright.shafts.whirl import Campbell, CriticalSpeed, WhirlModes

LAG = ".lag"  # behind the name of a part
BACKWARD = "Dashed: backward whirl."  # caption of plots with both senses
SENSES = ((True, "forward", "with the shaft"), (False, "backward", "against the shaft"))
HERTZ = 1 / (2 * np.pi)


# -- whirl ---------------------------------------------------------------------------------------------------------------------


def whirl_values(modes: WhirlModes, damped: bool) -> dict[str, Value]:
    """`whirl.forward.N` and `whirl.backward.N` [rad/s], the N-th of each; where the supports damp with the logarithmic decrement [-]."""
    values, at = {}, f"at {modes.speed * 30 / np.pi:.6g} rpm"
    for forward, name, words in SENSES:
        for n, number in enumerate(modes.chosen(forward), 1):
            key, meaning = f"whirl.{name}.{n}", f"{name} whirl frequency {n}, {words}, {at}"
            values[key] = Value(float(modes.frequency[number]), "rad/s", meaning)
            if damped:
                meaning, sense = f"log decrement of {name} whirl {n}, {at}", "above 0 the whirl decays"
                values[f"{key}.log_decrement"] = Value(float(modes.log_decrement[number]), "-", meaning, convention=sense)
    return values


def critical_values(critical: Sequence[CriticalSpeed], damped: bool) -> dict[str, Value]:
    """`critical_speeds.damped.N` [rad/s] within the Campbell diagram, rising, with the amplification factor 1/(2 zeta) [-]."""
    values = {}
    for n, each in enumerate(critical if damped else (), 1):
        way = "with" if each.forward else "against"
        key = f"critical_speeds.damped.{n}"
        values[key] = Value(each.speed, "rad/s", f"damped critical speed {n}, whirling {way} the shaft")
        if each.damping_ratio > 0:
            meaning = f"amplification factor {n}, at damped critical speed {n}: 1/(2 damping ratio)"
            values[f"{key}.amplification"] = Value(0.5 / each.damping_ratio, "-", meaning)
    return values


def stability_values(modes: WhirlModes, threshold: float | None) -> dict[str, Value]:
    """The least logarithmic decrement at the speed [-], and the speed [rad/s] from which a whirl grows, where there is one."""
    least = float(modes.log_decrement.min())
    values = {"stability.log_decrement": Value(least, "-", "minimum log decrement, of all whirls at the speed of the shaft")}
    if threshold is not None:
        values["stability.threshold_speed"] = Value(threshold, "rad/s", "stability threshold speed, above which a whirl is unstable")
    return values


def campbell_table(diagram: Campbell) -> Table:
    """`campbell`: natural frequencies [Hz] over the speed [rad/s], the branches numbered by their way of going round, and the line of the
    speed itself."""
    columns, counted = [Column("speed", "rad/s", "speed of the shaft", diagram.speeds)], {"forward": 0, "backward": 0}
    for frequency, ratio, sense in zip(diagram.frequency.T, diagram.damping_ratio.T, diagram.sense.T, strict=True):
        way = "forward" if np.nansum(np.sign(sense)) > 0 else "backward"
        counted[way] += 1
        name, label = f"{way}_{counted[way]}", f"{way} whirl {counted[way]}"
        columns.append(Column(name, "Hz", label, frequency * HERTZ))
        columns.append(Column(f"{name}.damping_ratio", "-", f"damping ratio of {label}", ratio))
        columns.append(Column(f"{name}.sense", "-", f"sense of {label}: 1 with the shaft, -1 against it, 0 on a line", sense))
    columns.append(Column("synchronous", "Hz", "once per revolution", diagram.speeds * HERTZ))
    gaps = "an overdamped whirl has no frequency"
    return Table("campbell", "Campbell diagram", tuple(columns), gaps if np.isnan(diagram.frequency).any() else "")


def whirl_shape_table(modes: WhirlModes, z: Floats) -> Table:
    """`whirl_shapes`: the circle that goes round as the whirl does, scaled to 1."""
    columns = [Column("z", "m", "distance from the left end", z)]
    for forward, name, _ in SENSES:
        for n, number in enumerate(modes.chosen(forward), 1):
            x, y = modes.shapes[:, :, number]
            radius = x + 1j * y if forward else np.conj(x - 1j * y)
            size = np.abs(radius)
            radius = radius * np.conj(radius[np.argmax(size > 0.5 * size.max())])  # the first large one points up
            radius = radius / np.abs(radius).max()
            meaning = f"{name} whirl {n}, {modes.frequency[number] * HERTZ:.4g} Hz"
            columns.append(Column(f"{name}_{n}", "-", meaning, radius.real))
    return Table("whirl_shapes", "Whirl shapes at the speed of the shaft", tuple(columns))


# -- unbalance -----------------------------------------------------------------------------------------------------------------


def orbit_values(orbits: Orbits, parts: Sequence[str], supports: Sequence[str]) -> dict[str, Value]:
    """`unbalance.NAME.amplitude` [m] of every part, its lag [rad], and `bearings.NAME.unbalance_force` [N] of `Orbits` at one speed."""
    values, at = {}, f"at {orbits.speeds[0] * 30 / np.pi:.6g} rpm"
    for name, amplitude, lag in zip(parts, orbits.amplitude[0], orbits.lag[0], strict=True):
        meaning = f"unbalance amplitude of {name!r}, major semi-axis of its orbit {at}"
        values[f"unbalance.{name}.amplitude"] = Value(float(amplitude), "m", meaning)
        meaning = f"phase lag of {name!r}, behind the unbalance at the angle 0, {at}"
        values[f"unbalance.{name}.phase_lag"] = Value(float(lag), "rad", meaning)
    for name, force in zip(supports, orbits.support_forces[0], strict=True):
        if np.isfinite(force):
            values[f"bearings.{name}.unbalance_force"] = Value(
                float(force), "N", f"unbalance force on bearing {name!r}, major semi-axis of the rotating force {at}"
            )
    return values


def moment_values(unbalances: Sequence[Unbalance]) -> dict[str, Value]:
    """`unbalance.NAME.moment` [kg m] of the parts."""
    return {
        f"unbalance.{each.name}.moment": Value(each.moment, "kg m", f"unbalance of {each.name!r}, mass times eccentricity")
        for each in unbalances
    }


def resonance_finding(orbits: Orbits) -> str:
    """The finding where `Orbits` at one speed are `resonant`."""
    return (
        f"the unbalance response at {orbits.speeds[0] * 30 / np.pi:.6g} rpm is absent: the speed is a natural frequency that no support "
        f"damps (response over {RESONANCE:.0f} times that at rest); give the bearings a radial_damping, or change the speed"
    )


def orbit_table(orbits: Orbits, parts: Sequence[str], damped: bool) -> Table:
    """`unbalance_response`: amplitude [m] of every part over the speed, where supports damp its lag [rad] too; rows at resonance without
    damping left out."""
    kept = ~orbits.resonant
    columns = [Column("speed", "rad/s", "speed of the shaft", orbits.speeds[kept])]
    for name, amplitude, lag in zip(parts, orbits.amplitude[kept].T, orbits.lag[kept].T, strict=True):
        columns.append(Column(name, "m", f"unbalance amplitude of {name!r}", amplitude))
        if damped:
            meaning, label = f"phase lag behind the unbalance, {name!r}", f"phase lag of {name!r}"
            columns.append(Column(f"{name}{LAG}", "rad", meaning, _continuous(lag), label))
    return Table("unbalance_response", "Unbalance response over speed", tuple(columns))


def _continuous(lag: Floats) -> Floats:
    """The angle without jumps, from within half a turn of 0 on."""
    whole = np.unwrap(lag)
    return whole - 2 * np.pi * np.round(whole[:1] / (2 * np.pi))


# -- to look at ----------------------------------------------------------------------------------------------------------------


def rotor_plots(tables: Mapping[str, Table], speed: float | None, places: tuple[tuple[float, str], ...] = ()) -> Iterator[Plot]:
    """The plots of the tables above; `speed` [rad/s] of the shaft stands upright in them, `places` along the shaft."""
    at = ((speed, "operating speed"),) if speed else ()
    if "campbell" in tables:
        ahead, back = _branches(tables["campbell"])
        curves = (*ahead, "synchronous")
        yield Plot("campbell", "Campbell diagram", "campbell", "speed", curves, reference=back, places=at, meaning=BACKWARD)
    if "whirl_shapes" in tables:
        ahead, back = _branches(tables["whirl_shapes"])
        yield Plot("whirl_shapes", "Whirl shapes", "whirl_shapes", "z", ahead, reference=back, places=places, meaning=BACKWARD)
    if "unbalance_response" in tables:
        names = [column.name for column in tables["unbalance_response"].columns[1:]]
        amplitudes, lags = (tuple(name for name in names if name.endswith(LAG) == lag) for lag in (False, True))
        table = "unbalance_response"
        yield Plot(table, "Unbalance response over speed", table, "speed", amplitudes, log=True, places=at)
        if lags:
            yield Plot("unbalance_lag", "Phase lag behind the unbalance", table, "speed", lags, places=at)


def _branches(table: Table) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Names of the columns of forward, and of backward whirl."""
    names = [column.name for column in table.columns if "." not in column.name]
    ahead, back = (tuple(name for name in names if name.startswith(f"{way}_")) for way in ("forward", "backward"))
    return ahead, back
