"""Tables of records: how the descriptions of bodies, joints and forces reach the compiled kernels."""

from collections.abc import Iterable, Mapping
from typing import Any, TypeAlias

import numpy as np

Records: TypeAlias = Any  # np.recarray: an array whose fields are attributes, which type checkers do not know
OneRecord: TypeAlias = Any  # np.record: one of its records
Values: TypeAlias = Mapping[str, float]  # field -> value of one record; what is left out is zero


def record_type(integers: str, reals: str) -> np.dtype:
    """The type of a record with integer and real fields, their names apart by blanks."""
    fields = [(name, np.int64) for name in integers.split()] + [(name, np.float64) for name in reals.split()]
    return np.dtype((np.record, fields))


def table_of(kind: np.dtype, rows: Iterable[Values]) -> Records:
    """Records (n,) of a kind."""
    return np.array([_members(kind, row) for row in rows], kind).view(np.recarray)


def empty_table(kind: np.dtype, *shape: int) -> Records:
    """Records of a kind, all of them zero."""
    return np.zeros(shape, kind).view(np.recarray)


def _members(kind, values):
    """The values in the order of the fields."""
    if unknown := values.keys() - kind.fields.keys():
        raise ValueError(f"a record has no field {', '.join(map(repr, sorted(unknown)))}; there are: {', '.join(kind.names)}")
    return tuple(values.get(name, 0) for name in kind.names)
