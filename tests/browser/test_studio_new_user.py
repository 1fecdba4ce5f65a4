"""What a new user stumbled over: another bearing, a design compared, a search watched, a design opened by mistake; in a real browser."""

import pytest
from browsing import until
from studio_running import analysed, drawn, field, shared

pytestmark = [pytest.mark.browser, pytest.mark.needs_browser, pytest.mark.needs_studio]

STATE = "window.drivewright.state"
RADIUS, ROLLER = "follower.prime_radius", "follower.roller_radius"


@pytest.fixture
def opened(browser, studio):
    """Opens an example; afterwards the page must not have complained."""
    contexts, complaints = [], []

    def open_it(name, width=1440, height=900, **settings):
        context = browser.new_context(viewport={"width": width, "height": height}, reduced_motion="reduce", **settings)
        contexts.append(context)
        page = context.new_page()
        page.on("console", lambda said: complaints.append(said.text) if said.type == "error" else None)
        page.on("pageerror", lambda error: complaints.append(str(error)))
        page.goto(shared(studio, name))
        until(page, "window.drivewright !== undefined", 30)
        drawn(page)
        analysed(page)
        return page

    yield open_it
    for context in contexts:
        context.close()
    assert complaints == []


def toml(page):
    return page.evaluate(f"{STATE}.design.toml")


def test_a_bearing_is_chosen_from_the_list_with_ratings_of_its_own(opened):
    page = opened("gearbox_shaft")
    assert 'dynamic_rating = "29.6 kN"' in toml(page)
    page.get_by_test_id("search").fill("bearing designation")
    box = field(page, "bearings.A.bearing").get_by_role("combobox")
    box.click()
    page.get_by_role("option", name="6406 30 × 90 × 23 mm").wait_for()
    box.fill("640")  # half a name is a search, no value that is refused
    page.wait_for_timeout(1000)
    assert page.evaluate(f"Object.keys({STATE}.refused).length") == 0 and 'bearing = "6306"' in toml(page)
    page.get_by_role("option", name="6406").click()
    until(page, f"{STATE}.design.toml.includes('bearing = \"6406\"')")
    assert "dynamic_rating" not in toml(page) and "dynamic rating" in page.evaluate(f"{STATE}.notice")
    page.get_by_test_id("undo").click()
    until(page, f"{STATE}.design.toml.includes('dynamic_rating = \"29.6 kN\"')")
    assert 'bearing = "6306"' in toml(page)


def test_nothing_of_a_list_matches_and_the_form_stands_still(opened):
    page = opened("gearbox_shaft")
    box = field(page, "material.card").get_by_role("combobox")
    box.fill("18cr")
    page.wait_for_timeout(1000)
    assert page.locator(".st-option.is-none").is_visible() and page.get_by_test_id("message-").is_hidden()
    box.fill("34cr")
    box.press("ArrowDown")
    box.press("Enter")
    until(page, f"{STATE}.design.toml.includes('34CrNiMo6')")


def test_torques_that_do_not_balance_say_so_once(opened):
    page = opened("gearbox_shaft")
    box = field(page, "gears.wheel.torque").get_by_role("textbox")
    box.fill("550")
    box.press("Enter")
    page.locator(".vw-note:visible").filter(has_text="the torques do not balance").wait_for(timeout=60_000)
    assert page.locator(".vw-note").inner_text().lower().count("no motion to show") == 1
    assert page.locator("[data-testid^=check-]").count() == 22, "the checks of the last design that had a solution stay, out of date"
    page.get_by_test_id("undo").click()
    analysed(page)
    assert page.evaluate(f"{STATE}.result.checks.every(check => check.ok && !check.stale)")


def test_the_names_of_checks_keep_their_room_beside_what_is_compared(opened):
    page = opened("disc_cam")
    page.get_by_test_id("compare").click()
    box = field(page, RADIUS).get_by_role("textbox")
    box.fill("47.123456 mm")
    box.press("Enter")
    analysed(page)
    until(page, "document.querySelectorAll('.sd-reference:not(:empty)').length > 2")
    wide = page.evaluate("[...document.querySelectorAll('.sd-card .sd-label')].map(made => made.getBoundingClientRect().width)")
    assert min(wide) > 60
    assert page.evaluate("[...document.querySelectorAll('.sd-card')].every(card => card.scrollWidth <= card.clientWidth + 1)")


