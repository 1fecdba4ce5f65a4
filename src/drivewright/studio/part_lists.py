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


LISTS: dict[str, Callable[[], list[Entry]]] = {"bearings": _bearings}
