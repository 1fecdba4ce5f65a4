"""Pages, findings and terminal of a study or a search in the units of the spec: inches, and long times in hours."""

import html
import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pyarrow as pa
import pytest
from study_toy import Toy, install
from typer.testing import CliRunner

import drivewright as dw
from drivewright.cli import show
from drivewright.cli.app import app
from drivewright.report.content import Views, pictures
from drivewright.report.optimised import write_optimised
from drivewright.report.study import study_content, varied, write_answers
from drivewright.result import Check, Column, Table
from drivewright.spec import from_document
from drivewright.spec.fields import Field
from drivewright.studies import verification
from drivewright.studies.answers import Answers, analyse_study
from drivewright.studies.plan import make_plan
from drivewright.studies.spec_differences import differing_keys
from drivewright.studies.variation import linked, linspace, normal, tolerance, triangular, uniform, with_variation
from drivewright.studies.verification import Comparison
from drivewright.units import Temperature
from drivewright.view.panels import panels

pytestmark = pytest.mark.interface

METRIC = re.compile(r"[\d\u00a0\s](?:mm|N|MPa|kg|m|mm²)(?![\w/])")
GRID = {"size": linspace("5.08 mm", "10.16 mm", 5), "ratio": [1, 2], "force": ["4.4482216152605 N", "8.896443230521 N"]}


@pytest.fixture(autouse=True)
def _toy(monkeypatch):
    install(monkeypatch.setattr)


def plain(text):
    return text.replace("\u00a0", " ")


def studied(vary, units="inch", **settings):
    return dw.sweep(with_variation(Toy(units=units), vary, every_analysis=True, **settings), on="serial")


def in_words(vary, **settings):
    spec = with_variation(settings.pop("spec", Toy(units="inch")), vary, **settings)
    return [plain(varied(each, spec.units)[1]) for each in make_plan(spec).variables]


# -- the page ------------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("vary", "method"),
    [(GRID, "random"), ({"size": tolerance("1.27 mm"), "force": normal("2 N", "0.1 N"), "flag": [True, False]}, "tolerance")],
)
def test_no_page_in_inches_says_millimetres(vary, method, tmp_path):
    study = studied(vary, method=method, samples=12)
    text = html.unescape(write_answers(study, analyse_study(study), tmp_path).read_text(encoding="utf-8"))
    body = text[text.index("What varied") : text.index('id="values"')]  # where the values are also in SI
    shown = re.sub(r"<(?:svg|script|style).*?</(?:svg|script|style)>|title=\"[^\"]*\"|<[^>]*>", " ", body, flags=re.DOTALL)
    assert " in " in plain(shown) and " lbf" in plain(shown) and not METRIC.findall(shown)


def test_figures_and_titles_in_inches():
    study = studied(GRID)
    answers = analyse_study(study, ("value.size", "more"))
    labels = {panel.label for plot in answers.plots for panel in panels(answers.result, plot)}
    assert "Size again [in]" in labels and "Force per size [lbf/in]" in labels and not any("mm" in label for label in labels)
    drawn = pictures(answers.result, Views(plots=answers.plots))
    assert any("force = 1 lbf" in plain(picture.title) for picture in drawn) and not any("\u00a0N" in picture.title for picture in drawn)


def test_tables_on_the_page_are_in_the_units_of_the_spec():
    printed = {}
    for units in ("inch", "si", "mm"):
        study = studied(GRID, units)
        told = study_content(study, analyse_study(study))
        table = next(table for table in told["tables"] if table["name"] == "range")
        printed[units] = {row[0]: [plain(cell) for cell in row[1:]] for row in table["printed"]}
    assert printed["inch"]["value.size"] == ["20", "0.2 in", "0", "0.4 in", "16"]
    assert printed["si"]["value.size"][1] == "0.00508 m" and printed["mm"]["value.size"][1] == "5.08 mm"
    assert printed["inch"]["more"][3] == "10 lbf/in"


