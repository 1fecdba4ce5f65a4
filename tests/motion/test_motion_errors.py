"""What a motion refuses, and the sentence it says."""

import math

import numpy as np
import pytest

from drivewright.errors import InputError, UnitError, UnknownName
from drivewright.motion import Programme, Segment, hold, integrate, law

pytestmark = pytest.mark.error

TURN = 2 * math.pi


def refused(message, build, *args, error=InputError, **kwargs):
    with pytest.raises(error) as caught:
        build(*args, **kwargs)
    assert all(part in str(caught.value) for part in message), str(caught.value)


def test_outside_the_unit_interval():
    cycloidal = law("cycloidal")
    refused(["'cycloidal': u = 1.2", "0 .. 1", "2 of 3", "Programme"], cycloidal, [0.5, 1.2, -3])
    refused(["u = nan"], cycloidal, math.nan)
    assert cycloidal(1 + 1e-14) == cycloidal(1.0) and cycloidal(-1e-14) == cycloidal(0.0)
    refused(["'parabolic' on a piece: u = 0.49", "0.5 .. 1"], law("parabolic").on_piece, 1, 0.49)
    refused(["no piece 2", "0 .. 1"], law("parabolic").on_piece, 2, 1.0)


def test_names_and_parameters():
    refused(["'modified-sin'", "did you mean 'modified-sine'?", "cycloidal"], law, "modified-sin", error=UnknownName)
    refused(["'scca'", "'d'", "its parameters: b, c, d"], law, "scca", b=0.5, c=0.5)
    refused(["'cycloidal'", "'b'", "its parameters: none"], law, "cycloidal", b=0.5)


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"b": 0.5, "c": 0.5, "d": 0.1}, "b + c + d = 1.1"),
        ({"b": -0.5, "c": 1, "d": 0.5}, "part b = -0.5"),
        ({"b": math.nan, "c": 1, "d": 0}, "part b = nan"),
    ],
)
def test_scca_parts(parameters, message):
    refused([message], law, "scca", **parameters)


def test_modified_constant_velocity_needs_room_to_accelerate():
    refused(["c = 1 ", "0 <= c < 1"], law, "mcv", c=1.0)


def test_acceleration_pieces_that_make_no_motion():
    refused(["sum to 0.9"], integrate, [hold(0.5, 1), hold(0.4, -1)])
    refused(["give no rise"], integrate, [hold(1, 0)])


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"interior": [(0.0, 0, 0.3)]}, "7 conditions contradict"),
        ({"start": (), "end": (), "interior": [(0.5, 1, 0.0), (0.5, 1, 0.0)]}, "4 conditions"),
        ({"interior": [(1.4, 0, 0.3)]}, "u in 0..1"),
        ({"interior": [(0.4, -1, 0.3)]}, "order -1"),
        ({"interior": [(0.4, 0.5, 0.3)]}, "order 0.5"),
        ({"start": (math.nan,)}, "finite value"),
    ],
)
def test_polynomial_conditions(parameters, message):
    refused(["'polynomial'", message], law, "polynomial", **parameters)


@pytest.mark.parametrize(
    ("points", "options", "message"),
    [
        ([(0, 0), (1, 1)], {}, "at least 3 points"),
        ([0, 0.5, 1], {}, "shape (3,)"),
        ([(0, 0), (0.5, 0.5), (0.4, 0.6), (1, 1)], {}, "point 3: u is 0.4 after 0.5"),
        ([(0, 0), (0.5, math.nan), (1, 1)], {}, "point 2: the lift is nan"),
        ([(0, 0), (0.5, 0.5), (0.9, 1)], {}, "to 0.9; they must run from 0 to 1"),
        ([(0, 0), (0.5, 0.5), (1, 0.8)], {}, "s runs from 0 to 0.8"),
        ([(0, 0.2), (0.5, 0.5), (1, 0.3)], {"ends": "periodic"}, "from 0.2 to 0.2"),
        ([(0, 0), (0.5, 0.5), (1, 1)], {"degree": 4}, "degree 4"),
        ([(0, 0), (0.5, 0.5), (1, 1)], {"ends": "free"}, "ends 'free'"),
    ],
)
def test_spline_points(points, options, message):
    refused(["'spline'", message], law, "spline", points=points, **options)


ROWS = "angle [deg],lift [mm]\n0,1\n120,5\n240,3\n360,1\n"


def table(tmp_path, text, **options):
    path = tmp_path / "cam.csv"
    path.write_text(text, encoding="utf-8")
    return law("table", file=path, **options)


def test_a_table_file_in_other_units_says_the_same(tmp_path):
    plain = table(tmp_path, ROWS)
    assert plain.span == pytest.approx(TURN) and plain(1 / 3).s == pytest.approx(0.005) and plain.lift_unit == "m" and plain.closed
    other = table(tmp_path, "\ufeffLift [cm], note,Angle [rev]\n0.1,a,0\n0.5,b,0.3333333333333333\n\n0.3,c,0.6666666666666666\n0.1,d,1\n")
    assert other(0.77) == pytest.approx(plain(0.77))
    swing = table(tmp_path, ROWS.replace("mm", "deg"))
    assert swing.lift_unit == "rad" and swing(1 / 3).s == pytest.approx(math.radians(5))


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("240,3", "100,3", ["cam.csv", "row 3 (line 4): the angle in deg is 100 after 120"]),
        ("240,3", "240,nan", ["cam.csv", "line 4: the lift is 'nan', not a finite number"]),
        ("240,3", "240,x", ["cam.csv", "line 4: the lift is 'x', not a number"]),
        ("240,3", "240", ["cam.csv", "line 4: the lift is missing"]),
        ("360,1", "360,1.5", ["first and the last row disagree", "starts at 0.001 and ends at 0.0015", "+0.0005"]),
        ("0,1\n120", "5,1\n120", ["row 1 (line 2): the angle starts at 5°"]),
        ("120,5\n240,3\n", "", ["2 rows are too few", "at least 3"]),
        ("angle [deg],", "angle,", ["column 'angle'", "has no unit", "'angle [deg]'"]),
    ],
)
def test_table_files(tmp_path, old, new, message):
    refused(message, table, tmp_path, ROWS.replace(old, new))


