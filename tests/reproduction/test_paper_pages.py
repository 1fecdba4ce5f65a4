"""Parts that are kept and go on, and the page, its PDF and rows.json made of them."""

import json
from dataclasses import replace

import pytest

from drivewright import reproduction, validation
from drivewright.errors import InputError, MissingExtra
from drivewright.report.content import Picture
from drivewright.reproduction import page as pages
from drivewright.reproduction import parts
from drivewright.reproduction.document import Equation, Figure, Grid, Input, LongRows, Paper, PaperStudy, Section
from drivewright.validation import AGREES, CALIBRATED, EXPLAINED, NOT_COMPARED, OPEN, PRINT_ONLY, Explanation, Row, Source, rounded

pytestmark = pytest.mark.interface

KEYS = ["source", "where", "quantity", "printed", "ours", "low", "high", "unit", "basis", "verdict"]
SVG = '<svg xmlns="http://www.w3.org/2000/svg" width="40" height="20" viewBox="0 0 40 20"><rect width="40" height="20"/></svg>'


def row(name, ours, pinned, printed="10 mm", **more):
    return Row(name, rounded(printed, "m"), ours, "m", pinned, "published table", "table 1", **more)


ROWS = (
    row("right", 0.01, AGREES),
    row("other reading of right", 0.02, OPEN, reading_of="right"),
    row("misread", 0.02, EXPLAINED, explanation=Explanation("Twice.", 0.01), note="So it is."),
    row("open one", 0.03, OPEN, low=0.025, high=0.035),
    row("chosen <b>one</b>", 0.01, NOT_COMPARED, basis=CALIBRATED),
    row("counted", None, NOT_COMPARED, basis=PRINT_ONLY),
)


class Bench:
    """A paper of two figures, a study and long rows that counts what it computes."""

    def __init__(self, fail=()):
        self.computed, self.fail = [], set(fail)
        source = Source("shaft-paper", "Somebody: A paper.", self.rows, ("A fault.",))
        grid = Grid("Table 1", "row", ("a", "b"), (("first", ("right", "misread")), ("second", ("", "open one"))))
        section = Section(
            "1 All",
            ("It claims.",),
            ("table 1",),
            (Equation("(1)", (r"a=\frac{b}{c}",), "corrected", "Upside down.", (r"a=\frac{c}{b}",)),),
            (self.figure("Fig. 1"), self.figure("Fig. 2", True)),
            (grid,),
            ("Fig. 3 is a photograph.",),
        )
        inputs = (Input("length", "10 mm", True), Input("width", "5 mm", False, "not printed"))
        self.paper = Paper(
            source, "A paper", "About it.", inputs, (section,), (LongRows("long", self.long),), (PaperStudy("map", self.study),)
        )

    def figure(self, number, solids=False):
        return Figure(number, f"Title of {number}", lambda folder: self.note(number) or Picture("x", "x", SVG), "What it shows.", solids)

    def note(self, name):
        self.computed.append(name)
        if name in self.fail:
            raise MissingExtra(name, "fe", ImportError("none"))

    def rows(self):
        self.note("source")
        return ROWS

    def long(self, folder):
        self.note("long")
        assert (folder / "studies" / "map").is_file()
        return [row("late", 0.01, AGREES)]

    def study(self, folder, progress):
        self.note("map")
        (folder / "studies").mkdir(exist_ok=True)
        (folder / "studies" / "map").write_text("done", encoding="utf-8")
        progress(1, 1, "")


@pytest.fixture
def bench(monkeypatch):
    return make(monkeypatch)


def make(monkeypatch, **more):
    bench = Bench(**more)
    monkeypatch.setattr(reproduction, "papers", lambda name=None: (bench.paper,))

    def one_after_another(function, calls, groups=(), begun=lambda index: None):
        for index, arguments in enumerate(calls):
            begun(index)
            yield index, function(*arguments)

    monkeypatch.setattr(parts, "side_by_side", one_after_another)
    return bench


