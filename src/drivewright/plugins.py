"""What other packages bring: everything installed under an entry point group, and the object behind a name."""

from functools import cache
from importlib.metadata import EntryPoint, entry_points
from typing import Any

from drivewright.errors import InputError, UnknownName

OURS = "drivewright"


@cache
def installed(group: str) -> dict[str, EntryPoint]:
    """Name -> entry point of everything installed under `group`; InputError where two packages claim one name."""
    points = {}
    for point in entry_points(group=group):
        other = points.setdefault(point.name, point)
        if other.value != point.value:
            raise InputError(f"{group}: {point.name!r} is claimed by {other.value} and by {point.value}; uninstall one of the packages")
    return points


@cache
def load(group: str, name: str, what: str = "plug-in") -> Any:
    """The object behind a name of a group; UnknownName with the nearest name otherwise."""
    known = installed(group)
    if name not in known:
        raise UnknownName(what, name, known)
    try:
        return known[name].load()
    except ImportError as error:
        owner = getattr(getattr(known[name], "dist", None), "name", OURS)
        if owner == OURS:
            raise
        raise InputError(f"{what} {name!r} of the package {owner!r} does not load: {error}; repair or uninstall the package") from error
