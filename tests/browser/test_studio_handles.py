"""Handles on the drawing in a real browser: dragged, taken back, typed, moved by keys and by touch, shown and hidden."""

import pytest
from browsing import until
from studio_running import drawn

pytestmark = [pytest.mark.browser, pytest.mark.needs_browser, pytest.mark.needs_studio]

STATE = "window.drivewright.state"
KEY = "bodies.crank.points.A"
VALUES = f"""key => {STATE}.design.form.groups.flatMap(g => g.fields).find(f => f.key === key).parts.map(p => p.value)"""
START = [40, 0]


@pytest.fixture
def tab(open_tab, studio):
    """Opens tabs whose handles stay where they are."""

    def open_it(motion="reduce", **settings):
        page = open_tab(studio, reduced_motion=motion, **settings)
        page.get_by_test_id(f"handle-{KEY}").wait_for(timeout=90_000)
        until(page, f"{STATE}.result?.full", 400)  # the plots below have their place
        drawn(page)
        return page

    return open_it


def handle(page, key=KEY):
    return page.get_by_test_id(f"handle-{key}")


def middle(page, key=KEY):
    box = handle(page, key).bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def values(page, key=KEY):
    return page.evaluate(VALUES, key)


def grip(page, dx=0, dy=0, key=KEY, steps=8):
    """Press a handle and move it by pixels, the button held."""
    x, y = middle(page, key)
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + dx, y + dy, steps=steps)
    return x + dx, y + dy


def has_moved(page, key=KEY):
    until(page, f"({VALUES})({key!r}).join() !== '40,0'")
    drawn(page)


def test_a_drag_moves_the_point_and_the_drawing(tab):
    page = tab()
    before = page.evaluate(f"{STATE}.scene.scene.motions.join()")
    to = grip(page, 40, -8)
    has_moved(page)
    page.mouse.up()
    drawn(page)
    x, y = values(page)
    scale = 40 / (x - 40)  # px per mm
    assert x > 40 and y == pytest.approx(8 / scale, abs=3 / scale)
    assert page.evaluate(f"{STATE}.scene.scene.motions.join()") != before
    until(page, f"{STATE}.design.undo")
    page.get_by_test_id("undo").click()
    until(page, f"({VALUES})({KEY!r}).join() === '40,0' && !{STATE}.design.undo")
    assert to


def test_the_handle_ends_under_the_hand(tab):
    page = tab()
    page.evaluate("window.drivewright.set({refused: {}})")
    to = grip(page, 30, -20, steps=20)
    has_moved(page)
    page.wait_for_timeout(400)
    x, y = middle(page)
    assert (x, y) == pytest.approx(to, abs=6)  # a step of the grid, or the other point that it snaps to
    page.mouse.up()


def test_escape_takes_a_drag_back(tab):
    page = tab()
    grip(page, 40, -8)
    has_moved(page)
    page.keyboard.press("Escape")
    until(page, f"({VALUES})({KEY!r}).join() === '40,0'")
    assert not page.evaluate(f"{STATE}.design.undo")
    page.mouse.move(900, 500)
    page.mouse.up()
    page.wait_for_timeout(200)
    assert values(page) == START


def test_numbers_can_be_typed(tab):
    page = tab()
    grip(page, 40, -8)
    has_moved(page)
    page.keyboard.type("45, 3 mm")
    page.keyboard.press("Enter")
    page.mouse.up()
    until(page, f"({VALUES})({KEY!r}).join() === '45,3'")
    page.get_by_test_id("undo").click()
    until(page, f"({VALUES})({KEY!r}).join() === '40,0'")


def test_arrow_keys_move_a_handle(tab):
    page = tab()
    handle(page).focus()
    page.keyboard.press("ArrowRight")
    has_moved(page)
    x, y = values(page)
    assert x > 40 and y == 0
    page.keyboard.press("Shift+ArrowUp")
    until(page, f"({VALUES})({KEY!r})[1] > 0")
    assert values(page)[1] > x - 40  # ten times as far


def test_a_handle_that_plays_is_dragged_where_the_motion_begins(tab):
    page = tab(motion="no-preference")
    until(page, "Number(document.querySelector('.vw-player').dataset.phase) > 0.1")
    grip(page, 40, -8)
    has_moved(page)
    page.mouse.up()
    assert page.evaluate("Number(document.querySelector('.vw-player').dataset.phase)") == 0
    assert values(page)[0] > 40


def test_a_finger_drags_too(tab):
    page = tab(has_touch=True)
    page.evaluate(
        """([key]) => {
          const button = document.querySelector(`[data-testid="handle-${key}"]`), box = button.getBoundingClientRect();
          button.setPointerCapture = () => {};  // of a pointer that only these events know
          const tell = (type, dx) => button.dispatchEvent(new PointerEvent(type, {pointerId: 7, pointerType: 'touch',
            isPrimary: true, bubbles: true, cancelable: true, button: 0,
            buttons: 1, clientX: box.x + box.width / 2 + dx, clientY: box.y + box.height / 2}));
          tell('pointerdown', 0); for (let n = 1; n <= 8; n++) tell('pointermove', 5 * n); tell('pointerup', 40); }""",
        [KEY],
    )
    has_moved(page)
    assert values(page)[0] > 40


def test_handles_of_locked_keys_and_hidden_bodies_cannot_be_taken(tab):
    page = tab()
    page.evaluate("key => document.querySelector(`[data-key='${key}'] [aria-pressed]`).click()", KEY)
    until(page, f"{STATE}.design.locks.length > 0")
    assert handle(page).is_disabled() and "locked" in handle(page).get_attribute("title")
    other = "bodies.coupler.points.C"
    assert handle(page, other).is_visible()
    page.locator(".dw-chip", has_text="coupler").click()
    handle(page, other).wait_for(state="hidden")


def test_the_switch_hides_all_handles_and_is_remembered(tab):
    page = tab()
    page.get_by_test_id("handles-switch").click()
    handle(page).wait_for(state="hidden")
    page.reload()
    until(page, "window.drivewright !== undefined", 30)
    drawn(page)
    assert page.locator(".hd:visible").count() == 0
    page.get_by_test_id("handles-switch").click()
    handle(page).wait_for()
