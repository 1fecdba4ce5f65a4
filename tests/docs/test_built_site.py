"""The built site loads nothing from elsewhere, has its formulas, and is found by its checker when it does load something."""

import importlib
import shutil
import subprocess
import sys

import pytest
from places import ROOT

pytestmark = [pytest.mark.interface, pytest.mark.needs_docs]

SITE = """INHERIT: {root}/mkdocs.yml
docs_dir: docs
site_dir: site
hooks: []
plugins: [offline, search]
not_in_nav: ""
exclude_docs: ""
nav: [index.md, plain.md]
"""


@pytest.fixture(scope="module")
def checker():
    sys.path.insert(0, str(ROOT / "docs"))
    yield importlib.import_module("check_site")
    sys.path.remove(str(ROOT / "docs"))


@pytest.fixture(scope="module")
def site(tmp_path_factory, checker):
    """Two pages with the project's own theme, styles and scripts."""
    folder = tmp_path_factory.mktemp("site")
    shutil.copytree(ROOT / "docs" / "assets", folder / "docs" / "assets")
    importlib.import_module("builders.assets").build(folder / "docs", print)
    (folder / "docs" / "index.md").write_text("# Page\n\nThe energy $E = m c^2$ and\n\n$$\nF = m a \\tag{1}\n$$\n")
    (folder / "docs" / "plain.md").write_text("# Plain\n\n| a | b |\n|---|---|\n| 1 | 2 |\n")
    (folder / "mkdocs.yml").write_text(SITE.format(root=ROOT))
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "-f", str(folder / "mkdocs.yml")]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return folder / "site"


def test_nothing_is_loaded_from_elsewhere(site, checker):
    assert list(checker.loads(site)) == []


def test_formulas_are_marked_and_their_typesetter_is_there(site):
    page = (site / "index.html").read_text(encoding="utf-8")
    assert '<span class="arithmatex">' in page and '<div class="arithmatex">' in page and "\\tag{1}" in page
    assert (site / "assets" / "mathjax" / "tex-svg-full.js").stat().st_size > 1e6
    assert "arithmatex" not in (site / "plain.html").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    "text",
    [
        '<script src="https://cdn.example/x.js"></script>',
        '<link rel="stylesheet" href="//cdn.example/x.css">',
        '<img src="http://example.org/x.png">',
        '<img src="not-there.png">',
        "<p style=\"background: url('https://example.org/x.png')\">",
    ],
)
def test_a_load_from_elsewhere_is_found(tmp_path, checker, text):
    (tmp_path / "index.html").write_text(f"<html><body>{text}</body></html>")
    assert len(list(checker.loads(tmp_path))) == 1


def test_a_link_that_a_reader_follows_is_none(tmp_path, checker):
    (tmp_path / "index.html").write_text('<a href="https://example.org">x</a><link rel="canonical" href="https://example.org/">')
    assert list(checker.loads(tmp_path)) == []


@pytest.mark.parametrize(
    "text",
    [
        '<iframe src="//example.org/x"></iframe>',
        '<object data="https://example.org/x.svg"></object>',
        '<link rel="ModulePreload" href="https://cdn.example/x.js">',
        '<link rel="alternate ICON" href="https://cdn.example/x.png">',
        '<video><source src="HTTPS://example.org/x.mp4"></video>',
    ],
)
def test_frames_objects_and_links_of_any_spelling_load(tmp_path, checker, text):
    (tmp_path / "index.html").write_text(f"<html><body>{text}</body></html>")
    assert len(list(checker.loads(tmp_path))) == 1


def test_a_file_that_is_there_is_found_whatever_its_address_has_behind_it(tmp_path, checker):
    (tmp_path / "below").mkdir()
    (tmp_path / "a picture.png").write_bytes(b"x")
    texts = ("../a%20picture.png", "../a picture.png?v=2#top", "data:image/png;base64,eA==", "#part", "/served/from/the/root.png")
    (tmp_path / "below" / "page.html").write_text("".join(f'<img src="{text}">' for text in texts))
    assert list(checker.loads(tmp_path)) == []
    (tmp_path / "a picture.png").unlink()
    assert [target for _, target in checker.loads(tmp_path)] == list(texts[:2])


def test_styles_below_a_folder_load_nothing_from_elsewhere(tmp_path, checker):
    (tmp_path / "assets").mkdir()
    style = tmp_path / "assets" / "x.css"
    style.write_text('@import "https://example.org/a.css"; b { background: url( //example.org/b.png ) } c { background: url(c.png) }')
    assert [(file, target) for file, target in checker.loads(tmp_path)] == [
        (style, "https://example.org/a.css"),
        (style, "//example.org/b.png"),
    ]


def test_the_command_ends_with_the_addresses_or_with_a_word_of_praise(tmp_path, checker, monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["check_site.py", str(tmp_path)])
    with pytest.raises(SystemExit, match="holds no site"):
        checker.main()
    (tmp_path / "index.html").write_text("<p>")
    checker.main()
    assert "nothing is missing" in capsys.readouterr().out
    (tmp_path / "index.html").write_text('<img src="gone.png">')
    with pytest.raises(SystemExit, match=r"^index\.html loads gone\.png, "):
        checker.main()
