"""Least radii of curvature of a cam, and how large a flat-faced follower and its cam must be."""

from dataclasses import replace
from typing import Any

import numpy as np

from drivewright.cams.cycle import Cycle, Extreme
from drivewright.cams.followers import ContactAt, OscillatingFlat, TranslatingFlat, flat_radius
from drivewright.curves import derivative
from drivewright.numerics.roots import roots_in_brackets


def min_flat_radius(cycle: Cycle, follower: TranslatingFlat | OscillatingFlat) -> Extreme:
    """Least radius of curvature [m] of the profile under a flat face, negative where it is undercut, and where."""
    return cycle.minimum(lambda angle, lift: flat_radius(*follower.face(angle, lift)))


def min_pitch_radius(cycle: Cycle, contact_at: ContactAt, sign: int) -> Extreme:
    """Least radius of curvature [m] of the pitch curve where it is convex (sign +1) or concave (-1), and where; nan if nowhere."""
    sharpest = cycle.maximum(lambda angle, lift: sign * contact_at(angle, lift).pitch_curvature)
    with np.errstate(divide="ignore"):
        radius = np.divide(1.0, sharpest.value)
    return sharpest._replace(value=radius).where(np.greater(sharpest.value, 0))


def min_base_radius(cycle: Cycle, follower: TranslatingFlat | OscillatingFlat) -> Any:
    """Base radius [m] below which a flat face undercuts the profile: 0 where none is too small, nan where none is large enough.

    Translating: max(0, -min(s + s'') cos tilt), exact, as the radius of curvature is R + (s + s'') cos tilt.  Oscillating: the
    base radius at which the least radius of curvature is zero.
    """

    def sharpest(radius):
        changed = replace(follower, base_radius=radius)
        return min_flat_radius(cycle, changed).value

    if isinstance(follower, TranslatingFlat):
        return np.maximum(0.0, follower.base_radius - sharpest(follower.base_radius))
    highest = cycle.maximum(lambda _, lift: lift).value
    # The lever is short of its dead point at the greatest lift.
    low, high = 1e-6 * follower.pivot_distance, follower.face_offset + follower.pivot_distance * np.cos(highest) * (1 - 1e-9)
    low = np.maximum(low, follower.face_offset - follower.pivot_distance * (1 - 1e-9))
    at_low, at_high = np.asarray(sharpest(low)), np.asarray(sharpest(high))
    root = roots_in_brackets(sharpest, np.asarray(low), np.asarray(high), at_low, at_high)
    return np.where(at_low >= 0, 0.0, np.where(at_high < 0, np.nan, root))[()]


def face_ends(cycle: Cycle, follower: TranslatingFlat | OscillatingFlat) -> tuple[float, float]:
    """(least, greatest) place of the contact along a flat face [m].

    Translating: from where the follower's line meets the face, positive on the side that the cam surface moves to on a rise;
    oscillating: from the foot of the pivot.
    """

    def along(angle, lift):
        if not isinstance(follower, TranslatingFlat):
            return follower.reach * follower.contact(angle, lift).leverage
        cos, sin = np.cos(follower.tilt), np.sin(follower.tilt)
        foot = (follower.base_radius + follower.offset * sin) / cos + lift
        return cos * derivative(lift) - follower.offset * cos - sin * foot

    return cycle.minimum(along).value, cycle.maximum(along).value
