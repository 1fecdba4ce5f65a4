"""A search as a study: the same bits whoever computes, each design once, and a start after any stop goes on where it was."""

import subprocess
import sys
import textwrap
import time
import tomllib

import numpy as np
import pytest
from pyarrow import parquet

import drivewright as dw
from drivewright.cli import main
from drivewright.errors import InputError
from drivewright.execution.executors import InProcessExecutor, make_executors
from drivewright.spec import from_document
from drivewright.studies.search import evaluator, history
from drivewright.studies.store import Memory, joined
from drivewright.studies.study_folder import Folder
from drivewright.studies.study_reading import is_study, read_study
from drivewright.studies.sweeps import sweep

pytestmark = pytest.mark.property

TEXT = """
mechanism = "cam"
[follower]
motion = "translating"
roller_radius = "8 mm"
prime_radius = "40 mm"
[[programme]]
angle = "90 deg"
law = "cycloidal"
rise = "20 mm"
[[programme]]
angle = "180 deg"
law = "cycloidal"
rise = "-20 mm"
[[programme]]
angle = "90 deg"
law = "dwell"
[optimise]
population = 8
generations = 3
[[optimise.unknowns]]
key = "follower.prime_radius"
lower = "1 mm"
upper = "80 mm"
[[optimise.objectives]]
value = "profile.perimeter"
[[optimise.requirements]]
value = "max_pressure_angle"
at_most = "25 deg"
"""


def cam(**changes):
    tables = tomllib.loads(TEXT)
    tables["optimise"] |= changes
    return from_document(tables)


@pytest.fixture(scope="module")
def undisturbed():
    return dw.optimise(cam(), on="serial")


@pytest.fixture
def counted(monkeypatch):
    """Numbers of the designs evaluated in this process."""
    numbers, evaluate = [], evaluator.evaluate

    def counting(task, first, columns):
        numbers.extend(range(first, first + len(next(iter(columns.values())))))
        return evaluate(task, first, columns)

    monkeypatch.setattr(evaluator, "evaluate", counting)
    return numbers


def same(one, other):
    """Bit for bit."""
    return one.table.equals(other.table) and np.array_equal(one.front, other.front) and one.best.values == other.best.values


# -- who computes --------------------------------------------------------------------------------------------------------------


def test_two_processes_give_the_bits_of_one_and_live_for_the_whole_search(undisturbed, monkeypatch):
    started = []

    def counting(*asked):
        started.append(asked)
        return make_executors(*asked)

    monkeypatch.setattr(evaluator, "make_executors", counting)
    assert same(dw.optimise(cam(), workers=2), undisturbed)
    assert started == [(2, None)]


def test_a_short_search_starts_no_process_and_a_long_one_has_help(undisturbed, monkeypatch):
    monkeypatch.setattr(evaluator, "make_executors", lambda *asked: pytest.fail("a pool for a search of a moment"))
    monkeypatch.setattr(evaluator, "WORTH_HELP", 1e9)
    assert same(dw.optimise(cam()), undisturbed)
    helped = []
    monkeypatch.setattr(evaluator, "WORTH_HELP", 0.0)
    monkeypatch.setattr(evaluator, "make_executors", lambda *asked: helped.append(asked) or (InProcessExecutor(), InProcessExecutor()))
    assert same(dw.optimise(cam()), undisturbed)
    assert helped == [(None, None)]


def test_each_design_is_evaluated_once(undisturbed, counted):
    found = dw.optimise(cam(), on="serial")
    assert counted == list(range(found.evaluations))
    designs = found.history["follower.prime_radius"]
    assert len(np.unique(designs)) == len(designs) <= 8 * 4 and set(found.history["generation"]) == {0, 1, 2, 3}


@pytest.mark.needs_optimise
def test_several_objectives_too(counted):
    spec = cam(objectives=[{"value": "min_convex_radius"}, {"value": "max_pressure_angle"}], requirements=[])
    one, other = (dw.optimise(spec, on="serial") for _ in range(2))
    assert same(one, other) and len(one.front) > 3
    angle, size = one.front_values["max_pressure_angle"], one.front_values["min_convex_radius"]
    assert np.all(np.diff(size) > 0) and np.all(np.diff(angle) < 0), "from the smallest cam to the steepest"
    sizes, angles = (one.history[name][np.isfinite(one.history[name])][:, None] for name in ("min_convex_radius", "max_pressure_angle"))
    assert not np.any((sizes < size) & (angles < angle)), "an evaluated design beats one of the front"


# -- what is kept --------------------------------------------------------------------------------------------------------------


