"""Many specs that differ in a few keys: tables without such a key are validated once, and all specs hold the same ones."""

from collections.abc import Iterable, Mapping
from typing import Any

from drivewright.spec.base import Spec


def share_tables(tables: Mapping[str, Any], spec: Spec, keys: Iterable[str]) -> dict[str, Any]:
    """Raw tables as `tables`, those of `spec`, in which every table that holds none of the dotted keys is the validated one of `spec`.

    They can be changed by `set_key` at these keys and validated like raw ones.  A table that is looked at as a whole before it is
    validated stays raw.
    """
    inside: dict[str, list[str]] = {}
    for key in keys:
        step, _, rest = key.partition(".")
        inside.setdefault(step, []).append(rest)
    if any(each.info.mode != "after" for each in type(spec).__pydantic_decorators__.model_validators.values()):
        return dict(tables)
    return {name: _shared(raw, getattr(spec, name, None), inside.get(name, ())) for name, raw in tables.items()}


def _shared(raw: Any, validated: Any, keys: Iterable[str]) -> Any:
    """One entry of the tables: the validated one, a copy of which a part is validated, or the raw one."""
    if not keys:
        return validated if _is_table(validated) else raw
    return share_tables(raw, validated, keys) if isinstance(raw, dict) and isinstance(validated, Spec) and all(keys) else raw


def _is_table(validated: Any) -> bool:
    """Whether it is a table, or a list or dictionary of tables alone."""
    parts = validated.values() if isinstance(validated, dict) else validated if isinstance(validated, tuple) else (validated,)
    return all(isinstance(part, Spec) for part in parts)