def test_a_page_with_everything_on_it(bench, tmp_path):
    said = []
    page, computed = pages.reproduce(bench.paper, tmp_path / "out", progress=lambda done, total, what: said.append((done, total, what)))
    text = page.read_text(encoding="utf-8")
    assert page == tmp_path / "out" / "index.html" and computed.missing == {}
    for words in (
        "A paper",
        "It claims.",
        "Upside down.",
        "Fig. 3 is a photograph.",
        "A fault.",
        "not printed",
        "What it shows.",
        "So it is.",
    ):
        assert words in text
    assert "Chosen &lt;b&gt;one&lt;/b&gt;" in text and "<b>one</b>" not in text
    assert 'src="http' not in text and 'href="http' not in text
    assert said[-1][:2] == (5, 5)
    assert bench.computed == ["map", "source", "long", "Fig. 1", "Fig. 2"]
    assert {path.name for path in (tmp_path / "out").iterdir()} >= {"index.html", "rows.json", "figures", "parts", "studies"}
    assert {path.name for path in (tmp_path / "out" / "figures").iterdir()} == {"figure-fig-1.svg", "figure-fig-2.svg"}


def test_the_folder_of_another_paper_is_refused_and_left_as_it_is(bench, tmp_path):
    pages.reproduce(bench.paper, tmp_path)
    before = {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()}
    with pytest.raises(InputError, match="holds the page of shaft-paper; give hyvo-paper another --out. Nothing was written"):
        pages.reproduce(replace(bench.paper, source=replace(bench.paper.source, name="hyvo-paper")), tmp_path)
    assert {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()} == before
    pages.reproduce(bench.paper, tmp_path)


def test_rows_json_is_the_contract(bench, tmp_path):
    pages.reproduce(bench.paper, tmp_path)
    rows = json.loads((tmp_path / "rows.json").read_text(encoding="utf-8"))
    assert [list(each) for each in rows] == [KEYS] * 7
    assert rows[0] == dict(
        zip(KEYS, ("shaft-paper", "table 1", "right", "10 mm", 0.01, 0.01, 0.01, "m", "computed", "agrees"), strict=True)
    )
    assert (rows[3]["low"], rows[3]["high"], rows[3]["verdict"]) == (0.025, 0.035, "differs, open")
    assert (rows[4]["basis"], rows[4]["verdict"]) == ("calibrated", "not compared")
    assert (rows[5]["ours"], rows[5]["low"], rows[5]["basis"]) == (None, None, "print-only")


def test_the_verdict_counts_printed_numbers_by_their_best_reading(bench, tmp_path):
    _, computed = pages.reproduce(bench.paper, tmp_path)
    assert validation.counts(computed.rows) == {AGREES: 2, EXPLAINED: 1, OPEN: 1, NOT_COMPARED: 2}
    assert pages.verdict(computed.rows) == {"state": "warn", "text": "2 of 4 compared numbers and claims agree"}
    text = (tmp_path / "index.html").read_text(encoding="utf-8")
    assert "prints 6 numbers and claims, of which 4 can be compared" in text and "below have 7 rows" in text
    assert "evaluated for its inputs" not in text, "none is"


def test_formulas_evaluated_are_counted_apart(bench):
    formula = Row("formula", validation.evaluated("10 mm", "m"), 0.01, "m", AGREES, "closed form", "eq. (1)")
    assert pages.verdict((*ROWS, formula)) == pages.verdict(ROWS)
    expected = Row("ratio", validation.implied("below 1", 0.0, 1.0), 0.5, "-", AGREES, "closed form", "section 2")
    assert "evaluated for its inputs: 1 agrees." in pages.readings((*ROWS, formula)) and "implies" not in pages.readings((*ROWS, formula))
    assert "implies and does not say: 1 agrees." in pages.readings((*ROWS, expected))


def test_remarks_are_numbered_in_the_order_in_which_the_page_points_to_them(bench, tmp_path):
    _, computed = pages.reproduce(bench.paper, tmp_path)
    texts = pages.content(bench.paper, computed)
    section = texts["sections"][0]
    order = [*section["grids"][0]["remarks"], *(each["remark"] for each in section["rows"] if each["remark"])]
    assert order[0] == "1" and sorted(set(order), key=int) == list(dict.fromkeys(order))
    assert len(texts["footnotes"]) == len(set(order)) and texts["footnotes"][0] == "Twice. So it is."


