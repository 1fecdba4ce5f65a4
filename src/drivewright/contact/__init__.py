"""Contact: normal forces, Hertz contact, impact and its losses, friction, oil film, wear.

`normal`     the family of normal laws, a NamedTuple and its formulas each, for Python and kernels.
`power_law`  F = k d^n with its energy, stiffness and inverse for arrays.
`laws`       contact laws by name, of other packages.
`time_step`  the mean of a force over a step of an explicit integrator.
`hertz`      line and point contact of elastic bodies.
`strip`      a line contact that a mesh sees as a Gaussian strip of load.
`conforming` a pin in a hole with clearance.
`impact`     impact laws, restitution and damping; a cylinder in a hollow.
`friction`   Coulomb, Ambrosio, Stribeck and LuGre friction.
`elastohydrodynamic`  oil film of a line contact under pressure.
`film`       closed forms of a journal bearing's oil film; `reynolds` solves its equation, `film_table` keeps its solutions for a time step.
`wear`       Archard wear of a bearing over its angle.
"""

from importlib import import_module
from typing import Any

from drivewright.contact.elastohydrodynamic import LineFilm, film_ratio, line_film
from drivewright.contact.hertz import (
    LineContact,
    PointContact,
    cylinder_compression,
    effective_modulus,
    effective_radius,
    line_contact,
    line_greatest_shear,
    line_shear,
    point_constant,
    point_contact,
    relative_radii,
)
from drivewright.contact.normal import HuntCrossley, KelvinVoigt, PowerLaw, Spring, hunt_crossley_chi, normal_force, stored_energy, tangent
from drivewright.contact.power_law import PowerLawResponse, power_law_depth, power_law_response, power_law_secant
from drivewright.contact.strip import gaussian_strip_approach, hertz_beyond_strip

# Their modules hold kernels, and the first kernel imports numba: loaded when first used.
_WHERE = {
    "impact": (
        "ImpactLaw",
        "cylinder_depth",
        "cylinder_energy",
        "cylinder_force",
        "delivered_restitution",
        "impact_law",
        "impact_law_names",
        "journal_stiffness",
        "kelvin_voigt_damping",
        "kelvin_voigt_restitution",
        "lasting_factor",
    ),
    "friction": ("ambrosio", "coulomb", "lugre", "lugre_rate", "stribeck"),
    "film": ("journal_friction", "long_bearing", "short_bearing"),
    "film_table": ("FilmTable", "film_table", "tabulated_bearing"),
    "reynolds": ("Film", "FilmMap", "closed_form_map", "film_deviation", "film_map", "solve_film"),
    "conforming": ("conforming_half_angle", "conforming_pressure"),
    "laws": ("ContactParameters", "contact_law", "contact_law_names"),
    "time_step": ("mean_force",),
    "wear": ("deposit", "wear_at", "wear_volume", "extrapolate_wear"),
}
_MODULE = {name: module for module, names in _WHERE.items() for name in names}

__all__ = [
    "HuntCrossley",
    "KelvinVoigt",
    "LineContact",
    "LineFilm",
    "PointContact",
    "PowerLaw",
    "PowerLawResponse",
    "Spring",
    "cylinder_compression",
    "effective_modulus",
    "effective_radius",
    "film_ratio",
    "gaussian_strip_approach",
    "hertz_beyond_strip",
    "hunt_crossley_chi",
    "line_contact",
    "line_film",
    "line_greatest_shear",
    "line_shear",
    "normal_force",
    "point_constant",
    "point_contact",
    "power_law_depth",
    "power_law_response",
    "power_law_secant",
    "relative_radii",
    "stored_energy",
    "tangent",
    *_MODULE,
]


def __getattr__(name: str) -> Any:
    if name not in _MODULE:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_MODULE[name]}"), name)
