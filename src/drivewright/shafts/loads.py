"""Loads on a shaft from what is known of them: directions across the shaft, and the teeth of a gear."""

from collections.abc import Sequence

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


def tooth_load(
    position: float,
    pitch_diameter: float,
    torque: float,
    mesh_angle: float = 0.0,
    pressure_angle: float = np.pi / 9,
    helix_angle: float = 0.0,
) -> ShaftLoad:
    """Load of a gear's teeth: F_t = 2 T/d along the pitch circle, F_r = |F_t| tan(a_n)/cos(b) inwards, F_a = F_t tan(b).

    position, pitch diameter d [m]; torque T [N m] of the teeth on the shaft, x towards y; angles [rad]: mesh_angle of the point of
    contact from x towards y, normal pressure angle a_n, helix angle b, positive where a positive torque pushes the gear to the right.
    """
    outward, radius = transverse_direction(mesh_angle), pitch_diameter / 2
    along = np.array([-outward[1], outward[0]])
    tangential = torque / radius
    force = tangential * along - abs(tangential) * np.tan(pressure_angle) / np.cos(helix_angle) * outward
    axial = tangential * np.tan(helix_angle)
    return ShaftLoad(position, (*force, axial), (radius * axial * outward[1], -radius * axial * outward[0], torque))
