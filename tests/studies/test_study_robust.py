"""What must not happen to a study: rows of another design, files of somebody else lost, a worker's end taken for a case's fault."""

import os
import shutil
import signal
import sqlite3
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from places import EXAMPLES

import drivewright as dw
from drivewright import registry
from drivewright.errors import DoesNotAssemble, InputError, SpecError
from drivewright.execution import batches, dask_cluster, evaluation, executors
from drivewright.execution.batches import BatchScheduler, run_batches
from drivewright.execution.evaluation import BatchValues, CaseResult
from drivewright.execution.outputs import Output
from drivewright.studies.sweeps import sweep

pytestmark = pytest.mark.property

RADII = {"joint.rolling_radius": dw.linspace("1.0 mm", "1.6 mm", 9)}


def chain(*changes):
    return dw.load(EXAMPLES / "hyvo_chain.toml", ('study.analyses=["meshing"]', *changes))


# -- rows ----------------------------------------------------------------------------------------------------------------------


def test_several_threads_in_one_process_do_not_mix_their_designs():
    """The tables of a task are shared by all calls in a process; a data file in the spec lets threads change places."""
    task = evaluation.case_task(dw.load(EXAMPLES / "oscillating_cam.toml"), ("follower.roller_radius",))._replace(analyses=("profile",))
    radii = np.linspace(5e-3, 9e-3, 24)

    def one(n):
        return evaluation.evaluate(task, n, {"follower.roller_radius": radii[n : n + 1]})[0]

    alone = [one(n) for n in range(len(radii))]
    with ThreadPoolExecutor(4) as pool:
        assert all(a.equals(b) for a, b in zip(alone, pool.map(one, range(len(radii))), strict=True))


def test_the_tables_of_a_task_are_never_changed():
    task = evaluation.case_task(chain(), ("joint.rolling_radius",))
    before = repr(task.tables)
    evaluation.evaluate(task, 0, {"joint.rolling_radius": np.array([1.3e-3])})
    assert repr(task.tables) == before


@pytest.fixture
def offered(monkeypatch):
    """Puts another `batch` into the chain: offered(function of (evaluate, designs) -> {name: (n,)})."""
    mechanism = registry.mechanism("silent-chain")

    def put(change):
        def batch(spec, keys, names):
            real = mechanism.batch(spec, keys, names)
            return real and (lambda designs: change(real, designs))

        import dataclasses

        changed = dataclasses.replace(mechanism, batch=batch)
        monkeypatch.setattr(registry, "mechanism", lambda kind: changed)
        evaluation._prepared_from.cache_clear()

    yield put
    evaluation._prepared_from.cache_clear()


def stumbling(error):
    """A batch that raises an error wherever a design is among its designs."""

    def batch(real, designs):
        if np.any(np.abs(designs - 1.15e-3) < 1e-9):
            raise error
        return real(designs)

    return batch


def test_a_batch_that_does_not_cover_a_design_costs_nobody_a_row(offered):
    plain = sweep(chain(), RADII, on="serial")
    offered(stumbling(DoesNotAssemble("this one is for a run of its own")))
    assert sweep(chain(), RADII, on="serial").table.equals(plain.table)


def test_a_fault_of_a_batch_shows_in_the_row_of_its_design_and_costs_no_other(offered):
    plain = sweep(chain(), RADII, on="serial")
    offered(stumbling(ZeroDivisionError("float division by zero")))
    study = sweep(chain(), RADII, on="serial")
    failed = np.flatnonzero(study["status"] != "complete").tolist()
    assert [study["joint.rolling_radius"][n] for n in failed] == [pytest.approx(1.15e-3)]
    assert study["message"][failed[0]] == "a fault of the program, please report it: ZeroDivisionError: float division by zero"
    others = [n for n in range(len(study)) if n not in failed]
    assert study.table.take(others).equals(plain.table.take(others))


def test_a_batch_with_a_fault_in_the_cases_compared_is_not_taken_and_says_so(offered):
    plain = sweep(chain(), RADII, on="serial")

    def broken(real, designs):
        raise KeyError("no such table")

    offered(broken)
    study = sweep(chain(), RADII, on="serial")
    assert study.counts == plain.counts
    assert study.remarks == ("the compiled route was not taken: a fault of the program, please report it: KeyError: 'no such table'",)


