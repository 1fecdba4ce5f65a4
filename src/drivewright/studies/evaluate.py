"""A batch of cases: the one function that every runner calls, here, in another process or on another machine.

Two routes: design by design through `runner`, or many designs at once through what the mechanism offers as `batch`.  A row depends on
its own design only, so neither the size of a batch nor who computes it changes a bit.
"""

import time
from functools import lru_cache
from threading import Lock
from typing import NamedTuple

import numpy as np

from drivewright import registry, runner
from drivewright.errors import DrivewrightError, InputError, SpecError, UnknownName
from drivewright.spec import document, from_document, set_key
from drivewright.studies.outputs import TOLD, looked_at
from drivewright.studies.study import CASE, MESSAGE, STATUS, first_fields
from drivewright.studies.variables import kind_of

LONGEST = 2000  # characters of a message
FEW = 4  # cases that are not worth a second route
ROUNDING = 1e-9  # of a value: no difference between two routes
PLACE = (ImportError, MemoryError)  # faults of the place where a case is computed, not of the case
OFFERED = "value."  # in front of a value that has the name of a key that varies


class Task(NamedTuple):
    """What to do with each case: the tables of the spec, the keys that vary, what to compute and what to keep.

    `names` are the values and checks to keep, with the ends of their intervals, () for all.  `compiled` are those that the mechanism's
    `batch` gives, with unit, meaning and whose interval they bound; where there are none, each case is a run.
    """

    tables: dict
    keys: tuple
    analyses: tuple = ()
    everything: bool = False
    names: tuple = ()
    compiled: tuple = ()
    version: str = ""


class Found(NamedTuple):
    """One case by the runner: `values` {name: Output} and what became of it."""

    values: dict
    status: str = "complete"
    message: str = ""


def task_of(spec, keys):
    """The `Task` of a spec and the keys that vary, design by design."""
    study, tables = spec.study, document(spec)
    for shared in ("study", "optimise"):
        tables.pop(shared, None)
    asked = (study.analyses, study.every_analysis, study.values) if study else ((), False, ())
    runner.selection(registry.mechanism(spec.mechanism).analyses, asked[0])
    return Task(tables, tuple(keys), *asked, version=runner.versions()["drivewright"])


