"""The missing cases of a study, handed out in batches and computed by the lanes of a pool."""

import math
from collections import deque
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, CancelledError, wait
from typing import NamedTuple

from drivewright.errors import InputError

TARGET, LEAST = 1.5, 0.5  # seconds that a batch should take, and below which no batch is split for the sake of an even end
GROWTH = 8  # a batch may have so many times the cases of the one before: the first ones compile
LARGEST = 200_000  # cases of a batch: what is held in memory on its way
TRIES = 3  # a batch whose worker dies is taken again, twice; then its halves once each, until the deadly case is alone
WORTH_HELP = 3.0  # seconds of work: other processes need one or two to start
LOOK = 1.0  # seconds between two looks at the pool


class Batch(NamedTuple):
    """Cases from `first` up to `stop`, and how often workers died of them."""

    first: int
    stop: int
    deaths: int = 0


class Done(NamedTuple):
    """A batch with what came of it: `answer`, or the `reason` why its cases have none."""

    batch: Batch
    answer: object = None
    seconds: float = 0.0
    reason: str = ""


class Supply:
    """Hands out the missing cases; learns from what is done how many make a batch, and how long all will take: `expected` [s], None before
    the first batch is done."""

    def __init__(self, ranges, total, workers):
        self._gaps = deque(gaps(ranges, total))
        self._left = sum(stop - first for first, stop in self._gaps)
        self._again = deque()
        self.workers, self._size, self._least, self.expected = workers, 1, 1, None

    def __bool__(self):
        return bool(self._again or self._gaps)

    def next(self):
        """The next batch."""
        if self._again:
            return self._again.popleft()
        first, stop = self._gaps.popleft()
        share = math.ceil(self._left / (2 * self.workers))
        end = min(stop, first + min(self._size, max(self._least, share)))
        if end < stop:
            self._gaps.appendleft((end, stop))
        self._left -= end - first
        return Batch(first, end)

    def again(self, batch):
        """Take a batch back: it goes out before all others, as it is."""
        self._again.appendleft(batch)

    def learn(self, batch, seconds):
        """A batch took so many seconds."""
        count = batch.stop - batch.first
        rate = count / max(seconds, 1e-9)
        self._size = max(1, int(min(TARGET * rate, GROWTH * count, LARGEST)))
        self._least = max(1, int(min(LEAST * rate, self._size)))
        self.expected = self._left * seconds / count


def gaps(ranges, total):
    """(first, stop) of the cases up to `total` that no (first, count) of sorted ranges holds."""
    found, place = [], 0
    for first, count in ranges:
        if first > place:
            found.append((place, first))
        place = first + count
    return [*found, (place, total)] if place < total else found


def compute(lanes, function, arguments, supply, enough=lambda: False):
    """Yields a `Done` for every batch of a supply, in the order in which they end.

    `function(*arguments(batch))` gives (answer, seconds).  Until the first batch is done no second one begins: it compiles the kernels
    that all others need.  No batch begins when `enough()`.  A batch whose worker dies is taken again; InputError where the scheduler
    goes away.
    """
    supply.workers = sum(lane.workers for lane in lanes)
    waiting = {}  # future -> (lane, batch), in the order of their submission
    while waiting or (supply and not enough()):
        begun = supply.expected is not None
        for lane in lanes if begun else lanes[:1]:
            for _ in range((lane.capacity if begun else 1) - sum(at is lane for at, _ in waiting.values())):
                if supply and not enough():
                    batch = supply.next()
                    waiting[lane.submit(function, *arguments(batch))] = lane, batch
        done, _ = wait(waiting, LOOK, FIRST_COMPLETED)
        for future in sorted(done, key=list(waiting).index):
            if future in waiting:
                yield from _settled(future, waiting, supply)
        _refuse_loss(lanes)


def _settled(future, waiting, supply):
    """What came of a call that has ended."""
    lane, batch = waiting[future]
    try:
        answer, seconds = future.result()
    except BrokenExecutor as death:
        yield from _buried(lane, death, waiting, supply)
    except CancelledError:
        _refuse_loss([lane])
        del waiting[future]
        supply.again(batch)
    except Exception as error:
        if isinstance(error, ImportError):
            raise InputError(f"a worker cannot load the program ({error}); install the same drivewright where it runs") from error
        if type(error).__name__ != "KilledWorker":
            raise
        del waiting[future]
        yield Done(batch, reason="the workers that computed this batch died (of memory, or killed from outside)")
    else:
        del waiting[future]
        supply.learn(batch, seconds)
        yield Done(batch, answer, seconds)


def _buried(lane, death, waiting, supply):
    """A lane's process is dead: its oldest call is to blame, the others go out again as they were."""
    mine = {future: batch for future, (at, batch) in waiting.items() if at is lane}
    lost = []
    for future, batch in mine.items():
        del waiting[future]
        if future.done() and future.exception() is None:
            yield Done(batch, *future.result())
        else:
            lost.append(batch)
    lane.revive()
    for batch in reversed(lost[1:]):
        supply.again(batch)
    blamed = lost[0]._replace(deaths=lost[0].deaths + 1)
    if blamed.deaths < TRIES:
        supply.again(blamed)
    elif blamed.stop - blamed.first > 1:
        middle = (blamed.first + blamed.stop) // 2
        supply.again(Batch(middle, blamed.stop, TRIES - 1))
        supply.again(Batch(blamed.first, middle, TRIES - 1))
    else:
        yield Done(blamed, reason=f"the process that computed this case died {TRIES} times (of memory, or killed from outside)")


def _refuse_loss(lanes):
    for trouble in filter(None, (lane.trouble() for lane in lanes)):
        raise InputError(
            f"{trouble}; every case that was finished before is kept. Start it again and give the same command, or go on "
            "without it (leave --on out)"
        )
