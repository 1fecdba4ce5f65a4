"""Who computes: this process, processes on this machine, or the workers of a Dask scheduler.  All call the same function.

A pool is a tuple of lanes.  A lane takes up to `capacity` calls at once; `submit(function, *arguments)` gives a future as those of
`concurrent.futures`, `revive()` makes a broken lane usable again, `trouble()` says why nothing can come from it any more, `close()` lets
everything go at once.
"""

import logging
import os
import signal
import sys
import threading
import time
from concurrent.futures import BrokenExecutor, Future, ProcessPoolExecutor
from contextlib import ExitStack, contextmanager
from multiprocessing import get_context

from drivewright.cases import worker_count
from drivewright.errors import InputError, MissingExtra, brief

ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS", "VECLIB_MAXIMUM_THREADS")
WATCH = 0.25  # seconds between two looks at the parent
PATIENCE = "20s"  # for a scheduler to answer
LONELY = 60.0  # seconds without a worker after which a scheduler is given up
SCHEMES = ("tcp://", "tls://", "ucx://", "ws://", "wss://")


def pool(workers=None, on=None, most=None):
    """The lanes for `on`: None for `workers` processes (None: one per core), but no more than `most`, "serial" for this process, "local:N"
    for a Dask cluster on this machine, "tcp://HOST:PORT" for the scheduler there.  InputError for anything else."""
    refuse_nowhere(workers, on)
    if on is None:
        return _processes(min(worker_count(workers), most or sys.maxsize))
    if on == "serial":
        return (Here(),)
    return (_local_cluster(on) if on.startswith("local:") else _remote(on),)


def refuse_nowhere(workers, on):
    """InputError where `workers` and `on` say no place to compute."""
    if on is None:
        worker_count(workers)
    elif workers is not None:
        raise InputError(f"--workers counts processes of this machine, and --on {on} says who computes; give one of them")
    elif on.startswith("local:"):
        number = on.removeprefix("local:")
        if not number.isdecimal() or not int(number):
            raise InputError(f"--on {brief(on)} wants a number of workers from 1 up, e.g. local:4")
    elif on != "serial" and not on.startswith(SCHEMES):
        raise InputError(
            f"--on {brief(on)} is no place to compute: serial, local:N for N Dask workers on this machine, or tcp://HOST:PORT of "
            "a Dask scheduler; leave it out for processes on this machine"
        )


def _processes(number):
    """So many lanes of one process each; those that came up are let go where the next one does not."""
    with ExitStack() as stack:
        lanes = []
        for _ in range(number):
            lanes.append(Process())
            stack.callback(lanes[-1].close)
        stack.pop_all()
        return tuple(lanes)


class Here:
    """One call after another in this process."""

    workers = capacity = 1

    def submit(self, function, *arguments):
        """The call is over when this returns."""
        future = Future()
        try:
            future.set_result(function(*arguments))
        except Exception as error:
            future.set_exception(error)
        return future

    def trouble(self):
        """None."""
        return ""

    def close(self):
        """Nothing to let go."""


class Process:
    """One process of its own: when it dies, the oldest of its calls is the one to blame."""

    workers, capacity = 1, 2

    def __init__(self):
        self._start()

    def _start(self):
        context = get_context("spawn")
        ours, self._hold = context.Pipe(duplex=False)
        with as_a_worker():
            self._executor = ProcessPoolExecutor(1, context, leave_with_parent, (os.getpid(), ours))
            self._warmed = self._executor.submit(_warm)
        ours.close()

    def submit(self, function, *arguments):
        """BrokenExecutor in its future when the process dies, or is dead already."""
        try:
            return self._executor.submit(function, *arguments)
        except BrokenExecutor as death:
            future = Future()
            future.set_exception(death)
            return future

    def revive(self):
        """A new process in place of the dead one; InputError where that one never came to work."""
        if not self._warmed.done() or self._warmed.exception() is not None:
            raise InputError(
                "a worker process does not start (its own message stands above, if it had one); mend that, or compute in this "
                "process with --on serial. Every case that was finished before is kept"
            )
        self.close()
        self._start()

    def trouble(self):
        """None: a death shows in the futures."""
        return ""

    def close(self):
        """The process leaves as soon as its end of the pipe is closed, whatever it does at the moment."""
        self._hold.close()
        self._executor.shutdown(wait=False, cancel_futures=True)


class Cluster:
    """The workers of a Dask scheduler; it sends a call again itself when a worker dies."""

    def __init__(self, on, client, ours=None):
        self._on, self._client, self._ours = on, client, ours
        self._executor = client.get_executor(pure=False)
        self._seen = time.monotonic()
        self.workers = _workers_of(client)

    @property
    def capacity(self):
        """Two calls for each worker that is there."""
        return 2 * max(1, self.workers)

    def submit(self, function, *arguments):
        """KilledWorker in its future when several workers died of it."""
        return self._executor.submit(function, *arguments)

    def trouble(self):
        """Why nothing can come from it any more; empty while it works."""
        if self._client.status != "running":
            return f"--on {self._on}: the scheduler has gone away"
        self.workers = _workers_of(self._client)
        self._seen = time.monotonic() if self.workers else self._seen
        lost = time.monotonic() - self._seen
        return f"--on {self._on}: the scheduler has had no workers for {lost:.0f} s" if lost > LONELY else ""

    def close(self):
        """Leave the scheduler; a cluster of our own ends with it."""
        self._executor.shutdown(wait=False)
        self._client.close(timeout=2)
        if self._ours is not None:
            self._ours.close()


# -- a process of our own ------------------------------------------------------------------------------------------------------


@contextmanager
def as_a_worker():
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


def leave_with_parent(parent, pipe):
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


def _workers_of(client):
    """How many workers a scheduler has; 0 where it does not say."""
    try:
        return len(client.scheduler_info(n_workers=-1)["workers"])
    except (OSError, RuntimeError, TimeoutError):
        return 0


def _local_cluster(on):
    """The lane of as many Dask workers on this machine, one thread each."""
    dask, distributed = _distributed()
    with ExitStack() as stack:
        stack.enter_context(as_a_worker())  # to the end: the cluster starts a worker again when it dies
        stack.enter_context(dask.config.set({"distributed.scheduler.allowed-failures": 2}))
        cluster = distributed.LocalCluster(
            n_workers=int(on.removeprefix("local:")),
            threads_per_worker=1,
            processes=True,
            dashboard_address=":0",
            silence_logs=logging.CRITICAL,
        )
        stack.callback(cluster.close, timeout=10)
        return Cluster(on, distributed.Client(cluster), stack.pop_all())


def _remote(on):
    """The lane of a scheduler; InputError where nobody answers, nobody works, or a worker has several threads."""
    _, distributed = _distributed()
    try:
        client = distributed.Client(on, timeout=PATIENCE)
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
    return Cluster(on, client)
