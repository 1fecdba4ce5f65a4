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
    """The ending signals that have come, in a list, and Ctrl-C.  Each raises KeyboardInterrupt; after the first one from a system or a
    terminal those change nothing any more, also not while the interpreter ends.

    A signal that is ignored from outside (`nohup`) stays so.
    """
    received: list[int] = []

    def note(number: int, frame: object) -> None:
        received.append(number)
        raise KeyboardInterrupt

    def interrupt(number: int, frame: object) -> None:
        for each in before:
            signal.signal(each, signal.SIG_IGN)
        note(number, frame)

    before: dict[int, Any] = {}
    by_hand = False  # whether Ctrl-C is Python's own to handle
    try:
        for number in ENDING:
            if signal.getsignal(number) == signal.SIG_DFL:
                before[number] = signal.signal(number, interrupt)
        if by_hand := signal.getsignal(signal.SIGINT) is signal.default_int_handler:
            signal.signal(signal.SIGINT, note)
    except ValueError:  # not the main thread: signals belong to the main thread
        pass
    try:
        yield received
    finally:
        if by_hand:
            signal.signal(signal.SIGINT, signal.default_int_handler)
        if not before.keys() & set(received):
            for number, handler in before.items():
                signal.signal(number, handler)


def exit_code(received: list[int]) -> int:
    """128 and the number of the signal that ended the command; that of Ctrl-C where no other came."""
    exec("")  # an interrupt within `exec`, as when a dataclass is made, is remembered by CPython as unhandled until the next `exec`
    return 128 + (received[0] if received else signal.SIGINT)
