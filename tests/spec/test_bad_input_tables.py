"""Tabulated and splined motion in a cam spec: what cannot be read, runs backwards, does not close or has too few points."""

import pytest

import drivewright as dw
from drivewright.errors import InputError
from drivewright.spec import from_document

pytestmark = pytest.mark.error

HEADER = "angle [deg],lift [mm]"
ROWS = [(0, 0), (60, 3), (120, 10), (180, 12), (240, 9), (300, 2), (360, 0)]


def text(rows, header=HEADER):
    return "\n".join([header, *(",".join(map(str, row)) for row in rows)]) + "\n"


def spec(folder, content=None, **segment):
    """A cam of one turn whose one segment is a table, or of two whose first has the given law."""
    follower = {"roller_radius": "8 mm", "prime_radius": "40 mm"}
    if content is not None:
        (folder / "lift.csv").write_bytes(content if isinstance(content, bytes) else content.encode())
        programme = [{"angle": "360 deg", "law": "table", "file": "lift.csv", **segment}]
    else:
        programme = [{"angle": "180 deg", "rise": "10 mm", **segment}, {"angle": "180 deg", "law": "cycloidal", "rise": "-10 mm"}]
    return from_document({"mechanism": "cam", "follower": follower, "programme": programme}, folder=folder)


def refusal(folder, content=None, **segment):
    with pytest.raises(InputError) as caught:
        dw.build(spec(folder, content, **segment))
    return str(caught.value)


def test_the_table_itself_is_fine(tmp_path):
    assert dw.build(spec(tmp_path, text(ROWS))) and dw.build(spec(tmp_path, "\ufeff" + text(ROWS)))


def changed(number, row):
    return text([*ROWS[:number], row, *ROWS[number + 1 :]])


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (changed(3, (110, 12)), ("110", "increas")),
        (changed(3, (120, 12)), ("120", "increas")),
        (text(ROWS[::-1]), ("increas",)),
        (changed(6, (360, 0.5)), ("disagree", "ends at 0.0005")),
        (text(ROWS[:2]), ("at least 3",)),
        (text([]), ("at least 3",)),
        (changed(2, (120, "nan")), ("line 4", "nan")),
        (changed(2, (120, "inf")), ("line 4", "inf")),
        (changed(2, (120, "ten")), ("line 4: the lift is 'ten', not a number",)),
        (changed(2, (120,)), ("line 4: the lift is missing",)),
        (text(ROWS, "angle,lift"), ("column 'angle'", "has no unit", "angle [deg]")),
        (text(ROWS, "angle [mm],lift [mm]"), ("column 'angle'", "wants an angle")),
        (text(ROWS, "angle [deg],lift [kg]"), ("column 'lift'", "kg", "mass")),
        (text(ROWS, "angle [deg],lift [deg]"), ("programme.0.file", "must be a length")),
        (b"", ("is empty", HEADER)),
        (b"\xff\xfe\x00", ("cannot be read",)),
    ],
)
def test_a_table_that_is_none_is_refused_with_its_place(tmp_path, content, words):
    message = refusal(tmp_path, content)
    assert "lift.csv" in message or "programme.0.file" in message
    assert all(word in message for word in words), message


@pytest.mark.parametrize(
    ("segment", "words"),
    [
        ({"law": "spline", "points": [[0.0, 0.0], [1.0, 1.0]]}, ("programme.0.law", "at least 3 points")),
        ({"law": "spline", "points": [[0.0, 0.0], [0.6, 0.4], [0.5, 0.6], [1.0, 1.0]]}, ("programme.0.law", "increas")),
        ({"law": "spline", "points": [[0.0, 0.0], [0.5, 0.4], [0.5, 0.6], [1.0, 1.0]]}, ("programme.0.law", "increas")),
        ({"law": "spline"}, ("programme.0.law", "'points'")),
        (
            {"law": "spline", "points": [[0.0, 0.0], [0.5, float("nan")], [1.0, 1.0]]},
            ("programme.0.points.1.1", "must be a finite number, got nan"),
        ),
        ({"law": "spline", "points": [[0.0, 0.0], [0.5, 0.5], [1.0, 1.0]], "degree": 4}, ("programme.0.law", "4")),
        ({"law": "table"}, ("programme.0.law", "file")),
        ({"law": "table", "file": "gone.csv"}, ("programme.0.file", "there is no file", "relative to the spec")),
        ({"law": "cycloidal", "degree": 5}, ("programme.0.law", "degree")),
    ],
)
def test_a_segment_that_makes_no_motion_is_refused_by_key(tmp_path, segment, words):
    message = refusal(tmp_path, **segment)
    assert all(word in message for word in words), message
