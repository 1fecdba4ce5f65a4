"""Progress of compilation as text: which kernels are compiled, how many a kind usually needs, and about how long it still takes."""

import time
import tomllib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import NamedTuple, TypeAlias

FOUND, BEGUN, DONE = "found", "begun", "done"
Watcher: TypeAlias = Callable[[str, str], object]  # (name of a kernel, FOUND on the disk, compilation BEGUN or DONE)
USUAL = Path(__file__).parent / "usual_seconds.toml"  # {kind: {kernel: [seconds of each signature]}}, measured by scripts/usual_seconds.py

_watchers: list[Watcher] = []
_work: list[Callable[[], bool]] = []  # what there is to do while another process compiles a kernel


@contextmanager
def watched_by(watcher: Watcher) -> Iterator[None]:
    """Within the block the watcher is called for every kernel that Python calls for the first time."""
    _watchers.append(watcher)
    try:
        yield
    finally:
        _watchers.remove(watcher)


@contextmanager
def meanwhile(work: Callable[[], bool]) -> Iterator[None]:
    """Within the block `work` does something, and says whether there was something to do, while another process compiles a kernel."""
    _work.append(work)
    try:
        yield
    finally:
        _work.remove(work)


def work_meanwhile() -> bool:
    """Do a piece of what there is to do while another process compiles a kernel; whether there was something."""
    return any(work() for work in tuple(_work))


def tell(kernel: str, what: str) -> None:
    """Tell all watchers."""
    for watcher in tuple(_watchers):
        watcher(kernel, what)


@cache
def usual_seconds(kind: str) -> dict[str, list[float]]:
    """{kernel: [seconds of each signature]} that a first run of this kind of drive usually compiles; empty where nobody measured it."""
    return tomllib.loads(USUAL.read_text(encoding="utf-8")).get(kind, {})


def seconds_of_a_first_run(kind: str) -> float:
    """What a first run of this kind of drive usually compiles."""
    return sum(sum(seconds) for seconds in usual_seconds(kind).values())


class Compilation:
    """A `Watcher` that knows how far compiling is; `on_news` is called when a kernel is begun and when it is done."""

    def __init__(self, kind: str, on_news: Callable[[], object] = lambda: None) -> None:
        self.kind, self.on_news = kind, on_news
        self.to_come = [(kernel, each) for kernel, seconds in usual_seconds(kind).items() for each in seconds]
        self.expected = self.spent = 0.0  # seconds of what is done: usual ones, real ones
        self.begun: list[_Begun] = []  # a kernel, and those that are compiled while another process still compiles it
        self.done = 0

    def __call__(self, kernel: str, what: str) -> None:
        """A kernel is found on the disk, begun or done."""
        if what == DONE:
            self._end(next(each for each in reversed(self.begun) if each.kernel == kernel))
            self.on_news()
            return
        expected = next((each for each in self.to_come if each[0] == kernel), (kernel, 0.0))
        self.to_come = [each for each in self.to_come if each is not expected]
        if what == BEGUN:
            self.begun.append(_Begun(kernel, expected[1], time.monotonic()))
            self.on_news()

    def _end(self, ended):
        """Count a kernel as done; its time is not that of those which wait meanwhile."""
        taken = time.monotonic() - ended.began
        self.begun = [each._replace(others=each.others + taken) for each in self.begun if each is not ended]
        self.expected, self.spent, self.done = self.expected + ended.usual, self.spent + taken - ended.others, self.done + 1

    @property
    def seconds(self) -> float:
        """What it has taken so far."""
        return self.spent + sum(time.monotonic() - each.began - each.others for each in self.begun[:1])

    @property
    def left(self) -> float:
        """Seconds that the rest takes, at the pace so far; of the kernel at hand what it has not had yet."""
        pace = self.spent / self.expected if self.expected else 1.0
        now = max((pace * each.usual - (time.monotonic() - each.began) for each in self.begun), default=0.0)
        return max(now, 0.0) + pace * sum(seconds for _, seconds in self.to_come)

    @property
    def words(self) -> str:
        """Which kernel of how many it is, and how long it still takes where that is known; nothing while nothing is compiled."""
        if not self.begun:
            return ""
        about = f", about {max(self.left, 1.0):.0f} s left" if self.to_come or any(each.usual for each in self.begun) else ""
        kernels = self.done + len(self.begun) + len(self.to_come)
        return f"compiling kernels for '{self.kind}' ({_how_often()}) {self.done + 1}/{kernels}{about}"


class _Begun(NamedTuple):
    """A kernel that is compiled: the seconds that it usually takes, when it was begun, and the seconds for others meanwhile."""

    kernel: str
    usual: float
    began: float
    others: float = 0.0


def _how_often():
    from drivewright._jit import disk_cache  # which tells this module what it does

    return "each once, when first needed" if disk_cache.is_kept() else "in every run: the user's cache folder cannot be written to"
