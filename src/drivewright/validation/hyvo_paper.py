"""The Hy-Vo chain with a small rolling radius of An, Cheng, Li and Xu: pitches, centre distances, stresses, lives beside ours.

The paper prints its tables and trends, but no mass, no flank, no material curve and no drawing: a trend is taken as an interval.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np

from drivewright._typing import Floats
from drivewright.chains import meshing
from drivewright.validation import hyvo_strength
from drivewright.validation.hyvo_model import (
    CHAIN,
    CLASSICAL_RADIUS,
    DRIVE,
    GROWS,
    MASSES,
    MM,
    NEW_RADII,
    SMALLER,
    TABLE,
    Z1,
    Z2,
    P,
    elastic_equilibrium,
    pin_offset,
    pitch_deviation,
    rigid_closure,
    seated_pitch_difference,
)
from drivewright.validation.source import (
    ABOVE_ONE,
    AGREES,
    BELOW_ONE,
    EVALUATED,
    EXPLAINED,
    NOT_COMPARED,
    OPEN,
    PRINT_ONLY,
    Explanation,
    Printed,
    Row,
    Source,
    evaluated,
    rounded,
)


def rows() -> Iterator[Row]:
    """Section 4.3, Table 2, Figs. 7 and 8, section 5, section 6, conclusions."""
    yield from _pitches()
    yield from _table()
    yield from _slopes()
    yield from _radii()
    yield from _distances()
    yield from _trends()
    yield from hyvo_strength.rows()


# -- section 4.3 ---------------------------------------------------------------------------------------------------------------


def _pitches() -> Iterator[Row]:
    common: dict[str, Any] = {"pinned": AGREES, "kind": "closed form", "where": "section 4.3", "inputs": CHAIN}
    for number, teeth, printed in ((1, Z1, "0.1795"), (2, Z2, "0.1698")):
        yield Row(f"pitch angle phi{number}, in rad", rounded(printed, "-"), 2 * np.pi / teeth, "-", **common)
    seated = meshing.seated_pitch(meshing.hole_pitch(P, MM), MM, pin_offset(1.0), Z1)
    truncated = Explanation("Cut off after the sixth digit, not rounded.", float(np.floor(seated * 1e9) * 1e-9))
    explained: dict[str, Any] = common | {"pinned": EXPLAINED, "explanation": truncated}
    yield Row("seated pitch pp1'' = pp01''", rounded("9.563499 mm", "m"), float(seated), "m", **explained)
    yield Row("constant k", rounded("11.464849", "-"), float(meshing.pitch_constant(Z1, Z2)), "-", **common)
    yield Row("boundary radius r10", rounded("5.0548 mm", "m"), float(meshing.boundary_radius(P, Z1, Z2)), "m", **common)
    yield Row("reference deviation delta12", rounded("0.00406 mm", "m"), float(meshing.reference_deviation(P, Z1, Z2)), "m", **common)
    common |= {"where": "section 6", "pinned": NOT_COMPARED, "basis": PRINT_ONLY}
    yield Row("2000 rpm in rad/s, over pi", rounded("66.7", "-"), 2000 / 30, "-", **common)


def _table() -> Iterator[Row]:
    common: dict[str, Any] = {"pinned": AGREES, "kind": "published table", "where": "Table 2", "inputs": CHAIN}
    for number, radius in enumerate(NEW_RADII, 1):
        hole, pin = (rounded(f"{text} mm", "m") for text in TABLE[radius])
        yield Row(f"hole pitch A, group {number}", hole, float(meshing.hole_pitch(P, radius * MM)), "m", **common)
        yield Row(f"pin offset e, group {number}", pin, pin_offset(radius), "m", **common)
    common |= {"pinned": NOT_COMPARED, "basis": PRINT_ONLY}
    round_pins = float(meshing.hole_pitch(P, CLASSICAL_RADIUS * MM))
    note = (
        "Nothing to compare it with: where the hole centres of the classical chain lie is not drawn; its motion depends on the radius of "
        "the rolling arcs and the pitch alone. Eq. (1) is for round pins, whose centres are those of the holes, and would give "
        f"{round_pins / MM:.3f} mm."
    )
    yield Row("hole pitch A, control group", rounded("8.16 mm", "m"), None, "m", note=note, **common)
    best = np.degrees(np.arcsin(pin_offset(CLASSICAL_RADIUS) / (CLASSICAL_RADIUS * MM)))
    note = (
        "Nothing to compare it with: the paper gives the control group 'the optimal parameter values' without stating the criterion. "
        f"With e = R sin(gamma) it deviates on both sprockets; without deviation on the driver gamma would be {best:.3f} deg."
    )
    yield Row("angle gamma, control group", rounded("3.667 deg", "rad"), None, "rad", note=note, **common)


def _slopes() -> Iterator[Row]:
    explained_pin: dict[str, Any] = {"pinned": EXPLAINED}
    common: dict[str, Any] = {"pinned": AGREES, "kind": "closed form", "inputs": CHAIN}
    for name, curve, figure in (("e", pin_offset, "Fig. 7"), ("delta_p2", pitch_deviation, "Fig. 8")):
        values = np.array([curve(radius) for radius in NEW_RADII])
        off = np.max(np.abs(values - np.linspace(values[0], values[-1], len(values)))) / np.ptp(values)
        yield Row(
            f"departure of {name} from a straight line, over its range",
            Printed("strictly linear: below 1e-9", 0.0, 1e-9, origin=EVALUATED),
            round(float(off), 9),
            "-",
            where=figure,
            **common,
        )
    c1, c2 = np.cos(np.pi / Z1), np.cos(np.pi / Z2)
    partial, total = (
        (seated_pitch_difference(1.6, e) - seated_pitch_difference(1.0, pin_offset(1.0))) / (6e-5 * MM)
        for e in (pin_offset(1.0), pin_offset(1.6))
    )
    partial_derivative = Explanation(
        "(29) holds e fixed; e grows with r1 by (21), so that the slope is 1 - k tan(pi/(2 z1)) = 0.48511 of it. The sign, "
        "and so the conclusion, stays.",
        float(partial),
    )
    printed = evaluated(f"{2e4 * (c2 - c1) / (c1 * c2):.5f}", "-")
    yield Row(
        "slope of delta_p2 over r1, in 1e-4",
        printed,
        float(total),
        "-",
        where="eq. (29)",
        explanation=partial_derivative,
        **(common | explained_pin),
    )


def _radii() -> Iterator[Row]:
    in_metres: dict[str, Any] = {"unit": "m", "pinned": EXPLAINED}
    common: dict[str, Any] = {"pinned": AGREES, "kind": "closed form", "inputs": CHAIN, "unit": "-"}
    reference = meshing.reference_deviation(P, Z1, Z2)
    classical = abs(meshing.pitch_deviation(P, CLASSICAL_RADIUS * MM, CLASSICAL_RADIUS * MM * np.sin(np.radians(3.667)), Z2))
    yield Row(
        "largest delta_p2 of groups 1 to 7 over delta12",
        Printed("below 1, eq. (30)", *BELOW_ONE),
        float(max(map(pitch_deviation, NEW_RADII)) / reference),
        where="Fig. 8",
        **common,
    )
    yield Row(
        "delta_p2 of the control group over delta12",
        Printed("above 1, eq. (31)", *ABOVE_ONE),
        float(classical / reference),
        where="eq. (31)",
        assumed="arcs of 7.4 mm with e = R sin(gamma)",
        **common,
    )
    note = (
        "'Unconditionally' holds for this pitch and these teeth and means delta_p2 < delta12, no more. For z1 = z2, delta12 is 0 and "
        f"r10 is p/(2 cos(pi/z)): {meshing.boundary_radius(8.0, 40, 40):.4f} mm for 8 mm and 40 teeth."
    )
    yield Row(
        "largest radius that holes allow, 1.6 mm, over r10",
        Printed("below 1", *BELOW_ONE),
        float(1.6 * MM / meshing.boundary_radius(P, Z1, Z2)),
        where="section 4.3",
        note=note,
        **common,
    )
    not_monotone = Explanation(
        "At r10 the deviations on the driven sprocket are equal, no more: there p'' has its greatest value between the two "
        "seats. p'' of a matched chain grows up to the driver's seat below p/(2 cos(pi/z1)). Under that reading our "
        "value is the printed one.",
        float(meshing.boundary_radius(P, Z1, Z2)),
    )
    yield Row(
        "radius below which p'' grows with the angle up to the seat",
        rounded("5.0548 mm", "m"),
        float(meshing.monotone_radius(P, Z1)),
        explanation=not_monotone,
        where="conclusion 2",
        **(common | in_metres),
    )


# -- section 5 -----------------------------------------------------------------------------------------------------------------


ELASTIC = "elastic joints and teeth"
ROUTES = {
    "straight strands": lambda radius: rigid_closure(radius, "straight"),
    "strands in equilibrium": rigid_closure,
    ELASTIC: elastic_equilibrium,
}


def _distances() -> Iterator[Row]:
    common: dict[str, Any] = {"kind": "other code", "inputs": DRIVE, "unit": "m"}
    first, last = rigid_closure(1.0, "straight").mean, rigid_closure(1.6).mean
    truncated = Explanation(
        f"Cut off, not rounded, it is the mean of the rigid drive of group 1. Those of all groups lie from {1e3 * first:.4f} "
        f"to {1e3 * last:.4f} mm, and that of hinges (r1 = 0) is 219.0540 mm. How it was chosen is not stated.",
        float(np.floor(first * 1e6) * 1e-6),
    )
    yield Row(
        "initial centre distance",
        rounded("219.056 mm", "m"),
        first,
        where="section 5.1",
        pinned=EXPLAINED,
        explanation=truncated,
        assumed="mean over a tooth, rigid, straight strands, group 1",
        **common,
    )
    common["where"] = "section 5.2"
    apart = round(219.136037 - 219.115892, 9) * MM
    printed = rounded("0.020145 mm", "m")
    yield Row("fluctuation from the printed extremes", printed, apart, pinned=NOT_COMPARED, basis=PRINT_ONLY, **common)
    rest = elastic_equilibrium(CLASSICAL_RADIUS)
    common |= {
        "pinned": OPEN,
        "assumed": MASSES,
        "note": (
            "Does not follow from the data given: masses, friction, damping and its exponents, and the driven sprocket are not printed. At "
            f"rest the rigid drive has {1e3 * rigid_closure(CLASSICAL_RADIUS).mean:.4f} mm and elasticity adds the rest. Most of a running "
            "deviation is compliance, a choice of the model."
        ),
    }
    distance = rest.centre_distance
    for name, printed, ours in (
        ("maximum centre distance", "219.136037", distance.max()),
        ("minimum centre distance", "219.115892", distance.min()),
        ("fluctuation", "0.020145", rest.fluctuation),
        ("mean centre distance", "219.1256", rest.mean),
    ):
        printed_row: dict[str, Any] = common | {"where": "section 5.3" if name.startswith("mean") else "section 5.2"}
        quantity = f"{name}, control group"
        yield Row(f"{quantity} at rest", rounded(f"{printed} mm", "m"), float(ours), reading_of=quantity, **printed_row)
    yield Row(
        "running deviation, printed mean less 219.056 mm",
        rounded("0.0696 mm", "m"),
        round(219.1256 - 219.056, 6) * MM,
        pinned=NOT_COMPARED,
        basis=PRINT_ONLY,
        note="The paper subtracts 19.056, a misprint of 219.056.",
        where="section 5.3",
        kind="other code",
        inputs=DRIVE,
        unit="m",
    )


ELASTIC_NOTE = (
    "True of rigid drives alone. With joints and teeth of the paper's stiffness, at rest under the paper's force, the order is the "
    "opposite: 2.5 um for group 1, 2.1 um for group 7; the control group lies between them, at 2.4 um."
)
RUNNING_NOTE = "True of plates without elasticity at rest. The claim is about running chains; the page of the paper computes those."
AT_REST = "True at rest. The claim is about running chains; the page of the paper computes those."


def _trends() -> Iterator[Row]:
    for route, compute in ROUTES.items():
        groups, control = [compute(radius) for radius in NEW_RADII], compute(CLASSICAL_RADIUS)
        common: dict[str, Any] = {
            "kind": "other code",
            "inputs": DRIVE,
            "unit": "-",
            "assumed": MASSES if compute is elastic_equilibrium else "rigid plates, no load",
        }
        yield from _fluctuations(route, np.array([each.fluctuation for each in groups]), control.fluctuation, common)
        yield from _deviations(route, np.array([each.mean for each in groups]) - 219.056e-3, control.mean - 219.056e-3, common)


def _fluctuations(route: str, groups: Floats, control: float, common: dict[str, Any]) -> Iterator[Row]:
    elastic = route == ELASTIC
    common = common | {"where": "Fig. 11", "pinned": EXPLAINED, "note": "" if elastic else RUNNING_NOTE, "idealised": True}
    for name, claim, ours, stiff in (
        ("minimum growth of the fluctuation from group to group, in um", GROWS, np.diff(groups).min() * 1e6, _least_fluctuation_growth()),
        ("largest fluctuation of groups 1 to 7 over control", SMALLER, groups.max() / control, _fluctuation_ratio()),
    ):
        yield Row(
            f"{name}, {route}",
            claim,
            round(float(ours), 5),
            explanation=Explanation(ELASTIC_NOTE, stiff) if elastic else None,
            reading_of=name,
            **common,
        )


def _least_fluctuation_growth() -> float:
    return float(np.diff([rigid_closure(radius).fluctuation for radius in NEW_RADII]).min() * 1e6)


def _fluctuation_ratio() -> float:
    return max(rigid_closure(radius).fluctuation for radius in NEW_RADII) / rigid_closure(CLASSICAL_RADIUS).fluctuation


def _deviations(route: str, groups: Floats, control: float, common: dict[str, Any]) -> Iterator[Row]:
    line = np.linspace(groups[0], groups[-1], len(groups))
    common = common | {"where": "Figs. 12, 13", "pinned": EXPLAINED, "note": AT_REST, "idealised": True}
    for name, claim, ours in (
        ("minimum growth of the running deviation from group to group, in um", GROWS, np.diff(groups).min() * 1e6),
        ("largest running deviation of groups 1 to 7 over control", SMALLER, groups.max() / control),
        (
            "departure of the running deviation from a straight line, over its range",
            Printed("linear: below 0.05", 0.0, 0.05),
            np.abs(groups - line).max() / np.ptp(groups),
        ),
    ):
        yield Row(f"{name}, {route}", claim, round(float(ours), 5), reading_of=name, **common)


ERRATA = (
    "Eq. (2): the apothem of the rotation centre is f0 + r1 cos(a) + e sin(a); without the last term the sprocket is cut 0.134 mm off the "
    "flanks (group 3). Table 1 gives the module of the cutter as m2 = p2; it is p2/pi.",
    "Eq. (29) is the derivative with e held; by (21) e grows with r1, and the slope of delta_p2 is 4.1374e-4 instead of 8.5288e-4.",
    "Section 4.3: pp1'' = 9.563499 mm is cut off; it rounds to 9.563500 mm.",
    "Section 4.3: 'unconditionally' true is r1 < r10 for this pitch and these teeth; for equal tooth numbers delta12 is 0.",
    "The pin offset e has no effect on any motion, seat, force or tooth, it only sets where the line called pitch line is drawn. All "
    "groups "
    "change r1 and e together, so that the experiment cannot separate their effects. The quantities that matter are r1 and the flank's "
    "distance from the pin.",
    "A pitch that varies does not take away the polygonal action: the strand rises and falls by 0.2139 to 0.2153 mm on 35 teeth for any r1 "
    "from 0 to 7.4 mm, as that of a roller chain does.",
    "The fluctuation depends on the number of links more than on r1. With 81 or 83 instead of 82 links the trend turns round: rigid, with "
    "strands in equilibrium, groups 1 to 7 fall from 7.7 to 7.2 um, and the classical chain has 2.6 um.",
    "Section 5.1: 150 outputs in 0.3 s are 500 a second; the teeth mesh 1167 times a second, so the curves of Fig. 10 are aliased.",
    "Section 5: links' and sprocket's masses, contact exponents, friction, flank angle, apothem, cutter and lacing are not given; the mean "
    "centre distance is mostly the compliance of the contacts, a choice of the model.",
    "Section 5.3: 19.056 stands for 219.056 mm.",
    "Section 5.3: 'proved to be linear' is the closure of rigid plates, where the mean grows by 2.5 um per mm of radius.",
    "The control group has another measure in place of e, the angle 3.667 deg, and counts it from another place.",
    "Section 6.1: the elements of the pin are nine times as wide as half the contact; 1415 MPa of the small pins against 570 MPa of the "
    "classical ones are not resolved. By Tresca the small pins begin to yield at 1390 MPa.",
    "Section 6.2: 303.13 and 468.66 MPa of the plates cannot be computed: neither plate is drawn. The plate of group 3 that we drew has "
    "223 MPa in its crotch under 200 N, and the start from 0 to 2000 rpm in 0.01 s adds to that: the numbers depend on a drawing that "
    "is not given.",
    "Section 6: lives of plates have no unit. The exponents that stresses and lives imply are 5.98 for plates and 3.30 for pins.",
    "Conclusion 2: p'' grows strictly up to the seat for r1 < 4.7817 mm; at r10 = 5.0548 mm it only deviates by delta12.",
    "Conclusion 3: 'much smaller' fluctuations are those of rigid plates. With the paper's contact stiffness, at rest, groups 1 to 7 fall "
    "from 2.5 to 2.1 um and the classical chain has 2.4 um.",
)

source = Source(
    "hyvo-paper",
    "An Lichi, Cheng Yabing, Li Jiabao, Xu Weilong: New Design of Hy-Vo Chain Based on the Ultra-Small Rolling Radius. "
    "Machines 2022, 10(5), 325, doi:10.3390/machines10050325 (text and Table 2 read, figures not).",
    rows,
    ERRATA,
)
