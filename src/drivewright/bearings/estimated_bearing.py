"""A bearing out of an estimated inner geometry, with the ratings that ISO 281 and ISO 76 give it."""

from typing import Any

from drivewright.bearings.ball import BallBearing
from drivewright.bearings.dynamic_rating import ball_dynamic_rating, roller_dynamic_rating
from drivewright.bearings.inner_geometry import InnerGeometry
from drivewright.bearings.roller import RollerBearing
from drivewright.bearings.standard_static_rating import ball_standard_static_rating, roller_standard_static_rating
from drivewright.units import SI

FIGURES = 3  # of an estimated rating, as catalogues print it


def geometric_ratings(geometry: InnerGeometry, angle: float) -> tuple[float, float]:
    """(C, C0) [N] of ISO 281 and ISO 76 by an inner geometry and the contact angle [rad]."""
    elements, diameter, pitch, length = geometry
    if length:
        roller = elements, diameter, length, pitch, angle
        return float(roller_dynamic_rating(*roller)), float(roller_standard_static_rating(*roller))
    ball = elements, diameter, pitch, angle
    return float(ball_dynamic_rating(*ball)), float(ball_standard_static_rating(*ball))


def bearing_of_geometry(
    geometry: InnerGeometry, angle: float = 0.0, dynamic_rating: float | None = None, static_rating: float | None = None
) -> BallBearing | RollerBearing:
    """The `BallBearing`, or with a length the `RollerBearing`, of an inner geometry; ratings [N] that are not given are the estimated."""
    estimates = (rounded(rating) for rating in geometric_ratings(geometry, angle))
    given = (dynamic_rating, static_rating)
    ratings = [estimate if rating is None else rating for rating, estimate in zip(given, estimates, strict=True)]
    keys: dict[str, Any] = {
        "pitch_diameter": SI(geometry.pitch_diameter),
        "dynamic_rating": SI(ratings[0]),
        "static_rating": SI(ratings[1]),
    }
    if angle:
        keys["contact_angle"] = SI(angle)
    if not geometry.length:
        return BallBearing(balls=geometry.elements, ball_diameter=SI(geometry.diameter), **keys)
    size = {"roller_diameter": SI(geometry.diameter), "roller_length": SI(geometry.length)}
    return RollerBearing(rollers=geometry.elements, **size, **keys)


def rounded(rating: float) -> float:
    """To the figures of a catalogue."""
    return float(f"{rating:.{FIGURES}g}")
