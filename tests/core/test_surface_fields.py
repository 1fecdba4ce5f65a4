"""Fields on deformed surfaces: shape at a step, range, which steps are kept, arrays for a file."""

import numpy as np
import pytest

from drivewright.result import Answer, merge_answers
from drivewright.surface_fields import ScalarField, SurfaceBody, SurfaceFields, kept_steps, single

pytestmark = pytest.mark.analytical

RANDOM = np.random.default_rng(7)
POINTS, MOVED = RANDOM.normal(size=(6, 3)), RANDOM.normal(size=(2, 6, 3))
TRIANGLES = np.array([[0, 1, 2], [3, 4, 5]])
STRESS = ScalarField("mises", "Pa", "Von Mises stress", single(np.array([[1.0, 2, 3, 4, 5, np.nan], [6, 5, 4, 3, 2, np.nan]])))
LIFE = ScalarField("life", "-", "Life", single(np.array([[1e6, np.inf, 1e7, 1e8, np.inf, 1e9]])), log=True)


def body(**changes):
    return SurfaceBody("plate", "Plate", POINTS, TRIANGLES, single(MOVED), (STRESS, LIFE))._replace(**changes)


@pytest.mark.parametrize("scale", [0.0, 1.0, 37.5])
def test_the_deformed_points_are_those_at_rest_and_scale_times_the_displacement(scale):
    for step in (0, 1):
        assert body().deformed(step, scale) == pytest.approx(POINTS + scale * MOVED[step], rel=1e-5, abs=1e-6)


def test_a_place_turns_about_z_and_moves_the_frame():
    places = np.array([[1.0, 2.0, 3.0, np.pi / 2], [0.0, 0.0, 0.0, 0.0]])
    placed = body(places=places)
    x, y, z = POINTS.T
    assert placed.deformed(0, 0.0) == pytest.approx(np.column_stack([1 - y, 2 + x, 3 + z]))
    assert placed.deformed(1, 2.0) == pytest.approx(body().deformed(1, 2.0))


def test_a_place_keeps_lengths():
    places = np.array([[0.3, -0.2, 0.1, 0.7], [0.0, 0.0, 0.0, 1.9]])
    turned = body(places=places).deformed(1, 3.0)
    free = body().deformed(1, 3.0)
    assert np.linalg.norm(turned - turned[0], axis=1) == pytest.approx(np.linalg.norm(free - free[0], axis=1))


def test_a_field_knows_its_range_and_its_steps():
    assert STRESS.range == (1.0, 6.0) and LIFE.range == (pytest.approx(1e6), pytest.approx(1e9))
    assert np.array_equal(LIFE.at(0), LIFE.at(1)) and STRESS.at(1)[0] == 6.0
    assert np.isnan(STRESS._replace(values=single(np.full((1, 2), np.nan))).range).all()
    assert body().field("life") is LIFE and body().field("pressure") is None


@pytest.mark.parametrize(("count", "first", "most"), [(24, [7, 3, 7, 20], 8), (4, [1, 1], 8), (100, [99, 0], 3), (5, [4, 3, 2, 1, 0], 3)])
def test_the_steps_that_are_kept_hold_the_first_and_are_few(count, first, most):
    kept = kept_steps(count, first, most)
    assert len(kept) <= most and np.all(np.diff(kept) > 0)
    assert kept.min() >= 0 and kept.max() < count
    assert set(list(dict.fromkeys(first))[:most]) <= set(kept.tolist())


def test_all_arrays_have_names_and_answers_hand_fields_on():
    found = SurfaceFields("solid", "Solids", ("1 ms", "2 ms"), 1, (body(places=np.zeros((2, 4))),))
    names = {f"plate.{each}" for each in ("points", "triangles", "displacements", "mises", "life", "places")}
    assert set(found.arrays()) == {"steps", *names}
    assert merge_answers([Answer(fields=(found,)), Answer()]).fields == (found,)
