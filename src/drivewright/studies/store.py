"""Where a study lives: a folder with `study.toml`, a ledger (SQLite) and `parts/` (Parquet), or nothing but memory.

A part is written under a temporary name, forced to the disk, renamed, and only then entered in the ledger: what the ledger names is
whole.  What it does not name never happened and is deleted at the next start.  One process at a time holds the folder (a lock that the
system takes back when the process dies).
"""

from __future__ import annotations

import os
import sqlite3
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any, Protocol

from drivewright.errors import InputError
from drivewright.execution.case_table import case_fields
from drivewright.spec import MechanismSpec, load
from drivewright.studies.spec_differences import describe_differences

if TYPE_CHECKING:
    import pyarrow as pa

SPEC, LEDGER, PARTS, LOCK = "study.toml", "ledger.sqlite", "parts", ".lock"
OURS = {SPEC, f"{SPEC}.tmp", LEDGER, f"{LEDGER}-journal", PARTS, LOCK, "data"}
TABLES = """
create table if not exists identity (key text primary key, value text not null);
create table if not exists parts (first integer primary key, count integer not null, name text not null unique, seconds real not null);
create table if not exists remarks (text text primary key);
"""


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

    def close(self) -> None:
        """Let go of what it holds."""
        ...


class Memory:
    """The parts of a study that is not kept."""

    folder: Path | None = None
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
        """Keep what is to be said of the study."""
        self._remarks = tuple(dict.fromkeys((*self._remarks, *texts)))

    def remarks(self) -> tuple[str, ...]:
        """What was kept."""
        return self._remarks

    def tables(self) -> list[pa.Table]:
        """All parts in the order of their cases."""
        return [table for _, table in sorted(self._parts.items())]

    def close(self) -> None:
        """Nothing to let go."""


class Folder:
    """The folder of a study; `identity` is what must not change between two starts, {what: text}."""

    def __init__(self, folder: str | Path, spec: MechanismSpec, identity: Mapping[str, str]) -> None:
        self.folder = Path(folder).resolve()
        refuse_foreign(self.folder)
        with self._to_disk():
            self.folder.mkdir(parents=True, exist_ok=True)
            self._lock = _locked(self.folder)
        try:
            with self._to_disk():
                (self.folder / PARTS).mkdir(exist_ok=True)
                self._ledger = _ledger(self.folder)
                self._settle(spec, identity)
                self._forget_what_is_not_named()
        except BaseException:
            self.close()
            raise

    def _settle(self, spec, identity):
        """Write down what the study is, or refuse another one."""
        known = dict(self._ledger.execute("select key, value from identity"))
        if known and known != identity:
            differences = describe_differences(self.folder / SPEC, spec, known, identity)
            raise InputError(f"{self.folder}: holds another study; {differences}. Give another --out, or remove the folder")
        if not known or not (self.folder / SPEC).is_file() or load(self.folder / SPEC).title != spec.title:
            _write_spec(spec, self.folder)
        if not known:
            with self._ledger:
                self._ledger.executemany("insert into identity values (?, ?)", list(identity.items()))

    def _forget_what_is_not_named(self):
        """Delete parts that never happened, and compute again those that are gone or damaged."""
        named = dict(self._ledger.execute("select name, count from parts"))
        for file in (self.folder / PARTS).iterdir():
            if file.name not in named and file.suffix in (".parquet", ".tmp") and file.is_file():
                file.unlink()
        lost = [(name,) for name, count in named.items() if _rows_of(self.folder / PARTS / name) != count]
        with self._ledger:
            self._ledger.executemany("delete from parts where name = ?", lost)

    @property
    def seconds(self) -> float:
        """That workers spent on what is there."""
        return self._ledger.execute("select coalesce(sum(seconds), 0) from parts").fetchone()[0]

    def ranges(self) -> list[tuple[int, int]]:
        """Sorted (first, count) of what is there."""
        return list(self._ledger.execute("select first, count from parts order by first"))

    def add(self, first: int, table: pa.Table, seconds: float) -> None:
        """Keep a part for good: InputError where the disk does not take it; nothing that was there is lost."""
        name = f"{first:012d}-{first + table.num_rows - 1:012d}.parquet"
        with self._to_disk():
            _write_part(self.folder / PARTS / name, table)
            with self._ledger:
                self._ledger.execute("insert into parts values (?, ?, ?, ?)", (first, table.num_rows, name, seconds))

    def remark(self, texts: Iterable[str]) -> None:
        """Keep what is to be said of the study."""
        with self._to_disk(), self._ledger:
            self._ledger.executemany("insert or ignore into remarks values (?)", [(text,) for text in texts])

    def remarks(self) -> tuple[str, ...]:
        """What was kept."""
        return _remarks(self._ledger)

    def tables(self) -> list[pa.Table]:
        """All parts in the order of their cases."""
        return read_parts(self.folder, self._ledger)

    def close(self) -> None:
        """Let go of ledger and lock."""
        if ledger := getattr(self, "_ledger", None):
            ledger.close()
        self._lock.close()

    @contextmanager
    def _to_disk(self) -> Iterator[None]:
        """A disk that is full or away is no bug of ours."""
        try:
            yield
        except (OSError, sqlite3.Error) as error:
            reason = getattr(error, "strerror", None) or error
            remedy = (
                "Make room or mend the disk, and give the same command again"
                if type(error) is not sqlite3.DatabaseError
                else f"Its {LEDGER} is damaged: the parts are whole, but the study cannot go on from them; give another --out"
            )
            raise InputError(f"{self.folder}: cannot be written: {reason}; every case that was finished before is safe. {remedy}") from None


