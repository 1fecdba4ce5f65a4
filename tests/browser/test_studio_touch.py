"""Fingers and keys on the studio's page: what is moved, what stays, and what may be reached without a mouse."""

import pytest
from browsing import until
from studio_running import analysed
from studio_states import STATE, address_of

pytestmark = [pytest.mark.browser, pytest.mark.needs_browser, pytest.mark.needs_studio]

KEY = "bodies.coupler.points.C"
TEXT = f"{STATE}.design.form.groups.flatMap(group => group.fields).find(({{key}}) => key === '{KEY}').text"
PLACES = """(() => {
  const scrolled = [document.scrollingElement, ...document.querySelectorAll('.st, .st *')].map(one => one.scrollTop + one.scrollLeft);
  return JSON.stringify([scrolled.filter(Boolean), scrollX, scrollY, visualViewport.scale]); })()"""


@pytest.fixture
def phone(browser, studio):
    """Opens a design on a phone: (page, touch), touch(kind, *places) being what fingers do."""
    contexts = []

    def open_it(spec="four_bar"):
        context = browser.new_context(viewport={"width": 390, "height": 844}, reduced_motion="reduce", has_touch=True, is_mobile=True)
        contexts.append(context)
        page = context.new_page()
        page.goto(address_of(studio, spec))
        until(page, "window.drivewright !== undefined", 30)
        analysed(page)
        session = context.new_cdp_session(page)

        def touch(kind, *places):
            points = [{"x": x, "y": y, "id": finger} for finger, (x, y) in enumerate(places)]
            session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

        return page, touch

    yield open_it
    for context in contexts:
        context.close()


def middle(page, name):
    box = page.get_by_test_id(name).bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def apart(page):
    """Pixels between the ends of the crank, which only a zoom changes."""
    (x1, y1), (x2, y2) = (middle(page, f"handle-{point}") for point in ("ground.points.O2", "bodies.crank.points.A"))
    return ((x2 - x1) ** 2 + (y2 - y1) ** 2) ** 0.5


def test_a_finger_drags_a_handle_and_nothing_scrolls(phone):
    page, touch = phone()
    before, places, wide, (x, y) = page.evaluate(TEXT), page.evaluate(PLACES), apart(page), middle(page, f"handle-{KEY}")
    touch("touchStart", (x, y))
    for step in range(1, 9):
        touch("touchMove", (x + 2 * step, y - 5 * step))
        page.wait_for_timeout(20)
    touch("touchEnd")
    until(page, f"{TEXT} !== {before!r} && {STATE}.scene.gen === {STATE}.design.gen")
    assert page.evaluate(PLACES) == places and apart(page) == pytest.approx(wide, abs=1)
    page.get_by_test_id("undo").click()
    until(page, f"{TEXT} === {before!r}")  # one step


@pytest.mark.parametrize(("second", "step"), [((70, 70), 3), ((12, 8), 1)])  # on the canvas, on the target of the same handle
def test_a_second_finger_zooms_and_takes_the_drag_back(phone, second, step):
    page, touch = phone()
    before, wide, (x, y) = page.evaluate(TEXT), apart(page), middle(page, f"handle-{KEY}")
    other = x + second[0], y + second[1]
    touch("touchStart", (x, y))
    for moves in range(1, 5):
        touch("touchMove", (x - 3 * moves, y - 3 * moves))
        page.wait_for_timeout(30)
    until(page, f"{TEXT} !== {before!r}")
    touch("touchStart", (x - 12, y - 12), other)
    for far in range(step, 9 * step, step):
        touch("touchMove", (x - 12 - far, y - 12 - far), (other[0] + far, other[1] + far))
        page.wait_for_timeout(20)
    touch("touchEnd")
    until(page, f"{TEXT} === {before!r}")
    page.wait_for_timeout(200)
    assert page.evaluate(TEXT) == before and page.get_by_test_id("undo").is_disabled()
    assert apart(page) > 1.25 * wide


def test_a_finger_drags_a_border_of_the_programme_and_the_pane_stays(phone):
    page, touch = phone("cam")
    page.get_by_test_id("pane-mechanism").click()
    page.get_by_test_id("view-programme").click()
    angle = f"{STATE}.design.form.groups.flatMap(group => group.fields).find(({{key}}) => key === 'programme.0.angle').text"
    before, places, (x, y) = page.evaluate(angle), page.evaluate(PLACES), middle(page, "programme-border-1")
    touch("touchStart", (x, y))
    for step in range(1, 7):
        touch("touchMove", (x + 4 * step, y + 3 * step))
        page.wait_for_timeout(20)
    touch("touchEnd")
    until(page, f"{angle} !== {before!r}")
    assert page.evaluate(PLACES) == places


# ------------------------------------------------------------------------------------------------------------------------- keys

STOPS = """() => {
  const seen = one => one.checkVisibility();
  const stops = field => [...field.querySelectorAll('button, input, select')].filter(one => one.tabIndex >= 0 && seen(one));
  return [...document.querySelectorAll('.st-field')].filter(seen).map(field => [field.dataset.key, stops(field).length])
    .filter(([, count]) => count !== 1);
}"""


