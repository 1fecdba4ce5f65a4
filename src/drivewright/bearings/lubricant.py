"""The lubricant of a rolling bearing: viscosity at operating temperature, and how clean it is.

Viscosity over temperature after Walther (ASTM D341), nu + 0.7 = 10^10^(A - B lg T) with nu in mm^2/s and T in K, through 40 and 100 degC.
A grade of ISO 3448 says the viscosity at 40 degC; that at 100 degC is the one of an oil of viscosity index 95 (ASTM D2270).
"""

from collections.abc import Iterator
from typing import Literal

import numpy as np

from drivewright.errors import InputError, SpecError, UnknownName
from drivewright.spec import Number, Spec
from drivewright.spec.fields import Field
from drivewright.units import KinematicViscosity, Temperature

ZERO = 273.15  # K at 0 degC
COLDEST, HOTTEST = 253.15, 423.15  # K, between which a bearing of a spec runs
WARM, HOT = 40 + ZERO, 100 + ZERO
# grade, which is the viscosity [mm^2/s] at 40 degC: that at 100 degC with a viscosity index of 95
VISCOSITY_AT_HOT = {
    "ISO VG 10": 2.637,
    "ISO VG 15": 3.381,
    "ISO VG 22": 4.254,
    "ISO VG 32": 5.290,
    "ISO VG 46": 6.644,
    "ISO VG 68": 8.530,
    "ISO VG 100": 11.07,
    "ISO VG 150": 14.54,
    "ISO VG 220": 18.75,
    "ISO VG 320": 23.95,
    "ISO VG 460": 30.34,
    "ISO VG 680": 39.06,
    "ISO VG 1000": 49.86,
}
Grade = Literal[
    "ISO VG 10",
    "ISO VG 15",
    "ISO VG 22",
    "ISO VG 32",
    "ISO VG 46",
    "ISO VG 68",
    "ISO VG 100",
    "ISO VG 150",
    "ISO VG 220",
    "ISO VG 320",
    "ISO VG 460",
    "ISO VG 680",
    "ISO VG 1000",
]
Contamination = Literal["extreme-cleanliness", "high-cleanliness", "normal-cleanliness", "slight", "typical", "severe", "very-severe"]
# e_C of ISO 281 by the pitch diameter, below 100 mm and from there on: the middle of the range that the standard gives.  Ranges as printed
# in the manual of the MESYS bearing calculation; the SKF bearing calculator takes the same 0.55 for a 6309 of normal cleanliness.
CONTAMINATION_FACTORS: dict[str, tuple[float, float]] = {
    "extreme-cleanliness": (1.0, 1.0),
    "high-cleanliness": (0.7, 0.85),
    "normal-cleanliness": (0.55, 0.7),
    "slight": (0.4, 0.5),
    "typical": (0.2, 0.3),
    "severe": (0.05, 0.05),
    "very-severe": (0.0, 0.0),
}
LARGE = 0.1  # m, pitch diameter from which a bearing counts as a large one


GRADE, TEMPERATURE, CLEANLINESS = "ISO VG 68", 70.0, "normal-cleanliness"  # where nothing is given; the second in degC


class Lubrication(Spec):
    """The lubricant of the bearings, and the reliability of their modified life."""

    viscosity: KinematicViscosity | None = Field(
        None, gt=0, description="kinematic viscosity at operating temperature, in place of grade and temperature", examples=["20 mm^2/s"]
    )
    grade: Grade | None = Field(
        None, description=f"viscosity grade of the oil, or of a grease's base oil, viscosity index 95; default {GRADE}", examples=[GRADE]
    )
    temperature: Temperature | None = Field(
        None,
        ge=COLDEST,
        le=HOTTEST,
        description=f"operating temperature of the bearing, for the viscosity of the grade; default {TEMPERATURE:g} degC",
        examples=[f"{TEMPERATURE:g} degC"],
    )
    contamination: Contamination | None = Field(
        None, description=f"contamination class of ISO 281; default {CLEANLINESS}", examples=[CLEANLINESS]
    )
    contamination_factor: Number | None = Field(
        None, ge=0, le=1, description="contamination factor e_C of ISO 281, in place of the class: 1 clean, 0 very dirty", examples=[0.6]
    )
    reliability: Number = Field(0.9, ge=0.9, le=0.9995, description="probability of survival for the modified life")


def refuse_said_twice(lubrication: Lubrication) -> None:
    """SpecError for the first key that replaces others which are given too."""
    for one, others in (("viscosity", ("grade", "temperature")), ("contamination_factor", ("contamination",))):
        twice = [key for key in others if getattr(lubrication, one) is not None and getattr(lubrication, key) is not None]
        if twice:
            raise SpecError(f"replaces {' and '.join(twice)}; give one of the two", key=one)


def walther_viscosity(temperature: float, warm: float, hot: float) -> float:
    """Kinematic viscosity [m^2/s] at a temperature [K] of an oil that has `warm` at 40 and `hot` at 100 degC [m^2/s]."""
    if not warm > hot > 0 or not temperature > 0:
        raise InputError(
            f"lubricant: needs a temperature above 0 K and a viscosity that falls from 40 to 100 °C, got {temperature:g} K and "
            f"{1e6 * warm:g}, {1e6 * hot:g} mm²/s."
        )
    low, high = (np.log10(np.log10(1e6 * each + 0.7)) for each in (warm, hot))
    slope = (low - high) / np.log10(HOT / WARM)
    return float(1e-6 * (10**10 ** (low - slope * np.log10(temperature / WARM)) - 0.7))


def grade_viscosity(grade: str, temperature: float) -> float:
    """Kinematic viscosity [m^2/s] of an oil by its grade, "ISO VG 68", at a temperature [K]; viscosity index 95."""
    if grade not in VISCOSITY_AT_HOT:
        raise UnknownName("viscosity grade", grade, VISCOSITY_AT_HOT)
    return walther_viscosity(temperature, 1e-6 * float(grade.split()[-1]), 1e-6 * VISCOSITY_AT_HOT[grade])


def operating_viscosity(lubrication: Lubrication) -> float:
    """Kinematic viscosity [m^2/s] at operating temperature."""
    if lubrication.viscosity is not None:
        return lubrication.viscosity
    temperature = ZERO + TEMPERATURE if lubrication.temperature is None else lubrication.temperature
    return grade_viscosity(lubrication.grade or GRADE, temperature)


def contamination_factor(lubrication: Lubrication, pitch_diameter: float) -> float:
    """e_C [-] of ISO 281 in a bearing of this pitch diameter [m]."""
    if lubrication.contamination_factor is not None:
        return lubrication.contamination_factor
    return CONTAMINATION_FACTORS[lubrication.contamination or CLEANLINESS][pitch_diameter >= LARGE]


def lubrication_findings(lubrication: Lubrication) -> Iterator[str]:
    """What the modified life assumes where the spec does not give it."""
    assumed = []
    if lubrication.viscosity is None:
        assumed += [GRADE] * (lubrication.grade is None) + [f"{TEMPERATURE:g} degC"] * (lubrication.temperature is None)
    if lubrication.contamination_factor is None and lubrication.contamination is None:
        assumed.append(f"contamination {CLEANLINESS}")
    if assumed:
        yield f"the modified life assumes {', '.join(assumed)}; give the actual values in [lubrication]"
