"""Reports in another language: how texts are recognised, and that nothing of the frame is left in English."""

import math
import re
import tomllib
from dataclasses import replace

import pytest
from places import EXAMPLES, SOURCE

from drivewright.advice import Advice, Change
from drivewright.report.advice import failed_texts
from drivewright.report.content import content, pictures, views
from drivewright.report.form import ReportForm
from drivewright.report.html import player_texts, write_report
from drivewright.report.pdf import FRAME
from drivewright.report.words import Words, words_of
from drivewright.result import Check, Result

pytestmark = pytest.mark.interface

BOOK = Words(
    {
        "Stroke": "行程",
        "* of * checks fail": "*／* 项校核未通过",
        "* · *": "* · *",
        "* of *": "*／*",
        "force of *": "*的力",
        "cam": "凸轮",
        "rises": "上升",
        "runs: --only *": "计算：--only *",
    }
)


@pytest.mark.parametrize(
    ("english", "wanted"),
    [
        ("Stroke", "行程"),
        ("stroke", "行程"),
        ("Stroke [mm]", "行程 [mm]"),
        ("Stroke × 20", "行程 × 20"),
        ("Stroke −2.5 mm", "行程 −2.5 mm"),
        ("Way 12 mm", "Way 12 mm"),
        ("2 of 7 checks fail", "2／7 项校核未通过"),
        ("one of many", "one of many"),
        ("3 of 9", "3／9"),
        ("Force of cam", "凸轮的力"),
        ("Force of cam [N]", "凸轮的力 [N]"),
        ("Force of A [N]", "A的力 [N]"),
        ("Force of A", "A的力"),
        ("cam · stroke", "凸轮 · 行程"),
        ("stroke; rises", "行程；上升"),
        ("stroke; unheard of", "行程；unheard of"),
        ("unheard of; stroke", "unheard of; 行程"),
        ("runs: --only cam", "计算：--only cam"),
        ("Unheard of", "Unheard of"),
        ("", ""),
    ],
)
def test_texts_are_recognised(english, wanted):
    assert BOOK(english) == wanted


def test_english_stays_as_it_is_and_stars_are_filled():
    assert words_of("en")("Figure *", 3) == "Figure 3" and words_of("zh")("Figure *", 3) == "图 3"


def used_in_templates():
    """Texts that the templates of a report translate."""
    for name in ("report.html.j2", "layout.html.j2", "parts.html.j2"):
        yield from re.findall(r"""\bt\((["'])(.+?)\1""", (SOURCE / "report" / "templates" / name).read_text(encoding="utf-8"))


def test_all_words_of_the_frame_are_known():
    known = tomllib.loads((SOURCE / "report" / "zh.toml").read_text(encoding="utf-8"))["texts"]
    used = {text for _, text in used_in_templates()} | set(FRAME) | set(player_texts()) | {"fails", "undecided", "passes"}
    assert len(used) > 50 and sorted(used - known.keys()) == []


def test_the_paper_asks_for_no_other_words():
    text = (SOURCE / "report" / "templates" / "report.typ").read_text(encoding="utf-8")
    assert set(re.findall(r"""\bt\("([^"]+)\"""", text)) == set(FRAME)


def test_studio_and_report_say_the_same():
    studio, report = (tomllib.loads((SOURCE / room / "zh.toml").read_text(encoding="utf-8"))["texts"] for room in ("studio", "report"))
    assert {
        english: (studio[english], report[english]) for english in studio.keys() & report.keys() if studio[english] != report[english]
    } == {}


@pytest.fixture(scope="module")
def run():
    from drivewright import runner
    from drivewright.spec import load

    spec = load(EXAMPLES / "disc_cam.toml")
    model = runner.build(spec)
    result = runner.run(spec, model=model)
    return result, views(result, model)


def test_the_words_of_a_report_are_chinese(run, tmp_path):
    result, seen = run
    told = content(result, form=ReportForm("normal", "zh"))
    latin = re.compile(r"[A-Za-z]{3,}")
    for text in (told["title"], told["mechanism"], told["verdict"]["text"], *(row["label"] for row in told["checks"] + told["headline"])):
        assert not latin.search(text.replace("von Mises", "")), text
    drawn = pictures(result, seen, language="zh")
    page = write_report(result, seen, tmp_path, drawn, ReportForm("normal", "zh")).read_text(encoding="utf-8")
    assert '<html lang="zh-Hans">' in page and "图 1" in page and "设计校核" in page
    pressure = next(each for each in drawn if each.name == "plot-pressure_angle")
    assert "凸轮转角" in pressure.svg and "Cam angle" not in pressure.svg


def test_what_a_user_wrote_stays(run):
    from dataclasses import replace

    result, _ = run
    assert content(replace(result, title="Cam 7 · press"), form=ReportForm("normal", "zh"))["title"] == "Cam 7 · press"


def test_first_lines_name_what_fails_by_most_and_what_to_change():
    result = Result(
        spec=None,
        mechanism="none",
        title="t",
        digest="d",
        values={},
        tables={},
        findings=(),
        provenance={},
        checks=(
            Check("near", 0.99, 1.0, ">=", "-", "nearly there", label="Nearly there"),
            Check("half", 0.5, 1.0, ">=", "-", "half", label="Half"),
            Check("steep", math.radians(37.8), math.radians(30), "<=", "rad", "steep", label="Pressure angle"),
            Check("fine", 2.0, 1.0, ">=", "-", "fine", label="Fine"),
        ),
        advice=(Advice("half", (Change("cam.prime_radius", "m", 0.038, 0.042, "42 mm"),), 1.01, ("near",), ("fine",)),),
    )
    assert [text.replace("\u00a0", " ") for text in failed_texts(result)] == [
        "Half 0.5 (limit ≥ 1): prime radius 42 mm instead of 38 mm gives 1.01; 'Nearly there' passes too; but 'Fine' would fail.",
        "Pressure angle 37.8° (limit ≤ 30°).",
        "Also failing: 'Nearly there'.",
    ]
    assert failed_texts(replace(result, checks=result.checks[3:], advice=())) == []
