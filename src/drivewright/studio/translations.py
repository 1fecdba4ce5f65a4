"""Words of the page in another language than English: labels of the form, and texts on the screen.

They stand in `zh.toml`, here for what all kinds share and in the folder of each mechanism for its own:
`fields` and `tables` (dotted key, * for a name or a number -> label), `hints` (what a key means, in English -> in the language), `texts`
(English, * for a part that varies -> text), `presets`.
"""

import re
import tomllib
from functools import cache
from pathlib import Path

from drivewright import registry
from drivewright.report.worked_examples import cards
from drivewright.spec import read_document
from drivewright.studio.field_info import field_info_at

LANGUAGE = "zh"


def fields(kind: str) -> dict[str, str]:
    """{dotted key with * for names and numbers: label} of every field of a kind; the dictionary is shared, do not change it."""
    return _merged(kind, "fields")


def tables(kind: str) -> dict[str, str]:
    """The same of its tables, which are the groups of a form."""
    return _merged(kind, "tables")


def hints(kind: str) -> dict[str, str]:
    """{meaning of a key or of a table, as its class states it: in the language}; the dictionary is shared, do not change it."""
    return _merged(kind, "hints")


@cache
def texts(kind: str | None = None) -> dict[str, str]:
    """{English text, with * for what varies: text} of a kind and the studio, or of the studio alone with what it says of all kinds."""
    if kind is None:
        return {english: text for each in registry.kinds() for english, text in _introduction(each).items()} | _own().get("texts", {})
    return _keys(kind) | _presets(kind) | _merged(kind, "texts")


def _introduction(kind):
    """Texts about a kind before a design of it is open: its name, its summary, its presets, titles of what a new design can start from."""
    known = registry.mechanism(kind)
    texts = _brought(kind).get("texts", {})
    titles = (*preset_titles(kind).values(), *(card.title for card in cards() if card.kind == kind))
    told = {english: _translated(english, texts) for english in (_words_of_name(kind), known.summary, *titles)}
    return _presets(kind) | {english: text for english, text in told.items() if text}


def _translated(english, texts):
    """The translation of a text, itself or by the longest entry with * that it fits; None where there is none."""
    if english in texts:
        return texts[english]
    for pattern in sorted((each for each in texts if "*" in each and each.strip("* ")), key=len, reverse=True):
        if parts := re.fullmatch("(.+?)".join(map(re.escape, pattern.split("*"))), english):
            return _filled(texts[pattern], parts.groups())
    return None


def _filled(text, parts):
    """Each * of a text replaced by the next of the parts."""
    given = iter(parts)
    return re.sub(r"\*", lambda star: next(given, star[0]), text)


@cache
def preset_titles(kind: str) -> dict[str, str]:
    """{preset: title of its spec}, of those that have one."""
    tables = {name: read_document(path) for name, path in registry.mechanism(kind).presets().items()}
    return {name: str(given["title"]) for name, given in tables.items() if given.get("title")}


def _keys(kind):
    """Fields as jobs name them: 'joints · * · clearance', each step by its own label; of points and the like also their parts."""
    titles = tables(kind)
    named = {}
    for key, text in fields(kind).items():
        *places, last = key.split(".")
        titled = [step if step == "*" else titles.get(".".join(places[: n + 1]), step) for n, step in enumerate(places)]
        inside = _parts_of(kind, (*places, last))
        named[" · ".join((*map(_words_of_name, (*places, last)), *inside))] = " · ".join((*titled, text, *inside))
    return named


def _parts_of(kind, steps):
    """("*", ...) for the steps that a key has below its field: the name of a point, the part of a pair."""
    info = field_info_at(registry.mechanism(kind).spec, steps)
    return ("*", "*") if info and info.kind == "names" else ("*",) if info and info.fixed else ()


def _presets(kind):
    """Presets by their names as the page shows them."""
    return {_words_of_name(name): text for name, text in _brought(kind).get("presets", {}).items()}


def _words_of_name(name):
    return name.replace("-", " ").replace("_", " ")


@cache
def _merged(kind, part):
    return _own().get(part, {}) | _brought(kind).get(part, {})


@cache
def _brought(kind):
    return registry.mechanism(kind).translations(LANGUAGE)


@cache
def _own():
    return tomllib.loads(Path(__file__).with_name(f"{LANGUAGE}.toml").read_text(encoding="utf-8"))
