"""The keys of a design as jobs see them: which have values, how a value is written, what a person calls them."""

import math
from collections.abc import Iterable
from typing import Any

from drivewright.errors import SpecError
from drivewright.execution.keys import FIXED, KeyKind, key_kind
from drivewright.spec import MechanismSpec, value_at
from drivewright.spec.keys import leaves
from drivewright.studio.design import Design, Tables
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
    """A key in words: an element of a list by its name where it has one."""
    place: Any = tables
    words = []
    for step in key.split("."):
        place = (
            place[int(step)]
            if isinstance(place, list) and step.isdecimal() and int(step) < len(place)
            else place.get(step)
            if isinstance(place, dict)
            else None
        )
        name = place.get("name") if isinstance(place, dict) and step.isdecimal() else None
        words.append((name if isinstance(name, str) and name else step).replace("_", " "))
    return " · ".join(words)


def plain(value: float, unit: str = "-") -> float | None:
    """A number in the unit people read, for JSON: None where there is none."""
    number = float(value) * display_unit(unit)[0]
    return number if math.isfinite(number) else None
