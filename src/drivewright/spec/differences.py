"""In which keys specs differ."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from drivewright.errors import UnitError
from drivewright.spec.serialisation import document
from drivewright.units import any_quantity

IDLE = ("title", "units", "study", "optimise", "report")  # tables and keys that change no number of a run


class DifferingKey(NamedTuple):
    """A dotted key and its value in each spec, as it is written there; None where a spec does not have it."""

    key: str
    values: tuple[Any, ...]


def differing_keys(specs: Sequence[Any]) -> tuple[DifferingKey, ...]:
    """The keys that are not the same in all specs, in the order of the specs; defaults count as if they were written."""
    flat = [flat_tables({name: value for name, value in document(spec).items() if name not in IDLE}) for spec in specs]
    keys = list(dict.fromkeys(key for tables in flat for key in tables))
    rows = [DifferingKey(key, tuple(tables.get(key) for tables in flat)) for key in keys]
    return tuple(row for row in rows if not all(is_same_entry(row.values[0], value) for value in row.values[1:]))


def flat_tables(tables: Mapping[str, Any] | Sequence[Any], path: str = "") -> dict[str, Any]:
    """{dotted key: value} of raw tables."""
    entries = tables.items() if isinstance(tables, Mapping) else enumerate(tables)
    flat: dict[str, Any] = {}
    for key, value in entries:
        place = f"{path}.{key}" if path else str(key)
        flat |= flat_tables(value, place) if isinstance(value, (dict, list)) else {place: value}
    return flat


def is_same_entry(there: Any, here: Any) -> bool:
    """Whether two entries say the same: in other units, or by a copy of the same file."""
    if there == here or not (isinstance(there, str) and isinstance(here, str)):
        return there == here
    try:
        return any_quantity(there) == any_quantity(here)
    except UnitError:
        return Path(there).is_file() and Path(here).is_file() and Path(there).read_bytes() == Path(here).read_bytes()
