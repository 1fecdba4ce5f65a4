"""The report of a study and its table: complete, self-contained, replaced whole; a table that other programs read."""

import csv
import json
import re
import subprocess
import sys
import time
from dataclasses import replace

import numpy as np
import openpyxl
import pyarrow as pa
import pytest
from pyarrow import parquet
from test_report_page import Page

from drivewright.errors import InputError
from drivewright.execution.keys import key_kind
from drivewright.report import tabular
from drivewright.report.study import cases, reasons, study_content, varied, verdict, write_answers
from drivewright.report.tabular import rounded, write_study_table
from drivewright.result import Column, Plot, Table, Value
from drivewright.spec import from_document
from drivewright.studies.answers import Answers, analyse_study
from drivewright.studies.plan import make_plan
from drivewright.studies.study import Study
from drivewright.studies.variables import Variable

pytestmark = pytest.mark.interface

NASTY = '</script><img src=x onerror=alert(1)> & "quoted", {{ 7*7 }} =1+1'


def spec(**study):
    return from_document(
        {
            "mechanism": "silent-chain",
            "title": "A <b>chain</b>",
            "pitch": "9.525 mm",
            "links": 82,
            "teeth": [35, 37],
            "joint": {"kind": "round-pin", "rolling_radius": "1.2 mm"},
            "plate": {"flank_angle": "30 deg", "apothem": "2.6 mm"},
            "study": study,
        }
    )


GRID = {
    "vary": [
        {"key": "joint.rolling_radius", "values": ["0.6 mm", "1.2 mm", "2.4 mm"]},
        {"key": "drive.speed", "lower": "100 rpm", "upper": "10000 rpm", "steps": 9, "spacing": "logarithmic"},
    ]
}
SAMPLE = {
    "samples": 40,
    "method": "random",
    "vary": [
        {"key": "joint.rolling_radius", "tolerance": "0.06 mm"},
        {"key": "plate.apothem", "lower": "2.5 mm", "upper": "2.7 mm"},
        {"key": "pitch", "distribution": "triangular", "lower": "9.5 mm", "upper": "9.56 mm"},
    ],
}


def study_of(given, folder=None, failing=0):
    """A study whose numbers are made up: a play that grows with the radius, a check; the first cases fail."""
    plan = make_plan(given)
    n, columns = len(plan), plan.cases(0, len(plan))
    radius = np.asarray(columns["joint.rolling_radius"])
    status = np.array(["complete"] * n, dtype=object)
    message = np.array([""] * n, dtype=object)
    status[:failing], message[:failing] = "failed", [f"{NASTY}: the teeth miss by {k / 7:.3f} mm" for k in range(failing)]
    play = np.where(np.arange(n) < failing, np.nan, radius**2 * 10 + 1e-6 * np.arange(n))
    arrays = {
        "case": (np.arange(n), "-", "number of the case"),
        "status": (status, "", "s"),
        "message": (message, "", "m"),
        **{key: (column, "m" if key != "drive.speed" else "rad/s", "varied") for key, column in columns.items()},
        "play": (play, "m", "play of the joint"),
        "check.play": (1e-4 - play, "m", "margin"),
    }
    fields = [
        pa.field(name, pa.array(data).type, metadata={"unit": unit, "meaning": meaning}) for name, (data, unit, meaning) in arrays.items()
    ]
    made = [pa.array(data, mask=np.isnan(data) if data.dtype.kind == "f" else None) for data, _, _ in arrays.values()]
    return Study(given, plan, pa.Table.from_arrays(made, schema=pa.schema(fields)), folder, 12.5)


def report(study, folder, found=None):
    path = write_answers(study, found or analyse_study(study), folder)
    text = path.read_text(encoding="utf-8")
    return text, Page(text), re.sub(r"\s+", " ", Page(text).text.replace("\u00a0", " "))


# -- the page ------------------------------------------------------------------------------------------------------------------


def test_the_page_says_what_varied_what_became_of_it_and_how_to_do_it_again(tmp_path):
    study = study_of(spec(**GRID), failing=5)
    _, page, text = report(study, tmp_path)
    for part in (
        "A <b>chain</b>",
        "joint.rolling_radius",
        "0.6 mm, 1.2 mm, 2.4 mm",
        "100 rpm … 10 000 rpm, 9 levels in equal ratios",
        "3 × 9 levels = 27 cases",
        "22 of 27 cases complete",
        "5 failed",
        "drivewright sweep study.toml",
        study.plan.digest[:12],
        study.spec.digest()[:12],
        "12.5 s",
        "numpy",
        "figures/plot-map.play.svg",
        "[[study.vary]]",
    ):
        assert part in text, part
    assert f"the teeth miss by 0.000 … 0.571 mm (the first: {NASTY}: the teeth miss by 0.000 mm)" in page.text
    assert not [a for tag, a in page.tags if "onerror" in a]


