"""Two columns of a CSV file by name, each with its unit: "displacement [um],force [N]"; read by `csv_table`."""

from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.errors import SpecError
from drivewright.spec import csv_words
from drivewright.spec.csv_headings import PURE, Wanted
from drivewright.spec.csv_table import CsvTable, read_csv
from drivewright.units import BY_NAME

__all__ = ["PURE", "ColumnPair", "read_columns"]
OTHER_NAMES = {  # of columns, as others write them
    "angle": ("theta", "phi", "rotation", "crank", *csv_words.ANGLE, *csv_words.CRANK_ANGLE),
    "time": ("t", *csv_words.TIME),
    "speed": ("angular velocity", "angular speed", "omega", "rotational speed", "n", *csv_words.SPEED),
    "velocity": csv_words.VELOCITY,
    "torque": ("moment", *csv_words.TORQUE),
    "force": ("load", *csv_words.FORCE),
    "travel": ("displacement", "position", "stroke", "x", "Hub", *csv_words.TRAVEL),
    "displacement": ("travel", "deflection", "x", *csv_words.TRAVEL),
    "factor": csv_words.FACTOR,
}


class ColumnPair(NamedTuple):
    """Two columns of a file with their names [SI]: x increases."""

    x_name: str
    x: Floats
    y_name: str
    y: Floats


def read_columns(file: str | Path, x_names: Mapping[str, str], y_names: Mapping[str, str]) -> ColumnPair:
    """The `ColumnPair` of a CSV file with one column of `x_names` and one of `y_names`, each name -> dimension; x must increase."""
    wanted = [_wanted(name, dimension) for name, dimension in {**x_names, **y_names}.items()]
    table = read_csv(file, wanted, (tuple(x_names), tuple(y_names)))
    x_name, y_name = _first(table, x_names), _first(table, y_names)
    x, y = table.numbers(x_name), table.numbers(y_name)
    _refuse_disorder(table, x, x_name)
    return ColumnPair(x_name, x, y_name, y)


def _first(table: CsvTable, names: Mapping[str, str]) -> str:
    """The name whose column comes first."""
    return min((name for name in names if name in table), key=lambda name: table.columns[name].place)


def _wanted(name, dimension):
    unit = "" if dimension == PURE else BY_NAME[dimension].display_unit
    return Wanted(name, {dimension: unit}, OTHER_NAMES.get(name, ()))


def _refuse_disorder(table: CsvTable, x: Floats, name: str) -> None:
    if len(x) < 2:
        raise SpecError(f"{len(x)} rows are too few; give at least 2", file=table.file)
    if np.any(np.diff(x) <= 0):
        row = int(np.argmax(np.diff(x) <= 0)) + 1
        before, now = (table.cells(name)[each].text.strip() for each in (row - 1, row))
        raise SpecError(
            f"row {row + 1} (line {table.lines[row]}): the {name} must increase from row to row, but {now!r} follows {before!r}; sort the "
            "rows and drop repeats",
            file=table.file,
        )
