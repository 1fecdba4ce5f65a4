"""Many designs in one spec: arrays in the place of its numbers, for formulas that take arrays; nothing is validated again."""

import operator
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, TypeVar

import numpy as np

from drivewright._typing import Bools, Floats, Ints, Numbers
from drivewright.errors import DrivewrightError, InputError
from drivewright.result import Answer
from drivewright.spec.fields import Frozen, field_at, type_of, value_at
from drivewright.spec.mechanism_spec import MechanismSpec

SpecT = TypeVar("SpecT", bound=MechanismSpec)
ResultT = TypeVar("ResultT")
BLOCK = 8192  # designs at a time: their arrays stay in the processor's cache
LIMITS = {"gt": operator.gt, "ge": operator.ge, "lt": operator.lt, "le": operator.le}


def evaluator(
    spec: SpecT,
    keys: Sequence[str],
    names: Sequence[str],
    quantities: Callable[[SpecT], Mapping[str, Floats]],
    possible: Callable[[Mapping[str, Floats], int], Bools],
) -> Callable[[Floats], dict[str, Floats]] | None:
    """designs (n, keys) in SI -> {name: (n,)}, in blocks; nan in every name where a design is impossible or one of the names not finite.

    quantities: everything there is of a spec with arrays in it; possible: columns and their length -> which designs the spec accepts.
    None where no design can be built, or a name is not among the quantities.
    """
    try:
        known = quantities(with_columns(spec, {key: np.array([sample_of(spec, key)]) for key in keys}))
    except InputError:  # the run of one design says why
        return None
    if not set(names) <= set(known):
        return None

    def blocks(columns, rows):
        for start in range(0, len(rows), BLOCK):
            block = rows[start : start + BLOCK]
            everything = quantities(with_columns(spec, {key: column[block] for key, column in columns.items()}))
            wanted = {name: np.broadcast_to(everything[name], block.shape) for name in names}
            exist = np.all([np.isfinite(column) for column in wanted.values()], axis=0)
            yield block[exist], {name: column[exist] for name, column in wanted.items()}

    return evaluator_of_blocks(keys, names, possible, blocks)


def evaluator_of_blocks(
    keys: Sequence[str],
    names: Sequence[str],
    possible: Callable[[Mapping[str, Floats], int], Bools],
    blocks: Callable[[Mapping[str, Floats], Ints], Iterable[tuple[Ints, Mapping[str, Numbers]]]],
) -> Callable[[Floats], dict[str, Floats]]:
    """designs (n, keys) in SI -> {name: (n,)}; nan in every name of an impossible design, and in a name that a block does not give.

    possible: columns and their length -> which designs the spec accepts; blocks: columns and the numbers of these designs -> some of the
    designs, with their numbers by name, block by block.
    """

    def evaluate(designs: Floats) -> dict[str, Floats]:
        """{name: (n,)} of designs (n, d)."""
        columns = dict(zip(keys, np.asarray(designs, float).T, strict=True))
        values = {name: np.full(len(designs), np.nan) for name in names}
        for rows, given in blocks(columns, np.flatnonzero(possible(columns, len(designs)))):
            for name, column in values.items():
                column[rows] = given.get(name, np.nan)
        return values

    return evaluate


def accepted_blocks(rows: Ints, evaluate: Callable[[Ints], ResultT], size: int) -> Iterator[tuple[Ints, ResultT]]:
    """(rows, evaluate(rows)) of designs by their numbers, at most `size` at a time.

    A block in which one of our errors is raised is halved, until the designs that it is about are alone; these are left out.
    """
    for start in range(0, len(rows), size):
        yield from _accepted(rows[start : start + size], evaluate)


def _accepted(rows, evaluate):
    try:
        yield rows, evaluate(rows)
    except DrivewrightError:
        if len(rows) > 1:
            for half in np.array_split(rows, 2):
                yield from _accepted(half, evaluate)


def numbers_of(answer: Answer) -> Iterator[tuple[str, Any]]:
    """(name, number) of the values, and `check.NAME` with the margin of the checks, of an answer."""
    yield from ((name, value.value) for name, value in answer.values.items())
    yield from ((f"check.{check.name}", check.counted_margin) for check in answer.checks)


def sample_of(spec: MechanismSpec, key: str) -> float:
    """A number that the key can have: the spec's own where it has one."""
    own = value_at(spec, key)
    return float(own) if isinstance(own, (int, float)) else 1.0


def with_samples(spec: SpecT, keys: Sequence[str]) -> SpecT:
    """The spec with a number at those of the keys where it has none."""
    return with_columns(spec, {key: sample_of(spec, key) for key in keys if value_at(spec, key) is None})


def with_columns(spec: SpecT, columns: Mapping[str, Numbers]) -> SpecT:
    """The spec with arrays, or other numbers, in the place of the numbers at dotted keys."""
    for key, column in columns.items():
        spec = _replaced(spec, key.split("."), column)
    return spec


def _replaced(table: Any, steps: Sequence[str], column: Numbers) -> Any:
    """A table, a list or a table of the user's keys with the column at the end of the steps."""
    first, *rest = steps
    if isinstance(table, tuple):
        names = [getattr(entry, "name", None) for entry in table]
        own = names.index(first) if first in names else int(first)
        return tuple((_replaced(entry, rest, column) if rest else column) if number == own else entry for number, entry in enumerate(table))
    if isinstance(table, dict):
        return Frozen({**table, first: _replaced(table[first], rest, column) if rest else column})
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
