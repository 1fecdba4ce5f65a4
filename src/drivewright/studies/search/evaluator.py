"""The designs of a search and their values: each is evaluated once, kept, and never again, also not after a new start."""

from __future__ import annotations

from collections.abc import Callable, Generator, Mapping, Sequence
from contextlib import closing
from typing import NamedTuple, TypeAlias

import numpy as np

from drivewright import registry
from drivewright._typing import Floats
from drivewright.errors import InputError
from drivewright.execution.batches import WORTH_HELP, Batch, BatchScheduler, missing_ranges, run_batches
from drivewright.execution.case_table import MESSAGE, STATUS
from drivewright.execution.evaluation import case_task, evaluate, failed_rows
from drivewright.execution.executors import InProcessExecutor, make_executors
from drivewright.studies.search import history
from drivewright.studies.search.problem import Problem
from drivewright.studies.search.searching import most_evaluations, population_of
from drivewright.studies.store import Store, joined

Progress: TypeAlias = Callable[[int, int, str], object]  # (done, total, what became of them)
SILENT = "the compiled evaluation finds no solution; a run of this design says why"


class Rows(NamedTuple):
    """Evaluated designs from number `first` on: values {name: (m,)}, what became of each, and the seconds it took."""

    first: int
    values: dict[str, Floats]
    statuses: list[str]
    messages: list[str]
    seconds: float


class Evaluator:
    """`evaluator(points)` with the points (m, n) of a generation gives {name: (m,)}; it is the same search each time, so what `kept` holds
    of an earlier start answers for the designs with the same numbers.  InputError where they are not the same designs."""

    def __init__(
        self, problem: Problem, kept: Store, workers: int | None = None, on: str | None = None, progress: Progress | None = None
    ) -> None:
        self.problem, self.generations = problem, problem.search.generations
        self.progress = progress or (lambda done, total, what: None)
        self.designs = []  # of each generation those that it brought
        self._answers = {}  # design (bytes) -> values, in the order of their numbers
        self._found = _kept(problem, kept)  # number -> (design, values) not asked for yet
        self._kept_count, self._most = len(self._found), most_evaluations(problem.search)
        self._journal = history.Journal(kept)
        self._compute = compiled(problem) or Runs(problem, workers, on)

    def __call__(self, points: Floats) -> dict[str, Floats]:
        designs = self.problem.designs(points)
        new = {key: row for key, row in zip(map(bytes, designs), designs, strict=True) if key not in self._answers}
        self._fill(np.array(list(new.values())).reshape(-1, designs.shape[1]))
        for number, key in enumerate(new, len(self._answers)):
            self._answers[key] = self._found.pop(number)[1]
        return self.values(points)

    def values(self, points: Floats) -> dict[str, Floats]:
        """{name: (m,)} at points that have been evaluated."""
        rows = np.array([self._answers[key] for key in map(bytes, self.problem.designs(points))])
        return dict(zip(self.problem.names, rows.reshape(-1, len(self.problem.names)).T, strict=True))

    def _fill(self, designs):
        """Find what is known of a generation's new designs, and evaluate the others."""
        first, generation = len(self._answers), len(self.designs)
        have = [number for number in range(first, first + len(designs)) if number in self._found]
        if any(bytes(self._found[number][0]) != bytes(designs[number - first]) for number in have):
            raise InputError(
                f"the search computes other designs than those in the folder, from evaluation {first} on: another version of "
                "NumPy, SciPy or pymoo, or another machine. Continue on the original one, or give another --out"
            )
        done, ahead = first + len(have), (self.generations - generation) * population_of(self.problem.search)
        if len(have) < len(designs):
            with closing(self._compute(first, designs, have, ahead)) as each:
                for batch in each:
                    self._keep(batch, generation, designs[batch.first - first :][: len(batch.statuses)])
                    done += len(batch.statuses)
                    self._tell(done)
        self.designs.append(designs)
        self._tell(done)

    def begin(self) -> None:
        """Tell how many designs are known before the search begins."""
        self._tell(0)

    def _tell(self, done):
        """How many designs are evaluated, of those that all generations could ask for."""
        self.progress(max(done, self._kept_count), self._most, f"generation {len(self.designs) + 1}")

    def _keep(self, batch, generation, designs):
        values = history.usable(batch.values, batch.statuses)
        for number, (design, *row) in enumerate(zip(designs, *(values[name] for name in self.problem.names), strict=True), batch.first):
            self._found[number] = design, np.array(row)
        table = history.rows(self.problem, batch.first, generation, designs, batch.values, batch.statuses, batch.messages)
        self._journal.add(batch.first, table, batch.seconds)

    def close(self) -> None:
        """What is evaluated goes to the store, whatever ends the search."""
        try:
            self._journal.flush()
        finally:
            self._compute.close()


