"""Selection by the maker's power ratings: the user's table, read off on logarithmic scales, and a service factor.

No table comes along: ratings and service factors belong to standards and makers, and are entered by the user.
"""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from drivewright._typing import ArrayLike, Floats
from drivewright.chains.standards.given import above_zero
from drivewright.errors import InputError


class RatingTable(NamedTuple):
    """Rated power [W] over tooth numbers (rows) and angular speeds of the small sprocket [rad/s] (columns), both increasing."""

    teeth: Floats
    speeds: Floats
    powers: Floats


def rating_table(teeth: Sequence[int], speeds: Sequence[float], powers: ArrayLike, name: str = "rating table") -> RatingTable:
    """A checked `RatingTable`; one row or more, two speeds or more."""
    rows, columns = np.atleast_1d(np.asarray(teeth, dtype=float)), np.atleast_1d(np.asarray(speeds, dtype=float))
    table = RatingTable(rows, columns, np.atleast_2d(np.asarray(powers, dtype=float)))
    if table.powers.shape != (table.teeth.size, table.speeds.size):
        raise InputError(
            f"{name}: powers of shape {table.powers.shape} for {table.teeth.size} tooth numbers and {table.speeds.size} "
            "speeds; give a row for each tooth number and a column for each speed."
        )
    above_zero(name, tooth_numbers=table.teeth, speeds=table.speeds, powers=table.powers)
    if np.any(np.diff(table.teeth) <= 0) or np.any(np.diff(table.speeds) <= 0) or table.speeds.size < 2:
        raise InputError(f"{name}: tooth numbers and speeds must increase from entry to entry, and at least two speeds are needed.")
    return table


def rated_power(table: RatingTable, teeth: int, speed: float, name: str = "rating table") -> float:
    """Rated power [W] between the entries: linear in the logarithms of teeth, speed and power, hence exact for any law P = C z^a w^b.

    Nothing is read off outside of the table.
    """
    above_zero(name, tooth_number=teeth, speed=speed)
    for what, value, axis, unit in (("teeth", teeth, table.teeth, ""), ("speed", speed, table.speeds, " rad/s")):
        if not axis[0] <= value <= axis[-1]:
            raise InputError(
                f"{name}: {what} {value:g}{unit} lies outside of it, {axis[0]:g}..{axis[-1]:g}{unit}; a rating is not extended."
            )
    along_speed = [np.interp(np.log(speed), np.log(table.speeds), np.log(row)) for row in table.powers]
    return float(np.exp(np.interp(np.log(teeth), np.log(table.teeth), along_speed)))


def design_power(power: float, service_factor: float, strand_factor: float = 1.0) -> float:
    """Power [W] that the rating of a single chain must reach: P f/k, both factors the user's, k of a multiple chain."""
    above_zero("chain selection", power=power, service_factor=service_factor, strand_factor=strand_factor)
    return power * service_factor / strand_factor


def suitable_chains(tables: Mapping[str, RatingTable], needed_power: float, teeth: int, speed: float) -> list[tuple[str, float]]:
    """(name, needed over rated power) of the chains that suffice, the best used first; `tables` maps names to `RatingTable`.

    A chain whose table does not cover teeth and speed is not rated there and left out.
    """
    above_zero("chain selection", needed_power=needed_power)
    uses = {name: needed_power / rated_power(table, teeth, speed, name) for name, table in tables.items() if _covers(table, teeth, speed)}
    fit = sorted(((name, use) for name, use in uses.items() if use <= 1), key=lambda pair: -pair[1])
    if fit:
        return fit
    if not uses:
        raise InputError(
            f"chain selection: no table covers {teeth:g} teeth at {speed:g} rad/s; enter one that does, or change the sprocket."
        )
    best = min(uses, key=lambda name: uses[name])
    raise InputError(
        f"chain selection: no chain is rated for {needed_power:g} W with {teeth:g} teeth at {speed:g} rad/s; the strongest, "
        f"{best}, reaches {needed_power / uses[best]:.4g} W. Take more strands, more teeth, or enter larger chains."
    )


def _covers(table, teeth, speed):
    return table.teeth[0] <= teeth <= table.teeth[-1] and table.speeds[0] <= speed <= table.speeds[-1]
