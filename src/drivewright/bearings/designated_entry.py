"""The `Entry` of a designation: dimensions from tables, the inner geometry and the ratings estimated from them."""

from functools import lru_cache

import numpy as np

from drivewright.bearings.boundary_dimensions import BoundaryDimensions, boundary_dimensions, clearance_range
from drivewright.bearings.catalogue_entry import Entry, Source
from drivewright.bearings.designation import BasicDesignation
from drivewright.bearings.estimated_bearing import bearing_of_geometry
from drivewright.bearings.inner_geometry import CYLINDER_ASPECT, LIGHT_ASPECT, InnerGeometry, cylindrical_geometry, estimate_inner_geometry
from drivewright.units import SI

WORDS = {
    "deep-groove": "deep-groove ball bearing",
    "angular-contact": "angular-contact ball bearing",
    "cylindrical": "cylindrical roller bearing; its ribs are not in the model, so that it carries no axial load",
    "tapered": "tapered roller bearing; width is the assembled one, T",
}
LIGHT_SERIES = "10"
DIMENSIONS = "ISO 15 and ISO 355 by the catalogues of SKF and NSK, which agree"
RATINGS = "; C by ISO 281 and C0 by ISO 76 for that geometry"
RULES = {
    "deep-groove": "balls of 0.311 (D - d) - 0.41 mm or 0.723 B, midway between bore and outside, as many as fill 189 deg at assembly",
    "angular-contact": "balls of 0.311 (D - d) - 0.41 mm or 0.723 B, midway between bore and outside, over 87 % of the pitch circle "
    "(82 % at 15 deg)",
    "cylindrical": "rollers over 85 % of the pitch circle, 0.95 times as long as thick (0.75 in series 10)",
    "tapered": "rollers of 0.25 (D - d), midway between bore and outside, over 90 % of the pitch circle, L cos a = 0.60 T",
}
RACEWAYS = "the raceways F and E of the two makers' catalogues, between which the rollers run"
ANGLES = {"angular-contact": "the letters of the designation", "tapered": "e = 1.5 tan a as NSK prints it, to two figures"}

BALL_KEYS = ("balls", "ball_diameter", "pitch_diameter")
ESTIMATED = {
    "deep-groove": BALL_KEYS,
    "angular-contact": BALL_KEYS,
    "cylindrical": ("rollers", "roller_length"),
    "tapered": ("rollers", "roller_diameter", "roller_length", "pitch_diameter"),
}


def designated_entry(designation: BasicDesignation) -> Entry:
    """The `Entry` of a designation of a known series and size; ratings are filled in, and sources flag what is estimated."""
    return as_designated(_plain_entry(designation._replace(clearance="", unread="")), designation)


@lru_cache(maxsize=512)
def _plain_entry(designation: BasicDesignation) -> Entry:
    kind, size = designation.kind, _dimensions(designation)
    angle = size.contact_angle or float(np.radians(designation.angle))
    bearing = bearing_of_geometry(_geometry(designation, size, angle), angle)
    return Entry(
        description=WORDS[kind],
        bore=SI(size.bore),
        outer_diameter=SI(size.outer_diameter),
        width=SI(size.width),
        ball=None if "rollers" in bearing.model_fields_set else bearing,
        roller=bearing if "rollers" in bearing.model_fields_set else None,
        sources=tuple(_sources(designation)),
    )


def as_designated(entry: Entry, designation: BasicDesignation) -> Entry:
    """An entry with what the letters of its designation say: the clearance of its class, and which of them are not read.

    The clearance is the middle of the range before the bearing is mounted.  Fits and temperature take most of it away: give
    radial_clearance where it counts.
    """
    unread = unread_text(designation)
    changes = _with_clearance(entry, designation) | ({"description": f"{entry.description}{unread}"} if unread else {})
    return entry.model_copy(update=changes) if changes else entry


def _with_clearance(entry, designation):
    """What the clearance class changes: the bearing, and the sources where the entry has any."""
    clearance_class = designation.clearance
    limits = clearance_range(designation.kind, entry.bore, clearance_class) if clearance_class and entry.bore else None
    if limits is None:
        return {}
    text = f"middle of class {clearance_class} of ISO 5753-1 before mounting, {1e6 * limits[0]:g} to {1e6 * limits[1]:g} um"
    source = Source(keys=("radial_clearance",), flag="read", text=f"{text}: NSK's and SKF's tables")
    bearing = entry.bearing.model_copy(update={"radial_clearance": sum(limits) / 2})
    others = tuple(each for each in entry.sources if "radial_clearance" not in each.keys)
    return {"ball" if entry.ball else "roller": bearing, "sources": (*others, source) if others else ()}


def unread_text(designation: BasicDesignation) -> str:
    """What of a designation counts for nothing here, as an appendix to a sentence; "" where everything is read."""
    letters = designation.unread
    if designation.clearance and clearance_range(designation.kind, 0.0, designation.clearance) is None:
        letters = f"{designation.clearance} {letters}".strip()
    return f" ({letters!r} of the designation is not taken into account)" if letters else ""


def _dimensions(designation) -> BoundaryDimensions:
    return boundary_dimensions(designation.kind, designation.dimension_series)[designation.code]


def _geometry(designation, size: BoundaryDimensions, angle: float) -> InnerGeometry:
    """Cylindrical rollers run between raceways that are known; else all is estimated."""
    if designation.kind != "cylindrical":
        return estimate_inner_geometry(designation.kind, size.bore, size.outer_diameter, size.width, angle)
    aspect = LIGHT_ASPECT if designation.dimension_series == LIGHT_SERIES else CYLINDER_ASPECT
    inner, outer = size.inner_raceway, size.outer_raceway
    return cylindrical_geometry((inner + outer) / 2, (outer - inner) / 2, aspect)


def _sources(designation):
    kind = designation.kind
    yield Source(keys=("bore", "outer_diameter", "width"), flag="read", text=DIMENSIONS)
    if kind in ANGLES:
        yield Source(keys=("contact_angle",), flag="read", text=ANGLES[kind])
    if kind == "cylindrical":
        yield Source(keys=("roller_diameter", "pitch_diameter"), flag="read", text=RACEWAYS)
    yield Source(keys=(*ESTIMATED[kind], "dynamic_rating", "static_rating"), flag="estimated", text=RULES[kind] + RATINGS)
