"""The inner-translation indexing cam of Liu, Zhai, Li and Guo: contacts, stiffness and bearing loads as printed, beside ours.

The paper gives neither the pins' radius nor a length of the drive train; what is assumed is in the preset and said in every row.
"""

from collections.abc import Iterator
from functools import cache
from typing import Any

import numpy as np

from drivewright import registry
from drivewright.bearings import approximate_stiffness
from drivewright.indexing.stiffness import statics
from drivewright.result import Result
from drivewright.runner import build, run
from drivewright.spec import load
from drivewright.validation.source import AGREES, EXPLAINED, Explanation, Printed, Row, Source, rounded

ARCMIN = np.pi / 10800
DATA = "Table 1: 12 steps, pin circle 120 mm, pin coefficient 0.6, motion over dwell 1.0, eccentricity 10 mm, modified sine"
ASSUMED = (
    "pins of 8 mm; split shafts 110 mm apart and of 20 to 30 mm, gears, widths: none is printed (preset `default`); two bonded cams "
    "under 1000 N m"
)
BEARINGS = "Tables 2, 3: NU207E with 14 rollers of 8.5 mm; 61904 with 11 balls of 4.762 mm"
LARGEST = (
    'shaft_spacing="122 mm"',
    'shafts.diameters=["60 mm", "60 mm", "60 mm", "60 mm"]',
    'gear.module="2.75 mm"',
    "gear.teeth=22",
    'gear.stiffness="5e9 N/m"',
)
CONSTANT = (
    "crank_bearings.bearing=",
    'crank_bearings.law="elements"',
    'crank_bearings.stiffness="4.5e8 N/m"',
    "support_bearings.bearing=",
    'support_bearings.law="elements"',
    'support_bearings.stiffness="1.2e8 N/m"',
)
NOT_FOLLOWING = "Does not follow from the data given: "


def rows() -> Iterator[Row]:
    """Section 3.2, section 2.3, section 4, equations (5), (6), (8)."""
    yield from _contacts()
    yield from _measured()
    yield from _constant()
    yield from _formulas()
    yield from _crank_loads()


@cache
def indexer_result(*changes: str) -> Result[Any]:
    """Result of the preset, bonded as in the paper, with changes."""
    spec = load(registry.mechanism("indexer").presets()["default"], ('contact.model="bonded"', *changes))
    return run(spec, ("contacts", "stiffness"))


def _contacts() -> Iterator[Row]:
    common: dict[str, Any] = {"pinned": AGREES, "kind": "other code", "where": "section 3.2", "inputs": DATA, "assumed": "pins of 8 mm"}
    result = indexer_result()
    count = dict(zip(np.round(np.degrees(result.tables["contacts"]["angle"].data), 6), result.tables["contacts"]["pins"].data, strict=True))
    note = "Pins from 7.5 to 8.5 mm give both numbers; 18.635 mm, 0.6 of the chord, leaves 3 contacts at 45 deg, none at 22.5."
    yield Row("pins in contact at 45 deg, the fewest", rounded("7", "-"), count[45.0], "-", note=note, **common)
    yield Row("fewest pins in contact", rounded("7", "-"), result["contacts.minimum"], "-", **common)
    yield Row("pins in contact at 90 deg", rounded("12", "-"), count[90.0], "-", **common)


def _per_arcmin(text: str) -> Printed:
    return rounded(f"{text} N m/arcmin", "N m/rad")


