"""Rated power of American roller chains by the formulas behind the tables of ANSI/ASME B29.1 (American Chain Association).

At low speed the plates' fatigue limits the power, at high speed the impact of rollers and bushes on the teeth:

    P1 = K1 z^1.08 n^0.9 p^(3 - 0.07 p)     [hp],  K1 = 0.004, of No. 41 0.0022
    P2 = 1000 K2 z^1.5 p^0.8/n^1.5          [hp],  K2 = 17, of No. 41 3.4, of bush chains 29

with the teeth z and the speed n [1/min] of the smaller sprocket and the pitch p [inch].  The ratings hold for 15,000 h, about 100 pitches,
two sprockets, even loads and the lubrication that the tables ask for.  Read on a public sheet (Roller Chains, scribd.com/doc/232681759)
and checked against the printed tables of Nos. 40, 41 and 50, in both branches, and of No. 25 in the second.

Left out: the speed at which pins and bushes gall, whose formula is recalled and no table opened here verifies.
"""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Numbers
from drivewright.chains.standards.given import above_zero, whole_teeth
from drivewright.errors import InputError
from drivewright.units import unit_factor

INCH, MINUTE = 0.0254, 60.0
STRAND_FACTORS = {1: 1.0, 2: 1.7, 3: 2.5, 4: 3.3}  # read beside the printed tables
LIGHT = "41"  # narrow chain of light machinery


class RollerChainPower(NamedTuple):
    """Power that limits one row of a chain: by fatigue of the plates, by impact of rollers and bushes  [W]."""

    plate_fatigue: Numbers
    roller_impact: Numbers

    @property
    def rated(self) -> Numbers:
        """The lesser of both  [W]."""
        return np.minimum(self.plate_fatigue, self.roller_impact)


def ansi_power(ansi: str, pitch: Numbers, teeth: Numbers, speed: Numbers, bush_chain: bool = False) -> RollerChainPower:
    """`RollerChainPower` of an American chain by its ANSI number.

    pitch [m], teeth and speed [rad/s] of the smaller sprocket; bush_chain: without rollers (Nos. 25, 35).
    """
    above_zero("chain rating", pitch=pitch, speed=speed)
    whole_teeth("chain rating", teeth)
    inches, turns, z = np.divide(pitch, INCH), np.asarray(speed) * MINUTE / (2 * np.pi), np.asarray(teeth, float)
    fatigue, impact = (0.0022, 3.4) if ansi == LIGHT else (0.004, 29.0 if bush_chain else 17.0)
    horsepower = unit_factor("hp", "power")
    first = fatigue * z**1.08 * turns**0.9 * inches ** (3 - 0.07 * inches)
    return RollerChainPower(horsepower * first, horsepower * 1000 * impact * z**1.5 * inches**0.8 / turns**1.5)


def strand_factor(rows: int) -> float:
    """Rated power of a chain with so many rows over that of one  [-]: below their number, as rows do not share evenly."""
    if rows not in STRAND_FACTORS:
        raise InputError(
            f"chain rating: no factor is known for {rows} rows, only for {', '.join(map(str, STRAND_FACTORS))}; give the maker's."
        )
    return STRAND_FACTORS[rows]
