"""A spec as raw tables, as TOML text, and as the canonical text under its digest."""

import hashlib
import json
import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from pydantic import BaseModel

from drivewright.errors import SpecError, UnitError
from drivewright.spec.fields import AnyUnit, dimension_of, marker_of
from drivewright.units import Dimension, any_quantity


def document(spec: Any, places: Mapping[Path, str] | None = None) -> dict[str, Any]:
    """Raw tables of a spec, quantities as text with unit; what is None or an empty default is left out.

    `places` gives a data file another path than its own.
    """
    fields = [(name, field, getattr(spec, name)) for name, field in type(spec).model_fields.items()]
    return {
        name: to_plain(value, dimension_of(field), places)
        for name, field, value in fields
        if value is not None and not (value in ((), {}) and not field.default)
    }


def to_plain(value: Any, dimension: Dimension | None = None, places: Mapping[Path, str] | None = None) -> Any:
    """A value of a spec as TOML has it: quantities as text, tables as dictionaries."""
    if isinstance(value, BaseModel):
        return document(value, places)
    if isinstance(value, (tuple, list)):
        return [to_plain(v, dimension, places) for v in value]
    if isinstance(value, dict):
        return {name: to_plain(v, dimension, places) for name, v in value.items()}
    if isinstance(value, Path):
        return str((places or {}).get(value, value))
    return dimension.text(value) if dimension and isinstance(value, float) else value


def data_files_in(value: Any) -> list[Path]:
    """Every data file a spec names."""
    if isinstance(value, BaseModel):
        value = [getattr(value, name) for name in type(value).model_fields]
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, (tuple, list)):
        return [path for v in value for path in data_files_in(v)]
    return [value] if isinstance(value, Path) else []


def data_file_places(paths: Iterable[Path]) -> dict[Path, str]:
    """Path -> "data/name", names kept apart where two files of different folders share one."""
    places: dict[Path, str] = {}
    taken: set[str] = set()
    for path in paths:
        number, name = 1, path.name
        while name.lower() in taken:
            number += 1
            name = f"{path.stem}-{number}{path.suffix}"
        taken.add(name.lower())
        places[path] = f"data/{name}"
    return places


# -- TOML ----------------------------------------------------------------------------------------------------------------------


def toml_text(tables: Mapping[str, Any], path: str = "") -> str:
    """TOML text of raw tables: the values of each table first, then its sub-tables."""
    lines = [f"{toml_key(key)} = {toml_value(value)}" for key, value in tables.items() if not _is_table(value)]
    text = "".join(f"{line}\n" for line in lines)
    for key, value in tables.items():
        if _is_table(value):
            place, several = f"{path}{toml_key(key)}", isinstance(value, list)
            for table in value if several else [value]:
                text += f"{_heading(place, table, several)}{toml_text(table, f'{place}.')}"
    return text


def _heading(path: str, table: Mapping[str, Any], several: bool) -> str:
    """The line that opens a table; a table of nothing but tables needs none."""
    if several:
        return f"\n[[{path}]]\n"
    return "" if table and all(isinstance(value, dict) for value in table.values()) else f"\n[{path}]\n"


def _is_table(value: Any) -> bool:
    return isinstance(value, dict) or (isinstance(value, list) and bool(value) and isinstance(value[0], dict))


def toml_value(value: Any) -> str:
    """A value as TOML text on one line."""
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(toml_value, value)) + "]"
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{toml_key(key)} = {toml_value(v)}" for key, v in value.items()) + " }" if value else "{}"
    return repr(value)


def toml_key(step: str) -> str:
    """One step of a key: in quotes where it is empty or has odd characters."""
    return step if re.fullmatch(r"[A-Za-z0-9_-]+", step) else toml_value(step)


# -- digest --------------------------------------------------------------------------------------------------------------------


def canonical_text(spec: Any, leave_out: Iterable[str] = ()) -> str:
    """The same text for equal specs, however they are written: SI, keys sorted, data files by content."""
    fields = {name: field for name, field in type(spec).model_fields.items() if name not in leave_out}
    tables = {name: _canonical(getattr(spec, name), field) for name, field in fields.items()}
    return json.dumps(tables, sort_keys=True, separators=(",", ":"))


def _canonical(value: Any, field: Any = None) -> Any:
    if isinstance(value, BaseModel):
        return {name: _canonical(getattr(value, name), field) for name, field in type(value).model_fields.items()}
    if isinstance(value, (tuple, list)):
        return [_canonical(v, field) for v in value]
    if isinstance(value, dict):
        return {name: _canonical(v, field) for name, v in value.items()}
    if isinstance(value, Path):
        return _content(value)
    if marker_of(field, AnyUnit) and not isinstance(value, bool):
        return _canonical_quantity(value)
    return (value + 0.0).hex() if isinstance(value, float) else value  # + 0.0: -0.0 is 0.0


def _canonical_quantity(value: Any) -> Any:
    """The same for "30 mm" and "3 cm", whatever kind of quantity it is; other text as it stands."""
    if value is None:
        return None
    try:
        number, dimensionality = any_quantity(value) if isinstance(value, str) else (float(value), ())
    except UnitError:
        return value
    return [(number + 0.0).hex(), dimensionality]


def _content(path: Path) -> str:
    try:
        return hashlib.sha256(path.read_bytes()).hexdigest()
    except OSError as error:
        raise SpecError(f"data file {str(path)!r} cannot be read: {error.strerror}") from None
