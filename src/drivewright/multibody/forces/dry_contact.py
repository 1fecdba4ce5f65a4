"""The dry contact of a pin with play from radii, material and restitution, by the name of its normal law."""

from drivewright.contact.hertz import effective_modulus
from drivewright.contact.impact import impact_law, journal_stiffness, kelvin_voigt_damping
from drivewright.contact.laws import ContactParameters, contact_law, contact_law_names
from drivewright.multibody.forces.contact import Dry, Friction

CYLINDER_LOSS = "flores-2011"  # the cylinder law says nothing of losses


def dry_contact(
    normal: str,
    clearance: float,
    bearing_radius: float,
    length: float,
    modulus: float,
    poisson: float,
    restitution: float,
    mass: float,
    stiffness: float | None = None,
    damping: float | None = None,
    friction: Friction = Friction(),
) -> Dry:
    """The contact of journal and bearing of one material.

    normal: an impact law, whose elastic force K d^1.5 follows from the radii; "cylinder", the line contact with the losses of
    `CYLINDER_LOSS`; "kelvin-voigt", K d + c d' with the stiffness [N/m] given and the damping c [N s/m], or what gives the restitution;
    or a contact law of another package.  clearance: difference of the radii [m]; length of the bearing [m]; modulus [Pa];
    mass: effective mass of the two bodies, m1 m2/(m1 + m2) [kg].
    """
    reduced = float(effective_modulus(modulus, poisson, modulus, poisson))
    size = {"clearance": clearance, "bearing_radius": bearing_radius, "length": length, "friction": friction}
    if normal == "kelvin-voigt":
        k = stiffness or 0.0
        c = kelvin_voigt_damping(restitution, k, mass) if damping is None else damping
        return Dry(stiffness=k, exponent=1.0, damping=c, **size)
    if normal == "cylinder":
        return Dry(stiffness=reduced, hysteresis=impact_law(CYLINDER_LOSS).factor(restitution), cylinder=True, **size)
    if normal not in contact_law_names():
        hertz = float(journal_stiffness(bearing_radius, bearing_radius - clearance, reduced))
        return Dry(stiffness=hertz, hysteresis=impact_law(normal).factor(restitution), **size)
    linear = stiffness is not None
    k = stiffness if linear else float(journal_stiffness(bearing_radius, bearing_radius - clearance, reduced))
    parameters = ContactParameters(k, 1.0 if linear else 1.5, damping or 0.0, restitution, mass)
    return Dry(stiffness=k, exponent=parameters.exponent, law=contact_law(normal, parameters), **size)
