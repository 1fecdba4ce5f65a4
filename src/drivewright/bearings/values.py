"""A rolling bearing under load as values and findings of a result."""

from collections.abc import Iterator

import numpy as np

from drivewright.bearings.life import basic_life, equivalent_radial_load, life_duration
from drivewright.bearings.solving import BearingEquilibrium
from drivewright.result import Value


def load_values(name: str, state: BearingEquilibrium) -> dict[str, Value]:
    """Load [N] and pressure [Pa] of the rolling elements of the bearing of this name, and its static safety."""
    of, key = f"of bearing {name!r}", f"bearings.{name}"
    loaded = int(np.sum(state.element_loads > 0))
    values = {
        f"{key}.max_element_load": Value(float(state.element_loads.max()), "N", f"load of the most loaded rolling element {of}"),
        f"{key}.max_pressure": Value(float(state.pressures.max()), "Pa", f"largest Hertz pressure {of}"),
        f"{key}.loaded_elements": Value(float(loaded), "-", f"rolling elements under load {of}"),
    }
    if loaded:
        values[f"{key}.static_safety"] = Value(state.static_safety, "-", f"load at the permissible static pressure over the load {of}")
    return values


def life_values(name: str, state: BearingEquilibrium, speed: float | None = None) -> dict[str, Value]:
    """Basic and reference life in revolutions, and at a speed [rad/s] in time [s]; without those that are not known."""
    of, key, values = f"of bearing {name!r}", f"bearings.{name}", {}
    load, life = equivalent_radial_load(state.force, state.bearing.contact_angle), state.reference_life
    basic = None if load is None else basic_life(state.bearing, load)
    if basic is not None:
        values[f"{key}.basic_life"] = Value(float(basic), "-", f"basic life L10 (ISO 281) {of}, revolutions, at P = its radial force")
    if life is not None and np.isfinite(life):
        values[f"{key}.reference_life"] = Value(float(life), "-", f"reference life L10r {of}, revolutions")
        if speed:
            values[f"{key}.reference_life.time"] = Value(life_duration(life, speed), "s", f"the same {of} at the shaft's speed")
    return values


def bearing_findings(name: str, state: BearingEquilibrium) -> Iterator[str]:
    """What is absent for want of a rating, and elements that bear where an angular-contact bearing has no shoulder."""
    if state.bearing.dynamic_rating is None:
        yield f"life of bearing {name!r} is absent: it has no dynamic_rating"
    if state.bearing.contact_angle and state.reversed_elements:
        yield (
            f"bearing {name!r}: {state.reversed_elements} of its elements bear on the side that an angular-contact bearing does not have; "
            "it needs more preload or axial load, or turn it round (carries)"
        )
