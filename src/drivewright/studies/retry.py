"""Cases of a study that have no whole answer, computed once more: what `sweep(..., retry="failed")` chooses, and where it puts the rows."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from drivewright._typing import Ints
from drivewright.errors import InputError, brief
from drivewright.execution.case_table import CASE, STATUS
from drivewright.spec import MechanismSpec, load
from drivewright.studies.parts import Part
from drivewright.studies.plan import Plan
from drivewright.studies.store import joined
from drivewright.studies.study_folder import Folder
from drivewright.studies.study_reading import SPEC

if TYPE_CHECKING:
    import pyarrow as pa

RETRIES = {"failed": ("failed",), "incomplete": ("failed", "partial")}  # {word: statuses of the cases that are computed once more}


def statuses_to_retry(retry: str | None) -> tuple[str, ...]:
    """The statuses that a word stands for; InputError for another word."""
    if retry is None:
        return ()
    if retry not in RETRIES:
        raise InputError(f"--retry {brief(retry)} names no cases; take {' or '.join(RETRIES)}")
    return RETRIES[retry]


def with_plan_of(spec: MechanismSpec, folder: str | Path) -> MechanismSpec:
    """A spec without a [study] with that of the study in a folder, so that a retry need not say again what varies."""
    return spec if spec.study is not None else spec.model_copy(update={"study": load(Path(folder) / SPEC).study})


class Chosen:
    """Some cases of a plan, numbered from 0 in the order of their `numbers` in the plan."""

    def __init__(self, plan: Plan, numbers: Ints) -> None:
        self.keys, self.numeric, self.numbers, self._plan = plan.keys, plan.numeric, numbers, plan

    keys: tuple[str, ...]
    numeric: bool
    numbers: Ints

    def __len__(self) -> int:
        return len(self.numbers)

    def cases(self, first: int, stop: int) -> Mapping[str, NDArray[Any]]:
        """{key: values} of the chosen cases from `first` up to `stop`, SI."""
        return self._plan.at(self.numbers[first:stop])


class Retry:
    """The cases of a folder that have one of some statuses: `cases` to compute, and `add` for the rows that come of them.

    A part of the study is written anew as soon as all its new rows are there; every other row in it stays as it is.
    """

    def __init__(self, kept: Folder, plan: Plan, statuses: tuple[str, ...]) -> None:
        self._kept, self._statuses = kept, statuses
        self._missing: dict[Part, set[int]] = {}
        for part in kept.parts() if statuses else ():
            if numbers := _numbers(kept.part_rows(part), statuses):
                self._missing[part] = set(numbers)
        self._rows: dict[Part, list[pa.Table]] = {part: [] for part in self._missing}
        self._seconds = dict.fromkeys(self._missing, 0.0)
        self._complete = self._written = 0
        self._partial = sum(_count(kept.part_rows(part), "partial") for part in kept.parts()) if not self._missing else 0
        self.cases = Chosen(plan, np.array(sorted(number for numbers in self._missing.values() for number in numbers), dtype=np.int64))

    def add(self, first: int, table: pa.Table, seconds: float) -> None:
        """Take the rows of chosen cases, numbered from `first` on as in `cases`."""
        import pyarrow as pa

        numbers = self.cases.numbers[first : first + table.num_rows]
        table = table.set_column(0, table.schema.field(CASE), pa.array(numbers))
        for part in list(self._missing):
            inside = (numbers >= part.first) & (numbers < part.first + part.count)
            if inside.any():
                self._rows[part].append(table.filter(pa.array(inside)))
                self._seconds[part] += seconds * inside.mean()
                self._missing[part] -= set(numbers[inside].tolist())
                if not self._missing[part]:
                    self._write(part)

    def _write(self, part: Part) -> None:
        rows = joined(self._rows.pop(part))
        self._kept.rewrite(part, merged(self._kept.part_rows(part), rows), self._seconds[part])
        self._written += rows.num_rows
        self._complete += _count(rows, "complete")
        del self._missing[part]

    def outcome(self) -> str:
        """What became of the chosen cases, in a sentence."""
        had, are = ("is incomplete", "that were incomplete") if "partial" in self._statuses else ("has failed", "that had failed")
        if not len(self.cases):
            partial = f": 0 failed, {self._partial} partial, which --retry incomplete computes once more" if self._partial else ""
            return f"no case of this study {had}, so none is computed once more{partial}"
        cases = "case" if len(self.cases) == 1 else "cases"
        told = f"{self._written} of {len(self.cases)} {cases} {are}: computed once more, {self._complete} complete now"
        left = len(self.cases) - self._written
        return f"{told}; the same command computes the other {left}" if left else told


def _count(table: pa.Table, status: str) -> int:
    return table[STATUS].to_pylist().count(status)


def _numbers(table: pa.Table, statuses: tuple[str, ...]) -> list[int]:
    """Numbers of the cases of a table that have one of some statuses."""
    return [number for number, status in zip(table[CASE].to_pylist(), table[STATUS].to_pylist(), strict=True) if status in statuses]


def merged(old: pa.Table, new: pa.Table) -> pa.Table:
    """The rows of a part with some of them replaced, as if all had been computed at once: columns in the order in which rows bring them."""
    import pyarrow as pa

    order = np.asarray(old[CASE].to_numpy())
    is_new = np.isin(order, new[CASE].to_numpy())
    new = new.take(np.argsort(new[CASE].to_numpy(), kind="stable"))
    ends = [0, *(np.flatnonzero(np.diff(is_new)) + 1).tolist(), len(order)]
    pieces, place = [], 0
    for start, stop in zip(ends, ends[1:], strict=False):
        if is_new[start]:
            pieces.append(new.slice(place, stop - start))
            place += stop - start
        else:
            pieces.append(old.slice(start, stop - start))
    brought = [_with_values(piece, pa.types.is_floating) for piece in pieces]
    return joined([*brought, *(whole.slice(0, 0) for whole in (old, new))])


def _with_values(table: pa.Table, may_be_left: Any) -> pa.Table:
    """A table without the columns in which none of its rows has a number; what every row has stays."""
    named = [f.name for f in table.schema if not may_be_left(f.type) or table[f.name].null_count < table.num_rows]
    return table.select(named)
