"""Tables of numbers in CSV files from any program: one reader for the data files of all drives.

* separators: comma, semicolon, tab or blanks, by the header; "sep=;" in the first line is heeded
* decimal sign: point, or comma where the comma does not separate columns; what may be a sign of thousands is refused
* headings: names in any order and in several spellings, units in them or in the row below (`csv_headings`); lines before the headings
  are passed over, headings in a comment line (as numpy writes them) are found
* comments: lines that begin with #, % or //; quotes and byte-order marks

An error names file, line and text of what cannot be read, and what to write instead.
"""

import csv
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.errors import SpecError, brief
from drivewright.spec.csv_headings import PURE, TEXT, CsvColumn, Wanted, find_columns, has_column, no_column, says_units, unit_in_brackets
from drivewright.spec.csv_numbers import NUMBER, PLAIN, Cell, decimal_sign, last_digit, number
from drivewright.spec.csv_text import read_data_file

COMMENT = ("#", "%", "//")
SEARCHED = 60  # lines in which the headings must stand
SEPARATORS = ("\t", ";", ",", " ")
NAMES = {"\t": "tab", ";": "semicolon", ",": "comma", " ": "blank"}


class Row(NamedTuple):
    """Cells of a row and the numbers of the lines where it begins and ends: a quoted cell may run over several."""

    line: int
    end: int
    cells: list[str]


@dataclass(frozen=True, eq=False)
class CsvTable:
    """The wanted columns of a file by name, and its rows."""

    file: str
    columns: dict[str, CsvColumn]
    rows: tuple[Row, ...]
    separator: str

    def __contains__(self, name: str) -> bool:
        return name in self.columns

    @property
    def lines(self) -> list[int]:
        """Number of the line of each row."""
        return [row.line for row in self.rows]

    def texts(self, name: str) -> list[str]:
        """The cells of a column; "" where a row is too short."""
        place = self.columns[name].place
        return [row.cells[place] if place < len(row.cells) else "" for row in self.rows]

    def cells(self, name: str) -> list[Cell]:
        """The same with the number of the line."""
        return [Cell(text, line, name) for text, line in zip(self.texts(name), self.lines, strict=True)]

    @cached_property
    def decimal(self) -> str:
        """The decimal sign of the file, by all its numbers that are read."""
        numeric = [name for name, column in self.columns.items() if column.dimension != TEXT]
        if not any("," in text for name in numeric for text in self.texts(name)):
            return "."
        cells = [cell for name in numeric for cell in self.cells(name)]
        return decimal_sign([cell for cell in cells if re.search("[0-9]", cell.text)], self.file)

    def numbers(self, name: str) -> Floats:
        """The numbers of a column in SI (rows,)."""
        texts, lines, sign = self.texts(name), self.lines, self.decimal
        plain = [text.replace(",", ".") for text in texts] if sign == "," else texts
        found = [
            float(usual) if PLAIN.fullmatch(usual) else number(Cell(text, line, name), sign, self.file)
            for usual, text, line in zip(plain, texts, lines, strict=True)
        ]
        return np.array(found) * self.columns[name].factor

    def last_digit(self, name: str) -> float:
        """The step [SI] of the last digit that a column was printed to."""
        return last_digit(self.texts(name)) * self.columns[name].factor


def read_csv(file: str | Path, wanted: Sequence[Wanted], needed: Sequence[Sequence[str]]) -> CsvTable:
    """The `CsvTable` of a file with the columns of `wanted` that it has; `needed`: groups of names, of each of which one must be there."""
    file = str(file)
    lines, notes = _lines(read_data_file(file), file)
    by_name = {each.name: each for each in wanted}
    groups = [[by_name[name] for name in group] for group in needed]
    separator, header, rows = _with_header(lines, notes, groups, file)
    rows, units = _without_units(header, rows, wanted)
    columns = find_columns(header.cells, wanted, units, file, header.line)
    _refuse_longer(header, rows, separator, columns, file)
    return CsvTable(file, columns, tuple(rows), separator)


def _lines(text, file):
    """([(number, line)] without blank lines and comments, [(number, line)] of the comments without their sign)."""
    lines, notes = [], []
    for line_number, line in enumerate(text.splitlines(), 1):
        if line.lstrip().startswith(COMMENT):
            notes.append((line_number, line.strip().lstrip("#%/ ")))
        elif line.strip(" \t\r\n\x00"):
            lines.append((line_number, line))
    return lines, notes


def _with_header(lines, notes, groups, file):
    """(separator, header, rows below it), by the first separator with which a line has a column of each group."""
    declared = re.fullmatch(r'\s*"?sep=(.)"?\s*', lines[0][1], re.IGNORECASE) if lines else None
    lines = lines[1:] if declared else lines
    for separator in (declared[1],) if declared else SEPARATORS:
        rows = list(_rows(lines[:SEARCHED], separator, file))
        for place, row in enumerate(rows, 1):
            if _has_all(row, groups) and (separator != " " or declared or _as_wide(row, rows[place : place + 1])):
                below = [each for each in lines if each[0] > row.end]
                return separator, row, list(_rows(below, separator, file))
        for note in _rows(notes[:SEARCHED], separator, file):
            if _has_all(note, groups) and rows and len(rows[0].cells) >= 2:
                return separator, note, list(_rows(lines, separator, file))
    raise SpecError(_no_header(lines, groups, file), file=file)


