"""A rolling bearing under load as values and findings of a result."""

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from drivewright.bearings.equivalent_loads import STEEPEST, equivalent_static_load
from drivewright.bearings.life import life_duration, life_exponent, static_rating
from drivewright.bearings.lives import RatingLives, life_load_ratio, rating_lives
from drivewright.bearings.load_spectrum import SLOPES, checked_shares, mean_load, mean_speed, spectrum_life, system_life
from drivewright.bearings.lubricant import Lubrication
from drivewright.bearings.modified_life import THINNEST
from drivewright.bearings.solving import BearingEquilibrium, RollingBearing, contact_of
from drivewright.result import Value

REVOLUTIONS = "rev"  # unit of a life
SPEED, CYCLE = "at the shaft's speed", "over the duty cycle"  # what a life in time is counted by
NOTICED = 1.25  # ratio of the loads behind L10r and L10 from which a finding tells: a factor of two in the life of balls
SLIDING = 1e-6  # axial over radial force below which a cylindrical roller bearing counts as loaded radially alone
# kind of life: words, symbol, what it comes from
LIVES = {
    "basic_life": ("basic life", "L10", "from the equivalent load P, ISO 281"),
    "reference_life": ("reference life", "L10r", "from the load on every rolling element, ISO/TS 16281"),
    "modified_life": ("modified life", "Lnm", "a1 a_ISO L10r with lubricant, contamination and reliability, ISO 281"),
}


class DutyCase(NamedTuple):
    """One case of a duty cycle: its share of the time [-], the speed [rad/s] and the bearing under its load."""

    share: float
    speed: float
    state: BearingEquilibrium


def load_values(name: str, state: BearingEquilibrium) -> dict[str, Value]:
    """Load [N] and pressure [Pa] of the rolling elements of the bearing of this name, and its static safety by pressure and by rating."""
    of, key = f"of bearing {name!r}", f"bearings.{name}"
    loaded = int(np.sum(state.element_loads > 0))
    values = {
        f"{key}.max_element_load": Value(
            float(state.element_loads.max()),
            "N",
            f"maximum load of a rolling element {of}",
            label=f"Maximum element load, bearing {name!r}",
        ),
        f"{key}.max_pressure": Value(
            float(state.pressures.max()),
            "Pa",
            f"maximum Hertz pressure {of}, over all its contacts",
            label=f"Maximum pressure in bearing {name!r}",
        ),
        f"{key}.loaded_elements": Value(float(loaded), "-", f"loaded elements {of}, number of rolling elements that carry load"),
    }
    if loaded:
        values[f"{key}.static_safety"] = Value(
            state.static_safety, "-", f"static safety {of}, load at the permissible contact pressure over actual load"
        )
    return values | _rating_values(name, state.bearing) | _static_rating_values(name, state)


def _rating_values(name, bearing):
    """C and C0 that the lives and safeties count with."""
    values = {
        f"bearings.{name}.static_rating": Value(
            static_rating(bearing), "N", f"static rating C0 of bearing {name!r}, basic static load rating"
        )
    }
    if bearing.dynamic_rating is not None:
        meaning = f"dynamic rating C of bearing {name!r}, basic dynamic load rating"
        values[f"bearings.{name}.dynamic_rating"] = Value(bearing.dynamic_rating, "N", meaning)
    return values


def _static_rating_values(name, state):
    """s0 = C0/P0 (ISO 76), where its factors are known."""
    static = equivalent_static_load(state.bearing, state.force)
    if static is None or not static.load > 0:
        return {}
    meaning = f"static safety C0/P0 of bearing {name!r}, static rating over equivalent static load, ISO 76"
    return {f"bearings.{name}.static_rating_safety": Value(static_rating(state.bearing) / static.load, "-", meaning)}


