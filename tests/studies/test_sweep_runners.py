"""Serial, processes and Dask: the same function, the same bytes, and what happens when a worker dies."""

import os
import signal
from pathlib import Path

import numpy as np
import pytest
from places import EXAMPLES

import drivewright as dw
from drivewright.errors import InputError
from drivewright.execution import batches, dask_cluster, evaluation, executors
from drivewright.execution.batches import Batch, BatchScheduler, missing_ranges, run_batches
from drivewright.studies.sweeps import sweep

pytestmark = pytest.mark.interface


def chain(analysis="closure"):
    return dw.load(EXAMPLES / "hyvo_chain.toml", (f'study.analyses=["{analysis}"]',))


LEVELS = {"joint.rolling_radius": ["1.0 mm", "1.2 mm", "-1 mm", "1.6 mm"], "plate.apothem": dw.linspace("2.5 mm", "2.7 mm", 5)}


@pytest.fixture(scope="module")
def serial():
    return sweep(chain(), LEVELS, on="serial")


def test_serial_rows_are_the_results_of_runs(serial):
    """Another way to the same numbers: each case as a spec of its own."""
    for case in (0, 7, 19):
        changes = [f'{key}="{serial[key][case].item()!r} m"' for key in LEVELS]
        result = dw.run(dw.load(EXAMPLES / "hyvo_chain.toml", changes), "closure")
        assert {name: serial[name][case] for name in result.values} == {name: value.value for name, value in result.values.items()}
        checks = {check.name: check.margin for check in result.checks}
        assert {name: serial[f"check.{name}"][case] for name in checks} == pytest.approx(checks, abs=1e-15)


def test_a_case_that_cannot_be_is_a_row_with_the_reason(serial):
    bad = np.flatnonzero(serial["joint.rolling_radius"] < 0)
    assert list(bad) == [10, 11, 12, 13, 14]
    assert set(serial["status"][bad]) == {"failed"} and "must be greater than 0 mm, got -1 mm" in serial["message"][10]
    assert all(np.isnan(serial[name][bad]).all() for name in serial.value_names)


@pytest.mark.parametrize("workers", [1, 2])
def test_processes_give_the_same_bytes(serial, workers):
    assert sweep(chain(), LEVELS, workers=workers).table.equals(serial.table)


@pytest.mark.parametrize("target", [1e-9, 0.02, 100.0])
def test_the_size_of_a_batch_changes_nothing(serial, monkeypatch, target):
    monkeypatch.setattr(batches, "TARGET", target)
    monkeypatch.setattr(batches, "LEAST", target / 3)
    assert sweep(chain(), LEVELS, on="serial").table.equals(serial.table)


@pytest.mark.needs_cluster
def test_dask_gives_the_same_bytes(serial):
    assert sweep(chain(), LEVELS, on="local:2").table.equals(serial.table)


@pytest.fixture(scope="module")
def scheduler():
    """A Dask scheduler with two workers at an address, as on a cluster."""
    distributed = pytest.importorskip("distributed")
    cluster = distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=":0")
    yield cluster
    cluster.close()


@pytest.mark.needs_cluster
def test_a_scheduler_by_its_address_gives_the_same_bytes_and_lives_on(serial, scheduler):
    for _ in range(2):
        assert sweep(chain(), LEVELS, on=scheduler.scheduler_address).table.equals(serial.table)


@pytest.mark.slow
@pytest.mark.needs_cluster
def test_a_scheduler_that_goes_away_is_told_and_what_was_done_is_kept(tmp_path):
    import distributed

    cluster = distributed.LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=":0")

    def away(done, total, what):
        if done >= 3:
            cluster.close()

    levels = {"joint.rolling_radius": dw.linspace("1.0 mm", "1.6 mm", 4000)}
    with pytest.raises(InputError, match="scheduler has stopped; every case that was finished before is kept"):
        sweep(chain(), levels, out=tmp_path / "S", on=cluster.scheduler_address, progress=away)
    assert 3 <= len(dw.open_study(tmp_path / "S")) < 4000


@pytest.mark.needs_cluster
def test_nobody_at_an_address_is_told(monkeypatch):
    monkeypatch.setattr(dask_cluster, "ANSWER_TIMEOUT", "1s")
    with pytest.raises(InputError, match="no Dask scheduler answers there"):
        sweep(chain(), LEVELS, on="tcp://127.0.0.1:9")


