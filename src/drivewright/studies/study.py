"""A study that has been run, whole or in part: its spec, its plan, and a row for every case that is there."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from drivewright.errors import UnknownName
from drivewright.spec import MechanismSpec
from drivewright.studies.plan import Plan

CASE, STATUS, MESSAGE, CHECK = "case", "status", "message", "check."


def first_fields():
    """The pyarrow fields that every study's table begins with."""
    import pyarrow as pa

    rows = ((CASE, pa.int64(), "-", "number of the case"), (STATUS, pa.string(), "", "complete, partial or failed"),
            (MESSAGE, pa.string(), "", "why it is not complete, or what was left out"))
    return [pa.field(name, kind, metadata={"unit": unit, "meaning": meaning}) for name, kind, unit, meaning in rows]


@dataclass(frozen=True, eq=False)
class Study:
    """The rows of a study, sorted by case; `table` is a pyarrow.Table with unit and meaning in the metadata of every field."""

    spec: MechanismSpec
    plan: Plan
    table: Any
    folder: Path | None = None
    seconds: float = 0.0  # that the workers spent on it
    remarks: tuple = ()  # on how the cases were computed
    interrupted: bool = False

    def __getitem__(self, name):
        """A column as an array: numbers as floats with nan where a case has none, texts as objects."""
        import pyarrow as pa

        if name not in self.table.column_names:
            raise UnknownName("column of the study", name, self.table.column_names)
        column = self.table[name]
        if pa.types.is_floating(column.type) or pa.types.is_null(column.type):
            return column.to_numpy().astype(float)
        return column.to_numpy()

    def __len__(self):
        return self.table.num_rows

    def __repr__(self):
        """One line: how many cases are there, and what became of them."""
        return f"<Study of {self.spec.mechanism!r}: {len(self)} of {len(self.plan)} cases, {self.counts}>"

    @property
    def counts(self):
        """{status: number of cases}."""
        names, counts = np.unique(self[STATUS].astype(str), return_counts=True) if len(self) else (np.array([]), np.array([]))
        return dict(zip(names.tolist(), counts.tolist(), strict=True))

    @property
    def answered(self):
        """Whether any case has an answer."""
        return len(self) > 0 and bool(np.any(self[STATUS] != "failed"))

    @property
    def complete(self):
        """Whether every case of the plan has its row."""
        return len(self) == len(self.plan)

    @property
    def value_names(self):
        """Names of the columns that hold values of the result."""
        inputs = {CASE, STATUS, MESSAGE, *self.plan.keys}
        return tuple(name for name in self.table.column_names if name not in inputs and not name.startswith(CHECK))

    @property
    def check_names(self):
        """Names of the design checks, without the `check.` of their columns."""
        return tuple(name.removeprefix(CHECK) for name in self.table.column_names if name.startswith(CHECK))

    def unit(self, name):
        """SI unit of a column."""
        return self._about(name, b"unit")

    def meaning(self, name):
        """What a column is."""
        return self._about(name, b"meaning")

    def _about(self, name, what):
        if name not in self.table.column_names:
            raise UnknownName("column of the study", name, self.table.column_names)
        return (self.table.schema.field(name).metadata or {}).get(what, b"").decode()
