"""Storage of the parts of a study, or of a search, as they are done: a folder (`study_folder`), or nothing but memory."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from drivewright.execution.case_table import case_fields

if TYPE_CHECKING:
    import pyarrow as pa

    from drivewright.studies.stored_rows import StoredRows


class Store(Protocol):
    """Where the parts of a study, or of a search, go as they are done."""

    @property
    def folder(self) -> Path | None:
        """Its folder; None in memory."""
        ...

    @property
    def seconds(self) -> float:
        """That workers spent on what is there."""
        ...

    def ranges(self) -> list[tuple[int, int]]:
        """Sorted (first, count) of what is there."""
        ...

    def add(self, first: int, table: pa.Table, seconds: float) -> None:
        """Keep a part."""
        ...

    def remark(self, texts: Iterable[str]) -> None:
        """Keep remarks on the study."""
        ...

    def remarks(self) -> tuple[str, ...]:
        """What was remarked."""
        ...

    def tables(self) -> list[pa.Table]:
        """All parts in the order of their cases."""
        ...

    def rows(self) -> pa.Table | StoredRows:
        """All rows in the order of their cases; not in memory where they are many and in a folder."""
        ...

    @property
    def notices(self) -> Sequence[str]:
        """What was found damaged at this start, and what became of it."""
        ...

    def close(self) -> None:
        """Let go of what it holds."""
        ...


class Memory:
    """The parts of a study that is not kept."""

    folder: Path | None = None
    notices: Sequence[str] = ()
    seconds: float

    def __init__(self) -> None:
        self._parts: dict[int, pa.Table] = {}
        self.seconds, self._remarks = 0.0, ()

    def ranges(self) -> list[tuple[int, int]]:
        """Sorted (first, count) of what is there."""
        return [(first, table.num_rows) for first, table in sorted(self._parts.items())]

    def add(self, first: int, table: pa.Table, seconds: float) -> None:
        """Keep a part."""
        self._parts[first] = table
        self.seconds += seconds

    def remark(self, texts: Iterable[str]) -> None:
        """Keep the notices about the study."""
        self._remarks = tuple(dict.fromkeys((*self._remarks, *texts)))

    def remarks(self) -> tuple[str, ...]:
        """What was kept."""
        return self._remarks

    def tables(self) -> list[pa.Table]:
        """All parts in the order of their cases."""
        return [table for _, table in sorted(self._parts.items())]

    def rows(self) -> pa.Table:
        """All rows in the order of their cases."""
        return joined(self.tables())

    def close(self) -> None:
        """Nothing to let go."""


def joined(tables: Sequence[pa.Table]) -> pa.Table:
    """One table of all parts: columns in the order in which the cases bring them, null where a case has none."""
    import pyarrow as pa

    fields = {} if tables else {field.name: field for field in case_fields()}
    for table in tables:
        for field in table.schema:
            fields.setdefault(field.name, field)
    schema = pa.schema(list(fields.values()))
    return pa.concat_tables([completed(table, schema) for table in tables]) if tables else schema.empty_table()


def completed(table: pa.Table, schema: pa.Schema) -> pa.Table:
    """A table with the columns of a schema, null where it has none."""
    import pyarrow as pa

    columns = [table[f.name] if f.name in table.column_names else pa.nulls(table.num_rows, f.type) for f in schema]
    return pa.Table.from_arrays(columns, schema=schema)
