"""The plots pane of the studio: what it begins with, the choice, kept runs, its height, files of a plot; the diagrams of a shaft."""

import csv
import io
import xml.etree.ElementTree as ET

import pytest
from browsing import until
from studio_running import analysed, enter, shared

pytestmark = [pytest.mark.browser, pytest.mark.needs_browser, pytest.mark.needs_studio]

STATE = "window.drivewright.state"
KEY = "bodies.crank.points.A.0"
CURVE = "n => document.querySelectorAll('.dw-plot-canvas')[n].toDataURL()"


@pytest.fixture
def tab(open_tab):
    """Opens tabs, analysed."""

    def open_it(address, width=1440, height=900):
        page = open_tab(address, width, height)
        analysed(page)
        return page

    return open_it


def names(page):
    return page.evaluate("[...document.querySelectorAll('.bt-scroll .dw-group')].map(node => node.dataset.testid)")


def height(page):
    return page.locator(".st-plots").bounding_box()["height"]


def downloaded(page, testid, n=0):
    with page.expect_download() as waiting:
        page.get_by_test_id(testid).nth(n).click(force=True)
    return waiting.value.suggested_filename, waiting.value.path().read_text(encoding="utf-8")


def test_the_pane_begins_with_the_main_plots_and_shows_what_is_chosen(studio, tab):
    page = tab(studio)
    assert names(page) == ["plot-motion.rocker", "plot-drive"]
    page.get_by_test_id("plot-picker").click()
    page.get_by_test_id("plot-search").fill("spectrum")
    assert page.locator(".bt-pick:visible").count() == 2
    page.get_by_test_id("plot-search").fill("")
    page.get_by_test_id("pick-motion.rocker/rocker.w").uncheck()
    page.get_by_test_id("pick-spectrum.rocker").check()
    page.get_by_test_id("pick-path.coupler_point").check()
    page.keyboard.press("Escape")
    assert page.get_by_test_id("plot-motion.rocker").locator(".dw-plot").count() == 2
    assert set(names(page)) == {"plot-motion.rocker", "plot-drive", "plot-spectrum.rocker", "plot-path.coupler_point"}
    page.reload()
    until(page, "window.drivewright?.state.result?.full === true", 60)
    assert "plot-spectrum.rocker" in names(page), "the choice is remembered"
    page.get_by_test_id("plot-picker").click()
    page.get_by_test_id("plot-none").click()
    assert names(page) == [] and page.locator(".bt-none").is_visible()
    page.get_by_test_id("plot-usual").click()
    assert names(page) == ["plot-motion.rocker", "plot-drive"]


def test_the_values_under_the_pointer_are_told_and_a_drag_moves_the_clock(studio, tab):
    page = tab(studio)
    box = page.locator(".dw-cover").nth(1).bounding_box()
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + 60)
    tip = page.locator(".dw-tip:visible")
    assert tip.count() == 1 and "Angular velocity of rocker" in tip.inner_text() and "rpm" in tip.inner_text()
    page.mouse.down()
    page.mouse.move(box["x"] + box["width"] / 2 + 30, box["y"] + 60)
    page.mouse.up()
    assert float(page.locator(".dw-player").get_attribute("data-phase")) > 0.4


def test_kept_runs_are_drawn_behind_named_and_switched(studio, tab):
    page = tab(studio)
    page.get_by_test_id("run-keep").click()
    assert page.evaluate(f"{STATE}.kept.length") == 1
    enter(page, KEY, "35 mm")
    until(page, f"{STATE}.design.gen === 2")  # the answer may be late
    analysed(page)
    with_run = page.evaluate(CURVE, 0)
    page.get_by_test_id("run-1").click()
    assert page.get_by_test_id("run-1").get_attribute("aria-pressed") == "false"
    without = page.evaluate(CURVE, 0)
    assert with_run != without
    page.get_by_test_id("run-1").click()
    page.get_by_test_id("run-name-1").fill("long crank")
    page.get_by_test_id("run-name-1").press("Enter")
    box = page.locator(".dw-cover").first.bounding_box()
    page.mouse.move(box["x"] + 120, box["y"] + 60)
    assert "long crank" in page.locator(".dw-tip:visible").inner_text()
    name, text = downloaded(page, "plot-csv")
    head, first, *_ = csv.reader(io.StringIO(text))
    assert name.endswith("motion.rocker-rocker.angle.csv") and len(head) == 4
    assert head[:2] == ["crank angle [°]", "Angle of rocker [°]"] and "long crank" in head[3]
    assert float(first[1]) != pytest.approx(float(first[3]), abs=0.1)
    for _ in range(3):
        page.get_by_test_id("run-keep").click()
    assert page.get_by_test_id("run-keep").is_disabled(), "four runs are the most"
    page.get_by_test_id("run-drop-1").click()
    assert page.get_by_test_id("run-keep").is_enabled() and page.get_by_test_id("run-1").count() == 0


