"""The inner-translation indexing cam of Liu, Zhai, Li and Guo: contacts, stiffness and bearing loads as printed, beside ours.

The paper gives neither the pins' radius nor a length of the drive train; what is assumed is in the preset and said in every row.
"""

from collections.abc import Iterator
from functools import cache
from typing import Any

import numpy as np

from drivewright import registry
from drivewright.bearings import approximate_stiffness
from drivewright.indexing import torsion_test
from drivewright.indexing.stiffness import statics
from drivewright.result import Result
from drivewright.runner import build, run
from drivewright.spec import load
from drivewright.validation.source import (
    ABOVE_ONE,
    AGREES,
    BELOW_ONE,
    CALIBRATED,
    EXPLAINED,
    NOT_COMPARED,
    OPEN,
    PRINT_ONLY,
    Explanation,
    Printed,
    Row,
    Source,
    about,
    evaluated,
    rounded,
)

ARCMIN = np.pi / 10800
DATA = "Table 1: 12 steps, radius of the pin circle 120 mm, pin coefficient 0.6, motion over dwell 1.0, eccentricity 10 mm, modified sine"
ASSUMED = (
    "pins of 8 mm; split shafts 110 mm apart and of 20 to 30 mm, gears, widths: none is printed (preset `default`); two bonded cams "
    "under 1000 N m"
)
BEARINGS = "Tables 2, 3: NU207E with 14 rollers 8.5 mm long; 61904 with 11 balls of 4.762 mm in diameter"
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
    'crank_bearings.stiffness="4.8e8 N/m"',
    "support_bearings.bearing=",
    'support_bearings.law="elements"',
    'support_bearings.stiffness="1.7e8 N/m"',
)  # means of eqs. (5), (6) over the index period under the loads of 1000 N m
NOT_FOLLOWING = "Does not follow from the data given: "


def rows() -> Iterator[Row]:
    """Contacts, test, simulation, equations (3) to (12), counts."""
    yield from _contacts()
    yield from _measured()
    yield from _constant()
    yield from _formulas()
    yield from _crank_loads()
    yield from _shaft_loads()
    yield from _test()


@cache
def indexer_result(*changes: str) -> Result[Any]:
    """Result of the preset, bonded as in the paper, with changes."""
    spec = load(registry.mechanism("indexer").presets()["default"], ('contact.model="bonded"', *changes))
    return run(spec, ("contacts", "stiffness"))


def _contacts() -> Iterator[Row]:
    """Counts of contacts: the radius of the pins is not printed, and ours is one of those that give them."""
    common: dict[str, Any] = {"pinned": NOT_COMPARED, "basis": CALIBRATED, "kind": "other code", "where": "section 3.2", "inputs": DATA}
    common["assumed"] = "pins of 8 mm"
    result = indexer_result()
    count = dict(zip(np.round(np.degrees(result.tables["contacts"]["angle"].data), 6), result.tables["contacts"]["pins"].data, strict=True))
    note = "Pins from 7.5 to 8.5 mm give both numbers; 18.635 mm, 0.6 of half the chord, leaves 3 contacts at 45 deg, none at 22.5."
    yield Row("pins in contact at 45 deg, the fewest", rounded("7", "-"), count[45.0], "-", note=note, **common)
    yield Row("fewest pins in contact", rounded("7", "-"), result["contacts.minimum"], "-", **common)
    yield Row("pins in contact at 90 deg", rounded("12", "-"), count[90.0], "-", **common)


def _per_arcmin(text: str) -> Printed:
    return rounded(f"{text} N m/arcmin", "N m/rad")


