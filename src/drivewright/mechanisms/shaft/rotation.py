"""The turning shaft: whirl at its speed, Campbell diagram, stability, and the response to unbalance."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from drivewright import shafts
from drivewright._typing import Floats
from drivewright.errors import InputError
from drivewright.mechanisms.shaft.build import ShaftModel
from drivewright.mechanisms.shaft.frequencies import no_modes
from drivewright.mechanisms.shaft.spec import ShaftSpec
from drivewright.result import Answer, Answers, Check, Value
from drivewright.shafts import rotor_results as results

SPEEDS, RESPONSE_SPEEDS = 41, 161  # of the Campbell diagram, and of the unbalance response
FLANKS = np.array([-4.0, -2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0, 4.0])  # about a peak, in damping ratios
LEAST = 1.05  # over the speed of the shaft, which is always shown
BEYOND = 1.25  # over the speed of the shaft and the first critical speed: how far both go


class Turning(NamedTuple):
    """The rotor of a shaft, and its critical speeds within the Campbell diagram."""

    rotor: shafts.Rotor
    critical: Sequence[shafts.CriticalSpeed]


def no_whirl(spec: ShaftSpec) -> str | None:
    """Why no whirl is computed."""
    return no_modes(spec) or (None if spec.drive else "the spec has no [drive] speed")


def whirl(model: ShaftModel, done: Answers) -> Answer:
    """Whirl at the speed of the shaft and over all speeds to beyond the first critical one; `data` is the `Turning`."""
    vibration = done["modes"].data
    if vibration is None or model.spec.drive is None:
        return Answer(findings=("whirl is absent: the shaft has no natural frequencies",), outcome="left out")
    speed, count = model.spec.drive.speed, model.spec.analysis.modes
    try:
        rotor = shafts.reduced_rotor(vibration.equilibrium, [part.position for part in model.turning_parts])
    except InputError as error:
        return Answer(findings=(f"whirl is absent: {error}",), outcome="left out")
    modes = shafts.whirl_modes(rotor, speed, count)
    diagram = shafts.campbell(rotor, np.linspace(0.0, _highest_speed(model, vibration.lowest), SPEEDS), count)
    damped, critical = not rotor.is_conservative, shafts.damped_critical_speeds(rotor, diagram)
    values = results.whirl_values(modes, damped) | results.critical_values(critical, damped)
    tables = [results.campbell_table(diagram), results.whirl_shape_table(modes, rotor.z)]
    if damped and len(modes.frequency):
        values |= results.stability_values(modes, shafts.stability_threshold(rotor, diagram))
    checks = (*_stability_check(model, values), *_separation_check(model, critical, rotor.whirls))
    return Answer(values, tuple(tables), checks, tuple(_inertia_findings(model)), data=Turning(rotor, critical))


def _inertia_findings(model: ShaftModel) -> Iterator[str]:
    """Moments of inertia that no body has: the polar one is at most twice that about a diameter."""
    for part in model.turning_parts:
        if part.polar_inertia > 2 * part.diametral_inertia * (1 + 1e-9) and part.diametral_inertia > 0:
            yield (
                f"{part.name!r} has a polar_inertia of {part.polar_inertia:.4g} kg·m², more than twice its diametral_inertia of "
                f"{part.diametral_inertia:.4g} kg·m², which no body has; check both"
            )


def _highest_speed(model: ShaftModel, lowest: float | None) -> float:
    """The highest speed [rad/s] that is looked at; `lowest` critical speed [rad/s]."""
    drive, given = model.spec.drive, model.spec.analysis.campbell_speed
    speed = drive.speed if drive else 0.0
    return max(given, LEAST * speed) if given else BEYOND * max(speed, lowest or 0.0)


def _stability_check(model: ShaftModel, values: dict[str, Value]) -> Iterator[Check]:
    least = values.get("stability.log_decrement")
    if least is not None:
        message = "minimum log decrement, of all whirls at the speed of the shaft; below 0 a whirl is unstable; give more damping"
        yield Check("stability", least.value, model.spec.limits.log_decrement, ">=", "-", message, ("shaft",))


def _separation_check(model: ShaftModel, critical: Sequence[shafts.CriticalSpeed], round_: bool) -> Iterator[Check]:
    """How near the next critical speed is that an unbalance excites; on round supports none of those against the shaft."""
    drive = model.spec.drive
    excited = [each.speed for each in critical if each.forward or not round_]
    if drive is not None and excited:
        nearest = min(abs(speed / drive.speed - 1) for speed in excited)
        meaning = "separation margin, distance of the nearest unbalance-excited critical speed over the speed of the shaft"
        message = f"{meaning}; change the speed, or the stiffness of shaft or bearings"
        yield Check("separation_margin", nearest, model.spec.limits.separation_margin, ">=", "-", message, ("shaft",))


# -- unbalance -----------------------------------------------------------------------------------------------------------------


def no_unbalance(spec: ShaftSpec) -> str | None:
    """Why no unbalance response is computed."""
    heavy = any(part.mass or part.unbalance for part in (*spec.stations, *spec.gears))
    return no_whirl(spec) or (None if heavy else "no station and no gear has a mass or an unbalance")


def unbalance(model: ShaftModel, done: Answers) -> Answer:
    """Orbits of stations and gears at the speed of the shaft and over all speeds, by their unbalances, else by the balance grade."""
    turning, vibration, drive = done["whirl"].data, done["modes"].data, model.spec.drive
    if turning is None or drive is None:
        return Answer(findings=("the unbalance response is absent: there are no results for whirl",), outcome="left out")
    given, findings = unbalances(model), []
    if not any(part.unbalance for part in model.turning_parts):
        findings.append(
            f"no unbalance is given: the permissible one of balance grade {drive.balance_grade} at the speed of the shaft (ISO 21940-11) "
            "is distributed over stations and gears in proportion to their masses, all at one angle"
        )
    stiffness = np.array([tangent[:2, :2] for tangent in vibration.equilibrium.tangent])
    places, names = [part.position for part in model.turning_parts], [part.name for part in model.turning_parts]
    supports = [support.name for support in model.shaft.supports]

    def orbits(speeds: Floats) -> shafts.Orbits:
        return shafts.unbalance_response(turning.rotor, given, speeds, places, stiffness)

    at_speed = orbits(np.array([drive.speed]))
    over = np.linspace(0.0, _highest_speed(model, vibration.lowest), RESPONSE_SPEEDS)[1:]
    table = results.orbit_table(orbits(_with_peaks(over, turning.critical)), names, not turning.rotor.is_conservative)
    quality = Value(shafts.balance_quality(model.shaft, given, drive.speed), "m/s", "balance quality, eccentricity times angular speed")
    values = {"unbalance.balance_quality": quality} | results.moment_values(given)
    if at_speed.resonant[0]:
        return Answer(values, (table,), (), (*findings, results.resonance_finding(at_speed)))
    values |= results.orbit_values(at_speed, names, supports)
    return Answer(values, (table,), tuple(_amplitude_checks(model, values)), tuple(findings))


def unbalances(model: ShaftModel) -> tuple[shafts.Unbalance, ...]:
    """Those of stations and gears, else what the balance grade permits."""
    drive = model.spec.drive
    own = tuple(shafts.Unbalance(p.position, p.unbalance, p.unbalance_angle, p.name) for p in model.turning_parts if p.unbalance)
    return own if own or drive is None else shafts.permissible_unbalances(model.shaft, drive.balance_grade, drive.speed)


def _with_peaks(speeds: Floats, critical: Sequence[shafts.CriticalSpeed]) -> Floats:
    """Speeds (k,) [rad/s] with those at which a damped resonance has its peak and its flanks."""
    peaks = [each.speed * (1 + each.damping_ratio * FLANKS) for each in critical if each.damping_ratio > 0]
    whole = np.unique(np.concatenate([speeds, *peaks]))
    return whole[(whole > 0) & (whole <= speeds[-1])]


def _amplitude_checks(model: ShaftModel, values: dict[str, Value]) -> Iterator[Check]:
    limit = model.spec.limits.unbalance
    for part in model.turning_parts if limit else ():
        value = values[f"unbalance.{part.name}.amplitude"]
        message = f"{value.meaning}; take a finer balance grade or more damping"
        yield Check.of(value, f"unbalance.{part.name}", float(limit or 0), "<=", message, ("shaft",))
