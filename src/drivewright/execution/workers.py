"""Worker processes that answer a server: one call at a time each, with messages on the way, and an end at any moment.

A call is `function(send, *arguments)`, run in a process of its own.  `send(message)` sends anything picklable to the caller at once, and
raises `Cancelled` where the caller has asked for an end.  The server only ever waits: whatever a computation does, the server stays alive.
"""

import asyncio
import os
import threading
import traceback
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager, suppress
from enum import Enum
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from typing import Any

from drivewright.errors import DrivewrightError
from drivewright.execution.processes import exit_with_parent, worker_environment

MEMORY_SHARE = 0.4  # of the machine's memory that one process may take
PATIENCE = 60.0  # seconds that a call which nobody waits for may take to notice
PATIENCE_NOW = 0.3  # seconds that a call may take to clear up


class Cancellation(Enum):
    """How urgent the end of a call is: the argument of a task's `cancel`."""

    NOW = "the process is ended where it does not stop at once"


class Cancelled(Exception):
    """The caller wants no answer any more."""


class WorkerDied(DrivewrightError):
    """The process ended in the middle of a call."""


class WorkerFault(Exception):
    """A fault of the program: the traceback of the process as text."""


# -- in the process ------------------------------------------------------------------------------------------------------------


def _work(pipe: Connection, alive: Connection, parent: int) -> None:
    """Take calls from the pipe until it closes."""
    exit_with_parent(parent, alive)
    _limit_memory()
    with suppress(EOFError, OSError):
        while True:
            call = pipe.recv()
            if call is not None:  # a cancellation that came after the end
                pipe.send(_answer(pipe, *call))


def _limit_memory() -> None:
    """A design that wants more than its share of the memory fails, and takes neither the machine nor the other tabs along."""
    with suppress(ImportError, ValueError, OSError):
        import resource

        share = int(MEMORY_SHARE * os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES"))
        resource.setrlimit(resource.RLIMIT_DATA, (share, resource.getrlimit(resource.RLIMIT_DATA)[1]))


def _answer(pipe: Connection, function: Callable[..., Any], arguments: tuple[Any, ...]) -> tuple[str, Any]:
    """("answer", value) or ("error", what was raised; a fault of the program as WorkerFault with its traceback)."""

    def send(message: object) -> None:
        if pipe.poll():
            pipe.recv()  # None: nothing else can come during a call
            raise Cancelled
        pipe.send(("message", message))

    try:
        return "answer", function(send, *arguments)
    except (Cancelled, DrivewrightError) as error:
        return "error", error
    except Exception:
        return "error", WorkerFault(traceback.format_exc())


# -- in the server -------------------------------------------------------------------------------------------------------------


class Worker:
    """One process; it is made again when it has died."""

    def __init__(self) -> None:
        self._start()

    def _start(self) -> None:
        context = get_context("spawn")
        self._pipe, theirs = context.Pipe()
        alive, self._hold = context.Pipe(duplex=False)
        self.process: BaseProcess = context.Process(target=_work, args=(theirs, alive, os.getpid()))
        with worker_environment():
            self.process.start()
        theirs.close()
        alive.close()

    async def call(self, function: Callable[..., Any], *arguments: Any, on_message: Callable[[Any], object] = lambda message: None) -> Any:
        """The function's answer; its error, WorkerDied or WorkerFault.  `on_message(message)` is called for every message it sends.

        Where the caller is cancelled, the process is asked to stop and given PATIENCE: it may be compiling what the next call needs too.
        Where the caller is cancelled with `Cancellation.NOW`, the process is ended if it does not stop at once.
        """
        if not self.process.is_alive():
            self._start()
        loop = asyncio.get_running_loop()
        ended = loop.create_future()
        threading.Thread(target=_listen, args=(self._pipe, self.process, loop, ended, on_message), daemon=True).start()
        with suppress(OSError):  # the listener reports a process that died before it could take the call
            self._pipe.send((function, arguments))
        try:
            return await asyncio.shield(ended)
        except asyncio.CancelledError as cancelled:
            await self._cancel(ended, PATIENCE_NOW if Cancellation.NOW in cancelled.args else PATIENCE)
            raise

    async def _cancel(self, ended: asyncio.Future[Any], patience: float) -> None:
        """Come to an end with the call under way, so that the worker is free for the next."""
        with suppress(OSError):
            self._pipe.send(None)
        try:
            await asyncio.wait([ended], timeout=patience)
        finally:
            if not ended.done():
                self.kill()
            ended.add_done_callback(lambda future: future.exception())  # nobody waits for it any more

    def kill(self) -> None:
        """End the process now, with whatever processes it started itself; the call under way raises WorkerDied."""
        self._hold.close()
        self.process.kill()
        self.process.join(1)

    def close(self) -> None:
        """Let the process go."""
        self.kill()


def _listen(
    pipe: Connection,
    process: BaseProcess,
    loop: asyncio.AbstractEventLoop,
    future: asyncio.Future[Any],
    on_message: Callable[[Any], object],
) -> None:
    """Hand on what comes from the process until the call has ended."""

    def settle(setter: Callable[[Any], object], value: Any) -> None:
        if not future.done():
            setter(value)

    def hand(function: Callable[..., object], *arguments: Any) -> None:
        with suppress(RuntimeError):  # the loop has gone: the server stops
            loop.call_soon_threadsafe(function, *arguments)

    while True:
        try:
            if pipe not in wait([pipe, process.sentinel]) and not pipe.poll():
                raise EOFError
            kind, content = pipe.recv()
        except (EOFError, OSError):
            process.join(1)
            return hand(settle, future.set_exception, WorkerDied(_death(process.exitcode)))
        except Exception as error:  # an answer that cannot be read
            return hand(settle, future.set_exception, WorkerFault(f"{type(error).__name__}: {error}"))
        if kind == "message":
            hand(on_message, content)
        elif kind == "answer":
            return hand(settle, future.set_result, content)
        else:
            return hand(settle, future.set_exception, content)


def _death(code: int | None) -> str:
    """Why a call has no answer, from the exit code of its process."""
    how = f"was ended by signal {-code}" if code and code < 0 else f"ended with code {code}"
    return f"the computing process {how}; a new one takes over. If it happens again with this design, run it on the command line to see why"


class WorkerPool:
    """As many workers as there may be at once, made when they are wanted."""

    def __init__(self, limit: int) -> None:
        self._free: list[Worker] = []
        self._all: list[Worker] = []
        self._turn = asyncio.Semaphore(limit)

    @asynccontextmanager
    async def worker(self) -> AsyncIterator[Worker]:
        """A worker to oneself, as soon as there is one."""
        async with self._turn:
            worker = self._free.pop() if self._free else self._new()
            try:
                yield worker
            finally:
                self._free.append(worker)

    def _new(self) -> Worker:
        self._all.append(Worker())
        return self._all[-1]

    def close(self) -> None:
        """Let all processes go."""
        for worker in self._all:
            worker.close()