def test_no_request_leaves_the_page_and_everything_is_beside_it(tmp_path):
    found = analyse_study(study_of(spec(**GRID)))
    _, page, _ = report(study_of(spec(**GRID)), tmp_path, found)
    for tag, attributes in page.tags:
        for name in ("src", "href", "srcset", "action", "data"):
            assert attributes.get(name, "data:").startswith("data:"), (tag, name)
    assert [tag for tag, _ in page.tags].count("img") == len(found.plots) == len(list((tmp_path / "figures").iterdir())) > 0
    assert sorted(p.stem for p in (tmp_path / "tables").iterdir()) == sorted(found.result.tables)
    record = json.loads((tmp_path / "answers.json").read_text(encoding="utf-8"))
    assert record["values"]["cases"]["value"] == 27 and record["digest"] == found.result.digest
    table = parquet.read_table(tmp_path / "tables" / "range.parquet")
    assert table.column_names == [column.name for column in found.result.tables["range"].columns]


def test_an_older_report_is_replaced_and_nothing_else(tmp_path):
    (tmp_path / "figures").mkdir()
    (tmp_path / "figures" / "plot-old.svg").write_text("<svg/>")
    (tmp_path / "figures" / "notes.txt").write_text("mine")
    (tmp_path / "study.toml").write_text("kept")
    study = study_of(spec(**GRID))
    report(study, tmp_path)
    first = {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()}
    report(study, tmp_path)
    assert first == {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()}
    names = {path.name for path in first}
    assert "plot-old.svg" not in names and {"notes.txt", "study.toml", "report.html"} <= names


def test_a_sample_has_histograms_bars_and_its_spread(tmp_path):
    text, _, words = report(study_of(spec(**SAMPLE)), tmp_path)
    assert "40 points by random (40 sample) = 40 cases" in words and "all 40 cases complete" in words
    assert "figures/plot-histogram.play.svg" in words and "seed (1)" in words and len(text) < 2_000_000


def test_small_tables_are_on_the_page_in_the_units_of_their_rows():
    study = study_of(spec(**GRID))
    rows = {"value": ("", ["play", "k"]), "unit": ("", ["m", "-"]), "least": ("", [2e-3, 0.5]), "angle": ("rad", np.radians([30, 45]))}
    small = Table("small", "Small", tuple(Column(name, unit, name, np.array(data)) for name, (unit, data) in rows.items()))
    large = replace(small, name="large", columns=tuple(c._replace(data=np.resize(c.data, 41)) for c in small.columns))
    found = analyse_study(study)
    told = study_content(study, Answers(replace(found.result, tables={"small": small, "large": large}, values={}), ()))
    assert told["tables"][0]["printed"] == [("play", "2\u00a0mm", "30"), ("k", "0.5", "45")]
    assert [head["unit"] for head in told["tables"][0]["columns"]] == ["", "", "°"]
    assert "printed" not in told["tables"][1] and told["tables"][1]["rows"] == 41


def test_the_tiles_are_the_yield_and_what_has_a_plot():
    study = study_of(spec(**GRID))
    values = {name: Value(1.0, "m", name) for name in ("cases", "least.play", "least.k", "yield", "yield.low", "greatest.play")}
    found = Answers(
        replace(analyse_study(study).result, values=values, tables={}), (Plot("p", "P", "t", "x", ("key", "play"), style="map"),)
    )
    assert [tile["name"] for tile in study_content(study, found)["headline"]] == ["least.play", "yield", "greatest.play"]


def test_a_study_cut_short_is_never_good():
    whole = study_of(spec(**GRID))
    part = replace(whole, rows=whole.table.slice(0, 20))
    assert verdict(whole) == {"state": "good", "text": "all 27 cases complete"}
    assert verdict(part) == {"state": "warn", "text": "20 of 27 cases complete"}
    assert cases(part)[-1] == {"name": "not computed yet", "count": "7", "state": "none", "share": 7} and len(cases(whole)) == 3
    assert verdict(study_of(spec(**GRID), failing=27))["state"] == "bad" and reasons(whole) == []


def test_reasons_that_differ_in_numbers_only_are_one_and_the_commonest_comes_first():
    study = study_of(spec(**GRID), failing=5)
    messages = ["no oil", "gap 1.5 mm at -3e-2", "gap 2 mm at 7", "gap 3 mm at 1e+5", None]
    place = study.table.column_names.index("message")
    table = study.table.set_column(place, study.table.schema.field(place), pa.array(messages + [""] * 22))
    assert [(row["count"], row["text"]) for row in reasons(replace(study, rows=table))] == [
        (3, "gap 1.5 … 3 mm at -3e-2 … 1e+5 (the first: gap 1.5 mm at -3e-2)"),
        (1, "no oil"),
        (1, "no reason given"),
    ]