@pytest.mark.slow
def test_a_search_with_two_objectives_shows_its_trade_off_while_it_runs(opened):
    page = opened("disc_cam")
    page.get_by_test_id("setup-optimise").click()
    for key in (RADIUS, ROLLER):
        page.get_by_test_id(f"search-key-{key}").check()
    page.get_by_test_id("search-value-0").select_option("max_contact_pressure")
    page.get_by_text("Add another").click()
    page.get_by_test_id("search-value-1").select_option("profile.max_radius")
    page.get_by_test_id("search-budget").fill("4000")
    page.get_by_test_id("search-start").click()
    running_front = f"{STATE}.jobs.optimise?.state === 'running' && {STATE}.jobs.optimise.answer?.tried?.fronts.length === 1"
    until(page, running_front, 120)
    until(page, f"{STATE}.view === 'study'")
    assert page.locator(".sc-canvas").is_visible() and page.locator(".sc-key.is-front").is_visible()
    page.get_by_test_id("cancel-optimise").click()  # what was found so far stays, and can be taken
    until(page, f"{STATE}.jobs.optimise.state === 'cancelled'")
    page.locator(".sc-canvas").focus()
    page.keyboard.press("ArrowRight")
    page.keyboard.press("Enter")
    until(page, f"{STATE}.design.gen >= 3")
    analysed(page)
    assert page.evaluate(f"{STATE}.result.checks.every(check => check.ok)")


@pytest.mark.slow
def test_a_cancelled_study_says_how_many_designs_it_has(opened):
    page = opened("disc_cam")
    page.evaluate("window.drivewright.set({view: 'study'})")
    page.get_by_test_id("begin-study").click()  # the empty pane leads to the form
    for key in (RADIUS, ROLLER):
        page.get_by_test_id(f"study-key-{key}").check()
        page.get_by_test_id(f"study-steps-{key}").fill("40")
    page.get_by_test_id("study-start").click()
    until(page, f"{STATE}.jobs.study?.state === 'running' && {STATE}.jobs.study.answer?.rows.length > 2", 60)
    page.get_by_test_id("cancel-study").click()
    until(page, f"{STATE}.jobs.study.state === 'cancelled'")
    words = page.locator(".sd-section[data-name=study]").inner_text()
    assert "undefined" not in words and "of 1600 designs" in words


def test_a_new_design_is_found_by_its_words_and_the_old_one_comes_back(opened):
    page = opened("disc_cam")
    page.get_by_test_id("form").evaluate("made => { made.scrollTop = 900; }")
    box = field(page, "drive.speed").get_by_role("textbox")
    box.fill("500 rpm")
    box.press("Enter")
    until(page, f"{STATE}.design.toml.includes('500 rpm')")
    page.get_by_test_id("new").click()
    page.keyboard.type("gearbox")
    assert page.locator(".st-card:visible").count() == 1
    page.keyboard.press("ArrowDown")
    page.keyboard.press("Enter")
    until(page, f"{STATE}.design.kind === 'shaft'", 60)
    drawn(page)
    assert page.get_by_test_id("form").evaluate("made => made.scrollTop") == 0
    page.get_by_test_id("undo").click()
    until(page, f"{STATE}.design.kind === 'cam' && {STATE}.design.toml.includes('500 rpm')", 60)
    page.get_by_test_id("redo").click()
    until(page, f"{STATE}.design.kind === 'shaft'", 60)


def test_plots_are_as_tall_as_their_pane(opened):
    page = opened("disc_cam")
    edge, area = page.get_by_test_id("plots-edge"), page.locator(".dw-plot-area").first
    before = area.bounding_box()["height"]
    edge.focus()
    edge.press("Home")
    until(page, "document.querySelector('.dw-plot-area').clientHeight > 300")
    for _ in range(12):
        edge.press("Shift+ArrowDown")
    assert area.bounding_box()["height"] < before
