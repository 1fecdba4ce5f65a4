"""Worker processes of the studio: answers, errors in their own words, an end at any moment, a death that is told."""

import asyncio
import os
import re
import signal
import time
from pathlib import Path

import lane_toy
import loops
import pytest

from drivewright.errors import SpecError
from drivewright.studio.lanes import NOW, Failed, Lane, Lanes, Lost


@pytest.fixture(scope="module")
def lane():
    found = Lane()
    yield found
    found.close()


def call(lane, function, *arguments, **more):
    return loops.run(lane.call(function, *arguments, **more))


def test_an_answer_and_news_on_the_way(lane):
    news = []
    assert call(lane, lane_toy.double, 21, heard=news.append) == 42
    assert news == [("half way", 21)]


def test_it_is_another_process_and_stays_the_same(lane):
    first = call(lane, lane_toy.process)
    assert first == lane.process.pid != os.getpid()
    assert call(lane, lane_toy.process) == first


def test_our_errors_come_as_they_are(lane):
    with pytest.raises(SpecError, match=r"^drive.radius: must be greater than 0 mm, got -1 mm$") as caught:
        call(lane, lane_toy.refuse)
    assert caught.value.key == "drive.radius"
    assert call(lane, lane_toy.double, 1) == 2


def test_a_bug_comes_with_its_traceback_and_the_process_lives(lane):
    before = lane.process.pid
    with pytest.raises(Failed, match=r"(?s)Traceback.*in bug.*KeyError: 'no such key'"):
        call(lane, lane_toy.bug)
    assert call(lane, lane_toy.process) == before


def test_a_death_is_told_and_the_next_call_has_a_new_process(lane):
    before = lane.process.pid
    with pytest.raises(Lost, match="ended with code 7; a new one takes over"):
        call(lane, lane_toy.die)
    assert call(lane, lane_toy.process) != before


def test_a_process_killed_from_outside_is_told_at_once(lane):
    async def killed():
        heard = asyncio.Event()
        task = asyncio.create_task(lane.call(lane_toy.wait_deaf, 60, heard=lambda what: heard.set()))
        await heard.wait()
        os.kill(lane.process.pid, signal.SIGKILL)
        await task

    began = time.monotonic()
    with pytest.raises(Lost, match="was ended by signal 9"):
        loops.run(killed())
    assert time.monotonic() - began < 30


async def _cancelled(lane, function, seconds, *message):
    heard = asyncio.Event()
    task = asyncio.create_task(lane.call(function, seconds, heard=lambda what: heard.set()))
    await heard.wait()
    task.cancel(*message)
    with pytest.raises(asyncio.CancelledError):
        await task


def test_a_call_that_listens_stops_and_keeps_its_process(lane):
    before = call(lane, lane_toy.process)
    loops.run(_cancelled(lane, lane_toy.wait_politely, 60))
    assert call(lane, lane_toy.process) == before


def test_a_call_that_does_not_listen_is_waited_for(lane):
    before = call(lane, lane_toy.process)
    loops.run(_cancelled(lane, lane_toy.wait_deaf, 0.6))
    assert call(lane, lane_toy.process) == before


def test_or_ended_when_a_person_does_not_want_to_wait(lane):
    before = call(lane, lane_toy.process)
    loops.run(_cancelled(lane, lane_toy.wait_deaf, 60, NOW))
    assert call(lane, lane_toy.process) != before


def test_a_stop_that_comes_too_late_harms_nobody(lane):
    assert call(lane, lane_toy.double, 1) == 2
    lane._pipe.send(None)
    assert call(lane, lane_toy.double, 2) == 4


def test_lanes_are_made_when_wanted_and_used_again():
    async def work():
        lanes = Lanes(2)
        try:
            async with lanes.lane() as one, lanes.lane() as other:
                assert one is not other
                third = asyncio.create_task(lanes.lane().__aenter__())
                await asyncio.sleep(0.05)
                assert not third.done()
            assert await third in (one, other)
            assert len(lanes.processes()) == 2
        finally:
            lanes.close()
        return one, other

    assert not any(lane.process.is_alive() for lane in loops.run(work()))


@pytest.mark.skipif(not Path("/proc/self/limits").exists(), reason="reads limits in /proc")
def test_a_process_may_take_its_share_of_the_memory_only(lane):
    call(lane, lane_toy.process)
    limits = Path(f"/proc/{lane.process.pid}/limits").read_text()
    share = int(re.search(r"Max data size +(\d+)", limits)[1]) / (os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES"))
    assert 0.2 < share < 0.5
