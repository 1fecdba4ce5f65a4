"""Data files as spreadsheets, instruments and numpy write them: read to the same numbers, or told what stands where."""

import codecs
import io

import numpy as np
import pytest

from drivewright.errors import SpecError
from drivewright.motion.tables import read_table
from drivewright.multibody.curve_files import load_curve
from drivewright.spec.csv_columns import read_columns
from drivewright.spec.csv_headings import Wanted
from drivewright.spec.csv_numbers import last_digit
from drivewright.spec.csv_table import read_csv

ROWS = ((0, 0), (60, 3.25), (120, 10.5), (180, 12.125), (240, 9), (300, 2), (360, 0))


def body(separator, decimal="."):
    return "".join(separator.join(f"{number:g}".replace(".", decimal) for number in row) + "\n" for row in ROWS)


def numpy_text():
    text = io.StringIO()
    np.savetxt(text, ROWS, header="angle [deg] lift [mm]", fmt="%.3f")
    return text.getvalue()


FILES = {
    "comma": "angle [deg],lift [mm]\n" + body(","),
    "semicolon and decimal comma": "angle [deg]; lift (mm)\n" + body(";", ","),
    "tab and decimal comma": "Angle/deg\tLift/mm\n" + body("\t", ","),
    "blanks in columns": "angle [deg]     lift [mm]\n" + body("      "),
    "single blanks": "angle [deg] lift [mm]\n" + body(" "),
    "single blanks and decimal comma": "angle_deg lift_mm\n" + body(" ", ","),
    "numpy": numpy_text(),
    "byte-order mark, quotes, degree sign": '\ufeff"Cam angle (°)";"Valve lift (mm)"\n' + body(";"),
    "sep= and a row of units, in German": "sep=;\nNockenwinkel;Hub\n[°];[mm]\n" + body(";", ","),
    "row of bare units": "angle\tlift\ndeg\tmm\n" + body("\t"),
    "lines before the headings": "Bench 3, 2024-01-01\n\n% operator: N N\nangle_deg,lift_mm\n" + body(","),
    "comments in between": "# lift of cam 7\nangle [deg],lift [mm]\n" + body(",").replace("120,", "// here\n\n120,"),
    "units in words": "angle in degrees,lift in millimetres\n" + body(","),
    "units behind a comma, quoted": '"angle, deg";"lift, mm"\n' + body(";"),
    "capitals": "ANGLE [DEG],LIFT [MM]\n" + body(","),
    "line feeds of Windows": ("angle [deg],lift [mm]\n" + body(",")).replace("\n", "\r\n"),
    "another angle beside the cam's": "pressure angle [deg],cam angle [deg],valve lift [mm]\n" + "".join(f"9,{a},{s}\n" for a, s in ROWS),
    "line feed in a heading": '"angle\n[deg]","lift\n[mm]"\n' + body(","),
    "other columns and empty cells": "no.;lift [mm];note;angle [deg]\n" + "".join(f'7;{s};"a; b";{a};;\n' for a, s in ROWS),
    "minus sign and exponents": "angle [deg],lift [mm]\n"
    + body(",").replace("3.25", "3.25E+00").replace("60,", "6.0e1,").replace("0,0\n", "\u22120,0\n"),
    "lift in micrometres": "angle [deg];lift [µm]\n" + "".join(f"{a};{s * 1000:.1f}\n" for a, s in ROWS),
    "German compounds": "Nockenwellenwinkel [deg];Ventilhub [mm]\n" + body(";", ","),
    "German, other words": "Drehwinkel [°];Erhebung [mm]\n" + body(";", ","),
    "French": "Angle de came [deg];Levée [mm]\n" + body(";", ","),
    "Italian, accents as two characters": "Angolo camma (deg);Alzata valvola (mm)\n" + body(";", ","),
    "Spanish": "A\u0301ngulo de leva [deg];Elevacio\u0301n [mm]\n" + body(";", ","),
    "Chinese with its own brackets": "凸轮转角（deg）,升程（mm）\n" + body(","),
    "a crank's angle beside the cam's": "Kurbelwinkel [°];Nockenwinkel [°];Hub [mm]\n" + "".join(f"{2 * a};{a};{s}\n" for a, s in ROWS),
    "a sentence before the headings": "lift of cam 7\nangle [deg];lift [mm]\n" + body(";", ","),
    "angle in turns": "angle [rev],lift [cm]\n" + "".join(f"{a / 360!r},{s / 10!r}\n" for a, s in ROWS),
}


