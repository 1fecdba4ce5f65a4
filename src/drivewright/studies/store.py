"""Where a study lives: a folder with `study.toml`, a ledger (SQLite) and `parts/` (Parquet), or nothing but memory.

A part is written under a temporary name, forced to the disk, renamed, and only then entered in the ledger: what the ledger names is
whole.  What it does not name never happened and is deleted at the next start.  One process at a time holds the folder (a lock that the
system takes back when the process dies).
"""

import os
import sqlite3
from contextlib import contextmanager
from pathlib import Path

from drivewright.errors import InputError
from drivewright.spec import document, load

SPEC, LEDGER, PARTS, LOCK = "study.toml", "ledger.sqlite", "parts", ".lock"
OURS = {SPEC, f"{SPEC}.tmp", LEDGER, f"{LEDGER}-journal", PARTS, LOCK, "data"}
TABLES = """
create table if not exists identity (key text primary key, value text not null);
create table if not exists parts (first integer primary key, count integer not null, name text not null unique, seconds real not null);
create table if not exists remarks (text text primary key);
"""


class Memory:
    """The parts of a study that is not kept."""

    folder = None

    def __init__(self):
        self._parts, self.seconds, self._remarks = {}, 0.0, ()

    def ranges(self):
        """Sorted (first, count) of what is there."""
        return [(first, table.num_rows) for first, table in sorted(self._parts.items())]

    def add(self, first, table, seconds):
        """Keep a part."""
        self._parts[first] = table
        self.seconds += seconds

    def remark(self, texts):
        """Keep what is to be said of the study."""
        self._remarks = tuple(dict.fromkeys((*self._remarks, *texts)))

    def remarks(self):
        """What was kept."""
        return self._remarks

    def tables(self):
        """All parts in the order of their cases."""
        return [table for _, table in sorted(self._parts.items())]

    def close(self):
        """Nothing to let go."""


class Folder:
    """The folder of a study; `identity` is what must not change between two starts, {what: text}."""

    def __init__(self, folder, spec, identity):
        self.folder = Path(folder).resolve()
        refuse_foreign(self.folder)
        with self._to_disk():
            (self.folder / PARTS).mkdir(parents=True, exist_ok=True)
            self._lock = _locked(self.folder)
        try:
            with self._to_disk():
                self._ledger = _ledger(self.folder)
                self._settle(spec, identity)
                self._forget_what_is_not_named()
        except BaseException:
            self.close()
            raise

    def _settle(self, spec, identity):
        """Write down what the study is, or refuse another one."""
        known = dict(self._ledger.execute("select key, value from identity"))
        if not known:
            _write_spec(spec, self.folder)
            with self._ledger:
                self._ledger.executemany("insert into identity values (?, ?)", list(identity.items()))
        elif known != identity:
            raise InputError(
                f"{self.folder}: holds another study; {_differing(self.folder, spec, known, identity)}. Give another --out, or "
                "remove the folder"
            )

    def _forget_what_is_not_named(self):
        named = {name for (name,) in self._ledger.execute("select name from parts")}
        for file in (self.folder / PARTS).iterdir():
            if file.name not in named:
                file.unlink()
        missing = sorted(name for name in named if not (self.folder / PARTS / name).is_file())
        with self._ledger:
            self._ledger.executemany("delete from parts where name = ?", [(name,) for name in missing])

    @property
    def seconds(self):
        """That workers spent on what is there."""
        return self._ledger.execute("select coalesce(sum(seconds), 0) from parts").fetchone()[0]

    def ranges(self):
        """Sorted (first, count) of what is there."""
        return list(self._ledger.execute("select first, count from parts order by first"))

    def add(self, first, table, seconds):
        """Keep a part for good: InputError where the disk does not take it; nothing that was there is lost."""
        name = f"{first:012d}-{first + table.num_rows - 1:012d}.parquet"
        with self._to_disk():
            _write_part(self.folder / PARTS / name, table)
            with self._ledger:
                self._ledger.execute("insert into parts values (?, ?, ?, ?)", (first, table.num_rows, name, seconds))

    def remark(self, texts):
        """Keep what is to be said of the study."""
        with self._to_disk(), self._ledger:
            self._ledger.executemany("insert or ignore into remarks values (?)", [(text,) for text in texts])

    def remarks(self):
        """What was kept."""
        return _remarks(self._ledger)

    def tables(self):
        """All parts in the order of their cases."""
        return read_parts(self.folder, self._ledger)

    def close(self):
        """Let go of ledger and lock."""
        if ledger := getattr(self, "_ledger", None):
            ledger.close()
        self._lock.close()

    @contextmanager
    def _to_disk(self):
        """A disk that is full or away is no bug of ours."""
        try:
            yield
        except (OSError, sqlite3.Error) as error:
            reason = getattr(error, "strerror", None) or error
            raise InputError(
                f"{self.folder}: cannot be written: {reason}; every case that was finished before is safe. Make room or mend the "
                "disk, and give the same command again"
            ) from None


