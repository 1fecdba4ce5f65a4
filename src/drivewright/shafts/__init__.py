"""Shafts on elastic, rolling and rigid bearings: deflection, flexibility at stations, modes; one by one and by the million.

Description: `model` sections, supports, stations, loads; `loads` directions and tooth forces; `supports` springs and rolling bearings as
supports, and their stiffness at rest; `curves` radial curves: play, tables, tangents.
Kernels and elements: `sections` round cross-sections; `beam` exact two-node elements; `closed_form` two bearings and a uniform shaft.
Statics: `assembly` beam and supports as one system; `equilibrium` Newton's method; `loaded` all loads, and the diagrams along the shaft;
`audit` whether forces balance; `buckling` under axial forces; `linearised` the shaft about its equilibrium.
Flexibility: `influence` flexibility, stiffness and their parts; `unit_loads` rigid bearings and stress under unit forces; `strength` what
fails first; `sensitivity` how the flexibility follows every parameter, `piece_slopes` and a piece of shaft its dimensions.
Vibration: `vibration` modes and critical speeds; `mode_shapes` what they are compared with; `rotor` the turning shaft in few
coordinates; `whirl` its frequencies at speed, stability; `unbalance` response and balance grades; `rotor_results` all that as values,
tables and plots.
Strength: `notches` and their factors; `fatigue_strength` safety of a section against fatigue and yield; `strength_sections` which sections;
`haigh` all that as tables, values and a plot.
Many at once: `batch` checks the arguments, `batch_kernels` computes.
To look at: `drawing` shapes of a shaft, `scenes` the shaft on screen as it bends; `tables`, `plots`, `values` and `force_results` answers
as those of a result; `solid_check` the shaft as a solid beside the beam.
"""

from importlib import import_module
from typing import Any

from drivewright.shafts.model import COWPER, EULER_BERNOULLI, LineLoad, PlaneMatrix, Section, Shaft, ShaftLoad, Station, Support

# Their modules hold kernels, and the first kernel imports numba: loaded when first used.
_WHERE = {
    "audit": ("imbalance", "unit_imbalance"),
    "assembly": ("ShaftSystem", "assemble", "refuse_mechanism", "nodal_forces"),
    "equilibrium": ("ShaftEquilibrium", "solve"),
    "influence": ("Flexibility", "flexibility", "stiffness"),
    "loaded": ("Diagram", "LoadedShaft", "ShaftLoads", "diagram", "largest_displacement", "apply_loads", "forces_along", "scaled_loads"),
    "loads": ("ToothForces", "are_coplanar", "slope_in_plane_of_action", "tooth_forces", "tooth_load", "transverse_direction"),
    "mode_shapes": ("PlanarShape", "first_mode_along", "massless_frequencies", "planar_shape"),
    "strength": ("LimitLoad", "limit_loads"),
    "notches": (
        "CrossHole",
        "Keyway",
        "Notch",
        "NotchFactors",
        "PressFit",
        "RectangularGroove",
        "RoundGroove",
        "ShoulderFillet",
        "SmoothPlace",
        "Spline",
        "measured_factors",
        "stress_concentration",
    ),
    "fatigue_strength": ("SectionStrength", "Service", "StrengthSection", "endurance_limit", "notch_sensitivity", "strength_at"),
    "strength_sections": ("assumed_fillets", "refuse_impossible_notch", "shaft_sections"),
    "haigh": ("haigh_plots", "haigh_table", "strength_table", "strength_values"),
    "supports": (
        "SupportStiffness",
        "bearing_displacement",
        "is_idle",
        "rolling_support",
        "slides_freely",
        "spring_support",
        "support_stiffness",
    ),
    "vibration": ("CriticalSpeeds", "Modes", "critical_speeds", "lowest_excited", "modes", "torsional_modes"),
    "rotor": ("Rotor", "is_round", "reduced_rotor"),
    "whirl": ("Campbell", "CriticalSpeed", "WhirlModes", "campbell", "damped_critical_speeds", "stability_threshold", "whirl_modes"),
    "unbalance": ("Orbits", "Unbalance", "balance_quality", "permissible_unbalances", "shaft_mass", "unbalance_response"),
    "drawing": ("diameters_at",),
    "buckling": ("buckling_factor", "buckling_factor_under"),
    "linearised": ("refined_equilibrium", "tangent_shaft"),
    "sensitivity": ("flexibility_slopes", "relative_flexibility_slopes"),
    "unit_loads": ("flexibility_on_rigid_bearings", "peak_unit_stress", "unit_deflection"),
    "solid_check": ("SolidFlexibility", "bearing_bands", "beam_on_bands", "solid_and_beam", "solid_flexibility"),
    "curves": ("LinearSupport", "tabulated", "with_play"),
    "batch": ("DesignTables", "design_tables", "flexibilities", "flexibility_function", "is_batchable"),
}
_MODULE = {name: module for module, names in _WHERE.items() for name in names}

__all__ = ["COWPER", "EULER_BERNOULLI", "LineLoad", "PlaneMatrix", "Section", "Shaft", "ShaftLoad", "Station", "Support", *sorted(_MODULE)]


def __getattr__(name: str) -> Any:
    if name not in _MODULE:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_MODULE[name]}"), name)