def test_what_varied_in_words():
    by_key = {each.key: varied(each) for each in make_plan(spec(**SAMPLE)).variables}
    thin = {key: row[1].replace("\u00a0", " ") for key, row in by_key.items()}
    assert thin["joint.rolling_radius"] == "normal, mean 1.2 mm, standard deviation 20 µm, within 1.14 mm … 1.26 mm"
    assert thin["plate.apothem"] == "uniform, 2.5 mm … 2.7 mm" and by_key["plate.apothem"][2] == "2.6\u00a0mm"
    assert thin["pitch"] == "triangular, 9.5 mm … 9.56 mm, peak at 9.525 mm"
    given = spec(**GRID)
    kind = key_kind(given, "joint.rolling_radius")
    assert varied(Variable("k", kind, None, np.linspace(1, 2, 11) * 1e-3))[1:] == ("1\u00a0mm … 2\u00a0mm, 11 levels in equal steps", "")
    assert varied(Variable("k", kind, None, np.arange(1, 10) ** 2 * 1e-3))[1].endswith("9 levels in uneven steps")
    texts = Variable("k", key_kind(given, "joint.kind"), "round-pin", np.array(["a", "b"], dtype=object))
    assert varied(texts) == ("k", "a, b", "round-pin")
    assert varied(Variable("k", kind, 1e-3))[1] == "the points of a file"


# -- the table -----------------------------------------------------------------------------------------------------------------


def test_csv_in_shown_units_with_empty_cells_for_what_is_missing(tmp_path):
    study = study_of(spec(**GRID), failing=2)
    with write_study_table(study, tmp_path / "t.csv").open(newline="", encoding="utf-8") as file:
        head, *rows = csv.reader(file)
    assert head == ["case", "status", "message", "joint.rolling_radius [mm]", "drive.speed [rpm]", "play [mm]", "check.play [mm]"]
    assert rows[0][:2] == ["0", "failed"] and rows[0][2].startswith(NASTY) and rows[0][3:] == ["0.6", "100", "", ""]
    assert [float(row[5]) for row in rows[2:]] == pytest.approx(1e3 * study["play"][2:], rel=1e-12) and rows[-1][3:5] == ["2.4", "10000"]


def test_a_sheet_with_numbers_as_numbers_and_texts_as_texts(tmp_path):
    study = study_of(spec(**GRID), failing=2)
    sheet = openpyxl.load_workbook(write_study_table(study, tmp_path / "t.xlsx")).active
    rows = list(sheet.iter_rows(values_only=True))
    assert rows[0][3:5] == ("joint.rolling_radius [mm]", "drive.speed [rpm]") and len(rows) == 28 and sheet.freeze_panes == "B2"
    assert rows[1][0] == 0 and rows[1][2].startswith(NASTY) and rows[1][3:] == (0.6, 100, None, None)
    assert [row[5] for row in rows[3:]] == pytest.approx(1e3 * study["play"][2:], rel=1e-12)
    assert sheet["C3"].data_type == "s"


def test_parquet_is_the_table_itself(tmp_path):
    study = study_of(spec(**GRID), failing=2)
    read = parquet.read_table(write_study_table(study, tmp_path / "t.PARQUET"))
    assert read.equals(study.table) and read.schema.field("play").metadata == {b"unit": b"m", b"meaning": b"play of the joint"}


def test_other_formats_and_what_no_sheet_holds_are_refused(tmp_path, monkeypatch):
    study = study_of(spec(**GRID))
    with pytest.raises(InputError, match=r"t\.ods: cannot be written as \.ods; take \.csv, \.xlsx, \.parquet"):
        write_study_table(study, tmp_path / "t.ods")
    with pytest.raises(InputError, match="as a file without a suffix"):
        write_study_table(study, tmp_path / "t")
    long = replace(study, rows=pa.table({"case": pa.array(np.arange(1_048_576))}))
    with pytest.raises(InputError, match="1048576 cases are more than the 1048575 that an Excel sheet holds; take parquet or csv"):
        write_study_table(long, tmp_path / "t.xlsx")
    monkeypatch.setattr(tabular, "SHEET_COLUMNS", 3)
    with pytest.raises(InputError, match="7 columns are more than the 3"):
        write_study_table(study, tmp_path / "t.xlsx")
    assert list(tmp_path.iterdir()) == []


def test_numbers_are_the_nearest_floats_of_twelve_figures():
    rng = np.random.default_rng(4)
    data = rng.normal(size=4000) * 10.0 ** rng.integers(-40, 40, 4000)
    data = np.concatenate([data, [0.0, -0.0, 0.1 + 0.2, 1e3 * 0.0006, 999999999999.6, 1e300, 5e-324]])
    assert rounded(data).tolist() == [float(f"{value:.12g}") for value in data.tolist()]
    assert str(rounded(np.array([-0.0]))[0]) == "0.0"


def test_a_long_table_takes_seconds_and_no_matplotlib(tmp_path):
    n = 100_000
    numbers = np.random.default_rng(1).normal(size=n)
    fields = [pa.field(f"v{k}", pa.float64(), metadata={"unit": "m"}) for k in range(6)]
    study = replace(study_of(spec(**GRID)), rows=pa.Table.from_arrays([pa.array(numbers)] * 6, schema=pa.schema(fields)))
    started = time.perf_counter()
    path = write_study_table(study, tmp_path / "t.csv")
    assert time.perf_counter() - started < 10.0
    lines = path.read_text().splitlines()
    assert len(lines) == n + 1 and float(lines[-1].split(",")[3]) == pytest.approx(1e3 * numbers[-1], rel=1e-11)
    code = "import sys; import drivewright.report.tabular; assert not {'matplotlib', 'pyarrow', 'xlsxwriter'} & set(sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True)
