"""Pareto fronts: against the definition, pair by pair, and on fronts known in closed form."""

import numpy as np
import pytest

from drivewright.studies.pareto import classify_designs, nondominated

pytestmark = pytest.mark.analytical


def by_definition(points):
    """No other point is nowhere greater and somewhere smaller."""
    return np.array([not np.any(np.all(points <= p, axis=1) & np.any(points < p, axis=1)) for p in points])


@pytest.mark.parametrize("objectives", [1, 2, 3, 4, 5])
@pytest.mark.parametrize("levels", [3, 8, 10**6])
def test_the_front_is_the_definition(objectives, levels):
    """With few levels there are many ties and equal points."""
    points = np.random.default_rng(levels + objectives).integers(0, levels, (400, objectives)) - levels / 3
    expected = by_definition(points)
    assert 0 < expected.sum() < 400
    assert nondominated(points).tolist() == expected.tolist()


@pytest.mark.parametrize("objectives", [2, 3, 4])
def test_permutation_growing_scales_and_a_needless_objective_change_nothing(objectives):
    rng = np.random.default_rng(2)
    points = rng.normal(size=(300, objectives))
    front, mixed = nondominated(points), rng.permutation(300)
    assert nondominated(points[mixed]).tolist() == front[mixed].tolist()
    assert nondominated(np.exp(points) * 7 - 3).tolist() == front.tolist()
    assert nondominated(np.column_stack([points, np.zeros(300)])).tolist() == front.tolist()
    assert nondominated(np.column_stack([points, points[:, 0]])).tolist() == front.tolist()


def test_a_quarter_circle_is_its_own_front_and_equal_points_share_it():
    angle = np.linspace(0, np.pi / 2, 50)
    circle = np.column_stack([1 - np.cos(angle), 1 - np.sin(angle)])
    points = np.concatenate([circle, circle + 1e-9, circle[:3]])
    assert nondominated(points).tolist() == [True] * 50 + [False] * 50 + [True] * 3
    assert nondominated(np.array([[0.0, 1.0], [-0.0, 1.0]])).tolist() == [True, True]
    assert nondominated(np.zeros((0, 2))).tolist() == []


@pytest.mark.parametrize("objectives", [2, 3])
def test_a_hundred_thousand_rows_can_all_be_on_the_front(objectives):
    u = np.random.default_rng(1).random((100_000, objectives - 1))
    assert np.all(nondominated(np.column_stack([u, -u.sum(axis=1)])))


def test_goals_limits_and_missing_numbers():
    mass = np.array([1.0, 2.0, 3.0, 2.5, 0.5, np.nan])
    life = np.array([10.0, 20.0, 30.0, 15.0, 90.0, 90.0])
    passes = np.array([True, True, True, True, False, True])
    found = classify_designs((mass, life), ("minimise", "maximise"), passes)
    assert found.tolist() == ["front", "front", "front", "dominated", "fails", "absent"]
    found = classify_designs((mass, life), ("minimise", "minimise"), passes)
    assert found.tolist() == ["front", "dominated", "dominated", "dominated", "fails", "absent"]
    assert classify_designs((mass, life), ("minimise", "maximise"), np.zeros(6, bool)).tolist() == ["fails"] * 5 + ["absent"]
