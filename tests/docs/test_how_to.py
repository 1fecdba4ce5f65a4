"""The how-to pages: every command runs and prints what the page shows; indexes list every page."""

import re
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "docs"))

from builders import tutorials  # noqa: E402

pytestmark = pytest.mark.interface
PAGES = [page for page in tutorials.pages() if page.parent.name == "how-to"]
SLOW = (
    *("sweep-in-python", "response-map", "own-bearing", "check-in-ci", "bearing-by-life", "report-letterhead", "less-jerk"),
    *("units-and-language", "verify-a-result", "worn-pin"),
)
EVERY_PAGE = [page for folder in tutorials.FOLDERS for page in sorted((tutorials.DOCS / folder).glob("*.md"))]
IMPORTS = {"sweep-in-python": "pandas"}


def parameters():
    return [pytest.param(page, id=page.stem, marks=[pytest.mark.slow] if page.stem in SLOW else []) for page in PAGES]


@pytest.mark.parametrize("page", parameters())
def test_page_shows_what_its_commands_print(page, tmp_path):
    if page.stem in IMPORTS:
        pytest.importorskip(IMPORTS[page.stem])
    told = tutorials.faults(page, tmp_path)
    advice = f"run `python docs/builders/tutorials.py --refresh {page.stem}` and read what has changed"
    assert not told, f"{page.name}: {advice}\n" + "\n".join(told)


@pytest.mark.parametrize("folder", tutorials.FOLDERS)
def test_index_lists_every_page(folder):
    listed = re.findall(r"\]\(([\w-]+\.md)\)", (tutorials.DOCS / folder / "index.md").read_text(encoding="utf-8"))
    assert sorted(listed) == sorted(page.name for page in (tutorials.DOCS / folder).glob("*.md") if page.name != "index.md")


@pytest.mark.parametrize("page", EVERY_PAGE, ids=lambda page: page.stem)
def test_links_and_pictures_exist(page):
    for target in re.findall(r"\]\(([^)#\s:]+)(?:#[^)]*)?\)", page.read_text(encoding="utf-8")):
        assert (page.parent / target).exists(), f"{page.name}: no {target}"


def test_no_page_waits_for_its_output():
    assert not [page.name for page in tutorials.pages() if "\n???" in page.read_text(encoding="utf-8")]
