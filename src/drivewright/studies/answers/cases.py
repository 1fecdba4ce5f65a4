"""The cases of a study: how each ended, whether it passes, and which of them are a random sample."""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Bools, Ints
from drivewright.execution.case_table import STATUS
from drivewright.execution.outputs import CHECK
from drivewright.studies.plan import Plan
from drivewright.studies.statistics import Sampled, share_between
from drivewright.studies.study import Study

STATUSES = ("complete", "partial", "failed")
SAMPLES = ("sample", "a", "b")  # blocks of points that are random


class Tally(NamedTuple):
    """How many of the cases counted pass: by their values; surely and possibly, whatever their intervals hold."""

    passes: int
    surely: int
    possibly: int
    counted: int

    def more(self, other: "Tally") -> "Tally":
        """Both together."""
        return Tally(*(mine + theirs for mine, theirs in zip(self, other, strict=True)))

    @property
    def share(self) -> Sampled:
        """Of the cases that pass."""
        return share_between(self.surely, self.passes, self.possibly, self.counted)

    @property
    def undecided(self) -> int:
        """Cases that pass or do not, by where in its interval their value is."""
        return self.possibly - self.surely


NOBODY = Tally(0, 0, 0, 0)


def tally(passes: Bools, surely: Bools, possibly: Bools, counted: Bools) -> Tally:
    """`Tally` of some cases."""
    return Tally(*(int(np.sum(each & counted)) for each in (passes, surely, possibly, counted)))


def status_codes(study: Study) -> Ints:
    """Number of each row's status in STATUSES."""
    status = np.asarray(study[STATUS], dtype=str)
    return np.select([status == name for name in STATUSES], range(len(STATUSES)), len(STATUSES) - 1)


def passing(study: Study, sign: int = 0) -> Bools:
    """(rows,) whether a case is complete and none of the checks that it has fails; by the value, or surely (-1), or possibly (+1)."""
    passes = status_codes(study) == 0
    for name in study.check_names:
        margin = study.at_worst(CHECK + name, sign) if sign else np.asarray(study[CHECK + name], dtype=float)
        passes &= ~(margin < 0)
    return passes


def sample_ranges(plan: Plan) -> tuple[tuple[int, int], ...]:
    """Rows (start, stop) of the points that are a random sample, or come from a file; none where there is only a grid, steps or corners."""
    if plan.listed:
        return ((0, plan.inner),)
    return tuple((block.start, block.stop) for block in plan.blocks if block.name in SAMPLES)
