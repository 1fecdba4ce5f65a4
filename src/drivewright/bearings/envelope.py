"""A rolling bearing of one's own by its envelope and ratings alone: type, bore, outer diameter, width, C and C0.

The inner geometry is that of `inner_geometry`, moved as far as the given ratings ask: least squares of what C, C0 and the rule say,
each over its scatter.  C0 counts most, for it hangs on the geometry alone, while makers rate C of today's steel above the standard.
"""

from typing import NamedTuple

import numpy as np
from pydantic import model_validator

from drivewright.bearings.ball import BallBearing
from drivewright.bearings.dynamic_rating import ball_dynamic_rating
from drivewright.bearings.estimated_bearing import bearing_of_geometry, geometric_ratings
from drivewright.bearings.inner_geometry import BearingType, InnerGeometry, estimate_inner_geometry
from drivewright.bearings.roller import RIGHT_ANGLE, RollerBearing
from drivewright.bearings.standard_static_rating import ball_standard_static_rating
from drivewright.errors import SpecError
from drivewright.spec import Spec
from drivewright.spec.fields import Field
from drivewright.units import Angle, Force, Length

DEFAULT_ANGLES = {"angular-contact": np.radians(40), "tapered": np.radians(14)}
ANGLE_LIMITS = {"angular-contact": (10, 45), "tapered": (8, 32)}  # deg
LEAST_SECTION = 5e-3  # D - d [m], below which the rule leaves the bearings it was fitted to
WIDTHS = 0.15, 2.0  # of B/(D - d), least and most of radial bearings
DYNAMIC_SCATTER, STATIC_SCATTER = 0.06, 0.02  # of ln C and ln C0 that makers print about the standards
RULE_SCATTER = 0.06  # of the logarithms of diameter and number of balls about the rule
LENGTH_SCATTER = 0.10  # of that of a roller's length
BALL_SHARES = 0.20, 0.38  # of D - d that a ball can have
FEWEST = 0.7  # of the balls that the rule puts in
FULLEST_ASSEMBLY, FULLEST_PITCH = np.radians(205), 0.95  # filling angle of deep-groove bearings; part of the pitch circle of others
LONGEST = 0.85  # L cos a of a roller over the width of the bearing
DYNAMIC_MISS, STATIC_MISS = 1.35, 1.15  # ratios of given to reachable rating that are refused beyond
FINENESS = 241  # diameters that are tried for every number of balls


class Envelope(Spec):
    """A rolling bearing by type, boundary dimensions and ratings; its inner geometry is estimated."""

    type: BearingType = Field(description="type of the bearing", examples=["deep-groove"])
    bore: Length = Field(gt=0, description="bore of the inner ring", examples=["30 mm"])
    outer_diameter: Length = Field(gt=0, description="outer diameter of the outer ring", examples=["72 mm"])
    width: Length = Field(gt=0, description="width of the bearing; for a tapered bearing the assembled width T", examples=["19 mm"])
    contact_angle: Angle | None = Field(
        None, gt=0, lt=RIGHT_ANGLE, description="nominal contact angle; default 40 deg for angular-contact, 14 deg for tapered bearings"
    )
    dynamic_rating: Force | None = Field(None, gt=0, description="basic dynamic load rating C; default estimated")
    static_rating: Force | None = Field(None, gt=0, description="basic static load rating C0; default estimated")

    @property
    def nominal_angle(self) -> float:
        """The contact angle [rad], given or usual for the type; 0 of deep-groove and cylindrical bearings."""
        return float(DEFAULT_ANGLES.get(self.type, 0.0)) if self.contact_angle is None else self.contact_angle

    @model_validator(mode="after")
    def _has_a_section(self):
        section = self.outer_diameter - self.bore
        if section < LEAST_SECTION:
            raise SpecError(
                f"{1e3 * self.outer_diameter:g} mm leaves {1e3 * section:g} mm of section outside the bore of {1e3 * self.bore:g} mm; "
                f"the rule for inner geometries begins at {1e3 * LEAST_SECTION:g} mm",
                key="outer_diameter",
            )
        least, most = WIDTHS
        if not least <= self.width / section <= most:
            raise SpecError(
                f"{1e3 * self.width:g} mm is {self.width / section:.2g} times D - d = {1e3 * section:g} mm; single-row bearings have "
                f"{least:g} to {most:g} times: check the unit",
                key="width",
            )
        return self


def _refuse_other_angle(envelope: Envelope) -> None:
    """SpecError where the contact angle is not of the bearing's type."""
    if envelope.contact_angle is None:
        return
    if envelope.type not in ANGLE_LIMITS:
        raise SpecError(f"a {envelope.type} bearing has none; leave it out, or take another type", key="contact_angle")
    least, most = ANGLE_LIMITS[envelope.type]
    if not least <= np.degrees(envelope.contact_angle) <= most + 1e-9:
        raise SpecError(
            f"{np.degrees(envelope.contact_angle):.4g}° is outside the {least} to {most}° of {envelope.type} bearings", key="contact_angle"
        )


