"""The workers of a Dask scheduler: one started on this machine, or one that is there already."""

import logging
import time
from collections.abc import Callable
from concurrent.futures import Future
from contextlib import ExitStack
from typing import Any

from drivewright.errors import InputError, MissingExtra
from drivewright.execution.processes import most_processes, worker_environment

ANSWER_TIMEOUT = "20s"  # for a scheduler to answer
WORKERLESS_LIMIT = 60.0  # seconds without a worker after which a scheduler is given up


class DaskExecutor:
    """The workers of a Dask scheduler; it sends a call again itself when a worker dies."""

    def __init__(self, on: str, client: Any, owned: ExitStack | None = None) -> None:
        self._on, self._client, self._owned = on, client, owned
        self._executor = client.get_executor(pure=False)
        self._last_seen = time.monotonic()
        self.workers: int = _count_workers(client)

    @property
    def capacity(self) -> int:
        """Two calls for each worker that is there."""
        return 2 * max(1, self.workers)

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """KilledWorker in its future when several workers died of it."""
        return self._executor.submit(function, *arguments)

    def restart(self) -> None:
        """The scheduler starts its workers again itself."""

    def is_death(self, error: Exception) -> bool:
        """Whether several workers died of a call, and the scheduler has given it up."""
        from distributed import KilledWorker

        return isinstance(error, KilledWorker)

    def fault(self) -> str:
        """Why nothing can come from it any more; empty while it works."""
        if self._client.status != "running":
            return f"--on {self._on}: the scheduler has stopped"
        self.workers = _count_workers(self._client)
        self._last_seen = time.monotonic() if self.workers else self._last_seen
        workerless = time.monotonic() - self._last_seen
        return f"--on {self._on}: the scheduler has had no workers for {workerless:.0f} s" if workerless > WORKERLESS_LIMIT else ""

    def close(self) -> None:
        """Leave the scheduler; a cluster of our own ends with it."""
        self._executor.shutdown(wait=False)
        self._client.close(timeout=2)
        if self._owned is not None:
            self._owned.close()


def start_local(on: str) -> DaskExecutor:
    """The executor of as many Dask workers on this machine as `on`, "local:N", says; one thread each."""
    dask, distributed = _distributed()
    with ExitStack() as stack:
        stack.enter_context(worker_environment())  # to the end: the cluster starts a worker again when it dies
        stack.enter_context(dask.config.set({"distributed.scheduler.allowed-failures": 2}))
        cluster = distributed.LocalCluster(
            n_workers=min(int(on.removeprefix("local:")), most_processes()),
            threads_per_worker=1,
            processes=True,
            dashboard_address=":0",
            silence_logs=logging.CRITICAL,
        )
        stack.callback(cluster.close, timeout=10)
        return DaskExecutor(on, distributed.Client(cluster), stack.pop_all())


def connect(on: str) -> DaskExecutor:
    """The executor of the scheduler at an address; InputError where nobody answers, nobody works, or a worker has several threads."""
    _, distributed = _distributed()
    try:
        client = distributed.Client(on, timeout=ANSWER_TIMEOUT)
    except (OSError, ValueError, TypeError, ImportError, RuntimeError, TimeoutError) as error:
        reason = str(error).partition("\n")[0] or type(error).__name__
        raise InputError(
            f"--on {on}: no Dask scheduler answers there ({reason}); start one with `dask scheduler`, and workers with "
            "`dask worker HOST:PORT --nthreads 1`"
        ) from None
    threads = [worker["nthreads"] for worker in client.scheduler_info(n_workers=-1)["workers"].values()]
    if not threads or max(threads) > 1:
        client.close()
        what = f"a worker has {max(threads)} threads, and one is what a case can use" if threads else "the scheduler has no workers"
        raise InputError(f"--on {on}: {what}; start workers with `dask worker {on} --nthreads 1`, several with --nworkers")
    return DaskExecutor(on, client)


def _distributed() -> tuple[Any, Any]:
    try:
        import dask
        import distributed
    except ImportError as error:
        raise MissingExtra("--on", "cluster", error) from None
    for name in ("distributed", "distributed.client"):  # we say ourselves what happened, in one line
        for handler in logging.getLogger(name).handlers:
            handler.setLevel(logging.CRITICAL)
    return dask, distributed


def _count_workers(client: Any) -> int:
    """How many workers a scheduler has; 0 where it does not say."""
    try:
        return len(client.scheduler_info(n_workers=-1)["workers"])
    except (OSError, RuntimeError, TimeoutError):
        return 0