def test_columns_with_a_unit_of_their_own():
    study = studied(GRID)
    data = {"life": ("s", [1800.0, 3.6e7]), "short": ("s", [2.0, 30.0]), "width": ("m", [0.0254, 0.0127]), "name": ("", ["a", "b"])}
    columns = tuple(Column(name, unit, name, np.array(numbers)) for name, (unit, numbers) in data.items())
    ends = columns[2].bounds(np.array([0.0127, 0.0127]), np.array([0.0381, 0.0127]))
    table = Table("t", "T", (*columns, *ends))
    answers = Answers(replace(analyse_study(study).result, tables={"t": table}, values={}), ())
    told = study_content(study, answers)["tables"][0]
    assert [head["unit"] for head in told["columns"]] == ["h", "s", "in", ""]
    assert told["printed"] == [("0.5", "2", "1.00 (0.50 to 1.50)", "a"), ("10\u202f000", "30", "0.5", "b")]


def test_what_varied_in_inches():
    assert in_words({"size": ["25.4 mm", "12.7 mm"]}) == ["1 in, 0.5 in"]
    assert in_words({"size": linspace("2.54 mm", "50.8 mm", 20)}) == ["0.1 in … 2 in, 20 levels in equal steps"]
    assert in_words({"size": uniform("1 in", "2 in")}) == ["uniform, 1 in … 2 in"]
    assert in_words({"size": triangular("1 in", "1.5 in", "3 in")}) == ["triangular, 1 in … 3 in, peak at 1.5 in"]
    assert in_words({"size": normal("1 in", "0.01 in", "0.98 in")}) == ["normal, mean 1 in, standard deviation 0.01 in, within 0.98 in … ∞"]
    assert plain(varied(make_plan(with_variation(Toy(), {"size": ["1 mm"]})).variables[0], "inch")[2]) == "0.3937 in"


class Warm(Toy):
    """A toy with a temperature."""

    warmth: Temperature = Field("70 degC", description="temperature")


def test_the_standard_deviation_of_a_temperature_is_a_difference():
    vary = {"warmth": tolerance("9 degC")}
    assert in_words(vary, spec=Warm()) == ["normal, mean 70 °C, standard deviation 3 K, within 61 °C … 79 °C"]
    assert in_words(vary, spec=Warm(units="inch")) == ["normal, mean 158 °F, standard deviation 5.4 °F, within 141.8 °F … 174.2 °F"]


def test_what_contradicts_a_relation_is_told_in_inches():
    spec = with_variation(Toy(units="inch", offset="1 in"), {"size": ["10 mm"], "offset": linked("size + 1 in")})
    (remark,) = make_plan(spec).remarks
    assert remark.startswith("offset is 1\u00a0in in the spec, where size + 1 in gives 1.3937\u00a0in")


def test_units_are_no_difference_between_studies_and_do_not_vary(tmp_path):
    Toy().write(tmp_path / "spec.toml")
    assert differing_keys(tmp_path / "spec.toml", Toy(units="inch", title="Another"), True) == []
    assert differing_keys(tmp_path / "spec.toml", Toy(units="inch", size="11 mm"), True) != []


# -- searches ------------------------------------------------------------------------------------------------------------------

OPTIMISE = {
    "unknowns": [{"key": "size", "lower": "5.08 mm", "upper": "15.24 mm"}],
    "objectives": [{"value": "area", "goal": "minimise"}],
    "requirements": [{"value": "size", "at_least": "7.62 mm"}],
    "generations": 40,
    "population": 10,
}


def searched(**more):
    return dw.optimise(from_document({"mechanism": "toy", "units": "inch", "optimise": OPTIMISE | more}), on="serial")


