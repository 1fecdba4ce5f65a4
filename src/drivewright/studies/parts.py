"""The parts of a study: Parquet files that say which study they belong to, which cases they hold, and whether a bit of them has changed.

Three checksums: the SHA-256 of the file, which the ledger keeps; one of each page, which any reader of Parquet can check; and one
of the numbers themselves in the file's metadata, beside the digest of the study, so that a part is worth something without its ledger.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from drivewright.atomic import replacing
from drivewright.execution.case_table import CASE

if TYPE_CHECKING:
    import pyarrow as pa

MARK = b"drivewright.part"  # key in the metadata of the file
NAME = re.compile(r"(\d{12})-(\d{12})\.parquet")
TOLD = 3  # damaged parts that are named
CHANGED = "its bytes are not those that were written"


@dataclass(frozen=True)
class Part:
    """A part as the ledger has it; `size` [bytes] and `sha256` of the file, None where an older version wrote it.

    `next_size` and `next_sha256` are those of the file that is about to take its place, with the same cases computed once more.
    """

    first: int
    count: int
    name: str
    size: int | None = None
    sha256: str | None = None
    next_size: int | None = None
    next_sha256: str | None = None

    @property
    def cases(self) -> str:
        """Its cases as text."""
        return f"cases {self.first} to {self.first + self.count - 1}" if self.count > 1 else f"case {self.first}"

    def overlaps(self, other: Part) -> bool:
        """Whether a case is in both."""
        return self.first < other.first + other.count and other.first < self.first + self.count


class Damaged(Exception):
    """A part is not what was written."""


class Foreign(Exception):
    """A part of another study."""


def part_name(first: int, count: int) -> str:
    """Name of the file with `count` cases from `first` on."""
    return f"{first:012d}-{first + count - 1:012d}.parquet"


def study_digest(identity: Mapping[str, str]) -> str:
    """SHA-256 of what a study is, {what: text}."""
    return hashlib.sha256(json.dumps(dict(identity), sort_keys=True).encode()).hexdigest()


def write_part(folder: Path, first: int, table: pa.Table, study: str) -> Part:
    """Write cases from `first` on into `folder`, whole or not at all; the part as the ledger wants it."""
    part, content = packed(first, table, study)
    write_content(folder, part, content)
    return part


def packed(first: int, table: pa.Table, study: str) -> tuple[Part, Any]:
    """(part as the ledger wants it, the bytes of its file) of the cases from `first` on."""
    import pyarrow as pa
    from pyarrow import parquet

    mark = {"study": study, "first": first, "count": table.num_rows, "data": data_digest(table)}
    marked = table.replace_schema_metadata({MARK: json.dumps(mark, sort_keys=True).encode()})
    sink = pa.BufferOutputStream()
    parquet.write_table(marked, sink, write_page_checksum=True)
    content = sink.getvalue()
    return Part(first, table.num_rows, part_name(first, table.num_rows), content.size, hashlib.sha256(content).hexdigest()), content


def write_content(folder: Path, part: Part, content: Any) -> None:
    """Write the file of a part, whole or not at all."""
    with replacing(folder / part.name, clear=False) as temporary:  # the folder of a study is cleared at its start
        temporary.write_bytes(content)


def checked_part(folder: Path, part: Part) -> Part:
    """The part with size and checksum of its file; Damaged where the file is not what the ledger says."""
    content = _content(folder / part.name)
    found = replace(part, size=len(content), sha256=hashlib.sha256(content).hexdigest(), next_size=None, next_sha256=None)
    if part.sha256 is None:
        _verified(content, part)
    elif not _is_expected(found, part):
        raise Damaged(CHANGED)
    return found


def _is_expected(found: Part, part: Part) -> bool:
    """Whether a file is that of the part, or the one that was to take its place."""
    return (found.size, found.sha256) in ((part.size, part.sha256), (part.next_size, part.next_sha256))


def read_part(folder: Path, part: Part, names: Sequence[str] | None = None) -> pa.Table:
    """The cases of a part, all columns or those of some names that it has; Damaged where the file is not what the ledger says."""
    content = _content(folder / part.name)
    if part.sha256 is not None and not _is_expected(
        Part(part.first, part.count, part.name, len(content), hashlib.sha256(content).hexdigest()), part
    ):
        raise Damaged(CHANGED)
    return _verified(content, part, names)


def columns_of(folder: Path, part: Part) -> pa.Schema:
    """The columns of a part."""
    import pyarrow as pa
    from pyarrow import parquet

    try:
        return parquet.read_schema(folder / part.name).remove_metadata()
    except (OSError, ValueError, pa.ArrowException) as error:
        raise Damaged(str(error).partition("\n")[0]) from None


def adopt_part(folder: Path, name: str, study: str) -> Part:
    """A part that no ledger names, as its own mark says; Damaged where this is not proven, Foreign where it is of another study."""
    content = _content(folder / name)
    table, mark = _table(content)
    if not mark:
        raise Damaged("it does not say to which study it belongs")
    if mark.get("study") != study:
        raise Foreign
    first, count = mark.get("first"), mark.get("count")
    if not isinstance(first, int) or not isinstance(count, int) or name != part_name(first, count):
        raise Damaged("its name is not that of its cases")
    if not _holds(table, first, count) or mark.get("data") != data_digest(table):
        raise Damaged(CHANGED)
    return Part(first, count, name, len(content), hashlib.sha256(content).hexdigest())


def study_of(file: Path) -> str | None:
    """Digest of the study to which a part says that it belongs; None where it does not, or cannot be read."""
    try:
        return _table(_content(file))[1].get("study")
    except Damaged:
        return None


def read_parts(folder: Path, parts: Iterable[Part]) -> tuple[list[pa.Table], dict[Part, str]]:
    """(tables of the parts that are whole, {part: reason} of the others)."""
    tables, damaged = [], {}
    for part in parts:
        try:
            tables.append(read_part(folder, part))
        except Damaged as damage:
            damaged[part] = str(damage)
    return tables, damaged


def damage_text(folder: Path, damaged: Mapping[Part, str]) -> str:
    """Which cases are not to be had, why, and what helps."""
    return f"{folder}: a part cannot be read ({reasons_of(damaged)}): {cases_of(damaged)}; the sweep's command computes its cases again"


def part_names(parts: Path) -> set[str]:
    """Names of the files that are called as parts are."""
    return {file.name for file in parts.iterdir() if NAME.fullmatch(file.name)} if parts.is_dir() else set()


def cases_of(parts: Iterable[Part]) -> str:
    """How many cases in how many parts."""
    parts = list(parts)
    count = sum(part.count for part in parts)
    return f"{count} case{'s' * (count != 1)} in {len(parts)} part{'s' * (len(parts) != 1)}"


def reasons_of(damaged: Mapping[Part, str]) -> str:
    """The first damaged parts by name, each with its cases and what is wrong with it."""
    reasons = [f"{part.name}, {part.cases}: {reason}" for part, reason in list(damaged.items())[:TOLD]]
    return "; ".join(reasons) + (f"; and {len(damaged) - TOLD} more" if len(damaged) > TOLD else "")


def data_digest(table: pa.Table) -> str:
    """SHA-256 of names, types, metadata and every cell of a table, however it is cut or packed."""
    digest = hashlib.sha256()
    for field, column in zip(table.schema, table.columns, strict=True):
        about = sorted((field.metadata or {}).items())
        digest.update(repr((field.name, str(field.type), about, len(column))).encode())
        for cells in _cells(column, field.type):
            digest.update(cells)
    return digest.hexdigest()


def _cells(column, kind):
    """The bytes of a column: which cells are null, and those that are not."""
    import pyarrow as pa

    yield np.asarray(column.is_null().to_numpy(), bool).tobytes()
    known = column.drop_null()
    if pa.types.is_string(kind):
        texts = [text.encode() for text in known.to_pylist()]
        yield np.array([len(text) for text in texts], np.int64).tobytes()
        yield b"".join(texts)
    elif not pa.types.is_null(kind):
        yield np.ascontiguousarray(known.to_numpy()).tobytes()


def _content(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except FileNotFoundError:
        raise Damaged("it is not there") from None
    except OSError as error:
        raise Damaged(error.strerror or str(error)) from None


def _table(content: bytes, names: Sequence[str] | None = None) -> tuple[pa.Table, dict[str, Any]]:
    """(cases, marks) of the bytes of a file, every page that is read checked; `names` as of `read_part`, and the numbers of the cases."""
    import pyarrow as pa
    from pyarrow import parquet

    try:
        file = parquet.ParquetFile(pa.BufferReader(content), page_checksum_verification=True)
        table = file.read(None if names is None else [name for name in file.schema_arrow.names if name in (CASE, *names)])
        mark = json.loads((table.schema.metadata or {}).get(MARK, b"{}"))
    except (OSError, ValueError, pa.ArrowException) as error:
        raise Damaged(str(error).partition("\n")[0]) from None
    return table.replace_schema_metadata(None), mark if isinstance(mark, dict) else {}


def _verified(content: bytes, part: Part, names: Sequence[str] | None = None) -> pa.Table:
    """The cases of a file; Damaged where they are not those of the part."""
    table, mark = _table(content, names)
    if not _holds(table, part.first, part.count) or (mark and (mark.get("first"), mark.get("count")) != (part.first, part.count)):
        raise Damaged("its cases are not those that the ledger says")
    return table


def _holds(table: pa.Table, first: int, count: int) -> bool:
    """Whether the rows are those of these cases, in their order."""
    if CASE not in table.column_names or table.num_rows != count:
        return False
    return np.array_equal(table[CASE].to_numpy(), np.arange(first, first + count))
