"""Worker processes of the studio: answers, errors in their own words, an end at any moment, a death that is told."""

import asyncio
import os
import re
import signal
import time
from pathlib import Path

import loops
import pytest
import worker_toy

from drivewright.errors import SpecError
from drivewright.execution.workers import LEAST_MEMORY, CallTimedOut, Cancellation, Worker, WorkerDied, WorkerFault, WorkerPool

pytestmark = pytest.mark.interface


@pytest.fixture(scope="module")
def worker():
    found = Worker()
    yield found
    found.close()


def call(worker, function, *arguments, **more):
    return loops.run(worker.call(function, *arguments, **more))


def test_an_answer_and_news_on_the_way(worker):
    news = []
    assert call(worker, worker_toy.double, 21, on_message=news.append) == 42
    assert news == [("half way", 21)]


def test_it_is_another_process_and_stays_the_same(worker):
    first = call(worker, worker_toy.process)
    assert first == worker.process.pid != os.getpid()
    assert call(worker, worker_toy.process) == first


def test_our_errors_come_as_they_are(worker):
    with pytest.raises(SpecError, match=r"^drive.radius: must be greater than 0 mm, got -1 mm$") as caught:
        call(worker, worker_toy.refuse)
    assert caught.value.key == "drive.radius"
    assert call(worker, worker_toy.double, 1) == 2


def test_a_bug_comes_with_its_traceback_and_the_process_lives(worker):
    before = worker.process.pid
    with pytest.raises(WorkerFault, match=r"(?s)Traceback.*in bug.*KeyError: 'no such key'"):
        call(worker, worker_toy.bug)
    assert call(worker, worker_toy.process) == before


def test_a_death_is_told_and_the_next_call_has_a_new_process(worker):
    before = worker.process.pid
    with pytest.raises(WorkerDied, match="ended with code 7; a new one takes over"):
        call(worker, worker_toy.die)
    assert call(worker, worker_toy.process) != before


def test_a_process_killed_from_outside_is_told_at_once(worker):
    async def killed():
        heard = asyncio.Event()
        task = asyncio.create_task(worker.call(worker_toy.wait_deaf, 60, on_message=lambda what: heard.set()))
        await heard.wait()
        os.kill(worker.process.pid, signal.SIGKILL)
        await task

    began = time.monotonic()
    with pytest.raises(WorkerDied, match="was ended by signal 9"):
        loops.run(killed())
    assert time.monotonic() - began < 30


async def _cancelled(worker, function, seconds, *message):
    heard = asyncio.Event()
    task = asyncio.create_task(worker.call(function, seconds, on_message=lambda what: heard.set()))
    await heard.wait()
    task.cancel(*message)
    with pytest.raises(asyncio.CancelledError):
        await task


def test_a_call_that_listens_stops_and_keeps_its_process(worker):
    before = call(worker, worker_toy.process)
    loops.run(_cancelled(worker, worker_toy.wait_politely, 60))
    assert call(worker, worker_toy.process) == before


def test_a_call_that_does_not_listen_is_waited_for(worker):
    before = call(worker, worker_toy.process)
    loops.run(_cancelled(worker, worker_toy.wait_deaf, 0.6))
    assert call(worker, worker_toy.process) == before


def test_or_ended_when_a_person_does_not_want_to_wait(worker):
    before = call(worker, worker_toy.process)
    loops.run(_cancelled(worker, worker_toy.wait_deaf, 60, Cancellation.NOW))
    assert call(worker, worker_toy.process) != before


def test_a_stop_that_comes_too_late_harms_nobody(worker):
    assert call(worker, worker_toy.double, 1) == 2
    worker._pipe.send(None)
    assert call(worker, worker_toy.double, 2) == 4


def test_workers_are_made_when_wanted_and_used_again():
    async def work():
        pool = WorkerPool(2)
        try:
            async with pool.worker() as one, pool.worker() as other:
                assert one is not other
                third = asyncio.create_task(pool.worker().__aenter__())
                await asyncio.sleep(0.05)
                assert not third.done()
            assert await third in (one, other)
            assert len({one.process.pid, other.process.pid}) == 2
        finally:
            pool.close()
        return one, other

    assert not any(worker.process.is_alive() for worker in loops.run(work()))


def test_a_closed_pool_starts_nothing_again():
    async def work():
        pool = WorkerPool(2)
        async with pool.worker() as one:
            pool.close()
            with pytest.raises(WorkerDied, match="closed"):
                await one.call(worker_toy.process)
            with pytest.raises(WorkerDied, match="closed"):
                async with pool.worker():
                    pass
        return one

    assert not loops.run(work()).process.is_alive()


