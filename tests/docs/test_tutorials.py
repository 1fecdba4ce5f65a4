"""The tutorials: every command of every page runs, prints what the page shows, and makes the pictures."""

import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "docs"))

from builders import tutorials  # noqa: E402
from builders.page_commands import Command, File, Picture, difference, page_steps  # noqa: E402

pytestmark = pytest.mark.interface
QUICK = frozenset({"01-first-cam"})  # the others are slow tests: all of them take minutes
NEEDS = {"10-cluster": "needs_cluster"}
PAGES = [page for page in tutorials.pages() if page.parent.name == "tutorials"]


def parameters(pages):
    for page in pages:
        marks = [] if page.stem in QUICK else [pytest.mark.slow]
        marks += [getattr(pytest.mark, NEEDS[page.stem])] if page.stem in NEEDS else []
        yield pytest.param(page, id=page.stem, marks=marks)


@pytest.mark.parametrize("page", list(parameters(PAGES)))
def test_tutorial_shows_what_its_commands_print(page, tmp_path):
    told = tutorials.faults(page, tmp_path)
    assert not told, f"{page.name}: run `python docs/builders/tutorials.py --refresh {page.stem}` and read what has changed\n" + "\n".join(
        told
    )


@pytest.mark.slow
@pytest.mark.parametrize("path", tutorials.notebooks(), ids=lambda path: path.stem)
def test_notebook_gives_what_it_shows_and_its_page_is_its_own(path, tmp_path):
    pytest.importorskip("nbclient")
    pytest.importorskip("ipykernel")
    told = tutorials.notebook_faults(path, tmp_path)
    assert not told, f"run `python docs/builders/tutorials.py --refresh {path.stem}`\n" + "\n".join(told)


def test_notebook_keeps_nothing_of_a_machine():
    for path in tutorials.notebooks():
        text = path.read_text(encoding="utf-8")
        assert not [word for word in ("execution_timing", "iopub", "/home/", "/tmp/", "<dc:date>") if word in text]


def test_compact_pictures_keep_the_numbers_of_their_axes():
    picture = b'<path d="M 1.23456 7.891011"/><!-- 320.1702 -->\n<text x="0.12345">320.1702</text>'
    assert tutorials.compact(picture) == b'<path d="M 1.23 7.89"/><!-- 320.17 -->\n<text x="0.12">320.1702</text>'


# -- the comparison itself -----------------------------------------------------------------------------------------------------

PAGE = """
```toml title="a.toml"
x = 1
```
```console
$ drivewright run a.toml \\
    --set x=2
  Stroke   20.00 mm
...
$ echo $?
0
```
<!-- picture: out/a/figures/plot.svg -->
![a plot](img/a.svg)
"""


def test_a_page_is_read_in_its_order():
    file, run, code, picture = page_steps(PAGE)
    assert file == File("a.toml", "x = 1\n")
    assert isinstance(run, Command) and run.shown == ["  Stroke   20.00 mm", "..."] and "--set x=2" in run.text
    assert isinstance(code, Command) and (code.text, code.shown) == ("echo $?", ["0"])
    assert picture == Picture("out/a/figures/plot.svg", "img/a.svg")


@pytest.mark.parametrize(
    ("shown", "printed", "told"),
    [
        (["Stroke  20 mm"], ["Stroke    20 mm"], ""),
        (["Stroke 20.00 mm"], ["Stroke 20.009 mm"], ""),
        (["Force 206.61 N"], ["Force 207.90 N"], ""),
        (["Force 206.61 N"], ["Force 230.00 N"], "other numbers"),
        (["Force 206.61 N"], ["Torque 206.61 N"], "not printed"),
        (["verdict: all 13 checks pass"], ["verdict: all 14 checks pass"], "other numbers"),
        (["b 1"], ["a 1", "b 1"], "not shown"),
        (["...", "b 1"], ["a 1", "b 1"], ""),
        (["a 1"], ["a 1", "b 1"], "not shown"),
        (["a 1", "..."], ["a 1", "b 1"], ""),
        (["ratio 9.1 (8.1 to 10.1)"], ["ratio 9.9 (9.0 to 10.8)"], ""),
        (["ratio 9.1 (8.1 to 10.1)"], ["ratio 12 (11 to 13)"], "other numbers"),
        (["...", "yield 97.0% (94.8% to 98.4% with 95%)"], ["yield 97.1% (94.9% to 98.4% with 95%)"], ""),
        (["12 cases in 3.2 s"], ["12 cases in 9.9 s"], ""),
    ],
)
def test_the_comparison_is_loose_in_digits_and_strict_in_words(shown, printed, told):
    found = difference(shown, printed)
    assert told in found and bool(found) == bool(told)


def test_a_kept_picture_has_short_coordinates_and_its_texts_as_they_were():
    made = b'<svg><path d="M 1.23456 7.8"/><g transform="scale(0.015625 -0.085)"/><text x="1.99999">0.125 mm</text></svg>'
    kept = b'<svg><path d="M 1.23 7.8"/><g transform="scale(0.015625 -0.085)"/><text x="1.99">0.125 mm</text></svg>'
    assert tutorials.compact(made) == kept
