"""Texts in CSV and Excel files: none is taken for a formula, all come back as they were written, and numbers stay numbers."""

import csv
import io

import numpy as np
import pyarrow as pa
import pytest
from hypothesis import given
from hypothesis import strategies as st
from openpyxl import load_workbook

from drivewright.errors import SpecError
from drivewright.report.tabular import write_csv, write_study_table
from drivewright.result import Column, Table
from drivewright.spec.csv_text import csv_line, csv_rows, plain_text, read_data_file, text_cell

pytestmark = pytest.mark.interface

TEXTS = [
    '=HYPERLINK("http://example.org","x")',
    "=1+1",
    "+1",
    "-1",
    "-",
    "@SUM(A1)",
    "\t=1",
    "\r=1",
    "\n=1",
    "'=1",
    "''=1",
    "'quoted'",
    "plain",
    "a=b",
    " =1",
    "",
    "a, b",
    'say "hi"',
]
SIGNS = tuple("=+-@\t\r\n")


def rows(path):
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.reader(file))


@given(st.text(alphabet=st.sampled_from("'=+-@\t\r\na ")) | st.text())
def test_a_text_comes_back_and_never_begins_like_a_formula(text):
    assert plain_text(text_cell(text)) == text and not text_cell(text).startswith(SIGNS)


@given(st.lists(st.text(alphabet=st.sampled_from('a ,"\n\r')), min_size=1))
def test_cells_of_a_line_come_back_though_all_be_empty(cells):
    (row,) = csv.reader(io.StringIO(csv_line(cells), newline=""))
    assert row == cells


def test_a_cell_that_somebody_else_wrote_is_left_alone():
    assert [plain_text(cell) for cell in ("'a", "'", "", "-1.5", "=1", "'1")] == ["'a", "'", "", "-1.5", "=1", "'1"]


@pytest.fixture
def study():
    numbers = np.linspace(-1.0, 1.0, len(TEXTS))
    table = pa.table({"=name": pa.array(TEXTS), "number": pa.array(numbers), "count": pa.array(range(-9, 9))})
    return Stored(table)


class Stored:
    """What writing asks of a study."""

    def __init__(self, table):
        self.table, self.schema = table, table.schema

    def __len__(self):
        return len(self.table)

    def batches(self):
        yield self.table


def test_the_csv_table_of_a_study(study, tmp_path):
    header, *body = rows(write_study_table(study, tmp_path / "t.csv"))
    assert header == ["'=name", "number", "count"] and not any(row[0].startswith(SIGNS) for row in body)
    assert [plain_text(row[0]) for row in body] == TEXTS
    assert [float(row[1]) for row in body] == pytest.approx(np.linspace(-1.0, 1.0, len(TEXTS)), rel=1e-11)
    assert body[0][1:] == ["-1", "-9"]


def test_the_excel_table_of_a_study(study, tmp_path):
    sheet = load_workbook(write_study_table(study, tmp_path / "t.xlsx")).active
    cells = [sheet.cell(row + 2, 1) for row in range(len(TEXTS))]
    assert all(cell.data_type in ("s", "n") and not (cell.value is None and text) for cell, text in zip(cells, TEXTS, strict=True))
    assert [(cell.value or "").replace("_x000D_", "\r") for cell in cells] == TEXTS
    assert sheet["A1"].data_type == "s" and sheet["B2"].data_type == "n" and sheet["B2"].value == -1.0
    assert not any(cell.data_type == "f" for row in sheet.iter_rows() for cell in row)


def test_the_csv_file_of_a_result(tmp_path):
    columns = Column("name", "-", "names", np.array(TEXTS)), Column("x", "m", "x", -np.ones(len(TEXTS)))
    write_csv(Table("t", "t", columns), tmp_path / "t.csv")
    header, *body = rows(tmp_path / "t.csv")
    assert [plain_text(row[0]) for row in body] == TEXTS and {row[1] for row in body} == {"-1000"} and header == ["name", "x [mm]"]
    assert not any(row[0].startswith(SIGNS) for row in body)


# -- what is read --------------------------------------------------------------------------------------------------------------


def test_a_data_file_has_a_limit_before_it_is_read_whole(tmp_path):
    with (tmp_path / "long.csv").open("wb") as file:
        file.truncate(10 * 2**30)  # a hole of 10 GB
    with pytest.raises(SpecError, match=r"long.csv: has more than 64 MB; give fewer rows"):
        read_data_file(tmp_path / "long.csv")
    with pytest.raises(SpecError, match="more than 64 MB"):
        read_data_file("/dev/zero")


def test_a_cell_longer_than_any_number_is_refused_with_its_line(tmp_path):
    with pytest.raises(SpecError, match=r"t.csv: line 2: cannot be read as CSV: field larger than"):
        list(csv_rows(["angle [deg],lift [mm]", "1" * 200_000 + ",1"], "t.csv"))