def life_values(
    name: str, state: BearingEquilibrium, speed: float | None = None, lubrication: Lubrication | None = None
) -> dict[str, Value]:
    """Equivalent load [N]; basic, reference and modified life in revolutions, and at a speed [rad/s] in time [s]; without those that
    are not known.  The modified life, its a_ISO and the viscosity ratio want a speed; lubrication is that of `Lubrication()` if not given.
    """
    lives, values, of, key = rating_lives(state, speed, lubrication), {}, f"of bearing {name!r}", f"bearings.{name}"
    if lives.equivalent is not None and lives.equivalent.load > 0:
        values[f"{key}.equivalent_load"] = Value(lives.equivalent.load, "N", f"equivalent load P {of}, {_factor_text(lives)}")
    values |= _life_pairs(name, lives, speed)
    if lives.viscosity_ratio is not None:
        values[f"{key}.viscosity_ratio"] = Value(
            lives.viscosity_ratio, "-", f"viscosity ratio {of}, kappa: operating over reference viscosity"
        )
    if lives.modification is not None:
        values[f"{key}.a_iso"] = Value(lives.modification, "-", f"factor a_ISO {of}, life modification factor of ISO 281")
    return values


def _factor_text(lives: RatingLives) -> str:
    given = lives.equivalent
    return f"X Fr + Y Fa by {given.source}" if given is not None and given.Y else "equal to the radial force"


def _life_pairs(name: str, lives: RatingLives, speed: float | None) -> dict[str, Value]:
    """Each life that is finite, as revolutions and at a speed as time."""
    values = {}
    for kind, life in (("basic_life", lives.basic), ("reference_life", lives.reference), ("modified_life", lives.modified)):
        if life is not None and np.isfinite(life):
            values |= _life_pair(name, kind, life, life_duration(life, speed) if speed else None, SPEED)
    return values


def _life_pair(name: str, kind: str, revolutions: float, time: float | None, basis: str) -> dict[str, Value]:
    """One life in revolutions and, where it is known, in time [s], at a speed or over a cycle."""
    key, (words, symbol, source) = f"bearings.{name}.{kind}", LIVES[kind]
    over = f", {basis}" if basis == CYCLE else ""
    values = {
        key: Value(
            float(revolutions),
            REVOLUTIONS,
            f"{symbol} revolutions of bearing {name!r}, {words} {source}{over}",
            label=f"{words} {symbol}, bearing {name!r}",
        )
    }
    if time is not None:
        values[f"{key}.time"] = Value(
            float(time), "s", f"{words} of bearing {name!r}, {symbol}h {basis}", label=f"{words} {symbol}h, bearing {name!r}"
        )
    return values


def spectrum_values(name: str, cases: Sequence[DutyCase], lubrication: Lubrication | None = None) -> dict[str, Value]:
    """Mean load [N] and lives of a bearing over a duty cycle, each as revolutions and as time [s]: Miner's sum over the cases.

    A life that one of the turning cases does not have is left out; empty where nothing turns.
    """
    shares, speeds = checked_shares([case.share for case in cases]), np.abs([case.speed for case in cases])
    if not shares @ speeds > 0:
        return {}
    lives = [rating_lives(case.state, case.speed, lubrication) for case in cases]
    values = _mean_load_values(name, cases, lives)
    for kind, column in zip(LIVES, zip(*((each.basic, each.reference, each.modified) for each in lives), strict=True), strict=True):
        time = _spectrum_time(shares, speeds, column)
        if time is not None and np.isfinite(time):
            values |= _life_pair(name, kind, time * mean_speed(shares, speeds) / (2 * np.pi), time, CYCLE)
    return values


def _mean_load_values(name, cases, lives):
    """The mean load, where every case has an equivalent one."""
    if any(each.equivalent is None for each in lives):
        return {}
    columns = [case.share for case in cases], [case.speed for case in cases], [each.equivalent.load for each in lives]
    load = mean_load(*columns, life_exponent(cases[0].state.bearing))
    return {
        f"bearings.{name}.mean_load": Value(
            load, "N", f"mean load of bearing {name!r}, constant load with the basic life of the duty cycle"
        )
    }


def _spectrum_time(shares, speeds, lives):
    """Life [s] of the cycle from the cases' lives [revolutions]; None where a case that turns has none."""
    if any(life is None for life, speed in zip(lives, speeds, strict=True) if speed > 0):
        return None
    return spectrum_life(shares, [life_duration(life, speed) if speed > 0 else np.inf for life, speed in zip(lives, speeds, strict=True)])