def test_a_search_in_inches(capsys, tmp_path):
    found = searched()
    (objective,), (unknown,) = found.objective_rows(), found.unknown_rows()
    assert objective[1].endswith(" in²") and float(objective[1].split()[0]) == pytest.approx(0.09, rel=1e-3)
    assert unknown[1].endswith(" in") and unknown[2:] == ("0.2 in", "0.6 in")
    show.optimised(found)
    assert ">= 0.3 in" in capsys.readouterr().out
    page = html.unescape((write_optimised(found, tmp_path / "o") / "best" / "report.html").read_text(encoding="utf-8"))
    assert "0.3\u00a0in" in page and 'units = "inch"' in (tmp_path / "o" / "best.toml").read_text()


def test_what_is_to_blame_is_told_in_inches():
    found = searched(requirements=[{"value": "size", "at_least": "25.4 mm"}])
    assert "the limiting requirement is size >= 1 in: the least violating design reaches 0.6 in" in found.findings[0]


def test_long_times_and_their_ends_of_a_search():
    from drivewright.execution.outputs import Output
    from drivewright.studies.optimisation import _with_interval

    reached = {name: Output(value, "s", "", bounds) for name, value, bounds in (("life", 3.6e7, ""), ("life.low", 1.8e7, "life"))}
    reached["life.high"] = Output(5.4e7, "s", "", "life")
    assert _with_interval(reached, "life", "mm") == "10000 (5000 to 15000) h"
    assert _with_interval({"life": reached["life"]}, "life", "mm") == "10000 h"


# -- the terminal --------------------------------------------------------------------------------------------------------------


def told(*arguments):
    run = CliRunner().invoke(app, list(map(str, arguments)))
    assert run.exit_code == 0, run.output
    return run.output


def test_sweep_and_optimise_take_units(tmp_path):
    file = tmp_path / "toy.toml"
    Toy().replace(optimise=OPTIMISE).write(file)
    common = ("sweep", file, "--vary", "size=5.08 mm,10.16 mm", "--out", tmp_path / "s", "--on", "serial")
    assert "0.16 in²" in told(*common, "--units", "inch")
    assert "103.23 mm²" in told(*common)  # the same study, gone on with in other units
    assert ">= 0.3 in" in told("optimise", file, "--out", tmp_path / "o", "--on", "serial", "--units", "inch")
    assert ">= 7.62 mm" in told("optimise", file, "--out", tmp_path / "o", "--on", "serial")


def test_the_table_of_a_study_is_in_its_units_too(tmp_path):
    file = tmp_path / "toy.toml"
    Toy().write(file)
    told("sweep", file, "--vary", "size=25.4 mm", "--out", tmp_path / "s", "--on", "serial", "--units", "inch", "--no-figures")
    written = told("table", tmp_path / "s").strip().splitlines()[-1]
    assert "size [in]" in Path(written).read_text(encoding="utf-8-sig").splitlines()[0]


def test_reasons_that_differ_in_numbers_are_one_line(capsys):
    vary = {"size": ["-1 mm", "-2 mm", "5 mm"], "colour": ["red", "black"], "count": [2, 7, 13]}
    show.study(studied(vary))
    notes = [line for line in capsys.readouterr().err.splitlines() if re.match(r"note: \d+ x ", line)]
    assert len(notes) == 3 and all(len(note) < 700 for note in notes)
    counts = [int(note.split()[1]) for note in notes]
    assert counts == sorted(counts, reverse=True) and sum(counts) > 6
    assert any("-2" in note and "-1" in note and "(the first: " in note for note in notes)


def row_of(capsys, check, units="mm"):
    show.checks([check], units)
    (line,) = [line for line in capsys.readouterr().out.splitlines() if re.match(r"\s*(ok|FAILS)\s", line)]
    return re.split(r"\s{2,}", line.strip())[2:5]


