"""Whole tasks of a designer by hand in a real browser: a mechanism is begun, built, measured, searched and changed without text."""

import csv
import re

import pytest
from browsing import until
from studio_running import analysed, drawn, shared

pytestmark = [pytest.mark.browser, pytest.mark.needs_browser, pytest.mark.needs_studio]

STATE = "window.drivewright.state"


@pytest.fixture
def page(browser, studio):
    """A page with the worked example of a cam; afterwards it must not have complained."""
    context, complaints = browser.new_context(viewport={"width": 1440, "height": 900}, reduced_motion="reduce"), []
    page = context.new_page()
    page.on("console", lambda said: complaints.append(said.text) if said.type == "error" else None)
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.goto(shared(studio, "disc_cam"))
    until(page, "window.drivewright !== undefined", 30)
    drawn(page)
    analysed(page)
    yield page
    context.close()
    assert complaints == []


def begin(page, name):
    """Another design from the menu of new ones."""
    before = page.evaluate(f"{STATE}.design.opened")
    page.get_by_test_id("new").click()
    page.get_by_test_id(name).click()
    until(page, f"{STATE}.design.opened > {before}", 60)
    analysed(page)
    drawn(page)


def value(page, name):
    """A value of the result as a number of the unit that people read."""
    text = page.evaluate(f"name => {STATE}.result.values.find(each => each.name === name).number", name)
    return float(text.replace("−", "-").replace("\u202f", ""))


def middle(page, name):
    box = page.get_by_test_id(name).bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def drag(page, name, dx, dy):
    x, y = middle(page, name)
    page.mouse.move(x, y)
    page.mouse.down()
    for step in range(1, 9):
        page.mouse.move(x + dx * step / 8, y + dy * step / 8)
        page.wait_for_timeout(40)
    page.mouse.up()


def test_another_drive_takes_nothing_along(page):
    page.get_by_test_id("view-programme").click()
    page.get_by_test_id("programme-border-1").wait_for(state="visible")
    begin(page, "preset-linkage-default")
    assert page.get_by_test_id("view-programme").is_hidden() and page.get_by_test_id("view-motion").get_attribute("aria-selected") == "true"
    assert page.get_by_test_id("check-pressure_angle").count() == 0
    assert page.locator("[data-testid=plots] [data-testid^=plot-lift]").count() == 0


def test_a_measurement_names_its_points_tells_its_range_and_is_saved(page, tmp_path):
    begin(page, "preset-linkage-klann_leg")
    page.get_by_test_id("measure").click()
    page.get_by_test_id("measure-vertical").click()
    for key in ("ground.points.O2", "bodies.leg.points.foot"):
        choice = page.get_by_test_id("measure-point")
        choice.select_option(
            next(text for text in choice.evaluate("e => [...e.options].map(o => o.value)") if text.endswith(f"handle {key}"))
        )
        page.get_by_test_id("measure-pick").click()
    row = page.locator(".ms-row")
    assert "ground · O2 – leg · foot" in row.inner_text()
    number = re.search(r"[\d.]+", page.get_by_test_id("measure-range").inner_text())
    assert float(number[0]) == pytest.approx(value(page, "output.travel_y"), rel=1e-3)
    texts = {}
    for ending in ("csv", "svg"):
        with page.expect_download() as download:
            page.get_by_test_id(f"measure-{ending}").click()
        download.value.save_as(tmp_path / ending)
        texts[ending] = (tmp_path / ending).read_text(encoding="utf-8")
    head, *rows = csv.reader(texts["csv"].splitlines())
    heights = [float(row[1]) for row in rows]
    assert "leg · foot" in head[1] and head[1].endswith("[mm]")
    assert max(heights) - min(heights) == pytest.approx(float(number[0]), abs=2e-3)
    assert texts["svg"].startswith("<?xml") and "leg · foot" in texts["svg"]
    page.get_by_test_id("measure-scale").click()  # the wanted lift of the foot; every place of the mechanism goes with it
    page.get_by_test_id("measure-wanted").fill("60 mm")
    page.keyboard.press("Enter")
    until(page, "document.querySelector('[data-testid=measure-range]')?.textContent.includes('60.000')", 60)
    analysed(page)
    assert value(page, "output.travel_y") == pytest.approx(60.0, abs=0.05)
    assert page.evaluate(f"{STATE}.result.checks.every(check => check.ok)")