def system_values(bearings: Mapping[str, RollingBearing], values: Mapping[str, Value]) -> dict[str, Value]:
    """Lives [s] that all bearings of a shaft reach together, from `life_values` or `spectrum_values` of each loaded one by its name.

    Of each kind of life that every one of them has; it has the reliability of the single lives.  None for fewer than two bearings.
    """
    slopes, found = [SLOPES[contact_of(bearing)] for bearing in bearings.values()], {}
    if len(slopes) < 2:
        return {}
    for kind, (words, symbol, _) in LIVES.items():
        single = [values.get(f"bearings.{name}.{kind}.time") for name in bearings]
        lives = [each.value for each in single if each is not None]
        if len(lives) == len(slopes):
            meaning = f"{words} of all bearings together, {symbol}h with Weibull slopes {_slope_text(slopes)}"
            label = f"{words} {symbol}h of all bearings"
            found[f"shaft.system_{kind}.time"] = Value(system_life(lives, slopes), "s", meaning, label=label)
    return found


def _slope_text(slopes: Sequence[float]) -> str:
    """The slopes that occur, as fractions."""
    names = {SLOPES["point"]: "10/9 (balls)", SLOPES["line"]: "9/8 (rollers)"}
    return " and ".join(names[slope] for slope in sorted(set(slopes), reverse=True))


def bearing_findings(
    name: str, state: BearingEquilibrium, speed: float | None = None, lubrication: Lubrication | None = None
) -> Iterator[str]:
    """Why a life is absent, where the two ways to the life of a combined load differ, where kappa is too small, and elements that bear
    where an angular-contact bearing has no shoulder."""
    lives = rating_lives(state, speed, lubrication)
    yield from _absent_lives(name, state, lives)
    yield from _differing_lives(name, state, lives)
    if lives.viscosity_ratio is not None and lives.viscosity_ratio < THINNEST:
        yield (
            f"bearing {name!r}: viscosity ratio {lives.viscosity_ratio:.2g}, below {THINNEST:g}, the lower limit of ISO 281 for a film; "
            f"its modified life uses a_ISO = {THINNEST:g}. Take a thicker lubricant, or judge the bearing by its static safety"
        )
    if state.bearing.contact_angle and state.reversed_elements:
        yield (
            f"bearing {name!r}: {state.reversed_elements} of its elements bear on the side that an angular-contact bearing does not have; "
            "give more preload or axial load, or reverse the bearing (carries)"
        )


def _absent_lives(name, state, lives):
    """Why a bearing has no life, or none by ISO 281; and an axial force that does not count in it."""
    axial, radial = abs(state.force[2]), np.hypot(state.force[0], state.force[1])
    if state.bearing.dynamic_rating is None:
        yield f"life of bearing {name!r} is absent: it has no dynamic_rating"
    elif state.bearing.contact_angle > STEEPEST:
        yield f"basic life of bearing {name!r} is absent: a contact angle above 45° makes it a thrust bearing in ISO 281"
    if contact_of(state.bearing) == "line" and not state.bearing.contact_angle and axial > SLIDING * radial:
        yield (
            f"bearing {name!r}: the axial force of {axial:.4g} N on a cylindrical roller bearing is carried by its ribs in sliding and "
            "enters neither P = Fr nor the lives; compare it with the maker's permissible axial load"
        )


def _differing_lives(name, state, lives):
    """Where L10r is that of a load other than P by more than `NOTICED`; of rollers, whose L10r is the longer one as a rule, only above."""
    ratio = life_load_ratio(state, lives)
    if ratio is None or not (ratio > NOTICED or (ratio < 1 / NOTICED and contact_of(state.bearing) == "point")):
        return
    why = "clearance, preload, tilt or a narrow load zone" if ratio > 1 else "the contact angle under load"
    yield (
        f"bearing {name!r}: the reference life is {ratio ** -life_exponent(state.bearing):.2g} times the basic life. It includes {why}; "
        "the factors of ISO 281 assume a bearing without clearance. Prefer it where the inner geometry is that of the bearing"
    )
