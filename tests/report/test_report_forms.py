"""Short, normal and full reports, the order and numbers of their figures, and what a letterhead may bring along."""

import re
import struct
import zlib
from dataclasses import replace
from types import SimpleNamespace

import pytest
from sample_designs import all_views, four_bar_result

from drivewright.errors import InputError, UnknownName
from drivewright.report.content import Views, content, pictures
from drivewright.report.form import ReportForm, report_form
from drivewright.report.html import write_report
from drivewright.report.letterhead import LARGEST_LOGO, LARGEST_TEMPLATE, read_letterhead
from drivewright.report.numbering import (
    BEARS_NAME,
    DRAWS_LIMIT,
    UNRELATED,
    NumberedFigure,
    failed_first,
    in_order,
    numbered_figures,
    relation,
    seen_in,
    with_figures,
)
from drivewright.report.pdf import HALF_WIDTH, figure_rows, write_pdf
from drivewright.report.value_groups import OTHERS, grouped_values
from drivewright.result import Check, Plot

pytestmark = pytest.mark.interface

SEEN = all_views()
SHORT, NORMAL, FULL = ReportForm("short"), ReportForm(), ReportForm("full")
SCRIPT = '<svg xmlns="http://www.w3.org/2000/svg"><script>alert(1)</script></svg>'


def written(tmp_path, result, form=NORMAL, drawn=()):
    return write_report(result, SEEN, tmp_path, drawn, form).read_text(encoding="utf-8")


# -- forms ---------------------------------------------------------------------------------------------------------------------


def test_a_form_has_a_name():
    assert report_form("full", "zh") == ReportForm("full", "zh")
    for names in (("long", "en"), ("short", "de")):
        with pytest.raises(UnknownName):
            report_form(*names)


def test_a_short_report_is_its_first_page(tmp_path):
    result = replace(four_bar_result(), findings=("nothing to worry about", "warned"), warnings=("warned",))
    text = written(tmp_path, result, SHORT, pictures(result, SEEN))
    assert 'id="player"' in text and "Design checks" in text and "Angle swept by the rocker" in text
    assert not [part for part in ('id="values"', 'id="spec"', 'id="sources"', 'id="tables"', "nothing to worry about") if part in text]
    assert "warned" in text, "what the verdict counts is said"
    assert text.count("<figure") == 3, "the scene and two plots"


def test_a_full_report_is_all_open_and_says_how_it_was_computed(tmp_path):
    result = four_bar_result()
    result = replace(result, value_sources={name: "swing" if "swing" in name else "rest" for name in result.values})
    normal, full = written(tmp_path, result), written(tmp_path, result, FULL)
    folded = re.findall(r'<details class="(?:card|card full|group)"(?: id="(\w+)")?>', full)
    assert folded == ["si"], "all is open but the table for those who compute on"
    assert re.search(r'<details class="card" id="tables">', normal) and '<details class="group">' in normal
    assert 'id="spec" open' in full and "How it was computed" in full and "computing time" in full and "Greatest" in full
    assert "How it was computed" not in normal and "2.4669517247e-06\u00a0m" in full


# -- values and captions -------------------------------------------------------------------------------------------------------


def test_values_stand_under_the_analyses_that_computed_them():
    from drivewright import registry

    result = replace(four_bar_result(), mechanism="linkage")
    sources = {name: "motion" if name.startswith("rocker") else "energy" for name in result.values}
    groups = grouped_values(replace(result, value_sources=sources), [{"name": name} for name in result.values])
    meanings = {each.name: each.meaning for each in registry.mechanism("linkage").analyses}
    assert {group["title"].lower() for group in groups} == {meanings[each].lower() for each in set(sources.values())}
    assert sorted(row["name"] for group in groups for row in group["values"]) == sorted(result.values)


def test_without_analyses_the_first_part_of_their_names_groups_values():
    names = ("cam.lift", "ratio", "joint.A.force", "cam.radius", "joint.B.force", "mass")
    groups = grouped_values(replace(four_bar_result(), value_sources={}), [{"name": name} for name in names])
    assert [(group["title"], [row["name"] for row in group["values"]]) for group in groups] == [
        ("Cam", ["cam.lift", "cam.radius"]),
        ("Joint", ["joint.A.force", "joint.B.force"]),
        (OTHERS, ["ratio", "mass"]),
    ]


def test_the_runner_says_which_analysis_computed_each_value():
    from places import EXAMPLES

    from drivewright import runner
    from drivewright.spec import load

    result = runner.run(load(EXAMPLES / "disc_cam.toml"))
    assert result.value_sources.keys() == result.values.keys() and set(result.value_sources.values()) <= set(result.provenance["analyses"])
    assert result.value_sources["max_pressure_angle"] == "geometry"


