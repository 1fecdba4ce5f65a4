"""The missing cases of a study, handed out in batches and computed by executors."""

import math
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, CancelledError, Future, wait
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from drivewright.errors import InputError
from drivewright.execution.executors import Executor

if TYPE_CHECKING:
    import pyarrow as pa

TARGET, LEAST = 1.5, 0.5  # seconds that a batch should take, and below which no batch is split for the sake of an even end
GROWTH = 8  # a batch may have so many times the cases of the one before: the first ones compile
LARGEST = 200_000  # cases of a batch: what is held in memory on its way
TRIES = 3  # a batch whose worker dies is taken again, twice; then its halves once each, until the deadly case is alone
WORTH_HELP = 3.0  # seconds of work: other processes need one or two to start
POLL = 1.0  # seconds between two looks at the executors


class Batch(NamedTuple):
    """Cases from `first` up to `stop`, and how often workers died of them."""

    first: int
    stop: int
    deaths: int = 0


class BatchResult(NamedTuple):
    """A batch with what came of it: `table`, or the `reason` why its cases have none."""

    batch: Batch
    table: "pa.Table | None" = None
    seconds: float = 0.0
    reason: str = ""


class BatchScheduler:
    """Hands out the missing cases; the timing of what is done says how many make a batch, and how long all will take: `expected` [s], None
    before the first batch is done."""

    def __init__(self, ranges: Iterable[tuple[int, int]], total: int, workers: int) -> None:
        self._gaps = deque(missing_ranges(ranges, total))
        self._left = sum(stop - first for first, stop in self._gaps)
        self._requeued: deque[Batch] = deque()
        self.workers, self.expected = workers, None
        self._size, self._least = 1, 1

    workers: int
    expected: float | None

    def __bool__(self) -> bool:
        return bool(self._requeued or self._gaps)

    def next_batch(self) -> Batch:
        """The next batch."""
        if self._requeued:
            return self._requeued.popleft()
        first, stop = self._gaps.popleft()
        share = math.ceil(self._left / (2 * self.workers))
        end = min(stop, first + min(self._size, max(self._least, share)))
        if end < stop:
            self._gaps.appendleft((end, stop))
        self._left -= end - first
        return Batch(first, end)

    def requeue(self, batch: Batch) -> None:
        """Take a batch back: it goes out before all others, as it is."""
        self._requeued.appendleft(batch)

    def record_timing(self, batch: Batch, seconds: float) -> None:
        """A batch took so many seconds."""
        count = batch.stop - batch.first
        rate = count / max(seconds, 1e-9)
        self._size = max(1, int(min(TARGET * rate, GROWTH * count, LARGEST)))
        self._least = max(1, int(min(LEAST * rate, self._size)))
        self.expected = self._left * seconds / count


def missing_ranges(ranges: Iterable[tuple[int, int]], total: int) -> list[tuple[int, int]]:
    """(first, stop) of the cases up to `total` that no (first, count) of sorted ranges holds."""
    missing, place = [], 0
    for first, count in ranges:
        if first > place:
            missing.append((place, first))
        place = first + count
    return [*missing, (place, total)] if place < total else missing


_Waiting: TypeAlias = dict[Future[Any], tuple[Executor, Batch]]


def run_batches(
    executors: Sequence[Executor],
    function: Callable[..., tuple[Any, float]],
    arguments: Callable[[Batch], tuple[Any, ...]],
    scheduler: BatchScheduler,
    enough: Callable[[], bool] = lambda: False,
) -> Iterator[BatchResult]:
    """Yields a `BatchResult` for every batch of a scheduler, in the order in which they end.

    `function(*arguments(batch))` gives (table, seconds).  Until the first batch is done no second one begins: it compiles the kernels
    that all others need.  No batch begins when `enough()`.  A batch whose worker dies is taken again; InputError where a Dask scheduler
    goes away.
    """
    scheduler.workers = sum(executor.workers for executor in executors)
    waiting: _Waiting = {}  # in the order of their submission
    while waiting or (scheduler and not enough()):
        begun = scheduler.expected is not None
        for executor in executors if begun else executors[:1]:
            for _ in range((executor.capacity if begun else 1) - sum(at is executor for at, _ in waiting.values())):
                if scheduler and not enough():
                    batch = scheduler.next_batch()
                    waiting[executor.submit(function, *arguments(batch))] = executor, batch
        done, _ = wait(waiting, POLL, FIRST_COMPLETED)
        for future in sorted(done, key=list(waiting).index):
            if future in waiting:
                yield from _settled(future, waiting, scheduler)
        _check_executors(executors)


def _settled(future: Future[Any], waiting: _Waiting, scheduler: BatchScheduler) -> Iterator[BatchResult]:
    """What came of a call that has ended."""
    executor, batch = waiting[future]
    try:
        table, seconds = future.result()
    except BrokenExecutor:
        yield from _after_death(executor, waiting, scheduler)
    except CancelledError:
        _check_executors([executor])
        del waiting[future]
        scheduler.requeue(batch)
    except ImportError as error:
        raise InputError(f"a worker cannot load the program ({error}); install the same drivewright where it runs") from error
    except Exception as error:
        if not executor.is_death(error):
            raise
        del waiting[future]
        yield BatchResult(batch, reason="the workers that computed this batch died (of memory, or killed from outside)")
    else:
        del waiting[future]
        scheduler.record_timing(batch, seconds)
        yield BatchResult(batch, table, seconds)


def _after_death(executor: Executor, waiting: _Waiting, scheduler: BatchScheduler) -> Iterator[BatchResult]:
    """The process of an executor is dead: its oldest call is to blame, the others go out again as they were."""
    mine = {future: batch for future, (at, batch) in waiting.items() if at is executor}
    lost = []
    for future, batch in mine.items():
        del waiting[future]
        if future.done() and future.exception() is None:
            yield BatchResult(batch, *future.result())
        else:
            lost.append(batch)
    executor.restart()
    for batch in reversed(lost[1:]):
        scheduler.requeue(batch)
    blamed = lost[0]._replace(deaths=lost[0].deaths + 1)
    if blamed.deaths < TRIES:
        scheduler.requeue(blamed)
    elif blamed.stop - blamed.first > 1:
        middle = (blamed.first + blamed.stop) // 2
        scheduler.requeue(Batch(middle, blamed.stop, TRIES - 1))
        scheduler.requeue(Batch(blamed.first, middle, TRIES - 1))
    else:
        yield BatchResult(blamed, reason=f"the process that computed this case died {TRIES} times (of memory, or killed from outside)")


def _check_executors(executors: Iterable[Executor]) -> None:
    """InputError where one of them can give nothing any more."""
    for fault in filter(None, (executor.fault() for executor in executors)):
        raise InputError(
            f"{fault}; every case that was finished before is kept. Start it again and give the same command, or continue "
            "without it (leave --on out)"
        )
