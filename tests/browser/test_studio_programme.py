"""The motion programme under a hand: the rod of a seedling pusher, the points of a spline, the rows of a table, in a real browser."""

import json

import pytest
from browsing import until
from studio_running import EXAMPLES, shared

from drivewright.studio.opening import packed

pytestmark = [pytest.mark.browser, pytest.mark.needs_browser, pytest.mark.needs_studio]
FIELD = "window.drivewright.state.design.form.groups.flatMap(group => group.fields).find(({{key}}) => key === {!r})?.text"
CURRENT = "window.drivewright.state.scene.gen === window.drivewright.state.design.gen"
POINTS = "[[0, 0], [0.25, 0.1], [0.5, 0.5], [0.75, 0.9], [1, 1]]"


@pytest.fixture
def tab(open_tab):
    """Opens tabs on the programme of a design."""

    def open_it(address, **more):
        page = open_tab(address, **more)
        page.get_by_test_id("view-programme").click()
        return page

    return open_it


def text(page, key):
    return page.evaluate(FIELD.format(key))


def number(page, key):
    return float(text(page, key).split()[0])


def middle(page, name):
    box = page.get_by_test_id(name).bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def pull(page, name, dx, dy):
    x, y = middle(page, name)
    page.mouse.move(x, y)
    page.mouse.down()
    for step in range(1, 5):
        page.mouse.move(x + dx * step / 4, y + dy * step / 4)
    page.mouse.up()


def changed(page, key, before):
    """The text of a field that a hand has changed, when the design has what it left."""
    until(page, f"{FIELD.format(key)} !== {before!r}")
    until(page, "document.querySelector('[data-testid=programme]').getAttribute('aria-busy') === 'false'")
    until(page, CURRENT)
    return text(page, key)


def points(page, key):
    return json.loads(text(page, key))


def wait_for_count(page, key, count):
    until(page, f"JSON.parse({FIELD.format(key)}).length === {count}")
    until(page, CURRENT)


# -- the rod of a pusher -------------------------------------------------------------------------------------------------------

PUSH = {"push.end": 86, "push.rise": 21, "push.hold": 1, "push.retraction": 36}


def test_borders_and_stroke_of_a_pusher_are_dragged_over_the_carrier_angle(studio, tab):
    page = tab(shared(studio, "seedling_pusher"))

    def numbers():
        return {key: number(page, key) for key in PUSH}

    assert numbers() == PUSH
    pull(page, "programme-border-0", -20, 0)  # the push begins earlier and ends where it did
    changed(page, "push.rise", "21 deg")
    earlier = numbers()
    assert earlier["push.rise"] > 25 and earlier == {**PUSH, "push.rise": earlier["push.rise"]}
    page.get_by_test_id("programme-border-2").press("ArrowRight")  # the hold ends later, the retraction where it did
    changed(page, "push.hold", "1 deg")
    assert numbers() == {**earlier, "push.hold": 2, "push.retraction": 35}
    page.get_by_test_id("programme-border-1").press("ArrowLeft")
    changed(page, "push.end", "86 deg")
    assert numbers() == {**earlier, "push.end": 85, "push.rise": earlier["push.rise"] - 1, "push.hold": 3, "push.retraction": 35}
    pull(page, "programme-lift-0", 0, 60)
    assert 0 < float(changed(page, "push.stroke", "18 mm").split()[0]) < 18
    page.get_by_test_id("programme-law").select_option("parabolic")
    page.get_by_test_id("programme-continuity").filter(has_text="acceleration jumps at").wait_for()
    assert text(page, "push.law") == "parabolic"


def test_a_border_that_the_spec_does_not_state_stands_still_and_says_why(studio, tab):
    page = tab(shared(studio, "seedling_pusher_improved"))
    assert page.get_by_test_id("programme-border-1").count() == 0
    assert "lowest position of the needle tip" in page.get_by_test_id("programme-notes").inner_text()
    before = text(page, "push.rise")
    page.get_by_test_id("programme-border-0").press("ArrowLeft")
    changed(page, "push.rise", before)


