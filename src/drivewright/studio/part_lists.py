"""Bought parts that a field of a spec names, each with what one chooses it by."""

from collections.abc import Callable
from functools import cache

from drivewright.bearings import catalogue
from drivewright.bearings.designation import designations
from drivewright.errors import InputError, UnknownName
from drivewright.view.text import quantity

Entry = tuple[str, str]  # name, and what stands beside it


def entries(send: object, name: str) -> list[Entry]:
    """Names of a list and their boundary dimensions and ratings; a call of a worker process."""
    if name not in LISTS:
        raise UnknownName("list of parts", name, LISTS)
    return LISTS[name]()


def stronger(name: str, part: str) -> list[str]:
    """Parts of a list that fit in the place of one and carry more, those of its own type and the small ones first."""
    return STRONGER[name](part) if name in STRONGER else []


@cache
def _bearings() -> list[Entry]:
    """Rolling bearings of the usual series by their bore, small ones first."""
    found = []
    for name in designations():
        try:
            part = catalogue.entry(name)
        except InputError:
            continue
        found.append((part.bore, part.outer_diameter, name, _bearing_text(part)))
    return [(name, text) for _, _, name, text in sorted(found)]


def _bearing_text(part: catalogue.Entry) -> str:
    """ "30 × 72 × 19 mm, C 26.7 kN": bore, outside, width, dynamic rating."""
    sizes = " × ".join(f"{1e3 * size:g}" for size in (part.bore, part.outer_diameter, part.width) if size)
    rating = part.bearing.dynamic_rating
    return f"{sizes} mm" + (f", C {quantity(rating, 'N', 3)}" if rating else "")


def _stronger_bearings(name: str) -> list[str]:
    """Bearings of the same bore with a higher dynamic rating; a designation that begins alike is of the same type (6: deep groove)."""
    try:
        own = catalogue.entry(name)
    except InputError:
        return []
    found = []
    for other, _ in _bearings():
        part = catalogue.entry(other)
        rating = part.bearing.dynamic_rating or 0.0
        if part.bore == own.bore and rating > (own.bearing.dynamic_rating or 0.0):
            found.append((other[:1] != name[:1], type(part.bearing) is not type(own.bearing), part.outer_diameter or 0.0, rating, other))
    return [other for *_, other in sorted(found)]


STRONGER: dict[str, Callable[[str], list[str]]] = {"bearings": _stronger_bearings}
LISTS: dict[str, Callable[[], list[Entry]]] = {"bearings": _bearings}
