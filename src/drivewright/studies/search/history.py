"""Every evaluation of a search as a table, a row each: what a folder keeps of it, and what a start after that reads."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from drivewright._typing import Floats, Ints
from drivewright.execution.case_table import CASE, MESSAGE, STATUS, VALUE_PREFIX, key_info
from drivewright.execution.outputs import OutputInfo
from drivewright.studies.search.problem import Problem
from drivewright.studies.store import Store, joined

if TYPE_CHECKING:
    import pyarrow as pa

GENERATION, VIOLATION = "generation", "violation"
GATHER = 1.0  # seconds of evaluations that make a part


def column_of(problem: Problem, name: str) -> str:
    """Name of a value's column; one that has the name of an unknown stands apart from it."""
    return f"{VALUE_PREFIX}{name}" if name in problem.keys else name


def rows(
    problem: Problem,
    first: int,
    generation: int,
    designs: Floats,
    values: Mapping[str, Floats],
    statuses: Sequence[str],
    messages: Sequence[str],
) -> pa.Table:
    """The pyarrow.Table of the evaluations from number `first` on; designs (m, n) SI, values {name: (m,)}, nan is null."""
    import pyarrow as pa

    count = len(designs)
    columns = [
        (CASE, np.arange(first, first + count), OutputInfo("-", "number of the evaluation")),
        (STATUS, pa.array(statuses, pa.string()), OutputInfo("", "complete, partial or failed", label="Status")),
        (MESSAGE, pa.array(messages, pa.string()), OutputInfo("", "why it is not complete", label="Message")),
        (GENERATION, np.full(count, generation), OutputInfo("-", "first generation with this design", label="Generation")),
    ]
    for key, kind, x in zip(problem.keys, problem.kinds, designs.T, strict=True):
        columns.append((key, x.astype(np.int64) if kind.name == "integer" else x, key_info(key, kind.unit, "unknown")))
    for name, about in problem.about.items():
        value = np.asarray(values[name], float)
        columns.append((column_of(problem, name), pa.array(value, pa.float64(), mask=~np.isfinite(value)), about))
    violation = problem.total_violation(usable(values, statuses))
    columns.append((VIOLATION, violation, OutputInfo("-", "sum of what is beyond the limits, each over its size", label="Violation")))
    arrays = [pa.array(data) for _, data, _ in columns]
    fields = [pa.field(name, array.type, metadata=about.metadata()) for array, (name, _, about) in zip(arrays, columns, strict=True)]
    return pa.Table.from_arrays(arrays, schema=pa.schema(fields))


def usable(values: Mapping[str, Floats], statuses: Sequence[str]) -> dict[str, Floats]:
    """The values as the search may see them: a design that is not complete has none."""
    complete = np.array([status == "complete" for status in statuses], bool)
    return {name: np.where(complete, column, np.nan) for name, column in values.items()}


def read(problem: Problem, table: pa.Table) -> tuple[Ints, Floats, dict[str, Floats]]:
    """(numbers (m,), designs (m, n), values {name: (m,)} as the search may see them) of a table of evaluations."""
    designs = np.stack([table[key].to_numpy().astype(float) for key in problem.keys], axis=1)
    values = {name: table[column_of(problem, name)].to_numpy().astype(float) for name in problem.names}
    return table[CASE].to_numpy(), designs, usable(values, table[STATUS].to_pylist())


class Journal:
    """Puts rows into a store, gathered to parts that are worth a file: the work of a second at least, or all there is at the end."""

    def __init__(self, kept: Store) -> None:
        self._kept, self._waiting, self._since = kept, {}, time.monotonic()

    def add(self, first: int, table: pa.Table, seconds: float) -> None:
        """Take rows; they are safe after the next `flush`, which comes within a second of work."""
        self._waiting[first] = table, seconds
        if time.monotonic() - self._since >= GATHER:
            self.flush()

    def flush(self) -> None:
        """Everything to the store; a Ctrl-C in the middle loses nothing and puts nothing there twice."""
        there = {first for first, _ in self._kept.ranges()}
        for run in _runs(self._waiting):
            if run[0] not in there:
                tables, seconds = zip(*(self._waiting[first] for first in run), strict=True)
                self._kept.add(run[0], joined(tables).combine_chunks(), sum(seconds))
        self._waiting.clear()
        self._since = time.monotonic()


def _runs(waiting):
    """Lists of the first numbers of tables that follow one another without a gap."""
    runs, end = [], None
    for first in sorted(waiting):
        if first == end:
            runs[-1].append(first)
        else:
            runs.append([first])
        end = first + waiting[first][0].num_rows
    return runs
