"""Profile and contacts of plate cams as numbers and tables."""

from collections.abc import Sequence

import numpy as np

from drivewright._typing import Bools, Complexes, Floats
from drivewright.curves import Trimmed
from drivewright.curves.pieces import gather
from drivewright.indexing.contacts import CamContacts
from drivewright.indexing.plane import PinDrive, PlaneDrive, contacts_at
from drivewright.result import Array, Column, Table


def profile_table(drive: PlaneDrive, name: str, title: str = "Cam profile", chords: int = 24) -> Table:
    """Points along the profile with the input angle and the pin that cuts them; curvature positive where the cam is convex."""
    t, points, curvature = _along_spans(drive.profile, chords)
    x, y = points.real, points.imag
    angle, pin = drive.pin_that_cuts(t)
    way = np.sign(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))
    return Table(
        name,
        title,
        (
            Column("angle", "rad", "input angle at which a pin touches this point", angle, "Input angle at contact"),
            Column("pin", "-", "pin that touches this point", pin, "Pin in contact"),
            Column("x", "m", "coordinate x from the cam's centre", x, "Coordinate x"),
            Column("y", "m", "coordinate y from the cam's centre", y, "Coordinate y"),
            Column("curvature", "1/m", "curvature of the profile, positive where the cam is convex", way * curvature),
        ),
    )


def _along_spans(trimmed: Trimmed, chords: int) -> tuple[Floats, Complexes, Floats]:
    """(t [rad], point [m], curvature [1/m], left turns positive) at the ends of as many chords on every span, span after span."""
    spans = trimmed.spans
    t = np.concatenate([np.linspace(span.start, span.stop, chords + 1) for span in spans])
    number = np.repeat(np.arange(len(spans)), chords + 1)
    jet = gather(tuple(span.piece for span in spans), number, t)
    sense = np.array([np.sign(span.stop - span.start) for span in spans])[number]
    return t, jet.d0, np.imag(np.conj(jet.d1) * jet.d2) / np.maximum(np.abs(jet.d1), 1e-300) ** 3 * sense


def least_convex_radius(drive: PlaneDrive) -> float:
    """Least radius of the pitch curve [m] where the trimmed profile is convex; nan where it never is."""
    curvature = drive.orientation * _along_spans(drive.profile, 256)[2]
    sharpest = float(np.max(curvature, initial=0.0))
    return 1 / sharpest + drive.pin_radius if sharpest > 0 else np.nan


def find_all_contacts(drive: PinDrive, angles: Floats) -> list[CamContacts]:
    """Contacts of one cam of each shape at the input angles (n,) [rad]; pins of the second level count on from those of the first."""
    levels = [contacts_at(level, angles) for level in drive.levels]
    shifted = [[each._replace(pin=each.pin + drive.levels[0].pins * k) for each in level] for k, level in enumerate(levels)]
    return [CamContacts(*(np.concatenate(parts) for parts in zip(*each, strict=True))) for each in zip(*shifted, strict=True)]


def best_pressure_angles(contacts: Sequence[CamContacts], circle_radius: float) -> Floats:
    """(2, n) [rad]: pressure angle of the intended contact that pushes best forward, and backward, in each set; nan where none does."""
    best = np.full((2, len(contacts)), np.nan)
    for row, each in enumerate(contacts):
        for side, sign in enumerate((1, -1)):
            arms = sign * each.arm[each.intended]
            if np.any(arms > 0):
                best[side, row] = np.arccos(min(np.max(arms) / circle_radius, 1.0))
    return best


def driving_pressure_angle(acceleration: Floats, best: Floats) -> Floats:
    """Pressure angle (n,) [rad] in the direction in which the wheel is accelerated; the worse of both where it is not.

    acceleration (n,): d2 phi/d theta2; best (2, n) [rad]: of the pin pushed best forward, backward.
    """
    still = np.abs(acceleration) <= 1e-9 * np.max(np.abs(acceleration), initial=1e-9)
    return np.where(still, np.fmax(best[0], best[1]), np.where(acceleration > 0, best[0], best[1]))


