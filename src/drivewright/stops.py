"""A run that ended early makes everything computed from it partial.

Such a run, or a record of it, passes a `Stop` to `note_stop` whenever an analysis reads it; the runner collects the stops of each
analysis with `collect_stops` and makes its answer partial.  So no analysis has to check for it.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import NamedTuple


class Stop(NamedTuple):
    """Where something ended before its time, e.g. "the run ends at t = 0.7 s of 3 s", and why."""

    where: str
    reason: str

    def __str__(self) -> str:
        return f"{self.where}: {self.reason}"


_stops: ContextVar[dict[Stop, None] | None] = ContextVar("stops", default=None)


def note_stop(stop: Stop | None) -> None:
    """Note that the analysis under way looks at something that stopped; nothing happens for None, and outside of an analysis."""
    stops = _stops.get()
    if stop is not None and stops is not None:
        stops[stop] = None


@contextmanager
def collect_stops() -> Iterator[dict[Stop, None]]:
    """The stops (as keys, in order) that are noted inside, also by the threads of `cases.run`."""
    stops: dict[Stop, None] = {}
    token = _stops.set(stops)
    try:
        yield stops
    finally:
        _stops.reset(token)
