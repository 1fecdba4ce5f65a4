"""Factors of the classical motion laws as handbooks print them, and in closed form."""

import math
from collections.abc import Iterator

from drivewright import motion
from drivewright.validation.source import AGREES, Row, Source, rounded

PI = math.pi
FACTORS = ("Vm", "Am", "Jm", "AVm")

# Velocity, acceleration, jerk and torque factor; a factor that is infinite is left out.
HANDBOOK = {
    "modified-sine": ("1.76", "5.53", "69.47", "5.46"),
    "modified-trapezoid": ("2.00", "4.89", "61.43", "8.09"),
    "cycloidal": ("2.00", "6.28", "39.5", "8.16"),
    "simple-harmonic": ("1.5708", "4.9348", None, "3.88"),
    "parabolic": ("2.00", "4.00", None, "8.00"),
    "polynomial-345": ("1.875", "5.7735", "60.0", "6.69"),
    "polynomial-4567": ("2.1875", "7.5132", "52.5", "10.75"),
    "mcv50": ("1.28", "8.01", "201.4", "5.73"),
}

CLOSED = {
    "modified-sine": {
        "Vm": ("4 pi/(4 + pi)", 4 * PI / (4 + PI)),
        "Am": ("4 pi^2/(4 + pi)", 4 * PI**2 / (4 + PI)),
        "Jm": ("16 pi^3/(4 + pi)", 16 * PI**3 / (4 + PI)),
    },
    "modified-trapezoid": {"Am": ("8 pi/(2 + pi)", 8 * PI / (2 + PI)), "Jm": ("32 pi^2/(2 + pi)", 32 * PI**2 / (2 + PI))},
    "cycloidal": {"Am": ("2 pi", 2 * PI), "Jm": ("4 pi^2", 4 * PI**2), "AVm": ("3 sqrt(3) pi/2", 1.5 * math.sqrt(3) * PI)},
    "simple-harmonic": {"Vm": ("pi/2", PI / 2), "Am": ("pi^2/2", PI**2 / 2), "AVm": ("pi^3/8", PI**3 / 8)},
    "polynomial-345": {"Vm": ("15/8", 1.875), "Am": ("10/sqrt(3)", 10 / math.sqrt(3))},
    "polynomial-4567": {"Vm": ("35/16", 2.1875), "Am": ("84 sqrt(5)/25", 84 * math.sqrt(5) / 25)},
}


def rows() -> Iterator[Row]:
    """Printed factors of every law, then those that have a closed form."""
    for law, printed in HANDBOOK.items():
        peaks = motion.law(law).peaks()
        for factor, text in zip(FACTORS, printed, strict=True):
            if text is not None:
                yield Row(f"{law}, {factor}", rounded(text, "-"), getattr(peaks, factor), "-", AGREES, "published table", "recalled")
    for law, formulas in CLOSED.items():
        peaks = motion.law(law).peaks()
        for factor, (formula, value) in formulas.items():
            text = rounded(f"{value:.9f}", "-")._replace(text=f"{formula} = {value:.9f}")
            yield Row(f"{law}, {factor} in closed form", text, getattr(peaks, factor), "-", AGREES, "closed form", "derived")


source = Source(
    "motion-laws",
    "Peak factors of cam motion laws for unit rise in unit time, as in R. L. Norton, Cam Design and Manufacturing Handbook, "
    "and indexer catalogues: both recalled, neither opened; the closed forms beside them are our own derivation.",
    rows,
)
