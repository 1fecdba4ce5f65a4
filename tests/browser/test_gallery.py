"""The gallery in a real browser: filters, pictures that move under the pointer, text to copy."""

import pytest
from browsing import until

from drivewright.report.gallery import write_gallery
from drivewright.report.worked_examples import cards

pytestmark = [pytest.mark.browser, pytest.mark.needs_browser]

SHOWN = "[...document.querySelectorAll('.ex-card:not([hidden])')].map(card => card.id.slice(8)).sort()"


@pytest.fixture(scope="module")
def gallery(tmp_path_factory):
    return write_gallery(tmp_path_factory.mktemp("gallery") / "index.html").as_uri()


def _wanted(kinds=(), questions=()):
    return sorted(card.name for card in cards() if (not kinds or card.kind in kinds) and set(questions) <= set(card.questions))


def _pick(page, *values):
    for value in values:
        page.check(f"input[value={value}]", force=True)


def test_filters_by_kind_and_by_question(open_page, gallery):
    page = open_page(gallery)
    assert page.evaluate(SHOWN) == _wanted()
    _pick(page, "cam")
    assert page.evaluate(SHOWN) == _wanted(["cam"]) != _wanted()
    _pick(page, "shaft", "vibration")
    assert page.evaluate(SHOWN) == _wanted(["cam", "shaft"], ["vibration"])
    page.reload()
    assert page.evaluate(SHOWN) == _wanted(["cam", "shaft"], ["vibration"]), "the address keeps the filters"
    _pick(page, "tolerances")
    assert page.evaluate(SHOWN) == [] and "clear a question" in page.inner_text(".ex-count")


def test_a_picture_moves_under_the_pointer_only(open_page, gallery):
    page = open_page(gallery)
    image = "document.querySelector('#example-disc_cam img')"
    before = page.evaluate(f"{image}.src")
    page.hover("#example-disc_cam")
    assert page.evaluate(f"{image}.src === {image}.dataset.moving")
    page.hover("h1")
    assert page.evaluate(f"{image}.src") == before


def test_a_reader_who_wants_no_motion_gets_none(open_page, gallery):
    page = open_page(gallery, reduced_motion="reduce")
    before = page.evaluate("document.querySelector('#example-disc_cam img').src")
    page.hover("#example-disc_cam")
    assert page.evaluate("document.querySelector('#example-disc_cam img').src") == before


@pytest.mark.parametrize("width", [1280, 390])
def test_nothing_scrolls_sideways(open_page, gallery, width):
    page = open_page(gallery)
    page.set_viewport_size({"width": width, "height": 800})
    assert page.evaluate("document.documentElement.scrollWidth") <= width


def test_copying_takes_the_command(open_page, gallery):
    page = open_page(gallery)
    page.evaluate("navigator.clipboard.writeText = async text => { window.copied = text; }")
    page.click("#example-disc_cam .ex-command .ex-copy")
    until(page, "window.copied === 'drivewright examples --run disc_cam'")
    page.click("#example-disc_cam summary")
    page.click("#example-disc_cam details .ex-copy")
    until(page, "window.copied.includes('mechanism = \"cam\"')")
