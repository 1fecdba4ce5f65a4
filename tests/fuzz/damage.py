"""Tables and texts of specs with faults in them."""

import copy

from drivewright.spec.serialisation import toml_key, toml_value

from .values import QUANTITY, TEXTS, other_value

ODD_KEYS = ("", "a.b", "\u202e", "\ud800", "__proto__", "x" * 300, "name", "enabled", "nan", "\x00")


def damaged_tables(tables, rng):
    """A copy of raw tables with one to four places changed, removed, doubled, renamed or exchanged."""
    tables = copy.deepcopy(tables)
    for _ in range(int(rng.choice([1, 1, 1, 1, 2, 3]))):
        places = [place for place in _places(tables) if place[1] != "mechanism" or rng.random() < 0.02]
        if places:
            _change(places, rng)
    return tables


def _places(value):
    """(container, key) of every value below a value."""
    for key in list(value) if isinstance(value, dict) else range(len(value)) if isinstance(value, list) else ():
        yield value, key
        yield from _places(value[key])


def _change(places, rng):
    inside, key = places[int(rng.integers(len(places)))]
    chance = rng.random()
    if chance < 0.85 or (isinstance(inside[key], (dict, list)) and chance < 0.3):
        leaves = [place for place in places if not isinstance(place[0][place[1]], dict)] or places
        measured = [place for place in leaves if _is_measured(place[0][place[1]])]
        leaves = measured if measured and rng.random() < 0.8 else leaves
        inside, key = leaves[int(rng.integers(len(leaves)))]
        inside[key] = other_value(inside[key], rng)
    elif chance < 0.88:
        del inside[key]
    elif chance < 0.91 and isinstance(inside, list):
        inside.append(copy.deepcopy(inside[key]))
    elif chance < 0.94 and isinstance(inside, dict):
        inside[_odd_key(inside, key, rng)] = copy.deepcopy(inside[key])
    elif chance < 0.98:
        other, name = places[int(rng.integers(len(places)))]
        inside[key] = copy.deepcopy(other[name])
    else:
        inside[key] = _deep(int(rng.integers(2, 40)), rng)


def _is_measured(value):
    """Whether a value is a quantity or a number, which stays of its kind when it is changed a little."""
    return isinstance(value, (int, float)) or (isinstance(value, str) and QUANTITY.fullmatch(value) is not None)


def _odd_key(inside, key, rng):
    odd = ODD_KEYS[int(rng.integers(len(ODD_KEYS)))]
    return odd if rng.random() < 0.5 else f"{key}{odd or 2}"


def _deep(levels, rng):
    value = 1
    for _ in range(levels):
        value = [value] if rng.random() < 0.5 else {"a": value}
    return value


def text_of(tables, path=""):
    """TOML text of raw tables, whatever they hold: an inline table where a list mixes tables with other things."""
    lines = [f"{toml_key(key)} = {_inline(value)}\n" for key, value in tables.items() if not isinstance(value, dict)]
    text = "".join(lines)
    for key, value in tables.items():
        if isinstance(value, dict):
            place = f"{path}{toml_key(key)}"
            text += f"\n[{place}]\n{text_of(value, f'{place}.')}"
    return text


def _inline(value):
    if isinstance(value, dict):
        return "{" + ", ".join(f"{toml_key(key)} = {_inline(inner)}" for key, inner in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(_inline, value)) + "]"
    if isinstance(value, int) and not isinstance(value, bool) and abs(value) > 10**300:
        return ("-" if value < 0 else "") + "1" + "0" * 400
    return toml_value(value)


def damaged_text(text, rng):
    """The bytes of a text with a line twice, a hole, another byte, odd signs or what is nested too deeply."""
    lines = text.splitlines(keepends=True)
    n, content = int(rng.integers(len(lines))), text.encode()
    at = int(rng.integers(len(content)))
    kinds = (
        lambda: "".join([*lines[: n + 1], *lines[n:]]).encode(),
        lambda: "".join([*lines[:n], *lines[n + 1 :]]).encode(),
        lambda: "".join(rng.permutation(lines).tolist()).encode(),
        lambda: content[:at],
        lambda: content[:at] + bytes(rng.integers(0, 256, 3, dtype="u1")) + content[at:],
        lambda: content[:at] + content[at + int(rng.integers(1, 40)) :],
        lambda: content[:at] + TEXTS[int(rng.integers(len(TEXTS)))].encode("utf-8", "surrogatepass") + content[at:],
        lambda: b"\xef\xbb\xbf" + content,
        lambda: content.replace(b"\n", b"\r\n"),
        lambda: text.encode("utf-16"),
        lambda: content.replace(b'"', b"'"),
        lambda: content.replace(b'"', b""),
        lambda: content + b"a." * int(rng.integers(2, 30_000)) + b"a = 1\n",
        lambda: content + b"a = " + b"[" * int(rng.integers(2, 3000)),
        lambda: content + b"[[programme]]\n" * int(rng.integers(2, 3000)),
    )
    return kinds[int(rng.integers(len(kinds)))]()
