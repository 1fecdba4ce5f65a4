"""Pages of the documentation: all of them are in the navigation, and their links lead somewhere."""

import re
from pathlib import Path

import pytest
from places import ROOT

pytestmark = pytest.mark.interface

DOCS = ROOT / "docs"
GENERATED = set(re.findall(r"^/docs/(.+\.md)$", (ROOT / ".gitignore").read_text(), flags=re.MULTILINE))
WRITTEN = {str(page.relative_to(DOCS)) for page in DOCS.rglob("*.md") if not page.name.endswith(".in.md")} - GENERATED


def test_every_page_is_in_the_navigation():
    navigation = set(re.findall(r"[\w/-]+\.md", (ROOT / "mkdocs.yml").read_text()))
    assert navigation == WRITTEN | GENERATED


@pytest.mark.parametrize("page", sorted(WRITTEN))
def test_links_between_pages_lead_somewhere(page):
    text = re.sub(r"```.*?```", "", (DOCS / page).read_text(), flags=re.DOTALL)
    links = [link for link in re.findall(r"\]\(([^)#\s]+)", text) if not re.match(r"[a-z]+:", link)]
    lost = [link for link in links if not _leads_somewhere(DOCS / page, link)]
    assert not lost


def _leads_somewhere(page: Path, link: str) -> bool:
    target = (page.parent / link).resolve()
    return target.exists() or (target.is_relative_to(DOCS) and str(target.relative_to(DOCS)) in GENERATED)
