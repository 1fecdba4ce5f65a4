"""Parts of the evaluation of a study: its table arranged by combination of levels, and parts that are put together."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, TypedDict

import numpy as np
from numpy.typing import NDArray

from drivewright._typing import Floats, Ints
from drivewright.execution.case_table import CASE
from drivewright.execution.outputs import CHECK
from drivewright.result import Column, Plot, Table, Value
from drivewright.studies.answers.all_cases import AllCases
from drivewright.studies.answers.cases import Tally, passing, sample_ranges, status_codes, tally
from drivewright.studies.answers.factorial import crossed
from drivewright.studies.plan import Plan
from drivewright.studies.statistics import LEVEL, Summary, summary
from drivewright.studies.study import Study
from drivewright.studies.variables import Variable
from drivewright.units import System
from drivewright.view.text import quantity

BOUNDS = (("", ""), (".low", f", at least, with {LEVEL:.0%} confidence"), (".high", f", at most, with {LEVEL:.0%} confidence"))


@dataclass(frozen=True)
class Part:
    """Some of the answers: values, tables, how to look at them, findings."""

    values: Mapping[str, Value] = field(default_factory=dict)
    tables: tuple[Table, ...] = ()
    plots: tuple[Plot, ...] = ()
    findings: tuple[str, ...] = ()


class About(TypedDict):
    """Meaning and label of a value."""

    meaning: str
    label: str


def about(study: Study, name: str, what: str) -> About:
    """Meaning and label of a statistic of a column, `what` says which: "Maximum torque, mean of the sample"."""
    return About(meaning=f"{study.meaning(name) or name}: {what}", label=f"{study.label(name)}, {what}")


def together(parts: Iterable[Part]) -> Part:
    """One `Part` of several."""
    parts = tuple(parts)
    gathered = (tuple(item for part in parts for item in getattr(part, name)) for name in ("tables", "plots", "findings"))
    return Part({name: value for part in parts for name, value in part.values.items()}, *gathered)


@dataclass(frozen=True, eq=False)
class Arranged:
    """A study as arrays (combinations of levels, points that come with each), nan where a case is not there; `plotted` get plots.

    Of a study that is too large, `study` holds some of the cases, those of `numbers`, and `everything` says what there is of all.
    """

    study: Study
    plotted: tuple[str, ...]
    numbers: Ints | None = None
    everything: AllCases | None = None

    @cached_property
    def _crossed(self) -> tuple[Plan, Ints]:
        return crossed(self.study.plan)

    @property
    def plan(self) -> Plan:
        """The plan of the study; a file of points that is a full factorial as the levels that it combines."""
        return self._crossed[0]

    @property
    def whole_plan(self) -> Plan:
        """The plan of all cases of the study, also where only some are held."""
        return self.everything.plan if self.everything else self.study.plan

    @property
    def known_names(self) -> tuple[str, ...]:
        """Columns of the values, and of the margins of the checks."""
        return (*self.study.value_names, *(CHECK + name for name in self.study.check_names))

    @cached_property
    def combinations(self) -> int:
        """How many combinations of levels there are."""
        return len(self.plan) // self.plan.inner

    @cached_property
    def sample(self) -> Ints:
        """Rows of the points that are a random sample, or come from a file; none where there is only a grid, steps or corners."""
        return np.concatenate([np.zeros(0, dtype=int), *(np.arange(*ends) for ends in sample_ranges(self.plan))])

    def summaries(self, name: str) -> list[Summary]:
        """`Summary` of a column in the sample of each combination; of all cases, also where only some are held."""
        if self.everything and self.everything.samples:
            return [each.summaries[name] for each in self.everything.samples]
        return [summary(sample) for sample in self.of(name)[:, self.sample]]

    def block(self, name: str) -> slice | None:
        """Slice of the points of a block, or None."""
        block = self.plan.block(name)
        return slice(block.start, block.stop) if block else None

    def of(self, name: str) -> Floats:
        """A column by combination and point."""
        return self.arrange(np.asarray(self.study[name], dtype=float))

    def bounds(self, name: str) -> tuple[Floats, Floats] | None:
        """(low, high): the ends of a column's 95 % intervals by combination and point, nan where it has none; None where no case has."""
        ends = self.study.bounds(name)
        return None if ends is None else (self.arrange(ends[0]), self.arrange(ends[1]))

    def errors(self, name: str) -> Floats | None:
        """Standard errors of a column by combination and point, nan where it has none; None where no case has one."""
        errors = self.study.errors(name)
        return None if errors is None else self.arrange(errors)

    def at_worst(self, name: str, sign: float) -> Floats:
        """A column by combination and point, at the lower (sign -1) or upper (+1) end of each interval."""
        return self.arrange(self.study.at_worst(name, sign))

    def arrange(self, column: Floats) -> Floats:
        """Numbers of the rows of the table by combination and point."""
        arranged, cases = np.full(len(self.plan), np.nan), np.asarray(self.study[CASE], dtype=int)
        places = cases if self.numbers is None else np.searchsorted(self.numbers, cases)
        arranged[self._crossed[1][places]] = column
        return arranged.reshape(self.combinations, self.plan.inner)

    def tallies(self, check: str | None = None) -> list[Tally]:
        """`Tally` of a check, or of all together, in the sample of each combination; of all cases, also where only some are held."""
        if self.everything and self.everything.samples:
            return [each.checks[check] if check else each.together for each in self.everything.samples]
        if check:
            margin, *ends = (self.of(CHECK + check), *(self.at_worst(CHECK + check, sign) for sign in (-1, 1)))
            rows = [margin >= 0, *(end >= 0 for end in ends), np.isfinite(margin) | (self.status == 2)]
        else:
            rows = [self.passing == 1, *(end == 1 for end in self.passing_ends), np.isfinite(self.passing)]
        return [tally(*case) for case in zip(*(row[:, self.sample] for row in rows), strict=True)]

    @cached_property
    def status(self) -> Floats:
        """0 complete, 1 partial, 2 failed, by combination and point."""
        return self.arrange(status_codes(self.study).astype(float))

    @cached_property
    def passing(self) -> Floats:
        """1 where a case is complete and no check fails, else 0, by combination and point."""
        return self.arrange(passing(self.study).astype(float))

    @cached_property
    def passing_ends(self) -> tuple[Floats, Floats]:
        """The same for cases that surely pass, whatever the intervals hold, and for those that may pass."""
        surely, possibly = (self.arrange(passing(self.study, sign).astype(float)) for sign in (-1, 1))
        return surely, possibly

    def level_columns(self, rows: Sequence[int]) -> tuple[Column, ...]:
        """A `Column` for each key of the grid: its level in the combinations `rows`."""
        places = np.unravel_index(np.asarray(rows, dtype=int), self.plan.shape) if self.plan.grid else ()
        return tuple(
            Column(variable.key, variable.kind.unit, variable.key, plain(variable.grid_levels[place]))
            for variable, place in zip(self.plan.grid, places, strict=True)
        )


