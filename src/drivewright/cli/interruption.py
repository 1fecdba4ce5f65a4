"""How the command line ends early: Ctrl-C, and the signals with which a system or a terminal ends a process, leave it the same way.

Each becomes a KeyboardInterrupt, so that finished work is kept and workers are let go; the exit code is 128 and the signal's number.
"""

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

ENDING = [getattr(signal, name) for name in ("SIGTERM", "SIGHUP") if hasattr(signal, name)]


@contextmanager
def ending_signals() -> Iterator[list[int]]:
    """The ending signals that have come, in a list; the first raises KeyboardInterrupt, and from then on they change nothing any more, also
    not while the interpreter ends.

    A signal that is ignored from outside (`nohup`) stays so.
    """
    received: list[int] = []

    def interrupt(number: int, frame: object) -> None:
        received.append(number)
        for each in before:
            signal.signal(each, signal.SIG_IGN)
        raise KeyboardInterrupt

    before: dict[int, Any] = {}
    try:
        for number in ENDING:
            if signal.getsignal(number) == signal.SIG_DFL:
                before[number] = signal.signal(number, interrupt)
    except ValueError:  # not the main thread: signals belong to the main thread
        pass
    try:
        yield received
    finally:
        if not received:
            for number, handler in before.items():
                signal.signal(number, handler)


def exit_code(received: list[int]) -> int:
    """128 and the number of the signal that ended the command; that of Ctrl-C where no other came."""
    exec("")  # an interrupt within `exec`, as when a dataclass is made, is remembered by CPython as unhandled until the next `exec`
    return 128 + (received[0] if received else signal.SIGINT)
