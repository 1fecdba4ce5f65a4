"""Masses, stiffness and damping of a chain drive estimated where none are given: discs for sprockets, joints in line for strands."""

from typing import NamedTuple

import numpy as np

from drivewright.chains.roller_sprocket import RollerSprocket
from drivewright.chains.roller_tooth import RollerTooth
from drivewright.chains.sprocket import Sprocket
from drivewright.chains.tooth import Tooth

IN_LINE = 3  # plate on pin, pin on pin, pin on plate: contacts that make a joint
ROLLING, HINGED = 0.003, 0.02  # articulation damping over critical, estimated


def disc_mass(radius: float, hole: float, width: float, density: float) -> float:
    """Mass [kg] of a disc with a hole (radii [m]) of a width [m] and density [kg/m^3]; a hole that leaves nothing is none."""
    return np.pi * (radius**2 - _hole(radius, hole) ** 2) * width * density


def disc_inertia(mass: float, radius: float, hole: float) -> float:
    """Moment of inertia [kg m^2] of such a disc of a mass [kg] about its axis."""
    return 0.5 * mass * (radius**2 + _hole(radius, hole) ** 2)


def _hole(radius: float, hole: float) -> float:
    return hole if hole < radius else 0.0


class Disc(NamedTuple):
    """A sprocket as a disc: mass [kg], moment of inertia about its axis [kg m^2]."""

    mass: float
    inertia: float


def sprocket_disc(
    radius: float, hole: float, width: float, density: float, mass: float | None = None, inertia: float | None = None
) -> Disc:
    """`Disc` of a radius, hole (radius) and width [m] and density [kg/m^3]; mass and inertia as given where they are measured."""
    mass = mass or disc_mass(radius, hole, width, density)
    return Disc(mass, inertia or disc_inertia(mass, radius, hole))


def joint_stiffness(contact_stiffness: float) -> float:
    """Stiffness of a joint [N/m]: its contacts one behind the other."""
    return contact_stiffness / IN_LINE


def strand_stiffness(stiffness: float, free: float) -> float:
    """Stiffness [N/m] of one strand with so many free plates between joints of a stiffness [N/m]."""
    return stiffness / (free + 1)


def strands_stiffness(stiffness: float, free: float) -> float:
    """Stiffness [N/m] of both strands side by side, each with so many free plates between joints of a stiffness [N/m]."""
    return 2 * strand_stiffness(stiffness, free)


def strand_damping(ratio: float, stiffness: float, inertia: float, arm: float = 1.0) -> float:
    """Damping [N s/m] of a mass m [kg] on strands of a stiffness k [N/m] at a ratio of the critical one, 2 ratio sqrt(k m).

    With an arm R [m], that of the rotation of a moment of inertia J [kg m^2] on strands at R: 2 ratio R sqrt(k J)  [N m s].
    """
    return 2 * ratio * arm * np.sqrt(stiffness * inertia)


def usual_articulation_ratio(rolling_radius: float) -> float:
    """Damping of a joint's articulation over critical: little more than steel itself has where pins roll, more where one pin slides."""
    return ROLLING if rolling_radius else HINGED


def articulation_damping(ratio: float, tension: float, hole_pitch: float, inertia: float) -> float:
    """Damping of a joint against the turning of its plates [N m s], at a ratio of the critical one.

    A plate of inertia I [kg m^2] between joints that stand still rocks under the force T [N] of the strand with the stiffness T A, A [m]
    from pin to pin; both its joints damp it, with 2 c: c = ratio sqrt(T A I).
    """
    return ratio * np.sqrt(tension * hole_pitch * inertia)


class MeshingTooth(NamedTuple):
    """The tooth of a sprocket and the radii [m] between which it is active."""

    tooth: Tooth | RollerTooth
    tip_radius: float
    form_radius: float


def meshing_tooth(sprocket: Sprocket | RollerSprocket, thickness: float = 0.0) -> MeshingTooth:
    """What meshes of a sprocket; flanks of involutes stand out by a `thickness` [m]."""
    if isinstance(sprocket, RollerSprocket):
        return MeshingTooth(sprocket.tooth, sprocket.tip_radius, 0.0)
    tooth = sprocket.tooth._replace(support=sprocket.tooth.support - thickness)
    return MeshingTooth(tooth, sprocket.tip_radius - sprocket.tip_chamfer, sprocket.form_radius)
