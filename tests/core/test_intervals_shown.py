"""A value with an interval wherever it is shown: result.json, Parquet, command line, page, paper, figures."""

import json
import re

import chaos_toy
import numpy as np
import pytest
from pyarrow import parquet

from drivewright import registry, runner
from drivewright.cli import show
from drivewright.report.content import Views, content, views
from drivewright.report.folder import write_run_folder
from drivewright.report.html import page
from drivewright.report.index import write_index
from drivewright.report.tabular import write_csv
from drivewright.result import UNDECIDED, Check, Column, Plot, Table, Value
from drivewright.view import draw_panels
from drivewright.view.panels import find_plot, panels

pytestmark = pytest.mark.interface


@pytest.fixture(autouse=True)
def _toy(monkeypatch):
    chaos_toy.install(monkeypatch.setattr)
    monkeypatch.setattr(registry, "is_known", lambda kind: True)


def run(**keys):
    return runner.run(chaos_toy.Chaotic(**keys))


# -- the numbers ---------------------------------------------------------------------------------------------------------------


def test_record_has_the_interval_where_there_is_one():
    record = json.loads(json.dumps(run().record(), allow_nan=False))
    level, area = record["values"]["level"], record["values"]["area"]
    assert level["low"] < level["value"] < level["high"] and level["interval"] == "ensemble"
    assert set(area) == {"value", "unit", "label", "meaning"}
    assert "settled" not in level


def test_a_bound_that_is_no_number_is_left_out():
    value = Value(1.0, "m", "length", float("nan"), np.float64(2.0), "fit")
    assert value.record() == {"value": 1.0, "unit": "m", "label": "Length", "meaning": "length", "high": 2.0, "interval": "fit"}
    without = {"value": 1.0, "unit": "m", "label": "Length", "meaning": "length"}
    assert Value(1.0, "m", "length", None, float("inf"), "fit").record() == without


def test_what_has_not_settled_is_no_headline_and_stays_in_the_result():
    steady, drifting = run(), run(drift=3.0)
    mechanism = registry.mechanism("chaotic-toy")
    assert registry.headlines(mechanism, steady.values) == ["level", "area"]
    assert registry.headlines(mechanism, drifting.values) == ["area"]
    assert drifting.record()["values"]["level"]["settled"] is False
    assert not drifting.check("settled").ok
    assert [value["name"] for value in content(drifting)["headline"]] == ["area"]
    assert "not settled" in content(drifting)["values"][0]["hint"]


def test_a_table_says_whose_ends_its_columns_are(tmp_path):
    result = run()
    assert result.tables["course"].bounded("level.low") == "level" and result.tables["course"].bounded("level") == ""
    schema = result.table("course").schema
    assert schema.field("level.low").metadata[b"bounds"] == b"level" and b"bounds" not in schema.field("level").metadata
    assert schema.field("level.high").metadata[b"unit"] == b"m"
    parquet.write_table(result.table("course"), tmp_path / "course.parquet")
    back = parquet.read_table(tmp_path / "course.parquet")
    assert back.schema.field("level.high").metadata[b"bounds"] == b"level"
    write_csv(result.tables["course"], tmp_path / "course.csv")
    assert (tmp_path / "course.csv").read_text().startswith("window,level [mm],level.low [mm],level.high [mm],name\n")


def test_a_column_named_low_alone_is_a_column_of_its_own():
    table = Table("t", "T", (Column("x", "-", "x", np.arange(3.0)), Column("y.low", "-", "y", np.arange(3.0))))
    assert table.bounded("y.low") == "" and find_plot_columns(table) == ("y.low",)


def find_plot_columns(table):
    from drivewright.view.panels import whole_table

    return whole_table(table).y


# -- checks --------------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("low", "high", "sense", "undecided"),
    [(9.0, 11.0, "<=", True), (9.0, 11.0, ">=", True), (7.0, 9.5, "<=", False), (10.5, 12.0, "<=", False), (10.0, 12.0, "<=", False)],
)
def test_a_check_is_undecided_where_its_limit_lies_within(low, high, sense, undecided):
    value = Value((low + high) / 2, "m", "length", low, high, "ensemble")
    check = Check.of(value, "long", 10.0, sense, "not too long", ("rod",))
    assert check.undecided is undecided and check.record()["undecided"] is undecided
    assert check.parts == ("rod",)
    nearest, farthest = sorted((10.0 - low, 10.0 - high) if sense == "<=" else (low - 10.0, high - 10.0))
    assert check.margin_bounds == pytest.approx((nearest, farthest))


def test_a_check_without_interval_says_nothing_of_it():
    check = Check("long", 1.0, 2.0, "<=", "m", "not too long")
    assert not check.undecided and check.bounds is None and check.margin_bounds is None
    assert set(check.record()) == {"name", "label", "value", "limit", "sense", "margin", "unit", "ok", "message", "parts"}


def test_undecided_is_a_warning_on_the_page():
    result = run(size="11.6 mm")
    check = result.check("low_enough")
    assert check.ok and check.undecided
    said = content(result)
    assert said["verdict"] == {"state": "warn", "text": "1 of 2 checks undecided"}
    told = next(each for each in said["checks"] if each["name"] == "low_enough")
    assert told["undecided"] == UNDECIDED
    text = page("report.html.j2", said, player=None, solids=None, pictures=[])
    assert 'class="check warn"' in text and "Undecided: the limit lies within the interval" in text


# -- how it reads --------------------------------------------------------------------------------------------------------------


