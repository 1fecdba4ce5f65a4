"""What the writers refuse, and whether the message says what, where, how much and what to try."""

import re

import numpy as np
import pytest

from drivewright.errors import InputError
from drivewright.report.dxf import write_dxf
from drivewright.report.gcode import gcode
from drivewright.report.svgout import write_svg
from drivewright.scene import Arc, Drawing, Line, Outline, Part, Prism, Shape, Spline, circle, polygon
from drivewright.solids import outlines
from drivewright.solids.volume import part_volume

pytestmark = pytest.mark.error

SETTINGS = {"cutter_diameter": 0.006, "feed": 0.012, "plunge": 0.002, "step_down": 0.005, "spindle_speed": 400.0}
SQUARE = polygon([(0, 0), (0.03, 0), (0.03, 0.03), (0, 0.03)])


def drawing(outline, *holes):
    return Drawing("plate", "Plate", (Shape("profile", outline), *(Shape("hole", hole) for hole in holes)), 0.005)


def bay(radius):
    """Plate with a half-round bay of this radius in its upper edge, 30 mm wide, about (15, 30) mm."""
    return Outline(
        (
            Line((0.0, 0.0), (0.03, 0.0)),
            Line((0.03, 0.0), (0.03, 0.03)),
            Line((0.03, 0.03), (0.015 + radius, 0.03)),
            Arc((0.015, 0.03), radius, 0.0, -np.pi),
            Line((0.015 - radius, 0.03), (0.0, 0.03)),
            Line((0.0, 0.03), (0.0, 0.0)),
        )
    )


def test_gap_is_named_with_place_and_size():
    broken = Outline((Line((0.0, 0.0), (0.02, 0.0)), Line((0.02, 2e-5), (0.02, 0.01)), Line((0.02, 0.01), (0.0, 0.0))))
    with pytest.raises(
        InputError,
        match=re.escape(
            "part 'plate': a gap of 0.02 mm between pieces 0 and 1 of the outline at (20, 0) mm; pieces must meet within 1e-06 mm"
        ),
    ):
        outlines.normalised(broken, "part 'plate'")
    unclosed = Outline((Line((0.0, 0.0), (0.02, 0.0)), Line((0.02, 0.0), (0.02, 0.01))))
    with pytest.raises(InputError, match=r"gap of 22\.3607 mm between pieces 1 and 0"):
        outlines.normalised(unclosed, "plate")


def test_not_finite_and_empty_outlines():
    with pytest.raises(InputError, match=r"plate: piece 1 of the outline \(spline\) holds a number that is not finite"):
        outlines.normalised(Outline((Line((0, 0), (1, 0)), Spline(np.array([(1, 0), (np.nan, 1.0)]), (0, 1), (0, 1)))), "plate")
    with pytest.raises(InputError, match="plate: the outline has no piece longer than 1e-09 m"):
        outlines.normalised(Outline((Line((0.0, 0.0), (1e-10, 0.0)), Line((1e-10, 0.0), (0.0, 0.0)))), "plate")


def test_crossing_outline_is_named_with_its_place():
    bow = polygon([(0, 0), (0.02, 0.01), (0.02, 0), (0, 0.01)])
    with pytest.raises(InputError, match=re.escape("crosses or touches itself at (10, 5) mm; trim it there")):
        part_volume(Part("bow", (Prism(bow, (), 0.0, 0.01),)))
    with pytest.raises(InputError, match="open; a face needs a closed one"):
        outlines.outline_polygon(SQUARE._replace(closed=False), "plate")


def test_writers_want_shapes(tmp_path):
    with pytest.raises(InputError, match="at least one drawing"):
        write_dxf([], tmp_path / "x.dxf")
    for write in (write_dxf, write_svg):
        with pytest.raises(InputError, match="drawing 'void' has no shapes; give it at least a profile"):
            write(Drawing("void", "Void", ()), tmp_path / "x")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    "setting, value",
    [
        ("cutter_diameter", 0.0),
        ("feed", -1.0),
        ("step_down", float("nan")),
        ("depth", 0.0),
        ("lead_radius", 0.0),
        ("spindle_speed", float("inf")),
    ],
)
def test_gcode_wants_positive_settings(setting, value):
    with pytest.raises(InputError, match=f"G-code: {setting} is {value:g}; it must be positive and finite"):
        gcode(drawing(SQUARE), **{**SETTINGS, setting: value})


def test_gcode_wants_one_closed_profile():
    with pytest.raises(InputError, match="drawing 'plate' needs one closed outline on layer 'profile'; there are 1, not closed"):
        gcode(drawing(SQUARE._replace(closed=False)), **SETTINGS)
    two = Drawing("plate", "Plate", (Shape("profile", SQUARE), Shape("profile", circle((0.1, 0), 0.01))), 0.005)
    with pytest.raises(InputError, match="there are 2"):
        gcode(two, **SETTINGS)


def test_gcode_names_the_concave_place_its_radius_and_the_cutters():
    with pytest.raises(InputError) as caught:
        gcode(drawing(bay(0.0029)), **SETTINGS)
    message = str(caught.value)
    assert "drawing 'plate' with a cutter of radius 3 mm" in message and "(15, 27.1) mm" in message and "2.9 mm" in message
    gcode(drawing(bay(0.0031)), **SETTINGS)


def test_gcode_names_a_sharp_inner_corner_as_radius_zero():
    notch = polygon([(0, 0), (0.03, 0), (0.03, 0.03), (0.015, 0.012), (0, 0.03)])
    with pytest.raises(InputError, match=r"\(15, 12\) mm.*radius 0 mm"):
        gcode(drawing(notch), **SETTINGS)


def keyhole(mouth):
    """Block with a round pocket of 6 mm radius that opens upwards through a mouth of this width; no concave radius but the pocket's."""
    half, r = mouth / 2, 0.006
    y, begin = np.sqrt(r**2 - half**2), np.arctan2(np.sqrt(r**2 - half**2), half)
    corners = [(-half, y), (-half, 0.01), (-0.02, 0.01), (-0.02, -0.02), (0.02, -0.02), (0.02, 0.01), (half, 0.01), (half, y)]
    lines = polygon(corners, closed=False).pieces
    return Outline((*lines, Arc((0.0, 0.0), r, begin, -(np.pi + 2 * begin))))


def test_gcode_refuses_a_mouth_narrower_than_the_cutter_where_every_radius_is_wide():
    with pytest.raises(InputError, match=r"cutter of radius 3 mm.*mm into another part of the outline"):
        gcode(drawing(keyhole(0.005)), **SETTINGS)
    gcode(drawing(keyhole(0.0061)), **SETTINGS)


def test_gcode_names_the_hole_that_is_too_small():
    with pytest.raises(InputError, match=re.escape("hole at (12, 11) mm has radius 2.5 mm, under the cutter's radius of 3 mm; take a")):
        gcode(drawing(SQUARE, circle((0.012, 0.011), 0.0025)), **SETTINGS)
    gcode(drawing(SQUARE, circle((0.012, 0.011), 0.0025)), **SETTINGS, bores=False)