def _as_wide(row, below):
    """Whether the row below has as many cells; words of a sentence are no columns."""
    return not below or len(below[0].cells) == len(row.cells)


def _has_all(row, groups):
    return len(row.cells) > 1 and _columns_in(row, groups) == len(groups)


def _no_header(lines, groups, file):
    """What to say of a file in which no line has the wanted headings: of the line that looks most like them."""
    example = ",".join(group[0].heading for group in groups)
    if not lines:
        return f"is empty; the first line must name the columns, e.g. {example}"
    first = next((number for number, (_, text) in enumerate(lines[:SEARCHED]) if _has_numbers_alone(text, file)), len(lines))
    if first == 0:
        line, text = lines[0]
        return f"line {line}: {brief(text)} has numbers alone; the first line must name the columns with their units, e.g. {example}"
    separator = _separator(lines[min(first, len(lines) - 1)][1])
    above = list(_rows(lines[:first], separator, file)) if first < len(lines) else list(_rows(lines[:1], _separator(lines[0][1]), file))
    header = max(above, key=lambda row: (len(row.cells) > 1, _columns_in(row, groups), not _in_brackets(row.cells), row.line))
    text = dict(lines)[header.line].strip()
    missing = next((group for group in groups if not any(has_column(header.cells, each) for each in group)), None)
    if missing is None:
        return f"line {header.line}: {brief(text)} has {len(header.cells)} cells between blanks, but the row below it has another number"
    return no_column(missing, header.cells, header.line, text, [group[0] for group in groups], ";" if separator == ";" else ",")


def _has_numbers_alone(text, file):
    """Whether a line is a row of numbers."""
    cells = next(iter(_rows([(1, text)], _separator(text), file))).cells
    return all(NUMBER.fullmatch(cell.strip().replace(",", ".")) for cell in cells if cell.strip())


def _separator(text):
    return next((each for each in SEPARATORS if each in text.strip()), ",")


def _columns_in(row, groups):
    """How many of the groups of columns a row has."""
    return sum(any(has_column(row.cells, each) for each in group) for group in groups)


def _in_brackets(cells):
    """Whether a row has units in brackets alone."""
    return all(cell.strip()[:1] in "[(" for cell in cells if cell.strip())


def _rows(lines: Sequence[tuple[int, str]], separator: str, file: str) -> Iterator[Row]:
    """The rows of lines (number, text)."""
    if separator == " ":
        yield from (Row(line, line, _blank_separated(text)) for line, text in lines)
        return
    reader, before = csv.reader(_texts(lines), delimiter=separator, skipinitialspace=True), 0
    try:
        for cells in reader:
            if any(cell.strip() for cell in cells):
                yield Row(lines[before][0], lines[reader.line_num - 1][0], cells)
            before = reader.line_num
    except csv.Error as error:
        line = lines[min(max(reader.line_num, 1), len(lines)) - 1][0]
        raise SpecError(f"line {line}: cannot be read as CSV: {error}", file=file) from None


def _texts(lines: Iterable[tuple[int, str]]) -> Iterator[str]:
    return (f"{text}\n" for _, text in lines)


def _blank_separated(text):
    """Cells between blanks; a bracket, or what stands in quotes, belongs to the word before it."""
    if len(wide := re.split(r"\s{2,}", text.strip())) > 1:
        return [cell.strip("\"'") for cell in wide]
    return [cell.strip("\"'") for cell in re.findall(r"\"[^\"]*\"|[^\s\[({<]*\s*[\[({<][^\])}>]*[\])}>]|\S+", text.strip())]


def _without_units(header, rows, wanted):
    """(rows, units): a row of units below the headings is taken out."""
    places = [place for place, cell in enumerate(header.cells) if any(has_column([cell], each) and _measured(each) for each in wanted)]
    bare = [place for place in places if not unit_in_brackets(header.cells[place])]
    if rows and bare and says_units(rows[0].cells, bare):
        return rows[1:], rows[0].cells
    return rows, []


def _measured(each):
    return not {PURE, TEXT} & set(each.units)


def _refuse_longer(header, rows, separator, columns, file):
    """Rows with more cells than headings: a comma that is a decimal sign, or a text without quotes."""
    width = len(header.cells)
    for row in rows:
        if len(row.cells) == width or separator != " " and len(row.cells) < width:
            continue
        used = len(row.cells) if separator == " " else max((n + 1 for n, cell in enumerate(row.cells) if cell.strip()), default=0)
        if used > width or separator == " " and used != width:
            between = NAMES.get(separator, repr(separator))
            hint = "; where the comma is the decimal sign, separate the columns by semicolons" if separator == "," else ""
            raise SpecError(
                f"line {row.line}: {used} cells between {between}s, but the headings of line {header.line} are "
                f"{width}{hint}; put a text that contains the separator in quotes",
                file=file,
            )
