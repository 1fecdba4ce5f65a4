"""A study on a cluster of up to a thousand workers, in simulated time: the real `BatchScheduler` decides, costs measured here pass by.

One process hands batches out, takes their tables in, writes a part of each and enters it in the ledger, all one after another, as
`run_batches` and `Folder.add` do; the scheduler of the cluster passes each batch on; workers compute.  An idle worker takes the batch
that has waited longest.
"""

import heapq
import os
import statistics
import sys
import tempfile
import time
from collections import defaultdict, deque
from collections.abc import Callable, Iterator
from concurrent.futures import Future
from contextlib import closing
from itertools import islice
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.execution.batches import TARGET, BatchScheduler, run_batches

EXAMPLES = Path(__file__).parent.parent / "examples"
LATENCY = 1e-3  # s one way between two machines: assumed
WORKERS = (1, 2, 10, 100, 1000)
LENGTHS = (1e-3, 1e-2, 1.0)  # s of a case on average
GROWING, FIXED = 300.0, 10_000.0  # s of computing: for each worker, and of a whole study
ROWS = (1, 100, 10_000)
REPEATS = 21  # of a part of each size
SAMPLES = 300  # cases timed one by one
MANY = 256  # cases from which on their sum is drawn from the normal distribution


class Costs(NamedTuple):
    """Seconds: of handing out a batch and for each batch that is out; of a part and of each row of it; of its entry in the ledger; of the
    cluster's scheduler a batch; one way of a message; until a worker is ready, of its first batch more than of others, and of each batch
    beside its cases."""

    hand_out: float = 0.0
    waiting: float = 0.0
    part: float = 0.0
    row: float = 0.0
    ledger: float = 0.0
    dispatch: float = 0.0
    latency: float = 0.0
    start: float = 0.0
    first: float = 0.0
    batch: float = 0.0


class Simulated(NamedTuple):
    """A study: wall time and the work in its cases [s], workers, batches, and how long each resource that is there once was busy [s]."""

    seconds: float
    work: float
    workers: int
    batches: int
    busy: dict[str, float]

    @property
    def efficiency(self) -> float:
        """Work over what the workers could have done."""
        return self.work / (self.seconds * self.workers)

    @property
    def bottleneck(self) -> str:
        """What the workers wait for."""
        if self.efficiency > 0.9:
            return "-"
        one = self.busy["hand out"] + self.busy["part"] + self.busy["ledger"]
        shares = {"cluster's scheduler": self.busy["dispatch"], "process that writes": one}
        name = max(shares, key=lambda each: shares[each])
        if shares[name] < 0.8 * self.seconds:
            return "start and end: too little work for so many workers"
        if name == "process that writes":
            name += ", most of it " + max(("hand out", "part", "ledger"), key=lambda each: self.busy[each])
        return f"{name}: busy {100 * shares[max(shares, key=lambda each: shares[each])] / self.seconds:.0f} %"


def simulate(total: int, workers: int, costs: Costs, draw: Callable[[int], float]) -> Simulated:
    """The `Simulated` study of `total` cases; draw(count) gives the seconds of so many of them, one after another."""
    scheduler = BatchScheduler([], total, workers)
    idle, fresh = [costs.start] * workers, workers  # when each worker is free; how many have computed nothing yet
    results: list[tuple[float, int, Any, float]] = []  # (arrival, number, batch, seconds), a heap
    clock = passed_on = work = 0.0
    batches, busy = 0, defaultdict[str, float](float)

    def spend(what: str, seconds: float) -> None:
        nonlocal clock
        clock += seconds
        busy[what] += seconds

    while results or scheduler:
        room = 2 * workers if scheduler.expected is not None else 1
        while scheduler and len(results) < room:
            batch = scheduler.next_batch()
            spend("hand out", costs.hand_out)
            busy["dispatch"] += costs.dispatch
            passed_on = max(passed_on, clock + costs.latency) + costs.dispatch
            cases = draw(batch.stop - batch.first)
            seconds = costs.batch + cases + (costs.first if fresh > 0 else 0.0)
            fresh, work, batches = fresh - 1, work + cases, batches + 1
            end = max(passed_on + costs.latency, idle[0]) + seconds
            heapq.heapreplace(idle, end)
            heapq.heappush(results, (end + costs.latency, batches, batch, seconds))
        clock = max(clock, results[0][0])
        spend("hand out", costs.waiting * len(results))
        arrived = []
        while results and results[0][0] <= clock:
            arrived.append(heapq.heappop(results))
        for _, _, batch, seconds in sorted(arrived, key=lambda each: each[1]):
            scheduler.record_timing(batch, seconds)
            spend("part", costs.part + costs.row * (batch.stop - batch.first))
            spend("ledger", costs.ledger)
    return Simulated(clock, work, workers, batches, busy)


