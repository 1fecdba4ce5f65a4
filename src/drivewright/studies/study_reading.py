"""A study's folder as a reader finds it: what is acknowledged by now, and what of it is damaged."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from drivewright.errors import InputError
from drivewright.spec import MechanismSpec, load
from drivewright.studies.ledger import LEDGER, LedgerDamaged, identity_of, parts_of, read_ledger, remarks_of
from drivewright.studies.parts import Part, part_names
from drivewright.studies.stored_rows import StoredRows, rows_of_parts

if TYPE_CHECKING:
    import pyarrow as pa

SPEC, PARTS = "study.toml", "parts"


class KeptStudy(NamedTuple):
    """What a study's folder holds: `damaged` are the parts that cannot be read, with the reason."""

    spec: MechanismSpec
    rows: pa.Table | StoredRows
    seconds: float
    remarks: tuple[str, ...]
    identity: dict[str, str]
    damaged: dict[Part, str]


def is_study(folder: str | Path) -> bool:
    """Whether a folder holds a study, be its ledger lost."""
    return (Path(folder) / SPEC).is_file() and ((Path(folder) / LEDGER).is_file() or bool(part_names(Path(folder) / PARTS)))


def read_study(folder: str | Path) -> KeptStudy:
    """What is acknowledged by now in a study's folder, without its lock."""
    folder = Path(folder)
    if not is_study(folder):
        raise InputError(
            f"{folder}: is no study (it has no {SPEC} with a {LEDGER}); `drivewright sweep SPEC --vary ... --out {folder}` makes one"
        )
    try:
        with closing(read_ledger(folder)) as ledger:
            return _kept(folder, ledger)
    except LedgerDamaged as damage:
        raise InputError(
            f"{folder}: its {LEDGER} {damage}; the parts are there: `drivewright sweep {folder / SPEC} --out {folder}` makes a new "
            "ledger of those that are intact, and continues"
        ) from None
    except (OSError, sqlite3.Error) as error:
        raise InputError(f"{folder}: cannot be read: {error}") from None


def _kept(folder: Path, ledger: sqlite3.Connection) -> KeptStudy:
    seconds = ledger.execute("select coalesce(sum(seconds), 0) from parts").fetchone()[0]
    known, parts = identity_of(ledger), parts_of(ledger)
    rows, damaged = rows_of_parts(folder / PARTS, parts)
    while damaged and (now := parts_of(ledger)) != parts:  # a sweep has just begun, and replaced them
        parts = now
        rows, damaged = rows_of_parts(folder / PARTS, parts)
    return KeptStudy(load(folder / SPEC), rows, seconds, remarks_of(ledger), known, damaged)