def test_table_units_and_missing_files(tmp_path):
    refused(["cam.csv", "column 'angle'", "wants an angle", "mm"], table, tmp_path, ROWS.replace("deg", "mm"), error=UnitError)
    refused(["cam.csv", "column 'lift'", "kg"], table, tmp_path, ROWS.replace("mm", "kg"), error=UnitError)
    refused(["nowhere.csv", "No such file"], law, "table", file=tmp_path / "nowhere.csv")
    refused(["is empty", "angle [deg],lift [mm]"], table, tmp_path, "")


def test_table_arrays():
    refused(["either a file, or the arrays"], law, "table")
    refused(["either a file, or the arrays"], law, "table", angle=[0, 1, 2])
    refused(["shapes (3,) and (2,)"], law, "table", angle=[0, 1, 2], lift=[0, 1])
    refused(["row 2", "inf"], law, "table", angle=[0, math.inf, 2], lift=[0, 1, 2])


def test_segments():
    refused(["'cycloidal'", "angle is -10°", "positive"], Segment, math.radians(-10), "cycloidal", 1)
    refused(["angle is nan"], Segment, math.nan, "dwell")
    refused(["rise is inf"], Segment, 1, "cycloidal", math.inf)
    refused(["no rise is given", "make it a dwell"], Segment, 1, "cycloidal")
    refused(["a dwell does not move"], Segment, 1, "dwell", 0.1)
    refused(["did you mean 'parabolic'?"], Segment, 1, "parabolik", 0.1, error=UnknownName)
    refused(["its law is 3"], Segment, 1, 3, 0.1)
    angle = np.linspace(0, 1, 5)
    refused(["lifts of a table are absolute"], Segment, 1, law("table", angle=angle, lift=angle), 0.1)


def mirrored(segment):
    return Segment(segment.angle, segment.law, -segment.rise)


def test_programmes():
    up, down = Segment(2.0, "cycloidal", 0.01), Segment(2.0, "cycloidal", -0.008)
    rest = Segment(TURN - 4, "dwell")
    refused(["no segment"], Programme, [])
    refused(["sum to 229.183", "130.816882° less", "cycle of 360°", "add a dwell of 130.816882°"], Programme, [up, down])
    refused(["130.816882° more", "shorten"], Programme, [up, up, rest, rest])
    refused(["cycle is nan"], Programme, [up, down, rest], math.nan)
    refused(
        ["ends 0.002 (SI) above its start", "rises are 0.01 (SI), -0.008 (SI); with -0.01 (SI) in segment 2"], Programme, [up, down, rest]
    )
    refused(["ends 2 mm above", "10 mm, -8 mm; with -10 mm in segment 2 it closes"], Programme, [up, down, rest], TURN, "m")
    refused(["ends 2 mm below", "8 mm, -10 mm; with -8 mm in segment 2"], Programme, [mirrored(down), mirrored(up), rest], TURN, "m")
    refused(["ends 0.573 deg above"], Programme, [Segment(2.0, "cycloidal", math.radians(0.573)), Segment(TURN - 2, "dwell")], TURN, "rad")
    refused(["rises are 10 mm; as a dwell segment 1 closes it"], Programme, [up, Segment(TURN - 2, "dwell")], TURN, "m")
    fine = Programme([up, Segment(2.0, "cycloidal", -0.01), rest])
    refused(["programme on a piece: theta = 2.5", "0 .. 2", "call the motion itself"], fine.on_piece, 0, 2.5)
    refused(["no piece 3", "0 .. 2"], fine.on_piece, 3, 2.5)
    refused(["no piece -1"], fine.on_piece, [0, -1], 2.5)
    refused(["theta = 1.5 lies outside 2 .. 4 (1 of 2 values do)"], fine.on_piece, [0, 1], [1.5, 1.5])


def test_tables_in_programmes():
    angle = np.linspace(0, 2, 9)
    rows = law("table", angle=angle, lift=0.01 * (1 - law("cycloidal")(angle / 2).s))
    rest = Segment(TURN - 4, "dwell")
    refused(
        ["segment 2: its table ends at 114.591559°", "spans 120.321137°"],
        Programme,
        [Segment(2.0, "cycloidal", 0.01), Segment(2.1, rows), Segment(TURN - 4.1, "dwell")],
    )
    refused(
        ["segment 2: its table starts at a lift of 10 mm", "ends at 12 mm", "shift them by 2 mm"],
        Programme,
        [Segment(2.0, "cycloidal", 0.012), Segment(2.0, rows), rest],
        lift_unit="m",
    )
