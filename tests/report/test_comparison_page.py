"""The folder and the page of a comparison."""

import json
import re
from dataclasses import replace
from html.parser import HTMLParser
from xml.etree import ElementTree

import pytest

import drivewright as dw
from drivewright import registry, runner
from drivewright.errors import InputError
from drivewright.report import comparison_page
from drivewright.report.comparison_page import comparison_content, views_of, write_comparison
from drivewright.report.content import views

pytestmark = pytest.mark.interface

CHANGES = {"Plain": (), "Larger": ("follower.prime_radius=46 mm",), "<b>Fast</b>": ("drive.speed=900 rpm", "load.mass=2 kg")}


@pytest.fixture(scope="module")
def designs():
    """(comparison, views) of three cams."""
    preset = registry.mechanism("cam").presets()["default"]
    models = [(spec, runner.build(spec)) for spec in (dw.load(preset, changes) for changes in CHANGES.values())]
    results = [dw.run(spec, model=model) for spec, model in models]
    return dw.compare(results, tuple(CHANGES)), [views(result, model) for result, (_, model) in zip(results, models, strict=True)]


@pytest.fixture(scope="module")
def written(designs, tmp_path_factory):
    """The folder of the comparison."""
    return write_comparison(*designs, tmp_path_factory.mktemp("compare") / "out")


def cells(rows, key, name):
    return next(row["cells"] for row in rows if row[key] == name)


def text_of(page):
    found = []

    class Texts(HTMLParser):
        def handle_data(self, data):
            found.append(data)

    Texts().feed(re.sub(r"<(script|style)\b.*?</\1>", "", page, flags=re.DOTALL))
    return re.sub(r"\s+", " ", " ".join(found).replace("\u00a0", " "))


def test_the_folder_holds_page_record_and_figures(written, designs):
    assert {path.name for path in written.iterdir()} == {"index.html", "compare.json", "figures"}
    record = json.loads((written / "compare.json").read_text())
    assert set(record) == {"mechanism", "labels", "values", "units", "checks", "differing"} and record["mechanism"] == "cam"
    assert record["labels"] == list(CHANGES)
    assert record["differing"]["drive.speed"] == ["600 rpm", "600 rpm", "900 rpm"]
    assert record["checks"]["separation"] == [True, True, False] and set(record["checks"]) >= {"undercut", "cutter"}
    assert {name: tuple(row) for name, row in record["values"].items()} == designs[0].values
    names = {path.stem for path in (written / "figures").iterdir()}
    assert {"scene-machine", "plot-pressure_angle", "plot-motion", "drawing-cam"} <= names
    for path in (written / "figures").iterdir():
        assert "This figure is missing" not in path.read_text() and ElementTree.parse(path)


def test_the_page_says_everything_and_needs_nothing_else(written):
    page = (written / "index.html").read_text()
    text = text_of(page)
    for part in (
        "Comparison of 3 designs",
        "Plain",
        "<b>Fast</b>",
        "follower.prime_radius",
        "46 mm",
        "drive.speed",
        "Design checks",
        "All values",
    ):
        assert part in text or part in text.replace(" ", ""), part
    assert not re.search(r'(src|href)="(?!data:)', page) and "<b>Fast" not in page
    data = json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', page, re.DOTALL)[1])
    assert {body["label"] for body in data["scene"]["bodies"]} == set(CHANGES)


