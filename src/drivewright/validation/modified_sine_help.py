"""Help page of a commercial cam program: factors of the modified sine."""

from typing import Any

from drivewright import motion
from drivewright.validation.source import AGREES, EXPLAINED, Explanation, Row, Source, rounded

TRUNCATED = "the page cuts the third digit off instead of rounding: -23.1555 is printed as -23.15"


def rows() -> tuple[Row, ...]:
    """Peaks, and the jerk at the middle of the rise."""
    law = motion.law("modified-sine")
    peaks, middle = law.peaks(), float(law(0.5).j)
    common: dict[str, Any] = {"unit": "-", "kind": "published table", "where": "Motion-Law Coefficients"}
    return (
        Row("velocity factor Cv", rounded("1.76", "-"), peaks.Vm, pinned=AGREES, **common),
        Row("acceleration factor Ca", rounded("5.53", "-"), peaks.Am, pinned=AGREES, **common),
        Row("jerk factor Cj", rounded("69.47", "-"), peaks.Jm, pinned=AGREES, **common),
        Row(
            "jerk factor at the crossover",
            rounded("-23.15", "-"),
            middle,
            pinned=EXPLAINED,
            explanation=Explanation(TRUNCATED, int(middle * 100) / 100),
            **common,
        ),
    )


source = Source(
    "modified-sine-help",
    'MechDesigner help, page "Modified-Sinusoid Motion-Law", '
    "http://mechdesigner.support/motion-cam-law-modified-sinusoid.htm (a stored copy was read).",
    rows,
)
