"""A linkage built by clicks on its drawing, in a real browser."""

import pytest
from browsing import until
from studio_running import drawn

pytestmark = [pytest.mark.browser, pytest.mark.needs_browser, pytest.mark.needs_studio]
STATE = "window.drivewright.state"
MISSING = f"JSON.stringify({STATE}.scene?.missing)"


@pytest.fixture
def page(studio, browser):
    """A page in which a person builds; it must not have complained, or asked for anything outside."""
    context, complaints = browser.new_context(viewport={"width": 1440, "height": 900}, reduced_motion="reduce"), []
    page = context.new_page()
    page.on("console", lambda said: complaints.append(said.text) if said.type == "error" else None)
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.on("request", lambda request: None if request.url.startswith((studio, "ws", "data:")) else complaints.append(request.url))
    page.goto(studio)
    until(page, "window.drivewright !== undefined", 30)
    drawn(page)
    until(page, f"{STATE}.result?.full", 120)  # the pane below has its place, so that the places of the drawing stay
    page.get_by_test_id("build").click()
    until(page, f"Array.isArray({STATE}.scene?.missing)", 60)
    drawn(page)
    yield page
    context.close()
    assert complaints == []


def at(page, x, y):
    """Click a place of the drawing, as parts of its width and height."""
    box = page.get_by_test_id("build-sheet").bounding_box()
    page.mouse.click(box["x"] + x * box["width"], box["y"] + y * box["height"])


def steps(page):
    return page.evaluate(f"{STATE}.design.gen")


def after(page, gen):
    until(page, f"{STATE}.design.gen > {gen}", 60)
    drawn(page)


def test_a_pendulum_from_clicks(page):
    gen = steps(page)
    page.get_by_test_id("tool-body").click()
    at(page, 0.1, 0.2)
    at(page, 0.25, 0.3)
    page.keyboard.press("Enter")
    after(page, gen)
    until(page, f"{MISSING}.includes('held by no joint')", 60)
    assert "[bodies.link_1]" in page.evaluate(f"{STATE}.design.toml")
    gen = steps(page)
    page.get_by_test_id("tool-pin").click()
    at(page, 0.1, 0.2)
    after(page, gen)
    until(page, f"{MISSING}.includes('held by one joint only')", 60)
    page.keyboard.press("Control+z")
    until(page, f"{MISSING}.includes('held by no joint')", 60)


def test_a_second_drive_is_placed_and_taken_away_by_clicks(page):
    page.get_by_test_id("tool-body").click()
    at(page, 0.1, 0.2)
    at(page, 0.25, 0.3)
    page.keyboard.press("Enter")
    until(page, f"{MISSING}.includes('held by no joint')", 60)
    for tool, words in (("pin", "held by one joint only"), ("drive", None), ("delete", "held by one joint only")):
        page.get_by_test_id(f"tool-{tool}").click()
        at(page, 0.1, 0.2)
        until(page, f"{MISSING}.includes({words!r})" if words else f"{MISSING} === '[]'", 60)
        drawn(page)
        further = page.evaluate(f"({STATE}.design.toml.match(/\\[\\[drives\\]\\]/g) || []).length")
        marks = page.evaluate(f"{STATE}.scene.scene.bodies.filter(({{name}}) => name.startsWith('drive ')).length")
        assert (further, marks) == ((1, 2) if tool == "drive" else (0, 1))


def test_a_stroke_draws_a_bar_and_moves_no_point(page):
    box, gen = page.get_by_test_id("build-sheet").bounding_box(), steps(page)

    def stroke():
        page.mouse.move(box["x"] + 0.1 * box["width"], box["y"] + 0.2 * box["height"])
        page.mouse.down()
        page.mouse.move(box["x"] + 0.25 * box["width"], box["y"] + 0.3 * box["height"], steps=4)
        page.mouse.up()

    page.get_by_test_id("tool-body").click()
    stroke()
    after(page, gen)
    until(page, f"{MISSING}.includes('held by no joint')", 60)
    assert "[bodies.link_1]" in page.evaluate(f"{STATE}.design.toml")
    gen = steps(page)
    page.get_by_test_id("tool-pin").click()
    stroke()
    assert "when Build is off" in page.get_by_test_id("build-words").inner_text() and steps(page) == gen


def test_a_refused_click_is_explained_beside_the_tools(page):
    page.get_by_test_id("tool-drive").click()
    at(page, 0.1, 0.1)
    until(page, "document.querySelector('[data-testid=build-words]').textContent.includes('there is no pin here')", 30)


def test_by_keys_alone(page):
    gen = steps(page)
    page.get_by_test_id("tool-body").press("Enter")
    for key in ("ArrowLeft", "Space", "ArrowUp", "ArrowUp", "ArrowUp", "Space", "Enter"):
        page.keyboard.press(key)
    after(page, gen)
    page.keyboard.press("Escape")
    assert page.get_by_test_id("build").get_attribute("aria-pressed") == "false"
    assert page.evaluate("document.activeElement.dataset.testid") == "build"


def test_only_kinds_with_tools_offer_them(page):
    assert page.get_by_test_id("build").is_visible()
    page.get_by_test_id("new").click()
    page.get_by_test_id("preset-cam-default").click()
    until(page, f"{STATE}.design.kind === 'cam'", 60)
    until(page, "!document.querySelector('[data-testid=build]')?.checkVisibility()", 30)
    assert page.get_by_test_id("build-sheet").is_hidden()
