"""Who computes: this process, processes on this machine, or the workers of a Dask scheduler.  All call the same function.

A pool is a tuple of lanes.  A lane takes up to `capacity` calls at once; `submit(function, *arguments)` gives a future as those of
`concurrent.futures`, `revive()` makes a broken lane usable again, `close()` lets everything go at once.
"""

import logging
import os
import signal
import sys
import threading
from concurrent.futures import Future, ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import get_context

from drivewright.cases import worker_count
from drivewright.errors import InputError, MissingExtra, brief

ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS", "VECLIB_MAXIMUM_THREADS")
WATCH = 0.25  # seconds between two looks at the parent
PATIENCE = "20s"  # for a scheduler to answer


def pool(workers=None, on=None):
    """The lanes for `on`: None for `workers` processes (None: one per core), "serial" for this process, "local:N" for a Dask cluster on
    this machine, "tcp://HOST:PORT" for the scheduler there.  InputError for anything else."""
    if on is None:
        return tuple(Process() for _ in range(worker_count(workers)))
    if workers is not None:
        raise InputError(f"--workers counts processes of this machine, and --on {on} says who computes; give one of them")
    if on == "serial":
        return (Here(),)
    if on.startswith("local:"):
        return (Cluster(_local_cluster(on)),)
    if on.startswith(("tcp://", "tls://", "ucx://", "ws://", "wss://")):
        return (Cluster(_remote(on)),)
    raise InputError(
        f"--on {brief(on)} is no place to compute: serial, local:N for N Dask workers on this machine, or tcp://HOST:PORT of a Dask "
        "scheduler; leave it out for processes on this machine"
    )


class Here:
    """One call after another in this process, with one thread in the libraries like everywhere else."""

    workers = capacity = 1

    def __init__(self):
        from threadpoolctl import threadpool_limits

        self._limits = threadpool_limits(1)

    def submit(self, function, *arguments):
        """The call is over when this returns."""
        future = Future()
        try:
            future.set_result(function(*arguments))
        except Exception as error:
            future.set_exception(error)
        return future

    def alive(self):
        """Always."""
        return True

    def close(self):
        """The libraries may have their threads again."""
        self._limits.restore_original_limits()


class Process:
    """One process of its own: when it dies, the oldest of its calls is the one to blame."""

    workers, capacity = 1, 2

    def __init__(self):
        self._start()

    def _start(self):
        context = get_context("spawn")
        ours, self._hold = context.Pipe(duplex=False)
        with _as_a_worker():
            self._executor = ProcessPoolExecutor(1, context, _watch, (os.getpid(), ours))
            self._executor.submit(_warm)
        ours.close()

    def submit(self, function, *arguments):
        """BrokenExecutor in its future when the process dies."""
        return self._executor.submit(function, *arguments)

    def revive(self):
        """A new process in place of the dead one."""
        self.close()
        self._start()

    def alive(self):
        """A death shows in the futures."""
        return True

    def close(self):
        """The process leaves as soon as its end of the pipe is closed, whatever it does at the moment."""
        self._hold.close()
        self._executor.shutdown(wait=False, cancel_futures=True)


class Cluster:
    """The workers of a Dask scheduler; it sends a call again itself when a worker dies."""

    def __init__(self, client):
        self._client = client
        self._executor = client.get_executor(pure=False)
        self.workers = len(client.scheduler_info(n_workers=-1)["workers"])
        self.capacity = 2 * max(1, self.workers)

    def submit(self, function, *arguments):
        """KilledWorker in its future when several workers died of it."""
        return self._executor.submit(function, *arguments)

    def alive(self):
        """Whether the scheduler is still there."""
        return self._client.status == "running"

    def close(self):
        """Leave the scheduler; a cluster of our own ends with it."""
        self._executor.shutdown(wait=False)
        cluster = self._client.cluster
        self._client.close(timeout=2)
        if cluster is not None:
            cluster.close(timeout=10)


# -- a process of our own ------------------------------------------------------------------------------------------------------


@contextmanager
def _as_a_worker():
    """What a process inherits: one thread in the libraries, and no main module (it would run a user's script again)."""
    kept = {name: os.environ.get(name) for name in ONE_THREAD}
    main = sys.modules["__main__"]
    spec, file = getattr(main, "__spec__", None), main.__dict__.pop("__file__", None)
    os.environ.update(dict.fromkeys(ONE_THREAD, "1"))
    main.__spec__ = None
    try:
        yield
    finally:
        main.__spec__ = spec
        if file is not None:
            main.__file__ = file
        for name, value in kept.items():
            os.environ.pop(name) if value is None else os.environ.__setitem__(name, value)


def _watch(parent, pipe):
    """In the process: leave when the parent dies or closes its end; Ctrl-C is the parent's business."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)

    def look():
        while True:
            try:
                gone = pipe.poll(WATCH)
            except OSError:
                gone = True
            if gone or os.getppid() != parent:
                os._exit(1)

    threading.Thread(target=look, daemon=True, name="watch").start()


def _warm():
    """Load what every call needs, while others still start."""
    import drivewright.studies.evaluate  # noqa: F401


# -- Dask ----------------------------------------------------------------------------------------------------------------------


def _distributed():
    try:
        import dask
        import distributed
    except ImportError as error:
        raise MissingExtra("--on", "cluster", error) from None
    for name in ("distributed", "distributed.client"):  # we say ourselves what happened, in one line
        for handler in logging.getLogger(name).handlers:
            handler.setLevel(logging.CRITICAL)
    return dask, distributed


def _local_cluster(on):
    """A client of as many Dask workers on this machine, one thread each."""
    dask, distributed = _distributed()
    number = on.removeprefix("local:")
    if not number.isdecimal() or not int(number):
        raise InputError(f"--on {brief(on)} wants a number of workers from 1 up, e.g. local:4")
    with _as_a_worker(), dask.config.set({"distributed.scheduler.allowed-failures": 2}):
        cluster = distributed.LocalCluster(n_workers=int(number), threads_per_worker=1, processes=True, dashboard_address=":0",
                                           silence_logs=logging.CRITICAL)
    return distributed.Client(cluster)


def _remote(on):
    """A client of a scheduler; InputError where nobody answers, or nobody works."""
    _, distributed = _distributed()
    try:
        client = distributed.Client(on, timeout=PATIENCE)
    except (OSError, ValueError, TimeoutError) as error:
        raise InputError(f"--on {on}: no Dask scheduler answers there ({str(error).splitlines()[0]}); start one with `dask scheduler`, and "
                         "workers with `dask worker HOST:PORT --nthreads 1`") from None
    if not client.scheduler_info(n_workers=-1)["workers"]:
        client.close()
        raise InputError(f"--on {on}: the scheduler has no workers; start them with `dask worker {on} --nthreads 1`")
    return client
