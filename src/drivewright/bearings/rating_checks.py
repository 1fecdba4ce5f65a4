"""Findings on ratings: those that are estimated from the dimensions, and those that contradict the bearing they are given for."""

from collections.abc import Iterator

import numpy as np

from drivewright.bearings.ball import BallBearing
from drivewright.bearings.catalogue_entry import Entry
from drivewright.bearings.dynamic_rating import basic_dynamic_rating
from drivewright.bearings.roller import RollerBearing
from drivewright.bearings.solving import basic_static_rating
from drivewright.errors import InputError

FAR_OFF = 1.4  # ratio of a rating to that of the geometry; makers' own lie within 1.25 of it either way
RATING_RATIOS = {"ball": (0.35, 1.4), "roller": (0.65, 2.0)}  # C0/C of makers' radial bearings, least and most, with some room
SCATTER = {"ball": 8, "roller": 6}  # per cent, one standard deviation of makers' ratings about the estimate: docs/bearing_catalogue.md


def estimated_keys(entry: Entry) -> tuple[str, ...]:
    """The keys of an entry whose numbers are estimated from its dimensions, ratings among them; () where none is."""
    return tuple(key for source in entry.sources if source.flag == "estimated" for key in source.keys)


def catalogue_findings(
    name: str, designation: str, entry: Entry, dynamic_rating_given: bool = False, static_rating_given: bool = False
) -> Iterator[str]:
    """What is estimated of the bearing of this name in a spec, found by its designation; ratings that the spec gives are not."""
    estimated = estimated_keys(entry)
    if not estimated:
        return
    given = {"dynamic_rating": dynamic_rating_given, "static_rating": static_rating_given}
    missing = [key for key in given if key in estimated and not given[key]]
    bearing, kind = entry.bearing, "ball" if entry.ball else "roller"
    dynamic, static = (_kilonewtons(rating) for rating in (bearing.dynamic_rating, bearing.static_rating))
    numbers = {"dynamic_rating": f"C = {dynamic}", "static_rating": f"C0 = {static}"}
    start = f"bearing {name!r} ({designation}): {entry.description}; its inner geometry is estimated from its dimensions"
    if missing:
        yield (
            f"{start}, and from it {' and '.join(numbers[key] for key in missing)}; the ratings of makers scatter about this by "
            f"±{SCATTER[kind]} %, and present ones are up to 15 % higher; give {' and '.join(missing)} of the maker"
        )
    else:
        yield f"{start}; its stiffness and load distribution depend on that geometry"


def rating_findings(
    name: str, bearing: BallBearing | RollerBearing, dynamic_rating: float | None = None, static_rating: float | None = None
) -> Iterator[str]:
    """Ratings [N] that contradict the inner geometry or each other; those of the bearing itself where they are not given."""
    dynamic = bearing.dynamic_rating if dynamic_rating is None else dynamic_rating
    static = bearing.static_rating if static_rating is None else static_rating
    yield from _against_geometry(name, "dynamic_rating", dynamic, _dynamic_of_geometry(bearing), "ISO 281")
    yield from _against_geometry(name, "static_rating", static, basic_static_rating(bearing), "ISO 76")
    if dynamic and static:
        yield from _against_each_other(name, bearing, static / dynamic)


def _dynamic_of_geometry(bearing) -> float | None:
    try:
        return basic_dynamic_rating(bearing)
    except InputError:  # grooves wider than the standard rates
        return None


def _against_geometry(name, key, given, expected, standard):
    if not given or not expected or 1 / FAR_OFF <= given / expected <= FAR_OFF:
        return
    yield (
        f"bearing {name!r}: {key} {_kilonewtons(given)} is {given / expected:.2g} times the {_kilonewtons(expected)} that {standard} gives "
        "for its inner geometry; check the rating, its unit, and the size of the rolling elements"
    )


def _against_each_other(name, bearing, ratio):
    least, most = RATING_RATIOS["ball" if isinstance(bearing, BallBearing) else "roller"]
    if not least <= ratio <= most:
        yield (
            f"bearing {name!r}: static_rating is {ratio:.2g} times dynamic_rating; for such bearings it is {least:g} to {most:g} times: "
            "check that the two are not exchanged and belong to one bearing"
        )


def _kilonewtons(force) -> str:
    return "unknown" if force is None else f"{np.round(force / 1e3, 4):.3g} kN"
