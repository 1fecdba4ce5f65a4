"""Dotted keys of raw tables: set, or taken out, in place."""

from collections.abc import Iterator
from typing import Any

from drivewright.errors import SpecError, brief, nearest
from drivewright.spec.document_limits import refuse_long_key
from drivewright.spec.fields import value_at


def set_key(tables: dict[str, Any], key: str, value: Any) -> dict[str, Any]:
    """Set a dotted key of raw tables, in place; list elements go by their `name` or number."""
    refuse_long_key(key)
    *path, last = key.split(".")
    place = tables
    for number, step in enumerate(path):
        place = _descend(place, step, ".".join(path[: number + 1]))
    if isinstance(place, list):
        place[_index(place, last, key)] = value
    elif isinstance(place, dict):
        place[last] = value
    else:
        raise SpecError(f"is no table, so it has no key {last!r}", key=".".join(path))
    return tables


def remove_key(tables: dict[str, Any], key: str) -> dict[str, Any]:
    """Take a dotted key out of raw tables, in place; SpecError where it is not there."""
    refuse_long_key(key)
    *path, last = key.split(".")
    place = tables
    for number, step in enumerate(path):
        place = _descend(place, step, ".".join(path[: number + 1]))
    if isinstance(place, list):
        del place[_index(place, last, key)]
    elif isinstance(place, dict) and last in place:
        del place[last]
    else:
        raise SpecError(f"is not there, so it cannot be removed; for an empty text write --set {key}='\"\"'", key=key)
    return tables


def leaves(tables: Any, path: tuple[str, ...] = ()) -> Iterator[tuple[str, Any]]:
    """(dotted key, raw value) of everything in raw tables that is no table; elements of lists by number."""
    for step, value in enumerate(tables) if isinstance(tables, list) else tables.items():
        here = (*path, str(step))
        if isinstance(value, (dict, list)):
            yield from leaves(value, here)
        else:
            yield ".".join(here), value


def key_by_name(spec: Any, key: str) -> str:
    """The same key of a spec with elements of lists by their `name` where they have one, so that two ways to say one key are one text."""
    steps = key.split(".")
    for n in range(1, len(steps)):
        holder = value_at(spec, ".".join(steps[:n]))
        if isinstance(holder, tuple):
            steps[n] = getattr(value_at(spec, ".".join(steps[: n + 1])), "name", None) or steps[n]
    return ".".join(steps)


def _descend(place: Any, step: str, key: str) -> Any:
    if isinstance(place, list):
        return place[_index(place, step, key)]
    if not isinstance(place, dict):
        raise SpecError("is no table", key=key)
    return place.setdefault(step, {})


def _index(elements: list[Any], step: str, key: str) -> int:
    """Number of the list element that a step names."""
    names = {e["name"]: i for i, e in enumerate(elements) if isinstance(e, dict) and isinstance(e.get("name"), str)}
    if step in names:
        return names[step]
    if step in map(str, range(len(elements))):
        return int(step)
    inside = f"named {', '.join(names)}" if names else f"numbered from 0 to {len(elements) - 1}" if elements else "none at all"
    raise SpecError(f"the list has no element {brief(step)}{nearest(step, names)}; it has {len(elements)}, {inside}", key=key)