def _measured() -> Iterator[Row]:
    common: dict[str, Any] = {"pinned": EXPLAINED, "kind": "experiment", "where": "section 2.3", "inputs": DATA, "assumed": ASSUMED}
    ours, best = indexer_result(), indexer_result(*LARGEST)["stiffness.mean"] * ARCMIN
    why = (
        f"{NOT_FOLLOWING}with the printed bearings the stiffness is bounded by them: rigid shafts and gears and the widest "
        f"spacing that the cam leaves (122 mm) give a mean of {best:.0f} N m/arcmin. Inputs differ strongly, or the load or its unit does."
    )
    yield Row("mean torsional stiffness", _per_arcmin("747.39"), ours["stiffness.mean"], "N m/rad", explanation=Explanation(why), **common)
    yield Row(
        "variation over the index period",
        _per_arcmin("186.49"),
        ours["stiffness.range"],
        "N m/rad",
        explanation=Explanation(
            "Nearness of the numbers means nothing beside a mean that is five times ours; whether the whole range or "
            "half of it is meant is not said."
        ),
        **common,
    )
    shape = (
        f"{NOT_FOLLOWING}all normals pass through the pitch point e/phi' away, so bearings that yield make the drive softest where phi' is "
        "largest, at 90 deg, alike on both sides of it while pins pull as well as push. Contact in one direction alone breaks the symmetry."
    )
    yield Row(
        "angle of the lowest stiffness",
        Printed("about 50 deg", np.radians(45), np.radians(55)),
        ours["stiffness.minimum.at"],
        "rad",
        explanation=Explanation(shape),
        **common,
    )
    yield Row(
        "angle of the highest stiffness",
        Printed("about 145 deg", np.radians(140), np.radians(150)),
        _angle_of_max_stiffness(ours),
        "rad",
        explanation=Explanation(shape),
        **common,
    )


def _angle_of_max_stiffness(result: Result[Any]) -> float:
    table = result.tables["stiffness"]
    return float(table["angle"].data[np.nanargmax(table["secant"].data)])


def _constant() -> Iterator[Row]:
    common: dict[str, Any] = {
        "pinned": EXPLAINED,
        "kind": "other code",
        "where": "section 4, Fig. 17",
        "inputs": DATA,
        "assumed": ASSUMED + "; bearings of 450 and 120 N/um",
        "explanation": Explanation(
            f"{NOT_FOLLOWING}constant bearings give K ~ r_p^2, r_p = e/phi': about three times stiffer in the dwell than at 90 deg. A "
            "curve that follows the number of contacts needs bearings that hardly yield at all."
        ),
    }
    ours = indexer_result(*CONSTANT)
    yield Row(
        "mean stiffness, bearings of constant stiffness",
        Printed("about 1020 N m/arcmin", 975 / ARCMIN, 1065 / ARCMIN),
        ours["stiffness.mean"],
        "N m/rad",
        **common,
    )
    yield Row(
        "range, bearings of constant stiffness",
        Printed("about 90 N m/arcmin", 80 / ARCMIN, 100 / ARCMIN),
        ours["stiffness.range"],
        "N m/rad",
        **common,
    )
    yield Row(
        "highest at, bearings of constant stiffness",
        Printed("90 deg", np.radians(85), np.radians(95)),
        _angle_of_max_stiffness(ours),
        "rad",
        **common,
    )
    yield Row(
        "lowest at, bearings of constant stiffness",
        Printed("45 deg", np.radians(40), np.radians(50)),
        ours["stiffness.minimum.at"],
        "rad",
        **common,
    )


def _formulas() -> Iterator[Row]:
    note = "It is the tangent of a power law; as a linear spring, as in the paper, it is too stiff by {} %."
    common: dict[str, Any] = {"pinned": AGREES, "kind": "closed form", "inputs": BEARINGS, "assumed": "1000 N"}
    roller, ball = approximate_stiffness.palmgren_roller(1000.0, 14, 8.5e-3), approximate_stiffness.palmgren_ball(1000.0, 11, 4.762e-3)
    for name, place, printed, ours, over in (
        ("NU207E", "eq. (5)", approximate_stiffness.liu_roller(1000.0, 14, 8.5e-3), roller, 11),
        ("61904", "eq. (6)", approximate_stiffness.liu_ball(1000.0, 11, 4.762e-3), ball, 50),
    ):
        value = float(printed.value)
        yield Row(
            f"stiffness of the {name}, tangent of Palmgren's approach",
            Printed(f"{place}: {value / 1e3:.0f} N/mm (+- 1.5 %)", value * 0.985, value * 1.015),
            float(ours.tangent),
            "N/m",
            where=place,
            note=note.format(over),
            **common,
        )