def test_a_batch_that_knows_a_design_which_the_spec_refuses_is_not_taken(offered):
    levels = {"joint.rolling_radius": ["-1 mm", "1.1 mm", "1.2 mm", "1.3 mm"]}
    offered(lambda real, designs: {name: np.where(np.isfinite(column), column, 7.0) for name, column in real(designs).items()})
    study = sweep(chain(), levels, on="serial")
    assert study["status"].tolist() == ["failed"] + 3 * ["complete"]


def test_the_difference_of_two_routes():
    def difference(numbers, **columns):
        runs = [
            CaseResult({"a": Output(number, "m", "")} if number is not None else {}, "complete" if number is not None else "failed")
            for number in numbers
        ]
        return evaluation._difference(runs, BatchValues({name: np.array(column) for name, column in columns.items()}, {}))

    nan = np.nan
    assert difference([1.0, 2.0], a=[1.0, 2.0]) == 0
    assert difference([1.0, 2.0], a=[1.0, 2.2]) == pytest.approx(0.1)
    assert difference([-4.0], a=[-3.0]) == 0.25
    assert difference([1.0, None], a=[1.0, 5.0]) == 1
    assert difference([1.0, 2.0], a=[1.0, nan], b=[nan, 3.0]) == 1
    assert difference([1.0, 2.0], a=[1.0, nan]) == 0  # not covered: it is run alone
    assert difference([None, None], a=[nan, nan]) == 0


def test_a_value_that_no_case_can_have_is_refused_before_the_first(tmp_path):
    with pytest.raises(SpecError, match=r"study.values: no value of the first case is called 'pin_ofset' \(did you mean 'pin_offset'\?\)"):
        sweep(chain('study.values=["pin_ofset"]'), RADII, out=tmp_path / "S", on="serial")


def test_what_is_wrong_with_the_place_is_no_row(monkeypatch):
    monkeypatch.setattr(evaluation.runner, "run_analyses", lambda *_: (_ for _ in ()).throw(MemoryError()))
    task = evaluation.case_task(chain(), ("joint.rolling_radius",))
    with pytest.raises(MemoryError):
        evaluation.evaluate(task, 0, {"joint.rolling_radius": np.array([1.0e-3])})


# -- the folder ----------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["parts", "data"])
def test_a_folder_of_somebody_else_is_left_alone(tmp_path, name):
    (tmp_path / name).mkdir()
    (tmp_path / name / "housing.step").write_text("a day's work")
    with pytest.raises(InputError, match="is not empty and holds no study"):
        sweep(chain(), RADII, out=tmp_path, on="serial")
    assert (tmp_path / name / "housing.step").read_text() == "a day's work" and len(list(tmp_path.iterdir())) == 1


def test_what_somebody_puts_among_the_parts_stays_and_parts_that_never_happened_go(tmp_path):
    study = sweep(chain(), RADII, out=tmp_path, on="serial")
    (tmp_path / "parts" / ".notes").mkdir()
    (tmp_path / "parts" / "readme.txt").write_text("mine")
    (tmp_path / "parts" / "000000000007-000000000008.parquet").write_bytes(b"half")
    again = sweep(chain(), RADII, out=tmp_path, on="serial")
    assert again.table.equals(study.table)
    left = {path.name for path in (tmp_path / "parts").iterdir()}
    assert {".notes", "readme.txt"} <= left and "000000000007-000000000008.parquet" not in left


def test_a_damaged_part_is_told_and_computed_again(tmp_path):
    study = sweep(chain(), RADII, out=tmp_path, on="serial")
    part = sorted((tmp_path / "parts").glob("*.parquet"))[-1]
    part.write_bytes(part.read_bytes()[:40])
    with pytest.raises(InputError, match="a part cannot be read .* the sweep's command computes its cases again"):
        dw.open_study(tmp_path)
    assert sweep(chain(), RADII, out=tmp_path, on="serial").table.equals(study.table)


def test_a_lost_spec_is_written_again_and_a_new_title_is_kept(tmp_path):
    sweep(chain(), RADII, out=tmp_path, on="serial")
    (tmp_path / "study.toml").unlink()
    sweep(chain('title="Other"'), RADII, out=tmp_path, on="serial")
    assert dw.open_study(tmp_path).spec.title == "Other"
    sweep(chain('title="Third"'), RADII, out=tmp_path, on="serial")
    assert dw.open_study(tmp_path).spec.title == "Third"


