"""The drawings of what the keys measure, in another language: letters of a drawing are text, which is replaced."""

import re
from collections.abc import Callable
from html import escape, unescape

from drivewright import registry
from drivewright.report.words import Words
from drivewright.spec.fields import field_at
from drivewright.studio import translations
from drivewright.studio.field_info import field_infos

TEXT = re.compile(r"(<text [^>]*>)([^<]+)(</text>)")
TIMES = re.compile(r"([\d.]+ × )?(.+)")  # "2 × pin_radius"
JOINED = " · "


def drawing_in_words(kind: str, drawing: str) -> str:
    """The text of an SVG drawing of a kind: its title and the keys in it as the form names them; values stay."""
    words = Words(translations.texts(kind), translations.texts(None))

    def replaced(found: re.Match[str]) -> str:
        times, text = TIMES.fullmatch(unescape(found[2])).groups()  # pyright: ignore[reportOptionalMemberAccess]  # fits any text
        told = key_in_words(kind, text, words.exact) if field_at(registry.mechanism(kind).spec, text.split(".")) else words(text)
        return f"{found[1]}{escape((times or '') + told, quote=False)}{found[3]}"

    return TEXT.sub(replaced, drawing).replace("<svg ", f'<svg xml:lang="{translations.LANGUAGE}" ', 1)


def key_in_words(kind: str, key: str, exact: Callable[[str], str]) -> str:
    """A dotted key as the form shows it: the element that it is of, its label, and x or y; `exact` translates names that are known."""
    labels = translations.fields(kind) | translations.tables(kind)
    model, pattern, told, steps = registry.mechanism(kind).spec, "", [], key.split(".")
    while steps:
        name, *steps = steps
        pattern = f"{pattern}.{name}".lstrip(".")
        info, label = field_infos(model)[name], labels[pattern]
        if info.kind == "names" or (info.table and info.levels):
            name, *steps = steps
            pattern += ".*"
            told.append(f"{label} {int(name) + 1}" if name.isdecimal() else exact(name))
        elif not info.table:
            told.append(label)
        if info.table:
            model = info.table
        else:
            parts = info.items[0].parts if info.kind == "names" else info.parts
            return JOINED.join((*told, *(exact(parts[int(step)]) for step in steps)))
    return JOINED.join(told)