@pytest.mark.interface
@pytest.mark.parametrize("how", FILES)
def test_the_same_numbers_however_they_are_written(tmp_path, how):
    path = tmp_path / "lift.csv"
    path.write_text(FILES[how], encoding="utf-8", newline="")
    rows = read_table(path)
    angle, lift = np.array(ROWS).T
    assert rows.angle == pytest.approx(np.radians(angle), abs=1e-12) and rows.lift == pytest.approx(lift / 1e3, abs=1e-12)
    assert rows.lift_unit == "m"


@pytest.mark.interface
@pytest.mark.parametrize("encoding", ["utf-16", "utf-8-sig"])
def test_unicode_of_spreadsheets(tmp_path, encoding):
    path = tmp_path / "lift.txt"
    path.write_bytes(FILES["tab and decimal comma"].encode(encoding))
    assert read_table(path).lift == pytest.approx(np.array(ROWS)[:, 1] / 1e3)
    assert path.read_bytes()[:2] in (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE, b"\xef\xbb")


REFUSED = {
    "decimal comma between commas": (
        "angle [deg],lift [mm]\n0,0\n60,3,25\n",
        ("line 3: 3 cells between commas", "headings of line 1 are 2", "separate the columns by semicolons"),
    ),
    "thousand or decimal": (
        "angle [deg];lift [mm]\n0;1,234\n60;2,345\n",
        ("line 2: the lift '1,234' may be 1.234 or 1234", "three digits"),
    ),
    "two decimal signs": ("angle [deg];lift [mm]\n0;0\n60;3,25\n120;4.5\n", ("line 3 has '3,25', line 4 has '4.5'", "one decimal sign")),
    "sign of thousands": ("angle [deg];lift [mm]\n0;1.000,25\n", ("line 2: the lift '1.000,25' has a point and a comma",)),
    "no headings": (body(","), ("line 1: '0,0' has numbers alone", "angle [deg],lift [mm]")),
    "other headings": ("alpha [deg],lift [mm]\n" + body(","), ("no column 'angle [deg]' in the first line", "alpha [deg]")),
    "no unit": ("angle,lift\n" + body(","), ("column 'angle': has no unit; write 'angle [deg]'",)),
    "degree or gon": ("Winkel [Grad];Hub [mm]\n" + body(";"), ("column 'angle'", "'Grad' may mean degrees or gons", "write 'deg'")),
    "megametres": ("angle [deg];lift [Mm]\n" + body(";"), ("column 'lift'", "'Mm' may mean megametres")),
    "two angles": ("wheel angle [deg],shaft angle [deg],lift [mm]\n0,0,0\n", ("line 1", "may both be the angle", "rename")),
    "twice": ("angle [deg],angle [rad],lift [mm]\n0,0,0\n", ("line 1: column 'angle' is there twice",)),
    "crank": ("crank angle [deg],lift [mm]\n" + body(","), ("'crank angle [deg]' is no cam angle", "half as far")),
    "crank in German": ("Kurbelwinkel [°];Ventilhub [mm]\n" + body(";"), ("'Kurbelwinkel [°]' is no cam angle", "half as far")),
    "crank in Italian": ("angolo di manovella [deg],alzata [mm]\n" + body(","), ("is no cam angle", "half of these")),
    "degrees of the crank": ("Winkel [°KW];Hub [mm]\n" + body(";"), ("column 'angle'", "'°KW' may mean degrees of the crank")),
    "mass in place of a lift": ("angle [deg];Hub [kg]\n" + body(";"), ("column 'lift': wants a length or an angle, got 'kg' (mass)",)),
    "headings of line 3": (
        "Messung 3; 2024\nBank 7; Halle 2\nStellung [deg];Ventilhub [mm]\n" + body(";"),
        ("no column 'angle [deg]' in line 3 'Stellung [deg];Ventilhub [mm]'", "should read 'angle [deg];lift [mm]'"),
    ),
    "a sentence, other headings and a row of units": (
        "lift of cam 7\nStellung;Ausschlag\n[deg];[mm]\n" + body(";"),
        ("no column 'angle [deg]' in line 2 'Stellung;Ausschlag'",),
    ),
    "a sentence with all words": ("lift of cam\n0 0\n60 3\n", ("line 1: 'lift of cam' has 3 cells between blanks", "another number")),
    "unit in a cell": (
        "angle [deg],lift [mm]\n0,0\n60,3.25 mm\n",
        ("line 3: the lift is '3.25 mm', not a number", "units stand in the heading"),
    ),
    "missing cell": ("angle [deg],lift [mm]\n0,0\n\n# note\n60,\n", ("line 5: the lift is missing",)),
    "blank as sign of thousands": ("angle [deg];lift [um]\n0;0\n60;3 250\n", ("line 3: the lift is '3 250'", "thousands have no sign")),
    "short row of blanks": ("angle [deg] lift [mm]\n0 0\n60\n", ("line 3: 1 cells between blanks", "headings of line 1 are 2")),
    "underscored": ("angle [deg],lift [mm]\n0,0\n60,1_000\n", ("line 3: the lift is '1_000', not a number",)),
    "nan": ("angle [deg],lift [mm]\n0,0\n60,NaN\n", ("line 3: the lift is 'NaN', not a finite number",)),
    "empty": ("# nothing\n", ("is empty", "angle [deg],lift [mm]")),
    "bracket": ("angle [deg;lift [mm]\n0;0\n", ("column 'angle'", "has no unit, as its bracket is not closed")),
}


