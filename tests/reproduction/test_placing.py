"""Words in a chart stand where the curves leave room."""

import numpy as np
import pytest

from drivewright.reproduction.figures import Chart, Curve, Stated, chart_figure
from drivewright.reproduction.placing import Place, Room, dense_points
from drivewright.view.style import new_figure, styled
from drivewright.view.text import wrapped_label

pytestmark = pytest.mark.interface

CORNERS = [Place(0.5, 0.5, right, up) for right, up in ((1, 1), (-1, 1), (1, -1), (-1, -1))]


@pytest.fixture
def axis():
    with styled():
        axis = new_figure(3.0, "x").subplots()
    axis.set(xlim=(0.0, 10.0), ylim=(0.0, 4.0))
    return axis


def line(x0, y0, x1, y1):
    return np.array([x0, x1], float), np.array([y0, y1], float)


def test_a_point_of_the_data_as_fractions(axis):
    assert Room(axis, []).fraction(2.5, 3.0) == pytest.approx((0.25, 0.75))


@pytest.mark.parametrize(
    ("taken", "free"),
    [
        ((), (1, 1)),  # the first of equals
        ((line(5, 2.1, 8, 2.1),), (-1, 1)),
        ((line(5, 2.1, 8, 2.1), line(2, 2.1, 5, 2.1)), (1, -1)),
        ((line(5, 2.1, 8, 2.1), line(2, 2.1, 5, 2.1), line(5, 1.9, 8, 1.9)), (-1, -1)),
    ],
)
def test_words_at_a_point_go_where_no_curve_is(axis, taken, free):
    place = Room(axis, taken).best("some words", CORNERS)
    assert (place.right, place.up) == free


def test_words_stay_within_the_axes(axis):
    right, left = Place(0.98, 0.5, 1, 1), Place(0.98, 0.5, -1, 1)
    assert Room(axis, [line(5, 2.1, 9.8, 2.1)]).best("some words", [right, left]) == left


def test_words_do_not_lie_upon_those_placed_before(axis):
    room = Room(axis, [])
    first, second = room.best("some words", CORNERS), room.best("some words", CORNERS)
    assert first == CORNERS[0] and second != first


def test_upright_words_stand_in_the_largest_gap(axis):
    assert Room(axis, [line(0, 1, 10, 1)]).gap("word", 0.5) == pytest.approx(0.5 * (0.25 + 1.0), abs=0.01)
    assert Room(axis, [line(0, 3, 10, 3)]).gap("word", 0.5) == pytest.approx(0.5 * 0.75, abs=0.01)
    assert Room(axis, [line(0, 1, 2, 1)]).gap("word", 0.5) == pytest.approx(0.5, abs=0.01), "a curve that is not there takes nothing"


def test_long_upright_words_do_not_leave_the_axes(axis):
    room = Room(axis, [line(0, 2.2, 10, 2.2)])
    short, long = room.gap("word", 0.5), room.gap("a text of many letters, more than the gap", 0.5)
    assert short == pytest.approx(0.275, abs=0.01) and short < long <= 0.5


def test_gaps_of_a_curve_are_not_drawn_over():
    points = dense_points(np.arange(4.0), np.array([0.0, np.nan, 1.0, 2.0]))
    assert np.isfinite(points).all() and not np.any((points[:, 0] > 0) & (points[:, 0] < 2))


def test_lines_across_keep_upright_words_away():
    x = np.linspace(0.0, 10.0, 50)
    chart = Chart("y", [Curve("low", x, 0.1 * x)], [Stated("across", y=6.0), Stated("upright", 5.0)])
    (axis,) = chart_figure("t", "x", [chart]).axes
    words = {text.get_text(): text for text in axis.texts}
    height = axis.transAxes.transform((0, words["upright"].xy[1]))[1]
    _, y = axis.transData.inverted().transform((0, height))
    assert 0.5 < y < 6.0, "between the curve and the line"


def test_markers_lie_evenly_over_x_and_beside_each_other():
    x = np.concatenate([np.linspace(0.0, 1.0, 200), np.linspace(1.001, 10.0, 200)])
    (axis,) = chart_figure("t", "x", [Chart("y", [Curve("a", x, x), Curve("b", x, 2 * x)])]).axes
    first, second = (line.get_xdata()[line.get_markevery()] for line in axis.get_lines())
    assert np.diff(first) == pytest.approx(10 / 9, rel=0.1)
    assert min(abs(a - b) for a in first for b in second) > 0.2


def test_a_unit_is_never_torn_apart():
    label = wrapped_label("Torsional stiffness [N m/arcmin]", 24)
    assert [line.replace("\u00a0", " ") for line in label.split("\n")] == ["Torsional stiffness", "[N m/arcmin]"]
