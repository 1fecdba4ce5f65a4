"""Many cases: the same answers for any number of workers, failures as rows, nothing finished lost."""

import os
import signal
import threading
import time

import numpy as np
import pytest

from drivewright.cases import Outcome, Outcomes, run
from drivewright.errors import DoesNotAssemble, InputError, SolverError

pytestmark = pytest.mark.interface

WORKERS = [1, 2, 5]


def chaotic(case):
    """Hundred steps of the logistic map from a random start: any difference in the order of work would show."""
    seed, r = case
    x = np.random.default_rng(seed).uniform(0.1, 0.9)
    for _ in range(100):
        x = r * x * (1 - x)
    return x


def touchy(case):
    if case % 3 == 1:
        raise DoesNotAssemble(f"case {case} misses by {case} mm")
    if case % 3 == 2:
        raise SolverError(f"case {case} gave up", partial=10 * case)
    return -case


@pytest.mark.parametrize("workers", WORKERS)
def test_the_answers_do_not_depend_on_the_number_of_workers(workers):
    cases = [(seed, 3.9) for seed in range(20)]
    found = run(chaotic, cases, workers)
    assert found == Outcomes(tuple(Outcome(case, chaotic(case)) for case in cases))
    assert not found.interrupted and not found.failed


@pytest.mark.parametrize("workers", WORKERS)
def test_rows_keep_the_order_of_the_cases_not_that_of_the_finish(workers):
    def slow_first(case):
        time.sleep(0.03 / (1 + case))
        return case**2

    assert [row.value for row in run(slow_first, (n for n in range(6)), workers).rows] == [0, 1, 4, 9, 16, 25]


@pytest.mark.parametrize("workers", WORKERS)
def test_our_own_errors_are_rows_with_the_reason_and_the_partial_value(workers):
    found = run(touchy, range(6), workers)
    assert found.rows == (
        Outcome(0, 0),
        Outcome(1, None, "case 1 misses by 1 mm"),
        Outcome(2, 20, "case 2 gave up"),
        Outcome(3, -3),
        Outcome(4, None, "case 4 misses by 4 mm"),
        Outcome(5, 50, "case 5 gave up"),
    )
    assert [row.ok for row in found.rows] == [True, False, False] * 2
    assert [row.case for row in found.failed] == [1, 2, 4, 5]


def test_an_error_without_words_still_gives_a_reason():
    def mute(case):
        raise InputError

    assert run(mute, [7]).rows == (Outcome(7, None, "InputError"),)


@pytest.mark.parametrize("workers", WORKERS)
def test_a_bug_is_raised_names_its_case_and_ends_the_study(workers):
    begun = []

    def buggy(case):
        begun.append(case)
        time.sleep(0.01 if case == 3 else 0.005)
        if case in (3, 4):  # with threads case 4 fails first; the first in line is raised all the same
            raise ZeroDivisionError(case)
        return case

    with pytest.raises(ZeroDivisionError) as caught:
        run(buggy, range(3, 60), workers)
    assert caught.value.args == (3,)
    assert caught.value.__notes__ == ["in case 1 of 57: 3"]
    assert len(begun) < 20


@pytest.mark.parametrize("workers", WORKERS)
def test_progress_counts_every_case_from_the_thread_of_the_caller(workers):
    calls = []
    run(touchy, range(5), workers, lambda *what: calls.append((threading.current_thread(), *what)))
    assert {call[0] for call in calls} == {threading.main_thread()}
    assert [call[1:3] for call in calls] == [(n, 5) for n in range(1, 6)]
    assert calls[-1][3] == "3 without a complete answer"
    if workers == 1:
        assert [call[3] for call in calls[:2]] == ["", "1 without a complete answer"]


def test_threads_work_side_by_side_and_no_more_than_asked_for():
    meeting, busy, most = threading.Barrier(2, timeout=10), [], []

    def meet(case):
        busy.append(case)
        most.append(len(busy))
        meeting.wait()  # breaks unless two are here at once
        busy.remove(case)

    assert len(run(meet, range(4), workers=2).rows) == 4
    assert max(most) == 2
    assert run(lambda case: threading.current_thread(), [0]).rows[0].value is threading.main_thread()


def test_without_a_number_there_is_one_worker_per_usable_core(monkeypatch):
    monkeypatch.setattr(os, "sched_getaffinity", lambda pid: {0, 3, 5}, raising=False)
    meeting = threading.Barrier(3, timeout=10)
    assert len(run(lambda case: meeting.wait(), range(3), workers=None).rows) == 3
    monkeypatch.delattr(os, "sched_getaffinity")
    monkeypatch.setattr(os, "cpu_count", lambda: 1)
    assert run(lambda case: threading.current_thread(), [0], workers=None).rows[0].value is threading.main_thread()


@pytest.mark.parametrize("workers", WORKERS)
def test_every_case_meets_the_error_handling_of_the_caller_and_leaves_none_behind(workers):
    def divide(case):
        try:
            np.float64(1) / np.float64(case)
        except FloatingPointError:
            return "raised"
        np.seterr(divide="ignore")
        return "divided"

    assert [row.value for row in run(divide, [1, 0, 1, 0, 0], workers).rows] == ["divided", "raised", "divided", "raised", "raised"]


@pytest.mark.parametrize("workers", [1, 2])
def test_ctrl_c_keeps_what_is_finished_and_begins_nothing_more(workers):
    begun = []

    def task(case):
        begun.append(case)
        time.sleep(0.01)
        if case == 3:  # while the caller waits, not while it counts
            os.kill(os.getpid(), signal.SIGINT)
        time.sleep(0.1 if case == 3 else 0.01)
        return case

    found = run(task, range(40), workers)
    assert found.interrupted
    # In line, the case under way is the one that Ctrl-C breaks off; in threads it ends.
    assert [row.value for row in found.rows] == (begun[:-1] if workers == 1 else sorted(begun))
    assert 3 <= len(found.rows) < 12


def test_a_second_ctrl_c_does_not_wait_for_the_case_under_way():
    gate, timers = threading.Event(), [threading.Timer(delay, os.kill, (os.getpid(), signal.SIGINT)) for delay in (0.15, 0.4)]
    for timer in timers:
        timer.start()
    found = run(lambda case: gate.wait(20) if case == 1 else case, range(3), workers=2)
    gate.set()
    assert found == Outcomes((Outcome(0, 0), Outcome(2, 2)), interrupted=True)


@pytest.mark.parametrize("workers", [1, 2])
def test_ctrl_c_before_anything_is_finished_goes_on_to_the_caller(workers):
    def stop(case):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(stop, range(3), workers)


@pytest.mark.parametrize("workers", [1, 2])
def test_progress_can_stop_the_study(workers):
    def stop(error):
        def progress(done, total, what):
            if done == 2:
                raise error

        return progress

    def task(case):
        time.sleep(0.01)
        return case

    before = threading.active_count()  # a library loaded by another test may keep a thread of its own
    found = run(task, range(30), workers, stop(KeyboardInterrupt))
    assert found.interrupted and 2 <= len(found.rows) <= 5
    with pytest.raises(LookupError, match="full"):
        run(task, range(30), workers, stop(LookupError("full")))
    assert threading.active_count() == before


@pytest.mark.parametrize("workers", WORKERS)
def test_no_cases_no_rows(workers):
    assert run(chaotic, [], workers) == Outcomes(())


@pytest.mark.parametrize("workers", [0, -2, 1.5, True, "all"])
def test_a_strange_number_of_workers_is_refused(workers):
    with pytest.raises(InputError, match="from 1 up, or be left out for one per core; got"):
        run(chaotic, [], workers)