@pytest.mark.parametrize("form", [NORMAL, FULL])
def test_numbers_in_si_have_a_folded_table_at_the_end(tmp_path, form):
    text = written(tmp_path, four_bar_result(), form)
    values, si = (text.index(f'id="{name}"') for name in ("values", "si"))
    assert '<details class="card" id="si">' in text and si > text.index('id="sources"') > values
    assert "2.4669517247e-06\u00a0m" in text[si:] and "2.4669517247e-06" not in text[values : text.index('id="sources"')]


def test_what_a_plot_shows_is_its_caption(tmp_path):
    plots = (SEEN.plots[0]._replace(meaning="dashed: with ideal joints"),)
    result, seen = four_bar_result(), Views(plots=plots)
    text = write_report(result, seen, tmp_path, pictures(result, seen), NORMAL).read_text(encoding="utf-8")
    assert '<p class="muted">Dashed: with ideal joints.</p></figcaption>' in text
    (drawn,) = pictures(replace(result, mechanism="linkage"), seen, language="zh")
    assert drawn.meaning == "虚线：理想运动副。"


def test_the_numerical_settings_of_a_spec_are_in_a_full_report():
    from places import EXAMPLES

    from drivewright.report.computed import settings
    from drivewright.spec import load

    rows = dict(settings(load(EXAMPLES / "disc_cam.toml")))
    assert rows["manufacture.chord_tolerance"] and "follower.face" not in rows and not any(key.startswith("study") for key in rows)


# -- numbers and order of figures ----------------------------------------------------------------------------------------------


def plot(name, *y, limits=()):
    return Plot(name, name, "motion", "angle", y, limits)


def check(name, ok):
    return Check(name, 1.0, 2.0 if ok else 0.5, "<=", "m", "")


@pytest.mark.parametrize(
    ("shown", "name", "wanted"),
    [
        (plot("a", "b", limits=(("play.forward", "limit"),)), "play.forward", DRAWS_LIMIT),
        (plot("a", "b", limits=(("-play.forward", "limit"),)), "play.backward", DRAWS_LIMIT),
        (plot("a", "main.play"), "play.forward", BEARS_NAME),
        (plot("play", "b"), "play", BEARS_NAME),
        (plot("a", "playing", limits=((1.0, "play"),)), "play", UNRELATED),
    ],
)
def test_how_a_plot_shows_a_check(shown, name, wanted):
    assert relation(shown, check(name, True)) == wanted


def test_plots_of_failed_checks_come_first_and_all_others_keep_their_order():
    plots = (plot("one", "x"), plot("two", "bad"), plot("three", "good"), plot("four", "y", limits=(("bad", "limit"),)), plot("five", "z"))
    result = replace(four_bar_result(), checks=(check("good", True), check("bad", False)))
    assert [each.name for each in failed_first(result, Views(plots=plots)).plots] == ["four", "two", "one", "three", "five"]


def test_a_plot_of_one_of_two_failed_checks_comes_first():
    plots = (plot("one", "x"), plot("two", "bad"), plot("three", "worse", limits=(("bad", "limit"),)))
    result = replace(four_bar_result(), checks=(check("worse", False), check("bad", False)))
    assert [each.name for each in failed_first(result, Views(plots=plots)).plots] == ["three", "two", "one"]


def test_pictures_stand_in_the_order_of_their_numbers_and_further_ones_follow():
    figures = (NumberedFigure(1, "scene-top"), NumberedFigure(2, "plot-a"), NumberedFigure(3, "plot-b"))
    drawn = [picture(name, 300) for name in ("plot-b", "extra", "scene-top", "plot-a", "more")]
    assert [(number, each.name) for number, each in in_order(drawn, figures)] == [
        (1, "scene-top"),
        (2, "plot-a"),
        (3, "plot-b"),
        (4, "extra"),
        (5, "more"),
    ]


def test_a_short_report_without_a_scene_shows_the_first_drawing():
    result = four_bar_result()
    still = seen_in(SHORT, result, SEEN._replace(scene=None))
    assert SEEN.drawings and still.scene is None and still.drawings == SEEN.drawings[:1]
    assert seen_in(SHORT, result, SEEN).drawings == ()


