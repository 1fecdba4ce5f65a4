"""Cases that failed, computed once more: the answer of a fresh study, nothing else computed, and nothing lost on the way."""

import os
import shutil
import sqlite3
from dataclasses import replace

import numpy as np
import pyarrow as pa
import pytest
from places import EXAMPLES
from study_toy import TOY, Toy, install

import drivewright as dw
from drivewright.cli import main
from drivewright.errors import InputError, SolverError
from drivewright.execution.case_table import case_table
from drivewright.execution.evaluation import _prepared_from
from drivewright.execution.keys import key_kind
from drivewright.execution.outputs import OutputInfo
from drivewright.registry import Analysis
from drivewright.result import Answer, Value
from drivewright.studies import sweeps
from drivewright.studies.retry import merged
from drivewright.studies.variation import with_variation

pytestmark = pytest.mark.property

SIZES = [f"{n} mm" for n in range(1, 24)]
BAD = {3, 4, 9, 15, 22}  # cases that fail on a bad day


DAY = {"bad": BAD, "ill": set()}  # cases that fail, and that are partial, as long as the day lasts


def on_a_day(patch, bad, ill=frozenset()):
    """Which cases of the toy fail from now on, and which are partial."""
    patch(__name__ + ".DAY", {"bad": bad, "ill": ill})


def answer(spec, done):
    """The toy of the day; even cases bring another value."""
    case = round(spec.size / 1e-3) - 1
    if case in DAY["bad"]:
        raise InputError(f"size: no memory for case {case}")
    values = {"area": Value(spec.size**2, "m^2", "size squared")}
    if case in DAY["ill"]:
        raise SolverError("gave up", Answer(values=values))
    return Answer(values=values | ({"even": Value(float(case), "-", "an even case")} if case % 2 == 0 else {}))


@pytest.fixture(autouse=True)
def _toy(monkeypatch):
    install(monkeypatch.setattr, replace(TOY, analyses=(Analysis("main", answer, "what it is"),)))
    _prepared_from.cache_clear()  # a process keeps what it has made of a task
    on_a_day(monkeypatch.setattr, BAD)
    yield
    _prepared_from.cache_clear()


def run(folder, **more):
    return dw.sweep(Toy(), {"size": SIZES}, out=folder, on="serial", **more)


@pytest.fixture
def fresh(monkeypatch, tmp_path):
    """The table of the same study on a good day."""
    with pytest.MonkeyPatch.context() as patch:
        on_a_day(patch.setattr, set())
        return run(tmp_path / "fresh").table


@pytest.fixture
def counted(monkeypatch):
    """Sizes [mm] of the cases that are computed."""
    sizes, evaluate = [], sweeps.evaluate

    def counting(task, first, columns):
        sizes.extend(np.round(np.asarray(columns["size"]) / 1e-3).astype(int).tolist())
        return evaluate(task, first, columns)

    monkeypatch.setattr(sweeps, "evaluate", counting)
    return sizes


def same(table, other):
    return table.equals(other) and table.schema.equals(other.schema, check_metadata=True)


def test_only_what_failed_is_computed_and_the_table_is_that_of_a_fresh_study(tmp_path, monkeypatch, fresh, counted):
    before = run(tmp_path / "S")
    assert before.counts == {"complete": 18, "failed": 5} and before.notices == () and len(counted) == 23
    counted.clear()
    on_a_day(monkeypatch.setattr, set())
    again = run(tmp_path / "S", retry="failed")
    assert counted == [case + 1 for case in sorted(BAD)]
    assert same(again.table, fresh) and same(dw.open_study(tmp_path / "S").table, fresh)
    assert again.notices == ("5 of 5 cases that had failed: computed once more, 5 complete now",)
    assert again.seconds > before.seconds
    assert run(tmp_path / "S", retry="failed").notices == ("no case of this study has failed, so none is computed once more",)


def test_what_fails_again_keeps_its_row_and_its_new_reason(tmp_path, monkeypatch):
    run(tmp_path / "S")
    on_a_day(monkeypatch.setattr, {4, 22})
    again = run(tmp_path / "S", retry="failed")
    assert again.notices == ("5 of 5 cases that had failed: computed once more, 3 complete now",)
    assert np.flatnonzero(again["status"] == "failed").tolist() == [4, 22] and "no memory for case 22" in again["message"][22]


