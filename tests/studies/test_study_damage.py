"""Bits that changed on the disk: told, never taken for an answer, and computed again; a ledger that is lost costs no case."""

import os
import shutil
import sqlite3

import pytest
from older_study import make_older
from pyarrow import parquet
from study_toy import Toy, install

import drivewright as dw
from drivewright.cli import main
from drivewright.errors import InputError
from drivewright.studies import parts as module
from drivewright.studies import sweeps
from drivewright.studies.parts import Damaged, Foreign, adopt_part, data_digest, part_names

pytestmark = pytest.mark.property

VARY = {"size": [f"{n} mm" for n in range(1, 14)]}


@pytest.fixture(autouse=True)
def _toy(monkeypatch):
    install(monkeypatch.setattr)


def run(folder, spec=None, **more):
    return dw.sweep(spec or Toy(), VARY, out=folder, on="serial", **more)


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """A complete study of several parts, and its table."""
    with pytest.MonkeyPatch.context() as patch:
        install(patch.setattr)
        folder = tmp_path_factory.mktemp("whole") / "S"
        return folder, run(folder).table


@pytest.fixture
def study(whole, tmp_path):
    """A copy of it."""
    shutil.copytree(whole[0], tmp_path / "S")
    return tmp_path / "S"


@pytest.fixture
def counted(monkeypatch):
    """Cases that are computed."""
    numbers, evaluate = [], sweeps.evaluate

    def counting(task, first, columns):
        numbers.extend(range(first, first + len(next(iter(columns.values())))))
        return evaluate(task, first, columns)

    monkeypatch.setattr(sweeps, "evaluate", counting)
    return numbers


def parts_of(folder):
    return sorted((folder / "parts").glob("*.parquet"))


