"""The force at a station at which a bearing of the shaft, or the shaft itself, reaches its limit."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.shafts.equilibrium import ShaftEquilibrium
from drivewright.shafts.influence import Flexibility
from drivewright.shafts.unit_loads import peak_unit_stress

NO_SHARE = 1e-12  # of the force that a bearing carries: rounding
NO_STRESS = 1e-9  # of a force over the square of the shaft's length: that at a station on a bearing is rounding


class LimitLoad(NamedTuple):
    """A force [N] at which a support, by its name, or the shaft (None) reaches its limit."""

    support: str | None
    force: float

    @property
    def part(self) -> str:
        """What reaches its limit, in words."""
        return "shaft, yield" if self.support is None else f"bearing {self.support}"


def limit_loads(
    flexibility: Flexibility,
    equilibrium: ShaftEquilibrium,
    station: int,
    direction: Floats,
    ratings: Sequence[float | None],
    yield_strength: float | None,
) -> Iterator[LimitLoad]:
    """The `LimitLoad`s of a force at a station alone: C0 over the share of every support with a static rating C0 [N], and the yield
    strength [Pa] over the largest bending stress of a unit force.

    station: its number in the `Flexibility` of the `equilibrium` along `direction` (x, y); ratings: one for every support.
    """
    shaft = equilibrium.model.beam.shaft
    for support, rating, share in zip(shaft.supports, ratings, np.abs(flexibility.reactions[:, station]), strict=True):
        if rating and share > NO_SHARE:
            yield LimitLoad(support.name, rating / share)
    stress = peak_unit_stress(equilibrium, flexibility.unknowns[:, station], direction)
    if yield_strength and stress > NO_STRESS / shaft.length**2:
        yield LimitLoad(None, yield_strength / stress)
