"""Hertz pressure of pins on the cams, and what is allowed."""

from collections.abc import Iterator, Mapping

import numpy as np

from drivewright import materials
from drivewright.mechanisms.indexer.build import IndexerModel
from drivewright.result import Check, Table, Value


def largest_pin_values(forces: Table) -> dict[str, Value]:
    """Largest force and pressure of a table of pins."""
    values = {}
    if len(forces["force"].data):
        values["pins.max_force"] = Value(float(np.max(forces["force"].data)), "N", "largest force on a pin")
    if np.isfinite(forces["pressure"].data).any():
        values["pins.max_pressure"] = Value(float(np.nanmax(forces["pressure"].data)), "Pa", "largest Hertz pressure on a pin")
    return values


def pressure_check(model: IndexerModel, values: Mapping[str, Value]) -> Iterator[Check]:
    """The Hertz pressure against what is allowed, or what the material stands."""
    allowed = model.spec.limits.contact_pressure or materials.material(model.spec.contact.material).hertz_limit
    if allowed and "pins.max_pressure" in values:
        yield Check(
            "contact_pressure", values["pins.max_pressure"].value, allowed, "<=", "Pa", "Hertz pressure on a pin", ("cam1", "wheel")
        )
