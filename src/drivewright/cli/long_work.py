"""How far a command with many cases or evaluations is: what it has to do before it begins, a bar at a terminal, lines elsewhere.

How long it takes is measured: from the first cases without what was compiled for them, then from all since.
"""

import contextlib
import sys
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from drivewright.cli import show
from drivewright.execution.batches import WORTH_HELP

if TYPE_CHECKING:
    from drivewright.spec import Optimise
    from drivewright.steps import Progress

EACH = 10.0  # seconds between two lines, where no bar can be drawn
WORTH_WORDS = 2.0  # seconds of work, from which on it is said how long it takes
WINDOW = 30.0  # seconds of late, whose pace counts
LEAST_SEEN = 3  # counts, from which on the first ones, which compile, are left out


class Pace:
    """How fast counting goes: `rate` [1/s] and the time that is `left` [s], None before anything is done.

    One process computes the first ones; `workers` compute the rest where that is worth it, or `at_once`.
    """

    def __init__(self, spent_elsewhere: Callable[[], float] = lambda: 0.0, clock: Callable[[], float] = time.monotonic) -> None:
        self.clock, self.spent_elsewhere = clock, spent_elsewhere
        self.done = self.total = 0
        self.workers, self.at_once = 1, False
        self._seen: deque[tuple[float, int]] = deque()  # (time without that for something else, how many were done) of late

    def count(self, done: int, total: int) -> None:
        """Take note of how many are done."""
        self.done, self.total, now = done, total, self.clock() - self.spent_elsewhere()
        self._seen.append((now, done))
        while len(self._seen) > LEAST_SEEN and self._seen[1][0] < now - WINDOW:
            self._seen.popleft()

    @property
    def begun(self) -> bool:
        """Whether anything has been counted."""
        return bool(self._seen)

    @property
    def rate(self) -> float | None:
        """How many are done in a second [1/s], of late; without the first ones, as soon as there are others."""
        if len(self._seen) < 2:
            return None
        (since, before), (until, after) = self._seen[0 if len(self._seen) < LEAST_SEEN else 1], self._seen[-1]
        return (after - before) / max(until - since, 1e-6) if after > before else None

    @property
    def left(self) -> float | None:
        """About how long the rest takes [s]."""
        work = (self.total - self.done) / rate if (rate := self.rate) else None
        first = len(self._seen) < LEAST_SEEN  # computed by one
        return work / self.workers if work is not None and first and (self.at_once or work > WORTH_HELP) else work


def duration(seconds: float) -> str:
    """'25 s', '3 min 20 s', '2 h 10 min'."""
    whole = max(round(seconds), 1)
    minutes, rest = divmod(whole, 60)
    hours, minutes = divmod(minutes, 60)
    if hours:
        return f"{hours} h {minutes} min" if minutes else f"{hours} h"
    return f"{minutes} min {rest} s" if minutes and rest else f"{minutes} min" if minutes else f"{rest} s"


def rate_text(rate: float) -> str:
    """'3.2/s', or '14 s each' of what takes long."""
    return f"{rate:.2g}/s" if 0.5 <= rate < 100 else f"{rate:.0f}/s" if rate >= 100 else f"{duration(1 / rate)} each"


def words(pace: Pace, noun: str, what: str = "") -> str:
    """'12 of 41 cases, 3.2/s, about 9 s left, 2 not complete'."""
    rate, left = pace.rate, pace.left
    parts = [f"{pace.done} of {pace.total} {noun}" if pace.total else "", rate_text(rate) if rate else ""]
    parts += [f"about {duration(left)} left" if left is not None and pace.done < pace.total else "", what]
    return ", ".join(filter(None, parts))


def place_text(workers: int, on: str | None) -> str:
    """'with 2 workers', 'in one process', 'on tcp://host:8786'."""
    if on and on != "serial":
        return f"on {on}"
    return "in one process" if workers == 1 else f"with {workers} workers"


def search_text(search: "Optimise") -> str:
    """'up to 6416 evaluations: differential evolution, 400 generations of 16 designs at most; it ends earlier ...'."""
    from drivewright.studies.search.searching import method_of, most_evaluations

    method = {"differential-evolution": "differential evolution", "nsga2": "NSGA-II"}[method_of(search)]
    early = ", fewer where the designs of a generation agree before" if method != "NSGA-II" else ""
    return f"up to {most_evaluations(search)} evaluations in {search.generations} generations by {method}{early}"


def worker_number(workers: int | None, on: str | None, limit: int) -> int:
    """How many compute at a time; of a Dask scheduler, whose workers come and go, it is not known: 1."""
    from drivewright.cases import worker_count
    from drivewright.execution.processes import most_processes

    if on is not None:
        return int(on.removeprefix("local:")) if on.startswith("local:") else 1
    return max(min(worker_count(workers), most_processes(), limit), 1)


