"""Cards of results and studies in notebooks: they are whole, light, without scripts, and their colours follow the page."""

import re
from html.parser import HTMLParser

import pytest
from places import EXAMPLES

import drivewright as dw
from drivewright.notebook import result_card
from drivewright.view import cards
from drivewright.view.palette import ROLES

pytestmark = pytest.mark.interface

LARGEST = 200_000  # characters of a card
EMPTY = {"meta", "wbr", "br", "hr"}


class Balanced(HTMLParser):
    """Notes which elements are open, and which were closed that were not."""

    def __init__(self):
        super().__init__()
        self.open, self.wrong, self.tags = [], [], set()

    def handle_starttag(self, tag, attrs):
        self.tags.add(tag)
        if tag not in EMPTY:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.tags.add(tag)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.wrong.append(tag)


def tags_of(page):
    reader = Balanced()
    reader.feed(page)
    assert reader.open == [] and reader.wrong == []
    return reader.tags


@pytest.fixture(scope="module")
def cam():
    return dw.run(dw.load(EXAMPLES / "disc_cam.toml"))


def test_a_card_is_whole_and_light_and_runs_no_script(cam):
    page = result_card(cam)
    assert {"svg", "table", "details", "style"} <= tags_of(page) and "script" not in tags_of(page)
    assert len(page) < LARGEST and "http" not in re.sub(r'xmlns(:xlink)?="[^"]*"', "", page)


def test_a_card_shows_the_headline_numbers_with_labels_and_units(cam):
    page = result_card(cam)
    for text in (
        "Maximum pressure angle",
        "27.374°",
        "max_<wbr>pressure_<wbr>angle",
        "all 13 checks pass",
        "Disc cam with a spring-loaded",
    ):
        assert text in page


def test_a_study_has_a_card_with_its_plot_and_the_ends_of_its_values(cam):
    page = dw.sweep(cam.spec, {"follower.prime_radius": ["35 mm", "40 mm", "45 mm"]})._repr_html_()
    assert {"svg", "table"} <= tags_of(page) and len(page) < LARGEST
    for text in ("study of cam", "all 3 cases complete", "Least", "Greatest", "25.143°", "30.011°", "35\u00a0mm, 40\u00a0mm, 45\u00a0mm"):
        assert text in page


def test_a_picture_takes_the_colours_of_the_page_unless_they_are_data():
    picture = '<?xml version="1.0"?><svg xmlns="x"><metadata>m</metadata><path id="a" style="fill: #1b55bd"/><use href="#a" id="b"/></svg>'
    page = cards.figure(picture, 'a "b"', 300)
    assert "var(--blue,#1b55bd)" in page and "metadata" not in page and 'id="a"' in page and 'id="b"' not in page
    assert 'aria-label="a &quot;b&quot;"' in page and "var(" not in cards.figure(picture, "a", 300, follows_page=False)


def test_a_picture_that_is_too_large_is_left_out():
    assert cards.figure(f"<svg>{'<path/>' * cards.LARGEST_FIGURE}</svg>", "", 300) == ""


def test_the_style_has_both_themes_and_stays_within_the_card():
    style = cards.style_sheet()
    assert all(f"--{role}: {theme};" in style for role, pair in ROLES.items() for theme in pair)
    rules = re.findall(r"(?:^|\})\s*([^{}]+)\{", style)
    assert rules and all(cards.CARD in selector for rule in rules for selector in rule.split(","))


# -- pieces of a card ----------------------------------------------------------------------------------------------------------


def test_every_text_of_a_table_and_of_notes_is_escaped():
    page = cards.table([("<i>", "<b>")], ("<u>", "x"), "tc") + cards.notes(["<q>"]) + cards.folded("<s>", "block")
    assert re.findall(r"<(?:i|b|u|q|s)>", page) == []
    assert [text in page for text in ("&lt;i&gt;", "&lt;b&gt;", "&lt;u&gt;", "&lt;q&gt;", "&lt;s&gt;")] == [True] * 5


def test_numbers_stand_to_the_right_under_their_head_and_columns_without_a_kind_are_texts():
    page = cards.table([("a", "1.5", "x_y", "last")], ("A", "B", "C", "D"), "tnc")
    assert page.count('<th class="n">B</th>') == 1 and page.count('class="n"') == 2
    assert '<td class="n">1.5</td>' in page and "<td><code>x_<wbr>y</code></td><td>last</td>" in page and "<th>D</th>" in page


def test_signs_have_the_colours_of_their_meaning():
    page = cards.table([("✓", "it holds"), ("✗", "it does not")])
    assert '<td class="pass">✓</td><td>it holds</td>' in page and '<td class="fail">✗</td><td>it does not</td>' in page


def test_what_is_empty_leaves_no_trace():
    assert [cards.table([], ("A",)), cards.notes([]), cards.folded("All", ""), cards.beside("", "")] == [""] * 4
    assert cards.beside("", "x") == '<div class="side">x</div>'


def test_a_picture_brings_no_rules_for_the_page():
    page = cards.figure('<svg xmlns="x"><style type="text/css">*{stroke: red}</style><!-- note --><path/></svg>', "a", 300)
    assert "stroke: red" not in page and "note" not in page and "<path/>" in page and "width: 300px" in page


@pytest.mark.parametrize(("more", "is_drawn"), [(0, True), (1, False)])
def test_a_picture_is_drawn_up_to_the_largest_number_of_characters(more, is_drawn):
    frame = len(cards.figure("<svg></svg>", "a", 300)) - len('<figure style="width: 300px"></figure>')
    letters = "x" * (cards.LARGEST_FIGURE - frame + more)
    assert bool(cards.figure(f"<svg>{letters}</svg>", "a", 300)) is is_drawn


def test_a_page_that_is_not_dark_gets_the_light_colours():
    rules = dict(re.findall(r"(?:^|\})\s*([^{}]+?)\s*\{([^{}]*)", cards.style_sheet()))
    light, dark = ROLES["surface"]
    assert f"--surface: {light};" in rules[cards.RULE]
    (rule,) = (rule for selectors, rule in rules.items() if "vscode-dark" in selectors)
    assert f"--surface: {dark};" in rule and f"--surface: {light};" not in rule