def test_a_failed_check_names_the_figure_that_shows_it(tmp_path):
    result = four_bar_result()
    failed = next(each for each in result.checks if not each.ok)
    plots = tuple(each._replace(limits=((failed.name, "limit"),)) if each.name == "track" else each for each in SEEN.plots)
    seen = seen_in(NORMAL, result, SEEN._replace(plots=plots))
    number = next(each.number for each in numbered_figures(result, seen) if each.name == "plot-track")
    assert number == 1 + len(SEEN.scene.frames), "the first behind the scenes"
    rows = with_figures(content(result), result, seen)["checks"]
    assert rows[0]["figure"] == {"number": number, "name": "plot-track"}
    text = write_report(result, seen, tmp_path, pictures(result, seen)).read_text(encoding="utf-8")
    assert f'href="#figure-{number}"' in text and f'id="figure-{number}"' in text
    numbers = [int(found) for found in re.findall(r'id="figure-(\d+)"', text)]
    assert numbers == list(range(1, len(numbers) + 1))


# -- paper ---------------------------------------------------------------------------------------------------------------------


def picture(name, width, height=100):
    return SimpleNamespace(name=name, title=name, meaning="", svg=f'<svg width="{width}pt" height="{height}pt"/>')


def test_two_narrow_figures_share_a_row_and_a_wide_one_has_its_own():
    drawn = [picture("plot-a", 300), picture("plot-b", 300), picture("plot-c", 500), picture("plot-d", 200), picture("scene-e", 900, 4000)]
    rows = figure_rows(list(enumerate(drawn, 1)))
    assert [[entry["number"] for entry in row] for row in rows] == [[1, 2], [3], [4], [5]]
    assert rows[0][0]["width"] <= HALF_WIDTH and rows[1][0]["width"] > HALF_WIDTH
    assert rows[3][0]["width"] * 4000 / 900 < 300, "a tall one is made small enough for its page"


def pages(path):
    return len(re.findall(rb"/Type\s*/Page\b(?!s)", path.read_bytes()))


@pytest.mark.needs_pdf
def test_a_short_pdf_has_one_page_and_a_full_one_the_most(tmp_path):
    counts = [pages(write_pdf(four_bar_result(), tmp_path / f"{n}.pdf", SEEN, form=form)) for n, form in enumerate((SHORT, NORMAL, FULL))]
    assert counts[0] == 1 < counts[1] <= counts[2]


@pytest.mark.needs_pdf
def test_a_chinese_pdf_with_a_logo(tmp_path):
    (tmp_path / "logo.svg").write_text(SCRIPT, encoding="utf-8")
    result = branded(tmp_path, "logo.svg")
    path = write_pdf(result, tmp_path / "r.pdf", Views(), form=ReportForm("normal", "zh"))
    assert path.read_bytes().startswith(b"%PDF") and b"alert" not in path.read_bytes()


@pytest.mark.needs_pdf
def test_the_pdf_of_a_design_with_a_failed_geometry_check_is_written(tmp_path):
    from places import EXAMPLES

    from drivewright.errors import GeometryCheckFailed
    from drivewright.report.export import export
    from drivewright.spec import load

    spec = load(EXAMPLES / "seedling_pusher.toml")
    assert [path.name for path in export(spec, ("pdf",), tmp_path, form=SHORT)] == ["report.pdf"]
    with pytest.raises(GeometryCheckFailed):
        export(spec, ("pdf", "svg"), tmp_path / "both")
    assert not (tmp_path / "both").exists()


# -- letterhead ----------------------------------------------------------------------------------------------------------------


def branded(folder, logo="", templates=(), **texts):
    table = SimpleNamespace(
        company=texts.get("company", "Works & <b>Co</b>"),
        author=texts.get("author", "Me"),
        logo=folder / logo if logo else None,
        templates=tuple(folder / name for name in templates),
    )
    result = four_bar_result()
    return replace(result, spec=SimpleNamespace(**vars(result.spec), report=table))


def png(width, height):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(b"\0\0")) + chunk(b"IEND", b"")


def test_a_letterhead_is_printed_as_text_and_the_logo_is_an_image(tmp_path):
    (tmp_path / "logo.svg").write_text(SCRIPT, encoding="utf-8")
    text = written(tmp_path, branded(tmp_path, "logo.svg"))
    assert "Works &amp; &lt;b&gt;Co&lt;/b&gt; · " in text and " · Me" in text
    assert re.search(r'<img class="logo" src="data:image/svg\+xml;base64,', text) and "alert" not in text


def test_a_png_is_known_by_its_content(tmp_path):
    (tmp_path / "logo.svg").write_bytes(png(40, 10))
    assert read_letterhead(branded(tmp_path, "logo.svg").spec).suffix == ".png"


