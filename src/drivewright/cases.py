"""Many cases through one function: same function, same answer, whatever the number of workers."""

import os
from collections.abc import Callable, Generator, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from contextlib import closing
from contextvars import copy_context
from dataclasses import dataclass
from typing import Any, Generic, NamedTuple, TypeAlias, TypeVar

from drivewright.errors import DrivewrightError, InputError, brief
from drivewright.stops import collect_stops

CaseT = TypeVar("CaseT")
ValueT = TypeVar("ValueT")


class Outcome(NamedTuple, Generic[CaseT, ValueT]):
    """What became of one case: `value` and no `reason`, or the reason why not and what the solver had until then (else None)."""

    case: CaseT
    value: ValueT
    reason: str = ""

    @property
    def ok(self) -> bool:
        """Whether the value is complete."""
        return not self.reason


@dataclass(frozen=True)
class Outcomes(Generic[CaseT, ValueT]):
    """The rows of a study in the order of the cases; after Ctrl-C those of the cases that were finished."""

    rows: tuple[Outcome[CaseT, ValueT], ...]
    interrupted: bool = False

    @property
    def failed(self) -> tuple[Outcome[CaseT, ValueT], ...]:
        """The rows that carry a reason."""
        return tuple(row for row in self.rows if not row.ok)


Rows: TypeAlias = dict[int, Outcome[CaseT, ValueT]]  # by number of the case


def run(
    task: Callable[[CaseT], ValueT],
    cases: Iterable[CaseT],
    workers: int | None = 1,
    progress: Callable[[int, int, str], object] | None = None,
) -> Outcomes[CaseT, ValueT]:
    """`Outcomes` of task(case) for every case, one after another or, with more workers, in as many threads (None: one per core).

    Threads gain where the task spends its time in compiled kernels, which run without the interpreter lock.  Every case runs with
    a copy of the caller's context (numpy's error handling), so the number of workers changes no answer; a random task must
    take its seed from its case.
    Our own errors become rows with the reason, and so do cases that look at a run which stopped.  Any other exception is a bug: no
    further case begins, and that of the first case in line to fail is raised, with a note that names the case.
    `progress(done, total, what)` is called from the caller's thread after each case; where it raises, no further case begins.
    Ctrl-C, or a KeyboardInterrupt from `progress`, lets the cases under way end (a second one does not wait for them) and returns
    the rows so far, `interrupted`; it goes on to the caller where there are none.
    """
    cases, workers = tuple(cases), worker_count(workers)
    rows: Rows[CaseT, ValueT] = {}
    interrupted = False
    steps = _in_threads(task, cases, workers, rows) if workers > 1 else _serially(task, cases, rows)
    try:
        with closing(steps):
            for done, _ in enumerate(steps, 1):
                if progress:
                    progress(done, len(cases), _failures(rows))
    except KeyboardInterrupt:
        if not rows:
            raise
        interrupted = True
    return Outcomes(tuple(rows[number] for number in sorted(rows)), interrupted)


def worker_count(workers: int | None) -> int:
    """How many workers are meant: a number, or be left out for one per core this process may use."""
    if workers is None:
        return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    if isinstance(workers, bool) or not isinstance(workers, int) or workers < 1:
        raise InputError(f"run: workers must be a whole number from 1 up, or be left out for one per core; got {brief(workers)}.")
    return workers


def _failures(rows: Rows[CaseT, ValueT]) -> str:
    """What to say beside the progress."""
    count = sum(not row.ok for row in tuple(rows.values()))
    return f"{count} without a complete answer" if count else ""


def _serially(task: Callable[[CaseT], ValueT], cases: Sequence[CaseT], rows: Rows[CaseT, ValueT]) -> Generator[None, None, None]:
    """Fills `rows` case by case, yields after each."""
    for number in range(len(cases)):
        copy_context().run(_attempt, task, cases, number, rows)
        yield


def _in_threads(
    task: Callable[[CaseT], ValueT], cases: Sequence[CaseT], workers: int, rows: Rows[CaseT, ValueT]
) -> Generator[None, None, None]:
    """Fills `rows` from a pool of threads, yields after each case; when closed, what has not begun is cancelled."""
    pool, futures = ThreadPoolExecutor(min(workers, max(1, len(cases)))), []
    try:
        futures.extend(pool.submit(copy_context().run, _attempt, task, cases, number, rows) for number in range(len(cases)))
        for future in as_completed(futures):
            if future.exception():
                break
            yield
    finally:
        pool.shutdown(cancel_futures=True)
    # Cases begin in their order, so all before a failed one have ended by now, and the first failure does not depend on the workers.
    for future in futures:
        if not future.cancelled():
            future.result()


def _attempt(task: Callable[[CaseT], Any], cases: Sequence[CaseT], number: int, rows: Rows[CaseT, Any]) -> None:
    """Files the outcome of one case.  The worker does it itself, so that nothing finished is lost, whenever Ctrl-C comes."""
    case = cases[number]
    try:
        with collect_stops() as stopped:
            value = task(case)
        rows[number] = Outcome(case, value, "; ".join(map(str, stopped)))
    except DrivewrightError as error:
        rows[number] = Outcome(case, getattr(error, "partial", None), str(error) or type(error).__name__)
    except Exception as bug:
        bug.add_note(f"in case {number + 1} of {len(cases)}: {brief(case)}")
        raise