@pytest.mark.parametrize(
    ("verdict", "count", "words"),
    [
        (AGREES, 1, "agrees"),
        (AGREES, 2, "agree"),
        (OPEN, 0, "differ, open"),
        (NOT_COMPARED, 3, "not compared"),
        ("definition", 2, "definitions"),
    ],
)
def test_verdicts_in_number(verdict, count, words):
    assert pages.in_number(verdict, count) == words


def test_what_is_missing_is_said_once_for_each_reason(bench, tmp_path):
    _, computed = pages.reproduce(bench.paper, tmp_path, solids=False)
    missing = {"Fig. 2": "left out by --no-solids", "long": "left out by --no-solids", "map": "no memory"}
    lines = pages.missing_parts(bench.paper, replace(computed, missing=missing))
    assert lines == ["Left out by --no-solids: Fig. 2, numbers that need solid models.", "No memory: numbers that need solid models."]


def is_finished(paper, out, solids=True):
    """Whether every part of a page is there."""
    return all(parts.read_part(out / "parts" / part.file) is not None for part in parts.parts_of(paper) if solids or not part.solids)


def test_what_is_there_is_not_computed_again(bench, tmp_path):
    pages.reproduce(bench.paper, tmp_path)
    assert is_finished(bench.paper, tmp_path)
    bench.computed.clear()
    (tmp_path / "parts" / "figure-fig-1.json").write_text("{half", encoding="utf-8")
    assert not is_finished(bench.paper, tmp_path)
    _, computed = pages.reproduce(bench.paper, tmp_path)
    assert bench.computed == ["Fig. 1"] and set(computed.pictures) == {"Fig. 1", "Fig. 2"} and len(computed.rows) == 7


def test_other_sources_compute_anew(bench, tmp_path, monkeypatch):
    pages.reproduce(bench.paper, tmp_path)
    bench.computed.clear()
    monkeypatch.setattr(parts, "sources_digest", lambda: "another")
    pages.reproduce(bench.paper, tmp_path)
    assert len(bench.computed) == 5


def test_parts_made_by_another_version_are_counted(bench, tmp_path, monkeypatch):
    assert pages.reproduce(bench.paper, tmp_path)[1].renewed == 0
    monkeypatch.setattr(parts, "sources_digest", lambda: "another")
    assert pages.reproduce(bench.paper, tmp_path)[1].renewed == 5
    assert pages.reproduce(bench.paper, tmp_path)[1].renewed == 0


def test_a_page_that_was_stopped_goes_on(bench, tmp_path):
    def stop(done, total, what):
        if done == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        pages.reproduce(bench.paper, tmp_path, progress=stop)
    before = list(bench.computed)
    assert not (tmp_path / "index.html").exists() and "source" in before
    bench.computed.clear()
    pages.reproduce(bench.paper, tmp_path)
    assert not set(before) & set(bench.computed) and (tmp_path / "index.html").exists()


def test_without_solids_a_figure_is_left_out_and_said_so(bench, tmp_path):
    _, computed = pages.reproduce(bench.paper, tmp_path, solids=False)
    assert "Fig. 2" not in bench.computed and computed.left_out == {"Fig. 2"}
    assert "left out by --no-solids" in (tmp_path / "index.html").read_text(encoding="utf-8")
    assert is_finished(bench.paper, tmp_path, solids=False) and not is_finished(bench.paper, tmp_path)


def test_a_missing_extra_costs_its_figure_alone(monkeypatch, tmp_path):
    bench = make(monkeypatch, fail=["Fig. 1"])
    _, computed = pages.reproduce(bench.paper, tmp_path)
    assert set(computed.missing) == {"Fig. 1"} and "extra" in computed.missing["Fig. 1"] and not computed.left_out
    assert set(computed.pictures) == {"Fig. 2"}


