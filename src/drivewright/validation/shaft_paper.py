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
from drivewright.validation.source import (
    AGREES,
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
HISTORICAL_NOTE = "The printed eqs. (16), (17), which are wrong, give this trend: the paper beside itself."
MISPRINT = "Misprint: the span is that of the bearings C and D, l7 + l8; with D right of C by l7 alone ours is the printed value."


def rows() -> Iterator[Row]:
    """Section, eqs. (1) to (21), section 4.1, section 5.3, bearings."""
    yield from _section()
    yield from _pressure_roller()
    yield from _rubber_roller()
    yield from _lines()
    yield from _yielding()
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


def flexibility_of_formula(value: float) -> Printed:
    """A printed formula's flexibility [m/N] for the printed data, to six digits."""
    return evaluated(f"{1e9 * value:.6g} um/kN", "m/N")


def slope_of_formula(value: float) -> Printed:
    """A printed formula's slope [rad/N], in urad/N, to six digits."""
    return evaluated(f"{1e6 * value:.6g}", "-")


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
    yield Row("slope at A, force at m1, in urad/N", slope_of_formula(L1 * L2 / (3 * EI)), 1e6 * slope, "-", where="eq. (1)", **common)
    yield Row("moment at A over the force at m1, in m", evaluated("0.0565", "-"), moment, "-", where="eq. (2)", **common)
    for number, mass, arm in ((3, "m1", L1), (4, "m2", L3)):
        yield Row(
            f"flexibility of {mass}, bearings rigid",
            flexibility_of_formula(arm**2 * (arm + L2) / (3 * EI)),
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
    yield Row(name, slope_of_formula(L6 * L7 / (3 * EI)), slope, "-", where="eq. (5)", explanation=Explanation(MISPRINT, other), **common)
    own, other = own_flexibility("m3", np.inf), float(flexibility("rubber-roller-r3", np.inf)[0, 0])
    yield Row(
        "flexibility of m3, bearings rigid",
        flexibility_of_formula(L6**2 * (L6 + L7) / (3 * EI)),
        own,
        "m/N",
        where="eq. (6)",
        explanation=Explanation(MISPRINT, other),
        **common,
    )


# -- deflection lines, eqs. (7) to (14) ----------------------------------------------------------------------------------------


def deflections(preset: str, places: tuple[float, ...]) -> Floats:
    """(places, 2) deflections [m/N] at places [m] of a preset's shaft by unit forces at its two masses, bearings rigid."""
    marked = [{"name": f"place-{number}", "position": f"{place!r} m"} for number, place in enumerate(places)]
    spec = load(registry.mechanism("shaft").presets()[preset], (PRINTED_SECTION, 'analysis.theory="euler-bernoulli"'))
    rigid = [{"name": b.name, "position": f"{b.position!r} m", "radial_stiffness": "rigid"} for b in spec.bearings]
    same = {s.name: next((n for n, place in enumerate(places) if abs(place - s.position) < 1e-9), None) for s in spec.stations}
    masses = [{"name": s.name, "position": f"{s.position!r} m"} for s in spec.stations if same[s.name] is None]
    flexibilities = run(spec.replace(bearings=rigid, stations=[*marked, *masses], loads=[]), ("flexibility",)).arrays["flexibility"]
    names = list(flexibilities.labels[0])
    loaded = [name if number is None else f"place-{number}" for name, number in same.items()]
    return flexibilities.values[np.ix_([names.index(mark["name"]) for mark in marked], [names.index(name) for name in loaded])]


def printed_line(x: float, terms: tuple[tuple[float, float], ...], zeros: tuple[float, float]) -> float:
    """u(x) = (sum f <x - a>^3 + C1 x + C2)/(6 EI) for terms (f, a), with the constants that make it zero at two bearings  [m]."""

    def cubes(z):
        return sum(f * max(z - a, 0.0) ** 3 for f, a in terms)

    first, second = zeros
    slope = -(cubes(second) - cubes(first)) / (second - first)
    return (cubes(x) + slope * (x - first) - cubes(first)) / (6 * EI)


PLACES_1 = {7: ("between m1 and A", L1 / 2), 8: ("between A and B", L1 + L2 / 2), 9: ("between B and m2", L1 + L2 + L3 / 2)}
PLACES_1[10] = ("right end", 0.340)
LINE_INPUTS = "1 N at each of the two masses, bearings rigid"
SIGN_OF_F2 = "Misprint: F2 must enter with a minus sign, as F1 does. With F2 turned round behind m2 ours is the printed value."
OTHER_LENGTHS = (
    "Misprint: the lengths are those of an older numbering (reading R2: m3 0, C 95, D 148, m4 230 mm), and F2 pulls up where F1 presses "
    "down. For that shaft and those forces ours is the printed value."
)


def _lines() -> Iterator[Row]:
    """Deflections that eqs. (7) to (14) give for the printed data, positive with the load."""
    common: dict[str, Any] = {"kind": "closed form", "inputs": f"{DATA}; {LINE_INPUTS}", "unit": "m/N"}
    places = tuple(place for _, place in PLACES_1.values())
    ours = deflections("pressure-roller", places).sum(axis=1)
    reaction_a, reaction_b = 1 + L1 / L2 - L3 / L2, -L1 / L2 + 1 + L3 / L2
    terms = ((-1.0, 0.0), (reaction_a, L1), (reaction_b, L1 + L2), (1.0, L1 + L2 + L3))
    for (number, (name, place)), value in zip(PLACES_1.items(), ours, strict=True):
        printed = -printed_line(place, terms, (L1, L1 + L2))  # eqs. (7) to (10) count deflection upwards
        behind = max(place - L1 - L2 - L3, 0.0)
        yield Row(
            f"deflection {name}, pressure-roller shaft",
            flexibility_of_formula(printed),
            float(value),
            where=f"eq. ({number})",
            pinned=EXPLAINED if behind else AGREES,
            explanation=Explanation(SIGN_OF_F2, float(value) - 2 * behind**3 / (6 * EI)) if behind else None,
            assumed=READING,
            **common,
        )
    yield from _lines_of_rubber_roller(common)


def _lines_of_rubber_roller(common: dict[str, Any]) -> Iterator[Row]:
    """Eqs. (11) to (14) to the letter: x from m3, lengths l4, l5, l6, F_D down, F2 up."""
    l4, l5, l6 = 0.095, L5, L6
    force_c = (l4 + l5 + l6) / l5  # up: moments about D, F1 down at a distance l4 + l5, F2 up at l6
    force_d = force_c  # down: F1 and F2 cancel
    terms = ((1.0, 0.0), (-force_c, l4), (force_d, l4 + l5), (-1.0, l4 + l5 + l6))
    where = {
        11: ("at m3", 0.0, L5),
        12: ("between m3 and C", l4 / 2, L5 + L6 / 2),
        13: ("between C and m4", l4 + l5 + l6 / 2, L5 + L6 + L7 / 2),
        14: ("at m4", l4 + l5 + l6, L5 + L6 + L7),
    }
    ours = deflections("rubber-roller-r1", tuple(place for _, _, place in where.values())).sum(axis=1)
    other = deflections("rubber-roller-r2", tuple(x for _, x, _ in where.values())) @ np.array([1.0, -1.0])
    for (number, (name, x, _)), value, read in zip(where.items(), ours, other, strict=True):
        yield Row(
            f"deflection {name}, rubber-roller shaft",
            flexibility_of_formula(printed_line(x, terms, (l4, l4 + l5))),
            float(value),
            where=f"eq. ({number})",
            pinned=EXPLAINED,
            explanation=Explanation(OTHER_LENGTHS, float(read)),
            assumed=READING,
            **common,
        )


# -- bearings that yield, eqs. (15) to (21) ------------------------------------------------------------------------------------


def _yielding() -> Iterator[Row]:
    common: dict[str, Any] = {"kind": "closed form", "inputs": DATA, "assumed": READING, "unit": "m/N"}
    reactions = {
        "A, force at m1": (1 + L1 / L2, "pressure-roller", "m1", "A"),
        "B, force at m2": (1 + L3 / L2, "pressure-roller", "m2", "B"),
    }
    reactions["C, force at m3"] = (1 + L6 / SPAN, "rubber-roller-r1", "m3", "C")
    for name, (reaction, preset, station, bearing) in reactions.items():
        load_one = f'loads=[{{station="{station}", force="1 N"}}]'
        ours = abs(run_preset(preset, None, ("statics",), load_one)[f"bearings.{bearing}.displacement"])
        printed = flexibility_of_formula(reaction / STIFFNESS)
        yield Row(f"displacement in bearing {name}", printed, ours, where="eq. (15)", pinned=AGREES, **common)
    for mass, printed in LITERAL.items():
        preset, _, place = LAYOUT[mass]
        number = 16 if preset == "pressure-roller" else 17
        own, rigid = own_flexibility(mass), own_flexibility(mass, np.inf)
        yield Row(
            f"what yielding bearings add at {mass}",
            flexibility_of_formula(printed),
            own - rigid,
            where=f"eq. ({number})",
            pinned=EXPLAINED,
            explanation=Explanation(LITERAL_REMARK, literal_bearing_flexibility(mass)),
            **common,
        )
    yield from _sums(common)


LITERAL = {  # eqs. (16), (17) for the printed data: mu are magnitudes of the reactions over the stiffness, x from the first mass
    "m1": L1 / L2 / STIFFNESS,
    "m2": ((1 + L3 / L2) - (L1 + L2 + L3) / L2 * (1 + 2 * L3 / L2)) / STIFFNESS,
    "m3": (1 + L6 / SPAN) / STIFFNESS,
    "m4": (L8 / SPAN - (L6 + L7) / (L6 + L7) * (L8 + L7) / SPAN) / STIFFNESS,
}
LITERAL_REMARK = (
    "Wrong signs: with the magnitudes of our reactions and x from the first mass, as printed, ours is the printed value. Bearings that "
    "yield add squares of their reactions over their stiffness, so never a negative flexibility under the load itself."
)


def _sums(common: dict[str, Any]) -> Iterator[Row]:
    """Eq. (18) with the right parts; eqs. (19) to (21) to the letter."""
    share = ((L3 / L2) ** 2 + (1 + L3 / L2) ** 2) / STIFFNESS
    rigid = L3**2 * (L2 + L3) / (3 * EI)
    yield Row(
        "flexibility of m2 as the sum of beam and bearings",
        flexibility_of_formula(rigid + share),
        own_flexibility("m2"),
        where="eq. (18)",
        pinned=AGREES,
        **common,
    )
    yield Row(
        "flexibility of m2 on bearings that yield",
        flexibility_of_formula(rigid + LITERAL["m2"]),
        own_flexibility("m2"),
        where="eq. (19)",
        pinned=EXPLAINED,
        explanation=Explanation(LITERAL_REMARK, own_flexibility("m2", np.inf) + literal_bearing_flexibility("m2")),
        **common,
    )
    l5, l6 = L5, L6
    beam = -(l6**2) * (l5 + l6) / (3 * EI)  # m4 overhangs D by l6 on a span l5, its force up
    old = float(flexibility("rubber-roller-r2", np.inf)[1, 1])
    yield Row(
        "flexibility of m4 on bearings that yield",
        flexibility_of_formula(beam + LITERAL["m4"]),
        own_flexibility("m4"),
        where="eq. (20)",
        pinned=EXPLAINED,
        explanation=Explanation(f"{OTHER_LENGTHS} The bearings' part is that of eq. (17).", -old + literal_bearing_flexibility("m4")),
        **common,
    )
    d11 = L1**2 * (L1 + L2) / (3 * EI) + ((1 + L1 / L2) ** 2 + (L1 / L2) ** 2) / STIFFNESS
    d12 = L1 * L2 * L3 / (6 * EI) - ((1 + L1 / L2) * (L3 / L2) + (L1 / L2) * (1 + L3 / L2)) / STIFFNESS
    d22 = rigid + share
    k11 = d22 / (d11 * d22 - d12**2)
    in_newtons: dict[str, Any] = {"unit": "N/m"}
    yield Row(
        "stiffness of m1, m2 held, from the inverse",
        evaluated(f"{1e-6 * k11:.6g} kN/mm", "N/m"),
        float(run_preset("pressure-roller", None, ("flexibility",)).arrays["stiffness"].values[0, 0]),
        where="eq. (21)",
        pinned=AGREES,
        **(common | in_newtons),
    )


def _equation_21() -> Row:
    whole = np.zeros((4, 4))
    whole[:2, :2], whole[2:, 2:] = flexibility("pressure-roller"), flexibility("rubber-roller-r1")
    printed, meant = (int(np.linalg.matrix_rank(block)) for block in (whole[2:, :2], whole[2:, 2:]))
    misprint = Explanation("Misprint: the indices of K2 are 33, 34; 43, 44. No force on one shaft moves the other in this model.", meant)
    return Row(
        "rank of the flexibility with indices 31, 32; 41, 42",
        Printed("2, implied by its inverse K2", 2, 2, evaluated=True),
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


SUPPORTS_NOTE = (
    "Finite elements with fixed supports are another shaft than the beam on simple supports that they are to confirm. Whether they "
    "were clamped cannot be told: none of their numbers is printed, and there are four bearings in two shafts, not three."
)


def _fixed() -> Iterator[Row]:
    common: dict[str, Any] = {"kind": "closed form", "where": "section 4.1", "inputs": DATA, "assumed": READING}
    consistent = about("1, implied: consistent", 1.0, 0.1)
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
        literal: dict[str, Any] = common | {"pinned": NOT_COMPARED, "basis": PRINT_ONLY, "note": HISTORICAL_NOTE, "reading_of": name}
        yield Row(f"{name}, eqs. (16), (17) to the letter", claim, historical, **literal)


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
        rounded("3.0e7 N/m", "N/m"),
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
