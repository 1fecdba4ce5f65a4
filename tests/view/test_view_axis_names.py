"""The name of a y axis that several lines share says what is shown."""

import numpy as np
import pytest

from drivewright.result import Column, Plot, Result, Table
from drivewright.view.axis_names import axis_name, common_ends
from drivewright.view.panels import panels

pytestmark = pytest.mark.interface

CASES = [
    (("Deflection, along the load", "Deflection, square to it: to the right"), "m", "Deflection and slope", "Deflection"),
    (("Bending moment, along x", "Bending moment, along y"), "N m", "Deflection and moment", "Bending moment"),
    (("In the plane xz", "In the plane yz"), "N m", "Bending moment of the shaft", "Bending moment of the shaft"),
    (("Whole loop", "Branches"), "N m", "Test with fitted lines", "Torque"),
    (("Peak pressure at the inner race", "Peak pressure at the outer race"), "Pa", "Contact", "Peak pressure at the race"),
    (("At the fillet", "At the groove"), "Pa", "Stress along the shaft", "Stress along the shaft"),
    (("Velocity, x, of 'P'", "Velocity, y, of 'P'"), "m/s", "Motion of P", "Velocity of 'P'"),
    (("X of 'P'", "y of 'P'"), "m", "Motion of P", "X and Y of 'P'"),
    (("Equivalent pitch p''", "Ideal pitch p/cos of half the angle"), "m", "As published, and the ideal one", "Pitch"),
    (("Support left front", "Support right rear"), "N", "Loads of the support bearings", "Force"),
    (("Main cam, signed", "Return cam, signed"), "rad", "Pressure angle of both cams", "Pressure angle of both cams"),
    (("Free rotation forward", "Free rotation backward"), "rad", "Free rotation of the wheel", "Free rotation"),
    (("Pins that touch", "Pins that the cam can push"), "-", "Pins and their ways", "Pins"),
    (("Mode 1, 60 Hz", "Mode 2, 200 Hz"), "-", "Natural modes of bending", "Natural modes of bending"),
    (("Shear force along -y", "Shear force along -x"), "N", "Shear force and bending moment", "Shear force"),
    (("Slope along the loads", "Slope across the loads"), "rad", "Deflection and slope", "Slope"),
    (("Bending", "Shear"), "m/N", "Who contributes what to the flexibility", "Flexibility"),
]


@pytest.mark.parametrize(("labels", "unit", "title", "name"), CASES, ids=[case[3] for case in CASES])
def test_the_axis_says_what_is_shown(labels, unit, title, name):
    assert axis_name(labels, unit, title) == name


def test_no_axis_is_called_value_or_length():
    for unit in ("-", "m", "no unit of ours"):
        assert axis_name(("One", "Other"), unit, "Gap along the track, both sides") == "Gap along the track"


def test_a_title_of_several_panels_speaks_for_none_of_them():
    assert axis_name(("On the left", "On the right"), "N", "Force and moment", alone=False) == "Force"


def test_common_words_at_both_ends():
    assert common_ends(["Speed of the pin", "Force of the pin"]) == ([], ["of", "the", "pin"])
    assert common_ends(["Same", "Same"]) == (["Same"], [])


def test_a_column_split_into_lines_names_the_axis():
    columns = (
        Column("x", "s", "time", np.arange(4.0)),
        Column("y", "m", "height of the bump", np.arange(4.0)),
        Column("by", "-", "", [0, 0, 1, 1]),
    )
    result = Result(None, "nothing", "t", "", {}, {"t": Table("t", "T", columns)}, (), (), {})
    (panel,) = panels(result, Plot("t", "T", "t", "x", ("y",), by="by"))
    assert panel.label == "Height of the bump [mm]"