def test_a_plot_is_an_svg_file_with_title_and_units(studio, tab):
    page = tab(studio)
    page.get_by_test_id("theme").click()
    name, text = downloaded(page, "plot-svg", 1)
    root = ET.fromstring(text)
    said = [node.text for node in root.iter("{http://www.w3.org/2000/svg}text")]
    assert (
        name.endswith(".svg")
        and "Angular velocity of rocker" in said
        and "Angular velocity of rocker [rpm]" in said
        and "crank angle" in said
    )
    first = next(root.iter("{http://www.w3.org/2000/svg}rect"))
    assert first.get("fill") == "#ffffff", "on white, whatever the theme"
    assert max(len(node.get("d")) for node in root.iter("{http://www.w3.org/2000/svg}path")) > 2000, "the curve itself"


def test_the_upper_edge_moves_by_hand_and_by_keys_and_is_remembered(studio, tab):
    page = tab(studio)
    before, edge = height(page), page.get_by_test_id("plots-edge")
    edge.focus()
    page.keyboard.press("ArrowUp")
    assert height(page) == pytest.approx(before + 24, abs=2)
    box = edge.bounding_box()
    page.mouse.move(box["x"] + 300, box["y"] + 3)
    page.mouse.down()
    page.mouse.move(box["x"] + 300, box["y"] - 77, steps=4)
    page.mouse.up()
    tall = height(page)
    assert tall == pytest.approx(before + 104, abs=3)
    until(page, f"Math.abs(document.querySelector('[role=separator]').getAttribute('aria-valuenow') - {tall}) < 3")
    page.reload()
    until(page, "window.drivewright?.state.result?.full === true", 60)
    assert height(page) == pytest.approx(tall, abs=3)
    page.get_by_test_id("plots-edge").dblclick()
    assert height(page) == pytest.approx(before, abs=3)


def test_diagrams_of_a_shaft_stand_under_its_drawing_on_the_same_axis(studio, tab):
    page = tab(shared(studio, "pressure_roller_shaft"))
    diagrams = page.get_by_test_id("diagrams")
    assert diagrams.is_visible() and diagrams.locator(".dg-head").count() == 5
    assert "largest" in page.get_by_test_id("diagram-diagram/moment").inner_text()
    canvas, stage = (page.locator(name).bounding_box() for name in (".dg-canvas", ".dw-canvas"))
    assert canvas["x"] == pytest.approx(stage["x"], abs=1) and canvas["width"] == pytest.approx(stage["width"], abs=1)
    assert canvas["y"] > stage["y"] + stage["height"]
    reading = page.get_by_test_id("diagram-diagram/moment").locator("output")
    page.mouse.move(canvas["x"] + canvas["width"] * 0.4, canvas["y"] + 50)
    here = reading.inner_text()
    page.mouse.move(canvas["x"] + canvas["width"] * 0.6, canvas["y"] + 50)
    assert "largest" not in here and reading.inner_text() != here
    picture = "() => document.querySelector('.dg-canvas').toDataURL()"
    before = page.evaluate(picture)
    page.locator(".dw-canvas").press("+")
    until(page, f"({picture})() !== {before!r}")


def test_a_small_screen_shows_the_first_plots_whole_and_their_unit_once(studio, tab):
    page = tab(shared(studio, "two_disc_rotor"), 1024, 768)
    until(page, "document.querySelectorAll('.bt-scroll .dw-group').length > 2")
    box, pane = page.locator(".bt-scroll .dw-group").first.bounding_box(), page.locator(".bt-scroll").bounding_box()
    assert box["y"] + box["height"] <= pane["y"] + pane["height"] + 1
    campbell = page.locator("[data-testid='plot-campbell'] .dw-plot-head").first
    assert campbell.inner_text().count("Hz") == 1
    page.mouse.move(box["x"] + 150, box["y"] + box["height"] - 80)  # numbers under the pointer have the unit of the title
    until(page, "/[0-9]/.test(document.querySelector('.bt-scroll .dw-now b').textContent)")
    first = page.locator(".bt-scroll .dw-group .dw-plot-head").first
    assert first.inner_text().count("µm/kN") == 1
    indexer = tab(shared(studio, "pin_indexer"))  # over the cycle every number has its unit
    until(indexer, "document.querySelector('[data-testid=plot-play]') !== null")
    assert indexer.locator("[data-testid='plot-play'] .dw-plot-head").first.inner_text().count("arcmin") == 2


def test_a_chain_opens_with_plots(studio, tab):
    page = tab(shared(studio, "roller_chain"))
    assert names(page) == ["plot-centre_distance", "plot-running", "plot-spectrum"]
    assert page.locator(".bt-scroll .dw-plot").count() == 4
