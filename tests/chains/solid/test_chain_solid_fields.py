"""Fields on plate and pins: the stress, pressure and life of the history they come from."""

from functools import cache

import numpy as np
import pytest

from drivewright.chains.solid.fields import solid_fields
from drivewright.chains.solid.history import SkinLife
from tests.support.solid_chain import plate, pulled

pytestmark = [pytest.mark.analytical, pytest.mark.needs_fe]

TIME = np.array([0.0, 1e-3, 2e-3, 3e-3])
BODIES = ("plate", "left", "right")
LIVES = {name: SkinLife(np.array([0, 5]), np.array([1e6, 1e8]), np.array([1e-6, 1e-8])) for name in BODIES}


@cache
def fields():
    return solid_fields(pulled(), TIME, LIVES)


def body(name):
    return next(each for each in fields().bodies if each.name == name)


def test_the_worst_step_is_that_of_the_plate():
    assert fields().name == "solid_stress" and fields().steps[fields().worst] == "1 ms"
    assert len(fields().steps) == 4


@pytest.mark.parametrize("name", BODIES)
def test_the_greatest_of_the_field_is_that_of_the_search(name):
    stress = body(name).field("mises")
    assert stress.range[1] == pytest.approx(pulled().worst(name)[0], rel=1e-6)
    assert np.nanmax(stress.values, axis=1) == pytest.approx(pulled().greatest(name), rel=1e-6)


def test_the_pressure_is_that_of_the_contact_and_only_on_the_seats():
    pressure = body("plate").field("pressure").values
    found = [max(part.max() for part in state.pressure) for state in pulled().states]
    assert pressure.max(axis=1) == pytest.approx(found, rel=1e-6)
    assert pressure.min() == 0.0
    x, y = body("plate").points[pressure[1] > 0, :2].T
    for side, on in (("left", x < 0), ("right", x > 0)):
        seat = plate().seat(side)
        assert np.hypot(x[on] - seat.center[0], y[on] - seat.center[1]) == pytest.approx(seat.radius, abs=1e-6)
        assert on.any()


@pytest.mark.parametrize("name", BODIES)
def test_triangles_and_arrays_fit(name):
    own = body(name)
    assert own.triangles.min() == 0 and own.triangles.max() == len(own.points) - 1
    assert own.displacements.shape == (4, len(own.points), 3)
    assert all(each.values.shape[1] == len(own.points) for each in own.fields)
    assert np.abs(own.displacements[1][: len(pulled().skins[name].points)].mean(axis=0)).max() < 1e-9  # no motion as a whole
    assert own.mirrored and own.points[:, 2].min() >= -1e-12


def test_flanks_are_shown_without_stress_and_with_their_displacement():
    own = body("plate")
    bare = np.isnan(own.field("mises").values).all(axis=0)
    assert bare.sum() == len(own.points) - len(pulled().skins["plate"].points) > 0
    assert np.abs(own.displacements[1][bare]).max() > 0 and own.field("mises").missing


def test_the_life_is_that_of_the_points_looked_at():
    life = body("left").field("life")
    assert life.log and life.values[0, 0] == np.float32(1e6) and life.values[0, 5] == np.float32(1e8)
    assert np.isinf(np.delete(life.values[0], [0, 5])).all()