@pytest.mark.error
@pytest.mark.parametrize("what", REFUSED)
def test_what_cannot_be_read_is_told_with_its_line(tmp_path, what):
    text, words = REFUSED[what]
    path = tmp_path / "lift.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(SpecError) as caught:
        read_table(path)
    message = str(caught.value)
    assert message.startswith(str(path)) and all(word in message for word in words), message


@pytest.mark.error
def test_a_file_of_another_code_page(tmp_path):
    path = tmp_path / "lift.csv"
    path.write_bytes("# Nocke 7\nWinkel [°];Hub [mm]\n0;0\n".encode("cp1252"))
    with pytest.raises(SpecError, match="line 2 has the byte 0xb0, which is no UTF-8 .*'°'.*save the file as 'CSV UTF-8'"):
        read_table(path)


@pytest.mark.property
@pytest.mark.parametrize(
    ("texts", "step"),
    [(["0", "12"], 1), (["0.10", "3.25"], 0.01), (["0,1", "3,250"], 0.001), (["1.5e-3", "2E2"], 1e-4), (["1.25d2"], 1), ([" -3.5 "], 0.1)],
)
def test_last_printed_digit(texts, step):
    assert last_digit(texts) == pytest.approx(step, rel=1e-12)


@pytest.mark.property
def test_the_last_digit_is_counted_in_the_unit_of_the_column(tmp_path):
    path = tmp_path / "lift.csv"
    path.write_text("angle [deg];lift [um]\n0;0,0\n10;3,25\n")
    table = read_csv(path, (Wanted("lift", {"length": "mm"}),), (("lift",),))
    assert table.last_digit("lift") == pytest.approx(1e-8) and table.lines == [2, 3] and "angle" not in table


@pytest.mark.interface
def test_loads_of_linkages_and_force_curves_gain_too(tmp_path):
    path = tmp_path / "load.csv"
    path.write_text("# bench\nTime (ms);Torque (N mm)\n0,5;1000\n20,5;3000,5\n")
    curve = load_curve(path, "torque", "torque")
    assert curve.over == "time" and curve.curve.breaks[1:-1] == pytest.approx([0.5e-3, 20.5e-3])
    path.write_text("displacement in um\tforce in kN\n0\t0\n12,5\t1,5\n")
    pair = read_columns(path, {"displacement": "length"}, {"force": "force"})
    assert pair.x == pytest.approx([0, 12.5e-6]) and pair.y == pytest.approx([0, 1500])
    path.write_text("Zeit [s];Faktor\n0;1\n0,5;2,5\n", encoding="utf-8")
    assert load_curve(path, "factor", "a pure number").curve.breaks[1:-1] == pytest.approx([0, 0.5])
    path.write_text("曲柄转角 [deg],力矩 [N m]\n0,1\n90,3\n", encoding="utf-8")
    assert load_curve(path, "torque", "torque").over == "angle"
    path.write_text("angle [deg],factor\n0,1\n90,3\n")
    assert load_curve(path, "factor", "a pure number").curve.breaks[1] == 0
    path.write_text("time [s],torque [N m]\n0,1\n0,2\n")
    with pytest.raises(SpecError, match=r"row 2 \(line 3\): the time must increase from row to row, but '0' follows '0'"):
        load_curve(path, "torque", "torque")
