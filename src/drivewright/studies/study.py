"""A study that has been run, whole or in part: its spec, its plan, and a row for every case that is there."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import tee
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from drivewright._typing import Floats
from drivewright.errors import UnknownName
from drivewright.execution.case_reasons import ReasonGroup, reason_groups
from drivewright.execution.case_table import CASE, MESSAGE, STATUS
from drivewright.execution.outputs import CHECK
from drivewright.labels import label_of
from drivewright.result import ERROR, HIGH, LOW
from drivewright.spec import MechanismSpec
from drivewright.studies.plan import Plan
from drivewright.studies.statistics import NORMAL
from drivewright.studies.stored_rows import StoredRows, batches_of

if TYPE_CHECKING:
    import pandas as pd
    import pyarrow as pa
    import xarray as xr

MOST_SHOWN = 100_000  # rows of a study that a notebook analyses to show it
BOUNDS = b"bounds"  # in the metadata of a column that is an end of an interval, or a standard error: the name of the column whose it is


@dataclass(frozen=True, eq=False)
class Study:
    """The rows of a study, sorted by case, with unit, label and meaning in the metadata of every field; many of them stay on the disk."""

    spec: MechanismSpec
    plan: Plan
    rows: pa.Table | StoredRows
    folder: Path | None = None
    seconds: float = 0.0  # that the workers spent on it
    remarks: tuple[str, ...] = ()  # on how the cases were computed
    interrupted: bool = False
    notices: tuple[str, ...] = ()  # what was damaged in its folder, and what became of it
    damaged: int = 0  # parts that are left out

    def __getitem__(self, name: str) -> NDArray[Any]:
        """A column as an array: numbers as floats with nan where a case has none, texts as objects."""
        import pyarrow as pa

        if name not in self.column_names:
            raise UnknownName("column of the study", name, self.column_names)
        column = self.rows.column(name)
        if pa.types.is_floating(column.type) or pa.types.is_null(column.type):
            return column.to_numpy().astype(float)
        return column.to_numpy()

    def __len__(self) -> int:
        return self.rows.num_rows

    @property
    def table(self) -> pa.Table:
        """All rows in memory, as a pyarrow.Table."""
        return self.rows.whole() if isinstance(self.rows, StoredRows) else self.rows

    @property
    def schema(self) -> pa.Schema:
        """The columns, with unit, label and meaning in the metadata of each."""
        return self.rows.schema

    @property
    def column_names(self) -> list[str]:
        """Names of the columns."""
        return self.rows.schema.names

    def batches(self, names: Sequence[str] | None = None, first: int = 0, stop: int | None = None) -> Iterator[pa.Table]:
        """The rows of the cases from `first` up to `stop` in pieces that need little memory, all columns or some."""
        return batches_of(self.rows, names, first, stop)

    def to_pandas(self) -> pd.DataFrame:
        """A frame with a row per case, in SI; `attrs` has units and labels of its columns.  MissingExtra without the extra 'frames'."""
        from drivewright.studies.study_frames import study_frame

        return study_frame(self)

    def to_xarray(self) -> xr.Dataset:
        """A dataset with an axis per key of the grid, in SI with `units` and `long_name`; sampled points lie along "sample"."""
        from drivewright.studies.study_frames import study_dataset

        return study_dataset(self)

    def __repr__(self) -> str:
        """One line: how many cases are there, and what became of them."""
        return f"<Study of {self.spec.mechanism!r}: {len(self)} of {len(self.plan)} cases, {self.counts}>"

    def _repr_html_(self) -> str:
        """A card for notebooks: cases done and failed, what varies, the main plot and between which ends the values lie."""
        from drivewright.notebook import study_card
        from drivewright.studies.answers import analyse_study

        return study_card(self, analyse_study(self) if self.answered and len(self) <= MOST_SHOWN else None)

    @property
    def counts(self) -> dict[str, int]:
        """{status: number of cases}."""
        return self._counts

    @cached_property
    def _counts(self) -> dict[str, int]:
        counts: Counter[str] = Counter()
        for table in self.batches([STATUS]):
            for each in table[STATUS].value_counts().to_pylist():
                counts[each["values"]] += each["counts"]
        return dict(sorted(counts.items()))

    def reasons(self) -> list[ReasonGroup]:
        """Why cases are not complete, the commonest reason first."""
        import pyarrow.compute as pc

        def incomplete():
            for table in self.batches([STATUS, MESSAGE]):
                chosen = table.filter(pc.call_function("not_equal", [table[STATUS], "complete"]))
                yield from zip(chosen[STATUS].to_pylist(), chosen[MESSAGE].to_pylist(), strict=True)

        rows, again = tee(incomplete())
        return reason_groups((status for status, _ in rows), (message for _, message in again))

    @property
    def answered(self) -> bool:
        """Whether any case has an answer."""
        return any(status != "failed" for status in self.counts)

    @property
    def complete(self) -> bool:
        """Whether every case of the plan has its row."""
        return len(self) == len(self.plan)

    @property
    def value_names(self) -> tuple[str, ...]:
        """Names of the columns that hold values of the result; the ends of their intervals are not among them."""
        inputs = {CASE, STATUS, MESSAGE, *self.plan.keys}
        return tuple(name for name in self._outputs if name not in inputs and not name.startswith(CHECK))

    @property
    def check_names(self) -> tuple[str, ...]:
        """Names of the design checks, without the `check.` of their columns."""
        return tuple(name.removeprefix(CHECK) for name in self._outputs if name.startswith(CHECK))

    @property
    def _outputs(self) -> list[str]:
        """Names of the columns that belong to no other one."""
        return [field.name for field in self.schema if BOUNDS not in (field.metadata or {})]

    def bounds(self, name: str) -> tuple[Floats, Floats] | None:
        """(low, high): the ends of the 95 % intervals of a column (rows,), nan where a case has none; None where no case has one."""
        low, high = f"{name}{LOW}", f"{name}{HIGH}"
        if any(end not in self.column_names or self._about(end, BOUNDS) != name for end in (low, high)):
            return None
        return np.asarray(self[low], float), np.asarray(self[high], float)

    def errors(self, name: str) -> Floats | None:
        """Standard errors of a column (rows,): its own, or half the width of its interval over the normal quantile; None without any."""
        bounds, own = self.bounds(name), f"{name}{ERROR}"
        if bounds is None:
            return None
        half = (bounds[1] - bounds[0]) / (2 * NORMAL)
        known = own in self.column_names and self._about(own, BOUNDS) == name
        return np.where(np.isfinite(self[own]), self[own], half) if known else half

    def at_worst(self, name: str, sign: float) -> Floats:
        """The column (rows,) at the lower (sign -1) or upper (+1) end of each interval, the value where a case has none."""
        column, bounds = np.asarray(self[name], float), self.bounds(name)
        end = column if bounds is None else bounds[0 if sign < 0 else 1]
        return np.where(np.isfinite(end), end, column)

    def unit(self, name: str) -> str:
        """SI unit of a column."""
        return self._about(name, b"unit")

    def meaning(self, name: str) -> str:
        """What a column is."""
        return self._about(name, b"meaning")

    def label(self, name: str) -> str:
        """The label of a column, the first phrase of its meaning where it has none of its own."""
        return label_of(self.meaning(name), self._about(name, b"label"))

    def _about(self, name: str, what: bytes) -> str:
        if name not in self.column_names:
            raise UnknownName("column of the study", name, self.column_names)
        return (self.schema.field(name).metadata or {}).get(what, b"").decode()
