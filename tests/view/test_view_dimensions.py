"""Lines of measure: where they lie, what they are as long as, and which name points to them."""

import math

import numpy as np
import pytest

from drivewright.dimensions import Angle, DimensionSheet, Length, Radius, direction, shown, turn
from drivewright.scene import Body, Frame, Scene, Shape, Trace, polygon
from drivewright.view.dimensions import MM, OVER, _lines, draw_dimensions

pytestmark = pytest.mark.interface

SIZE = 0.2  # of the scene [m]
START, END = (0.01, 0.02), (0.04, 0.06)
LEFT = np.array([-0.8, 0.6])  # of the way from START to END


def scene(**more):
    """A plate of 200 x 100 mm."""
    still = np.zeros((2, 3))
    plate = Shape("body", polygon([(0.0, 0.0), (0.2, 0.0), (0.2, 0.1), (0.0, 0.1)]))
    bodies = (Body("plate", "plate", (plate,), still, "blue"), Body("plate.mark", "mark", (), still, "blue"))
    return Scene(np.array([0.0, 1.0]), "", "-", 1.0, bodies, (Frame("machine", "machine", still),), **more)


@pytest.mark.parametrize("aside", [0.15, -0.3])
def test_a_line_of_measure_lies_aside_to_the_left_of_the_length_that_it_measures(aside):
    drawn = _lines(Length("key", START, END, aside), SIZE)
    np.testing.assert_allclose(drawn.measure, np.array([START, END]) + aside * SIZE * LEFT, atol=1e-15)
    assert drawn.double and np.hypot(*np.diff(drawn.measure, axis=0)[0]) == pytest.approx(0.05)
    for point, foot, thin in zip((START, END), drawn.measure, drawn.thin, strict=True):
        np.testing.assert_allclose(thin, [point, foot + math.copysign(OVER, aside) * SIZE * LEFT], atol=1e-15)


def test_a_length_in_its_place_has_no_thin_lines():
    drawn = _lines(Length("key", START, END), SIZE)
    assert drawn.thin == () and drawn.measure.tolist() == [list(START), list(END)]


@pytest.mark.parametrize("is_diameter", [False, True])
def test_a_radius_goes_from_the_centre_and_a_diameter_from_the_other_side_onto_the_circle(is_diameter):
    drawn = _lines(Radius("key", START, 0.03, math.radians(120), is_diameter), SIZE)
    way = np.array([-0.5, math.sqrt(0.75)])
    np.testing.assert_allclose(drawn.measure[1], START + 0.03 * way, atol=1e-15)
    np.testing.assert_allclose(drawn.measure[0], START - 0.03 * way if is_diameter else START, atol=1e-15)
    assert drawn.double is is_diameter and drawn.dimension.drawn == (0.06 if is_diameter else 0.03)


