"""The studio by keyboard and by eye: one stop a field, names, contrast; undo, verdict, lists, names of parts, and what sharing says."""

import json
import re

import pytest
from browsing import until
from studio_running import EXAMPLES, analysed, drawn, enter, field

from drivewright.studio.opening import packed

pytestmark = [pytest.mark.browser, pytest.mark.needs_browser, pytest.mark.needs_studio]

STATE = "window.drivewright.state"
KEY = "bodies.crank.points.A.0"
NAMELESS = """() => [...document.querySelectorAll('button, input, select, textarea, [role=tab], [tabindex]')]
  .filter(one => one.checkVisibility() && !one.matches('[type=file], .sd-scroll'))
  .filter(one => !(one.getAttribute('aria-label') || one.getAttribute('aria-labelledby') || one.textContent.trim() || one.title))
  .map(one => one.outerHTML.slice(0, 120))"""
STOPS = """() => [...document.querySelectorAll('.st-field')].filter(one => one.checkVisibility()).map(one =>
  [one.dataset.key, [...one.querySelectorAll('button, input, select')].filter(stop => stop.tabIndex >= 0 && stop.checkVisibility()).length])
  .filter(([, stops]) => stops !== 1)"""
# Texts below the contrast that WCAG AA asks for, with the colours as they are mixed; what is disabled or overtaken is excepted there.
FAINT = """() => {
  const pixel = document.createElement('canvas').getContext('2d', {willReadFrequently: true});
  const rgba = text => {
    pixel.clearRect(0, 0, 1, 1); pixel.fillStyle = '#0000'; pixel.fillStyle = text; pixel.fillRect(0, 0, 1, 1);
    const [r, g, b, a] = pixel.getImageData(0, 0, 1, 1).data;
    return [r, g, b, a / 255];
  };
  const over = ([r, g, b, a], under) => [r, g, b].map((c, n) => c * a + under[n] * (1 - a));
  const channel = c => c / 255 <= .03928 ? c / 255 / 12.92 : ((c / 255 + .055) / 1.055) ** 2.4;
  const luminance = ([r, g, b]) => .2126 * channel(r) + .7152 * channel(g) + .0722 * channel(b);
  const found = new Set(), boxes = 'input:not([type=range], [type=checkbox], [type=file]), select, textarea';
  for (const node of document.querySelectorAll('.st *')) {
    const words = [...node.childNodes].some(one => one.nodeType === 3 && one.data.trim()) || node.matches(boxes);
    if (!words || !node.checkVisibility({visibilityProperty: true, opacityProperty: true}) || !node.getClientRects().length) continue;
    if (node.matches('.is-stale *, .is-old *, .sd-state, option, :disabled, :disabled *')) continue;
    let under = [255, 255, 255], shown = 1;
    for (const one of [...function* () { for (let up = node; up; up = up.parentElement) yield up; }()].reverse()) {
      shown *= Number(getComputedStyle(one).opacity);
      under = over(rgba(getComputedStyle(one).backgroundColor), under);
    }
    const [r, g, b, a] = rgba(getComputedStyle(node).color), text = over([r, g, b, a * shown], under);
    const [dim, bright] = [luminance(text), luminance(under)].sort((one, other) => one - other), ratio = (bright + .05) / (dim + .05);
    if (ratio < 4.5) found.add(`${node.className || node.tagName}: ${ratio.toFixed(2)} "${(node.textContent || node.value).slice(0, 20)}"`);
  }
  return [...found];
}"""


@pytest.fixture
def tab(browser):
    """Opens a tab, its drawing at rest."""
    contexts = []

    def open_it(studio, lang="en", theme="light", width=1440):
        settings = {"viewport": {"width": width, "height": 900}, "reduced_motion": "reduce", "accept_downloads": True}
        context = browser.new_context(**settings, has_touch=width < 900)
        contexts.append(context)
        page = context.new_page()
        page.goto(studio)
        until(page, "window.drivewright !== undefined", 30)
        page.evaluate("news => window.drivewright.set(news)", {"lang": lang, "theme": theme})
        drawn(page)
        return page

    yield open_it
    for context in contexts:
        context.close()


