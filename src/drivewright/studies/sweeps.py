"""A study from its plan to its rows: `sweep(spec)` computes what is not there yet and keeps it."""

from __future__ import annotations

from collections.abc import Callable, Generator, Mapping
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from drivewright.errors import InputError
from drivewright.execution.batches import WORTH_HELP, Batch, BatchResult, BatchScheduler, run_batches
from drivewright.execution.case_table import STATUS, Columns
from drivewright.execution.evaluation import Cases, CaseTask, case_task, evaluate, failed_rows, refuse_unknown, with_batch
from drivewright.execution.executors import Executor, InProcessExecutor, check_location, make_executors
from drivewright.runner import versions
from drivewright.spec import MechanismSpec
from drivewright.spec.serialisation import canonical_text
from drivewright.studies.parts import damage_text
from drivewright.studies.plan import Plan, make_plan
from drivewright.studies.retry import Retry, statuses_to_retry, with_plan_of
from drivewright.studies.store import Memory, Store
from drivewright.studies.study import Study
from drivewright.studies.study_folder import Folder
from drivewright.studies.study_reading import is_study, read_study
from drivewright.studies.variation import with_variation

if TYPE_CHECKING:
    import pyarrow as pa

Progress: TypeAlias = Callable[[int, int, str], object]  # (done, total, what became of them)
MANY = 200_000  # cases above which a confirmation is required


def sweep(
    spec: MechanismSpec,
    vary: Mapping[str, Any] | None = None,
    *,
    out: str | Path | None = None,
    workers: int | None = None,
    on: str | None = None,
    confirmed: bool = True,
    progress: Progress | None = None,
    retry: str | None = None,
) -> Study:
    """`Study` of a spec: one row for every case of its [study], or of `vary` {key: levels or distribution}, see `variation`.

    `out` is the folder it lives in: what is there already is not computed again, and a study stopped in any way goes on where it was.
    None keeps it in memory.  `workers` processes (None: one per core); `on` names another place to compute, see `execution.executors`.
    Neither changes a bit of any row.  `progress(done, total, what)` is called after each batch.  Ctrl-C, also from `progress`, returns
    what is there, `interrupted`.

    `retry` "failed" computes the cases of a study in `out` once more that have failed, "incomplete" the partial ones too, and then what is
    not there yet; all other rows stay.  A spec without a [study] takes that of the folder.  A notice says what became of them.
    """
    spec = spec if vary is None else with_variation(spec, vary)
    check_location(workers, on)
    statuses = statuses_to_retry(retry)
    if statuses:
        spec = with_plan_of(spec, _with_study(out))
    plan = make_plan(spec)
    if len(plan) > MANY and not confirmed:
        raise InputError(f"{len(plan)} cases are more than {MANY}; give --yes to confirm, or take fewer levels or samples")
    task = case_task(spec, plan.keys)
    kept = Folder(out, spec, study_identity(spec, plan)) if out is not None else Memory()
    with closing(kept):
        if not statuses or not isinstance(kept, Folder):
            return compute_study(kept, spec, plan, task, workers, on, progress)
        again = Retry(kept, plan, statuses)
        if _compute_again(kept, task, plan, again, workers, on, progress or _no_progress):
            study = _study(kept, spec, plan, interrupted=True)
        else:
            study = compute_study(kept, spec, plan, task, workers, on, progress)
        return replace(study, notices=(*study.notices, again.outcome()))


def _with_study(folder: str | Path | None) -> str | Path:
    """The folder; InputError where there is no study in it whose cases could be computed once more."""
    if folder is None or not is_study(folder):
        raise InputError(f"{folder or 'a study in memory'}: holds no study yet, so it has no case to retry; leave --retry out to begin it")
    return folder


def compute_study(
    kept: Store,
    spec: MechanismSpec,
    plan: Plan,
    task: CaseTask,
    workers: int | None = None,
    on: str | None = None,
    progress: Progress | None = None,
) -> Study:
    """`Study` of the cases of a plan, whoever made it; they go to the store `kept` as they are done.  The rest as of `sweep`."""
    return _study(kept, spec, plan, _fill(kept, task, plan, workers, on, progress or _no_progress))


def _study(kept: Store, spec: MechanismSpec, plan: Plan, interrupted: bool) -> Study:
    """What is there."""
    return Study(spec, plan, kept.rows(), kept.folder, kept.seconds, kept.remarks(), interrupted, tuple(kept.notices))


