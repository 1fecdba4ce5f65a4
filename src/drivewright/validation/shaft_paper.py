"""The shafts of a pipe-lining machine of Li, Zhang and Chen: what the paper claims of elastic bearings, beside the corrected model.

The paper prints formulas and trends, no flexibility: a trend is taken as an interval, a formula by its value for the printed data.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np

from drivewright import registry, shafts
from drivewright._typing import Floats
from drivewright.runner import build
from drivewright.spec import load
from drivewright.validation import shaft_bearings, shaft_equations
from drivewright.validation.shaft_model import (
    DATA,
    LAYOUT,
    PRINTED_SECTION,
    READING,
    STIFFNESS,
    literal_bearing_flexibility,
    own_flexibility,
)
from drivewright.validation.source import (
    ABOVE_ONE,
    AGREES,
    BELOW_ONE,
    EXPLAINED,
    NOT_COMPARED,
    OPEN,
    PRINT_ONLY,
    Explanation,
    Printed,
    Row,
    Source,
    implied,
)

LITERAL_NOTE = (
    "Eqs. (16), (17) to the letter, reactions as magnitudes and x from the first mass, give the printed trend, by wrong signs: "
    "elastic bearings add squares of their reactions over their stiffness, so to the flexibility of every mass under its load."
)
BESIDE_ITSELF = "Not even the printed eqs. (16), (17), which are wrong, give this trend: the paper is compared with itself."
HISTORICAL_NOTE = "The printed eqs. (16), (17), which are wrong, give this trend: the paper is compared with itself."


def rows() -> Iterator[Row]:
    """Section, eqs. (1) to (21), section 4.1, section 5.3, bearings."""
    yield from shaft_equations.rows()
    yield from _fixed()
    yield from _trends()
    yield from _conclusion()
    yield from shaft_bearings.rows()


# -- fixed supports ------------------------------------------------------------------------------------------------------------


def clamped_flexibility(preset: str) -> Floats:
    """Flexibility (2, 2) with bearings that hold deflection and slope."""
    model = build(load(registry.mechanism("shaft").presets()[preset], (PRINTED_SECTION, 'analysis.theory="euler-bernoulli"')))
    held = (np.inf, np.inf, 0.0, np.inf, np.inf)
    shaft = model.shaft._replace(supports=tuple(shafts.Support(s.name, s.position, held) for s in model.shaft.supports))
    system = shafts.assemble(shaft)
    return shafts.flexibility(shafts.solve(system, shafts.nodal_forces(system, ())), model.places, model.direction).delta


SUPPORTS_NOTE = (
    "Finite elements with fixed supports are another shaft than the beam on simple supports that they are to confirm. Whether they "
    "were clamped cannot be determined: none of their numbers is printed, and there are four bearings in two shafts, not three."
)


def _fixed() -> Iterator[Row]:
    common: dict[str, Any] = {"kind": "closed form", "where": "section 4.1", "inputs": DATA, "assumed": READING}
    consistent = implied("1, consistent", 0.9, 1.1)
    for mass, (preset, _, place) in LAYOUT.items():
        ours = float(clamped_flexibility(preset)[place, place])
        yield Row(
            f"flexibility of {mass}, clamped over simply supported",
            consistent,
            ours / own_flexibility(mass, np.inf),
            "-",
            pinned=OPEN,
            note=SUPPORTS_NOTE,
            **common,
        )


# -- section 5.3 ---------------------------------------------------------------------------------------------------------------

NO_CHANGE = 0.1  # of the rigid flexibility, which a figure of it hardly shows
MEANT = {
    "no significant change": "no significant change: within 10 %",
    "decreases": "decreases: below 1",
    "increases": "increases: above 1",
}
CLAIMS = {"m1": "no significant change", "m2": "decreases", "m3": "increases", "m4": "decreases"}


def claimed_interval(mass: str) -> Printed:
    """The interval of elastic over rigid flexibility that the claim means."""
    ends = {"decreases": BELOW_ONE, "increases": ABOVE_ONE}.get(CLAIMS[mass], (1 - NO_CHANGE, 1 + NO_CHANGE))
    return Printed(MEANT[CLAIMS[mass]], *ends)


def _trends() -> Iterator[Row]:
    common: dict[str, Any] = {"unit": "-", "kind": "published table", "where": "section 5.3", "inputs": DATA, "assumed": READING}
    for mass in CLAIMS:
        claim, rigid, name = claimed_interval(mass), own_flexibility(mass, np.inf), f"elastic over rigid flexibility of {mass}"
        historical = 1 + literal_bearing_flexibility(mass) / rigid
        gives_claim = claim.low <= historical <= claim.high
        yield Row(
            name,
            claim,
            own_flexibility(mass) / rigid,
            pinned={"m1": OPEN, "m3": AGREES}.get(mass, EXPLAINED),
            explanation=Explanation(LITERAL_NOTE, historical) if gives_claim and mass != "m3" else None,
            **common,
        )
        literal: dict[str, Any] = common | {"pinned": NOT_COMPARED, "basis": PRINT_ONLY, "reading_of": name}
        literal["note"] = HISTORICAL_NOTE if gives_claim else BESIDE_ITSELF
        yield Row(f"{name}, eqs. (16), (17) to the letter", claim, historical, **literal)


def _conclusion() -> Iterator[Row]:
    common: dict[str, Any] = {"kind": "published table", "where": "conclusion (3)", "inputs": DATA, "assumed": READING}
    common["reading_of"] = "flexibility on stiffer bearings"
    common["note"] = "This conclusion is right at every mass for springs at fixed places, and contradicts the trends of section 5.3."
    for mass in CLAIMS:
        yield Row(
            f"flexibility of {mass}, bearing stiffness doubled over nominal",
            Printed("reduced: below 1", *BELOW_ONE),
            own_flexibility(mass, 2 * STIFFNESS) / own_flexibility(mass),
            "-",
            pinned=AGREES,
            **common,
        )


ERRATA = (
    "Eqs. (1) to (3) hold for a force at m1 alone and eq. (4) for one at m2, though the text speaks of one force P; the cross flexibility, "
    "l1 l2 l3/(6 EI), is missing, and so are mu_34 and mu_44 of the other shaft.",
    "Section 3 calls the shafts cantilevers; they are beams on two supports that overhang.",
    "The text counts l7 and l8 both from D to m4; l7 is the distance from C to m4.",
    "Eq. (5): the segment is CD and its length l7 + l8; the printed slope is 4.9 times too small.",
    "Eq. (6): the bracket is l6 + l7 + l8; the printed flexibility is 2.75 times too small.",
    "Eq. (10): where deflection is up and F1 down, F2 enters with a minus sign as F1 does. Eqs. (7) to (14): deflection and slope are "
    "continuous, so all the constants of a shaft are two, C1 = C3 = C5 = C7 and C2 = C4 = C6 = C8.",
    "Eqs. (11) to (14) have the opposite signs of (7) to (10), F_D down where F_C is up, and F2 against F1. Their l4, l5, l6 with x from "
    "m3 contradict the prose (l5 to l8 from the left end) and put m4 outside D.",
    "Eqs. (16), (17): the ratio has a meaning for x from the bearing, not from the first mass; (16) must begin with the displacement of "
    "A, not "
    "of B; with magnitudes it holds for a load on the left overhang only; the span of (17) is l7 + l8. Right, with signs: "
    "z(x) = w_A + (w_B - w_A)(x - x_A)/L.",
    "Eqs. (19), (20) inherit all this; (20) is called mu_m4 and described as the segment from m3 to D.",
    "Eq. (21): the indices of K2 are 33, 34; 43, 44.",
    "Section 4.1: the finite elements are fixed at three bearings; the shafts have four, and fixed is neither the simple support nor the "
    "spring of section 3.",
    "Section 5.2 sends the reader to sections 2.1 and 2.2 for the method of 3.1 and 3.2; section 5.3 puts the gearbox on the "
    "pressure-roller shaft, while m3 belongs to the other one.",
    "Section 5.3: three of the four trends contradict mechanics and conclusion (3). With elastic bearings only the cross "
    "flexibility may fall: that of m1 and m2 goes from +50.5 to -82.1 nm/N.",
    "The cylindrical roller bearing is the stiffest for equal rollers without axial load, not in general. A bearing has no stiffness at a "
    "'unit force' that would hold at another load, and cylindrical and tapered bearings of 20 x 32 x 7 mm are in no catalogue known to us.",
    "A uniform shaft of the least diameter is an estimate on the safe side, not the stepped shaft.",
    "No flexibility, no result of the finite elements and no mesh is printed: 'consistent trends' of two curves confirm no value.",
)

source = Source(
    "shaft-paper",
    "Li Yanqi, Zhang Qifan, Chen Gang: Transverse stiffness analysis of the shaft system in the drive mechanism of "
    "mobile-head spiral winding equipment. Tianjin University of Science and Technology (text and Table 1 read, figures not).",
    rows,
    ERRATA,
)