def _measured() -> Iterator[Row]:
    common: dict[str, Any] = {"pinned": OPEN, "kind": "experiment", "where": "section 2.3", "inputs": DATA, "assumed": ASSUMED}
    ours, best = indexer_result(), indexer_result(*LARGEST)["stiffness.mean"] * ARCMIN
    why = (
        f"{NOT_FOLLOWING}with the printed bearings the stiffness is bounded by them: rigid shafts and gears and the widest "
        f"spacing that the cam leaves (122 mm) give a mean of {best:.0f} N m/arcmin. Either the inputs, or the load or its unit, differ "
        f"strongly from those printed."
    )
    yield Row("mean torsional stiffness", _per_arcmin("747.39"), ours["stiffness.mean"], "N m/rad", note=why, **common)
    near = (
        "The two numbers are close by chance, for the printed mean is five times ours; whether the whole range or half of it is meant is "
        "not stated."
    )
    yield Row("variation over the index period", _per_arcmin("186.49"), ours["stiffness.range"], "N m/rad", note=near, **common)
    shape = (
        f"{NOT_FOLLOWING}all normals pass through the pitch point e/phi' away, so elastic bearings make the drive softest where phi' is "
        "largest, at 90 deg, alike on both sides of it while pins pull as well as push. Contact in one direction alone breaks the symmetry."
    )
    lowest, highest = (about(f"about {at} deg", np.radians(at), np.radians(5)) for at in (50, 145))
    yield Row("angle of the lowest stiffness", lowest, ours["stiffness.minimum.at"], "rad", note=shape, **common)
    alike = f"{shape} Of its two equal maxima ours is the one nearer to the print."
    yield Row("angle of the highest stiffness", highest, _angle_of_max_stiffness(ours, highest), "rad", note=alike, **common)


def _angle_of_max_stiffness(result: Result[Any], printed: Printed) -> float:
    """Of the two maxima, equal by symmetry about 90 deg, the angle [rad] nearer to the print."""
    table = result.tables["stiffness"]
    one = float(table["angle"].data[np.nanargmax(table["secant"].data)])
    return min((one, np.pi - one), key=lambda angle: abs(angle - 0.5 * (printed.low + printed.high)))


def _constant() -> Iterator[Row]:
    ours = indexer_result(*CONSTANT)
    curve = ours.tables["stiffness"]["secant"].data
    stiffer = float(np.max(curve) / np.min(curve))
    common: dict[str, Any] = {
        "pinned": OPEN,
        "kind": "other code",
        "where": "section 4, Fig. 17",
        "inputs": DATA,
        "assumed": ASSUMED + "; bearings of 480 and 170 N/um, the means of eqs. (5), (6) under the loads of this torque",
        "note": (
            f"{NOT_FOLLOWING}constant bearings give K ~ r_p^2, r_p = e/phi': {stiffer:.1f} times stiffer in the dwell than at 90 deg. A "
            "curve that follows the number of contacts needs almost rigid bearings."
        ),
    }
    highest = about("90 deg", np.radians(90), np.radians(5))
    yield Row(
        "mean stiffness, bearings of constant stiffness",
        about("about 1020 N m/arcmin", 1020 / ARCMIN, 45 / ARCMIN),
        ours["stiffness.mean"],
        "N m/rad",
        **common,
    )
    yield Row(
        "range, bearings of constant stiffness",
        about("about 90 N m/arcmin", 90 / ARCMIN, 10 / ARCMIN),
        ours["stiffness.range"],
        "N m/rad",
        **common,
    )
    yield Row("highest at, bearings of constant stiffness", highest, _angle_of_max_stiffness(ours, highest), "rad", **common)
    angle, contacts = ours.tables["stiffness"]["angle"].data, ours.tables["contacts"]
    at_45 = float(np.interp(np.radians(45), angle, curve)) / ours["stiffness.mean"]
    small: dict[str, Any] = common | {"pinned": AGREES, "note": ""}
    yield Row(
        "stiffness at 45 deg over the mean, bearings of constant stiffness", Printed("small: below 1", *BELOW_ONE), at_45, "-", **small
    )
    loaded = indexer_result()
    above = Printed("clearly above: above 1", *ABOVE_ONE)
    ratio = ours["stiffness.mean"] / loaded["stiffness.mean"]
    yield Row("mean stiffness, constant over load-dependent bearings", above, ratio, "-", **small)
    follows = float(np.corrcoef(curve, np.interp(angle, contacts["angle"].data, contacts["pins"].data))[0, 1])
    close = Printed("very close: above 0.5", 0.5, 1.0)
    yield Row("correlation of stiffness and pins in contact, bearings constant", close, follows, "-", **common)


