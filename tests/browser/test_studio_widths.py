"""The studio on a phone, a tablet and a desk: every control can be reached, and nothing lies over anything else."""

import pytest
from browsing import until
from studio_running import analysed, shared

pytestmark = [pytest.mark.browser, pytest.mark.needs_browser, pytest.mark.needs_studio]

SIZES = {390: 844, 820: 1180, 1024: 700, 1280: 800, 1440: 900}
PANES = ("form", "mechanism", "checks", "plots")
# Handles lie where the points of the drawing are, which may be at one place.
HIDDEN = """() => {
  const wanted = 'button, input, select, textarea, summary, a[href], [tabindex]', missed = [];
  const name = node => node.dataset?.testid || node.className || node.tagName;
  const rendered = node => node.checkVisibility({visibilityProperty: true}) && node.getClientRects().length > 0;
  for (const node of document.querySelectorAll(wanted)) {
    if (!rendered(node) || node.disabled || node.matches('.hd, .dw-canvas, .sd-scroll, [type=file]')) continue;
    node.scrollIntoView({block: 'center', inline: 'center', behavior: 'instant'});
    const box = node.getBoundingClientRect(), x = box.x + box.width / 2, y = box.y + box.height / 2;
    const hit = document.elementFromPoint(x, y);
    if (!hit || !(node === hit || node.contains(hit) || (node.matches('.dw-canvas') && hit.matches('.hd'))))
      missed.push(`${name(node)} under ${hit && name(hit)} at ${x | 0},${y | 0}`);
  }
  return missed;
}"""
OVERLAPS = """() => {
  const places = [...document.querySelectorAll('.st > *')].filter(one => one.checkVisibility()), found = [];
  const boxes = places.map(one => one.getBoundingClientRect());
  boxes.forEach((a, n) => boxes.slice(n + 1).forEach((b, m) => {
    const wide = Math.min(a.right, b.right) - Math.max(a.left, b.left), high = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
    if (wide > 1 && high > 1) found.push(`${places[n].className} and ${places[n + 1 + m].className}`);
  }));
  const scrolling = '.st-bar, .st-panes, .st-scroll, .sd-scroll, .st-plots, .sd-exports, .dw-bar, .vw-tabs';
  for (const one of [document.scrollingElement, ...document.querySelectorAll(scrolling)])
    if (one.scrollWidth > one.clientWidth + 1) found.push(`${one.className || one.tagName} is ${one.scrollWidth} in ${one.clientWidth}`);
  const leaves = box => box.right > innerWidth + 1 || box.bottom > innerHeight + 1;
  boxes.forEach((box, n) => { if (leaves(box)) found.push(`${places[n].className} leaves the screen`); });
  return found;
}"""


@pytest.fixture
def tab(browser):
    """Opens a tab at a width, in a language."""
    contexts = []

    def open_it(studio, width, lang="en"):
        context = browser.new_context(viewport={"width": width, "height": SIZES[width]}, reduced_motion="reduce", has_touch=width < 900)
        contexts.append(context)
        page = context.new_page()
        page.goto(studio)
        until(page, "window.drivewright !== undefined", 30)
        analysed(page)
        page.evaluate("lang => window.drivewright.set({lang})", lang)
        return page

    yield open_it
    for context in contexts:
        context.close()


def _look(page):
    return page.evaluate(OVERLAPS) + page.evaluate(HIDDEN)


@pytest.mark.parametrize("lang", ["en", pytest.param("zh", marks=pytest.mark.slow)])
@pytest.mark.parametrize("width", SIZES)
def test_every_control_can_be_reached_and_nothing_lies_over_another(studio, tab, width, lang):
    page = tab(studio, width, lang)
    if width >= 900:
        assert not page.get_by_test_id("pane-form").is_visible()
        assert _look(page) == []
        return
    for pane in PANES:
        page.get_by_test_id(f"pane-{pane}").click()
        assert page.get_by_test_id(f"pane-{pane}").get_attribute("aria-selected") == "true"
        assert _look(page) == []
    page.get_by_test_id("more").click()
    assert page.get_by_test_id("report").is_visible()
    assert page.get_by_test_id("language").is_visible()
    assert (
        page.evaluate(
            HIDDEN.replace("querySelectorAll(wanted)", "querySelectorAll(wanted.split(', ').map(one => `.st-bar ${one}`).join())")
        )
        == []
    )
    page.keyboard.press("Escape")
    assert not page.get_by_test_id("report").is_visible()
    assert page.evaluate("document.activeElement.dataset.testid") == "more"


def test_a_phone_shows_one_part_and_a_tablet_two(studio, tab):
    phone, tablet = tab(studio, 390), tab(studio, 820)
    for page, beside in ((phone, False), (tablet, True)):
        page.get_by_test_id("pane-checks").click()
        assert page.get_by_test_id("verdict").is_visible()
        assert page.get_by_test_id("player").is_visible() is beside
        page.get_by_test_id("pane-mechanism").click()
        assert not page.get_by_test_id("verdict").is_visible()
        page.get_by_test_id("pane-mechanism").press("ArrowLeft")
        assert page.evaluate("document.activeElement.dataset.testid") == "pane-form"
        assert page.get_by_test_id("form").is_visible()


def test_a_drive_of_another_kind_fits_a_phone_too(studio, tab):
    page = tab(shared(studio, "pressure_roller_shaft"), 390)
    for pane in PANES:
        if page.get_by_test_id(f"pane-{pane}").is_enabled():
            page.get_by_test_id(f"pane-{pane}").click()
            assert _look(page) == []
