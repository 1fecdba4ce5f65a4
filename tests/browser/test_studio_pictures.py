"""The studio's screens as pictures in out/screenshots/, for people to look at; asserted is that they are screens and not blank."""

import subprocess

import pytest
from browsing import until
from studio_running import ROOT, analysed, drawn, enter, shared

pytestmark = [pytest.mark.browser, pytest.mark.slow, pytest.mark.needs_browser, pytest.mark.needs_studio]

FOLDER = ROOT / "out" / "screenshots"
NAMES = ("disc_cam", "seedling_pusher", "four_bar", "rubber_roller_61804", "pin_indexer", "hyvo_chain", "slider_crank_clearance")
TASTE = "localStorage.setItem('drivewright-taste', JSON.stringify({{lang: '{lang}', theme: '{theme}'}}))"
COLOURS = """async () => {
  const c = document.querySelector('.dw-canvas'), d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
  const seen = new Set(); for (let i = 0; i < d.length; i += 4) seen.add(d[i] << 16 | d[i + 1] << 8 | d[i + 2]); return seen.size; }"""


@pytest.fixture
def tab(browser, studio):
    pages = []

    def open_it(name, theme="light", lang="en", size=(1440, 900)):
        page = browser.new_page(viewport={"width": size[0], "height": size[1]})
        pages.append(page)
        page.add_init_script(TASTE.format(lang=lang, theme=theme))
        page.goto(shared(studio, name))
        until(page, "window.drivewright !== undefined", 30)
        drawn(page)
        analysed(page)
        page.evaluate("document.querySelector('.dw-button').click()")
        until(page, "document.querySelector('.dw-range') !== null")
        page.evaluate("{ const r = document.querySelector('.dw-range'); r.value = 0.3; r.dispatchEvent(new Event('input')); }")
        page.wait_for_timeout(200)
        return page

    yield open_it
    for page in pages:
        page.close()


def keep(page, name):
    FOLDER.mkdir(parents=True, exist_ok=True)
    page.screenshot(path=FOLDER / f"{name}.png")
    assert page.evaluate(COLOURS) > 20


def has_chinese_letters():
    return bool(subprocess.run(["fc-list", ":lang=zh"], capture_output=True, text=True, check=False).stdout.strip())


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("name", NAMES)
def test_a_picture_of_every_kind(tab, name, theme):
    keep(tab(name, theme), f"studio-{name}-{theme}")


@pytest.mark.parametrize("name", NAMES)
def test_a_small_screen(tab, name):
    page = tab(name, size=(1280, 720))
    keep(page, f"studio-{name}-small")
    assert page.evaluate("document.documentElement.scrollWidth <= 1280 && document.documentElement.scrollHeight <= 720")


@pytest.mark.skipif(not has_chinese_letters(), reason="no Chinese font (fonts-wqy-zenhei)")
@pytest.mark.parametrize("name", NAMES)
def test_the_chinese_screen(tab, name):
    page = tab(name, lang="zh")
    keep(page, f"studio-{name}-zh")
    text = page.locator(".st-form").inner_text() + page.locator(".st-head").inner_text()
    letters = [c for c in text if c.isalpha()]
    assert sum("\u4e00" <= c <= "\u9fff" for c in letters) > 0.35 * len(letters)


def test_compared(tab):
    page = tab("four_bar")
    page.get_by_test_id("compare").click()
    enter(page, "bodies.crank.points.A.0", "46 mm")
    until(page, "window.drivewright.state.design.toml.includes('46 mm')")
    analysed(page)
    keep(page, "studio-compared")


SHOWN = {"solid": ".so-canvas", "figures": ".vw-tile img", "study": "text=No study has been run yet"}


