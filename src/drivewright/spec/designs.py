"""Many designs in one spec: arrays in the place of its numbers, for formulas that take arrays; nothing is validated again."""

import operator
from collections.abc import Mapping, Sequence
from typing import Any, TypeVar

import numpy as np

from drivewright._typing import Bools, Floats
from drivewright.spec.fields import field_at, type_of, value_at
from drivewright.spec.mechanism_spec import MechanismSpec

SpecT = TypeVar("SpecT", bound=MechanismSpec)
LIMITS = {"gt": operator.gt, "ge": operator.ge, "lt": operator.lt, "le": operator.le}


def sample_of(spec: MechanismSpec, key: str) -> float:
    """A number that the key can have: the spec's own where it has one."""
    own = value_at(spec, key)
    return float(own) if isinstance(own, (int, float)) else 1.0


def with_columns(spec: SpecT, columns: Mapping[str, Floats]) -> SpecT:
    """The spec with arrays (n,) in the place of the numbers at dotted keys."""
    for key, column in columns.items():
        spec = _replaced(spec, key.split("."), column)
    return spec


def _replaced(table: Any, steps: Sequence[str], column: Floats) -> Any:
    """A table, or a list, with the column at the end of the steps."""
    first, *rest = steps
    if isinstance(table, tuple):
        return tuple(column if number == int(first) else entry for number, entry in enumerate(table))
    return table.model_copy(update={first: _replaced(getattr(table, first), rest, column) if rest else column})


def within_limits(model: type[MechanismSpec], columns: Mapping[str, Floats], count: int) -> Bools:
    """Which of `count` designs are finite, whole where a field wants it, and within the limits of every field (count,)."""
    good = np.ones(count, bool)
    for key, column in columns.items():
        field = field_at(model, key.split("."))
        assert field is not None
        good &= np.isfinite(column)
        if type_of(field.annotation) is int:
            good &= column == np.floor(column)
        for mark in field.metadata:
            for name, holds in LIMITS.items():
                if (limit := getattr(mark, name, None)) is not None:
                    good &= holds(column, limit)
    return good