@pytest.mark.parametrize("sweep", [1.2, -0.7])
def test_an_arc_goes_from_the_start_through_the_angle(sweep):
    drawn = _lines(Angle("key", START, 0.4, sweep, 0.25), SIZE)
    arms = (drawn.measure - START) @ [1, 1j]
    np.testing.assert_allclose(np.abs(arms), 0.25 * SIZE, rtol=1e-12)
    np.testing.assert_allclose(np.angle(arms[[0, len(arms) // 3, -1]]), 0.4 + sweep * np.array([0, 20 / 59, 1]), rtol=1e-12)
    ends = [np.angle((thin[1] - thin[0]) @ [1, 1j]) for thin in drawn.thin]
    np.testing.assert_allclose(ends, [0.4, 0.4 + sweep], rtol=1e-12)


def test_a_key_that_counts_the_other_way_or_twice_is_drawn_over_its_factor():
    assert Length("key", START, END, times=2).drawn == pytest.approx(0.025)
    assert Angle("key", START, 0.0, 0.6, 0.1, times=-1).drawn == pytest.approx(-0.6)
    assert Angle("key", START, 0.0, 0.6, 0.1, times=2).drawn == pytest.approx(0.3)


def named(*dimensions):
    """{first text of a name: (second text, x of the name, end of its thin line)} [mm] and the axis."""
    figure = draw_dimensions(DimensionSheet("a", "A", "p", None), scene(), dimensions)
    (axis,) = figure.axes
    leaders = [line.get_xydata() for line in axis.lines if line.get_zorder() == 5]
    pairs = zip(axis.texts[::2], axis.texts[1::2], leaders, strict=True)
    return {
        key.get_text(): (value.get_text().replace("\u00a0", " "), key.get_position()[0], leader[1].tolist()) for key, value, leader in pairs
    }, axis


def test_a_name_says_the_key_and_its_value_in_the_unit_that_people_read():
    found, _ = named(
        Length("pitch", (0.0, 0.0), (0.2, 0.0), -0.1, times=2),
        Angle("lean", (0.1, 0.0), 0.0, math.radians(-30), 0.2, times=-1),
        Radius("bore", (0.15, 0.05), 0.0125, 0.0, diameter=True),
    )
    assert {key: value for key, (value, _, _) in found.items()} == {"2 × pitch": "2 × 100 mm", "lean": "30°", "bore": "25 mm"}


def test_a_level_length_is_named_at_its_nearer_end_and_an_upright_one_in_its_middle():
    """Left and right column, by where the middles lie."""
    found, _ = named(
        Length("level left", (0.0, 0.02), (0.1, 0.02)),
        Length("level right", (0.1, 0.08), (0.2, 0.08)),
        Length("upright", (0.18, 0.0), (0.18, 0.1)),
        Length("left upright", (0.02, 0.0), (0.02, 0.1)),
    )
    assert found["level left"][2] == pytest.approx([0.0, 20.0]) and found["level right"][2] == pytest.approx([200.0, 80.0])
    assert found["upright"][2] == pytest.approx([180.0, 50.0]) and found["left upright"][2] == pytest.approx([20.0, 50.0])
    assert all((x < 0) == ("left" in key) and (x > 200) == ("left" not in key) for key, (_, x, _) in found.items())


def test_the_whole_drawing_stands_between_the_names_and_within_the_picture():
    """A tall drawing is limited by its height, a wide one by its width."""
    for tall in (0.0, 0.6):
        found, axis = named(Length("a", (0.0, 0.0), (0.2, 0.0), -0.1), Length("b", (0.1, 0.0), (0.1, 0.1 + tall)))
        (low_x, high_x), (low_y, high_y) = axis.get_xlim(), axis.get_ylim()
        places = [x for _, x, _ in found.values()]
        assert low_x < min(places) < 0.0 and MM * 0.2 < max(places) < high_x
        assert low_y < -MM * (0.1 + OVER) * SIZE and high_y > MM * (0.1 + tall)


def test_what_a_sheet_shows_has_neither_traces_nor_what_is_left_out():
    whole = scene(traces=(Trace("t", "t", "plate", (0.0, 0.0)),))
    sheet = DimensionSheet("a", "A", "p", None)
    assert whole.traces and shown(sheet, whole).traces == ()
    assert [body.name for body in shown(sheet, whole).bodies] == ["plate", "plate.mark"]
    assert [body.name for body in shown(sheet._replace(left_out=("plate.",)), whole).bodies] == ["plate"]


def test_directions_and_turns():
    assert direction((1.0, 1.0), (1.0, 3.0)) == pytest.approx(np.pi / 2) and direction((1.0, 1.0), (0.0, 1.0)) == pytest.approx(np.pi)
    assert turn(0.1, 0.5) == pytest.approx(0.4) and turn(0.5, 0.1) == pytest.approx(-0.4)
    assert turn(3.0, -3.0) == pytest.approx(2 * np.pi - 6.0), "the smaller angle, through the opposite direction"
