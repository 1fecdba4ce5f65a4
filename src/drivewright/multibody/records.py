"""Tables of records: how the descriptions of bodies, joints and forces reach the compiled kernels."""

from collections.abc import Iterable, Mapping
from typing import Any, TypeAlias

import numpy as np

Records: TypeAlias = Any  # np.recarray: an array whose fields are attributes, which type checkers do not know
OneRecord: TypeAlias = Any  # np.record: one of its records
Values: TypeAlias = Mapping[str, float]  # field -> value of one record; what is left out is zero


def record_type(integers: str, reals: str) -> np.dtype:
    """The type of a record with integer and real fields, their names apart by blanks."""
    return np.dtype([(name, np.int64) for name in integers.split()] + [(name, np.float64) for name in reals.split()])


def record_of(kind: np.dtype, values: Values) -> np.ndarray:
    """One record (a 0-d array)."""
    record = np.zeros((), kind)
    for name, value in values.items():
        record[name] = value
    return record


def table_of(kind: np.dtype, rows: Iterable[Values]) -> Records:
    """Records (n,) of a kind."""
    return np.array([record_of(kind, row) for row in rows], dtype=kind).view(np.recarray)
