"""A second process that helps this one, on the core that is free: with calls that do not depend on each other, as of figures, and with
kernels that are compiled while this one compiles others."""

from collections import deque
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager
from functools import partial
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

from drivewright import registry
from drivewright._jit.compilation import BEGUN, meanwhile, watched_by
from drivewright._jit.disk_cache import is_first_run, is_kept
from drivewright.cases import worker_count
from drivewright.result import SpecLike

if TYPE_CHECKING:
    from concurrent.futures import Future

    from drivewright.execution.executors import ProcessExecutor

ItemT = TypeVar("ItemT")
ResultT = TypeVar("ResultT")


class Map(Protocol):
    """Calls a function with each of some items, and gives the results in their order: as `map` does."""

    def __call__(self, function: Callable[[ItemT], ResultT], items: Iterable[ItemT], /) -> Iterable[ResultT]:
        """The results."""
        ...


@contextmanager
def helping_hand(prepare: Callable[[], object], wanted: bool = True) -> Iterator[Map]:
    """A `Map` that shares its calls with a process of its own, where one is wanted and there is a core for it.

    The process starts at once and calls `prepare`, so that it is at hand when the calls come.  This process takes calls from the front, the
    other one from the back, and nobody waits for one that has not come to work or cannot do it.
    """
    if not wanted or worker_count(None) < 2:
        yield map
        return
    executor = _process(prepare)
    if executor is None:
        yield map
        return
    try:
        yield lambda function, items: _shared(executor, function, list(items))
    finally:
        executor.close()


def _process(prepare: Callable[[], object]) -> "ProcessExecutor | None":
    """A process that calls `prepare`; None where the system does not let it start, for then this process does all by itself."""
    from drivewright.execution.executors import ProcessExecutor

    try:
        return ProcessExecutor(prepare)
    except OSError:
        return None


@contextmanager
def compiling_ahead(spec: SpecLike) -> Iterator[None]:
    """Within the block a second process compiles what a run of the spec comes to last: from the beginning where nothing has been compiled
    yet, else as soon as something is.

    This process finds it on the disk, or waits for it there, and meanwhile compiles what would come after it, from the end; where there is
    no core for a second process it compiles all by itself.
    """
    if worker_count(None) < 2 or registry.mechanism(spec.mechanism).compile_ahead is None or not is_kept():
        yield
        return
    with ExitStack() as at_the_end:
        begun: list[ProcessExecutor | None] = []
        from_the_end = _from_the_end(spec)

        def compile_one_more() -> bool:
            compile_kernel = next(from_the_end, None)
            if compile_kernel:
                compile_kernel()
            return compile_kernel is not None

        def begin(_: str = "", what: str = BEGUN) -> None:
            if what == BEGUN and not begun:
                begun.append(process := _process(partial(_compile_ahead, spec)))
                if process:
                    at_the_end.callback(process.close)

        at_the_end.enter_context(watched_by(begin))
        at_the_end.enter_context(meanwhile(compile_one_more))
        if is_first_run():
            begin()
        yield


def _compile_ahead(spec):
    for compile_kernel in _last_kernels(spec):
        compile_kernel()


def _from_the_end(spec):
    yield from reversed(_last_kernels(spec))


def _last_kernels(spec):
    compile_ahead = registry.mechanism(spec.mechanism).compile_ahead
    assert compile_ahead is not None
    return compile_ahead(spec)


def _shared(executor: "ProcessExecutor", function: Callable[[Any], Any], items: list[Any]) -> list[Any]:
    results: dict[int, Any] = {}
    left, given = deque(range(len(items))), deque["tuple[int, Future[Any]]"]()
    while left:
        _collect(given, results)
        if executor.at_work and len(given) < executor.capacity and len(left) > 1:
            index = left.pop()
            given.append((index, executor.submit(function, items[index])))
        else:
            index = left.popleft()
            results[index] = function(items[index])
    for index, future in given:
        results[index] = function(items[index]) if future.exception() else future.result()
    return [results[index] for index in range(len(items))]


def _collect(given, results):
    """Take what is finished; what failed over there is left for here."""
    while given and given[0][1].done() and not given[0][1].exception():
        index, future = given.popleft()
        results[index] = future.result()
