"""Elliptic gears pivoted at a focus, and the planetary train made of them: closed forms and routes that do not use them."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from drivewright.gears import EllipticGearPair, GearTrain
from drivewright.oracles.seedling_pusher.rolled_motion import rolled_pair
from drivewright.validation.source import AGREES, Printed, Row, Source, rounded

ECCENTRICITY = 0.3
PUBLISHED = np.sqrt(1 - 0.985**2)  # of the transplanter's gears

# Planet relative to the carrier over the carrier angle [deg], two pairs, bend 89 deg turned, near start: an earlier program of ours.
TABLE = {
    30: "21.4077",
    60: "47.6488",
    65: "52.6967",
    86: "76.5794",
    87: "77.8338",
    90: "81.6639",
    120: "125.2498",
    123: "130.0510",
    150: "174.3070",
    180: "219.1554",
    210: "254.5432",
    240: "281.7357",
    253: "291.7316",
    270: "303.6895",
    300: "322.8529",
    330: "341.0806",
    360: "360.0000",
}


def rows() -> Iterator[Row]:
    """The pair, then the train."""
    yield from _pair()
    yield from _train()


def _computed(value: float, unit: str, digits: int = 9) -> Printed:
    """What another route computes, to so many digits of SI."""
    return rounded(f"{value:.{digits}f}" + ("" if unit == "-" else f" {unit}"), unit)


def _pair() -> Iterator[Row]:
    from scipy.special import ellipe

    e, pair, rolled = ECCENTRICITY, EllipticGearPair(ECCENTRICITY, 0.1), rolled_pair(ECCENTRICITY)
    common, ratio = {"pinned": AGREES, "inputs": "eccentricity 0.3, semi-major axis 100 mm"}, (1 - ECCENTRICITY) / (1 + ECCENTRICITY)
    form: dict[str, Any] = {"kind": "closed form", "where": "focal radii in contact", "unit": "-"} | common
    yield Row("ratio, short focal radius of the driver in contact", _computed(ratio, "-"), float(pair.ratio(0.0)), **form)
    yield Row("ratio, long focal radius in contact", _computed(1 / ratio, "-"), float(pair.ratio(np.pi)), **form)
    yield Row("ratio, equal radii in contact", _computed(1, "-"), float(pair.ratio(np.arccos(-e))), **form)
    form |= {"where": "complete elliptic integral", "unit": "m"}
    yield Row("perimeter", _computed(0.4 * ellipe(e**2), "m"), pair.perimeter(), **form)
    for at in (30, 75, 140, 250):
        yield _rolling_row(f"driven angle at {at} deg", rolled(np.radians(at)), float(pair.driven(np.radians(at))), common)


def _train() -> Iterator[Row]:
    pair, bend = EllipticGearPair(PUBLISHED), np.radians(89.0)
    train, rolled = GearTrain((pair, pair), (bend,)), rolled_pair(PUBLISHED)
    common: dict[str, Any] = {"pinned": AGREES, "inputs": "axis ratio 0.985, bend 89 deg turned, near start"}
    table: dict[str, Any] = {"kind": "other code", "where": "earlier program", "unit": "rad"} | common
    for degrees, text in TABLE.items():
        yield Row(f"planet at carrier {degrees} deg", rounded(f"{text} deg", "rad"), float(train.planet(np.radians(degrees)).d0), **table)
    for degrees in (65, 86, 123, 253):
        t = np.radians(degrees)
        other = rolled(bend + rolled(t)) - rolled(bend)
        yield _rolling_row(f"planet at carrier {degrees} deg, rolled", float(other), float(train.planet(t).d0), common)


def _rolling_row(name: str, other: float, ours: float, common: dict[str, Any]) -> Row:
    return Row(name, _computed(other, "rad"), float(ours), "rad", kind="other code", where="ellipses rolled by arc length", **common)


source = Source(
    "elliptic-gears",
    "Two congruent ellipses rolling on each other about their foci (textbook matter; Litvin, Noncircular Gears, recalled)"
    ": closed forms, a rolling by arc length, and a table from an earlier, separate program.",
    rows,
)