# -- points of a spline --------------------------------------------------------------------------------------------------------


def spline(studio):
    given = (EXAMPLES / "disc_cam.toml").read_text(encoding="utf-8")
    law = f'law = "spline"\npoints = {POINTS}'
    return f"{studio}/#" + packed(given.replace('law = "cycloidal"', law, 1))


def on_curve(page, u):
    """A pixel upon the lift at a part of the first segment, which is of 90 degrees: between its neighbours' handles."""
    (x0, y0), (x1, y1) = (middle(page, f"programme-point-0-{k}") for k in (2, 3))
    return x0 + (x1 - x0) * (u - 0.5) / 0.25, y0 + (y1 - y0) * (u - 0.5) / 0.25


def test_points_of_a_spline_come_and_go_by_mouse_and_keys(studio, tab):
    page, key = tab(spline(studio)), "programme.0.points"
    page.mouse.dblclick(*on_curve(page, 0.625))
    wait_for_count(page, key, 6)
    new = points(page, key)[3]
    assert new[0] == pytest.approx(0.625, abs=0.03) and new[1] == pytest.approx(0.72, abs=0.05)
    page.get_by_test_id("undo").click()  # one step
    wait_for_count(page, key, 5)
    assert text(page, key) == POINTS and page.get_by_test_id("undo").is_disabled()
    page.get_by_test_id("programme-point").fill("2")
    page.get_by_test_id("programme-point-add").press("Enter")  # half-way to the third
    wait_for_count(page, key, 6)
    assert points(page, key)[2][0] == pytest.approx(0.375)
    page.get_by_test_id("programme-point-0-2").press("Delete")
    wait_for_count(page, key, 5)
    assert points(page, key) == json.loads(POINTS)
    page.get_by_test_id("programme-point-drop").click()
    wait_for_count(page, key, 4)
    assert [0.5, 0.5] not in points(page, key)


@pytest.mark.slow  # the mouse and the keys do it in the short run
def test_a_finger_adds_a_point_by_a_double_tap(studio, tab):
    page, key = tab(spline(studio), has_touch=True), "programme.0.points"
    for _ in range(2):
        page.touchscreen.tap(*on_curve(page, 0.625))
    wait_for_count(page, key, 6)
    page.wait_for_timeout(300)
    assert len(points(page, key)) == 6  # once


# -- rows of a table -----------------------------------------------------------------------------------------------------------


def test_rows_of_a_file_are_taken_into_the_spec_before_a_hand_moves_them(studio, tab):
    page, key = tab(shared(studio, "disc_cam")), "programme.0.rows"
    page.get_by_test_id("new").click()
    page.get_by_test_id("example-oscillating_cam").click()
    until(page, "window.drivewright.state.design.form.groups.some(({key}) => key === 'conjugate') && " + CURRENT, 60)
    page.get_by_test_id("view-programme").click()
    until(page, "document.querySelector('[data-testid=programme-points]').textContent.includes('61 rows of the file lift.csv')")
    assert page.locator("[data-testid^=programme-point-0-]").count() == 0
    page.get_by_test_id("programme-rows").click()
    until(page, f"({FIELD.format(key)} || '').startsWith('[[')")
    until(page, CURRENT)
    assert text(page, "programme.0.file") == "" and len(points(page, key)) == 61 and points(page, key)[1] == ["6 deg", "0.1655 deg"]
    page.get_by_test_id("programme-point").fill("20")
    given, before = text(page, key), points(page, key)
    pull(page, "programme-point-0-19", 3, -15)
    changed(page, key, given)
    after = points(page, key)
    assert [k for k in range(61) if after[k] != before[k]] == [19] and after[19][0] == "114 deg"
    assert float(after[19][1].split()[0]) > 16.5
    page.mouse.move(*middle(page, "programme-segment-0"))  # of many points those near the hand have a handle
    handles = page.locator("[data-testid^=programme-point-0-]")
    assert 2 <= handles.count() <= 8