def test_a_search_is_no_study_and_its_table_changes_nothing(tmp_path):
    search = 'optimise={unknowns=[{key="pitch",lower="9 mm",upper="10 mm"}],objectives=[{value="pin_offset"}]}'
    sweep(chain(), RADII, out=tmp_path, on="serial")
    assert len(sweep(chain(search), RADII, out=tmp_path, on="serial")) == 9


def test_a_journal_left_by_a_kill_is_rolled_back_by_a_reader(tmp_path):
    """A commit is cut off: the copy of ledger and journal taken in the middle of it is what a kill leaves."""
    sweep(chain(), RADII, out=tmp_path / "S", on="serial")
    ledger = sqlite3.connect(tmp_path / "S" / "ledger.sqlite", isolation_level=None)
    ledger.execute("pragma cache_size = 1")
    ledger.execute("begin")
    ledger.executemany("insert into remarks values (?)", [(f"{n}" * 500,) for n in range(400)])
    shutil.copytree(tmp_path / "S", tmp_path / "T")
    ledger.execute("rollback")
    ledger.close()
    assert (tmp_path / "T" / "ledger.sqlite-journal").stat().st_size > 0
    assert len(dw.open_study(tmp_path / "T")) == 9 and not dw.open_study(tmp_path / "T").remarks


def test_the_difference_told_is_one(tmp_path):
    spec = dw.load(
        EXAMPLES / "hyvo_chain.toml", ('study={analyses=["meshing"],vary=[{key="joint.rolling_radius",values=["1.0 mm","1.2 mm"]}]}',)
    )
    same = dw.load(
        EXAMPLES / "hyvo_chain.toml",
        ('study={analyses=["meshing"],vary=[{key="joint.rolling_radius",values=["0.1 cm","1.2 mm"]}]}', 'title="x"'),
    )
    sweep(spec, out=tmp_path, on="serial")
    assert sweep(same, out=tmp_path, on="serial").complete
    with pytest.raises(InputError, match=r"holds another study; pitch: 9.525 mm there, 9.6 mm here\. Give") as told:
        sweep(same.replace(pitch="9.6 mm"), out=tmp_path, on="serial")
    assert "title" not in str(told.value) and "rolling_radius" not in str(told.value)


# -- who computes --------------------------------------------------------------------------------------------------------------


def test_a_worker_that_dies_while_nobody_looks_costs_nothing():
    """Between two calls its death shows only when the next one is given."""
    levels = {"joint.rolling_radius": dw.linspace("1.0 mm", "1.6 mm", 40)}
    spec = dw.load(EXAMPLES / "hyvo_chain.toml", ('study.analyses=["closure"]', 'closure.strands="straight"'))
    killed = []

    def kill(done, total, what):
        from multiprocessing import active_children

        if done >= 5 and not killed:
            killed.extend(child.pid for child in active_children())
            for pid in killed:
                os.kill(pid, signal.SIGKILL)

    study = sweep(spec, levels, workers=1, progress=kill)
    assert killed and study.counts == {"complete": 40}


def test_a_worker_that_cannot_start_is_no_fault_of_the_cases(monkeypatch):
    monkeypatch.setattr(executors, "_load_evaluation", os.abort)
    with pytest.raises(InputError, match="a worker process does not start"):
        sweep(chain(), RADII, workers=1)


class DeadlyExecutor:
    """An executor whose calls with case 5 kill it."""

    workers, capacity = 1, 2

    def __init__(self):
        self.calls = []

    def submit(self, function, first, stop):
        from concurrent.futures import BrokenExecutor, Future

        future = Future()
        self.calls.append((first, stop))
        if first <= 5 < stop:
            future.set_exception(BrokenExecutor("dead"))
        else:
            future.set_result((list(range(first, stop)), 1e-6))
        return future

    def restart(self):
        pass

    def fault(self):
        return ""