def test_partial_cases_are_computed_once_more_where_that_is_wanted(tmp_path, monkeypatch, fresh, counted):
    on_a_day(monkeypatch.setattr, {3}, {7, 8})
    assert run(tmp_path / "S").counts == {"complete": 20, "failed": 1, "partial": 2}
    on_a_day(monkeypatch.setattr, set())
    counted.clear()
    assert run(tmp_path / "S", retry="failed").counts == {"complete": 21, "partial": 2} and counted == [4]
    words = (
        "no case of this study has failed, so none is computed once more: 0 failed, 2 partial, which --retry incomplete computes once more"
    )
    assert run(tmp_path / "S", retry="failed").notices == (words,)
    again = run(tmp_path / "S", retry="incomplete")
    assert counted == [4, 8, 9] and same(again.table, fresh)
    assert again.notices == ("2 of 2 cases that were incomplete: computed once more, 2 complete now",)
    assert run(tmp_path / "S", retry="incomplete").notices == ("no case of this study is incomplete, so none is computed once more",)


def stop_after(count):
    """A progress that interrupts after so many calls."""
    calls = []

    def progress(done, total, what):
        calls.append(done)
        if len(calls) > count:
            raise KeyboardInterrupt

    return progress


@pytest.mark.parametrize("batches", [1, 2, 3])
def test_an_interrupted_retry_loses_no_row_and_goes_on(tmp_path, monkeypatch, fresh, batches):
    run(tmp_path / "S")
    on_a_day(monkeypatch.setattr, set())
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("drivewright.execution.batches.GROWTH", 1)  # one case after another
        stopped = run(tmp_path / "S", retry="failed", progress=stop_after(batches))
    assert stopped.interrupted and len(stopped) == 23 and 18 <= stopped.counts["complete"] < 23
    left = stopped.counts["failed"]
    assert stopped.notices[0].endswith(f"; the same command computes the other {left}")
    assert same(run(tmp_path / "S", retry="failed").table, fresh)


def test_cases_that_are_missing_are_computed_too(tmp_path, monkeypatch, fresh):
    stopped = run(tmp_path / "S", progress=stop_after(2))
    assert stopped.interrupted and 0 < len(stopped) < 23
    on_a_day(monkeypatch.setattr, set())
    assert same(run(tmp_path / "S", retry="failed").table, fresh)


@pytest.mark.parametrize("workers", [1, 2])
def test_in_other_processes_it_is_the_same(tmp_path, monkeypatch, workers):
    """The shaft in place of the toy, which other processes do not know."""
    vary = {"stations.m4.position": [f"{n} mm" for n in (190, 200, 9000, 210)]}
    spec = with_variation(dw.load(EXAMPLES / "rubber_roller_shaft.toml"), vary, analyses=["statics"])
    one = dw.sweep(spec, out=tmp_path / "S", on="serial")
    assert one.counts == {"complete": 3, "failed": 1}
    again = dw.sweep(spec, out=tmp_path / "S", workers=workers, retry="failed")
    assert same(again.table, one.table) and again.notices == ("1 of 1 case that had failed: computed once more, 0 complete now",)


# -- the disk ------------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("step", ["write_content", "settle"])
def test_an_end_between_file_and_ledger_leaves_the_old_rows_or_the_new_ones(tmp_path, monkeypatch, fresh, step, counted):
    from drivewright.studies import study_folder

    run(tmp_path / "S")
    on_a_day(monkeypatch.setattr, set())

    class Killed(BaseException):
        pass

    def killed(*arguments):
        raise Killed

    with pytest.MonkeyPatch.context() as patch, pytest.raises(Killed):
        if step == "write_content":
            patch.setattr(study_folder, "write_content", killed)
        else:
            write = study_folder.write_content
            patch.setattr(study_folder, "write_content", lambda *arguments: killed(write(*arguments)))
        run(tmp_path / "S", retry="failed")
    assert len(dw.open_study(tmp_path / "S")) == 23  # a reader takes either file
    counted.clear()
    on_a_day(monkeypatch.setattr, BAD)
    there = run(tmp_path / "S")
    assert counted == [] and len(there) == 23 and there.notices == ()
    assert (there.counts["failed"] == 5) == (step == "write_content")
    on_a_day(monkeypatch.setattr, set())
    assert same(run(tmp_path / "S", retry="failed").table, fresh)
    ledger = sqlite3.connect(tmp_path / "S" / "ledger.sqlite")
    assert ledger.execute("select count(*) from parts where next_sha256 is not null or next_size is not null").fetchone() == (0,)


def test_a_damaged_part_that_was_to_be_replaced_is_still_found(tmp_path):
    run(tmp_path / "S")
    (file, *_) = sorted((tmp_path / "S" / "parts").glob("*.parquet"))
    ledger = sqlite3.connect(tmp_path / "S" / "ledger.sqlite")
    with ledger:
        ledger.execute("update parts set next_size = 7, next_sha256 = 'x' where name = ?", (file.name,))
    ledger.close()
    assert not run(tmp_path / "S").notices
    file.write_bytes(file.read_bytes()[:-1] + b"\0")
    with pytest.raises(InputError, match="a part cannot be read"):
        dw.open_study(tmp_path / "S")