class GivenRatings(NamedTuple):
    """C and C0 [N] as the user gives them, None where not."""

    dynamic: float | None
    static: float | None


def bearing_of_envelope(envelope: Envelope) -> BallBearing | RollerBearing:
    """The `BallBearing` or `RollerBearing` that fits an envelope and meets its ratings best; ratings not given are of its geometry.

    SpecError names the rating that no inner geometry within the envelope comes near, or an angle that is none of the type.
    """
    _refuse_other_angle(envelope)
    angle, given = envelope.nominal_angle, GivenRatings(envelope.dynamic_rating, envelope.static_rating)
    size = envelope.bore, envelope.outer_diameter, envelope.width
    geometry = estimate_inner_geometry(envelope.type, *size, angle)
    if given != (None, None):
        geometry = _fitted_rollers(envelope, geometry, given) if geometry.length else _fitted_balls(envelope, geometry, given)
        _refuse_far(envelope, geometry, given)
    return bearing_of_geometry(geometry, angle, *given)


def _fitted_balls(envelope: Envelope, rule: InnerGeometry, given: GivenRatings) -> InnerGeometry:
    """The number and diameter with the least sum of squares, of all that go in."""
    balls, diameters, fits = _candidates(envelope, rule)
    numbers = balls, diameters, rule.pitch_diameter, envelope.nominal_angle
    misses = (
        _miss(diameters, rule.diameter, RULE_SCATTER),
        _miss(balls, rule.elements, RULE_SCATTER),
        _miss(ball_dynamic_rating(*numbers), given.dynamic, DYNAMIC_SCATTER),
        _miss(ball_standard_static_rating(*numbers), given.static, STATIC_SCATTER),
    )
    count, size = np.unravel_index(np.argmin(np.where(fits, sum(misses), np.inf)), fits.shape)
    return InnerGeometry(int(balls[count, 0]), _to_micrometres(diameters[0, size]), rule.pitch_diameter)


def _candidates(envelope, rule):
    """Numbers of balls (n, 1), diameters (1, m) [m], and which of them (n, m) go in side by side."""
    section, pitch = envelope.outer_diameter - envelope.bore, rule.pitch_diameter
    least, most = (share * section for share in BALL_SHARES)
    diameters = np.geomspace(least, min(most, envelope.width), FINENESS)[None, :]
    balls = np.arange(np.ceil(FEWEST * rule.elements), int(np.pi * pitch / least) + 1)[:, None]
    step = 2 * np.arcsin(diameters / pitch)
    conrad = envelope.type == "deep-groove"
    fits = (balls - 1) * step <= FULLEST_ASSEMBLY if conrad else balls * step <= FULLEST_PITCH * 2 * np.pi
    return balls, diameters, fits


def _to_micrometres(length):
    return float(np.round(1e6 * length) / 1e6)


def _miss(value, wanted, scatter):
    return 0.0 if wanted is None else np.square(np.log(value / wanted) / scatter)


def _fitted_rollers(envelope: Envelope, rule: InnerGeometry, given: GivenRatings) -> InnerGeometry:
    """Rollers of another length: the least squares of ln L, with C ~ L^(7/9) and C0 ~ L, up to what the width holds."""
    weighted, weights = 0.0, 1 / LENGTH_SCATTER**2
    ratings = geometric_ratings(rule, envelope.nominal_angle)
    for rating, wanted, power, scatter in zip(ratings, given, (7 / 9, 1.0), (DYNAMIC_SCATTER, STATIC_SCATTER), strict=True):
        if wanted is not None:
            weighted += power * np.log(wanted / rating) / scatter**2
            weights += power**2 / scatter**2
    longest = LONGEST * envelope.width / np.cos(envelope.nominal_angle)
    return rule._replace(length=_to_micrometres(min(rule.length * np.exp(weighted / weights), longest)))


def _refuse_far(envelope, geometry, given):
    """The rating that the best geometry misses by more than makers' practice explains."""
    of_geometry = geometric_ratings(geometry, envelope.nominal_angle)
    for key, reached, wanted, most in zip(
        ("dynamic_rating", "static_rating"), of_geometry, given, (DYNAMIC_MISS, STATIC_MISS), strict=True
    ):
        if wanted is not None and not 1 / most <= wanted / reached <= most:
            elements = f"{geometry.elements} {'rollers' if geometry.length else 'balls'} of {1e3 * geometry.diameter:.4g} mm"
            length = f", {1e3 * geometry.length:.4g} mm long," if geometry.length else ""
            raise SpecError(
                f"{wanted / 1e3:.4g} kN does not go with the envelope: {elements}{length} that fit it best have {reached / 1e3:.4g} kN; "
                "check the rating, its unit, and that both ratings are of this bearing",
                key=key,
            )
