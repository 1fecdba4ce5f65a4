"""The folder of a study: `study.toml`, a ledger (SQLite) and `parts/` (Parquet).

A part is written under a temporary name, forced to the disk, renamed, and only then entered in the ledger with its size and checksum.
At every start all parts are checked: a damaged one is computed again, and one that no ledger names is kept where it proves what it is,
so that a lost ledger costs no case.  One process at a time holds the folder (a lock that the system takes back when the process dies).
"""

from __future__ import annotations

import re
import secrets
import sqlite3
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import IO, TYPE_CHECKING, NoReturn

from drivewright.atomic import TOKEN
from drivewright.errors import InputError
from drivewright.spec import MechanismSpec, load
from drivewright.spec.serialisation import canonical_text
from drivewright.studies.ledger import LEDGER, LedgerDamaged, identity_of, open_ledger, parts_of, remarks_of, set_aside
from drivewright.studies.parts import (
    TOLD,
    Damaged,
    Foreign,
    Part,
    adopt_part,
    cases_of,
    checked_part,
    damage_text,
    packed,
    part_names,
    read_part,
    read_parts,
    reasons_of,
    study_digest,
    study_of,
    write_content,
    write_part,
)
from drivewright.studies.spec_differences import describe_differences, differing_keys
from drivewright.studies.stored_rows import StoredRows, rows_of_parts
from drivewright.studies.study_reading import PARTS, SPEC, is_study

if TYPE_CHECKING:
    import pyarrow as pa

LOCK, DATA = ".lock", "data"
OURS = re.compile(rf"{re.escape(SPEC)}(\.tmp)?|\.{re.escape(SPEC)}\.{TOKEN}\.tmp\.toml|{re.escape(LEDGER)}.*|{PARTS}|\.lock|{DATA}")
PENDING = "update parts set next_size = ?, next_sha256 = ? where name = ?"
SETTLED = "update parts set size = ?, sha256 = ?, next_size = null, next_sha256 = null, seconds = seconds + ? where name = ?"
UNFINISHED = re.compile(rf"\.(\d{{12}}-\d{{12}}\.parquet\.tmp|.*\.{TOKEN}\.tmp(\..*)?)")


