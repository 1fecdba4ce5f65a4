"""Nothing on a report overlaps or is cut, from a phone to a wide screen and on paper."""

from pathlib import Path

import pytest
from places import ROOT

pytestmark = [pytest.mark.browser, pytest.mark.needs_browser]

WIDTHS = (390, 820, 1280, 1920)
EXAMPLES = ("disc_cam", "pin_indexer", "gearbox_shaft")  # quick ones, of three kinds: player, failed checks, matrices
# Every text on the page, as far as the boxes around it show it: [what is wrong, its text].  A box that scrolls may hide some of it.
MEASURE = """() => {
  const found = [], boxes = [], walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  const moves = value => ["auto", "scroll"].includes(value), wide = document.documentElement.scrollWidth;
  if (wide > innerWidth + 1) found.push(["page wider than the window", `${wide} > ${innerWidth}`]);

  function seen(rect, owner, text) {  // what the boxes around a text leave of it
    let box = rect, scrolls = false;
    for (let around = owner; around; around = around.parentElement) {
      const style = getComputedStyle(around), edge = around.getBoundingClientRect();
      if (style.display === "inline" || style.overflowX === "visible") continue;
      scrolls ||= moves(style.overflowX) || moves(style.overflowY) || around === document.documentElement;
      if (!scrolls && (box.right > edge.right + 1 || box.left < edge.left - 1)) found.push(["cut", text]);
      if (!scrolls && box.bottom > edge.bottom + 2) found.push(["cut below", text]);
      box = {left: Math.max(box.left, edge.left), right: Math.min(box.right, edge.right),
        top: Math.max(box.top, edge.top), bottom: Math.min(box.bottom, edge.bottom)};
    }
    if (!scrolls && (box.right > innerWidth + 1 || box.left < -1)) found.push(["outside the window", text]);
    return box;
  }

  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const text = node.nodeValue.trim(), owner = node.parentElement, range = document.createRange();
    if (!text || owner.closest("script, style, noscript, option") || getComputedStyle(owner).visibility === "hidden") continue;
    range.selectNodeContents(node);
    for (const {left, top, right, bottom} of range.getClientRects()) {
      if (right - left < 1 || bottom - top < 1) continue;
      const box = seen({left, top, right, bottom}, owner, text);
      if (box.right - box.left > 1 && box.bottom - box.top > 1) boxes.push({...box, text, owner});
    }
  }
  boxes.sort((a, b) => a.top - b.top);
  boxes.forEach((one, n) => {
    for (let k = n + 1; k < boxes.length && boxes[k].top < one.bottom - 2; k++) {
      const other = boxes[k], across = Math.min(one.right, other.right) - Math.max(one.left, other.left);
      const small = Math.min(one.bottom - one.top, other.bottom - other.top), down = Math.min(one.bottom, other.bottom) - other.top;
      if (across > 1.5 && down > Math.max(3, 0.3 * small) && one.owner !== other.owner)
        found.push(["overlap", `${one.text} | ${other.text}`]);
    }
  });
  const holdsScroller = box => [...box.querySelectorAll("*")].some(inner => moves(getComputedStyle(inner).overflowX));
  for (const box of document.querySelectorAll("main *, header *")) {
    const style = getComputedStyle(box), text = box.textContent.trim();
    if (!text || !box.clientWidth || box.scrollWidth <= box.clientWidth + 1 || style.display === "inline") continue;
    if (moves(style.overflowX) || box.tagName === "SELECT" || box.closest("svg") || holdsScroller(box)) continue;
    found.push(["wider than its box", `${box.className} ${text.slice(0, 60)}`]);
  }
  return found;
}"""


def faults(page):
    """What is wrong at the page's present width, all of it open."""
    page.evaluate("() => { window.drivewright?.clock.pause(); document.querySelectorAll('details').forEach(box => { box.open = true; }); }")
    page.wait_for_timeout(150)
    return [tuple(each) for each in page.evaluate(MEASURE)]


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """Address of the report of an example, written once."""
    from drivewright import runner
    from drivewright.report.content import views
    from drivewright.report.folder import write_run_folder
    from drivewright.report.form import report_form
    from drivewright.spec import load

    folder, known = tmp_path_factory.mktemp("reports"), {}

    def make(name, detail="normal", language="en"):
        key = (name, detail, language)
        if key not in known:
            spec = load(Path(ROOT) / "examples" / f"{name}.toml")
            model = runner.build(spec)
            result = runner.run(spec, model=model)
            out = write_run_folder(result, folder / "-".join(key), seen=views(result, model), form=report_form(detail, language))
            known[key] = (out / "report.html").as_uri()
        return known[key]

    return make


@pytest.mark.parametrize("name", EXAMPLES)
def test_nothing_overlaps_or_is_cut(open_page, written, name):
    page = open_page(written(name), width=WIDTHS[0], height=900)
    found = {}
    for width in WIDTHS:
        page.set_viewport_size({"width": width, "height": 900})
        found[width] = faults(page)
    page.set_viewport_size({"width": 794, "height": 1123})  # A4 at 96 dots per inch
    page.emulate_media(media="print")
    found["print"] = faults(page)
    assert {where: what for where, what in found.items() if what} == {}


@pytest.mark.slow
@pytest.mark.parametrize(("detail", "language"), [("short", "en"), ("full", "zh")])
def test_neither_in_another_form_or_language(open_page, written, detail, language):
    page = open_page(written("pin_indexer", detail, language), width=WIDTHS[0], height=900)
    for width in WIDTHS:
        page.set_viewport_size({"width": width, "height": 900})
        assert faults(page) == [], width


def test_the_measure_finds_what_is_wrong(open_page, written):
    page = open_page(written("disc_cam"), width=820, height=900)
    assert faults(page) == []
    page.add_style_tag(content=".tile-name { white-space: nowrap; width: 30px; overflow: hidden } .check-limit { margin-top: -14px }")
    assert {what for what, _ in faults(page)} >= {"cut", "overlap", "wider than its box"}
