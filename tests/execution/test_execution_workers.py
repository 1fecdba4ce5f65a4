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
from drivewright.execution.workers import Cancellation, Worker, WorkerDied, WorkerFault, WorkerPool

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


@pytest.mark.skipif(not Path("/proc/self/limits").exists(), reason="reads limits in /proc")
def test_a_process_may_take_its_share_of_the_memory_only(worker):
    call(worker, worker_toy.process)
    limits = Path(f"/proc/{worker.process.pid}/limits").read_text()
    share = int(re.search(r"Max data size +(\d+)", limits)[1]) / (os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES"))
    assert 0.2 < share < 0.5
