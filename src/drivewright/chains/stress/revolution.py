"""A plate over one revolution of the chain: its loads from a run of the drive, and the instants that matter for its life."""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from drivewright._typing import Bools, Floats, Ints
from drivewright.chains.explicit.motion import Motion
from drivewright.chains.explicit.simulate import tooth_time
from drivewright.chains.stress.plate import Basis, Loads
from drivewright.result import Column, Table

SEAT = 0.17  # sine of how far a seat reaches around its pin beyond a right angle


@dataclass(frozen=True, eq=False)
class PlateRevolution:
    """The plate that a run watches, over the last revolution of the chain in the steady part.

    plates: of its link, which share its forces equally; contact_heights: of the contact on its flank, seated on the driving and on the
    driven sprocket, in the pin frame [m]; middle: x [m] below which the plate is nearer to the driving sprocket.
    """

    motion: Motion
    plates: int
    contact_heights: tuple[float, float]
    middle: float

    @property
    def rows(self) -> slice:
        """The samples of one revolution of the chain, the last ones of the run."""
        count = self.motion.model.chain.count * self.motion.per_tooth
        last = self.motion.steady.stop
        return slice(max(self.motion.steady.start, last - count - 1), last)

    @property
    def whole(self) -> bool:
        """Whether it is a whole revolution of the chain, of a run that did not fail."""
        turn = self.motion.model.chain.count * tooth_time(self.motion.model)
        return not self.motion.advice and bool(self.time[-1] - self.time[0] > 0.999 * turn)

    @property
    def time(self) -> Floats:
        """Times of the samples (n,)  [s]."""
        return self.motion.t[self.rows]

    @cached_property
    def loads(self) -> Loads:
        """`Loads` (n,) of one plate; an open joint loads none."""
        share = 1 / self.plates
        column = {
            name: self.motion.column(name)[self.rows] * share
            for name in ("left x", "left y", "right x", "right y", "left flank", "right flank")
        }
        pins = np.stack([[column["left x"], column["left y"]], [column["right x"], column["right y"]]]).transpose(2, 0, 1)
        pins = np.where(open_seats(pins)[..., None], 0.0, pins)
        flanks = np.stack([column["left flank"], column["right flank"]], axis=1)
        near = self.motion.column("x")[self.rows] < self.middle
        return Loads(pins, flanks, np.where(near, *self.contact_heights)[:, None] * np.ones(2))


class StressedPlate(NamedTuple):
    """The stress of a plate under unit loads, and its revolution with the chain."""

    basis: Basis
    revolution: PlateRevolution


def history_table(revolution: PlateRevolution, mises: Floats) -> Table:
    """Table "plate_history": von Mises stress (n,) [Pa] at the worst place of a plate, and its loads over the revolution."""
    pins, flanks = np.asarray(revolution.loads.pins), np.asarray(revolution.loads.flanks)
    return Table(
        "plate_history",
        "Plate stress over a revolution",
        (
            Column("time", "s", "time", revolution.time),
            Column("mises", "Pa", "von Mises stress at the worst point", mises),
            Column("left_pin", "N", "left pin force on a plate", np.hypot(*pins[:, 0].T)),
            Column("right_pin", "N", "right pin force on a plate", np.hypot(*pins[:, 1].T)),
            Column("left_flank", "N", "left flank force on a plate", flanks[:, 0]),
            Column("right_flank", "N", "right flank force on a plate", flanks[:, 1]),
        ),
    )


def open_seats(pins: Floats) -> Bools:
    """Where a pin of pins (n, 2, 2) [N] would pull its plate inwards, off its seat: the joint is open there (n, 2)."""
    outward = pins[:, :, 0] * np.array([-1.0, 1.0])
    return outward < -SEAT * np.hypot(*np.moveaxis(pins, 2, 0))


def fewer_instants(loads: Loads, most: int) -> Loads:
    """The loads at `most` instants or fewer: in equal spans of the history that with the largest and that with the smallest forces."""
    pins, flanks = np.asarray(loads.pins, float), np.asarray(loads.flanks, float)
    return loads_at(loads, turning_points(np.abs(pins).sum(axis=(1, 2)) + flanks.sum(axis=1), most))


def turning_points(size: Floats, most: int) -> Ints:
    """Rows of a history (n,), `most` or fewer: in equal spans of it the largest and the smallest."""
    rows = np.arange(len(size))
    if len(rows) <= most:
        return rows
    parts = np.array_split(rows, most // 2)
    return np.unique([part[pick] for part in parts for pick in (np.argmax(size[part]), np.argmin(size[part]))])


def loads_at(loads: Loads, rows: Ints) -> Loads:
    """The loads at some instants."""
    return Loads(*(np.asarray(part, float)[rows] for part in loads))