def flip(file, place=None, bit=0):
    """Change one bit, in the middle unless `place` says where."""
    content = bytearray(file.read_bytes())
    content[len(content) // 2 if place is None else place] ^= 1 << bit
    file.write_bytes(content)


def last_number(file):
    """Place of a byte of a number in a part."""
    pages = parquet.ParquetFile(file).metadata.row_group(0).column(3)
    return pages.data_page_offset + pages.total_compressed_size - 1


def command(capsys, *arguments):
    with pytest.raises(SystemExit) as left:
        main([str(each) for each in arguments])
    return left.value.code, capsys.readouterr()


# -- a part --------------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("number", [0, 1])
def test_a_flipped_bit_is_named_by_the_table_and_the_other_rows_are_written(study, whole, capsys, number):
    file = parts_of(study)[number]
    gone = set(parquet.read_table(file)["case"].to_pylist())
    flip(file)
    code, said = command(capsys, "table", study, "--to", "csv,parquet")
    assert code == 4
    assert f"({file.name}, case" in said.err and "its bytes are not those that were written" in said.err
    assert f"{len(gone)} case" in said.err and "the sweep's command computes its cases again" in said.err
    kept = [case for case in range(whole[1].num_rows) if case not in gone]
    assert parquet.read_table(study / "table.parquet").equals(whole[1].take(kept))
    assert (study / "table.csv").read_text().count("\n") == 1 + len(kept)


def test_a_damaged_part_is_not_opened_unless_that_is_wanted(study, whole):
    flip(parts_of(study)[1])
    with pytest.raises(InputError, match="S: a part cannot be read "):
        dw.open_study(study)
    opened = sweeps.open_study(study, skip_damaged=True)
    assert opened.damaged == 1 and not opened.complete and opened.notices


def test_a_sweep_computes_damaged_parts_again_and_nothing_else(study, whole, counted):
    file = parts_of(study)[1]
    gone = parquet.read_table(file)["case"].to_pylist()
    flip(file)
    again = run(study)
    assert again.table.equals(whole[1]) and counted == gone
    count, which = (f"{len(gone)} cases", f"cases {gone[0]} to {gone[-1]}") if len(gone) > 1 else ("1 case", f"case {gone[0]}")
    assert again.notices == (f"{count} in 1 part are computed again: {file.name}, {which}: its bytes are not those that were written",)
    assert dw.open_study(study).table.equals(whole[1]) and not run(study).notices


@pytest.mark.parametrize("change", ["cut", "empty", "longer", "another part", "a folder"])
def test_a_part_that_is_something_else(study, whole, change):
    first, second = parts_of(study)[:2]
    if change == "cut":
        second.write_bytes(second.read_bytes()[:-1])
    elif change == "empty":
        second.write_bytes(b"")
    elif change == "longer":
        second.write_bytes(second.read_bytes() + b"\0")
    elif change == "another part":
        shutil.copy(first, second)
    else:
        second.unlink()
        second.mkdir()
    with pytest.raises(InputError, match="a part cannot be read"):
        dw.open_study(study)
    if change == "a folder":
        second.rmdir()
    assert run(study).table.equals(whole[1])


def test_a_part_proves_what_it_is_without_the_ledger(study, whole):
    """Every bit of every seventh byte: the part is refused, or its numbers are those that were written."""
    file = parts_of(study)[1]
    content, digest = file.read_bytes(), data_digest(parquet.read_table(file).replace_schema_metadata(None))
    identity = dict(sqlite3.connect(study / "ledger.sqlite").execute("select key, value from identity"))
    mark, taken = module.study_digest(identity), 0
    assert adopt_part(file.parent, file.name, mark).sha256
    for place in range(0, len(content), 7):
        flip(file, place, place // 7 % 8)
        try:
            adopt_part(file.parent, file.name, mark)
        except (Damaged, Foreign):
            pass
        else:
            taken += 1
            assert data_digest(parquet.read_table(file).replace_schema_metadata(None)) == digest
        file.write_bytes(content)
    assert taken < len(content) // 7 / 2


def test_pages_have_checksums_that_any_reader_can_verify(study):
    file = parts_of(study)[1]
    flip(file, last_number(file))
    with pytest.raises(OSError, match="[Cc][Rr][Cc]"):
        parquet.read_table(file, page_checksum_verification=True)


# -- the ledger ----------------------------------------------------------------------------------------------------------------


def test_a_lost_ledger_costs_no_case(study, whole, counted, capsys):
    (study / "ledger.sqlite").unlink()
    with pytest.raises(InputError, match=r"its ledger.sqlite is lost; the parts are there: `drivewright sweep .* continues"):
        dw.open_study(study)
    again = run(study)
    assert again.table.equals(whole[1]) and counted == []
    (notice,) = again.notices
    assert notice.startswith("the ledger.sqlite is lost; a new one was made from the parts that prove what they are: 13 cases in ")
    assert dw.open_study(study).table.equals(whole[1])


@pytest.mark.parametrize("content", [b"", b"no data base at all " * 100, b"\0" * 9000])
def test_a_ledger_that_is_none(study, whole, counted, content):
    (study / "ledger.sqlite").write_bytes(content)
    again = run(study)
    assert again.table.equals(whole[1]) and counted == [] and "13 cases in" in again.notices[0]


def test_a_ledger_and_a_part_that_are_damaged(study, whole, counted):
    file = parts_of(study)[1]
    gone = parquet.read_table(file)["case"].to_pylist()
    flip(file, last_number(file))
    (study / "ledger.sqlite").write_bytes((study / "ledger.sqlite").read_bytes()[:5000])
    again = run(study)
    assert again.table.equals(whole[1]) and counted == gone
    assert f"{13 - len(gone)} cases in" in again.notices[0] and f"; {file.name} cannot, and stay under other names" in again.notices[0]
    assert len(list((study / "parts").glob(f"{file.name}.damaged-*"))) == 1 and len(list(study.glob("ledger.sqlite.damaged-*"))) == 1


@pytest.mark.parametrize(("head", "step"), [(9, 401), pytest.param(3, 71, marks=pytest.mark.slow)])
def test_any_bit_of_the_ledger_may_change(study, whole, head, step):
    """Some bytes of every page, and more of the head: the same rows, or a refusal; and the same rows after a sweep."""
    ledger, told = (study / "ledger.sqlite").read_bytes(), 0
    for place in [*range(0, 100, head), *range(100, len(ledger), step)]:
        (study / "ledger.sqlite").write_bytes(ledger)
        flip(study / "ledger.sqlite", place, place % 8)
        try:
            opened = sweeps.open_study(study, skip_damaged=True)
        except InputError:
            told += 1
        else:
            assert not len(opened) or opened.table.equals(whole[1].take(opened.table["case"]))
            told += opened.damaged
        assert run(study).table.equals(whole[1]), place
        for left in study.glob("ledger.sqlite?*"):
            left.unlink()
    assert told > 5


def test_parts_of_another_study_are_never_taken(study, tmp_path):
    """Its ledger is lost, and the parts say whose they are."""
    before = {file: file.read_bytes() for file in parts_of(study)}
    (study / "ledger.sqlite").unlink()
    with pytest.raises(InputError, match="holds another study; .* Give another --out, or remove the folder"):
        run(study, Toy(force="3 N"))
    assert {file: file.read_bytes() for file in parts_of(study)} == before


def test_the_ledger_of_another_study_does_not_make_its_parts_ours(study, whole, tmp_path):
    run(tmp_path / "T", Toy(force="3 N"))
    shutil.copy(tmp_path / "T" / "ledger.sqlite", study / "ledger.sqlite")
    assert run(study).table.equals(whole[1])
    with pytest.raises(InputError, match="holds another study"):
        run(study, Toy(force="3 N"))


def test_a_part_that_was_finished_and_not_named_any_more_is_kept(study, whole, counted):
    """Killed between the part and its line in the ledger."""
    with sqlite3.connect(study / "ledger.sqlite") as ledger:
        ledger.execute("delete from parts where first = (select max(first) from parts)")
    ledger.close()
    assert run(study).table.equals(whole[1]) and counted == []


def test_a_table_of_a_study_with_a_damaged_ledger_says_what_helps(study, capsys):
    (study / "ledger.sqlite").write_bytes(b"no data base at all " * 100)
    code, said = command(capsys, "table", study)
    assert code == 2 and "is damaged (file is not a database)" in said.err and "drivewright sweep" in said.err
    assert not (study / "table.csv").exists()


# -- older versions ------------------------------------------------------------------------------------------------------------


def test_an_older_study_opens_goes_on_and_has_checksums_from_then_on(study, whole, counted):
    make_older(study)
    assert dw.open_study(study).table.equals(whole[1])
    again = run(study)
    assert again.table.equals(whole[1]) and counted == []
    assert again.notices[0].startswith("13 cases in") and "kept without a checksum by an older version" in again.notices[0]
    assert not run(study).notices
    flip(parts_of(study)[1])
    with pytest.raises(InputError, match="its bytes are not those that were written"):
        dw.open_study(study)


def test_an_older_part_that_cannot_be_read_is_computed_again(study, whole):
    make_older(study)
    file = parts_of(study)[1]
    file.write_bytes(file.read_bytes()[:-9])
    assert run(study).table.equals(whole[1])


def test_an_older_study_without_its_ledger_is_computed_again_and_its_parts_are_kept(study, whole, counted):
    make_older(study)
    names = part_names(study / "parts")
    (study / "ledger.sqlite").unlink()
    again = run(study)
    assert again.table.equals(whole[1]) and len(counted) == 13 and "0 cases in 0 parts kept" in again.notices[0]
    kept = {name.partition(".damaged")[0] for name in os.listdir(study / "parts") if ".damaged" in name}
    assert kept == names
