"""The frame of the site: every page is in the navigation once, every builder has its `build`, every public module has its reference."""

import importlib
import inspect
import re
import sys
from pathlib import Path

import pytest
from markdown_links import DOCS, is_generated
from places import ROOT, SOURCE

pytestmark = pytest.mark.interface

PRIVATE_ROOMS = {"cli", "studio", "reproduction", "validation", "oracles"}  # of the program itself: no interface of the library
PRIVATE_MODULES = {"atomic", "digits", "steps"}
CONFIGURATION = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
NAVIGATION = CONFIGURATION.partition("\nnav:\n")[2]
ENTRIES = re.findall(r"[\w/.-]+\.md", NAVIGATION)
FOLDERS = re.findall(r"(?<=: )[\w/-]+/$", NAVIGATION, flags=re.MULTILINE)


@pytest.fixture
def builders(monkeypatch):
    """Imports a module of docs/."""
    monkeypatch.syspath_prepend(str(DOCS))
    yield importlib.import_module
    for name in [name for name in sys.modules if name == "generate" or name.partition(".")[0] == "builders"]:
        del sys.modules[name]


def test_no_page_is_in_the_navigation_twice():
    assert len(ENTRIES) == len(set(ENTRIES))


def test_every_page_that_is_written_is_in_the_navigation():
    written = {path.relative_to(DOCS).as_posix() for path in DOCS.rglob("*.md") if not is_generated(path)}
    written = {page for page in written if not page.endswith(".in.md") and not page.startswith(("decisions/", *FOLDERS))}
    assert written - set(ENTRIES) == set()


def test_every_entry_of_the_navigation_is_a_page():
    lost = [entry for entry in ENTRIES if not (DOCS / entry).is_file() and not is_generated(DOCS / entry)]
    assert lost == [] and all((DOCS / folder).is_dir() for folder in FOLDERS)


def test_every_page_that_is_made_has_its_builder():
    builders = "".join(path.read_text(encoding="utf-8") for path in (DOCS / "builders").glob("*.py"))
    made = [entry for entry in ENTRIES if "/" not in entry and is_generated(DOCS / entry)]
    assert {"index.md", "dimensions.md", "gallery.md"} <= set(made)
    assert [entry for entry in made if f'"{entry}"' not in builders] == []


def test_every_decision_is_in_their_list():
    records = {path.name for path in (DOCS / "decisions").glob("0*.md")}
    assert records == set(re.findall(r"\]\((0\d+[\w.-]+\.md)\)", (DOCS / "decisions" / "index.md").read_text(encoding="utf-8")))


def test_every_step_is_a_builder(builders):
    generate = builders("generate")
    for name in generate.STEPS:
        parameters = list(inspect.signature(builders(f"builders.{name}").build).parameters)
        assert parameters == ["docs", "progress", *(["full"] if name in generate.WITH_FULL else [])], name
    assert set(generate.STEPS) >= generate.WITH_FULL


def test_every_package_of_the_library_has_its_page(builders):
    listed = {name.partition(".")[0] for page in builders("builders.reference_python").PAGES for name in page.modules}
    packages = {path.parent.name for path in SOURCE.glob("[!_]*/__init__.py")}
    modules = {path.stem for path in SOURCE.glob("[!_]*.py")}
    assert (packages | modules) - listed == PRIVATE_ROOMS | PRIVATE_MODULES


def test_a_folder_in_the_navigation_stands_for_its_pages(builders, tmp_path):
    for name in ("02-b.md", "index.md", "01-a.md"):
        (tmp_path / "lessons" / name).parent.mkdir(exist_ok=True)
        (tmp_path / "lessons" / name).touch()
    hooks = builders("builders.site_hooks")
    nav = [{"Lessons": "lessons/"}, {"Other": ["x.md"]}]
    pages = ["lessons/index.md", "lessons/01-a.md", "lessons/02-b.md"]
    assert [hooks._with_folders(entry, Path(tmp_path)) for entry in nav] == [{"Lessons": pages}, {"Other": ["x.md"]}]
