"""Independent calls side by side, in order and out of it."""

import os
import time

import pytest

from drivewright.errors import InputError
from drivewright.execution import helper
from drivewright.execution.executors import ProcessExecutor, side_by_side
from drivewright.execution.helper import helping_hand

pytestmark = pytest.mark.interface


def square(x):
    return x * x, os.getpid()


def nap(x):
    time.sleep(0.05)
    return x * x, os.getpid()


def refuse(x):
    if x == 2:
        raise InputError("two is refused")
    return x


def only_here(x):
    if os.environ.get("PYTEST_CURRENT_TEST") is None or os.getpid() != HERE:
        raise InputError("not in another process")
    return x + 1


HERE = os.getpid()


def test_every_call_comes_back_once_with_its_index():
    begun = []
    results = dict(side_by_side(square, [(x,) for x in range(7)], begun=begun.append))
    assert {index: result[0] for index, result in results.items()} == {x: x * x for x in range(7)}
    assert sorted(begun) == list(range(7)) and os.getpid() not in {process for _, process in results.values()}


def test_calls_of_one_group_run_one_after_another():
    seen = []
    for index, _ in side_by_side(
        nap, [(x,) for x in range(6)], ["a", "a", "b", "a", "b", "c"], lambda index: seen.append(("begun", index))
    ):
        seen.append(("done", index))
    for group in ([0, 1, 3], [2, 4]):
        assert [each for each in seen if each[1] in group] == [(what, index) for index in group for what in ("begun", "done")]


def test_what_a_call_raises_is_raised_here():
    with pytest.raises(InputError, match="two is refused"):
        list(side_by_side(refuse, [(x,) for x in range(5)]))
    assert list(side_by_side(square, [])) == []


@pytest.fixture
def two_cores(monkeypatch):
    monkeypatch.setattr(helper, "worker_count", lambda workers: 2)


def until_at_work(monkeypatch):
    """The other process is at work before the first call is made."""
    start = ProcessExecutor.__init__

    def started(self, prepare):
        start(self, prepare)
        deadline = time.monotonic() + 60
        while not self.at_work and time.monotonic() < deadline:
            time.sleep(0.01)

    monkeypatch.setattr(ProcessExecutor, "__init__", started)


def test_two_share_the_work_and_the_order_stays(two_cores, monkeypatch):
    until_at_work(monkeypatch)
    with helping_hand(int) as compute:
        results = list(compute(nap, range(12)))
    assert [value for value, _ in results] == [x * x for x in range(12)]
    assert len({process for _, process in results}) == 2 and results[0][1] == HERE and results[-1][1] != HERE


def test_what_the_other_process_cannot_do_is_done_here(two_cores, monkeypatch):
    until_at_work(monkeypatch)
    with helping_hand(int) as compute:
        assert list(compute(only_here, range(9))) == list(range(1, 10))
        assert list(compute(lambda x: 2 * x, range(9))) == list(range(0, 18, 2))  # cannot be sent


def test_nobody_waits_for_a_process_that_does_not_come_to_work(two_cores):
    with helping_hand(lambda: None) as compute:  # cannot be sent either: it never comes to work
        assert [process for _, process in compute(square, range(5))] == [HERE] * 5


def test_one_core_and_nothing_wanted_need_no_process(two_cores, monkeypatch):
    monkeypatch.setattr(ProcessExecutor, "__init__", lambda self, prepare: pytest.fail("a process"))
    with helping_hand(int, wanted=False) as compute:
        assert compute is map
    monkeypatch.setattr(helper, "worker_count", lambda workers: 1)
    with helping_hand(int) as compute:
        assert compute is map