@pytest.mark.skipif(not Path("/proc/self/limits").exists(), reason="reads limits in /proc")
def test_a_process_may_take_its_share_of_the_memory_only(worker):
    call(worker, worker_toy.process)
    limits = Path(f"/proc/{worker.process.pid}/limits").read_text()
    share = int(re.search(r"Max data size +(\d+)", limits)[1]) / (os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES"))
    assert 0.2 < share < 0.5


@pytest.mark.skipif(not Path("/proc/self/limits").exists(), reason="limits of memory are kept by Linux")
def test_the_smallest_machine_still_lets_a_process_begin():
    tiny = Worker(memory=1e-6)
    try:
        assert call(tiny, worker_toy.process)
    finally:
        tiny.close()


@pytest.mark.skipif(not Path("/proc/self/limits").exists(), reason="limits of memory are kept by Linux")
def test_a_call_that_wants_more_memory_fails_alone():
    modest = Worker(memory=0.1)
    try:
        before = call(modest, worker_toy.process)
        with pytest.raises((WorkerFault, WorkerDied)):
            call(modest, worker_toy.fill, max(int(0.15 * os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")), 2 * LEAST_MEMORY))
        assert call(modest, worker_toy.process) == before  # nothing was taken: the system refused
    finally:
        modest.close()


# -- limits --------------------------------------------------------------------------------------------------------------------


def test_a_silent_call_is_ended_at_its_limit(worker):
    before, since = call(worker, worker_toy.process), time.monotonic()
    with pytest.raises(CallTimedOut, match=r"^this took more than 0.3 s and was ended$"):
        call(worker, worker_toy.wait_deaf, 60, limit=0.3)
    assert time.monotonic() - since < 5
    assert call(worker, worker_toy.process) != before


def test_a_call_that_gives_signs_of_life_is_not(worker):
    assert call(worker, worker_toy.wait_politely, 0.8, limit=0.3) is None


def test_a_large_call_does_not_stop_the_loop_while_its_process_starts():
    async def work():
        fresh, longest, last = Worker(), 0.0, (began := time.monotonic())
        try:
            task = asyncio.create_task(fresh.call(worker_toy.length, b"x" * 20_000_000))  # far more than a pipe holds
            while not task.done():
                await asyncio.sleep(0.005)
                longest, last = max(longest, time.monotonic() - last), time.monotonic()
            return task.result(), longest / (last - began)
        finally:
            fresh.close()

    length, longest = loops.run(work())
    assert length == 20_000_000 and longest < 0.5  # of the whole, most of which is the start of the process


def test_a_large_call_that_is_cancelled_before_it_is_taken_leaves_a_worker_that_works():
    async def work():
        fresh = Worker()
        try:
            task = asyncio.create_task(fresh.call(worker_toy.length, b"x" * 20_000_000))
            await asyncio.sleep(0.02)
            task.cancel()
            with pytest.raises(asyncio.CancelledError):
                await task
            return await fresh.call(worker_toy.double, 4)
        finally:
            fresh.close()

    assert loops.run(work()) == 8


@pytest.mark.parametrize("seconds", [0.0, 0.01, 0.1, 0.4, 1.0])
def test_a_process_killed_at_any_moment_is_told_and_the_next_call_works(seconds):
    """While it starts, while it takes the call, in the middle, after the end: never an answer that is lost without a word."""

    async def work():
        fresh = Worker()
        try:
            task = asyncio.create_task(fresh.call(worker_toy.wait_politely, 0.6))
            await asyncio.sleep(seconds)
            os.kill(fresh.process.pid, signal.SIGKILL)
            (outcome,) = await asyncio.gather(task, return_exceptions=True)
            await asyncio.sleep(0.05)  # for the system to end it
            return outcome, await fresh.call(worker_toy.double, 4)
        finally:
            fresh.close()

    outcome, after = loops.run(work())
    assert (outcome is None or isinstance(outcome, WorkerDied)) and after == 8


# -- shares --------------------------------------------------------------------------------------------------------------------


async def waited_for(pool, owner):
    """A task that holds a worker of the pool until it is cancelled; done waiting where there was one."""
    got = asyncio.Event()

    async def hold():
        async with pool.worker(owner):
            got.set()
            await asyncio.Event().wait()

    task = asyncio.create_task(hold())
    await asyncio.sleep(0.01)
    return task, got


async def _released(*tasks):
    for task in tasks:
        task.cancel()
    await asyncio.gather(*tasks, return_exceptions=True)
    await asyncio.sleep(0.01)


@pytest.fixture
def processless(monkeypatch):
    """Pools whose workers are no processes."""
    monkeypatch.setattr("drivewright.execution.workers.Worker", lambda *settings: object())


def test_one_owner_never_has_all_workers(processless):
    async def work():
        pool = WorkerPool(3, share=2)
        (one, first), (two, second), (three, third) = [await waited_for(pool, "a") for _ in range(3)]
        assert first.is_set() and second.is_set() and not third.is_set() and pool.crowded
        other, fourth = await waited_for(pool, "b")
        assert fourth.is_set()
        await _released(one)
        assert third.is_set() and not pool.crowded
        await _released(two, three, other)

    loops.run(work())


def test_the_next_is_who_has_the_fewest(processless):
    async def work():
        pool = WorkerPool(2)
        (one, _), (two, _) = [await waited_for(pool, "a") for _ in range(2)]
        waiting = [await waited_for(pool, owner) for owner in ("a", "a", "b", "c")]
        await _released(one)
        assert [got.is_set() for _, got in waiting] == [False, False, True, False]
        await _released(waiting[2][0])
        assert [got.is_set() for _, got in waiting] == [False, False, True, True]
        await _released(two)
        assert [got.is_set() for _, got in waiting] == [True, False, True, True]
        await _released(*(task for task, _ in waiting))
        assert not pool.crowded and pool._held.total() == 0

    loops.run(work())


def test_who_stops_waiting_takes_nothing_along(processless):
    async def work():
        pool = WorkerPool(1)
        one, _ = await waited_for(pool, "a")
        two, never = await waited_for(pool, "b")
        await _released(two)
        assert not never.is_set() and not pool.crowded
        three, got = await waited_for(pool, "c")
        one.cancel()
        three.cancel()  # granted and given up at the same moment
        await _released(one, three)
        four, last = await waited_for(pool, "d")
        assert last.is_set()
        await _released(four)

    loops.run(work())


@pytest.mark.skipif(not hasattr(os, "getpriority"), reason="no priorities of processes")
def test_long_work_leaves_the_processor_to_drawings():
    kind = Worker(niceness=5)
    try:
        assert call(kind, worker_toy.niceness) - os.getpriority(os.PRIO_PROCESS, 0) in (5, 19 - os.getpriority(os.PRIO_PROCESS, 0))
    finally:
        kind.close()
