"""Laws of touching: Hertz line and point contact, and normal forces as functions of gap and gap rate."""

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
from drivewright.contact.normal import HuntCrossley, KelvinVoigt, Spring, hunt_crossley_chi, normal_force

__all__ = [
    "HuntCrossley", "KelvinVoigt", "LineContact", "PointContact", "Spring", "cylinder_compression", "effective_modulus",
    "effective_radius", "hunt_crossley_chi", "line_contact", "line_greatest_shear", "line_shear", "normal_force", "point_constant",
    "point_contact", "relative_radii",
]
