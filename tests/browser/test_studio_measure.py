"""Measuring on the drawing, and drawing the motion of a cam, in a real browser."""

import re

import numpy as np
import pytest
from browsing import until
from studio_running import EXAMPLES, drawn, enter, shared

from drivewright import registry, runner
from drivewright.spec import load

pytestmark = [pytest.mark.browser, pytest.mark.needs_browser, pytest.mark.needs_studio]

TEXTS = "window.drivewright.state.design.form.groups.flatMap(g => g.fields).filter(f => /^programme.*{}$/.test(f.key)).map(f => f.text)"


@pytest.fixture
def tab(browser):
    """Opens tabs, their drawings at rest; afterwards none may have complained."""
    contexts, complaints = [], []

    def open_it(address):
        context = browser.new_context(viewport={"width": 1440, "height": 900}, reduced_motion="reduce")
        contexts.append(context)
        page = context.new_page()
        page.on("console", lambda said: complaints.append(said.text) if said.type == "error" else None)
        page.on("pageerror", lambda error: complaints.append(str(error)))
        page.goto(address)
        until(page, "window.drivewright !== undefined", 30)
        drawn(page)
        return page

    yield open_it
    for context in contexts:
        context.close()
    assert complaints == []


def pick(page, kind, *features):
    page.get_by_test_id(f"measure-{kind}").click()
    for feature in features:
        page.get_by_test_id("measure-point").select_option(feature)
        page.get_by_test_id("measure-pick").click()


def numbers(text):
    return [float(part.replace("−", "-")) for part in re.findall(r"[−\d.]+(?=\xa0mm)", text)]


O2, A, C = "|handle ground.points.O2", "crank|handle bodies.crank.points.A", "coupler|handle bodies.coupler.points.C"


def test_the_crank_is_as_long_as_it_is_and_the_coupler_point_as_high(studio, tab):
    page = tab(studio)
    boxes = [page.get_by_test_id(f"handle-{key}").bounding_box() for key in ("ground.points.O2", "bodies.crank.points.A")]
    page.get_by_test_id("measure").click()
    for box in boxes:  # by the pointer, within a few pixels
        page.mouse.click(box["x"] + box["width"] / 2 + 3, box["y"] + box["height"] / 2 - 2)
    pick(page, "vertical", O2, C)
    values, ends = (page.get_by_test_id(f"measure-{what}") for what in ("value", "ends"))
    assert values.nth(0).inner_text() == "40.000\xa0mm" and ends.nth(0).inner_text() == "constant over the cycle"
    spec = load(EXAMPLES / "four_bar.toml")
    model = runner.build(spec)
    scene = registry.mechanism("linkage").scene(model)
    body = next(each for each in scene.bodies if each.name == "coupler")
    x, y = spec.bodies["coupler"].points["C"]
    height = body.poses[:, 1] + x * np.sin(body.poses[:, 2]) + y * np.cos(body.poses[:, 2])
    low, high = numbers(ends.nth(1).inner_text())
    assert (low, high) == pytest.approx((1e3 * height.min(), 1e3 * height.max()), abs=2e-3)


def test_measurements_follow_the_design_and_are_removed(studio, tab):
    page = tab(studio)
    page.get_by_test_id("measure").click()
    pick(page, "distance", O2, A)
    page.get_by_test_id("measure").click()
    enter(page, "bodies.crank.points.A.0", "36 mm")
    until(page, "document.querySelector('[data-testid=measure-value]').textContent.startsWith('36.000')")
    assert page.locator(".ms-svg text").text_content() == "36.000\xa0mm"
    page.get_by_test_id("measure-drop").click()
    assert page.get_by_test_id("measure-panel").is_hidden()


def test_measurements_end_with_the_drive(studio, tab):
    page = tab(studio)
    page.get_by_test_id("measure").click()
    pick(page, "distance", O2, C)
    page.goto(shared(studio, "disc_cam"))
    page.reload()
    until(page, "window.drivewright?.state.design?.kind === 'cam'", 30)
    drawn(page)
    assert page.get_by_test_id("measure-value").count() == 0


