"""Arrays of many cases for kernels that compute them at once: the cases lie side by side in the last axis."""

from typing import Any

import numpy as np

from drivewright._typing import Floats

WIDTH = 8  # cases at once: the numbers in a vector register of AVX-512, two of AVX2


class LaneArray:
    """An array of numbers, or a table of records, of `WIDTH` cases."""

    def __init__(self, values: np.ndarray):
        """values: (..., WIDTH) of numbers, or (...) of records of `record_kind`."""
        self.values = np.ascontiguousarray(values)
        self.is_table = self.values.dtype.names is not None
        self.ndim = self.values.ndim - (0 if self.is_table else 1)

    @property
    def bytes(self) -> np.ndarray:
        """(..., bytes of an element)."""
        shape = self.values.shape[: self.ndim]
        return self.values.reshape(-1).view(np.uint8).reshape(*shape, self.item_bytes)

    @property
    def item_bytes(self) -> int:
        """Bytes of an element."""
        return self.values.dtype.itemsize if self.is_table else 8 * WIDTH

    @property
    def fields(self) -> tuple[tuple[str, int, bool], ...]:
        """(name, place in bytes, whether it is an integer) of the members of a record; () of numbers."""
        if not self.is_table:
            return ()
        members: Any = self.values.dtype.fields
        return tuple((name, members[name][1], members[name][0].kind == "i") for name in members)


class LaneNumber:
    """A number of `WIDTH` cases."""

    def __init__(self, numbers: Floats):
        self.numbers = np.ascontiguousarray(numbers, float)


def record_kind(kind: np.dtype) -> np.dtype:
    """The type of records whose real members have lanes."""
    members: Any = kind.fields
    return np.dtype([(name, np.int64) if members[name][0].kind == "i" else (name, np.float64, (WIDTH,)) for name in members])


def in_lanes(value: Any, made: dict[int, Any] | None = None) -> Any:
    """A tuple of numbers, arrays and tables, nested ones included, with the same case in all lanes; what holds integers stays as it is.

    What stands in several places stays one (`made`: by identity, what stands for it).
    """
    made = {} if made is None else made
    if id(value) not in made:
        made[id(value)] = _in_lanes(value, made)
    return made[id(value)]


def _in_lanes(value, made):
    if isinstance(value, tuple):
        parts = [in_lanes(each, made) for each in value] if _has_numbers(value) else value
        return getattr(type(value), "_make", tuple)(parts)
    if isinstance(value, float):
        return LaneNumber(np.full(WIDTH, value))
    if not isinstance(value, np.ndarray) or value.dtype.kind not in "fV":
        return value
    if value.dtype.names is None:
        return LaneArray(np.repeat(value[..., None], WIDTH, axis=-1))
    table = LaneArray(np.zeros(value.shape, record_kind(value.dtype)))
    for name in value.dtype.names:
        table.values[name] = _with_axis(value, name)
    return table


def put_in_lane(laned: Any, lane: int, value: Any) -> None:
    """Write a case, alike in `structure`, into one lane of what `in_lanes` made."""
    if isinstance(laned, LaneNumber):
        laned.numbers[lane] = value
    elif isinstance(laned, LaneArray) and not laned.is_table:
        laned.values[..., lane] = value
    elif isinstance(laned, LaneArray):
        for name, _, is_integer in laned.fields:
            if not is_integer:
                laned.values[name][..., lane] = value[name]
    elif isinstance(laned, tuple):
        for whole, part in zip(laned, value, strict=True):
            put_in_lane(whole, lane, part)


def take_from_lane(laned: Any, lane: int, value: Any) -> None:
    """Write one lane back into the arrays (not tables) of a case, nested ones included."""
    if isinstance(laned, LaneArray):
        value[...] = laned.values[..., lane]
    elif isinstance(laned, tuple):
        for whole, part in zip(laned, value, strict=True):
            take_from_lane(whole, lane, part)


def structure(value: Any) -> tuple[object, ...]:
    """What cases must have in common to be computed side by side: classes, shapes, and all integers."""
    if isinstance(value, tuple):
        return (type(value), *(structure(each) for each in value))
    if isinstance(value, float):
        return ()
    if not isinstance(value, np.ndarray):
        return (value,)
    if value.dtype.names is not None:
        integers = [name for name in value.dtype.names if value.dtype[name].kind == "i"]
        return (value.shape, value.dtype.names, *(np.asarray(value)[name].tobytes() for name in integers))
    return (value.shape, b"" if value.dtype.kind == "f" else value.tobytes())


def is_of_compiler(fault: BaseException | None) -> bool:
    """Whether a fault says that a kernel cannot be compiled for arguments in lanes."""
    from numba.core.errors import NumbaError

    return isinstance(fault, NumbaError | NotImplementedError)


def _has_numbers(value):
    """Whether a case may differ from another one in this tuple."""
    return any(_has_numbers(each) if isinstance(each, tuple) else isinstance(each, float | np.ndarray) for each in value)


def _with_axis(table, name):
    """A column of a table as it stands in its records in lanes: real numbers with a last axis."""
    column = np.asarray(table)[name]
    return column if column.dtype.kind == "i" else column[..., None]
