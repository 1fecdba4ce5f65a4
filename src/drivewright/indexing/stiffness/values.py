"""Torsional stiffness, loads of bearings and the statics beside them as values and findings of a result."""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from drivewright import bearings
from drivewright._typing import Complexes, Floats
from drivewright.bearings import RollingBearing
from drivewright.indexing.contacts import CamContacts
from drivewright.indexing.stiffness.result import TorsionalStiffness, WheelStiffness
from drivewright.indexing.stiffness.statics import crank_load_deviations, equivalent_load
from drivewright.result import Table, Value


def stiffness_values(angles: Floats, result: WheelStiffness) -> dict[str, Value]:
    """Part of the input angles (p,) [rad] where the torque is not carried; mean, extremes and range of the secant where it is."""
    carried = result.carried
    meaning = "share of the positions at which no contact without a gap carries the torque"
    values = {"stiffness.undefined_fraction": Value(float(np.mean(~carried)), "-", meaning, label="Positions without holding contact")}
    if not carried.any():
        return values
    secant, at = result.secant[carried], angles[carried]
    least = int(np.argmin(secant))
    return values | {
        "stiffness.mean": Value(
            float(np.mean(secant)),
            "N m/rad",
            "mean secant stiffness over the positions that carry the torque",
            label="Mean secant stiffness",
        ),
        "stiffness.minimum": Value(float(secant[least]), "N m/rad", "minimum secant stiffness"),
        "stiffness.minimum.at": Value(float(at[least]), "rad", "input angle at minimum stiffness"),
        "stiffness.maximum": Value(float(np.max(secant)), "N m/rad", "maximum secant stiffness"),
        "stiffness.range": Value(
            float(np.ptp(secant)), "N m/rad", "maximum minus minimum secant stiffness", label="Peak-to-peak secant stiffness"
        ),
    }


def dwell_values(angles: Floats, result: WheelStiffness, forces: Table, part: str = "pin") -> dict[str, Value]:
    """The same in the dwell, where work is done on the table, with the largest force and pressure of a table of forces on each `part`."""
    meaning = "share of the dwell at which no contact without a gap carries the torque"
    values = {"dwell.undefined_fraction": Value(float(np.mean(~result.carried)), "-", meaning, label="Dwell without holding contact")}
    if result.carried.any():
        least, at = int(np.nanargmin(result.secant)), "Input angle at minimum stiffness, dwell"
        values |= {
            "dwell.stiffness.minimum": Value(float(result.secant[least]), "N m/rad", "minimum secant stiffness in the dwell"),
            "dwell.stiffness.minimum.at": Value(float(angles[least]), "rad", "input angle at minimum stiffness, dwell", label=at),
            "dwell.pins.max_force": Value(float(np.max(forces["force"].data)), "N", f"maximum force on a {part} in the dwell"),
        }
    if np.isfinite(forces["pressure"].data).any():
        largest = float(np.nanmax(forces["pressure"].data))
        meaning = f"maximum Hertz pressure on a {part} in the dwell"
        values["dwell.pins.max_pressure"] = Value(largest, "Pa", meaning, label="Maximum Hertz pressure in the dwell")
    return values


def stiffness_findings(angles: Floats, result: WheelStiffness, after_play: WheelStiffness) -> Iterator[str]:
    """Why there is no stiffness at some of the input angles (p,) [rad], and at how many of them there is one after the play."""
    lost, reasons = np.flatnonzero(~result.carried), result.reasons
    for reason in dict.fromkeys(reasons[k] for k in lost):
        rows = [k for k in lost if reasons[k] == reason]
        after = int(np.sum(after_play.carried[rows]))
        more = f" At {after} of them a contact carries it after the play; see table stiffness, secant_after_play." if after else ""
        places = ", ".join(f"{angle:.4g}" for angle in np.degrees(angles[rows[:12]])) + (" ..." if len(rows) > 12 else "")
        yield f"no stiffness at {len(rows)} of {len(angles)} input angles ({places}°) against {result.torque:.6g} N·m: {reason}.{more}"


def bearing_load_values(
    group: str, forces: Mapping[str, Complexes], rolling: RollingBearing | None = None, speed: float | None = None
) -> dict[str, Value]:
    """Largest load of a group of bearings; of a rated rolling bearing the equivalent load and the life of the most loaded one.

    forces: (p,) complex [N] by name, nan where nothing carries; with a rolling bearing over a whole turn of the input, first and last
    position being one; speed of the input [rad/s].
    """
    largest = max(float(np.nanmax(np.abs(force))) for force in forces.values())
    values = {f"{group}.max_load": Value(largest, "N", f"maximum load of a {group} bearing")}
    if rolling is None or rolling.dynamic_rating is None:
        return values
    mean = max(equivalent_load(np.abs(force), bearings.life_exponent(rolling)) for force in forces.values())
    life = bearings.basic_life(rolling, mean) if mean > 0 else None
    if life is not None:
        worst = f"most loaded {group} bearing"
        values[f"{group}.equivalent_load"] = Value(
            mean, "N", f"constant load with the same life, {worst}", label=f"Equivalent load, {group} bearings"
        )
        values[f"{group}.basic_life"] = Value(
            float(life), "rev", f"basic life L10 of ISO 281 in turns of the input, {worst}", label=f"Basic life L10, {group} bearings"
        )
        if speed:
            values[f"{group}.basic_life.time"] = Value(
                bearings.life_duration(life, speed),
                "s",
                f"basic life L10h of ISO 281 at the speed of the input, {worst}",
                label=f"Basic life L10h, {group} bearings",
            )
    return values


def statics_values(result: TorsionalStiffness, contacts: Sequence[CamContacts], eccentricity: float, spacing: float) -> dict[str, Value]:
    """Largest differences of the loads by statics alone from those in equilibrium; eccentricity, spacing of the split shafts [m]."""
    return {
        f"statics.{name}.deviation": Value(
            deviation,
            "-",
            f"deviation of the bearing loads by equations (8) as {name} from those in equilibrium, over the largest load",
            label=f"Deviation of equations (8) as {name}",
        )
        for name, deviation in crank_load_deviations(result, contacts, eccentricity, spacing).items()
    }
