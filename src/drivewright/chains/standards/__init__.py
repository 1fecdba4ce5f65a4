"""Chain drives by formula: lengths and distances, layouts, sprockets, forces, impacts, resonances, selection by the user's ratings.

Roller chains (ISO 606 and ISO 10823 family) and inverted-tooth chains (ASME B29.2, GB/T 10855 family), in SI units, angles in rad.
Each formula is checked by a closed form or a second route; of those recalled or read `SOURCES` says so.  Left out, as neither would
verify it:

- the standards' tables of power ratings and service factors; enter your own (sizes of chains: `drivewright.chains.sizes`)
- the speed at which pins gall, life beyond that of the ratings, the dynamic strength of chains; ratings of European chains
- lubrication classes, tooth-width and rim profiles, run-out and tolerances, also those of measuring pins
- guide grooves, face widths and tip diameters of inverted-tooth sprockets; their dimension over pins follows from the involute tooth of
  `drivewright.chains` and not from a table

The chordal rise of a strand is `drivewright.chains.link.chordal_rise`.

ansi_power  power of American chains by the formulas behind the tables of ASME B29.1
given     what the formulas of chain drives refuse to work with
layout    two sprockets and the taut chain around them
loop      a taut loop around any number of circles, inside and outside of it
rating    selection by the maker's power ratings
running   a chain at speed
sprocket  sprockets of roller chains (ISO 606 family)
"""

from drivewright.chains.standards.ansi_power import RollerChainPower, ansi_power, strand_factor
from drivewright.chains.standards.layout import (
    approximate_centre_distance,
    approximate_links,
    centre_distance,
    chain_links,
    distance_factor,
    even_links,
    min_centre_distance,
    pitch_diameter,
    strand_angle,
    strand_angle_cosine,
    strand_length,
    usual_centre_distances,
    wrap_angles,
)
from drivewright.chains.standards.loop import Circle, Loop, loop_length, taut_loop
from drivewright.chains.standards.rating import RatingTable, design_power, rated_power, rating_table, suitable_chains
from drivewright.chains.standards.running import (
    StrandForces,
    articulation_pressure,
    centrifugal_tension,
    chain_speed,
    max_power,
    meeting_energy,
    meeting_velocity,
    mesh_frequency,
    resonance_speed,
    speed_fluctuation,
    speed_range,
    strand_forces,
    strand_frequency,
    strand_pulls,
    strand_tension,
    tensile_safety,
)
from drivewright.chains.standards.sprocket import (
    SOURCES,
    ToothGap,
    gap_outline,
    max_radius_over_chain,
    over_pins,
    root_diameter,
    silent_chain,
    silent_number,
    tip_range,
    tooth_gap,
)

__all__ = [
    "Circle",
    "Loop",
    "RatingTable",
    "RollerChainPower",
    "SOURCES",
    "StrandForces",
    "ToothGap",
    "ansi_power",
    "approximate_centre_distance",
    "approximate_links",
    "articulation_pressure",
    "centre_distance",
    "centrifugal_tension",
    "chain_links",
    "chain_speed",
    "design_power",
    "distance_factor",
    "even_links",
    "gap_outline",
    "max_power",
    "max_radius_over_chain",
    "min_centre_distance",
    "loop_length",
    "meeting_energy",
    "meeting_velocity",
    "mesh_frequency",
    "over_pins",
    "pitch_diameter",
    "rated_power",
    "rating_table",
    "resonance_speed",
    "root_diameter",
    "silent_chain",
    "silent_number",
    "speed_fluctuation",
    "speed_range",
    "strand_angle",
    "strand_factor",
    "strand_forces",
    "strand_frequency",
    "strand_length",
    "strand_pulls",
    "strand_angle_cosine",
    "strand_tension",
    "suitable_chains",
    "taut_loop",
    "tensile_safety",
    "tip_range",
    "tooth_gap",
    "usual_centre_distances",
    "wrap_angles",
]
