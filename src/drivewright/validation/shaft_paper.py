"""The shafts of a pipe-lining machine of Li, Zhang and Chen: what the paper claims of elastic bearings, beside the corrected model.

The paper prints formulas and trends, no flexibility: a trend is taken as an interval, a formula by its value for the printed data.
"""

from collections.abc import Iterator
from functools import cache
from typing import Any

import numpy as np

from drivewright import bearings, registry, shafts
from drivewright._typing import Floats
from drivewright.bearings.ball import BallBearing
from drivewright.bearings.roller import RollerBearing
from drivewright.result import Result
from drivewright.runner import build, run
from drivewright.spec import load
from drivewright.validation.source import AGREES, EXPLAINED, OPEN, Explanation, Printed, Row, Source, rounded

# Table 1, SI; I is the printed one.
L1, L2, L3, L5, L6, L7, L8 = 0.0565, 0.080, 0.1085, 0.053, 0.082, 0.0665, 0.2595
E, SECOND, STIFFNESS = 206e9, 7854e-12, 3.0e7
EI = E * SECOND
SPAN = L7 + L8  # between C and D
PRINTED_SECTION = 'segments.0.diameter="20.00001169 mm"'  # that has the printed I
LAYOUT = {
    "m1": ("pressure-roller", "A", 0),
    "m2": ("pressure-roller", "B", 1),
    "m3": ("rubber-roller-r1", "C", 0),
    "m4": ("rubber-roller-r1", "C", 1),
}  # preset, bearing next to it, place in the matrix

DATA = "Table 1: l1 to l9 = 56.5, 80, 108.5, 95, 53, 82, 66.5, 259.5, 29 mm; E = 206 GPa; I = 7854 mm^4; 3.0e7 N/m for each bearing"
READING = "the prose with l7 counted from C (reading R1); beam after Euler and Bernoulli, as in the paper"
TRENDS = "no significant change, on the scale of a figure: less than a tenth of the largest rigid flexibility of the shaft"
LITERAL_NOTE = (
    "Eqs. (16), (17) to the letter, reactions as magnitudes and x from the first mass, give the printed trend, by wrong signs: "
    "bearings that yield add squares of their reactions over their stiffness, so to the flexibility of every mass under its load."
)
HISTORICAL_NOTE = "Historical comparison: the printed eqs. (16), (17), which are wrong, reproduce this trend; no evidence for it."
MISPRINT = "Misprint: the span is that of the bearings C and D, l7 + l8; with D right of C by l7 alone ours is the printed value."


def rows() -> Iterator[Row]:
    """Section, eqs. (1) to (6), (21), section 4.1, section 5.3, bearings."""
    yield from _section()
    yield from _pressure_roller()
    yield from _rubber_roller()
    yield _equation_21()
    yield from _fixed()
    yield from _trends()
    yield from _conclusion()
    yield from _bearings()


@cache
def flexibility(preset: str, stiffness: float | None = None) -> Floats:
    """(2, 2) of a preset with the printed I, on its own bearings or others [N/m]."""
    return run_preset(preset, stiffness, ("flexibility",)).arrays["flexibility"].values


def run_preset(preset: str, stiffness: float | None = None, only: tuple[str, ...] = (), *changes: str) -> Result[Any]:
    """Result of a preset, after Euler and Bernoulli."""
    changes = (PRINTED_SECTION, 'analysis.theory="euler-bernoulli"', *changes)
    spec = load(registry.mechanism("shaft").presets()[preset], changes)
    if stiffness is not None:
        text = "rigid" if np.isinf(stiffness) else f"{stiffness!r} N/m"
        spec = spec.replace(bearings=[{"name": b.name, "position": f"{b.position!r} m", "radial_stiffness": text} for b in spec.bearings])
    return run(spec, only)


def own_flexibility(mass: str, stiffness: float | None = None) -> float:
    """Flexibility of a mass under its own load [m/N]."""
    preset, _, place = LAYOUT[mass]
    return float(flexibility(preset, stiffness)[place, place])


def flexibility_of_formula(value: float, formula: str) -> Printed:
    """A formula's flexibility [m/N] for the printed data, to six digits."""
    printed = rounded(f"{1e9 * value:.6g} um/kN", "m/N")
    return printed._replace(text=f"{formula}: {printed.text}")


def slope_of_formula(value: float, formula: str) -> Printed:
    """A formula's slope [rad/N], in urad/N, to six digits."""
    printed = rounded(f"{1e6 * value:.6g}", "-")
    return printed._replace(text=f"{formula}: {printed.text}")


# -- section and closed forms --------------------------------------------------------------------------------------------------


