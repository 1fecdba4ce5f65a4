"""The levels behind a file of points, where its points are all combinations of some: a full factorial design."""

import math
from dataclasses import replace
from itertools import combinations

import numpy as np

from drivewright._typing import Ints
from drivewright.studies.plan import Plan

MOST_AXES = 4  # keys that are crossed with each other in a file


def crossed(plan: Plan) -> tuple[Plan, Ints]:
    """(plan of levels with the same cases, number that each case has there); the plan itself where its file is no full factorial.

    The levels of the file come after those of the plan, so that a case changes its place only within the file.
    """
    coded = {variable: _coded(column) for variable, column in plan.listed.items()}
    axes = _axes(coded, plan.inner)
    if not axes:
        return plan, np.arange(len(plan))
    grid = (*plan.grid, *(replace(variable, levels=coded[variable][0]) for variable in axes))
    start = np.arange(len(plan) // plan.inner) * plan.inner
    number = start[:, None] + _numbers([coded[variable] for variable in axes])
    return replace(plan, grid=grid, points=np.zeros((1, 0)), listed={}), number.ravel()


def _coded(column):
    """(levels of a column, numbers by size and words as they first come; place of each row's entry among them)."""
    levels, first, places = np.unique(column, return_index=True, return_inverse=True)
    order = np.arange(len(levels)) if column.dtype.kind in "iuf" else np.argsort(first)
    return levels[order], np.argsort(order)[places]


def _axes(coded, count):
    """The fewest columns, numbers in one at least, of whose levels the rows are all combinations; the first such columns, or none.

    Every other column is then a function of these.
    """
    several = [variable for variable, (levels, _) in coded.items() if len(levels) > 1]
    for number in range(2, MOST_AXES + 1):
        for chosen in combinations(several, number):
            if any(coded[variable][0].dtype.kind in "iuf" for variable in chosen) and _full([coded[v] for v in chosen], count):
                return chosen
    return ()


def _full(columns, count):
    """Whether `count` rows are all combinations of the levels, each of them once."""
    return math.prod(len(levels) for levels, _ in columns) == count == len(np.unique(_numbers(columns)))


def _numbers(columns):
    """Number of each row's combination of levels, the first column slowest."""
    return np.ravel_multi_index([places for _, places in columns], [len(levels) for levels, _ in columns])
