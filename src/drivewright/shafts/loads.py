"""Loads on a shaft from what is known of them: directions across the shaft, and the teeth of a gear."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from drivewright._typing import Floats
from drivewright.shafts.model import ShaftLoad

PARALLEL = 1e-9  # sine of the angle below which two directions are one


def transverse_direction(angle: float) -> Floats:
    """Unit vector (x, y) at an angle [rad] from x towards y, exact along the axes."""
    turn = np.exp(1j * angle)
    return np.where(np.abs([turn.real, turn.imag]) < 1e-15, 0.0, [turn.real, turn.imag])


def are_coplanar(vectors: Sequence[Floats]) -> bool:
    """Whether transverse vectors (x, y), the first of length 1, lie in one plane through the axis of the shaft."""
    return all(abs(vectors[0][0] * each[1] - vectors[0][1] * each[0]) < PARALLEL * np.hypot(*each) for each in vectors)


class ToothForces(NamedTuple):
    """Forces [N] of a gear's teeth on the shaft: tangential with the sign of its torque, radial towards the axis, axial to the right."""

    tangential: float
    radial: float
    axial: float


def tooth_forces(pitch_diameter: float, torque: float, pressure_angle: float = np.pi / 9, helix_angle: float = 0.0) -> ToothForces:
    """F_t = 2 T/d,  F_r = |F_t| tan(a_n)/cos(b),  F_a = F_t tan(b).

    pitch diameter d [m]; torque T [N m] of the teeth on the shaft, x towards y; angles [rad]: normal pressure angle a_n, helix angle b,
    positive where a positive torque pushes the gear to the right.
    """
    tangential = 2 * torque / pitch_diameter
    return ToothForces(tangential, abs(tangential) * np.tan(pressure_angle) / np.cos(helix_angle), tangential * np.tan(helix_angle))


def tooth_load(
    position: float,
    pitch_diameter: float,
    torque: float,
    mesh_angle: float = 0.0,
    pressure_angle: float = np.pi / 9,
    helix_angle: float = 0.0,
) -> ShaftLoad:
    """Load of a gear's teeth: the `ToothForces` along the pitch circle, inwards and along the axis; mesh_angle [rad]: of the point of
    contact from x towards y.
    """
    tangential, radial, axial = tooth_forces(pitch_diameter, torque, pressure_angle, helix_angle)
    outward, radius = transverse_direction(mesh_angle), pitch_diameter / 2
    force = tangential * np.array([-outward[1], outward[0]]) - radial * outward
    return ShaftLoad(position, (*force, axial), (radius * axial * outward[1], -radius * axial * outward[0], torque))


def slope_in_plane_of_action(slope: Floats, load: ShaftLoad) -> float:
    """Slope [rad] of a gear's axis in the plane in which its teeth press, from the slope (x, y) of the shaft: times the face width it is
    how much farther apart the flanks are at one end of the face than at the other.  0 without a tooth force.
    """
    press = np.array(load.force[:2])
    size = np.hypot(*press)
    return float(slope @ press / size) if size > 0 else 0.0