def _formulas() -> Iterator[Row]:
    """The coefficients of eqs. (5), (6), in N and mm, beside those of Gargiulo, whose own are in pounds and inches."""
    note = (
        "Gargiulo's formula, and to 0.3 and 1.2 % the derivative of Palmgren's approach of the rings: the tangent of a power law. As a "
        "linear spring, as in the paper, it is too stiff by {} %."
    )
    common: dict[str, Any] = {"pinned": AGREES, "kind": "closed form", "inputs": BEARINGS, "unit": "-"}
    roller, ball = approximate_stiffness.gargiulo_roller(1000.0, 14, 8.5e-3), approximate_stiffness.gargiulo_ball(1000.0, 11, 4.762e-3)
    shapes = 1000.0**0.1 * 14**0.9 * 8.5**0.8, (4.762 * 1000.0 * 11**2) ** (1 / 3)
    for name, place, text, law, shape, over in (
        ("cylindrical roller", "eq. (5)", "0.340e4", roller, shapes[0], 11),
        ("ball", "eq. (6)", "0.118e4", ball, shapes[1], 50),
    ):
        ours = float(law.value) * 1e-3 / shape
        yield Row(f"coefficient of the {name} bearing's stiffness", rounded(text, "-"), ours, where=place, note=note.format(over), **common)


UNEVEN = ('load.angle="22.5 deg"', 'contact.model="bonded"', 'shafts.front="30 mm"', 'shafts.rear="20 mm"')
INSTANCE = f"{ASSUMED}; at 22.5 deg, front support 30 mm and rear support 20 mm from the cams"


@cache
def equilibrium_instance() -> tuple[Any, Any, Any]:
    """(spec, equilibrium, contacts) of the preset at 22.5 deg, bonded, the supports at unequal distances."""
    spec = load(registry.mechanism("indexer").presets()["default"], UNEVEN)
    stiffness = next(a for a in registry.mechanism("indexer").analyses if a.name == "stiffness")
    equilibrium, near = stiffness.answer(build(spec), {}).data
    return spec, equilibrium, near


def force_text(value: float) -> Printed:
    """A printed formula's force [N] for the instance, to four digits."""
    return evaluated(f"{value:.1f} N", "N")


def _crank_loads() -> Iterator[Row]:
    """Equations (7) to (9) beside the equilibrium of the same cam."""
    spec, equilibrium, near = equilibrium_instance()
    force, moment = statics.pin_resultants(equilibrium, near)
    centre, spacing = statics.cam_centre(spec.eccentricity, equilibrium.theta), spec.shaft_spacing
    common: dict[str, Any] = {"kind": "closed form", "inputs": DATA, "assumed": INSTANCE, "unit": "N"}
    at: dict[str, Any] = {"where": "eq. (7)", "pinned": AGREES, "kind": "closed form", "inputs": DATA, "unit": "m"}
    for name, value, printed in (("x_b", centre.real[0], "9.238795 mm"), ("y_b", centre.imag[0], "3.826834 mm")):
        yield Row(f"{name} at 22.5 deg", evaluated(printed, "m"), float(value), **at)
    printed = statics.crank_loads_printed(force[:, 0], centre, spacing)
    ours = [-complex(equilibrium.crank_forces[0, side, 0]) for side in range(2)]  # of the bearings on the cam
    equal = Explanation(
        "Statics alone leaves open how the bearings share the force along x; equal shares are an assumption, and the mean of our two is "
        "the printed value.",
        (ours[0].real + ours[1].real) / 2,
    )
    for side in range(2):
        name, value = f"R_x{side + 1} of cam 1", force_text(printed[side].real[0])
        yield Row(name, value, ours[side].real, where="eq. (8)", pinned=EXPLAINED, explanation=equal, **common)
    why = (
        "The couple of the pins, which is the output torque itself, is left out, and the moment of F_x about the cam's centre is wrong. "
        "Without the couple, and with the terms as printed, our equilibrium gives the printed value."
    )
    # What the print leaves out of our equilibrium: the couple, and in R_y1 F_x y_b for F_y y_b, in R_y2 the sign of F_x y_b.
    couple, lift = moment[0, 0] / spacing, centre.imag[0] / spacing
    wrong = (-couple - lift * (force[0, 0].imag + force[0, 0].real), couple + 2 * lift * force[0, 0].real)
    for side, name in enumerate(("R_y1", "R_y2")):
        yield Row(
            f"{name} of cam 1",
            force_text(printed[side].imag[0]),
            ours[side].imag,
            where="eq. (8)",
            pinned=EXPLAINED,
            explanation=Explanation(why, float(ours[side].imag + wrong[side])),
            **common,
        )
    others = equilibrium.support_forces[0, 0].sum() - equilibrium.gear_forces[0, 0] - equilibrium.crank_forces[0, 0, 1]
    for name, reaction, value in (("F_x1", ours[0].real, others.real), ("F_y1", ours[0].imag, others.imag)):
        where = f"{name} of cam 1 on the split shaft, from the balance of that shaft"
        yield Row(where, force_text(-reaction), float(value), where="eq. (9)", pinned=AGREES, **common)


