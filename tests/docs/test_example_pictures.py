"""Pictures of worked examples: each is shown by a page, and each on the pages of these examples is made by the builder."""

import re
import sys

import pytest
from markdown_links import DOCS
from places import EXAMPLES

pytestmark = pytest.mark.interface


@pytest.fixture
def pictures(monkeypatch):
    monkeypatch.syspath_prepend(str(DOCS))
    yield __import__("builders.example_pictures", fromlist=["example_pictures"]).PICTURES
    for name in [name for name in sys.modules if name.partition(".")[0] == "builders"]:
        del sys.modules[name]


def test_the_page_of_an_example_shows_the_pictures_that_are_made_of_it(pictures):
    for example, made in pictures.items():
        assert (EXAMPLES / f"{example}.toml").is_file()
        shown = re.findall(r"\]\(img/([\w-]+)\.svg\)", (DOCS / f"{example}.md").read_text(encoding="utf-8"))
        assert sorted(shown) == sorted(made), example
        assert all((DOCS / "img" / f"{name}.svg").is_file() for name in made)