def _section() -> Iterator[Row]:
    common: dict[str, Any] = {"pinned": AGREES, "kind": "closed form", "where": "Table 1", "inputs": DATA}
    yield Row("second moment of area of 20 mm, in mm^4", rounded("7854", "-"), float(np.pi * 20**4 / 64), "-", **common)


def value_per_newton(preset: str, station: str, name: str) -> float:
    """A value of a run under 1 N at a station, bearings rigid."""
    return run_preset(preset, np.inf, ("statics",), f'loads=[{{station="{station}", force="1 N"}}]')[name]


def _pressure_roller() -> Iterator[Row]:
    common: dict[str, Any] = {"kind": "closed form", "inputs": DATA, "assumed": READING, "pinned": AGREES}
    own = "The formula belongs to a force at this mass alone, whatever the text says of one force P."
    slope, moment = (value_per_newton("pressure-roller", "m1", name) for name in ("bearings.A.slope", "shaft.max_moment"))
    yield Row(
        "slope at A, force at m1, in urad/N", slope_of_formula(L1 * L2 / (3 * EI), "eq. (1)"), 1e6 * slope, "-", where="eq. (1)", **common
    )
    yield Row("moment at A over the force at m1, in m", rounded("0.0565", "-"), moment, "-", where="eq. (2)", **common)
    for number, mass, arm in ((3, "m1", L1), (4, "m2", L3)):
        yield Row(
            f"flexibility of {mass}, bearings rigid",
            flexibility_of_formula(arm**2 * (arm + L2) / (3 * EI), f"eq. ({number})"),
            own_flexibility(mass, np.inf),
            "m/N",
            where=f"eq. ({number})",
            note=own,
            **common,
        )


def _rubber_roller() -> Iterator[Row]:
    common: dict[str, Any] = {"kind": "closed form", "inputs": DATA, "assumed": READING, "pinned": EXPLAINED}
    slope, other = (1e6 * value_per_newton(preset, "m3", "bearings.C.slope") for preset in ("rubber-roller-r1", "rubber-roller-r3"))
    name = "slope at C, force at m3, in urad/N"
    yield Row(
        name,
        slope_of_formula(L6 * L7 / (3 * EI), "eq. (5)"),
        slope,
        "-",
        where="eq. (5)",
        explanation=Explanation(MISPRINT, other),
        **common,
    )
    own, other = own_flexibility("m3", np.inf), float(flexibility("rubber-roller-r3", np.inf)[0, 0])
    yield Row(
        "flexibility of m3, bearings rigid",
        flexibility_of_formula(L6**2 * (L6 + L7) / (3 * EI), "eq. (6)"),
        own,
        "m/N",
        where="eq. (6)",
        explanation=Explanation(MISPRINT, other),
        **common,
    )
    common |= {"pinned": AGREES, "where": "eqs. (5), (6) corrected"}
    yield Row(f"{name}, corrected", slope_of_formula(L6 * SPAN / (3 * EI), "l6 (l7 + l8)/(3 EI)"), slope, "-", **common)
    corrected = flexibility_of_formula(L6**2 * (L6 + SPAN) / (3 * EI), "l6^2 (l6 + l7 + l8)/(3 EI)")
    yield Row("flexibility of m3, bearings rigid, corrected", corrected, own, "m/N", **common)


def _equation_21() -> Row:
    whole = np.zeros((4, 4))
    whole[:2, :2], whole[2:, 2:] = flexibility("pressure-roller"), flexibility("rubber-roller-r1")
    printed, meant = (int(np.linalg.matrix_rank(block)) for block in (whole[2:, :2], whole[2:, 2:]))
    misprint = Explanation("Misprint: the indices of K2 are 33, 34; 43, 44. No force on one shaft moves the other in this model.", meant)
    return Row(
        "rank of the flexibility with indices 31, 32; 41, 42",
        Printed("2, implied by its inverse K2", 2, 2),
        printed,
        "-",
        pinned=EXPLAINED,
        kind="closed form",
        where="eq. (21)",
        inputs=DATA,
        assumed=READING,
        explanation=misprint,
    )


# -- fixed supports ------------------------------------------------------------------------------------------------------------


def clamped_flexibility(preset: str) -> Floats:
    """Flexibility (2, 2) with bearings that hold deflection and slope."""
    model = build(load(registry.mechanism("shaft").presets()[preset], (PRINTED_SECTION, 'analysis.theory="euler-bernoulli"')))
    held = (np.inf, np.inf, 0.0, np.inf, np.inf)
    shaft = model.shaft._replace(supports=tuple(shafts.Support(s.name, s.position, held) for s in model.shaft.supports))
    system = shafts.assemble(shaft)
    return shafts.flexibility(shafts.solve(system, shafts.nodal_forces(system, ())), model.places, model.direction).delta


