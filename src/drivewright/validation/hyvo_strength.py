"""Stress and life of pins and plates of the Hy-Vo chain: section 6 of the paper."""

from collections.abc import Iterator
from functools import cache
from typing import Any

import numpy as np

from drivewright import fatigue
from drivewright.chains.stress import rolling
from drivewright.validation.hyvo_model import (
    CLASSICAL_RADIUS,
    FORCES,
    LINKS,
    MATERIAL_CARD,
    MM,
    MODULUS,
    PINS,
    POISSON,
    SMALLER,
    TENSILE,
    YIELD,
    Z1,
)
from drivewright.validation.source import NOT_COMPARED, OPEN, PRINT_ONLY, Printed, Row, implied, rounded


def rows() -> Iterator[Row]:
    """Pressures of the pins, lives."""
    yield from _pressures()
    yield from _lives()


def pin_stresses(radius: float) -> tuple[float, float]:
    """(p0, greatest von Mises stress below the surface) of two pins of a radius [mm] under 200 N  [Pa]."""
    limits = rolling.pressure_limits(YIELD, POISSON)
    radii = radius * MM, radius * MM
    pressure = float(rolling.rolling_contact(200.0, 6 * MM, radii, MODULUS, POISSON).pressure)
    return pressure, pressure * YIELD / limits.first_yield


def _pressures() -> Iterator[Row]:
    common: dict[str, Any] = {"kind": "other code", "inputs": PINS, "assumed": FORCES, "where": "section 6.1", "pinned": OPEN}
    new, classical = pin_stresses(1.2), pin_stresses(CLASSICAL_RADIUS)
    coarse = (
        "The print leaves out the contact itself: elements of 0.138 mm cannot hold a contact that is 0.030 mm wide (0.074 mm for the "
        f"control group). Hertz's pressure of 200 N over 6 mm is {new[0] / 1e6:.0f} MPa for pins of 1.2 mm and {classical[0] / 1e6:.0f} "
        "MPa for those of 7.4 mm. Which stress beside the contact the paper shows cannot be determined."
    )
    for name, printed, ours in (("group 3", "162.026855", new), ("control group", "245.183578", classical)):
        yield Row(f"maximum stress of a pin, {name}", rounded(f"{printed} MPa", "Pa"), ours[1], "Pa", note=coarse, **common)
    against_conclusion = (
        "The contact stress falls with the root of the radius: small pins have sqrt(7.4/1.2) times as much, against conclusion 4, whose "
        "stresses are those beside the contact."
    )
    yield Row("maximum stress of a pin, group 3 over control", SMALLER, new[1] / classical[1], "-", note=against_conclusion, **common)
    yield Row(
        "maximum stress of a pin over yield stress, group 3",
        Printed("162 << 835: below 0.3", 0.0, 0.3),
        new[1] / YIELD,
        "-",
        note=coarse,
        **common,
    )


@cache
def smooth_bar_life(stress: float) -> float:
    """Repeats of 0 .. stress [Pa] that a smooth bar endures."""
    card = fatigue.uniform_material_law(TENSILE, MODULUS, POISSON)
    history = np.zeros((2, 3, 3))
    history[1, 0, 0] = stress
    return float(fatigue.brown_miller(fatigue.elastic_strain(history, card), history, card).life)


TURNS = 2000 * Z1 / LINKS  # revolutions of the chain in a minute
PLATE_STRESSES = {"group 3": 303.126221, "control group": 468.663269}  # printed, MPa
LIFE_CASES = (  # what, printed, unit, the maximum stress printed for it [MPa], seconds for one repeat (1: repeats are counted)
    ("plate, new chain", "1.64e9", "-", PLATE_STRESSES["group 3"], 1.0),
    ("plate, classical chain", "1.21e8", "-", PLATE_STRESSES["control group"], 1.0),
    ("pin, new chain", "4.560e11 min", "s", 162.026855, 60 / TURNS),
    ("pin, classical chain", "1.164e11 min", "s", 245.183578, 60 / TURNS),
)


def _lives() -> Iterator[Row]:
    common: dict[str, Any] = {"kind": "other code", "where": "section 6, lives", "inputs": "the maximum stresses printed, Brown and Miller"}
    note = (
        "No material curve, mean stress or unit of the plates' lives is printed. Ours is that of the printed stress, once from 0 in a "
        "revolution of the chain; beyond 1e9 it is extrapolated."
    )
    for name, text, unit, stress, period in LIFE_CASES:
        ours, quantity = smooth_bar_life(stress * 1e6) * period, f"life of a smooth bar at the stress printed for the {name}"
        more: dict[str, Any] = {"pinned": OPEN, "assumed": MATERIAL_CARD, "note": note, "reading_of": f"life of the {name}"}
        yield Row(quantity, rounded(text, unit), ours, unit, **more, **common)
    for name, stress in PLATE_STRESSES.items():
        yield Row(
            f"maximum stress printed for the plate, {name}",
            rounded(f"{stress} MPa", "Pa"),
            None,
            "Pa",
            pinned=NOT_COMPARED,
            basis=PRINT_ONLY,
            kind="other code",
            where="section 6.2",
            inputs="F1 = 200 N, F0 = 50 N, 2000 rpm, 1 x 2, 2 mm",
            note="Neither plate is drawn. Running chains with plates drawn by us are computed with drivewright reproduce hyvo-paper.",
            reading_of=f"maximum stress of the plate, {name}",
        )
    ratio = rounded("13.55", "-")
    yield Row("life of the plates, new over classical", ratio, 1.64e9 / 1.21e8, "-", pinned=NOT_COMPARED, basis=PRINT_ONLY, **common)
    slopes = [
        np.log(a / b) / np.log(t / s)
        for a, b, s, t in ((1.64e9, 1.21e8, *PLATE_STRESSES.values()), (4.56e11, 1.164e11, 162.026855, 245.183578))
    ]
    new, classical = PLATE_STRESSES.values()
    ours = np.log(smooth_bar_life(new * 1e6) / smooth_bar_life(classical * 1e6)) / np.log(classical / new)
    note = (
        f"Life falls with the power {slopes[0]:.2f} of the plates' stresses and {slopes[1]:.2f} of the pins', which are lower: for "
        f"steel the opposite holds. Between the plates' two stresses ours is {ours:.1f}."
    )
    yield Row(
        "exponent of life over stress, pins over plates",
        implied("1", 0.9, 1.1),
        float(slopes[1] / slopes[0]),
        "-",
        pinned=NOT_COMPARED,
        basis=PRINT_ONLY,
        note=note,
        **common,
    )
