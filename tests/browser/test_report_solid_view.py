"""Solids in a report in a real browser: they move with the report's clock, turn, are cut and pulled apart; paper gets a picture."""

import numpy as np
import pytest
from browsing import until
from sample_designs import all_views, four_bar_result
from sample_solids import SOLIDS

from drivewright.report.html import MODULES, SOLID_MODULES, scripts

pytestmark = [pytest.mark.browser, pytest.mark.needs_browser]
STAGE = "document.querySelector('#solids-view .so-stage')"
INK = """() => {
  const c = document.querySelector('.so-canvas'), slider = document.querySelector('[data-testid=solid-explode]');
  const copy = document.createElement('canvas');
  const frame = () => new Promise(requestAnimationFrame);
  Object.assign(copy, {width: c.width, height: c.height});
  return (async () => {
    for (let n = 0; n < 3; n++) { slider.dispatchEvent(new Event('input')); await frame(); }
    const g = copy.getContext('2d');
    g.drawImage(c, 0, 0);
    const d = g.getImageData(0, 0, c.width, c.height).data;
    let count = 0, x = 0;
    for (let i = 0; i < d.length; i += 4) {
      if ([0, 1, 2].reduce((sum, k) => sum + Math.abs(d[i + k] - d[k]), 0) > 40) { count++; x += i / 4 % c.width; }
    }
    return [count, x / count];
  })();
}"""


@pytest.fixture(scope="module")
def address(tmp_path_factory):
    from drivewright.report.content import Views, pictures
    from drivewright.report.html import write_report

    result, seen = four_bar_result(), all_views()._replace(solids=SOLIDS)
    return write_report(result, seen, tmp_path_factory.mktemp("solids"), pictures(result, Views(solids=SOLIDS))).as_uri()


def test_solids_move_with_the_clock_of_the_report(open_page, address):
    page = open_page(address)
    if not page.evaluate("Boolean(document.createElement('canvas').getContext('webgl2'))"):
        pytest.skip("this browser has no WebGL 2")
    page.evaluate("document.querySelector('#solids').scrollIntoView()")
    until(page, f"Number({STAGE}.dataset.drawn) > 2")
    page.evaluate("drivewright.clock.pause(); drivewright.clock.set(0)")
    count, left = page.evaluate(INK)
    page.evaluate("drivewright.clock.set(0.5)")  # the crank points the other way
    moved, there = page.evaluate(INK)
    assert count > 1000 and moved > 1000 and there < left - 5
    assert page.get_by_test_id("solid-scrub").input_value() == "0.5"
    page.get_by_test_id("solid-cut").select_option("2")
    assert page.get_by_test_id("solid-cut-depth").is_visible()
    cut, _ = page.evaluate(INK)
    assert 0 < cut < moved
    page.locator(".so-legend .dw-chip", has_text="crank").click()
    assert page.evaluate(INK)[0] < cut


def test_the_pointer_names_parts_and_the_cube_is_reached_by_keys(open_page, address):
    page = open_page(address)
    if not page.evaluate("Boolean(document.createElement('canvas').getContext('webgl2'))"):
        pytest.skip("this browser has no WebGL 2")
    page.evaluate("document.querySelector('#solids').scrollIntoView()")
    until(page, f"Number({STAGE}.dataset.drawn) > 2")
    page.evaluate("drivewright.clock.pause(); drivewright.clock.set(0)")
    tip, canvas, named = page.get_by_test_id("solid-name"), page.locator(".so-canvas"), set()
    box = canvas.bounding_box()
    for across in range(2, 19):
        for down in range(3, 18):
            page.mouse.move(box["x"] + box["width"] * across / 20, box["y"] + box["height"] * down / 20)
            named |= {tip.inner_text()} if tip.is_visible() else set()
    assert {"crank", "coupler"} <= named <= {"crank", "coupler", "frame"}
    page.mouse.move(box["x"] + 4, box["y"] + box["height"] - 4)
    assert not tip.is_visible()

    front = page.get_by_test_id("cube-front")
    front.focus()
    page.keyboard.press("Enter")
    assert page.locator(".so-tools button", has_text="Front").get_attribute("aria-pressed") == "true"
    page.keyboard.press("ArrowRight")
    assert page.evaluate("document.activeElement.dataset.testid") == "cube-back"
    for _ in range(3):
        page.keyboard.press("ArrowRight")
    assert page.evaluate("document.activeElement.dataset.testid") == "cube-top"
    assert page.locator(".so-tools button", has_text="Top").get_attribute("aria-pressed") == "true"
    assert page.evaluate("document.querySelectorAll('.so-face[tabindex=\"0\"]').length") == 1