class Folder:
    """The folder of a study; `identity` is what must not change between two starts, {what: text}."""

    def __init__(self, folder: str | Path, spec: MechanismSpec, identity: Mapping[str, str]) -> None:
        self.folder = Path(folder).resolve()
        self.notices: list[str] = []
        self._parts, self._study = self.folder / PARTS, study_digest(identity)
        refuse_foreign(self.folder)
        with self._to_disk():
            self.folder.mkdir(parents=True, exist_ok=True)
            self._lock = _locked(self.folder)
        try:
            with self._to_disk():
                self._parts.mkdir(exist_ok=True)
                self._settle(spec, identity)
                self._check_parts()
        except BaseException:
            self.close()
            raise

    def _settle(self, spec, identity):
        """Go on with the study that is there; refuse another one before anything of it is touched."""
        damage, known, named = self._open_ledger()
        if known and known != identity:
            if self._claimed_study() != self._study:
                self._refuse(describe_differences(self.folder / SPEC, spec, known, identity))
            damage, known, named = "is damaged (it describes another study than the parts)", {}, []
        unnamed, rejected = self._unnamed_parts(named)
        is_rebuilt = not known and bool(unnamed or rejected or damage)
        if is_rebuilt and not unnamed and (differences := differing_keys(self.folder / SPEC, spec, "plan" in identity)):
            self._refuse("; ".join(differences))
        aside = self._replace_ledger() if damage else ""
        for name in rejected:
            _away(self._parts / name, is_kept=is_rebuilt)
        self._write_identity(spec, {} if known else identity)
        self._enter(unnamed)
        self._clear_away()
        if is_rebuilt:
            self.notices.append(_rebuilt(f"{damage} and kept as {aside}" if damage else "is lost", unnamed, rejected))

    def _open_ledger(self) -> tuple[str, dict[str, str], list[Part]]:
        """Open the ledger: (what is wrong with it, what it says the study is, the parts that it names)."""
        try:
            self._ledger = open_ledger(self.folder)
            identity, parts = identity_of(self._ledger), parts_of(self._ledger)
        except LedgerDamaged as damage:
            return str(damage), {}, []
        return ("is damaged (it does not say of what study it is)" if parts and not identity else ""), identity, parts if identity else []

    def _replace_ledger(self) -> str:
        """A new ledger in place of a damaged one, which keeps the name that is returned."""
        if ledger := getattr(self, "_ledger", None):
            ledger.close()
        aside = set_aside(self.folder)
        self._ledger = open_ledger(self.folder)
        return aside

    def _unnamed_parts(self, named: Sequence[Part]) -> tuple[list[Part], list[str]]:
        """(parts that no ledger names and that prove to be of this study, names of the files that do not)."""
        found, rejected = [], []
        for name in sorted(part_names(self._parts) - {part.name for part in named}):
            try:
                part = adopt_part(self._parts, name, self._study)
            except Damaged:
                rejected.append(name)
            except Foreign:
                self._refuse(f"{PARTS}/{name} is a part of it")
            else:
                if any(part.overlaps(other) for other in (*named, *found)):
                    rejected.append(name)
                else:
                    found.append(part)
        return found, rejected

    def _claimed_study(self) -> str | None:
        """Digest of the study to which the parts say that they belong; None where none says so."""
        return next(filter(None, (study_of(self._parts / name) for name in sorted(part_names(self._parts)))), None)

    def _refuse(self, differences: str) -> NoReturn:
        raise InputError(f"{self.folder}: holds another study; {differences}. Give another --out, or remove the folder")

    def _write_identity(self, spec, identity):
        """Write down what the study is, where that is new."""
        if identity:
            with self._ledger:
                self._ledger.executemany("insert into identity values (?, ?)", list(identity.items()))
        if not _has_spec(self.folder, spec):
            spec.write(self.folder / SPEC)

    def _clear_away(self):
        """Remove what a start that was killed had begun to write."""
        data = self.folder / DATA
        for file in (*self._parts.iterdir(), *(data.iterdir() if data.is_dir() else ())):
            if UNFINISHED.fullmatch(file.name) and file.is_file():
                file.unlink()

    def _check_parts(self):
        """Forget the parts that are gone or damaged, so that their cases are computed again; older ones get their checksum, and those that
        were being written anew when the command ended are what their file is."""
        before = parts_of(self._ledger)
        lost, settled = {}, []
        for part in before:
            try:
                whole = checked_part(self._parts, part)
            except Damaged as damage:
                lost[part] = str(damage)
            else:
                settled += [whole] if whole != part else []
        with self._ledger:
            self._ledger.executemany("delete from parts where name = ?", [(part.name,) for part in lost])
            self._ledger.executemany(SETTLED, [(part.size, part.sha256, 0.0, part.name) for part in settled])
        for part in lost:
            _away(self._parts / part.name, is_kept=False)
        if lost:
            self.notices.append(f"{cases_of(lost)} are computed again: {reasons_of(lost)}")
        if older := [part for part in before if part.sha256 is None and part not in lost]:
            self.notices.append(f"{cases_of(older)} were kept without a checksum by an older version; they have one now, as they were read")

    @property
    def seconds(self) -> float:
        """That workers spent on what is there."""
        return self._ledger.execute("select coalesce(sum(seconds), 0) from parts").fetchone()[0]

    def ranges(self) -> list[tuple[int, int]]:
        """Sorted (first, count) of what is there."""
        return list(self._ledger.execute("select first, count from parts order by first"))

    def add(self, first: int, table: pa.Table, seconds: float) -> None:
        """Keep a part for good: InputError where the disk does not take it; nothing that was there is lost."""
        with self._to_disk():
            self._enter([write_part(self._parts, first, table, self._study)], seconds)

    def parts(self) -> list[Part]:
        """The parts in the order of their cases."""
        return parts_of(self._ledger)

    def part_rows(self, part: Part) -> pa.Table:
        """The cases of a part; InputError where it is damaged meanwhile."""
        try:
            return read_part(self._parts, part)
        except Damaged as damage:
            raise InputError(damage_text(self.folder, {part: str(damage)})) from None

    def rewrite(self, part: Part, table: pa.Table, seconds: float) -> None:
        """Put other rows of the same cases in the place of a part: whenever this ends, the old rows are there, or the new ones."""
        new, content = packed(part.first, table, self._study)
        with self._to_disk():
            with self._ledger:
                self._ledger.execute(PENDING, (new.size, new.sha256, part.name))
            write_content(self._parts, new, content)
            with self._ledger:
                self._ledger.execute(SETTLED, (new.size, new.sha256, seconds, part.name))

    def _enter(self, parts: Sequence[Part], seconds: float = 0.0) -> None:
        """Name parts in the ledger."""
        rows = [(part.first, part.count, part.name, seconds, part.size, part.sha256) for part in parts]
        with self._ledger:
            self._ledger.executemany("insert into parts (first, count, name, seconds, size, sha256) values (?, ?, ?, ?, ?, ?)", rows)

    def remark(self, texts: Iterable[str]) -> None:
        """Keep the notices about the study."""
        with self._to_disk(), self._ledger:
            self._ledger.executemany("insert or ignore into remarks values (?)", [(text,) for text in texts])

    def remarks(self) -> tuple[str, ...]:
        """What was kept."""
        return remarks_of(self._ledger)

    def tables(self) -> list[pa.Table]:
        """All parts in the order of their cases; InputError where one of them is damaged meanwhile."""
        tables, damaged = read_parts(self._parts, parts_of(self._ledger))
        if damaged:
            raise InputError(damage_text(self.folder, damaged))
        return tables

    def rows(self) -> pa.Table | StoredRows:
        """All rows in the order of their cases, in memory where they are few; InputError where a part is damaged meanwhile."""
        rows, damaged = rows_of_parts(self._parts, parts_of(self._ledger))
        if damaged:
            raise InputError(damage_text(self.folder, damaged))
        return rows

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
            raise InputError(
                f"{self.folder}: cannot be written: {reason}; every case that was finished before is safe. "
                "Free space on the disk, or repair it, and give the same command again"
            ) from None


