"""Natural frequencies and critical speeds."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from drivewright import shafts
from drivewright._typing import Floats
from drivewright.errors import InputError, SpecError
from drivewright.mechanisms.shaft.build import ShaftModel
from drivewright.mechanisms.shaft.spec import ShaftSpec
from drivewright.result import Answer, Answers, Check
from drivewright.shafts.tables import mode_table
from drivewright.shafts.values import frequency_values, massless_findings, massless_values

ELEMENTS, MAX_ELEMENTS = 40, 1000  # along the shaft: unless a length is given, and at most


class Vibration(NamedTuple):
    """The equilibrium on the mesh of the modes, and the lowest critical speed [rad/s] that an unbalance excites."""

    equilibrium: shafts.ShaftEquilibrium
    lowest: float | None


def no_modes(spec: ShaftSpec) -> str | None:
    """Why no frequencies are computed."""
    return None if spec.analysis.modes else "no modes are requested (analysis.modes = 0)"


def frequencies(model: ShaftModel, done: Answers) -> Answer:
    """Modes and critical speeds about the equilibrium of the loads, and what a massless shaft would make of them; `data` is the
    `Vibration`."""
    count, fine = model.spec.analysis.modes, turning_equilibrium(model, done["statics"].data.equilibrium)
    try:
        (bending, axial), critical = shafts.modes(fine, count), shafts.critical_speeds(fine, count)
    except InputError as error:
        return Answer(findings=(f"modes are absent: {error}",), outcome="left out")
    if not len(bending.frequencies) + len(axial.frequencies):
        return Answer(
            findings=("modes are absent: nothing that can move has a mass; give a density, or a station a mass",), outcome="left out"
        )
    torsional = shafts.torsional_modes(fine, min(count, 3)).frequencies
    lowest = shafts.lowest_excited(fine, critical)
    values = frequency_values(bending.frequencies, axial.frequencies, torsional, critical, lowest)
    massless, findings = _massless_frequencies(model, done), ()
    if len(massless) and len(bending.frequencies):
        values |= massless_values(massless)
        findings = tuple(massless_findings(massless, bending, model.shaft.stations, model.direction))
    return Answer(values, (mode_table(fine, bending),), tuple(_speed_check(model, lowest)), findings, data=Vibration(fine, lowest))


def turning_equilibrium(model: ShaftModel, at_rest: shafts.ShaftEquilibrium) -> shafts.ShaftEquilibrium:
    """The same equilibrium on a mesh that is fine enough for the shapes of the modes; bearings keep their tangents."""
    step = model.spec.analysis.element_length or model.shaft.length / ELEMENTS
    if model.shaft.length / step > MAX_ELEMENTS:
        raise SpecError(
            f"divides the shaft into {model.shaft.length / step:.0f} elements; at most {MAX_ELEMENTS} are allowed",
            "analysis.element_length",
        )
    return shafts.refined_equilibrium(at_rest, step)


def _massless_frequencies(model: ShaftModel, done: Answers) -> Floats:
    """Natural frequencies [Hz] of the stations' masses alone on the flexibility; none where one of them has no mass."""
    found = done["flexibility"].data if "flexibility" in done else None
    masses = np.array([station.mass for station in model.shaft.stations])
    if found is None or not len(masses) or np.any(masses == 0):
        return np.zeros(0)
    return shafts.massless_frequencies(found.delta, masses)


def _speed_check(model: ShaftModel, lowest: float | None) -> Iterator[Check]:
    drive = model.spec.drive
    if drive is not None and lowest:
        meaning = "critical speed ratio, lowest unbalance-excited critical speed over the speed of the shaft"
        message = f"{meaning}; stiffen the shaft or the bearings"
        yield Check("critical_speed", lowest / drive.speed, model.spec.limits.critical_speed, ">=", "-", message, ("shaft",))