def test_paper_gets_the_picture_and_not_the_viewer(open_page, address):
    page = open_page(address)
    image = page.locator("#figures img[alt='Solids of the assembly']")
    page.emulate_media(media="print")
    assert not page.locator("#solids-view").is_visible()
    page.locator("#figures").evaluate("details => { details.open = true; }")
    assert image.is_visible() and image.evaluate("image => image.naturalWidth") > 200


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_the_ground_is_that_of_the_theme(open_page, address, theme):
    page = open_page(address, color_scheme=theme)
    page.evaluate("document.querySelector('#solids').scrollIntoView()")
    canvas = page.evaluate("getComputedStyle(document.querySelector('#solids-view .so-stage')).backgroundColor")
    assert (sum(map(int, canvas.strip("rgba()").split(",")[:3])) > 380) == (theme == "light")


def test_a_turn_about_a_line_in_space_is_that_of_rodrigues(browser):
    """As the page computes it: points of a part turned by an angle about a line, and pulled out."""
    page = browser.new_page()
    page.set_content(f"<script type='module'>{scripts((*MODULES, *SOLID_MODULES))}\nwindow.turned = turnMatrix;</script>")
    until(page, "window.turned !== undefined")
    point, direction, angle, pull = np.array([0.08, 0.01, -0.02]), np.array([0.3, 0.9, -0.2]), 1.1, np.array([0.0, 0.002, 0.01])
    found = page.evaluate(
        "([point, direction, angle, pull]) => [...turned({point, direction}, angle, pull)]",
        [point.tolist(), direction.tolist(), angle, pull.tolist()],
    )
    page.close()
    matrix = np.array(found).reshape(4, 4).T
    at, k = np.array([0.03, -0.04, 0.05]), direction / np.linalg.norm(direction)
    arm = at - point
    wanted = point + arm * np.cos(angle) + np.cross(k, arm) * np.sin(angle) + k * (k @ arm) * (1 - np.cos(angle)) + pull
    assert np.allclose(matrix[:3, :3] @ at + matrix[:3, 3], wanted, atol=1e-7)


PACES = """([first, then]) => {
  const pace = window.pacing(() => {}), seen = [];
  let now = 1000;
  for (const gap of [...Array(25).fill(first), ...Array(25).fill(then), 500, then]) { now += gap; seen.push(pace.smooth(now)); }
  pace.stop();
  return [pace.mode, seen];
}"""


@pytest.mark.parametrize(
    "first, then, mode",
    [(12, 12, "smooth"), (40, 12, "quick"), (40, 38, "settled")],
    ids=["a machine that keeps up", "a slow one that gains", "a slow one that does not"],
)
def test_moving_solids_are_smoothed_while_the_machine_keeps_up(browser, first, then, mode):
    page = browser.new_page()
    page.set_content(f"<script type='module'>{scripts((*MODULES, *SOLID_MODULES))}\nwindow.pacing = createPacing;</script>")
    until(page, "window.pacing !== undefined")
    found, seen = page.evaluate(PACES, [first, then])
    page.close()
    assert found == mode and all(seen[:20]) and all(seen[20:24]) == (mode == "smooth")
    assert seen[50] and seen[51] == (mode != "quick")  # after rest the first drawing is smooth
