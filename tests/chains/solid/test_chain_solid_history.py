"""Plate and pins through a history: rest, the worst place, life, tables."""

import numpy as np
import pytest

from drivewright import fatigue, steps
from drivewright.chains.solid import tables
from drivewright.chains.solid.history import FACES, LEAST, ROLLING, SkinLife, skin_life, solid_history
from drivewright.chains.solid.joint import STRIP, seat_pair
from drivewright.errors import InputError
from tests.support.solid_chain import FIT, PULL, STEEL, loads, middle_of_flank, plate, pulled, solid, straight

pytestmark = [pytest.mark.analytical, pytest.mark.needs_fe]
CARD = fatigue.uniform_material_law(980e6, *STEEL, yield_strength=835e6)
TIME = np.array([0.0, 1e-3, 2e-3, 3e-3])
BODIES = ("plate", "left", "right")


# -- stress


def test_a_plate_at_rest_bears_nothing():
    found = pulled()
    for body in BODIES:
        assert found.greatest(body)[[0, 3]] == pytest.approx([0.0, 0.0], abs=1e-3)
    for state in (found.states[0], found.states[3]):
        assert max(part.max() for part in state.pressure) == 0.0


@pytest.mark.parametrize("body", BODIES)
def test_the_worst_is_the_greatest_of_the_points_that_are_searched(body):
    found = pulled()
    size, instant, point = found.worst(body)
    skin, kept = found.skins[body], found.searched[body]
    assert size == pytest.approx(max(skin.mises[k][kept].max() for k in range(4)), rel=1e-12)
    assert found.greatest(body) == pytest.approx([skin.mises[k][kept].max() for k in range(4)])
    assert skin.mises[instant, point] == size
    assert kept[point]
    assert instant == 1


@pytest.mark.parametrize(("side", "way"), [("left", -1.0), ("right", 1.0)])
def test_pins_are_searched_beside_their_rolling_contact(side, way):
    """Five widths of the strip about the line at half a pitch."""
    found = pulled()
    points = found.skins[side].points
    off = np.hypot(points[:, 0] - way * plate().link.pitch / 2, points[:, 1])
    assert np.array_equal(found.searched[side], off > ROLLING * STRIP * 1.2e-3)
    assert 0.5 < found.searched[side].mean() < 1.0
    assert found.searched["plate"].all()


def test_half_the_pull_is_what_the_order_of_instants_says():
    """Every instant is a state of its own: the start from the one before changes nothing."""
    alone = solid_history(solid(), straight(PULL / 2))
    assert alone.greatest("plate")[0] == pytest.approx(pulled().greatest("plate")[2], rel=1e-6)


def test_every_load_step_is_told_to_who_shows_progress(monkeypatch):
    monkeypatch.setattr(steps, "EACH", 0.0)
    told, made = [], solid()
    with steps.detailed(lambda *words: told.append(words)) as step:
        step(1, 3, "solid_stress")
        solid_history(made, straight(PULL, PULL))
    assert told == [(1, 3, "solid_stress"), *((1, 3, f"solid_stress: load steps, {number} of 2") for number in (1, 2))]


def test_a_contact_too_narrow_at_the_greatest_force_is_told_and_else_let_be():
    gaps = [each.gap + 0.2 * each.area for each in solid().model.pairings]  # 0.2 mm: a line
    with pytest.raises(InputError, match="larger than half the width of the contact"):
        solid_history(solid(), straight(PULL), gaps=gaps)
    assert len(solid_history(solid(), straight(0.1, PULL)).states) == 2


def test_a_pressed_flank_moves_stress_to_its_side():
    """A push on the right flank alone: the plate accelerates, and its stress differs from that of the mirrored push in place only."""
    height = middle_of_flank()
    pins = [[[-PULL, 0.0], [PULL, 0.0]]]
    found = solid_history(solid(), loads(pins * 2, [[0.0, 100.0], [100.0, 0.0]], [[height, height]] * 2))
    pull = pulled()
    right, left = found.greatest("plate")
    assert right == pytest.approx(left, rel=0.06)
    assert abs(right / pull.greatest("plate")[1] - 1) > 0.05


# -- life


def test_life_falls_with_the_load_and_is_endless_without():
    history = solid_history(solid(), straight(0.0, 300.0, 0.0, 500.0, 0.0))
    skin, searched = history.skins["plate"], history.searched["plate"]
    lives = [skin_life(skin._replace(stress=times * skin.stress), searched, CARD).least for times in (1.0, 1.3, 3.0)]
    assert lives[0] > 2 * lives[1] > 20 * lives[2] > 0
    at_rest = skin_life(skin._replace(stress=0.0 * skin.stress[:, :50]), searched[:50], CARD)
    assert at_rest.least == np.inf
    assert at_rest.damage == pytest.approx(np.zeros(50))
    assert SkinLife(np.zeros(0, int), np.zeros(0), np.zeros(0)).least == np.inf