CLAMPED = {
    "m1": (L1**3, "l1^3/(3 EI)"),
    "m2": (L3**3, "l3^3/(3 EI)"),
    "m3": (L6**3, "l6^3/(3 EI)"),
    "m4": ((L7 * L8 / SPAN) ** 3, "(l7 l8)^3/(3 EI (l7 + l8)^3)"),
}
SUPPORTS_NOTE = (
    "Finite elements with fixed supports are another shaft than the beam on simple supports that they are to confirm. Whether they "
    "were clamped cannot be told: none of their numbers is printed, and there are four bearings in two shafts, not three."
)


def _fixed() -> Iterator[Row]:
    common: dict[str, Any] = {"kind": "closed form", "where": "section 4.1", "inputs": DATA, "assumed": READING}
    consistent = Printed("1, implied: consistent", 0.9, 1.1)
    for mass, (cube, formula) in CLAMPED.items():
        preset, _, place = LAYOUT[mass]
        ours = float(clamped_flexibility(preset)[place, place])
        yield Row(
            f"flexibility of {mass}, bearings clamped",
            flexibility_of_formula(cube / (3 * EI), formula),
            ours,
            "m/N",
            pinned=AGREES,
            **common,
        )
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


def literal_bearing_flexibility(mass: str) -> float:
    """Eqs. (16) and (17) as printed [m/N]: what bearings of 3.0e7 N/m would add under 1 N at a mass.  Wrong; kept for comparison.

    mu are the reactions' magnitudes over the stiffness, x counts from the first mass of the shaft.
    """
    preset, _, place = LAYOUT[mass]
    left, right = np.abs(run_preset(preset, None, ("flexibility",)).arrays["reactions.unit_load"].values[:, place]) / STIFFNESS
    if preset == "pressure-roller":
        x = (0.0, L1 + L2 + L3)[place]
        return float(right - x * (left + right) / L2)
    x = (0.0, L6 + L7)[place]
    return float(left - x * (left + right) / (L6 + L7))


BELOW_ONE, ABOVE_ONE = (-np.inf, np.nextafter(1.0, 0.0)), (np.nextafter(1.0, 2.0), np.inf)
CLAIMS = {"m1": "no significant change", "m2": "decreases", "m3": "increases", "m4": "decreases"}


def claimed_interval(mass: str) -> Printed:
    """The interval of elastic over rigid flexibility that the claim means."""
    preset, word = LAYOUT[mass][0], CLAIMS[mass]
    seen = 0.1 * float(np.diag(flexibility(preset, np.inf)).max()) / own_flexibility(mass, np.inf)
    return Printed(word, *{"decreases": BELOW_ONE, "increases": ABOVE_ONE}.get(word, (1 - seen, 1 + seen)))


def _trends() -> Iterator[Row]:
    common: dict[str, Any] = {
        "unit": "-",
        "kind": "published table",
        "where": "section 5.3",
        "inputs": DATA,
        "assumed": f"{READING}; {TRENDS}",
    }
    for mass in CLAIMS:
        claim, rigid, name = claimed_interval(mass), own_flexibility(mass, np.inf), f"elastic over rigid flexibility of {mass}"
        historical, right = 1 + literal_bearing_flexibility(mass) / rigid, mass == "m3"
        yield Row(
            name,
            claim,
            own_flexibility(mass) / rigid,
            pinned=AGREES if right else EXPLAINED,
            explanation=None if right else Explanation(LITERAL_NOTE, historical),
            **common,
        )
        yield Row(f"{name}, eqs. (16), (17) to the letter", claim, historical, pinned=AGREES, note=HISTORICAL_NOTE, **common)


def _conclusion() -> Iterator[Row]:
    common: dict[str, Any] = {"kind": "published table", "where": "conclusion (3)", "inputs": DATA, "assumed": READING}
    common["note"] = "This conclusion is right, at every mass and for any bearings - and contradicts the trends of section 5.3."
    for mass in CLAIMS:
        yield Row(
            f"flexibility of {mass}, bearings twice as stiff over as they are",
            Printed("below 1, implied", *BELOW_ONE),
            own_flexibility(mass, 2 * STIFFNESS) / own_flexibility(mass),
            "-",
            pinned=AGREES,
            **common,
        )


# -- bearings ------------------------------------------------------------------------------------------------------------------

LOAD = 500.0  # N
ROLLERS: dict[str, Any] = {"rollers": 16, "roller_length": "3.2 mm"}  # of the cylindrical bearing
KINDS = ("61804", "hypothetical-ACBB15-20x32x7", "hypothetical-ACBB25-20x32x7", "hypothetical-TRB-20x32x7")
INNER = (
    "inner geometries of the size of a 61804, nobody's bearings but the first; no clearance, rings parallel, 500 N radially; without "
    "an axial load the rings keep their axial place"
)