def _kept(problem, kept):
    """{number: (design, values)} of what a store holds."""
    tables = kept.tables()
    if not tables:
        return {}
    numbers, designs, values = history.read(problem, joined(tables))
    rows = np.stack([values[name] for name in problem.names], axis=1)
    return {number: (design, row) for number, design, row in zip(numbers.tolist(), designs, rows, strict=True)}


# -- who computes --------------------------------------------------------------------------------------------------------------


def _missing(first, designs, have):
    """[(number, number after the last)] of the new designs that are not kept."""
    return missing_ranges([(0, first), *((number, 1) for number in have)], first + len(designs))


def compiled(problem: Problem) -> Compiled | None:
    """Evaluation of a whole generation by what the mechanism offers as `batch`; None where it has none for this problem."""
    offer = registry.mechanism(problem.spec.mechanism).batch
    many = offer(problem.spec, problem.keys, problem.names) if offer else None
    return Compiled(problem, many) if many else None


class Compiled:
    """All missing designs of a generation in one call."""

    def __init__(self, problem: Problem, many: Callable[[Floats], Mapping[str, Floats]]) -> None:
        self._problem, self._many = problem, many

    def __call__(self, first: int, designs: Floats, have: Sequence[int], ahead: int) -> Generator[Rows, None, None]:
        for start, stop in _missing(first, designs, have):
            columns = self._many(designs[start - first : stop - first])
            values = {name: np.asarray(columns[name], float) for name in self._problem.names}
            silent = np.all([~np.isfinite(column) for column in values.values()], axis=0).tolist()
            statuses, messages = ["failed" if no else "complete" for no in silent], [SILENT if no else "" for no in silent]
            yield Rows(start, values, statuses, messages, 0.0)

    def close(self) -> None:
        """Nothing to let go."""


class Runs:
    """Design by design through the runner, by executors.

    Where nobody says who is to compute, this process begins, and has help as soon as the search would take long alone.
    """

    def __init__(self, problem: Problem, workers: int | None, on: str | None) -> None:
        bare = problem.spec.model_copy(update={"study": None})
        self._task = case_task(bare, problem.keys)._replace(analyses=problem.analyses, names=problem.names)
        self._problem, self._place = problem, (workers, on)
        self._alone, self._executors = workers is None and on is None, ()
        self._count, self._seconds = 0, 0.0  # of what is done

    def __call__(self, first: int, designs: Floats, have: Sequence[int], ahead: int) -> Generator[Rows, None, None]:
        scheduler = BatchScheduler([(0, first), *((number, 1) for number in have)], first + len(designs), 1)
        if self._count:
            scheduler.record_timing(Batch(0, self._count), self._seconds)

        def arguments(batch):
            return self._task, batch.first, self._columns(designs[batch.first - first : batch.stop - first])

        if self._alone:
            self._executors = self._executors or (InProcessExecutor(),)
            yield from self._by(arguments, scheduler, lambda: self._wants_help(ahead))
            if not scheduler:
                return
            self.close()
            self._alone = False
        self._executors = self._executors or make_executors(*self._place)
        yield from self._by(arguments, scheduler)

    def _by(self, arguments, scheduler, enough=lambda: False):
        for batch, table, seconds, reason in run_batches(self._executors, evaluate, arguments, scheduler, enough):
            if table is None:
                table = failed_rows(*arguments(batch), reason)
            else:
                self._count, self._seconds = self._count + table.num_rows, self._seconds + seconds
            yield Rows(batch.first, self._values(table), table[STATUS].to_pylist(), table[MESSAGE].to_pylist(), seconds)

    def _wants_help(self, ahead):
        return self._count > 0 and ahead * self._seconds / self._count > WORTH_HELP

    def _columns(self, designs):
        kinds = self._problem.kinds
        return {
            key: x.astype(np.int64) if kind.name == "integer" else x
            for key, kind, x in zip(self._problem.keys, kinds, designs.T, strict=True)
        }

    def _values(self, table):
        """{name: (m,)} of evaluated rows, nan where a design has none; where no design has one, there is no column."""
        columns, absent = {name: history.column_of(self._problem, name) for name in self._problem.names}, np.full(table.num_rows, np.nan)
        return {
            name: table[column].to_numpy().astype(float) if column in table.column_names else absent for name, column in columns.items()
        }

    def close(self) -> None:
        """Let the executors go."""
        executors, self._executors = self._executors, ()
        for executor in executors:
            executor.close()