def _box(page, key):
    return field(page, key).locator("input, select").first


def _becomes(page, key, text):
    until(page, f"document.querySelector('[data-testid=\"field-{key}\"] input').value === {json.dumps(text)}")


@pytest.mark.parametrize("theme", [pytest.param("light", marks=pytest.mark.slow), "dark"])
@pytest.mark.parametrize("width", [390, 1440])
def test_texts_have_contrast_and_controls_have_names(studio, tab, theme, width):
    page = tab(studio, theme=theme, width=width)
    analysed(page)
    for pane in ("form", "mechanism", "checks", "plots") if width < 900 else ("",):
        if pane:
            page.get_by_test_id(f"pane-{pane}").click()
        assert page.evaluate(FAINT) == []
        assert page.evaluate(NAMELESS) == []
        assert page.evaluate(STOPS) == []
    if width > 900:
        enter(page, "drive.speed", "3 kg")
        page.get_by_test_id("message-drive.speed").wait_for()
        page.get_by_test_id("new").click()
        assert page.evaluate(FAINT) == []
        page.keyboard.press("Escape")
        assert page.locator(".st-popover").count() == 0
        assert page.evaluate("document.activeElement.dataset.testid") == "new"


def test_a_field_is_one_stop_and_its_keys_lock_and_reset_it(studio, tab):
    page = tab(studio)
    _box(page, "bodies.crank.mass").focus()
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.closest('.st-field').dataset.key") == "bodies.crank.inertia"
    assert _box(page, "bodies.crank.inertia").input_value() == "3e-5 kg·m²"
    page.keyboard.press("Alt+l")
    until(page, f"{STATE}.design.locks.includes('bodies.crank.inertia')")
    page.keyboard.press("Alt+l")
    until(page, f"{STATE}.design.locks.length === 0")
    box = _box(page, "bodies.crank.inertia")
    box.press("ArrowUp")
    until(page, f"{STATE}.design.undo && {STATE}.design.toml.includes('kg m^2')")
    _box(page, "gravity.1").focus()
    page.keyboard.press("Alt+r")
    _becomes(page, "gravity.1", "0 m/s²")