def is_study(folder):
    """Whether a folder holds a study."""
    return (Path(folder) / SPEC).is_file() and (Path(folder) / LEDGER).is_file()


def refuse_foreign(folder):
    """InputError where a study would settle among somebody else's files."""
    if folder.exists() and not folder.is_dir():
        raise InputError(f"{folder}: is a file, a study cannot take its place; choose another --out")
    inside = sorted(path.name for path in folder.iterdir()) if folder.is_dir() else []
    if not is_study(folder) and set(inside) - OURS:
        raise InputError(
            f"{folder}: is not empty and holds no study ({', '.join(inside[:3])} ...); nothing was written. Choose another --out"
        )


def opened(folder):
    """(spec, tables of the parts, seconds, remarks) of a study's folder, without its lock: what is acknowledged by now."""
    folder = Path(folder)
    if not is_study(folder):
        raise InputError(
            f"{folder}: is no study (it has no {SPEC} with a {LEDGER}); `drivewright sweep SPEC --vary ... --out {folder}` makes one"
        )
    ledger = sqlite3.connect(f"{(folder / LEDGER).resolve().as_uri()}?mode=ro", uri=True)
    try:
        seconds = ledger.execute("select coalesce(sum(seconds), 0) from parts").fetchone()[0]
        return load(folder / SPEC), read_parts(folder, ledger), seconds, _remarks(ledger)
    except (OSError, sqlite3.Error) as error:
        raise InputError(f"{folder}: cannot be read: {error}") from None
    finally:
        ledger.close()


def _remarks(ledger):
    return tuple(text for (text,) in ledger.execute("select text from remarks order by rowid"))


def read_parts(folder, ledger):
    """The tables that a ledger names, in the order of their cases."""
    from pyarrow import parquet

    names = [name for (name,) in ledger.execute("select name from parts order by first")]
    return [parquet.read_table(folder / PARTS / name) for name in names]


def joined(tables):
    """One table of all parts: columns in the order in which the cases bring them, null where a case has none."""
    import pyarrow as pa

    fields = {}
    for table in tables:
        for field in table.schema:
            fields.setdefault(field.name, field)
    schema = pa.schema(list(fields.values()))
    return pa.concat_tables([completed(table, schema) for table in tables]) if tables else schema.empty_table()


def completed(table, schema):
    """A table with the columns of a schema, null where it has none."""
    import pyarrow as pa

    columns = [table[f.name] if f.name in table.column_names else pa.nulls(table.num_rows, f.type) for f in schema]
    return pa.Table.from_arrays(columns, schema=schema)


# -- on the disk ---------------------------------------------------------------------------------------------------------------


def _locked(folder):
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


def _ledger(folder):
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


# -- what differs --------------------------------------------------------------------------------------------------------------


def _differing(folder, spec, known, identity):
    """What is not the same there and here, key by key where the specs tell."""
    there, here = _flat(document(load(folder / SPEC))), _flat(document(spec))
    keys = [
        key for key in dict.fromkeys([*there, *here]) if there.get(key) != here.get(key) and not _same_file(there.get(key), here.get(key))
    ]
    rows = [f"{key}: {there.get(key, 'not given')} there, {here.get(key, 'not given')} here" for key in keys]
    rows += [
        f"{what}: {known.get(what, 'not given')} there, {identity.get(what, 'not given')} here"
        for what in dict.fromkeys([*known, *identity])
        if known.get(what) != identity.get(what) and what not in ("spec", "plan", "study")
    ]
    more = f" and {len(rows) - 8} more" if len(rows) > 8 else ""
    return "; ".join(rows[:8]) + more if rows else "the content of a data file, or the points of the plan, are not the same"


def _flat(tables, path=""):
    """{dotted key: value} of raw tables."""
    entries = tables.items() if isinstance(tables, dict) else enumerate(tables)
    found = {}
    for key, value in entries:
        place = f"{path}.{key}" if path else str(key)
        found |= _flat(value, place) if isinstance(value, (dict, list)) else {place: value}
    return found


def _same_file(there, here):
    """Whether two texts are paths of files with the same content: a study keeps copies of its data."""
    paths = [Path(value) for value in (there, here) if isinstance(value, str) and Path(value).is_file()]
    return len(paths) == 2 and paths[0].read_bytes() == paths[1].read_bytes()
