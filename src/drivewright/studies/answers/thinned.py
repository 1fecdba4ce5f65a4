"""Of a study that is too large to be held, the cases that plots and contributions are made of: fewer levels, shorter samples."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from drivewright._typing import Ints
from drivewright.execution.case_table import CASE
from drivewright.studies.plan import Block, Plan
from drivewright.studies.study import Study

if TYPE_CHECKING:
    import pyarrow as pa

HELD = 200_000  # cases up to which a study is held as it is
CELLS = 10_000_000  # of the table of what is held of a larger one
LEAST = 200  # points that each combination of levels keeps, if there are so many
SAMPLED = ("sample", "a", "b", "mixed")  # blocks of points that may be cut short


@dataclass(frozen=True, eq=False)
class Thinned:
    """Some cases of a study as a study of its own; `numbers` are those of all its cases in the whole, ascending, `combinations` those of
    its combinations of levels."""

    study: Study
    numbers: Ints
    combinations: Ints
    remark: str


def is_large(study: Study) -> bool:
    """Whether only some of the cases are held; the columns of a file of points are in memory in any case."""
    return len(study.plan) > HELD and not study.plan.listed


def thinned(study: Study) -> Thinned:
    """`Thinned` of a large study."""
    plan = study.plan
    most = min(HELD, max(CELLS // len(study.column_names), 1000))
    levels = _fewer_levels(plan.shape, max(most // min(plan.inner, LEAST), 1))
    blocks = _shorter_blocks(plan, most // math.prod(map(len, levels)))
    rows = np.concatenate([rows for _, rows in blocks]) if plan.random else np.zeros(1, int)
    grid = np.ravel_multi_index(np.ix_(*levels), plan.shape).ravel() if plan.grid else np.zeros(1, int)
    numbers = (grid[:, None] * plan.inner + rows).ravel()
    fewer = replace(
        plan,
        grid=tuple(replace(each, levels=each.grid_levels[places]) for each, places in zip(plan.grid, levels, strict=True)),
        points=plan.points[rows],
        blocks=_renumbered(blocks),
    )
    return Thinned(replace(study, plan=fewer, rows=rows_of(study, numbers)), numbers, grid, _remark(plan, len(numbers)))


def _fewer_levels(shape: Sequence[int], most: int) -> list[Ints]:
    """Places of the levels that are kept of each key, evenly spread with both ends: at most so many combinations, two of each at least."""
    kept = list(shape)
    while math.prod(kept) > most and max(kept, default=0) > 2:
        axis = int(np.argmax(kept))
        others = math.prod(kept) // kept[axis]
        second = max((count for n, count in enumerate(kept) if n != axis), default=2)
        kept[axis] = max(most // others, min(second, kept[axis] - 1), 2)
    return [np.unique(np.round(np.linspace(0, count - 1, few)).astype(int)) for count, few in zip(shape, kept, strict=True)]


def _shorter_blocks(plan: Plan, most: int) -> list[tuple[str, Ints]]:
    """(name, rows that are kept) of each block of the points: the first points of a sample, all of what is none."""
    whole = sum(block.stop - block.start for block in plan.blocks if block.name not in SAMPLED)
    few = max((most - whole) // (1 if plan.block("sample") else len(plan.random) + 2), 2)
    return [(block.name, _kept(block, few, len(plan.random))) for block in plan.blocks]


def _kept(block: Block, few: int, keys: int) -> Ints:
    """Rows that are kept of a block; of mixed points the first `few` of each key."""
    rows = np.arange(block.start, block.stop)
    if block.name == "mixed":
        return rows.reshape(keys, -1)[:, :few].ravel()
    return rows[:few] if block.name in SAMPLED else rows


def _renumbered(blocks: Sequence[tuple[str, Ints]]) -> tuple[Block, ...]:
    """The blocks where nothing lies between them."""
    ends = np.cumsum([0, *(len(rows) for _, rows in blocks)]).tolist()
    return tuple(Block(name, start, stop) for (name, _), start, stop in zip(blocks, ends, ends[1:], strict=False))


def _remark(plan: Plan, held: int) -> str:
    """The cases that an answer covers."""
    how = [*(["fewer levels of each key"] if plan.grid else []), *(["the first points of each sample"] if plan.random else [])]
    return (
        f"the study has {len(plan)} cases: ends, means, percentiles and shares of cases that pass are those of all of them; plots, "
        f"contributions and the Pareto front are drawn from {held} of them ({' and '.join(how)})"
    )


def rows_of(study: Study, numbers: Ints) -> pa.Table:
    """The rows of some cases, by their ascending numbers."""
    import pyarrow as pa

    pieces = [study.schema.empty_table()]
    for table in study.batches():
        cases = np.asarray(table[CASE])
        places = np.minimum(np.searchsorted(numbers, cases), len(numbers) - 1)
        if np.any(chosen := numbers[places] == cases):
            pieces.append(table.filter(chosen))
    return pa.concat_tables(pieces)
