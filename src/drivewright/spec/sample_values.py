"""Values that the keys of a spec could have: for the commented template and for forms."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, get_args, get_origin

from pydantic.fields import FieldInfo

from drivewright.registry import Mechanism
from drivewright.spec.fields import (
    AnyUnit,
    choices_of,
    containers_of,
    dimension_of,
    field_at,
    has_user_keys,
    list_depth,
    marker_of,
    table_of,
    type_of,
)
from drivewright.units import split

SAMPLE_NAME = "a"  # of a sample table
SAMPLES = {bool: False, int: 1, float: 1.0, str: "...", Path: "data.csv"}


def required_keys_sample(model: type[Any]) -> dict[str, Any]:
    """Sample values for the required keys of a table."""
    tables = {}
    for name, field in model.model_fields.items():
        if field.is_required():
            inner = table_of(field.annotation)
            table = required_keys_sample(inner) if inner else None
            several = {SAMPLE_NAME: table} if has_user_keys(field.annotation) else [table] if list_depth(field.annotation) else table
            tables[name] = sample_value(field) if inner is None else several
    return tables


def sample_value(field: FieldInfo) -> Any:
    """A value that a key could have."""
    if field.examples:
        return field.examples[0]
    dimension = dimension_of(field)
    one = f"1 {dimension.display_unit}" if dimension else 1.0 if marker_of(field, AnyUnit) else None
    return _nested_sample(field.annotation, one)


def _nested_sample(annotation, one):
    """A sample of a type, `one` standing for each quantity in its lists."""
    inner = [arg for arg in get_args(annotation) if arg not in (Ellipsis, type(None))]
    if get_origin(annotation) is dict:
        return {SAMPLE_NAME: _nested_sample(inner[1], one)}
    if get_origin(annotation) in (tuple, list):
        return [_nested_sample(arg, one) for arg in inner]
    if containers_of(annotation):
        return _nested_sample(inner[0], one)
    return one if one is not None else next(iter(choices_of(annotation)), SAMPLES.get(type_of(annotation), "..."))


def shared_table_samples(mechanism: Mechanism[Any, Any], given: Mapping[str, Any]) -> dict[str, Any]:
    """[optimise] and [study] tables that fit the kind: its first quantity as what changes, a headline value as the objective."""
    keys = [(f"{table}.{key}", value) for table, keys in given.items() if isinstance(keys, dict) for key, value in keys.items()]
    quantities = [
        (key, value)
        for key, value in keys
        if isinstance(value, str) and (field := field_at(mechanism.spec, key.split("."))) and dimension_of(field)
    ]
    if not quantities or not mechanism.headline:
        return {}
    key, value = quantities[0]
    number, unit = split(value)
    lower, upper = (f"{float(number) * share:.4g} {unit}" for share in (0.9, 1.1))
    required = {"value": mechanism.headline[-1], "at_least": 1.0, "at_most": 2.0}
    search = {
        "settings": [{"key": key, "value": value}],
        "unknowns": [{"key": key, "lower": lower, "upper": upper}],
        "objectives": [{"value": mechanism.headline[0]}],
        "requirements": [required],
    }
    return {"optimise": search, "study": {"vary": [{"key": key, "lower": lower, "upper": upper, "steps": 5}]}}
