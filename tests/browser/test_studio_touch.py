"""Fingers and keys on the studio's page: what is moved, what stays, and what may be reached without a mouse."""

import pytest
from browsing import until
from studio_running import EXAMPLES, analysed, own_port, running
from studio_states import STATE, address_of

pytestmark = [pytest.mark.browser, pytest.mark.needs_browser, pytest.mark.needs_studio]

KEY = "bodies.coupler.points.C"
TEXT = f"{STATE}.design.form.groups.flatMap(group => group.fields).find(({{key}}) => key === '{KEY}').text"
PLACES = """(() => {
  const scrolled = [document.scrollingElement, ...document.querySelectorAll('.st, .st *')].map(one => one.scrollTop + one.scrollLeft);
  return JSON.stringify([scrolled.filter(Boolean), scrollX, scrollY, visualViewport.scale]); })()"""


@pytest.fixture(scope="module")
def address():
    with running(own_port(8540), EXAMPLES / "four_bar.toml") as (address, _):
        yield address


@pytest.fixture
def phone(browser, address):
    """Opens a design on a phone: (page, touch), touch(kind, *places) being what fingers do."""
    contexts = []

    def open_it(spec="four_bar"):
        context = browser.new_context(viewport={"width": 390, "height": 844}, reduced_motion="reduce", has_touch=True, is_mobile=True)
        contexts.append(context)
        page = context.new_page()
        page.goto(address_of(address, spec))
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