def test_one_deadly_case_does_not_take_its_batch_with_it(monkeypatch):
    monkeypatch.setattr(batches, "LEAST", 1e9)
    place = DeadlyExecutor()
    done = list(run_batches([place], None, lambda batch: (batch.first, batch.stop), BatchScheduler([], 64, 1)))
    failed = [each.batch for each in done if each.reason]
    assert [(each.first, each.stop) for each in failed] == [(5, 6)]
    assert sorted(case for each in done if not each.reason for case in each.table) == [n for n in range(64) if n != 5]
    assert place.calls.count((1, 9)) == 3  # taken again, twice, and then by halves


def test_a_scheduler_without_workers_is_given_up_at_last(monkeypatch):
    class Client:
        status = "running"

        def get_executor(self, pure):
            return None

        def scheduler_info(self, n_workers):
            return {"workers": {}}

    place = dask_cluster.DaskExecutor("tcp://here:1", Client())
    assert place.fault() == "" and place.capacity == 2
    monkeypatch.setattr(dask_cluster, "WORKERLESS_LIMIT", -1.0)
    assert "the scheduler has had no workers for 0 s" in place.fault()
    Client.status = "closed"
    assert "the scheduler has stopped" in place.fault()


def test_nothing_is_made_where_nobody_can_compute(tmp_path):
    for settings in ({"on": "nowhere"}, {"on": "serial", "workers": 2}, {"workers": 0}):
        with pytest.raises(InputError):
            sweep(chain(), RADII, out=tmp_path / "S", **settings)
    assert not (tmp_path / "S").exists()


def test_no_more_processes_than_cases():
    places = executors.make_executors(64, limit=2)
    assert len(places) == 2
    for place in places:
        place.close()


# -- plans ---------------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("study", "words"),
    [
        (
            '{vary=[{key="pitch",lower="9 mm",upper="10 mm",steps=100000000},{key="links",values=[80,81]}]}',
            "2e\\+08 cases are more than 1e\\+08",
        ),
        ('{method="sobol-indices",samples=100000000,vary=[{key="pitch",tolerance="1 um"}]}', "cases are more than"),
        ('{vary=[{key="pitch",values=["9 mm"],sigma="1 um"}]}', r"vary.0.sigma: has no meaning beside values \(levels\)"),
        (
            '{vary=[{key="pitch",lower="9 mm",upper="10 mm",steps=3,distribution="normal"}]}',
            "vary.0.distribution: has no meaning beside lower, upper, steps",
        ),
        ('{vary=[{key="pitch",distribution="uniform",lower="9 mm",upper="10 mm",sigma="1 um"}]}', "vary.0.sigma: has no meaning"),
        ('{vary=[{key="pitch",tolerance="1 mm",lower="9 mm"}]}', "vary.0.lower: has no meaning beside tolerance"),
        ('{vary=[{key="pitch",mean="9 mm",sigma="1 um",lower="9.1 mm"}]}', "vary.0.lower: the mean is beyond it"),
        ('{vary=[{key="pitch",mean="9 mm",sigma="1 um",upper="8.9 mm"}]}', "vary.0.upper: the mean is beyond it"),
        ('{vary=[{key="pitch",lower="9 mm",upper="10 mm",steps=1}]}', "vary.0.steps: one step from lower to upper"),
    ],
)
def test_what_says_nothing_or_too_much_is_refused(study, words):
    from drivewright.studies.plan import make_plan

    with pytest.raises(SpecError, match=words):
        make_plan(dw.load(EXAMPLES / "hyvo_chain.toml", (f"study={study}",)))


def test_an_interrupt_before_the_first_case_leaves_an_empty_study():
    def stop(done, total, what):
        raise KeyboardInterrupt

    study = sweep(chain(), RADII, on="serial", progress=stop)
    assert study.interrupted and len(study) == 0 and "0 of 9 cases" in repr(study) and not study.answered


def test_the_libraries_work_with_one_thread_while_cases_are_computed():
    from threadpoolctl import threadpool_info

    seen = []
    task = evaluation.case_task(chain(), ("joint.rolling_radius",))
    working = evaluation._prepared(task)
    table = working.table
    working.table = lambda *rest: (seen.extend(lib["num_threads"] for lib in threadpool_info() if lib["user_api"] == "blas"), table(*rest))[
        1
    ]
    evaluation.evaluate(task, 0, {"joint.rolling_radius": np.array([1.2e-3])})
    del working.table
    assert seen and set(seen) == {1}