def radial_stiffness(bearing: BallBearing | RollerBearing, axial: float = 0.0) -> float:
    """Tangent stiffness [N/m] of a bearing under `LOAD` and an axial force [N], rings parallel."""
    held = ("tilt_x", "tilt_y") if axial else ("z", "tilt_x", "tilt_y")
    return float(bearings.solve(bearing, force=[LOAD, 0.0, axial, 0.0, 0.0], held=held).stiffness[0, 0])


def stiffness_ratio(axial: float, taper: BallBearing | RollerBearing) -> float:
    """Stiffness of the cylindrical bearing over that of the stiffest other; bearings with a contact angle get `axial` [N] each."""
    others = [taper if "TRB" in name else bearings.bearing(name) for name in KINDS]
    best = max(radial_stiffness(other, axial if other.contact_angle else 0.0) for other in others)
    return radial_stiffness(bearings.bearing("hypothetical-CRB-20x32x7")) / best


def secant_stiffness_of_61804(force: float) -> float:
    """Radial force over displacement [N/m]."""
    equilibrium = bearings.solve(bearings.bearing("61804"), force=[force, 0.0, 0.0, 0.0, 0.0])
    return float(force / equilibrium.displacement[0])


def _bearings() -> Iterator[Row]:
    yield from _stiffest()
    light = Explanation(
        "A 61804 has this secant stiffness at 107 N. No bearing of this kind has a constant stiffness: without preload it "
        "grows with the cube root of the load, from 0 at no load.",
        secant_stiffness_of_61804(107.0),
    )
    assumed = "balls of the catalogue's back-fitted 61804; no clearance; the load, which the paper leaves out"
    yield Row(
        "secant stiffness of a 61804 at 500 N",
        rounded("30 kN/mm", "N/m")._replace(text="3.0e7 N/m"),
        secant_stiffness_of_61804(LOAD),
        "N/m",
        pinned=EXPLAINED,
        kind="published table",
        where="Table 1",
        inputs=DATA,
        assumed=assumed,
        explanation=light,
    )


def _stiffest() -> Iterator[Row]:
    taper = bearings.bearing("hypothetical-TRB-20x32x7")
    alike = taper.replace(**ROLLERS)
    plain, claim = stiffness_ratio(0.0, alike), Printed("above 1, implied", *ABOVE_ONE)
    loaded = Explanation("The claim holds for equal rollers and no axial load. With it, all of a tapered bearing's rollers carry.", plain)
    longer = Explanation("The claim holds for equal rollers. A tapered bearing of the same size may have more and longer ones.", plain)
    common: dict[str, Any] = {
        "unit": "-",
        "kind": "published table",
        "where": "section 5.3, figs. 17 and 18",
        "inputs": "61804, 'identical dimensions'",
        "assumed": INNER,
    }
    name = "cylindrical roller bearing over the stiffest other"
    yield Row(f"{name}, equal rollers, no axial load", claim, plain, pinned=AGREES, **common)
    yield Row(
        f"{name}, tapered with 17 rollers of 4 mm, no axial load",
        claim,
        stiffness_ratio(0.0, taper),
        pinned=EXPLAINED,
        explanation=longer,
        **common,
    )
    yield Row(f"{name}, equal rollers, 300 N axially", claim, stiffness_ratio(300.0, alike), pinned=EXPLAINED, explanation=loaded, **common)


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
    "Eqs. (16), (17): the ratio has a meaning for x from the bearing, not from the first mass; (16) must begin with the yielding of A, not "
    "of B; with magnitudes it holds for a load on the left overhang only; the span of (17) is l7 + l8. Right, with signs: "
    "z(x) = w_A + (w_B - w_A)(x - x_A)/L.",
    "Eqs. (19), (20) inherit all this; (20) is called mu_m4 and described as the segment from m3 to D.",
    "Eq. (21): the indices of K2 are 33, 34; 43, 44.",
    "Section 4.1: the finite elements are fixed at three bearings; the shafts have four, and fixed is neither the simple support nor the "
    "spring of section 3.",
    "Section 5.2 sends the reader to sections 2.1 and 2.2 for the method of 3.1 and 3.2; section 5.3 puts the gearbox on the "
    "pressure-roller shaft, while m3 belongs to the other one.",
    "Section 5.3: three of the four trends contradict mechanics and conclusion (3). What may fall when bearings yield is the cross "
    "flexibility: that of m1 and m2 goes from +50.5 to -82.1 nm/N.",
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
