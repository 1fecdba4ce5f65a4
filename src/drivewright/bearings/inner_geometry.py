"""The inner geometry of rolling bearings estimated from their boundary dimensions: one rule for each type.

Makers do not print balls and rollers, but C, C0 and f_0 of a catalogue hold them: ISO 281 and ISO 76 solved for number and diameter
give whole numbers of balls, of whole 32nds of an inch (docs/bearing_catalogue.md).  The coefficients here are fits through what came
out for the metric series of bores 10 to 100 mm in NSK's catalogue; their scatter is stated there and held by tests.
"""

from typing import Literal, NamedTuple, TypeAlias

import numpy as np

BearingType: TypeAlias = Literal["deep-groove", "angular-contact", "cylindrical", "tapered"]

# A ball: each ring keeps about a tenth of D - d as its wall under the groove, and 0.1 mm whatever its size; and the
# lands beside the ball, more than a quarter of the width.
BALL_SHARE, BALL_WALLS, BALL_WIDTH = 0.311, 0.41e-3, 0.723
ASSEMBLY_ANGLE = np.radians(189)  # that the balls fill side by side, the inner ring pushed aside to let them in (Conrad)
PITCH_FILL = 0.873  # part of the pitch circle that balls of 25 deg and more fill; the rest is the cage
SPINDLE_FILL = 0.815  # of 15 deg, with the machined cages of spindle bearings
SMALL_ANGLE = np.radians(20)
CYLINDER_SHARE, CYLINDER_FILL = 0.274, 0.85
CYLINDER_ASPECT, LIGHT_ASPECT = 0.95, 0.75  # effective length over diameter: square rollers less their edges; of the light series 10
TAPER_SHARE, TAPER_FILL, TAPER_LENGTH = 0.25, 0.90, 0.60  # L cos a is the last times the width


class InnerGeometry(NamedTuple):
    """Number of rolling elements, their diameter and pitch diameter [m]; effective length [m] of rollers, 0 of balls."""

    elements: int
    diameter: float
    pitch_diameter: float
    length: float = 0.0


def estimate_inner_geometry(kind: BearingType, bore: float, outer_diameter: float, width: float, angle: float) -> InnerGeometry:
    """The `InnerGeometry` of a type by bore, outer diameter and width [m] (of a tapered bearing the whole, T) and contact angle [rad]."""
    pitch, section = (bore + outer_diameter) / 2, outer_diameter - bore
    if kind == "cylindrical":
        return cylindrical_geometry(pitch, CYLINDER_SHARE * section)
    if kind == "tapered":
        diameter = TAPER_SHARE * section
        return InnerGeometry(pitch_count(TAPER_FILL, diameter, pitch), diameter, pitch, TAPER_LENGTH * width / float(np.cos(angle)))
    diameter = ball_diameter(section, width)
    if kind == "deep-groove":
        return InnerGeometry(conrad_count(diameter, pitch), diameter, pitch)
    return InnerGeometry(pitch_count(angular_fill(angle), diameter, pitch), diameter, pitch)


def ball_diameter(section: float, width: float) -> float:
    """Dw [m] = the lesser of 0.311 (D - d) - 0.41 mm and 0.723 B."""
    return min(BALL_SHARE * section - BALL_WALLS, BALL_WIDTH * width)


def conrad_count(diameter: float, pitch_diameter: float) -> int:
    """Z of a deep-groove bearing, to the nearest: Z - 1 steps of 2 asin(Dw/Dpw) between the first and the last ball fill 189 deg."""
    return round(1 + ASSEMBLY_ANGLE / (2 * np.arcsin(diameter / pitch_diameter)))


def angular_fill(angle: float) -> float:
    """Part of the pitch circle that the balls of an angular-contact bearing fill."""
    return SPINDLE_FILL if angle < SMALL_ANGLE else PITCH_FILL


def pitch_count(fill: float, diameter: float, pitch_diameter: float) -> int:
    """Z, to the nearest: as many elements as cover the part `fill` of the pitch circle, Z asin(Dw/Dpw) = fill pi."""
    return round(fill * np.pi / np.arcsin(diameter / pitch_diameter))


def cylindrical_geometry(pitch_diameter: float, diameter: float, aspect: float = CYLINDER_ASPECT) -> InnerGeometry:
    """Cylindrical rollers of known diameter: as many as fill 85 % of the pitch circle, `aspect` times as long as thick."""
    return InnerGeometry(pitch_count(CYLINDER_FILL, diameter, pitch_diameter), diameter, pitch_diameter, aspect * diameter)
