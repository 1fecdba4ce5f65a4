"""The rows of a study in its folder: a table in memory where they are few, else read part by part where they are wanted."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from drivewright.errors import InputError
from drivewright.execution.case_table import case_fields
from drivewright.studies.parts import Damaged, Part, checked_part, columns_of, damage_text, read_part
from drivewright.studies.store import completed, joined

if TYPE_CHECKING:
    import pyarrow as pa

T = TypeVar("T")

HELD = 4_000_000  # cells of a study's table that are held in memory
SLICE = 200_000  # rows of a table in memory that are looked at together


class StoredRows:
    """Rows of many parts; requested rows are read and their checksum is verified each time, one part after another."""

    def __init__(self, parts_folder: Path, parts: Sequence[Part]) -> None:
        self._folder, self._parts = parts_folder, tuple(parts)

    @property
    def num_rows(self) -> int:
        """How many there are."""
        return sum(part.count for part in self._parts)

    @cached_property
    def schema(self) -> pa.Schema:
        """All columns in the order in which the parts bring them."""
        return joined([self._told(columns_of, part).empty_table() for part in self._parts]).schema

    def batches(self, names: Sequence[str] | None = None, first: int = 0, stop: int | None = None) -> Iterator[pa.Table]:
        """The rows of the cases from `first` up to `stop` in pieces, all columns or some; a column that a part lacks is null."""
        import pyarrow as pa

        schema = self.schema if names is None else pa.schema([self.schema.field(name) for name in names])
        for part in self._parts:
            low, high = max(first, part.first), part.first + part.count if stop is None else min(stop, part.first + part.count)
            if low < high:
                table = self._told(read_part, part, None if names is None else schema.names)
                yield completed(table, schema).slice(low - part.first, high - low)

    def _told(self, read: Callable[..., T], part: Part, *more: Any) -> T:
        """What `read` gives of a part; InputError where it is damaged."""
        try:
            return read(self._folder, part, *more)
        except Damaged as damage:
            raise InputError(damage_text(self._folder.parent, {part: str(damage)})) from None

    def column(self, name: str) -> pa.ChunkedArray:
        """One column in memory."""
        import pyarrow as pa

        pieces = [piece for table in self.batches([name]) for piece in table[name].chunks]
        return pa.chunked_array(pieces, self.schema.field(name).type)

    def whole(self) -> pa.Table:
        """All rows in memory."""
        import pyarrow as pa

        return pa.concat_tables([self.schema.empty_table(), *self.batches()])


def rows_of_parts(parts_folder: Path, parts: Iterable[Part]) -> tuple[pa.Table | StoredRows, dict[Part, str]]:
    """(rows of the parts that are whole, {part: reason} of the others)."""
    found, held, damaged, cells = [], [], {}, 0
    for part in parts:
        try:
            if cells <= HELD:
                held.append(read_part(parts_folder, part))
                cells += held[-1].num_rows * held[-1].num_columns
            else:
                held = []
                checked_part(parts_folder, part)
            found.append(part)
        except Damaged as damage:
            damaged[part] = str(damage)
    return (joined(held) if cells <= HELD else StoredRows(parts_folder, found)), damaged


def batches_of(
    rows: pa.Table | StoredRows, names: Sequence[str] | None = None, first: int = 0, stop: int | None = None
) -> Iterator[pa.Table]:
    """Rows in pieces, wherever they are: those of the cases from `first` up to `stop`, all columns or some."""
    if isinstance(rows, StoredRows):
        yield from rows.batches(names, first, stop)
        return
    import pyarrow.compute as pc

    chosen = rows if names is None else rows.select(list(names))
    if first or stop is not None:
        case = rows[case_fields()[0].name]
        inside = pc.call_function("greater_equal", [case, first])
        if stop is not None:
            inside = pc.call_function("and", [inside, pc.call_function("less", [case, stop])])
        chosen = chosen.filter(inside)
    for start in range(0, chosen.num_rows, SLICE):
        yield chosen.slice(start, SLICE)
