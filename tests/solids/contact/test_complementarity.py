"""The quadratic programme behind contact: its conditions on random cases, by the active set and by the interior point method."""

import numpy as np
import pytest

from drivewright.solids.contact import complementarity
from drivewright.solids.contact.complementarity import solve_complementarity

pytestmark = pytest.mark.property


def random_case(seed, count=40, motions=3, sided=0.8):
    rng = np.random.default_rng(seed)
    root = rng.normal(size=(count, count)) / np.sqrt(count)
    matrix = root @ root.T + 0.05 * np.eye(count)
    held = rng.normal(size=(motions, count))
    one_sided = rng.random(count) < sided
    load = -held @ rng.random(count)
    return matrix, rng.normal(size=count), held, load, one_sided


def check(case, found):
    matrix, right, held, load, one_sided = case
    gap = matrix @ found.x + right + held.T @ found.motions
    assert held @ found.x + load == pytest.approx(0, abs=1e-8)
    assert np.all(found.x[one_sided] >= 0)
    assert np.all(gap[one_sided] > -1e-8)
    assert gap[~one_sided] == pytest.approx(0, abs=1e-8)
    assert found.x[one_sided] * gap[one_sided] == pytest.approx(0, abs=1e-8)


@pytest.mark.parametrize("seed", range(12))
def test_no_place_pulls_and_none_overlaps(seed):
    case = random_case(seed)
    check(case, solve_complementarity(*case))


@pytest.mark.parametrize("seed", range(12))
def test_the_interior_point_method_finds_the_same(seed, monkeypatch):
    case = random_case(seed)
    expected = solve_complementarity(*case)
    first = complementarity._active_set
    calls = []

    def second_only(*args):
        calls.append(1)
        return None if len(calls) == 1 else first(*args)

    monkeypatch.setattr(complementarity, "_active_set", second_only)
    found = solve_complementarity(*case)
    check(case, found)
    assert found.x == pytest.approx(expected.x, abs=1e-8)


def test_units_of_the_unknowns_change_nothing():
    matrix, right, held, load, one_sided = random_case(3)
    scale = np.exp(np.random.default_rng(1).normal(scale=4.0, size=len(right)))
    expected = solve_complementarity(matrix, right, held, load, one_sided)
    other = solve_complementarity(matrix * np.outer(scale, scale), right * scale, held * scale, load, one_sided)
    assert other.x * scale == pytest.approx(expected.x, rel=1e-6, abs=1e-9)


def test_starting_from_the_answer_takes_it():
    case = random_case(5)
    expected = solve_complementarity(*case)
    again = solve_complementarity(*case, expected.pressing)
    assert np.array_equal(again.pressing, expected.pressing)
    assert again.x == pytest.approx(expected.x, abs=1e-10)
