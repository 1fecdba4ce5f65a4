"""The cases of a batch: the one function that every executor calls, here, in another process or on another machine.

Two routes: design by design through `runner`, or many designs at once through what the mechanism offers as `batch`.  A row depends on
its own design only, so neither the size of a batch nor who computes it changes a bit.
"""

from __future__ import annotations

import pickle
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import lru_cache
from threading import Lock
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

import numpy as np

from drivewright import registry, runner
from drivewright._typing import Floats
from drivewright.errors import DrivewrightError, InputError, SpecError, UnknownName
from drivewright.execution.case_table import Columns, case_table
from drivewright.execution.keys import KeyKind, key_kind
from drivewright.execution.outputs import INTERVAL_PARTS, Output, OutputInfo, case_outputs
from drivewright.spec import MechanismSpec, document, from_document, set_key
from drivewright.spec.shared_tables import share_tables

if TYPE_CHECKING:
    import pyarrow as pa

LONGEST = 2000  # characters of a message
FEW = 4  # cases that are not worth a second route
ROUNDING = 1e-9  # of a value: no difference between two routes
PLACE_ERRORS = (ImportError, MemoryError)  # faults of the place where a case is computed, not of the case


class CaseTask(NamedTuple):
    """What to do with each case: the tables of the spec, the keys that vary, what to compute and what to keep.

    `names` are the values and checks to keep, with the ends of their intervals, () for all.  `compiled` are those that the mechanism's
    `batch` gives, with unit, meaning and whose interval they bound; where there are none, each case is a run.
    """

    tables: dict[str, Any]
    keys: tuple[str, ...]
    analyses: tuple[str, ...] = ()
    everything: bool = False
    names: tuple[str, ...] = ()
    compiled: tuple[tuple[str, OutputInfo], ...] = ()
    version: str = ""


class CaseResult(NamedTuple):
    """One case by the runner: `values` {name: Output} and what became of it."""

    values: Mapping[str, Output]
    status: str = "complete"
    message: str = ""


class BatchValues(NamedTuple):
    """What the mechanism's `batch` gives: `values` {name: (n,)}, nan for what it does not cover, and its faults {number of
    the case: error}."""

    values: dict[str, Floats]
    faults: dict[int, Exception]

    @property
    def uncovered(self) -> list[int]:
        """Numbers of the cases that have no value at all, and no fault."""
        absent = np.all([~np.isfinite(column) for column in self.values.values()], axis=0)
        return [n for n in np.flatnonzero(absent).tolist() if n not in self.faults]


class Cases(Protocol):
    """The cases of a study by their numbers, such as a plan."""

    @property
    def keys(self) -> tuple[str, ...]:
        """Dotted keys that vary."""
        ...

    @property
    def numeric(self) -> bool:
        """Whether every key that varies takes numbers."""
        ...

    def __len__(self) -> int: ...

    def cases(self, first: int, stop: int) -> Columns:
        """{key: values} of the cases from `first` up to `stop`, SI."""
        ...


def case_task(spec: MechanismSpec, keys: Iterable[str]) -> CaseTask:
    """The `CaseTask` of a spec and the keys that vary, design by design."""
    study, tables = spec.study, document(spec)
    for shared in ("study", "optimise"):
        tables.pop(shared, None)
    requested = (study.analyses, study.every_analysis, study.values) if study else ((), False, ())
    runner.select_analyses(registry.mechanism(spec.mechanism).analyses, requested[0])
    return CaseTask(tables, tuple(keys), *requested, version=runner.versions()["drivewright"])