def level_text(variable: Variable, place: int, system: System) -> str:
    """A level as people read it in a system of units."""
    level = plain(variable.grid_levels)[place]
    return str(level) if isinstance(level, str) else quantity(level, variable.kind.unit, system=system)


def plain(column: NDArray[Any]) -> NDArray[Any]:
    """A column of numbers as it is; flags and texts as texts."""
    column = np.asarray(column)
    if column.dtype.kind == "b":
        return np.where(column, "true", "false")
    return column if column.dtype.kind in "iuf" else column.astype(str)


def estimate_values(
    arranged: Arranged, rows: Iterable[tuple[int, str, str, Any]], estimates: Mapping[str, tuple[str, str]]
) -> Iterator[tuple[str, Value]]:
    """(name, `Value`) of rows (combination, value, unit, estimates): `estimates` {prefix: (attribute with a `Sampled`, what it is)}."""
    for _, name, unit, estimate in rows:
        for prefix, (attribute, what) in estimates.items():
            yield f"{prefix}.{name}", getattr(estimate, attribute).named(unit, **about(arranged.study, name, what))


def table_of_rows(
    name: str, title: str, columns: Sequence[tuple[str, str, str]], rows: Sequence[Sequence[Any]], arranged: Arranged | None = None
) -> Table:
    """A `Table` of rows (combination, ...): `columns` (name, unit, meaning) of what follows, then the levels of the row's combination.

    Unit "" stands for the one that the row itself names.
    """
    filled = [Column(*head, np.array([row[number] for row in rows])) for number, head in enumerate(columns, 1)]
    return Table(name, title, (*filled, *(arranged.level_columns([row[0] for row in rows]) if arranged else ())))


def join_names(names: Sequence[str], most: int = 12) -> str:
    """Some names in one line."""
    more = len(names) - most
    return ", ".join(names[:most]) + (f" and {more} more" if more > 0 else "")
