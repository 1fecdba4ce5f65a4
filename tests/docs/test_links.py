"""Every link between pages leads to a file that is there, and to a heading that is there."""

from pathlib import Path

import pytest
from markdown_links import anchors, is_generated, links, written_pages
from places import ROOT

pytestmark = pytest.mark.interface

PAGES = written_pages()


@pytest.mark.parametrize("place", sorted(PAGES), ids=lambda place: str(place.relative_to(ROOT)))
def test_links_lead_somewhere(place):
    text = PAGES[place].read_text(encoding="utf-8")
    assert [link for link in links(text) if not _leads_somewhere(place, link)] == []


def _leads_somewhere(place: Path, link: str) -> bool:
    """Whether the file of a link is there, or is made by the builders, and has the anchor."""
    path, _, anchor = link.partition("#")
    target = (place.parent / path).resolve() if path else place
    if target not in PAGES and not target.exists():
        return target.is_relative_to(ROOT) and is_generated(target)
    if not anchor or target.suffix != ".md" or (target not in PAGES and is_generated(target)):
        return True
    return anchor in anchors(PAGES.get(target, target).read_text(encoding="utf-8"))


def test_a_link_that_leads_nowhere_is_found(tmp_path):
    page = ROOT / "docs" / "studies.md"
    assert _leads_somewhere(page, "cluster.md") and _leads_somewhere(page, "gallery.md")
    assert not _leads_somewhere(page, "no_such_page.md") and not _leads_somewhere(page, "cluster.md#no-such-heading")
