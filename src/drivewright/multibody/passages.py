"""What meets in a singular position: how many branches, whether two of them touch, and how singular it is."""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.multibody.chart import solve_kinematics
from drivewright.multibody.kinematics import evaluate_rows
from drivewright.multibody.partition import evaluate_at, scaled_jacobian
from drivewright.multibody.system import RESIDUAL, System, motion, scratch
from drivewright.numerics.linear import null_space

FOLDED = 1e-6  # singular value over the largest that counts as zero in a singular position
FOURTH = np.array([-1, 16, -30, 16, -1]) / 12  # second difference of the fourth order
TWICE = 1e-6  # discriminant of the tangents, over the squares of the quadratic form, below which two branches touch


class Passage(NamedTuple):
    """A singular position on the way: when, the coordinates there, the system with its chart, and what meets there.

    smallest: singular value of the loops' Jacobian without dimensions; tangents: number of directions that meet (at most, where several
    loops fold at once); touching: two branches have the same tangent, so that the second order decides.
    """

    time: float
    system: System
    state: Floats
    smallest: float
    tangents: int
    touching: bool


def passage(system: System, t: float, y: Floats) -> Passage:
    """The `Passage` of a state that stands in the singular position of its system's chart."""
    q = _configured(system, t, y).coordinates.q
    return Passage(float(t), system, np.array(y), _smallest(system, q, t), *_tangents(system, q, t))


def smallest_singular_values(system: System, t: Floats, y: Floats) -> Floats:
    """(m,) of the loops' Jacobian without dimensions, at states y (m, n) at the times t (m,); infinite without loops."""
    return np.array([_smallest(system, _configured(system, time, state).coordinates.q, time) for time, state in zip(t, y, strict=True)])


def _configured(system, t, y):
    moving = motion(system)
    solve_kinematics(moving.system, moving.work, t, y)
    return moving.work


def _smallest(system, q, t):
    columns = scaled_jacobian(system, evaluate_at(system, q, t), system.stored)
    return float(np.linalg.svd(columns, compute_uv=False)[-1]) if len(columns) else np.inf


def _tangents(system, q, t):
    """(number of directions in which a motion can go through, whether two of them coincide)."""
    coordinates = np.concatenate([system.stored, system.driven.coordinate])
    columns = scaled_jacobian(system, evaluate_at(system, q, t), coordinates)
    folded = int(np.sum(np.linalg.svd(columns, compute_uv=False) < FOLDED * np.linalg.norm(columns, 2)))
    if folded != 1 or len(coordinates) - len(columns) != 1:
        return 2**folded, False
    plane, across = null_space(columns, rcond=FOLDED), null_space(columns.T, rcond=FOLDED)[:, 0]
    form = _second_order(system, q, t, coordinates, plane, across)
    return 2, bool(form[0, 1] ** 2 - form[0, 0] * form[1, 1] < TWICE * np.sum(form**2))  # neither side depends on the base of the plane


def _second_order(system, q, t, coordinates, plane, across):
    """(2, 2) quadratic form whose zeros are the tangents: second derivative of the row that folds, in the plane of all that is free."""
    step = 1e-2

    def residual(way):
        there = q.copy()
        there[coordinates] += step * system.sizes[coordinates] * way
        return across @ (_free_misses(system, there) / system.rows.extent)

    def second(way):
        return sum(weight * residual(k * way) for k, weight in zip(range(-2, 3), FOURTH, strict=True)) / step**2

    one, two = plane.T
    mixed = (second(one + two) - second(one - two)) / 4
    return np.array([[second(one), mixed], [mixed, second(two)]])


def _free_misses(system, q):
    """Residuals at the coordinates q, driven ones where q has them."""
    work = scratch(system)
    work.coordinates.q = q
    evaluate_rows(system, work)
    return work.row_columns[RESIDUAL]
