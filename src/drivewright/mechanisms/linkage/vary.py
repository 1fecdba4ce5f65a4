"""A linkage's spec with other values at some of its keys."""

from collections.abc import Mapping
from typing import Any

from drivewright.mechanisms.linkage.refusals import refuse_nonsense
from drivewright.mechanisms.linkage.spec import LinkageSpec
from drivewright.spec import dimension_at
from drivewright.units import SI


def varied(spec: LinkageSpec, changes: Mapping[str, Any]) -> LinkageSpec:
    """The spec with keys {dotted key: SI value} changed; the changed tables and the whole are checked as on reading."""
    for key, value in changes.items():
        spec = _changed(spec, key.split("."), SI(value) if dimension_at(type(spec), key)[1] else value)
    refuse_nonsense(spec)
    return spec


def _changed(node: Any, path: list[str], value: Any) -> Any:
    """A copy of a table, a list of named tables or a table of tables with the value at the path changed."""
    step, *rest = path
    if isinstance(node, tuple):
        return tuple(_changed(one, rest, value) if step in (getattr(one, "name", None), str(n)) else one for n, one in enumerate(node))
    if isinstance(node, dict):
        return type(node)({**node, step: _changed(node[step], rest, value)})
    return node.model_copy(update={step: _changed(getattr(node, step), rest, value)}) if rest else node.replace(**{step: value})
