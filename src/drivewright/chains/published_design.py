"""Sprockets of a silent chain as the published method designs them, and its curve of the equivalent pitch; formulas in `meshing`."""

from typing import NamedTuple

import numpy as np

from drivewright._typing import Numbers
from drivewright.chains import meshing
from drivewright.chains.tooth import Cutter, Tooth, cut_tooth
from drivewright.result import Column, Table

TURNS = 121  # points of the curve of the equivalent pitch


class PublishedSprocket(NamedTuple):
    """One sprocket as the published method sees it, lengths in m: seated and ideal pitch, their difference, seated apothem fp'',
    modification x, positioning diameter dp, and the tooth that is cut.  Arrays where the numbers are those of many designs."""

    teeth: int
    seated_pitch: Numbers
    ideal_pitch: Numbers
    deviation: Numbers
    seated_apothem: Numbers
    modification: Numbers
    positioning_diameter: Numbers
    tooth: Tooth


def published_sprocket(
    pitch: Numbers,
    radius: Numbers,
    offset: Numbers,
    apothem: Numbers,
    flank_angle: Numbers,
    cutter: Cutter,
    teeth: int,
    ideal: str = "seat",
) -> PublishedSprocket:
    """The `PublishedSprocket` with so many teeth for a chain: pitch, rolling radius, offset, standard apothem f [m], flank angle [rad]."""
    seated = meshing.seated_pitch(meshing.hole_pitch(pitch, radius), radius, offset, teeth)
    seated_apothem = meshing.seated_apothem(apothem, pitch, seated, flank_angle)
    modification = meshing.modification(seated_apothem, seated, teeth, flank_angle, *cutter)
    return PublishedSprocket(
        teeth,
        seated,
        meshing.ideal_pitch(pitch, teeth, ideal),
        meshing.pitch_deviation(pitch, radius, offset, teeth, ideal),
        seated_apothem,
        modification,
        meshing.positioning_diameter(seated, teeth),
        cut_tooth(teeth, cutter, modification, flank_angle),  # pyright: ignore[reportArgumentType]  arrays, of many designs
    )


def equivalent_pitch_table(pitch: float, radius: float, offset: float, teeth: int) -> Table:
    """Table "equivalent_pitch": p'' [m] over the angle between two plates [rad], up to a quarter beyond the seat on so many teeth."""
    half = np.linspace(0, 1.25 * (np.pi / teeth), TURNS)
    equivalent = np.asarray(meshing.equivalent_pitch(meshing.hole_pitch(pitch, radius), radius, offset, half, half))
    return Table(
        "equivalent_pitch",
        "Equivalent pitch, published method",
        (
            Column("turn", "rad", "angle between neighbouring plates", 2 * half),
            Column("pitch", "m", "equivalent pitch p''", equivalent),
            Column("ideal", "m", "ideal pitch p/cos(half angle)", pitch / np.cos(half), "Ideal pitch"),
        ),
    )