def test_each_typed_edit_is_one_step_and_a_drag_is_one(studio, tab):
    page = tab(studio)
    for text in ("41 mm", "42 mm"):
        enter(page, KEY, text)
        _until_text(page, text)
    for text in ("43 mm", "44 mm"):  # without Enter: sent after a pause
        _box(page, KEY).fill(text)
        _until_text(page, text)
    for text in ("43 mm", "42 mm", "41 mm", "40 mm"):
        page.get_by_test_id("undo").click()
        _becomes(page, KEY, text)
    slider = page.get_by_test_id(f"slider-{KEY}")
    slider.scroll_into_view_if_needed()
    place = slider.bounding_box()
    x, y = place["x"] + place["width"] / 2, place["y"] + place["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    for step in range(1, 9):
        page.mouse.move(x + 3 * step, y)
        page.wait_for_timeout(30)
    page.mouse.up()
    until(page, f"{STATE}.design.undo && {STATE}.design.redo === false")
    page.get_by_test_id("undo").click()
    _becomes(page, KEY, "40 mm")
    assert not page.evaluate(f"{STATE}.design.undo")


def _until_text(page, text):
    part = f"{STATE}.design.form.groups.flatMap(group => group.fields).flatMap(one => one.parts || []).find(one => one.key === '{KEY}')"
    until(page, f"{part}.text === '{text}'")


def test_the_verdict_says_that_it_is_being_computed(studio, tab):
    page = tab(studio)
    analysed(page)
    before = page.get_by_test_id("verdict").inner_text()
    assert "pass" in before
    page.evaluate(
        """() => { window.said = []; const pill = document.querySelector('[data-testid=verdict]');
        new MutationObserver(() => window.said.push([pill.textContent, document.querySelector('.sd-before').textContent]))
          .observe(pill.parentElement, {subtree: true, childList: true, characterData: true}); }"""
    )
    enter(page, KEY, "39 mm")
    until(page, f"{STATE}.design.gen > 1")
    analysed(page)
    assert ["computing …", before] in page.evaluate("window.said")
    until(page, "document.querySelector('[data-testid=verdict]').textContent.includes('pass')")
    assert page.locator(".sd-before").inner_text() == ""


def test_the_section_that_was_asked_for_is_marked(studio, tab):
    page = tab(studio)
    analysed(page)
    for name in ("Numbers", "Optimise", "Sensitivity", "Study", "Checks"):
        page.locator(".sd-jumps button", has_text=name).click()
        page.wait_for_timeout(100)
        assert page.locator(".sd-jumps button[aria-current=true]").inner_text() == name


def test_sharing_says_where_the_address_works_and_offers_the_file(studio, tab):
    page = tab(studio)
    page.get_by_test_id("share").click()
    assert "on this machine only" in page.get_by_test_id("share-hint").inner_text()
    with page.expect_download() as download:
        page.get_by_test_id("share-file").click()
    assert download.value.suggested_filename.endswith(".toml")


def test_a_material_is_searched_in_a_list(studio, tab):
    spec = (EXAMPLES / "disc_cam.toml").read_text(encoding="utf-8")
    page = tab(f"{studio}/#{packed(spec)}")
    box = _box(page, "material")
    box.click()
    assert page.locator(".st-option").count() > 10
    box.fill("")
    box.press_sequentially("c4")
    assert page.locator(".st-option").all_inner_texts() == ["C45", "C45+N"]
    box.press("Escape")
    assert page.locator(".st-option").count() == 0
    box.press_sequentially("5")
    box.press("ArrowDown")
    assert box.get_attribute("aria-activedescendant")
    box.press("Enter")
    until(page, f"{STATE}.design.toml.includes('material = \"C45\"')")
    page.get_by_test_id("dock-drawing").click()
    until(page, "[...document.querySelectorAll('.st-dock img')].some(image => image.complete && image.naturalWidth > 300)")


def test_a_pdf_is_written_of_a_design_that_fails(studio, tab):
    spec = re.sub(r'prime_radius = "[^"]*"', 'prime_radius = "22 mm"', (EXAMPLES / "disc_cam.toml").read_text(encoding="utf-8"))
    page = tab(f"{studio}/#{packed(spec)}")
    analysed(page)
    assert "fail" in page.get_by_test_id("verdict").inner_text()
    with page.expect_download(timeout=120_000) as download:
        page.get_by_test_id("export-pdf").click()
    assert download.value.suggested_filename.endswith(".pdf")


def test_parts_of_pairs_and_the_title_are_said_in_both_languages(studio, tab):
    spec = (EXAMPLES / "hyvo_chain.toml").read_text(encoding="utf-8")
    page = tab(f"{studio}/#{packed(spec)}")
    assert field(page, "teeth").locator(".st-pair-parts .st-name").all_inner_texts() == ["driving", "driven"]
    title = _box(page, "title").input_value()
    page.evaluate("window.drivewright.set({lang: 'zh'})")
    until(page, "document.documentElement.lang === 'zh-CN'")
    assert all(not re.search("[a-z]", text) for text in field(page, "teeth").locator(".st-pair-parts .st-name").all_inner_texts())
    assert re.search("[一-鿿]", _box(page, "title").input_value())
    _box(page, "title").press("Enter")
    assert page.evaluate(f"{STATE}.design.title") == title
    assert not page.evaluate(f"{STATE}.design.undo")