# -- rows put together ---------------------------------------------------------------------------------------------------------


def rows(first, sizes, values, statuses=None):
    kinds = {"size": key_kind(Toy(), "size")}
    about = {name: OutputInfo("-", name) for name in values}
    columns = {name: np.array(column, float) for name, column in values.items()}
    return case_table(
        first, {"size": np.array(sizes, float)}, kinds, columns, about, statuses or ["complete"] * len(sizes), [""] * len(sizes)
    )


def test_columns_of_merged_rows_come_in_the_order_in_which_the_rows_bring_them():
    old = rows(5, [1, 2, 3, 4], {"b": [np.nan, 2, np.nan, 4], "c": [np.nan, 7, np.nan, 8]}, ["failed", "complete", "failed", "complete"])
    new = pa.concat_tables([rows(7, [3], {"a": [30], "d": [np.nan]}), rows(5, [1], {"a": [10], "d": [40]})])
    whole = merged(old, new)
    assert whole.column_names == ["case", "status", "message", "size", "a", "d", "b", "c"]
    assert whole["case"].to_pylist() == [5, 6, 7, 8] and whole["a"].to_pylist() == [10, None, 30, None]
    assert whole["b"].to_pylist() == [None, 2, None, 4] and set(whole["status"].to_pylist()) == {"complete"}


# -- refusals and the command --------------------------------------------------------------------------------------------------


def command(*arguments):
    with pytest.raises(SystemExit) as end:
        main(["sweep", *map(str, arguments), "--no-figures", "--on", "serial"])
    return end.value.code or 0


@pytest.mark.error
def test_where_there_is_no_study_or_no_such_word(tmp_path):
    with pytest.raises(InputError, match="S: holds no study yet, so it has no case to retry; leave --retry out to begin it"):
        run(tmp_path / "S", retry="failed")
    assert not (tmp_path / "S").exists()
    with pytest.raises(InputError, match="a study in memory: holds no study"):
        run(None, retry="failed")
    with pytest.raises(InputError, match="--retry 'bad' names no cases; take failed or incomplete"):
        run(tmp_path / "S", retry="bad")


@pytest.mark.interface
def test_a_retry_needs_no_plan_of_its_own(tmp_path, monkeypatch, capsys):
    """The study in --out says what varies; a spec with a plan, or with other keys, is another study as ever."""
    (tmp_path / "toy.toml").write_text('mechanism = "toy"\n')
    folder = tmp_path / "S"
    assert (
        command(tmp_path / "toy.toml", "--vary", "size=1 mm,2 mm,3 mm,4 mm", "--out", folder) == 0 and "1 failed" in capsys.readouterr().out
    )
    on_a_day(monkeypatch.setattr, set())
    assert command(tmp_path / "toy.toml", "--out", folder, "--retry", "failed") == 0
    said = capsys.readouterr()
    assert "1 of 1 case that had failed: computed once more, 1 complete now" in said.err and "4 complete" in said.out
    assert command(tmp_path / "toy.toml", "--out", folder) == 2 and "choose at least one parameter to vary" in capsys.readouterr().err
    assert command(tmp_path / "toy.toml", "--set", "size=7 mm", "--out", folder, "--retry", "failed") == 2
    assert "holds another study; size:" in capsys.readouterr().err
    assert dw.sweep(Toy(), out=folder, retry="failed", on="serial").plan.keys == ("size",)


@pytest.mark.interface
def test_the_command_says_what_it_did_and_takes_the_folder_of_a_study(tmp_path, monkeypatch, capsys):
    (tmp_path / "toy.toml").write_text('mechanism = "toy"\n')
    vary = ("--vary", "size=1 mm,2 mm,3 mm,4 mm")
    folder = tmp_path / "S"
    assert (
        command(tmp_path / "toy.toml", *vary, "--out", folder, "--retry", "failed") == 2 and "holds no study yet" in capsys.readouterr().err
    )
    assert command(tmp_path / "toy.toml", *vary, "--out", folder) == 0 and "1 failed" in capsys.readouterr().out
    on_a_day(monkeypatch.setattr, set())
    assert command(folder, "--retry", "failed") == 0
    said = capsys.readouterr()
    assert "note: 1 of 1 case that had failed: computed once more, 1 complete now" in said.err and "4 complete" in said.out
    assert command(tmp_path / "toy.toml", *vary, "--out", folder, "--retry", "failed") == 0
    assert "no case of this study has failed, so none is computed once more" in capsys.readouterr().err
    moved = tmp_path / "elsewhere"
    shutil.move(folder, moved)
    assert command(moved) == 0 and os.listdir(tmp_path / "elsewhere") and not folder.exists()
    assert command(moved, "--vary", "size=1 mm,2 mm", "--retry", "failed") == 2 and "holds another study" in capsys.readouterr().err
