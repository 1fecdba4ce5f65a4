"""The keys of a design as jobs see them: which have values, how a value is written, what a person calls them."""

import math
from collections.abc import Iterable
from typing import Any

from drivewright import registry
from drivewright.errors import SpecError
from drivewright.execution.keys import FIXED, KeyKind, key_kind
from drivewright.spec import MechanismSpec, value_at
from drivewright.spec.keys import leaves
from drivewright.studio.design import Design, Tables
from drivewright.studio.field_info import field_info_at
from drivewright.view.text import display_unit


def numeric(design: Design, spec: MechanismSpec) -> dict[str, tuple[KeyKind, float]]:
    """{dotted key: (KeyKind, value in SI)} of the quantities and numbers that a design gives; whole numbers do not vary by per cent."""
    numbers = {}
    for key, _ in leaves(design.tables):
        try:
            kind = key_kind(spec, key) if key.split(".")[0] not in FIXED else None
        except SpecError:  # a file, or a list that is one value
            continue
        value = value_at(spec, key)
        if kind and kind.name in ("quantity", "number") and isinstance(value, float):
            numbers[key] = kind, value
    return numbers


def numbered(tables: Tables, key: str) -> str:
    """A dotted key whose list elements go by number, whether they were named or not."""
    steps, place = [], tables
    for step in key.split("."):
        if isinstance(place, list):
            named = [n for n, entry in enumerate(place) if isinstance(entry, dict) and entry.get("name") == step]
            step = str(named[0]) if named else step
            place = place[int(step)] if step.isdecimal() and int(step) < len(place) else None
        else:
            place = place.get(step) if isinstance(place, dict) else None
        steps.append(step)
    return ".".join(steps)


def is_locked(tables: Tables, key: str, locks: Iterable[str]) -> bool:
    """Whether a key, or a table or list that it is in, is locked."""
    key = numbered(tables, key)
    return any(key == lock or key.startswith(f"{lock}.") for lock in (numbered(tables, lock) for lock in locks))


def input_text(kind: KeyKind, value: Any) -> str:
    """A value of a column as a person writes it into the spec, to the last digit."""
    given = kind.given(value)
    if kind.dimension and not isinstance(given, str):
        return kind.dimension.text(float(given))
    return str(given).lower() if isinstance(given, bool) else repr(given) if isinstance(given, float) else str(given)


def label(tables: Tables, key: str) -> str:
    """A key in words, as the form names it: an element of a list by its name or counted from 1, a part of a point by its axis."""
    place: Any = tables
    words = []
    steps = key.split(".")
    for at, step in enumerate(steps):
        part = _part(tables, steps[:at], step) if step.isdecimal() and not isinstance(place, dict) else step
        place = _inside(place, step)
        name = place.get("name") if isinstance(place, dict) and step.isdecimal() else None
        words.append((name if isinstance(name, str) and name else part).replace("_", " "))
    return " · ".join(words)


def _inside(place: Any, step: str) -> Any:
    """What lies at a step of a key: in a list by its number or name; None where nothing is given."""
    if isinstance(place, dict):
        return place.get(step)
    elements = place if isinstance(place, list) else []
    if step.isdecimal():
        return elements[int(step)] if int(step) < len(elements) else None
    return next((each for each in elements if isinstance(each, dict) and each.get("name") == step), None)


def _part(tables: Tables, places: list[str], step: str) -> str:
    """What an entry of a list is called that has no name of its own."""
    kind = tables.get("mechanism")
    info = field_info_at(registry.mechanism(kind).spec, places) if kind in registry.kinds() and places else None
    number = int(step)
    return info.parts[number] if info and number < len(info.parts) else str(number + 1)


def plain(value: float, unit: str = "-") -> float | None:
    """A number in the unit people read, for JSON: None where there is none."""
    number = float(value) * display_unit(unit)[0]
    return number if math.isfinite(number) else None