@pytest.mark.parametrize(
    ("data", "wanted"),
    [
        (b"GIF89a", "neither an SVG .* nor a PNG file"),
        (b"<html><svg/></html>", "neither an SVG"),
        (b'<!DOCTYPE svg [<!ENTITY a "aaaa">]><svg>&a;</svg>', "neither an SVG"),
        (b'<!-- --><!DOCTYPE svg [<!ENTITY a "aaaa">]><!-- --><svg>&a;</svg>', "neither an SVG"),
        (b"<svg>" + b" " * LARGEST_LOGO, "more than 500 kB"),
        (png(100_000, 100_000), "100000 × 100000 pixels"),
        (png(2000, 2001), "2000 × 2001 pixels"),
        (png(0, 10), "0 × 10 pixels"),
        (b"\x89PNG\r\n\x1a\n", "0 × 0 pixels"),
    ],
)
def test_what_is_no_logo_is_refused_before_anything_is_written(tmp_path, data, wanted):
    from drivewright.report.folder import write_run_folder

    (tmp_path / "logo.svg").write_bytes(data)
    with pytest.raises(InputError, match=f"report.logo: logo.svg .*{wanted}"):
        write_run_folder(branded(tmp_path, "logo.svg"), tmp_path / "run", figures=False, seen=Views())
    assert not (tmp_path / "run").exists()


@pytest.mark.parametrize(
    "data",
    [
        b"<svg>" + b" " * (LARGEST_LOGO - 5),
        b"\xef\xbb\xbf<svg/>",
        b'<?xml version="1.0"?>\n<!-- drawn\nby hand -->\n<!DOCTYPE svg>\n<svg xmlns="x"/>',
    ],
    ids=["largest", "byte order mark", "prolog"],
)
def test_an_svg_may_have_a_prolog_and_the_size_that_is_allowed(tmp_path, data):
    (tmp_path / "logo.svg").write_bytes(data)
    head = read_letterhead(branded(tmp_path, "logo.svg").spec)
    assert (head.suffix, head.logo) == (".svg", data) and head.logo_source.startswith("data:image/svg+xml;base64,")


def test_a_png_of_the_most_pixels_is_an_image_of_its_own_type(tmp_path):
    (tmp_path / "logo.png").write_bytes(png(2000, 2000))
    head = read_letterhead(branded(tmp_path, "logo.png").spec)
    assert head.content()["logo"].startswith("data:image/png;base64,iVBOR")
    assert read_letterhead(branded(tmp_path).spec).logo_source == "", "no logo, no image"


@pytest.mark.parametrize(
    ("data", "wanted"),
    [(b" " * (LARGEST_TEMPLATE + 1), "house.css has more than 200 kB"), ("Größe".encode("latin-1"), "house.css is not text in UTF-8")],
)
def test_a_template_that_is_no_text_of_some_size_is_named(tmp_path, data, wanted):
    (tmp_path / "house.css").write_bytes(data)
    with pytest.raises(InputError, match=f"report.templates: {wanted}"):
        read_letterhead(branded(tmp_path, templates=("house.css",)).spec)
    (tmp_path / "house.css").write_bytes(b" " * LARGEST_TEMPLATE)
    assert read_letterhead(branded(tmp_path, templates=("house.css",)).spec).templates == {"house.css": " " * LARGEST_TEMPLATE}


def test_templates_replace_ours_by_name(tmp_path):
    (tmp_path / "report.html.j2").write_text(
        '{% extends "layout.html.j2" %}{% block main %}<p>Only {{ title }}: {{ verdict.text }}</p>{% endblock %}', encoding="utf-8"
    )
    (tmp_path / "report.css").write_text("body { color: teal }", encoding="utf-8")
    (tmp_path / "house.css").write_text("h1 { color: plum }", encoding="utf-8")
    text = written(tmp_path, branded(tmp_path, templates=("report.html.j2", "report.css", "house.css")))
    assert "<p>Only Four-bar sample: 1 of 3 checks fails</p>" in text
    assert "color: teal" in text and ".tiles {" not in text and text.index("teal") < text.index("plum")
    added = written(tmp_path, branded(tmp_path, templates=("house.css",)))
    assert ".tiles {" in added and "plum" in added


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("{{ ''.__class__.__mro__ }}", "SecurityError"),
        ("{{ t.__init__.__globals__ }}", "SecurityError|UndefinedError"),
        ("{% include '/etc/hostname' %}", "TemplateNotFound"),
        ("{{ missing }}", "UndefinedError"),
        ("\n\n{% if %}", "line 3"),
    ],
)
def test_a_template_reaches_neither_python_nor_files(tmp_path, text, wanted):
    (tmp_path / "report.html.j2").write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=rf"report\.templates: .*({wanted})"):
        written(tmp_path, branded(tmp_path, templates=("report.html.j2",)))