def _crank_loads() -> Iterator[Row]:
    """Equation (8) as printed beside the equilibrium of the same cam."""
    changes = ('load.angle="22.5 deg"', 'contact.model="bonded"')
    spec = load(registry.mechanism("indexer").presets()["default"], changes)
    answer = registry.mechanism("indexer")
    model = build(spec)
    equilibrium, near = next(a for a in answer.analyses if a.name == "stiffness").answer(model, {}).data
    force, moment = statics.pin_resultants(equilibrium, near)
    centre = statics.cam_centre(spec.eccentricity, equilibrium.theta)
    printed = statics.crank_loads_printed(force[:, 0], centre, spec.shaft_spacing)
    corrected = statics.crank_loads(force[:, 0], moment[:, 0], centre, spec.shaft_spacing)
    common: dict[str, Any] = {"pinned": EXPLAINED, "kind": "closed form", "where": "eq. (8)", "inputs": DATA, "assumed": ASSUMED}
    for side, name in enumerate(("R_y1", "R_y2")):
        size = abs(printed[side].imag[0])
        why = "The couple of the pins, which is the output torque itself, is missing, and R_y1 has F_y y_b for F_x y_b."
        other = abs(corrected[side].imag[0])
        yield Row(
            f"{name} of cam 1 at 22.5 deg",
            Printed(f"eq. (8): {size:.0f} N", 0.995 * size, 1.005 * size),
            float(abs(equilibrium.crank_forces[0, side, 0].imag)),
            "N",
            explanation=Explanation(f"{why} Corrected: {other:.0f} N."),
            **common,
        )


ERRATA = (
    'Table 1: the "pin coefficient" 0.6 is undefined; the usual reading, 0.6 of the chord (18.6 mm), contradicts the '
    "paper's own contacts, and pins wider than the eccentricity leave no lobe top in the dwell.",
    "Neither the spacing of the crank bearings, nor a length or diameter of the shafts, nor the rated torque is given; the "
    "stiffness cannot be computed from the paper.",
    "Eqs. (5), (6) are tangent stiffnesses of the power laws F ~ d^(10/9) and F ~ d^(3/2); used as linear springs they are "
    "too stiff by 11 and 50 %.",
    "Eq. (8): R_y1 has (y_b/l) F_y where F_x belongs, so the forces do not sum to -F_y; the couple of the pins is left out.",
    "Eq. (10): the forces along x turn the shaft too (y_b); the printed form holds only at 0 and 180 deg, where no torque passes.",
    "Eq. (11): the first line lacks a minus; the separating force of the gear is left out.",
    "Eq. (12): the first line has b1 where b2 belongs; it holds only for b1 = b2.",
    'Section 3.3.1: "No Separation" lets pins pull. With equal motion and dwell the cams hold the wheel in one direction '
    "only from 0 to 31 deg and from 149 to 180 deg; the model cannot show it.",
    "A NU207E of 35 mm bore with 10 mm eccentricity leaves at most 15 mm for a shaft through a separate sleeve, the 61904 "
    "wants 20 mm; the crank must be one piece with its shaft.",
    "41 measuring points in section 2.2, 40 in section 4 (4.5 deg apart over 180 deg there are 41).",
    "61904 is a deep-groove, not an angular-contact ball bearing.",
)

source = Source(
    "indexer-paper",
    "Liu Mingtao, Zhai Fengxiao, Li Yanqi, Guo Zhiquan: Factors influencing the torsional stiffness of inner parallel indexing cam "
    "mechanism. Journal of Tianjin University of Science and Technology 2017, doi:10.13364/j.issn.1672-6510.20160015",
    rows,
    ERRATA,
)