def with_compiled(task, plan):
    """(Task, remarks): the same task by the compiled route where the mechanism offers one that gives the numbers of a run.

    First, middle and last case are run and compared.  Where the user names the values, an approximate route is taken, and a remark says
    how far it is off.
    """
    offer = registry.mechanism(task.tables["mechanism"]).batch
    if offer is None or len(plan) < FEW or not all(each.kind.numeric for each in plan.variables):
        return task, ()
    places = sorted({0, len(plan) // 2, len(plan) - 1})
    columns = {key: np.concatenate([plan.cases(n, n + 1)[key] for n in places]) for key in plan.keys}
    direct = _working(task)
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
    compiled = task._replace(compiled=tuple((name, *about[name]) for name in about))
    off = _difference(runs, _working(compiled).many(columns))
    if off <= ROUNDING:
        return compiled, ()
    remark = (
        f"the compiled route was taken for the values named; in the cases compared it differs from a run by {off:.1g} of a value at most"
    )
    return (compiled, (remark,)) if task.names else (task, ())


def _difference(runs, many):
    """Greatest difference of two routes, relative to the size of each value; what one of them lacks counts as all."""
    worst = 0.0
    silent = np.all([~np.isfinite(column) for column in many.values()], axis=0)  # these are run in any case
    for n, run in enumerate(runs):
        for name, column in () if silent[n] else many.items():
            value = run.values.get(name, (np.nan,))[0]
            if np.isfinite(value) or np.isfinite(column[n]):
                off = abs(column[n] - value) / max(abs(value), 1e-300) if column[n] != value else 0.0
                worst = max(worst, off if np.isfinite(off) else 1.0)
    return float(worst)


def refuse_unknown(task, plan):
    """SpecError for a value to keep that the first case does not have, where that case is complete."""
    if task.names and len(plan):
        found = _working(task._replace(names=())).case(plan.cases(0, 1), 0)
        for name in task.names:
            if found.status == "complete" and name not in found.values:
                raise SpecError(str(UnknownName("value of the first case", name, found.values)), "study.values")


def evaluate(task, first, columns):
    """(pyarrow.Table, seconds) of the cases from number `first` on, `columns` {key: values in SI}; one thread in the libraries, whose
    number of threads may change the bits of a matrix product."""
    from threadpoolctl import threadpool_limits

    started = time.perf_counter()
    with threadpool_limits(1):
        table = _working(task).table(first, columns)
    return table, time.perf_counter() - started


def failed(task, first, columns, reason):
    """The rows of cases that have no answer for a reason outside them."""
    count = len(next(iter(columns.values())))
    return _table(first, columns, _working(task).kinds, {}, {}, ["failed"] * count, [reason] * count)


def _working(task):
    """The `Working` of a task; found by its bytes, so that a copy that came from another process is known again."""
    return _of_pickle(_pickled(task))


def _pickled(task):
    import pickle

    return pickle.dumps(task)


@lru_cache(maxsize=4)
def _of_pickle(pickled):
    import pickle

    return Working(pickle.loads(pickled))


class Working:
    """A task made ready, once in each process."""

    def __init__(self, task):
        if task.version != runner.versions()["drivewright"]:
            raise InputError(
                f"drivewright {task.version} asks and {runner.versions()['drivewright']} would answer; install the same version "
                "on all workers"
            )
        self.task, self._alone = task, Lock()
        self.spec = from_document(task.tables)
        self.mechanism = registry.mechanism(self.spec.mechanism)
        self.wanted = runner.selection(self.mechanism.analyses, task.analyses, task.everything)
        self.kinds = {key: kind_of(self.spec, key) for key in task.keys}
        self.about = {name: tuple(about) for name, *about in task.compiled}
        self.batch = self.mechanism.batch(self.spec, task.keys, tuple(self.about)) if task.compiled else None

    def table(self, first, columns):
        """The rows of some cases."""
        count = len(next(iter(columns.values())))
        if self.batch is None:
            return _table(first, columns, self.kinds, *_gathered([self.case(columns, n) for n in range(count)]))
        values, about = self.many(columns), dict(self.about)
        silent = np.flatnonzero(np.all([~np.isfinite(column) for column in values.values()], axis=0))
        statuses, messages = ["complete"] * count, [""] * count
        for n in silent.tolist():
            found = self.case(columns, n)
            statuses[n], messages[n] = found.status, found.message
            for name, output in found.values.items():
                about.setdefault(name, output.about)
                values.setdefault(name, np.full(count, np.nan))[n] = output.value
        return _table(first, columns, self.kinds, values, about, statuses, messages)

    def many(self, columns):
        """{name: (n,)} by the mechanism's compiled route."""
        found = self._by_batch(np.stack([np.asarray(columns[key], float) for key in self.task.keys], axis=1))
        return {name: np.array(found[name], float) for name in self.about}

    def _by_batch(self, designs):
        """The same of designs (n, d); a design that it stumbles over is nan, and the others have their numbers."""
        try:
            return self.batch(designs)
        except Exception:
            if len(designs) == 1:
                return dict.fromkeys(self.about, np.array([np.nan]))
            halves = [self._by_batch(half) for half in np.array_split(designs, 2)]
            return {name: np.concatenate([half[name] for half in halves]) for name in self.about}

    def case(self, columns, n):
        """`Found` of case n of some columns; whatever goes wrong is its reason."""
        try:
            return self.found(self._spec(columns, n))
        except DrivewrightError as error:
            return Found({}, "failed", _short(error))
        except PLACE:
            raise
        except Exception as bug:  # one case in a million must not cost the others
            return Found({}, "failed", _short(f"a fault of the program, please report it: {type(bug).__name__}: {bug}"))

    def _spec(self, columns, n):
        """The spec of case n; one at a time, as all have the same tables and a process may have several threads."""
        with self._alone:
            for key, kind in self.kinds.items():
                set_key(self.task.tables, key, kind.given(columns[key][n]))
            return from_document(self.task.tables, type(self.spec))

    def found(self, spec):
        """`Found` of a spec: "partial" where an analysis failed or looked at a run that stopped, "failed" where that leaves no value."""
        asked = runner.ask(spec, self.mechanism.build(spec), self.wanted, None, PLACE)
        answers = asked.values()
        stated = {name: value for answer in answers for name, value in answer.values.items()}
        values = looked_at(stated, [check for answer in answers for check in answer.checks])
        if self.task.names:
            values = {
                name: values[name]
                for asked in self.task.names
                for name in (asked, *(f"{asked}{end}" for end in TOLD))
                if name in values and (name == asked or values[name].bounds == asked)
            }
        partial = any(answer.outcome == "partial" for answer in answers)
        status = "complete" if not partial else "partial" if values else "failed"
        return Found(values, status, _short("; ".join(runner.reasons(asked))))


def _short(reason):
    text = str(reason)
    return text if len(text) <= LONGEST else f"{text[: LONGEST - 4]} ..."


def _gathered(rows):
    """(values {name: (n,)}, about {name: (unit, meaning, bounds)}, statuses, messages) of rows by the runner."""
    about = {}
    for row in rows:
        for name, output in row.values.items():
            about.setdefault(name, output.about)
    values = {name: np.array([row.values[name][0] if name in row.values else np.nan for row in rows], float) for name in about}
    return values, about, [row.status for row in rows], [row.message for row in rows]


def _table(first, columns, kinds, values, about, statuses, messages):
    """The pyarrow.Table of some cases; what does not exist is null."""
    import pyarrow as pa

    fields = first_fields()
    arrays = [pa.array(np.arange(first, first + len(statuses))), pa.array(statuses, pa.string()), pa.array(messages, pa.string())]
    for key, kind in kinds.items():
        arrays.append(pa.array(columns[key]))
        unit = "" if columns[key].dtype == object else kind.unit
        fields.append(pa.field(key, arrays[-1].type, metadata={"unit": unit, "meaning": "varied"}))
    taken = {CASE, STATUS, MESSAGE, *kinds}
    for name, column in values.items():
        unit, meaning, owner = about[name]
        prefix = OFFERED if (owner or name) in taken or name in taken else ""
        bounds = {"bounds": f"{prefix}{owner}"} if owner else {}
        fields.append(pa.field(f"{prefix}{name}", pa.float64(), metadata={"unit": unit, "meaning": meaning, **bounds}))
        arrays.append(pa.array(column, pa.float64(), mask=~np.isfinite(column)))
    return pa.Table.from_arrays(arrays, schema=pa.schema(fields))
