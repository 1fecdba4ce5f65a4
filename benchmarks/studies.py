"""Studies: what a runner costs, what a second worker gains, a million cases; the standard library's bare pool and Dask beside ours."""

import os
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import numpy as np
from timing import best

EXAMPLES = Path(__file__).parent.parent / "examples"
CASES, BATCH, ROUNDS = 2000, 100, 2  # of about 10 ms
MANY = 3000  # of about 1 ms
CHECKED = 200  # of them run again one by one, for the bits


def work(loops):
    """So many turns of a loop that the interpreter cannot shorten."""
    x = 0.5
    for _ in range(loops):
        x = 3.9 * x * (1 - x)
    return x


def loops_for(seconds):
    """Turns that take about so long here and now."""
    return int(seconds * 200_000 / best(lambda: work(200_000), 5)[0])


def batch_of(first, stop, loops):
    """Cases of a made-up study: (answers, seconds)."""
    started = time.perf_counter()
    return [work(loops) for _ in range(first, stop)], time.perf_counter() - started


def ours(places, cases, loops):
    """Seconds of a made-up study from the end of its first batch on, per case."""
    from drivewright.execution.batches import BatchScheduler, run_batches

    scheduler, done, begun = BatchScheduler([], cases, len(places)), 0, None
    for each in run_batches(places, batch_of, lambda batch: (batch.first, batch.stop, loops), scheduler):
        done += each.batch.stop - each.batch.first
        if begun is None and done >= cases // 20:
            begun, before = time.perf_counter(), done
    return (time.perf_counter() - begun) / (done - before)


def bare(workers, cases, loops):
    """The same by the standard library's pool, batches of equal size, per case."""
    with ProcessPoolExecutor(workers, get_context("spawn")) as pool:
        list(pool.map(batch_of, range(workers), range(1, workers + 1), [1] * workers))
        started = time.perf_counter()
        list(pool.map(batch_of, *zip(*((n, n + BATCH, loops) for n in range(0, cases, BATCH)), strict=True)))
        return (time.perf_counter() - started) / cases


def workers():
    """Cases of about 10 ms by one and two workers of each kind."""
    from drivewright.execution import executors

    loops = loops_for(10e-3)
    alone = best(lambda: work(loops), 20)
    yield "a case alone, in this process", alone, f"load of the machine {os.getloadavg()[0]:.1f}"
    places = {
        "processes": lambda n: [executors.ProcessExecutor() for _ in range(n)],
        "Dask, local": lambda n: list(executors.make_executors(on=f"local:{n}")),
    }
    for name, make in places.items():
        opened, per = {count: make(count) for count in (1, 2)}, {1: [], 2: []}
        for count in (1, 2) * ROUNDS:  # in turn: a machine that changes its speed changes it for both
            per[count].append(ours(opened[count], CASES * count // 2, loops))
        for place in (*opened[1], *opened[2]):
            place.close()
        gain = np.median(per[1]) / np.median(per[2])
        yield f"{name}: one worker, per case", (min(per[1]), float(np.median(per[1]))), ""
        remark = f"{gain:.2f} times one; wanted 1.8 on two free cores"
        yield f"{name}: two workers, per case", (min(per[2]), float(np.median(per[2]))), remark
    single, double = bare(1, CASES // 2, loops), bare(2, CASES, loops)
    yield "standard library's pool: one worker, per case", (single, single), ""
    yield "standard library's pool: two workers, per case", (double, double), f"{single / double:.2f} times one"


def overhead():
    """A real study of cases of about 1 ms: what it costs beyond the bare run of each."""
    from threadpoolctl import threadpool_limits

    from drivewright import load, registry, runner, sweep
    from drivewright.execution.evaluation import case_task
    from drivewright.spec import from_document, set_key
    from drivewright.studies.variation import linspace, with_variation
    from drivewright.units import SI

    key = "joint.rolling_radius"
    spec = load(EXAMPLES / "hyvo_chain.toml", ('study.analyses=["closure"]',))
    studied = with_variation(spec, {key: linspace("1.0 mm", "1.6 mm", MANY)})
    task, mechanism = case_task(studied, (key,)), registry.mechanism(spec.mechanism)
    wanted = runner.select_analyses(mechanism.analyses, task.analyses)

    def alone():
        for radius in np.linspace(1e-3, 1.6e-3, MANY):
            set_key(task.tables, key, SI(radius))
            each = from_document(task.tables, type(spec))
            runner.run_analyses(each, mechanism.build(each), wanted)

    def kept():
        with tempfile.TemporaryDirectory() as folder:
            sweep(studied, out=Path(folder) / "S", on="serial")

    with threadpool_limits(1):  # for both
        pairs = [(best(alone, 1)[0], best(kept, 1)[0]) for _ in range(3)]
    bare, whole = (min(times) / MANY for times in zip(*pairs, strict=True))
    yield f"{MANY} closures of a chain, spec and run alone, per case", (bare, float(np.median([p[0] for p in pairs])) / MANY), ""
    yield (
        "the same as a study on disk, one worker, per case",
        (whole, float(np.median([p[1] for p in pairs])) / MANY),
        (f"{1e6 * (whole - bare):.0f} us a case more; wanted under 40"),
    )


def million():
    """A million meshing cases on disk, and some of them again one by one."""
    from drivewright import linspace, load, run, sweep

    spec = load(EXAMPLES / "hyvo_chain.toml", ('study.analyses=["meshing"]',))
    levels = {"joint.rolling_radius": linspace("1.0 mm", "1.6 mm", 1000), "pitch": linspace("9 mm", "10 mm", 1000)}
    for count in (1, 2):
        with tempfile.TemporaryDirectory() as folder:
            started = time.perf_counter()
            study = sweep(spec, levels, out=Path(folder) / "S", workers=count)
            seconds = time.perf_counter() - started
            name = f"1 000 000 meshing cases, {len(study.value_names)} values each, {count} worker{'s' * (count > 1)}"
            remark = f"wanted under 120 s on two cores; workers computed for {study.seconds:.1f} s, the rest is the disk"
            yield name, (seconds, seconds), remark
    off = 0.0
    for case in np.random.default_rng(1).choice(len(study), CHECKED, replace=False):
        changes = [f'{key}="{study[key][case].item()!r} m"' for key in levels]
        result = run(load(EXAMPLES / "hyvo_chain.toml", changes), "meshing")
        off = max(off, *(abs(study[name][case] - result[name]) / max(abs(result[name]), 1e-12) for name in study.value_names))
    yield f"{CHECKED} of them again one by one", None, f"greatest relative difference {off:.1g}"


SECTIONS = (("Studies: workers", workers), ("Studies: overhead", overhead), ("Studies: a million cases", million))
