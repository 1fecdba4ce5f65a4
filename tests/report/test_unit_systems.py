"""Reports in millimetres, SI or inches: the same numbers, and one system on a page."""

import html
import re
from dataclasses import replace
from types import SimpleNamespace
from urllib.parse import unquote

import numpy as np
import pytest

from drivewright import runner
from drivewright.report.comparison import compare, difference_text, value_text
from drivewright.report.comparison_page import comparison_content
from drivewright.report.content import content, pictures, views
from drivewright.report.export import export
from drivewright.report.folder import write_run_folder
from drivewright.report.pack import pack_plot_groups, pack_scene
from drivewright.report.tabular import write_csv
from drivewright.result import Array, Check, Column, Plot, Result, Table, Value
from drivewright.spec import load
from drivewright.view.overlays import overlay
from drivewright.view.panels import panels
from drivewright.view.text import quantity, uncertain

pytestmark = pytest.mark.interface

CAM = "examples/disc_cam.toml"
INCH = 0.0254
METRIC = re.compile(r"(?<![\w^])(mm|µm|m|N|kN|MPa|Pa|kg|m/s|m/s²|W|J)(?![\w/])(?!\xa0?(?:of|and)\b)")


@pytest.fixture(scope="module")
def runs():
    specs = {system: load(CAM, [f"units={system}"]) for system in ("mm", "si", "inch")}
    return {system: runner.run(spec) for system, spec in specs.items()}


@pytest.fixture(scope="module")
def page(runs, tmp_path_factory):
    """The folder of the report in inches."""
    return write_run_folder(runs["inch"], tmp_path_factory.mktemp("inch") / "run")


def made(system="inch", values=(), checks=(), tables=(), spec=None):
    """A result of a kind that is not installed."""
    spec = spec or SimpleNamespace(units=system, to_toml=lambda moved: "")
    return Result(spec, "none", "t", "d" * 64, dict(values), {each.name: each for each in tables}, tuple(checks), (), {})


# -- numbers -------------------------------------------------------------------------------------------------------------------


def test_values_and_checks_of_a_report(runs):
    shown = {system: content(run) for system, run in runs.items()}
    inch, si = ({each["name"]: each["shown"] for each in shown[system]["values"]} for system in ("inch", "si"))
    assert (inch["lift"], inch["max_contact_force"], inch["max_contact_pressure"]) == ("0.7874\xa0in", "46.449\xa0lbf", "45.744\xa0ksi")
    assert (si["lift"], si["max_contact_force"], si["max_contact_pressure"]) == ("0.02\xa0m", "206.61\xa0N", "3.154×10⁸\xa0Pa")
    wall = {system: next(c for c in each["checks"] if c["name"] == "bore_wall") for system, each in shown.items()}
    assert [wall[s]["value"] for s in ("mm", "si", "inch")] == ["24\xa0mm", "0.024\xa0m", "0.94488\xa0in"]
    assert [wall[s]["limit"] for s in ("mm", "si", "inch")] == ["≥ 3\xa0mm", "≥ 0.003\xa0m", "≥ 0.11811\xa0in"]
    assert [wall[s]["margin"] for s in ("mm", "si", "inch")] == ["+21\xa0mm", "+0.021\xa0m", "+0.8268\xa0in"]


def test_results_stay_in_si(runs):
    records = [{key: each.record()[key] for key in ("values", "checks", "arrays", "digest")} for each in runs.values()]
    assert records[0] == records[1] == records[2]


def test_temperatures_are_on_their_scale_and_their_margins_are_not():
    oil = Value(343.15, "K", "oil temperature", 341.15, 345.15, "fit")
    check = Check("oil", 343.15, 363.15, "<=", "K", "oil temperature")
    rise = Value(10.0, "deltaK", "rise")
    for system, texts in {
        "mm": ("70.0 (68.0 to 72.0)\xa0°C", "70\xa0°C", "≤ 90\xa0°C", "+20\xa0°C", "10\xa0K"),
        "inch": ("158.0 (154.4 to 161.6)\xa0°F", "158\xa0°F", "≤ 194\xa0°F", "+36\xa0°F", "18\xa0°F"),
        "si": ("343.1 (341.1 to 345.1)\xa0K", "343.15\xa0K", "≤ 363.15\xa0K", "+20\xa0K", "10\xa0K"),
    }.items():
        told = content(made(system, {"oil": oil, "rise": rise}, [check]))
        value, (of_check,) = {each["name"]: each["shown"] for each in told["values"]}, told["checks"]
        assert (value["oil"], of_check["value"], of_check["limit"], of_check["margin"], value["rise"]) == texts