def contact_points_table(angles: Floats, contacts: Sequence[CamContacts], drive: PinDrive, pin_radius: float) -> Table:
    """Every contact of cam 0, one row each."""
    live = [each.intended for each in contacts]
    column = {
        key: np.concatenate([getattr(each, key)[keep] for each, keep in zip(contacts, live, strict=True)])
        for key in ("pin", "centre", "normal", "arm", "curvature")
    }
    at = column["centre"] - pin_radius * column["normal"]
    return Table(
        "contact_points",
        "Contact points of one cam",
        (
            Column("angle", "rad", "input angle", np.repeat(angles, [np.sum(keep) for keep in live])),
            Column("pin", "-", "pin", column["pin"].astype(float)),
            Column("pin_forward", "-", "pin pushed forward", np.where(column["arm"] > 0, column["pin"], np.nan)),
            Column("pin_backward", "-", "pin pushed backward", np.where(column["arm"] < 0, column["pin"], np.nan)),
            Column("x", "m", "coordinate x of the contact point from the wheel's axis", at.real, "Coordinate x of the contact point"),
            Column("y", "m", "coordinate y of the contact point from the wheel's axis", at.imag, "Coordinate y of the contact point"),
            Column(
                "arm", "m", "moment arm of the contact about the wheel's axis, positive forward", column["arm"], "Moment arm of the contact"
            ),
            Column(
                "pressure_angle",
                "rad",
                "pressure angle, between the normal and the motion of the pin",
                np.arccos(np.minimum(np.abs(column["arm"]) / drive.circle_radius, 1)),
            ),
            Column("curvature", "1/m", "curvature of the profile, positive where the cam is convex", column["curvature"]),
        ),
    )


def contact_ways(contacts: Sequence[CamContacts], drive: PinDrive) -> tuple[Bools, Floats]:
    """(touching, way), both (sets, pins): whether a pin touches a cam, and 1 where that pushes it forward, -1 backward, 0 neither way."""
    pins = drive.levels[0].pins * len(drive.levels)
    touching, way = np.zeros((len(contacts), pins), dtype=bool), np.zeros((len(contacts), pins))
    for row, each in enumerate(contacts):
        touching[row, each.pin[each.intended]] = True
        way[row, each.pin[each.intended]] = np.sign(each.arm[each.intended])
    return touching, way


def contact_count_table(angles: Floats, contacts: Sequence[CamContacts], drive: PinDrive, driving: Floats, best: Floats) -> Table:
    """How many pins touch one cam at every input angle, which way it can push them, and the pressure angles of the best ones.

    driving (n,) [rad] and best (2, n) [rad] as of `driving_pressure_angle` and `best_pressure_angles`.
    """
    touching, way = contact_ways(contacts, drive)
    least = "least pressure angle of the pins that the cam can push"
    return Table(
        "contacts",
        "Pins in contact with one cam",
        (
            Column("angle", "rad", "input angle", angles),
            Column("pins", "-", "pins in contact", touching.sum(axis=1).astype(float)),
            Column("forward", "-", "pins that the cam can push forward", np.sum(way > 0, axis=1).astype(float)),
            Column("backward", "-", "pins that the cam can push backward", np.sum(way < 0, axis=1).astype(float)),
            Column("pressure_angle", "rad", "pressure angle of the driving pin", driving),
            Column("pressure_angle_forward", "rad", f"{least} forward", best[0], "Pressure angle, forward"),
            Column("pressure_angle_backward", "rad", f"{least} backward", best[1], "Pressure angle, backward"),
        ),
    )


def contact_map_array(angles: Floats, contacts: Sequence[CamContacts], drive: PinDrive) -> Array:
    """(angle, pin): 1 where the pin touches and is pushed forward, -1 backward, 0.5 neither way, 0 where it does not touch."""
    touching, way = contact_ways(contacts, drive)
    names = (tuple(f"{np.degrees(angle):.6g}°" for angle in angles), tuple(str(k) for k in range(touching.shape[1])))
    return Array("-", ("angle", "pin"), names, np.where(touching, np.where(way == 0, 0.5, way), 0.0))


def angle_ranges(angles: Floats, mask: Bools, most: int = 6) -> str:
    """The stretches of rising angles [rad] in which a mask is True as text in degrees, `most` of them: "0 to 13.5, 180 deg"."""
    degrees = np.degrees(angles)
    edges = np.flatnonzero(np.diff(np.concatenate([[0], mask.astype(int), [0]])))
    parts = [
        f"{degrees[a]:.4g}" if b - a == 1 else f"{degrees[a]:.4g} to {degrees[b - 1]:.4g}"
        for a, b in zip(edges[::2], edges[1::2], strict=True)
    ]
    return f"{', '.join(parts[:most])}{' ...' if len(parts) > most else ''}°"
