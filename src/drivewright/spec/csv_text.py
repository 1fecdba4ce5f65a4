"""CSV files as text: read within limits, and texts that no spreadsheet takes for a formula.

A spreadsheet computes a cell that begins with = + - @, or with a tab or a line feed before one of them, and the formula may be anything
that stood in a title or a name.  So a *text* that begins like this gets an apostrophe in front, the sign by which spreadsheets mark text;
one that has apostrophes before such a sign already gets one more, so that taking one off always gives back what was written.  Numbers
are left alone: -1.5 stays a number.
"""

import codecs
import csv
import re
from collections.abc import Iterable, Iterator
from pathlib import Path

from drivewright.errors import SpecError

MAX_BYTES = 64 * 2**20  # of a data file
FORMULA = r"^'*[=+\-@\t\r\n]"  # how a text begins that gets an apostrophe, in the syntax of re and of Arrow
_FORMULA, _ESCAPED = re.compile(FORMULA), re.compile(r"'" + FORMULA[1:])
_EMPTY = '""'  # the only cell of its row
_QUOTED = re.compile(r'[",\r\n]')


def text_cell(text: str) -> str:
    """A text as a cell of a CSV file: with an apostrophe in front where a spreadsheet would take it for a formula."""
    return f"'{text}" if _FORMULA.match(text) else text


def plain_text(cell: str) -> str:
    """The text of a cell that `text_cell` wrote."""
    return cell[1:] if _ESCAPED.match(cell) else cell


def csv_line(cells: Iterable[str]) -> str:
    """A line of a CSV file; a cell is quoted where it must be, which the `csv` module forgets with a lone carriage return."""
    line = ",".join('"' + cell.replace('"', '""') + '"' if _QUOTED.search(cell) else cell for cell in cells)
    return f"{line or _EMPTY}\n"


def read_data_file(file: str | Path) -> str:
    """The text of a CSV file in UTF-8, with or without a byte-order mark, or in UTF-16 with one; SpecError where it cannot be read or is
    too long."""
    try:
        with Path(file).open("rb") as stream:
            content = stream.read(MAX_BYTES + 1)
        if len(content) > MAX_BYTES:
            raise SpecError(f"has more than {MAX_BYTES // 2**20} MB; give fewer rows, every tenth will do", file=str(file))
        return content.decode("utf-16" if content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)) else "utf-8-sig")
    except UnicodeDecodeError as error:
        raise SpecError(f"cannot be read: {_undecodable(error)}", file=str(file)) from None
    except OSError as error:
        raise SpecError(f"cannot be read: {error.strerror or error}", file=str(file)) from None


def _undecodable(error):
    """Where a file is no text of its encoding, and what the byte is in the code page of Windows."""
    line, byte = error.object[: error.start].count(b"\n") + 1, error.object[error.start : error.start + 1]
    meant = byte.decode("cp1252", errors="ignore")
    also = f" (in the code page of Windows it is {meant!r})" if meant.isprintable() and meant else ""
    return f"line {line} has the byte 0x{byte.hex()}, which is no {error.encoding.upper()}{also}; save the file as 'CSV UTF-8'"


def csv_rows(lines: Iterable[str], file: str | Path) -> Iterator[tuple[int, list[str]]]:
    """(number of the line, cells) of every row that is not blank; SpecError where a cell is longer than any number or name."""
    reader = csv.reader(lines)
    try:
        for cells in reader:
            if cells:
                yield reader.line_num, cells
    except csv.Error as error:
        raise SpecError(f"line {reader.line_num}: cannot be read as CSV: {error}", file=str(file)) from None