def is_study(folder: str | Path) -> bool:
    """Whether a folder holds a study."""
    return (Path(folder) / SPEC).is_file() and (Path(folder) / LEDGER).is_file()


def refuse_foreign(folder: Path) -> None:
    """InputError where a study would settle among somebody else's files."""
    if folder.exists() and not folder.is_dir():
        raise InputError(f"{folder}: is a file, a study cannot take its place; choose another --out")
    inside = sorted(path.name for path in folder.iterdir()) if folder.is_dir() else []
    if not is_study(folder) and (set(inside) - OURS or (inside and LOCK not in inside)):
        raise InputError(
            f"{folder}: is not empty and holds no study ({', '.join(inside[:3])} ...); nothing was written. Choose another --out"
        )


def read_study(folder: str | Path) -> tuple[Any, list[pa.Table], float, tuple[str, ...], dict[str, str]]:
    """(spec, tables of the parts, seconds, remarks, identity) of a study's folder, without its lock: what is acknowledged by now."""
    folder = Path(folder)
    if not is_study(folder):
        raise InputError(
            f"{folder}: is no study (it has no {SPEC} with a {LEDGER}); `drivewright sweep SPEC --vary ... --out {folder}` makes one"
        )
    try:
        ledger = _readable(folder / LEDGER)
        seconds = ledger.execute("select coalesce(sum(seconds), 0) from parts").fetchone()[0]
        known = dict(ledger.execute("select key, value from identity"))
        study = load(folder / SPEC), read_parts(folder, ledger), seconds, _remarks(ledger), known
        ledger.close()
    except (OSError, sqlite3.Error) as error:
        raise InputError(f"{folder}: cannot be read: {error}") from None
    return study


def _readable(file: Path) -> sqlite3.Connection:
    """A connection for reading; a kill in the middle of a commit leaves a journal that only a writer may roll back."""
    for mode in ("ro", "rw"):
        ledger = sqlite3.connect(f"{file.resolve().as_uri()}?mode={mode}", uri=True)
        try:
            ledger.execute("select count(*) from parts").fetchone()
            return ledger
        except sqlite3.OperationalError:
            ledger.close()
            if mode == "rw":
                raise
    return ledger


def _remarks(ledger):
    return tuple(text for (text,) in ledger.execute("select text from remarks order by rowid"))


def read_parts(folder: Path, ledger: sqlite3.Connection) -> list[pa.Table]:
    """The tables that a ledger names, in the order of their cases."""
    import pyarrow as pa
    from pyarrow import parquet

    names = [name for (name,) in ledger.execute("select name from parts order by first")]
    try:
        return [parquet.read_table(folder / PARTS / name) for name in names]
    except (OSError, pa.ArrowException) as error:
        raise InputError(
            f"{folder}: a part cannot be read ({str(error).splitlines()[0]}); the sweep's command computes its cases again"
        ) from None


def _rows_of(file):
    """How many rows a part has; -1 where it cannot be read."""
    import pyarrow as pa
    from pyarrow import parquet

    try:
        return parquet.read_metadata(file).num_rows
    except (OSError, pa.ArrowException):
        return -1


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


# -- on the disk ---------------------------------------------------------------------------------------------------------------


def _locked(folder: Path) -> IO[str]:
    """The open lock file of a folder; InputError where another process holds it."""
    lock = (folder / LOCK).open("a")
    try:
        import fcntl

        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except ImportError:  # no such locks on this system
        pass
    except BlockingIOError:
        lock.close()
        raise InputError(f"{folder}: another process works on this study; wait for it, or give another --out") from None
    return lock


def _ledger(folder: Path) -> sqlite3.Connection:
    ledger = sqlite3.connect(folder / LEDGER)
    ledger.execute("pragma synchronous = full")
    with ledger:
        ledger.executescript(TABLES)
    return ledger


def _write_spec(spec, folder):
    temporary = folder / f"{SPEC}.tmp"
    spec.write(temporary)
    _forced(temporary)
    temporary.replace(folder / SPEC)
    _forced(folder)


def _write_part(path, table):
    from pyarrow import parquet

    temporary = path.with_name(f".{path.name}.tmp")
    try:
        parquet.write_table(table, temporary)
        _forced(temporary)
        temporary.replace(path)
        _forced(path.parent)
    finally:
        temporary.unlink(missing_ok=True)


def _forced(path):
    """Force a file, or the names in a folder, to the disk."""
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
