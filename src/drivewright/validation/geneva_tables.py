"""Peaks of external Geneva drives as handbooks tabulate them, and in closed form."""

import math
from collections.abc import Iterator

from drivewright.indexing.geneva.step import GenevaStep
from drivewright.validation.source import AGREES, Row, Source, rounded

# slots: maximum speed ratio, acceleration ratio at entry, maximum acceleration ratio; crank speed 1 rad/s
HANDBOOK = {
    3: ("6.46", "1.732", "31.4"),
    4: ("2.41", "1.000", "5.41"),
    5: ("1.43", "0.727", "2.30"),
    6: ("1.00", "0.577", "1.35"),
    7: ("0.766", "0.482", "0.928"),
    8: ("0.620", "0.414", "0.700"),
    9: ("0.520", "0.364", "0.559"),
    10: ("0.447", "0.325", "0.465"),
}
NOTES = {  # where a fourth digit is recalled that the closed form does not give
    (3, 2): "Recalled with a fourth digit, 31.44; the closed form gives 31.39.",
    (4, 2): "Recalled with a fourth digit, 5.409; the closed form gives 5.407.",
}
NAMES = ("maximum speed ratio", "acceleration ratio at entry", "maximum acceleration ratio")


def geneva(slots: int) -> GenevaStep:
    """The drive of so many slots whose pin enters along the slot, at a centre distance of 1 m."""
    return GenevaStep(slots, 1.0, math.sin(math.pi / slots))


def rows() -> Iterator[Row]:
    """Tabulated peaks of each number of slots, then those that have a closed form of their own."""
    for slots, printed in HANDBOOK.items():
        step = geneva(slots)
        peaks = (step.largest_rate, step.entry_bend, step.largest_bend)
        for place, (name, text, ours) in enumerate(zip(NAMES, printed, peaks, strict=True)):
            note = NOTES.get((slots, place), "")
            yield Row(f"{slots} slots, {name}", rounded(text, "-"), ours, "-", AGREES, "published table", "recalled", note=note)
    for slots, name, formula, value in (
        (4, "maximum speed ratio", "1 + sqrt(2)", 1 + math.sqrt(2)),
        (6, "maximum speed ratio", "1", 1.0),
        (6, "maximum jerk ratio", "6", 6.0),
        (4, "acceleration ratio at entry", "tan 45°", 1.0),
        (6, "acceleration ratio at entry", "1/sqrt(3)", 1 / math.sqrt(3)),
    ):
        step = geneva(slots)
        ours = {NAMES[0]: step.largest_rate, NAMES[1]: step.entry_bend, "maximum jerk ratio": step.largest_third}[name]
        text = rounded(f"{value:.9f}", "-")._replace(text=f"{formula} = {value:.9f}")
        yield Row(f"{slots} slots, {name} in closed form", text, ours, "-", AGREES, "closed form", "derived")


source = Source(
    "geneva-tables",
    "Peaks of external Geneva drives by the number of slots, as in J. H. Bickford, Mechanisms for Intermittent Motion (1972), and "
    "R. L. Norton, Design of Machinery: both recalled, neither opened; the closed forms beside them are our own derivation.",
    rows,
)
