"""Two columns of a CSV file by name, each with its unit in brackets in the header: "displacement [um],force [N]"."""

import math
import re
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.errors import SpecError, UnitError, brief
from drivewright.spec.csv_text import csv_rows, read_data_file
from drivewright.units import unit_factor

PURE = "a pure number"


class ColumnPair(NamedTuple):
    """Two columns of a file with their names [SI]: x increases."""

    x_name: str
    x: Floats
    y_name: str
    y: Floats


def read_columns(file: str | Path, x_names: Mapping[str, str], y_names: Mapping[str, str]) -> ColumnPair:
    """The `ColumnPair` of a CSV file with one column of `x_names` and one of `y_names`, each name -> dimension; x must increase."""
    rows = csv_rows(read_data_file(file).splitlines(), file)
    _, header = next(rows, (0, []))
    columns = [_column(header, names, file) for names in (x_names, y_names)]
    numbers = [[_number(cells, index, f"line {line}", name, file) for index, name, _ in columns] for line, cells in rows]
    table = np.array(numbers, dtype=float).reshape(-1, 2) * [factor for _, _, factor in columns]
    _refuse_disorder(table, columns[0][1], file)
    return ColumnPair(columns[0][1], table[:, 0], columns[1][1], table[:, 1])


def _column(header, names, file):
    """(index, name, factor to SI) of the first column that has one of the names."""
    for index, cell in enumerate(header):
        match = re.fullmatch(r"\s*([a-z]+)\s*(?:\[(.+)\])?\s*", cell, re.IGNORECASE)
        if match and match[1].lower() in names:
            return index, match[1].lower(), _factor(match[2], names[match[1].lower()], match[1], file)
    expected = " or ".join(repr(name if dimension == PURE else f"{name} [unit]") for name, dimension in names.items())
    raise SpecError(f"no column {expected} in the first line {brief(','.join(header))}", file=str(file))


def _factor(unit, dimension, name, file):
    if dimension == PURE:
        return 1.0
    try:
        return unit_factor(unit or "", dimension)
    except UnitError as error:
        raise error.located(key=f"column '{name}'", file=str(file)) from None


def _number(cells, index, place, name, file):
    try:
        number = float(cells[index])
    except (ValueError, IndexError):
        number = math.nan
    if not math.isfinite(number):
        got = brief(cells[index]) if index < len(cells) else "nothing"
        raise SpecError(f"{place}: the {name} is {got}, not a finite number", file=str(file))
    return number


def _refuse_disorder(table, name, file):
    if len(table) < 2:
        raise SpecError(f"{len(table)} rows are too few; give at least 2", file=str(file))
    if np.any(np.diff(table[:, 0]) <= 0):
        row = int(np.argmax(np.diff(table[:, 0]) <= 0)) + 2
        raise SpecError(f"row {row}: the {name} must increase from row to row; sort the rows and drop repeats", file=str(file))
