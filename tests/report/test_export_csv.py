"""CSV tables: units in the header, values that come back."""

import csv

import numpy as np
import pytest

from drivewright.report.tabular import heading, write_csv
from drivewright.result import Column, Table
from drivewright.units import to_si

pytestmark = pytest.mark.property

ANGLE = np.radians(np.linspace(0, 360, 73))
TABLE = Table(
    "inspection",
    "Inspection table",
    (
        Column("angle", "rad", "cam angle", ANGLE),
        Column("radius", "m", "profile radius", 0.03 + 0.01 * np.sin(ANGLE) ** 2),
        Column("pressure", "Pa", "Hertz stress", np.where(ANGLE > 1, 5.09e8, np.nan)),
        Column("ratio", "-", "gear ratio", np.cos(ANGLE)),
        Column("tooth", "-", "number", np.arange(73)),
        Column("phase", "-", "name", np.array(["rise, upper"] * 73)),
    ),
)
DIMENSIONS = {"angle": "angle", "radius": "length", "pressure": "pressure"}


def rows(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.reader(file))


def test_header_carries_the_units_people_read(tmp_path):
    write_csv(TABLE, tmp_path / "t.csv")
    assert rows(tmp_path / "t.csv")[0] == ["angle [deg]", "radius [mm]", "pressure [MPa]", "ratio", "tooth", "phase"]
    assert heading(Column("torque", "N m", "torque", ANGLE)) == "torque [N m]"


def test_values_come_back_to_twelve_figures(tmp_path):
    write_csv(TABLE, tmp_path / "t.csv")
    header, *body = rows(tmp_path / "t.csv")
    for name, column in zip(header[:2], TABLE.columns[:2], strict=True):
        plain, unit = name.rstrip("]").split(" [")
        back = [to_si(f"{row[header.index(name)]} {unit}", DIMENSIONS[plain]) for row in body]
        assert back == pytest.approx(column.data, rel=2e-12, abs=1e-15)
    assert [float(row[3]) for row in body] == pytest.approx(TABLE["ratio"].data, rel=2e-12, abs=1e-15)


def test_missing_numbers_are_empty_whole_numbers_whole_and_text_quoted(tmp_path):
    write_csv(TABLE, tmp_path / "t.csv")
    body = rows(tmp_path / "t.csv")[1:]
    assert [row[2] for row in body] == ["" if a <= 1 else "509" for a in ANGLE]
    assert [row[4] for row in body] == [str(i) for i in range(73)]
    assert {row[5] for row in body} == {"rise, upper"}
    assert b"\r" not in (tmp_path / "t.csv").read_bytes()


def test_file_takes_its_place_only_when_it_is_complete(tmp_path):
    from drivewright.atomic import replacing

    (tmp_path / "t.csv").write_text("old")
    with pytest.raises(RuntimeError, match="half-way"), replacing(tmp_path / "t.csv") as temporary:
        temporary.write_text("new")
        raise RuntimeError("half-way")
    assert (tmp_path / "t.csv").read_text() == "old" and len(list(tmp_path.iterdir())) == 1
    write_csv(TABLE, tmp_path / "deep" / "t.csv")
    assert [path.name for path in (tmp_path / "deep").iterdir()] == ["t.csv"]