def test_the_folder_holds_every_evaluation_with_units_and_reasons(tmp_path, undisturbed):
    found = dw.optimise(cam(), out=tmp_path / "o", on="serial")
    assert same(found, undisturbed) and found.folder == (tmp_path / "o").resolve()
    table = read_study(found.folder).rows
    assert table.equals(found.table) and table.num_rows == found.evaluations
    units = {field.name: field.metadata[b"unit"].decode() for field in table.schema}
    assert units == {
        "case": "-",
        "status": "",
        "message": "",
        "generation": "-",
        "follower.prime_radius": "m",
        "profile.perimeter": "m",
        "max_pressure_angle": "rad",
        "violation": "-",
    }
    assert all(field.metadata[b"meaning"] and field.metadata[b"label"] for field in table.schema)
    small = found.history["follower.prime_radius"] <= 8e-3
    failed = np.array(found.table["status"].to_pylist()) == "failed"
    assert small.any() and np.array_equal(small, failed), "a roller as large as the prime circle leaves no cam"
    assert all(("leaves no cam" in text) == no for text, no in zip(found.table["message"].to_pylist(), failed, strict=True))
    assert np.all(found.history["violation"][failed] >= 1000) and np.all(np.isnan(found.history["profile.perimeter"][failed]))


def test_a_finished_search_given_again_answers_from_the_store(tmp_path, undisturbed, monkeypatch):
    first = dw.optimise(cam(), out=tmp_path, on="serial")
    monkeypatch.setattr(evaluator, "evaluate", lambda *_: pytest.fail("evaluated again"))
    monkeypatch.setattr(evaluator, "make_executors", lambda *_: pytest.fail("nobody is needed"))
    again = dw.optimise(cam(), out=tmp_path, workers=2)
    assert same(again, first) and same(again, undisturbed)


@pytest.mark.parametrize("stop", [11, *(pytest.param(stop, marks=pytest.mark.slow) for stop in (1, 18))])
def test_ctrl_c_loses_nothing_finished_and_the_search_goes_on(tmp_path, undisturbed, counted, stop):
    def interrupting(done, total, what):
        if len(counted) >= stop:
            raise KeyboardInterrupt

    so_far = dw.optimise(cam(), out=tmp_path, on="serial", progress=interrupting)
    assert so_far.interrupted and so_far.evaluations == len(counted) < undisturbed.evaluations
    assert so_far.table.equals(undisturbed.table.slice(0, so_far.evaluations))
    found = dw.optimise(cam(), out=tmp_path, on="serial")
    assert same(found, undisturbed) and not found.interrupted
    assert counted == list(range(found.evaluations)), "each design once in both starts together"


def test_gaps_inside_a_generation_are_filled(tmp_path, undisturbed, counted):
    """Several processes end in any order: evaluations 0 to 9, 12 and 13 are there."""
    spec = cam()
    with_gap = Folder(tmp_path, spec, {"spec": spec.digest(), "search": "differential-evolution", "drivewright": dw.__version__})
    for first, count in ((12, 2), (0, 10)):
        with_gap.add(first, undisturbed.table.slice(first, count), 0.0)
    with_gap.close()
    assert same(dw.optimise(spec, out=tmp_path, on="serial"), undisturbed)
    assert sorted(counted) == [n for n in range(undisturbed.evaluations) if n > 9 and n not in (12, 13)]


KILLED = """
    import sys, time, tomllib
    from drivewright import optimise
    from drivewright.spec import from_document
    from drivewright.studies.search import evaluator, history

    plain = evaluator.evaluate

    def slow(*arguments):
        time.sleep(0.05)
        return plain(*arguments)

    evaluator.evaluate, history.GATHER = slow, 0.1
    optimise(from_document(tomllib.loads(sys.argv[1])), out=sys.argv[2], on="serial")
"""


def test_kill_9_costs_no_evaluation_that_was_acknowledged(tmp_path, undisturbed, counted):
    spec = cam()
    process = subprocess.Popen([sys.executable, "-c", textwrap.dedent(KILLED), spec.to_toml(), str(tmp_path / "o")])
    try:
        while not (is_study(tmp_path / "o") and len(list((tmp_path / "o" / "parts").glob("[0-9]*.parquet"))) > 2):
            assert process.poll() is None, "it ended before it could be killed"
            time.sleep(0.02)
    finally:
        process.kill()
        process.wait()
    acknowledged = read_study(tmp_path / "o").rows.num_rows
    assert 0 < acknowledged < undisturbed.evaluations
    assert same(dw.optimise(spec, out=tmp_path / "o", on="serial"), undisturbed)
    assert counted == list(range(counted[0], undisturbed.evaluations))
    assert counted[0] >= acknowledged  # parts that were whole when it died are found again, too


# -- what is refused -----------------------------------------------------------------------------------------------------------


def test_another_search_in_the_folder_is_refused_with_the_difference(tmp_path):
    dw.optimise(cam(generations=1), out=tmp_path, on="serial")
    with pytest.raises(InputError, match="optimise.seed: 1 there, 7 here"):
        dw.optimise(cam(generations=1, seed=7), out=tmp_path)