def test_command_line_tells_the_interval_and_how_it_was_made(capsys):
    show.result(run())
    out = capsys.readouterr().out
    assert re.search(r"Level of the drive +9.85 \(9.27 to 10.43\) mm +95 %, ensemble", out)
    show.result(run(noise=0.0))
    out = capsys.readouterr().out
    assert re.search(r"Level of the drive +10 mm +periodic", out)
    show.result(run(size="11.6 mm"))
    assert "undecided: the limit lies within" in " ".join(capsys.readouterr().out.split())


@pytest.mark.parametrize(
    ("value", "text"),
    [(-1.79834e-7, "-0.17983 µm"), (0.110291234, "110.29 mm"), (0.0, "0 mm"), (123.456789, "123460 mm"), (99.9999, "100000 mm")],
)
def test_command_line_prints_five_digits_where_there_is_no_interval(value, text):
    assert show.number(value, "m") == text


def test_command_line_prints_the_digits_that_an_interval_supports():
    assert show.number(-1.79834e-7, "m", -6.56e-7, 2.96e-7) == "-0.18 (-0.66 to 0.30) µm"


def test_command_line_prints_a_life_over_powers_of_ten_with_two_digits_each():
    assert show.number(2.2166e10, "-", 1.7e7, 2.74e13) == "2.2e+10 (1.7e+07 to 2.7e+13)"
    assert show.number(0.03, "m", 0.0029, 0.031) == "30 (2.9 to 31) mm"


def test_page_tells_the_interval_with_a_hint(tmp_path):
    result = run()
    text = page("report.html.j2", content(result), player=None, solids=None, pictures=[])
    assert '<p class="tile-interval" title="95\u00a0%, ensemble">9.27 to 10.43</p>' in text
    assert '<b>9.85\u00a0mm</b><span class="ends" title="95\u00a0%, ensemble">9.27 to 10.43</span>' in text
    folder = write_run_folder(result, tmp_path / "run", seen=Views())
    write_index([folder], tmp_path / "index.html")
    assert "9.85 (9.27 to 10.43)\u00a0mm" in (tmp_path / "index.html").read_text()


def test_paper_tells_the_interval(tmp_path):
    pytest.importorskip("typst")
    from drivewright.report.pdf import write_pdf

    result = run(size="11.6 mm")
    assert write_pdf(result, tmp_path / "report.pdf", seen=views(result)).stat().st_size > 10_000


# -- figures -------------------------------------------------------------------------------------------------------------------


def drawn(name):
    result = run()
    return result, draw_panels(panels(result, find_plot(result, name))).axes[0]


def ends_of(result):
    table = result.tables["course"]
    return np.array([table["level.low"].data, table["level.high"].data]) * 1e3


def vertical(axis):
    """(low, high) of all upright strokes."""
    return np.hstack(
        [np.array([segment[:, 1] for segment in lines.get_segments()]).T for lines in axis.collections if hasattr(lines, "get_segments")]
    )


def test_a_line_has_a_band():
    result, axis = drawn("course")
    low, high = ends_of(result)
    corners = np.vstack([path.vertices for path in axis.collections[0].get_paths()])
    assert set(np.round(np.hstack([low, high]), 9)) <= set(np.round(corners[:, 1], 9))
    assert axis.get_ylim()[0] < low.min() and axis.get_ylim()[1] > high.max()


@pytest.mark.parametrize("name", ["course", "points", "stems", "bars"])
def test_single_values_have_error_bars(name):
    result, axis = drawn(name)
    strokes = {tuple(np.round(pair, 9)) for pair in vertical(axis).T}
    assert {tuple(np.round(pair, 9)) for pair in ends_of(result).T} <= strokes


def test_ranked_bars_have_error_bars_in_their_order():
    result, axis = drawn("ranked")
    order = np.argsort(-np.abs(result.tables["course"]["level"].data), kind="stable")
    segments = np.array(axis.collections[0].get_segments())[:, :, 0].T
    assert segments == pytest.approx(ends_of(result)[:, order])


def test_lines_split_by_a_column_keep_their_own_ends():
    x, group = np.tile([0.0, 1.0, 2.0], 2), np.repeat([1.0, 2.0], 3)
    y = Column("y", "-", "y", np.arange(6.0))
    columns = (Column("x", "-", "x", x), Column("g", "-", "g", group), y, *y.bounds(y.data - 0.1, y.data + 0.3))
    result = run()
    result.tables["t"] = Table("t", "T", columns)
    (shown,) = panels(result, Plot("t", "T", "t", "x", ("y",), by="g"))
    assert [series.ends[0].tolist() for series in shown.series] == [pytest.approx([-0.1, 0.9, 1.9]), pytest.approx([2.9, 3.9, 4.9])]
    assert [series.ends[1].tolist() for series in shown.series] == [pytest.approx([0.3, 1.3, 2.3]), pytest.approx([3.3, 4.3, 5.3])]
    (cloud,) = panels(result, Plot("t", "T", "t", "x", ("y",), style="points", by="g"))
    assert np.isnan(cloud.series[0].ends[0][3:]).all() and np.isfinite(cloud.series[0].ends[0][:3]).all()


def test_the_whole_table_draws_ends_as_a_band_and_not_as_lines():
    result = run()
    (shown,) = panels(result, find_plot(result, "course")._replace(y=find_plot_columns(result.tables["course"])))
    assert [series.name for series in shown.series] == ["level"] and len(shown.series[0].ends) == 2