@pytest.mark.parametrize(
    ("on", "words"), [("local:0", "number of workers from 1 up"), ("local:x", "number of workers"), ("here", "is not a place to compute")]
)
def test_a_place_that_is_none_is_refused(on, words):
    with pytest.raises(InputError, match=words):
        executors.make_executors(on=on)


def test_two_answers_to_who_computes_are_refused():
    with pytest.raises(InputError, match="give one of them"):
        executors.make_executors(2, "serial")


# -- a worker that dies --------------------------------------------------------------------------------------------------------


def deadly(first, stop):
    """Cases of which number 5 kills its process; module-level, so that a process can find it."""
    if first <= 5 < stop:
        os.kill(os.getpid(), signal.SIGKILL)
    return list(range(first, stop)), 0.01


def once_deadly(first, stop, mark):
    """Case 5 kills its process the first time."""
    if first <= 5 < stop and not os.path.exists(mark):
        Path(mark).touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return list(range(first, stop)), 0.01


def computed(function, total, *more, number=2):
    places = [executors.ProcessExecutor() for _ in range(number)]
    try:
        return list(run_batches(places, function, lambda batch: (batch.first, batch.stop, *more), BatchScheduler([], total, len(places))))
    finally:
        for place in places:
            place.close()


@pytest.fixture
def _findable(monkeypatch):
    """Lets the processes import this file."""
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(Path(__file__).parent), os.environ.get("PYTHONPATH", "")]))


@pytest.mark.usefixtures("_findable")
def test_a_batch_that_kills_its_worker_three_times_fails_with_the_reason_and_the_others_do_not(monkeypatch):
    monkeypatch.setattr(batches, "GROWTH", 1)
    done = computed(deadly, 12)
    failed = [each for each in done if each.reason]
    assert [each.batch.first for each in failed] == [5] and "died 3 times" in failed[0].reason
    assert sorted(case for each in done if not each.reason for case in each.table) == [n for n in range(12) if n != 5]


@pytest.mark.usefixtures("_findable")
def test_a_batch_whose_worker_died_by_accident_is_taken_again(tmp_path):
    done = computed(once_deadly, 12, str(tmp_path / "mark"))
    assert not any(each.reason for each in done)
    assert sorted(case for each in done for case in each.table) == list(range(12))


def test_the_cases_of_a_batch_without_an_answer_are_rows():
    task = evaluation.case_task(chain(), ("joint.rolling_radius",))
    table = evaluation.failed_rows(task, 7, {"joint.rolling_radius": np.array([1e-3, 2e-3])}, "the process died 3 times")
    assert table["case"].to_pylist() == [7, 8] and table["status"].to_pylist() == ["failed"] * 2
    assert table["message"].to_pylist() == ["the process died 3 times"] * 2 and table["joint.rolling_radius"].to_pylist() == [1e-3, 2e-3]


# -- handing out ---------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("ranges", "total", "left"),
    [([], 5, [(0, 5)]), ([(0, 5)], 5, []), ([(1, 2), (4, 1)], 7, [(0, 1), (3, 4), (5, 7)]), ([(0, 3)], 3, []), ([], 0, [])],
)
def test_gaps_are_what_the_ranges_leave(ranges, total, left):
    assert missing_ranges(ranges, total) == left


def test_batches_grow_to_the_time_they_should_take_and_cover_every_case_once():
    scheduler, sizes, seen = BatchScheduler([(10, 5)], 100_000, 2), [], []
    while scheduler:
        batch = scheduler.next_batch()
        scheduler.record_timing(batch, 1e-3 * (batch.stop - batch.first))
        sizes.append(batch.stop - batch.first)
        seen += range(batch.first, batch.stop)
    assert seen == [*range(10), *range(15, 100_000)]
    assert max(sizes) == 1500 and sizes[0] == 1 and all(later <= 8 * before for before, later in zip(sizes, sizes[1:], strict=False))


def test_expensive_cases_go_one_by_one():
    scheduler = BatchScheduler([], 10, 2)
    scheduler.record_timing(scheduler.next_batch(), 60.0)
    assert scheduler.next_batch() == Batch(1, 2) and scheduler.expected == pytest.approx(9 * 60)
