"""What stands on the cards of results and studies: which checks, values and notes, in which table and order."""

from html.parser import HTMLParser

import pytest
from study_toy import Toy, install

import drivewright as dw
from drivewright.notebook import MOST_NOTES, MOST_VALUES, NARROW, WIDE, result_card
from drivewright.result import Check, Result, Value
from drivewright.studies import with_variation

pytestmark = pytest.mark.interface


class Reader(HTMLParser):
    """Rows of tables and items of lists, each under the summary of the fold in which they stand, "" outside."""

    def __init__(self):
        super().__init__()
        self.fold, self.text, self.rows, self.items = "", "", {}, {}

    def handle_starttag(self, tag, attrs):
        if tag == "tr":
            self.rows.setdefault(self.fold, []).append([])
        if tag != "wbr":
            self.text = ""

    def handle_data(self, data):
        self.text += data.replace("\u00a0", " ")

    def handle_endtag(self, tag):
        if tag == "summary":
            self.fold = self.text
        elif tag == "details":
            self.fold = ""
        elif tag == "td":
            self.rows[self.fold][-1].append(self.text)
        elif tag == "li":
            self.items.setdefault(self.fold, []).append(self.text)
        elif tag == "code":
            return
        self.text = self.text if tag == "code" else ""


def read(page):
    """(rows by fold, items by fold), heads left out."""
    reader = Reader()
    reader.feed(page)
    return {fold: [row for row in rows if row] for fold, rows in reader.rows.items()}, reader.items


def card(**given):
    """Rows and items of the card of a result of no known kind."""
    base = {"spec": None, "mechanism": "none", "title": "t", "digest": "d", "values": {}, "tables": {}, "checks": (), "findings": ()}
    return read(result_card(Result(**{**base, "provenance": {}, **given})))


def test_checks_that_fail_or_are_undecided_stand_in_front_with_what_to_do():
    checks = (
        Check("good", 1.0, 2.0, "<=", "m", "height that is good"),
        Check("bad", 3.0, 2.0, "<=", "m", "height that is bad"),
        Check("open", 1.9, 2.0, "<=", "m", "height that is open", low=1.5, high=2.3),
    )
    rows, _ = card(checks=checks)
    assert [(row[0], row[1]) for row in rows[""]] == [("✗", "Bad"), ("✓", "Open")]
    every = {row[1]: row for row in rows["All checks (3)"]}
    assert {name: row[0] for name, row in every.items()} == {"Good": "✓", "Bad": "✗", "Open": "✓"}
    assert every["Good"][-1] == "" and every["Bad"][-1] == "Height that is bad" and "interval" in every["Open"][-1]


@pytest.mark.parametrize("more", [0, 5])
def test_of_many_values_the_first_are_shown_and_the_others_counted(more):
    values = {f"v{n}": Value(float(n), "-", f"value {n}") for n in range(MOST_VALUES + more)}
    rows, items = card(values=values)
    fold = f"All values ({MOST_VALUES + more})"
    assert len(rows[fold]) == MOST_VALUES and rows[fold][2] == ["Value 2", "2", "v2"]
    assert items.get(fold, []) == ([f"{more} more values: see `values` of the result"] if more else [])


@pytest.mark.parametrize("more", [0, 3])
def test_notes_are_the_findings_that_are_no_warnings_the_first_of_them(more):
    findings = ("warned", *(f"note {n}" for n in range(MOST_NOTES + more)))
    _, items = card(findings=findings, warnings=("warned",))
    assert items[""] == ["⚠ warned"]
    notes = items[f"Notes ({MOST_NOTES + more})"]
    assert notes[:MOST_NOTES] == list(findings[1 : MOST_NOTES + 1]) and notes[MOST_NOTES:] == ([f"{more} more"] if more else [])


def test_a_drive_shows_its_scene_and_no_plot():
    page = result_card(dw.run(dw.load(next(iter(dw.registry.mechanism("cam").presets().values()))), only=["motion"]))
    assert f"width: {NARROW}px" in page and f"width: {WIDE}px" not in page and page.count("<figure") == 1


@pytest.fixture
def study(monkeypatch, tmp_path):
    """Squares of 0.02 mm to 13 mm; the black ones fail."""
    install(monkeypatch.setattr)
    spec = with_variation(Toy(), {"size": ["0.02 mm", "9 mm", "13 mm"], "colour": ["red", "black"]})
    return dw.sweep(spec, out=tmp_path / "S", on="serial")


def test_a_study_shows_the_ends_of_its_values_and_why_cases_failed(study):
    rows, items = read(study._repr_html_())
    table = {row[-1]: row for row in rows[""]}
    assert table["area"] == ["Size squared", "4×10⁻⁴ mm²", "169 mm²", "area"]
    assert any(text.startswith("3 × failed: ") and "black cannot be seen" in text for text in items[""])
    assert items[""][-1].startswith("folder: ") and items[""][-1].endswith("S")


def test_both_ends_of_a_value_have_the_unit_of_the_larger_one(monkeypatch):
    """0.02 mm alone would be 20 µm, as in the list of levels."""
    install(monkeypatch.setattr)
    rows, _ = read(dw.sweep(with_variation(Toy(), {"size": ["0.02 mm", "9 mm"]}, values=["size"]), on="serial")._repr_html_())
    (ends,) = (row[1:3] for row in rows[""] if row[-1] == "value.size")
    assert ends == ["0.02 mm", "9 mm"]


def test_the_plot_of_a_study_follows_the_page(study):
    page = study._repr_html_()
    assert f"width: {WIDE}px" in page and "var(--blue,#" in page


def test_a_study_without_a_folder_says_so(monkeypatch):
    install(monkeypatch.setattr)
    _, items = read(dw.sweep(with_variation(Toy(), {"size": ["8 mm", "9 mm"]}), on="serial")._repr_html_())
    assert items[""][-1] == "in memory"
