"""The ledger of a study: which parts there are, each with size and checksum, and what the study is, in an SQLite file."""

from __future__ import annotations

import os
import secrets
import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from drivewright.studies.parts import Part, part_name

LEDGER = "ledger.sqlite"
COMPANIONS = ("", "-journal", "-wal", "-shm")  # files that SQLite keeps beside a data base
TABLES = {
    "identity": {"key": "text primary key", "value": "text not null"},
    "parts": {
        "first": "integer primary key",
        "count": "integer not null",
        "name": "text not null unique",
        "seconds": "real not null",
        "size": "integer",
        "sha256": "text",
        "next_size": "integer",
        "next_sha256": "text",
    },
    "remarks": {"text": "text primary key"},
}
ELSEWHERE = {  # reasons of SQLite that lie outside the file: a full or missing disk, a lock of another process, no permission, no memory
    sqlite3.SQLITE_PERM,
    sqlite3.SQLITE_BUSY,
    sqlite3.SQLITE_LOCKED,
    sqlite3.SQLITE_NOMEM,
    sqlite3.SQLITE_READONLY,
    sqlite3.SQLITE_INTERRUPT,
    sqlite3.SQLITE_IOERR,
    sqlite3.SQLITE_FULL,
    sqlite3.SQLITE_CANTOPEN,
}
LATER = ("size", "sha256", "next_size", "next_sha256")  # columns of `parts` that older versions did not have


class LedgerDamaged(Exception):
    """The file is no ledger, or not a whole one; the message goes on after its name."""


def open_ledger(folder: Path) -> sqlite3.Connection:
    """The ledger of a folder for writing, made where there is none; LedgerDamaged with the reason where it is not whole."""
    ledger = sqlite3.connect(folder / LEDGER)
    ledger.text_factory = _text
    with _damage_told(ledger, folder / LEDGER):
        ledger.execute("pragma synchronous = full")
        if not _tables(ledger):
            _make(ledger)
        _check(ledger)
        with ledger:
            ledger.execute("begin")
            for column in LATER:
                if column not in _columns(ledger, "parts"):
                    ledger.execute(f"alter table parts add column {column} {TABLES['parts'][column]}")
    return ledger


def read_ledger(folder: Path) -> sqlite3.Connection:
    """A connection for reading; a kill in the middle of a commit leaves a journal that only a writer may roll back."""
    if not (folder / LEDGER).is_file():
        raise LedgerDamaged("is lost")
    for mode in ("ro", "rw"):
        ledger = sqlite3.connect(f"{(folder / LEDGER).resolve().as_uri()}?mode={mode}", uri=True)
        ledger.text_factory = _text
        try:
            with _damage_told(ledger):
                _check(ledger)
            return ledger
        except sqlite3.OperationalError:
            if mode == "rw":
                raise
    raise AssertionError("one of the two modes ends the loop")


def parts_of(ledger: sqlite3.Connection) -> list[Part]:
    """The parts in the order of their cases; LedgerDamaged where two of them, or a name and its cases, contradict each other."""
    more = ", ".join(name if name in _columns(ledger, "parts") else "null" for name in LATER)
    parts = [Part(*row) for row in ledger.execute(f"select first, count, name, {more} from parts order by first")]
    stop = 0
    for part in parts:
        if not (isinstance(part.first, int) and isinstance(part.count, int) and part.count > 0 and part.first >= stop):
            raise LedgerDamaged(f"is damaged (the cases of its part {part.name!r} are inconsistent)")
        if part.name != part_name(part.first, part.count):
            raise LedgerDamaged(f"is damaged (its part {part.name!r} has another name than its cases)")
        stop = part.first + part.count
    return parts


def identity_of(ledger: sqlite3.Connection) -> dict[str, str]:
    """What the study is, {what: text}; empty where it is not stated yet."""
    return dict(ledger.execute("select key, value from identity"))


def remarks_of(ledger: sqlite3.Connection) -> tuple[str, ...]:
    """What was remarked on the study."""
    return tuple(text for (text,) in ledger.execute("select text from remarks order by rowid"))


def set_aside(folder: Path) -> str:
    """Give a damaged ledger another name, which is returned."""
    aside = f"{LEDGER}.damaged-{secrets.token_hex(4)}"
    for companion in reversed(COMPANIONS):
        if (folder / f"{LEDGER}{companion}").exists():
            (folder / f"{LEDGER}{companion}").rename(folder / f"{aside}{companion}")
    return aside


def _text(content: bytes) -> str:
    """A text as it was written, or one that no writer has written."""
    return content.decode(errors="replace")


@contextmanager
def _damage_told(ledger: sqlite3.Connection, written: Path | None = None) -> Iterator[None]:
    """Close the ledger where something is wrong, and tell damage from a disk that is full or away."""
    try:
        yield
    except BaseException as error:
        ledger.close()
        if isinstance(error, UnicodeDecodeError) or (isinstance(error, sqlite3.DatabaseError) and _is_damage(error, written)):
            raise LedgerDamaged(f"is damaged ({error})") from None
        raise


def _is_damage(error: sqlite3.DatabaseError, written: Path | None) -> bool:
    """Whether an error comes from what is in the file.  A bit of the head of a file to be written says that it may only be read."""
    code = getattr(error, "sqlite_errorcode", sqlite3.SQLITE_CORRUPT)
    if code == sqlite3.SQLITE_READONLY and written is not None:
        return os.access(written, os.W_OK) and os.access(written.parent, os.W_OK)
    return code & 0xFF not in ELSEWHERE


def _make(ledger):
    with ledger:
        ledger.execute("begin immediate")
        for table, columns in TABLES.items():
            ledger.execute(f"create table if not exists {table} ({', '.join(f'{name} {kind}' for name, kind in columns.items())})")


def _check(ledger):
    """LedgerDamaged where a page, a table or a column is not what it should be."""
    (verdict,) = ledger.execute("pragma integrity_check(1)").fetchone()
    if verdict != "ok":
        raise LedgerDamaged(f"is damaged ({verdict})")
    for table, columns in TABLES.items():
        if lost := [name for name in columns if name not in _columns(ledger, table) and name not in LATER]:
            raise LedgerDamaged(f"is damaged (its table {table!r} has no column {lost[0]!r})")


def _tables(ledger):
    return [name for (name,) in ledger.execute("select name from sqlite_master where type = 'table'")]


def _columns(ledger, table):
    return [row[1] for row in ledger.execute(f"pragma table_info({table})")]
