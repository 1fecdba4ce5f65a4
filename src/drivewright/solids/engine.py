"""Import of Netgen and NGSolve (extra `fe`): loaded when first needed, with the cause where the import fails."""

import atexit
import importlib
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import Future
from contextlib import contextmanager
from typing import Any, TypeVar

from drivewright.errors import DrivewrightError, MissingExtra

QUADMATH = (
    "NGSolve's loader hides the real cause of a missing shared library: most often it is libquadmath; try: apt-get install libquadmath0"
)
LOOK = 0.1  # s between two looks for Ctrl-C
T = TypeVar("T")
EngineObject = Any  # shapes, meshes, forms and vectors of Netgen and NGSolve, which have no types of their own


def fe_module(name: str, purpose: str) -> Any:
    """A module of the extra `fe` by name, e.g. fe_module("netgen.occ", "STEP export"); MissingExtra says why it is not there."""
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as error:
        raise MissingExtra(purpose, "fe", error) from None
    except ImportError as error:  # installed, but a system library is not: "libopenblas.so.0: cannot open shared object file"
        raise MissingExtra(purpose, "fe", f"{error}. {QUADMATH}") from None


def engine_errors(purpose: str) -> tuple[type[Exception], ...]:
    """The errors that the CAD kernel and the mesher raise."""
    return RuntimeError, fe_module("netgen.meshing", purpose).NgException, fe_module("netgen.occ", purpose).OCCException


@contextmanager
def translated_errors(error_class: type[DrivewrightError], subject: str, advice: str, purpose: str) -> Iterator[None]:
    """Turns the poor messages of kernel and mesher into ours: "SUBJECT (their words); ADVICE"."""
    try:
        yield
    except engine_errors(purpose) as error:
        raise error_class(f"{subject} ({error}); {advice}") from error


_one_call = threading.Lock()


def interruptible(call: Callable[[], T]) -> T:
    """The answer of a call in which the engine computes for seconds: Ctrl-C does not wait for its end.

    In the main thread, which alone hears of Ctrl-C, another thread makes the call.  After an interrupt the engine goes on alone to the end
    of it; the next such call, and the end of the interpreter, wait for that.
    """
    if threading.current_thread() is not threading.main_thread():
        return call()
    answer: Future[T] = Future()
    thread = threading.Thread(target=_answer_call, args=(call, answer), daemon=True)
    thread.start()
    while thread.is_alive():
        thread.join(LOOK)
    return answer.result()


def is_computing() -> bool:
    """Whether the engine is in an `interruptible` call."""
    return _one_call.locked()


@atexit.register
def _wait_for_engine() -> None:
    with _one_call:  # what the interpreter takes down at its end the engine may still use
        pass


def _answer_call(call: Callable[[], T], answer: Future[T]) -> None:
    with _one_call:
        try:
            answer.set_result(call())
        except BaseException as error:  # the waiting thread must receive any error
            answer.set_exception(error)