def _shaft_loads() -> Iterator[Row]:
    """Equations (10) to (12), each from the forces of our equilibrium, beside that equilibrium."""
    spec, equilibrium, _ = equilibrium_instance()
    common: dict[str, Any] = {"kind": "closed form", "inputs": DATA, "assumed": INSTANCE, "unit": "N", "pinned": EXPLAINED}
    first, second = (equilibrium.crank_forces[:, 0, cam] for cam in range(2))
    gear, centre = equilibrium.gear_forces[0, 0], statics.cam_centre(spec.eccentricity, equilibrium.theta)
    radius = 0.5 * spec.gear.module * spec.gear.teeth
    printed = float(statics.gear_force_printed(first, second, centre, radius)[0])
    across = float((centre.imag * (first - second).real)[0] / radius)
    only_y = Explanation("The forces along x turn the shaft too. Without them ours is the printed value.", float(gear.imag) - across)
    yield Row("F_H on the split gear", force_text(printed), float(gear.imag), where="eq. (10)", explanation=only_y, **common)
    lengths = statics.ShaftLengths(spec.shafts.overhang, spec.shafts.front, spec.shafts.pitch, spec.shafts.rear)
    yield from _support_loads(equilibrium, lengths, first, second, gear, common)


def _support_loads(equilibrium: Any, lengths: Any, first: Any, second: Any, gear: complex, common: dict[str, Any]) -> Iterator[Row]:
    front, rear = (complex(equilibrium.support_forces[0, 0, end]) for end in range(2))  # of the shaft on its supports
    front, rear = -front, -rear
    agreed: dict[str, Any] = {"pinned": AGREES}
    a, b1, c, b2 = lengths
    span = lengths.span
    printed = [complex(each[0]) for each in statics.support_loads_printed(first, second, np.array([gear.imag]), lengths)]
    outward = gear.real * (a + span) / span
    sign = "The first line lacks a minus sign, and the gear's separating force is left out: with both changes our value is the printed one."
    swapped = "b1 stands where b2 belongs, true only where both are equal: with the two exchanged ours is the printed value."
    separating = "The gear's separating force is left out: without it ours is the printed value."
    shift = ((first.imag * (b1 + c) + second.imag * b1) - (first.imag * (b2 + c) + second.imag * b2))[0] / span
    for name, place, value, our, text, other in (
        ("R_1qx", "eq. (11)", printed[0].real, front.real, sign, -(front.real + outward)),
        ("R_1hx", "eq. (11)", printed[1].real, rear.real, separating, rear.real - gear.real * a / span),
        ("R_1qy", "eq. (12)", printed[0].imag, front.imag, swapped, front.imag - float(shift)),
    ):
        yield Row(name, force_text(value), our, where=place, explanation=Explanation(text, float(other)), **common)
    yield Row("R_1hy", force_text(printed[1].imag), rear.imag, where="eq. (12)", **(common | agreed))


# -- the test ------------------------------------------------------------------------------------------------------------------

LOOP_STIFFNESS, LOOP_HALF_WIDTH, LOOP_TORQUE = 750 / ARCMIN, 0.1 * ARCMIN, 300.0  # N m/rad, rad, N m
BRANCH = 401  # readings along one branch
LOOP = "a loop made up of two straight branches of 750 N m/arcmin, 0.1 arcmin to either side, over -300 to 300 N m"


@cache
def loop_evaluation() -> Any:
    """The torsion test's evaluation of the made-up loop."""
    up = np.linspace(-LOOP_TORQUE, LOOP_TORQUE, BRANCH)
    torque = np.tile(np.concatenate([up, up[::-1]]), 3)
    way = np.tile(np.repeat([1.0, -1.0], len(up)), 3)
    angle = torque / LOOP_STIFFNESS - way * LOOP_HALF_WIDTH
    return torsion_test.evaluate_loop(torsion_test.Readings(torque, angle))


