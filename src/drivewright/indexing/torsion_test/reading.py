"""A torsion test as a CSV file: `torque [N m],angle [arcmin]`, in the order of measuring.

Further columns: `force [N]` in place of the torque, with the arm given apart; `cycle` (whole numbers); `branch` (loading or unloading);
`crank [deg]`, the position of the input at which the loop was taken.  Lines that begin with # are comments; other columns are left alone.
"""

import math
import re
from collections.abc import Sequence
from os import PathLike
from typing import NamedTuple

import numpy as np

from drivewright._typing import Bools, Floats, Ints
from drivewright.errors import SpecError, UnitError, brief, nearest
from drivewright.spec.csv_text import csv_rows, read_data_file
from drivewright.units import unit_factor

QUANTITIES = {"torque": ("torque", "N m"), "force": ("force", "N"), "angle": ("angle", "arcmin"), "crank": ("angle", "deg")}
COLUMNS = (*QUANTITIES, "cycle", "branch")
BRANCHES = {"loading": 1, "unloading": -1}
LARGEST = 200_000  # samples


class Readings(NamedTuple):
    """Samples (n,) in the order of measuring: torque [N m], angle [rad].

    Where the file says so: cycle (whole number of each sample), branch (+1 loading, -1 unloading), crank [rad] (angle of the input).
    """

    torque: Floats
    angle: Floats
    cycle: Ints | None = None
    branch: Ints | None = None
    crank: Floats | None = None

    def select(self, samples: Bools) -> "Readings":
        """The readings of some samples (mask)."""
        return Readings(
            self.torque[samples],
            self.angle[samples],
            None if self.cycle is None else self.cycle[samples],
            None if self.branch is None else self.branch[samples],
            None if self.crank is None else self.crank[samples],
        )


class _Column(NamedTuple):
    place: int
    factor: float


def read_test(file: str | PathLike[str], arm: float | None = None) -> Readings:
    """The `Readings` of a CSV file; `arm` [m] turns a column of forces into torques.  SpecError names file, line and column."""
    rows = list(_rows(file))
    if not rows:
        raise SpecError("is empty; the first line wants the columns, e.g. torque [N m],angle [arcmin]", file=str(file))
    columns = _columns(rows[0][1], file)
    _refuse_load(columns, arm, file)
    cells = [_cells(line, row, columns, file) for line, row in rows[1:]]
    if len(cells) > LARGEST:
        raise SpecError(f"{len(cells)} samples; give at most {LARGEST}, every tenth will do", file=str(file))
    found = {name: np.array([row[name] for row in cells]) for name in columns}
    torque = found["force"] * arm if "force" in columns else found["torque"]
    return Readings(torque, found["angle"], *(found.get(name) for name in ("cycle", "branch", "crank")))


def _rows(file):
    """(number of the line, cells) of every line that is neither blank nor a comment."""
    for number, line in enumerate(read_data_file(file).splitlines(), 1):
        if line.strip() and not line.lstrip().startswith("#"):
            yield number, next(csv_rows([line], file))[1]


def _columns(header: Sequence[str], file: str | PathLike[str]) -> dict[str, _Column]:
    """Name -> `_Column` of what the header has of ours."""
    found = {}
    for index, cell in enumerate(header):
        parts = re.fullmatch(r"\s*([^\[]*?)\s*(?:\[(.*)\])?\s*", cell, re.DOTALL)
        name, unit = parts.groups() if parts else (cell.partition("[")[0].strip(), None)  # a bracket that is not closed
        if name.lower() in COLUMNS:
            if name.lower() in found:
                raise SpecError(f"column '{name}' is there twice", file=str(file))
            found[name.lower()] = _Column(index, _factor(name.lower(), unit, file))
    for wanted in ("torque", "angle"):
        if wanted not in found and not (wanted == "torque" and "force" in found):
            hint = nearest(wanted, [cell.partition("[")[0].strip() for cell in header])
            column = f"{wanted} [{QUANTITIES[wanted][1]}]"
            raise SpecError(f"no column {column!r} in the first line {brief(','.join(header))}{hint}", file=str(file))
    return found


def _factor(name, unit, file):
    if name not in QUANTITIES:
        return 1.0
    dimension, example = QUANTITIES[name]
    if not unit or not unit.strip():
        raise UnitError(f"has no unit; write '{name} [{example}]'", key=f"column '{name}'", file=str(file))
    try:
        return unit_factor(unit, dimension)
    except UnitError as error:
        raise error.located(key=f"column '{name}'", file=str(file)) from None


def _refuse_load(columns, arm, file):
    if "force" in columns and "torque" in columns:
        raise SpecError("has both a torque and a force; keep one of the columns", file=str(file))
    if "force" in columns and arm is None:
        raise SpecError("the load is a force; give the length of its arm as well, e.g. 500 mm", file=str(file))
    if "torque" in columns and arm is not None:
        raise SpecError("the load is a torque already; an arm belongs to a column 'force [N]'", file=str(file))


def _cells(line, row, columns, file):
    """Name -> value of one line."""
    readers = {"cycle": _whole, "branch": _branch}
    found = {}
    for name, column in columns.items():
        text = row[column.place].strip() if column.place < len(row) else ""
        try:
            found[name] = readers.get(name, _finite)(text) * column.factor
        except ValueError as error:
            raise SpecError(f"line {line}: the {name} is {brief(text) if text else 'missing'}, not {error}", file=str(file)) from None
    return found


def _finite(text):
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise ValueError("a finite number")
    return value


def _whole(text):
    value = _finite(text)
    if value != round(value):
        raise ValueError("a whole number")
    return int(value)


def _branch(text):
    if text.lower() not in BRANCHES:
        raise ValueError("'loading' or 'unloading'")
    return BRANCHES[text.lower()]