def refuse_foreign(folder: Path) -> None:
    """InputError where a study would settle among somebody else's files."""
    if folder.exists() and not folder.is_dir():
        raise InputError(f"{folder}: is a file, a study cannot take its place; choose another --out")
    inside = sorted(path.name for path in folder.iterdir()) if folder.is_dir() else []
    if not is_study(folder) and inside and (LOCK not in inside or not all(map(OURS.fullmatch, inside))):
        raise InputError(
            f"{folder}: is not empty and holds no study ({', '.join(inside[:3])} ...); nothing was written. Choose another --out"
        )


def _has_spec(folder: Path, spec: MechanismSpec) -> bool:
    """Whether the spec that lies in the folder, with its data, is this one."""
    try:
        kept = load(folder / SPEC)
        return (kept.title, canonical_text(kept)) == (spec.title, canonical_text(spec))
    except (OSError, InputError):
        return False


def _away(file: Path, is_kept: bool) -> None:
    """Take a damaged part out of the way: under another name, or for good."""
    if is_kept:
        file.rename(file.with_name(f"{file.name}.damaged-{secrets.token_hex(4)}"))
    else:
        file.unlink(missing_ok=True)


def _rebuilt(what: str, kept: Sequence[Part], rejected: Sequence[str]) -> str:
    """What became of a study whose ledger is a new one."""
    rest = f"; {', '.join(rejected[:TOLD])}{' ...' * (len(rejected) > TOLD)} cannot, and stay under other names" if rejected else ""
    return f"the {LEDGER} {what}; a new one was made from the parts that prove what they are: {cases_of(kept)} kept{rest}"


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
