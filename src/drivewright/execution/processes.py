"""What a process of our own inherits, and how it ends with the process that started it."""

import os
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Protocol

from drivewright._garbage import collect_rarely
from drivewright.cases import worker_count

ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS", "VECLIB_MAXIMUM_THREADS")
PER_CORE = 4  # processes beyond which more of them gain nothing, and cost memory
PARENT_POLL = 0.25  # seconds between two looks at the parent


def most_processes() -> int:
    """How many processes this machine gets at most, whatever is requested."""
    return PER_CORE * worker_count(None)


class Pipe(Protocol):
    """One end of a pipe between two processes."""

    def poll(self, timeout: float, /) -> bool:
        """Whether something is there to read within `timeout` [s], or the other end is closed."""
        ...


@contextmanager
def worker_environment() -> Iterator[None]:
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


@contextmanager
def endings_blocked() -> Iterator[None]:
    """A process that starts meanwhile never gets the signals that end one: they are the parent's business, with which it leaves."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT, signal.SIGTERM, signal.SIGHUP})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def exit_with_parent(parent: int, pipe: Pipe) -> None:
    """In the process: leave when the parent (its process id) dies or closes its end; Ctrl-C is the parent's business."""
    collect_rarely()
    signal.signal(signal.SIGINT, signal.SIG_IGN)

    def watch() -> None:
        while True:
            try:
                closed = pipe.poll(PARENT_POLL)
            except OSError:
                closed = True
            if closed or os.getppid() != parent:
                os._exit(1)

    threading.Thread(target=watch, daemon=True, name="watch").start()
