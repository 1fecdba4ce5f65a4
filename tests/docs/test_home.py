"""The home page is README.md, its links and pictures seen from the folder of the pages."""

import sys

import pytest
from markdown_links import DOCS

pytestmark = pytest.mark.interface


@pytest.fixture
def seen(monkeypatch):
    monkeypatch.syspath_prepend(str(DOCS))
    yield __import__("builders.home", fromlist=["home"]).seen_from_docs
    for name in [name for name in sys.modules if name.partition(".")[0] == "builders"]:
        del sys.modules[name]


def test_links_into_docs_lose_the_folder(seen):
    assert seen("[a](docs/studies.md) ![b](docs/img/x.png) [c](docs/x.md#y)") == "[a](studies.md) ![b](img/x.png) [c](x.md#y)"
    assert (
        seen('<a href="docs/studio.md"><img src="docs/img/x.webp" width="9"></a>')
        == '<a href="studio.md"><img src="img/x.webp" width="9"></a>'
    )


def test_of_links_to_other_files_the_text_stays(seen):
    assert seen("See [how to contribute](CONTRIBUTING.md).") == "See how to contribute."


def test_links_to_elsewhere_stay(seen):
    text = "[a](https://example.org/docs/x) [b](#here) [c](mailto:a@example.org)"
    assert seen(text) == text


def test_a_picture_outside_of_docs_is_refused(seen):
    for text in ("![b](examples/x.png)", '<img src="examples/x.png">'):
        with pytest.raises(ValueError, match=r"examples/x\.png"):
            seen(text)
