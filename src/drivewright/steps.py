"""How far a long part of an analysis is, reported from within it to the display of progress.

A loop whose steps take a while - meshes, solutions that condense a body, load steps - calls `note_step`; `detailed` makes a progress
callable that receives it.  So no analysis hands a callback down.  Reports of progress change no number.
"""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import TypeAlias

Progress: TypeAlias = Callable[[int, int, str], object]  # (done, total, name of what comes next)
EACH = 0.1  # s, at least, between two reported steps

_listener: ContextVar[Callable[[str], object] | None] = ContextVar("listener", default=None)


def note_step(what: str, done: int = 0, total: int = 0) -> None:
    """Tell that step `done` of `total` begins, or only `what` is done now; nothing happens where nobody shows progress."""
    if listener := _listener.get():
        listener(f"{what}, {done} of {total}" if total else what)


@contextmanager
def detailed(progress: Progress) -> Iterator[Progress]:
    """A progress(done, total, what) that is called again with "WHAT: step" as steps are noted inside, also by the threads of `cases.run`.

    No more often than every `EACH` seconds.
    """
    last, reported_at = (0, 0, ""), -EACH

    def step(done: int, total: int, what: str) -> object:
        nonlocal last
        last = done, total, what
        return progress(done, total, what)

    def hear(words: str) -> None:
        nonlocal reported_at
        done, total, what = last
        if time.monotonic() - reported_at >= EACH:
            reported_at = time.monotonic()
            progress(done, total, f"{what}: {words}" if what else words)

    token = _listener.set(hear)
    try:
        yield step
    finally:
        _listener.reset(token)