def test_a_folder_of_others_is_refused(bench, tmp_path):
    (tmp_path / "mine.txt").write_text("x", encoding="utf-8")
    with pytest.raises(InputError, match="is no reproduced paper"):
        pages.reproduce(bench.paper, tmp_path)
    with pytest.raises(InputError, match="is a file"):
        pages.reproduce(bench.paper, tmp_path / "mine.txt")
    assert [path.name for path in tmp_path.iterdir()] == ["mine.txt"] and not bench.computed


def test_the_overview_counts_each_paper(bench, tmp_path):
    _, computed = pages.reproduce(bench.paper, tmp_path / "shaft-paper")
    page = pages.write_overview((bench.paper,), {"shaft-paper": computed}, tmp_path)
    text = page.read_text(encoding="utf-8")
    assert 'href="shaft-paper/index.html"' in text and "6 printed numbers" in text
    assert len(json.loads((tmp_path / "rows.json").read_text(encoding="utf-8"))) == 7


def test_a_row_survives_its_file():
    for each in ROWS:
        record = json.loads(json.dumps(parts.asdict(each)))
        assert parts.row_of(record) == each


@pytest.mark.parametrize(
    ("printed", "shown"),
    [("89.7739 um/kN", "89.7739 µm/kN"), ("-40.793 um/kN", "−40.793 µm/kN"), ("4.560e11 min", "4.560×10¹¹ min"), ("86 deg", "86°")]
    + [("alpha0 = 35 deg, in mm^2", "α0 = 35°, in mm²"), ("delta_p2 < delta12", "δp2 < δ12"), (">= 1, 162 << 835", "≥ 1, 162 ≪ 835")]
    + [("x = -3 of group-3", "x = −3 of group-3"), ("urad/N and um", "µrad/N and µm"), ("the volume, 78-82", "the volume, 78-82")],
)
def test_printed_numbers_have_the_signs_of_print(printed, shown):
    assert pages.pretty(printed) == shown


def test_ours_has_the_digits_of_a_near_print():
    near = Row("k", rounded("11.464849", "-"), 11.46484882912, "-", AGREES, "closed form", "here")
    assert pages.ours_texts(near) == ("11.464849", "")
    assert pages.ours_texts(replace(near, ours=12.3456789)) == ("12.346", "")
    assert pages.ours_texts(replace(near, low=11.0, high=12.0)) == ("11.46", "11.00 to 12.00")
    assert pages.ours_texts(replace(near, ours=None)) == ("–", "")
    life = Row("life", rounded("4.560e11 min", "s"), 4.5e11 * 60, "s", OPEN, "other code", "here")
    assert pages.ours_texts(life) == ("4.5×10¹¹\u00a0min", "")
    assert pages.deviation_text(near) == "0" and pages.deviation_text(replace(near, ours=12.0)) == "+0.535"
    assert pages.deviation_text(replace(near, basis=CALIBRATED)) == ""
    cut_off = Row("pitch", rounded("9.563499 mm", "m"), 9.5635e-3, "m", OPEN, "closed form", "here")
    assert pages.deviation_text(cut_off).startswith("+1×10⁻⁶"), "a difference that makes the verdict is shown"


def test_the_pdf_has_every_picture(bench, tmp_path):
    pytest.importorskip("typst")
    pages.reproduce(bench.paper, tmp_path)
    assert (tmp_path / "paper.pdf").read_bytes().startswith(b"%PDF")


@pytest.mark.slow
@pytest.mark.parametrize("name", reproduction.NAMES)
def test_the_real_pages_without_solids(name, tmp_path):
    paper = reproduction.papers(name)[0]
    _, computed = pages.reproduce(paper, tmp_path, solids=False)
    assert set(computed.missing) == set(computed.left_out)
    rows = json.loads((tmp_path / "rows.json").read_text(encoding="utf-8"))
    assert all(each["basis"] == "computed" for each in rows if each["verdict"] == "agrees")
    assert {each["verdict"] for each in rows} <= set(validation.VERDICTS)
    assert {row.where for row in computed.rows} <= {place for section in paper.sections for place in section.places}