@pytest.fixture
def desk(open_tab, studio):
    """Opens a design on a wide screen, analysed."""

    def open_it(spec="four_bar"):
        page = open_tab(address_of(studio, spec))
        analysed(page)
        return page

    return open_it


@pytest.mark.parametrize("spec", ["four_bar", "cam", "shaft"])
def test_a_field_is_one_stop(desk, spec):
    page = desk(spec)
    assert page.locator(".st-field").count() > 10
    assert page.evaluate(STOPS) == []


# A key, and two with Shift, faster than the drawing follows.
AT_ONCE = """() => { for (const shiftKey of [false, true, true])
  document.activeElement.dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowRight', shiftKey, bubbles: true})); }"""


def lengths(text):
    return [float(part.split()[0]) for part in text.split(",")]


@pytest.mark.slow
def test_arrow_keys_move_a_handle_and_escape_takes_them_back(desk):
    page = desk()
    before, handle = page.evaluate(TEXT), page.get_by_test_id(f"handle-{KEY}")
    handle.focus()
    page.keyboard.press("ArrowRight")
    until(page, f"{TEXT} !== {before!r}")
    one = lengths(page.evaluate(TEXT))[0] - lengths(before)[0]
    assert one > 0
    page.keyboard.press("Escape")
    until(page, f"{TEXT} === {before!r}")
    page.evaluate(AT_ONCE)
    assert page.locator(".hd-layer > .hd-bubble").inner_text().startswith("coupler · C")
    until(page, f"parseFloat({TEXT}) > {lengths(before)[0] + 20.5 * one}")
    assert lengths(page.evaluate(TEXT))[0] - lengths(before)[0] == pytest.approx(21 * one, rel=0.06)
    page.keyboard.press("Escape")
    until(page, f"{TEXT} === {before!r}")
    assert page.get_by_test_id("undo").is_disabled()
    assert page.evaluate("document.activeElement.dataset.testid") == f"handle-{KEY}"


def test_the_choice_of_plots_and_a_measurement_by_keys_alone(desk):
    page = desk()
    page.get_by_test_id("plot-picker").focus()
    page.keyboard.press("Enter")
    assert page.evaluate("document.activeElement.dataset.testid") == "plot-search"
    page.keyboard.press("Escape")
    assert page.evaluate("document.activeElement.dataset.testid") == "plot-picker" and page.locator(".st-popover").count() == 0
    page.get_by_test_id("measure").focus()
    page.keyboard.press("Enter")
    for feature in ("|handle ground.points.O2", "|handle ground.points.O4"):
        page.get_by_test_id("measure-point").focus()
        page.get_by_test_id("measure-point").select_option(feature)
        page.keyboard.press("Tab")
        page.keyboard.press("Enter")
    assert page.get_by_test_id("measure-value").inner_text() == "120.000\xa0mm"


def test_forms_stay_as_they_are_in_another_language(desk):
    page, radius = desk("cam"), "follower.prime_radius"
    page.get_by_test_id("setup-optimise").click()
    page.get_by_test_id(f"search-key-{radius}").check()
    page.get_by_test_id(f"search-lower-{radius}").fill("31 mm")
    page.get_by_test_id("search-value-0").select_option("profile.max_radius")
    page.get_by_test_id("search-budget").fill("77")
    page.get_by_test_id("setup-study").click()
    page.get_by_test_id(f"study-key-{radius}").check()
    page.get_by_test_id(f"study-way-{radius}").select_option("normal")
    page.get_by_test_id(f"study-tolerance-{radius}").fill("3 %")
    page.get_by_test_id("study-method").select_option("sobol")
    page.get_by_test_id("language").focus()
    page.keyboard.press("Enter")
    until(page, "document.documentElement.lang === 'zh-CN'")
    assert page.evaluate("document.activeElement.dataset.testid") == "language"
    assert page.get_by_test_id(f"search-key-{radius}").is_checked() and page.get_by_test_id(f"study-key-{radius}").is_checked()
    assert page.get_by_test_id(f"search-lower-{radius}").input_value() == "31 mm"
    assert page.get_by_test_id("search-value-0").input_value() == "profile.max_radius"
    assert page.get_by_test_id("search-budget").input_value() == "77"
    assert page.get_by_test_id(f"study-way-{radius}").input_value() == "normal"
    assert page.get_by_test_id(f"study-tolerance-{radius}").input_value() == "3 %"
    assert page.get_by_test_id("study-method").input_value() == "sobol"
    assert page.get_by_test_id("search-start").is_enabled() and page.get_by_test_id("study-start").is_enabled()


def test_what_is_refused_is_told_in_the_language_of_the_page(desk):
    page = desk("cam")
    page.get_by_test_id("language").click()
    box = page.get_by_test_id("field-follower.prime_radius").locator("input").first
    box.fill("3 kg")
    box.press("Enter")
    page.get_by_test_id("message-follower.prime_radius").filter(has_text="应为长度").wait_for()