@pytest.mark.parametrize("view", list(SHOWN))
def test_the_other_views(tab, view):
    page = tab("disc_cam")
    page.get_by_test_id(f"view-{view}").click()
    if view != "study":
        until(page, f"['done', 'failed'].includes(window.drivewright.state.jobs.{view}?.state)", 120)
        assert page.evaluate(f"window.drivewright.state.jobs.{view}.state") == "done"
    page.locator(SHOWN[view]).first.wait_for(state="visible", timeout=20_000)
    page.wait_for_timeout(1500)
    page.screenshot(path=FOLDER / f"studio-view-{view}.png")


def test_the_solid_in_motion(tab):
    page = tab("roller_gear_indexer")
    page.get_by_test_id("view-solid").click()
    until(page, "['done', 'failed'].includes(window.drivewright.state.jobs.solid?.state)", 120)
    page.locator(".so-canvas").first.wait_for(state="visible", timeout=20_000)
    page.get_by_test_id("solid-explode").evaluate("e => { e.value = 0.1; e.dispatchEvent(new Event('input')); }")
    box = page.locator(".so-canvas").first.bounding_box()
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    page.mouse.wheel(0, -300)
    page.get_by_test_id("solid-play").click()
    page.wait_for_timeout(2500)
    page.screenshot(path=FOLDER / "studio-solid.png")


# -- what hands do: the pictures of docs/studio.md, which are copied from here into docs/img ---------------------------------------


def test_measured(tab):
    page = tab("four_bar")
    page.get_by_test_id("measure").click()
    for kind, *features in (
        ("distance", "|handle ground.points.O2", "coupler|handle bodies.coupler.points.C"),
        ("angle", "|handle ground.points.O4", "crank|handle bodies.crank.points.A", "rocker|handle bodies.rocker.points.B"),
    ):
        page.get_by_test_id(f"measure-{kind}").click()
        for feature in features:
            page.get_by_test_id("measure-point").select_option(feature)
            page.get_by_test_id("measure-pick").click()
    assert page.get_by_test_id("measure-list").inner_text().startswith("Distance: ground · O2 – coupler · C")
    keep(page, "studio-measured")


def test_the_programme_of_a_cam(tab):
    page = tab("disc_cam")
    page.get_by_test_id("view-programme").click()
    page.get_by_test_id("programme-border-1").wait_for(state="visible")
    page.wait_for_timeout(500)
    page.screenshot(path=FOLDER / "studio-programme.png")


def test_built_by_clicks(tab):
    page = tab("four_bar")
    page.get_by_test_id("build").click()
    until(page, "Array.isArray(window.drivewright.state.scene?.missing)", 60)
    page.get_by_test_id("tool-body").click()
    box = page.get_by_test_id("build-sheet").bounding_box()
    for x, y in ((0.62, 0.2), (0.8, 0.3)):
        page.mouse.click(box["x"] + x * box["width"], box["y"] + y * box["height"])
    page.keyboard.press("Enter")
    until(page, "JSON.stringify(window.drivewright.state.scene?.missing).includes('held by no joint')", 60)
    drawn(page)
    keep(page, "studio-building")


def test_a_change_that_makes_a_check_pass(tab):
    page = tab("disc_cam", theme="dark")
    enter(page, "follower.prime_radius", "24 mm")
    until(page, "window.drivewright.state.design.toml.includes('24 mm')")
    analysed(page)
    page.get_by_test_id("fix-pressure_angle").click()
    page.get_by_test_id("fix-answer").filter(has_text="instead of").wait_for(timeout=120_000)
    keep(page, "studio-fix")


def test_plots_are_chosen(tab):
    page = tab("gearbox_shaft")
    page.get_by_test_id("plot-picker").click()
    page.wait_for_timeout(400)
    keep(page, "studio-plots")


@pytest.mark.parametrize("pane", ["mechanism", "form"])
def test_a_telephone(tab, pane):
    page = tab("four_bar", size=(390, 844))
    page.get_by_test_id(f"pane-{pane}").click()
    page.wait_for_timeout(400)
    page.screenshot(path=FOLDER / f"studio-telephone-{pane}.png")
    assert page.evaluate("document.documentElement.scrollWidth <= 390")
