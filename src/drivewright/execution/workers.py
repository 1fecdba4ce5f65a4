"""Worker processes that answer a server: one call at a time each, with messages on the way, and an end at any moment.

A call is `function(send, *arguments)`, run in a process of its own.  `send(message)` sends anything picklable to the caller at once, and
raises `Cancelled` where the caller has asked for an end.  The server only ever waits: whatever a computation does, the server stays alive.
"""

import asyncio
import math
import os
import threading
import time
import traceback
from collections import Counter
from collections.abc import AsyncIterator, Callable, Hashable
from contextlib import asynccontextmanager, suppress
from enum import Enum
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from typing import Any

from drivewright.errors import DrivewrightError
from drivewright.execution.processes import exit_with_parent, worker_environment

MEMORY_SHARE = 0.4  # of the machine's memory that one process may take
LEAST_MEMORY = 800_000_000  # bytes that it may take on the smallest machine: Python and our packages need a third of that
PATIENCE = 60.0  # seconds that an abandoned call may take to notice
PATIENCE_NOW = 0.3  # seconds that a call may take to clear up
CLOSED = "the computing processes have been closed"
PATIENCE_DEATH = 5.0  # seconds that the system may take to end a process


class Cancellation(Enum):
    """How urgent the end of a call is: the argument of a task's `cancel`."""

    NOW = "the process is ended where it does not stop at once"


class Cancelled(Exception):
    """The caller wants no answer any more."""


class WorkerDied(DrivewrightError):
    """The process ended in the middle of a call, or was closed before it."""


class CallTimedOut(DrivewrightError):
    """The call was silent for longer than its limit, and its process has been ended."""


class WorkerFault(Exception):
    """A fault of the program: the traceback of the process as text."""


# -- in the process ------------------------------------------------------------------------------------------------------------


def _work(pipe: Connection, alive: Connection, parent: int, niceness: int, memory: float) -> None:
    """Take calls from the pipe until it closes."""
    exit_with_parent(parent, alive)
    _limit_memory(memory)
    with suppress(AttributeError, OSError):
        os.nice(niceness)
    with suppress(EOFError, OSError):
        while True:
            call = pipe.recv()
            if call is not None:  # a cancellation that came after the end
                _send_answer(pipe, _answer(pipe, *call))