def test_life_is_looked_for_where_stress_is_high_and_searched():
    history = pulled()
    skin, searched = history.skins["right"], history.searched["right"]
    found = skin_life(skin, searched, CARD)
    size = skin.mises.max(axis=0)
    assert np.array_equal(found.points, np.flatnonzero(searched & (size >= LEAST * size[searched].max())))
    assert found.damage == pytest.approx(1 / found.life)


def test_life_of_a_point_in_tension_is_that_of_its_stress_alone():
    """A point's history by `fatigue.life_map`, without yielding: nothing of the skin's other points comes in."""
    history = pulled()
    skin, one = history.skins["plate"], history.worst("plate")[2]
    found = skin_life(skin, history.searched["plate"], CARD)
    stress = skin.stress[:, [one]].swapaxes(0, 1)
    alone = fatigue.life_map(fatigue.elastic_strain(stress, CARD), stress, CARD)
    assert found.life[list(found.points).index(one)] == pytest.approx(float(alone.life[0]), rel=1e-9)


def test_yielding_shortens_life():
    history = solid_history(solid(), straight(0.0, 900.0, 0.0))
    skin, one = history.skins["plate"], history.worst("plate")[2]
    assert skin.mises[1, one] > CARD.cyclic_yield
    stress = skin.stress[:, [one]]
    found = skin_life(skin._replace(stress=stress, points=skin.points[[one]]), np.ones(1, bool), CARD)
    rows = np.ascontiguousarray(stress.swapaxes(0, 1))
    elastic = fatigue.life_map(fatigue.elastic_strain(rows, CARD), rows, CARD)
    local, strain = fatigue.neuber_history(rows[0], CARD)
    assert found.life == pytest.approx(fatigue.life_map(strain[None], local[None], CARD).life, rel=1e-9)
    assert found.least != pytest.approx(float(elastic.life[0]), rel=0.01)


# -- tables


def test_the_history_table_has_the_greatest_of_each_body_and_seat():
    found, table = pulled(), tables.history_table(pulled(), TIME)
    assert table.name == "solid_history"
    assert [column.name for column in table.columns] == ["time", "plate", "left_pin", "right_pin", "left_seat", "right_seat"]
    assert table["plate"].data == pytest.approx(found.greatest("plate"))
    assert table["left_pin"].data == pytest.approx(found.greatest("left"))
    for number, name in enumerate(("left_seat", "right_seat")):
        assert table[name].data[1] == found.states[1].pressure[number].max()


def corners(table, x, y):
    """Corners (m, 3, 2) of a table's triangles."""
    assert len(table[x].data) % 3 == 0 < len(table[x].data)
    return np.stack([table[x].data, table[y].data], axis=1).reshape(-1, 3, 2)


def areas(triangles):
    a, b = (triangles[:, n] - triangles[:, 0] for n in (1, 2))
    return 0.5 * (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])


@pytest.mark.parametrize(("body", "axes"), [("plate", (0, 1, 2)), ("left", (2, 1, 0)), ("right", (2, 1, 0))])
def test_the_stress_table_draws_the_deformed_skin(body, axes):
    table = tables.stress_table("t", "title", pulled(), body, 1)
    assert [column.name for column in table.columns] == ["x", "y", "depth", "mises"]
    corners(table, "x", "y")
    assert ", displacements magnified " in table["x"].meaning
    assert table["x"].meaning.endswith(" times")
    skin = pulled().skins[body].points
    for name, axis in zip(("x", "y", "depth"), axes, strict=True):
        reach = np.ptp(skin[:, axis])
        assert np.ptp(table[name].data) == pytest.approx(reach, abs=0.08 * np.ptp(skin, axis=0).max())
    mises = table["mises"].data
    if body == "plate":
        assert mises.max() == pytest.approx(pulled().greatest(body)[1], rel=0.03)
    assert FACES[body]


@pytest.mark.parametrize(("body", "towards"), [("plate", (0, 0, 1)), ("left", (-1, 0, 0)), ("right", (1, 0, 0))])
def test_a_plate_is_seen_from_its_face_and_a_pin_from_its_seat_and_no_picture_is_mirrored(body, towards):
    """Triangles that turn counter-clockwise in the picture face the viewer, and of a closed skin these are the nearer half."""
    table = tables.stress_table("t", "title", pulled(), body, 3)
    view = tables.SEATED.get(body, tables.FACE)
    assert np.cross(view.right, view.up) == pytest.approx(towards)
    faces = areas(corners(table, "x", "y")) > 0
    depth = table["depth"].data.reshape(-1, 3).mean(axis=1)
    assert depth[faces].mean() < depth[~faces].mean() - 0.1 * np.ptp(depth)