def test_long_lives_are_hours_and_millions_of_revolutions():
    life = {"life": Value(12345678.0, "s", "life"), "turns": Value(34.034e6, "rev", "life"), "short": Value(12.5, "rev", "life")}
    told = {each["name"]: each for each in content(made("mm", life))["values"]}
    assert told["life"]["shown"] == "3429.4\xa0h" and told["life"]["number"] == "3429.4" and told["life"]["unit"] == "h"
    assert told["turns"]["shown"] == "34.034\xa0million\xa0rev" and told["short"]["shown"] == "12.5\xa0rev"
    assert quantity(3599.0, "s") == "3599\xa0s" and uncertain(7200.0, "s", 3600.0, 10800.0).endswith("\xa0h")


# -- tables --------------------------------------------------------------------------------------------------------------------


def test_csv_files_say_their_units(tmp_path):
    table = Table("t", "t", (Column("x", "m", "x", np.array([0.0254, 0.0])), Column("oil", "K", "oil", np.array([343.15, 273.15]))))
    told = {}
    for system in ("mm", "si", "inch"):
        write_csv(table, tmp_path / "t.csv", system=system)
        told[system] = (tmp_path / "t.csv").read_text().split()
    assert told["inch"] == ["x", "[in],oil", "[degF]", "1,158", "0,32"]
    assert told["mm"] == ["x", "[mm],oil", "[degC]", "25.4,70", "0,0"]
    assert told["si"] == ["x", "[m],oil", "[K]", "0.0254,343.15", "0,273.15"]


def test_exported_csv_files_are_in_the_units_of_the_spec(tmp_path):
    files = export(load(CAM, ["units=inch"]), ("csv",), tmp_path)
    heads = ",".join(file.read_text().splitlines()[0] for file in files)
    assert "[in]" in heads and "[lbf]" in heads and "mm" not in heads and "[N]" not in heads


# -- pictures ------------------------------------------------------------------------------------------------------------------


def test_panels_are_scaled_with_their_limits_places_and_shades():
    table = Table(
        "t",
        "t",
        (
            Column("x", "m", "x", np.array([0.0, 1.0])),
            Column("y", "Pa", "y", np.array([1e6, 2e6])),
            Column("on", "-", "on", np.array([1, 0])),
        ),
    )
    plot = Plot("p", "p", "t", "x", ("y",), limits=((3e6, "limit"),), places=((0.254, "A"),), shade="on")
    (mm,), (inch,) = (panels(made(system, tables=[table]), plot) for system in ("mm", "inch"))
    assert (inch.x.unit, inch.series[0].unit) == ("in", "ksi") and inch.label == "Y [ksi]"
    assert inch.places == ((pytest.approx(10.0), "A"),) and mm.places == ((254.0, "A"),)
    assert inch.limits[0][0] == pytest.approx(3 / 6.894757293168361) and inch.limits[0][1].endswith("\xa0ksi")
    assert inch.x.data == pytest.approx(mm.x.data / 25.4) and inch.shade == ((0.0, pytest.approx(0.5 / INCH)),)


def test_small_deflections_are_micrometres_or_mils():
    columns = [Column(name, "m", name, np.zeros(3)) for name in ("x", "y", "z")]
    table = Table("t", "t", (*columns, Column("w", "m", "w", np.full(3, 25.4e-6))))
    plot = Plot("p", "p", "t", "x", ("y", "z", "w"), style="mesh")
    shown = {system: panels(made(system, tables=[table]), plot)[0].series[2] for system in ("mm", "inch", "si")}
    assert {system: (each.unit, float(each.data[0])) for system, each in shown.items()} == {
        "mm": ("µm", pytest.approx(25.4)),
        "inch": ("mil", pytest.approx(1.0)),
        "si": ("m", 25.4e-6),
    }


def test_the_player_has_the_system_of_the_report(runs):
    scene, plots = views(runs["inch"])[:2]
    assert "length" not in pack_scene(scene) and pack_scene(scene, "inch")["length"] == [1 / INCH, "in"]
    assert pack_scene(scene, "si")["length"] == [1.0, "m"]
    assert pack_scene(scene, "si")["cycle"]["unit"] == "rad" and pack_scene(scene, "inch")["cycle"]["unit"] == "°"
    groups = {system: pack_plot_groups(run, scene, plots)["plots"] for system, run in runs.items()}
    shades = [[panel["shade"] for plot in each for panel in plot["panels"]] for each in groups.values()]
    np.testing.assert_allclose(np.ravel([s for s in shades[0] if s]), np.ravel([s for s in shades[1] if s]), atol=1e-12)
    units = {series["unit"] for plot in groups["inch"] for panel in plot["panels"] for series in panel["series"]}
    assert "in" in units and not units & {"mm", "N", "MPa", "m/s", "m/s²"}


