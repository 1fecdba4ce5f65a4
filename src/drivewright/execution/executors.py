"""Executors: this process, processes on this machine, or the workers of a Dask scheduler.  All call the same function."""

import os
import sys
from collections.abc import Callable, Hashable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Future, ProcessPoolExecutor, wait
from contextlib import ExitStack
from multiprocessing import get_context
from typing import Any, Protocol

from drivewright.cases import worker_count
from drivewright.errors import InputError, brief
from drivewright.execution.processes import endings_blocked, exit_with_parent, most_processes, worker_environment

STARTS = 3  # of a process that dies before it comes to work: the first may have been killed by chance
SCHEMES = ("tcp://", "tls://", "ucx://", "ws://", "wss://")


class Executor(Protocol):
    """A place that computes: `workers` calls at a time, up to `capacity` with those that wait there."""

    @property
    def workers(self) -> int:
        """How many calls are computed at a time."""
        ...

    @property
    def capacity(self) -> int:
        """How many calls it takes at once."""
        ...

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """A future as those of `concurrent.futures`."""
        ...

    def restart(self) -> None:
        """Make it usable again after its process died."""
        ...

    def is_death(self, error: Exception) -> bool:
        """Whether an error of a future says that the workers died of its call, which is not to be tried again."""
        ...

    def fault(self) -> str:
        """Why nothing can come from it any more; empty while it works."""
        ...

    def close(self) -> None:
        """Let everything go at once."""
        ...


def make_executors(workers: int | None = None, on: str | None = None, limit: int | None = None) -> tuple[Executor, ...]:
    """The executors for `on`: None for `workers` processes (None: one per core), but no more than `limit`, "serial" for this process,
    "local:N" for a Dask cluster on this machine, "tcp://HOST:PORT" for the scheduler there.  InputError for anything else.

    On this machine there are never more than `processes.most_processes`, whatever is requested."""
    check_location(workers, on)
    if on is None:
        return _processes(min(worker_count(workers), most_processes(), limit or sys.maxsize))
    if on == "serial":
        return (InProcessExecutor(),)
    from drivewright.execution import dask_cluster

    return (dask_cluster.start_local(on) if on.startswith("local:") else dask_cluster.connect(on),)


def side_by_side(
    function: Callable[..., Any],
    calls: Sequence[tuple[Any, ...]],
    groups: Sequence[Hashable] = (),
    begun: Callable[[int], object] = lambda index: None,
) -> Iterator[tuple[int, Any]]:
    """(index, function(*arguments)) of independent calls as they come to an end, computed in processes of this machine, one per core.

    Calls of one group run one after another; `begun` is told the index of each as it starts.  What a call raises is raised here, and those
    that run beside it are let go.
    """
    groups = groups or range(len(calls))
    waiting, running = list(range(len(calls))), dict[Future[Any], tuple[int, Executor]]()
    with ExitStack() as stack:
        idle = list(make_executors(limit=max(len(set(groups)), 1)))
        for executor in idle:
            stack.callback(executor.close)
        while waiting or running:
            for index in list(waiting):
                if idle and groups[index] not in {groups[other] for other, _ in running.values()}:
                    waiting.remove(index)
                    begun(index)
                    executor = idle.pop(0)
                    running[executor.submit(function, *calls[index])] = index, executor
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                index, executor = running.pop(future)
                idle.append(executor)
                yield index, future.result()


def check_location(workers: int | None, on: str | None) -> None:
    """InputError where `workers` and `on` say no place to compute."""
    if on is None:
        worker_count(workers)
    elif workers is not None:
        raise InputError(f"--workers counts processes of this machine, and --on {on} names the workers; give one of them")
    elif on.startswith("local:"):
        number = on.removeprefix("local:")
        if not number.isdecimal() or not int(number):
            raise InputError(f"--on {brief(on)} needs a number of workers from 1 up, e.g. local:4")
    elif on != "serial" and not on.startswith(SCHEMES):
        raise InputError(
            f"--on {brief(on)} is not a place to compute: give serial, local:N for N Dask workers on this machine, or tcp://HOST:PORT of "
            "a Dask scheduler; leave it out for processes on this machine"
        )


def _processes(number: int) -> tuple[Executor, ...]:
    """So many executors of one process each; those that came up are let go where the next one does not."""
    with ExitStack() as stack:
        executors: list[Executor] = []
        for _ in range(number):
            executors.append(ProcessExecutor())
            stack.callback(executors[-1].close)
        stack.pop_all()
        return tuple(executors)


class InProcessExecutor:
    """One call after another in this process."""

    workers: int = 1
    capacity: int = 1

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """The call is over when this returns."""
        future: Future[Any] = Future()
        try:
            future.set_result(function(*arguments))
        except Exception as error:
            future.set_exception(error)
        return future

    def restart(self) -> None:
        """Nothing to start."""

    def is_death(self, error: Exception) -> bool:
        """Never: this process would be dead."""
        return False

    def fault(self) -> str:
        """None."""
        return ""

    def close(self) -> None:
        """Nothing to let go."""


class ProcessExecutor:
    """One process of its own: when it dies, the oldest of its calls is the one to blame."""

    workers: int = 1
    capacity: int = 2

    def __init__(self, prepare: Callable[[], object] | None = None) -> None:
        """`prepare` is called as the process starts, while others still start: it loads what every call needs."""
        self._vain_starts, self._prepare = 0, prepare or _load_evaluation
        self._start()

    def _start(self) -> None:
        context = get_context("spawn")
        theirs, self._hold = context.Pipe(duplex=False)
        with worker_environment():
            with endings_blocked():  # it starts the process that clears up after all others
                self._executor = ProcessPoolExecutor(1, context, exit_with_parent, (os.getpid(), theirs))
            with endings_blocked():  # that start has let them through again
                self._warmed = self._executor.submit(self._prepare)
        theirs.close()

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """BrokenExecutor in its future when the process dies, or is dead already."""
        try:
            return self._executor.submit(function, *arguments)
        except BrokenExecutor as death:
            future: Future[Any] = Future()
            future.set_exception(death)
            return future

    @property
    def at_work(self) -> bool:
        """Whether the process has come to work."""
        return self._warmed.done() and self._warmed.exception() is None

    def restart(self) -> None:
        """A new process in place of the dead one; InputError where none of `STARTS` in a row came to work."""
        self._vain_starts = 0 if self.at_work else self._vain_starts + 1
        if self._vain_starts >= STARTS:
            raise InputError(
                "a worker process does not start (its own message stands above, if it had one); fix that, or compute in this "
                "process with --on serial. Every case that was finished before is kept"
            )
        self.close()
        self._start()

    def is_death(self, error: Exception) -> bool:
        """Never: a dead process breaks the executor, and the call may be tried again."""
        return False

    def fault(self) -> str:
        """None: a death shows in the futures."""
        return ""

    def close(self) -> None:
        """The process leaves as soon as its end of the pipe is closed, whatever it does at the moment."""
        self._hold.close()
        self._executor.shutdown(cancel_futures=True)  # waits: Python 3.11 may trip over a pool that ends while the interpreter does


def _load_evaluation() -> None:
    """What the batches of a study need."""
    import drivewright.execution.evaluation  # noqa: F401