def with_batch(task: CaseTask, plan: Cases) -> tuple[CaseTask, tuple[str, ...]]:
    """(CaseTask, remarks): the same task by the compiled route where the mechanism offers one that gives the numbers of a run.

    First, middle and last case are run and compared.  Where the user names the values, an approximate route is taken, and a remark says
    how far it is off.  A remark also says where the compiled route has a fault.
    """
    offer = registry.mechanism(task.tables["mechanism"]).batch
    if offer is None or len(plan) < FEW or not plan.numeric:
        return task, ()
    places = sorted({0, len(plan) // 2, len(plan) - 1})
    columns = {key: np.concatenate([plan.cases(n, n + 1)[key] for n in places]) for key in plan.keys}
    direct = _prepared(task)
    if any(column.dtype == object for column in columns.values()) or offer(direct.spec, task.keys, task.names) is None:
        return task, ()
    runs = [direct.case(columns, 0)]
    if offer(direct.spec, task.keys, tuple(runs[0].values)) is None:
        return task, ()
    runs += [direct.case(columns, n) for n in range(1, len(places))]
    about = {name: output.about for run in runs for name, output in run.values.items()}
    whole = all(run.status == "failed" or (run.status == "complete" and not run.message) for run in runs)
    if not about or not whole or offer(direct.spec, task.keys, tuple(about)) is None:
        return task, ()
    compiled = task._replace(compiled=tuple(about.items()))
    batch = _prepared(compiled).batch_values(columns)
    if batch.faults:
        return task, (f"the compiled route was not taken: {_fault(next(iter(batch.faults.values())))}",)
    difference = _difference(runs, batch)
    if difference <= ROUNDING:
        return compiled, ()
    remark = (
        "the compiled route was taken for the values named; in the cases compared it differs from a run by "
        f"{difference:.1g} of a value at most"
    )
    return (compiled, (remark,)) if task.names else (task, ())


def _difference(runs: Sequence[CaseResult], batch: BatchValues) -> float:
    """Greatest difference of two routes, relative to the size of each value; what one of them lacks counts as all."""
    worst, uncovered = 0.0, batch.uncovered  # the latter are run in any case
    for n, run in enumerate(runs):
        for name, column in () if n in uncovered else batch.values.items():
            value = run.values[name].value if name in run.values else np.nan
            if np.isfinite(value) or np.isfinite(column[n]):
                off = abs(column[n] - value) / max(abs(value), 1e-300) if column[n] != value else 0.0
                worst = max(worst, off if np.isfinite(off) else 1.0)
    return float(worst)


def refuse_unknown(task: CaseTask, plan: Cases) -> None:
    """SpecError for a value to keep that the first case does not have, where that case is complete."""
    if task.names and len(plan):
        first = _prepared(task._replace(names=())).case(plan.cases(0, 1), 0)
        for name in task.names:
            if first.status == "complete" and name not in first.values:
                raise SpecError(str(UnknownName("value of the first case", name, first.values)), "study.values")


def evaluate(task: CaseTask, first: int, columns: Columns) -> tuple[pa.Table, float]:
    """(table, seconds) of the cases from number `first` on, `columns` {key: values in SI}; one thread in the libraries, whose number of
    threads may change the bits of a matrix product."""
    from threadpoolctl import threadpool_limits

    started = time.perf_counter()
    with threadpool_limits(1):
        table = _prepared(task).table(first, columns)
    return table, time.perf_counter() - started


def failed_rows(task: CaseTask, first: int, columns: Columns, reason: str) -> pa.Table:
    """The rows of cases that have no answer for a reason outside them."""
    count = len(next(iter(columns.values())))
    return case_table(first, columns, _prepared(task).kinds, {}, {}, ["failed"] * count, [reason] * count)


def _prepared(task: CaseTask) -> PreparedTask:
    """The `PreparedTask` of a task; recognised by its bytes, so that a copy that came from another process is known again."""
    return _prepared_from(pickle.dumps(task))


@lru_cache(maxsize=4)
def _prepared_from(pickled: bytes) -> PreparedTask:
    return PreparedTask(pickle.loads(pickled))


class PreparedTask:
    """A task made ready, once in each process."""

    def __init__(self, task: CaseTask) -> None:
        if task.version != runner.versions()["drivewright"]:
            raise InputError(
                f"the study is computed by drivewright {task.version}, and this worker has {runner.versions()['drivewright']}; "
                "install the same version on all workers"
            )
        self.task, self._alone = task, Lock()
        self.spec: MechanismSpec = from_document(task.tables)
        self._shared = share_tables(task.tables, self.spec, task.keys)
        self.mechanism = registry.mechanism(self.spec.mechanism)
        self.analyses = runner.select_analyses(self.mechanism.analyses, task.analyses, task.everything)
        self.kinds: dict[str, KeyKind] = {key: key_kind(self.spec, key) for key in task.keys}
        self.about = dict(task.compiled)
        offer = self.mechanism.batch if task.compiled else None
        self.batch: Callable[[Floats], Mapping[str, Floats]] | None = offer(self.spec, task.keys, tuple(self.about)) if offer else None

    def table(self, first: int, columns: Columns) -> pa.Table:
        """The rows of some cases."""
        count = len(next(iter(columns.values())))
        if self.batch is None:
            return case_table(first, columns, self.kinds, *_gathered([self.case(columns, n) for n in range(count)]))
        batch, about = self.batch_values(columns), dict(self.about)
        values, statuses, messages = batch.values, ["complete"] * count, [""] * count
        for n in batch.uncovered:
            case = self.case(columns, n)
            statuses[n], messages[n] = case.status, case.message
            for name, output in case.values.items():
                about.setdefault(name, output.about)
                values.setdefault(name, np.full(count, np.nan))[n] = output.value
        for n, fault in batch.faults.items():
            statuses[n], messages[n] = "failed", _fault(fault)
        return case_table(first, columns, self.kinds, values, about, statuses, messages)

    def batch_values(self, columns: Columns) -> BatchValues:
        """`BatchValues` of some cases by the mechanism's compiled route."""
        return self._by_batch(np.stack([np.asarray(columns[key], float) for key in self.task.keys], axis=1))

    def _by_batch(self, designs: Floats) -> BatchValues:
        """The same of designs (n, d); one that fails is nan, and the others have their numbers.

        An error of ours says that the batch does not cover the design; any other one is a fault of the program.
        """
        assert self.batch is not None
        try:
            given = self.batch(designs)
        except Exception as error:
            if isinstance(error, ImportError) or (isinstance(error, MemoryError) and len(designs) == 1):
                raise
            if len(designs) == 1:
                return BatchValues(
                    {name: np.array([np.nan]) for name in self.about}, {} if isinstance(error, DrivewrightError) else {0: error}
                )
            first, second = (self._by_batch(half) for half in np.array_split(designs, 2))
            values = {name: np.concatenate([first.values[name], second.values[name]]) for name in self.about}
            place = len(designs) - len(designs) // 2
            return BatchValues(values, first.faults | {place + n: fault for n, fault in second.faults.items()})
        return BatchValues({name: np.array(given[name], float) for name in self.about}, {})

    def case(self, columns: Columns, n: int) -> CaseResult:
        """`CaseResult` of case n of some columns; whatever goes wrong is its reason."""
        try:
            return self.run(self._spec(columns, n))
        except DrivewrightError as error:
            return CaseResult({}, "failed", _short(str(error)))
        except PLACE_ERRORS:
            raise
        except Exception as error:  # one case in a million must not cost the others
            return CaseResult({}, "failed", _fault(error))

    def _spec(self, columns: Columns, n: int) -> MechanismSpec:
        """The spec of case n; one at a time, as all have the same tables and a process may have several threads."""
        given = {key: kind.given(columns[key][n]) for key, kind in self.kinds.items()}
        with self._alone:
            try:
                return _changed(self._shared, given, type(self.spec))
            except SpecError:  # once more from raw tables only, which the message may quote
                return _changed(self.task.tables, given, type(self.spec))

    def run(self, spec: MechanismSpec) -> CaseResult:
        """`CaseResult` of a spec: "partial" where an analysis failed or used a run that stopped, "failed" where that leaves no value."""
        by_analysis = runner.run_analyses(spec, self.mechanism.build(spec), self.analyses, None, PLACE_ERRORS)
        answers = by_analysis.values()
        stated = {name: value for answer in answers for name, value in answer.values.items()}
        values = case_outputs(stated, [check for answer in answers for check in answer.checks])
        if self.task.names:
            values = {
                name: values[name]
                for requested in self.task.names
                for name in (requested, *(f"{requested}{end}" for end in INTERVAL_PARTS))
                if name in values and (name == requested or values[name].bounds == requested)
            }
        partial = any(answer.outcome == "partial" for answer in answers)
        status = "complete" if not partial else "partial" if values else "failed"
        return CaseResult(values, status, _short("; ".join(runner.incomplete_reasons(by_analysis))))


def _changed(tables: dict[str, Any], given: Mapping[str, Any], model: type[MechanismSpec]) -> MechanismSpec:
    """The spec of a class from raw tables in which some keys are set, in place."""
    for key, value in given.items():
        set_key(tables, key, value)
    return from_document(tables, model)


def _fault(error: Exception) -> str:
    """The message of a case that fails by a fault of the program."""
    return _short(f"a fault of the program, please report it: {type(error).__name__}: {error}")


def _short(text: str) -> str:
    return text if len(text) <= LONGEST else f"{text[: LONGEST - 4]} ..."


def _gathered(rows: Sequence[CaseResult]) -> tuple[dict[str, Floats], dict[str, OutputInfo], list[str], list[str]]:
    """(values {name: (n,)}, about {name: OutputInfo}, statuses, messages) of rows by the runner."""
    about: dict[str, OutputInfo] = {}
    for row in rows:
        for name, output in row.values.items():
            if name not in about:
                about[name] = output.about
    values = {name: np.array([row.values[name].value if name in row.values else np.nan for row in rows], float) for name in about}
    return values, about, [row.status for row in rows], [row.message for row in rows]
