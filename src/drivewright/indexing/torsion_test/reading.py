"""A torsion test as a CSV file: `torque [N m],angle [arcmin]`, in the order of measuring.

Further columns: `force [N]` in place of the torque, with the arm given apart; `cycle` (whole numbers); `branch` (loading or unloading);
`crank [deg]`, the position of the input at which the loop was taken.  Other columns are left alone; how the file may be written says
`spec.csv_table`.
"""

from collections.abc import Collection
from os import PathLike
from pathlib import Path
from typing import NamedTuple

import numpy as np

from drivewright._typing import Bools, Floats, Ints
from drivewright.errors import SpecError, brief
from drivewright.spec import csv_words
from drivewright.spec.csv_headings import PURE, TEXT, Wanted
from drivewright.spec.csv_table import CsvTable, read_csv

QUANTITIES = {"torque": ("torque", "N m"), "force": ("force", "N"), "angle": ("angle", "arcmin"), "crank": ("angle", "deg")}
OTHER_NAMES = {"torque": csv_words.TORQUE, "force": csv_words.FORCE, "angle": csv_words.ANGLE, "crank": csv_words.CRANK_ANGLE}
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


WANTED = (
    *(Wanted(name, {dimension: unit}, OTHER_NAMES[name]) for name, (dimension, unit) in QUANTITIES.items()),
    Wanted("cycle", {PURE: ""}),
    Wanted("branch", {TEXT: ""}),
)


def read_test(file: str | PathLike[str], arm: float | None = None) -> Readings:
    """The `Readings` of a CSV file; `arm` [m] turns a column of forces into torques.  SpecError names file, line and column."""
    table = read_csv(Path(file), WANTED, (("torque", "force"), ("angle",)))
    _refuse_load(table.columns, arm, file)
    if len(table.rows) > LARGEST:
        raise SpecError(f"{len(table.rows)} samples are too many; give at most {LARGEST}, for instance every tenth", file=str(file))
    torque = table.numbers("force") * arm if arm is not None else table.numbers("torque")
    cycle, branch = (_whole(table) if "cycle" in table else None), (_branch(table) if "branch" in table else None)
    return Readings(torque, table.numbers("angle"), cycle, branch, table.numbers("crank") if "crank" in table else None)


def _refuse_load(columns: Collection[str], arm: float | None, file: str | PathLike[str]) -> None:
    if "force" in columns and "torque" in columns:
        raise SpecError("has both a torque and a force; keep one of the columns", file=str(file))
    if "force" in columns and arm is None:
        raise SpecError("the load is a force; give the length of its arm as well, e.g. 500 mm", file=str(file))
    if "torque" in columns and arm is not None:
        raise SpecError("the load is a torque already; an arm belongs to a column 'force [N]'", file=str(file))


def _whole(table: CsvTable) -> Ints:
    """Whole numbers of the cycles."""
    numbers = table.numbers("cycle")
    for cell, value in zip(table.cells("cycle"), numbers, strict=True):
        if value != round(value):
            raise SpecError(f"line {cell.line}: the cycle is {brief(cell.text.strip())}, not a whole number", file=table.file)
    return numbers.astype(int)


def _branch(table: CsvTable) -> Ints:
    """+1 loading, -1 unloading."""
    cells = table.cells("branch")
    for cell in cells:
        text = cell.text.strip()
        if text.lower() not in BRANCHES:
            shown = brief(text) if text else "missing"
            raise SpecError(f"line {cell.line}: the branch is {shown}, not 'loading' or 'unloading'", file=table.file)
    return np.array([BRANCHES[cell.text.strip().lower()] for cell in cells], dtype=int)
