"""All lives of a bearing in equilibrium: basic (ISO 281), reference (ISO/TS 16281) and modified (lubricant, contamination, reliability)."""

from typing import NamedTuple

import numpy as np

from drivewright.bearings.equivalent_loads import EquivalentLoad, equivalent_load
from drivewright.bearings.life import basic_life, life_exponent, static_rating
from drivewright.bearings.lubricant import Lubrication, contamination_factor, operating_viscosity
from drivewright.bearings.modified_life import (
    fatigue_limit_load,
    life_modification_factor,
    reference_load,
    reference_viscosity,
    reliability_factor,
)
from drivewright.bearings.solving import BearingEquilibrium, contact_of


class RatingLives(NamedTuple):
    """P and its factors; lives [revolutions], kappa and a_ISO [-]; None where unknown, lives infinite where nothing loads the bearing."""

    equivalent: EquivalentLoad | None
    basic: float | None
    reference: float | None
    viscosity_ratio: float | None
    modification: float | None
    modified: float | None


def rating_lives(state: BearingEquilibrium, speed: float | None = None, lubrication: Lubrication | None = None) -> RatingLives:
    """The `RatingLives` of a bearing at a speed [rad/s]; without one those that need none.

    The modified life is a1 a_ISO L10r, with the load P_ref that gives L10r.
    """
    bearing = state.bearing
    equivalent = equivalent_load(bearing, state.force)
    basic = None
    if equivalent is not None:
        basic = basic_life(bearing, equivalent.load) if equivalent.load > 0 else np.inf
    basic, reference = (None if bearing.dynamic_rating is None else life for life in (basic, state.reference_life))
    diameter = getattr(bearing, "pitch_diameter", None)  # a kind of one's own need not have one
    if not speed or reference is None or diameter is None:
        return RatingLives(equivalent, basic, reference, None, None, None)
    return RatingLives(equivalent, basic, reference, *_modified(bearing, reference, speed, diameter, lubrication or Lubrication()))


def _modified(bearing, life, speed, diameter, lubrication):
    """(kappa, a_ISO, modified life [revolutions]) from the reference life [revolutions]; pitch diameter [m]."""
    contact = contact_of(bearing)
    kappa = operating_viscosity(lubrication) / reference_viscosity(speed, diameter)
    if not np.isfinite(life):
        return kappa, None, np.inf
    load = reference_load(bearing.dynamic_rating, life, life_exponent(bearing))
    limit = contamination_factor(lubrication, diameter) * fatigue_limit_load(static_rating(bearing), diameter, contact)
    factor = life_modification_factor(kappa, limit / load, contact)
    return kappa, factor, reliability_factor(lubrication.reliability) * factor * life


def life_load_ratio(state: BearingEquilibrium, lives: RatingLives) -> float | None:
    """P_ref/P [-]: load that gives the reference life over the equivalent load by X and Y; None where one of the two is not known."""
    if lives.basic is None or lives.reference is None or not np.isfinite(lives.basic) or not np.isfinite(lives.reference):
        return None
    return float((lives.basic / lives.reference) ** (1 / life_exponent(state.bearing)))