def test_the_life_table_has_the_lives_and_no_end_elsewhere():
    skin = pulled().skins["plate"]
    points = np.array([0, 5, 9])
    table = tables.life_table("l", "title", skin, SkinLife(points, np.array([1e4, 1e7, np.inf]), np.array([1e-4, 1e-7, 0.0])), "plate")
    assert len(table["life"].data) % 3 == 0
    rows = skin.parts.ravel()
    expected = np.full(len(skin.points), np.inf)
    expected[[0, 5]] = 1e4, 1e7
    assert np.array_equal(table["life"].data, expected[rows])
    assert table["x"].data == pytest.approx(skin.points[rows, 0])
    assert table.missing


@pytest.mark.parametrize("side", ["left", "right"])
def test_the_unrolled_seat_has_the_force_of_its_pressure(side):
    table, seat = tables.seat_table(pulled(), side, 1), plate().seat(side)
    triangles = corners(table, "along", "height")
    size = areas(triangles)
    assert np.all(size > 0)  # counter-clockwise
    assert size.sum() == pytest.approx(seat.radius * seat.sweep * 1e-3, rel=0.02)
    pressure = table["pressure"].data.reshape(-1, 3)
    outward = np.cos(triangles[..., 0] / seat.radius).mean(axis=1)
    assert np.sum(size * pressure.mean(axis=1) * outward) == pytest.approx(PULL / 2, rel=0.05)


@pytest.mark.parametrize(("side", "way"), [("left", -1.0), ("right", 1.0)])
def test_the_section_shows_plate_and_pin_around_one_hole(side, way):
    table = tables.section_table(pulled(), side, 1)
    triangles = corners(table, "x", "z")
    seat = plate().seat(side)
    assert np.all(areas(triangles) > 0)
    off = way * triangles[..., 0] - way * seat.center[0]
    assert off.min() >= -2.2 * seat.radius - 1e-9
    assert off.max() <= 2.2 * seat.radius + 1e-9
    above = triangles[..., 1] > 1.05e-3  # nothing but the pin
    assert triangles[..., 1].max() == pytest.approx(3e-3, rel=1e-6)
    outline = plate().own_pins[0 if way < 0 else 1]
    ends = [point.real if isinstance(point, complex) else point[0] for point in _points(outline)]
    step = 4.4 * seat.radius / tables.GRID[0]
    assert triangles[above][:, 0].min() == pytest.approx(min(ends), abs=2 * step)
    assert triangles[above][:, 0].max() == pytest.approx(max(ends), abs=2 * step)
    assert table["mises"].data.max() < 3 * pulled().greatest("plate")[1]


def _points(outline):
    from drivewright.solids.pieces import polyline

    return [point for piece in outline.pieces for point in np.asarray(polyline(piece, 1e-6))]


def test_friction_of_a_fit_is_that_of_its_pairs():
    pair = seat_pair(plate(), "plate", "right", "right", FIT._replace(friction=0.2), (0.0, 1e-3), 0.0)
    assert pair.friction == 0.2
    assert seat_pair(plate(), "plate", "right", "right", FIT, (0.0, 1e-3), 0.0).friction == 0.0


@pytest.mark.slow
def test_friction_in_the_seats_takes_load_off_the_plate_and_bends_the_pins_more():
    """It holds the seat together and loses work each time the pull grows; the second time through is the one that counts."""
    smooth, rough = pulled(), solid_history(solid(friction=0.1), straight(0.0, PULL, PULL / 2, 0.0))
    assert len(rough.states) == 4
    assert all(state.dissipated >= 0 for state in rough.states) and rough.states[1].dissipated > 0
    assert sum(state.dissipated for state in smooth.states) == 0
    first = rough.solid.model.solve(rough.states[0].forces, rough.states[-1], narrow=True)
    again = rough.solid.model.solve(rough.states[1].forces, first, narrow=True)
    assert again.dissipated == pytest.approx(rough.states[1].dissipated, rel=1e-6)  # it repeats
    assert 0.95 < rough.worst("plate")[0] / smooth.worst("plate")[0] < 1.0
    assert 1.0 < max(rough.worst(side)[0] for side in ("left", "right")) / max(smooth.worst(side)[0] for side in ("left", "right")) < 1.2