def _limit_memory(part: float) -> None:
    """A design that wants more than its share of the memory fails, and takes neither the machine nor the other tabs along."""
    with suppress(ImportError, ValueError, OSError):
        import resource

        share = max(int(part * os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")), LEAST_MEMORY)
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


def _send_answer(pipe: Connection, answer: tuple[str, Any]) -> None:
    try:
        pipe.send(answer)
    except OSError:
        raise
    except Exception as error:  # it cannot be pickled: too deep, too large, or no data
        pipe.send(("error", WorkerFault(f"{type(error).__name__}: {error}")))


# -- in the server -------------------------------------------------------------------------------------------------------------


class Worker:
    """One process; it is made again when it has died, until it is closed.

    With a `niceness` it leaves the processor to those who have less of it; `memory` is the part of the machine's that it may take.
    """

    def __init__(self, niceness: int = 0, memory: float = MEMORY_SHARE) -> None:
        self._settings, self._closed = (niceness, memory), False
        self._start()

    def _start(self) -> None:
        self._killed = False  # it may take a moment to die
        context = get_context("spawn")
        self._pipe, theirs = context.Pipe()
        alive, self._hold = context.Pipe(duplex=False)
        self.process: BaseProcess = context.Process(target=_work, args=(theirs, alive, os.getpid(), *self._settings))
        with worker_environment():
            self.process.start()
        theirs.close()
        alive.close()

    async def call(
        self,
        function: Callable[..., Any],
        *arguments: Any,
        on_message: Callable[[Any], object] = lambda message: None,
        limit: float = math.inf,
    ) -> Any:
        """The function's answer; its error, WorkerDied, CallTimedOut or WorkerFault.  `on_message(message)` is called for each it sends.

        Where the caller is cancelled, the process is asked to stop and given PATIENCE: it may be compiling what the next call needs too.
        Where the caller is cancelled with `Cancellation.NOW`, the process is ended if it does not stop at once.  So it is where the call
        neither ends nor sends a message for `limit` [s].
        """
        if self._closed:
            raise WorkerDied(CLOSED)
        if self._killed or not self.process.is_alive():
            self._start()
        call = _Call(self._pipe, self.process, on_message)
        threading.Thread(target=call.run, args=(function, arguments), daemon=True).start()
        try:
            while not call.ended.done():
                left = call.heard + limit - time.monotonic()
                if left <= 0:
                    await self._cancel(call, PATIENCE_NOW)
                    raise CallTimedOut(f"this took more than {limit:g} s and was ended")
                await asyncio.wait([call.ended], timeout=left if limit < math.inf else None)
        except asyncio.CancelledError as cancelled:
            await self._cancel(call, PATIENCE_NOW if Cancellation.NOW in cancelled.args else PATIENCE)
            raise
        return call.ended.result()

    async def _cancel(self, call: "_Call", patience: float) -> None:
        """Come to an end with the call under way, so that the worker is free for the next."""
        try:
            if call.taken.is_set():  # else the pipe may be full, and this would wait
                with suppress(OSError):
                    self._pipe.send(None)
                await asyncio.wait([call.ended], timeout=patience)
        finally:
            call.ended.add_done_callback(lambda future: future.exception())  # its result is no longer needed
            if not call.ended.done():
                self.kill()

    def kill(self) -> None:
        """End the process now, with whatever processes it started itself; the call under way raises WorkerDied."""
        self._killed = True
        self._hold.close()
        self.process.kill()

    def close(self) -> None:
        """Let the process go, for good: whoever still calls gets WorkerDied, and the program's end waits for nobody."""
        self._closed = True
        self.kill()
        self.process.join(1)


class _Call:
    """One call of a process: a thread hands it over, and hands on what comes back.  The loop of the server never waits for a pipe."""

    def __init__(self, pipe: Any, process: BaseProcess, on_message: Callable[[Any], object]) -> None:
        self._pipe, self._process, self._on_message = pipe, process, on_message
        self._loop = asyncio.get_running_loop()
        self.ended: asyncio.Future[Any] = self._loop.create_future()
        self.taken = threading.Event()
        self.heard = time.monotonic()

    def run(self, function: Callable[..., Any], arguments: tuple[Any, ...]) -> None:
        """In the thread: hand the call over, then listen until it has ended."""
        try:
            self._pipe.send((function, arguments))
        except OSError:
            pass  # it has died, which listening will tell
        except Exception as error:  # arguments that cannot be sent
            return self._settle(self.ended.set_exception, WorkerFault(f"{type(error).__name__}: {error}"))
        self.taken.set()
        return self._listen()

    def _listen(self) -> None:
        while True:
            try:
                if self._pipe not in wait([self._pipe, self._process.sentinel]) and not self._pipe.poll():
                    raise EOFError
                kind, content = self._pipe.recv()
            except (EOFError, OSError):
                self._process.join(PATIENCE_DEATH)
                return self._settle(self.ended.set_exception, WorkerDied(_death(self._process.exitcode)))
            except Exception as error:  # an answer that cannot be read
                return self._settle(self.ended.set_exception, WorkerFault(f"{type(error).__name__}: {error}"))
            if kind != "message":
                return self._settle(self.ended.set_result if kind == "answer" else self.ended.set_exception, content)
            self._hand(self._hear, content)

    def _hear(self, message: object) -> None:
        self.heard = time.monotonic()
        self._on_message(message)

    def _settle(self, setter: Callable[[Any], object], value: Any) -> None:
        self._hand(lambda: None if self.ended.done() else setter(value))

    def _hand(self, function: Callable[..., object], *arguments: Any) -> None:
        with suppress(RuntimeError):  # the loop has gone: the server stops
            self._loop.call_soon_threadsafe(function, *arguments)


def _death(code: int | None) -> str:
    """Why a call has no answer, from the exit code of its process."""
    how = f"was ended by signal {-code}" if code and code < 0 else f"ended with code {code}"
    return f"the computing process {how}; a new one takes over. If it happens again with this design, run it on the command line to see why"


class WorkerPool:
    """As many workers as there may be at once, made when they are wanted.

    One owner has `share` of them at most.  Of those who wait, the next is who has the fewest, and of these who has waited longest.
    """

    def __init__(self, limit: int, share: int | None = None, niceness: int = 0, memory: float = MEMORY_SHARE) -> None:
        self._limit, self._share, self._settings = limit, share or limit, (niceness, memory)
        self._free: list[Worker] = []
        self._all: list[Worker] = []
        self._held: Counter[Hashable] = Counter()
        self._waiting: list[tuple[Hashable, asyncio.Future[None]]] = []
        self._closed = False

    @property
    def crowded(self) -> bool:
        """Whether somebody waits for a worker."""
        return bool(self._waiting)

    @asynccontextmanager
    async def worker(self, owner: Hashable = None) -> AsyncIterator[Worker]:
        """A worker to oneself, as soon as it is the owner's turn."""
        await self._turn(owner)
        try:
            worker = self._free.pop() if self._free else self._new()
            try:
                yield worker
            finally:
                self._free.append(worker)
        finally:
            self._give_back(owner)

    async def _turn(self, owner: Hashable) -> None:
        turn = asyncio.get_running_loop().create_future()
        self._waiting.append((owner, turn))
        self._grant()
        try:
            await turn
        except asyncio.CancelledError:
            if turn.cancelled():
                self._waiting = [(each, other) for each, other in self._waiting if other is not turn]
            else:  # it has been granted at the same moment
                self._give_back(owner)
            raise

    def _grant(self) -> None:
        """Assign waiting calls to free workers."""
        while self._held.total() < self._limit:
            allowed = [
                (self._held[owner], number)
                for number, (owner, turn) in enumerate(self._waiting)
                if self._held[owner] < self._share and not turn.done()  # cancelled, and not taken out yet
            ]
            if not allowed:
                return
            owner, turn = self._waiting.pop(min(allowed)[1])
            self._held[owner] += 1
            turn.set_result(None)

    def _give_back(self, owner: Hashable) -> None:
        self._held[owner] -= 1
        if not self._held[owner]:
            del self._held[owner]
        self._grant()

    def _new(self) -> Worker:
        if self._closed:
            raise WorkerDied(CLOSED)
        self._all.append(Worker(*self._settings))
        return self._all[-1]

    def close(self) -> None:
        """Let all processes go; there will be no others."""
        self._closed = True
        for worker in self._all:
            worker.kill()
        for worker in self._all:
            worker.close()