def test_a_sweep_and_a_search_do_not_share_a_folder(tmp_path):
    sweep(cam(), {"follower.prime_radius": ["30 mm", "40 mm"]}, out=tmp_path, on="serial")
    with pytest.raises(InputError, match="holds another study; search: not given there, differential-evolution here"):
        dw.optimise(cam(), out=tmp_path)


def test_the_outcome_of_an_older_version_is_left_alone(tmp_path):
    (tmp_path / "history.parquet").write_bytes(b"precious")
    with pytest.raises(InputError, match="by an older version, which cannot be continued; nothing was written"):
        dw.optimise(cam(), out=tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["history.parquet"]


def test_a_folder_whose_search_went_another_way_is_refused(tmp_path, undisturbed):
    spec = cam()
    kept = Folder(tmp_path, spec, {"spec": spec.digest(), "search": "differential-evolution", "drivewright": dw.__version__})
    moved = undisturbed.table.slice(1, 8)  # rows moved up by one
    kept.add(0, moved.set_column(0, undisturbed.table.schema.field(0), [np.arange(8)]), 0.0)
    kept.close()
    with pytest.raises(InputError, match="computes other designs than those in the folder, from evaluation 0 on"):
        dw.optimise(spec, out=tmp_path)


# -- on the command line -------------------------------------------------------------------------------------------------------


def test_the_command_writes_the_best_beside_the_ledger_and_can_be_given_again(tmp_path, capsys):
    spec, out = tmp_path / "cam.toml", tmp_path / "o"
    spec.write_text(cam().to_toml())
    written = []
    for _ in range(2):
        with pytest.raises(SystemExit) as left:
            main(["optimise", str(spec), "--out", str(out), "--on", "serial"])
        assert left.value.code == 0
        written.append(((out / "best.toml").read_text(), parquet.read_table(out / "history.parquet")))
    assert written[0][0] == written[1][0] and written[0][1].equals(written[1][1])
    assert {path.name for path in out.iterdir()} == {
        "best",
        "best.toml",
        "front.parquet",
        "history.parquet",
        "ledger.sqlite",
        "parts",
        "study.toml",
        ".lock",
    }
    assert (out / "best" / "result.json").is_file()
    front = parquet.read_table(out / "front.parquet")
    assert front.schema.field("follower.prime_radius").metadata[b"unit"] == b"m" and front.num_rows == 1
    with pytest.raises(SystemExit) as left:
        main(["optimise", str(spec), "--out", str(out), "--set", "optimise.seed=9"])
    assert left.value.code == 2 and "optimise.seed: 1 there, 9 here" in capsys.readouterr().err


def test_a_design_whose_solver_gave_up_has_no_value_for_the_search():
    """Its row keeps what there was; a force that is small because the simulation ended early must not win."""
    seen = history.usable({"force": np.array([3.0, 1.0, np.nan])}, ["complete", "partial", "failed"])
    assert seen["force"][0] == 3.0 and np.all(np.isnan(seen["force"][1:]))


def test_a_journal_writes_each_row_once_whatever_happens_in_between(undisturbed):
    class Failing(Memory):
        trouble = 1

        def add(self, first, table, seconds):
            super().add(first, table, seconds)
            if self.trouble:
                self.trouble = 0
                raise KeyboardInterrupt

    kept = Failing()
    journal = history.Journal(kept)
    for first in (6, 0, 3, 9):
        journal.add(first, undisturbed.table.slice(first, 2 if first == 6 else 3), 1.0)
    with pytest.raises(KeyboardInterrupt):
        journal.flush()
    journal.flush()
    assert kept.ranges() == [(0, 8), (9, 3)] and kept.seconds == 4.0
    assert joined(kept.tables())["case"].to_pylist() == [*range(8), *range(9, 12)]


# -- how a search is shown -----------------------------------------------------------------------------------------------------


def test_the_search_is_drawn_with_the_best_on_top(undisturbed, tmp_path, monkeypatch):
    from drivewright.studies import optimisation as module

    table, plot = undisturbed.search()
    objective = undisturbed.problem.objectives[0][0]
    assert (plot.x, plot.y, plot.by) == ("evaluation", (objective,), "set") and len(table["set"].data) == undisturbed.evaluations
    assert table["set"].data[0] == "best"
    best = int(table["evaluation"].data[0])
    assert table[objective].data[0] == undisturbed.front_values[objective][0] == undisturbed.history[objective][best]
    failing = {int(n) for n, what in zip(table["evaluation"].data, table["set"].data, strict=True) if what == "fails a requirement"}
    assert failing == {int(n) for n in np.flatnonzero((undisturbed.history["violation"] > 0) & np.isfinite(undisturbed.history[objective]))}
    monkeypatch.setattr(module, "DRAWN", 10)
    thin, _ = undisturbed.search()
    assert len(thin["set"].data) <= 12 and thin["set"].data[0] == "best" and int(thin["evaluation"].data[0]) == best
