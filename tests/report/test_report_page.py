"""The report page as text: complete, self-contained, inert."""

import json
import re
from dataclasses import replace
from html.parser import HTMLParser
from types import SimpleNamespace

import numpy as np
import pytest
from sample_designs import PLOTS, SPEC_TEXT, all_views, four_bar_result

from drivewright import registry
from drivewright.errors import InputError
from drivewright.report.content import Picture, Views, content, headline, pictures, verdict, views
from drivewright.report.html import data_text, packed_views, scripts, write_report
from drivewright.result import Check, Value

pytestmark = pytest.mark.interface

NASTY = "</script><script>alert(1)</script><img src=x onerror=alert(2)> & \"quoted\" 'too' {{ 7*7 }} #strong[x]"
SEEN = all_views()


class Page(HTMLParser):
    """Tags with attributes, and the text outside scripts and styles."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.text, self.raw = [], "", None
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.tags.append((tag, dict(attributes)))
        self.raw = tag if tag in ("script", "style") else self.raw

    def handle_endtag(self, tag):
        self.raw = None if tag == self.raw else self.raw

    def handle_data(self, data):
        self.text += "" if self.raw else data


def written(tmp_path, result, seen=SEEN, drawn=()):
    text = write_report(result, seen, tmp_path, drawn).read_text(encoding="utf-8")
    return text, Page(text)


def test_everything_is_on_the_page(tmp_path):
    result = four_bar_result()
    _, page = written(tmp_path, result)
    text = re.sub(r"\s+", " ", page.text.replace("\u00a0", " "))
    for part in (
        "1 of 3 checks fails",
        "Angle swept by the rocker",
        "55.134",
        "512.3 MPa",
        "2.4669517247e-06 m",
        "limit ≥ 40°",
        "margin +4.994°",
        "margin −3.52",
        "The rocker is pushed at a good angle",
        "analysis 'forces' is left out: no [load] & no mass",
        "Norton, Design of Machinery (recalled)",
        "digest 5d41402abc4b",
        "flexibility",
        "1.5×10⁻⁸",
        "tables/motion.parquet",
        "python 3.11, numpy 2",
        "0.412",
    ):
        assert part in text, part
    assert SPEC_TEXT.strip().split("\n")[-1] in page.text


def test_failed_checks_come_first_and_say_so_without_colour(tmp_path):
    _, page = written(tmp_path, four_bar_result())
    lights = [a["aria-label"] for tag, a in page.tags if a.get("class") == "light"]
    assert lights == ["fails", "passes", "passes"]
    assert [a["data-parts"] for _, a in page.tags if "data-parts" in a] == ["rocker|frame", "rocker", ""]


def test_no_request_leaves_the_page(tmp_path):
    result = four_bar_result()
    text, page = written(tmp_path, result, drawn=pictures(result, Views(SEEN.scene, PLOTS[:1])))
    for tag, attributes in page.tags:
        for name in ("src", "href", "srcset", "action", "data"):
            assert attributes.get(name, "data:").startswith(("data:", "#")), (tag, name)
    assert not re.search(r"@import|url\(\s*['\"]?(?!#)", re.sub(r"data:image[^\"]*", "", text))
    policy = next(a["content"] for tag, a in page.tags if a.get("http-equiv") == "Content-Security-Policy")
    assert "default-src 'none'" in policy and "http" not in policy


def test_text_of_the_user_stays_text(tmp_path):
    result = four_bar_result(NASTY)
    check = Check("x", 1.0, 2.0, "<=", "m", NASTY, (NASTY,))
    result = replace(result, checks=(check,), findings=(NASTY,), provenance={**result.provenance, "sources": [NASTY], NASTY: NASTY})
    seen = Views(replace(SEEN.scene, cycle_label=NASTY, marks=((1.0, NASTY),)), SEEN.plots)
    text, page = written(tmp_path, result, seen, [Picture("x", NASTY, f"<svg title='{NASTY.replace(chr(39), '')}'/>")])
    assert [tag for tag, _ in page.tags].count("script") == 2
    assert not [a for tag, a in page.tags if "onerror" in a or a.get("src") == "x"]
    assert page.text.count(NASTY) >= 4 and "49" not in [a.get("title") for _, a in page.tags]
    data = json.loads(re.search(r'id="data">(.*?)</script>', text, re.DOTALL)[1])
    assert data["scene"]["cycle"]["label"] == NASTY


def test_the_data_holds_no_way_out_of_its_script_and_no_nan():
    data = data_text(packed_views(four_bar_result(), SEEN))
    assert "<" not in data and "NaN" not in data and "Infinity" not in data
    assert set(json.loads(data)) == {"scene", "plots"}
    assert packed_views(four_bar_result(), Views()) is None


def test_the_scripts_are_one_module_without_imports():
    assert not re.search(r"^\s*import\b|^export \{", scripts(), re.MULTILINE)
    assert "</script" not in scripts() and "export function createPlayer" in scripts() and "export function createPlots" in scripts()
    names = re.findall(r"^(?:export )?(?:const|let|function|class) (\w+)", scripts(), re.MULTILINE)
    assert len(names) == len(set(names))


def test_a_result_without_scene_checks_or_values_still_has_a_page(tmp_path):
    bare = replace(four_bar_result(), values={}, checks=(), tables={}, arrays={}, findings=())
    text, page = written(tmp_path, bare, Views())
    assert "no checks" in page.text and 'id="player"' not in text and "createPlayer" not in text


def test_a_report_with_player_stays_under_a_megabyte(tmp_path):
    result = four_bar_result()
    text, _ = written(tmp_path, result, drawn=pictures(result, SEEN))
    assert len(text.encode()) < 700_000


@pytest.mark.parametrize(
    ("passed", "outcome", "state", "words"),
    [
        ([True, False, True], "complete", "bad", "1 of 3 checks fails"),
        ([False, False], "partial", "bad", "2 of 2 checks fail"),
        ([True, True], "complete", "good", "all 2 checks pass"),
        ([True], "complete", "good", "1 check passes"),
        ([True], "partial", "warn", "partial result"),
        ([], "complete", "warn", "no checks"),
        ([], "partial", "warn", "partial result"),
    ],
)
def test_verdicts(passed, outcome, state, words):
    assert verdict(passed, outcome) == {"state": state, "text": words}


@pytest.mark.parametrize(
    ("passed", "outcome", "undecided", "warnings", "state", "words"),
    [
        ([True, True], "complete", 0, 1, "warn", "all 2 checks pass, 1 warning"),
        ([True], "complete", 0, 2, "warn", "1 check passes, 2 warnings"),
        ([True, False], "complete", 0, 1, "bad", "1 of 2 checks fails"),
        ([True], "partial", 0, 1, "warn", "partial result"),
        ([True, True], "complete", 1, 1, "warn", "1 of 2 checks undecided"),
    ],
)
def test_a_warning_takes_the_green_from_a_verdict(passed, outcome, undecided, warnings, state, words):
    assert verdict(passed, outcome, undecided, warnings) == {"state": state, "text": words}


def test_a_warning_is_marked_among_the_findings_and_in_the_verdict(tmp_path):
    found = four_bar_result()
    passing = tuple(check for check in found.checks if check.ok)
    warned = replace(found, checks=passing, findings=("pins slip", "all is told"), warnings=("pins slip",))
    text, page = written(tmp_path, warned, Views())
    assert re.search(r'<li class="warn"><b>Warning:</b> pins slip</li>', text) and "<li>all is told</li>" in text
    assert re.search(r'<span class="pill warn" id="verdict">[^<]*, 1 warning</span>', text)
    assert warned.record()["warnings"] == ["pins slip"] and repr(warned).endswith("all checks pass, 1 warning>")
    assert "⚠ pins slip" in warned._repr_html_() and "⚠ all is told" not in warned._repr_html_()


def test_a_check_without_a_value_fails():
    unknown = replace(four_bar_result(), checks=(Check("c", np.nan, 2.0, "<=", "m", ""),))
    assert content(unknown)["verdict"]["state"] == "bad" and content(unknown)["checks"][0]["value"] == "n/a"


def test_margins_and_limits_in_display_units():
    rows = content(four_bar_result())["checks"]
    assert [(r["label"], r["value"], r["limit"], r["margin"]) for r in rows][1] == ("Transmission", "44.994°", "≥ 40°", "+4.994°")
    assert (rows[2]["value"], rows[2]["margin"]) == ("∞", "")
    below = content(replace(four_bar_result(), checks=(Check("hub.wall_left", 0.0012, 0.002, ">=", "m", "thin"),)))["checks"][0]
    assert (below["label"], below["margin"], below["ok"]) == ("Hub · wall left", "−0.8\u00a0mm", False)


def registered(monkeypatch, **parts):
    kind = {"headline": (), "analyses": (), "plots": PLOTS, "scene": None, "drawings": None, "build": lambda spec: "model", **parts}
    monkeypatch.setattr(registry, "kinds", lambda: ["four-bar-sample"])
    monkeypatch.setattr(registry, "mechanism", lambda name: SimpleNamespace(**kind))


def test_the_headline_is_the_mechanisms_in_its_order_as_far_as_computed(monkeypatch):
    registered(monkeypatch, headline=("ratio", "not.computed", "rocker.swing"))
    assert [row["name"] for row in headline(four_bar_result())] == ["ratio", "rocker.swing"]


def test_a_zero_that_a_pattern_finds_is_no_key_number(monkeypatch):
    registered(monkeypatch, headline=("*.swing", "play"))
    still = Value(0.0, "rad", "angle")
    result = replace(four_bar_result(), values={"slider.swing": still, "play": still, "rocker.swing": Value(1.0, "rad", "angle")})
    assert [row["name"] for row in headline(result)] == ["rocker.swing", "play"]


def test_views_come_from_the_mechanism(monkeypatch):
    registered(monkeypatch, scene=lambda model: (model, "scene"), drawings=lambda model: [model])
    assert views(four_bar_result()) == Views(("model", "scene"), PLOTS, ("model",), ())


def test_a_design_that_cannot_be_drawn_keeps_its_report_and_says_why(monkeypatch, tmp_path):
    def refuse(model):
        raise InputError("the profile cuts itself at 31 deg")

    registered(monkeypatch, scene=refuse, drawings=refuse)
    seen = views(four_bar_result())
    assert seen.scene is None and seen.drawings == ()
    _, page = written(tmp_path, four_bar_result(), seen)
    assert "no motion to show: the profile cuts itself at 31 deg" in page.text


def test_an_unknown_kind_is_reported_without_pictures():
    assert views(four_bar_result()).remarks == ("mechanism 'four-bar-sample' is not installed here: neither motion nor drawings",)


def test_pictures_are_every_frame_plot_and_drawing():
    names = [picture.name for picture in pictures(four_bar_result(), SEEN)]
    plots = ["plot-rocker", "plot-speed", "plot-transmission", "plot-radius", "plot-track", "plot-links"]
    assert names == ["scene-machine", "scene-field", "scene-coupler", *plots, "drawing-cam"]