def open_study(folder: str | Path, *, skip_damaged: bool = False) -> Study:
    """`Study` of a folder as far as it has come; another process may be at work on it.

    InputError where a part is not what was written; with `skip_damaged` its rows are left out, and `notices` says which.
    """
    kept = read_study(folder)
    if "plan" not in kept.identity:
        raise InputError(f"{folder}: holds a search, not a study; its table is history.parquet")
    plan = make_plan(kept.spec)
    if plan.digest != kept.identity["plan"]:
        raise InputError(
            f"{folder}: its points cannot be made again here: another version of SciPy or NumPy. Its rows are in {folder}/parts"
        )
    if kept.damaged and not skip_damaged:
        raise InputError(damage_text(Path(folder), kept.damaged))
    notices = (damage_text(Path(folder), kept.damaged),) if kept.damaged else ()
    return Study(kept.spec, plan, kept.rows, Path(folder).resolve(), kept.seconds, kept.remarks, notices=notices, damaged=len(kept.damaged))


def rerun_cases(study: Study) -> Callable[[Columns], Study]:
    """What computes further cases of a study in this process, {key: values in SI} -> a `Study` of their rows."""
    task = case_task(study.spec, study.plan.keys)
    return lambda columns: replace(study, rows=evaluate(task, 0, columns)[0])


def study_identity(spec: MechanismSpec, plan: Plan) -> dict[str, str]:
    """What must stay the same between two starts of a study, {what: text}."""
    drive = spec.model_copy(update={"optimise": None})
    return {"spec": drive.digest(), "study": canonical_text(spec.study), "plan": plan.digest, "drivewright": versions()["drivewright"]}


def _no_progress(done: int, total: int, what: str) -> None:
    """Nobody wants to know."""


def _fill(kept: Store, task: CaseTask, plan: Plan, workers: int | None, on: str | None, progress: Progress) -> bool:
    """Compute what is missing; whether it was interrupted."""
    total, done = len(plan), sum(count for _, count in kept.ranges())
    if done == total and not kept.notices:  # a new ledger has no remarks any more
        return False
    return _compute(kept, task, plan, plan, BatchScheduler(kept.ranges(), total, 1), kept.add, (done, total), workers, on, progress)


def _compute_again(kept: Folder, task: CaseTask, plan: Plan, again: Retry, workers: int | None, on: str | None, progress: Progress) -> bool:
    """Compute chosen cases once more; whether it was interrupted."""
    chosen = len(again.cases)
    counts = sum(count for _, count in kept.ranges()) - chosen, len(plan)
    scheduler = BatchScheduler([], chosen, 1)
    return bool(chosen) and _compute(kept, task, plan, again.cases, scheduler, again.add, counts, workers, on, progress)


def _compute(
    kept: Store,
    task: CaseTask,
    plan: Plan,
    cases: Cases,
    scheduler: BatchScheduler,
    add: Callable[[int, pa.Table, float], object],
    counts: tuple[int, int],
    workers: int | None,
    on: str | None,
    progress: Progress,
) -> bool:
    """Compute the cases of a scheduler and hand their rows to `add`; whether it was interrupted.  `counts`: (rows there, rows wanted)."""
    (done, total), trouble = counts, 0
    refuse_unknown(task, plan)
    try:
        progress(done, total, "")
        task, remarks = with_batch(task, plan)
        kept.remark(remarks)
        with closing(_computed(task, cases, scheduler, workers, on)) as each:
            for batch, table, seconds, reason in each:
                table = failed_rows(task, batch.first, cases.cases(batch.first, batch.stop), reason) if table is None else table
                add(batch.first, table, seconds)
                done, trouble = done + table.num_rows, trouble + _incomplete(table)
                progress(done, total, f"{trouble} not complete" if trouble else "")
    except KeyboardInterrupt:
        return True
    return False


def _computed(
    task: CaseTask, cases: Cases, scheduler: BatchScheduler, workers: int | None, on: str | None
) -> Generator[BatchResult, None, None]:
    """A `BatchResult` for every batch.  Where nobody says who is to compute, this process begins, and has help when it would take long
    alone."""

    def arguments(batch: Batch) -> tuple[CaseTask, int, Columns]:
        return task, batch.first, cases.cases(batch.first, batch.stop)

    if workers is None and on is None:
        yield from _by((InProcessExecutor(),), arguments, scheduler, lambda: (scheduler.expected or 0.0) > WORTH_HELP)
    if scheduler:
        yield from _by(make_executors(workers, on, len(cases)), arguments, scheduler)


def _by(
    executors: tuple[Executor, ...],
    arguments: Callable[[Batch], tuple[CaseTask, int, Columns]],
    scheduler: BatchScheduler,
    enough: Callable[[], bool] = lambda: False,
) -> Generator[BatchResult, None, None]:
    """The same by given executors, which are let go at the end."""
    try:
        yield from run_batches(executors, evaluate, arguments, scheduler, enough)
    finally:
        for executor in executors:
            executor.close()


def _incomplete(table: pa.Table) -> int:
    return table.num_rows - table[STATUS].to_pylist().count("complete")