def test_the_panel_of_measurements_is_put_aside(page):
    page.get_by_test_id("measure").click()
    panel = page.get_by_test_id("measure-panel")
    before, grip = panel.bounding_box(), page.locator(".ms-top").bounding_box()
    x, y = grip["x"] + grip["width"] - 30, grip["y"] + grip["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x - 120, y - 60, steps=4)
    page.mouse.up()
    after = panel.bounding_box()
    assert (after["x"], after["y"]) == pytest.approx((before["x"] - 120, before["y"] - 60), abs=2)


@pytest.mark.slow
def test_a_search_of_segment_angles_keeps_the_turn(page):
    before = value(page, "max_jerk")
    page.get_by_test_id("setup-optimise").click()
    for number, lower, upper in ((0, "90 deg", "130 deg"), (1, "140 deg", "200 deg")):
        key = f"programme.{number}.angle"
        page.get_by_test_id(f"search-key-{key}").click()
        page.get_by_test_id(f"search-lower-{key}").fill(lower)
        page.get_by_test_id(f"search-upper-{key}").fill(upper)
    page.get_by_test_id("search-value-0").select_option("max_jerk")
    page.get_by_test_id("search-budget").fill("64")
    page.get_by_test_id("search-start").click()
    until(page, f"{STATE}.jobs.optimise?.state === 'done'", 400)
    assert page.evaluate(f"{STATE}.jobs.optimise.answer.feasible")
    gen = page.evaluate(f"{STATE}.design.gen")
    page.get_by_test_id("load-best").click()
    until(page, f"{STATE}.design.gen > {gen}")
    analysed(page)
    assert value(page, "max_jerk") < 0.8 * before and value(page, "lift") == pytest.approx(20.0)
    assert page.evaluate(f"{STATE}.result.checks.every(check => check.ok)")
    page.get_by_test_id("view-programme").click()  # the dwell has the rest of the turn, and its border can be dragged
    segments = "[...document.querySelectorAll('.mf-segment')].map(each => each.getBoundingClientRect().width)"
    until(page, f"{segments}.length === 3 && Math.min(...{segments}) > 0")
    assert page.get_by_test_id("programme-border-2").is_enabled()
    gen = page.evaluate(f"{STATE}.design.gen")
    drag(page, "programme-border-2", -30, 0)
    until(page, f"{STATE}.design.gen > {gen}")
    analysed(page)
    assert page.evaluate(f"{STATE}.result.checks.length") > 0 and page.evaluate(f"Object.keys({STATE}.refused).length") == 0


def test_a_four_bar_is_built_from_a_crank_by_clicks(page):
    before = page.evaluate(f"{STATE}.design.opened")
    page.get_by_test_id("new").click()
    page.get_by_test_id("preset-linkage-crank").click()
    until(page, f"{STATE}.design.opened > {before} && Array.isArray({STATE}.scene?.missing)", 60)
    drawn(page)
    assert page.get_by_test_id("build").get_attribute("aria-pressed") == "true"
    until(page, f"{STATE}.result?.plots", 120)  # the pane below has its place
    page.wait_for_timeout(300)
    sheet = page.get_by_test_id("build-sheet").bounding_box()
    crank = page.evaluate(
        """() => { const drawing = document.querySelector('.dw-canvas').getBoundingClientRect(); return [drawing.x, drawing.y]; }"""
    )
    assert crank == pytest.approx([sheet["x"], sheet["y"]], abs=2)
    places = {
        name: page.locator(f"[data-testid='handle-{key}']") for name, key in (("O2", "ground.points.O2"), ("A", "bodies.crank.points.A"))
    }
    spots = {
        name: place.evaluate("e => [new DOMMatrix(e.style.transform).e, new DOMMatrix(e.style.transform).f]")
        for name, place in places.items()
    }
    crank_length = spots["A"][0] - spots["O2"][0]
    spots["B"] = [spots["O2"][0] + 3.05 * crank_length, spots["O2"][1] - 1.9 * crank_length]
    spots["C"] = [spots["O2"][0] + 3 * crank_length, spots["O2"][1]]
    spots["rocker"] = [(spots["B"][k] + spots["C"][k]) / 2 for k in (0, 1)]

    def at(name):
        gen = page.evaluate(f"{STATE}.design.gen")
        page.mouse.click(sheet["x"] + spots[name][0], sheet["y"] + spots[name][1])
        return gen

    def done(gen):
        until(page, f"{STATE}.design.gen > {gen}", 60)
        drawn(page)

    for ends in ("AB", "BC"):
        page.get_by_test_id("tool-body").click()
        gen = [at(end) for end in ends][-1]
        page.keyboard.press("Enter")
        done(gen)
    for tool, name in (("pin", "A"), ("pin", "B"), ("pin", "C"), ("force", "rocker"), ("output", "rocker")):
        page.get_by_test_id(f"tool-{tool}").click()
        done(at(name))
    page.get_by_test_id("build").click()
    analysed(page)
    assert page.evaluate(f"{STATE}.result.full && {STATE}.result.checks.every(check => check.ok)")
    swing = value(page, "output.swing")
    assert 20 < swing < 120
    assert [value(page, f"joints.{name}.max_force") > 0 for name in page.evaluate(JOINTS)] == [True] * 4
    page.get_by_test_id("reach-output.swing").click()
    page.get_by_test_id("reach-target").fill("60")
    page.keyboard.press("Enter")
    page.locator("[data-testid^='reach-apply-']").first.wait_for(timeout=60_000)
    gen = page.evaluate(f"{STATE}.design.gen")
    page.locator("[data-testid^='reach-apply-']").first.click()
    until(page, f"{STATE}.design.gen > {gen}")
    analysed(page)
    assert value(page, "output.swing") == pytest.approx(60, abs=0.1) and page.get_by_test_id("reach").count() == 0


JOINTS = f"{STATE}.result.values.map(each => each.name).filter(name => /^joints[.].*max_force$/.test(name)).map(name => name.split('.')[1])"


def test_a_drag_too_far_leaves_plots_and_checks_in_place(page):
    begin(page, "preset-linkage-klann_leg")
    page.keyboard.press("Escape")
    name, plots = "handle-bodies.crank.points.A", page.get_by_test_id("plots")
    box, checks = plots.bounding_box(), page.locator(".sd-card").count()
    drag(page, name, 120, 0)
    until(page, f"{STATE}.result?.unsolved", 60)
    page.wait_for_timeout(400)
    assert plots.bounding_box() == box and page.locator(".sd-card").count() == checks
    reason = page.evaluate(f"Object.values({STATE}.refused)[0].message")[:30]  # drawn as it is stated, with the reason
    assert reason in page.locator(".vw-note.is-beside").inner_text() and reason in page.locator(".sd-top").inner_text()
    assert page.locator(".vw-player .dw-canvas").evaluate("e => getComputedStyle(e).opacity") == "1"
    gen = page.evaluate(f"{STATE}.design.gen")
    page.keyboard.press("Control+z")
    until(page, f"{STATE}.design.gen > {gen}")
    analysed(page)
    assert page.evaluate(f"!{STATE}.result.unsolved && Object.keys({STATE}.refused).length === 0")


def test_a_handle_says_its_name_and_shows_its_body(page):
    begin(page, "preset-linkage-default")
    page.mouse.move(*middle(page, "handle-bodies.crank.points.A"))
    bubble = page.locator("output.hd-bubble:visible")
    bubble.wait_for()
    assert "crank · A" in bubble.inner_text() and "40 mm" in bubble.inner_text()
    colours = [
        page.get_by_test_id(f"handle-{key}").evaluate("e => getComputedStyle(e, '::before').borderTopColor")
        for key in ("bodies.crank.points.A", "bodies.coupler.points.B", "bodies.rocker.points.B")
    ]
    assert len(set(colours)) == 3