@contextlib.contextmanager
def counted(title: str, kind: str, noun: str, workers: int | None, on: str | None, task: str = "") -> "Iterator[Progress]":
    """A callable step(done, total, what) for a command that counts; `noun` in the plural, `task` what is said at the first step.

    stderr says how many there are, after the first ones how long the rest takes, and then how far it is: in a bar at a terminal, in a
    line every `EACH` seconds elsewhere.  Compilation is reported too.
    """
    from drivewright._jit.compilation import Compilation, watched_by

    compilation, at_terminal = Compilation(kind), sys.stderr.isatty()
    pace = Pace(lambda: compilation.seconds)
    with contextlib.ExitStack() as stack:
        stack.enter_context(watched_by(compilation))
        if at_terminal:
            teller = stack.enter_context(contextlib.closing(_Bar(title, noun, pace, lambda: compilation.words)))
        else:
            stack.enter_context(show.compiling(kind))
            teller = stack.enter_context(contextlib.closing(_Lines(title, noun, pace)))
        yield _Steps(teller, pace, noun, workers, on, task)


class _Steps:
    """step(done, total, what) of `counted`."""

    def __init__(self, teller: "_Bar | _Lines", pace: Pace, noun: str, workers: int | None, on: str | None, task: str) -> None:
        self.teller, self.pace, self.noun, self.task = teller, pace, noun, task
        self.workers, self.on, self.is_announced = workers, on, False

    def __call__(self, done: int, total: int, what: str) -> None:
        pace = self.pace
        if not pace.begun:
            pace.workers, pace.at_once = worker_number(self.workers, self.on, total - done), bool(self.workers or self.on)
            kept = f", {done} of them done before" if done else ""
            self.teller.note(f"{self.task or f'{total} {self.noun}'}{kept}")
        pace.count(done, total)
        if not self.is_announced and pace.rate is not None:
            self.is_announced = True
            self._announce()
        self.teller.show(what)

    def _announce(self) -> None:
        """How long the rest takes, where it is long."""
        left, rate = self.pace.left, self.pace.rate
        if left is None or rate is None or left < WORTH_WORDS or self.pace.done >= self.pace.total:
            return
        alone = left > 0.99 * (self.pace.total - self.pace.done) / rate
        where = place_text(1 if alone else self.pace.workers, self.on)
        self.teller.note(f"judged by the first, the rest takes about {duration(left)} {where}")


class _Lines:
    """Lines on stderr: what is noted at once, how far it is every `EACH` seconds, also while nothing comes to an end."""

    def __init__(self, title: str, noun: str, pace: Pace) -> None:
        self.title, self.noun, self.pace, self.what = title, noun, pace, ""
        self.over = threading.Event()
        self.thread = threading.Thread(target=self._every_while, daemon=True)
        self.thread.start()

    def _every_while(self) -> None:
        while not self.over.wait(EACH):
            if self.pace.begun and self.pace.done < self.pace.total:
                self.note(words(self.pace, self.noun, self.what))

    def note(self, text: str) -> None:
        """A line now."""
        show.note(f"{self.title}: {text}")

    def show(self, what: str) -> None:
        """Text that the next line adds."""
        self.what = what

    def close(self) -> None:
        """Say nothing more."""
        self.over.set()
        self.thread.join()


class _Bar:
    """A bar at a terminal, with what is noted above it."""

    def __init__(self, title: str, noun: str, pace: Pace, compiling: Callable[[], str]) -> None:
        from rich.console import Console
        from rich.progress import BarColumn, Progress, ProgressColumn, Task, TextColumn
        from rich.table import Column
        from rich.text import Text

        class Words(ProgressColumn):
            """What is compiled, or how far it is."""

            def render(self, task: Task) -> Text:
                return Text(compiling() or words(pace, noun, task.fields["what"]))

        self.title = title
        self.bar = Progress(
            TextColumn("{task.description}"), BarColumn(20), Words(Column(no_wrap=True)), console=Console(stderr=True), transient=True
        )
        self.pace, self.task = pace, self.bar.add_task(title, total=None, what="")
        self.bar.start()

    def note(self, text: str) -> None:
        """A line above the bar, which stays."""
        self.bar.console.print(f"{self.title}: {text}", markup=False, highlight=False, soft_wrap=True)

    def show(self, what: str) -> None:
        """Move the bar."""
        self.bar.update(self.task, completed=self.pace.done, total=self.pace.total, what=what)

    def close(self) -> None:
        """Take the bar away."""
        self.bar.stop()