def drag(page, name, dx, dy):
    box = page.get_by_test_id(name).bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    for step in range(1, 7):
        page.mouse.move(x + dx * step / 6, y + dy * step / 6)
    page.mouse.up()


def settled(page, before, what="angle"):
    until(page, f"JSON.stringify({TEXTS.format(what)}) !== {before!r}")
    page.wait_for_timeout(300)  # the last step of the hand
    until(page, "window.drivewright.state.scene.gen === window.drivewright.state.design.gen")
    return page.evaluate(TEXTS.format(what))


def degrees(texts):
    return [float(text.removesuffix(" deg")) for text in texts]


def texts(page, what):
    return page.evaluate(f"JSON.stringify({TEXTS.format(what)})")


def test_a_border_is_dragged_and_the_turn_stays_whole(studio, tab):
    page = tab(shared(studio, "disc_cam"))
    page.get_by_test_id("view-programme").click()
    before = texts(page, "angle")
    drag(page, "programme-border-1", 30, 0)
    angles = degrees(settled(page, before))
    assert angles[0] > 95 and angles[1] < 175 and angles[2] == 90 and sum(angles) == pytest.approx(360)
    assert angles[0] == round(angles[0])
    page.get_by_test_id("undo").click()  # the whole drag
    until(page, f"JSON.stringify({TEXTS.format('angle')}) === {before!r}")
    assert page.get_by_test_id("undo").is_disabled()


def test_a_lift_is_moved_by_the_keyboard_and_the_cycle_closes(studio, tab):
    page = tab(shared(studio, "disc_cam"))
    page.get_by_test_id("view-programme").click()
    before = texts(page, "rise")
    page.get_by_test_id("programme-lift-0").press("ArrowUp")
    up, down, _ = settled(page, before, "rise")
    assert float(up.removesuffix(" mm")) > 20 and down == f"-{up}"


def test_laws_are_chosen_and_their_jumps_told(studio, tab):
    page = tab(shared(studio, "disc_cam"))
    page.get_by_test_id("view-programme").click()
    told = page.get_by_test_id("programme-continuity")
    assert "continuous" in told.inner_text()
    for law, words in (("parabolic", "acceleration jumps at 0°, 45°, 90°"), ("constant-velocity", "velocity jumps at 0°, 90°")):
        page.get_by_test_id("programme-law").select_option(law)
        told.filter(has_text=words).wait_for()
    assert not page.evaluate("Object.keys(window.drivewright.state.refused).length")
    page.get_by_test_id("programme-add").click()
    until(page, f"{TEXTS.format('angle')}.length === 4")
    until(page, "document.querySelector('[data-testid=programme-segment-3]')")
    page.get_by_test_id("programme-drop").click()
    until(page, f"{TEXTS.format('angle')}.length === 3")
    assert sum(degrees(page.evaluate(TEXTS.format("angle")))) == pytest.approx(360)


def test_a_list_is_edited_as_the_design_has_it_where_the_drawing_is_late(studio, tab):
    page = tab(shared(studio, "disc_cam"))
    page.get_by_test_id("view-programme").click()
    page.evaluate("window.before = window.drivewright.state.scene")
    page.get_by_test_id("programme-segment-2").click()
    page.get_by_test_id("programme-law").select_option("cycloidal")  # the dwell
    until(page, f"{TEXTS.format('rise')}[2] !== ''")
    until(page, "window.drivewright.state.scene.gen === window.drivewright.state.design.gen")
    page.evaluate("window.drivewright.set({scene: window.before})")
    assert page.get_by_test_id("programme-border-1").is_disabled()
    page.get_by_test_id("programme-drop").click()
    until(page, f"{TEXTS.format('angle')}.length === 2")
    until(page, "window.drivewright.state.scene.gen === window.drivewright.state.design.gen")
    assert not page.evaluate("Object.keys(window.drivewright.state.refused).length")
    rises = [float(text.removesuffix(" mm")) for text in page.evaluate(TEXTS.format("rise"))]
    assert sum(rises) == pytest.approx(0) and sum(degrees(page.evaluate(TEXTS.format("angle")))) == pytest.approx(360)


def test_a_drive_without_segments_has_no_programme(studio, tab):
    page = tab(studio)
    assert page.get_by_test_id("view-programme").is_hidden()