def test_values_checks_and_keys_stand_design_by_design(designs):
    comparison = designs[0]
    said = comparison_content(comparison)
    assert [design["label"] for design in said["designs"]] == list(CHANGES)
    first, larger, _ = cells(said["values"], "name", "max_pressure_angle")
    assert first["difference"] == "" and larger["difference"].startswith("−") and larger["difference"].endswith("\u00a0%)")
    assert cells(said["values"], "name", "lift")[1]["same"]
    fast = cells(said["values"], "name", "max_contact_force")[2]
    assert fast["difference"].startswith("+") and not fast["same"]
    assert [cell["text"] for cell in cells(said["keys"], "key", "drive.speed")] == ["600 rpm", "600 rpm", "900 rpm"]
    assert [row["key"] for row in said["keys"]] == ["follower.prime_radius", "drive.speed", "load.mass"]
    for row in said["checks"]:
        for cell, result in zip(row["cells"], comparison.results, strict=True):
            made = {check.name: "good" if check.ok else "bad" for check in result.checks}
            assert cell["state"] == made.get(row["name"], "none")
    failing = sum(not result.ok for result in comparison.results)
    assert said["verdict"] == {"state": "bad", "text": f"{failing} of 3 fail a check"} and failing == 1


def test_a_limit_stands_once_where_it_is_the_same_and_else_in_the_cells(designs):
    first = designs[0].results[0]
    checks = tuple(check._replace(limit=2 * check.limit) if check.name == "bore_wall" else check for check in first.checks)
    rows = {row["name"]: row for row in comparison_content(dw.compare([first, replace(first, checks=checks)]))["checks"]}
    assert rows["bore_wall"]["limit"] == "" and all(cell["limit"].startswith("≥ ") for cell in rows["bore_wall"]["cells"])
    assert rows["pressure_angle"]["limit"].startswith("≤ ") and {cell["limit"] for cell in rows["pressure_angle"]["cells"]} == {""}


def test_a_check_that_a_design_does_not_make_has_no_verdict(designs):
    results = designs[0].results
    fewer = dw.compare([results[0], dw.run(results[0].spec, only="forces")], ["All", "Few"])
    made = {check.name for check in fewer.results[1].checks}
    rows = comparison_content(fewer)["checks"]
    assert {row["name"] for row in rows if row["cells"][1]["state"] == "none"} == {row["name"] for row in rows} - made != set()


def test_a_design_beside_itself_shows_no_difference(designs):
    comparison = designs[0]
    said = comparison_content(dw.compare([comparison.results[0]] * 2))
    assert said["keys"] == [] and not any(row["differs"] for row in said["values"])
    assert {row["cells"][1]["difference"] for row in said["values"]} == {"0"}


def rows_of(page, part):
    """The texts of the cells of the table rows within the element of that id."""
    card = re.search(rf'<(section|details) class="card" id="{part}">(.*?)</\1>', page, re.DOTALL)[2]
    return [
        [text_of(cell).strip() for cell in re.findall(r"<t[dh][^>]*>.*?</t[dh]>", row, re.DOTALL)]
        for row in re.findall(r"<tr.*?</tr>", card, re.DOTALL)
    ]


@pytest.mark.parametrize("part", ["headline", "values"])
def test_the_difference_of_two_designs_has_a_column_and_the_page_says_to_which(designs, tmp_path, part):
    comparison, seen = designs
    page = (write_comparison(dw.compare(comparison.results[:2], ["A", "B"]), seen[:2], tmp_path / "out") / "index.html").read_text()
    head, *rows = rows_of(page, part)
    assert head == ["Quantity", "A", "B", "Difference"]
    named = {row[0]: row[1:] for row in rows}
    assert named["Stroke of the follower lift"] == ["20 mm", "20 mm", "0"]
    angle = next(row for name, row in named.items() if name.startswith("Maximum pressure angle"))
    assert angle[2].startswith("−") and angle[2].endswith(" %)") and "(" not in angle[1]
    assert "Differences are B less A" in text_of(page) and "Differences are to" not in text_of(page)


def test_the_differences_of_several_designs_stand_below_the_values(written):
    page = (written / "index.html").read_text()
    head, *rows = rows_of(page, "headline")
    assert head == ["Quantity", *CHANGES]
    assert any(re.search(r"N [+−].*%\)", row[3]) for row in rows)
    assert "differences to the first design, Plain" in text_of(page) and "are identical" not in text_of(page)


