"""What is told to a page, and when: the form of what a hand moves less often than its drawings."""

import asyncio

import loops
import pytest

from drivewright.studio.outbox import PACE, Outbox

pytestmark = pytest.mark.interface


def values(gen, settled=(), **fields):
    return {"what": "values", "gen": gen, "settled": list(settled), "fields": fields}


def told(act):
    """What the page has heard when `act(outbox, heard)` has ended."""
    heard = []

    async def acting():
        outbox = Outbox(heard.append)
        await act(outbox, heard)
        return outbox

    loops.run(acting())
    return heard


def test_what_is_held_lets_drawings_pass_and_goes_before_any_other_message_once():
    scene, result = {"what": "scene", "gen": 1}, {"what": "result", "gen": 1}

    async def act(outbox, heard):
        outbox.hold(values(1, a=1))
        outbox(scene)
        outbox(result)
        outbox(result)
        await asyncio.sleep(2 * PACE)

    assert told(act) == [scene, values(1, a=1), result, result]


def test_steps_that_are_held_together_are_one_with_every_field_and_the_newest_value():
    async def act(outbox, heard):
        outbox.hold(values(1, ["a", "b"], a=1, b=2))
        outbox.hold(values(2, ["b", "c"], b=3, c=4))
        outbox.release()
        outbox.release()

    assert told(act) == [values(2, ["a", "b", "c"], a=1, b=3, c=4)]


def test_without_a_drawing_it_goes_when_it_has_waited_however_many_steps_follow():
    async def act(outbox, heard):
        for gen in range(1, 9):
            outbox.hold(values(gen))
            await asyncio.sleep(PACE / 4)
        assert heard and heard[0]["gen"] < 8
        await asyncio.sleep(2 * PACE)

    heard = told(act)
    assert heard[-1] == values(8) and len(heard) <= 3


def test_a_step_after_that_waits_its_own_time():
    async def act(outbox, heard):
        outbox.hold(values(1))
        outbox.release()
        await asyncio.sleep(PACE / 2)
        outbox.hold(values(2))
        await asyncio.sleep(0.7 * PACE)
        assert heard == [values(1)]
        await asyncio.sleep(2 * PACE)

    assert told(act) == [values(1), values(2)]


def test_a_tab_that_has_gone_is_told_nothing():
    async def act(outbox, heard):
        outbox.hold(values(1))
        outbox.close()
        await asyncio.sleep(2 * PACE)

    assert told(act) == []