def test_least_and_greatest_are_in_one_unit(capsys):
    study = studied({"size": ["1 mm", "2 mm"]})
    life = pa.array([1800.0, 3.6e7])
    spread = {"area.low": pa.array([900.0, 1.8e7]), "area.high": pa.array([2700.0, 5.4e7])}
    table = study.table
    for name, data in {"area": life, **spread}.items():
        about = {"unit": "s", "meaning": "life"} | ({"bounds": "area"} if name != "area" else {})
        field = pa.field(name, pa.float64(), metadata=about)
        place = table.column_names.index(name) if name in table.column_names else None
        table = table.append_column(field, data) if place is None else table.set_column(place, field, data)
    show.study(replace(study, rows=table))
    (row,) = [line for line in capsys.readouterr().out.splitlines() if line.strip().startswith("area ")]
    assert re.split(r"\s{2,}", row.strip())[1:3] == ["0.50 (0.25 to 0.75) h", "10000 (5000 to 15000) h"]


HOURS = 3600.0


def test_value_limit_and_margin_are_in_one_unit(capsys):
    life = Check("k", 51007 * HOURS, 10000 * HOURS, ">=", "s", "life")
    assert row_of(capsys, life) == ["51007 h", ">= 10000 h", "41007 h"]
    assert row_of(capsys, life._replace(value=0.5 * HOURS)) == ["0.5 h", ">= 10000 h", "-9999.5 h"]
    assert row_of(capsys, life._replace(value=np.inf)) == ["inf h", ">= 10000 h", "inf h"]
    assert row_of(capsys, Check("k", 5e6, 2e6, ">=", "rev", "life")) == ["5 million rev", ">= 2 million rev", "3 million rev"]
    assert row_of(capsys, Check("k", 343.15, 363.15, "<=", "K", "oil"), "inch") == ["158 °F", "<= 194 °F", "36 °F"]
    spread = life._replace(low=41007 * HOURS, high=61007 * HOURS)
    assert row_of(capsys, spread) == ["51000 (41000 to 61000) h", ">= 10000 h", "41000 h"]


@pytest.mark.parametrize("value", [0.3, 0.1 + 0.2, 0.3 - 1e-16, 0.3 * (1 - 1e-10)])
@pytest.mark.parametrize("sense", [">=", "<="])
def test_a_margin_that_is_rounding_is_none(capsys, value, sense):
    assert row_of(capsys, Check("k", value, 0.3, sense, "m", "wall")) == ["300 mm", f"{sense} 300 mm", "0 mm"]


def test_small_margins_and_margins_of_nothing(capsys):
    assert row_of(capsys, Check("k", 0.0, 0.0, "<=", "-", "wall")) == ["0", "<= 0", "0"]
    assert row_of(capsys, Check("k", 1e-12, 0.0, ">=", "m", "wall"))[2] == "1e-06 µm"
    assert row_of(capsys, Check("k", 5.0, np.inf, "<=", "-", "wall"))[2] == "inf"
    assert row_of(capsys, Check("k", 0.3 * (1 + 1e-8), 0.3, "<=", "m", "wall"))[2] == "-3e-06 mm"


def test_a_comparison_in_inches(capsys):
    show.comparison((Comparison("tip", 0.0254, 0.0508, "m", 1e-3, "by hand"),), "inch")
    words = capsys.readouterr().out
    assert "2 in" in words and "0.03937 in" in words and "mm" not in words


def test_verify_takes_the_units_of_the_spec(tmp_path, monkeypatch):
    row = Comparison("tip", 0.0254, 0.0254, "m", 1e-3, "by hand")
    monkeypatch.setattr(verification, "verify", lambda spec: (row,))
    Toy(units="inch").write(tmp_path / "toy.toml")
    assert "1 in" in told("verify", tmp_path / "toy.toml")


def test_json_of_the_answers_stays_in_si(tmp_path):
    study = studied(GRID)
    write_answers(study, analyse_study(study), tmp_path)
    assert json.loads((tmp_path / "answers.json").read_text())["values"]["least.value.size"]["value"] == pytest.approx(5.08e-3)
