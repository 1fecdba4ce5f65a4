"""Quantities whose unit is one of another kind, and what they are read as: "25 Hz" of an angular speed as 25 rev/s."""

from collections.abc import Iterator, Mapping
from typing import Any

from pydantic import BaseModel

from drivewright.errors import brief
from drivewright.spec.fields import dimension_of
from drivewright.units import Dimension, has_two_readings


def readings(spec: Any, tables: Any) -> dict[str, str]:
    """{dotted key: "drive.speed: '25 Hz' is read as 25 rev/s"} of a spec and the raw tables that it was made from."""
    if not _any_has_two_readings(tables):  # like almost every spec: its fields need no look
        return {}
    return {key: f"{key}: {brief(text)} is read as {reading}" for key, text, reading in _readings(spec, tables, "", None)}


def _any_has_two_readings(raw: Any) -> bool:
    if isinstance(raw, str):
        return has_two_readings(raw)
    entries = raw.values() if isinstance(raw, Mapping) else raw if isinstance(raw, (list, tuple)) else ()
    return any(map(_any_has_two_readings, entries))


def _readings(value: Any, raw: Any, key: str, dimension: Dimension | None) -> Iterator[tuple[str, str, str]]:
    """(key, text, what it is read as) of everything below a key; `dimension` is that of the field it belongs to."""
    if isinstance(raw, str) and dimension and (reading := dimension.reading(raw)):
        yield key, raw, reading
    for step, inner, entry, kind in _below(value, raw, dimension):
        yield from _readings(inner, entry, f"{key}.{step}" if key else str(step), kind)


def _below(value, raw, dimension):
    """(step, value, raw value, dimension) of the keys of a table, the entries of a list."""
    if isinstance(value, BaseModel) and isinstance(raw, Mapping):
        fields = type(value).model_fields
        return [(name, getattr(value, name), raw[name], dimension_of(fields[name])) for name in raw if name in fields]
    if isinstance(value, dict) and isinstance(raw, Mapping):
        return [(name, value[name], raw[name], dimension) for name in raw if name in value]
    if isinstance(value, tuple) and isinstance(raw, (list, tuple)) and len(value) == len(raw):
        return [(place, *each, dimension) for place, each in enumerate(zip(value, raw, strict=True))]
    return []
