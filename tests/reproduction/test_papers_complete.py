"""The five papers as documents: complete, consistent with their rows, every equation drawable."""

import re

import numpy as np
import pytest

from drivewright import reproduction
from drivewright.errors import UnknownName
from drivewright.reproduction import document, indexer_paper, papers, pusher_paper, shaft_paper
from drivewright.reproduction.document import CORRECTED, DEFINITION, EQUATION_VERDICTS, Grid, read_paper
from drivewright.reproduction.figures import Curve
from drivewright.reproduction.formulas import formula_picture
from drivewright.validation import folding_linkage, shaft_model

pytestmark = pytest.mark.interface

PAPERS = papers()
EQUATIONS = {"shaft-paper": 21, "indexer-paper": 12, "hyvo-paper": 31, "folding-linkage": 11, "pusher-paper": 10}
LATE = {"shaft-paper": {"section 5.2"}}  # places of rows that take long
QUICK = ("shaft-paper", "indexer-paper", "pusher-paper")  # whose rows take seconds


def numbers_in(text):
    """Whole numbers of '(18), (19)' or '(6), (7)'; none of 'below (4)'."""
    return [] if text.startswith("below") else [int(each) for each in re.findall(r"\d+", text)]


def test_names_are_those_of_validate_in_the_papers_order():
    assert reproduction.NAMES == ("shaft-paper", "indexer-paper", "hyvo-paper", "folding-linkage", "pusher-paper")
    assert tuple(paper.name for paper in PAPERS) == reproduction.NAMES
    assert [paper.name for paper in papers("hyvo-paper")] == ["hyvo-paper"]
    with pytest.raises(UnknownName, match="no paper is called 'hyvo'"):
        papers("hyvo")


@pytest.mark.parametrize("paper", PAPERS, ids=lambda paper: paper.name)
def test_every_equation_of_the_paper_has_a_verdict(paper):
    equations = [equation for section in paper.sections for equation in section.equations]
    found = [number for equation in equations for number in numbers_in(equation.number)]
    assert sorted(found) == list(range(1, EQUATIONS[paper.name] + 1))
    for equation in equations:
        assert equation.verdict in EQUATION_VERDICTS
        assert bool(equation.right) == (equation.verdict in (CORRECTED, document.UNDECIDED)) or equation.verdict == document.UNDECIDED
        assert equation.remark or equation.verdict not in (CORRECTED, document.UNDECIDED), equation.number
        assert not (equation.verdict == DEFINITION and equation.right)


@pytest.mark.parametrize("paper", PAPERS, ids=lambda paper: paper.name)
def test_every_equation_is_drawn_as_outlines(paper):
    for section in paper.sections:
        for equation in section.equations:
            for lines in filter(None, (equation.printed, equation.right)):
                picture = formula_picture(lines)
                assert "<path" in picture and "<text" not in picture


@pytest.mark.parametrize("paper", PAPERS, ids=lambda paper: paper.name)
def test_figures_sections_and_inputs_are_told_apart(paper):
    names = [figure.number for figure in paper.figures]
    assert len(set(names)) == len(names) and all(figure.caption.endswith(".") for figure in paper.figures)
    places = [place for section in paper.sections for place in section.places]
    assert len(set(places)) == len(places)
    assert {True, False} == {each.printed for each in paper.inputs}
    assert all(section.claims for section in paper.sections)


@pytest.mark.parametrize("name", QUICK)
def test_every_row_has_its_section_and_every_place_its_rows(name):
    paper = papers(name)[0]
    wheres = {row.where for row in paper.source.rows()}
    assert set(wheres) - {place for section in paper.sections for place in section.places} == set()
    assert {place for section in paper.sections for place in section.places} == wheres | LATE.get(name, set())


def test_cells_of_a_grid_are_rows_of_the_paper(monkeypatch):
    monkeypatch.setattr(folding_linkage, "load_coefficients", lambda points: [1.0] * len(points))
    paper = papers("folding-linkage")[0]
    grids = [grid for section in paper.sections for grid in section.grids]
    assert [len(grid.rows) * len(grid.columns) for grid in grids] == [11, 55, 55, 55]
    names = {name for grid in grids if "dry" not in grid.title for _, cells in grid.rows for name in cells}
    assert names <= {row.name for row in paper.source.rows()}


def test_text_and_figures_must_name_the_same_figures():
    source = papers("shaft-paper")[0].source
    with pytest.raises(ValueError, match="disagree about.*no section"):
        read_paper(source, {figure.number: figure.draw for figure in PAPERS[0].figures}, grids={"no section": (Grid("", "", (), ()),)})
    with pytest.raises(KeyError, match=r"Fig\. 5"):
        read_paper(source, {})


def test_a_formula_stands_in_the_middle_of_its_line():
    """The foot of a letter without depth lies below the middle by half its height, of which x has less than half a line."""
    picture = formula_picture(["x"])
    height = float(re.search(r'viewBox="0 0 [\d.]+ ([\d.]+)"', picture)[1])
    foot = float(re.search(r"translate\(0 ([\d.]+)\) scale", picture)[1])
    assert height / 2 < foot < 0.75 * height


@pytest.mark.parametrize("length", ["l1", "l3", "l5", "l7"])
@pytest.mark.parametrize("stiffness", [3.0e7, np.inf])
def test_a_moved_mass_at_its_printed_length_is_that_of_the_shaft_itself(length, stiffness):
    """The closed form of the figure over lengths against the beam of the preset, at the one length that both have."""
    moved = shaft_paper.MOVED[length]
    found = shaft_paper.own_flexibility(moved, np.array([moved.printed]), stiffness)
    assert found[0] == pytest.approx(shaft_model.own_flexibility(moved.mass, stiffness), rel=1e-6)


def test_the_largest_angle_of_a_cam_is_that_of_the_phase_in_which_it_drives():
    curve = Curve("main cam", np.array([60.0, 70.0, 80.0, 90.0]), np.array([50.0, 20.0, 42.0, 60.0]))
    found = pusher_paper._largest_while_driving(curve, (65.0, 86.0))
    assert (found.x[0], found.y[0], found.label) == (80.0, 42.0, "main cam while it drives: 42.00°")


def test_stiffness_after_play_is_shown_apart(monkeypatch):
    """The band is a line where the cams hold the wheel at once, points where it turns freely first, and nothing in between."""
    angle = indexer_paper.degrees(indexer_paper.result().tables["stiffness"])
    monkeypatch.setattr(indexer_paper, "clearance_band", lambda: (angle, np.tile(1.0 + angle, (3, 1))))
    axis = indexer_paper.clearances().axes[0]
    drawn = {line.get_label(): np.isfinite(np.asarray(line.get_ydata(), float)) for line in axis.get_lines()}
    band, free = (drawn[name] for name in ("with clearances, median and 5 to 95 %", "the same where the wheel turns freely first"))
    assert not np.any(band & free) and angle[free].max() < 36.0 <= angle[band].min() and angle[free].min() == 4.5