def test_the_page_says_which_designs_are_identical(designs, tmp_path):
    comparison, seen = designs
    same = dw.compare([comparison.results[n] for n in (0, 1, 0)], ["A", "B", "C"])
    page = write_comparison(same, [seen[n] for n in (0, 1, 0)], tmp_path / "out") / "index.html"
    assert "A and C are identical: their specs differ in no key." in text_of(page.read_text())


def test_checks_are_named_by_what_they_measure(designs):
    rows = {row["name"]: row["label"] for row in comparison_content(designs[0])["checks"]}
    assert rows["undercut"] == "Undercut, pitch/face radius" and rows["cutter"] == "Concave radius for the cutter"
    assert rows["bore_wall"] == "Wall between bore and profile"


def test_a_later_comparison_replaces_the_earlier_one_and_nothing_else(designs, tmp_path):
    comparison, seen = designs
    out = write_comparison(comparison, seen, tmp_path / "out")
    (out / "notes.txt").write_text("mine")
    (out / "figures" / "old.svg").write_text("<svg/>")
    two = dw.compare(comparison.results[:2], ["A", "B"])
    write_comparison(two, seen[:2], out)
    assert (out / "notes.txt").read_text() == "mine" and not (out / "figures" / "old.svg").exists()
    assert json.loads((out / "compare.json").read_text())["labels"] == ["A", "B"]
    assert [path.name for path in tmp_path.iterdir()] == ["out"]


def test_a_foreign_folder_is_refused_and_left_alone(designs, tmp_path):
    (tmp_path / "thesis.tex").write_text("important")
    with pytest.raises(InputError, match="is not empty and is no comparison.*thesis.tex"):
        write_comparison(*designs, tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["thesis.tex"]
    with pytest.raises(InputError, match="is a file"):
        write_comparison(*designs, tmp_path / "thesis.tex")


def test_a_page_that_fails_leaves_nothing_behind(designs, tmp_path, monkeypatch):
    def fail(*_):
        raise ZeroDivisionError

    monkeypatch.setattr(comparison_page, "comparison_content", fail)
    with pytest.raises(ZeroDivisionError):
        write_comparison(*designs, tmp_path / "out")
    assert list(tmp_path.iterdir()) == []


def test_a_figure_that_fails_costs_no_other(designs, monkeypatch):
    comparison, seen = designs

    def fail(*_):
        raise InputError("no outline")

    monkeypatch.setattr(comparison_page, "draw_overlaid", fail)
    shown = {picture.name: picture.svg for picture in views_of(comparison, seen).pictures}
    assert "This figure is missing" in shown["drawing-cam"] and "This figure is missing" not in shown["plot-motion"]


def test_designs_without_motion_are_a_remark(designs):
    comparison, seen = designs
    shown = views_of(comparison, [view._replace(scene=None, drawings=()) for view in seen])
    assert shown.scene is None and "fewer than two" in shown.remarks[0]
    assert not [picture for picture in shown.pictures if picture.name.startswith(("scene", "drawing"))]


def test_a_plot_without_a_common_quantity_is_a_remark(designs):
    comparison, seen = designs
    first, second, _ = comparison.results
    motion = second.tables["motion"]
    columns = tuple(column._replace(unit="rad") if column.name != "angle" else column for column in motion.columns)
    swinging = replace(second, tables={**second.tables, "motion": replace(motion, columns=columns)})
    shown = views_of(dw.compare([first, swinging]), seen[:2])
    assert "plot-motion" not in {picture.name for picture in shown.pictures}
    assert [remark for remark in shown.remarks if remark.startswith("plot 'motion' is not drawn")]


def test_warnings_of_a_design_are_in_the_verdict(designs):
    passing = replace(designs[0].results[0], checks=())
    warned = replace(passing, warnings=("the pins slip",))
    assert comparison_content(dw.compare([passing, passing]))["verdict"] == {"state": "good", "text": "no failed check"}
    assert comparison_content(dw.compare([passing, warned]))["verdict"] == {
        "state": "warn",
        "text": "no failed check, 1 of 2 with warnings",
    }