def _test() -> Iterator[Row]:
    """Equations (1) to (4) on a made-up loop, and the counts of the test."""
    common: dict[str, Any] = {"kind": "closed form", "inputs": LOOP}
    found = loop_evaluation()
    whole = LOOP_STIFFNESS / (1 + 3 * (LOOP_HALF_WIDTH * LOOP_STIFFNESS / LOOP_TORQUE) ** 2)
    yield Row(
        "stiffness of the loop by least squares of torque on angle",
        evaluated(f"{whole * ARCMIN:.0f} N m/arcmin", "N m/rad"),
        found.per_branch.value,
        "N m/rad",
        where="eq. (3)",
        pinned=EXPLAINED,
        explanation=Explanation(
            "Torque on angle over the whole loop counts the hysteresis as compliance. So evaluated ours is the printed formula's value; "
            "the slope of the branches is the stiffness.",
            found.whole_loop.value,
        ),
        **common,
    )
    bar, support = 3000.0, 8000.0
    corrected = 1 / (1 / 750.0 - 1 / bar - 1 / support)
    springs = torsion_test.SeriesSpring
    setup = torsion_test.TorsionTestSettings(parts=(springs("bar", bar / ARCMIN), springs("support", support / ARCMIN)))
    yield Row(
        "stiffness without the bar and the support",
        evaluated(f"{corrected:.2f} N m/arcmin", "N m/rad"),
        _corrected_stiffness(setup),
        "N m/rad",
        where="eq. (4)",
        pinned=AGREES,
        assumed="bar of 3000, support of 8000 N m/arcmin: the paper prints neither",
        **common,
    )
    counted: dict[str, Any] = {"unit": "-", "kind": "experiment", "pinned": NOT_COMPARED, "basis": PRINT_ONLY}
    note = "180 deg in steps of 4.5 deg are 41 positions with both ends; section 4 has 40."
    yield Row("measuring points of the test", rounded("41", "-"), 180 / 4.5 + 1, where="section 2.2", note=note, **counted)
    yield Row("measuring points of the simulation", rounded("40", "-"), 180 / 4.5 + 1, where="section 4", note=note, **counted)
    angle = "The motor turns at 0.5 deg/s and a model is kept every 9 s: 4.5 deg, both printed."
    turned: dict[str, Any] = counted | {"unit": "rad", "where": "section 1.2", "note": angle}
    yield Row("input angle between two models", rounded("4.5 deg", "rad"), np.radians(0.5 * 9), **turned)
    mesh: dict[str, Any] = {"where": "section 3.3.2", "note": "The mesh is that of the authors; ours serves another purpose.", **counted}
    yield Row("elements of the mesh", rounded("109971", "-"), None, **mesh)
    yield Row("nodes of the mesh", rounded("507651", "-"), None, **mesh)


def _corrected_stiffness(setup: Any) -> float:
    up = np.linspace(-LOOP_TORQUE, LOOP_TORQUE, BRANCH)
    torque = np.concatenate([up, up[::-1]])
    return float(torsion_test.evaluate_loop(torsion_test.Readings(torque, torque / LOOP_STIFFNESS), setup).corrected.value)


ERRATA = (
    'Table 1: the "pin coefficient" 0.6 is undefined; the usual reading, 0.6 of half the chord between pins (18.6 mm), contradicts the '
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
    "needs 20 mm; the crank must be one piece with its shaft.",
    "41 measuring points in section 2.2, 40 in section 4 (4.5 deg apart over 180 deg there are 41).",
    "Eq. (6) is that of angular-contact ball bearings; it is applied to a 61904, a deep-groove ball bearing, with a contact angle of 0.",
)

source = Source(
    "indexer-paper",
    "Liu Mingtao, Zhai Fengxiao, Li Yanqi, Guo Zhiquan: Factors influencing the torsional stiffness of inner parallel indexing cam "
    "mechanism. Journal of Tianjin University of Science and Technology 2017, doi:10.13364/j.issn.1672-6510.20160015",
    rows,
    ERRATA,
)
