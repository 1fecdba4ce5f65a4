"""Tables as CSV and Excel files in the units people read, with the unit of every column in its header: `angle [deg],lift [mm]`."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from drivewright._typing import Floats
from drivewright.atomic import replacing, write_text
from drivewright.errors import InputError
from drivewright.report.records import StudyRecord
from drivewright.result import Column, Table
from drivewright.spec.csv_text import FORMULA, csv_line, text_cell
from drivewright.units import Scale, System, scale

if TYPE_CHECKING:
    import pyarrow

DIGITS = 12  # significant figures of what is written as text or shown in a sheet
SLICE = 65_536  # rows of a study at a time, so that a long one needs little memory
SHEET_ROWS, SHEET_COLUMNS, SHEET_LETTERS = 1_048_576, 16_384, 32_767  # what an Excel sheet and one of its cells hold


def write_csv(table: Table, path: str | Path, digits: int = DIGITS, system: System = "mm") -> None:
    """CSV file of a `result.Table`: header `name [unit]` (a pure number: `name`), numbers to `digits` figures, missing ones empty.

    Texts that a spreadsheet would take for a formula get an apostrophe in front (`spec.csv_text`)."""
    header = [text_cell(heading(column, system)) for column in table.columns]
    rows = zip(*(_cells(column, digits, system) for column in table.columns), strict=True)
    write_text(path, "".join(map(csv_line, [header, *rows])))


def heading(column: Column, system: System = "mm") -> str:
    """`name [unit]` with the unit that is shown."""
    return titled(column.name, column.unit, system)


def titled(name: str, unit: str, system: System = "mm") -> str:
    """`name [unit]` of a name and an SI unit."""
    shown = scale(unit, system=system).unit
    return name if shown in ("", "-") else f"{name} [{shown}]"


def _cells(column: Column, digits: int, system: System) -> list[str]:
    data = np.asarray(column.data)
    if data.dtype.kind not in "iuf":
        return [text_cell(str(value)) for value in data.tolist()]
    shown = scale(column.unit, system=system)
    if data.dtype.kind in "iu" and (shown.factor, shown.zero) == (1, 0):
        return [str(value) for value in data.tolist()]
    return [f"{value + 0.0:.{digits}g}" if np.isfinite(value) else "" for value in shown.of(data).tolist()]


# -- studies -------------------------------------------------------------------------------------------------------------------


def write_study_table(study: StudyRecord, path: str | Path, system: System = "mm") -> Path:
    """Write the cases of a study as one table and return its path: .csv, .xlsx or .parquet.

    CSV and Excel: units of the `system`, named in the first line, missing numbers empty.  Parquet: SI, with unit and meaning in the
    metadata of every field.  InputError for another format, and for more than a sheet holds.
    """
    path = Path(path)
    write = WRITERS.get(path.suffix.lower())
    if write is None:
        raise InputError(f"{path}: cannot be written as {path.suffix or 'a file without a suffix'}; take {', '.join(WRITERS)}")
    _refuse_what_no_sheet_holds(study, path)
    with replacing(path) as temporary:
        write(study, temporary, system)
    return path


def _refuse_what_no_sheet_holds(study, path):
    if path.suffix.lower() != ".xlsx":
        return
    for what, count, most in (("cases", len(study), SHEET_ROWS - 1), ("columns", len(study.schema), SHEET_COLUMNS)):
        if count > most:
            raise InputError(f"{path}: {count} {what} are more than the {most} that an Excel sheet holds; take parquet or csv")


def _study_csv(study, path, system):
    """The header by hand, for the units; the rows by pyarrow, a hundred times as fast as Python."""
    from pyarrow import csv as arrow_csv

    look = arrow_csv.WriteOptions(include_header=False, quoting_style="needed")
    with path.open("wb") as file:
        file.write(csv_line(map(text_cell, _headings(study, system))).encode())
        for part in _slices(study, system):
            arrow_csv.write_csv(_with_text_cells(part), file, look)


def _with_text_cells(table):
    """The table with the texts of all columns as `text_cell` has them."""
    import pyarrow as pa
    import pyarrow.compute as pc

    escaped = pc.ReplaceSubstringOptions(f"({FORMULA})", r"'\1", max_replacements=1)
    is_text = [pa.types.is_string(field.type) or pa.types.is_large_string(field.type) for field in table.schema]
    columns = [
        pc.call_function("replace_substring_regex", [column], escaped) if text else column
        for column, text in zip(table.columns, is_text, strict=True)
    ]
    return pa.Table.from_arrays(columns, names=table.column_names)


def _study_sheet(study, path, system):
    """One sheet with a header that stays in sight; texts are never taken for formulas."""
    import xlsxwriter
    from xlsxwriter.exceptions import FileCreateError

    try:
        with xlsxwriter.Workbook(path, {"constant_memory": True}) as book:
            _fill_sheet(book, study, system)
    except FileCreateError as error:  # what the system said is in it
        raise next((cause for cause in error.args if isinstance(cause, OSError)), OSError(str(error))) from None


def _fill_sheet(book, study, system):
    """The cells, the header first."""
    sheet = book.add_worksheet("cases")
    head = book.add_format({"bold": True, "bottom": 1, "valign": "top", "text_wrap": True})
    for column, name in enumerate(_headings(study, system)):
        sheet.set_column(column, column, min(max(len(name) + 2, 10), 28))
        sheet.write_string(0, column, name, head)
    sheet.freeze_panes(1, 1)
    sheet.autofilter(0, 0, len(study), max(len(study.schema) - 1, 0))
    writers = [_cell_writer(sheet, field.type) for field in study.schema]
    row = 0
    for part in _slices(study, system):
        for cells in zip(*(column.to_pylist() for column in part.columns), strict=True):
            row += 1
            for column, (write, cell) in enumerate(zip(writers, cells, strict=True)):
                if cell is not None and cell != "":
                    write(row, column, cell)


def _cell_writer(sheet, kind):
    """The method that writes cells of an Arrow type."""
    import pyarrow as pa

    if pa.types.is_boolean(kind):
        return sheet.write_boolean
    if pa.types.is_integer(kind) or pa.types.is_floating(kind):
        return sheet.write_number
    return lambda row, column, text: sheet.write_string(row, column, text[:SHEET_LETTERS])


def _study_parquet(study, path, system):
    from pyarrow import parquet

    with parquet.ParquetWriter(path, study.schema) as writer:
        for part in study.batches():
            writer.write_table(part)


def _headings(study: StudyRecord, system: System) -> list[str]:
    return [titled(field.name, _unit(field), system) for field in study.schema]


def _unit(field: "pyarrow.Field") -> str:
    return (field.metadata or {}).get(b"unit", b"").decode()


def _slices(study: StudyRecord, system: System) -> "Iterator[pyarrow.Table]":
    """The rows in slices, numbers in the units people read, what is not finite as null."""
    import pyarrow as pa

    scales = [scale(_unit(field), system=system) for field in study.schema]
    for table in study.batches():
        for start in range(0, table.num_rows, SLICE):
            part = table.slice(start, SLICE)
            columns = [_as_shown(column, shown) for column, shown in zip(part.columns, scales, strict=True)]
            yield pa.Table.from_arrays(columns, names=table.column_names)


def _as_shown(column, shown: Scale):
    import pyarrow as pa

    if not (pa.types.is_floating(column.type) or (pa.types.is_integer(column.type) and (shown.factor, shown.zero) != (1, 0))):
        return column
    data = shown.of(column.to_numpy().astype(float))
    finite = np.isfinite(data)
    return pa.array(rounded(np.where(finite, data, 0.0)), mask=~finite)


def rounded(data: Floats) -> Floats:
    """Finite numbers to `DIGITS` figures: the floats nearest to those decimals, so that they print short."""
    size = np.abs(data)
    exponent = DIGITS - 1 - np.floor(np.log10(np.where(size > 0, size, 1.0))).astype(int)
    # Powers of ten up to 1e22 are floats without an error; one division or product of such and a whole number is rounded once.
    exact = np.abs(exponent) <= 22
    power = 10.0 ** np.where(exact, np.abs(exponent), 0)
    whole = np.rint(np.where(exponent >= 0, data * power, data / power))
    numbers = np.where(exponent >= 0, whole / power, whole * power) + 0.0
    numbers[~exact] = [float(f"{value:.{DIGITS}g}") for value in data[~exact].tolist()]
    return numbers


WRITERS = {".csv": _study_csv, ".xlsx": _study_sheet, ".parquet": _study_parquet}
