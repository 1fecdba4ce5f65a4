"""A study as a frame of pandas, a row per case, and as a dataset of xarray, an axis per key of its grid."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from drivewright import frames
from drivewright.errors import counted
from drivewright.execution.case_table import CASE, key_info
from drivewright.frames import Variable
from drivewright.studies.plan import Plan

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

    from drivewright.studies.study import Study

SAMPLE = "sample"  # the axis of the points that come with each combination of levels
LARGEST = 20_000_000  # numbers that are held at once


def study_frame(study: Study) -> pd.DataFrame:
    """A row per case, the case its index, a column per key and value in SI; `attrs` has units and labels."""
    _refuse_large(len(study), study)
    return frames.frame(study.table, CASE, mechanism=study.spec.mechanism, title=study.spec.title)


def study_dataset(study: Study) -> xr.Dataset:
    """An axis per key of the grid and one named "sample" for the points that come with its levels; nan where a case is not there.

    Keys are coordinates: those that follow another key lie along its axis, random ones and those of a file along "sample".
    """
    plan, (sizes, axes) = study.plan, _axes(study.plan)
    _refuse_large(len(plan), study)
    taken, cases = {CASE, *plan.keys}, np.asarray(study[CASE], int)
    variables = {
        name: Variable(axes, _laid_out(study[name], cases, sizes), study.unit(name), study.label(name), study.meaning(name))
        for name in study.column_names
        if name not in taken
    }
    spec = study.spec
    return frames.dataset(variables, _coordinates(plan), mechanism=spec.mechanism, title=spec.title, digest=spec.digest())


def _axes(plan: Plan) -> tuple[tuple[int, ...], tuple[str, ...]]:
    """(sizes, names) of the axes, in the order in which cases are numbered."""
    inner = plan.listed or plan.random or not plan.grid
    return (*plan.shape, *((plan.inner,) if inner else ())), (*(each.key for each in plan.grid), *((SAMPLE,) if inner else ()))


def _coordinates(plan: Plan) -> dict[str, Variable]:
    """The values of every key along its axis."""
    along = [(each, each.key, each.grid_levels) for each in plan.grid]
    along += [(each, SAMPLE, np.asarray(column)) for each, column in plan.listed.items()]
    points = np.asarray(plan.points[np.arange(plan.inner)]).T if plan.random else ()
    along += [(each, SAMPLE, column) for each, column in zip(plan.random, points, strict=True)]
    return {
        key: Variable((axis,), values, "" if values.dtype == object else variable.kind.unit, key_info(key, "", "").label)
        for variable, axis, column in along
        for key, values in variable.columns(column).items()
    }


def _laid_out(column: NDArray[Any], cases: NDArray[np.int64], sizes: tuple[int, ...]) -> NDArray[Any]:
    """The column of some cases on the grid of all; nan, or an empty text, where a case is not there."""
    numbers = column.dtype.kind in "iufb"
    whole = np.full(int(np.prod(sizes)), np.nan) if numbers else np.full(int(np.prod(sizes)), "", object)
    whole[cases] = column
    return whole.reshape(sizes)


def _refuse_large(rows: int, study: Study) -> None:
    """InputError for more numbers than should be held at once."""
    counted(rows * len(study.column_names), LARGEST, "numbers of a study at once", "take the rows piece by piece: `study.batches(names)`")
