"""Worker processes that compute for the page: one call at a time each, with news on the way, and an end at any moment.

A call is `function(tell, *arguments)`, run in a process of its own.  `tell(what)` sends anything picklable to the caller at once, and
raises `Stopped` where the caller has asked for an end.  The server only ever waits: whatever a computation does, the page stays alive.
"""

import asyncio
import os
import threading
import traceback
from contextlib import asynccontextmanager, suppress
from multiprocessing import get_context
from multiprocessing.connection import wait

from drivewright.errors import DrivewrightError
from drivewright.studies.pools import as_a_worker, leave_with_parent

NOW = "now"
SHARE = 0.4  # of the machine's memory that one process may take
PATIENCE = 60.0  # seconds that a call which nobody waits for may take to notice
AT_ONCE = 0.3  # seconds that a call may take to clear up


class Stopped(Exception):
    """The caller wants no answer any more."""


class Lost(DrivewrightError):
    """The process ended in the middle of a call."""


class Failed(Exception):
    """A bug: the traceback of the process as text."""


# -- in the process ------------------------------------------------------------------------------------------------------------


def _work(pipe, alive, parent):
    """Take calls from the pipe until it closes."""
    leave_with_parent(parent, alive)
    _limit_memory()
    with suppress(EOFError, OSError):
        while True:
            call = pipe.recv()
            if call is not None:  # a stop that came after the end
                pipe.send(_answered(pipe, *call))


def _limit_memory():
    """A design that wants more than its share of the memory fails, and takes neither the machine nor the other tabs along."""
    with suppress(ImportError, ValueError, OSError):
        import resource

        share = int(SHARE * os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES"))
        resource.setrlimit(resource.RLIMIT_DATA, (share, resource.getrlimit(resource.RLIMIT_DATA)[1]))


def _answered(pipe, function, arguments):
    """("answer", value) or ("error", what was raised; a bug as Failed with its traceback)."""

    def tell(what):
        if pipe.poll():
            pipe.recv()  # None: nothing else can come during a call
            raise Stopped
        pipe.send(("news", what))

    try:
        return "answer", function(tell, *arguments)
    except (Stopped, DrivewrightError) as error:
        return "error", error
    except Exception:
        return "error", Failed(traceback.format_exc())


# -- in the server -------------------------------------------------------------------------------------------------------------


class Lane:
    """One process; it is made again when it has died."""

    def __init__(self):
        self._start()

    def _start(self):
        context = get_context("spawn")
        self._pipe, theirs = context.Pipe()
        alive, self._hold = context.Pipe(duplex=False)
        self.process = context.Process(target=_work, args=(theirs, alive, os.getpid()))
        with as_a_worker():
            self.process.start()
        theirs.close()
        alive.close()

    async def call(self, function, *arguments, heard=lambda what: None):
        """The function's answer; its error, Lost or Failed.  `heard(what)` is called for every piece of news.

        Where the caller is cancelled, the process is asked to stop and given PATIENCE: it may be compiling what the next call needs too.
        Where the caller is cancelled with the message NOW, the process is ended if it does not stop at once.
        """
        if not self.process.is_alive():
            self._start()
        loop = asyncio.get_running_loop()
        ended = loop.create_future()
        threading.Thread(target=_listen, args=(self._pipe, self.process, loop, ended, heard), daemon=True).start()
        with suppress(OSError):  # the listener tells of a process that died before it could take the call
            self._pipe.send((function, arguments))
        try:
            return await asyncio.shield(ended)
        except asyncio.CancelledError as cancelled:
            await self._stopped(ended, AT_ONCE if NOW in cancelled.args else PATIENCE)
            raise

    async def _stopped(self, ended, patience):
        """Come to an end with the call under way, so that the lane is free for the next."""
        with suppress(OSError):
            self._pipe.send(None)
        try:
            await asyncio.wait([ended], timeout=patience)
        finally:
            if not ended.done():
                self.kill()
            ended.add_done_callback(lambda future: future.exception())  # nobody asks any more

    def kill(self):
        """End the process now, with whatever processes it started itself; the call under way is Lost."""
        self._hold.close()
        self.process.kill()
        self.process.join(1)

    def close(self):
        """Let the process go."""
        self.kill()


def _listen(pipe, process, loop, future, heard):
    """Hand on what comes from the process until the call has ended."""

    def settle(setter, value):
        if not future.done():
            setter(value)

    def hand(function, *arguments):
        with suppress(RuntimeError):  # the loop has gone: the server stops
            loop.call_soon_threadsafe(function, *arguments)

    while True:
        try:
            if pipe not in wait([pipe, process.sentinel]) and not pipe.poll():
                raise EOFError
            kind, what = pipe.recv()
        except (EOFError, OSError):
            process.join(1)
            return hand(settle, future.set_exception, Lost(_epitaph(process.exitcode)))
        except Exception as error:  # an answer that cannot be read
            return hand(settle, future.set_exception, Failed(f"{type(error).__name__}: {error}"))
        if kind == "news":
            hand(heard, what)
        elif kind == "answer":
            return hand(settle, future.set_result, what)
        else:
            return hand(settle, future.set_exception, what)


def _epitaph(code):
    how = f"was ended by signal {-code}" if code and code < 0 else f"ended with code {code}"
    return f"the computing process {how}; a new one takes over. If it happens again with this design, run it on the command line to see why"


class Lanes:
    """As many lanes as there may be at once, made when they are wanted."""

    def __init__(self, most):
        self._free, self._all, self._turn = [], [], asyncio.Semaphore(most)

    @asynccontextmanager
    async def lane(self):
        """A lane to oneself, as soon as there is one."""
        async with self._turn:
            lane = self._free.pop() if self._free else self._new()
            try:
                yield lane
            finally:
                self._free.append(lane)

    def _new(self):
        self._all.append(Lane())
        return self._all[-1]

    def processes(self):
        """Ids of the processes."""
        return [lane.process.pid for lane in self._all]

    def close(self):
        """Let all processes go."""
        for lane in self._all:
            lane.close()
