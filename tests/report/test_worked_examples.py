"""Every worked example has its questions and a picture of the spec as it stands; the gallery shows all of them."""

import base64
import io
import re

import numpy as np
import pytest
from PIL import Image

from drivewright import registry
from drivewright.report import worked_examples
from drivewright.report.gallery import gallery_markdown, write_gallery
from drivewright.report.thumbnails import MOVING_BUDGET, SIZE, STILL_BUDGET
from drivewright.report.worked_examples import (
    cards,
    digest,
    examples,
    folder,
    outdated,
    outdated_presets,
    picture_settings,
    pictures,
    preset_pictures,
    question_words,
)

pytestmark = pytest.mark.interface

AGAIN = "python docs/builders/gallery.py makes them again"
NAMES = sorted(examples())


def test_every_picture_was_made_from_the_spec_as_it_stands():
    assert outdated() == [], f"pictures of other specs, or none: {AGAIN}"


@pytest.mark.parametrize("kind", registry.kinds())
def test_every_preset_has_a_picture_of_the_spec_as_it_stands(kind):
    assert outdated_presets(kind) == [], f"pictures of other specs, or none: {AGAIN}"
    for path in preset_pictures(kind).values():
        assert path.stat().st_size < STILL_BUDGET and Image.open(path).size == SIZE


def test_a_changed_spec_is_noticed(tmp_path, monkeypatch):
    path = examples()["oscillating_cam"]
    changed = tmp_path / path.name
    for file in (path, folder() / "lift.csv"):
        (tmp_path / file.name).write_bytes(file.read_bytes())
    assert digest(changed) == digest(path)
    changed.write_text(f"# another comment\n{path.read_text()}")
    assert digest(changed) == digest(path), "a comment moves nothing"
    changed.write_text(path.read_text().replace('"9 mm"', '"8 mm"'))
    assert digest(changed) != digest(path)
    changed.write_text(path.read_text())
    (tmp_path / "lift.csv").write_text(f"{(folder() / 'lift.csv').read_text()}\n")
    assert digest(changed) != digest(path), "its data file is another one"
    monkeypatch.setattr(worked_examples, "made_from", lambda place: {})
    assert outdated() == NAMES


@pytest.mark.parametrize("name", NAMES)
def test_pictures_are_small_and_show_something(name):
    still, moving = pictures(name)
    assert still.stat().st_size < STILL_BUDGET
    image = Image.open(still)
    assert image.size == SIZE and np.asarray(image.convert("L")).std() > 5, "nothing is drawn"
    if moving.is_file():
        film = Image.open(moving)
        assert moving.stat().st_size < MOVING_BUDGET and film.size == SIZE and film.n_frames > 5 and film.info["loop"] == 0


def test_no_picture_without_an_example():
    known = {path for name in NAMES for path in pictures(name)}
    assert set(pictures("x")[0].parent.glob("*.webp")) <= known


def test_each_example_is_listed_with_questions_of_the_list():
    listed = worked_examples._settings()["examples"]
    assert sorted(listed) == NAMES
    for name in NAMES:
        asked = picture_settings(name)["questions"]
        assert asked and len(set(asked)) == len(asked) and set(asked) <= set(question_words()), name


def test_each_question_is_answered_somewhere():
    assert {tag for card in cards() for tag in card.questions} == set(question_words())


def test_an_example_that_optimises_is_tagged_so():
    assert {card.name for card in cards() if "[optimise]" in examples()[card.name].read_text()} == {
        card.name for card in cards() if "optimisation" in card.questions
    }


def test_the_page_needs_no_other_file(tmp_path):
    text = write_gallery(tmp_path / "new" / "index.html").read_text()
    assert text.count('<article class="ex-card"') == len(NAMES)
    addresses = re.findall(r'(?:src|href|data-moving)="([^"]*)"', text)
    assert addresses and all(address.startswith("data:") for address in addresses)
    first = next(address for address in addresses if address.startswith("data:image/webp"))
    assert Image.open(io.BytesIO(base64.b64decode(first.partition(",")[2]))).size == SIZE
    for card in cards():
        assert f"drivewright examples --run {card.name}<" in text


def test_the_text_of_a_spec_is_no_markup(tmp_path, monkeypatch):
    spec = tmp_path / "disc_cam.toml"
    spec.write_text(examples()["disc_cam"].read_text() + "# </code><script>alert(1)</script>\n")
    monkeypatch.setattr(worked_examples, "examples", lambda: {"disc_cam": spec})
    monkeypatch.setattr("drivewright.report.gallery.examples", lambda: {"disc_cam": spec})
    assert "<script>alert" not in write_gallery(tmp_path / "index.html").read_text()


def test_the_page_of_the_documentation_links_its_pictures():
    text = gallery_markdown(lambda picture: f"pictures/{picture.name}")
    assert text.startswith("---") and "\n# Gallery\n" in text
    for card in cards():
        assert f'src="pictures/{card.name}.webp"' in text
