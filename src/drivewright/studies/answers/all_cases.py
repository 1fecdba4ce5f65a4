"""Statistics over all cases of a study that are too many for memory: ends, samples by combination of levels, and how many pass.

Everything is found by reading the study piece by piece; a piece is a `Study` of some of the rows.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from drivewright._typing import Floats
from drivewright.execution.case_table import CASE
from drivewright.execution.outputs import CHECK
from drivewright.studies.answers.cases import NOBODY, Tally, passing, sample_ranges, status_codes, tally
from drivewright.studies.statistics import Summary, summary
from drivewright.studies.streaming import Moments, summaries
from drivewright.studies.study import Study

HELD = 10_000_000  # cells of one combination's sample that are held in memory


@dataclass(frozen=True)
class SampleOfAll:
    """The sample of one combination of levels: `Summary` of each value and margin, `Tally` of each check, and of all together."""

    summaries: dict[str, Summary]
    checks: dict[str, Tally]
    together: Tally


def moments_of(study: Study, names: Sequence[str]) -> dict[str, Moments]:
    """{column: its `Moments` over all cases that are there, with the least and greatest and the numbers of their cases}."""
    found = {name: Moments() for name in names}
    for table in study.batches((CASE, *found)):
        piece = replace(study, rows=table)
        for name, each in found.items():
            each.add(np.asarray(piece[name], float), np.asarray(piece[CASE]))
    return found


def row_of(study: Study, case: int) -> Study:
    """One case of a study."""
    return replace(study, rows=next(study.batches(None, case, case + 1)))


class AllCases:
    """The statistics of all cases of a study."""

    def __init__(self, study: Study, combinations: Sequence[int]) -> None:
        """`combinations`: numbers of the combinations of levels whose samples are told."""
        self._study, self.plan, self._combinations = study, study.plan, combinations
        self._names = (*study.value_names, *(CHECK + name for name in study.check_names))

    @cached_property
    def ends(self) -> dict[str, Moments]:
        """{column: its `Moments` over every case, with the least and greatest and the numbers of their cases}."""
        return moments_of(self._study, self._names)

    def row(self, case: int) -> Study:
        """One case."""
        return row_of(self._study, case)

    @cached_property
    def samples(self) -> tuple[SampleOfAll, ...]:
        """The sample of each combination of levels that is told; empty where there is no sample."""
        return tuple(self._sample(number) for number in self._combinations) if self._ranges else ()

    @cached_property
    def _ranges(self):
        """Rows (start, stop) of the points that are a sample."""
        return sample_ranges(self.plan)

    def _sample(self, number):
        """`SampleOfAll` of one combination."""
        rows = sum(stop - start for start, stop in self._ranges)
        moments = {name: Moments() for name in self._names}
        checks, together = dict.fromkeys(self._study.check_names, NOBODY), NOBODY
        held: dict[str, list[Floats]] | None = {name: [] for name in self._names} if rows * len(self._names) <= HELD else None
        for piece in self._pieces(number):
            checks = {name: each.more(_of_check(piece, name)) for name, each in checks.items()}
            together = together.more(_of_all(piece))
            for name in self._names:
                column = np.asarray(piece[name], float)
                if held is None:
                    moments[name].add(column, np.asarray(piece[CASE]))
                else:
                    held[name].append(column)
        if held is not None:
            found = {name: summary(np.concatenate(columns or [np.zeros(0)])) for name, columns in held.items()}
        else:
            found = summaries(lambda: map(self._numbers, self._pieces(number, self._names)), moments)
        return SampleOfAll(found, checks, together)

    def _numbers(self, piece):
        return {name: np.asarray(piece[name], float) for name in self._names}

    def _pieces(self, number: int, names: Sequence[str] | None = None) -> Iterator[Study]:
        """The sample of one combination, piece by piece."""
        first, columns = number * self.plan.inner, None if names is None else (CASE, *names)
        for start, stop in self._ranges:
            for table in self._study.batches(columns, first + start, first + stop):
                yield replace(self._study, rows=table)


def _of_check(piece: Study, name: str) -> Tally:
    """A failed case passes no check."""
    margin = np.asarray(piece[CHECK + name], float)
    surely, possibly = (piece.at_worst(CHECK + name, sign) >= 0 for sign in (-1, 1))
    return tally(margin >= 0, surely, possibly, np.isfinite(margin) | (status_codes(piece) == 2))


def _of_all(piece: Study) -> Tally:
    return tally(passing(piece), passing(piece, -1), passing(piece, 1), np.ones(len(piece), bool))
