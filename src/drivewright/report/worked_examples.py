"""The worked examples that come with the package: their specs, what each answers, and the pictures that stand for them.

They are packed into the wheel; in a checkout they lie beside the sources.  `worked_examples.toml` has the questions of each and how its
picture is drawn; `gallery/` among the examples holds the pictures NAME.webp and NAME.moving.webp, and `made.json`: the digest of the spec
each was made from.  Presets have such pictures in `presets/pictures` of their kind; those that move are there for some only.
"""

import hashlib
import json
import tomllib
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from drivewright import registry
from drivewright.spec import load, read_document

PACKED = Path(__file__).parent.parent / "examples"
CHECKOUT = Path(__file__).parents[3] / "examples"
SETTINGS = Path(__file__).with_suffix(".toml")
GALLERY, MADE = "gallery", "made.json"
PICTURES = "pictures"  # folder in that of the presets of a kind


class Card(NamedTuple):
    """What a gallery shows of an example.

    `about` is what its head says; `questions` are {tag: words}; `still` and `moving` are paths of its pictures, the second where it moves.
    """

    name: str
    kind: str
    title: str
    about: str
    questions: dict[str, str]
    still: Path
    moving: Path | None

    @property
    def command(self) -> str:
        """What runs it."""
        return f"drivewright examples --run {self.name}"


def examples() -> dict[str, Path]:
    """Name -> path of every example spec."""
    return {path.stem: path for path in sorted(folder().glob("*.toml"))}


def studies() -> dict[str, Path]:
    """Name -> path of every worked study: specs with a [study] table, for `sweep`."""
    return {path.stem: path for path in sorted((folder() / "studies").glob("*.toml"))}


def folder() -> Path:
    """Where the examples are."""
    return PACKED if PACKED.is_dir() else CHECKOUT


def cards() -> list[Card]:
    """A card for each example, by kind and name."""
    made = [_card(name, path) for name, path in examples().items()]
    return sorted(made, key=lambda card: (card.kind, card.name))


def _card(name: str, path: Path) -> Card:
    tables, words = read_document(path), question_words()
    asked = {tag: words[tag] for tag in picture_settings(name).get("questions", ())}
    still, moving = pictures(name)
    about = _about(path.read_text(encoding="utf-8"))
    return Card(name, tables.get("mechanism", ""), tables.get("title", name), about, asked, still, moving if moving.is_file() else None)


def _about(text: str) -> str:
    """The comment at the head of a spec as one paragraph."""
    lines = text.splitlines()
    head = lines[: next((n for n, line in enumerate(lines) if not line.startswith("#")), len(lines))]
    return " ".join(" ".join(line.removeprefix("#") for line in head).split())


def pictures(name: str) -> tuple[Path, Path]:
    """Paths of the still and of the moving picture of an example; nothing moves where the second is not there."""
    place = folder() / GALLERY
    return place / f"{name}.webp", place / f"{name}.moving.webp"


def preset_pictures(kind: str) -> dict[str, Path]:
    """Preset -> path of its picture, of those that have one; a package that brings a kind may leave them out."""
    place = registry.mechanism(kind).folder / "presets" / PICTURES
    return {name: place / f"{name}.webp" for name in registry.mechanism(kind).presets() if (place / f"{name}.webp").is_file()}


def preset_films(kind: str) -> dict[str, Path]:
    """The same of the moving pictures; a film is worth its size where the name of a preset does not tell how it moves."""
    stills = preset_pictures(kind).items()
    return {name: film for name, still in stills if (film := still.with_suffix(".moving.webp")).is_file()}


def question_words() -> dict[str, str]:
    """Tag -> words of every question."""
    return dict(_settings()["questions"])


def picture_settings(name: str) -> dict[str, Any]:
    """What worked_examples.toml has of an example; {} where it does not name it."""
    return dict(_settings()["examples"].get(name, {}))


@cache
def _settings() -> dict[str, Any]:
    return tomllib.loads(SETTINGS.read_text(encoding="utf-8"))


def digest(path: Path) -> str:
    """SHA-256 of what a spec says, comments and order apart, of its data files, and of how its picture is drawn."""
    own = picture_settings(path.stem) if path.parent == folder() else {}
    drawn = {key: value for key, value in own.items() if key != "questions"}
    tables = {key: value for key, value in read_document(path).items() if key not in ("title", "optimise")}
    sums = [hashlib.sha256(file.read_bytes()).hexdigest() for file in load(path).data_files()]
    return hashlib.sha256(json.dumps([tables, drawn, sums], sort_keys=True, default=str).encode()).hexdigest()


def outdated() -> list[str]:
    """Names of the examples whose picture is missing or was made from another spec."""
    made = made_from(folder() / GALLERY)
    return [name for name, path in examples().items() if made.get(name) != digest(path) or not pictures(name)[0].is_file()]


def outdated_presets(kind: str) -> list[str]:
    """The same of the presets of a kind."""
    mechanism, pictured = registry.mechanism(kind), preset_pictures(kind)
    made = made_from(mechanism.folder / "presets" / PICTURES)
    return [name for name, path in mechanism.presets().items() if made.get(name) != digest(path) or name not in pictured]


def made_from(place: Path) -> dict[str, str]:
    """Name -> digest of the spec that the pictures in a folder were made from."""
    file = place / MADE
    return json.loads(file.read_text(encoding="utf-8")) if file.is_file() else {}
