"""Calls in which the engine computes for seconds: their answer, their errors, and Ctrl-C in the middle."""

import _thread
import threading
import time

import pytest

from drivewright.errors import SolverError
from drivewright.solids.engine import interruptible

pytestmark = pytest.mark.interface


def test_the_answer_and_the_error_are_those_of_the_call():
    def give_up():
        raise SolverError("the mesher gave up")

    assert interruptible(lambda: 7) == 7
    with pytest.raises(SolverError, match="the mesher gave up"):
        interruptible(give_up)


def test_in_another_thread_the_call_is_made_there():
    found = []
    thread = threading.Thread(target=lambda: found.append(interruptible(threading.get_ident)))
    thread.start()
    thread.join()
    assert found == [thread.ident]
    assert interruptible(threading.get_ident) != threading.get_ident()


def test_an_interrupt_does_not_wait_and_the_next_call_does():
    """The engine is never in two calls at once."""
    ended, order = threading.Event(), []

    def long():
        threading.Timer(0.2, _thread.interrupt_main).start()
        ended.wait(30)
        order.append("long")

    began = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        interruptible(long)
    assert time.monotonic() - began < 10
    threading.Timer(0.3, ended.set).start()
    interruptible(lambda: order.append("next"))
    assert order == ["long", "next"]