def test_every_picture_is_in_inches(runs):
    result = runs["inch"]
    texts = {picture.name: svg_text(picture.svg) for picture in pictures(result, views(result))}
    assert not {name: METRIC.findall(text) for name, text in texts.items() if METRIC.search(text)}
    assert METRIC.search(svg_text(next(each.svg for each in pictures(runs["mm"], views(runs["mm"])) if each.name == "plot-load")))
    assert "[in]" in texts["scene-machine"] and "in thick" in texts["drawing-cam"].replace("\xa0", " ")


def svg_text(svg):
    """What a picture says: its texts, which stand in comments before their outlines or as text."""
    return "\n".join([*re.findall(r"<!--(.*?)-->", svg, re.DOTALL), *re.findall(r">([^<>]+)<", svg)])


# -- pages ---------------------------------------------------------------------------------------------------------------------


def test_a_report_in_inches_has_no_millimetres(page, runs, tmp_path):
    told, metric = page_text(page), page_text(write_run_folder(runs["mm"], tmp_path / "mm", figures=False))
    number_and_unit = re.compile(r"[\d\[(]\s*(?:mm|µm|MPa|N|kg|m|m/s|m/s²)\b[^\w]")
    assert not number_and_unit.findall(told) and len(number_and_unit.findall(metric)) > 30
    assert "in/s" in told and "lbf·in" in told and "ksi" in told


def page_text(folder):
    """What a page says, but for pictures, the spec, the table of SI numbers and the list of the files of tables, which are SI."""
    text = (folder / "report.html").read_text(encoding="utf-8")
    for part in (r"<script.*?</script>", r"<style.*?</style>", r"<pre.*?</pre>", r'data:image[^"]*', r'<ul class="columns">.*?</ul>'):
        text = re.sub(part, "", text, flags=re.DOTALL)
    text = re.sub(r'<details class="card" id="si">.*?</details>', "", text, flags=re.DOTALL)
    return html.unescape(re.sub(r"<[^>]+>", " ", unquote(text)))


def test_the_spec_is_quoted_as_it_is_and_keeps_its_system(page):
    spec = load(page / "spec.toml")
    assert spec.units == "inch" and 'roller_radius = "8 mm"' in (page / "spec.toml").read_text()


# -- comparisons ---------------------------------------------------------------------------------------------------------------


def test_a_comparison_has_the_units_of_the_first_spec(runs):
    other = replace(runs["mm"], spec=load(CAM, ["follower.prime_radius=45 mm"]))
    both = compare([runs["inch"], other], ["A", "B"])
    told = comparison_content(both)
    (lift,) = (row for row in told["values"] if row["name"] == "lift")
    assert both.system == "inch" and [cell["value"] for cell in lift["cells"]] == ["0.7874\xa0in"] * 2
    (wall,) = (row for row in told["checks"] if row["name"] == "bore_wall")
    assert wall["limit"] == "≥ 0.11811\xa0in" and [cell["value"] for cell in wall["cells"]] == ["0.94488\xa0in"] * 2
    assert compare([other, runs["inch"]], ["A", "B"]).system == "mm"


def test_curves_of_several_designs_share_the_system(runs):
    drawn = overlay([runs["inch"], runs["mm"]], ["A", "B"], "load").panels
    assert {series.unit for panel in drawn for series in panel.series} == {"lbf", "lbf·in"}
    first, second = (series.data for series in drawn[0].series[:2])
    assert first == pytest.approx(second)


def test_texts_of_values_and_differences():
    assert value_text(Value(0.0254, "m", ""), "inch") == "1\xa0in" and value_text(Value(0.0254, "m", "")) == "25.4\xa0mm"
    apart = compare([made(values={"a": Value(x, "m", "a")}) for x in (0.0254, 0.0508)], ["A", "B"]).differences("a")[1]
    assert difference_text(apart, "m", "inch") == "+1\xa0in (+100\xa0%)"


def test_arrays_and_margins_with_intervals():
    check = Check("wall", 0.0508, 0.0254, ">=", "m", "wall", low=0.04, high=0.06)
    result = replace(made("inch", checks=[check]), arrays={"a": Array("m", ("i",), ((0, 1),), np.array([0.0254, 0.0508]))})
    told = content(result)
    assert (told["arrays"][0]["unit"], told["arrays"][0]["rows"]) == ("in", [["1", "2"]])
    assert told["checks"][0]["margin"] == "+1.00\xa0in"


def test_places_along_x_of_several_designs_are_in_the_system():
    x, y = Column("x", "m", "x", np.array([0.0, 0.0254])), Column("y", "N", "y", np.array([1.0, 2.0]))
    panel = overlay([made(tables=[Table("t", "t", (x, y))])] * 2, ["A", "B"], "t").panels[0]
    assert panel.series[1].x == pytest.approx([0.0, 1.0]) and panel.series[1].unit == "lbf" and panel.x.unit == "in"
