"""Rolling bearings as force elements: inner geometry, load distribution, stiffness matrix, contact pressure, life.

`response` energy, force and stiffness of any elastic support; `newton` the compiled equilibrium of one bearing; `solving` the same with
names, checks and what each element carries; `ball` and `roller` the two kinds, each with its law, static rating and reference life
(ISO/TS 16281); `life` basic life of ISO 281, `equivalent_loads` its X and Y, `modified_life` and `lubricant` its a_ISO, `lives` all lives
of a bearing, `load_spectrum` those of a duty cycle and of several bearings; `dynamic_rating` C of ISO 281 and
`standard_static_rating` C0 of ISO 76 by the inner geometry; `stiffness_curve` displacement and stiffness over load;
`approximate_stiffness` formulas from catalogue numbers alone; `catalogue` bearings by name, `catalogue_entry` what is said of each;
`designation` names as people write them, `boundary_dimensions` what they stand for, `inner_geometry` estimated from those,
`estimated_bearing` and `designated_entry` the bearing of it, `envelope` the same of one's own, `rating_checks` what is told of ratings;
`drawing` a bearing in section, `tables` and `values` answers as tables and values of a result.
"""

from importlib import import_module
from typing import Any

# Their modules hold kernels, and the first kernel imports numba: loaded when first used.
_WHERE = {
    "response": ("FREEDOMS", "evaluate_response"),  # the formula itself has the name of its module
    "newton": ("BearingMeasures", "equilibria", "equilibrium", "measures"),
    "solving": (
        "PERMISSIBLE",
        "BearingEquilibrium",
        "RollingBearing",
        "basic_static_rating",
        "contact_of",
        "elements",
        "law_of",
        "life_of",
        "solve",
    ),
    "stiffness_curve": ("LoadCurve", "load_curve"),
    "drawing": ("bearing_section",),
    "ball": ("BallBearing", "BallLaw"),
    "dynamic_rating": ("basic_dynamic_rating",),
    "life": ("basic_life", "life_duration", "life_exponent", "static_rating"),
    "equivalent_loads": ("EquivalentLoad", "LoadFactors", "ball_load_factors", "equivalent_load", "equivalent_static_load", "load_factors"),
    "modified_life": ("fatigue_limit_load", "life_modification_factor", "reference_load", "reference_viscosity", "reliability_factor"),
    "lubricant": (
        "Lubrication",
        "contamination_factor",
        "grade_viscosity",
        "lubrication_findings",
        "operating_viscosity",
        "refuse_said_twice",
        "walther_viscosity",
    ),
    "lives": ("RatingLives", "life_load_ratio", "rating_lives"),
    "load_spectrum": ("mean_load", "mean_speed", "spectrum_life", "system_life"),
    "roller": ("RollerBearing", "RollerLaw", "roller_reference_life", "roller_static_rating"),
    "designation": ("UnknownDesignation", "designations", "parse_designation"),
    "envelope": ("Envelope", "bearing_of_envelope"),
    "rating_checks": ("catalogue_findings", "estimated_keys", "rating_findings"),
    "catalogue": ("Entry", "bearing", "entry", "load_catalogue", "names", "replace_catalogue_values"),
    "approximate_stiffness": (
        "gargiulo_ball",
        "gargiulo_roller",
        "kraemer_ball",
        "kraemer_roller",
        "liu_ball",
        "liu_roller",
        "palmgren_ball",
        "palmgren_roller",
        "RadialStiffness",
    ),
}
_MODULE = {name: module for module, names in _WHERE.items() for name in names}

__all__ = sorted(_MODULE)


def __getattr__(name: str) -> Any:
    if name not in _MODULE:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_MODULE[name]}"), name)