def drawn(sample: Floats, mean: float, seed: int = 1) -> Callable[[int], float]:
    """draw(count): the sum of so many cases as in a sample, whose mean is scaled to `mean`."""
    rng, sample = np.random.default_rng(seed), sample * (mean / sample.mean())
    spread = float(sample.std())

    def draw(count: int) -> float:
        if count < MANY:
            return float(rng.choice(sample, count).sum())
        return max(mean * count + spread * np.sqrt(count) * rng.standard_normal(), 0.0)

    return draw


# -- measured here -------------------------------------------------------------------------------------------------------------


class _Immediate:
    """An executor whose calls are done as soon as it holds as many as it can: what remains is the cost of handing out."""

    workers: int

    def __init__(self, workers: int) -> None:
        self.workers, self.capacity = workers, 2 * workers
        self._open: deque[Future[Any]] = deque()

    def submit(self, function: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """Ends the oldest call when this one fills the executor."""
        self._open.append(Future())
        newest = self._open[-1]
        if len(self._open) >= self.capacity or not arguments[0]:
            self._open.popleft().set_result((None, 1e6))  # so long that batches stay single cases
        return newest

    def restart(self) -> None: ...

    def is_death(self, error: Exception) -> bool:
        return False

    def fault(self) -> str:
        return ""

    def close(self) -> None: ...


def handing_out(workers: int, batches: int = 300) -> float:
    """Seconds a batch of the real `run_batches` with two batches out for each of so many workers."""
    executor, begun = _Immediate(workers), 0.0
    out = run_batches([executor], divmod, lambda batch: (batch.first,), BatchScheduler([], 10**9, workers))
    for _ in islice(out, batches + 1):
        begun = begun or time.perf_counter()
    return (time.perf_counter() - begun) / batches


def _dispatch(batches: int = 1000) -> float:
    """Seconds of this process a call without work, where it holds both the scheduler of Dask and its client."""
    from drivewright.execution.executors import make_executors

    (place,) = make_executors(on="local:1")
    with closing(place):
        for count in (20, batches):  # the first ones for all that is loaded with them
            started = time.process_time()
            for call in [place.submit(int, number) for number in range(count)]:
                call.result()
        return (time.process_time() - started) / batches


def measure() -> tuple[Costs, Floats]:
    """(costs, seconds of single cases) of a chain's closure on this machine."""
    from drivewright import linspace, load
    from drivewright.execution.evaluation import case_task, evaluate
    from drivewright.execution.executors import ProcessExecutor
    from drivewright.studies.plan import make_plan
    from drivewright.studies.study_folder import Folder
    from drivewright.studies.sweeps import study_identity
    from drivewright.studies.variation import with_variation

    spec = load(EXAMPLES / "hyvo_chain.toml", ('study.analyses=["closure"]',))
    spec = with_variation(spec, {"joint.rolling_radius": linspace("1.0 mm", "1.6 mm", SAMPLES)})
    plan = make_plan(spec)
    task = case_task(spec, plan.keys)
    evaluate(task, 0, plan.cases(0, 1))  # compiles what workers find compiled
    began = time.perf_counter()
    with closing(ProcessExecutor()) as worker:
        worker.submit(int).result()
        start = time.perf_counter() - began
        alone = [worker.submit(evaluate, task, n, plan.cases(n, n + 1)).result()[1] for n in range(20)]
    single = np.array([evaluate(task, n, plan.cases(n, n + 1))[1] for n in range(SAMPLES)])
    table, whole = evaluate(task, 0, plan.cases(0, SAMPLES))
    batch = max(float(np.mean(single)) - whole / SAMPLES, 0.0)
    with tempfile.TemporaryDirectory() as scratch, closing(Folder(Path(scratch) / "S", spec, study_identity(spec, plan))) as folder:
        part, row, ledger = _disk(folder, table)
    few, many = handing_out(1), handing_out(1000)
    waiting = (many - few) / (2 * 999)
    return (
        Costs(few - 2 * waiting, waiting, part, row, ledger, _dispatch(), LATENCY, start, alone[0] - statistics.median(alone), batch),
        single - batch,
    )


def _disk(folder: Any, table: Any) -> tuple[float, float, float]:
    """(of a part, of a row, of the ledger) in seconds, from parts of several sizes."""
    import pyarrow as pa

    from drivewright.studies.parts import write_part

    place, first = folder.folder / "parts", 0

    def written(rows: int) -> tuple[float, float]:
        nonlocal first
        cases, times = pa.concat_tables([table] * (rows // len(table) + 1)).slice(0, rows).combine_chunks(), []
        for _ in range(REPEATS):
            began = time.perf_counter()
            part = write_part(place, first, cases, "0" * 64)
            between = time.perf_counter()
            folder._enter([part], 1.0)  # noqa: SLF001 - what `add` does, in two steps
            times.append((between - began, time.perf_counter() - between))
            first += rows
        parts, entries = zip(*times, strict=True)
        return statistics.median(parts), statistics.median(entries)

    parts, entries = zip(*map(written, ROWS), strict=True)
    row = (parts[-1] - parts[0]) / (ROWS[-1] - ROWS[0])
    return parts[0] - row * ROWS[0], row, statistics.median(entries)


# -- the page ------------------------------------------------------------------------------------------------------------------


def section(images: Path) -> Iterator[str]:
    """Lines of the page, and the figure beside it."""
    costs, sample = measure()
    studies = {
        (kind, length): [simulate(round(work(count) / length), count, costs, drawn(sample, length)) for count in WORKERS]
        for kind, work in (("growing", lambda count: GROWING * count), ("fixed", lambda count: FIXED))
        for length in LENGTHS
    }
    draw(studies, images / "cluster.svg")
    yield from text(costs, sample, studies)


def text(costs: Costs, sample: Floats, studies: dict[tuple[str, float], list[Simulated]]) -> Iterator[str]:
    """What was measured, what is assumed, what came out."""
    yield "## A study on a cluster, simulated"
    yield ""
    yield (
        "A study of up to a thousand workers of a Dask scheduler in simulated time. The program's own `BatchScheduler` decides which cases "
        "make a batch; batches take as long as cases measured here, scaled to a mean length. Three things are there once: the process that "
        "hands out batches, writes their parts and enters these in the ledger, one after another; the cluster's scheduler; the network, "
        f"of which a delay of {1e3 * LATENCY:g} ms one way is assumed, and no limit of its width. Workers begin with the study, never die, "
        "and the longest waiting batch goes to the first idle worker without delay (assumed)."
    )
    yield ""
    yield "| measured here | |"
    yield "|---|---|"
    rows = (
        (
            "handing out a batch, by `run_batches`",
            f"{1e6 * costs.hand_out:.0f} µs + {1e6 * costs.waiting:.2f} µs for each batch that is out",
        ),
        ("a part: Parquet, checksums, forced to this disk", f"{1e3 * costs.part:.2f} ms + {1e6 * costs.row:.2f} µs a case"),
        ("its entry in the ledger", f"{1e3 * costs.ledger:.2f} ms"),
        ("Dask: a call without work, time of its scheduler and its client", f"{1e3 * costs.dispatch:.2f} ms"),
        ("a worker process until it is ready, its first batch besides", f"{costs.start:.2f} s, {costs.first:.2f} s"),
        ("a batch beside its cases", f"{1e3 * costs.batch:.2f} ms"),
        ("length of a case, standard deviation over mean", f"{sample.std() / sample.mean():.2f}, of {1e3 * sample.mean():.2f} ms"),
    )
    yield from (f"| {what} | {value} |" for what, value in rows)
    yield ""
    once = costs.hand_out + costs.part + costs.ledger
    yield (
        f"A batch of few cases costs the one process {1e3 * once:.1f} ms. As batches take {TARGET:g} s where a case does not take "
        f"longer, it keeps up with about {_saturation(costs, 1e-3):.0f} workers with cases of 1 ms, {_saturation(costs, 1e-2):.0f} with "
        f"10 ms, {_saturation(costs, 1.0):.0f} with 1 s; longer batches would raise these numbers."
    )
    yield ""
    yield "![Efficiency against workers](img/cluster.svg)"
    for kind, title in (
        ("growing", f"Efficiency where each worker has {GROWING:g} s of cases"),
        ("fixed", f"Efficiency of one study of {FIXED:,.0f} s of cases"),
    ):
        yield ""
        yield f"| {title} | {' | '.join(f'{count}' for count in WORKERS)} | first bottleneck |"
        yield "|---" * (len(WORKERS) + 2) + "|"
        for length in LENGTHS:
            found = studies[kind, length]
            worst = next((each for each in found if each.bottleneck != "-"), None)
            reason = f"{worst.workers} workers: {worst.bottleneck}" if worst else "none up to here"
            yield f"| cases of {_length(length)} | {' | '.join(f'{100 * each.efficiency:.0f} %' for each in found)} | {reason} |"
    yield ""
    yield (
        "Efficiency is the time in the cases over the time of all workers, from the start of the first process to the last entry in the "
        "ledger: start, first batches, the uneven end and waiting all count."
    )


def _saturation(costs: Costs, length: float) -> float:
    """Workers with whose batches of full size the writing process just keeps up."""
    cases = max(1, int(TARGET / length))
    return (cases * length + costs.batch) / (costs.hand_out + costs.part + cases * costs.row + costs.ledger)


def _length(seconds: float) -> str:
    return f"{seconds:g} s" if seconds >= 1 else f"{1e3 * seconds:g} ms"


def draw(studies: dict[tuple[str, float], list[Simulated]], path: Path) -> None:
    """Efficiency against workers: left the study grows with them, right it does not."""
    from drivewright.view.palette import colour
    from drivewright.view.style import new_figure, styled

    with styled():
        figure = new_figure(3.0)
        axes = figure.subplots(1, 2, sharey=True)
        titles = {"growing": f"{GROWING:g} s of cases for each worker", "fixed": f"{FIXED:,.0f} s of cases in all"}
        for axis, (kind, title) in zip(axes, titles.items(), strict=True):
            for length, hue, marker, dash in zip(LENGTHS, ("blue", "orange", "green"), "osD", ("-", "--", "-."), strict=True):
                share = [100 * each.efficiency for each in studies[kind, length]]
                axis.plot(
                    WORKERS, share, dash, marker=marker, color=colour(hue), markerfacecolor="white", label=f"cases of {_length(length)}"
                )
            axis.set(xscale="log", title=title, xlabel="number of workers", ylim=(0, 105))
        axes[0].set_ylabel("efficiency [%]")
        axes[0].legend(loc="lower left", handlelength=3.5)
        figure.savefig(path, metadata={"Date": None})


if __name__ == "__main__":
    print(f"load {os.getloadavg()[0]:.1f}", *section(Path(sys.argv[1] if sys.argv[1:] else tempfile.gettempdir())), sep="\n")
