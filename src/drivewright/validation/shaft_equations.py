"""Equations (1) to (21) of the shaft paper, each evaluated for its data, beside the beam of the presets."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from drivewright import registry
from drivewright._typing import Floats
from drivewright.runner import run
from drivewright.spec import load
from drivewright.validation.shaft_model import (
    DATA,
    EI,
    L1,
    L2,
    L3,
    L5,
    L6,
    L7,
    L8,
    LAYOUT,
    PRINTED_SECTION,
    READING,
    SPAN,
    STIFFNESS,
    flexibility,
    flexibility_of_formula,
    literal_bearing_flexibility,
    own_flexibility,
    run_preset,
    slope_of_formula,
    value_per_newton,
)
from drivewright.validation.source import AGREES, EVALUATED, EXPLAINED, Explanation, Printed, Row, evaluated, rounded

MISPRINT = "Misprint: the span is that of the bearings C and D, l7 + l8; with D right of C by l7 alone ours is the printed value."


def rows() -> Iterator[Row]:
    """Section, eqs. (1) to (21)."""
    yield from _section()
    yield from _pressure_roller()
    yield from _rubber_roller()
    yield from _lines()
    yield from _elastic_bearings()
    yield _equation_21()


# -- section and closed forms --------------------------------------------------------------------------------------------------


def _section() -> Iterator[Row]:
    common: dict[str, Any] = {"pinned": AGREES, "kind": "closed form", "where": "Table 1", "inputs": DATA}
    yield Row("second moment of area of 20 mm, in mm^4", rounded("7854", "-"), float(np.pi * 20**4 / 64), "-", **common)


def _pressure_roller() -> Iterator[Row]:
    common: dict[str, Any] = {"kind": "closed form", "inputs": DATA, "assumed": READING, "pinned": AGREES}
    own = "The formula belongs to a force at this mass alone, although the text speaks of one force P."
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


# -- elastic bearings, eqs. (15) to (21) ----------------------------------------------------------------------------------------


def _elastic_bearings() -> Iterator[Row]:
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
            f"contribution of the bearings at {mass}",
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
    "Wrong signs: with the magnitudes of our reactions and x from the first mass, as printed, ours is the printed value. Elastic "
    "bearings add squares of their reactions over their stiffness, so never a negative flexibility under the load itself."
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
        "flexibility of m2 on elastic bearings",
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
        "flexibility of m4 on elastic bearings",
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
        Printed("2, implied by its inverse K2", 2, 2, origin=EVALUATED),
        printed,
        "-",
        pinned=EXPLAINED,
        kind="closed form",
        where="eq. (21)",
        inputs=DATA,
        assumed=READING,
        explanation=misprint,
    )
